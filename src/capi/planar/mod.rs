//! Particles of the plane over the C boundary.

mod contact;
mod convert;
mod particle;
mod shape;
mod types;

pub use contact::*;
pub use particle::*;
pub use shape::*;
pub use types::*;
