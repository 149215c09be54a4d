//! Derivatives of the force and the torques of a contact patch.

use super::convert::{contact_of, pose_from};
use super::derivative::{boundary_from, rows};
use super::fence::{Output, borrow, fenced, output};
use super::flat::flat_contact_of;
use super::particle::pp_particle;
use super::patch::{is_on, settings, with_points};
use super::status::*;
use super::types::*;
use crate::{
    Patch, PatchError, PatchPoint, PatchScratch, PatchSettings, patch_derivatives, patch_of_contact, patch_on_plane,
    patch_on_triangle,
};
use nalgebra::Vector3;
use std::ptr;

/// Derivatives of the force and the torques of a contact patch in the poses of A and B, over K, world axes;
/// columns as of struct pp_derivatives. They are minus the second derivative of the energy.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_patch_derivatives {
    /// Of the force on B, a row for each of x, y, z; that on A is minus it. length^2 and length^3.
    pub force: [[f64; 12]; 3],
    /// Of the torque on A about its position. length^3 and length^4.
    pub torque_on_a: [[f64; 12]; 3],
    /// Of the torque on B about its position (of a boundary: that of A).
    pub torque_on_b: [[f64; 12]; 3],
}

/// The derivatives of the patch of an overlapping contact of A with B.
///
/// contact, tolerance: as of pp_patch_of_contact; the derivatives are known to about the root of the
/// tolerance.
/// Errors: those of pp_patch_of_contact, and PP_NO_DERIVATIVE (no patch was found).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_patch_derivatives_of_contact(
    a: *const pp_particle,
    pose_a: *const pp_pose,
    b: *const pp_particle,
    pose_b: *const pp_pose,
    contact: *const pp_contact,
    tolerance: f64,
    out: *mut pp_patch_derivatives,
) -> pp_status {
    fenced(|| {
        let (a, b) = unsafe { (&borrow(a)?.0, &borrow(b)?.0) };
        let (pose_a, pose_b) = unsafe { (pose_from(borrow(pose_a)?)?, pose_from(borrow(pose_b)?)?) };
        let contact = unsafe { contact_of(contact) }?;
        let settings = PatchSettings { with_stiffness: true, ..settings(tolerance, 0)? };
        let out = unsafe { output(out) }?;
        write([contact.branch_a, contact.branch_b], &out, |scratch, visit| {
            patch_of_contact(a, &pose_a, b, &pose_b, contact, &settings, scratch, visit)
        })
    })
}

/// The derivatives of the patch of an overlapping contact of A with a plane or a triangle, in the poses of A
/// and of the boundary, which stands in place of B and turns about the position of A, too.
///
/// vertices: NULL for a plane; else, as from_front (0 for a plane), as of pp_patch_on_triangle. contact,
/// tolerance: as of pp_patch_on_plane and pp_patch_on_triangle.
/// Pointers: vertices holds 9 numbers.
/// Errors: those of pp_patch_on_triangle, and PP_NO_DERIVATIVE (no patch was found).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_patch_derivatives_on_boundary(
    a: *const pp_particle,
    pose_a: *const pp_pose,
    vertices: *const f64,
    from_front: u32,
    contact: *const pp_flat_contact,
    tolerance: f64,
    out: *mut pp_patch_derivatives,
) -> pp_status {
    fenced(|| {
        let (a, pose) = unsafe { (&borrow(a)?.0, pose_from(borrow(pose_a)?)?) };
        let (triangle, front) = (unsafe { boundary_from(vertices) }?, is_on(from_front)?);
        let contact = unsafe { flat_contact_of(contact) }?;
        let settings = PatchSettings { with_stiffness: true, ..settings(tolerance, 0)? };
        let out = unsafe { output(out) }?;
        write([contact.on_boundary - pose.position(); 2], &out, |scratch, visit| match &triangle {
            Some(triangle) => patch_on_triangle(a, &pose, triangle, front, contact, &settings, scratch, visit),
            None => patch_on_plane(a, &pose, contact, &settings, scratch, visit),
        })
    })
}

fn write(
    to_point: [Vector3<f64>; 2],
    out: &Output<pp_patch_derivatives>,
    run: impl FnOnce(&mut PatchScratch, &mut dyn FnMut(PatchPoint)) -> Result<Patch, PatchError>,
) -> Result<(), pp_status> {
    let patch = unsafe { with_points(run, |patch: &Patch| patch.points, ptr::null_mut(), 0, ptr::null_mut()) }?;
    let found = patch_derivatives(&patch, to_point).ok_or(PP_NO_DERIVATIVE)?;
    out.write(pp_patch_derivatives {
        force: rows(&found.force),
        torque_on_a: rows(&found.torque_on_a),
        torque_on_b: rows(&found.torque_on_b),
    });
    Ok(())
}
