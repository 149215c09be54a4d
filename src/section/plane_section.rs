//! The plane of the section as one particle sees it.

use crate::particle::solid::Solid;
use nalgebra::{Matrix3, Vector3};

/// A shape, the contact point and the axes of the section plane, all in the local frame of the particle.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlaneSection<'a> {
    pub shape: &'a Solid,
    /// As given: contact point minus centre in world axes, and the rotation from local to world axes.
    pub branch: Vector3<f64>,
    pub rotation: Matrix3<f64>,
    /// The contact point.
    pub point: Vector3<f64>,
    /// Two unit vectors that span the plane.
    pub axes: [Vector3<f64>; 2],
}

/// Why the closed form gives no area.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Failure {
    /// The contact point is outside a particle.
    Outside,
    /// More planes come close than the buffer holds.
    BufferFull,
    /// The end of an arc is not where S = 1 to rounding.
    Inaccurate,
}
