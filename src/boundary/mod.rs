//! The contact of a particle with a flat boundary of no thickness: a plane, or a triangle of a mesh.
//!
//! The boundary T is touched where the scale of the particle is least on it, the paper's closest point (eqs 3, 9) with
//! T in place of the second particle:
//!
//! ```text
//! x* = argmin S(x) over x in T,    s = √S(x*),    contact if s < 1
//! ```
//!
//! A part of T, its plane, an edge or a corner, takes the place of the second particle of a pair: a body with S = 0, on
//! which a point has two, one or no coordinates ([`crate::pair::boundary_part`]). All else is the solver of pairs, with
//! its bounds and its extended tier ("Boundaries" in docs/theory.md). Each file uses only those above it:
//!
//! | file | holds |
//! |---|---|
//! | `boundary` | planes and triangles as given, checked |
//! | `triangle` | a triangle in the frame of its plane |
//! | `separation` | separation tests |
//! | `closest` | the least S on a whole boundary: on its plane, an edge or a corner |
//! | `contact` | point, normal and overlap; [`contact_with_plane`], [`contact_with_triangle`] |
//! | `seam` | how S goes on from a triangle into its neighbour: [`onwards_from_seam`] |

mod boundary;
mod closest;
mod contact;
mod seam;
mod separation;
mod triangle;

pub use boundary::{BoundaryError, Feature, Triangle, Wall};
pub use contact::{FlatContact, contact_with_plane, contact_with_triangle};
pub use seam::{Onwards, onwards_from_seam};
