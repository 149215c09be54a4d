//! 1 − S at the contact point, in twice the usual precision.
//!
//! It sets the size of the cut. Of two particles that hardly overlap hardly a digit of it is left once S has been
//! rounded: plain numbers know S to ε·(1 + 2·size/r), while 1 − S is about 2·overlap/r.

use super::Side;
use std::ops::{Add, Mul};

/// An unevaluated sum of two numbers, the second one below the rounding of the first.
#[derive(Clone, Copy, Debug)]
struct Double {
    high: f64,
    low: f64,
}

impl Double {
    const ZERO: Self = Self { high: 0.0, low: 0.0 };

    /// The exact sum of two numbers (Knuth's two-sum).
    fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let part = high - a;
        Self { high, low: (a - (high - part)) + (b - part) }
    }

    /// The exact product of two numbers.
    fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        Self { high, low: a.mul_add(b, -high) }
    }

    fn dot<'a>(terms: impl Iterator<Item = (&'a f64, Self)>) -> Self {
        terms.fold(Self::ZERO, |sum, (&factor, term)| sum + term * factor)
    }

    fn over(self, divisor: Self) -> Self {
        let first = self.high / divisor.high;
        let rest = self + divisor * -first;
        Self::sum(first, rest.high / divisor.high)
    }
}

impl From<f64> for Double {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl Add for Double {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let sum = Self::sum(self.high, other.high);
        Self::sum(sum.high, sum.low + self.low + other.low)
    }
}

impl Mul for Double {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        Self::sum(product.high, product.low + self.high * other.low + self.low * other.high)
    }
}

impl Mul<f64> for Double {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        self * Self::from(factor)
    }
}

/// 1 − S at the contact point.
pub(super) fn precise(side: &Side) -> f64 {
    let Side { particle, branch, rotation, point, .. } = side;
    let x = [0, 1, 2].map(|axis| Double::dot(rotation.column(axis).iter().zip(branch.iter().map(|&b| b.into()))));
    let mut squares = Double::ZERO;
    if !particle.is_sphere() {
        particle.visit_near(point, 0.0, |i, normal, excess| {
            if excess > 0.0 {
                let excess = Double::dot(normal.iter().zip(x)) + Double::from(-particle.offset(i));
                squares = squares + excess * excess;
            }
        });
    }
    let (r, k, shadow_radius) = (particle.rounding_radius(), particle.sphericity(), particle.shadow_radius());
    let square = |a: f64| Double::product(a, a);
    let mut s = Double::ZERO;
    if squares.high > 0.0 {
        s = s + squares * Double::sum(1.0, -k).over(square(r));
    }
    if k > 0.0 {
        s = s + (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) * Double::from(k).over(square(shadow_radius));
    }
    (Double::from(1.0) + s * -1.0).high
}
