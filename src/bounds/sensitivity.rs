//! How the optimum of two quadratics answers to small changes of their data, and so what rounding does to it.

use crate::linalg::number::{larger, smaller};
use crate::linalg::symmetric::Symmetric;
use crate::model::dual_path::Optimum;
use crate::model::problem::Target;
use crate::particle::potential::Quadratic;
use nalgebra::Vector3;

/// Rounding of the sums in a slope: twice the root of the terms of S, each right to a few units in the last place.
const SUMS: f64 = 8.0 * f64::EPSILON;

/// Rounding of tr(M H M), relative to tr H⁻¹.
const TRACE_ROUNDING: f64 = 16.0 * f64::EPSILON;

impl Optimum {
    /// Bound on the rounding of the sums by which S of one body is taken along the step.
    pub fn rounding(&self, q: &Quadratic) -> f64 {
        q.rounding_after(&self.step, q.terms(&self.step))
    }

    /// The same of the sums by which the slope was made to vanish, in whatever direction.
    pub fn rounding_of_slope(&self, q: &Quadratic) -> f64 {
        SUMS * (q.terms(&self.step) * q.hessian.trace()).sqrt()
    }

    /// How fast the sides part with ln λ.
    pub fn rate(&self, target: Target) -> f64 {
        self.rate * target.per_logarithm(target.weights(self.lambda))
    }

    /// How the optimum answers to small changes of the data, with least curvatures `soft` of A and B.
    #[inline(always)]
    pub fn response(&self, target: Target, soft: (f64, f64)) -> Option<Response> {
        if !(self.rate > 0.0) {
            return None;
        }
        let inverse = self.factor.inverse();
        let mut squares = Symmetric::default();
        squares.add_square(&self.along);
        let to_slope = squares.weighted(1.0 / self.rate, &inverse, -1.0);
        let (a, b) = target.weights(self.factored);
        // tr(M H M) = −tr M, less the spheres' share of H; the difference is known to the rounding of its terms.
        let (trace, traces) = (-to_slope.trace(), [inverse.trace(), inverse.xx + inverse.yy]);
        let of_planes = trace - (a * soft.0 + b * soft.1) * to_slope.square() + TRACE_ROUNDING * traces[0];
        Some(Response {
            to_slope,
            traces,
            per_value: self.along.norm() / self.rate,
            to_all_planes: larger(of_planes, 0.0),
            slope: self.slope(target),
            values: self.values.into(),
        })
    }
}

/// How the optimum answers to small changes of the data: the derivative of the conditions
/// a·g_A + b·g_B = 0 and m = 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Response {
    /// The answer of v to a slope that is left:
    ///
    /// ```text
    /// M = (along ⊗ along)/rate − H⁻¹
    /// ```
    to_slope: Symmetric,
    /// Traces of H⁻¹: over all three axes, and over the first two.
    traces: [f64; 2],
    /// |dv/dθ| / (dm/dθ), with dv/dθ = −H⁻¹w and dm/dθ = wᵀH⁻¹w.
    per_value: f64,
    /// Σ of weight·2w·tr(M N M) over both bodies, N = Σ n nᵀ over the planes of one.
    to_all_planes: f64,
    /// What is left of a·g_A + b·g_B.
    slope: Vector3<f64>,
    /// q_A and q_B.
    values: [f64; 2],
}

impl Response {
    /// The move that would take away what is left of the slope.
    pub fn unsolved(&self) -> f64 {
        self.to_slope.times(&self.slope).norm()
    }

    /// How α·q_A + β·q_B moves the point when S of A (0) or B (1) grows: |α|·|along|/rate, or that of β.
    #[inline]
    pub fn to_body_value(&self, body: usize, target: Target) -> f64 {
        let (alpha, beta): (f64, f64) = target.turning();
        self.per_value * if body == 0 { alpha.abs() } else { beta.abs() }
    }

    /// Bound on the move by planes that do not count and may be on, each with its normal, its stiffness and the depth to which it
    /// is on if the point does not give way.
    ///
    /// The point gives way as a spring of M⁻¹ does, stiffer once a plane is on: a plane alone is on to the depth over
    /// 1 + stiffness·n·(−M)n. Several may push each other, but hold no more work, ½Σ stiffness·depth², than if the point stayed.
    pub fn to_planes_beside(&self, planes: impl Iterator<Item = (Vector3<f64>, f64, f64)>) -> f64 {
        let (mut alone, mut work, mut moves, mut count) = (0.0, 0.0, 0.0, 0);
        for (n, stiffness, depth) in planes {
            let way = self.to(&n);
            alone = stiffness * way.norm() * depth / (1.0 + stiffness * larger(-way.dot(&n), 0.0));
            work += stiffness * depth * depth;
            moves += stiffness * way.norm_squared();
            count += 1;
        }
        if count > 1 { (work * smaller(moves, larger(-self.to_slope.trace(), 0.0))).sqrt() } else { alone }
    }

    /// Bound on the move by the rounding of the sums in the slope of a body of this weight, after a step with these
    /// terms of S: on axis k they are as large as √h_kk.
    pub fn to_sums(&self, q: &Quadratic, weight: f64, terms: f64) -> f64 {
        let m = &self.to_slope;
        let square = |x: f64, y: f64, z: f64| x * x + y * y + z * z;
        let moves = Vector3::new(square(m.xx, m.yx, m.zx), square(m.yx, m.yy, m.zy), square(m.zx, m.zy, m.zz));
        SUMS * weight * (3.0 * terms * q.hessian.diagonal().dot(&moves)).sqrt()
    }

    /// The move of the optimum when a·g_A + b·g_B grows by a slope.
    pub fn to(&self, slope: &Vector3<f64>) -> Vector3<f64> {
        self.to_slope.times(slope)
    }

    /// Bound on the move when α·q_A + β·q_B is off by `value`.
    pub fn to_value(&self, value: f64) -> f64 {
        self.per_value * value
    }

    /// Bound on the moves, summed, when each plane of A (0) or B (1) moves by one unit of length.
    ///
    /// A plane with depth p turns the slope by 2wn and raises S by 2wp, and the optimum answers with
    /// 2w·(a·M n + along·α·p/rate). By Cauchy's inequality Σ|M n| ≤ √(m·tr(M N M)), and Σp ≤ √(m·S/w), so that no plane is
    /// looked at again. H·along = −w makes M H M = −M, of which the planes' share is what the spheres leave: one trace
    /// for all planes of both.
    pub fn to_planes(&self, body: usize, q: &Quadratic, target: Target, lambda: f64, plane_weight: f64) -> f64 {
        if plane_weight == 0.0 || q.count == 0 {
            return 0.0;
        }
        let (a, b) = target.weights(lambda);
        let weight = if body == 0 { a } else { b };
        let count = f64::from(q.count);
        let turned = (2.0 * plane_weight * weight * count * self.to_all_planes).sqrt();
        let raised = self.to_body_value(body, target) * (count * plane_weight * larger(self.values[body], 0.0)).sqrt();
        turned + 2.0 * raised
    }

    /// Bound on the move per unit of slope, in whatever direction (in the plane: of its first two axes).
    pub fn per_slope(&self, dimensions: usize) -> f64 {
        self.traces[usize::from(dimensions == 2)]
    }
}
