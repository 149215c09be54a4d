//! How the optimum of two quadratics answers to small changes of their data, and so what rounding does to it.

use crate::bounds::rounding::sums;
use crate::linalg::number::{gamma, larger};
use crate::linalg::symmetric::Symmetric;
use crate::model::dual_path::Optimum;
use crate::model::problem::Problem;
use crate::particle::potential::Quadratic;
use nalgebra::Vector3;

/// Rounding of tr(M H M), relative to tr H⁻¹ (estimated).
const TRACE_ROUNDING: f64 = gamma(32);

/// How the optimum answers to small changes of the data: the derivative of the conditions
/// a·g_A + b·g_B = 0 and m = 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sensitivity {
    /// The answer of v to a slope that is left:
    ///
    /// ```text
    /// M = (along ⊗ along)/rate − H⁻¹
    /// ```
    to_slope: Symmetric,
    /// Trace of H⁻¹ over the axes along which a point may move.
    trace: f64,
    /// |dv/dθ| / (dm/dθ), with dv/dθ = −H⁻¹w and dm/dθ = wᵀH⁻¹w.
    per_value: f64,
    /// Σ of weight·2w·tr(M N M) over both bodies, N = Σ n nᵀ over the planes of one.
    to_all_planes: f64,
    /// What is left of a·g_A + b·g_B.
    slope: Vector3<f64>,
    /// q_A and q_B.
    values: [f64; 2],
    /// Least depth of a plane of A and of B times the length of its normal.
    pushes: [f64; 2],
}

impl Sensitivity {
    /// Of the optimum of two quadratics with least curvatures `soft` and least plane pushes `pushes` of A and B, in
    /// `dimensions` coordinates; `None` where the mismatch does not change with λ.
    #[inline(always)]
    pub fn of(
        optimum: &Optimum,
        problem: Problem,
        soft: (f64, f64),
        pushes: [f64; 2],
        dimensions: usize,
    ) -> Option<Self> {
        if !(optimum.mismatch_rate > 0.0) {
            return None;
        }
        let inverse = optimum.factor.inverse().within(dimensions);
        let mut squares = Symmetric::default();
        squares.add_square(&optimum.along);
        let to_slope = squares.weighted(1.0 / optimum.mismatch_rate, &inverse, -1.0);
        let (a, b) = problem.weights(optimum.factored);
        // tr(M H M) = −tr M, less the spheres' share of H; the difference is known to the rounding of its terms.
        let trace = inverse.trace();
        let of_planes = -to_slope.trace() - (a * soft.0 + b * soft.1) * to_slope.square() + TRACE_ROUNDING * trace;
        Some(Self {
            to_slope,
            trace,
            per_value: optimum.along.norm() / optimum.mismatch_rate,
            to_all_planes: larger(of_planes, 0.0),
            slope: optimum.slope(problem),
            values: optimum.values.into(),
            pushes,
        })
    }

    /// The answer to a slope.
    pub fn to_slope(&self, slope: &Vector3<f64>) -> Vector3<f64> {
        self.to_slope.times(slope)
    }

    /// The move that would take away what is left of the slope.
    pub fn unsolved(&self) -> f64 {
        self.to_slope.times(&self.slope).norm()
    }

    /// Whether every plane still pushes when the point has moved so far, with normals of A and B no longer than these.
    #[inline]
    pub fn holds_within(&self, moved: f64, longest_normals: [f64; 2]) -> bool {
        let holds = |i: usize| moved * longest_normals[i] * longest_normals[i] <= self.pushes[i];
        holds(0) && holds(1)
    }

    /// Bound on the move per unit of S_A (0) or S_B (1): |α|·|along|/rate, or that of β.
    #[inline]
    pub fn to_body_value(&self, body: usize, problem: Problem) -> f64 {
        let (alpha, beta): (f64, f64) = problem.weight_rates();
        self.per_value * if body == 0 { alpha.abs() } else { beta.abs() }
    }

    /// Bound on the move by the rounding of the sums in the slope of a body of this weight, after a step with these
    /// terms of S: on axis k they are as large as √h_kk.
    pub fn to_sums(&self, q: &Quadratic, weight: f64, terms: f64) -> f64 {
        let m = &self.to_slope;
        let square = |x: f64, y: f64, z: f64| x * x + y * y + z * z;
        let moves = Vector3::new(square(m.xx, m.yx, m.zx), square(m.yx, m.yy, m.zy), square(m.zx, m.zy, m.zz));
        // 3: Cauchy's inequality over three axes.
        sums(q.count) * weight * (3.0 * terms * q.hessian.diagonal().dot(&moves)).sqrt()
    }

    /// Bound on the move when α·q_A + β·q_B is off by `value`.
    pub fn to_value(&self, value: f64) -> f64 {
        self.per_value * value
    }

    /// Bound on the moves, summed, when each plane of A (0) or B (1) moves by one unit of length.
    ///
    /// A plane with depth p turns the slope by 2wn and raises S by 2wp, and the optimum answers with 2w·(a·M n +
    /// along·α·p/rate). By Cauchy's inequality Σ|M n| ≤ √(m·tr(M N M)), and Σp ≤ √(m·S/w), so that no plane is looked
    /// at again. H·along = −w makes M H M = −M, of which the planes' share is what the spheres leave: one trace for all
    /// planes of both.
    pub fn to_planes(&self, body: usize, count: u32, problem: Problem, lambda: f64, plane_weight: f64) -> f64 {
        if plane_weight == 0.0 || count == 0 {
            return 0.0;
        }
        let (a, b) = problem.weights(lambda);
        let weight = if body == 0 { a } else { b };
        let count = f64::from(count);
        let turned = (2.0 * plane_weight * weight * count * self.to_all_planes).sqrt();
        let raised = self.to_body_value(body, problem) * (count * plane_weight * larger(self.values[body], 0.0)).sqrt();
        turned + 2.0 * raised
    }

    /// Bound on the move per unit of slope, in whatever direction.
    pub fn per_slope(&self) -> f64 {
        self.trace
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::dual_search::tests::two_ellipsoids;
    use crate::model::dual_search::{DualSearch, side};
    use crate::particle::potential::Quadratic;

    /// The optimum of quadratics whose slope or value is changed by a little, against what the sensitivity says of it.
    #[test]
    fn the_answer_to_small_changes_is_that_of_another_solve() {
        let [q_a, q_b] = two_ellipsoids();
        let (soft, change) = ((1.0, 1.0), 1e-6_f64);
        for problem in [Problem::Midway, Problem::OnB, Problem::OnA] {
            let solve = |q_a: &Quadratic| {
                DualSearch::new(side(q_a, soft.0), side(&q_b, soft.1), problem).solve(1.0).expect("an optimum")
            };
            let before = solve(&q_a);
            let sensitivity = Sensitivity::of(&before, problem, soft, [f64::INFINITY; 2], 3).unwrap();
            let (a, _) = problem.weights(before.lambda);
            let turned: Vector3<f64> = change * Vector3::new(0.3, -0.5, 0.8);
            // So that q_A at the optimum stays what it is.
            let expansion = q_a.expansion - turned.dot(&before.step);
            let after = solve(&Quadratic { gradient: q_a.gradient + turned, expansion, value: expansion, ..q_a });
            let (moved, expected) = (after.step - before.step, a * sensitivity.to_slope.times(&turned));
            assert!((moved - expected).norm() < 1e-4 * expected.norm(), "{problem:?}: {moved}, {expected}");
            assert!(moved.norm() <= a * turned.norm() * sensitivity.per_slope(), "{problem:?}");
            let expansion = q_a.expansion + change;
            let raised = solve(&Quadratic { expansion, value: expansion, ..q_a }).step - before.step;
            let bound = change * sensitivity.to_body_value(0, problem);
            assert!((raised.norm() - bound).abs() <= 1e-4 * bound, "{problem:?}: {raised}, {bound}");
        }
    }
}
