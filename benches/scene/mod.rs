//! Particles and pairs to measure on, the same in every run.
#![allow(dead_code)]

pub mod evaluation;
pub mod facets;
pub mod polyhedra;
pub mod pyramids;
pub mod random;
pub mod touching;
