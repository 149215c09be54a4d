//! Two particles in one frame: the relative pose in doubles.

use crate::particle::particle::Particle;
use crate::pose::Pose;
use nalgebra::{Matrix3, Vector3};

/// A pair seen from B: every solver works in the local frame of B.
///
/// The difference of the two positions is taken before anything is rotated, so that a pair far
/// from the world origin loses no more than the rounding of its own positions.
#[derive(Clone, Copy, Debug)]
pub struct Pair<'a> {
    /// Particle A.
    pub a: &'a Particle,
    /// Particle B.
    pub b: &'a Particle,
    /// The poses as given, from which the extended tier takes its own digits.
    pub poses: [&'a Pose; 2],
    /// Local frame of A to local frame of B.
    pub rotation: Matrix3<f64>,
    /// Centre of A in the local frame of B.
    pub centre: Vector3<f64>,
}

impl<'a> Pair<'a> {
    /// The pair (A, B) at the given poses.
    pub fn new(a: &'a Particle, pose_a: &'a Pose, b: &'a Particle, pose_b: &'a Pose) -> Self {
        Self {
            a,
            b,
            poses: [pose_a, pose_b],
            rotation: pose_b.rotation().tr_mul(pose_a.rotation()),
            centre: pose_b.rotation().tr_mul(&(pose_a.position() - pose_b.position())),
        }
    }

    /// A point in the frame of B, seen in the local frame of A.
    pub fn in_a(&self, x: &Vector3<f64>) -> Vector3<f64> {
        self.rotation.tr_mul(&(x - self.centre))
    }
}
