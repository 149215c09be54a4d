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
//! From joint sets to particles:
//!
//! ```
//! use potential_particles::{Plane, rock::{FaceOf, JointSet, SliceSettings, slice}};
//!
//! // Axes: x east, y north, z up. Bedding dips 35° to the east, every 1.5 m in the mean; steep joints with scatter.
//! let towards = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
//! let opposite = towards.map(|[a, b, c]: [f64; 3]| [-a, -b, -c]);
//! let domain = [towards, opposite].concat().iter().map(|n| Plane::from([n[0], n[1], n[2], 5.0])).collect::<Vec<_>>();
//! let bedding = JointSet { exponential: true, seed: 3, ..JointSet::new(35.0, 90.0, 1.5) };
//! let steep = JointSet { fisher: 150.0, seed: 4, ..JointSet::new(80.0, 265.0, 2.0) };
//! let joints = [bedding.joints([0.0; 3], 9.0)?, steep.joints([0.0; 3], 9.0)?].concat();
//! let mass = slice(&domain, &joints, &SliceSettings::default())?;
//! for block in &mass.blocks {
//!     let particle = block.particle(1e-3)?; // k = 0, edges rounded by 1 mm, about block.centroid
//!     let on_joints = block.faces.iter().filter(|face| matches!(face.of, FaceOf::Joint(_))).count();
//!     println!("{:.2} m3, {on_joints} faces on joints, {} planes", block.volume, particle.plane_count());
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! docs/rock.md has the same in Python, with a simulation.

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
