//! Derivatives of force and torque of a patch in the poses of both bodies.

use super::answer::PoseRows;
use crate::patch::Patch;
use nalgebra::{Matrix3, Vector3};

/// The derivatives of the wrench of a patch in the poses of both bodies, over the stiffness K per area, world axes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct PatchDerivatives {
    /// Of the force on B; that on A is minus it.
    pub force: PoseRows,
    /// Of the torque on A about its position, and of that on B about its own. With `force` they are minus the second
    /// derivative of the energy W/K.
    pub torque_on_a: PoseRows,
    /// See [`Self::torque_on_a`].
    pub torque_on_b: PoseRows,
}

/// The derivatives of force and torques of the patch of two bodies, from its stiffness: [`Patch::stiffness`] in the
/// columns of [`crate::contact_derivatives`].
///
/// `to_point` are the ways from the positions of A and B to the contact point, [`crate::Contact::branch_a`] and
/// `branch_b`; for a boundary, which turns about the position of A as in [`crate::boundary_derivatives`], both
/// `on_boundary` minus position. `None` where the patch was found without its stiffness. With the wrenches on both
/// bodies as minus the derivatives of W/K in their poses this is minus its second derivative: symmetric in the shifts;
/// in turns, which do not commute, but for half a wrench (docs/derivatives.md).
///
/// ```
/// use potential_particles::*;
/// let ball = Particle::sphere(1.0)?;
/// let (left, right) = (Pose::at([0.0, 0.0, 0.0])?, Pose::at([1.99, 0.0, 0.0])?);
/// let contact = detect(&ball, &left, &ball, &right, &Settings::default(), None)?;
/// let settings = PatchSettings { with_stiffness: true, ..PatchSettings::default() };
/// let mut scratch = PatchScratch::new();
/// let patch = patch_of_contact(&ball, &left, &ball, &right, &contact, &settings, &mut scratch, |_| ())?;
/// let derivatives = patch_derivatives(&patch, [contact.branch_a, contact.branch_b]).expect("a stiffness");
/// // The force π R' δ² falls by 2π R' δ where B moves away.
/// let slope = 2.0 * std::f64::consts::PI * 0.5 * 0.01;
/// assert!((derivatives.force[(0, 6)] / -slope - 1.0).abs() < 0.02);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn patch_derivatives(patch: &Patch, to_point: [Vector3<f64>; 2]) -> Option<PatchDerivatives> {
    let k = &patch.stiffness;
    if !k.iter().all(|entry| entry.is_finite()) {
        return None;
    }
    let block = |row: usize, column: usize| -> Matrix3<f64> { k.fixed_view::<3, 3>(3 * row, 3 * column).into_owned() };
    let [of_a, of_b] = to_point;
    let between = of_b - of_a;
    let (force, torque) = (patch.force, patch.torque);
    // With A alone, about the point: a turn of A about its centre shifts what of it is at the point.
    let by_a = |row: usize| (block(row, 0), block(row, 1) - block(row, 0) * of_a.cross_matrix());
    let (force_by_a, torque_by_a) = (by_a(0), by_a(1));
    // If both turn about B, forces turn with them.
    let both = |by_a: &(Matrix3<f64>, Matrix3<f64>), v: &Vector3<f64>| {
        let a_with_b = by_a.1 - by_a.0 * between.cross_matrix();
        (-by_a.0, -v.cross_matrix() - a_with_b)
    };
    let rows = |by_a: (Matrix3<f64>, Matrix3<f64>), by_b: (Matrix3<f64>, Matrix3<f64>)| {
        let mut rows = PoseRows::zeros();
        for (part, block) in [by_a.0, by_a.1, by_b.0, by_b.1].iter().enumerate() {
            rows.fixed_view_mut::<3, 3>(0, 3 * part).copy_from(block);
        }
        rows
    };
    let about = |arm: &Vector3<f64>| {
        let arm = arm.cross_matrix();
        (torque_by_a.0 + arm * force_by_a.0, torque_by_a.1 + arm * force_by_a.1)
    };
    let on_b = about(&of_b);
    let torque_on_b = torque + of_b.cross(&force);
    // The position of A moves with it, and the torque about it changes by as much times the force.
    let (shift, turn) = about(&of_a);
    let on_a = (-(shift + force.cross_matrix()), -turn);
    let torque_on_a = -(torque + of_a.cross(&force));
    Some(PatchDerivatives {
        force: rows(force_by_a, both(&force_by_a, &force)),
        torque_on_a: rows(on_a, both(&on_a, &torque_on_a)),
        torque_on_b: rows(on_b, both(&on_b, &torque_on_b)),
    })
}
