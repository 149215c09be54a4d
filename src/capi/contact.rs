//! The one call that matters, and the version of the library.

use super::fence::{borrow, fenced, output};
use super::particle::{pose_from, pp_particle};
use super::status::*;
use super::types::*;
use crate::contact::contact::{Contact, Kind};
use crate::contact::detect::{DetectError, begin, solved};
use crate::pair::relative_pose::Pair;
use crate::pair::separation_tests::Apart;
use crate::pair::warm_start::Memory;
use crate::section::Section;
use crate::settings::{BackEnd, Formulation, Settings};
use std::ffi::{CStr, c_char};

/// Version of this header; compare with `pp_version` of the library that was loaded.
pub const PP_VERSION_MAJOR: u32 = 0;
/// Grows with additions (or, while the major version is 0, with any change of the interface).
pub const PP_VERSION_MINOR: u32 = 1;
/// Grows with corrections that leave the interface as it is.
pub const PP_VERSION_PATCH: u32 = 0;

/// Version of the loaded library as "major.minor.patch". Static text: do not free it.
#[unsafe(no_mangle)]
pub extern "C" fn pp_version() -> *const c_char {
    const VERSION: &CStr = match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
        Ok(text) => text,
        Err(_) => unreachable!(),
    };
    VERSION.as_ptr()
}

/// Fills `settings` with the defaults.
///
/// Errors: `PP_NULL_POINTER`.
///
/// # Safety
/// `settings` is NULL or valid for writing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_settings_default(settings: *mut pp_settings) -> pp_status {
    fenced(|| {
        let out = unsafe { output(settings) }?;
        out.write(settings_to(&Settings::default()));
        Ok(())
    })
}

/// Finds the contact of particle A at `pose_a` with particle B at `pose_b`.
///
/// settings: may be NULL (defaults). memory: may be NULL; else what this ordered pair remembers,
/// read and updated. out: the answer; see struct pp_contact for frames, units and signs.
/// Errors: `PP_NULL_POINTER`, `PP_BAD_POSITION`, `PP_BAD_ORIENTATION`, `PP_UNKNOWN_FORMULATION`,
/// `PP_UNKNOWN_BACK_END`, `PP_BAD_SETTING`, `PP_SOLVER_FAILED`.
///
/// # Safety
/// Pointers are NULL or valid; `memory` and `out` are not used by another call at the same time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_contact_detect(
    a: *const pp_particle,
    pose_a: *const pp_pose,
    b: *const pp_particle,
    pose_b: *const pp_pose,
    settings: *const pp_settings,
    memory: *mut pp_memory,
    out: *mut pp_contact,
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
        let last = remembered.and_then(|memory| memory.last);
        settings.validate().map_err(|_| PP_BAD_SETTING)?;
        // Most calls of a scene end with a proof: what is written is nearly all the same.
        let rejected = |Apart { by, distance }: Apart| {
            let (formulation, flags) = (formulation_code(settings.formulation), PP_FLAG_REJECTED | by.bits());
            out.write(pp_contact { formulation, flags, distance, ..REJECTED });
            Ok(())
        };
        let undecided = |pair: &Pair| {
            let contact =
                solved(pair, &pose_b, &settings, remembered.as_mut()).map_err(|error| detect_status(&error))?;
            if let (Some(memory), Some(remembered)) = (memory, remembered) {
                memory.state = remembered.into_raw();
            }
            out.write(contact_to(&contact));
            Ok(())
        };
        begin((a, &pose_a), (b, &pose_b), &settings, last, rejected, undecided)
    })
}

/// Contact area: the area of the cut that the plane through the contact point, normal to the contact
/// normal, makes through the intersection of both particles.
///
/// contact: an overlapping answer of `pp_contact_detect` for the same particles and poses.
/// relative_tolerance: in [1e-12, 0.1]; 1e-6 is a good choice. The area is exact but for rounding
/// (1e-12 of it, or 2e-16 size/r where that is more) and this is not used, unless rounding forbids;
/// such areas are known to no better than 1e-9. With r near 1e-9 of the size or less, thin sections
/// may be wrong. area: receives length^2; 0 when separated.
/// Errors: `PP_NULL_POINTER`, `PP_BAD_POSITION`, `PP_BAD_ORIENTATION`, `PP_BAD_POINT` (the contact
/// was not filled: no kind, point or normal; or its point is outside a particle), `PP_BAD_SETTING`.
///
/// # Safety
/// Pointers are NULL or valid.
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
    fenced(|| {
        let (a, b) = unsafe { (&borrow(a)?.0, &borrow(b)?.0) };
        let (pose_a, pose_b) = unsafe { (pose_from(borrow(pose_a)?)?, pose_from(borrow(pose_b)?)?) };
        let contact = unsafe { borrow(contact) }?;
        let out = unsafe { output(area) }?;
        if !(1e-12..=0.1).contains(&relative_tolerance) {
            return Err(PP_BAD_SETTING);
        }
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
        out.write(section.area(a, &pose_a, b, &pose_b, relative_tolerance).ok_or(PP_BAD_POINT)?);
        Ok(())
    })
}

/// A pair that a cheap proof holds apart.
const REJECTED: pp_contact = pp_contact {
    kind: PP_SEPARATED,
    formulation: PP_MIDWAY,
    back_end: PP_FAST,
    flags: PP_FLAG_REJECTED,
    iterations: 0,
    reserved: 0,
    s: 1.0,
    s_b: f64::NAN,
    weight: f64::NAN,
    gap: f64::NAN,
    point_bound: f64::NAN,
    overlap: f64::NAN,
    normal: [f64::NAN; 3],
    point: [f64::NAN; 3],
    branch_a: [f64::NAN; 3],
    branch_b: [f64::NAN; 3],
    point_on_a: [f64::NAN; 3],
    point_on_b: [f64::NAN; 3],
    distance: 0.0,
};

fn settings_to(settings: &Settings) -> pp_settings {
    pp_settings {
        formulation: formulation_code(settings.formulation),
        back_end: back_end_code(settings.back_end),
        solve_separated: settings.solve_separated.into(),
        reserved: 0,
        gap_tolerance: settings.gap_tolerance,
        weight_on_a: settings.weight_on_a,
        flat_regularisation: settings.flat_regularisation,
    }
}

pub(super) fn settings_from(settings: &pp_settings) -> Result<Settings, pp_status> {
    if settings.solve_separated > 1 || settings.reserved != 0 {
        return Err(PP_BAD_SETTING);
    }
    Ok(Settings {
        formulation: match settings.formulation {
            PP_MIDWAY => Formulation::Midway,
            PP_CLOSEST => Formulation::Closest,
            _ => return Err(PP_UNKNOWN_FORMULATION),
        },
        back_end: match settings.back_end {
            PP_FAST => BackEnd::Fast,
            PP_CONIC => BackEnd::Conic,
            _ => return Err(PP_UNKNOWN_BACK_END),
        },
        solve_separated: settings.solve_separated == 1,
        gap_tolerance: settings.gap_tolerance,
        weight_on_a: settings.weight_on_a,
        flat_regularisation: settings.flat_regularisation,
    })
}

fn contact_to(contact: &Contact) -> pp_contact {
    pp_contact {
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
        distance: contact.distance,
    }
}

pub(super) fn detect_status(error: &DetectError) -> pp_status {
    match error {
        DetectError::Settings(_) => PP_BAD_SETTING,
        DetectError::Failed { .. } => PP_SOLVER_FAILED,
    }
}

pub(super) fn kind_code(kind: Kind) -> i32 {
    match kind {
        Kind::Separated => PP_SEPARATED,
        Kind::Overlapping => PP_OVERLAPPING,
    }
}

pub(super) fn formulation_code(formulation: Formulation) -> u32 {
    match formulation {
        Formulation::Midway => PP_MIDWAY,
        Formulation::Closest => PP_CLOSEST,
    }
}

pub(super) fn back_end_code(back_end: BackEnd) -> u32 {
    match back_end {
        BackEnd::Fast => PP_FAST,
        BackEnd::Conic => PP_CONIC,
    }
}
