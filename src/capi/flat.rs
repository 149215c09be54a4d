//! The contact of a particle with a flat boundary.

use super::argument::take;
use super::convert::{area_tolerance, detect_status, settings_status};
use super::fence::give;
use super::particle::pp_particle;
use super::status::*;
use super::types::*;
use crate::{BoundaryError, Feature, Kind, Section, Triangle, Wall};
use crate::{Onwards, contact_with_plane, contact_with_triangle, onwards_from_seam};

/// The point on the boundary lies on the plane, or inside the triangle.
pub const PP_ON_INTERIOR: u32 = 0;
/// It lies on the edge from vertex 0 to 1; PP_ON_EDGE + 1: from 1 to 2; PP_ON_EDGE + 2: from 2 to 0.
pub const PP_ON_EDGE: u32 = 1;
/// It is vertex 0; PP_ON_VERTEX + i: vertex i.
pub const PP_ON_VERTEX: u32 = 4;
const _: () = {
    use Feature::{Edge0, Interior, Vertex0};
    assert!(Interior as u32 == PP_ON_INTERIOR && Edge0 as u32 == PP_ON_EDGE && Vertex0 as u32 == PP_ON_VERTEX);
};

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
    give!(out, [a, pose_a, point, normal, settings, state], {
        let wall = Wall::new(*point, *normal).map_err(boundary_status)?;
        contact_with_plane(a, &pose_a, &wall, settings, state).map_err(detect_status)
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
    give!(out, [a, pose_a, vertices, settings, state], {
        contact_with_triangle(a, &pose_a, &triangle_of(vertices)?, settings, state).map_err(detect_status)
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
    give!((share, sense), [a, pose_a, vertices, neighbour, settings], {
        let (own, other) = (triangle_of(vertices)?, triangle_of(neighbour)?);
        let guess = share.cast_const();
        let [mut place] = *take!(guess)?;
        settings.validate().map_err(settings_status)?;
        let feature = Feature::from_number(feature).filter(|feature| *feature != Feature::Interior);
        let feature = feature.filter(|_| (0.0..=1.0).contains(&place)).ok_or(PP_BAD_POINT)?;
        let onwards = onwards_from_seam(a, &pose_a, &own, feature, &other, settings, &mut place);
        let sense = match onwards {
            Onwards::Falls => -1,
            Onwards::Rises => 1,
            Onwards::Unknown => 0,
        };
        Ok((place, sense))
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
    give!(area, [a, pose_a, contact], {
        let tolerance = area_tolerance(relative_tolerance)?;
        match contact.kind {
            Kind::Overlapping => Section::from(contact).area(a, &pose_a, a, &pose_a, tolerance).ok_or(PP_BAD_POINT),
            Kind::Separated => Ok(0.0),
        }
    })
}

fn boundary_status(error: BoundaryError) -> pp_status {
    match error {
        BoundaryError::Point(..) | BoundaryError::Normal(..) => PP_BAD_POINT,
        BoundaryError::Area(_) => PP_DEGENERATE_TRIANGLE,
    }
}

pub(super) fn triangle_of(vertices: &[f64; 9]) -> Result<Triangle, pp_status> {
    let corner = |i: usize| [vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]];
    Triangle::new([corner(0), corner(1), corner(2)]).map_err(boundary_status)
}

/// No triangle for a plane.
///
/// # Safety
/// `vertices` is NULL or points to 9 numbers.
pub(super) unsafe fn boundary_from(vertices: *const f64) -> Result<Option<Triangle>, pp_status> {
    if vertices.is_null() { Ok(None) } else { triangle_of(take!(vertices)?).map(Some) }
}
