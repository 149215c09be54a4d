//! The contacts of one pair of the plane and of many, its length, and one closest point alone.

use super::particle::{pp_particle_2d, pp_pose_2d};
use crate::capi::batch::detect_batch;
use crate::capi::convert::{detect_status, role_from};
use crate::capi::fence::{call, give};
use crate::capi::status::*;
use crate::capi::types::{pp_closest_2d, pp_contact_2d, pp_pair_state, pp_settings};
use crate::planar::{ClosestPoint, Contact, Particle, Pose, Section, closest_point, detect};
use crate::{Kind, PairState, Settings};
use std::mem::MaybeUninit;

/// Finds the contact of particle A at pose_a with particle B at pose_b, both of the plane.
///
/// settings, state: may be NULL, and are as of pp_contact_detect. out: the answer; see struct pp_contact_2d
/// for frames, units and signs.
/// Pointers: state and out are not used by another call at the same time.
/// Errors: PP_NULL_POINTER, PP_BAD_POSITION, PP_BAD_ORIENTATION (an angle that is not finite or beyond 2^30),
/// PP_UNKNOWN_FORMULATION, PP_UNKNOWN_BACK_END, PP_NO_CONE_PROGRAM, PP_BAD_SETTING, PP_SOLVER_FAILED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_contact_detect_2d(
    a: *const pp_particle_2d,
    pose_a: *const pp_pose_2d,
    b: *const pp_particle_2d,
    pose_b: *const pp_pose_2d,
    settings: *const pp_settings,
    state: *mut pp_pair_state,
    out: *mut pp_contact_2d,
) -> pp_status {
    // One body after the other, as of a batch.
    call!([a, pose_a, b, pose_b, out, settings, state], contact((a, &pose_a), (b, &pose_b), settings, state, out))
}

/// Finds one contact and writes it.
pub(super) fn contact(
    a: (&Particle, &Pose),
    b: (&Particle, &Pose),
    settings: &Settings,
    state: Option<&mut PairState>,
    out: &mut MaybeUninit<Contact>,
) -> Result<(), pp_status> {
    let found = detect(a.0, a.1, b.0, b.1, settings, state).map_err(detect_status)?;
    out.write(found);
    Ok(())
}

/// Finds the contacts of many pairs of bodies of the plane: pp_contact_detect_batch with two coordinates,
/// where every argument, status and error is explained.
///
/// Each contact and state is, to the last bit, that of pp_contact_detect_2d for the pair alone, whatever
/// the number of threads.
/// Errors: PP_NULL_POINTER, PP_UNKNOWN_FORMULATION, PP_UNKNOWN_BACK_END, PP_NO_CONE_PROGRAM, PP_BAD_SETTING,
/// PP_BAD_INDEX (a count that no memory could hold).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_contact_detect_batch_2d(
    particles: *const *const pp_particle_2d,
    poses: *const pp_pose_2d,
    body_count: usize,
    pairs: *const u32,
    pair_count: usize,
    settings: *const pp_settings,
    threads: u32,
    states: *mut pp_pair_state,
    contacts: *mut pp_contact_2d,
    statuses: *mut pp_status,
) -> pp_status {
    let bodies = (particles, poses, body_count);
    // SAFETY: as the caller has promised.
    unsafe { detect_batch(bodies, (pairs, pair_count), settings, threads, states, (contacts, statuses), contact) }
}

/// The point on one of the particles of the plane where the scale of the other is least: P1 on A, P2 on B
/// (paper eqs 3, 9). As pp_closest_point.
///
/// on: PP_ON_A or PP_ON_B. settings: may be NULL (defaults); the formulation and solve_separated do not
/// matter. out: the point, or slack = 1 where there is none.
/// Errors: PP_NULL_POINTER, PP_BAD_POSITION, PP_BAD_ORIENTATION (an angle that is not finite or beyond 2^30),
/// PP_BAD_INDEX (on), PP_UNKNOWN_FORMULATION, PP_UNKNOWN_BACK_END, PP_NO_CONE_PROGRAM, PP_BAD_SETTING,
/// PP_SOLVER_FAILED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_closest_point_2d(
    a: *const pp_particle_2d,
    pose_a: *const pp_pose_2d,
    b: *const pp_particle_2d,
    pose_b: *const pp_pose_2d,
    on: u32,
    settings: *const pp_settings,
    out: *mut pp_closest_2d,
) -> pp_status {
    give!(out, [a, pose_a, b, pose_b, settings], {
        let found = closest_point(a, &pose_a, b, &pose_b, role_from(on)?, settings).map_err(detect_status)?;
        Ok(found.unwrap_or(ClosestPoint::UNKNOWN))
    })
}

/// Contact length (YADE: jointLength): how much of the line through the contact point, normal to the
/// contact normal, lies in both particles.
///
/// contact: an overlapping answer of pp_contact_detect_2d for the same particles and poses.
/// length: receives a length; 0 when separated. Exact to rounding.
/// Errors: PP_NULL_POINTER, PP_BAD_POSITION, PP_BAD_ORIENTATION, PP_BAD_POINT (the contact
/// was not filled: no kind, point or normal).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_contact_length_2d(
    a: *const pp_particle_2d,
    pose_a: *const pp_pose_2d,
    b: *const pp_particle_2d,
    pose_b: *const pp_pose_2d,
    contact: *const pp_contact_2d,
    length: *mut f64,
) -> pp_status {
    give!(length, [a, pose_a, b, pose_b, contact], {
        match contact.kind {
            Kind::Overlapping => Section::from(contact).length(a, &pose_a, b, &pose_b).ok_or(PP_BAD_POINT),
            Kind::Separated => Ok(0.0),
        }
    })
}
