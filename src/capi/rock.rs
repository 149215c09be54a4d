//! Rock masses over the C boundary: cut once, then read as arrays.

use super::fence::{array, borrow, check_room, fenced, output, outputs, write_rows};
use super::particle::{explain_status, write_message};
use super::status::*;
use crate::Plane;
use crate::rock::{FaceOf, Joint, JointSet, Partners, RockError, RockMass, SliceSettings, slice_with_regions};
use std::ffi::{c_char, c_void};

/// A side of the domain.
pub const PP_FACE_OF_DOMAIN: u32 = 0;
/// A joint.
pub const PP_FACE_OF_JOINT: u32 = 1;
/// A plane of a region.
pub const PP_FACE_OF_REGION: u32 = 2;

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
    /// ball; 0: no limit.
    pub largest_aspect: f64,
    /// More blocks than this are an error; 0: a million.
    pub most_blocks: u64,
    /// How many threads cut, the calling one among them; 0: one. The blocks are the same for any number.
    pub threads: u64,
}

/// A rock mass in numbers.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_rock_summary {
    /// Blocks.
    pub blocks: u64,
    /// Faces of all of them.
    pub faces: u64,
    /// Corners of all faces.
    pub corners: u64,
    /// Pairs of faces that lie on each other.
    pub partners: u64,
    /// Joints that have cut: all, unless progress ended it.
    pub joints: u64,
    /// Joints among them that met no block.
    pub missing: u64,
    /// Cuts that were left out as a part would have been smaller than the settings allow, or as thin as
    /// rounding.
    pub too_small: u64,
    /// Blocks that were left whole where the parts would not have closed, by rounding.
    pub unclosed: u64,
}

/// A block: axes and origin of the domain.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_block {
    /// Volume.
    pub volume: f64,
    /// Centroid.
    pub centroid: [f64; 3],
    /// Inertia about the centroid for density 1: xx, yy, zz, xy, xz, yz, with products as they stand in the
    /// matrix.
    pub inertia: [f64; 6],
    /// Index of its first face; the others follow.
    pub first_face: u64,
    /// How many faces it has.
    pub face_count: u64,
    /// Blocks with the same number were one before regions cut it.
    pub parent: u64,
    /// Index of the region that it lies in; -1: none.
    pub region: i64,
}

/// A face of a block.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_block_face {
    /// PP_FACE_OF_DOMAIN, PP_FACE_OF_JOINT or PP_FACE_OF_REGION.
    pub of: u32,
    /// Index of the region, else 0.
    pub region: u32,
    /// Index of the plane of the domain, of the joint, or of the plane of the region.
    pub index: u64,
    /// Unit outward normal and offset: the block lies where n.x <= d.
    pub plane: [f64; 4],
    /// Area.
    pub area: f64,
    /// Index of its first corner; the others follow, counter-clockwise from outside.
    pub first_corner: u64,
    /// How many corners it has.
    pub corner_count: u64,
    /// Index of its block.
    pub block: u64,
}

/// Two faces that lie on each other.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_face_partners {
    /// Their indices.
    pub faces: [u64; 2],
    /// Area that they share; those of all partners of a face sum to its own.
    pub area: f64,
}

/// Called before each joint, in the calling thread, with the numbers of joints that have cut and of blocks
/// that there are. Returns 0 to go on; anything else ends the cuts of joints, and what was cut is kept. No
/// exception and no longjmp may leave it.
pub type pp_rock_progress = Option<unsafe extern "C" fn(context: *mut c_void, joints: u64, blocks: u64) -> i32>;

/// A rock mass that was cut. Created by pp_rock_new, released by pp_rock_free; it never changes.
pub struct pp_rock {
    mass: RockMass,
    partners: Vec<Partners>,
}

impl pp_rock {
    fn of(mass: RockMass) -> Self {
        let partners = mass.partners();
        Self { mass, partners }
    }

    fn face_count(&self) -> usize {
        self.mass.blocks.iter().map(|block| block.faces.len()).sum()
    }

    /// Index of the first face of each block among all.
    fn first_faces(&self) -> Vec<usize> {
        let of_block = |first: &mut usize, count: usize| Some(std::mem::replace(first, *first + count));
        self.mass.blocks.iter().map(|block| block.faces.len()).scan(0, of_block).collect()
    }
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
    let make = || {
        let point = *unsafe { borrow(point.cast::<[f64; 3]>()) }?;
        let out = unsafe { output(out) }?;
        let joint = Joint::new(point, dip, dip_direction);
        // with_radius is for joints that end.
        let joint = if radius == f64::INFINITY { joint } else { joint.and_then(|joint| joint.with_radius(radius)) };
        Ok(joint.map(|joint| out.write(joint_to(&joint))))
    };
    unsafe { told(make, "point and joint must not be NULL", message, message_size) }
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
    let make = || {
        let corners = unsafe { array(corners.cast::<[f64; 3]>(), count) }?;
        let out = unsafe { output(out) }?;
        Ok(Joint::polygon(corners).map(|joint| out.write(joint_to(&joint))))
    };
    unsafe { told(make, "corners and joint must not be NULL", message, message_size) }
}

/// The joints of a set within reach of a point, both lengths: those that cross the line through it along
/// the mean normal, of equal spacings one at the point itself; discs that reach into the ball.
///
/// joints: room for capacity joints; may be NULL when capacity is 0. count: receives their number, also
/// when the buffer is too small (PP_BUFFER_TOO_SMALL), so that one call asks the size.
/// message: receives, on failure, a sentence that names the value (may be NULL).
/// Errors: PP_NULL_POINTER, PP_BAD_ROCK, PP_BUFFER_TOO_SMALL.
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
    let make = || {
        let set = unsafe { borrow(set) }?;
        let centre = *unsafe { borrow(centre.cast::<[f64; 3]>()) }?;
        let reserved_is_used = set.reserved != 0 || set.exponential > 1;
        if reserved_is_used {
            return Err(PP_BAD_SETTING);
        }
        let made = match set_from(set).joints(centre, reach) {
            Ok(made) => made,
            Err(error) => return Ok(Err(error)),
        };
        unsafe { write_all(made.iter().map(joint_to), joints, capacity, count) }.map(Ok)
    };
    unsafe {
        told(make, "set, centre and count, and joints of a capacity above 0, must not be NULL", message, message_size)
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
    let make = || {
        let out = unsafe { output(out) }?;
        let domain = unsafe { planes_from(planes, plane_count) }?;
        let joints = unsafe { joints_from(joints, joint_count, outlines, outline_counts) }?;
        let counts = unsafe { array(region_counts, region_count) }?;
        let sum = counts.iter().try_fold(0usize, |sum, count| sum.checked_add(*count)).ok_or(PP_BAD_INDEX)?;
        let mut left = unsafe { planes_from(region_planes, sum) }?.into_iter();
        let regions: Vec<Vec<Plane>> = counts.iter().map(|count| left.by_ref().take(*count).collect()).collect();
        // SAFETY: NULL or the caller's.
        let settings = settings_from(unsafe { settings.as_ref() });
        let told = |joints: usize, blocks: usize| match progress {
            // SAFETY: the caller's function, with what it asks for.
            Some(progress) => unsafe { progress(context, joints as u64, blocks as u64) == 0 },
            None => true,
        };
        let (joints, settings) = match (joints, settings) {
            (Ok(joints), Ok(settings)) => (joints, settings),
            (Err(error), _) | (_, Err(error)) => return Ok(Err(error)),
        };
        let mass = slice_with_regions(&domain, &joints, &regions, &settings, told);
        Ok(mass.map(|mass| out.write(Box::into_raw(Box::new(pp_rock::of(mass))))))
    };
    unsafe { told(make, "planes, joints, regions and out must not be NULL", message, message_size) }
}

/// Releases a rock mass; NULL is allowed and does nothing.
/// Pointers: rock is NULL or came from pp_rock_new and was not released yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_rock_free(rock: *mut pp_rock) {
    if !rock.is_null() {
        // SAFETY: by contract this came from Box::into_raw and is freed once.
        drop(unsafe { Box::from_raw(rock) });
    }
}

/// How much there is to read, and what was left out.
///
/// Errors: PP_NULL_POINTER.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_rock_get_summary(rock: *const pp_rock, summary: *mut pp_rock_summary) -> pp_status {
    fenced(|| {
        let rock = unsafe { borrow(rock) }?;
        let faces = rock.mass.blocks.iter().flat_map(|block| &block.faces);
        unsafe { output(summary) }?.write(pp_rock_summary {
            blocks: rock.mass.blocks.len() as u64,
            faces: rock.face_count() as u64,
            corners: faces.map(|face| face.corners.len() as u64).sum(),
            partners: rock.partners.len() as u64,
            joints: rock.mass.joints as u64,
            missing: rock.mass.missing.len() as u64,
            too_small: rock.mass.too_small as u64,
            unclosed: rock.mass.unclosed as u64,
        });
        Ok(())
    })
}

/// All blocks.
///
/// blocks: room for capacity of them; may be NULL when capacity is 0. count: receives their number, also
/// when the buffer is too small.
/// Errors: PP_NULL_POINTER, PP_BUFFER_TOO_SMALL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_rock_blocks(
    rock: *const pp_rock,
    blocks: *mut pp_block,
    capacity: usize,
    count: *mut usize,
) -> pp_status {
    fenced(|| {
        let rock = unsafe { borrow(rock) }?;
        let rows = rock.mass.blocks.iter().zip(rock.first_faces()).map(|(block, first)| {
            let i = block.inertia();
            pp_block {
                volume: block.volume,
                centroid: block.centroid.into(),
                inertia: [i.m11, i.m22, i.m33, i.m12, i.m13, i.m23],
                first_face: first as u64,
                face_count: block.faces.len() as u64,
                parent: block.parent as u64,
                region: block.region.map_or(-1, |region| region as i64),
            }
        });
        unsafe { write_all(rows, blocks, capacity, count) }
    })
}

/// All faces, those of the first block first.
///
/// faces: room for capacity of them; may be NULL when capacity is 0. count: receives their number, also
/// when the buffer is too small.
/// Errors: PP_NULL_POINTER, PP_BUFFER_TOO_SMALL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_rock_faces(
    rock: *const pp_rock,
    faces: *mut pp_block_face,
    capacity: usize,
    count: *mut usize,
) -> pp_status {
    fenced(|| {
        let rock = unsafe { borrow(rock) }?;
        let mut first_corner = 0;
        let mut rows = Vec::with_capacity(rock.face_count());
        for (number, block) in rock.mass.blocks.iter().enumerate() {
            for face in &block.faces {
                let (of, region, index) = match face.of {
                    FaceOf::Domain(plane) => (PP_FACE_OF_DOMAIN, 0, plane),
                    FaceOf::Joint(joint) => (PP_FACE_OF_JOINT, 0, joint),
                    FaceOf::Region { region, plane } => (PP_FACE_OF_REGION, region, plane),
                };
                let Plane { normal: n, offset } = face.plane;
                rows.push(pp_block_face {
                    of,
                    // Fewer regions than 2^32 fit into memory.
                    region: region as u32,
                    index: index as u64,
                    plane: [n.x, n.y, n.z, offset],
                    area: face.area,
                    first_corner,
                    corner_count: face.corners.len() as u64,
                    block: number as u64,
                });
                first_corner += face.corners.len() as u64;
            }
        }
        unsafe { write_all(rows.into_iter(), faces, capacity, count) }
    })
}

/// The corners of all faces: rows of x, y, z.
///
/// corners: room for capacity rows; may be NULL when capacity is 0. count: receives their number, also when
/// the buffer is too small.
/// Errors: PP_NULL_POINTER, PP_BUFFER_TOO_SMALL.
/// Pointers: corners is valid for writing 3*capacity doubles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_rock_corners(
    rock: *const pp_rock,
    corners: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> pp_status {
    fenced(|| {
        let faces = unsafe { borrow(rock) }?.mass.blocks.iter().flat_map(|block| &block.faces);
        let rows: Vec<[f64; 3]> = faces.flat_map(|face| &face.corners).map(|at| (*at).into()).collect();
        unsafe { write_rows(rows.into_iter(), corners, capacity, count) }
    })
}

/// All pairs of faces that lie on each other.
///
/// partners: room for capacity of them; may be NULL when capacity is 0. count: receives their number, also
/// when the buffer is too small.
/// Errors: PP_NULL_POINTER, PP_BUFFER_TOO_SMALL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_rock_partners(
    rock: *const pp_rock,
    partners: *mut pp_face_partners,
    capacity: usize,
    count: *mut usize,
) -> pp_status {
    fenced(|| {
        let rock = unsafe { borrow(rock) }?;
        let first = rock.first_faces();
        let rows = rock.partners.iter().map(|pair| pp_face_partners {
            faces: pair.faces.map(|[block, face]| (first[block] + face) as u64),
            area: pair.area,
        });
        unsafe { write_all(rows, partners, capacity, count) }
    })
}

/// The joints that met no block, by their indices.
///
/// joints: room for capacity numbers; may be NULL when capacity is 0. count: receives how many there are,
/// also when the buffer is too small.
/// Errors: PP_NULL_POINTER, PP_BUFFER_TOO_SMALL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_rock_missing_joints(
    rock: *const pp_rock,
    joints: *mut u64,
    capacity: usize,
    count: *mut usize,
) -> pp_status {
    fenced(|| {
        let rock = unsafe { borrow(rock) }?;
        unsafe { write_all(rock.mass.missing.iter().map(|joint| *joint as u64), joints, capacity, count) }
    })
}

/// Runs `make`; an error of the rock is PP_BAD_ROCK with its own sentence as the message, `null` the one
/// for a pointer that is NULL.
/// Pointers: message is NULL or valid for writing size bytes.
unsafe fn told(
    make: impl FnOnce() -> Result<Result<(), RockError>, pp_status>,
    null: &str,
    message: *mut c_char,
    size: usize,
) -> pp_status {
    let status = fenced(|| {
        make()?.map_err(|error| {
            // SAFETY: by contract.
            unsafe { write_message(&error.to_string(), message, size) };
            PP_BAD_ROCK
        })
    });
    // SAFETY: by contract.
    unsafe { explain_status(status, null, message, size) };
    status
}

/// Writes all rows and how many there are; with too little room, only how many there are.
/// Pointers: to is NULL or valid for writing capacity rows, count NULL or valid for writing one number.
unsafe fn write_all<T>(
    rows: impl ExactSizeIterator<Item = T>,
    to: *mut T,
    capacity: usize,
    count: *mut usize,
) -> Result<(), pp_status> {
    let count = unsafe { output(count) }?;
    check_room(to, capacity)?;
    let there_are = rows.len();
    count.write(there_are);
    if there_are > capacity {
        return Err(PP_BUFFER_TOO_SMALL);
    }
    let places = unsafe { outputs(to, there_are) }?;
    places.iter_mut().zip(rows).for_each(|(place, row)| _ = place.write(row));
    Ok(())
}

/// Rows of a, b, c, d.
/// Pointers: planes is NULL or points to 4*count doubles.
unsafe fn planes_from(planes: *const f64, count: usize) -> Result<Vec<Plane>, pp_status> {
    let rows = unsafe { array(planes.cast::<[f64; 4]>(), count) }?;
    Ok(rows.iter().map(|row| Plane::from(*row)).collect())
}

/// Joints with their outlines.
/// Pointers: as of pp_rock_new.
unsafe fn joints_from(
    joints: *const pp_joint,
    count: usize,
    outlines: *const f64,
    outline_counts: *const usize,
) -> Result<Result<Vec<Joint>, RockError>, pp_status> {
    let joints = unsafe { array(joints, count) }?;
    if outline_counts.is_null() {
        return Ok(Ok(joints.iter().map(joint_from).collect()));
    }
    let counts = unsafe { array(outline_counts, count) }?;
    let sum = counts.iter().try_fold(0usize, |sum, count| sum.checked_add(*count)).ok_or(PP_BAD_INDEX)?;
    let mut left = unsafe { array(outlines.cast::<[f64; 3]>(), sum) }?;
    let mut made = Vec::with_capacity(count);
    for (number, (joint, &count)) in joints.iter().zip(counts).enumerate() {
        let (corners, rest) = left.split_at(count);
        left = rest;
        match if count == 0 { Ok(joint_from(joint)) } else { Joint::polygon(corners) } {
            Ok(joint) => made.push(joint),
            Err(RockError::NoPolygon(must)) => return Ok(Err(RockError::NoOutline { joint: number, must })),
            Err(error) => return Ok(Err(error)),
        }
    }
    Ok(Ok(made))
}

fn joint_to(joint: &Joint) -> pp_joint {
    pp_joint { point: joint.point.into(), normal: joint.normal.into(), radius: joint.radius }
}

fn joint_from(joint: &pp_joint) -> Joint {
    Joint { point: joint.point.into(), normal: joint.normal.into(), radius: joint.radius, outline: None }
}

fn set_from(set: &pp_joint_set) -> JointSet {
    JointSet {
        dip: set.dip,
        dip_direction: set.dip_direction,
        spacing: set.spacing,
        exponential: set.exponential == 1,
        fisher: set.fisher,
        radius: set.radius,
        seed: set.seed,
    }
}

fn settings_from(settings: Option<&pp_slice_settings>) -> Result<SliceSettings, RockError> {
    let Some(settings) = settings else { return Ok(SliceSettings::default()) };
    let not_negative = |value: f64, name: &'static str| {
        let is_fine = value >= 0.0 && value.is_finite();
        if is_fine { Ok(value) } else { Err(RockError::OutOfRange { name, value, range: "0 or above" }) }
    };
    Ok(SliceSettings {
        least_volume: not_negative(settings.least_volume, "least_volume")?,
        least_thickness: not_negative(settings.least_thickness, "least_thickness")?,
        least_width: not_negative(settings.least_width, "least_width")?,
        largest_aspect: match not_negative(settings.largest_aspect, "largest_aspect")? {
            0.0 => f64::INFINITY,
            aspect => aspect,
        },
        threads: usize::try_from(settings.threads).unwrap_or(usize::MAX),
        most_blocks: match settings.most_blocks {
            0 => SliceSettings::default().most_blocks,
            most => usize::try_from(most).unwrap_or(usize::MAX),
        },
    })
}
