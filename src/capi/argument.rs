//! What a pointer that a function of C is given stands for: every kind is checked and converted here alone.

use super::convert::pose_from;
use super::particle::pp_particle;
use super::status::*;
use super::types::*;
use crate::{Contact, ContactWeights, Feature, FlatContact, PairState, Particle, Pose, Settings};
use std::mem::MaybeUninit;

/// An argument, or a pointer and a count, that the library takes for a `T`.
pub(super) trait Argument<T> {
    /// # Safety
    /// A pointer is NULL, or points to as many valid, aligned objects as the header says, which nobody writes (of
    /// `*mut`: uses) while `T` lasts.
    unsafe fn take(self) -> Result<T, pp_status>;
}

/// Takes an argument, or `pointer[count]`, for what the code around it needs. A function of C promises its caller's
/// word for it.
macro_rules! take {
    ($argument:ident) => {
        // SAFETY: the caller of the C function has promised what its comment says of pointers.
        unsafe { $crate::capi::argument::Argument::take($argument) }
    };
    ($argument:ident [$count:expr]) => {
        // SAFETY: the same.
        unsafe { $crate::capi::argument::Argument::take(($argument, $count)) }
    };
}
pub(super) use take;

/// Reborrows a pointer, or reports `PP_NULL_POINTER`.
///
/// # Safety
/// `pointer` is NULL or points to a valid, aligned `T` that nobody writes while `'a` lasts.
pub(super) unsafe fn borrow<'a, T>(pointer: *const T) -> Result<&'a T, pp_status> {
    unsafe { pointer.as_ref() }.ok_or(PP_NULL_POINTER)
}

/// Pointers to objects: $pointer is taken for $type by $of.
macro_rules! objects {
    ($($pointer:ty => $type:ty, |$object:ident| $of:expr;)+) => {
        $(impl<'a> Argument<$type> for *const $pointer {
            #[inline(always)]
            unsafe fn take(self) -> Result<$type, pp_status> {
                // SAFETY: as promised.
                let $object: &'a $pointer = unsafe { $crate::capi::argument::borrow(self) }?;
                $of
            }
        })+
    };
}

objects! {
    pp_particle => &'a Particle, |particle| Ok(&particle.0);
    pp_pose => Pose, |pose| pose_from(pose);
    pp_contact_weights => &'a ContactWeights, |weights| finite_weights(weights);
}

/// The defaults for NULL; ranges are checked by whoever uses the settings.
impl<'a> Argument<&'a Settings> for *const pp_settings {
    #[inline(always)]
    unsafe fn take(self) -> Result<&'a Settings, pp_status> {
        if self.is_null() {
            return Ok(&Settings::DEFAULT);
        }
        // SAFETY: its first four fields are words; they are looked at before they count as enums.
        match *unsafe { borrow(self.cast::<[u32; 4]>()) }? {
            [PP_MIDWAY | PP_CLOSEST, PP_FAST | PP_CONE_PROGRAM, 0 | 1, 0] => unsafe { borrow(self) },
            [PP_MIDWAY | PP_CLOSEST, PP_FAST | PP_CONE_PROGRAM, ..] => Err(PP_BAD_SETTING),
            [PP_MIDWAY | PP_CLOSEST, ..] => Err(PP_UNKNOWN_BACK_END),
            _ => Err(PP_UNKNOWN_FORMULATION),
        }
    }
}

/// None for NULL.
impl<'a> Argument<Option<&'a mut PairState>> for *mut pp_pair_state {
    #[inline(always)]
    unsafe fn take(self) -> Result<Option<&'a mut PairState>, pp_status> {
        // SAFETY: as promised.
        Ok(unsafe { self.as_mut() }.map(state_of))
    }
}

#[inline(always)]
pub(super) fn state_of(state: &mut pp_pair_state) -> &mut PairState {
    // SAFETY: it holds as many bytes, all of them numbers of which any value is one; the remembered solution comes
    // first in both.
    unsafe { &mut *std::ptr::from_mut(state).cast::<PairState>() }
}

const _: () = assert!(
    size_of::<PairState>() <= size_of::<pp_pair_state>() && align_of::<PairState>() == align_of::<pp_pair_state>()
);

/// A contact that a caller hands back: what is no enum in Rust was not written by this library.
impl<'a> Argument<&'a Contact> for *const pp_contact {
    unsafe fn take(self) -> Result<&'a Contact, pp_status> {
        // SAFETY: its first three fields are words; they are looked at before they count as enums.
        let [kind, formulation, back_end] = *unsafe { borrow(self.cast::<[u32; 3]>()) }?;
        match (kind, formulation, back_end) {
            (1..=2, PP_MIDWAY | PP_CLOSEST, PP_FAST | PP_CONE_PROGRAM) => unsafe { borrow(self) },
            (1..=2, PP_MIDWAY | PP_CLOSEST, _) => Err(PP_UNKNOWN_BACK_END),
            (1..=2, ..) => Err(PP_UNKNOWN_FORMULATION),
            _ => Err(PP_BAD_POINT),
        }
    }
}

/// The same with a boundary.
impl<'a> Argument<&'a FlatContact> for *const pp_flat_contact {
    unsafe fn take(self) -> Result<&'a FlatContact, pp_status> {
        // SAFETY: its first two fields are words; they are looked at before they count as enums.
        let [kind, feature] = *unsafe { borrow(self.cast::<[u32; 2]>()) }?;
        match (kind, Feature::from_number(feature)) {
            (1..=2, Some(_)) => unsafe { borrow(self) },
            _ => Err(PP_BAD_POINT),
        }
    }
}

/// Where the library itself writes a contact.
impl<'a> Argument<&'a mut MaybeUninit<Contact>> for *mut pp_contact {
    #[inline(always)]
    unsafe fn take(self) -> Result<&'a mut MaybeUninit<Contact>, pp_status> {
        unsafe { self.cast::<MaybeUninit<Contact>>().as_mut() }.ok_or(PP_NULL_POINTER)
    }
}

/// As many numbers in a row as the code needs.
impl<'a, const N: usize> Argument<&'a [f64; N]> for *const f64 {
    unsafe fn take(self) -> Result<&'a [f64; N], pp_status> {
        unsafe { borrow(self.cast()) }
    }
}

/// What arrays are made of, as against rows of numbers.
pub(super) trait Element {}
impl<T> Element for *const T {}
impl Element for pp_pose {}

/// An array, which may be NULL when it has no elements.
impl<'a, T: Element> Argument<&'a [T]> for (*const T, usize) {
    unsafe fn take(self) -> Result<&'a [T], pp_status> {
        // SAFETY: as promised.
        unsafe { slice(self.0, self.1) }
    }
}

/// What rows are made of.
trait Number {}
impl Number for f64 {}
impl Number for u32 {}

/// Rows of as many numbers as the code needs.
impl<'a, T: Number, const N: usize> Argument<&'a [[T; N]]> for (*const T, usize) {
    unsafe fn take(self) -> Result<&'a [[T; N]], pp_status> {
        // SAFETY: as promised.
        unsafe { slice(self.0.cast(), self.1) }
    }
}

unsafe fn slice<'a, T>(pointer: *const T, count: usize) -> Result<&'a [T], pp_status> {
    // SAFETY: by contract.
    if is_array(pointer, count)? { Ok(unsafe { std::slice::from_raw_parts(pointer, count) }) } else { Ok(&[]) }
}

/// An array to read and write, which may be NULL when it has no elements.
impl<'a, T> Argument<&'a mut [T]> for (*mut T, usize) {
    unsafe fn take(self) -> Result<&'a mut [T], pp_status> {
        let (pointer, count) = self;
        if is_array(pointer, count)? {
            Ok(unsafe { std::slice::from_raw_parts_mut(pointer, count) })
        } else {
            Ok(&mut [])
        }
    }
}

/// Whether there is an array at all; refuses NULL where there should be one, and more elements than any memory holds.
fn is_array<T>(pointer: *const T, count: usize) -> Result<bool, pp_status> {
    match count {
        0 => Ok(false),
        _ if pointer.is_null() => Err(PP_NULL_POINTER),
        _ if count > isize::MAX as usize / size_of::<T>() => Err(PP_BAD_INDEX),
        _ => Ok(true),
    }
}

fn finite_weights(weights: &ContactWeights) -> Result<&ContactWeights, pp_status> {
    let ContactWeights { s, s_b, overlap, normal, point, point_on_a, point_on_b } = weights;
    let vectors = [normal, point, point_on_a, point_on_b];
    let is_finite = [s, s_b, overlap].into_iter().chain(vectors.into_iter().flatten()).all(|v| v.is_finite());
    if is_finite { Ok(weights) } else { Err(PP_BAD_SETTING) }
}
