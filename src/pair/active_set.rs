//! A point as a body sees it, and which planes count there.

use crate::pair::placed_particle::Body;
use crate::particle::particle::Particle;
use nalgebra::Vector3;

/// Most planes that one model may drop at a point.
const MOST_DROPPED: usize = 8;

/// A point as a body sees it, and which planes its quadratic there counts beyond those that are clearly on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Local {
    /// The point in the particle's own frame.
    pub y: Vector3<f64>,
    /// Bound on the rounding of this point: a sum of terms as long as the point and the centre, each known to a few
    /// units in the last place.
    pub shift: f64,
    /// Bound on the rounding of n·y − d of every plane that can be on here, from that of the point and of the offset.
    pub blur: f64,
    /// Planes count from this distance before they switch on: at least the blur, since a stiff plane carries
    /// its share with a depth below rounding; more where a step was stopped by a plane, so that the next
    /// model knows it.
    pub early: f64,
    /// Planes within that distance that were found to pull instead of push: they do not count.
    dropped: [u16; MOST_DROPPED],
    count: u8,
}

/// A point of the particle's own frame, and which planes count there.
pub(crate) trait Place {
    fn point(&self) -> &Vector3<f64>;

    /// No plane counts whose excess at the point is below −`early`.
    fn early(&self) -> f64;

    /// Whether plane `i`, with this excess at the point, counts.
    fn counts(&self, particle: &Particle, i: usize, excess: f64) -> bool;
}

impl Place for Local {
    #[inline]
    fn point(&self) -> &Vector3<f64> {
        &self.y
    }

    #[inline]
    fn early(&self) -> f64 {
        self.early
    }

    #[inline]
    fn counts(&self, _: &Particle, i: usize, excess: f64) -> bool {
        excess > -self.early && (self.count == 0 || excess > self.blur || !self.dropped().contains(&(i as u16)))
    }
}

impl Local {
    /// With no plane dropped.
    pub fn new(y: Vector3<f64>, shift: f64, blur: f64, early: f64) -> Self {
        Self { y, shift, blur, early, dropped: [0; MOST_DROPPED], count: 0 }
    }

    /// The same with another rounding.
    pub fn blurred(&self, shift: f64, blur: f64) -> Self {
        Self { shift, blur, ..*self }
    }

    /// Lower bound of [`Body::rounding`] where the gradient of S is this long.
    pub fn least_rounding(&self, steep: f64) -> f64 {
        self.blur * steep
    }

    /// Carries over which planes were dropped, from a point whose step was stopped at once, to the same point again:
    /// all but those that stopped it. Without it the planes that rightly went would come back each time.
    pub fn carry_dropped(&mut self, from: &Self, body: &Body, step: &Vector3<f64>) {
        let reached = from.y + body.turn(step);
        for &i in &from.dropped[..usize::from(from.count)] {
            let place = usize::from(i);
            if body.particle.normal(place).dot(&reached) - body.particle.offset(place) <= from.blur {
                self.drop(place);
            }
        }
    }

    fn dropped(&self) -> &[u16] {
        &self.dropped[..usize::from(self.count)]
    }

    /// From now on plane i does not count until it is clearly on; without effect when too many are dropped already.
    pub fn drop(&mut self, i: usize) {
        if let Some(place) = self.dropped.get_mut(usize::from(self.count)) {
            // Places fit: a particle has no more planes (`MAX_PLANES`).
            *place = i as u16;
            self.count += 1;
        }
    }

    /// Whether no further plane can be dropped.
    pub fn is_full(&self) -> bool {
        usize::from(self.count) == MOST_DROPPED
    }
}
