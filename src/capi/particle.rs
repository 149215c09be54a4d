//! Particles over the C boundary: creation, release, and the definition that they were created from.

use super::fence::{array, borrow, fenced, output, write_rows};
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
/// PP_TOO_MANY_PLANES.
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
    let make = || {
        if count > PP_MAX_PLANES {
            return Ok(Err(ParticleError::TooManyPlanes(count)));
        }
        // SAFETY: the caller promised 4*count doubles.
        let rows = unsafe { array(planes.cast::<[f64; 4]>(), count) }?;
        let planes: Vec<Plane> = rows.iter().map(|&row| Plane::from(row)).collect();
        Ok(Particle::new(&planes, r, k, shadow_radius).map(pp_particle))
    };
    // SAFETY: out and message are the caller's, as promised.
    unsafe { create(make, "planes and out must not be NULL", out, message, message_size) }
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
    let make = || {
        let particle = &unsafe { borrow(particle) }?.0;
        Ok(particle.scaled(factor).map(pp_particle))
    };
    // SAFETY: out and message are the caller's, as promised.
    unsafe { create(make, "particle and out must not be NULL", out, message, message_size) }
}

/// Releases a particle; NULL is allowed and does nothing. No call that uses it may still be running;
/// states of its pairs may stay.
/// Pointers: particle is NULL or came from pp_particle_new and was not released yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_free(particle: *mut pp_particle) {
    if !particle.is_null() {
        // SAFETY: by contract this came from Box::into_raw and is freed once.
        drop(unsafe { Box::from_raw(particle) });
    }
}

/// Rounding radius r as given to pp_particle_new, length.
///
/// Errors: PP_NULL_POINTER.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_rounding_radius(particle: *const pp_particle, r: *mut f64) -> pp_status {
    fenced(|| {
        let particle = &unsafe { borrow(particle) }?.0;
        unsafe { output(r) }?.write(particle.rounding_radius());
        Ok(())
    })
}

/// Sphericity k as given to pp_particle_new, no unit.
///
/// Errors: PP_NULL_POINTER.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_sphericity(particle: *const pp_particle, k: *mut f64) -> pp_status {
    fenced(|| {
        let particle = &unsafe { borrow(particle) }?.0;
        unsafe { output(k) }?.write(particle.sphericity());
        Ok(())
    })
}

/// Radius R of the shadow sphere as given to pp_particle_new, length.
///
/// Errors: PP_NULL_POINTER.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_shadow_radius(particle: *const pp_particle, shadow_radius: *mut f64) -> pp_status {
    fenced(|| {
        let particle = &unsafe { borrow(particle) }?.0;
        unsafe { output(shadow_radius) }?.write(particle.shadow_radius());
        Ok(())
    })
}

/// Planes as given to pp_particle_new: rows of a, b, c, d, local frame.
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
    fenced(|| {
        let particle = &unsafe { borrow(particle) }?.0;
        let rows = particle.planes().map(|Plane { normal: n, offset }| [n.x, n.y, n.z, offset]);
        // SAFETY: the caller promised 4*capacity doubles.
        unsafe { write_rows(rows, planes, capacity, count) }
    })
}

/// Hands what `make` makes to the caller. Why it could not is written to the message: the error's own sentence, `null` for a
/// pointer that is NULL, else that of the status.
/// Pointers: out is NULL or valid for writing, message is NULL or valid for writing size bytes.
pub(super) unsafe fn create<T>(
    make: impl FnOnce() -> Result<Result<T, ParticleError>, pp_status>,
    null: &str,
    out: *mut *mut T,
    message: *mut c_char,
    message_size: usize,
) -> pp_status {
    // SAFETY: by contract.
    let explain = |text: &str| unsafe { write_message(text, message, message_size) };
    let status = fenced(|| {
        let out = unsafe { output(out) }?;
        let made = make()?.map_err(|error| {
            explain(&error.to_string());
            particle_status(&error)
        })?;
        out.write(Box::into_raw(Box::new(made)));
        Ok(())
    });
    // SAFETY: by contract.
    unsafe { explain_status(status, null, message, message_size) };
    status
}

/// Writes the message of a status whose cause is no value: `null` for a pointer that is NULL, else the status's own sentence.
/// Pointers: message is NULL or valid for writing size bytes.
pub(super) unsafe fn explain_status(status: pp_status, null: &str, message: *mut c_char, size: usize) {
    let text = match status {
        PP_NULL_POINTER => null,
        PP_BAD_INDEX | PP_INTERNAL_ERROR => sentence(status),
        _ => return,
    };
    // SAFETY: by contract.
    unsafe { write_message(text, message, size) };
}

pub(super) fn particle_status(error: &ParticleError) -> pp_status {
    match error {
        ParticleError::PlaneNotFinite { .. }
        | ParticleError::LineNotFinite { .. }
        | ParticleError::VertexNotFinite { .. } => PP_PLANE_NOT_FINITE,
        ParticleError::ZeroNormal { .. } | ParticleError::ZeroLineNormal { .. } => PP_PLANE_ZERO_NORMAL,
        ParticleError::NormalLength { .. } | ParticleError::LineNormalLength { .. } => PP_PLANE_ZERO_NORMAL,
        ParticleError::Sphericity(_) => PP_BAD_SPHERICITY,
        ParticleError::RoundingRadius(_)
        | ParticleError::RoundingTooLarge { .. }
        | ParticleError::RoundingTooSmall { .. } => PP_BAD_ROUNDING_RADIUS,
        ParticleError::ShadowRadius(_) => PP_BAD_SHADOW_RADIUS,
        ParticleError::CentreOutside { .. } | ParticleError::CentreOutsideLines { .. } => PP_CENTRE_OUTSIDE,
        ParticleError::Unbounded | ParticleError::OpenLines | ParticleError::FlatVertices(_) => PP_UNBOUNDED,
        ParticleError::TooManyPlanes(_) | ParticleError::TooManyLines(_) => PP_TOO_MANY_PLANES,
    }
}

/// Copies as much of text as fits, always zero-terminated.
/// Pointers: message is NULL or valid for writing size bytes.
pub(super) unsafe fn write_message(text: &str, message: *mut c_char, size: usize) {
    if message.is_null() || size == 0 {
        return;
    }
    let room = text.len().min(size - 1);
    let length = (0..=room).rev().find(|&at| text.is_char_boundary(at)).unwrap_or(0);
    // SAFETY: length < size, and the caller promised `size` bytes.
    unsafe {
        std::ptr::copy_nonoverlapping(text.as_ptr().cast(), message, length);
        message.add(length).write(0);
    }
}
