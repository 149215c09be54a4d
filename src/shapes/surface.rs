//! Whether triangles are the whole surface of the convex hull of their points.

use super::error::ShapeError;
use super::numbers::COVERED;
use super::sharp_body::{HullOfPoints, SharpBody, about_middle};
use crate::particle::coplanar;
use crate::particle::numbers::COPLANAR;
use crate::particle::plane::Plane;
use nalgebra::Vector3;
use std::collections::HashMap;

impl SharpBody {
    /// The hull of a closed convex surface of triangles, three numbers of points each, in any sense of rotation.
    /// `known`: as of [`Self::of_points`].
    ///
    /// # Errors
    /// Those of [`Self::of_points`]; a surface that is open, not convex or crosses itself.
    pub fn of_surface(points: &[[f64; 3]], triangles: &[[u32; 3]], known: f64) -> Result<Self, ShapeError> {
        let (middle, about) = about_middle(points);
        let hull = HullOfPoints::new(&about, known)?;
        refuse_open(points, triangles)?;
        refuse_concave(&about, triangles, &hull, &middle, known)?;
        Ok(hull.body.at(middle))
    }
}

/// Refuses triangles that leave edges open, or name points that are not there.
pub fn refuse_open(points: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<(), ShapeError> {
    let mut edges: HashMap<[u32; 2], usize> = HashMap::new();
    for (triangle, corners) in triangles.iter().enumerate() {
        if let Some(&point) = corners.iter().find(|&&point| point as usize >= points.len()) {
            return Err(ShapeError::NoSuchPoint { triangle, point, points: points.len() });
        }
        for i in 0..3 {
            let (from, to) = (corners[i], corners[(i + 1) % 3]);
            *edges.entry([from.min(to), from.max(to)]).or_default() += 1;
        }
    }
    let wrong = |is_wrong: fn(usize) -> bool| {
        let edges = edges.iter().filter(move |(_, count)| is_wrong(**count)).map(|(edge, _)| *edge);
        edges.clone().min().map(|first| (edges.count(), first.map(|i| points[i as usize])))
    };
    if let Some((edges, [from, to])) = wrong(|count| count < 2) {
        return Err(ShapeError::OpenSurface { edges, from, to });
    }
    match wrong(|count| count > 2) {
        Some((edges, [from, to])) => Err(ShapeError::BranchedSurface { edges, from, to }),
        None => Ok(()),
    }
}

/// Refuses triangles that are not the surface of the hull of their points, which are about `middle`, or cover it more
/// than once.
fn refuse_concave(
    points: &[Vector3<f64>],
    triangles: &[[u32; 3]],
    hull: &HullOfPoints,
    middle: &Vector3<f64>,
    known: f64,
) -> Result<(), ShapeError> {
    let HullOfPoints { body, area, planes_around } = hull;
    let within = (COPLANAR * coplanar::extent(points)).max(known);
    let below = |plane: &Plane, at: &Vector3<f64>| plane.offset - plane.normal.dot(at);
    let mut covered = 0.0;
    for triangle in triangles {
        let [a, b, c] = triangle.map(|i| points[i as usize]);
        covered += 0.5 * (b - a).cross(&(c - a)).norm();
        let centre = (a + b + c) / 3.0;
        // Most lie on a plane through one of their corners.
        let near = triangle.iter().flat_map(|&corner| &planes_around[corner as usize]);
        if near.map(|&plane| &body.planes[plane as usize]).any(|plane| below(plane, &centre) <= within) {
            continue;
        }
        let depth = |at: &Vector3<f64>| body.planes.iter().map(|plane| below(plane, at)).fold(f64::INFINITY, f64::min);
        if depth(&centre) > within {
            let deepest = [a, b, c].into_iter().map(|at| (depth(&at), at)).max_by(|(i, _), (j, _)| i.total_cmp(j));
            let corner = deepest.filter(|(depth, _)| *depth > within);
            let (what, (depth, at)) =
                corner.map_or_else(|| ("triangle", (depth(&centre), centre)), |corner| ("point", corner));
            return Err(ShapeError::Concave { what, at: (at + middle).into(), depth });
        }
    }
    let covers = covered / area;
    if (covers - 1.0).abs() > COVERED { Err(ShapeError::Covers(covers)) } else { Ok(()) }
}
