//! The contact patch against closed forms, its own energy, and quadrature of the definition.

mod accuracy;
mod carried;
mod closed_forms;
mod definition;
mod estimates;
mod folds;
mod gradients;
mod stiffness;
mod walks;
mod walls;

use kit::patch::bodies::Pair;
use potential_particles::{Patch, PatchScratch, PatchSettings, patch_of_contact};

fn patch(pair: &Pair, tolerance: f64, with_energy: bool) -> Patch {
    let settings = PatchSettings { tolerance, with_energy, ..PatchSettings::default() };
    let Pair { a, pose_a, b, pose_b, contact, .. } = pair;
    patch_of_contact(a, pose_a, b, pose_b, contact, &settings, &mut PatchScratch::new(), |_| ()).unwrap()
}
