//! Particles over the C boundary: creation, release and what can be asked of one.

use super::fence::{borrow, fenced, output};
use super::status::*;
use super::types::{pp_mass_properties, pp_pose};
use crate::pair::pose::{Pose, PoseError};
use crate::particle::particle::{Particle, ParticleError, Plane};
use nalgebra::Vector3;
use std::ffi::c_char;

/// A validated particle. Created by `pp_particle_new`, released by `pp_particle_free`; immutable,
/// so that bodies and threads may share one.
pub struct pp_particle(pub(super) Particle);

/// Most planes that a particle may have.
pub const PP_MAX_PLANES: usize = 65536;
const _: () = assert!(PP_MAX_PLANES == crate::particle::particle::MAX_PLANES);

/// Size of a message buffer that holds every message whole.
pub const PP_MESSAGE_SIZE: usize = 512;

/// Creates a particle from `count` planes.
///
/// planes: count rows of a, b, c, d (outward normal and offset; local frame; the normal is used as
/// given). May be NULL when count is 0.
/// r: rounding radius, length. k: sphericity, in [0, 1]. shadow_radius: R, length.
/// out: receives the particle; release it with `pp_particle_free`.
/// message: receives, on failure, a sentence that names the plane or value (may be NULL).
/// Errors: `PP_NULL_POINTER`, `PP_PLANE_NOT_FINITE`, `PP_PLANE_ZERO_NORMAL`, `PP_BAD_SPHERICITY`,
/// `PP_BAD_ROUNDING_RADIUS`, `PP_BAD_SHADOW_RADIUS`, `PP_CENTRE_OUTSIDE`, `PP_UNBOUNDED`,
/// `PP_TOO_MANY_PLANES`.
///
/// # Safety
/// `planes` points to 4*count doubles, `out` to one pointer, `message` to `message_size` bytes.
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
    let explain = |text: &str| unsafe { write_message(text, message, message_size) };
    let status = fenced(|| {
        let out = unsafe { output(out) }?;
        if count > PP_MAX_PLANES {
            explain(&ParticleError::TooManyPlanes(count).to_string());
            return Err(PP_TOO_MANY_PLANES);
        }
        let planes: Vec<Plane> = if count == 0 {
            Vec::new()
        } else {
            if planes.is_null() {
                return Err(PP_NULL_POINTER);
            }
            // SAFETY: not NULL, and the caller promised 4*count doubles. From the pointer itself: one that went
            // through a reference to the first double would be good for that one only.
            let rows = unsafe { std::slice::from_raw_parts(planes, 4 * count) };
            rows.as_chunks::<4>().0.iter().map(|&row| Plane::from(row)).collect()
        };
        let particle = Particle::new(&planes, r, k, shadow_radius).map_err(|error| {
            explain(&error.to_string());
            particle_status(&error)
        })?;
        out.write(Box::into_raw(Box::new(pp_particle(particle))));
        Ok(())
    });
    if status == PP_NULL_POINTER {
        explain("planes and out must not be NULL");
    }
    status
}

/// Releases a particle; NULL is allowed and does nothing. No pair may still be using it.
///
/// # Safety
/// `particle` is NULL or came from `pp_particle_new` and was not released yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_free(particle: *mut pp_particle) {
    if !particle.is_null() {
        // SAFETY: by contract this came from Box::into_raw and is freed once.
        drop(unsafe { Box::from_raw(particle) });
    }
}

/// f = S - 1 at a world point (3 doubles), and its gradient (3 doubles, world axes, 1/length; may
/// be NULL).
///
/// f < 0 inside, 0 on the surface, > 0 outside.
/// Errors: `PP_NULL_POINTER`, `PP_BAD_POSITION`, `PP_BAD_ORIENTATION`, `PP_BAD_POINT`.
///
/// # Safety
/// Pointers are NULL or valid: `point` for reading 3 doubles, `f` and `gradient` for writing 1 and 3.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_potential(
    particle: *const pp_particle,
    pose: *const pp_pose,
    point: *const f64,
    f: *mut f64,
    gradient: *mut f64,
) -> pp_status {
    fenced(|| {
        let particle = &unsafe { borrow(particle) }?.0;
        let pose = pose_from(unsafe { borrow(pose) }?)?;
        let point = finite(unsafe { triple(point) }?)?;
        let f = unsafe { output(f) }?;
        let x = pose.to_local(&point);
        f.write(particle.potential(&x));
        if let Ok(gradient) = unsafe { output(gradient.cast::<[f64; 3]>()) } {
            gradient.write(pose.rotate(&particle.gradient(&x)).into());
        }
        Ok(())
    })
}

/// Axis-aligned box in world axes that holds the particle at this pose: the box of its corners.
///
/// lower, upper: receive 3 doubles each, world frame.
/// Errors: `PP_NULL_POINTER`, `PP_BAD_POSITION`, `PP_BAD_ORIENTATION`.
///
/// # Safety
/// Pointers are NULL or valid; `lower` and `upper` for writing 3 doubles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_box(
    particle: *const pp_particle,
    pose: *const pp_pose,
    lower: *mut f64,
    upper: *mut f64,
) -> pp_status {
    fenced(|| {
        let particle = &unsafe { borrow(particle) }?.0;
        let pose = pose_from(unsafe { borrow(pose) }?)?;
        let (lower, upper) = unsafe { (output(lower.cast::<[f64; 3]>())?, output(upper.cast::<[f64; 3]>())?) };
        let (low, high) = particle.bounding_box(&pose);
        lower.write(low.into());
        upper.write(high.into());
        Ok(())
    })
}

/// Radius about the centre of a ball that holds the particle, length.
///
/// Errors: `PP_NULL_POINTER`.
///
/// # Safety
/// Pointers are NULL or valid.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_bounding_radius(particle: *const pp_particle, radius: *mut f64) -> pp_status {
    fenced(|| {
        let particle = &unsafe { borrow(particle) }?.0;
        unsafe { output(radius) }?.write(particle.bounding_radius());
        Ok(())
    })
}

/// Corners, local frame, of a polyhedron that holds the particle: rows of x, y, z.
///
/// corners: room for `capacity` rows; may be NULL when capacity is 0. count: receives the number of
/// corners, also when the buffer is too small (`PP_BUFFER_TOO_SMALL`), so that one call asks the size.
/// Errors: `PP_NULL_POINTER`, `PP_BUFFER_TOO_SMALL`.
///
/// # Safety
/// Pointers are NULL or valid; `corners` for writing 3*capacity doubles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_corners(
    particle: *const pp_particle,
    corners: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> pp_status {
    fenced(|| {
        let particle = &unsafe { borrow(particle) }?.0;
        let count = unsafe { output(count) }?;
        let from = particle.bounding_corners();
        if from.len() > capacity {
            count.write(from.len());
            return Err(PP_BUFFER_TOO_SMALL);
        }
        unsafe { borrow(corners.cast_const()) }?;
        for (i, corner) in from.iter().enumerate() {
            // SAFETY: i < capacity, and the caller promised 3*capacity doubles.
            unsafe { corners.cast::<[f64; 3]>().add(i).write_unaligned((*corner).into()) };
        }
        count.write(from.len());
        Ok(())
    })
}

/// Distance from the centre to the surface along a direction (3 doubles, local frame, any length).
///
/// With it, direction * distance walks over the true surface: for meshes and pictures.
/// Errors: `PP_NULL_POINTER`, `PP_BAD_POINT`.
///
/// # Safety
/// Pointers are NULL or valid; `direction` for reading 3 doubles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_surface_distance(
    particle: *const pp_particle,
    direction: *const f64,
    distance: *mut f64,
) -> pp_status {
    fenced(|| {
        let particle = &unsafe { borrow(particle) }?.0;
        let direction = finite(unsafe { triple(direction) }?)?;
        let distance = unsafe { output(distance) }?;
        // Scaled first, so that the squares stay in range.
        let scaled = direction / direction.amax();
        let unit = scaled.try_normalize(0.5).ok_or(PP_BAD_POINT)?;
        distance.write(crate::particle::ray_cast::distance(particle, &Vector3::zeros(), &unit).ok_or(PP_BAD_POINT)?);
        Ok(())
    })
}

/// Volume, centroid and inertia for unit density, by quadrature over the true surface (relative
/// error about 1e-4 for sharp shapes, less for round ones).
///
/// Errors: `PP_NULL_POINTER`.
///
/// # Safety
/// Pointers are NULL or valid.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_mass_properties(
    particle: *const pp_particle,
    properties: *mut pp_mass_properties,
) -> pp_status {
    fenced(|| {
        let particle = &unsafe { borrow(particle) }?.0;
        let out = unsafe { output(properties) }?;
        let mass = particle.mass_properties();
        let i = mass.inertia;
        out.write(pp_mass_properties {
            volume: mass.volume,
            centroid: mass.centroid.into(),
            inertia: [i.m11, i.m22, i.m33, i.m12, i.m23, i.m13],
        });
        Ok(())
    })
}

pub(super) fn pose_from(pose: &pp_pose) -> Result<Pose, pp_status> {
    Pose::new(pose.position, pose.orientation).map_err(|error| match error {
        PoseError::Position(..) => PP_BAD_POSITION,
        PoseError::Orientation(..) | PoseError::Rotation(_) => PP_BAD_ORIENTATION,
    })
}

/// Three doubles behind a pointer, or `PP_NULL_POINTER`.
///
/// # Safety
/// `pointer` is NULL or valid for reading 3 doubles.
unsafe fn triple<'a>(pointer: *const f64) -> Result<&'a [f64; 3], pp_status> {
    unsafe { borrow(pointer.cast::<[f64; 3]>()) }
}

fn finite(v: &[f64; 3]) -> Result<Vector3<f64>, pp_status> {
    if v.iter().all(|c| c.is_finite()) { Ok(Vector3::from(*v)) } else { Err(PP_BAD_POINT) }
}

pub(super) fn particle_status(error: &ParticleError) -> pp_status {
    match error {
        ParticleError::PlaneNotFinite { .. } | ParticleError::LineNotFinite { .. } => PP_PLANE_NOT_FINITE,
        ParticleError::ZeroNormal { .. } | ParticleError::ZeroLineNormal { .. } => PP_PLANE_ZERO_NORMAL,
        ParticleError::NormalLength { .. } | ParticleError::LineNormalLength { .. } => PP_PLANE_ZERO_NORMAL,
        ParticleError::Sphericity(_) => PP_BAD_SPHERICITY,
        ParticleError::RoundingRadius(_) => PP_BAD_ROUNDING_RADIUS,
        ParticleError::ShadowRadius(_) => PP_BAD_SHADOW_RADIUS,
        ParticleError::CentreOutside { .. } | ParticleError::CentreOutsideLines { .. } => PP_CENTRE_OUTSIDE,
        ParticleError::Unbounded | ParticleError::OpenLines => PP_UNBOUNDED,
        ParticleError::TooManyPlanes(_) | ParticleError::TooManyLines(_) => PP_TOO_MANY_PLANES,
    }
}

/// Copies as much of `text` as fits, always zero-terminated.
///
/// # Safety
/// `message` is NULL or valid for writing `size` bytes.
pub(super) unsafe fn write_message(text: &str, message: *mut c_char, size: usize) {
    if message.is_null() || size == 0 {
        return;
    }
    let length = text.floor_char_boundary(size - 1);
    // SAFETY: length < size, and the caller promised `size` bytes.
    unsafe {
        std::ptr::copy_nonoverlapping(text.as_ptr().cast(), message, length);
        message.add(length).write(0);
    }
}
