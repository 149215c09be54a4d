//! What particles in the plane z = 0 must keep: the paper's 2-D case (eqs 1 and 5–31), solved by the code for space.
//!
//! A particle of lines a·x + b·y ≤ d is the particle of planes (a, b, 0, d), cut at z = 0. In space
//!
//! ```text
//! S(x, y, z) = S(x, y) + k/R² · z²
//! ```
//!
//! and poses of the plane, a shift and a turn about z, keep that form. Moving a point to z = 0 raises neither S_A nor
//! S_B, so that midway and closest (both are convex problems in S_A and S_B) have an optimum there, and at z = 0 they
//! are the problems of the plane, with the same s, weights and bounds. For k > 0 the optimum is there only. For k = 0
//! nothing depends on z: in the fast solver the regularisation of flat faces
//! ([`crate::Settings::flat_regularisation`]) holds z at 0, and the cone programs leave z out (eqs 19–31). z begins at
//! 0 and every term that could move it has an exact zero as a factor, so that it stays 0.
//!
//! Two things differ: lines that enclose an area bound a particle, and integrals (areas, masses, forces of patches) are
//! those of the cut, per unit of depth.

use crate::particle::particle::Particle;
use crate::pose::{Pose, Turn};
use nalgebra::Vector3;
use thiserror::Error;

/// Why bodies have no contact in the plane.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum InPlaneError {
    /// A particle in the plane with one in space.
    #[error(
        "one particle lies in the plane z = 0 and the other does not: make both by in_plane or polygon, or both of planes"
    )]
    Mixed,
    /// A position beside the plane.
    #[error("a particle in the plane has z={0:?}: it must be 0")]
    Height(f64),
    /// A turn out of the plane.
    #[error(
        "a particle in the plane has the orientation w={0:?}, x={1:?}, y={2:?}, z={3:?}: it turns about z alone, so that x and y \
         must be 0"
    )]
    Turn(f64, f64, f64, f64),
    /// A plane that does not stand at right angles to that of the particle.
    #[error("the boundary of a particle in the plane has a normal with z={0:?}: it must be 0")]
    Normal(f64),
    /// A triangle.
    #[error("a particle in the plane has no contact with a triangle: give it a plane with a normal (x, y, 0)")]
    Triangle,
}

impl Particle {
    /// Refuses a partner of the other kind, and poses that leave the plane.
    #[inline(always)]
    pub(crate) fn refuse_mixed(a: (&Self, &Pose), b: (&Self, &Pose)) -> Result<(), InPlaneError> {
        if a.0.is_in_plane() | b.0.is_in_plane() { both_in_plane(a, b) } else { Ok(()) }
    }

    /// Of a particle in the plane, refuses a pose that leaves it, and a plane that does not stand at right angles to
    /// it.
    pub(crate) fn refuse_slanted(&self, pose: &Pose, normal: &Vector3<f64>) -> Result<(), InPlaneError> {
        match normal.z {
            _ if !self.is_in_plane() => Ok(()),
            0.0 => stays(pose),
            z => Err(InPlaneError::Normal(z)),
        }
    }

    /// Refuses a triangle as a boundary of a particle in the plane.
    pub(crate) fn refuse_triangle(&self) -> Result<(), InPlaneError> {
        if self.is_in_plane() { Err(InPlaneError::Triangle) } else { Ok(()) }
    }
}

#[cold]
fn both_in_plane(a: (&Particle, &Pose), b: (&Particle, &Pose)) -> Result<(), InPlaneError> {
    if a.0.is_in_plane() != b.0.is_in_plane() {
        return Err(InPlaneError::Mixed);
    }
    stays(a.1)?;
    stays(b.1)
}

/// Refuses a pose that leaves the plane.
fn stays(pose: &Pose) -> Result<(), InPlaneError> {
    if pose.position().z != 0.0 {
        return Err(InPlaneError::Height(pose.position().z));
    }
    let [w, x, y, z] = pose.orientation();
    let rotation = pose.rotation();
    let turned = [rotation.m13, rotation.m23, rotation.m31, rotation.m32].iter().any(|entry| *entry != 0.0);
    match pose.turn() {
        Turn::Angle(_) => Ok(()),
        Turn::Quaternion(_) if x == 0.0 && y == 0.0 && !turned => Ok(()),
        Turn::Quaternion(_) => Err(InPlaneError::Turn(w, x, y, z)),
    }
}
