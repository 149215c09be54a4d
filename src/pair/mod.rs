//! Two particles in one frame.

pub mod body;
pub mod boundary_part;
pub mod extended_body;
pub mod local_point;
pub mod memory;
pub mod pair;
pub mod role;
pub mod separation;
