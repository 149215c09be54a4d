//! What holds of every contact of two particles.

use potential_particles::{Contact, Flags, Kind};

pub trait Whole {
    /// Asserts that the answer holds together.
    fn assert_whole(&self);
}

impl Whole for Contact {
    fn assert_whole(&self) {
        assert!(self.s >= 0.0, "{self:?}");
        let overlapping = self.kind == Kind::Overlapping;
        if self.flags.contains(Flags::REJECTED) {
            assert!(!overlapping && self.s >= 1.0, "{self:?}");
            return;
        }
        assert!(self.gap >= 0.0, "{self:?}");
        assert!((self.normal.norm() - 1.0).abs() < 1e-12, "{self:?}");
        assert!(self.point.iter().chain(self.branch_a.iter()).all(|c| c.is_finite()), "{self:?}");
        assert_eq!(overlapping, !self.overlap.is_nan(), "{self:?}");
        assert_eq!(overlapping, self.point_on_a.iter().all(|c| c.is_finite()), "{self:?}");
    }
}
