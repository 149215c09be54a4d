//! Packings over the C boundary: bodies are handed over as they find their places.

use super::argument::{Argument, objects, take};
use super::message::{Refusal, Refused, explain};
use super::particle::pp_particle;
use super::status::*;
use super::types::pp_pose;
use crate::Particle;
use crate::packing::{Arrangement, Container, PackError, Packing, Placement, Sizes, pack};
use std::ffi::{c_char, c_void};

/// A box, sides along the axes.
pub const PP_BOX: u32 = 0;
/// The upright cylinder that stands in a box, as wide as its smaller width.
pub const PP_CYLINDER: u32 = 1;

/// Bodies anywhere in the container, the largest first: random sequential addition.
pub const PP_SCATTERED: u32 = 0;
/// Each body as low as it gets, from the bottom upwards: a loose packing.
pub const PP_SETTLED: u32 = 1;

/// Rows of sizes: a size, and its share of the number of bodies; shares add up to 1.
pub const PP_BY_NUMBER: u32 = 0;
/// Rows of sizes: a size, and its share of the mass; shares add up to 1.
pub const PP_BY_MASS: u32 = 1;
/// Rows of sizes: a grading curve, each row a size and the share of the mass in smaller bodies, linear
/// between rows. Sizes increase from row to row, and shares from 0 to 1.
pub const PP_PASSING: u32 = 2;

/// What pp_pack fills, and how.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_packing {
    /// PP_BOX or PP_CYLINDER.
    pub container: u32,
    /// PP_SCATTERED or PP_SETTLED.
    pub arrangement: u32,
    /// What the rows of sizes mean: PP_BY_NUMBER, PP_BY_MASS or PP_PASSING.
    pub shares: u32,
    /// Threads that work on it, the calling one among them: 0 and 1 mean the calling thread alone.
    pub threads: u32,
    /// Lowest corner of the box, or of that about the cylinder; world frame, z upwards, length.
    pub lower: [f64; 3],
    /// Highest corner of it.
    pub upper: [f64; 3],
    /// Least distance between two bodies, length; that of a body to the container is half of it. Bodies are
    /// a millionth of their size apart in any case.
    pub margin: f64,
    /// The same seed gives the same packing, whatever the number of threads.
    pub seed: u64,
    /// How many bodies; 0: as many as fit (PP_SETTLED only).
    pub number: u64,
}

/// A body of a packing: a shape, scaled, at a pose.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_placement {
    /// Where it is.
    pub pose: pp_pose,
    /// Factor by which d, r and R of the shape are multiplied.
    pub scale: f64,
    /// Index into the shapes.
    pub shape: u32,
    /// Always 0.
    pub reserved: u32,
}

/// Receives bodies that have found their places, each once, in the calling thread, several times during
/// pp_pack; also with a count of 0, when none has for a while. Returns 0 to go on; anything else ends the
/// packing with the bodies handed over so far.
///
/// context: as given to pp_pack. placements: valid during this call only, and not to be read when count is
/// 0. It may call functions of this library; no exception and no longjmp may leave it.
pub type pp_placed =
    Option<unsafe extern "C" fn(context: *mut c_void, placements: *const pp_placement, count: usize) -> i32>;

/// Fills a box or an upright cylinder with bodies of random orientation that do not overlap, as
/// pp_contact_detect decides.
///
/// shapes: shape_count particles, each as likely as the others. sizes: size_count rows of a size and a
/// share, see struct pp_packing; a size is the diameter of a ball of the body's volume. May be NULL when
/// size_count is 0: shapes as they are.
/// placed: receives the bodies; see pp_placed. The packing ends with the number asked for, when placed ends
/// it, or when no further body finds a place: then fewer have been handed over.
/// message: receives, on failure, a sentence that names the value (may be NULL).
/// Pointers: shapes points to shape_count particles, sizes to 2*size_count doubles, message to message_size
/// bytes; placed is a function.
/// Errors: PP_NULL_POINTER, PP_BAD_PACKING, PP_BAD_INDEX (a count that no memory could hold).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_pack(
    shapes: *const *const pp_particle,
    shape_count: usize,
    sizes: *const f64,
    size_count: usize,
    how: *const pp_packing,
    placed: pp_placed,
    context: *mut c_void,
    message: *mut c_char,
    message_size: usize,
) -> pp_status {
    explain!(message[message_size], "", (), [shapes[shape_count], sizes[size_count], how], {
        // SAFETY: each is NULL or a particle.
        let shapes: Result<Vec<Particle>, pp_status> =
            shapes.iter().map(|&shape| take!(shape).map(Particle::clone)).collect();
        let shapes = shapes.map_err(|status| Refused::argument(status, "each of shapes"))?;
        let placed = placed.ok_or_else(|| Refused::argument(PP_NULL_POINTER, "placed"))?;
        let mut handed_over = 0;
        let hand_over = |all: &[Placement]| {
            let new: Vec<pp_placement> = all[handed_over..].iter().map(placement_to).collect();
            handed_over = all.len();
            // SAFETY: the caller's function, with what it asks for.
            unsafe { placed(context, new.as_ptr(), new.len()) == 0 }
        };
        let (packing, container) = (packing_from(how)?, container_from(how)?);
        pack(&container, &shapes, &sizes_from(how.shares, sizes)?, &packing, hand_over)?;
        Ok(())
    })
}

objects! { pp_packing => &'a pp_packing, |how| Ok(how); }

impl Refusal for PackError {
    fn status(&self) -> pp_status {
        PP_BAD_PACKING
    }
}

fn unknown(text: String) -> Refused {
    Refused::new(PP_BAD_PACKING, text)
}

fn packing_from(how: &pp_packing) -> Result<Packing, Refused> {
    Ok(Packing {
        arrangement: match how.arrangement {
            PP_SCATTERED => Arrangement::Scattered,
            PP_SETTLED => Arrangement::Settled,
            other => return Err(unknown(format!("arrangement {other} is unknown: use PP_SCATTERED or PP_SETTLED"))),
        },
        number: match how.number {
            0 => None,
            number => Some(usize::try_from(number).unwrap_or(usize::MAX)),
        },
        margin: how.margin,
        seed: how.seed,
        threads: how.threads as usize,
    })
}

fn container_from(how: &pp_packing) -> Result<Container, Refused> {
    let (lower, upper) = (how.lower, how.upper);
    match how.container {
        PP_BOX => Ok(Container::cuboid(lower, upper)?),
        PP_CYLINDER => {
            let middle = |axis: usize| lower[axis] + 0.5 * (upper[axis] - lower[axis]);
            let radius = 0.5 * (upper[0] - lower[0]).min(upper[1] - lower[1]);
            Ok(Container::cylinder([middle(0), middle(1), lower[2]], radius, upper[2] - lower[2])?)
        }
        other => Err(unknown(format!("container {other} is unknown: use PP_BOX or PP_CYLINDER"))),
    }
}

fn sizes_from(shares: u32, rows: &[[f64; 2]]) -> Result<Sizes, Refused> {
    match shares {
        _ if rows.is_empty() => Ok(Sizes::as_given()),
        PP_BY_NUMBER => Ok(Sizes::by_number(rows)?),
        PP_BY_MASS => Ok(Sizes::by_mass(rows)?),
        PP_PASSING => Ok(Sizes::passing(rows)?),
        other => Err(unknown(format!("shares {other} is unknown: use PP_BY_NUMBER, PP_BY_MASS or PP_PASSING"))),
    }
}

fn placement_to(placement: &Placement) -> pp_placement {
    pp_placement {
        pose: pp_pose { position: (*placement.pose.position()).into(), orientation: placement.pose.orientation() },
        scale: placement.scale,
        // Fewer shapes than 2³² fit into memory.
        shape: placement.shape as u32,
        reserved: 0,
    }
}
