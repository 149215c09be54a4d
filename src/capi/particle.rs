//! Particles over the C boundary: creation, release, and the definition that they were created from.

use super::argument::take;
use super::convert::planes_of;
use super::fence::give;
use super::message::{Refusal, Refused, explain};
use super::output::{New, release};
use super::status::*;
use crate::{Particle, ParticleError, Plane};
use std::ffi::c_char;

/// A validated particle. Created by pp_particle_new, released by pp_particle_free; immutable,
/// so that bodies and threads may share one.
pub struct pp_particle(pub(super) Particle);

/// Most planes that a particle may have.
pub const PP_MAX_PLANES: usize = 65536;
const _: () = assert!(PP_MAX_PLANES == crate::particle::particle::MAX_PLANES);

/// Size of a message buffer that holds every message whole.
pub const PP_MESSAGE_SIZE: usize = 512;

/// Creates a particle from count planes.
///
/// planes: count rows of a, b, c, d (outward normal and offset; local frame; the normal is used as
/// given). They are the planes of the core. For k = 0 a face lies at a x + b y + c z = d + r where no other
/// plane counts; where many planes nearly share a place the surface lies deeper. pp_particle_from_faces puts
/// the faces themselves where they are wanted. May be
/// NULL when count is 0.
/// r: rounding radius, length. k: sphericity, in [0, 1]. shadow_radius: R, length.
/// out: receives the particle; release it with pp_particle_free.
/// message: receives, on failure, a sentence that names the plane or value (may be NULL).
/// Errors: PP_NULL_POINTER, PP_PLANE_NOT_FINITE, PP_PLANE_ZERO_NORMAL, PP_BAD_SPHERICITY,
/// PP_BAD_ROUNDING_RADIUS, PP_BAD_SHADOW_RADIUS, PP_CENTRE_OUTSIDE, PP_UNBOUNDED,
/// PP_TOO_MANY_PLANES, PP_BAD_SIZE.
/// Pointers: planes points to 4*count doubles, out to one pointer, message to message_size bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_new(
    planes: *const f64,
    count: usize,
    r: f64,
    k: f64,
    shadow_radius: f64,
    out: *mut *mut pp_particle,
    message: *mut c_char,
    message_size: usize,
) -> pp_status {
    explain!(message[message_size], "out", New(out), [], {
        // Before they are looked at.
        if count > PP_MAX_PLANES {
            return Err(ParticleError::TooManyPlanes(count).into());
        }
        let planes = take!(planes[count]).map_err(|status| Refused::argument(status, "planes"))?;
        Ok(pp_particle(Particle::new(&planes_of(planes), r, k, shadow_radius)?))
    })
}

/// Creates a particle in the plane z = 0 from count lines a x + b y = d: that of the planes (a, b, 0, d), of
/// which only the cut at z = 0 counts.
///
/// It is used as any other, at poses with z = 0 and a turn about z alone, together with particles in the plane
/// or with planes whose normal is (x, y, 0): PP_NOT_IN_PLANE otherwise. Answers lie at z = 0. Areas are lengths,
/// volumes areas, and masses, forces of patches and energies are per unit of depth.
/// lines: count rows of a, b, d (outward normal and offset); may be NULL when count is 0. r, k, shadow_radius,
/// out, message, errors: as of pp_particle_new, the codes of planes for lines; for k = 0 the lines must enclose
/// an area.
/// Pointers: lines points to 3*count doubles, out to one pointer, message to message_size bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_new_in_plane(
    lines: *const f64,
    count: usize,
    r: f64,
    k: f64,
    shadow_radius: f64,
    out: *mut *mut pp_particle,
    message: *mut c_char,
    message_size: usize,
) -> pp_status {
    explain!(message[message_size], "out", New(out), [], {
        // Before they are looked at.
        if count > PP_MAX_PLANES {
            return Err(ParticleError::TooManyLines(count).into());
        }
        let lines = take!(lines[count]).map_err(|status| Refused::argument(status, "lines"))?;
        Ok(pp_particle(Particle::in_plane(lines, r, k, shadow_radius)?))
    })
}

/// Creates a particle in the plane z = 0 from points whose convex hull is a polygon with rounded corners; it is
/// used as one of pp_particle_new_in_plane.
///
/// The local origin is the centroid of the polygon, its sides are those of the polygon (k = 0), and the shadow
/// circle goes through its outermost corner.
/// points: count rows of x, y, in any order.
/// r: rounding radius, length, less than the distance of each side from the centroid. k: sphericity, in [0, 1].
/// out: receives the particle; release it with pp_particle_free.
/// message: receives, on failure, a sentence that names the point or value (may be NULL).
/// Errors: PP_NULL_POINTER, PP_PLANE_NOT_FINITE (a point is not), PP_UNBOUNDED (the points enclose no area),
/// PP_BAD_SPHERICITY, PP_BAD_ROUNDING_RADIUS, PP_TOO_MANY_PLANES, PP_BAD_INDEX (a count that no memory could
/// hold).
/// Pointers: points points to 2*count doubles, out to one pointer, message to message_size bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_new_polygon(
    points: *const f64,
    count: usize,
    r: f64,
    k: f64,
    out: *mut *mut pp_particle,
    message: *mut c_char,
    message_size: usize,
) -> pp_status {
    explain!(message[message_size], "out", New(out), [points[count]], Ok(pp_particle(Particle::polygon(points, r, k)?)))
}

/// The same shape factor times as large: d, r and R multiplied by it.
///
/// out: receives the new particle; release it with pp_particle_free.
/// message: receives, on failure, a sentence that names the value (may be NULL).
/// Errors: PP_NULL_POINTER, and those of pp_particle_new for what the factor makes of r, R and d.
/// Pointers: out points to one pointer, message to message_size bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_scaled(
    particle: *const pp_particle,
    factor: f64,
    out: *mut *mut pp_particle,
    message: *mut c_char,
    message_size: usize,
) -> pp_status {
    explain!(message[message_size], "out", New(out), [particle], Ok(pp_particle(particle.scaled(factor)?)))
}

/// Releases a particle; NULL is allowed and does nothing. No call that uses it may still be running;
/// states of its pairs may stay.
/// Pointers: particle is NULL or came from pp_particle_new and was not released yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_free(particle: *mut pp_particle) {
    // SAFETY: as promised.
    unsafe { release(particle) }
}

/// Rounding radius r as given to pp_particle_new, length.
///
/// Errors: PP_NULL_POINTER.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_rounding_radius(particle: *const pp_particle, r: *mut f64) -> pp_status {
    give!(r, [particle], Ok(particle.rounding_radius()))
}

/// Sphericity k as given to pp_particle_new, no unit.
///
/// Errors: PP_NULL_POINTER.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_sphericity(particle: *const pp_particle, k: *mut f64) -> pp_status {
    give!(k, [particle], Ok(particle.sphericity()))
}

/// Radius R of the shadow sphere as given to pp_particle_new, length.
///
/// Errors: PP_NULL_POINTER.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_shadow_radius(particle: *const pp_particle, shadow_radius: *mut f64) -> pp_status {
    give!(shadow_radius, [particle], Ok(particle.shadow_radius()))
}

/// Planes as given to pp_particle_new, without those that are one with an earlier one: rows of a, b, c, d,
/// local frame.
///
/// planes: room for capacity rows; may be NULL when capacity is 0. count: receives the number of
/// planes, also when the buffer is too small (PP_BUFFER_TOO_SMALL), so that one call asks the size.
/// Pointers: planes is valid for writing 4*capacity doubles.
/// Errors: PP_NULL_POINTER, PP_BUFFER_TOO_SMALL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_planes(
    particle: *const pp_particle,
    planes: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> pp_status {
    give!(
        (planes, capacity, count),
        [particle],
        Ok(particle.planes().map(|Plane { normal: n, offset }| [n.x, n.y, n.z, offset]))
    )
}

impl Refusal for ParticleError {
    fn status(&self) -> pp_status {
        match self {
            Self::PlaneNotFinite { .. } | Self::LineNotFinite { .. } | Self::VertexNotFinite { .. } => {
                PP_PLANE_NOT_FINITE
            }
            Self::ZeroNormal { .. } | Self::ZeroLineNormal { .. } => PP_PLANE_ZERO_NORMAL,
            Self::NormalLength { .. } | Self::LineNormalLength { .. } => PP_PLANE_ZERO_NORMAL,
            Self::Sphericity(_) => PP_BAD_SPHERICITY,
            Self::RoundingRadius(_) | Self::RoundingTooLarge { .. } | Self::RoundingTooSmall { .. } => {
                PP_BAD_ROUNDING_RADIUS
            }
            Self::ShadowRadius(_) => PP_BAD_SHADOW_RADIUS,
            Self::CentreOutside { .. } | Self::CentreOutsideLines { .. } => PP_CENTRE_OUTSIDE,
            Self::Size { .. } => PP_BAD_SIZE,
            Self::Unbounded | Self::OpenLines | Self::FlatVertices(_) => PP_UNBOUNDED,
            Self::TooManyPlanes(_) | Self::TooManyLines(_) => PP_TOO_MANY_PLANES,
        }
    }
}
