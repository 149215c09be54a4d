//! Nothing but a status crosses the boundary: panics are caught here, NULL is refused here.

use super::status::{PP_INTERNAL_ERROR, PP_NULL_POINTER, pp_status};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Runs `body`; a panic becomes `PP_INTERNAL_ERROR`, an `Err` its status.
///
/// Outputs are written by `body` as its last step only, so that an early return leaves them
/// untouched; that is why unwinding through it is safe.
pub(super) fn fenced(body: impl FnOnce() -> Result<(), pp_status>) -> pp_status {
    match catch_unwind(AssertUnwindSafe(body)) {
        Ok(Ok(())) => super::status::PP_OK,
        Ok(Err(status)) => status,
        Err(_) => PP_INTERNAL_ERROR,
    }
}

/// Reborrows a pointer argument, or reports `PP_NULL_POINTER`.
///
/// # Safety
/// `pointer` is NULL or points to a valid, aligned `T` that nobody writes while `'a` lasts.
pub(super) unsafe fn borrow<'a, T>(pointer: *const T) -> Result<&'a T, pp_status> {
    unsafe { pointer.as_ref() }.ok_or(PP_NULL_POINTER)
}

/// The output behind a pointer argument, or `PP_NULL_POINTER`. Only ever written through.
///
/// # Safety
/// `pointer` is NULL or valid for writing one `T`.
pub(super) unsafe fn output<T>(pointer: *mut T) -> Result<Output<T>, pp_status> {
    if pointer.is_null() { Err(PP_NULL_POINTER) } else { Ok(Output(pointer)) }
}

/// A checked place for one result. It may be uninitialised memory, so it is never read.
pub(super) struct Output<T>(*mut T);

impl<T> Output<T> {
    pub(super) fn write(&self, value: T) {
        // SAFETY: `output` was promised a pointer valid for writing one `T`.
        unsafe { self.0.write(value) }
    }
}
