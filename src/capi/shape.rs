//! What can be asked of a particle: potential, bounds, surface, mass.

use super::convert::finite;
use super::fence::give;
use super::output::IfWanted;
use super::particle::pp_particle;
use super::status::*;
use super::types::{pp_mass_properties, pp_pose};
use nalgebra::Vector3;

/// f = S - 1 at a world point (3 doubles), and its gradient (3 doubles, world axes, 1/length; may
/// be NULL).
///
/// f < 0 inside, 0 on the surface, > 0 outside.
/// Errors: PP_NULL_POINTER, PP_BAD_POSITION, PP_BAD_ORIENTATION, PP_BAD_POINT.
/// Pointers: Pointers are NULL or valid: point for reading 3 doubles, f and gradient for writing 1 and 3.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_potential(
    particle: *const pp_particle,
    pose: *const pp_pose,
    point: *const f64,
    f: *mut f64,
    gradient: *mut f64,
) -> pp_status {
    give!((f, IfWanted(gradient)), [particle, pose, point], {
        let x = pose.to_local(&finite(point)?);
        Ok((particle.potential(&x), move || pose.rotate(&particle.gradient(&x))))
    })
}

/// Axis-aligned box, world axes, that holds the particle at this pose: that of the corners of
/// pp_particle_corners.
///
/// lower, upper: receive 3 doubles each, world frame.
/// Errors: PP_NULL_POINTER, PP_BAD_POSITION, PP_BAD_ORIENTATION.
/// Pointers: Pointers are NULL or valid; lower and upper for writing 3 doubles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_box(
    particle: *const pp_particle,
    pose: *const pp_pose,
    lower: *mut f64,
    upper: *mut f64,
) -> pp_status {
    give!((lower, upper), [particle, pose], Ok(particle.bounding_box(&pose)))
}

/// Radius about the centre of a ball that holds the particle, length.
///
/// Errors: PP_NULL_POINTER.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_bounding_radius(particle: *const pp_particle, radius: *mut f64) -> pp_status {
    give!(radius, [particle], Ok(particle.bounding_radius()))
}

/// Whether the planes alone enclose a volume: 1, or 0 where only the shadow sphere bounds the particle,
/// at R/sqrt(k).
///
/// That is valid for k > 0, and seldom meant where there are planes: one may have been left out.
/// Errors: PP_NULL_POINTER.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_planes_enclose(particle: *const pp_particle, enclose: *mut i32) -> pp_status {
    give!(enclose, [particle], Ok(i32::from(particle.planes_enclose())))
}

/// Corners, local frame, of a polyhedron that holds the particle: rows of x, y, z.
///
/// corners: room for capacity rows; may be NULL when capacity is 0. count: receives the number of
/// corners, also when the buffer is too small (PP_BUFFER_TOO_SMALL), so that one call asks the size.
/// Pointers: corners is valid for writing 3*capacity doubles.
/// Errors: PP_NULL_POINTER, PP_BUFFER_TOO_SMALL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_corners(
    particle: *const pp_particle,
    corners: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> pp_status {
    give!((corners, capacity, count), [particle], Ok(particle.bounding_corners().iter().copied()))
}

/// How far the particle reaches along a direction (3 doubles, local frame, any length): an upper bound of e .
/// x over all its points x, where e = direction / |direction|. It follows from the corners of
/// pp_particle_corners.
///
/// Errors: PP_NULL_POINTER, PP_BAD_POINT.
/// Pointers: direction points to 3 doubles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_support(
    particle: *const pp_particle,
    direction: *const f64,
    support: *mut f64,
) -> pp_status {
    give!(support, [particle, direction], particle.support(&Vector3::from(*direction)).ok_or(PP_BAD_POINT))
}

/// Distance from the centre to the surface along a direction (3 doubles, local frame, any length).
///
/// The surface point is distance * direction / |direction|, local frame: for meshes and pictures.
/// Errors: PP_NULL_POINTER, PP_BAD_POINT.
/// Pointers: Pointers are NULL or valid; direction for reading 3 doubles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_surface_distance(
    particle: *const pp_particle,
    direction: *const f64,
    distance: *mut f64,
) -> pp_status {
    give!(distance, [particle, direction], {
        particle.surface_distance(&Vector3::zeros(), &Vector3::from(*direction)).ok_or(PP_BAD_POINT)
    })
}

/// Volume, centroid and inertia for unit density, by adaptive quadrature over the true surface.
///
/// tolerance: relative, 1e-12 to 1; 1e-6 is usual and takes milliseconds for some tens of planes. Where it
/// cannot be reached, the error of the properties says so.
/// Errors: PP_NULL_POINTER, PP_BAD_SETTING.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_mass_properties(
    particle: *const pp_particle,
    tolerance: f64,
    properties: *mut pp_mass_properties,
) -> pp_status {
    give!(properties, [particle], {
        let mass = particle.mass_properties(tolerance).map_err(|_| PP_BAD_SETTING)?;
        Ok(pp_mass_properties::from(&mass))
    })
}
