//! Why nothing was made, in words: the message that a function writes beside its status.

use super::fence::fenced;
use super::status::*;
use std::ffi::c_char;
use std::fmt::Display;

/// An error whose sentence goes into the message.
pub(super) trait Refusal: Display {
    fn status(&self) -> pp_status;
}

/// A status with its message: the error's own sentence, else that of the status.
pub(super) struct Refused(pp_status, Option<String>);

impl Refused {
    /// Of an argument.
    pub(super) fn argument(status: pp_status, name: &str) -> Self {
        Self(status, (status == PP_NULL_POINTER).then(|| format!("{name} must not be NULL")))
    }

    pub(super) fn new(status: pp_status, text: String) -> Self {
        Self(status, Some(text))
    }
}

impl From<pp_status> for Refused {
    fn from(status: pp_status) -> Self {
        Self(status, None)
    }
}

impl<E: Refusal> From<E> for Refused {
    fn from(error: E) -> Self {
        Self::new(error.status(), error.to_string())
    }
}

/// Runs `body`, and writes why it failed to the message.
///
/// # Safety
/// message is NULL or valid for writing size bytes.
pub(super) unsafe fn explained(
    body: impl FnOnce() -> Result<(), Refused>,
    (message, size): (*mut c_char, usize),
) -> pp_status {
    // SAFETY: by contract.
    let explain = |text: &str| unsafe { write_message(text, message, size) };
    let status = fenced(|| {
        body().map_err(|Refused(status, text)| {
            explain(text.as_deref().unwrap_or(sentence(status)));
            status
        })
    });
    if status == PP_INTERNAL_ERROR {
        explain(sentence(status));
    }
    status
}

/// [`give!`](super::fence::give) of a function that explains itself. What is NULL is named, of the outputs by `$name`.
macro_rules! explain {
    ($message:ident [$size:ident], $name:literal, $out:expr, [$($argument:ident $([$count:ident])?),*], $body:expr) => {{
        let body = || -> Result<(), $crate::capi::message::Refused> {
            $(
                let $argument = $crate::capi::argument::take!($argument $([$count])?)
                    .map_err(|status| $crate::capi::message::Refused::argument(status, stringify!($argument)))?;
            )*
            let null = |status| $crate::capi::message::Refused::argument(status, $name);
            let body = || $body;
            // SAFETY: as the caller has promised.
            unsafe { $crate::capi::output::written($out, null, body) }
        };
        // SAFETY: as the caller has promised.
        unsafe { $crate::capi::message::explained(body, ($message, $size)) }
    }};
}
pub(super) use explain;

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
