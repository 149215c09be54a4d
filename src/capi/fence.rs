//! Nothing but a status crosses the boundary: panics are caught here, NULL is refused here.

use super::status::{PP_BAD_INDEX, PP_BUFFER_TOO_SMALL, PP_INTERNAL_ERROR, PP_NULL_POINTER, PP_OK, pp_status};
use std::cell::Cell;
use std::mem::MaybeUninit;
use std::panic::{self, AssertUnwindSafe, catch_unwind};
use std::sync::Once;
use std::thread;

thread_local! {
    /// Whether this thread is inside a call of the C interface.
    static INSIDE: Cell<bool> = const { Cell::new(false) };
}

/// Runs `body`; a panic becomes `PP_INTERNAL_ERROR`, an `Err` its status.
///
/// Outputs are written by `body` as its last step only, so that an early return leaves them
/// untouched; that is why unwinding through it is safe.
#[inline]
pub(super) fn fenced(body: impl FnOnce() -> Result<(), pp_status>) -> pp_status {
    silence_panics_inside();
    // Looked up once: in a shared library that is a call.
    let outcome = INSIDE.with(|inside| {
        let outer = inside.replace(true);
        let outcome = catch_unwind(AssertUnwindSafe(body));
        inside.set(outer);
        outcome
    });
    match outcome {
        Ok(Ok(())) => PP_OK,
        Ok(Err(status)) => status,
        Err(_) => PP_INTERNAL_ERROR,
    }
}

/// Lets a panic inside a fence print nothing: the caller learns of it by its status, and a library does not write to
/// the caller's terminal.
///
/// Only the panic hook can do that, since it runs before any unwinding is caught. It is of the Rust runtime in this
/// shared library, which no other library shares; in a Rust program that uses this crate it is the program's. So
/// whatever hook there was still gets every panic from outside the fences.
#[inline]
fn silence_panics_inside() {
    static DONE: Once = Once::new();
    // A call from a destructor that runs in a panic may not set the hook: the next call will.
    if !DONE.is_completed() && !thread::panicking() {
        DONE.call_once(|| {
            let previous = panic::take_hook();
            panic::set_hook(Box::new(move |panic| {
                if !INSIDE.get() {
                    previous(panic);
                }
            }));
        });
    }
}

/// Reborrows a pointer argument, or reports `PP_NULL_POINTER`.
///
/// # Safety
/// `pointer` is NULL or points to a valid, aligned `T` that nobody writes while `'a` lasts.
pub(super) unsafe fn borrow<'a, T>(pointer: *const T) -> Result<&'a T, pp_status> {
    unsafe { pointer.as_ref() }.ok_or(PP_NULL_POINTER)
}

/// The array behind a pointer argument, which may be NULL when it has no elements.
///
/// # Safety
/// `pointer` is NULL or points to `count` valid, aligned `T` that nobody writes while `'a` lasts.
pub(super) unsafe fn array<'a, T>(pointer: *const T, count: usize) -> Result<&'a [T], pp_status> {
    if check_array(pointer, count)? { Ok(unsafe { std::slice::from_raw_parts(pointer, count) }) } else { Ok(&[]) }
}

/// The array for outputs behind a pointer argument, which may be NULL when it has no elements.
///
/// # Safety
/// `pointer` is NULL or valid for writing `count` aligned `T`, which nobody else uses while `'a` lasts.
pub(super) unsafe fn outputs<'a, T>(pointer: *mut T, count: usize) -> Result<&'a mut [MaybeUninit<T>], pp_status> {
    // SAFETY: as promised; memory that may not be initialised is never taken for more.
    unsafe { array_mut(pointer.cast(), count) }
}

/// The array behind a pointer argument, for reading and writing; it may be NULL when it has no elements.
///
/// # Safety
/// `pointer` is NULL or points to `count` valid, aligned `T` that nobody else uses while `'a` lasts.
pub(super) unsafe fn array_mut<'a, T>(pointer: *mut T, count: usize) -> Result<&'a mut [T], pp_status> {
    if check_array(pointer, count)? {
        Ok(unsafe { std::slice::from_raw_parts_mut(pointer, count) })
    } else {
        Ok(&mut [])
    }
}

/// Whether there is an array at all; refuses NULL where there should be one, and more elements than any memory holds.
fn check_array<T>(pointer: *const T, count: usize) -> Result<bool, pp_status> {
    match count {
        0 => Ok(false),
        _ if pointer.is_null() => Err(PP_NULL_POINTER),
        _ if count > isize::MAX as usize / size_of::<T>() => Err(PP_BAD_INDEX),
        _ => Ok(true),
    }
}

/// The output behind a pointer argument, or `PP_NULL_POINTER`. Only ever written through.
///
/// # Safety
/// `pointer` is NULL or valid for writing one `T`.
pub(super) unsafe fn output<T>(pointer: *mut T) -> Result<Output<T>, pp_status> {
    if pointer.is_null() { Err(PP_NULL_POINTER) } else { Ok(Output(pointer)) }
}

/// The same as memory that the library itself writes.
///
/// # Safety
/// `pointer` is NULL or valid for writing one aligned `T`, which nobody else uses while `'a` lasts.
pub(super) unsafe fn place<'a, T>(pointer: *mut T) -> Result<&'a mut MaybeUninit<T>, pp_status> {
    unsafe { pointer.cast::<MaybeUninit<T>>().as_mut() }.ok_or(PP_NULL_POINTER)
}

/// A checked place for one result. It may be uninitialised memory, so it is never read.
pub(super) struct Output<T>(*mut T);

impl<T> Output<T> {
    #[inline]
    pub(super) fn write(&self, value: T) {
        // SAFETY: `output` was promised a pointer valid for writing one `T`; an output in an array is one.
        unsafe { self.0.write_unaligned(value) }
    }
}

/// Writes what `get` gives of the object behind a pointer argument.
///
/// # Safety
/// As of [`borrow`] and [`output`].
pub(super) unsafe fn read<T, V>(object: *const T, to: *mut V, get: impl FnOnce(&T) -> V) -> pp_status {
    fenced(|| {
        let object = unsafe { borrow(object) }?;
        unsafe { output(to) }?.write(get(object));
        Ok(())
    })
}

/// Drops an object that a caller gives back; nothing for NULL.
///
/// # Safety
/// `object` is NULL or came from `Box::into_raw`, and is given back once.
pub(super) unsafe fn release<T>(object: *mut T) {
    if !object.is_null() {
        drop(unsafe { Box::from_raw(object) });
    }
}

/// Refuses a buffer that is NULL but said to have room, whatever there is to be written.
pub(super) fn check_room<T>(buffer: *mut T, capacity: usize) -> Result<(), pp_status> {
    if capacity > 0 && buffer.is_null() { Err(PP_NULL_POINTER) } else { Ok(()) }
}

/// Writes rows of N doubles and how many there are; with too little room, only how many there are.
///
/// # Safety
/// `to` is NULL or valid for writing N * capacity doubles, `count` NULL or valid for writing one number.
pub(super) unsafe fn write_rows<const N: usize>(
    rows: impl ExactSizeIterator<Item = [f64; N]>,
    to: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> Result<(), pp_status> {
    unsafe { write_all(rows, to.cast::<[f64; N]>(), capacity, count) }
}

/// Writes all rows and how many there are; with too little room, only how many there are.
///
/// # Safety
/// `to` is NULL or valid for writing capacity rows, `count` NULL or valid for writing one number.
pub(super) unsafe fn write_all<T>(
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

#[cfg(test)]
mod tests {
    use super::*;
    use std::process::Command;

    /// In a process of its own, since what is printed is the point, and the hook is one for all.
    #[test]
    #[cfg_attr(miri, ignore = "starts a process")]
    fn a_panic_inside_prints_nothing_and_one_outside_does() {
        let this = std::env::current_exe().unwrap();
        let child = ["--exact", "capi::fence::tests::child", "--ignored", "--nocapture", "--test-threads=1"];
        let run = Command::new(this).args(child).output().unwrap();
        let printed = String::from_utf8_lossy(&run.stderr);
        assert!(run.status.success(), "{printed}");
        assert!(!printed.contains("from inside"), "{printed}");
        assert!(printed.contains("from outside"), "{printed}");
    }

    #[test]
    #[ignore = "run by the test above"]
    fn child() {
        assert_eq!(fenced(|| panic!("from inside")), PP_INTERNAL_ERROR);
        // The fence inside another leaves that one closed.
        let nested = || {
            assert_eq!(fenced(|| Err(PP_NULL_POINTER)), PP_NULL_POINTER);
            panic!("from inside, after another call")
        };
        assert_eq!(fenced(nested), PP_INTERNAL_ERROR);
        assert!(catch_unwind(|| panic!("from outside")).is_err());
    }
}
