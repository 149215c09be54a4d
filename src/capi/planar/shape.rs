//! What can be asked of a particle of the plane.

use super::particle::{pp_particle_2d, pp_pose_2d};
use crate::capi::convert::finite;
use crate::capi::fence::give;
use crate::capi::output::IfWanted;
use crate::capi::status::*;
use nalgebra::Vector2;

/// Area and second moments of a particle of the plane of unit density, in its local frame.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_area_properties {
    /// Area, length^2.
    pub area: f64,
    /// Centroid, local frame.
    pub centroid: [f64; 2],
    /// xx, yy, xy of the integral of x x^T dA about the local origin, length^4. xx + yy is the moment of inertia
    /// of a body that turns in the plane.
    pub second_moment: [f64; 3],
    /// Estimated bound on the relative error, as in struct pp_mass_properties.
    pub error: f64,
}

/// f = S - 1 at a world point (2 doubles), and its gradient (2 doubles, world axes, 1/length; may
/// be NULL).
///
/// f < 0 inside, 0 on the boundary, > 0 outside.
/// Errors: PP_NULL_POINTER, PP_BAD_POSITION, PP_BAD_ORIENTATION, PP_BAD_POINT.
/// Pointers: Pointers are NULL or valid: point for reading 2 doubles, f and gradient for writing 1 and 2.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_potential_2d(
    particle: *const pp_particle_2d,
    pose: *const pp_pose_2d,
    point: *const f64,
    f: *mut f64,
    gradient: *mut f64,
) -> pp_status {
    give!((f, IfWanted(gradient)), [particle, pose, point], {
        let x = pose.to_local(&finite(point)?);
        Ok((particle.potential(&x), move || pose.rotate(&particle.gradient(&x))))
    })
}

/// Radius about the centre of a circle that holds the particle, length: two particles whose centres are
/// further apart than both radii together need no call of pp_contact_detect_2d.
///
/// Errors: PP_NULL_POINTER.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_bounding_radius_2d(
    particle: *const pp_particle_2d,
    radius: *mut f64,
) -> pp_status {
    give!(radius, [particle], Ok(particle.bounding_radius()))
}

/// Axis-aligned box in world axes that holds the particle at this pose: the box of its corners.
///
/// Pointers: lower and upper receive 2 doubles each, world frame.
/// Errors: PP_NULL_POINTER, PP_BAD_POSITION, PP_BAD_ORIENTATION.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_box_2d(
    particle: *const pp_particle_2d,
    pose: *const pp_pose_2d,
    lower: *mut f64,
    upper: *mut f64,
) -> pp_status {
    give!((lower, upper), [particle, pose], Ok(particle.bounding_box(&pose)))
}

/// Corners, local frame, of a polygon that holds the particle: rows of x, y.
///
/// corners: room for capacity rows; may be NULL when capacity is 0. count: receives the number of
/// corners, also when the buffer is too small (PP_BUFFER_TOO_SMALL), so that one call asks the size.
/// Pointers: corners is valid for writing 2*capacity doubles.
/// Errors: PP_NULL_POINTER, PP_BUFFER_TOO_SMALL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_corners_2d(
    particle: *const pp_particle_2d,
    corners: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> pp_status {
    give!((corners, capacity, count), [particle], Ok(particle.bounding_corners()))
}

/// Distance from the centre to the boundary along a direction (2 doubles, local frame, any length).
///
/// Pointers: direction is valid for reading 2 doubles.
/// Errors: PP_NULL_POINTER, PP_BAD_POINT.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_surface_distance_2d(
    particle: *const pp_particle_2d,
    direction: *const f64,
    distance: *mut f64,
) -> pp_status {
    give!(distance, [particle, direction], {
        particle.surface_distance(&Vector2::zeros(), &Vector2::from(*direction)).ok_or(PP_BAD_POINT)
    })
}

/// Area, centroid and second moments for unit density, in closed form. The tolerance, as in
/// pp_particle_mass_properties, counts where rounding leaves more than that: there a fine polygon answers.
///
/// Errors: PP_NULL_POINTER, PP_BAD_SETTING.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_area_properties_2d(
    particle: *const pp_particle_2d,
    tolerance: f64,
    properties: *mut pp_area_properties,
) -> pp_status {
    give!(properties, [particle], {
        let found = particle.area_properties(tolerance).map_err(|_| PP_BAD_SETTING)?;
        let second = found.second_moment;
        Ok(pp_area_properties {
            area: found.area,
            centroid: found.centroid.into(),
            second_moment: [second.m11, second.m22, second.m12],
            error: found.error,
        })
    })
}

/// Points of the boundary, local frame, in order: rows of x, y. The chord between neighbouring points is
/// nowhere farther than tolerance (length, above 0) from the boundary, unless that takes more than about a
/// million points: refinement ends there.
///
/// points: room for capacity rows; may be NULL when capacity is 0. count: receives the number of
/// points, also when the buffer is too small (PP_BUFFER_TOO_SMALL), so that one call asks the size.
/// Pointers: points is valid for writing 2*capacity doubles.
/// Errors: PP_NULL_POINTER, PP_BAD_SETTING, PP_BUFFER_TOO_SMALL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_outline_2d(
    particle: *const pp_particle_2d,
    tolerance: f64,
    points: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> pp_status {
    give!((points, capacity, count), [particle], {
        particle.outline(tolerance).map(Vec::into_iter).map_err(|_| PP_BAD_SETTING)
    })
}
