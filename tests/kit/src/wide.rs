//! Numbers of about 32 digits: the unevaluated sum of two doubles (Dekker 1971, Knuth).
//!
//! What judges an answer must not share its rounding.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// `high` + `low`, with |low| at most half a unit in the last place of high.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wide {
    high: f64,
    low: f64,
}

impl Wide {
    pub const ZERO: Self = Self { high: 0.0, low: 0.0 };
    pub const ONE: Self = Self { high: 1.0, low: 0.0 };

    /// Nearest double.
    pub fn f64(self) -> f64 {
        self.high
    }

    /// The two doubles whose sum it is.
    pub fn parts(self) -> (f64, f64) {
        (self.high, self.low)
    }

    /// a − b without rounding.
    pub fn difference(a: f64, b: f64) -> Self {
        let (high, low) = two_sum(a, -b);
        Self { high, low }
    }

    /// a·b without rounding.
    pub fn product(a: f64, b: f64) -> Self {
        let (high, low) = two_product(a, b);
        Self { high, low }
    }

    pub fn abs(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }

    pub fn max(self, other: Self) -> Self {
        if (self - other).high >= 0.0 { self } else { other }
    }

    /// One Newton step on the root in double precision.
    pub fn sqrt(self) -> Self {
        if !(self.high > 0.0) {
            return Self { high: self.high.max(0.0), low: 0.0 };
        }
        let root = self.high.sqrt();
        let rest = self - Self::product(root, root);
        sum(root, rest.high / (2.0 * root))
    }

    pub fn is_finite(self) -> bool {
        self.high.is_finite() && self.low.is_finite()
    }
}

impl From<f64> for Wide {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let from_b = sum - a;
    (sum, (a - (sum - from_b)) + (b - from_b))
}

/// a + b for |a| ≥ |b|.
fn sum(a: f64, b: f64) -> Wide {
    let high = a + b;
    Wide { high, low: b - (high - a) }
}

/// Halves of 26 bits (Veltkamp); fused multiplication is no baseline instruction.
fn split(a: f64) -> (f64, f64) {
    let shifted = 134_217_729.0 * a;
    let high = shifted - (shifted - a);
    (high, a - high)
}

fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let ((a_high, a_low), (b_high, b_low)) = (split(a), split(b));
    (product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low)
}

impl Add for Wide {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (high, rest) = two_sum(self.high, other.high);
        let (low, least) = two_sum(self.low, other.low);
        let first = sum(high, rest + low);
        sum(first.high, first.low + least)
    }
}

impl Neg for Wide {
    type Output = Self;
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Sub for Wide {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Wide {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (high, low) = two_product(self.high, other.high);
        sum(high, low + (self.high * other.low + self.low * other.high))
    }
}

impl Div for Wide {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * Self::from(first);
        let second = rest.high / other.high;
        let rest = rest - other * Self::from(second);
        sum(first, second) + Self::from(rest.high / other.high)
    }
}

impl AddAssign for Wide {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

/// A vector of three.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wide3(pub [Wide; 3]);

impl Wide3 {
    pub fn dot(&self, other: &Self) -> Wide {
        self.0[0] * other.0[0] + self.0[1] * other.0[1] + self.0[2] * other.0[2]
    }

    pub fn norm(&self) -> Wide {
        // Scaled, since the squares of millimetres in nanometre units must not underflow.
        let most = self.0.iter().fold(0.0, |most: f64, c| most.max(c.high.abs()));
        if most == 0.0 {
            return Wide::ZERO;
        }
        let unit = Wide::ONE / Wide::from(most);
        let scaled = self.times(unit);
        scaled.dot(&scaled).sqrt() * Wide::from(most)
    }

    pub fn times(&self, factor: Wide) -> Self {
        Self(self.0.map(|c| c * factor))
    }

    pub fn plus(&self, other: &Self) -> Self {
        Self([0, 1, 2].map(|i| self.0[i] + other.0[i]))
    }

    pub fn minus(&self, other: &Self) -> Self {
        Self([0, 1, 2].map(|i| self.0[i] - other.0[i]))
    }

    pub fn f64(&self) -> nalgebra::Vector3<f64> {
        self.0.map(Wide::f64).into()
    }
}

impl From<nalgebra::Vector3<f64>> for Wide3 {
    fn from(v: nalgebra::Vector3<f64>) -> Self {
        Self([v.x, v.y, v.z].map(Wide::from))
    }
}

/// Symmetric: xx, yy, zz, xy, yz, zx.
pub type Wide6 = [Wide; 6];

/// Solves H·p = v by Cholesky, where H is positive definite but for its rounding; a lost pivot is replaced by a tiny
/// one, which only lengthens the step. Rows and columns are taken in order of falling pivots.
pub fn solve(h: &Wide6, v: &Wide3) -> Wide3 {
    let entry = |i: usize, j: usize| h[[[0, 3, 5], [3, 1, 4], [5, 4, 2]][i][j]];
    let mut rest = [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j)));
    let mut order = [0, 1, 2];
    let mut factor = [[Wide::ZERO; 3]; 3];
    let mut pivots = [Wide::ZERO; 3];
    let largest = (0..3).map(|i| entry(i, i).high).fold(0.0, f64::max);
    let least = Wide::from((1e-27 * largest).max(f64::MIN_POSITIVE));
    for step in 0..3 {
        let next = (step..3).max_by(|&i, &j| rest[order[i]][order[i]].high.total_cmp(&rest[order[j]][order[j]].high));
        order.swap(step, next.unwrap_or(step));
        let at = order[step];
        pivots[step] = rest[at][at].max(least);
        for &i in &order[step + 1..] {
            factor[i][step] = rest[i][at] / pivots[step];
        }
        for &i in &order[step + 1..] {
            for &j in &order[step + 1..] {
                rest[i][j] = rest[i][j] - factor[i][step] * factor[j][step] * pivots[step];
            }
        }
    }
    let mut y = [Wide::ZERO; 3];
    for step in 0..3 {
        let mut value = v.0[order[step]];
        for (earlier, solved) in y.iter().enumerate().take(step) {
            value = value - factor[order[step]][earlier] * *solved;
        }
        y[step] = value;
    }
    let mut p = Wide3::default();
    for step in (0..3).rev() {
        let mut value = y[step] / pivots[step];
        for later in step + 1..3 {
            value = value - factor[order[later]][step] * p.0[order[later]];
        }
        p.0[order[step]] = value;
    }
    p
}
