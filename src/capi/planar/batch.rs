//! The contacts of many pairs of the plane in one call.

use super::contact::contact;
use super::convert::pose_from;
use super::particle::pp_particle_2d;
use super::types::pp_pose_2d;
use crate::capi::batch::detect_batch;
use crate::capi::status::*;
use crate::capi::types::{pp_contact_2d, pp_pair_state, pp_settings};
use crate::planar::{Particle, Pose};
use crate::{PairState, Settings};
use std::mem::MaybeUninit;

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
    let (bodies, pairs, outputs) = ((particles, poses, body_count), (pairs, pair_count), (contacts, statuses));
    let one =
        |a: &Body,
         b: &Body,
         settings: &Settings,
         state: Option<&mut PairState>,
         out: &mut MaybeUninit<pp_contact_2d>| { contact((a.0, &a.1), (b.0, &b.1), settings, state, out) };
    // SAFETY: as the caller promised.
    unsafe { detect_batch(bodies, pairs, settings, threads, states, outputs, (body, one)) }
}

type Body<'a> = (&'a Particle, Pose);

fn body<'a>(particle: &'a pp_particle_2d, pose: &pp_pose_2d) -> Result<Body<'a>, pp_status> {
    Ok((&particle.0, pose_from(pose)?))
}
