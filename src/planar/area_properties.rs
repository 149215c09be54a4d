//! Area, centroid and second moments of a particle of the plane, and points of its boundary, by adaptive quadrature over rays.
//!
//! With ρ the distance from the origin to the boundary, A = ∫ρ²/2 dφ, ∫x dA = ∫ρ³/3 e dφ, ∫x xᵀ dA = ∫ρ⁴/4 e eᵀ dφ. All angles are divided
//! to begin with where a side of the polygon {n_i·x ≤ d_i + r/√(1−k)} ends, and where beside its end the next line becomes active.
//! Then the interval whose two rules differ most is halved, as in space (`particle::mass_properties`).

use super::raised;
use crate::particle::mass_properties::{LEAST_TOLERANCE, RULE};
use crate::particle::ray_cast;
use crate::particle::shape::Shape;
use nalgebra::{Matrix2, SVector, Vector2, Vector3};
use std::collections::BinaryHeap;
use std::f64::consts::TAU;

/// Area and moments of a particle of unit density (mass per area), local frame.
#[derive(Clone, Copy, Debug, PartialEq)]
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

/// Most intervals.
const MOST_INTERVALS: usize = 100_000;

/// Equal parts of the circle to begin with, so that no feature of a circle is as wide as one.
const PARTS: usize = 8;

/// Most points of an outline.
const MOST_POINTS: usize = 1_000_000;

/// A, ∫x dA (2), and xx, yy, xy of ∫x xᵀ dA.
type Moments = SVector<f64, 6>;

struct Interval {
    from: f64,
    to: f64,
    moments: Moments,
    difference: Moments,
    error: f64,
}

/// To a relative tolerance of at least [`LEAST_TOLERANCE`].
pub(super) fn of(shape: &Shape, tolerance: f64) -> AreaProperties {
    let tolerance = tolerance.max(LEAST_TOLERANCE);
    let angles = angles(shape);
    let mut intervals: Vec<Interval> = angles.windows(2).map(|ends| Interval::of(shape, ends[0], ends[1])).collect();
    let total: Moments = intervals.iter().map(|interval| interval.moments).sum();
    let unscaled = second(&(total / total[0])).cholesky().and_then(|factor| factor.l().try_inverse());
    let unscaled =
        unscaled.unwrap_or_else(|| Matrix2::from_diagonal_element((total[0] / (total[3] + total[4])).sqrt()));
    let judge = |interval: &mut Interval| {
        let first = unscaled * Vector2::new(interval.difference[1], interval.difference[2]);
        let second = unscaled * second(&interval.difference) * unscaled.transpose();
        let square = interval.difference[0].powi(2) + first.norm_squared() + second.norm_squared();
        interval.error = square.sqrt() / total[0];
    };
    intervals.iter_mut().for_each(judge);
    let mut heap = BinaryHeap::from(intervals);
    let mut error: f64 = heap.iter().map(|interval| interval.error).sum();
    while error > tolerance && heap.len() < MOST_INTERVALS {
        let Some(Interval { from, to, error: worst, .. }) = heap.pop() else { break };
        error -= worst;
        let middle = 0.5 * (from + to);
        for (from, to) in [(from, middle), (middle, to)] {
            let mut half = Interval::of(shape, from, to);
            judge(&mut half);
            error += half.error;
            heap.push(half);
        }
    }
    let total: Moments = heap.iter().map(|interval| interval.moments).sum();
    AreaProperties {
        area: total[0],
        centroid: Vector2::new(total[1], total[2]) / total[0],
        second_moment: second(&total),
        error: heap.iter().map(|interval| interval.error).sum(),
    }
}

/// Points of the boundary in order, so that no chord between two of them is further than `tolerance` (length) from the boundary.
pub(super) fn outline(shape: &Shape, tolerance: f64) -> Vec<Vector2<f64>> {
    let point = |angle: f64| radius(shape, angle) * Vector2::new(angle.cos(), angle.sin());
    let angles = angles(shape);
    let mut points = Vec::new();
    // The boundary is convex, so that it is farthest from a chord near the middle of its angles; a half of the tolerance
    // covers what it is farther elsewhere.
    let mut left: Vec<[(f64, Vector2<f64>); 2]> =
        angles.windows(2).rev().map(|ends| [(ends[0], point(ends[0])), (ends[1], point(ends[1]))]).collect();
    while let Some([(from, start), (to, end)]) = left.pop() {
        let middle = 0.5 * (from + to);
        let between = point(middle);
        let chord = end - start;
        let sagitta = chord.perp(&(between - start)).abs() / chord.norm();
        if sagitta > 0.5 * tolerance && points.len() + left.len() < MOST_POINTS && from < middle && middle < to {
            left.push([(middle, between), (to, end)]);
            left.push([(from, start), (middle, between)]);
        } else {
            points.push(start);
        }
    }
    points
}

fn second(m: &Moments) -> Matrix2<f64> {
    Matrix2::new(m[3], m[5], m[5], m[4])
}

fn radius(shape: &Shape, angle: f64) -> f64 {
    let direction = Vector3::new(angle.cos(), angle.sin(), 0.0);
    // The origin is inside, so that every ray leaves the particle.
    ray_cast::distance(shape, &Vector3::zeros(), &direction).unwrap_or(0.0)
}

impl Interval {
    fn of(shape: &Shape, from: f64, to: f64) -> Self {
        let width = to - from;
        let (mut moments, mut difference) = (Moments::zeros(), Moments::zeros());
        for (t, kronrod, gauss) in RULE {
            let angle = from + t * width;
            let rho = radius(shape, angle);
            let (e, square) = (Vector2::new(angle.cos(), angle.sin()), width * rho * rho);
            let (f, s) = (square * rho / 3.0, square * rho * rho / 4.0);
            let at = Moments::from([square / 2.0, f * e.x, f * e.y, s * e.x * e.x, s * e.y * e.y, s * e.x * e.y]);
            moments += kronrod * at;
            difference += (kronrod - gauss) * at;
        }
        Self { from, to, moments, difference, error: 0.0 }
    }
}

/// Angles at which the circle is divided to begin with, rising, the last one turn after the first.
fn angles(shape: &Shape) -> Vec<f64> {
    let mut angles: Vec<f64> = (0..PARTS).map(|i| TAU * i as f64 / PARTS as f64).collect();
    if !shape.is_sphere() {
        for line in 0..shape.len() {
            breaks(shape, line, &mut angles);
        }
    }
    angles.sort_by(f64::total_cmp);
    angles.dedup();
    angles.push(angles[0] + TAU);
    angles
}

/// Adds the angles at which a side ends, and where beside its ends the next line becomes active.
fn breaks(shape: &Shape, line: usize, angles: &mut Vec<f64>) {
    let bounds = &shape.bounds;
    let n = shape.normal(line);
    let height = shape.offset(line) + bounds.face_reach;
    let foot = height / n.norm_squared() * n;
    let along = raised(&Vector2::new(-n.y, n.x)) / n.norm();
    let mut ends = [-2.0 * bounds.radius, 2.0 * bounds.radius];
    let mut used = Vec::new();
    // The line that cuts off most, again and again.
    loop {
        let (excess, worst) =
            ends.map(|t| shape.farthest_excess(&(foot + t * along))).into_iter().fold((0.0, line), larger);
        if excess <= bounds.face_reach * (1.0 + 1e-12) || used.contains(&worst) {
            break;
        }
        used.push(worst);
        let (m, d) = (shape.normal(worst), shape.offset(worst));
        let (start, rate) = (m.dot(&foot) - d, m.dot(&along));
        let side = usize::from(rate > 0.0);
        ends[side] = (bounds.face_reach - start) / rate;
        if !(ends[0] < ends[1]) {
            return;
        }
        for t in [ends[side], -start / rate] {
            let at = foot + t * along;
            if t.is_finite() {
                angles.push(at.y.atan2(at.x).rem_euclid(TAU));
            }
        }
    }
}

fn larger(a: (f64, usize), b: (f64, usize)) -> (f64, usize) {
    if b.0 > a.0 { b } else { a }
}

/// Intervals are ordered by their error.
impl Ord for Interval {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.error.total_cmp(&other.error)
    }
}

impl PartialOrd for Interval {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Interval {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Interval {}
