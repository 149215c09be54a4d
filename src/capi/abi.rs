//! Which library was loaded, and whether its structs are those that the caller was compiled with.

use super::builder::pp_built;
use super::derivative::{pp_derivatives, pp_shape_gradient};
use super::patch::{pp_patch, pp_patch_state};
use super::patch_derivatives::pp_patch_derivatives;
use super::types::*;
use crate::answer::Row;
use crate::{ClosestPoint, Contact, FlatContact, Settings};
use std::ffi::{CStr, CString, c_char};
use std::sync::OnceLock;

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

/// The size of each struct, by its name.
macro_rules! sizes {
    ($($name:ident),+ $(,)?) => {
        fn size_of_struct(name: &[u8]) -> usize {
            $(if name == stringify!($name).as_bytes() {
                return size_of::<$name>();
            })+
            0
        }
    };
}

sizes! {
    pp_pose, pp_settings, pp_contact, pp_closest, pp_mass_properties, pp_flat_contact, pp_pair_state, pp_patch,
    pp_patch_point, pp_patch_state, pp_derivatives, pp_contact_weights, pp_shape_gradient, pp_pose_gradient,
    pp_patch_derivatives, pp_built,
}

/// Size in bytes of a struct as the loaded library knows it, by its name ("pp_contact"), to be compared with
/// sizeof; 0 for a name it does not know. For languages that write the structs down themselves.
///
/// Pointers: name is NULL or a text that ends with a zero byte.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_struct_size(name: *const c_char) -> usize {
    // SAFETY: by contract.
    unsafe { text(name) }.map_or(0, size_of_struct)
}

/// The fields of a struct, for languages that make it of them: for each a line with its name, numpy's format
/// of a number of it ("f8", "i4", "u4"), how many numbers it has, and its first byte. Known are pp_contact,
/// pp_closest, pp_flat_contact and pp_settings; NULL for another name. Static text: do not free it.
///
/// Pointers: name is NULL or a text that ends with a zero byte.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_struct_fields(name: *const c_char) -> *const c_char {
    const STRUCTS: [(&[u8], &[Row]); 4] = [
        (b"pp_contact", Contact::LAYOUT),
        (b"pp_closest", ClosestPoint::LAYOUT),
        (b"pp_flat_contact", FlatContact::LAYOUT),
        (b"pp_settings", Settings::LAYOUT),
    ];
    static TEXTS: OnceLock<[CString; STRUCTS.len()]> = OnceLock::new();
    let line = |(name, format, count, place, _): &Row| format!("{name} {format} {count} {place}\n");
    let text_of =
        |(_, rows): (&[u8], &[Row])| CString::new(rows.iter().map(line).collect::<String>()).unwrap_or_default();
    // SAFETY: by contract.
    let place = unsafe { text(name) }.and_then(|name| STRUCTS.iter().position(|(known, _)| *known == name));
    place.map_or(std::ptr::null(), |place| TEXTS.get_or_init(|| STRUCTS.map(text_of))[place].as_ptr())
}

/// # Safety
/// name is NULL or a text that ends with a zero byte.
unsafe fn text<'a>(name: *const c_char) -> Option<&'a [u8]> {
    // SAFETY: by contract.
    (!name.is_null()).then(|| unsafe { CStr::from_ptr(name) }.to_bytes())
}
