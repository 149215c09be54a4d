//! Contact detection between potential particles (Houlsby 2009; Boon, Houlsby & Utili).
//!
//! A potential particle is a convex body {x : S(x) ≤ 1} with
//!
//! ```text
//! S(x) = (1-k)/r² · Σ ⟨n_i·x − d_i⟩²  +  k/R² · |x|²        ⟨t⟩ = max(t, 0)
//! ```
//!
//! S is convex, once continuously differentiable and piecewise quadratic. The contact of two particles is the solution
//! of a convex program in S_A and S_B ([`Formulation`]), found here by an active-set Newton method with a certified
//! error bound. Data flows one way, and the folders are read in that order:
//!
//! | folder | holds |
//! |---|---|
//! | `linalg` | numbers and lanes of them, symmetric 3×3 matrices and their LDLᵀ factors |
//! | `particle` | the shape: definition, potential, bounding volumes, ray casting, mass properties |
//! | `pair` | poses, two particles in one frame, the active set at a point, warm starts, separation tests |
//! | `model` | both potentials as quadratics at a point, their exact optimum along the dual path, the KKT check |
//! | `bounds` | what rounding does to an optimum: the gap of s and the distance of the point |
//! | `solver` | initial guess, line search, Newton's method, and the order in which solvers are tried |
//! | `reference` | the paper's second-order cone programs, as an independent back end |
//! | `contact` | point, normal and overlap from a solution; [`detect`](detect()), the whole on one screen |
//! | `section` | the contact area |
//! | [`planar`] | the same for particles of the plane |
//! | `capi` | the C interface, the only place with `unsafe` |

mod bounds;
pub mod capi;
mod contact;
mod linalg;
mod model;
mod pair;
mod particle;
pub mod planar;
mod reference;
mod section;
mod settings;
mod solver;

pub use contact::closest_point::{Half, closest_point};
pub use contact::contact::{Contact, Flags, Kind};
pub use contact::detect::{DetectError, detect};
pub use pair::pose::{Pose, PoseError};
pub use pair::warm_start::Memory;
pub use particle::mass_properties::MassProperties;
pub use particle::particle::{MAX_PLANES, Particle, ParticleError, Plane};
pub use reference::Role;
pub use section::Section;
pub use settings::{BackEnd, Formulation, Settings, SettingsError};

/// Stages of the solver for benchmarks; no part of the public interface, and changed without notice.
#[doc(hidden)]
pub mod internals {
    pub use crate::pair::relative_pose::Pair;
    pub use crate::pair::separation_tests as reject;
    pub use crate::particle::potential;
}
