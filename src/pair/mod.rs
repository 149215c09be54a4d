//! Two particles in one frame.

pub mod active_set;
pub mod extended_body;
pub mod placed_particle;
pub mod relative_pose;
pub mod role;
pub mod separation_tests;
pub mod warm_start;
