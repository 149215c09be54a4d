//! The contacts of many pairs of the plane in one call.

use super::contact::contact;
use super::particle::pp_particle_2d;
use super::types::pp_pose_2d;
use crate::capi::batch::detect_batch;
use crate::capi::status::*;
use crate::capi::types::{pp_contact_2d, pp_pair_state, pp_settings};

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
