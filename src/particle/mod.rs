//! The shape: what a potential particle is, and what follows from its shape alone.

pub mod bounding_volumes;
pub mod linear_program;
pub mod mass_properties;
pub mod particle;
pub mod plane_clusters;
pub mod potential;
pub mod ray_cast;
