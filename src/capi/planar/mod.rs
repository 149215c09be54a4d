//! Particles of the plane over the C boundary.

mod batch;
mod contact;
mod particle;
mod patch;
mod shape;
mod types;

pub use batch::*;
pub use contact::*;
pub use particle::*;
pub use patch::*;
pub use shape::*;
pub use types::*;
