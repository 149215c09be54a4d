//! Creation and release of particles of the plane, and the definition that they were created from.

use crate::ParticleError;
use crate::capi::argument::take;
use crate::capi::fence::give;
use crate::capi::message::{Refused, explain};
use crate::capi::output::{New, release};
use crate::capi::particle::PP_MAX_PLANES;
use crate::capi::status::*;
use crate::planar::{Line, Particle};
use std::ffi::c_char;

/// Where a body of the plane is: world = rotation(angle) * local + position.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_pose_2d {
    /// Centre of the particle (origin of its local frame), world frame, length units of the caller.
    pub position: [f64; 2],
    /// Angle of the local axes in the world, radians, anticlockwise, from -2^30 to 2^30; beyond, take
    /// whole turns off. It counts as exact.
    pub angle: f64,
}

/// A validated particle of the plane. Created by pp_particle_new_2d, released by
/// pp_particle_free_2d; immutable, so that bodies and threads may share one.
pub struct pp_particle_2d(pub(in crate::capi) Particle);

/// Creates a particle of the plane from count lines a x + b y = d.
///
/// With S(x) = (1-k)/r^2 * sum <a x + b y - d>^2 + k/R^2 * |x|^2 all else is as in
/// pp_particle_new, and the codes of planes stand for lines.
/// lines: count rows of a, b, d (outward normal and offset; local frame; the normal is used as
/// given). They are the lines of the core: for k = 0 a side lies at a x + b y = d + r. May be NULL when
/// count is 0.
/// r: rounding radius, length. k: sphericity, in [0, 1]. shadow_radius: R, length.
/// out: receives the particle; release it with pp_particle_free_2d.
/// message: receives, on failure, a sentence that names the line or value (may be NULL).
/// Errors: PP_NULL_POINTER, PP_PLANE_NOT_FINITE, PP_PLANE_ZERO_NORMAL, PP_BAD_SPHERICITY,
/// PP_BAD_ROUNDING_RADIUS, PP_BAD_SHADOW_RADIUS, PP_CENTRE_OUTSIDE, PP_UNBOUNDED (k = 0 and
/// the lines enclose no area), PP_TOO_MANY_PLANES, PP_BAD_SIZE.
/// Pointers: lines points to 3*count doubles, out to one pointer, message to message_size bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_new_2d(
    lines: *const f64,
    count: usize,
    r: f64,
    k: f64,
    shadow_radius: f64,
    out: *mut *mut pp_particle_2d,
    message: *mut c_char,
    message_size: usize,
) -> pp_status {
    explain!(message[message_size], "out", New(out), [], {
        // Before they are looked at.
        if count > PP_MAX_PLANES {
            return Err(ParticleError::TooManyLines(count).into());
        }
        let lines: &[[f64; 3]] = take!(lines[count]).map_err(|status| Refused::argument(status, "lines"))?;
        let lines: Vec<Line> = lines.iter().map(|&row| Line::from(row)).collect();
        Ok(pp_particle_2d(Particle::new(&lines, r, k, shadow_radius)?))
    })
}

/// Creates a particle of the plane from points whose convex hull is a polygon with rounded corners.
///
/// The local origin is the centroid of the polygon, its sides are those of the polygon (k = 0), and
/// the shadow circle goes through its outermost corner.
/// points: count rows of x, y, in any order.
/// r: rounding radius, length, less than the distance of each side from the centroid. k: sphericity,
/// in [0, 1].
/// out: receives the particle; release it with pp_particle_free_2d.
/// message: receives, on failure, a sentence that names the point or value (may be NULL).
/// Errors: PP_NULL_POINTER, PP_PLANE_NOT_FINITE (a point is not), PP_UNBOUNDED (the points enclose
/// no area), PP_BAD_SPHERICITY, PP_BAD_ROUNDING_RADIUS, PP_TOO_MANY_PLANES, PP_BAD_INDEX (a count that no
/// memory could hold).
/// Pointers: points points to 2*count doubles, out to one pointer, message to message_size bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_new_polygon_2d(
    points: *const f64,
    count: usize,
    r: f64,
    k: f64,
    out: *mut *mut pp_particle_2d,
    message: *mut c_char,
    message_size: usize,
) -> pp_status {
    explain!(
        message[message_size],
        "out",
        New(out),
        [points[count]],
        Ok(pp_particle_2d(Particle::polygon(points, r, k)?))
    )
}

/// Releases a particle of the plane; NULL is allowed and does nothing. No call that uses it may still be
/// running.
/// Pointers: particle is NULL or came from pp_particle_new_2d or pp_particle_new_polygon_2d and was not
/// released yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_free_2d(particle: *mut pp_particle_2d) {
    // SAFETY: as promised.
    unsafe { release(particle) }
}

/// Rounding radius r as given, length.
///
/// Errors: PP_NULL_POINTER.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_rounding_radius_2d(particle: *const pp_particle_2d, r: *mut f64) -> pp_status {
    give!(r, [particle], Ok(particle.rounding_radius()))
}

/// Sphericity k as given, no unit.
///
/// Errors: PP_NULL_POINTER.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_sphericity_2d(particle: *const pp_particle_2d, k: *mut f64) -> pp_status {
    give!(k, [particle], Ok(particle.sphericity()))
}

/// Radius R of the shadow circle as given, or that through the outermost corner of a polygon, length.
///
/// Errors: PP_NULL_POINTER.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_shadow_radius_2d(
    particle: *const pp_particle_2d,
    shadow_radius: *mut f64,
) -> pp_status {
    give!(shadow_radius, [particle], Ok(particle.shadow_radius()))
}

/// Lines as given, or the sides of a polygon less r: rows of a, b, d, local frame.
///
/// lines: room for capacity rows; may be NULL when capacity is 0. count: receives the number of
/// lines, also when the buffer is too small (PP_BUFFER_TOO_SMALL), so that one call asks the size.
/// Pointers: lines is valid for writing 3*capacity doubles.
/// Errors: PP_NULL_POINTER, PP_BUFFER_TOO_SMALL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_lines_2d(
    particle: *const pp_particle_2d,
    lines: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> pp_status {
    give!(
        (lines, capacity, count),
        [particle],
        Ok(particle.lines().map(|Line { normal: n, offset }| [n.x, n.y, offset]))
    )
}
