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
//! ```
//! use potential_particles::{Plane, rock::{JointSet, SliceSettings, slice}};
//!
//! // A cube of 10 m, cut by bedding that dips 30° to the east and by steep joints.
//! let sides = [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
//! let domain = sides.map(|[a, b, c]| Plane::from([a, b, c, 5.0]));
//! let bedding = JointSet { exponential: true, ..JointSet::new(30.0, 90.0, 1.5) };
//! let steep = JointSet { fisher: 50.0, seed: 1, ..JointSet::new(80.0, 280.0, 2.0) };
//! let joints = [bedding.joints([0.0; 3], 9.0)?, steep.joints([0.0; 3], 9.0)?].concat();
//! let mass = slice(&domain, &joints, &SliceSettings::default())?;
//! let volume: f64 = mass.blocks.iter().map(|block| block.volume).sum();
//! assert!((volume / 1000.0 - 1.0).abs() < 1e-12);
//! let particle = mass.blocks[0].particle(1e-3)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

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
