//! The stiffness against differences of force and torque, and against the symmetry of second derivatives of an energy.

use crate::gradients::each;
use kit::patch::bodies::{Chance, FAMILIES, Pair, body, contact, difference, moved};
use kit::patch::boundaries::{Boundary, resting};
use nalgebra::{Matrix6, Vector3, Vector6};
use potential_particles::{
    Contact, Patch, PatchFlags, PatchScratch, PatchSettings, Pose, Triangle, Wall, patch_of_contact,
};

const FINE: PatchSettings = PatchSettings { tolerance: 1e-9, with_energy: false, with_stiffness: true };

/// Force and torque about a point that stays.
fn wrench(patch: &Patch, contact_point: &Vector3<f64>, about: &Vector3<f64>) -> Vector6<f64> {
    let torque = patch.torque + (contact_point - about).cross(&patch.force);
    Vector6::from_iterator(patch.force.iter().chain(torque.iter()).copied())
}

/// With torques and turns over an arm, as a part of its size.
fn scaled(stiffness: &Matrix6<f64>, arm: f64) -> Matrix6<f64> {
    let scale = |i: usize| if i < 3 { 1.0 } else { 1.0 / arm };
    Matrix6::from_fn(|i, j| stiffness[(i, j)] * scale(i) * scale(j))
}

const IN_SPACE: &[usize] = &[0, 1, 2, 3, 4, 5];
/// Of polygons; the other motions leave the plane, and have no stiffness.
const IN_PLANE: &[usize] = &[0, 1, 5];

/// Largest relative distance of the columns to differences in these motions.
fn error(
    (stiffness, motions): (&Matrix6<f64>, &[usize]),
    arm: f64,
    h: f64,
    at: impl Fn(Vector3<f64>, Vector3<f64>) -> Vector6<f64>,
) -> f64 {
    let mut differences = Matrix6::zeros();
    for &column in motions {
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
    each(31, |pair, chance, name| {
        // A third of the pairs is enough for the time.
        if chance.uniform() > 0.33 && !pair.is_flat() {
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
        let motions = if pair.is_flat() { IN_PLANE } else { IN_SPACE };
        let off = error((&here.stiffness, motions), arm, 3e-3 * found.overlap, |shift, turn| {
            let pose_a = moved(pose_a, &found.point, &shift, &turn);
            let there = contact(a, &pose_a, b, pose_b);
            wrench(&patch(&pose_a, &there), &there.point, &found.point)
        });
        assert!(off < 1e-6, "{name}: {off:e}");
    });
}

/// The motions e_i and e_j one after the other, less the same in reverse order: of turns their axis, of a turn and a
/// shift the shift turned.
fn commutator(i: usize, j: usize) -> Vector6<f64> {
    let [(shift, turn), (other_shift, other_turn)] = [i, j].map(|k| {
        let axis = Vector3::ith(k % 3, 1.0);
        if k < 3 { (axis, Vector3::zeros()) } else { (Vector3::zeros(), axis) }
    });
    let (moved, turned) = (turn.cross(&other_shift) - other_turn.cross(&shift), turn.cross(&other_turn));
    Vector6::new(moved.x, moved.y, moved.z, turned.x, turned.y, turned.z)
}

#[test]
fn the_stiffness_is_that_of_an_energy() {
    each(32, |pair, _, name| {
        let Pair { a, pose_a, b, pose_b, contact, .. } = pair;
        let here = patch_of_contact(a, pose_a, b, pose_b, contact, &FINE, &mut PatchScratch::new(), |_| ()).unwrap();
        if here.flags.contains(PatchFlags::TOLERANCE_NOT_REACHED) {
            return;
        }
        // Derivatives along motions that do not commute: they differ by that along the commutator.
        let wrench = wrench(&here, &contact.point, &contact.point);
        // Of the plane what turns out of it is left out.
        let leaves = |i: usize| pair.is_flat() && !IN_PLANE.contains(&i);
        let along = |i: usize, j: usize| if leaves(i) || leaves(j) { 0.0 } else { wrench.dot(&commutator(i, j)) };
        let expected = Matrix6::from_fn(along);
        let arm = here.area.sqrt();
        let [off, size] =
            [here.stiffness - here.stiffness.transpose() - expected, here.stiffness].map(|m| scaled(&m, arm).norm());
        assert!(off < 1e-6 * size, "{name}: {off:e} of {size:e}");
    });
}

#[test]
fn the_stiffness_of_boundaries_is_that_of_differences() {
    let mut chance = Chance::new(33);
    for family in FAMILIES {
        for k in [0.0, 0.02, 0.3] {
            for r in [1e-3, 0.3] {
                let a = body(family, r, k, &mut chance);
                let overlap = 0.1 * if family == "ball" { 0.5 } else { a.rounding_radius() };
                let pose = resting(&a, &chance.rotation(), overlap);
                let plane = Boundary::Plane(Wall::new([0.0; 3], [0.0, 0.0, 1.0]).unwrap());
                let here = plane.patch(&a, &pose, &FINE).unwrap();
                let (middle, arm) = (here.pressure_centre, here.area.sqrt());
                // Its border lies across the patch.
                let corner = |x: f64, y: f64| [middle.x + x * arm, middle.y + y * arm, 0.0];
                let triangle = Triangle::new([corner(-9.0, -0.1), corner(9.0, -0.2), corner(0.0, 9.0)]).unwrap();
                for boundary in [plane, Boundary::Triangle(triangle)] {
                    let here = boundary.patch(&a, &pose, &FINE).unwrap();
                    if here.flags.contains(PatchFlags::TOLERANCE_NOT_REACHED) {
                        continue;
                    }
                    let about = boundary.contact(&a, &pose).unwrap().on_boundary;
                    let off = error((&here.stiffness, IN_SPACE), arm, 3e-3 * overlap, |shift, turn| {
                        let pose = moved(&pose, &about, &shift, &turn);
                        let contact = boundary.contact(&a, &pose).unwrap();
                        wrench(&boundary.patch(&a, &pose, &FINE).unwrap(), &contact.on_boundary, &about)
                    });
                    assert!(off < 1e-5, "{family}, k {k}, r {r}, {boundary:?}: {off:e}");
                }
            }
        }
    }
}
