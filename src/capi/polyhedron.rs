//! Sharp convex bodies over the C boundary: from half-spaces, points or a surface to faces, corners and triangles, and
//! from there to a particle.

use super::argument::{Argument, objects};
use super::builder::{built_from, lengths, pp_built};
use super::convert::{finite, planes_of};
use super::fence::give;
use super::message::{Refusal, explain};
use super::output::{IfWanted, New, release};
use super::particle::pp_particle;
use super::status::*;
use super::types::pp_mass_properties;
use crate::Plane;
use crate::particle::error::ToleranceError;
use crate::particle::mass_properties::MassProperties;
use crate::shapes::{self, Rounding, Shape, SharpBody};
use nalgebra::Matrix3;
use std::ffi::c_char;

/// A sharp convex body. Released by pp_polyhedron_free; immutable.
pub struct pp_polyhedron(SharpBody);

objects! { pp_polyhedron => &'a SharpBody, |polyhedron| Ok(&polyhedron.0); }

/// The body between planes: count rows of a, b, c, h, (a, b, c) of any length; inside is a x + b y + c z <= h.
///
/// Planes that make no face of their own are left out: a face is part of a larger one if it lies within 1e-6
/// of the extent of the body of the plane of that one.
/// out: receives the body; release it with pp_polyhedron_free.
/// message: receives, on failure, a sentence that names the plane or value (may be NULL).
/// Errors: PP_NULL_POINTER, PP_PLANE_ZERO_NORMAL (also of a plane whose numbers are not finite),
/// PP_UNBOUNDED (the planes enclose no volume), PP_TOO_MANY_PLANES.
/// Pointers: planes points to 4*count doubles, out to one pointer, message to message_size bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_polyhedron_from_faces(
    planes: *const f64,
    count: usize,
    out: *mut *mut pp_polyhedron,
    message: *mut c_char,
    message_size: usize,
) -> pp_status {
    explain!(message[message_size], "out", New(out), [planes[count]], {
        Ok(pp_polyhedron(SharpBody::of_planes(&planes_of(planes))?))
    })
}

/// The convex hull of points: count rows of x, y, z, in any order; those inside the hull do not matter.
///
/// known: the length to which the points are known, 0 for all digits. Triangles that lie that close to the plane
/// of a larger one, or within 1e-6 of the extent, are one face with it.
/// Errors: PP_NULL_POINTER, PP_BAD_POINT, PP_BAD_SETTING (known is negative or not finite), PP_UNBOUNDED (fewer
/// than four points, or all in one plane), PP_TOO_MANY_PLANES. All else as pp_polyhedron_from_faces.
/// Pointers: points points to 3*count doubles, out to one pointer, message to message_size bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_polyhedron_from_points(
    points: *const f64,
    count: usize,
    known: f64,
    out: *mut *mut pp_polyhedron,
    message: *mut c_char,
    message_size: usize,
) -> pp_status {
    explain!(message[message_size], "out", New(out), [points[count]], {
        Ok(pp_polyhedron(SharpBody::of_points(points, known)?))
    })
}

/// The body within a closed convex surface: triangles of three numbers of points each, from 0, in any sense of
/// rotation.
///
/// Errors: those of pp_polyhedron_from_points, whose points and known are the same; PP_BAD_POINT also where a
/// triangle names a point that is not there; PP_UNBOUNDED also of a surface that is open, not convex or crosses
/// itself: the message says where.
/// Pointers: points points to 3*count doubles, triangles to 3*triangle_count integers, out to one pointer,
/// message to message_size bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_polyhedron_from_surface(
    points: *const f64,
    count: usize,
    triangles: *const u32,
    triangle_count: usize,
    known: f64,
    out: *mut *mut pp_polyhedron,
    message: *mut c_char,
    message_size: usize,
) -> pp_status {
    explain!(message[message_size], "out", New(out), [points[count], triangles[triangle_count]], {
        Ok(pp_polyhedron(SharpBody::of_surface(points, triangles, known)?))
    })
}

/// A regular prism, frustum or pyramid along z from -height/2 to height/2, the first side towards x.
///
/// radius, top_radius: of the circles within its lower and upper end; 0 above makes a pyramid.
/// Errors: PP_NULL_POINTER, PP_UNBOUNDED (sides or lengths out of range: the message says which). All else as
/// pp_polyhedron_from_faces.
/// Pointers: out points to one pointer, message to message_size bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_polyhedron_prism(
    sides: usize,
    radius: f64,
    top_radius: f64,
    height: f64,
    out: *mut *mut pp_polyhedron,
    message: *mut c_char,
    message_size: usize,
) -> pp_status {
    explain!(message[message_size], "out", New(out), [], {
        Ok(pp_polyhedron(shapes::sharp_frustum(sides, radius, top_radius, height)?))
    })
}

/// The regular solid of 4, 6, 8, 12 or 20 faces with this length of edges, about the origin.
///
/// Errors: PP_NULL_POINTER, PP_UNBOUNDED (another number of faces, or an edge that is not positive and finite).
/// All else as pp_polyhedron_from_faces.
/// Pointers: out points to one pointer, message to message_size bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_polyhedron_regular_solid(
    faces: usize,
    edge: f64,
    out: *mut *mut pp_polyhedron,
    message: *mut c_char,
    message_size: usize,
) -> pp_status {
    explain!(message[message_size], "out", New(out), [], Ok(pp_polyhedron(shapes::sharp_regular_solid(faces, edge)?)))
}

/// Releases a polyhedron; NULL is allowed and does nothing.
/// Pointers: polyhedron is NULL or came from a pp_polyhedron function and was not released yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_polyhedron_free(polyhedron: *mut pp_polyhedron) {
    // SAFETY: as promised.
    unsafe { release(polyhedron) }
}

/// Planes of the faces: rows of a, b, c, h, unit normals; half-spaces in the order given, other faces by
/// falling area.
///
/// planes: room for capacity rows; may be NULL when capacity is 0. count: receives the number of
/// faces, also when the buffer is too small (PP_BUFFER_TOO_SMALL), so that one call asks the size.
/// Errors: PP_NULL_POINTER, PP_BUFFER_TOO_SMALL.
/// Pointers: planes is valid for writing 4*capacity doubles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_polyhedron_faces(
    polyhedron: *const pp_polyhedron,
    planes: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> pp_status {
    give!((planes, capacity, count), [polyhedron], {
        let row = |Plane { normal: n, offset }: &Plane| [n.x, n.y, n.z, offset + n.dot(&polyhedron.origin)];
        Ok(polyhedron.planes.iter().map(row))
    })
}

/// Corners: rows of x, y, z. Buffer and count as of pp_polyhedron_faces.
///
/// Errors: PP_NULL_POINTER, PP_BUFFER_TOO_SMALL.
/// Pointers: corners is valid for writing 3*capacity doubles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_polyhedron_corners(
    polyhedron: *const pp_polyhedron,
    corners: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> pp_status {
    give!(
        (corners, capacity, count),
        [polyhedron],
        Ok(polyhedron.corners.iter().map(|corner| corner + polyhedron.origin))
    )
}

/// The surface as triangles: rows of three numbers of corners, from 0, counter-clockwise from outside. Those of
/// one face may be several. Buffer and count as of pp_polyhedron_faces.
///
/// Errors: PP_NULL_POINTER, PP_BUFFER_TOO_SMALL.
/// Pointers: triangles is valid for writing 3*capacity integers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_polyhedron_triangles(
    polyhedron: *const pp_polyhedron,
    triangles: *mut u32,
    capacity: usize,
    count: *mut usize,
) -> pp_status {
    give!((triangles, capacity, count), [polyhedron], Ok(polyhedron.triangles.iter().copied()))
}

/// Of the sharp body: volume and centroid, and the inertia about its centroid, axes of its frame; the error is
/// 0. size: receives the diameter of the largest ball that fits inside, length (may be NULL).
///
/// Errors: PP_NULL_POINTER, PP_UNBOUNDED (rounding leaves no ball).
/// Pointers: properties and size are valid for writing one each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_polyhedron_properties(
    polyhedron: *const pp_polyhedron,
    properties: *mut pp_mass_properties,
    size: *mut f64,
) -> pp_status {
    give!((properties, IfWanted(size)), [polyhedron], {
        let body: &SharpBody = polyhedron;
        // Rounding may leave no ball.
        let width = if size.is_null() { f64::NAN } else { body.size().map_err(|error| error.status())? };
        let centroid = body.centroid + body.origin;
        let mass = MassProperties { volume: body.volume, centroid, inertia: body.inertia(), error: 0.0 };
        Ok((pp_mass_properties::from(&mass), move || width))
    })
}

/// Rounds a polyhedron: a particle whose faces are where its faces are, about its centroid and along its
/// principal axes.
///
/// r: rounding radius, length, below half the size that pp_polyhedron_properties has. k: sphericity, in [0, 1).
/// shadow_radius: R, length, or 0 for the distance from the centroid to the farthest corner.
/// tolerance: of volume, centroid and inertia, relative, 1e-12 to 1; 0 for 1e-6, or 1e-4 of more than 30 planes.
/// out: receives the particle; release it with pp_particle_free.
/// built: receives how it stands in the frame of the polyhedron, and its mass properties (may be NULL).
/// message: receives, on failure, a sentence that names the value (may be NULL).
/// Errors: PP_NULL_POINTER, PP_BAD_SETTING (tolerance), and those of pp_particle_new.
/// Pointers: out points to one pointer, built to one struct, message to message_size bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_from_polyhedron(
    polyhedron: *const pp_polyhedron,
    r: f64,
    k: f64,
    shadow_radius: f64,
    tolerance: f64,
    out: *mut *mut pp_particle,
    built: *mut pp_built,
    message: *mut c_char,
    message_size: usize,
) -> pp_status {
    explain!(message[message_size], "out", (New(out), IfWanted(built)), [polyhedron], {
        if tolerance != 0.0 {
            ToleranceError::refuse_relative(tolerance)?;
        }
        let rounding = Rounding::of_radius(r, k);
        let rounding = if shadow_radius == 0.0 { rounding } else { rounding.with_shadow_radius(shadow_radius) };
        Ok(built_from(Shape::of_body(polyhedron, &rounding, (tolerance != 0.0).then_some(tolerance))?))
    })
}

/// A particle of at most so many planes that comes as near to a polyhedron of many faces as it can, and with a
/// given volume: for scans. About its centroid and along its principal axes.
///
/// planes: from 4 to 1000. volume: length^3, or 0 for that of the polyhedron. r: 0 for what comes nearest. All
/// else as pp_particle_from_polyhedron.
/// Errors: PP_NULL_POINTER, PP_BAD_SETTING (tolerance), PP_UNBOUNDED (planes, volume), and those of
/// pp_particle_new.
/// Pointers: out points to one pointer, built to one struct, message to message_size bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_fitted(
    polyhedron: *const pp_polyhedron,
    planes: usize,
    volume: f64,
    r: f64,
    k: f64,
    shadow_radius: f64,
    tolerance: f64,
    out: *mut *mut pp_particle,
    built: *mut pp_built,
    message: *mut c_char,
    message_size: usize,
) -> pp_status {
    explain!(message[message_size], "out", (New(out), IfWanted(built)), [polyhedron], {
        if tolerance != 0.0 {
            ToleranceError::refuse_relative(tolerance)?;
        }
        let body: &SharpBody = polyhedron;
        let volume = if volume == 0.0 { body.volume } else { volume };
        let rounding = lengths(r, k, shadow_radius);
        Ok(built_from(shapes::of_hull(body, volume, planes, &rounding, (tolerance != 0.0).then_some(tolerance))?))
    })
}

/// Whether triangles, three numbers of points each, from 0, are a closed surface: each edge joins two of them.
///
/// message: receives, of one that is not, a sentence that says where (may be NULL).
/// Errors: PP_NULL_POINTER, PP_BAD_POINT (a triangle names a point that is not there), PP_UNBOUNDED (it is not
/// closed).
/// Pointers: points points to 3*count doubles, triangles to 3*triangle_count integers, message to message_size
/// bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_surface_is_closed(
    points: *const f64,
    count: usize,
    triangles: *const u32,
    triangle_count: usize,
    message: *mut c_char,
    message_size: usize,
) -> pp_status {
    explain!(message[message_size], "", (), [points[count], triangles[triangle_count]], {
        Ok(shapes::refuse_open(points, triangles)?)
    })
}

/// Principal axes of a matrix of inertia, axis i the one nearest to axis i of its frame.
///
/// Where moments are equal, and any axes of a plane or of space are principal, those nearest to the frame's own
/// are taken. inertia: xx, yy, zz, xy, yz, zx, as in pp_mass_properties. orientation: receives the quaternion
/// (w, x, y, z), w >= 0, from the principal axes to the frame.
/// Errors: PP_NULL_POINTER, PP_BAD_POINT (a number that is not finite).
/// Pointers: inertia points to 6 doubles, orientation to 4.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_principal_axes(inertia: *const f64, orientation: *mut f64) -> pp_status {
    give!(orientation, [inertia], {
        let [[xx, yy, zz, xy, yz, zx]] = finite(inertia)?.data.0;
        Ok(shapes::principal_orientation(&Matrix3::new(xx, xy, zx, xy, yy, yz, zx, yz, zz)).1)
    })
}

impl Refusal for ToleranceError {
    fn status(&self) -> pp_status {
        PP_BAD_SETTING
    }
}
