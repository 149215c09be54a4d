//! Convex polygons from points: the lines of a particle with corners where they are wanted.

use super::particle::Line;
use crate::particle::particle::ParticleError;
use nalgebra::Vector2;
use std::f64::consts::TAU;

/// A convex polygon of three corners or more, counter-clockwise, about its centroid.
pub(super) struct Polygon {
    corners: Vec<Vector2<f64>>,
}

impl Polygon {
    /// The convex hull of points, in any order.
    pub(super) fn hull(points: &[[f64; 2]]) -> Result<Self, ParticleError> {
        if let Some(index) = points.iter().position(|point| point.iter().any(|value| !value.is_finite())) {
            let [x, y] = points[index];
            return Err(ParticleError::VertexNotFinite { index, x, y });
        }
        let flat = ParticleError::FlatVertices(points.len());
        // From a point among them: far from the origin the differences are what is known well.
        let first = Vector2::from(*points.first().ok_or(flat)?);
        let mut sorted: Vec<Vector2<f64>> = points.iter().map(|&point| Vector2::from(point) - first).collect();
        sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        let mut corners = chain(sorted.iter());
        corners.append(&mut chain(sorted.iter().rev()));
        let centroid = centroid(&corners).ok_or(flat)?;
        corners.iter_mut().for_each(|corner| *corner -= centroid);
        Ok(Self { corners })
    }

    /// The outermost distance of a corner from the centroid, length.
    pub(super) fn radius(&self) -> f64 {
        self.corners.iter().map(|corner| corner.norm()).fold(0.0, f64::max)
    }

    /// The sides, moved inwards by r, so that the particle's sides lie where those of the polygon are.
    pub(super) fn lines(&self, r: f64) -> Result<Vec<Line>, ParticleError> {
        let sides: Vec<Line> = self.sides().collect();
        let limit = sides.iter().map(|side| side.offset).fold(f64::INFINITY, f64::min);
        if r >= limit {
            return Err(ParticleError::RoundingTooLarge { r, limit });
        }
        Ok(sides.into_iter().map(|side| Line { offset: side.offset - r, ..side }).collect())
    }

    fn sides(&self) -> impl Iterator<Item = Line> + '_ {
        let ends = self.corners.iter().cycle().skip(1);
        self.corners.iter().zip(ends).map(|(from, to)| {
            let along = (to - from).normalize();
            let normal = Vector2::new(along.y, -along.x);
            Line { normal, offset: 0.5 * normal.dot(&(from + to)) }
        })
    }
}

/// Corners of a regular polygon about the origin, the first on the x axis; radius: of the circle through them.
pub(super) fn regular(sides: usize, radius: f64) -> Vec<[f64; 2]> {
    (0..sides)
        .map(|i| {
            let (sine, cosine) = (TAU * i as f64 / sides as f64).sin_cos();
            [radius * cosine, radius * sine]
        })
        .collect()
}

/// Half of the hull of points sorted along x, without its last corner (Andrew's monotone chain).
fn chain<'a>(points: impl Iterator<Item = &'a Vector2<f64>>) -> Vec<Vector2<f64>> {
    let mut corners: Vec<Vector2<f64>> = Vec::new();
    for point in points {
        while let [.., before, last] = corners[..] {
            if turns_left(&(last - before), &(point - last)) {
                break;
            }
            corners.pop();
        }
        corners.push(*point);
    }
    corners.pop();
    corners
}

/// Whether b turns left from a by more than rounding explains: the sum of two products is off by at most γ₂ of their sizes,
/// and each difference of points by half an ulp.
fn turns_left(a: &Vector2<f64>, b: &Vector2<f64>) -> bool {
    let (one, other) = (a.x * b.y, a.y * b.x);
    one - other > 4.0 * f64::EPSILON * (one.abs() + other.abs())
}

/// Of the area of a counter-clockwise polygon; `None` if it has none.
fn centroid(corners: &[Vector2<f64>]) -> Option<Vector2<f64>> {
    let &[from, ref others @ ..] = corners else { return None };
    let (mut doubled, mut first) = (0.0, Vector2::zeros());
    for pair in others.windows(2) {
        let (a, b) = (pair[0] - from, pair[1] - from);
        let part = a.perp(&b);
        doubled += part;
        first += part * (a + b) / 3.0;
    }
    (doubled > 0.0).then(|| from + first / doubled)
}
