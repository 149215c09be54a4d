//! Whether a scene of rigid bodies stands, and by how much: the equilibrium of elastic joints with Coulomb's friction
//! (feature `equilibrium`).
//!
//! At each point of a contact the law of joints gives the force of a small displacement, n along the normal and t
//! across it, |t| ≤ (μ n + c a)/F and n ≥ −σ a with a the share of the area. [`stands()`]: do bodies come to rest under
//! their dead loads, applied slowly, at λ = 0 and F = 1? [`load_factor`]: the largest λ on the live loads.
//! [`strength_factor`]: the largest F. Both follow the states of rest to their limit, where displacements grow along
//! the mechanism.
//!
//! Slip does not open joints ([`Flow::NonDilatant`]). With every factor comes a bound from above, that of joints which
//! open by tan φ times their slip ([`Flow::Associated`]), a convex problem whose limit no state exceeds.
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
//! assert!((found.factor - 1.0 / 3.0).abs() < 1e-6 && found.factor <= found.bound + 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Each file uses only those above it:
//!
//! | file | holds |
//! |---|---|
//! | `error` | why a scene has no answer |
//! | `numbers` | the numbers that the solution is tuned by |
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
mod numbers;
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
