//! The builders.

use super::error::{ShapeError, positive, within};
use super::rounding::{Definition, Rounding, Shape};
use super::sharp_body::SharpBody;
use crate::particle::mass_properties::MASS_TOLERANCE;
use crate::particle::plane::{MAX_PLANES, Plane};
use nalgebra::Vector3;
use std::f64::consts::TAU;

/// Of half-spaces n·x ≤ d, with normals of any length: the faces of the particle are where these planes are (its own
/// planes lie deeper, by about r). Planes that make no face are left out.
///
/// # Errors
/// Planes without a normal or whose numbers are not finite, that enclose no volume or hold no point; a rounding out of
/// range.
pub fn half_spaces(planes: &[Plane], rounding: &Rounding) -> Result<Shape, ShapeError> {
    rounded(&SharpBody::of_planes(planes)?, rounding)
}

/// Of the convex hull of points, rounded inwards: no part lies outside the hull. Faces that are coplanar to 1e-6 of the
/// extent are one.
///
/// # Errors
/// Points that are not finite, fewer than four, or all in a plane; a rounding out of range.
pub fn hull(points: &[[f64; 3]], rounding: &Rounding) -> Result<Shape, ShapeError> {
    known_hull(points, None, 0.0, rounding)
}

/// Of a closed convex surface of triangles, three indices of points each, in any sense of rotation.
///
/// # Errors
/// Those of [`hull`]; a surface that is open, not convex or crosses itself, of which [`hull`] makes the convex hull.
pub fn surface(points: &[[f64; 3]], triangles: &[[u32; 3]], rounding: &Rounding) -> Result<Shape, ShapeError> {
    known_hull(points, Some(triangles), 0.0, rounding)
}

/// Of points that are known to a length, as those of a file are by their digits: faces that are coplanar within it are
/// one. Of the convex hull, which triangles, if given, must be the surface of.
///
/// # Errors
/// Those of [`hull`] or [`surface`]; points that are flat within that length.
pub fn known_hull(
    points: &[[f64; 3]],
    triangles: Option<&[[u32; 3]]>,
    known: f64,
    rounding: &Rounding,
) -> Result<Shape, ShapeError> {
    let body = match triangles {
        Some(triangles) => SharpBody::of_surface(points, triangles, known)?,
        None => SharpBody::of_points(points, known)?,
    };
    rounded(&body, rounding)
}

/// The faces of the hull of points, about their middle: for tests.
#[doc(hidden)]
pub fn sharp_hull(points: &[[f64; 3]]) -> Result<(Vector3<f64>, Vec<Plane>), ShapeError> {
    let body = SharpBody::of_points(points, 0.0)?;
    Ok((body.origin, body.planes))
}

/// The faces of the body of half-spaces: for tests.
#[doc(hidden)]
pub fn sharp_planes(planes: &[Plane]) -> Result<Vec<Plane>, ShapeError> {
    Ok(SharpBody::of_planes(planes)?.planes)
}

fn rounded(body: &SharpBody, rounding: &Rounding) -> Result<Shape, ShapeError> {
    Shape::of_body(body, rounding, None)
}

/// A sphere: k = 1.
///
/// # Errors
/// A radius that is not positive and finite.
pub fn sphere(radius: f64) -> Result<Shape, ShapeError> {
    let radius = positive(radius, "radius")?;
    let definition = |_: &Vector3<f64>| Definition { planes: Vec::new(), r: 0.0, k: 1.0, shadow_radius: radius };
    Shape::settled(definition, Vector3::zeros(), 2.0 * radius, MASS_TOLERANCE)
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
    half_spaces(&planes, rounding)
}

/// A regular prism along z, its heights from −height/2 to height/2, the first side towards x; `radius` is that of the
/// circle within its section.
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
    rounded(&sharp_frustum(sides, radius, top_radius, height)?, rounding)
}

/// As `frustum`, not rounded.
pub fn sharp_frustum(sides: usize, radius: f64, top_radius: f64, height: f64) -> Result<SharpBody, ShapeError> {
    if !(3..=MAX_PLANES - 2).contains(&sides) {
        return Err(ShapeError::Sides(sides));
    }
    let (radius, height) = (positive(radius, "radius")?, positive(height, "height")?);
    let top = within(top_radius, top_radius >= 0.0, "top radius", "finite and not below 0")?;
    let side = |i: usize| {
        let (sin, cos) = (TAU * i as f64 / sides as f64).sin_cos();
        Plane { normal: Vector3::new(cos, sin, (radius - top) / height), offset: 0.5 * (radius + top) }
    };
    let ends = [1.0, -1.0].map(|sign| Plane { normal: Vector3::ith(2, sign), offset: 0.5 * height });
    SharpBody::of_planes(&(0..sides).map(side).chain(ends).collect::<Vec<_>>())
}

/// The regular solid of 4, 6, 8, 12 or 20 faces with this length of edges, about the origin.
///
/// # Errors
/// Another number of faces, an edge that is not positive and finite; a rounding out of range.
pub fn regular_solid(faces: usize, edge: f64, rounding: &Rounding) -> Result<Shape, ShapeError> {
    rounded(&sharp_regular_solid(faces, edge)?, rounding)
}

/// As `regular_solid`, not rounded.
pub fn sharp_regular_solid(faces: usize, edge: f64) -> Result<SharpBody, ShapeError> {
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
    SharpBody::of_points(&points.iter().map(|p: &[f64; 3]| p.map(|c| scale * c)).collect::<Vec<_>>(), 0.0)
}
