//! Why a contact has no answer.

use crate::particle::in_plane::InPlaneError;
use crate::settings::SettingsError;
use crate::solver::call::SolveError;
use thiserror::Error;

/// Why there is no answer.
#[derive(Clone, Debug, Error)]
#[non_exhaustive]
pub enum DetectError {
    /// A setting is out of range.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// One particle lies in the plane and the other does not, or something leaves the plane.
    #[error(transparent)]
    InPlane(#[from] InPlaneError),
    /// No solver reached an answer. The contact is unknown; this does not mean separated.
    #[error("no solver reached an answer ({reason}); the contact is unknown")]
    Failed {
        /// What stopped the last solver.
        reason: String,
    },
    /// A pair of a batch names a body that is not there.
    #[error("body {index} does not exist: there are {bodies}, counted from 0")]
    NoSuchBody {
        /// As given.
        index: u32,
        /// How many there are.
        bodies: usize,
    },
    /// The arguments of a batch do not fit together.
    #[error("{given} {what} given where {expected} are needed")]
    Length {
        /// Of what.
        what: &'static str,
        /// How many were given.
        given: usize,
        /// How many are needed.
        expected: usize,
    },
}

impl DetectError {
    pub(crate) fn no_surface() -> Self {
        Self::Failed { reason: "the surface was not found along the normal".into() }
    }
}

impl From<SolveError> for DetectError {
    fn from(error: SolveError) -> Self {
        Self::Failed { reason: error.to_string() }
    }
}
