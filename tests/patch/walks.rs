//! Bodies that tilt, slide and roll: the wrench changes without jumps.

use crate::patch;
use kit::patch::bodies::{Pair, contact, cuboid};
use nalgebra::{Matrix3, Rotation3, Vector3, Vector6};
use potential_particles::{Kind, Pose};

/// Largest change between two of so many steps, over the largest force.
fn largest_change(steps: usize, pose_of_b: impl Fn(f64) -> Pose, r: f64, k: f64) -> f64 {
    let (a, b) = (cuboid([1.0, 1.0, 0.5], r, k), cuboid([0.3; 3], r, k));
    let pose_a = Pose::at([0.0; 3]).unwrap();
    let wrench = |t: f64| {
        let pose_b = pose_of_b(t);
        let contact = contact(&a, &pose_a, &b, &pose_b);
        if contact.kind == Kind::Separated {
            return Vector6::zeros();
        }
        let arm = contact.point;
        let found = patch(&Pair { a: a.clone(), b: b.clone(), pose_a, pose_b, contact }, 1e-7, false);
        let torque = found.torque + arm.cross(&found.force);
        Vector6::from_iterator(found.force.iter().chain(torque.iter()).copied())
    };
    let values: Vec<Vector6<f64>> = (0..=steps).map(|i| wrench(i as f64 / steps as f64)).collect();
    let size = values.iter().map(|v| v.norm()).fold(0.0, f64::max);
    values.windows(2).map(|pair| (pair[1] - pair[0]).norm()).fold(0.0, f64::max) / size
}

#[test]
fn the_wrench_has_no_jumps() {
    let turn = |axis: [f64; 3], angle: f64| Rotation3::new(angle * Vector3::from(axis)).into_inner();
    for (r, k) in [(0.05, 0.0), (0.05, 0.02), (1e-3, 0.0)] {
        let overlap = 0.1 * r;
        let on_face = |rotation: Matrix3<f64>, x: f64, lift: f64| {
            Pose::from_rotation([x, 0.1, 0.8 - overlap + lift], &rotation).unwrap()
        };
        // From a face over its edge, over the end of the plate, and about the contact normal.
        let tilt = |t: f64| on_face(turn([0.0, 1.0, 0.0], 3.0 * overlap * (t - 0.3)), 0.1, 0.0);
        let slide = |t: f64| on_face(turn([0.0, 0.0, 1.0], 0.2), 0.6 + 0.7 * t, 0.0);
        let spin = |t: f64| on_face(turn([0.0, 0.0, 1.0], 1.6 * t), 0.7, 0.0);
        // Onto an edge, slowly at first, the middle as high as that lets it sink in by the overlap.
        let roll = |t: f64| {
            let angle = std::f64::consts::FRAC_PI_4 * t.powi(3);
            let reach = (0.3 - r) * (angle.sin() + angle.cos()) + r;
            Pose::from_rotation([0.1, 0.2, 0.5 + reach - overlap], &turn([0.0, 1.0, 0.0], angle)).unwrap()
        };
        let walks: [(&str, &dyn Fn(f64) -> Pose); 4] =
            [("tilt", &tilt), ("slide", &slide), ("spin", &spin), ("roll", &roll)];
        for (name, walk) in walks {
            // A jump would stay as the steps get shorter; where the stiffness changes in a short way, the changes fall
            // later.
            let changes = [200, 800].map(|steps| largest_change(steps, walk, r, k));
            assert!(changes[1] < 0.5 * changes[0] || changes[1] < 2e-3, "{name}, r {r}, k {k}: {changes:?}");
        }
    }
}
