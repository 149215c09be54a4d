//! The contact of a particle with a flat boundary.

use super::convert::{detect_status, kind_code, pose_from, settings_from, state_of};
use super::fence::{Output, borrow, fenced, output};
use super::particle::pp_particle;
use super::status::*;
use super::types::*;
use crate::{BoundaryError, DetectError, Feature, FlatContact, Section, Triangle, Wall};
use crate::{Onwards, contact_with_plane, contact_with_triangle, onwards_from_seam};

/// The point on the boundary lies on the plane, or inside the triangle.
pub const PP_ON_INTERIOR: u32 = 0;
/// It lies on the edge from vertex 0 to 1; PP_ON_EDGE + 1: from 1 to 2; PP_ON_EDGE + 2: from 2 to 0.
pub const PP_ON_EDGE: u32 = 1;
/// It is vertex 0; PP_ON_VERTEX + i: vertex i.
pub const PP_ON_VERTEX: u32 = 4;

/// The contact of a particle A with a flat boundary T, a plane or a closed triangle of no thickness. World
/// axes; lengths in the caller's unit; s and gap have no unit. Fields that do not apply are NaN.
///
/// x* is the point of T where the scale s of A is least. A overlaps T if that scale is below 1.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_flat_contact {
    /// PP_SEPARATED or PP_OVERLAPPING. A failed solve has no kind: it returns a status.
    pub kind: i32,
    /// Where on T the point x* lies: PP_ON_INTERIOR, PP_ON_EDGE + i or PP_ON_VERTEX + i.
    pub feature: u32,
    /// Sum of PP_FLAG_... bits: REJECTED with BY_SPHERES, or with BY_FACE (of A, or T itself);
    /// ROUNDING_LIMITED, EXTENDED, DEFAULT_REGULARISATION, NORMAL_BY_BOUNDARY.
    pub flags: u32,
    /// Quadratics solved.
    pub iterations: u32,
    /// Scale of A at x*, the least on T, of A as regularised (flat_regularisation). Rejected: a lower bound,
    /// no less than 1. Triangles that share the edge or vertex on which x* lies get the same s to the last
    /// bit: a caller can give the contact at a seam to the triangle with the least s, and break ties by its
    /// own numbering. If a flat face (k = 0) lies on several triangles, their s differ by flat_regularisation
    /// only; the place of the contact is then known to some percent of the size with the default, to 1e-6 of
    /// the size with 1e-4.
    pub s: f64,
    /// Bound on the error of s, with rounding to first order in doubles (as in struct pp_contact).
    pub gap: f64,
    /// Estimated bound on the distance of on_boundary to the exact x*, length.
    pub point_bound: f64,
    /// Distance from x* along the normal to the surface of A (YADE: penetrationDepth), length, >= 0 when
    /// overlapping; NaN when separated.
    pub overlap: f64,
    /// Separated: lower bound on the distance between A and T, length; 0 when none is known. NaN when
    /// overlapping.
    pub distance: f64,
    /// Unit normal from A to T: the gradient of S_A at x*; inside T exactly the normal of T or its opposite.
    pub normal: [f64; 3],
    /// Contact point, halfway between on_boundary and on_particle, world frame; x* when separated.
    pub point: [f64; 3],
    /// Contact point minus position of A: exact lever arm even far from the world origin.
    pub branch: [f64; 3],
    /// x*, world frame.
    pub on_boundary: [f64; 3],
    /// The point of the surface of A beyond x* along the normal, world frame; NaN when separated.
    pub on_particle: [f64; 3],
}

/// Finds the contact of particle A at pose_a with the plane through a point (world frame) with this normal
/// (of any length). A may touch it from either side; where its centre lies on the plane to rounding, A counts
/// as in front of it (PP_FLAG_NORMAL_BY_BOUNDARY).
///
/// settings: may be NULL (defaults); gap_tolerance, flat_regularisation and solve_separated count. A
/// gap_tolerance below 1e-13, or a gap in doubles that is too wide, is answered in extended precision
/// (PP_FLAG_EXTENDED). state: may be NULL; else that of A and this boundary, read and updated as
/// by pp_contact_detect (the last point, from which the next search starts).
/// Pointers: point and normal hold 3 numbers each.
/// Errors: PP_NULL_POINTER, PP_BAD_POSITION, PP_BAD_ORIENTATION, PP_BAD_POINT, PP_UNKNOWN_FORMULATION,
/// PP_UNKNOWN_BACK_END, PP_NO_CONE_PROGRAM, PP_BAD_SETTING, PP_SOLVER_FAILED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_contact_plane(
    a: *const pp_particle,
    pose_a: *const pp_pose,
    point: *const f64,
    normal: *const f64,
    settings: *const pp_settings,
    state: *mut pp_pair_state,
    out: *mut pp_flat_contact,
) -> pp_status {
    fenced(|| {
        let (a, pose) = unsafe { (&borrow(a)?.0, pose_from(borrow(pose_a)?)?) };
        let (point, normal) = unsafe { (borrow(point.cast::<[f64; 3]>())?, borrow(normal.cast::<[f64; 3]>())?) };
        let out = unsafe { output(out) }?;
        let settings = settings_from(unsafe { settings.as_ref() })?;
        let wall = Wall::new(*point, *normal).map_err(boundary_status)?;
        // SAFETY: NULL or exclusively ours for the call.
        let state = unsafe { state.as_mut() }.map(state_of);
        write(contact_with_plane(a, &pose, &wall, &settings, state), &out)
    })
}

/// Finds the contact of particle A at pose_a with a closed triangle, which A may touch from either side.
///
/// vertices: three points, world frame, one after the other; seen from the front they run
/// counter-clockwise. Where the centre of A lies on the triangle to rounding, A counts as in front of it
/// (PP_FLAG_NORMAL_BY_BOUNDARY).
/// settings: may be NULL (defaults); gap_tolerance, flat_regularisation and solve_separated count. A
/// gap_tolerance below 1e-13, or a gap in doubles that is too wide, is answered in extended precision
/// (PP_FLAG_EXTENDED). state: may be NULL; else that of A and this boundary, read and updated as
/// by pp_contact_detect.
/// Pointers: vertices holds 9 numbers.
/// Errors: those of pp_contact_plane, and PP_DEGENERATE_TRIANGLE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_contact_triangle(
    a: *const pp_particle,
    pose_a: *const pp_pose,
    vertices: *const f64,
    settings: *const pp_settings,
    state: *mut pp_pair_state,
    out: *mut pp_flat_contact,
) -> pp_status {
    fenced(|| {
        let (a, pose) = unsafe { (&borrow(a)?.0, pose_from(borrow(pose_a)?)?) };
        let vertices = unsafe { borrow(vertices.cast::<[f64; 9]>()) }?;
        let out = unsafe { output(out) }?;
        let settings = settings_from(unsafe { settings.as_ref() })?;
        let triangle = triangle_of(vertices)?;
        // SAFETY: NULL or exclusively ours for the call.
        let state = unsafe { state.as_mut() }.map(state_of);
        write(contact_with_triangle(a, &pose, &triangle, &settings, state), &out)
    })
}

/// How the scale of A goes on from where it is least on a triangle of a mesh, an edge or a vertex, into a
/// neighbour that shares it, without solving the triangle. Where it falls, a contact there is the
/// neighbour's; where it rises, both have the same.
///
/// vertices, neighbour: three points each, world frame, as for pp_contact_triangle. feature: PP_ON_EDGE + i
/// or PP_ON_VERTEX + i of the triangle, as pp_contact_triangle has found it before. settings: as for
/// pp_contact_triangle.
/// share: in and out; on an edge the place of the least scale, from the edge's first vertex to the next
/// one, 0 to 1: a guess, and what was found. For a vertex it is left alone.
/// sense: receives -1 where it falls, 1 where it rises, 0 where the triangle's least scale is not there for
/// sure, or is no less than 1, or only a solution can tell: ask pp_contact_triangle.
/// Errors: those of pp_contact_triangle without PP_SOLVER_FAILED; PP_BAD_POINT also for another feature or
/// a share outside of 0 to 1.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_seam_slope(
    a: *const pp_particle,
    pose_a: *const pp_pose,
    vertices: *const f64,
    feature: u32,
    neighbour: *const f64,
    settings: *const pp_settings,
    share: *mut f64,
    sense: *mut i32,
) -> pp_status {
    fenced(|| {
        let (a, pose) = unsafe { (&borrow(a)?.0, pose_from(borrow(pose_a)?)?) };
        let (own, other) = unsafe { (borrow(vertices.cast::<[f64; 9]>())?, borrow(neighbour.cast::<[f64; 9]>())?) };
        let (found, out) = unsafe { (output(share)?, output(sense)?) };
        let mut place = *unsafe { borrow(share) }?;
        let settings = settings_from(unsafe { settings.as_ref() })?;
        settings.validate().map_err(|_| PP_BAD_SETTING)?;
        let feature = match feature {
            PP_ON_EDGE..=3 => Feature::Edge((feature - PP_ON_EDGE) as u8),
            PP_ON_VERTEX..=6 => Feature::Vertex((feature - PP_ON_VERTEX) as u8),
            _ => return Err(PP_BAD_POINT),
        };
        if !(0.0..=1.0).contains(&place) {
            return Err(PP_BAD_POINT);
        }
        let (own, other) = (triangle_of(own)?, triangle_of(other)?);
        let onwards = onwards_from_seam(a, &pose, &own, feature, &other, &settings, &mut place);
        found.write(place);
        out.write(match onwards {
            Onwards::Falls => -1,
            Onwards::Rises => 1,
            Onwards::Unknown => 0,
        });
        Ok(())
    })
}

/// Contact area with a flat boundary: the area of the cut that the plane through the contact point, normal to
/// the contact normal, makes through the particle. (It is not cut off at the edges of a triangle.)
///
/// contact: an overlapping answer of pp_contact_plane or pp_contact_triangle for the same particle and pose.
/// relative_tolerance: in [1e-12, 0.1], as for pp_contact_area. area: receives length^2; 0 when separated.
/// Errors: PP_NULL_POINTER, PP_BAD_POSITION, PP_BAD_ORIENTATION, PP_BAD_POINT (the contact has no kind, or its
/// point is outside the particle), PP_BAD_SETTING.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_flat_contact_area(
    a: *const pp_particle,
    pose_a: *const pp_pose,
    contact: *const pp_flat_contact,
    relative_tolerance: f64,
    area: *mut f64,
) -> pp_status {
    fenced(|| {
        let (a, pose) = unsafe { (&borrow(a)?.0, pose_from(borrow(pose_a)?)?) };
        let contact = unsafe { borrow(contact) }?;
        let out = unsafe { output(area) }?;
        if !(1e-12..=0.1).contains(&relative_tolerance) {
            return Err(PP_BAD_SETTING);
        }
        let branch = contact.branch.into();
        let section = Section { branch_a: branch, branch_b: branch, normal: contact.normal.into() };
        out.write(match contact.kind {
            PP_OVERLAPPING => section.area(a, &pose, a, &pose, relative_tolerance).ok_or(PP_BAD_POINT)?,
            PP_SEPARATED => 0.0,
            _ => return Err(PP_BAD_POINT),
        });
        Ok(())
    })
}

pub(super) fn boundary_status(error: BoundaryError) -> pp_status {
    match error {
        BoundaryError::Point(..) | BoundaryError::Normal(..) => PP_BAD_POINT,
        BoundaryError::Area(_) => PP_DEGENERATE_TRIANGLE,
    }
}

fn triangle_of(vertices: &[f64; 9]) -> Result<Triangle, pp_status> {
    let [x0, y0, z0, x1, y1, z1, x2, y2, z2] = *vertices;
    Triangle::new([[x0, y0, z0], [x1, y1, z1], [x2, y2, z2]]).map_err(boundary_status)
}

fn write(found: Result<FlatContact, DetectError>, out: &Output<pp_flat_contact>) -> Result<(), pp_status> {
    let found = found.map_err(|error| detect_status(&error))?;
    out.write(pp_flat_contact {
        kind: kind_code(found.kind),
        feature: match found.feature {
            Feature::Interior => PP_ON_INTERIOR,
            Feature::Edge(i) => PP_ON_EDGE + u32::from(i),
            Feature::Vertex(i) => PP_ON_VERTEX + u32::from(i),
        },
        flags: found.flags.bits(),
        iterations: found.iterations,
        s: found.s,
        gap: found.gap,
        point_bound: found.point_bound,
        overlap: found.overlap,
        distance: found.distance,
        normal: found.normal.into(),
        point: found.point.into(),
        branch: found.branch.into(),
        on_boundary: found.on_boundary.into(),
        on_particle: found.on_particle.into(),
    });
    Ok(())
}
