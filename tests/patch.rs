//! The contact patch.

#[path = "patch/bodies.rs"]
mod bodies;

use bodies::*;
use potential_particles::{Patch, PatchScratch, PatchSettings, patch_of_contact};

fn patch(pair: &Pair, tolerance: f64, with_energy: bool) -> Patch {
    let settings = PatchSettings { tolerance, with_energy };
    let Pair { a, pose_a, b, pose_b, contact, .. } = pair;
    patch_of_contact(a, pose_a, b, pose_b, contact, &settings, &mut PatchScratch::new(), |_| ()).unwrap()
}

#[test]
fn explore() {
    let mut chance = Chance::new(7);
    for family in FAMILIES {
        for k in [0.0, 1e-6, 0.02, 0.3] {
            for r in [1e-3, 0.05, 0.3] {
                let depth = chance.pick(&[0.01, 0.1, 0.4]);
                let other = chance.pick(&FAMILIES);
                let pair = Pair::random([family, other], [k, k], r, depth, &mut chance);
                let coarse = patch(&pair, 1e-4, false);
                let fine = patch(&pair, 1e-7, false);
                let finest = patch(&pair, 1e-9, true);
                let f = finest.force.norm();
                println!(
                    "{family:8} {other:8} k {k:7.0e} r {r:5.0e} d {depth:4} t {:8.1e} | {:4} {:5} {:8.1e} {:8.1e} | {:4} {:8.1e} {:8.1e} | {:4} {:8.1e} | {} {} {}",
                    pair.contact.s,
                    coarse.rays,
                    coarse.points,
                    coarse.error,
                    (coarse.force - finest.force).norm() / f,
                    fine.rays,
                    fine.error,
                    (fine.force - finest.force).norm() / f,
                    finest.rays,
                    finest.error,
                    coarse.flags, fine.flags, finest.flags
                );
            }
        }
    }
}

#[test]
fn ladder() {
    for (families, k, r, depth, seed) in [
        (["ball", "needle"], 1e-6, 1e-3, 0.01, 3),
        (["plate", "cube"], 0.02, 0.3, 0.4, 4),
        (["ball", "rock"], 0.0, 1e-3, 0.01, 5),
        (["rock", "plate"], 0.3, 0.05, 0.01, 6),
        (["needle", "plate"], 0.02, 0.05, 0.01, 7),
        (["cube", "pyramid"], 1e-6, 1e-3, 0.1, 8),
        (["needle", "rock"], 0.02, 0.05, 0.1, 9),
    ] {
        let mut chance = Chance::new(seed);
        let pair = Pair::random(families, [k, k], r, depth, &mut chance);
        println!("{families:?} {k} {r} {depth} t {}", pair.contact.s);
        let finest = patch(&pair, 1e-11, false);
        for e in 2..11 {
            let tolerance = 10f64.powi(-e);
            let found = patch(&pair, tolerance, false);
            let f = finest.force.norm();
            println!("   1e-{e} rays {:4} points {:6} estimate {:8.1e} error {:8.1e} torque {:8.1e} area {:8.1e} {}", found.rays, found.points, found.error, (found.force - finest.force).norm() / f,
              (found.torque - finest.torque).norm() / f, found.area / finest.area - 1.0, found.flags);
        }
    }
}
