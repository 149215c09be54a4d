//! Particles of the plane over the C boundary.

use super::contact::{back_end_code, detect_status, formulation_code, kind_code, settings_from};
use super::fence::{borrow, fenced, output};
use super::particle::{PP_MAX_PLANES, particle_status, write_message};
use super::status::*;
use super::types::{PP_OVERLAPPING, PP_SEPARATED, pp_memory, pp_settings};
use crate::pair::warm_start::Memory;
use crate::particle::particle::ParticleError;
use crate::planar::{Contact, Line, Particle, Pose, PoseError, Section, detect};
use crate::settings::Settings;
use nalgebra::Vector2;
use std::ffi::c_char;

/// A validated particle of the plane. Created by `pp_particle_new_2d`, released by
/// `pp_particle_free_2d`; immutable, so that bodies and threads may share one.
pub struct pp_particle_2d(Particle);

/// Where a body of the plane is: world = rotation(angle) * local + position.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_pose_2d {
    /// Centre of the particle (origin of its local frame), world frame, length units of the caller.
    pub position: [f64; 2],
    /// Angle from world to local axes, radians, anticlockwise; any finite number.
    pub angle: f64,
}

/// The answer for one pair of the plane: the fields of struct pp_contact but distance, with vectors of two.
/// Frames: world axes unless said otherwise; lengths in the caller's unit; s, weight and gap have no
/// unit. Fields that do not apply are NaN.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_contact_2d {
    /// `PP_SEPARATED` or `PP_OVERLAPPING`. A failed solve has no kind: it returns a status.
    pub kind: i32,
    /// The formulation that the geometry below answers (`PP_MIDWAY` if `PP_FLAG_SLACK` is set).
    pub formulation: u32,
    /// The back end that answered: `PP_FAST` or `PP_CONIC`.
    pub back_end: u32,
    /// Sum of PP_FLAG_... bits.
    pub flags: u32,
    /// Evaluations of the two potentials (fast) or interior-point iterations (conic).
    pub iterations: u32,
    /// Always 0.
    pub reserved: u32,
    /// Midway: t, the common scale at which the two particles touch at one point; t < 1 overlap.
    /// Closest: s_A at P2. Rejected pairs: a lower bound, >= 1. No unit.
    pub s: f64,
    /// Closest: s_B at P1; NaN for midway.
    pub s_b: f64,
    /// Weight u of B, in [0, 1]: (1-u) grad S_A + u grad S_B = 0 at the solution.
    pub weight: f64,
    /// Proved bound on the error of s, from this answer's own numbers: |s - s*| <= gap.
    pub gap: f64,
    /// Bound on the distance of the point (closest: of each of P1 and P2) to the exact optimum, length.
    pub point_bound: f64,
    /// Overlap (YADE: penetrationDepth), length, > 0 when overlapping; NaN when separated.
    pub overlap: f64,
    /// Unit contact normal, from A to B (positive force on B pushes it along +normal).
    pub normal: [f64; 2],
    /// Contact point, world frame: P3 of midway, or the weighted mean of P1 and P2 of closest.
    pub point: [f64; 2],
    /// Contact point minus position of A: exact lever arm even far from the world origin.
    pub branch_a: [f64; 2],
    /// Contact point minus position of B.
    pub branch_b: [f64; 2],
    /// Point on the boundary of A inside B, world frame; P1 of closest. NaN when separated.
    pub point_on_a: [f64; 2],
    /// Point on the boundary of B inside A, world frame; P2 of closest. NaN when separated.
    pub point_on_b: [f64; 2],
}

/// Creates a particle of the plane from `count` lines a x + b y = d.
///
/// With S(x) = (1-k)/r^2 * sum <a x + b y - d>^2 + k/R^2 * |x|^2 all else is as in
/// `pp_particle_new`, and the codes of planes stand for lines.
/// lines: count rows of a, b, d (outward normal and offset; local frame; the normal is used as
/// given). May be NULL when count is 0.
/// r: rounding radius, length. k: sphericity, in [0, 1]. shadow_radius: R, length.
/// out: receives the particle; release it with `pp_particle_free_2d`.
/// message: receives, on failure, a sentence that names the line or value (may be NULL).
/// Errors: `PP_NULL_POINTER`, `PP_PLANE_NOT_FINITE`, `PP_PLANE_ZERO_NORMAL`, `PP_BAD_SPHERICITY`,
/// `PP_BAD_ROUNDING_RADIUS`, `PP_BAD_SHADOW_RADIUS`, `PP_CENTRE_OUTSIDE`, `PP_UNBOUNDED` (k = 0 and
/// the lines enclose no area), `PP_TOO_MANY_PLANES`.
///
/// # Safety
/// `lines` points to 3*count doubles, `out` to one pointer, `message` to `message_size` bytes.
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
    let explain = |text: &str| unsafe { write_message(text, message, message_size) };
    let status = fenced(|| {
        let out = unsafe { output(out) }?;
        if count > PP_MAX_PLANES {
            explain(&ParticleError::TooManyLines(count).to_string());
            return Err(PP_TOO_MANY_PLANES);
        }
        let lines: Vec<Line> = if count == 0 {
            Vec::new()
        } else {
            if lines.is_null() {
                return Err(PP_NULL_POINTER);
            }
            // SAFETY: not NULL, and the caller promised 3*count doubles. From the pointer itself: one that went
            // through a reference to the first double would be good for that one only.
            let rows = unsafe { std::slice::from_raw_parts(lines, 3 * count) };
            rows.as_chunks::<3>().0.iter().map(|&row| Line::from(row)).collect()
        };
        let particle = Particle::new(&lines, r, k, shadow_radius).map_err(|error| {
            explain(&error.to_string());
            particle_status(&error)
        })?;
        out.write(Box::into_raw(Box::new(pp_particle_2d(particle))));
        Ok(())
    });
    if status == PP_NULL_POINTER {
        explain("lines and out must not be NULL");
    }
    status
}

/// Releases a particle of the plane; NULL is allowed and does nothing. No pair may still be using it.
///
/// # Safety
/// `particle` is NULL or came from `pp_particle_new_2d` and was not released yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_free_2d(particle: *mut pp_particle_2d) {
    if !particle.is_null() {
        // SAFETY: by contract this came from Box::into_raw and is freed once.
        drop(unsafe { Box::from_raw(particle) });
    }
}

/// f = S - 1 at a world point (2 doubles), and its gradient (2 doubles, world axes, 1/length; may
/// be NULL).
///
/// f < 0 inside, 0 on the boundary, > 0 outside.
/// Errors: `PP_NULL_POINTER`, `PP_BAD_POSITION`, `PP_BAD_ORIENTATION`, `PP_BAD_POINT`.
///
/// # Safety
/// Pointers are NULL or valid: `point` for reading 2 doubles, `f` and `gradient` for writing 1 and 2.
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
        let point = Vector2::from(*unsafe { borrow(point.cast::<[f64; 2]>()) }?);
        if !point.iter().all(|c| c.is_finite()) {
            return Err(PP_BAD_POINT);
        }
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
/// further apart than both radii together need no call of `pp_contact_detect_2d`.
///
/// Errors: `PP_NULL_POINTER`.
///
/// # Safety
/// Pointers are NULL or valid.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_bounding_radius_2d(
    particle: *const pp_particle_2d,
    radius: *mut f64,
) -> pp_status {
    fenced(|| {
        let particle = &unsafe { borrow(particle) }?.0;
        unsafe { output(radius) }?.write(particle.bounding_radius());
        Ok(())
    })
}

/// Finds the contact of particle A at `pose_a` with particle B at `pose_b`, both of the plane.
///
/// settings: may be NULL (defaults). memory: may be NULL; else what this ordered pair remembers,
/// read and updated. out: the answer; see struct pp_contact_2d for frames, units and signs.
/// Errors: `PP_NULL_POINTER`, `PP_BAD_POSITION`, `PP_BAD_ORIENTATION` (an angle that is not finite),
/// `PP_UNKNOWN_FORMULATION`, `PP_UNKNOWN_BACK_END`, `PP_BAD_SETTING`, `PP_SOLVER_FAILED`.
///
/// # Safety
/// Pointers are NULL or valid; `memory` and `out` are not used by another call at the same time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_contact_detect_2d(
    a: *const pp_particle_2d,
    pose_a: *const pp_pose_2d,
    b: *const pp_particle_2d,
    pose_b: *const pp_pose_2d,
    settings: *const pp_settings,
    memory: *mut pp_memory,
    out: *mut pp_contact_2d,
) -> pp_status {
    fenced(|| {
        let (a, b) = unsafe { (&borrow(a)?.0, &borrow(b)?.0) };
        let (pose_a, pose_b) = unsafe { (pose_from(borrow(pose_a)?)?, pose_from(borrow(pose_b)?)?) };
        let out = unsafe { output(out) }?;
        let settings = match unsafe { settings.as_ref() } {
            Some(settings) => settings_from(settings)?,
            None => Settings::default(),
        };
        // SAFETY: NULL or exclusively ours for the call.
        let memory = unsafe { memory.as_mut() };
        let mut remembered = memory.as_ref().map(|m| Memory::from_raw(m.state));
        let contact =
            detect(a, &pose_a, b, &pose_b, &settings, remembered.as_mut()).map_err(|error| detect_status(&error))?;
        if let (Some(memory), Some(remembered)) = (memory, remembered) {
            memory.state = remembered.into_raw();
        }
        out.write(contact_to(&contact));
        Ok(())
    })
}

/// Contact length (YADE: jointLength): how much of the line through the contact point, normal to the
/// contact normal, lies in both particles.
///
/// contact: an overlapping answer of `pp_contact_detect_2d` for the same particles and poses.
/// length: receives a length; 0 when separated. Exact to rounding.
/// Errors: `PP_NULL_POINTER`, `PP_BAD_POSITION`, `PP_BAD_ORIENTATION`, `PP_BAD_POINT` (the contact
/// was not filled: no kind, point or normal).
///
/// # Safety
/// Pointers are NULL or valid.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_contact_length_2d(
    a: *const pp_particle_2d,
    pose_a: *const pp_pose_2d,
    b: *const pp_particle_2d,
    pose_b: *const pp_pose_2d,
    contact: *const pp_contact_2d,
    length: *mut f64,
) -> pp_status {
    fenced(|| {
        let (a, b) = unsafe { (&borrow(a)?.0, &borrow(b)?.0) };
        let (pose_a, pose_b) = unsafe { (pose_from(borrow(pose_a)?)?, pose_from(borrow(pose_b)?)?) };
        let contact = unsafe { borrow(contact) }?;
        let out = unsafe { output(length) }?;
        match contact.kind {
            PP_OVERLAPPING => {}
            PP_SEPARATED => {
                out.write(0.0);
                return Ok(());
            }
            _ => return Err(PP_BAD_POINT),
        }
        let section = Section {
            branch_a: contact.branch_a.into(),
            branch_b: contact.branch_b.into(),
            normal: contact.normal.into(),
        };
        out.write(section.length(a, &pose_a, b, &pose_b).ok_or(PP_BAD_POINT)?);
        Ok(())
    })
}

fn pose_from(pose: &pp_pose_2d) -> Result<Pose, pp_status> {
    Pose::new(pose.position, pose.angle).map_err(|error| match error {
        PoseError::Position(..) => PP_BAD_POSITION,
        PoseError::Angle(_) => PP_BAD_ORIENTATION,
    })
}

fn contact_to(contact: &Contact) -> pp_contact_2d {
    pp_contact_2d {
        kind: kind_code(contact.kind),
        formulation: formulation_code(contact.formulation),
        back_end: back_end_code(contact.back_end),
        flags: contact.flags.bits(),
        iterations: contact.iterations,
        reserved: 0,
        s: contact.s,
        s_b: contact.s_b,
        weight: contact.weight,
        gap: contact.gap,
        point_bound: contact.point_bound,
        overlap: contact.overlap,
        normal: contact.normal.into(),
        point: contact.point.into(),
        branch_a: contact.branch_a.into(),
        branch_b: contact.branch_b.into(),
        point_on_a: contact.point_on_a.into(),
        point_on_b: contact.point_on_b.into(),
    }
}
