//! The contact of a particle with a flat boundary of no thickness: a plane, or a triangle of a mesh.
//!
//! The boundary T is touched where the scale of the particle is least on it, the paper's closest point (eqs 3, 9) with T in
//! place of the second particle:
//!
//! ```text
//! x* = argmin S(x) over x in T,    s = √S(x*),    contact if s < 1
//! ```
//!
//! S is convex and piecewise quadratic, so is its restriction to a plane or a line, and Newton's method with an exact line
//! search finds its minimum there ("Flat boundaries" in docs/theory.md). Everything is solved in the frame of the particle.
//! Each file uses only those above it:
//!
//! | file | holds |
//! |---|---|
//! | `boundary` | planes and triangles as given, checked |
//! | `placed` | the same in the frame of a particle |
//! | `separation` | cheap proofs that the particle does not reach the boundary |
//! | `minimum` | the least S on a plane, a line or at a point, with what rounding does to it |
//! | `search` | Newton's method for it |
//! | `closest` | the least S on a whole boundary, and the bound on its error |
//! | `contact` | point, normal and overlap; [`contact_with_plane`], [`contact_with_triangle`] |

mod boundary;
mod closest;
mod contact;
mod minimum;
mod placed;
mod search;
mod separation;

pub use boundary::{BoundaryError, Feature, Triangle, Wall};
pub use contact::{FlatContact, contact_with_plane, contact_with_triangle};
