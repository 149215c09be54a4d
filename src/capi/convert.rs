//! The one conversion of each plain struct of the C interface to the Rust type, or back.

use super::status::*;
use super::types::*;
use crate::{
    BackEnd, ClosestPoint, Contact, DetectError, Formulation, Kind, MassProperties, PairState, Pose, PoseError, Role,
    Settings, SettingsError,
};
use nalgebra::Vector3;

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
    // SAFETY: it holds as many bytes, all of them numbers of which any value is one; the remembered solution comes first in both.
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
/// Always inlined: given back through memory byte by byte and read again as words, they cost a cheap rejection a tenth of its
/// time.
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

#[inline(always)]
pub(super) fn contact_to(contact: &Contact) -> pp_contact {
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

/// Which particle the closest point is asked on.
pub(super) fn role_from(on: u32) -> Result<Role, pp_status> {
    match on {
        PP_ON_A => Ok(Role::A),
        PP_ON_B => Ok(Role::B),
        _ => Err(PP_BAD_INDEX),
    }
}

pub(super) fn closest_to(closest: Option<ClosestPoint>) -> pp_closest {
    match closest {
        Some(ClosestPoint { s, gap, point, branch_a, branch_b, point_bound }) => pp_closest {
            slack: 0,
            reserved: 0,
            s,
            gap,
            point_bound,
            point: point.into(),
            branch_a: branch_a.into(),
            branch_b: branch_b.into(),
        },
        None => {
            let nan = [f64::NAN; 3];
            let [s, gap, point_bound] = nan;
            pp_closest { slack: 1, reserved: 0, s, gap, point_bound, point: nan, branch_a: nan, branch_b: nan }
        }
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
pub(super) fn kind_code(kind: Kind) -> i32 {
    match kind {
        Kind::Separated => PP_SEPARATED,
        Kind::Overlapping => PP_OVERLAPPING,
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
