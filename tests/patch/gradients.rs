//! Force and torque are minus the gradient of the energy, which is another integral.

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
    for k in [0.0, 0.02, 0.3] {
        for r in [1e-3, 0.05, 0.3, 0.9] {
            for depth in [0.05, 0.3] {
                visit(
                    &Pair::flat(r, k, depth, &mut chance),
                    &mut chance,
                    &format!("polygons, k {k}, r {r}, depth {depth}"),
                );
            }
        }
    }
    assert!(count > 80, "{count} pairs");
}

#[test]
fn the_force_is_the_gradient_of_the_energy() {
    each(21, |pair, chance, name| {
        // A third of the pairs is enough for the time.
        if chance.uniform() > 0.33 && !pair.is_flat() {
            return;
        }
        let here = patch(pair, 1e-9, false);
        let force = here.force.norm();
        let [aside, turn] = pair.directions(chance);
        let direction = (here.force / force + 0.3 * aside).normalize();
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
