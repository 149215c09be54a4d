//! Force and torque are minus the gradient of the energy, which is another integral; and the stiffness is symmetric.

use crate::patch;
use kit::patch::bodies::{Chance, FAMILIES, Pair, difference};
use nalgebra::Vector3;
use potential_particles::PatchFlags;

/// Pairs of all families, roundings, sphericities and depths; folded ones are left out.
pub fn each(seed: u64, mut visit: impl FnMut(&Pair, &mut Chance, &str)) {
    let mut chance = Chance::new(seed);
    let mut count = 0;
    for family in FAMILIES {
        for k in [0.0, 1e-6, 0.02, 0.3] {
            for r in [1e-3, 0.05, 0.3, 0.9] {
                let depth = chance.pick(&[0.01, 0.1, 0.3]);
                let other = chance.pick(&FAMILIES);
                let pair = Pair::random([family, other], [k, k], r, depth, &mut chance);
                if !patch(&pair, 1e-4, false).flags.contains(PatchFlags::FOLDED) {
                    visit(&pair, &mut chance, &format!("{family} on {other}, k {k}, r {r}, depth {depth}"));
                    count += 1;
                }
            }
        }
    }
    assert!(count > 80, "{count} pairs");
}

#[test]
fn the_force_is_the_gradient_of_the_energy() {
    each(21, |pair, chance, name| {
        // A third of the pairs is enough for the time.
        if chance.uniform() > 0.33 {
            return;
        }
        let here = patch(pair, 1e-9, false);
        let force = here.force.norm();
        let direction = (here.force / force + 0.3 * chance.direction()).normalize();
        let turn = chance.direction();
        let arm = pair.contact.branch_b.norm().max(0.1);
        let h = 3e-2 * pair.contact.overlap;
        let energy = |shift: Vector3<f64>, turn: Vector3<f64>| patch(&pair.moved(&shift, &turn), 1e-9, true).energy;
        let by_shift = -difference(|h| energy(h * direction, Vector3::zeros()), h);
        let by_turn = -difference(|h| energy(Vector3::zeros(), h * turn), h / arm);
        let torque = here.torque + pair.contact.branch_b.cross(&here.force);
        let errors = [(by_shift - here.force.dot(&direction)).abs(), (by_turn - torque.dot(&turn)).abs() / arm];
        // Differences of an energy whose third derivative jumps.
        assert!(errors.iter().all(|error| *error < 1e-4 * force), "{name}: {errors:?} of {force}");
    });
}

#[test]
fn the_stiffness_is_symmetric() {
    each(22, |pair, chance, name| {
        let normal = patch(pair, 1e-9, false).force.normalize();
        let (a, b) = ((normal + chance.direction()).normalize(), chance.direction());
        let h = 3e-3 * pair.contact.overlap;
        let force = |shift: Vector3<f64>| patch(&pair.moved(&shift, &Vector3::zeros()), 1e-9, false).force;
        let [by_a, by_b] = [a, b].map(|direction| (force(h * direction) - force(-h * direction)) / (2.0 * h));
        let error = (by_a.dot(&b) - by_b.dot(&a)).abs() / (by_a.norm() + by_b.norm());
        // Of the few that do not reach so small a tolerance, the flag tells.
        let reached = !patch(pair, 1e-9, false).flags.contains(PatchFlags::TOLERANCE_NOT_REACHED);
        assert!(error < if reached { 1e-4 } else { 1e-2 }, "{name}: {error:e}");
    });
}
