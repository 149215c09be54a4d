//! The contact patch.

use super::fence::{call, give};
use super::flat::triangle_of;
use super::output::{IfWanted, Output, check_room, outputs};
use super::particle::pp_particle;
use super::status::*;
use super::types::*;
use crate::{Patch, PatchError, PatchPoint, PatchScratch, PatchSettings, PatchState};
use crate::{patch_of_contact, patch_on_plane, patch_on_triangle};
use std::cell::RefCell;

/// The contact patch of two bodies A and B, or of A and a flat boundary B: the surface on which the scales of
/// both are equal and at most 1, with the pressure p = K length (1 - s), K the caller's stiffness per area
/// (force/length^3). What is proportional to K is given over K. World axes; lengths in the caller's unit.
/// Its normal n points from A to B. In the plane it is a curve: areas are lengths, all is per unit of depth.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_patch {
    /// Sum of PP_PATCH_... bits.
    pub flags: u32,
    /// Number of rays that were followed.
    pub rays: u32,
    /// Estimated relative error, the largest of three: of the force; of the torque, relative to |force| times
    /// the reach of the patch; of the energy, if asked for.
    pub error: f64,
    /// Estimated relative error of the area; NaN in the plane.
    pub area_error: f64,
    /// pp_particle_depth_length of A, plus that of B for two particles.
    pub length: f64,
    /// Integral of p n over K: the force on B (minus that on A) over K, length^3.
    pub force: [f64; 3],
    /// Torque of that on B about the point of the contact (of a boundary: on_boundary) over K, length^4.
    pub torque: [f64; 3],
    /// The point of the axis of the wrench that lies in the plane of the patch, world frame: where a law
    /// applies the force.
    pub pressure_centre: [f64; 3],
    /// The same minus position of A.
    pub branch_a: [f64; 3],
    /// The same minus position of B (of a boundary: of A).
    pub branch_b: [f64; 3],
    /// Couple along that axis, torque . force / |force|, over K, length^4.
    pub couple: f64,
    /// Area, length^2.
    pub area: f64,
    /// Centroid minus pressure_centre.
    pub centroid: [f64; 3],
    /// xx, yy, zz, xy, yz, zx of the integral of y y^T over the area about the centroid, length^4.
    pub second_moment: [f64; 6],
    /// Integral of |y|^2 over the area, y from the axis of the wrench, length^4.
    pub polar_moment: f64,
    /// Integral of p |y| over that of p: the lever of friction against twist, length.
    pub twist_lever: f64,
    /// Mean of p/K, an overlap, length.
    pub mean_depth: f64,
    /// Largest p/K, that of the contact point, length.
    pub largest_depth: f64,
    /// Elastic energy over K, length^4; NaN unless asked for.
    pub energy: f64,
}

/// What one ordered pair (A, B), or a particle A and a flat boundary, keeps of its patch. While no point of it
/// has moved by more than 0.3 sqrt(tolerance) of the largest depth, the next ones follow from it without an
/// integral.
///
/// Owned by the caller: set all bytes to 0 to begin with or to forget; copy it freely within a process. One
/// caller at a time. Not to be saved, as answers depend on it. It is used only for the particles, the
/// tolerance and the with_energy for which it was written, while the particles exist.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_patch_state {
    /// Private to the library.
    pub last_patch: [f64; 112],
}

const _: () = assert!(
    size_of::<PatchState>() <= size_of::<pp_patch_state>() && align_of::<PatchState>() == align_of::<pp_patch_state>()
);

thread_local! {
    /// Buffers of the last patch of this thread.
    static SCRATCH: RefCell<PatchScratch> = RefCell::new(PatchScratch::new());
}

/// The length by which 1 - s is multiplied to give a depth below the surface: r/|n| for k = 0, R for k = 1; in
/// between the inverse slope of s at the face nearest to the centre. A constant of the particle.
///
/// Errors: PP_NULL_POINTER.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_depth_length(particle: *const pp_particle, length: *mut f64) -> pp_status {
    give!(length, [particle], Ok(particle.depth_length()))
}

/// The patch of an overlapping contact of A with B.
///
/// contact: an answer of pp_contact_detect for the same particles and poses. tolerance: relative, in
/// [1e-12, 0.1]; 1e-4 is a good choice. with_energy: 0 or 1. state: may be NULL; else that of the pair, read
/// and updated: the patch may then be carried on from an earlier one (PP_PATCH_CARRIED). It is not used where
/// points are asked for. points: room for capacity points of quadrature; may be NULL with a capacity of 0.
/// count: receives their number; may be NULL with a capacity of 0.
/// Buffers: the library keeps some 100 kilobytes for each thread that calls this, until the thread ends.
/// Errors: PP_NULL_POINTER, PP_BAD_POSITION, PP_BAD_ORIENTATION, PP_BAD_POINT (the contact was not filled, or is
/// separated), PP_BAD_SETTING (tolerance, with_energy), PP_BUFFER_TOO_SMALL (count receives the needed size,
/// points the first ones).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_patch_of_contact(
    a: *const pp_particle,
    pose_a: *const pp_pose,
    b: *const pp_particle,
    pose_b: *const pp_pose,
    contact: *const pp_contact,
    tolerance: f64,
    with_energy: u32,
    state: *mut pp_patch_state,
    patch: *mut pp_patch,
    points: *mut pp_patch_point,
    capacity: usize,
    count: *mut usize,
) -> pp_status {
    call!([a, pose_a, b, pose_b, contact], {
        let settings = settings(tolerance, with_energy)?;
        let run = |scratch: &mut _, state: Option<&mut PatchState>, visit: &mut dyn FnMut(PatchPoint)| match state {
            Some(state) => state.patch_of_contact(a, &pose_a, b, &pose_b, contact, &settings, scratch),
            None => patch_of_contact(a, &pose_a, b, &pose_b, contact, &settings, scratch, visit),
        };
        // SAFETY: as the caller has promised.
        unsafe { answer(run, state, patch, (points, capacity, count)) }
    })
}

/// The patch of an overlapping contact of A with a plane: the part of the plane inside A. Its normal is that
/// of the contact, from A to the plane.
///
/// contact: an answer of pp_contact_plane for the same particle and pose. The rest as for pp_patch_of_contact.
/// Errors: those of pp_patch_of_contact.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_patch_on_plane(
    a: *const pp_particle,
    pose_a: *const pp_pose,
    contact: *const pp_flat_contact,
    tolerance: f64,
    with_energy: u32,
    state: *mut pp_patch_state,
    patch: *mut pp_patch,
    points: *mut pp_patch_point,
    capacity: usize,
    count: *mut usize,
) -> pp_status {
    call!([a, pose_a, contact], {
        let settings = settings(tolerance, with_energy)?;
        let run = |scratch: &mut _, state: Option<&mut PatchState>, visit: &mut dyn FnMut(PatchPoint)| match state {
            Some(state) => state.patch_on_plane(a, &pose_a, contact, &settings, scratch),
            None => patch_on_plane(a, &pose_a, contact, &settings, scratch, visit),
        };
        // SAFETY: as the caller has promised.
        unsafe { answer(run, state, patch, (points, capacity, count)) }
    })
}

/// The patch of an overlapping contact of A with a triangle: the part of the triangle inside A. Patches of
/// coplanar triangles add up to that of the slab they cover, and those of a closed mesh to force, torque and
/// energy of the mesh.
///
/// vertices: as for pp_contact_triangle. from_front: 1 where A presses on its front, from which the vertices run
/// counter-clockwise, as for a closed mesh seen from outside; 0 for its back. contact: an answer of
/// pp_contact_triangle for the same particle, pose and vertices. The rest as for pp_patch_of_contact.
/// Pointers: vertices holds 9 numbers.
/// Errors: those of pp_patch_of_contact, and PP_DEGENERATE_TRIANGLE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_patch_on_triangle(
    a: *const pp_particle,
    pose_a: *const pp_pose,
    vertices: *const f64,
    from_front: u32,
    contact: *const pp_flat_contact,
    tolerance: f64,
    with_energy: u32,
    state: *mut pp_patch_state,
    patch: *mut pp_patch,
    points: *mut pp_patch_point,
    capacity: usize,
    count: *mut usize,
) -> pp_status {
    call!([a, pose_a, vertices, contact], {
        let (triangle, front) = (triangle_of(vertices)?, is_on(from_front)?);
        let settings = settings(tolerance, with_energy)?;
        let run = |scratch: &mut _, state: Option<&mut PatchState>, visit: &mut dyn FnMut(PatchPoint)| match state {
            Some(state) => state.patch_on_triangle(a, &pose_a, &triangle, front, contact, &settings, scratch),
            None => patch_on_triangle(a, &pose_a, &triangle, front, contact, &settings, scratch, visit),
        };
        // SAFETY: as the caller has promised.
        unsafe { answer(run, state, patch, (points, capacity, count)) }
    })
}

/// Writes the patch that `run` finds with the scratch of this thread and with the state, unless points are wanted,
/// which a patch that is carried on does not have; its points, and their number. One that has more points than there
/// is room for is refused.
///
/// # Safety
/// `state` is NULL or exclusively ours for the call; points, if not NULL, is valid for writing `capacity` points, the
/// others are NULL or valid for writing.
unsafe fn answer(
    run: impl FnOnce(&mut PatchScratch, Option<&mut PatchState>, &mut dyn FnMut(PatchPoint)) -> Result<Patch, PatchError>,
    state: *mut pp_patch_state,
    out: *mut pp_patch,
    (points, capacity, count): (*mut pp_patch_point, usize, *mut usize),
) -> Result<(), pp_status> {
    check_room(out, 1)?;
    check_room(points, capacity)?;
    check_room(count, capacity)?;
    // SAFETY: as promised; the state holds as many bytes, all of them of numbers of which any value is one.
    let (state, places) = unsafe { (state.cast::<PatchState>().as_mut(), outputs(points, capacity)?) };
    let mut places = places.iter_mut();
    let mut visit = |point: PatchPoint| _ = places.next().map(|place| place.write(point));
    let state = state.filter(|_| capacity == 0);
    let patch = with_scratch(|scratch| run(scratch, state, &mut visit))?;
    // SAFETY: checked, and as promised.
    unsafe {
        IfWanted(count).put(|| patch.points)?;
        if capacity > 0 && patch.points > capacity {
            return Err(PP_BUFFER_TOO_SMALL);
        }
        out.write((&patch).into());
    }
    Ok(())
}

/// What is found with the scratch of this thread.
pub(super) fn with_scratch(
    run: impl FnOnce(&mut PatchScratch) -> Result<Patch, PatchError>,
) -> Result<Patch, pp_status> {
    SCRATCH.with_borrow_mut(run).map_err(patch_status)
}

impl From<&Patch> for pp_patch {
    fn from(patch: &Patch) -> Self {
        let m = &patch.second_moment;
        Self {
            flags: patch.flags.bits(),
            rays: patch.rays as u32,
            error: patch.error,
            area_error: patch.area_error,
            length: patch.length,
            force: patch.force.into(),
            torque: patch.torque.into(),
            pressure_centre: patch.pressure_centre.into(),
            branch_a: patch.branch_a.into(),
            branch_b: patch.branch_b.into(),
            couple: patch.couple,
            area: patch.area,
            centroid: patch.centroid.into(),
            second_moment: [m.m11, m.m22, m.m33, m.m12, m.m23, m.m31],
            polar_moment: patch.polar_moment,
            twist_lever: patch.twist_lever,
            mean_depth: patch.mean_depth,
            largest_depth: patch.largest_depth,
            energy: patch.energy,
        }
    }
}

pub(super) fn is_on(flag: u32) -> Result<bool, pp_status> {
    if flag <= 1 { Ok(flag == 1) } else { Err(PP_BAD_SETTING) }
}

pub(super) fn settings(tolerance: f64, with_energy: u32) -> Result<PatchSettings, pp_status> {
    Ok(PatchSettings { tolerance, with_energy: is_on(with_energy)?, ..PatchSettings::default() })
}

fn patch_status(error: PatchError) -> pp_status {
    match error {
        PatchError::Tolerance(_) => PP_BAD_SETTING,
        PatchError::Separated | PatchError::NotFinite => PP_BAD_POINT,
        PatchError::InPlane(_) => PP_NOT_IN_PLANE,
    }
}
