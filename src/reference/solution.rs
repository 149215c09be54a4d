//! What a cone program gives, or why it gives nothing.

pub use crate::pair::role::Role;
use nalgebra::Vector3;
use thiserror::Error;

/// Solution of one cone program, in the frame of B.
#[derive(Clone, Copy, Debug)]
pub struct ConeProgramSolution {
    /// The minimiser, local frame of B, length: P3 of midway, P1 or P2 of closest.
    pub x: Vector3<f64>,
    /// The objective, no unit: max(s_A, s_B) at x for midway, s of the free particle for closest.
    pub s: f64,
    /// Weight u of B, in [0, 1], from the duals: (1−u)·∇S_A + u·∇S_B = 0 at the exact optimum.
    pub weight: f64,
    /// Interior-point iterations, summed over all passes.
    pub iterations: u32,
}

/// Why a cone program gave no answer.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum ConeProgramError {
    /// clarabel rejected the program.
    #[error("clarabel rejected the cone program: {0}; check the particles for numbers near the limits of f64")]
    Refused(String),
    /// A pass was solved with none of the settings.
    #[error(
        "clarabel stopped with status {0} at every scaling of the cone program: check for an r, R or distance that is \
         many orders of magnitude away from the size of the particles"
    )]
    Status(String),
    /// The passes did not converge.
    #[error(
        "the cone program did not converge in {0} passes: check for an r, R or distance that is many orders of magnitude \
         away from the size of the particles"
    )]
    Unsettled(u32),
}
