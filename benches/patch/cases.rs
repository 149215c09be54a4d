//! Contacts of each kind: face on face, edge on face, crossed edges, corner on face.

use kit::patch::bodies::{Pair, cuboid};
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use std::f64::consts::FRAC_PI_4;

fn turn(axis: [f64; 3], angle: f64) -> Matrix3<f64> {
    Rotation3::new(angle * Vector3::from(axis)).into_inner()
}

/// The kinds, each for one rounding, sphericity and overlap: cubes of edge 1, B above A and somewhat aside.
pub fn kinds(r: f64, k: f64, overlap: f64) -> [(&'static str, Pair); 5] {
    let edge = turn([1.0, 0.0, 0.0], FRAC_PI_4);
    let corner = UnitQuaternion::rotation_between(&Vector3::new(1.0, 0.9, 1.1).normalize(), &-Vector3::z())
        .expect("not opposite")
        .to_rotation_matrix()
        .into_inner();
    let pair = |turn_a: Matrix3<f64>, turn_b: Matrix3<f64>, [x, y]: [f64; 2]| {
        let cube = || cuboid([0.5; 3], r, k);
        Pair::at_overlap(cube(), &turn_a, cube(), &turn_b, &Vector3::new(x, y, 1.0).normalize(), overlap)
    };
    let level = Matrix3::identity();
    let tilt = turn([1.0, 0.3, 0.0], 0.3 * overlap) * turn([0.0, 0.0, 1.0], 0.3);
    [
        ("face on face, turned", pair(level, turn([0.0, 0.0, 1.0], 0.3), [0.2, 0.1])),
        ("face on face, tilted", pair(level, tilt, [0.2, 0.1])),
        ("edge on face", pair(level, turn([0.0, 0.0, 1.0], 0.3) * edge, [0.1, 0.2])),
        ("crossed edges", pair(edge, turn([0.0, 0.0, 1.0], 1.0) * edge, [0.1, 0.05])),
        ("corner on face", pair(level, corner, [0.1, 0.05])),
    ]
}
