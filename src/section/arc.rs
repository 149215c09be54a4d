//! One arc of a boundary as a rational quadratic curve: its sector, its parts.

use super::bernstein::{Parameter, rising_root};
use nalgebra::Vector2;

/// The curve ((1−λ)²·from + 2λ(1−λ)·weight·pole + λ²·to) / ((1−λ)² + 2λ(1−λ)·weight + λ²), 0 ≤ λ ≤ 1, seen from
/// the origin counter-clockwise and over less than half a turn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arc {
    pub from: Vector2<f64>,
    /// Where the tangents at both ends meet.
    pub pole: Vector2<f64>,
    pub to: Vector2<f64>,
    /// Cosine of half the angle that the arc spans on the circle that it is an affine image of.
    pub weight: f64,
}

impl Arc {
    /// Area between the arc and the origin.
    pub fn sector(&self) -> f64 {
        let chord = self.to - self.from;
        let tangents = (self.pole - self.from).perp(&chord);
        let square = 1.0 / (self.weight * self.weight) - 1.0;
        0.5 * (self.from.perp(&self.to) + tangents * filling(square.max(0.0)))
    }

    /// Twice the area of the triangle of chord and point, positive on the side of the origin.
    pub fn behind_chord(&self, point: &Vector2<f64>) -> f64 {
        (self.to - self.from).perp(&(point - self.from))
    }

    /// Both parts, divided where the arc meets the ray through `direction`.
    pub fn split(&self, direction: &Vector2<f64>) -> (Self, Self) {
        let before = direction.perp(&self.from).min(0.0);
        let after = direction.perp(&self.to).max(0.0);
        self.split_at(rising_root([before, self.weight * direction.perp(&self.pole), after]))
    }

    /// Both parts, divided at a parameter (de Casteljau for a rational curve).
    pub fn split_at(&self, [a, b]: Parameter) -> (Self, Self) {
        let Self { from, pole, to, weight } = self;
        let (left, right) = (a + b * weight, a * weight + b);
        let whole = a * left + b * right;
        let root = whole.sqrt();
        let left_pole = (a * from + b * weight * pole) / left;
        let right_pole = (a * weight * pole + b * to) / right;
        let point = (a * left * left_pole + b * right * right_pole) / whole;
        (
            Self { from: *from, pole: left_pole, to: point, weight: left / root },
            Self { from: point, pole: right_pole, to: *to, weight: right / root },
        )
    }
}

/// Squares below which the nine terms of the series of [`filling`] leave less than ε: 0.03⁹ = 2e-14 times 2/399.
const SMALL: f64 = 0.03;

/// Area between arc and chord over the area of the triangle of its chord and tangents, from the square of the tangent
/// of half the angle: ((1+z)·atan√z − √z) / z^(3/2), for parabolas 2/3.
pub(super) fn filling(z: f64) -> f64 {
    if z < SMALL {
        const SERIES: [f64; 9] = [
            2.0 / 3.0,
            -2.0 / 15.0,
            2.0 / 35.0,
            -2.0 / 63.0,
            2.0 / 99.0,
            -2.0 / 143.0,
            2.0 / 195.0,
            -2.0 / 255.0,
            2.0 / 323.0,
        ];
        return SERIES.iter().rev().fold(0.0, |sum, term| sum * z + term);
    }
    let tangent = z.sqrt();
    ((1.0 + z) * tangent.atan() - tangent) / (z * tangent)
}
