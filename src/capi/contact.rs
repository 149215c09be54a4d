//! The contact of one pair, its area, and one closest point alone.

use super::convert::*;
use super::fence::{Output, borrow, fenced, output};
use super::particle::pp_particle;
use super::status::*;
use super::types::*;
use crate::contact::closest_point::closest_point;
use crate::contact::detect::{Carrying, detect_as};
use crate::{Carried, Contact, DetectError, Flags, Memory, Particle, Pose, Section, Settings};

/// Fills settings with the defaults.
///
/// Pointers: settings is valid for writing.
/// Errors: PP_NULL_POINTER.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_settings_default(settings: *mut pp_settings) -> pp_status {
    fenced(|| {
        let out = unsafe { output(settings) }?;
        out.write(settings_to(&Settings::default()));
        Ok(())
    })
}

/// Finds the contact of particle A at pose_a with particle B at pose_b.
///
/// settings: may be NULL (defaults). memory: may be NULL; else what this ordered pair remembers, read, and
/// updated when the call returns PP_OK. out: the answer; see struct pp_contact for frames, units and signs.
/// Pointers: memory and out are not used by another call at the same time.
/// Errors: PP_NULL_POINTER, PP_BAD_POSITION, PP_BAD_ORIENTATION, PP_UNKNOWN_FORMULATION,
/// PP_UNKNOWN_BACK_END, PP_NO_CONE_PROGRAM, PP_BAD_SETTING, PP_SOLVER_FAILED.
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
        let settings = settings_from(unsafe { settings.as_ref() })?;
        // SAFETY: NULL or exclusively ours for the call.
        let memory = unsafe { memory.as_mut() };
        contact((a, &pose_a), (b, &pose_b), &settings, memory, out)
    })
}

/// Prepares a pose: its rotation as a matrix.
///
/// Pointers: frame is valid for writing.
/// Errors: PP_NULL_POINTER, PP_BAD_POSITION, PP_BAD_ORIENTATION.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_frame_from_pose(pose: *const pp_pose, frame: *mut pp_frame) -> pp_status {
    fenced(|| {
        let pose = pose_from(unsafe { borrow(pose) }?)?;
        let out = unsafe { output(frame) }?;
        out.write(frame_from(&pose));
        Ok(())
    })
}

/// pp_contact_detect for contacts that are followed from pose to pose, for poses that are prepared. Where
/// the last contact can be carried on, no plane is looked at: the answer has PP_FLAG_CARRIED, and its gap
/// and point_bound hold as for any other.
///
/// carry_tolerance: in [0, 0.1]; to what part of the smaller bounding radius the contact point of a
/// contact that is carried on has to be known (1e-9, say); 0 solves always. PP_CLOSEST and PP_CONE_PROGRAM are
/// never carried on.
/// settings: may be NULL (defaults). memory: may be NULL. carry: what the pair carries on, read and updated;
/// emptied when the solve fails.
/// Pointers: memory, carry and out are not used by another call at the same time.
/// Errors: PP_NULL_POINTER, PP_UNKNOWN_FORMULATION, PP_UNKNOWN_BACK_END, PP_NO_CONE_PROGRAM, PP_BAD_SETTING
/// (carry_tolerance, too), PP_SOLVER_FAILED. A frame that pp_frame_from_pose did not fill is not recognised:
/// the answer is then without meaning.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_contact_detect_carried(
    a: *const pp_particle,
    frame_a: *const pp_frame,
    b: *const pp_particle,
    frame_b: *const pp_frame,
    settings: *const pp_settings,
    carry_tolerance: f64,
    memory: *mut pp_memory,
    carry: *mut pp_carry,
    out: *mut pp_contact,
) -> pp_status {
    fenced(|| {
        let (a, b) = unsafe { (&borrow(a)?.0, &borrow(b)?.0) };
        let (pose_a, pose_b) = unsafe { (pose_of(borrow(frame_a)?), pose_of(borrow(frame_b)?)) };
        // SAFETY: as for every output, and initialised by the caller.
        let carried = carried_of(unsafe { carry.as_mut() }.ok_or(PP_NULL_POINTER)?);
        let out = unsafe { output(out) }?;
        let settings = settings_from(unsafe { settings.as_ref() })?;
        let (a, b) = ((a, pose_a), (b, pose_b));
        // SAFETY: NULL or exclusively ours for the call.
        contact_carried(a, b, (&settings, carry_tolerance), unsafe { memory.as_mut() }, carried, out)
    })
}

/// Flags of a separated pair that the solver never saw.
const CHEAP_PROOF: Flags = Flags::BY_SPHERES.with(Flags::BY_FACE).with(Flags::BY_MEMORY);

/// Finds one contact, carried on where it can be, and writes it.
#[inline(always)]
pub(super) fn contact_carried(
    a: (&Particle, &Pose),
    b: (&Particle, &Pose),
    (settings, tolerance): (&Settings, f64),
    memory: Option<&mut pp_memory>,
    carried: &mut Carried,
    out: Output<pp_contact>,
) -> Result<(), pp_status> {
    let carrying = Carrying::new(settings, tolerance).map_err(|error| settings_status(&error))?;
    let write = writing(out);
    if carrying.carry_on(a, b, carried, &write).is_some() {
        return Ok(());
    }
    remembering(memory, |memory| carrying.solve(a, b, (memory, carried), write))
}

/// Finds one contact and writes it.
#[inline(always)]
pub(super) fn contact(
    a: (&Particle, &Pose),
    b: (&Particle, &Pose),
    settings: &Settings,
    memory: Option<&mut pp_memory>,
    out: Output<pp_contact>,
) -> Result<(), pp_status> {
    remembering(memory, |memory| detect_as(a, b, settings, (memory, None), writing(out)))
}

/// Writes the contact that it is given, and says by its flags how it was found.
#[inline(always)]
fn writing(out: Output<pp_contact>) -> impl Fn(Contact) -> Flags {
    move |contact| {
        out.write(contact_to(&contact));
        contact.flags
    }
}

/// Finds a contact, in space or in the plane, by `detect`, which writes it and gives its flags; with the memory of the pair.
#[inline(always)]
pub(super) fn remembering(
    memory: Option<&mut pp_memory>,
    detect: impl FnOnce(Option<&mut Memory>) -> Result<Flags, DetectError>,
) -> Result<(), pp_status> {
    let mut remembered = memory.as_deref().map(memory_from);
    let flags = detect(remembered.as_mut()).map_err(|error| detect_status(&error))?;
    match (memory, remembered) {
        // A cheap proof leaves the memory as it was, and is over before it could be written.
        (Some(memory), Some(remembered)) if !flags.has_any(CHEAP_PROOF) => *memory = memory_to(remembered),
        _ => {}
    }
    Ok(())
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
    fenced(|| {
        let (a, b) = unsafe { (&borrow(a)?.0, &borrow(b)?.0) };
        let (pose_a, pose_b) = unsafe { (pose_from(borrow(pose_a)?)?, pose_from(borrow(pose_b)?)?) };
        let out = unsafe { output(out) }?;
        let on = role_from(on)?;
        let settings = settings_from(unsafe { settings.as_ref() })?;
        let found = closest_point(a, &pose_a, b, &pose_b, on, &settings).map_err(|error| detect_status(&error))?;
        out.write(closest_to(found));
        Ok(())
    })
}

/// Contact area: the area of the cut that the plane through the contact point, normal to the contact
/// normal, makes through the intersection of both particles.
///
/// contact: an overlapping answer of pp_contact_detect for the same particles and poses.
/// relative_tolerance: in [1e-12, 0.1]; 1e-6 is a good choice. The area is exact but for rounding
/// (1e-12 of it, or 2e-16 size/r where that is more) and this is not used, unless rounding forbids;
/// such areas are known to no better than 1e-9. With r near 1e-9 of the size or less, thin sections
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
    fenced(|| {
        let (a, b) = unsafe { (&borrow(a)?.0, &borrow(b)?.0) };
        let (pose_a, pose_b) = unsafe { (pose_from(borrow(pose_a)?)?, pose_from(borrow(pose_b)?)?) };
        let contact = unsafe { borrow(contact) }?;
        let out = unsafe { output(area) }?;
        if !(1e-12..=0.1).contains(&relative_tolerance) {
            return Err(PP_BAD_SETTING);
        }
        let section = Section {
            branch_a: contact.branch_a.into(),
            branch_b: contact.branch_b.into(),
            normal: contact.normal.into(),
        };
        out.write(match contact.kind {
            PP_OVERLAPPING => section.area(a, &pose_a, b, &pose_b, relative_tolerance).ok_or(PP_BAD_POINT)?,
            PP_SEPARATED => 0.0,
            _ => return Err(PP_BAD_POINT),
        });
        Ok(())
    })
}
