//! Convex polygons in the plane from points: the lines of a particle with corners where they are wanted.

use crate::particle::coplanar::{self, Face};
use crate::particle::error::ParticleError;
use crate::particle::plane::Plane;
use nalgebra::{Vector2, Vector3};
use robust::{Coord, orient2d};

/// A convex polygon of three corners or more, counter-clockwise, about its centroid.
pub(super) struct Polygon {
    corners: Vec<Vector2<f64>>,
    sides: Vec<Plane>,
}

impl Polygon {
    /// The convex hull of points, in any order.
    pub(super) fn hull(points: &[[f64; 2]]) -> Result<Self, ParticleError> {
        if let Some(index) = points.iter().position(|point| point.iter().any(|value| !value.is_finite())) {
            let [x, y] = points[index];
            return Err(ParticleError::VertexNotFinite { index, x, y });
        }
        let flat = ParticleError::FlatVertices(points.len());
        // From a point among them: far from the origin only differences are precise.
        let first = Vector2::from(*points.first().ok_or(flat)?);
        let mut sorted: Vec<Vector2<f64>> = points.iter().map(|&point| Vector2::from(point) - first).collect();
        sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        let mut corners = chain(sorted.iter());
        corners.append(&mut chain(sorted.iter().rev()));
        let centroid = centroid(&corners).ok_or(flat)?;
        corners.iter_mut().for_each(|corner| *corner -= centroid);
        let sides = distinct_sides(&corners).ok_or(flat)?;
        Ok(Self { corners, sides })
    }

    /// The outermost distance of a corner from the centroid, length.
    pub(super) fn radius(&self) -> f64 {
        self.corners.iter().map(|corner| corner.norm()).fold(0.0, f64::max)
    }

    /// The sides, moved inwards by r, so that the particle's sides lie where those of the polygon are.
    pub(super) fn lines(&self, r: f64) -> Result<Vec<Plane>, ParticleError> {
        let limit = self.sides.iter().map(|side| side.offset).fold(f64::INFINITY, f64::min);
        if r >= limit {
            return Err(ParticleError::RoundingTooLarge { r, limit });
        }
        Ok(self.sides.iter().map(|side| Plane { offset: side.offset - r, ..*side }).collect())
    }
}

/// The sides of a convex polygon that are distinct, as those of the prism on it; `None` if it is flat.
fn distinct_sides(corners: &[Vector2<f64>]) -> Option<Vec<Plane>> {
    let count = corners.len() as u32;
    let half = 0.5 * coplanar::extent(&corners.iter().map(|corner| corner.push(0.0)).collect::<Vec<_>>());
    let prism: Vec<Vector3<f64>> =
        [-half, half].iter().flat_map(|&z| corners.iter().map(move |corner| corner.push(z))).collect();
    let side = |i: u32| {
        let next = (i + 1) % count;
        Face::new(&prism, vec![i, next, count + next, count + i])
    };
    let ends = [Face::new(&prism, (0..count).rev().collect()), Face::new(&prism, (count..2 * count).collect())];
    let faces: Vec<Face<Vec<u32>>> = (0..count).map(side).chain(ends).collect();
    let mut planes = coplanar::distinct(&prism, &faces, 0.0)?.planes;
    planes.retain(|(face, _)| (*face as u32) < count);
    planes.sort_by_key(|(face, _)| *face);
    Some(planes.into_iter().map(|(_, plane)| plane).collect())
}

/// Half of the hull of points sorted along x, without its last corner (Andrew's monotone chain).
fn chain<'a>(points: impl Iterator<Item = &'a Vector2<f64>>) -> Vec<Vector2<f64>> {
    let mut corners: Vec<Vector2<f64>> = Vec::new();
    for point in points {
        while let [.., before, last] = corners[..] {
            // Exact in its sign.
            let [a, b, c] = [before, last, *point].map(|p| Coord { x: p.x, y: p.y });
            if orient2d(a, b, c) > 0.0 {
                break;
            }
            corners.pop();
        }
        corners.push(*point);
    }
    corners.pop();
    corners
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
