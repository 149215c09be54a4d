//! Contacts of each kind: face on face, edge on face, crossed edges, corner on face, round bodies.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use potential_particles::{Contact, Kind, Particle, Plane, Pose, Settings, detect};
use std::f64::consts::FRAC_PI_4;

/// Two bodies in contact.
pub struct Case {
    pub a: Particle,
    pub b: Particle,
    pub pose_a: Pose,
    pub pose_b: Pose,
    pub contact: Contact,
}

/// A cube of edge 1 with this rounding.
pub fn cube(r: f64, k: f64) -> Particle {
    let sides = (0..3).flat_map(|axis| [1.0, -1.0].map(|sign| Vector3::ith(axis, sign)));
    let planes: Vec<Plane> = sides.map(|normal| Plane { normal, offset: 0.5 - r }).collect();
    Particle::new(&planes, r, k, 0.9).expect("a cube")
}

impl Case {
    /// B above A, turned, and lowered until their overlap is this.
    pub fn above(
        a: Particle,
        turn_a: Matrix3<f64>,
        b: Particle,
        turn_b: Matrix3<f64>,
        aside: [f64; 2],
        overlap: f64,
    ) -> Self {
        let pose_a = Pose::from_rotation([0.0; 3], &turn_a).expect("a rotation");
        let at = |height: f64| Pose::from_rotation([aside[0], aside[1], height], &turn_b).expect("a rotation");
        let settings = Settings::default();
        let find = |pose_b: &Pose| detect(&a, &pose_a, &b, pose_b, &settings, None).expect("a contact");
        let (mut deep, mut apart) = (0.3, a.bounding_radius() + b.bounding_radius());
        for _ in 0..60 {
            let middle = 0.5 * (deep + apart);
            let found = find(&at(middle));
            if found.kind == Kind::Overlapping && found.overlap > overlap { deep = middle } else { apart = middle }
        }
        let pose_b = at(deep);
        let contact = find(&pose_b);
        Self { a, b, pose_a, pose_b, contact }
    }
}

fn turn(axis: [f64; 3], angle: f64) -> Matrix3<f64> {
    Rotation3::new(angle * Vector3::from(axis)).into_inner()
}

/// The kinds, each for one rounding, sphericity and overlap.
pub fn kinds(r: f64, k: f64, overlap: f64) -> [(&'static str, Case); 5] {
    let edge = turn([1.0, 0.0, 0.0], FRAC_PI_4);
    let corner = UnitQuaternion::rotation_between(&Vector3::new(1.0, 0.9, 1.1).normalize(), &-Vector3::z())
        .expect("not opposite")
        .to_rotation_matrix()
        .into_inner();
    let case = |turn_a: Matrix3<f64>, turn_b: Matrix3<f64>, aside| {
        Case::above(cube(r, k), turn_a, cube(r, k), turn_b, aside, overlap)
    };
    let level = Matrix3::identity();
    let tilt = turn([1.0, 0.3, 0.0], 0.3 * overlap) * turn([0.0, 0.0, 1.0], 0.3);
    [
        ("face on face, turned", case(level, turn([0.0, 0.0, 1.0], 0.3), [0.2, 0.1])),
        ("face on face, tilted", case(level, tilt, [0.2, 0.1])),
        ("edge on face", case(level, turn([0.0, 0.0, 1.0], 0.3) * edge, [0.1, 0.2])),
        ("crossed edges", case(edge, turn([0.0, 0.0, 1.0], 1.0) * edge, [0.1, 0.05])),
        ("corner on face", case(level, corner, [0.1, 0.05])),
    ]
}
