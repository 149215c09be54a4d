//! What holds of every contact of two particles, in space and in the plane.

use potential_particles::{Contact, Flags, Kind, planar};

pub trait Whole {
    /// Asserts that the answer holds together.
    fn assert_whole(&self);
}

/// The fields of both have the same names.
macro_rules! whole {
    ($contact:ty) => {
        impl Whole for $contact {
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
    };
}

whole!(Contact);
whole!(planar::Contact);
