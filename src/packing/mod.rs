//! Packings: bodies placed in a container without overlap, as a start for a simulation.
//!
//! A body is placed where [`crate::detect`] and its like find it separated from every body and [`Obstacle`] near by; a
//! solve that fails counts as an overlap. [`Arrangement`] says where places are sought: anywhere in the container, or
//! as low as they get. Each file uses only those above it:
//!
//! | file | holds |
//! |---|---|
//! | `numbers` | what packing is tuned by |
//! | `error` | why nothing can be packed |
//! | `container` | a box, an upright cylinder or prism, or points, and whether it holds a particle |
//! | `sizes` | distributions of size, by number, by mass or as a grading curve |
//! | `supply` | the bodies that are to be placed, one after the other |
//! | `obstacle` | what is there: bodies, triangles, planes |
//! | `grid` | which boxes are near a box |
//! | `pile` | the bodies that have their place, and whether one more fits at a pose |
//! | `scattered` | a place anywhere: random sequential addition |
//! | `settled` | a place as low as it gets: a fall, and a random walk downwards |
//! | `pack` | all of it, on several threads |

mod container;
mod error;
mod grid;
mod numbers;
mod obstacle;
mod pack;
mod pile;
mod scattered;
mod settled;
mod sizes;
mod supply;

pub use container::Container;
pub use error::PackError;
pub use obstacle::Obstacle;
pub use pack::{Arrangement, Packing, Placement, are_free, pack};
pub use sizes::Sizes;
pub use supply::Supply;
