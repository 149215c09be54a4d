//! Packings: bodies placed in a container without overlap, as a start for a simulation.
//!
//! A body is placed where [`crate::detect`] finds it separated from every body near by; a solve that fails counts as an
//! overlap. [`Arrangement`] says where places are sought: anywhere in the container, or as low as they get. Each file
//! uses only those above it:
//!
//! | file | holds |
//! |---|---|
//! | `numbers` | what packing is tuned by |
//! | `error` | why nothing can be packed |
//! | `container` | a box or an upright cylinder, and whether it holds a particle |
//! | `sizes` | distributions of size, by number, by mass or as a grading curve |
//! | `grid` | which boxes are near a box |
//! | `pile` | the bodies that have their place, and whether one more fits at a pose |
//! | `scattered` | a place anywhere: random sequential addition |
//! | `settled` | a place as low as it gets: a fall, and a random walk downwards |
//! | `supply` | the bodies that are to be placed, one after the other |
//! | `pack` | all of it, on several threads |

mod container;
mod error;
mod grid;
mod numbers;
mod pack;
mod pile;
mod scattered;
mod settled;
mod sizes;
mod supply;

pub use container::Container;
pub use error::PackError;
pub use pack::{Arrangement, Packing, Placement, pack};
pub use sizes::Sizes;
