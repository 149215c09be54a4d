//! The contact patch: the surface on which both potentials are equal, with their depth as pressure.
//!
//! docs/patch.md has the definition, the method and what was measured. Each file uses only those above it:
//!
//! | file | holds |
//! |---|---|
//! | `numbers` | what the integration is tuned by: limits, the budget of errors, fitted factors |
//! | `rules` | Gauss rules |
//! | `settings` | what is asked for |
//! | `patch` | the answer |
//! | `field` | the potentials in the frame of the patch |
//! | `half_plane` | in which a walk over the patch takes place |
//! | `cell` | a stretch of a ray on which they are quadratics |
//! | `energy` | the elastic energy as an integral over the patch |
//! | `ray` | the walk over a ray |
//! | `ray_rule` | the quadrature along it |
//! | `curve` | the walk over the curve where a plane goes on |
//! | `rim` | points and arcs of the rim |
//! | `network` | curves and rim, and where they meet |
//! | `faces` | the cells that they enclose |
//! | `form` | the potentials of a cell |
//! | `triangle_rule` | quadrature over a curved triangle |
//! | `triangulation` | cells cut into such triangles |
//! | `cells` | the patch in cells |
//! | `local_coordinates` | coordinates in which the patch is explicit |
//! | `polygon` | its flat part |
//! | `strip` | the part along an edge |
//! | `cap` | the part beyond its end |
//! | `disc` | a patch about a corner |
//! | `piece` | one of these with its rule |
//! | `zones` | where they lie |
//! | `pieces` | the patch in such parts |
//! | `centre` | where the rays start |
//! | `smoothness` | how far off a rule over a sector is |
//! | `fan` | sectors of rays, refined |
//! | `scratch` | the buffers |
//! | `stiffness` | how force and torque change with the pose |
//! | `integration` | from the potentials to the answer |
//! | `contact` | the patch of two particles, of a particle and a plane, of a particle and a triangle |
//! | `patch_state` | what a pair keeps of its patch, and how that is carried on |

mod cap;
mod cell;
mod cells;
mod centre;
mod contact;
mod curve;
mod disc;
mod energy;
mod faces;
mod fan;
mod field;
mod form;
mod half_plane;
mod integration;
mod local_coordinates;
mod network;
mod numbers;
#[allow(clippy::module_inception)]
mod patch;
mod patch_state;
mod piece;
mod pieces;
mod polygon;
mod ray;
mod ray_rule;
mod rim;
mod rules;
mod scratch;
mod settings;
mod smoothness;
mod stiffness;
mod strip;
mod triangle_rule;
mod triangulation;
mod zones;

pub use contact::{patch_of_contact, patch_on_plane, patch_on_triangle};
pub use patch::{Patch, PatchFlags, PatchPoint};
pub use patch_state::PatchState;
pub use scratch::PatchScratch;
pub use settings::{PatchError, PatchSettings};
