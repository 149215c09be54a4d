//! Which library was loaded, and whether its structs are those that the caller was compiled with.

#![allow(missing_docs)] // The first number of a struct has the comment for all.

use super::builder::pp_built;
use super::derivative::{pp_derivatives, pp_shape_gradient};
use super::equilibrium::{pp_equilibrium_result, pp_rigid_body, pp_rigid_contact};
use super::packing::{pp_packing, pp_placement};
use super::patch::{pp_patch, pp_patch_state};
use super::patch_derivatives::pp_patch_derivatives;
use super::planar::{pp_area_properties, pp_patch_2d, pp_pose_2d};
use super::rock::pp_slice_settings;
use super::rock_arrays::{pp_block, pp_block_face, pp_face_partners, pp_rock_summary};
use super::rock_joints::{pp_joint, pp_joint_set};
use super::types::*;
use std::ffi::{CStr, c_char};

/// Version of this header; compare with pp_version of the library that was loaded.
pub const PP_VERSION_MAJOR: u32 = 0;
/// Grows with additions (or, while the major version is 0, with any change of the interface).
pub const PP_VERSION_MINOR: u32 = 2;
/// Grows with corrections that leave the interface as it is.
pub const PP_VERSION_PATCH: u32 = 0;

/// Number of the binary interface: it grows by 1 whenever a program compiled with an older header could
/// not use the library (a struct, a function or the meaning of a number has changed), and not with
/// additions. A program that loads the library should refuse to go on unless pp_abi_version() ==
/// PP_ABI_VERSION.
pub const PP_ABI_VERSION: u32 = 3;

/// Numbers of the structs for pp_struct_size: PP_STRUCT_POSE is that of struct pp_pose, and so on.
pub const PP_STRUCT_POSE: u32 = 1;
pub const PP_STRUCT_SETTINGS: u32 = 2;
pub const PP_STRUCT_CONTACT: u32 = 4;
pub const PP_STRUCT_CLOSEST: u32 = 5;
pub const PP_STRUCT_MASS_PROPERTIES: u32 = 6;
pub const PP_STRUCT_POSE_2D: u32 = 7;
pub const PP_STRUCT_CONTACT_2D: u32 = 8;
pub const PP_STRUCT_CLOSEST_2D: u32 = 9;
pub const PP_STRUCT_AREA_PROPERTIES: u32 = 12;
pub const PP_STRUCT_PACKING: u32 = 14;
pub const PP_STRUCT_PLACEMENT: u32 = 15;
pub const PP_STRUCT_FLAT_CONTACT: u32 = 13;
pub const PP_STRUCT_PAIR_STATE: u32 = 16;
pub const PP_STRUCT_PATCH: u32 = 17;
pub const PP_STRUCT_PATCH_POINT: u32 = 18;
pub const PP_STRUCT_PATCH_2D: u32 = 19;
pub const PP_STRUCT_PATCH_POINT_2D: u32 = 20;
pub const PP_STRUCT_PATCH_STATE: u32 = 21;
pub const PP_STRUCT_JOINT: u32 = 22;
pub const PP_STRUCT_JOINT_SET: u32 = 23;
pub const PP_STRUCT_SLICE_SETTINGS: u32 = 24;
pub const PP_STRUCT_ROCK_SUMMARY: u32 = 25;
pub const PP_STRUCT_BLOCK: u32 = 26;
pub const PP_STRUCT_BLOCK_FACE: u32 = 27;
pub const PP_STRUCT_FACE_PARTNERS: u32 = 28;
pub const PP_STRUCT_DERIVATIVES: u32 = 29;
pub const PP_STRUCT_CONTACT_WEIGHTS: u32 = 30;
pub const PP_STRUCT_SHAPE_GRADIENT: u32 = 31;
pub const PP_STRUCT_POSE_GRADIENT: u32 = 32;
pub const PP_STRUCT_PATCH_DERIVATIVES: u32 = 33;
pub const PP_STRUCT_BUILT: u32 = 34;
pub const PP_STRUCT_RIGID_BODY: u32 = 35;
pub const PP_STRUCT_RIGID_CONTACT: u32 = 36;
pub const PP_STRUCT_EQUILIBRIUM_RESULT: u32 = 37;

/// Version of the loaded library as "major.minor.patch". Static text: do not free it.
#[unsafe(no_mangle)]
pub extern "C" fn pp_version() -> *const c_char {
    const VERSION: &CStr = match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
        Ok(text) => text,
        Err(_) => unreachable!(),
    };
    VERSION.as_ptr()
}

/// PP_ABI_VERSION of the loaded library.
#[unsafe(no_mangle)]
pub extern "C" fn pp_abi_version() -> u32 {
    PP_ABI_VERSION
}

/// Size in bytes of a struct as the loaded library knows it (one of PP_STRUCT_...), to be compared with
/// sizeof; 0 for a number it does not know. For languages that write the structs down themselves.
#[unsafe(no_mangle)]
pub extern "C" fn pp_struct_size(which: u32) -> usize {
    match which {
        PP_STRUCT_POSE => size_of::<pp_pose>(),
        PP_STRUCT_SETTINGS => size_of::<pp_settings>(),
        PP_STRUCT_CONTACT => size_of::<pp_contact>(),
        PP_STRUCT_CLOSEST => size_of::<pp_closest>(),
        PP_STRUCT_MASS_PROPERTIES => size_of::<pp_mass_properties>(),
        PP_STRUCT_POSE_2D => size_of::<pp_pose_2d>(),
        PP_STRUCT_CONTACT_2D => size_of::<pp_contact_2d>(),
        PP_STRUCT_CLOSEST_2D => size_of::<pp_closest_2d>(),
        PP_STRUCT_AREA_PROPERTIES => size_of::<pp_area_properties>(),
        PP_STRUCT_PACKING => size_of::<pp_packing>(),
        PP_STRUCT_PLACEMENT => size_of::<pp_placement>(),
        PP_STRUCT_FLAT_CONTACT => size_of::<pp_flat_contact>(),
        PP_STRUCT_PAIR_STATE => size_of::<pp_pair_state>(),
        PP_STRUCT_PATCH => size_of::<pp_patch>(),
        PP_STRUCT_PATCH_POINT => size_of::<pp_patch_point>(),
        PP_STRUCT_PATCH_2D => size_of::<pp_patch_2d>(),
        PP_STRUCT_PATCH_POINT_2D => size_of::<pp_patch_point_2d>(),
        PP_STRUCT_PATCH_STATE => size_of::<pp_patch_state>(),
        PP_STRUCT_JOINT => size_of::<pp_joint>(),
        PP_STRUCT_JOINT_SET => size_of::<pp_joint_set>(),
        PP_STRUCT_SLICE_SETTINGS => size_of::<pp_slice_settings>(),
        PP_STRUCT_ROCK_SUMMARY => size_of::<pp_rock_summary>(),
        PP_STRUCT_BLOCK => size_of::<pp_block>(),
        PP_STRUCT_BLOCK_FACE => size_of::<pp_block_face>(),
        PP_STRUCT_FACE_PARTNERS => size_of::<pp_face_partners>(),
        PP_STRUCT_DERIVATIVES => size_of::<pp_derivatives>(),
        PP_STRUCT_CONTACT_WEIGHTS => size_of::<pp_contact_weights>(),
        PP_STRUCT_SHAPE_GRADIENT => size_of::<pp_shape_gradient>(),
        PP_STRUCT_POSE_GRADIENT => size_of::<pp_pose_gradient>(),
        PP_STRUCT_PATCH_DERIVATIVES => size_of::<pp_patch_derivatives>(),
        PP_STRUCT_BUILT => size_of::<pp_built>(),
        PP_STRUCT_RIGID_BODY => size_of::<pp_rigid_body>(),
        PP_STRUCT_RIGID_CONTACT => size_of::<pp_rigid_contact>(),
        PP_STRUCT_EQUILIBRIUM_RESULT => size_of::<pp_equilibrium_result>(),
        _ => 0,
    }
}
