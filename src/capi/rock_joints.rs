//! Joints over the C boundary.

use super::argument::{Argument, objects, take};
use super::message::{Refusal, Refused, explain};
use super::status::*;
use crate::rock::{Joint, JointSet, RockError};
use std::ffi::c_char;

/// A joint: a plane, or a disc or polygon of it.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_joint {
    /// A point of it, length; of a disc its centre, of a polygon the mean of its corners.
    pub point: [f64; 3],
    /// Normal, of any length.
    pub normal: [f64; 3],
    /// Radius of a disc, length; infinite for a joint without end; of a polygon that of a disc that holds it.
    pub radius: f64,
}

/// Joints of about one orientation at about one spacing. Axes: x east, y north, z up.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_joint_set {
    /// Mean dip, degrees, 0 to 90.
    pub dip: f64,
    /// Mean dip direction, degrees, clockwise from north.
    pub dip_direction: f64,
    /// Mean spacing along the mean normal, length.
    pub spacing: f64,
    /// Concentration of the normals in Fisher's distribution; infinite: none scatters.
    pub fisher: f64,
    /// Radius of joints that are discs, length; infinite for joints without end.
    pub radius: f64,
    /// Seed of what is drawn at random: the same one gives the same joints.
    pub seed: u64,
    /// 1: spacings are drawn from an exponential distribution; 0: all are the same. Without a meaning for
    /// discs.
    pub exponential: u32,
    /// Always 0.
    pub reserved: u32,
}

/// The joint through a point that descends most, by the angle dip in degrees, towards the azimuth
/// dip_direction in degrees, clockwise from north.
///
/// point: x east, y north, z up. radius: as of struct pp_joint. out: receives the joint, with the unit
/// normal that points upwards.
/// message: receives, on failure, a sentence that names the value (may be NULL).
/// Errors: PP_NULL_POINTER, PP_BAD_ROCK.
/// Pointers: point points to 3 doubles, message to message_size bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_joint_from_dip(
    point: *const f64,
    dip: f64,
    dip_direction: f64,
    radius: f64,
    out: *mut pp_joint,
    message: *mut c_char,
    message_size: usize,
) -> pp_status {
    explain!(message[message_size], "out", out, [point], {
        let joint = Joint::new(*point, dip, dip_direction)?;
        // with_radius is for joints that end.
        Ok(joint_to(&if radius == f64::INFINITY { joint } else { joint.with_radius(radius)? }))
    })
}

/// The joint that is a convex polygon, by its corners in their order; pp_rock_new is given the corners again.
///
/// corners: count rows of x, y, z. out: receives the joint, with a unit normal.
/// message: receives, on failure, a sentence (may be NULL).
/// Errors: PP_NULL_POINTER, PP_BAD_ROCK (corners off one plane, on one line, or not of a convex polygon).
/// Pointers: corners points to 3*count doubles, message to message_size bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_joint_from_corners(
    corners: *const f64,
    count: usize,
    out: *mut pp_joint,
    message: *mut c_char,
    message_size: usize,
) -> pp_status {
    explain!(message[message_size], "out", out, [corners[count]], {
        let corners: &[[f64; 3]] = corners;
        Ok(joint_to(&Joint::polygon(corners)?))
    })
}

/// The joints of a set within reach of a point, both lengths: those that cross the line through it along
/// the mean normal, of equal spacings one at the point itself; discs that reach into the ball.
///
/// joints: room for capacity joints; may be NULL when capacity is 0. count: receives their number, also
/// when the buffer is too small (PP_BUFFER_TOO_SMALL), so that one call asks the size.
/// message: receives, on failure, a sentence that names the value (may be NULL).
/// Errors: PP_NULL_POINTER, PP_BAD_ROCK, PP_BAD_SETTING (exponential), PP_BUFFER_TOO_SMALL.
/// Pointers: centre points to 3 doubles, message to message_size bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_joint_set_joints(
    set: *const pp_joint_set,
    centre: *const f64,
    reach: f64,
    joints: *mut pp_joint,
    capacity: usize,
    count: *mut usize,
    message: *mut c_char,
    message_size: usize,
) -> pp_status {
    explain!(message[message_size], "joints and count", (joints, capacity, count), [set, centre], {
        Ok(set.joints(*centre, reach)?.into_iter().map(|joint| joint_to(&joint)))
    })
}

impl Refusal for RockError {
    fn status(&self) -> pp_status {
        PP_BAD_ROCK
    }
}

/// How many rows all counts need.
pub(super) fn sum_of(counts: &[usize]) -> Result<usize, pp_status> {
    counts.iter().try_fold(0usize, |sum, count| sum.checked_add(*count)).ok_or(PP_BAD_INDEX)
}

/// Joints with their outlines.
///
/// # Safety
/// The pointers are as of pp_rock_new.
pub(super) unsafe fn joints_from(
    joints: &[pp_joint],
    outlines: *const f64,
    outline_counts: *const usize,
) -> Result<Vec<Joint>, Refused> {
    if outline_counts.is_null() {
        return Ok(joints.iter().map(joint_from).collect());
    }
    let joint_count = joints.len();
    let counts: &[usize] = take!(outline_counts[joint_count])?;
    let sum = sum_of(counts)?;
    let mut left: &[[f64; 3]] = take!(outlines[sum]).map_err(|status| Refused::argument(status, "outlines"))?;
    let mut made = Vec::with_capacity(joints.len());
    for (number, (joint, &count)) in joints.iter().zip(counts).enumerate() {
        let (corners, rest) = left.split_at(count);
        left = rest;
        made.push(match if count == 0 { Ok(joint_from(joint)) } else { Joint::polygon(corners) } {
            Err(RockError::NoPolygon(must)) => Err(RockError::NoOutline { joint: number, must }),
            made => made,
        }?);
    }
    Ok(made)
}

fn joint_to(joint: &Joint) -> pp_joint {
    pp_joint { point: joint.point.into(), normal: joint.normal.into(), radius: joint.radius }
}

fn joint_from(joint: &pp_joint) -> Joint {
    Joint { point: joint.point.into(), normal: joint.normal.into(), radius: joint.radius, outline: None }
}

objects! { pp_joint_set => JointSet, |set| set_from(set); }

fn set_from(set: &pp_joint_set) -> Result<JointSet, pp_status> {
    let reserved_is_used = set.reserved != 0 || set.exponential > 1;
    if reserved_is_used {
        return Err(PP_BAD_SETTING);
    }
    Ok(JointSet {
        dip: set.dip,
        dip_direction: set.dip_direction,
        spacing: set.spacing,
        exponential: set.exponential == 1,
        fisher: set.fisher,
        radius: set.radius,
        seed: set.seed,
    })
}
