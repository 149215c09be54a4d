//! The contacts of a whole step in one call.

use super::contact::contact;
use super::convert::{pose_from, settings_from, settings_status, state_of};
use super::fence::{array, array_mut, borrow, fenced, outputs};
use super::particle::pp_particle;
use super::status::*;
use super::types::*;
use crate::contact::batch::{CHUNK, in_parallel, optional_chunks};
use crate::{PairState, Particle, Pose, Settings};
use std::mem::MaybeUninit;

/// Finds the contacts of many pairs of bodies: the way for a DEM program to hand over a whole step.
///
/// Body i is particles[i] at poses[i]; pair n is that of the bodies pairs[2n] (A) and pairs[2n+1] (B),
/// counted from 0. Each pose is converted once, however many pairs its body is in. Each contact and state is,
/// to the last bit, that of pp_contact_detect for the pair alone, whatever the number of threads.
///
/// particles, poses: body_count of each; several bodies may share a particle. A particle may be NULL and
/// a pose may be bad: that is told by the statuses of the pairs that name such a body, if any.
/// pairs: pair_count rows of two indices. settings: may be NULL (defaults); the same for all pairs.
/// threads: how many work on it, the calling one among them: 0 and 1 mean the calling thread alone,
/// more than 256 count as 256. Threads are started and ended within the call, which is worth its time from
/// some thousand pairs on.
/// states: one for each pair, read and updated; may be NULL. contacts: one for each pair; written where
/// its status is PP_OK. statuses: one for each pair, all of them written: as pp_contact_detect would return,
/// or PP_BAD_INDEX for a body that is not there.
/// The call itself returns PP_OK when it went through all pairs, whatever their statuses; an error means
/// that nothing was written.
/// Pointers: may be NULL where the count is 0. No array overlaps another, and states, contacts and
/// statuses are not used by another call at the same time.
/// Errors: PP_NULL_POINTER, PP_UNKNOWN_FORMULATION, PP_UNKNOWN_BACK_END, PP_NO_CONE_PROGRAM, PP_BAD_SETTING,
/// PP_BAD_INDEX (a count that no memory could hold).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_contact_detect_batch(
    particles: *const *const pp_particle,
    poses: *const pp_pose,
    body_count: usize,
    pairs: *const u32,
    pair_count: usize,
    settings: *const pp_settings,
    threads: u32,
    states: *mut pp_pair_state,
    contacts: *mut pp_contact,
    statuses: *mut pp_status,
) -> pp_status {
    let (bodies, pairs, outputs) = ((particles, poses, body_count), (pairs, pair_count), (contacts, statuses));
    let one =
        |a: &Body, b: &Body, settings: &Settings, state: Option<&mut PairState>, out: &mut MaybeUninit<pp_contact>| {
            contact((a.0, &a.1), (b.0, &b.1), settings, state, out)
        };
    // SAFETY: as the caller promised.
    unsafe { detect_batch(bodies, pairs, settings, threads, states, outputs, (body, one)) }
}

type Body<'a> = (&'a Particle, Pose);

fn body<'a>(particle: &'a pp_particle, pose: &pp_pose) -> Result<Body<'a>, pp_status> {
    Ok((&particle.0, pose_from(pose)?))
}

/// pp_contact_detect_batch of particles P at poses Q with contacts C: `body` makes a body of a particle and its pose,
/// `contact` finds the contact of two and writes it.
///
/// # Safety
/// Pointers and counts are as pp_contact_detect_batch asks for.
pub(super) unsafe fn detect_batch<'a, P: 'a, Q: 'a, B: Sync, C: Send>(
    (particles, poses, body_count): (*const *const P, *const Q, usize),
    (pairs, pair_count): (*const u32, usize),
    settings: *const pp_settings,
    threads: u32,
    states: *mut pp_pair_state,
    (contacts, statuses): (*mut C, *mut pp_status),
    (body, contact): (
        impl Fn(&'a P, &'a Q) -> Result<B, pp_status>,
        impl Fn(&B, &B, &Settings, Option<&mut PairState>, &mut MaybeUninit<C>) -> Result<(), pp_status> + Sync,
    ),
) -> pp_status {
    fenced(|| {
        let (particles, poses) = unsafe { (array(particles, body_count)?, array(poses, body_count)?) };
        let pairs = unsafe { array(pairs.cast::<[u32; 2]>(), pair_count) }?;
        // SAFETY: exclusively ours for the call; NULL states are none.
        let states = unsafe { array_mut(states, if states.is_null() { 0 } else { pair_count }) }?;
        let (contacts, statuses) = unsafe { (outputs(contacts, pair_count)?, outputs(statuses, pair_count)?) };
        let settings = settings_from(unsafe { settings.as_ref() })?;
        settings.validate().map_err(|error| settings_status(&error))?;

        // SAFETY: each is NULL or a particle.
        let bodies = particles.iter().zip(poses).map(|(&particle, pose)| body(unsafe { borrow(particle) }?, pose));
        let bodies: Vec<Result<B, pp_status>> = bodies.collect();
        let find = |index: u32| bodies.get(index as usize).ok_or(PP_BAD_INDEX)?.as_ref().map_err(|&status| status);

        let outputs = contacts.chunks_mut(CHUNK).zip(statuses.chunks_mut(CHUNK));
        let chunks = pairs.chunks(CHUNK).zip(optional_chunks(states)).zip(outputs);
        in_parallel(threads as usize, pair_count.div_ceil(CHUNK), chunks, |((pairs, states), (contacts, statuses))| {
            let mut states = states.iter_mut();
            for ((&[i, j], out), status) in pairs.iter().zip(contacts).zip(statuses) {
                let state = states.next().map(state_of);
                status.write(fenced(|| contact(find(i)?, find(j)?, &settings, state, out)));
            }
        });
        Ok(())
    })
}
