//! Derivatives of the force and the torques of a contact patch.

use super::derivative::rows;
use super::fence::give;
use super::flat::boundary_from;
use super::particle::pp_particle;
use super::patch::{is_on, settings, with_scratch};
use super::status::*;
use super::types::*;
use crate::{Patch, PatchError, PatchPoint, PatchScratch, PatchSettings, patch_derivatives};
use crate::{patch_of_contact, patch_on_plane, patch_on_triangle};
use nalgebra::Vector3;

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
    give!(out, [a, pose_a, b, pose_b, contact], {
        let settings = PatchSettings { with_stiffness: true, ..settings(tolerance, 0)? };
        derivatives([contact.branch_a, contact.branch_b], |scratch, visit| {
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
    give!(out, [a, pose_a, contact], {
        // SAFETY: as the caller has promised.
        let (triangle, front) = (unsafe { boundary_from(vertices) }?, is_on(from_front)?);
        let settings = PatchSettings { with_stiffness: true, ..settings(tolerance, 0)? };
        derivatives([contact.on_boundary - pose_a.position(); 2], |scratch, visit| match &triangle {
            Some(triangle) => patch_on_triangle(a, &pose_a, triangle, front, contact, &settings, scratch, visit),
            None => patch_on_plane(a, &pose_a, contact, &settings, scratch, visit),
        })
    })
}

fn derivatives(
    to_point: [Vector3<f64>; 2],
    run: impl FnOnce(&mut PatchScratch, &mut dyn FnMut(PatchPoint)) -> Result<Patch, PatchError>,
) -> Result<pp_patch_derivatives, pp_status> {
    let patch = with_scratch(|scratch| run(scratch, &mut |_| ()))?;
    let found = patch_derivatives(&patch, to_point).ok_or(PP_NO_DERIVATIVE)?;
    Ok(pp_patch_derivatives {
        force: rows(&found.force),
        torque_on_a: rows(&found.torque_on_a),
        torque_on_b: rows(&found.torque_on_b),
    })
}
