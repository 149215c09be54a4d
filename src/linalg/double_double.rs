//! Numbers of about 32 digits: the unevaluated sum of two doubles.
//!
//! Algorithms and error bounds are those of Joldes, Muller & Popescu (2017), "Tight and rigorous error bounds for basic
//! building blocks of double-word arithmetic", ACM TOMS 44(2): with u = 2⁻⁵³ the relative error is at most 3u² + 13u³
//! of a sum or difference (their algorithm 6), 7u² of a product (without fused multiplication) and 15u² of a quotient.
//! One bound, [`DoubleDouble::UNIT`] = 16u², covers them all.

use num_traits::{One, Zero};
use std::cmp::Ordering;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// `high` + `low`, with |low| at most half a unit in the last place of `high`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct DoubleDouble {
    pub high: f64,
    pub low: f64,
}

impl DoubleDouble {
    /// Bound on the relative error of one operation: 16u² = 2⁻¹⁰². Derived: a quotient needs 15u², u = 2⁻⁵³.
    pub const UNIT: f64 = 4.0 * f64::EPSILON * f64::EPSILON;

    /// a + b without rounding.
    #[inline(always)]
    pub fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let part = high - a;
        Self { high, low: (a - (high - part)) + (b - part) }
    }

    /// a·b without rounding, unless a partial product leaves the range of f64.
    pub fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        // Fused multiplication is no baseline instruction: Dekker's product of halves.
        let ((a1, a2), (b1, b2)) = (halves(a), halves(b));
        let low = ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2;
        Self { high, low }
    }

    /// The nearest double.
    pub fn rounded(self) -> f64 {
        self.high
    }

    pub fn abs(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }

    pub fn is_finite(self) -> bool {
        self.high.is_finite() && self.low.is_finite()
    }

    /// Square root of a number that is not negative; 0 for a negative one, NaN for NaN. One step of Newton's method on
    /// the double root squares its error.
    pub fn sqrt(self) -> Self {
        if self.high <= 0.0 {
            return Self::default();
        }
        let root = self.high.sqrt();
        let rest = self - Self::product(root, root);
        quick_sum(root, rest.high / (2.0 * root))
    }
}

/// a + b without rounding, for |a| ≥ |b|.
fn quick_sum(a: f64, b: f64) -> DoubleDouble {
    let high = a + b;
    DoubleDouble { high, low: b - (high - a) }
}

/// Two halves of 26 bits each (Veltkamp's splitting).
fn halves(a: f64) -> (f64, f64) {
    let shifted = 134_217_729.0 * a;
    let high = shifted - (shifted - a);
    (high, a - high)
}

impl From<f64> for DoubleDouble {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl Add for DoubleDouble {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        let (high, low) = (Self::sum(self.high, other.high), Self::sum(self.low, other.low));
        let first = quick_sum(high.high, high.low + low.high);
        quick_sum(first.high, low.low + first.low)
    }
}

impl Neg for DoubleDouble {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Sub for DoubleDouble {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        quick_sum(product.high, product.low + (self.high * other.low + self.low * other.high))
    }
}

impl Mul<f64> for DoubleDouble {
    type Output = Self;

    #[inline]
    fn mul(self, other: f64) -> Self {
        let product = Self::product(self.high, other);
        quick_sum(product.high, product.low + self.low * other)
    }
}

impl Div for DoubleDouble {
    type Output = Self;

    #[inline]
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * Self::from(first);
        quick_sum(first, rest.high / other.high)
    }
}

macro_rules! assign {
    ($($trait:ident $method:ident $operator:tt),*) => {$(
        impl $trait for DoubleDouble {
            #[inline]
            fn $method(&mut self, other: Self) {
                *self = *self $operator other;
            }
        }
    )*};
}
assign!(AddAssign add_assign +, SubAssign sub_assign -, MulAssign mul_assign *, DivAssign div_assign /);

impl PartialOrd for DoubleDouble {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        match self.high.partial_cmp(&other.high) {
            Some(Ordering::Equal) => self.low.partial_cmp(&other.low),
            order => order,
        }
    }
}

impl Zero for DoubleDouble {
    fn zero() -> Self {
        Self::default()
    }

    fn is_zero(&self) -> bool {
        self.high == 0.0
    }
}

impl One for DoubleDouble {
    fn one() -> Self {
        Self::from(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn third() -> DoubleDouble {
        DoubleDouble::from(1.0) / DoubleDouble::from(3.0)
    }

    #[test]
    fn a_third_has_32_digits() {
        let left = third() * DoubleDouble::from(3.0) - DoubleDouble::from(1.0);
        assert!(left.rounded().abs() <= 2.0 * DoubleDouble::UNIT && third().low != 0.0);
    }

    #[test]
    fn the_root_of_two_squared_is_two() {
        let root = DoubleDouble::from(2.0).sqrt();
        assert!((root * root - DoubleDouble::from(2.0)).rounded().abs() <= 4.0 * DoubleDouble::UNIT);
        assert_eq!(DoubleDouble::from(-1.0).sqrt(), DoubleDouble::zero());
    }

    proptest! {
        // Whole numbers up to 2¹⁰⁰ in i128 say what sums and products should be.
        #[test]
        fn sums_and_products_are_those_of_whole_numbers(
            a in -(1i128 << 60)..(1i128 << 60), b in -(1i128 << 60)..(1i128 << 60)
        ) {
            let of = |n: i128| {
                let high = n as f64;
                DoubleDouble::from(high) + DoubleDouble::from((n - high as i128) as f64)
            };
            let whole = |x: DoubleDouble| x.high as i128 + x.low as i128;
            prop_assert_eq!(whole(of(a) + of(b)), a + b);
            prop_assert_eq!(whole(of(a) - of(b)), a - b);
            let (a, b) = (a >> 10, b >> 10);
            prop_assert_eq!(whole(of(a) * of(b)), a * b);
            if b != 0 {
                let left = of(a) - of(a) / of(b) * of(b);
                prop_assert!(left.rounded().abs() <= 2.0 * DoubleDouble::UNIT * (a as f64).abs());
            }
        }
    }
}
