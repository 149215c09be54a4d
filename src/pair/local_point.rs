//! A point as one body sees it, and which of its planes count as active there.

use nalgebra::Vector3;

/// Most planes that may be left out of the active set at one point, or listed (chosen; with more, the point moves).
const MOST_DROPPED: usize = 8;

/// A few planes by their places.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PlaneList {
    places: [u16; MOST_DROPPED],
    count: u8,
}

impl PlaneList {
    #[inline]
    pub fn contains(&self, place: usize) -> bool {
        self.places[..usize::from(self.count)].contains(&(place as u16))
    }

    /// Without effect when it is full.
    pub fn add(&mut self, place: usize) {
        if let Some(slot) = self.places.get_mut(usize::from(self.count)) {
            // Places fit: a particle has no more planes than `MAX_PLANES`.
            *slot = place as u16;
            self.count += 1;
        }
    }

    pub fn remove(&mut self, place: usize) {
        let kept = *self;
        *self = Self::default();
        kept.places[..usize::from(kept.count)]
            .iter()
            .filter(|p| usize::from(**p) != place)
            .for_each(|p| self.add((*p).into()));
    }

    fn is_full(&self) -> bool {
        usize::from(self.count) == MOST_DROPPED
    }
}

/// A point in a particle's own frame, with the bounds on its rounding, and the active set there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LocalPoint {
    /// The point in the particle's own frame.
    pub y: Vector3<f64>,
    /// Bound on the rounding of this point, length.
    pub shift: f64,
    /// Bound on the rounding of n·y − d of every plane that can be active here, from that of the point and of the
    /// offset.
    ///
    /// A plane is active if n·y − d > −blur: a stiff plane carries its share of the force with a depth below rounding.
    pub blur: f64,
    /// Planes with |n·y − d| ≤ blur and a negative multiplier after a step: they are not active.
    dropped: PlaneList,
}

impl LocalPoint {
    /// With no plane dropped.
    pub fn new(y: Vector3<f64>, shift: f64, blur: f64) -> Self {
        Self { y, shift, blur, dropped: PlaneList::default() }
    }

    /// Whether the plane at this place, with this n·y − d, is active.
    #[inline]
    pub fn is_active(&self, place: usize, excess: f64) -> bool {
        excess > -self.blur && (self.dropped.count == 0 || excess > self.blur || !self.dropped.contains(place))
    }

    /// Excludes the plane at this place from the active set while its n·y − d is within the blur; without effect when
    /// too many are excluded.
    pub fn drop(&mut self, place: usize) {
        self.dropped.add(place);
    }

    /// Whether no further plane can be dropped.
    pub fn is_full(&self) -> bool {
        self.dropped.is_full()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[test]
    fn a_plane_is_dropped_only_where_its_depth_is_rounding() {
        let blur = 1e-15;
        let mut point = LocalPoint::new(Vector3::zeros(), 1e-16, blur);
        assert!(point.is_active(3, 0.0) && point.is_active(3, -0.5 * blur) && !point.is_active(3, -2.0 * blur));
        point.drop(3);
        assert!(!point.is_active(3, 0.0) && point.is_active(3, 2.0 * blur) && point.is_active(4, 0.0));
        (4..20).for_each(|place| point.drop(place));
        assert!(point.is_full() && point.is_active(19, 0.0));
    }
}
