//! The builders.

use super::error::{ShapeError, positive, within};
use super::hull::faces;
use super::rounding::{Definition, Rounding, Shape, block};
use super::surface::{refuse_concave, refuse_open};
use crate::particle::plane::Plane;
use crate::rock::{Block, FaceOf};
use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};

/// Of half-spaces n·x ≤ d, with normals of any length: the faces of the particle are where these planes are (its own planes lie deeper, by about r).
/// Planes that make no face are left out.
///
/// # Errors
/// Planes without a normal or whose numbers are not finite, that enclose no volume or hold no point; a rounding out of range.
pub fn half_spaces(planes: &[Plane], rounding: &Rounding) -> Result<Shape, ShapeError> {
    Shape::rounded(planes, rounding)
}

/// Of the convex hull of points, rounded inwards: no part lies outside the hull. Triangles that are coplanar to 1e-6 of the extent are one face.
///
/// # Errors
/// Points that are not finite, fewer than four, or all in a plane; a rounding out of range.
pub fn hull(points: &[[f64; 3]], rounding: &Rounding) -> Result<Shape, ShapeError> {
    let (middle, points) = about_middle(points);
    placed(&body(&faces(&points)?, &points)?, &middle, rounding)
}

/// Of a closed convex surface of triangles, three indices of points each, in any sense of rotation.
///
/// # Errors
/// Those of [`hull`]; a surface that is open, not convex or crosses itself, of which [`hull`] makes the convex hull.
pub fn surface(points: &[[f64; 3]], triangles: &[[u32; 3]], rounding: &Rounding) -> Result<Shape, ShapeError> {
    let (middle, points) = about_middle(points);
    refuse_open(points.len(), triangles)?;
    let faces = faces(&points)?;
    let body = body(&faces, &points)?;
    refuse_concave(&points, triangles, &faces, body.faces.iter().map(|face| face.area).sum())?;
    placed(&body, &middle, rounding)
}

/// The middle of points, and the points about it: their distances from it have all digits, however far away they are.
fn about_middle(points: &[[f64; 3]]) -> (Vector3<f64>, Vec<Vector3<f64>>) {
    let points: Vec<Vector3<f64>> = points.iter().map(|&point| point.into()).collect();
    let [low, high] = extremes(&points);
    let middle = 0.5 * low + 0.5 * high;
    let origin = if middle.iter().all(|c| c.is_finite()) { middle } else { Vector3::zeros() };
    (origin, points.iter().map(|point| point - origin).collect())
}

fn extremes(points: &[Vector3<f64>]) -> [Vector3<f64>; 2] {
    let first = points.first().copied().unwrap_or_default();
    points.iter().fold([first; 2], |[low, high], point| [low.inf(point), high.sup(point)])
}

/// The sharp body of the faces of a hull of points about their middle. Of a flat body all planes may pass close to the origin, while it reaches far: a
/// box about the points says how far, and makes no face.
fn body(faces: &[Plane], points: &[Vector3<f64>]) -> Result<Block, ShapeError> {
    let [low, high] = extremes(points);
    let sides = (0..6).map(|i| {
        let normal = Vector3::ith(i / 2, if i % 2 == 0 { 1.0 } else { -1.0 });
        Plane { normal, offset: (high - low).max() }
    });
    let planes: Vec<Plane> = sides.chain(faces.iter().copied()).collect();
    let flat = ShapeError::Flat(points.len());
    let body = block(&planes).map_err(|error| match error {
        ShapeError::Empty | ShapeError::Open => flat.clone(),
        other => other,
    })?;
    let is_open = body.faces.iter().any(|face| matches!(face.of, FaceOf::Domain(side) if side < 6));
    if is_open { Err(flat) } else { Ok(body) }
}

/// A body about a place, rounded.
fn placed(body: &Block, place: &Vector3<f64>, rounding: &Rounding) -> Result<Shape, ShapeError> {
    let shape = Shape::of_block(body, rounding)?;
    Ok(Shape { centroid: shape.centroid + place, ..shape })
}

/// A sphere: k = 1.
///
/// # Errors
/// A radius that is not positive and finite.
pub fn sphere(radius: f64) -> Result<Shape, ShapeError> {
    let radius = positive(radius, "radius")?;
    let definition = |_: &Vector3<f64>| Definition { planes: Vec::new(), r: 0.0, k: 1.0, shadow_radius: radius };
    Shape::settled(definition, Vector3::zeros(), 2.0 * radius)
}

/// A cuboid about the origin with these edges along x, y, z, length.
///
/// # Errors
/// An edge that is not positive and finite; a rounding out of range.
pub fn cuboid(edges: [f64; 3], rounding: &Rounding) -> Result<Shape, ShapeError> {
    let mut planes = Vec::new();
    for (axis, edge) in edges.into_iter().enumerate() {
        let offset = 0.5 * positive(edge, ["edge x", "edge y", "edge z"][axis])?;
        planes.extend([1.0, -1.0].map(|sign| Plane { normal: Vector3::ith(axis, sign), offset }));
    }
    Shape::rounded(&planes, rounding)
}

/// A regular prism along z, its heights from −height/2 to height/2, the first side towards x; `radius` is that of the circle within its section.
///
/// # Errors
/// Fewer than three sides, a length that is not positive and finite; a rounding out of range.
pub fn prism(sides: usize, radius: f64, height: f64, rounding: &Rounding) -> Result<Shape, ShapeError> {
    frustum(sides, radius, radius, height, rounding)
}

/// The same with another radius at its upper end; 0 makes a pyramid.
///
/// # Errors
/// Those of [`prism`]; an upper radius that is negative or not finite.
pub fn frustum(
    sides: usize,
    radius: f64,
    top_radius: f64,
    height: f64,
    rounding: &Rounding,
) -> Result<Shape, ShapeError> {
    if sides < 3 {
        return Err(ShapeError::TooFewSides(sides));
    }
    let (radius, height) = (positive(radius, "radius")?, positive(height, "height")?);
    let top = within(top_radius, top_radius >= 0.0, "top radius", "finite and not below 0")?;
    let side = |i: usize| {
        let (sin, cos) = (TAU * i as f64 / sides as f64).sin_cos();
        Plane { normal: Vector3::new(cos, sin, (radius - top) / height), offset: 0.5 * (radius + top) }
    };
    let ends = [1.0, -1.0].map(|sign| Plane { normal: Vector3::ith(2, sign), offset: 0.5 * height });
    Shape::rounded(&(0..sides).map(side).chain(ends).collect::<Vec<_>>(), rounding)
}

/// A cylinder along z as a prism of as many sides, whose section has the area π radius².
///
/// # Errors
/// Those of [`prism`].
pub fn cylinder(radius: f64, height: f64, sides: usize, rounding: &Rounding) -> Result<Shape, ShapeError> {
    if sides < 3 {
        return Err(ShapeError::TooFewSides(sides));
    }
    let inner = positive(radius, "radius")? * (PI / (sides as f64 * (PI / sides as f64).tan())).sqrt();
    prism(sides, inner, height, rounding)
}

/// The regular solid of 4, 6, 8, 12 or 20 faces with this length of edges, about the origin.
///
/// # Errors
/// Another number of faces, an edge that is not positive and finite; a rounding out of range.
pub fn regular_solid(faces: usize, edge: f64, rounding: &Rounding) -> Result<Shape, ShapeError> {
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    let signs = [-1.0, 1.0];
    let cube: Vec<[f64; 3]> =
        signs.iter().flat_map(|&x| signs.map(|y| [x, y])).flat_map(|[x, y]| signs.map(|z| [x, y, z])).collect();
    let cyclic = |points: &[[f64; 3]]| -> Vec<[f64; 3]> {
        points.iter().flat_map(|p| [0, 1, 2].map(|i| [0, 1, 2].map(|j| p[(i + j) % 3]))).collect()
    };
    let crossed =
        |a: f64, b: f64| -> Vec<[f64; 3]> { signs.iter().flat_map(|&x| signs.map(|y| [0.0, a * x, b * y])).collect() };
    let (points, length) = match faces {
        4 => (cube.into_iter().filter(|p| p.iter().product::<f64>() > 0.0).collect(), 8f64.sqrt()),
        6 => (cube, 2.0),
        8 => (cyclic(&signs.map(|s| [s, 0.0, 0.0])), 2f64.sqrt()),
        12 => ([cube, cyclic(&crossed(1.0 / golden, golden))].concat(), 2.0 / golden),
        20 => (cyclic(&crossed(1.0, golden)), 2.0),
        _ => return Err(ShapeError::NoRegularSolid(faces)),
    };
    let scale = positive(edge, "edge")? / length;
    hull(&points.iter().map(|p: &[f64; 3]| p.map(|c| scale * c)).collect::<Vec<_>>(), rounding)
}
