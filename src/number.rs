//! The larger and the smaller of two numbers in one instruction; `f64::max` and `min` take five to be right about NaN.

/// The larger; b if one of the two is no number.
#[inline(always)]
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The smaller; b if one of the two is no number.
#[inline(always)]
pub(crate) fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}
