//! In place of `reference` in a build without the Cargo feature `cone-program`: the same functions, none of which has
//! an answer.
//!
//! [`crate::Settings::validate`] refuses the cone-program back end by name before any of this is reached; what remains
//! is the last resort of the fast solver.

use crate::pair::pair::Pair;
pub use crate::pair::role::Role;
use nalgebra::Vector3;
use thiserror::Error;

/// As in a build with the feature; never made here.
pub struct ConeProgramSolution {
    pub x: Vector3<f64>,
    pub s: f64,
    pub weight: f64,
    pub iterations: u32,
}

/// Why there is no answer.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("not part of this build, which lacks the Cargo feature cone-program")]
pub struct ConeProgramError;

pub fn midway(_: &Pair) -> Result<ConeProgramSolution, ConeProgramError> {
    Err(ConeProgramError)
}

pub fn closest(_: &Pair, _: Role) -> Result<ConeProgramSolution, ConeProgramError> {
    Err(ConeProgramError)
}
