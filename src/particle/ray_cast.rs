//! The distance along a ray from a point inside to the surface: exact, since S is piecewise quadratic on a line.
//!
//! Newton's method with the quadratic at the current point as the model: its root is the answer once the active planes
//! are those of the root. Before that an iterate may pass the root on either side; a step that leaves the bracket is
//! replaced by the Newton step from its outer end, which does not overshoot as S is convex.
//!
//! Stop criteria compare steps with an estimate of the rounding of a point on the ray; they are no error bounds.

use super::numbers::FACES_APART;
use crate::linalg::root::{Bracket, MOST_STEPS};
use crate::particle::potential::{self, OnLine};
use crate::particle::solid::Solid;
use nalgebra::Vector3;

/// Distance τ ≥ 0 with S(from + τ·direction) = 1, for a local point and a local unit direction.
///
/// `from` should be inside (S ≤ 1). From a point that rounding has put outside, the answer is a small negative number
/// if the ray points away from the particle, and the distance to where it leaves it again if the ray enters. `None`
/// when the ray misses the particle or something is not finite.
pub fn distance(shape: &Solid, from: &Vector3<f64>, direction: &Vector3<f64>) -> Option<f64> {
    distance_near(shape, from, direction, 0.0)
}

/// The same from an initial guess; a good one saves half of the work.
#[inline]
pub(crate) fn distance_near(shape: &Solid, from: &Vector3<f64>, direction: &Vector3<f64>, guess: f64) -> Option<f64> {
    let start = from.norm();
    // No surface point is further off than this.
    let ray = Ray { shape, from, direction, start, farthest: start + shape.bounds.radius };
    let mut bracket = Bracket { low: f64::NEG_INFINITY, high: f64::INFINITY };
    let mut newton_from_outside = f64::NAN;
    let (mut nearest, mut least) = (0.0, f64::INFINITY);
    let mut tau = if guess.abs() <= ray.farthest { guess } else { 0.0 };
    let mut first = true;
    for _ in 0..MOST_STEPS {
        let line = ray.at(tau);
        if !(line.value.is_finite() && line.slope.is_finite()) {
            return None;
        }
        let newton = tau - line.value / line.slope;
        let rounding = ray.rounding(newton.abs().min(tau.abs()));
        // From outside a Newton step misses the root by at most ½·curvature·step²/slope, since planes only become
        // inactive on the way. From inside others may become active, and only a step below rounding is the last.
        let step = newton - tau;
        let outside_and_close = line.value >= 0.0 && 0.5 * line.curvature * step * step <= rounding * line.slope;
        // A slope that has lost its digits may lead anywhere.
        let in_reach = newton >= bracket.low - rounding && newton.abs() <= (1.0 + FACES_APART) * ray.farthest;
        if line.slope > 0.0 && in_reach && (step.abs() <= rounding || outside_and_close) {
            return Some(newton);
        }
        if line.value < least {
            (nearest, least) = (tau, line.value);
        }
        // Where the ray enters the particle, the root lies ahead.
        let enters = line.slope < 0.0 && bracket.high == f64::INFINITY;
        let is_outside = !(line.value < 0.0 || enters);
        bracket.narrow(tau, is_outside);
        if is_outside {
            newton_from_outside = newton;
        }
        // After the guess, go on from where one plane alone gives S = 1, if that lies ahead.
        let beyond = if first { ray.beyond_a_plane() } else { bracket.low };
        first = false;
        let mut next = if beyond > bracket.low {
            beyond
        } else if line.slope > 0.0 {
            let root = tau + root_of_piece(line.value, line.slope, line.curvature);
            // Where rounding hides the planes, the sphere alone may put it far beyond.
            if root > ray.farthest { ray.farthest } else { root }
        } else if bracket.high == f64::INFINITY {
            ray.farthest
        } else {
            newton_from_outside
        };
        if !bracket.contains(next) && bracket.high < f64::INFINITY {
            next = newton_from_outside;
        }
        if !(bracket.contains(next) && next.is_finite()) {
            if least <= 0.0 {
                // The step leaves the bracket by rounding, or the slope has lost its digits.
                let kept = next.max(bracket.low).min(bracket.high);
                return kept.is_finite().then_some(kept);
            }
            // Newton steps from outside end at the root if there is one. If not, the ray touches the particle, to the
            // rounding of S near 1, or misses it.
            let touching = 4.0 * rounding * (shape.plane_weight.sqrt() + shape.sphere_weight.sqrt());
            return (least <= touching).then_some(nearest);
        }
        tau = next;
    }
    Some(tau)
}

/// The same for a start that rounding has put beside the particle so that the ray misses it: from a nearby point
/// inside.
///
/// A sharp particle far from the origin may be thinner than the rounding of a point, which is at most `shift`. Each
/// step projects the point onto a half-space that holds the particle, that of the tangent to s ≤ 1, and so comes no
/// further from any point inside. The exact start is inside and within `shift` of the rounded one; so the point that is
/// found lies within 2·`shift`, or there is none.
#[cold]
pub(crate) fn distance_beside(shape: &Solid, from: &Vector3<f64>, direction: &Vector3<f64>, shift: f64) -> Option<f64> {
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

/// A ray with what its search needs at every step.
struct Ray<'a> {
    shape: &'a Solid,
    from: &'a Vector3<f64>,
    direction: &'a Vector3<f64>,
    /// Distance of its start from the origin.
    start: f64,
    /// Distance along it beyond which there is no surface point.
    farthest: f64,
}

impl Ray<'_> {
    fn point(&self, tau: f64) -> Vector3<f64> {
        self.from + tau * self.direction
    }

    /// S − 1 with slope and curvature.
    #[inline(always)]
    fn at(&self, tau: f64) -> OnLine {
        let mut line = potential::on_line(self.shape, &self.shape.weights(), &self.point(tau), self.direction);
        line.value -= 1.0;
        line
    }

    /// Estimated rounding of the distance of a plane from a point at |τ|, in units of |n|.
    #[inline(always)]
    fn rounding(&self, tau: f64) -> f64 {
        let lengths = self.start + tau;
        2.0 * f64::EPSILON * (lengths + self.shape.bounds.offset_within(lengths).min(lengths))
    }

    /// A distance at which one plane alone gives S = 1, near the least such; at most `farthest`.
    ///
    /// Newton's method from outside on the largest n·x − d, which is convex along the ray: from plane to plane, to
    /// where each gives S = 1, taken from the start of the ray, since a crossing may be many orders nearer than the
    /// point before.
    #[cold]
    fn beyond_a_plane(&self) -> f64 {
        if self.shape.is_sphere() {
            return self.farthest;
        }
        let depth = 1.0 / self.shape.plane_weight.sqrt();
        let mut tau = self.farthest;
        for _ in 0..MOST_STEPS {
            let (excess, place) = self.shape.farthest_excess(&self.point(tau));
            let rate = self.shape.normal(place).dot(self.direction);
            let next = (depth + self.shape.offset(place) - self.shape.normal(place).dot(self.from)) / rate;
            if !(excess > depth && rate > 0.0 && next < tau) {
                break;
            }
            tau = next;
        }
        tau
    }
}

/// Root of v + s·δ + ½c·δ² on the rising branch (s > 0), without cancellation; the Newton step where the quadratic has
/// no root because its piece ends before the surface.
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
