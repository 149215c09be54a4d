//! The one conversion of each plain struct of the plane.

use super::types::{pp_closest_2d, pp_contact_2d, pp_pose_2d};
use crate::capi::convert::{back_end_code, formulation_code, kind_code};
use crate::capi::status::*;
use crate::planar::{ClosestPoint, Contact, Pose, PoseError};
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

#[inline(always)]
pub(super) fn contact_to(contact: &Contact) -> pp_contact_2d {
    pp_contact_2d {
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

pub(super) fn closest_to(closest: Option<ClosestPoint>) -> pp_closest_2d {
    match closest {
        Some(ClosestPoint { s, gap, point, branch_a, branch_b, point_bound }) => pp_closest_2d {
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
            let (nan, none) = (f64::NAN, [f64::NAN; 2]);
            pp_closest_2d {
                slack: 1,
                reserved: 0,
                s: nan,
                gap: nan,
                point_bound: nan,
                point: none,
                branch_a: none,
                branch_b: none,
            }
        }
    }
}
