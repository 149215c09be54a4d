//! What can be asked of a particle of the plane.

use super::convert::{finite, pose_from};
use super::particle::pp_particle_2d;
use super::types::{pp_area_properties, pp_pose_2d};
use crate::capi::fence::{borrow, fenced, output, read, write_rows};
use crate::capi::status::*;
use nalgebra::Vector2;

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
    fenced(|| {
        let particle = &unsafe { borrow(particle) }?.0;
        let pose = pose_from(unsafe { borrow(pose) }?)?;
        let point = finite(unsafe { borrow(point.cast::<[f64; 2]>()) }?)?;
        let f = unsafe { output(f) }?;
        let x = pose.to_local(&point);
        f.write(particle.potential(&x));
        if let Ok(gradient) = unsafe { output(gradient.cast::<[f64; 2]>()) } {
            gradient.write(pose.rotate(&particle.gradient(&x)).into());
        }
        Ok(())
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
    // SAFETY: as promised.
    unsafe { read(particle, radius, |particle| particle.0.bounding_radius()) }
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
    fenced(|| {
        let particle = &unsafe { borrow(particle) }?.0;
        let pose = pose_from(unsafe { borrow(pose) }?)?;
        let (lower, upper) = unsafe { (output(lower.cast::<[f64; 2]>())?, output(upper.cast::<[f64; 2]>())?) };
        let (low, high) = particle.bounding_box(&pose);
        lower.write(low.into());
        upper.write(high.into());
        Ok(())
    })
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
    fenced(|| {
        let particle = &unsafe { borrow(particle) }?.0;
        let rows = particle.bounding_corners().map(|corner| corner.into());
        // SAFETY: the caller promised 2*capacity doubles.
        unsafe { write_rows(rows, corners, capacity, count) }
    })
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
    fenced(|| {
        let particle = &unsafe { borrow(particle) }?.0;
        let direction = unsafe { borrow(direction.cast::<[f64; 2]>()) }?;
        let distance = unsafe { output(distance) }?;
        distance.write(particle.surface_distance(&Vector2::zeros(), &(*direction).into()).ok_or(PP_BAD_POINT)?);
        Ok(())
    })
}

/// Area, centroid and second moments for unit density; tolerance as in pp_particle_mass_properties.
///
/// Errors: PP_NULL_POINTER, PP_BAD_SETTING.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_area_properties_2d(
    particle: *const pp_particle_2d,
    tolerance: f64,
    properties: *mut pp_area_properties,
) -> pp_status {
    fenced(|| {
        let particle = &unsafe { borrow(particle) }?.0;
        let out = unsafe { output(properties) }?;
        let found = particle.area_properties(tolerance).map_err(|_| PP_BAD_SETTING)?;
        let second = found.second_moment;
        out.write(pp_area_properties {
            area: found.area,
            centroid: found.centroid.into(),
            second_moment: [second.m11, second.m22, second.m12],
            error: found.error,
        });
        Ok(())
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
    fenced(|| {
        let particle = &unsafe { borrow(particle) }?.0;
        let outline = particle.outline(tolerance).map_err(|_| PP_BAD_SETTING)?;
        let rows: Vec<[f64; 2]> = outline.into_iter().map(|point| point.into()).collect();
        // SAFETY: the caller promised 2*capacity doubles.
        unsafe { write_rows(rows.into_iter(), points, capacity, count) }
    })
}
