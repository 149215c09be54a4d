//! Area and moments of a particle's cut by a plane through its origin, in closed form: each arc of the boundary adds
//! the triangle of its chord and the origin, and the segment between chord and arc.
//!
//! With m the middle of the chord, c half of it, and e from m to the pole, a point of the segment is m + x c + y e. In
//! x and y the segment lies between y = 0 and the conic x² + z y² + 2y = 1, z the square of the tangent of half the
//! angle that the arc spans on its circle. With A its area there, integrating the divergence of (x q, 0), (0, q) and
//! (0, y q), q = 1 − x² − z y² − 2y, over it gives
//!
//! ```text
//! ∫y = (2/3 − A)/z      ∫x² = (A − ∫y)/4      ∫y² = (A − 5∫y)/(4z)
//! ```

use super::arc::{Arc, filling};
use super::boundary::Boundary;
use super::cross_section::CrossSection;
use super::lines::Line;
use super::plane_section::{Failure, PlaneSection};
use crate::particle::solid::Solid;
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

/// Integrals over an area of the plane.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Moments {
    /// ∫dA, length².
    pub area: f64,
    /// ∫x dA, length³.
    pub first: Vector2<f64>,
    /// ∫x xᵀ dA, length⁴.
    pub second: Matrix2<f64>,
}

/// A part of a boundary, or of a polygon near it, with what the area between it and the origin adds.
pub(crate) struct Sector {
    pub moments: Moments,
    /// Its ends, and between them where their tangents meet: it is no longer than the way along them.
    pub corners: [Vector2<f64>; 3],
    /// Estimated bound on its distance from the boundary, length.
    pub deviation: f64,
}

impl Moments {
    /// Of the triangle of the origin and two points, counter-clockwise.
    pub fn triangle(from: &Vector2<f64>, to: &Vector2<f64>) -> Self {
        let (area, sum) = (0.5 * from.perp(to), from + to);
        let squares = from * from.transpose() + to * to.transpose() + sum * sum.transpose();
        Self { area, first: area / 3.0 * sum, second: area / 12.0 * squares }
    }

    /// Of the area between an arc and the origin.
    fn sector(arc: &Arc) -> Self {
        let Arc { from, pole, to, .. } = arc;
        let (m, c) = (0.5 * (from + to), 0.5 * (to - from));
        let e = pole - m;
        let [a, y, xx, yy] = segment((1.0 / (arc.weight * arc.weight) - 1.0).max(0.0));
        let unit = e.perp(&c);
        let mixed = m * e.transpose();
        Self::triangle(from, to).plus(&Self {
            area: unit * a,
            first: unit * (a * m + y * e),
            second: unit
                * (a * (m * m.transpose())
                    + y * (mixed + mixed.transpose())
                    + xx * (c * c.transpose())
                    + yy * (e * e.transpose())),
        })
    }

    pub fn plus(&self, other: &Self) -> Self {
        Self { area: self.area + other.area, first: self.first + other.first, second: self.second + other.second }
    }
}

/// Below this square of the tangent a series is summed: there the recurrence would lose more than two digits.
const SMALL: f64 = 0.3;

/// Terms that leave less than ε of it: 0.3³⁰ = 2e-16.
const TERMS: u32 = 30;

/// Integrals of 1, y, x² and y² over a segment. The first is Σ aₙ zⁿ with aₙ = 2 (−1)ⁿ/((2n+1)(2n+3)), and the others
/// follow from the same series begun at its next terms, since each division by z takes off the first.
fn segment(z: f64) -> [f64; 4] {
    let a = filling(z);
    let term = |n: u32| f64::from(1 - 2 * (n as i32 % 2)) * 2.0 / f64::from((2 * n + 1) * (2 * n + 3));
    let [b, c] = if z < SMALL {
        [1, 2].map(|first| (first..first + TERMS).rev().fold(0.0, |sum, n| sum * z + term(n)))
    } else {
        let b = (a - term(0)) / z;
        [b, (b - term(1)) / z]
    };
    [a, -b, 0.25 * (a + b), 0.25 * (b + 5.0 * c)]
}

/// Calls `each` with the parts of the boundary of the cut z = 0 of a shape, once around. Fails where the end of one is
/// not where S = 1 to rounding.
pub(crate) fn sectors(shape: &Solid, mut each: impl FnMut(Sector)) -> Result<(), Failure> {
    let (origin, axes) = (Vector3::zeros(), [Vector3::x(), Vector3::y()]);
    let section = PlaneSection { shape, branch: origin, rotation: Matrix3::identity(), point: origin, axes };
    let mut lines = vec![Line::default(); shape.len()];
    let mut boundary = Boundary::new(CrossSection::new(&section, &mut lines)?)?;
    while !boundary.is_complete() {
        let arc = boundary.next_arc()?;
        let corners = [arc.from, arc.pole, arc.to];
        each(Sector { moments: Moments::sector(&arc), corners, deviation: boundary.deviation() });
    }
    if boundary.is_closed() { Ok(()) } else { Err(Failure::Inaccurate) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By a sum over strips of the segment, x = sin φ/sin θ.
    #[test]
    fn integrals_of_a_segment_are_those_of_its_strips() {
        for tangent in [1e-9_f64, 1e-3, 0.1, 0.5477, 0.5478, 1.0, 1.7] {
            let z = tangent * tangent;
            let strips = 20_000;
            let mut sums = [0.0; 4];
            for i in 0..strips {
                // By the angle, so that the strips narrow towards the ends, where y has a root.
                let angle = (f64::from(2 * i + 1) / f64::from(strips) - 1.0) * std::f64::consts::FRAC_PI_2;
                let (x, width) = (angle.sin(), angle.cos() * std::f64::consts::PI / f64::from(strips));
                let y = (1.0 - x * x) / (1.0 + (1.0 + z * (1.0 - x * x)).sqrt());
                let strip = [y, y * y / 2.0, x * x * y, y.powi(3) / 3.0];
                sums.iter_mut().zip(strip).for_each(|(sum, value)| *sum += width * value);
            }
            for (found, sum) in segment(z).into_iter().zip(sums) {
                assert!((found / sum - 1.0).abs() < 1e-7, "{tangent}: {found} for {sum}");
            }
        }
    }
}
