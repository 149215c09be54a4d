//! Rock masses: a convex domain cut into blocks by its joints, one after the other (Boon, Houlsby & Utili 2015, Computers and Geotechnics 65).
//!
//! A joint cuts the blocks that it meets in two. Each file uses only those above it:
//!
//! | file | holds |
//! |---|---|
//! | `error` | why a rock mass cannot be cut |
//! | `joint` | a plane, a disc or a polygon in the rock, by dip and dip direction |
//! | `joint_set` | joints of one orientation and spacing, with their scatter |
//! | `block` | what is cut out, with the joint or the side of the domain that each face comes from |
//! | `in_order` | work on several threads |
//! | `cutting` | what joints make of one part of the domain |
//! | `slicing` | the cuts |
//! | `partners` | which faces lie on each other |
//!
//! docs/rock.md has an example.

mod block;
mod cutting;
mod error;
mod in_order;
mod joint;
mod joint_set;
mod partners;
mod slicing;

pub use block::{Block, BlockFace, FaceOf};
pub use error::RockError;
pub use joint::Joint;
pub use joint_set::JointSet;
pub use partners::Partners;
pub use slicing::{RockMass, SliceSettings, slice, slice_with_regions};
