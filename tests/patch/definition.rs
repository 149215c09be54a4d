//! Energy, force and area by sums over a grid, straight from the definition.

use crate::patch;
use kit::patch::bodies::{Chance, Pair};
use nalgebra::Vector3;

/// W/K = ℓ ∫ min(1 − s_A, 1 − s_B) dV and the force −∂W/∂x_B = ℓ ∫ ∇s_B dV where B decides, by the midpoint rule in a
/// box.
fn grid(pair: &Pair, cells: usize, reach: f64) -> (f64, Vector3<f64>) {
    let length = pair.a.depth_length() + pair.b.depth_length();
    let step = 2.0 * reach / cells as f64;
    let (mut energy, mut force) = (0.0, Vector3::zeros());
    let at = |i: usize| -reach + (i as f64 + 0.5) * step;
    for i in 0..cells {
        for j in 0..cells {
            for k in 0..cells {
                let x = pair.contact.point + Vector3::new(at(i), at(j), at(k));
                let s = |squared: f64| (1.0 + squared).max(0.0).sqrt();
                let s_a = s(pair.a.potential(&pair.pose_a.to_local(&x)));
                let y = pair.pose_b.to_local(&x);
                let s_b = s(pair.b.potential(&y));
                if s_a.max(s_b) < 1.0 {
                    energy += 1.0 - s_a.max(s_b);
                    if s_b > s_a {
                        force += -pair.pose_b.rotate(&pair.b.gradient(&y)) / (2.0 * s_b);
                    }
                }
            }
        }
    }
    let volume = length * step.powi(3);
    (volume * energy, volume * force)
}

#[test]
fn energy_and_force_are_those_of_the_definition() {
    let mut chance = Chance::new(17);
    for (families, k, r, depth) in [
        (["cube", "rock"], [0.3, 0.02], 0.5, 0.2),
        (["pyramid", "ball"], [0.0, 1.0], 0.9, 0.1),
        (["rock", "needle"], [0.0, 0.0], 0.9, 0.3),
    ] {
        let pair = Pair::random(families, k, r, depth, &mut chance);
        let found = patch(&pair, 1e-6, true);
        let reach = 1.5 * found.area.sqrt() + 2.0 * pair.contact.overlap;
        let (energy, force) = grid(&pair, 160, reach);
        // Of the force, the sum over a grid is less exact: it ends at surfaces.
        let size = force.norm();
        assert!((found.energy / energy - 1.0).abs() < 3e-3, "{families:?}: {} {energy}", found.energy);
        assert!((found.force - force).norm() < 3e-2 * size, "{families:?}: {} {force}", found.force);
    }
}
