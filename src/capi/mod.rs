//! The C interface. All `unsafe` of the crate is here; each function states what its pointers
//! must be. The conventions are written once, in the head of `include/potential_particles.h`
//! (see `cbindgen.toml`).
#![allow(non_camel_case_types, unsafe_code)]

mod contact;
mod fence;
mod particle;
mod planar;
mod status;
mod types;

pub use contact::*;
pub use particle::*;
pub use planar::*;
pub use status::*;
pub use types::*;
