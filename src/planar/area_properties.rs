//! Area, centroid and second moments of a particle of the plane, and points of its boundary.

use crate::linalg::number::larger;
use crate::particle::mass_properties::OF_SUMS;
use crate::particle::ray_cast;
use crate::particle::shape::Shape;
use crate::section::moments::{Moments, Sector, sectors};
use nalgebra::{Matrix2, Vector2, Vector3};
use std::f64::consts::TAU;

/// Area and moments of a particle of unit density (mass per area), local frame.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct AreaProperties {
    /// Area, length².
    pub area: f64,
    /// Centroid, length.
    pub centroid: Vector2<f64>,
    /// ∫ x xᵀ dA about the local origin, length⁴; its trace is the moment of inertia of a body that turns in the plane.
    pub second_moment: Matrix2<f64>,
    /// Estimated bound on the relative error, as in [`MassProperties`](crate::MassProperties).
    pub error: f64,
}

/// Equal parts of the circle that an outline begins with.
const PARTS: usize = 8;

/// Most points of an outline.
const MOST_POINTS: usize = 1_000_000;

/// In closed form, from the arcs of the boundary; where rounding leaves more than the tolerance of that, by polygons of
/// points on rays.
pub(super) fn of(shape: &Shape, tolerance: f64) -> AreaProperties {
    let mut arcs = Vec::new();
    let traced = sectors(shape, |sector| arcs.push(sector)).map(|()| properties(&arcs)).ok();
    if let Some(found) = traced.filter(|found| found.error <= tolerance) {
        return found;
    }
    // What the error of a polygon is over the distance of its sides from the boundary, the one before says.
    let mut off = tolerance * shape.bounds.radius;
    let mut best = polygon(shape, off);
    while best.error > tolerance {
        off *= 0.5 * tolerance / best.error;
        let finer = polygon(shape, off);
        if !(finer.error < 0.5 * best.error) {
            break;
        }
        best = finer;
    }
    traced.filter(|traced| !(best.error < traced.error)).unwrap_or(best)
}

/// Of the polygon of an outline.
fn polygon(shape: &Shape, tolerance: f64) -> AreaProperties {
    let (points, off) = outline(shape, tolerance);
    let chord = |(from, to): (&Vector2<f64>, &Vector2<f64>)| Sector {
        moments: Moments::triangle(from, to),
        corners: [*from, 0.5 * (from + to), *to],
        off,
    };
    properties(&points.iter().zip(points.iter().cycle().skip(1)).map(chord).collect::<Vec<_>>())
}

fn properties(parts: &[Sector]) -> AreaProperties {
    let Moments { area, first, second } =
        parts.iter().fold(Moments::default(), |sum, sector| sum.plus(&sector.moments));
    // Lengths are measured in the radii of gyration.
    let root = (second / area).cholesky().and_then(|factor| factor.l().try_inverse());
    let error = root.map_or(f64::INFINITY, |unscaled| {
        let of_part = |Sector { corners, off, .. }: &Sector| {
            let length = (corners[1] - corners[0]).norm() + (corners[2] - corners[1]).norm();
            let farthest = corners.iter().map(|corner| (unscaled * corner).norm()).fold(0.0, f64::max);
            off * length * (1.0 + farthest).max(farthest * farthest)
        };
        let of_sums = OF_SUMS * second.trace() / area * unscaled.norm_squared();
        parts.iter().map(of_part).sum::<f64>() / area + of_sums
    });
    let error = if error.is_nan() { f64::INFINITY } else { error };
    AreaProperties { area, centroid: first / area, second_moment: second, error }
}

/// Points of the boundary in order, so that no chord between two of them is further than `tolerance` (length) from the
/// boundary, or as many as there may be; and how far the farthest chord is.
pub(super) fn outline(shape: &Shape, tolerance: f64) -> (Vec<Vector2<f64>>, f64) {
    let on_ray = |angle: f64| {
        let direction = Vector3::new(angle.cos(), angle.sin(), 0.0);
        // The origin is inside, so that every ray leaves the particle.
        (angle, ray_cast::distance(shape, &Vector3::zeros(), &direction).unwrap_or(0.0) * direction.xy())
    };
    let ends: Vec<_> = (0..=PARTS).map(|i| on_ray(TAU * i as f64 / PARTS as f64)).collect();
    let (mut points, mut off) = (Vec::new(), 0.0_f64);
    let mut left: Vec<_> = ends.windows(2).rev().map(|ends| [ends[0], ends[1]]).collect();
    while let Some([start, end]) = left.pop() {
        let middle = on_ray(0.5 * (start.0 + end.0));
        let (chord, beyond) = (end.1 - start.1, middle.1 - start.1);
        let share = chord.dot(&beyond) / chord.norm_squared();
        // The boundary is convex: where it is δ from the chord at a share m, it is nowhere further than δ/min(m, 1−m).
        let farthest = chord.perp(&beyond).abs() / (chord.norm() * larger(share.min(1.0 - share), 0.0));
        let is_between = start.0 < middle.0 && middle.0 < end.0;
        if farthest > tolerance && is_between && points.len() + left.len() < MOST_POINTS {
            left.extend([[middle, end], [start, middle]]);
        } else {
            points.push(start.1);
            // Rays that cannot be told apart have no point between them that is further than both.
            off = off.max(if is_between { farthest } else { (end.0 - start.0) * shape.bounds.radius });
        }
    }
    (points, off)
}
