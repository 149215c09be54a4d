//! The C interface. All `unsafe` of the crate is here; each function states what its pointers
//! must be. The conventions are written once, in the head of `include/potential_particles.h`
//! (see `cbindgen.toml`).
//!
//! The body of a function is `call!`, `give!` or `explain!`: the arguments are taken as their types say (`argument`),
//! and the answer is written (`output`), with why there is none (`message`).
//!
//! The documentation of every exported item is also the comment in the C header: plain text, without the marks of
//! rustdoc, and "Pointers:" where Rust would have a section on safety.

// Comments are those of the C header, where brackets are C's.
#![allow(rustdoc::broken_intra_doc_links)]
#![allow(non_camel_case_types, unsafe_code)]
#![allow(clippy::missing_safety_doc)]

mod abi;
mod argument;
mod batch;
mod builder;
mod contact;
mod convert;
mod derivative;
mod fence;
mod flat;
mod message;
mod output;
mod particle;
mod patch;
mod patch_derivatives;
mod shape;
mod status;
mod surface;
mod types;

pub use abi::*;
pub use batch::*;
pub use builder::*;
pub use contact::*;
pub use derivative::*;
pub use flat::*;
pub use particle::*;
pub use patch::*;
pub use patch_derivatives::*;
pub use shape::*;
pub use status::*;
pub use surface::*;
pub use types::*;
