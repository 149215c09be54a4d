//! Numbers of the solver: one, or two in lanes; and the larger and the smaller of two in one instruction (`f64::max` and `min`
//! take five to be right about NaN).

use nalgebra::SimdRealField;
use simba::simd::AutoF64x2;

/// Two numbers on which the same is done at once.
pub type Twin = AutoF64x2;

/// A number, or two of them in lanes. What is asked of a number is asked of both.
pub trait Number: SimdRealField<Element = f64> + Copy {
    /// The larger; the other if one of the two is no number.
    fn larger(self, other: Self) -> Self;
    /// |x|.
    fn magnitude(self) -> Self;
    /// x ≤ y.
    fn is_at_most(self, other: Self) -> bool;
    /// x > 0.
    fn is_positive(self) -> bool;
    /// Neither infinite nor no number.
    fn is_finite(self) -> bool;
}

impl Number for f64 {
    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        larger(self, other)
    }

    #[inline(always)]
    fn magnitude(self) -> Self {
        self.abs()
    }

    #[inline(always)]
    fn is_at_most(self, other: Self) -> bool {
        self <= other
    }

    #[inline(always)]
    fn is_positive(self) -> bool {
        self > 0.0
    }

    #[inline(always)]
    fn is_finite(self) -> bool {
        f64::is_finite(self)
    }
}

impl Number for Twin {
    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        Self::new(larger(self.0[0], other.0[0]), larger(self.0[1], other.0[1]))
    }

    #[inline(always)]
    fn magnitude(self) -> Self {
        Self::new(self.0[0].abs(), self.0[1].abs())
    }

    #[inline(always)]
    fn is_at_most(self, other: Self) -> bool {
        self.0[0] <= other.0[0] && self.0[1] <= other.0[1]
    }

    #[inline(always)]
    fn is_positive(self) -> bool {
        self.0[0] > 0.0 && self.0[1] > 0.0
    }

    #[inline(always)]
    fn is_finite(self) -> bool {
        self.0[0].is_finite() && self.0[1].is_finite()
    }
}

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
