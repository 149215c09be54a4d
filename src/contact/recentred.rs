//! A contact that is carried on and whose point has left the validity radius of its quadratics: they are set up anew
//! about the point where the planes that are active are still the same (docs/theory.md, "Carrying a contact on").
//!
//! A point on a face may go far along its edge, whose plane is never far from switching.

use crate::linalg::number::smaller;
use crate::pair::body::Body;
use crate::pair::pair::Pair;
use crate::pair::pair_state::{KnownPiece, LastContact};
use crate::particle::potential;
use nalgebra::Vector3;
use std::cell::Cell;

/// Bound on the rounding of places within the validity radius, over that of the solved contact (derived: 3.1).
pub(super) const MORE_ROUNDING: f64 = 4.0;

/// How often the pieces are set up again about a moving point, before it is solved from the planes: only a solve gives
/// the response of the optimum to changes of its data (chosen).
const MOST_RECENTRINGS: f64 = 30.0;

/// How many times as large the rounding of S may be there as where it was solved (chosen).
const MOST_GROWTH: f64 = 8.0;

/// Most that may be left of the way to a point that is followed, relative to the smaller bounding radius, whatever the
/// tolerance: near the rounding of a solved one, so that runs which solve it anew, as on several ranks, stay as near as
/// the regularisation lets them (chosen).
pub(super) const MOST_OPEN: f64 = 1e-13;

impl KnownPiece {
    /// The piece about a point x beyond the validity radius, frame of B, from the planes there, with the bound on the
    /// rounding of S; `None` where a plane has switched on the way, or may have. `self` is in the frame of its body.
    #[inline(always)]
    fn about(&self, body: &Body, x: &Vector3<f64>) -> Option<(Self, f64)> {
        let (particle, point) = (body.particle, body.locate(x));
        let way = point.y - self.from;
        let same = Cell::new(true);
        let is_active = |place, excess| {
            let was_active = excess > particle.normal(place).dot(&way);
            same.set(same.get() && (excess > 0.0) == was_active);
            excess > 0.0
        };
        let longest = particle.bounds.longest_normal;
        // No plane that was active is further off than this.
        let early = longest * way.norm() + point.blur;
        let q = potential::turned(particle, &particle.weights(), |n| n, &point.y, early, is_active);
        let validity_radius = smaller((q.clear - MORE_ROUNDING * point.blur) / longest, point.y.norm());
        let piece = Self { from: point.y, value: q.value, gradient: q.gradient, hessian: q.hessian, validity_radius };
        (same.get() && validity_radius > 0.0).then(|| (piece, body.rounding(&point, &q)))
    }
}

impl LastContact {
    /// Sets up the pieces again about the point x, frame of B, which has left one of them, at this S, from the planes
    /// that may have switched. `None` where one has, or after too many times.
    #[inline(never)]
    pub(super) fn recentre(&mut self, pair: &Pair, x: &Vector3<f64>, square: f64) -> Option<()> {
        let (a, b) = Body::both(pair, 0.0);
        let [(of_a, rounding_a), (of_b, rounding_b)] = [self.pieces[0].about(&a, x)?, self.pieces[1].about(&b, x)?];
        let more = (rounding_a / self.roundings[0]).max(rounding_b / self.roundings[1]);
        let growth = (self.square / square).max(1.0).sqrt() * more.max(1.0);
        // Written so that what is not a number fails.
        let whole = self.roundings.iter().chain([&self.square]).all(|value| *value > 0.0 && value.is_finite());
        if !(whole && self.recentrings < MOST_RECENTRINGS && growth <= MOST_GROWTH) {
            return None;
        }
        (self.growth, self.pieces) = (growth, [of_a, of_b]);
        self.recentrings += 1.0;
        Some(())
    }
}
