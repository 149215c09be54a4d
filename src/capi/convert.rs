//! The one conversion of each plain struct of the C interface to the Rust type, or back.

use super::fence::{array, borrow};
use super::status::*;
use super::types::*;
use crate::{
    BackEnd, Contact, DetectError, Formulation, MassProperties, PairState, Plane, Pose, PoseError, Role, Settings,
    SettingsError,
};
use nalgebra::Vector3;

/// Rows of a, b, c, d.
/// Pointers: planes is NULL or points to 4*count doubles.
pub(super) unsafe fn planes_from(planes: *const f64, count: usize) -> Result<Vec<Plane>, pp_status> {
    let rows = unsafe { array(planes.cast::<[f64; 4]>(), count) }?;
    Ok(rows.iter().map(|row| Plane::from(*row)).collect())
}

#[inline]
pub(super) fn pose_from(pose: &pp_pose) -> Result<Pose, pp_status> {
    Pose::new(pose.position, pose.orientation).map_err(|error| match error {
        PoseError::Position(..) => PP_BAD_POSITION,
        PoseError::Orientation(..) | PoseError::Rotation(_) => PP_BAD_ORIENTATION,
    })
}

const _: () = assert!(
    size_of::<PairState>() <= size_of::<pp_pair_state>() && align_of::<PairState>() == align_of::<pp_pair_state>()
);

#[inline(always)]
pub(super) fn state_of(state: &mut pp_pair_state) -> &mut PairState {
    // SAFETY: it holds as many bytes, all of them numbers of which any value is one; the remembered solution comes
    // first in both.
    unsafe { &mut *std::ptr::from_mut(state).cast::<PairState>() }
}

impl From<&MassProperties> for pp_mass_properties {
    fn from(mass: &MassProperties) -> Self {
        let i = mass.inertia;
        let inertia = [i.m11, i.m22, i.m33, i.m12, i.m23, i.m13];
        Self { volume: mass.volume, centroid: mass.centroid.into(), inertia, error: mass.error }
    }
}

/// A point or direction.
pub(super) fn finite(v: &[f64; 3]) -> Result<Vector3<f64>, pp_status> {
    if v.iter().all(|c| c.is_finite()) { Ok(Vector3::from(*v)) } else { Err(PP_BAD_POINT) }
}

pub(super) fn settings_to(settings: &Settings) -> pp_settings {
    pp_settings {
        formulation: formulation_code(settings.formulation),
        back_end: back_end_code(settings.back_end),
        solve_separated: settings.solve_separated.into(),
        reserved: 0,
        gap_tolerance: settings.gap_tolerance,
        weight_on_a: settings.weight_on_a,
        flat_regularisation: settings.flat_regularisation,
        carry_tolerance: settings.carry_tolerance,
    }
}

/// The defaults for `None`; ranges are checked by whoever uses the settings.
///
/// Always inlined: given back through memory byte by byte and read again as words, they cost a cheap rejection a tenth
/// of its time.
#[inline(always)]
pub(super) fn settings_from(settings: Option<&pp_settings>) -> Result<Settings, pp_status> {
    let Some(settings) = settings else { return Ok(Settings::default()) };
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
            PP_CONE_PROGRAM => BackEnd::ConeProgram,
            _ => return Err(PP_UNKNOWN_BACK_END),
        },
        solve_separated: settings.solve_separated == 1,
        gap_tolerance: settings.gap_tolerance,
        weight_on_a: settings.weight_on_a,
        flat_regularisation: settings.flat_regularisation,
        carry_tolerance: settings.carry_tolerance,
    })
}

/// A contact that a caller hands back: what is no enum in Rust was not written by this library.
///
/// # Safety
/// `contact` is NULL or points to a contact.
pub(super) unsafe fn contact_of<'a, const N: usize>(contact: *const Contact<N>) -> Result<&'a Contact<N>, pp_status> {
    // SAFETY: its first three fields are words; they are looked at before they count as enums.
    let [kind, formulation, back_end] = *unsafe { borrow(contact.cast::<[u32; 3]>()) }?;
    match (kind, formulation, back_end) {
        (1..=2, PP_MIDWAY | PP_CLOSEST, PP_FAST | PP_CONE_PROGRAM) => unsafe { borrow(contact) },
        (1..=2, PP_MIDWAY | PP_CLOSEST, _) => Err(PP_UNKNOWN_BACK_END),
        (1..=2, ..) => Err(PP_UNKNOWN_FORMULATION),
        _ => Err(PP_BAD_POINT),
    }
}

/// Which particle the closest point is asked on.
pub(super) fn role_from(on: u32) -> Result<Role, pp_status> {
    match on {
        PP_ON_A => Ok(Role::A),
        PP_ON_B => Ok(Role::B),
        _ => Err(PP_BAD_INDEX),
    }
}

pub(super) fn detect_status(error: &DetectError) -> pp_status {
    match error {
        DetectError::Settings(error) => settings_status(error),
        DetectError::Failed { .. } => PP_SOLVER_FAILED,
        DetectError::NoSuchBody { .. } | DetectError::Length { .. } => PP_BAD_INDEX,
    }
}

pub(super) fn settings_status(error: &SettingsError) -> pp_status {
    match error {
        SettingsError::NoConeProgram => PP_NO_CONE_PROGRAM,
        _ => PP_BAD_SETTING,
    }
}

#[inline]
pub(super) fn formulation_code(formulation: Formulation) -> u32 {
    match formulation {
        Formulation::Midway => PP_MIDWAY,
        Formulation::Closest => PP_CLOSEST,
    }
}

#[inline]
pub(super) fn back_end_code(back_end: BackEnd) -> u32 {
    match back_end {
        BackEnd::Fast => PP_FAST,
        BackEnd::ConeProgram => PP_CONE_PROGRAM,
    }
}
