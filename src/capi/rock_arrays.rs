//! What was cut, over the C boundary: a rock mass read as arrays.

use super::fence::give;
use super::rock::pp_rock;
use super::status::*;
use crate::Plane;
use crate::rock::{FaceOf, Partners};
use nalgebra::Vector3;

/// A side of the domain.
pub const PP_FACE_OF_DOMAIN: u32 = 0;
/// A joint.
pub const PP_FACE_OF_JOINT: u32 = 1;
/// A plane of a region.
pub const PP_FACE_OF_REGION: u32 = 2;

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
    /// Inertia about the centroid for density 1: xx, yy, zz, xy, yz, zx, as in pp_mass_properties, with products
    /// as they stand in the matrix.
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
    /// The part of it that lies in the true extent of its joint, a disc or polygon; all of it where the joint
    /// has no end, 0 on other planes.
    pub jointed_area: f64,
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

/// How much there is to read, and what was left out.
///
/// Errors: PP_NULL_POINTER.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_rock_get_summary(rock: *const pp_rock, summary: *mut pp_rock_summary) -> pp_status {
    give!(summary, [rock], {
        let mass = &rock.mass;
        Ok(pp_rock_summary {
            blocks: mass.blocks.len() as u64,
            faces: rock.face_count() as u64,
            corners: mass.blocks.iter().map(|block| block.corners.len() as u64).sum(),
            partners: rock.partners.len() as u64,
            joints: mass.joints as u64,
            missing: mass.missing.len() as u64,
            too_small: mass.too_small as u64,
            unclosed: mass.unclosed as u64,
        })
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
    give!((blocks, capacity, count), [rock], {
        Ok(rock.mass.blocks.iter().zip(rock.first_faces()).map(|(block, first)| {
            let i = block.inertia();
            pp_block {
                volume: block.volume,
                centroid: block.centroid.into(),
                inertia: [i.m11, i.m22, i.m33, i.m12, i.m23, i.m13],
                first_face: first as u64,
                face_count: block.faces.len() as u64,
                parent: block.parent as u64,
                region: block.region.map_or(-1, |region| region as i64),
            }
        }))
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
    give!((faces, capacity, count), [rock], {
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
                let corner_count = block.corners_of(face).len() as u64;
                rows.push(pp_block_face {
                    of,
                    // Fewer regions than 2^32 fit into memory.
                    region: region as u32,
                    index: index as u64,
                    plane: [n.x, n.y, n.z, offset],
                    area: face.area,
                    jointed_area: face.jointed_area,
                    first_corner,
                    corner_count,
                    block: number as u64,
                });
                first_corner += corner_count;
            }
        }
        Ok(rows.into_iter())
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
    give!((corners, capacity, count), [rock], {
        let corners: Vec<Vector3<f64>> = rock.mass.blocks.iter().flat_map(|block| &block.corners).copied().collect();
        Ok(corners.into_iter())
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
    give!((partners, capacity, count), [rock], {
        let first = rock.first_faces();
        let row = move |pair: &Partners| {
            let faces = pair.faces.map(|[block, face]| (first[block] + face) as u64);
            pp_face_partners { faces, area: pair.area }
        };
        Ok(rock.partners.iter().map(row))
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
    give!((joints, capacity, count), [rock], Ok(rock.mass.missing.iter().map(|joint| *joint as u64)))
}
