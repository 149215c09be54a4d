//! What the solver asks of a number: one double, two of them in lanes, or one of 32 digits.

use super::double_double::DoubleDouble;
use nalgebra::{
    ArrayStorage, ClosedAddAssign, ClosedDivAssign, ClosedMulAssign, ClosedSubAssign, SVector, Scalar, SimdValue,
    Vector3,
};
use num_traits::{One, Zero};
use simba::simd::AutoF64x2;
use std::ops::Neg;

/// Two doubles on which the same is done at once.
pub type Twin = AutoF64x2;

/// Bound on the relative rounding of a result of fewer than this many operations, in doubles: γ(n) = n u/(1 − n u) of n
/// operations lies below (n + 1) u, u = ε/2.
pub(crate) const fn gamma(operations: u32) -> f64 {
    operations as f64 * (0.5 * f64::EPSILON)
}

/// A vector of which nothing is known.
pub(crate) const UNKNOWN_VECTOR: Vector3<f64> = unknown_vector();

/// The same in any dimension.
pub(crate) const fn unknown_vector<const N: usize>() -> SVector<f64, N> {
    SVector::from_array_storage(ArrayStorage([[f64::NAN; N]]))
}

/// A number, or two of them in lanes. A predicate holds if it holds for both.
pub trait Number:
    Scalar + Copy + Zero + One + ClosedAddAssign + ClosedSubAssign + ClosedMulAssign + ClosedDivAssign + Neg<Output = Self>
{
    /// Bound on the relative error of one operation (derived).
    const UNIT: f64;

    /// The number that equals a double.
    fn of(value: f64) -> Self;
    /// The larger; `other` if one of the two is not a number.
    fn larger(self, other: Self) -> Self;
    /// |x|.
    fn magnitude(self) -> Self;
    /// x ≤ y.
    fn is_at_most(self, other: Self) -> bool;
    /// x > 0.
    fn is_positive(self) -> bool;
    /// Neither infinite nor not a number.
    fn is_finite(self) -> bool;
}

/// A single number, of which an approximation decides where the search goes next.
pub trait Single: Number + Default {
    /// The nearest double.
    fn approximate(self) -> f64;
    /// √x of a number that is not negative.
    fn root(self) -> Self;
    /// `exact` where that has more digits than a double.
    fn refined(double: f64, exact: impl FnOnce() -> Self) -> Self;
}

impl Number for f64 {
    const UNIT: f64 = 0.5 * f64::EPSILON;

    #[inline(always)]
    fn of(value: f64) -> Self {
        value
    }

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

impl Single for f64 {
    #[inline(always)]
    fn approximate(self) -> f64 {
        self
    }

    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn refined(double: f64, _: impl FnOnce() -> Self) -> Self {
        double
    }
}

impl Number for Twin {
    const UNIT: f64 = 0.5 * f64::EPSILON;

    #[inline(always)]
    fn of(value: f64) -> Self {
        Self::splat(value)
    }

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

impl Number for DoubleDouble {
    const UNIT: f64 = DoubleDouble::UNIT;

    fn of(value: f64) -> Self {
        Self::from(value)
    }

    fn larger(self, other: Self) -> Self {
        if self > other { self } else { other }
    }

    fn magnitude(self) -> Self {
        self.abs()
    }

    fn is_at_most(self, other: Self) -> bool {
        self <= other
    }

    fn is_positive(self) -> bool {
        self > Self::zero()
    }

    fn is_finite(self) -> bool {
        DoubleDouble::is_finite(self)
    }
}

impl Single for DoubleDouble {
    fn approximate(self) -> f64 {
        self.rounded()
    }

    fn root(self) -> Self {
        self.sqrt()
    }

    fn refined(_: f64, exact: impl FnOnce() -> Self) -> Self {
        exact()
    }
}

/// The larger; b if one of the two is not a number. One instruction, where `f64::max` takes five to be right about NaN.
#[inline(always)]
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The smaller; b if one of the two is not a number.
#[inline(always)]
pub(crate) fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// A vector at unit length, also where its square is lost or infinite; `None` if it has no direction. The one place
/// where directions of any length that callers give are normalised.
pub(crate) fn direction<const N: usize>(v: &SVector<f64, N>) -> Option<SVector<f64, N>> {
    let scaled = v / v.amax();
    scaled.iter().all(|c| c.is_finite()).then(|| scaled.normalize())
}
