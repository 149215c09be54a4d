//! The contact patch.

#[path = "patch/bodies.rs"]
mod bodies;
#[path = "patch/closed_forms.rs"]
mod closed_forms;
#[path = "patch/walls.rs"]
mod walls;

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
                    coarse.flags,
                    fine.flags,
                    finest.flags
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
                        if finest.flags.contains(potential_particles::PatchFlags::FOLDED) {
                            continue;
                        }
                        let error = (found.force - finest.force).norm() / finest.force.norm();
                        count += 1;
                        rays += found.rays;
                        points += found.points;
                        if found.error > tolerance {
                            missed += 1;
                        }
                        if error > found.error {
                            over += 1;
                        }
                        if error > tolerance {
                            above += 1;
                        }
                        if !(error < 10.0 * tolerance) {
                            println!(
                                "   {family} {other} k {k} r {r} d {depth} t {:.2} rays {} {} estimate {:.1e} error {error:.1e} {} {}",
                                pair.contact.s, found.rays, finest.rays, found.error, found.flags, finest.flags
                            );
                        }
                        worst = worst.max(error);
                    }
                }
            }
        }
        println!(
            "{tolerance} count {count} rays {} points {} over estimate {over} over tolerance {above} missed {missed} worst {worst:.1e}",
            rays / count,
            points / count
        );
    }
}

/// Central differences of the energy with Richardson's extrapolation.
fn difference(energy: impl Fn(f64) -> f64, h: f64) -> f64 {
    let of = |h: f64| (energy(h) - energy(-h)) / (2.0 * h);
    (4.0 * of(0.5 * h) - of(h)) / 3.0
}

#[test]
fn gradients() {
    use nalgebra::Vector3;
    let mut chance = Chance::new(21);
    let mut worst = 0.0_f64;
    for family in FAMILIES {
        for k in [0.0, 1e-6, 0.02, 0.3] {
            for r in [1e-3, 0.05, 0.3, 0.9] {
                for depth in [0.01, 0.1, 0.3] {
                    let other = chance.pick(&FAMILIES);
                    let pair = Pair::random([family, other], [k, k], r, depth, &mut chance);
                    let found = patch(&pair, 1e-9, true);
                    if found.flags.contains(potential_particles::PatchFlags::FOLDED) {
                        continue;
                    }
                    let direction = (found.force.normalize() + 0.3 * chance.direction()).normalize();
                    let turn = chance.direction();
                    let h = 3e-2 * pair.contact.overlap;
                    let size = pair.contact.branch_b.norm().max(0.1);
                    let along =
                        -difference(|h| patch(&pair.moved(&(h * direction), &Vector3::zeros()), 1e-9, true).energy, h);
                    let about = -difference(
                        |h| patch(&pair.moved(&Vector3::zeros(), &(h * turn)), 1e-9, true).energy,
                        h / size,
                    );
                    let f = found.force.norm();
                    let torque = found.torque + pair.contact.branch_b.cross(&found.force);
                    let errors = [
                        (along - found.force.dot(&direction)).abs() / f,
                        (about - torque.dot(&turn)).abs() / (f * size),
                    ];
                    let error = errors[0].max(errors[1]);
                    if error > 1e-5 {
                        println!(
                            "  {family} {other} k {k} r {r} d {depth} t {:.2} rays {} estimate {:.1e} {:.1e} {:.1e} {}",
                            pair.contact.s, found.rays, found.error, errors[0], errors[1], found.flags
                        );
                    }
                    worst = worst.max(error);
                }
            }
        }
    }
    println!("worst {worst:.1e}");
}

#[test]
fn symmetry() {
    use nalgebra::Vector3;
    let mut chance = Chance::new(21);
    let mut worst = 0.0_f64;
    let mut all = Vec::new();
    for family in FAMILIES {
        for k in [0.0, 1e-6, 0.02, 0.3] {
            for r in [1e-3, 0.05, 0.3, 0.9] {
                for depth in [0.01, 0.1, 0.3] {
                    let other = chance.pick(&FAMILIES);
                    let pair = Pair::random([family, other], [k, k], r, depth, &mut chance);
                    let found = patch(&pair, 1e-9, false);
                    if found.flags.contains(potential_particles::PatchFlags::FOLDED) {
                        continue;
                    }
                    let n = found.force.normalize();
                    let (a, b) = ((n + chance.direction()).normalize(), chance.direction());
                    let h = 3e-3 * pair.contact.overlap;
                    let force = |x: Vector3<f64>| patch(&pair.moved(&x, &Vector3::zeros()), 1e-9, false).force;
                    let by_a = (force(h * a) - force(-h * a)) / (2.0 * h);
                    let by_b = (force(h * b) - force(-h * b)) / (2.0 * h);
                    let error = (by_a.dot(&b) - by_b.dot(&a)).abs() / (by_a.norm() + by_b.norm());
                    let energies = [1e-5, 1e-7, 1e-9].map(|t| patch(&pair, t, true).energy);
                    all.push((energies[1] / energies[2] - 1.0).abs());
                    if error > 1e-5 {
                        println!(
                            "  {family} {other} k {k} r {r} d {depth} t {:.2} rays {} estimate {:.1e} {error:.1e} energy {:.1e} {:.1e}",
                            pair.contact.s,
                            found.rays,
                            found.error,
                            energies[0] / energies[2] - 1.0,
                            energies[1] / energies[2] - 1.0
                        );
                    }
                    worst = worst.max(error);
                }
            }
        }
    }
    all.sort_by(f64::total_cmp);
    println!(
        "worst {worst:.1e} energy median {:.1e} 0.9 {:.1e} worst {:.1e}",
        all[all.len() / 2],
        all[all.len() * 9 / 10],
        all[all.len() - 1]
    );
}
