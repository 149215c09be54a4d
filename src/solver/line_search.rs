//! Descent along a line: the merit of a problem, minimised exactly enough on a segment.
//!
//! On a line both potentials are convex, piecewise quadratic functions of one variable, and every
//! merit is the larger of two sums of them.

use crate::model::problem::{PRICE, Problem};
use crate::pair::placed_particle::Body;
use crate::particle::potential::OnLine;
use nalgebra::Vector3;

/// Most trial points of one search; each costs less than an evaluation with Hessians.
const MOST_TRIALS: usize = 20;

/// Both potentials at a point of the line.
#[derive(Clone, Copy, Debug)]
struct Trial {
    merit: f64,
    pieces: [OnLine; 2],
}

/// Looks for the minimum over α in (0, most) of the merit at `from + α·direction`, from `start` on.
pub(crate) fn descend(
    [a, b]: [&Body; 2],
    merit: Merit,
    from: &Vector3<f64>,
    direction: &Vector3<f64>,
    (start, most): (f64, f64),
) -> Descent {
    let (mut low, mut high) = (0.0, most);
    let mut alpha = start;
    let mut best: Option<(Trial, Descent)> = None;
    for _ in 0..MOST_TRIALS {
        let x = from + alpha * direction;
        let (on_a, on_b) = (a.on_line(&x, direction), b.on_line(&x, direction));
        let pieces = merit.pieces(on_a, on_b);
        let trial = Trial { merit: pieces[0].value.max(pieces[1].value), pieces };
        let step = trial.minimise_pieces();
        let close = step.abs() <= CLOSE * alpha.abs();
        if best.is_none_or(|(b, _)| trial.merit < b.merit) {
            best = Some((trial, Descent { alpha, slope_a: on_a.slope, slope_b: on_b.slope }));
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
    best.map_or(Descent { alpha: 0.0, slope_a: 0.0, slope_b: 0.0 }, |(_, descent)| descent)
}

/// Relative accuracy of the minimum: the direction is itself an approximation.
const CLOSE: f64 = 1e-3;

/// Where a descent ended.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Descent {
    /// The best α tried.
    pub alpha: f64,
    /// dS_A/dα and dS_B/dα at the best α.
    pub slope_a: f64,
    pub slope_b: f64,
}

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
        }
    }
}

impl Trial {
    /// Step to the minimum of the larger of the two quadratics.
    fn minimise_pieces(&self) -> f64 {
        let [p, q] = &self.pieces;
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
