//! Particles of the plane over the C boundary.

mod contact;
mod particle;
mod patch;
mod shape;

pub use contact::*;
pub use particle::*;
pub use patch::*;
pub use shape::*;
