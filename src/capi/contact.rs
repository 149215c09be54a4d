//! The contact of one pair, its area, and one closest point alone.

use super::convert::{area_tolerance, detect_status, role_from};
use super::fence::{call, give};
use super::particle::pp_particle;
use super::status::*;
use super::types::*;
use crate::contact::closest_point::closest_point;
use crate::contact::detect::detect_into;
use crate::{ClosestPoint, Contact, Kind, PairState, Particle, Pose, Section, Settings};
use std::mem::MaybeUninit;

/// Fills settings with the defaults.
///
/// Pointers: settings is valid for writing.
/// Errors: PP_NULL_POINTER.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_settings_default(settings: *mut pp_settings) -> pp_status {
    give!(settings, [], Ok(Settings::DEFAULT))
}

/// Finds the contact of particle A at pose_a with particle B at pose_b.
///
/// settings: may be NULL (defaults). state: may be NULL; else that of this ordered pair, read, and updated
/// when the call returns PP_OK. With carry_tolerance above 0 a contact of PP_MIDWAY by PP_FAST is carried on
/// from the last one and not solved, where that can be: the answer has PP_FLAG_CARRIED, and its
/// gap and point_bound hold as for any other. out: the answer; see struct pp_contact for frames, units and
/// signs.
/// Pointers: state and out are not used by another call at the same time.
/// Errors: PP_NULL_POINTER, PP_BAD_POSITION, PP_BAD_ORIENTATION, PP_UNKNOWN_FORMULATION,
/// PP_UNKNOWN_BACK_END, PP_NO_CONE_PROGRAM, PP_BAD_SETTING, PP_SOLVER_FAILED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_contact_detect(
    a: *const pp_particle,
    pose_a: *const pp_pose,
    b: *const pp_particle,
    pose_b: *const pp_pose,
    settings: *const pp_settings,
    state: *mut pp_pair_state,
    out: *mut pp_contact,
) -> pp_status {
    // One body after the other, as of a batch.
    call!([a, pose_a, b, pose_b, out, settings, state], contact((a, &pose_a), (b, &pose_b), settings, state, out))
}

/// Finds one contact and writes it.
#[inline(always)]
pub(super) fn contact(
    a: (&Particle, &Pose),
    b: (&Particle, &Pose),
    settings: &Settings,
    state: Option<&mut PairState>,
    out: &mut MaybeUninit<Contact>,
) -> Result<(), pp_status> {
    detect_into(a, b, settings, state, out).map(|_| ()).map_err(detect_status)
}

/// The point on one of the particles where the scale of the other is least: P1 on A, P2 on B (paper eqs
/// 3, 9). pp_contact_detect with PP_CLOSEST needs both; this is for pairs that have only one, and for
/// callers that want only one.
///
/// on: PP_ON_A or PP_ON_B. settings: may be NULL (defaults); the formulation and solve_separated do not
/// matter. out: the point, or slack = 1 where there is none.
/// Errors: PP_NULL_POINTER, PP_BAD_POSITION, PP_BAD_ORIENTATION, PP_BAD_INDEX (on), PP_UNKNOWN_FORMULATION,
/// PP_UNKNOWN_BACK_END, PP_NO_CONE_PROGRAM, PP_BAD_SETTING, PP_SOLVER_FAILED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_closest_point(
    a: *const pp_particle,
    pose_a: *const pp_pose,
    b: *const pp_particle,
    pose_b: *const pp_pose,
    on: u32,
    settings: *const pp_settings,
    out: *mut pp_closest,
) -> pp_status {
    give!(out, [a, pose_a, b, pose_b, settings], {
        let found = closest_point(a, &pose_a, b, &pose_b, role_from(on)?, settings).map_err(detect_status)?;
        Ok(found.unwrap_or(ClosestPoint::UNKNOWN))
    })
}

/// Contact area: the area of the cut that the plane through the contact point, normal to the contact
/// normal, makes through the intersection of both particles.
///
/// contact: an overlapping answer of pp_contact_detect for the same particles and poses.
/// relative_tolerance: in [1e-12, 0.1]; 1e-6 is a good choice. It is used only where rounding prevents a
/// closed form, and the area is then known to 1e-9 at best. Elsewhere the area is exact but for rounding:
/// 1e-12 of it, or 2e-16 size/r where that is more. With r near 1e-9 of the size or less, thin sections
/// may be wrong. area: receives length^2; 0 when separated.
/// Errors: PP_NULL_POINTER, PP_BAD_POSITION, PP_BAD_ORIENTATION, PP_BAD_POINT (the contact
/// was not filled: no kind, point or normal; or its point is outside a particle), PP_BAD_SETTING.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_contact_area(
    a: *const pp_particle,
    pose_a: *const pp_pose,
    b: *const pp_particle,
    pose_b: *const pp_pose,
    contact: *const pp_contact,
    relative_tolerance: f64,
    area: *mut f64,
) -> pp_status {
    give!(area, [a, pose_a, b, pose_b, contact], {
        let tolerance = area_tolerance(relative_tolerance)?;
        match contact.kind {
            Kind::Overlapping => Section::from(contact).area(a, &pose_a, b, &pose_b, tolerance).ok_or(PP_BAD_POINT),
            Kind::Separated => Ok(0.0),
        }
    })
}
