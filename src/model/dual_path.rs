//! The curve on which both quadratics at a point are optimal for some weights, in numbers or in lanes of numbers.
//!
//! For weights a, b ≥ 0 let v minimise a·q_A + b·q_B, that is H v = −g with H = a H_A + b H_B, g = a g_A + b g_B. As
//! the weight θ of the problem changes, v runs along a curve from the minimum of one particle to that of the other;
//! the wanted point is where the mismatch m(θ) = c − (α q_A + β q_B) is zero, with α, β the rates of a, b and
//! c = 0 for midway, 1 for the two closest points. One search in one variable serves all three (`dual_search`).
//!
//! One factorisation of H gives the curve's whole Taylor series: with D = α H_A + β H_B and w₀ = α g_A + β g_B at v₀,
//!
//! ```text
//! v(δ) = Σ δⁿ v_n,   v_n = −H⁻¹ w_{n−1},   w_n = D v_n,   m_n = −(n+1)/2 · v_i·w_j  for any i + j = n, i ≥ 1
//! ```
//!
//! so that v₁ and v₂ give m to the fourth order, and each search multiplies the number of right digits by five.

use crate::linalg::number::Number;
use crate::linalg::symmetric::{Factor, Symmetric};
use crate::model::problem::Problem;
use nalgebra::Vector3;

/// |a·g_A + b·g_B| that counts as zero, in units of rounding of either force (chosen; the slope itself enters the
/// bound).
const BALANCED: f64 = 32.0;

/// One of the two quadratics: value, gradient and curvature where the step begins.
#[derive(Clone, Copy)]
pub(crate) struct Side<'a, N> {
    pub value: N,
    pub gradient: &'a Vector3<N>,
    pub hessian: &'a Symmetric<N>,
    /// Least curvature in any direction (its sphere's).
    pub soft: N,
}

/// The pair of quadratics and the problem: what stays the same while λ is searched.
///
/// Functions that are rarely called take it and the probes by value: an address passed on would keep them in memory on
/// the common path.
#[derive(Clone, Copy)]
pub(crate) struct DualPath<'a, N> {
    a: Side<'a, N>,
    b: Side<'a, N>,
    problem: Problem,
    /// D, and α·q_A + β·q_B at the point of expansion.
    rate_hessian: Symmetric<N>,
    rate_value: N,
}

/// Optimum of the two quadratics for a weight ratio λ.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Optimum<N = f64> {
    /// Step from the point of expansion.
    pub step: Vector3<N>,
    /// ∇S_A and ∇S_B there: a·g_A + b·g_B = 0. Where a stiff plane is on by less than rounding, only the
    /// model knows them.
    pub gradients: [Vector3<N>; 2],
    /// q_A and q_B there.
    pub values: (N, N),
    /// Weight ratio λ = b/a.
    pub lambda: N,
    /// Whether λ is as good as rounding allows.
    pub settled: bool,
    /// Of H, at λ or very near.
    pub factor: Factor<N>,
    /// The λ of the factor.
    pub factored: N,
    /// dv/dθ and dm/dθ.
    pub along: Vector3<N>,
    pub mismatch_rate: N,
}

/// The point of the curve at some λ: as much as the search for λ takes.
#[derive(Clone, Copy)]
pub(crate) struct Probe<N> {
    pub lambda: N,
    pub weights: (N, N),
    step: Vector3<N>,
    factor: Factor<N>,
    along: Vector3<N>,
    pub rate: N,
    /// m.
    pub mismatch: N,
    /// q_A and q_B, with the absolute rounding of a·q_A + b·q_B.
    pub values: (N, N),
}

/// The way to the root along the series of the curve.
#[derive(Clone, Copy)]
pub(crate) struct Series<N> {
    /// Change of θ.
    delta: N,
    /// λ after it.
    pub lambda: N,
    v2: Vector3<N>,
    w2: Vector3<N>,
    /// Share of the higher terms in the first.
    pub share: N,
}

impl<'a, N: Number> DualPath<'a, N> {
    #[inline(always)]
    pub fn new(a: Side<'a, N>, b: Side<'a, N>, problem: Problem) -> Self {
        let (alpha, beta) = problem.weight_rates();
        let rate_hessian = a.hessian.weighted(alpha, b.hessian, beta);
        let rate_value = alpha * a.value + beta * b.value;
        Self { a, b, problem, rate_hessian, rate_value }
    }

    /// With H v = −g the weighted sum is ½ g·v more than at the point of expansion, and D v gives the other sum: q_A
    /// and q_B follow from the two.
    #[inline(always)]
    pub fn probe(&self, lambda: N) -> Option<Probe<N>> {
        let (half, weights @ (a, b)) = (N::of(0.5), self.problem.weights(lambda));
        let h = self.a.hessian.weighted(a, self.b.hessian, b);
        let factor = Factor::of(&h, a * self.a.soft + b * self.b.soft)?;
        let g = self.a.gradient * a + self.b.gradient * b;
        let step = -factor.solve(&g);
        let before = self.rate_of(self.a.gradient, self.b.gradient);
        let w0 = before + self.rate_hessian.times(&step);
        let along = -factor.solve(&w0);
        let rate = self.rate_value + half * step.dot(&(before + w0));
        let fixed = a * self.a.value + b * self.b.value + half * step.dot(&g);
        let (values, mismatch) = (self.problem.apart(fixed, rate, weights), self.problem.level::<N>() - rate);
        Some(Probe { lambda, weights, step, factor, along, rate: self.problem.rate(-w0.dot(&along)), mismatch, values })
    }

    /// α·x + β·y.
    #[inline(always)]
    fn rate_of(&self, x: &Vector3<N>, y: &Vector3<N>) -> Vector3<N> {
        match self.problem {
            Problem::Midway => y - x,
            Problem::OnB => *y,
            Problem::OnA => *x,
            Problem::OnBoundary => Vector3::repeat(N::of(0.0)),
        }
    }

    /// The optimum at a point of the curve.
    #[inline(always)]
    pub fn optimum(&self, probe: &Probe<N>) -> Optimum<N> {
        self.after(probe.step, probe.lambda, probe)
    }

    /// The quadratics after a step, which lies on the curve near a probe.
    #[inline(always)]
    pub fn after(&self, step: Vector3<N>, lambda: N, near: &Probe<N>) -> Optimum<N> {
        let gradient = |side: &Side<N>| side.gradient + side.hessian.times(&step);
        let gradients = [gradient(&self.a), gradient(&self.b)];
        let value = |side: &Side<N>, g: &Vector3<N>| side.value + N::of(0.5) * step.dot(&(side.gradient + g));
        let values = (value(&self.a, &gradients[0]), value(&self.b, &gradients[1]));
        let Probe { factor, along, rate: mismatch_rate, lambda: factored, .. } = *near;
        Optimum { step, gradients, values, lambda, settled: false, factor, factored, along, mismatch_rate }
    }

    /// Root of m(δ) to the fourth order, by reversion of the series; `None` where it would move a weight by more
    /// than half.
    #[inline(always)]
    pub fn series(&self, found: &Probe<N>) -> Option<Series<N>> {
        let (v1, inverse, (a, b)) = (&found.along, N::of(1.0) / found.rate, found.weights);
        let w1 = self.rate_hessian.times(v1);
        let v2 = -found.factor.solve(&w1);
        let w2 = self.rate_hessian.times(&v2);
        let of = N::of;
        let (m2, m3, m4) = (of(-1.5) * v1.dot(&w1), of(-2.0) * v2.dot(&w1), of(-2.5) * v2.dot(&w2));
        let y = -found.mismatch * inverse;
        let (c2, c3, c4) = (m2 * inverse * y, m3 * inverse * y * y, m4 * inverse * y * y * y);
        let delta = y * (of(1.0) - c2 + (of(2.0) * c2 * c2 - c3) + (of(5.0) * c2 * (c3 - c2 * c2) - c4));
        let (alpha, beta) = self.problem.weight_rates::<N>();
        let stays =
            (alpha * delta).magnitude().is_at_most(of(0.5) * a) && (beta * delta).magnitude().is_at_most(of(0.5) * b);
        let lambda = self.lambda_after(found, delta);
        let share = c2.magnitude() + c3.magnitude() + c4.magnitude();
        stays.then_some(Series { delta, lambda, v2, w2, share })
    }

    #[inline(always)]
    fn lambda_after(&self, found: &Probe<N>, delta: N) -> N {
        let ((alpha, beta), (a, b)) = (self.problem.weight_rates::<N>(), found.weights);
        (b + beta * delta) / (a + alpha * delta)
    }

    /// The optimum at the end of a series, without another factorisation: to the third order.
    #[inline(always)]
    pub fn along(&self, found: &Probe<N>, series: &Series<N>) -> Optimum<N> {
        let v3 = -found.factor.solve(&series.w2);
        let delta = series.delta;
        let step = found.step + (found.along + (series.v2 + v3 * delta) * delta) * delta;
        self.after(step, series.lambda, found)
    }

    /// Whether the slope a·g_A + b·g_B is zero to rounding. In a symmetric pair the terms of the mismatch cancel and
    /// say nothing about those of the curve.
    #[inline(always)]
    pub fn is_balanced(&self, found: &Optimum<N>) -> bool {
        let (a, _) = self.problem.weights(found.lambda);
        let force = a * a * (square(self.a.gradient) + square(&found.gradients[0]));
        square(&found.slope(self.problem)).is_at_most(N::of(BALANCED * N::UNIT * BALANCED * N::UNIT) * force)
    }
}

#[inline(always)]
fn square<N: Number>(v: &Vector3<N>) -> N {
    v.dot(v)
}

impl<N: Number> Optimum<N> {
    /// a·g_A + b·g_B: zero but for rounding.
    #[inline]
    pub fn slope(&self, problem: Problem) -> Vector3<N> {
        let (a, b) = problem.weights(self.lambda);
        self.gradients[0] * a + self.gradients[1] * b
    }
}

impl Optimum {
    /// dm/d ln λ; negative for the closest point on A.
    pub fn rate(&self, problem: Problem) -> f64 {
        self.mismatch_rate * problem.per_logarithm(problem.weights(self.lambda))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    /// q_A about the origin and q_B about another point, none of them a sphere.
    fn path<'a>(sides: &'a [(Vector3<f64>, Symmetric); 2], problem: Problem) -> DualPath<'a, f64> {
        let side = |(gradient, hessian): &'a (Vector3<f64>, Symmetric)| Side {
            value: 0.5 * gradient.x * gradient.x,
            gradient,
            hessian,
            soft: 0.1,
        };
        DualPath::new(side(&sides[0]), side(&sides[1]), problem)
    }

    fn sides() -> [(Vector3<f64>, Symmetric); 2] {
        let of_a = Symmetric { xx: 2.5, yx: 0.3, yy: 4.0, zx: -0.2, zy: 0.1, zz: 1.5 };
        let of_b = Symmetric { xx: 1.8, yx: -0.1, yy: 2.0, zx: 0.4, zy: 0.5, zz: 5.0 };
        [(Vector3::new(1.1, -0.4, 0.2), of_a), (Vector3::new(-1.3, 0.2, 0.5), of_b)]
    }

    /// The derivatives of the curve by differences.
    #[test]
    fn along_and_rate_are_the_derivatives_of_the_curve() {
        let sides = sides();
        for problem in [Problem::Midway, Problem::OnB, Problem::OnA] {
            let (path, lambda, step) = (path(&sides, problem), 1.7, 1e-5_f64);
            let at = |lambda: f64| path.probe(lambda).unwrap();
            let (here, more, less) = (at(lambda), at(lambda * step.exp()), at(lambda * (-step).exp()));
            let of_theta = 2.0 * step * problem.per_logarithm(here.weights);
            assert!(((more.step - less.step) / of_theta - here.along).norm() < 1e-7, "{problem:?}");
            assert!(((more.mismatch - less.mismatch) / of_theta - here.rate).abs() < 1e-7, "{problem:?}");
        }
    }

    /// With a tenth of the mismatch to begin with, the series of four terms leaves a hundred thousandth, and its point,
    /// of three, a ten thousandth.
    #[test]
    fn the_series_leaves_the_fifth_power_of_the_mismatch() {
        let sides = sides();
        let path = path(&sides, Problem::Midway);
        let mut root = 1.0;
        for _ in 0..6 {
            root = path.series(&path.probe(root).unwrap()).unwrap().lambda;
        }
        let left = |off: f64| {
            let found = path.probe(root * off.exp()).unwrap();
            let series = path.series(&found).unwrap();
            let end = path.along(&found, &series);
            let exact = path.probe(series.lambda).unwrap();
            ((series.lambda / root).ln().abs(), (end.step - exact.step).norm())
        };
        let ((far, far_point), (near, near_point)) = (left(0.2), left(0.02));
        assert!(
            near < 10.0 * 1e-5 * far && near_point < 10.0 * 1e-4 * far_point,
            "{far:e} to {near:e}, {far_point:e} to {near_point:e}"
        );
    }
}
