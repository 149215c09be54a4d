//! Whether a scene of rigid bodies stands, and by how much: limit analysis by second-order cone programs (feature
//! `cone-program`).
//!
//! Forces f at the corners of the contacts, n along the normal and t across it, keep each free body in equilibrium:
//!
//! ```text
//! E f + w + λ w' = 0,   |t| ≤ (μ n + c a)/F,   n ≥ −σ a        a: the area of a contact over the number of its corners
//! ```
//!
//! Every stress distribution without cohesion over a convex polygon has the resultant of such forces, and the
//! reverse. [`stands()`]: do any exist for λ = 0, F = 1? [`load_factor`]: the largest λ for F = 1.
//! [`strength_factor`]: the largest F for λ = 0. The multipliers of the programs are the velocities of the bodies:
//! how it moves at its limit.
//!
//! The largest λ or F is that of joints that open by tan φ times their slip ([`Flow::Associated`]). Friction does not
//! dilate; of the many states that it may be in, motion without dilatancy selects those in which friction bears
//! nothing but the slip ([`Flow::NonDilatant`]). Then strength is bounded by the normal forces of the last program,
//! until these no longer change (M. Gilbert, C. Casapulla and H. M. Ahmed, Computers and Structures 84, 2006,
//! 873-887). The associated factor is an upper bound of it. States without dilatancy need not be unique, by the nature
//! of the problem; the sequence finds one of them.
//!
//! ```
//! use potential_particles::equilibrium::{Body, Contact, Flow, Load, Scene, load_factor};
//! use potential_particles::nalgebra::Vector3;
//!
//! // A block of width 1 and height 3 on a floor, pushed by a share of its weight: it turns over at 1/3.
//! let weight = Vector3::new(0.0, 0.0, -1.0);
//! let mut block = Body::free(Vector3::new(0.0, 0.0, 1.5), weight);
//! block.live = Load::force(Vector3::x());
//! let corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]].map(|[x, y]| Vector3::new(x, y, 0.0));
//! let floor = Contact::new([0, 1], corners.to_vec(), Vector3::z(), 0.5);
//! let scene = Scene { bodies: vec![Body::held(Vector3::zeros()), block], contacts: vec![floor] };
//! let found = load_factor(&scene, Flow::NonDilatant)?;
//! assert!((found.factor - 1.0 / 3.0).abs() < 1e-6 && found.mechanism[1].angular.y > 0.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Each file uses only those above it:
//!
//! | file | holds |
//! |---|---|
//! | `error` | why a scene has no answer |
//! | `scene` | bodies, contacts, loads |
//! | `rock_mass` | the scene of a rock mass |
//! | `points` | where the forces of a contact act |
//! | `law` | the law of joints at a point |
//! | `assembly` | a scene in units of its own |
//! | `answer` | forces that are judged anew |
//! | `program` | one cone program |
//! | `bound` | the associated answers, by programs |
//! | `stiffness` | the matrix of elastic joints, and its factors |
//! | `rest` | states of rest |
//! | `path` | states of rest up to the limit |
//! | `problems` | the three questions |

mod answer;
mod assembly;
mod bound;
mod error;
mod law;
mod path;
mod points;
mod problems;
mod program;
mod rest;
mod rock_mass;
mod scene;
mod stiffness;

pub use answer::{ContactForce, Equilibrium};
pub use error::EquilibriumError;
pub use problems::{Flow, load_factor, stands, strength_factor};
pub use rock_mass::JointStrength;
pub use scene::{Body, Contact, Load, Scene, Velocity};
