//! The contacts of a whole step in one call.

use super::argument::{state_of, take};
use super::contact::contact;
use super::convert::settings_status;
use super::fence::{call, fenced};
use super::output::outputs;
use super::particle::pp_particle;
use super::status::*;
use super::types::*;
use crate::contact::batch::{CHUNK, in_parallel, optional_chunks};
use crate::{Particle, Pose};

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
    let state_count = if states.is_null() { 0 } else { pair_count };
    call!([particles[body_count], poses[body_count], pairs[pair_count], states[state_count], settings], {
        // SAFETY: as the caller has promised.
        let (contacts, statuses) = unsafe { (outputs(contacts, pair_count)?, outputs(statuses, pair_count)?) };
        settings.validate().map_err(settings_status)?;

        let body = |(&particle, pose): (&*const pp_particle, &pp_pose)| -> Result<(&Particle, Pose), pp_status> {
            let pose = std::ptr::from_ref(pose);
            Ok((take!(particle)?, take!(pose)?))
        };
        let bodies: Vec<_> = particles.iter().zip(poses).map(body).collect();
        let find = |index: u32| match bodies.get(index as usize) {
            Some(Ok((particle, pose))) => Ok((*particle, pose)),
            Some(Err(status)) => Err(*status),
            None => Err(PP_BAD_INDEX),
        };

        let outputs = contacts.chunks_mut(CHUNK).zip(statuses.chunks_mut(CHUNK));
        let pairs: &[[u32; 2]] = pairs;
        let chunks = pairs.chunks(CHUNK).zip(optional_chunks(states)).zip(outputs);
        in_parallel(threads as usize, pair_count.div_ceil(CHUNK), chunks, |((pairs, states), (contacts, statuses))| {
            let mut states = states.iter_mut();
            for ((&[i, j], out), status) in pairs.iter().zip(contacts).zip(statuses) {
                let state = states.next().map(state_of);
                status.write(fenced(|| contact(find(i)?, find(j)?, settings, state, out)));
            }
        });
        Ok(())
    })
}
