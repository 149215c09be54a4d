//! Contact detection between potential particles (Houlsby 2009; Boon, Houlsby & Utili).
//!
//! Read the modules in the order in which data flows:
//!
//! | module | holds |
//! |---|---|
//! | [`particle`] | what a particle is, validated once |
//! | `leaves` | its planes in groups, so that far ones are never touched |
//! | [`potential`] | S, ∇S, ∇²S at a point |
//! | [`bounds`] | a polyhedron, ball and box around a particle |
//! | [`surface`] | where a ray meets the surface |
//! | [`mass`] | volume, centroid, inertia |
//! | [`pose`] | where a body is |
//! | [`settings`], [`memory`] | how to solve, and what a pair remembers |
//! | [`pair`], `body`, `local` | two particles in one frame, and a point as each sees it |
//! | [`reject`] | cheap proofs of separation |
//! | `number`, [`symmetric`], `target` | numbers and lanes of them, small matrices, and which point of two bodies is wanted |
//! | `curve` | where two quadratics are optimal for some weights, and its series: midway and both closest points lie on it |
//! | `model` | two quadratics solved exactly: the search along the curve |
//! | `response` | how that optimum answers to small changes of the data |
//! | `verdict` | what a step does to the planes of a quadratic |
//! | `frame`, `expansion` | both quadratics at a point, in safe axes, and the step to their optimum |
//! | `line`, `start` | descent along a line; where a search without memory begins |
//! | `sway` | what the rounding of both potentials does to the optimum |
//! | `outcome`, `spine` | where a search ended; the fast solver: Newton on that model, safe steps |
//! | `anchor`, `anchored` | the safe solver, finite, where the fast one goes in circles |
//! | `ceiling` | an upper bound that holds wherever rounding may have the planes |
//! | `remnant` | what a slope that is left can hide from the planes |
//! | `certificate` | how far an answer can be from the optimum |
//! | [`conic`] | the paper's second-order cone programs through clarabel: the reference |
//! | [`contact`] | point, normal, overlap from a solution |
//! | [`area`] | the contact area, exact, when asked for |
//! | `search`, [`mod@detect`] | the ladder of solvers, and the whole on one screen |
//! | [`half`] | one closest point alone |
//! | [`planar`] | the same for particles of the plane |
//! | [`ffi`] | the C interface |

mod anchor;
mod anchored;
pub mod area;
mod body;
pub mod bounds;
mod ceiling;
mod certificate;
pub mod conic;
pub mod contact;
mod curve;
pub mod detect;
mod expansion;
pub mod ffi;
mod frame;
pub mod half;
mod leaves;
mod line;
mod linear_program;
mod local;
pub mod mass;
pub mod memory;
mod model;
mod number;
mod outcome;
pub mod pair;
pub mod particle;
pub mod planar;
pub mod pose;
pub mod potential;
pub mod reject;
mod remnant;
mod response;
mod search;
pub mod settings;
mod spine;
mod start;
pub mod surface;
mod sway;
pub mod symmetric;
mod target;
mod verdict;

pub use contact::{Contact, Flags, Kind};
pub use detect::{DetectError, detect};
pub use half::{Half, closest_point};
pub use memory::Memory;
pub use particle::{Particle, ParticleError, Plane};
pub use pose::{Pose, PoseError};
pub use settings::{BackEnd, Formulation, Settings, SettingsError};
