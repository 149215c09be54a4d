//! The one conversion of each plain struct of the plane.

use super::types::pp_pose_2d;
use crate::capi::status::*;
use crate::planar::{Pose, PoseError};
use nalgebra::Vector2;

pub(super) fn pose_from(pose: &pp_pose_2d) -> Result<Pose, pp_status> {
    Pose::new(pose.position, pose.angle).map_err(|error| match error {
        PoseError::Position(..) => PP_BAD_POSITION,
        PoseError::Angle(_) => PP_BAD_ORIENTATION,
    })
}

/// A point or direction.
pub(super) fn finite(v: &[f64; 2]) -> Result<Vector2<f64>, pp_status> {
    if v.iter().all(|c| c.is_finite()) { Ok(Vector2::from(*v)) } else { Err(PP_BAD_POINT) }
}
