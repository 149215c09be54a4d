//! Whether triangles are the whole surface of the convex hull of their points.

use super::error::ShapeError;
use super::hull::COPLANAR;
use crate::particle::plane::Plane;
use nalgebra::Vector3;
use std::collections::HashMap;

/// How far the area of the triangles may be from that of the hull, as a share.
const COVERED: f64 = 1e-3;

/// Refuses triangles that leave edges open, or name points that are not there.
pub(super) fn refuse_open(points: usize, triangles: &[[u32; 3]]) -> Result<(), ShapeError> {
    let mut edges: HashMap<[u32; 2], usize> = HashMap::new();
    for (triangle, corners) in triangles.iter().enumerate() {
        if let Some(&point) = corners.iter().find(|&&point| point as usize >= points) {
            return Err(ShapeError::NoSuchPoint { triangle, point, points });
        }
        for i in 0..3 {
            let (from, to) = (corners[i], corners[(i + 1) % 3]);
            *edges.entry([from.min(to), from.max(to)]).or_default() += 1;
        }
    }
    let wrong = || edges.iter().filter(|(_, count)| **count != 2).map(|(edge, _)| *edge);
    match wrong().min() {
        Some([from, to]) => Err(ShapeError::OpenSurface { edges: wrong().count(), from, to }),
        None => Ok(()),
    }
}

/// Refuses triangles that are not the surface of the body of these faces, of this area, or cover it more than once.
pub(super) fn refuse_concave(
    points: &[Vector3<f64>],
    triangles: &[[u32; 3]],
    faces: &[Plane],
    area: f64,
) -> Result<(), ShapeError> {
    let extent = area.sqrt();
    let mut covered = 0.0;
    for (triangle, corners) in triangles.iter().enumerate() {
        let [a, b, c] = corners.map(|i| points[i as usize]);
        covered += 0.5 * (b - a).cross(&(c - a)).norm();
        let middle = (a + b + c) / 3.0;
        let below = |face: &Plane| face.offset - face.normal.dot(&middle);
        let depth = faces.iter().map(below).fold(f64::INFINITY, f64::min);
        if depth > COPLANAR * extent {
            return Err(ShapeError::Concave { triangle, depth });
        }
    }
    let covers = covered / area;
    if (covers - 1.0).abs() > COVERED { Err(ShapeError::Covers(covers)) } else { Ok(()) }
}
