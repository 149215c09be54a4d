//! Round bodies: what is exact with few planes, and prisms whose size is that of what is round.
//!
//! Σ⟨n_i·x − d_i⟩² of orthogonal normals is the square of a distance: of ±x, ±y at d = 0 and ±z at d = l/2 that from a
//! segment, whose level set is a capsule; of ±x, ±y, ±z at d = 0, with normals as long as the inverse of each
//! semi-axis, the form of an ellipsoid.

use super::error::{ShapeError, positive};
use super::numbers::{CIRCLE_SIDES, LOST, Limits};
use super::rounding::{Rounding, Shape};
use super::solids::{frustum, prism};
use crate::particle::mass_properties::MassProperties;
use crate::particle::particle::Particle;
use crate::particle::plane::{MAX_PLANES, Plane};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::{PI, TAU};

/// Sides of a cylinder or cone that nobody has chosen, and planes of a superquadric.
pub const SIDES: usize = 48;

/// An ellipsoid about the origin with these semi-axes along x, y, z, length: exact, of 6 planes through its centre.
///
/// # Errors
/// A semi-axis that is not positive and finite.
pub fn ellipsoid(axes: [f64; 3]) -> Result<Shape, ShapeError> {
    for (axis, name) in axes.into_iter().zip(["semi-axis x", "semi-axis y", "semi-axis z"]) {
        positive(axis, name)?;
    }
    let r = axes.into_iter().fold(f64::INFINITY, f64::min);
    let normals = (0..3).flat_map(|axis| [1.0, -1.0].map(|sign| Vector3::ith(axis, sign * r / axes[axis])));
    let planes: Vec<Plane> = normals.map(|normal| Plane { normal, offset: 0.0 }).collect();
    let volume = 4.0 / 3.0 * PI * axes.iter().product::<f64>();
    of_planes(&planes, r, volume, Vector3::from(axes).map(|axis| volume / 5.0 * axis * axis))
}

/// A capsule along z, all points within `radius` of a segment of this length about the origin: exact, of 6 planes.
///
/// # Errors
/// A length that is not positive and finite.
pub fn capsule(radius: f64, length: f64) -> Result<Shape, ShapeError> {
    let (r, length) = (positive(radius, "radius")?, positive(length, "length")?);
    let offset = |axis: usize| if axis == 2 { 0.5 * length } else { 0.0 };
    let plane = |axis: usize, sign: f64| Plane { normal: Vector3::ith(axis, sign), offset: offset(axis) };
    let planes: Vec<Plane> = (0..3).flat_map(|axis| [1.0, -1.0].map(|sign| plane(axis, sign))).collect();
    let (tube, ends) = (PI * r * r * length, 4.0 / 3.0 * PI * r.powi(3));
    // ∫x² and ∫z²: half balls have their centroids 3r/8 beyond the ends.
    let across = tube * r * r / 4.0 + ends * r * r / 5.0;
    let along = tube * length * length / 12.0 + ends * (r * r / 5.0 + length * length / 4.0 + 3.0 * length * r / 8.0);
    of_planes(&planes, r, tube + ends, Vector3::new(across, across, along))
}

/// A particle about its own centroid, k = 0, with these second moments ∫x², ∫y², ∫z².
fn of_planes(planes: &[Plane], r: f64, volume: f64, second: Vector3<f64>) -> Result<Shape, ShapeError> {
    let inertia = Matrix3::from_diagonal(&second.map(|own| second.sum() - own));
    let mass = MassProperties { volume, centroid: Vector3::zeros(), inertia, error: 0.0 };
    Ok(Shape {
        particle: Particle::new(planes, r, 0.0, 1.0)?,
        mass,
        sharp_volume: volume,
        centroid: Vector3::zeros(),
        orientation: [1.0, 0.0, 0.0, 0.0],
    })
}

/// A cylinder along z as a prism of as many sides, whose section, rounded as it is, has the area π radius².
///
/// # Errors
/// Those of [`prism`].
pub fn cylinder(radius: f64, height: f64, sides: usize, rounding: &Rounding) -> Result<Shape, ShapeError> {
    refuse_sides(sides)?;
    let (radius, height) = (positive(radius, "radius")?, positive(height, "height")?);
    let (r, k, _) = rounding.lengths(height.min(2.0 * radius))?;
    let inner = if k < 1.0 { side_height(sides, r / (1.0 - k).sqrt() / radius) * radius } else { radius };
    let sharp_volume = PI * radius * radius * height;
    Ok(Shape { sharp_volume, ..prism(sides, inner, height, rounding)? })
}

/// A cone along z from −height/2 to its tip at height/2, as a pyramid of as many sides whose base has the area π
/// radius². Where r is chosen, it is so small that base and height lose no more than 0.1 % of them.
///
/// # Errors
/// Those of [`prism`].
pub fn cone(radius: f64, height: f64, sides: usize, rounding: &Rounding) -> Result<Shape, ShapeError> {
    refuse_sides(sides)?;
    let (radius, height) = (positive(radius, "radius")?, positive(height, "height")?);
    let slant = radius.hypot(height);
    // The rim is an edge of the angle φ, from which a ball of radius r stays r (cot φ/2 − 1) away; at the tip that is
    // r (1/sin α − 1), α the half angle.
    let [of_rim, of_tip] = [(slant + radius) / height - 1.0, slant / radius - 1.0];
    let r = (LOST * radius / of_rim).min(LOST * height / of_tip);
    let size = 2.0 * radius * height / (radius + slant);
    let rounding = if rounding.is_chosen() { rounding.with_radius(r.min(Rounding::SHARE * size)) } else { *rounding };
    let sharp_volume = PI * radius * radius * height / 3.0;
    Ok(Shape { sharp_volume, ..frustum(sides, of_equal_area(sides) * radius, 0.0, height, &rounding)? })
}

fn refuse_sides(sides: usize) -> Result<(), ShapeError> {
    if (3..=MAX_PLANES - 2).contains(&sides) { Ok(()) } else { Err(ShapeError::Sides(sides)) }
}

/// The radius of the circle within a regular polygon of the area π.
fn of_equal_area(sides: usize) -> f64 {
    (PI / (sides as f64 * (PI / sides as f64).tan())).sqrt()
}

/// How far the sides of a regular polygon reach from its centre, rounded by r, so that its area is π.
fn side_height(sides: usize, r: f64) -> f64 {
    if sides > CIRCLE_SIDES {
        return 1.0;
    }
    let step = TAU / sides as f64;
    let normals: Vec<f64> = (0..sides).map(|i| i as f64 * step).collect();
    // Where a ray at an angle leaves Σ⟨ρ cos(θ − θ_i) − d⟩² = r²: Newton's method from outside.
    let reach = |angle: f64, d: f64| {
        let cosines: Vec<f64> = normals.iter().map(|normal| (angle - normal).cos()).filter(|c| *c > 0.0).collect();
        let mut reach = 4.0;
        for _ in 0..Limits::STEPS {
            let beyond = cosines.iter().map(|cosine| (cosine, (reach * cosine - d).max(0.0)));
            let (sum, slope) = beyond.fold((-r * r, 0.0), |(s, t), (c, e)| (s + e * e, t + 2.0 * c * e));
            let change = sum / slope;
            reach -= change;
            if change.abs() <= 1e-14 * reach {
                break;
            }
        }
        reach
    };
    let area = |d: f64| {
        let at = |i: usize| reach(0.5 * step * i as f64 / (Limits::SECTION_RAYS - 1) as f64, d).powi(2);
        // Simpson's rule.
        let weight = |i: usize| if i == 0 || i == Limits::SECTION_RAYS - 1 { 1.0 } else { [2.0, 4.0][i % 2] };
        (0..Limits::SECTION_RAYS).map(|i| weight(i) * at(i)).sum::<f64>() / (3 * (Limits::SECTION_RAYS - 1)) as f64
    };
    let (mut low, mut high) = (-1.0, 1.0);
    for _ in 0..Limits::STEPS {
        let middle = 0.5 * (low + high);
        if area(middle) < 1.0 { low = middle } else { high = middle }
    }
    reach(0.0, 0.5 * (low + high))
}
