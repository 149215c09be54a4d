//! The contact of one pair of the plane, and its length.

use super::convert::{contact_to, pose_from};
use super::particle::pp_particle_2d;
use super::types::{pp_contact_2d, pp_pose_2d};
use crate::capi::convert::{detect_status, memory_from, memory_to, settings_from};
use crate::capi::fence::{borrow, fenced, output};
use crate::capi::status::*;
use crate::capi::types::{PP_OVERLAPPING, PP_SEPARATED, pp_memory, pp_settings};
use crate::planar::{Section, detect_as};

/// Finds the contact of particle A at pose_a with particle B at pose_b, both of the plane.
///
/// settings: may be NULL (defaults). memory: may be NULL; else what this ordered pair remembers,
/// read and updated. out: the answer; see struct pp_contact_2d for frames, units and signs.
/// Errors: PP_NULL_POINTER, PP_BAD_POSITION, PP_BAD_ORIENTATION (an angle that is not finite),
/// PP_UNKNOWN_FORMULATION, PP_UNKNOWN_BACK_END, PP_NO_CONIC, PP_BAD_SETTING, PP_SOLVER_FAILED.
/// Pointers: Pointers are NULL or valid; memory and out are not used by another call at the same time.
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
        let settings = settings_from(unsafe { settings.as_ref() })?;
        // SAFETY: NULL or exclusively ours for the call.
        let memory = unsafe { memory.as_mut() };
        let mut remembered = memory.as_deref().map(memory_from);
        let write = |contact| out.write(contact_to(&contact));
        detect_as((a, &pose_a), (b, &pose_b), &settings, remembered.as_mut(), write)
            .map_err(|error| detect_status(&error))?;
        if let (Some(memory), Some(remembered)) = (memory, remembered) {
            *memory = memory_to(remembered);
        }
        Ok(())
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
    fenced(|| {
        let (a, b) = unsafe { (&borrow(a)?.0, &borrow(b)?.0) };
        let (pose_a, pose_b) = unsafe { (pose_from(borrow(pose_a)?)?, pose_from(borrow(pose_b)?)?) };
        let contact = unsafe { borrow(contact) }?;
        let out = unsafe { output(length) }?;
        let section = Section {
            branch_a: contact.branch_a.into(),
            branch_b: contact.branch_b.into(),
            normal: contact.normal.into(),
        };
        out.write(match contact.kind {
            PP_OVERLAPPING => section.length(a, &pose_a, b, &pose_b).ok_or(PP_BAD_POINT)?,
            PP_SEPARATED => 0.0,
            _ => return Err(PP_BAD_POINT),
        });
        Ok(())
    })
}
