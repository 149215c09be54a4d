//! Why nothing was made, in words: the message that a function writes beside its status.

use super::fence::{fenced, output};
use super::status::*;
use std::ffi::c_char;
use std::fmt::Display;

/// An error whose sentence goes into the message.
pub(super) trait Refusal: Display {
    fn status(&self) -> pp_status;
}

/// Runs `make`. Why it failed is written to the message: the error's own sentence, `null` for a pointer that is NULL,
/// else that of the status. Pointers: message is NULL or valid for writing size bytes.
pub(super) unsafe fn explained<E: Refusal>(
    make: impl FnOnce() -> Result<Result<(), E>, pp_status>,
    null: &str,
    message: *mut c_char,
    size: usize,
) -> pp_status {
    // SAFETY: by contract.
    let explain = |text: &str| unsafe { write_message(text, message, size) };
    let status = fenced(|| {
        make()?.map_err(|error| {
            explain(&error.to_string());
            error.status()
        })
    });
    match status {
        PP_NULL_POINTER => explain(null),
        PP_BAD_INDEX | PP_INTERNAL_ERROR => explain(sentence(status)),
        _ => {}
    }
    status
}

/// The same for an object, which is handed to the caller.
/// Pointers: out is NULL or valid for writing, message is NULL or valid for writing size bytes.
pub(super) unsafe fn create<T, E: Refusal>(
    make: impl FnOnce() -> Result<Result<T, E>, pp_status>,
    null: &str,
    out: *mut *mut T,
    message: *mut c_char,
    size: usize,
) -> pp_status {
    let make = || {
        // SAFETY: by contract.
        let out = unsafe { output(out) }?;
        Ok(make()?.map(|made| out.write(Box::into_raw(Box::new(made)))))
    };
    // SAFETY: by contract.
    unsafe { explained(make, null, message, size) }
}

/// Copies as much of text as fits, always zero-terminated.
/// Pointers: message is NULL or valid for writing size bytes.
unsafe fn write_message(text: &str, message: *mut c_char, size: usize) {
    if message.is_null() || size == 0 {
        return;
    }
    let room = text.len().min(size - 1);
    let length = (0..=room).rev().find(|&at| text.is_char_boundary(at)).unwrap_or(0);
    // SAFETY: length < size, and the caller promised `size` bytes.
    unsafe {
        std::ptr::copy_nonoverlapping(text.as_ptr().cast(), message, length);
        message.add(length).write(0);
    }
}
