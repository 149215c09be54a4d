//! placeholder until the real one lands
use crate::pair::Pair;
use nalgebra::Vector3;
use thiserror::Error;
#[derive(Clone, Copy, Debug)]
pub struct ConicSolution { pub x: Vector3<f64>, pub s: f64, pub weight: f64, pub iterations: u32 }
#[derive(Clone, Copy, Debug)]
pub enum Role { A, B }
#[derive(Clone, Debug, Error)]
pub enum ConicError { #[error("not yet")] None }
pub fn midway(_: &Pair) -> Result<ConicSolution, ConicError> { Err(ConicError::None) }
pub fn closest(_: &Pair, _: Role) -> Result<ConicSolution, ConicError> { Err(ConicError::None) }
