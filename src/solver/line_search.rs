//! Descent along a line: the merit of a problem, minimised exactly enough on a segment.
//!
//! On a line both potentials are convex, piecewise quadratic functions of one variable, and every
//! merit is the larger of two sums of them.

use crate::linalg::number::larger;
use crate::model::problem::{PRICE, Problem};
use crate::pair::body::Body;
use crate::particle::potential::OnLine;
use nalgebra::Vector3;

/// Most trial points of one search; each costs less than an evaluation with Hessians.
const MOST_TRIALS: usize = 20;

/// The best α tried on the way to the minimum over α in (0, 1) of the merit at `from + α·direction`.
pub(crate) fn descend([a, b]: [&Body; 2], merit: Merit, from: &Vector3<f64>, direction: &Vector3<f64>) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    let mut alpha = 0.5;
    let mut best = (f64::INFINITY, 0.0);
    for _ in 0..MOST_TRIALS {
        let x = from + alpha * direction;
        let pieces = merit.pieces(a.on_line(&x, direction), b.on_line(&x, direction));
        let step = to_minimum(&pieces);
        let close = step.abs() <= CLOSE * alpha.abs();
        let value = larger(pieces[0].value, pieces[1].value);
        if value < best.0 {
            best = (value, alpha);
        }
        if step > 0.0 {
            low = alpha
        } else {
            high = alpha
        }
        let next = alpha + step;
        let next = if low < next && next < high { next } else { 0.5 * (low + high) };
        if close || (next - alpha).abs() <= CLOSE * alpha.abs() || !(low < next && next < high) {
            break;
        }
        alpha = next;
    }
    best.1
}

/// Relative accuracy of the minimum: the direction is itself an approximation.
const CLOSE: f64 = 1e-3;

/// The merit of a problem at λ.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Merit(pub Problem, pub f64);

impl Merit {
    /// The two functions whose larger one is the merit.
    fn pieces(self, a: OnLine, b: OnLine) -> [OnLine; 2] {
        let sum = |p: OnLine, weight_p: f64, q: OnLine, weight_q: f64, less: f64| OnLine {
            value: weight_p * p.value + weight_q * (q.value - less),
            slope: weight_p * p.slope + weight_q * q.slope,
            curvature: weight_p * p.curvature + weight_q * q.curvature,
        };
        let Self(problem, lambda) = self;
        match problem {
            Problem::Midway => [a, b],
            Problem::OnB => [a, sum(a, 1.0, b, PRICE * lambda, 1.0)],
            Problem::OnA => [b, sum(b, 1.0, a, PRICE / lambda, 1.0)],
            Problem::OnBoundary => [a, a],
        }
    }
}

/// Step to the minimum of the larger of the two quadratics.
fn to_minimum([p, q]: &[OnLine; 2]) -> f64 {
    let (upper, other) = if p.value >= q.value { (p, q) } else { (q, p) };
    let at = |f: &OnLine, t: f64| f.value + t * (f.slope + 0.5 * f.curvature * t);
    let descent = -upper.slope / upper.curvature;
    if !descent.is_finite() || at(other, descent) <= at(upper, descent) {
        return descent;
    }
    // The other piece takes over on the way: where they cross, or at its own minimum if that lies
    // before the crossing.
    let (v, s, c) = (upper.value - other.value, upper.slope - other.slope, upper.curvature - other.curvature);
    let towards = descent.signum();
    let crossing = first_crossing(v, s * towards, c).map_or(0.0, |t| t * towards);
    let valley = -other.slope / other.curvature;
    if (valley - crossing) * towards > 0.0 && valley.is_finite() { valley } else { crossing }
}

/// Least t ≥ 0 with v + s·t + ½c·t² = 0 for v ≥ 0, without cancellation.
fn first_crossing(v: f64, s: f64, c: f64) -> Option<f64> {
    let discriminant = s * s - 2.0 * c * v;
    if discriminant < 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    let t = if s < 0.0 { 2.0 * v / (root - s) } else { -(s + root) / c };
    (t >= 0.0 && t.is_finite()).then_some(t)
}
