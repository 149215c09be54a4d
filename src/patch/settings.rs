//! What is asked of a patch, and what is refused.

use super::numbers::COARSEST;
use crate::particle::in_plane::InPlaneError;
use thiserror::Error;

/// How a patch is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchSettings {
    /// Relative error of the force, and of the torque over |force| times the reach of the patch, in [1e-12, 0.1].
    pub tolerance: f64,
    /// Whether the elastic energy is computed. The patch is then integrated by rays, which takes many times as long.
    pub with_energy: bool,
    /// Whether the stiffness is computed ([`crate::Patch::stiffness`]).
    pub with_stiffness: bool,
}

impl PatchSettings {
    /// The tolerance, no finer than a relative rounding.
    pub(super) fn above(&self, rounding: f64) -> f64 {
        self.tolerance.max(rounding.min(COARSEST))
    }
}

impl Default for PatchSettings {
    fn default() -> Self {
        Self { tolerance: 1e-4, with_energy: false, with_stiffness: false }
    }
}

/// Why there is no patch.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum PatchError {
    /// [`PatchSettings::tolerance`] is out of range.
    #[error("tolerance={0:?} of a patch must lie in [1e-12, 0.1]")]
    Tolerance(f64),
    /// The contact is separated: it has no patch.
    #[error("the contact is separated: only overlapping contacts have a patch")]
    Separated,
    /// The contact has no finite point or normal.
    #[error("the contact has no finite point and normal: take the answer of a call for the same bodies and poses")]
    NotFinite,
    /// One particle lies in the plane and the other does not, or something leaves the plane.
    #[error(transparent)]
    InPlane(#[from] InPlaneError),
}
