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
fn statistics() {
    let mut chance = Chance::new(11);
    for tolerance in [1e-4, 1e-6] {
        let (mut worst, mut over, mut count, mut rays, mut points, mut missed, mut above) = (0.0_f64, 0, 0, 0, 0, 0, 0);
        for family in FAMILIES {
            for k in [0.0, 1e-6, 0.02, 0.3] {
                for r in [1e-6, 1e-3, 0.05, 0.3, 0.9] {
                    for depth in [0.001, 0.01, 0.1, 0.4] {
                        let other = chance.pick(&FAMILIES);
                        let pair = Pair::random([family, other], [k, k], r, depth, &mut chance);
                        let found = patch(&pair, tolerance, false);
                        let finest = patch(&pair, 0.01 * tolerance, false);
                        if finest.flags.contains(potential_particles::PatchFlags::FOLDED) { continue; }
                        let error = (found.force - finest.force).norm() / finest.force.norm();
                        count += 1; rays += found.rays; points += found.points;
                        if found.error > tolerance { missed += 1; }
                        if error > found.error { over += 1; }
                        if error > tolerance { above += 1; }
                        if !(error < 10.0 * tolerance) {
                            println!("   {family} {other} k {k} r {r} d {depth} t {:.2} rays {} {} estimate {:.1e} error {error:.1e} {} {}", pair.contact.s, found.rays, finest.rays, found.error, found.flags, finest.flags);
                        }
                        worst = worst.max(error);
                    }
                }
            }
        }
        println!("{tolerance} count {count} rays {} points {} over estimate {over} over tolerance {above} missed {missed} worst {worst:.1e}", rays / count, points / count);
    }
}
