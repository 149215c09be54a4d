//! Pairs whose contact patches are known, boundaries below them, and the patch by brute force.

pub mod bodies;
pub mod boundaries;
pub mod brute;
pub mod families;
