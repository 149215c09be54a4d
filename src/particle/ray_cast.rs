//! Where a ray from inside meets the surface: exact, since S is piecewise quadratic on a line.

use crate::particle::potential;
use crate::particle::shape::Shape;
use nalgebra::Vector3;

/// Most pieces that a root search walks over; each Newton step from outside ends one piece or more,
/// so that this is reached only by rounding.
const MOST_STEPS: usize = 100;

/// Distance τ ≥ 0 with S(from + τ·direction) = 1, for a local point and a local unit direction.
///
/// `from` should be inside (S ≤ 1). From a point outside by rounding the answer is a small negative number if the ray leads
/// away, and where it comes out again if it leads in. `None` when the ray never leaves (not a particle) or misses it, or
/// something is not finite.
pub fn distance(shape: &Shape, from: &Vector3<f64>, direction: &Vector3<f64>) -> Option<f64> {
    distance_near(shape, from, direction, 0.0)
}

/// The same, with a guess of the distance to begin at; a right one saves half of the work.
#[inline]
pub(crate) fn distance_near(shape: &Shape, from: &Vector3<f64>, direction: &Vector3<f64>, guess: f64) -> Option<f64> {
    let at = |tau: f64| {
        let mut line = potential::on_line(shape, shape.sphere_weight, &(from + tau * direction), direction);
        line.value -= 1.0;
        line
    };
    // The root of the current quadratic piece is exact once the right planes are on. Before that it
    // may jump past the root either way; the bracket turns such a jump into a Newton step from the
    // outside, which, S being convex, never jumps.
    let (mut inside, mut outside) = (f64::NEG_INFINITY, f64::INFINITY);
    let mut newton_from_outside = f64::NAN;
    let (mut nearest, mut least) = (0.0, f64::INFINITY);
    // No surface point is further off than this.
    let start = from.norm();
    let farthest = start + shape.bounds.radius;
    let mut tau = if guess.abs() <= farthest { guess } else { 0.0 };
    let mut first = true;
    for _ in 0..MOST_STEPS {
        let line = at(tau);
        if !(line.value.is_finite() && line.slope.is_finite()) {
            return None;
        }
        let newton = tau - line.value / line.slope;
        let lengths = start + newton.abs().min(tau.abs());
        let rounding = 2.0 * f64::EPSILON * (lengths + shape.bounds.offset_within(lengths).min(lengths));
        // From outside a Newton step misses by at most ½·curvature·step²/slope, since planes only go off on the way; from
        // inside others may come on, and only a step below the rounding of a point on the ray is the last.
        let step = newton - tau;
        let outside_and_close = line.value >= 0.0 && 0.5 * line.curvature * step * step <= rounding * line.slope;
        if line.slope > 0.0 && (step.abs() <= rounding || outside_and_close) {
            return Some(newton);
        }
        if line.value < least {
            (nearest, least) = (tau, line.value);
        }
        // Where a ray enters, the way out lies ahead.
        let enters = line.slope < 0.0 && outside == f64::INFINITY;
        if line.value < 0.0 || enters {
            inside = tau;
        } else {
            outside = tau;
            newton_from_outside = newton;
        }
        // The guess was none: on from where a plane alone brings S to 1, if rounding on the long way to it left it ahead.
        let beyond = if first { beyond_a_plane(shape, from, direction, farthest) } else { inside };
        let mut next = if beyond > inside {
            beyond
        } else if line.slope > 0.0 {
            let root = tau + root_of_piece(line.value, line.slope, line.curvature);
            // Where rounding hides the planes, the sphere alone may put it far beyond.
            if root > farthest { farthest } else { root }
        } else if outside == f64::INFINITY {
            farthest
        } else {
            newton_from_outside
        };
        first = false;
        if !(inside < next && next < outside) && outside < f64::INFINITY {
            next = newton_from_outside;
        }
        if !(inside < next && next < outside && next.is_finite()) {
            if least <= 0.0 {
                return next.is_finite().then_some(next);
            }
            // From outside Newton's steps end at the way out, if there is one: else the ray touches the body to the rounding of S
            // near 1, or misses it.
            let touching = 4.0 * rounding * (shape.plane_weight.sqrt() + shape.sphere_weight.sqrt());
            return (least <= touching).then_some(nearest);
        }
        tau = next;
    }
    Some(tau)
}

/// The same where rounding has put the start beside the body, and the ray misses it: from a point of the body nearby.
///
/// A sharp body far from the origin may be thinner than the rounding of a point, which moves it by at most `shift`. Each step
/// goes to the nearest point of a half-space that holds the body, {the tangent of s ≤ 1}: by that it comes no further from any
/// point of the body. One of them, the start as it was meant, is within the rounding of it; so the point that is found is
/// within twice that, or there is none.
#[cold]
pub(crate) fn distance_beside(shape: &Shape, from: &Vector3<f64>, direction: &Vector3<f64>, shift: f64) -> Option<f64> {
    let mut point = *from;
    for _ in 0..MOST_STEPS {
        let here = potential::tangent(shape, &point);
        let s = here.value.sqrt();
        if s <= 1.0 {
            break;
        }
        point -= 2.0 * s * (s - 1.0) / here.gradient.norm_squared() * here.gradient;
        if !((point - from).norm() <= 2.0 * shift) {
            return None;
        }
    }
    distance(shape, &point, direction)
}

/// A distance at which one plane alone has brought S to 1, near the least; at most `farthest`.
///
/// Newton's method from outside on the largest n·x − d, which is convex along the ray.
#[cold]
fn beyond_a_plane(shape: &Shape, from: &Vector3<f64>, direction: &Vector3<f64>, farthest: f64) -> f64 {
    if shape.is_sphere() {
        return farthest;
    }
    let depth = 1.0 / shape.plane_weight.sqrt();
    let mut tau = farthest;
    for _ in 0..MOST_STEPS {
        let (excess, place) = shape.farthest_excess(&(from + tau * direction));
        let rate = shape.normal(place).dot(direction);
        let next = tau - (excess - depth) / rate;
        if !(excess > depth && rate > 0.0 && next < tau) {
            break;
        }
        tau = next;
    }
    tau
}

/// Root right of the stationary point of v + s·δ + ½c·δ² (s > 0), without cancellation; the Newton step
/// when the quadratic has no root (its piece ends before the surface).
#[inline]
pub(crate) fn root_of_piece(v: f64, s: f64, c: f64) -> f64 {
    let discriminant = s * s - 2.0 * c * v;
    if discriminant >= 0.0 { -2.0 * v / (s + discriminant.sqrt()) } else { -v / s }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particle::particle::Particle;

    fn cube() -> Particle {
        Particle::cube(0.45, 0.05, 0.3, 0.8)
    }

    #[test]
    fn a_ray_that_enters_from_a_point_on_the_surface_comes_out_on_the_other_side() {
        let (cube, up) = (cube(), Vector3::y());
        for sideways in [0.0, 0.1, -0.17, 0.3] {
            let foot = Vector3::new(sideways, 0.0, 0.02);
            let half = distance(&cube, &foot, &up).unwrap();
            // From inside and from outside by rounding alike.
            for off in -20..=20 {
                let from = foot + half * (1.0 + f64::from(off) * f64::EPSILON) * up;
                let (out, through) = (distance(&cube, &from, &up).unwrap(), distance(&cube, &from, &-up).unwrap());
                assert!(out.abs() < 1e-14 && (through - 2.0 * half).abs() < 1e-14, "{off}: {out:e}, {through:e}");
            }
        }
    }

    #[test]
    fn a_ray_that_misses_is_told_from_one_that_touches() {
        let (cube, across) = (cube(), Vector3::new(1.0, 0.0, 1.0).normalize());
        let height = distance(&cube, &Vector3::zeros(), &Vector3::y()).unwrap();
        for off in [1e-12, 1e-9, 1e-3] {
            let beside = Vector3::new(0.0, height * (1.0 + off), 0.0);
            assert_eq!(distance(&cube, &beside, &across), None, "{off:e} above");
        }
        let on = Vector3::new(0.0, height * (1.0 + f64::EPSILON), 0.0);
        assert!(distance(&cube, &on, &across).is_some());
    }
}
