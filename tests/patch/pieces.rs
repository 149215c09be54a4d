//! Patches in pieces against the fan of rays, which computes them when the energy is asked for.

use crate::bodies::{Chance, FAMILIES, Pair, cuboid};
use crate::patch;
use nalgebra::{Rotation3, Vector3};
use potential_particles::{Patch, PatchFlags};

/// Errors of force, torque, area, lever and second moments, relative to the patch.
fn errors(found: &Patch, exact: &Patch) -> [f64; 5] {
    let force = exact.force.norm();
    let reach = exact.area.sqrt();
    [
        (found.force - exact.force).norm() / force,
        (found.torque - exact.torque).norm() / (force * reach),
        (found.area / exact.area - 1.0).abs(),
        (found.twist_lever / exact.twist_lever - 1.0).abs(),
        (found.second_moment - exact.second_moment).norm() / exact.second_moment.norm(),
    ]
}

/// Pairs with faces nearly against each other, or anyhow.
fn pairs(seed: u64) -> Vec<(String, Pair)> {
    let mut chance = Chance::new(seed);
    let mut pairs = Vec::new();
    for r in [1e-6, 1e-3, 0.05, 0.3] {
        for depth in [0.001, 0.02, 0.2] {
            for tilt in [0.0, 0.3, 1.0, 3.0] {
                let overlap = depth * r;
                let spin = Rotation3::new(chance.uniform() * Vector3::z()).into_inner();
                let turn = Rotation3::new(tilt * overlap * Vector3::new(1.0, 0.3, 0.0)).into_inner() * spin;
                let (a, b) = (cuboid([0.7, 0.6, 0.5], r, 0.0), cuboid([0.5, 0.4, 0.3], 0.5 * r, 0.0));
                let aside = Vector3::new(0.6 * chance.uniform(), 0.5 * chance.uniform(), 1.0).normalize();
                let pair = Pair::at_overlap(a, &nalgebra::Matrix3::identity(), b, &turn, &aside, overlap);
                pairs.push((format!("face, r {r}, depth {depth}, tilt {tilt}"), pair));
            }
            for family in &FAMILIES[..5] {
                let other = chance.pick(&FAMILIES[..5]);
                let pair = Pair::random([family, other], [0.0; 2], r, depth, &mut chance);
                pairs.push((format!("{family} on {other}, r {r}, depth {depth}"), pair));
            }
        }
    }
    pairs
}

#[test]
fn pieces_are_as_the_fan() {
    for tolerance in [1e-4, 1e-6] {
        let (mut in_pieces, mut count, mut over) = (0, 0, 0);
        for (name, pair) in pairs(5) {
            let (found, exact) = (patch(&pair, tolerance, false), patch(&pair, 0.01 * tolerance, true));
            if exact.flags.contains(PatchFlags::FOLDED) {
                continue;
            }
            count += 1;
            if found.rays > 0 {
                eprintln!("FAN  {name} rays {}", found.rays);
                continue;
            }
            in_pieces += 1;
            let off = errors(&found, &exact).map(|e| (e * 1e9).round() * 1e-9);
            eprintln!(
                "{tolerance} {name}: est {:.1e}, {off:?} ({} points, exact's {:.1e})",
                found.error, found.points, exact.error
            );
            over += usize::from(off[0] > found.error.max(0.1 * tolerance));
        }
        eprintln!("{in_pieces} of {count}, {over} over");
    }
}
