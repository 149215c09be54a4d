//! The contact patch against closed forms, its own energy, and quadrature of the definition.

#[path = "patch/aligned.rs"]
mod aligned;
#[path = "patch/bodies.rs"]
mod bodies;
#[path = "patch/boundaries.rs"]
mod boundaries;
#[path = "patch/brute.rs"]
mod brute;
#[path = "patch/carried.rs"]
mod carried;
#[path = "patch/cells.rs"]
mod cells;
#[path = "patch/closed_forms.rs"]
mod closed_forms;
#[path = "patch/definition.rs"]
mod definition;
#[path = "patch/estimates.rs"]
mod estimates;
#[path = "patch/folds.rs"]
mod folds;
#[path = "patch/gradients.rs"]
mod gradients;
#[path = "patch/pieces.rs"]
mod pieces;
#[path = "patch/planar.rs"]
mod planar;
#[path = "patch/stiffness.rs"]
mod stiffness;
#[path = "patch/walks.rs"]
mod walks;
#[path = "patch/walls.rs"]
mod walls;

use bodies::Pair;
use potential_particles::{Patch, PatchScratch, PatchSettings, patch_of_contact};

fn patch(pair: &Pair, tolerance: f64, with_energy: bool) -> Patch {
    let settings = PatchSettings { tolerance, with_energy, ..PatchSettings::default() };
    let Pair { a, pose_a, b, pose_b, contact, .. } = pair;
    patch_of_contact(a, pose_a, b, pose_b, contact, &settings, &mut PatchScratch::new(), |_| ()).unwrap()
}
