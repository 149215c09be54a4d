//! The one conversion of each plain struct of the C interface to the Rust type, or back.

use super::status::*;
use super::types::*;
use crate::{DetectError, MassProperties, Plane, Pose, PoseError, Role, Section, SettingsError};
use nalgebra::SVector;

/// Rows of a, b, c, d.
pub(super) fn planes_of(rows: &[[f64; 4]]) -> Vec<Plane> {
    rows.iter().map(|row| Plane::from(*row)).collect()
}

#[inline]
pub(super) fn pose_from(pose: &pp_pose) -> Result<Pose, pp_status> {
    Pose::new(pose.position, pose.orientation).map_err(|error| match error {
        PoseError::Position(..) => PP_BAD_POSITION,
        PoseError::Orientation(..) | PoseError::Rotation(_) | PoseError::Angle(_) => PP_BAD_ORIENTATION,
    })
}

impl From<&MassProperties> for pp_mass_properties {
    fn from(mass: &MassProperties) -> Self {
        let i = mass.inertia;
        let inertia = [i.m11, i.m22, i.m33, i.m12, i.m23, i.m13];
        Self { volume: mass.volume, centroid: mass.centroid.into(), inertia, error: mass.error }
    }
}

/// A point or direction.
pub(super) fn finite<const N: usize>(v: &[f64; N]) -> Result<SVector<f64, N>, pp_status> {
    if v.iter().all(|c| c.is_finite()) { Ok(SVector::from(*v)) } else { Err(PP_BAD_POINT) }
}

/// The relative tolerance of an area.
pub(super) fn area_tolerance(tolerance: f64) -> Result<f64, pp_status> {
    if Section::TOLERANCES.contains(&tolerance) { Ok(tolerance) } else { Err(PP_BAD_SETTING) }
}

/// Which particle the closest point is asked on.
pub(super) fn role_from(on: u32) -> Result<Role, pp_status> {
    match on {
        PP_ON_A => Ok(Role::A),
        PP_ON_B => Ok(Role::B),
        _ => Err(PP_BAD_INDEX),
    }
}

pub(super) fn detect_status(error: DetectError) -> pp_status {
    match error {
        DetectError::Settings(error) => settings_status(error),
        DetectError::InPlane(_) => PP_NOT_IN_PLANE,
        DetectError::Failed { .. } => PP_SOLVER_FAILED,
        DetectError::NoSuchBody { .. } | DetectError::Length { .. } => PP_BAD_INDEX,
    }
}

pub(super) fn settings_status(error: SettingsError) -> pp_status {
    match error {
        SettingsError::NoConeProgram => PP_NO_CONE_PROGRAM,
        _ => PP_BAD_SETTING,
    }
}
