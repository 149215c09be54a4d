//! The contact patch in the plane.

use super::particle::{pp_particle_2d, pp_pose_2d};
use crate::capi::fence::call;
use crate::capi::patch::{Answer, answer, pp_patch_state, settings};
use crate::capi::status::*;
use crate::capi::types::{pp_contact_2d, pp_patch_point_2d};
use crate::planar::{Patch, PatchPoint, patch_of_contact};
use crate::{PatchSettings, PatchState};

/// The contact patch of two particles of the plane, a curve: the fields of struct pp_patch, with lengths in
/// place of areas, all per unit of thickness.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_patch_2d {
    /// Sum of PP_PATCH_... bits.
    pub flags: u32,
    /// Always 0.
    pub reserved: u32,
    /// Estimated error of the force over its size.
    pub error: f64,
    /// The length by which 1 - s is multiplied, of A and B together.
    pub depth_length: f64,
    /// The force on B over K, length^2.
    pub force: [f64; 2],
    /// The torque on B about the contact point over K, anticlockwise, length^3.
    pub torque: f64,
    /// The point on the line of action at the height of the patch, world frame.
    pub pressure_centre: [f64; 2],
    /// The same minus position of A.
    pub branch_a: [f64; 2],
    /// The same minus position of B.
    pub branch_b: [f64; 2],
    /// Length of the patch.
    pub length: f64,
    /// Centroid minus pressure_centre.
    pub centroid: [f64; 2],
    /// Integral of |y|^2 over the length about the centroid, length^3.
    pub second_moment: f64,
    /// Mean of p/K, an overlap, length.
    pub mean_depth: f64,
    /// Largest p/K, that of the contact point, length.
    pub largest_depth: f64,
    /// Elastic energy over K, length^3; NaN unless asked for.
    pub energy: f64,
    /// Change of force and torque on B about the contact point, over K, with a shift and a turn of A: rows and
    /// columns x, y and angle. NaN where it is carried on.
    pub stiffness: [f64; 9],
}

/// The patch of an overlapping contact of two particles of the plane. As pp_patch_of_contact, state too.
///
/// Errors: those of pp_patch_of_contact.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_patch_of_contact_2d(
    a: *const pp_particle_2d,
    pose_a: *const pp_pose_2d,
    b: *const pp_particle_2d,
    pose_b: *const pp_pose_2d,
    contact: *const pp_contact_2d,
    tolerance: f64,
    with_energy: u32,
    state: *mut pp_patch_state,
    patch: *mut pp_patch_2d,
    points: *mut pp_patch_point_2d,
    capacity: usize,
    count: *mut usize,
) -> pp_status {
    call!([a, pose_a, b, pose_b, contact], {
        let settings = PatchSettings { with_stiffness: true, ..settings(tolerance, with_energy)? };
        let run = |scratch: &mut _, state: Option<&mut PatchState>, visit: &mut dyn FnMut(PatchPoint)| match state {
            Some(state) => state.patch_in_plane(a, &pose_a, b, &pose_b, contact, &settings, scratch),
            None => patch_of_contact(a, &pose_a, b, &pose_b, contact, &settings, scratch, visit),
        };
        // SAFETY: as the caller has promised.
        unsafe { answer(run, state, patch, (points, capacity, count)) }
    })
}

impl Answer for Patch {
    type InC = pp_patch_2d;

    fn points(&self) -> usize {
        self.points
    }

    fn in_c(&self) -> pp_patch_2d {
        pp_patch_2d {
            flags: self.flags.bits(),
            reserved: 0,
            error: self.error,
            depth_length: self.depth_length,
            force: self.force.into(),
            torque: self.torque,
            pressure_centre: self.pressure_centre.into(),
            branch_a: self.branch_a.into(),
            branch_b: self.branch_b.into(),
            length: self.length,
            centroid: self.centroid.into(),
            second_moment: self.second_moment,
            mean_depth: self.mean_depth,
            largest_depth: self.largest_depth,
            energy: self.energy,
            stiffness: std::array::from_fn(|i| self.stiffness[(i / 3, i % 3)]),
        }
    }
}
