//! Where answers go: the pointers to outputs of a C function, and what is written through them.

use super::argument::Argument;
use super::status::*;
use nalgebra::SVector;
use std::mem::MaybeUninit;

/// One or several outputs, for an answer `V`. They may be uninitialised memory, so they are never read.
pub(super) trait Output<V>: Copy {
    /// Refuses a pointer that must not be NULL, before anything is computed.
    fn check(self) -> Result<(), pp_status>;

    /// Writes the answer.
    ///
    /// # Safety
    /// `check` has passed, and what is not NULL is valid for writing as the header says.
    unsafe fn put(self, answer: V) -> Result<(), pp_status>;
}

/// Checks the output, and writes what `body` ends in.
///
/// # Safety
/// What is not NULL is valid for writing as the header says.
#[inline]
pub(super) unsafe fn written<V, E: From<pp_status>>(
    out: impl Output<V>,
    refused: impl FnOnce(pp_status) -> E,
    body: impl FnOnce() -> Result<V, E>,
) -> Result<(), E> {
    out.check().map_err(refused)?;
    // SAFETY: checked, and as promised.
    Ok(unsafe { out.put(body()?) }?)
}

/// A pointer to memory that holds a `V`: one, or as many numbers as a row or a vector has.
pub(super) trait Holds<V>: Copy {
    fn place(self) -> *mut V;
}

impl<T> Holds<T> for *mut T {
    fn place(self) -> *mut T {
        self
    }
}

impl<T, const N: usize> Holds<[T; N]> for *mut T {
    fn place(self) -> *mut [T; N] {
        self.cast()
    }
}

impl<const N: usize> Holds<SVector<f64, N>> for *mut f64 {
    fn place(self) -> *mut SVector<f64, N> {
        self.cast()
    }
}

impl<T, V> Output<V> for *mut T
where
    *mut T: Holds<V>,
{
    #[inline]
    fn check(self) -> Result<(), pp_status> {
        check_room(self, 1)
    }

    #[inline]
    unsafe fn put(self, answer: V) -> Result<(), pp_status> {
        // SAFETY: as promised.
        unsafe { self.place().write_unaligned(answer) };
        Ok(())
    }
}

/// Nothing is asked but the status.
impl Output<()> for () {
    fn check(self) -> Result<(), pp_status> {
        Ok(())
    }

    unsafe fn put(self, (): ()) -> Result<(), pp_status> {
        Ok(())
    }
}

impl<P: Output<V>, Q: Output<W>, V, W> Output<(V, W)> for (P, Q) {
    fn check(self) -> Result<(), pp_status> {
        self.0.check()?;
        self.1.check()
    }

    unsafe fn put(self, (first, second): (V, W)) -> Result<(), pp_status> {
        // SAFETY: as promised of both.
        unsafe {
            self.0.put(first)?;
            self.1.put(second)
        }
    }
}

/// An output that may be NULL; what goes there is computed only if it is not.
#[derive(Clone, Copy)]
pub(super) struct IfWanted<P>(pub P);

impl<P: Output<V>, V, F: FnOnce() -> V> Output<F> for IfWanted<P> {
    fn check(self) -> Result<(), pp_status> {
        Ok(())
    }

    unsafe fn put(self, answer: F) -> Result<(), pp_status> {
        // SAFETY: as promised.
        if self.0.check().is_ok() { unsafe { self.0.put(answer()) } } else { Ok(()) }
    }
}

/// An object that is handed to the caller.
pub(super) struct New<T>(pub *mut *mut T);

impl<T> Clone for New<T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for New<T> {}

impl<T> Output<T> for New<T> {
    fn check(self) -> Result<(), pp_status> {
        check_room(self.0, 1)
    }

    unsafe fn put(self, object: T) -> Result<(), pp_status> {
        // SAFETY: as promised.
        unsafe { self.0.put(Box::into_raw(Box::new(object))) }
    }
}

/// A buffer, the rows that it has room for, and their number: all rows are written, or with too little room only how
/// many there are.
impl<P, V, I: ExactSizeIterator<Item = V>> Output<I> for (P, usize, *mut usize)
where
    P: Holds<V>,
{
    fn check(self) -> Result<(), pp_status> {
        check_room(self.0.place(), self.1)?;
        check_room(self.2, 1)
    }

    unsafe fn put(self, rows: I) -> Result<(), pp_status> {
        let (buffer, capacity, count) = self;
        let there_are = rows.len();
        // SAFETY: as promised.
        unsafe { count.write_unaligned(there_are) };
        if there_are > capacity { Err(PP_BUFFER_TOO_SMALL) } else { unsafe { fill(buffer.place(), there_are, rows) } }
    }
}

/// Writes that many rows.
///
/// # Safety
/// `to` is NULL or valid for writing them.
pub(super) unsafe fn fill<V>(to: *mut V, count: usize, rows: impl IntoIterator<Item = V>) -> Result<(), pp_status> {
    // SAFETY: as promised.
    let places = unsafe { outputs(to, count) }?;
    places.iter_mut().zip(rows).for_each(|(place, row)| _ = place.write(row));
    Ok(())
}

/// The array for outputs behind a pointer, which may be NULL when it has no elements.
///
/// # Safety
/// `pointer` is NULL or valid for writing `count` aligned `T`, which nobody else uses while `'a` lasts.
pub(super) unsafe fn outputs<'a, T>(pointer: *mut T, count: usize) -> Result<&'a mut [MaybeUninit<T>], pp_status> {
    // SAFETY: as promised; memory that may not be initialised is never taken for more.
    unsafe { (pointer.cast::<MaybeUninit<T>>(), count).take() }
}

/// Refuses a buffer that is NULL but said to have room, whatever there is to be written.
pub(super) fn check_room<T>(buffer: *mut T, capacity: usize) -> Result<(), pp_status> {
    if capacity > 0 && buffer.is_null() { Err(PP_NULL_POINTER) } else { Ok(()) }
}

/// Drops an object that a caller gives back; nothing for NULL.
///
/// # Safety
/// `object` is NULL or came from [`New`], and is given back once.
pub(super) unsafe fn release<T>(object: *mut T) {
    if !object.is_null() {
        drop(unsafe { Box::from_raw(object) });
    }
}
