//! The stiffness against differences of force and torque, and against the symmetry of second derivatives of an energy.

use crate::bodies::{Chance, FAMILIES, Pair, body, contact, cuboid};
use crate::difference;
use crate::gradients::each;
use nalgebra::{Matrix6, UnitQuaternion, Vector3, Vector6};
use potential_particles::{
    Contact, Kind, Particle, Patch, PatchFlags, PatchScratch, PatchSettings, Pose, Settings, Triangle, Wall, contact_with_plane,
    contact_with_triangle, patch_of_contact, patch_on_plane, patch_on_triangle,
};

const FINE: PatchSettings = PatchSettings { tolerance: 1e-9, with_energy: false, with_stiffness: true };

/// A pose after a shift and a turn about a point.
fn moved(pose: &Pose, about: &Vector3<f64>, shift: &Vector3<f64>, turn: &Vector3<f64>) -> Pose {
    let turn = UnitQuaternion::from_scaled_axis(*turn).to_rotation_matrix().into_inner();
    let position = about + shift + turn * (pose.position() - about);
    Pose::from_rotation(position.into(), &(turn * pose.rotation())).unwrap()
}

/// A patch, and force and torque about a point that stays; `None` without contact.
fn wrench(patch: &Patch, contact_point: &Vector3<f64>, about: &Vector3<f64>) -> Vector6<f64> {
    let torque = patch.torque + (contact_point - about).cross(&patch.force);
    Vector6::from_iterator(patch.force.iter().chain(torque.iter()).copied())
}

/// With torques and turns over an arm, as a part of its size.
fn scaled(stiffness: &Matrix6<f64>, arm: f64) -> Matrix6<f64> {
    let scale = |i: usize| if i < 3 { 1.0 } else { 1.0 / arm };
    Matrix6::from_fn(|i, j| stiffness[(i, j)] * scale(i) * scale(j))
}

/// Largest relative distance of the columns to differences.
fn error(stiffness: &Matrix6<f64>, arm: f64, h: f64, at: impl Fn(Vector3<f64>, Vector3<f64>) -> Vector6<f64>) -> f64 {
    let mut differences = Matrix6::zeros();
    for column in 0..6 {
        let axis = Vector3::ith(column % 3, 1.0);
        for row in 0..6 {
            let of = |h: f64| match column < 3 {
                true => at(h * axis, Vector3::zeros())[row],
                false => at(Vector3::zeros(), h * axis)[row],
            };
            differences[(row, column)] = difference(of, if column < 3 { h } else { h / arm });
        }
    }
    let (expected, found) = (scaled(&differences, arm), scaled(stiffness, arm));
    (found - expected).norm() / expected.norm()
}

#[test]
fn the_stiffness_of_pairs_is_that_of_differences() {
    let mut worst = (0.0, String::new());
    each(31, |pair, chance, name| {
        if chance.uniform() > 0.33 {
            return;
        }
        let Pair { a, pose_a, b, pose_b, contact: found, .. } = pair;
        let patch = |pose_a: &Pose, contact: &Contact| {
            patch_of_contact(a, pose_a, b, pose_b, contact, &FINE, &mut PatchScratch::new(), |_| ()).unwrap()
        };
        let here = patch(pose_a, found);
        if here.flags.contains(PatchFlags::TOLERANCE_NOT_REACHED) {
            return;
        }
        let arm = here.area.sqrt();
        let off = error(&here.stiffness, arm, 3e-3 * found.overlap, |shift, turn| {
            let pose_a = moved(pose_a, &found.point, &shift, &turn);
            let there = contact(a, &pose_a, b, pose_b);
            wrench(&patch(&pose_a, &there), &there.point, &found.point)
        });
        if off > worst.0 { worst = (off, name.to_string()) }
        println!("{off:.1e} {name}");
    });
    println!("{worst:?}");
    assert!(worst.0 < 1e-3, "{worst:?}");
}
