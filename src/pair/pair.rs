//! Two bodies in one frame: the relative pose in doubles.

use crate::pair::boundary_part::{BoundaryPart, PartFrame};
use crate::particle::particle::Particle;
use crate::pose::Pose;
use nalgebra::{Matrix3, Vector3};

/// A pair seen from B: every solver works in the local frame of B. In place of B may stand a part of a boundary, on which a point has
/// fewer coordinates.
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
    /// Length that the rounding of the centre is proportional to.
    pub(crate) lengths: f64,
}

/// Poses and boundaries as the caller gave them.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Given<'a> {
    Poses([&'a Pose; 2]),
    Boundary(&'a Pose, &'a BoundaryPart),
}

impl<'a> Pair<'a> {
    /// The pair (A, B) at the given poses.
    pub fn new(a: &'a Particle, pose_a: &'a Pose, b: &'a Particle, pose_b: &'a Pose) -> Self {
        let centre = pose_b.rotation().tr_mul(&(pose_a.position() - pose_b.position()));
        Self {
            a,
            b,
            given: Given::Poses([pose_a, pose_b]),
            rotation: pose_b.rotation().tr_mul(pose_a.rotation()),
            centre,
            lengths: centre.norm(),
        }
    }

    /// A particle and a part of a boundary, with its frame beside this particle.
    pub(crate) fn on_boundary(a: &'a Particle, pose: &'a Pose, part: &'a BoundaryPart, frame: &PartFrame) -> Self {
        Self {
            a,
            b: Particle::boundary(part.dimensions()),
            given: Given::Boundary(pose, part),
            rotation: frame.rotation.tr_mul(pose.rotation()),
            centre: frame.centre,
            lengths: frame.lengths,
        }
    }

    /// The number of coordinates in which a point may move.
    #[inline(always)]
    pub(crate) fn dimensions(&self) -> usize {
        self.a.dimensions.min(self.b.dimensions)
    }

    /// A point in the frame of B, seen in the local frame of A.
    pub fn in_a(&self, x: &Vector3<f64>) -> Vector3<f64> {
        self.rotation.tr_mul(&(x - self.centre))
    }
}
