//! Rock masses: a convex domain cut into blocks by its joints, one after the other (Boon, Houlsby & Utili 2015,
//! Computers and Geotechnics 65).
//!
//! A joint cuts the blocks that it meets in two. Each file uses only those above it:
//!
//! | file | holds |
//! |---|---|
//! | `numbers` | what cutting is tuned by |
//! | `error` | why a rock mass cannot be cut |
//! | `polygon` | convex polygons of a plane |
//! | `joint` | a plane, a disc or a polygon in the rock, by dip and dip direction |
//! | `joint_set` | joints of one orientation and spacing, with their scatter |
//! | `block` | what is cut out, with the joint or the side of the domain that each face comes from |
//! | `settings` | limits of a rock mass |
//! | `domain` | the polyhedron of the domain, and all planes |
//! | `expected` | how many blocks joints will make |
//! | `cutting` | what one plane makes of one part of the domain |
//! | `regions` | what regions make of a part that joints have left |
//! | `parallel_cut` | what some joints make of many parts, on several threads |
//! | `slicing` | the whole |
//! | `partners` | which faces lie on each other |
//!
//! docs/rock.md has an example.

mod block;
mod cutting;
mod domain;
mod error;
mod expected;
mod joint;
mod joint_set;
mod numbers;
mod parallel_cut;
mod partners;
mod polygon;
mod regions;
mod settings;
mod slicing;
#[cfg(test)]
mod tests;

pub use block::{Block, BlockFace, FaceOf};
pub(crate) use domain::{enclosed, unit_planes};
pub use error::RockError;
pub use joint::Joint;
pub use joint_set::JointSet;
pub(crate) use numbers::EXTENTS;
pub use partners::{Interface, Partners};
pub use settings::SliceSettings;
pub use slicing::{RockMass, slice, slice_with_regions};
