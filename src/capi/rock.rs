//! Rock masses over the C boundary: cut once, then read by the functions of `rock_arrays`.

use super::argument::{Argument, objects, take};
use super::convert::planes_of;
use super::message::{Refused, explain};
use super::output::{New, release};
use super::rock_joints::{joints_from, pp_joint, sum_of};
use super::status::*;
use crate::Plane;
use crate::rock::{Partners, RockMass, SliceSettings, slice_with_regions};
use std::ffi::{c_char, c_void};

/// Limits of a rock mass.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_slice_settings {
    /// A joint leaves a block whole if a part would have less than this volume.
    pub least_volume: f64,
    /// It also leaves it whole if a part would be thinner than this: 2 V / A of the part's volume and
    /// surface, length (a third of the edge of a cube).
    pub least_thickness: f64,
    /// And if the largest ball in a part would have a smaller diameter than this.
    pub least_width: f64,
    /// And if the extent of a part along x, y or z would be more than so many times the diameter of that
    /// ball; 0 or infinity: no limit.
    pub largest_aspect: f64,
    /// More blocks than this are an error; 0: a million.
    pub most_blocks: u64,
    /// How many threads cut, the calling one among them; 0: one. The blocks are the same for any number.
    pub threads: u64,
}

/// Called before the first joint and again after every few, in the calling thread, with the numbers of
/// joints that have cut and of blocks that there are. Returns 0 to go on; anything else ends the cuts of
/// joints, and what was cut is kept. No exception and no longjmp may leave it.
pub type pp_rock_progress = Option<unsafe extern "C" fn(context: *mut c_void, joints: u64, blocks: u64) -> i32>;

/// A rock mass that was cut. Created by pp_rock_new, released by pp_rock_free; it never changes.
pub struct pp_rock {
    pub(super) mass: RockMass,
    pub(super) partners: Vec<Partners>,
}

objects! { pp_rock => &'a pp_rock, |rock| Ok(rock); }

impl pp_rock {
    fn of(mass: RockMass) -> Self {
        let partners = mass.partners();
        Self { mass, partners }
    }

    pub(super) fn face_count(&self) -> usize {
        self.mass.blocks.iter().map(|block| block.faces.len()).sum()
    }

    /// Index of the first face of each block among all.
    pub(super) fn first_faces(&self) -> Vec<usize> {
        let of_block = |first: &mut usize, count: usize| Some(std::mem::replace(first, *first + count));
        self.mass.blocks.iter().map(|block| block.faces.len()).scan(0, of_block).collect()
    }
}

/// Cuts a convex domain by joints, one after the other: each cuts the blocks that it meets in two, a disc
/// or polygon all of a block that it reaches. Regions (a tunnel, a bench, what a domain that is not convex
/// leaves out) then cut the blocks that they meet into what lies in the region and the parts beside it,
/// which keep their parent.
///
/// planes: plane_count rows of a, b, c, d: the domain is where a x + b y + c z <= d for all of them.
/// joints: joint_count joints; may be NULL when there are none.
/// outline_counts: NULL, or for each joint how many corners it has as a polygon, 0 for a plane or disc;
/// outlines: the corners of all of them, rows of x, y, z in their order.
/// region_planes: the planes of all regions, rows as of the domain; region_counts: how many belong to each
/// of region_count regions.
/// settings: NULL for none. progress: NULL, or see pp_rock_progress.
/// out: receives the rock mass; release it with pp_rock_free.
/// message: receives, on failure, a sentence that names the plane, joint or value (may be NULL).
/// Errors: PP_NULL_POINTER, PP_BAD_ROCK, PP_BAD_INDEX (a count that no memory could hold).
/// Pointers: planes points to 4*plane_count doubles, outlines to 3 doubles for each of the sum of
/// outline_counts, region_planes to 4 for each of that of region_counts, message to message_size bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_rock_new(
    planes: *const f64,
    plane_count: usize,
    joints: *const pp_joint,
    joint_count: usize,
    outlines: *const f64,
    outline_counts: *const usize,
    region_planes: *const f64,
    region_counts: *const usize,
    region_count: usize,
    settings: *const pp_slice_settings,
    progress: pp_rock_progress,
    context: *mut c_void,
    out: *mut *mut pp_rock,
    message: *mut c_char,
    message_size: usize,
) -> pp_status {
    let goes_on = |joints: usize, blocks: usize| match progress {
        // SAFETY: the caller's function, with what it asks for.
        Some(progress) => unsafe { progress(context, joints as u64, blocks as u64) == 0 },
        None => true,
    };
    explain!(
        message[message_size],
        "out",
        New(out),
        [planes[plane_count], joints[joint_count], region_counts[region_count]],
        {
            // SAFETY: the caller promised as many corners.
            let joints = unsafe { joints_from(joints, outlines, outline_counts) }?;
            let sum = sum_of(region_counts)?;
            let region_planes =
                take!(region_planes[sum]).map_err(|status| Refused::argument(status, "region_planes"))?;
            let mut left = planes_of(region_planes).into_iter();
            let regions: Vec<Vec<Plane>> =
                region_counts.iter().map(|count| left.by_ref().take(*count).collect()).collect();
            // SAFETY: NULL or the caller's.
            let settings = settings_of(unsafe { settings.as_ref() });
            Ok(pp_rock::of(slice_with_regions(&planes_of(planes), &joints, &regions, &settings, goes_on)?))
        }
    )
}

/// Releases a rock mass; NULL is allowed and does nothing.
/// Pointers: rock is NULL or came from pp_rock_new and was not released yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_rock_free(rock: *mut pp_rock) {
    // SAFETY: as promised.
    unsafe { release(rock) }
}

fn settings_of(settings: Option<&pp_slice_settings>) -> SliceSettings {
    let Some(settings) = settings else { return SliceSettings::default() };
    let whole = |number: u64| usize::try_from(number).unwrap_or(usize::MAX);
    SliceSettings {
        least_volume: settings.least_volume,
        least_thickness: settings.least_thickness,
        least_width: settings.least_width,
        largest_aspect: if settings.largest_aspect == 0.0 { f64::INFINITY } else { settings.largest_aspect },
        threads: whole(settings.threads),
        most_blocks: if settings.most_blocks == 0 {
            SliceSettings::default().most_blocks
        } else {
            whole(settings.most_blocks)
        },
    }
}
