//! Particles and pairs to measure on, the same in every run.

pub mod evaluation;
pub mod facets;
pub mod polyhedra;
pub mod pyramids;
pub mod touching;
