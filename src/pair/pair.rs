//! Two bodies in one frame: the relative pose in doubles.

use crate::linalg::double_double::DoubleDouble;
use crate::pair::boundary_part::PlacedPart;
use crate::particle::particle::Particle;
use crate::pose::Pose;
use nalgebra::{Matrix3, Vector3};

/// A pair seen from B: every solver works in the local frame of B. In place of B may stand a part of a boundary, on
/// which a point has fewer coordinates.
///
/// The difference of the two positions is taken before anything is rotated, so that a pair far
/// from the world origin loses no more than the rounding of its own positions.
#[derive(Clone, Copy, Debug)]
pub struct Pair<'a> {
    /// Particle A.
    pub a: &'a Particle,
    /// Particle B.
    pub b: &'a Particle,
    /// What A and B are placed by, from which the extended tier takes its own digits.
    pub(crate) given: Given<'a>,
    /// Local frame of A to local frame of B.
    pub rotation: Matrix3<f64>,
    /// Centre of A in the local frame of B.
    pub centre: Vector3<f64>,
}

/// Poses and boundaries as the caller gave them.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Given<'a> {
    Poses([&'a Pose; 2]),
    Boundary(&'a PlacedPart<'a>),
}

impl<'a> Pair<'a> {
    /// The pair (A, B) at the given poses.
    #[inline(always)]
    pub fn new(a: &'a Particle, pose_a: &'a Pose, b: &'a Particle, pose_b: &'a Pose) -> Self {
        let centre = pose_b.rotation().tr_mul(&(pose_a.position() - pose_b.position()));
        Self {
            a,
            b,
            given: Given::Poses([pose_a, pose_b]),
            rotation: pose_b.rotation().tr_mul(pose_a.rotation()),
            centre,
        }
    }

    /// A particle and a part of a boundary, placed beside it.
    pub(crate) fn on_boundary(a: &'a Particle, placed: &'a PlacedPart<'a>) -> Self {
        let frame = &placed.frame;
        Self {
            a,
            b: Particle::boundary(placed.part.dimensions()),
            given: Given::Boundary(placed),
            rotation: frame.rotation.tr_mul(placed.pose.rotation()),
            centre: frame.centre,
        }
    }

    /// Length that the rounding of the centre is proportional to.
    pub(crate) fn lengths(&self) -> f64 {
        match self.given {
            Given::Poses(..) => self.centre.norm(),
            Given::Boundary(placed) => placed.frame.lengths,
        }
    }

    /// From the centre of A to a point, world axes, given the branch from the centre of B. The difference of the
    /// positions is not rounded: both branches differ by it to the rounding of this one.
    #[inline(always)]
    pub(crate) fn branch_a(&self, branch_b: &Vector3<f64>) -> Vector3<f64> {
        match self.given {
            Given::Poses([pose_a, pose_b]) => {
                let (to, from) = (pose_b.position(), pose_a.position());
                Vector3::new(
                    far(branch_b.x, to.x, from.x),
                    far(branch_b.y, to.y, from.y),
                    far(branch_b.z, to.z, from.z),
                )
            }
            // The centre of A is what a boundary is placed from.
            Given::Boundary(..) => *branch_b,
        }
    }

    /// A point in the frame of B, seen in the local frame of A.
    pub fn in_a(&self, x: &Vector3<f64>) -> Vector3<f64> {
        self.rotation.tr_mul(&(x - self.centre))
    }
}

/// branch + (to − from), where the difference is not rounded.
#[inline(always)]
fn far(branch: f64, to: f64, from: f64) -> f64 {
    let between = DoubleDouble::sum(to, -from);
    (branch + between.high) + between.low
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Formulation, Kind, Settings, detect};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn both_branches_differ_by_the_positions(
            towards in [-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64],
            far in [-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64],
            log_far in -3.0..6.0_f64,
            log_size in -4.0..4.0_f64,
            closest: bool,
        ) {
            let a = Particle::cube(0.4, 0.1, 0.02, 1.2);
            let b = a.scaled(10_f64.powf(log_size)).unwrap();
            let from = 10_f64.powf(log_far) * Vector3::from(far);
            prop_assume!(Vector3::from(towards).norm() > 0.1);
            let to = from + 0.5 * (a.bounding_radius() + b.bounding_radius()) * Vector3::from(towards).normalize();
            let pose_a = Pose::new(from.into(), [1.0, 0.3, far[0], far[1]]).unwrap();
            let pose_b = Pose::new(to.into(), [0.5, far[2], 0.2, 0.1]).unwrap();
            let formulation = if closest { Formulation::Closest } else { Formulation::Midway };
            let settings = Settings { formulation, ..Settings::default() };
            let contact = detect(&a, &pose_a, &b, &pose_b, &settings, None).unwrap();
            if contact.kind == Kind::Overlapping {
                for i in 0..3 {
                    let between = DoubleDouble::sum(pose_b.position()[i], -pose_a.position()[i]);
                    let off = (between + DoubleDouble::sum(contact.branch_b[i], -contact.branch_a[i])).high;
                    assert!(off.abs() <= f64::EPSILON * contact.branch_a.norm(), "{off:e}: {contact:?}");
                }
            }
        }
    }
}
