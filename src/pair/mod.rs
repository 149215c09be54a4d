//! Two particles in one frame.

pub mod body;
pub mod boundary_part;
pub mod extended_body;
pub mod local_point;
pub mod pair;
pub mod pair_state;
pub mod role;
pub mod separation;
