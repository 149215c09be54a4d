//! Descent along a line: the merit of a problem, minimised exactly enough on a segment.
//!
//! On a line both potentials are convex, piecewise quadratic functions of one variable, and every
//! merit is the larger of two sums of them.

use crate::linalg::number::larger;
use crate::model::problem::{PRICE, Problem};
use crate::pair::body::Body;
use crate::particle::potential::OnLine;
use nalgebra::Vector3;

/// Most trial points of one search; each costs less than an evaluation with Hessians (chosen).
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

/// Relative accuracy of the minimum: the direction is itself an approximation (chosen).
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pair::pair::Pair;
    use crate::particle::particle::Particle;
    use crate::pose::Pose;

    fn piece(value: f64, slope: f64, curvature: f64) -> OnLine {
        OnLine { value, slope, curvature }
    }

    /// 1 − t against t: they cross at ½. 1 − 10 t against 0.9 − t + ½ t², which takes over at once and is least at 1.
    #[test]
    fn the_larger_of_two_pieces_is_least_where_they_cross_or_in_the_valley_of_one() {
        for way in [1.0, -1.0] {
            let falling = piece(1.0, -way, 0.1);
            assert!((to_minimum(&[falling, falling]) - 10.0 * way).abs() < 1e-14);
            assert!((to_minimum(&[falling, piece(0.0, way, 0.1)]) - 0.5 * way).abs() < 1e-15);
            assert!((to_minimum(&[piece(1.0, -10.0 * way, 0.1), piece(0.9, -way, 1.0)]) - way).abs() < 1e-15);
        }
    }

    /// Unit balls about 0 and 1.5: both S are equal at 0.75, and the surface of B ends at 1, up to which S_A falls.
    #[test]
    fn the_minimum_along_a_line_between_balls_is_known() {
        let ball = Particle::sphere(1.0).unwrap();
        let (pose_a, pose_b) = (Pose::at([1.5, 0.0, 0.0]).unwrap(), Pose::at([0.0; 3]).unwrap());
        let pair = Pair::new(&ball, &pose_a, &ball, &pose_b);
        let (a, b) = Body::both(&pair, 0.0);
        for (problem, expected) in [(Problem::Midway, 0.75), (Problem::OnB, 1.0), (Problem::OnA, 0.5)] {
            let (from, direction) = (Vector3::new(-0.3, 0.0, 0.0), Vector3::new(2.0, 0.0, 0.0));
            let alpha = descend([&a, &b], Merit(problem, 1.0), &from, &direction);
            assert!((from.x + alpha * direction.x - expected).abs() < 2.0 * CLOSE, "{problem:?}: {alpha}");
        }
    }
}
