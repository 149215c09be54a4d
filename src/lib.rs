//! Contact detection between potential particles (Houlsby 2009; Boon, Houlsby & Utili).
//!
//! A potential particle is a convex body {x : S(x) ≤ 1} with
//!
//! ```text
//! S(x) = (1-k)/r² · Σ ⟨n_i·x − d_i⟩²  +  k/R² · |x|²        ⟨t⟩ = max(t, 0)
//! ```
//!
//! S is convex, once continuously differentiable and piecewise quadratic. The contact of two particles is the solution
//! of a convex program in S_A and S_B ([`Formulation`]), found here by an active-set Newton method with a bound on its
//! error (proved in extended precision, estimated in doubles: docs/theory.md). Data flows one way, and the folders are
//! read in that order (`tests/folders.rs`):
//!
//! | folder | holds |
//! |---|---|
//! | `linalg` | numbers and lanes of them, symmetric 3×3 matrices and their LDLᵀ factors |
//! | `particle` | the shape: definition, potential, bounding volumes, ray casting, mass properties |
//! | `pair` | two particles in one frame, the active set at a point, the state of a pair, separation tests |
//! | `reference` | the paper's second-order cone programs, as an independent back end (feature `cone-program`) |
//! | `model` | both potentials as quadratics at a point, their exact optimum along the dual path, the KKT check |
//! | `bounds` | what rounding does to an optimum: the gap of s and the distance of the point |
//! | `solver` | initial guess, line search, Newton's method, and the order in which solvers are tried |
//! | `contact` | point, normal and overlap from a solution; [`detect`](detect()); many pairs at once |
//! | `section` | the contact area; mass properties, in the plane by the same arcs |
//! | `boundary` | the contact with a flat boundary: a plane, or a triangle of a mesh |
//! | `patch` | the contact patch: pressure, force, torque, area, energy |
//! | `derivative` | derivatives of a contact in poses and shapes |
//! | `surface` | a closed mesh of triangles on the surface |
//! | [`packing`] | bodies placed in a container without overlap, as a start for a simulation |
//! | [`rock`] | a rock mass cut into blocks by its joints |
//! | `equilibrium` | whether a scene of rigid bodies stands, and by how much (feature `equilibrium`) |
//! | [`shapes`] | builders: half-spaces, points, surfaces and solids with rounded edges, about their centroid |
//! | `serialisation` | what can be written down and read back with serde (feature `serde`) |
//! | `capi` | the C interface, the only place with `unsafe` (feature `capi`) |
//!
//! # Use
//!
//! A [`Particle`] is made once for each shape; a body is a particle at a [`Pose`]. [`detect()`] finds the [`Contact`]
//! of two bodies, [`detect_batch`] those of many pairs on several threads; [`Settings`] choose the formulation and the
//! accuracy, and a [`PairState`] for each pair lets the next call start from the last solution. [`Section::area`] gives
//! the contact area, [`closest_point`] one closest point alone, [`contact_with_plane`] and [`contact_with_triangle`]
//! the contact with a wall, [`Particle::mass_properties`] volume and inertia. [`Particle::in_plane`] makes a particle
//! in the plane, which all of them take like any other.
//!
//! ```
//! use potential_particles::{Kind, PairState, Particle, Plane, Pose, Section, Settings, detect};
//!
//! // A cube of edge 2 with edges and corners rounded by r = 0.1: six planes at 0.9, moved out by r.
//! let faces =
//!     [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
//! let cube = Particle::new(&faces.map(|[a, b, c]| Plane::from([a, b, c, 0.9])), 0.1, 0.0, 1.0)?;
//!
//! let lower = Pose::at([0.0, 0.0, 0.0])?;
//! let upper = Pose::new([0.3, 0.0, 1.95], [1.0, 0.0, 0.0, 0.2])?;
//! let mut state = PairState::default();
//! let contact = detect(&cube, &lower, &cube, &upper, &Settings::default(), Some(&mut state))?;
//! assert_eq!(contact.kind, Kind::Overlapping);
//! assert!((contact.overlap - 0.05).abs() < 1e-9 && (contact.normal.z - 1.0).abs() < 1e-9);
//!
//! let area = Section::from(&contact).area(&cube, &lower, &cube, &upper, 1e-6).expect("an overlapping contact");
//! assert!(area > 2.0 && area < 4.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![deny(missing_docs)]

mod answer;
mod boundary;
mod bounds;
#[cfg(feature = "capi")]
pub mod capi;
mod contact;
mod derivative;
#[cfg(feature = "equilibrium")]
pub mod equilibrium;
mod flags;
mod linalg;
mod model;
pub mod packing;
mod pair;
mod particle;
mod patch;
mod pose;
mod random;
#[cfg(feature = "cone-program")]
mod reference;
#[cfg(not(feature = "cone-program"))]
#[path = "reference_left_out.rs"]
mod reference;
pub mod rock;
mod section;
#[cfg(feature = "serde")]
mod serialisation;
mod settings;
pub mod shapes;
mod solver;
mod surface;

pub use boundary::{
    BoundaryError, Feature, FlatContact, Onwards, Triangle, Wall, contact_with_plane, contact_with_triangle,
    onwards_from_seam,
};
/// Its vectors and matrices are those of this interface: of this version, whatever others a program has.
pub use nalgebra;

pub use answer::Row;
pub use contact::batch::{detect_batch, detect_batch_into};
pub use contact::closest_point::{ClosestPoint, closest_point};
pub use contact::contact::{Contact, Kind};
pub use contact::detect::detect;
pub use contact::error::DetectError;
pub use derivative::{
    ContactDerivatives, ContactWeights, DerivativeError, DerivativeFlags, PatchDerivatives, PoseGradient, PoseRow,
    PoseRows, ShapeGradient, boundary_derivatives, boundary_gradient, contact_derivatives, contact_gradient,
    patch_derivatives,
};
pub use flags::Flags;
pub use pair::pair_state::PairState;
pub use pair::role::Role;
pub use particle::error::ToleranceError;
pub use particle::in_plane::InPlaneError;
pub use particle::mass_properties::{MASS_TOLERANCE, MassProperties};
pub use particle::particle::{MAX_PLANES, Particle, ParticleError, Plane};
pub use patch::{
    Patch, PatchError, PatchFlags, PatchPoint, PatchScratch, PatchSettings, PatchState, patch_of_contact,
    patch_on_plane, patch_on_triangle,
};
pub use pose::{Pose, PoseError};
pub use section::Section;
pub use settings::{BackEnd, Formulation, Settings, SettingsError};
pub use surface::surface_mesh::{MeshError, SurfaceMesh};

/// Stages of the solver for benchmarks, and what the wheel and the C header share; no part of the public interface, and
/// changed without notice.
#[doc(hidden)]
pub mod internals {
    pub use crate::answer::comment_with;
    pub use crate::pair::pair::Pair;
    pub use crate::pair::separation as reject;
    pub use crate::particle::potential;
    pub use crate::shapes::{sharp_hull, sharp_planes};
}

/// The Rust code of README.md is tested like any example.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

/// And so is that of the guide.
#[cfg(doctest)]
#[doc = include_str!("../docs/rust.md")]
struct Guide;
