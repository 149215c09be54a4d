//! Area, centroid and second moments of a particle of the plane, and points of its boundary, by adaptive quadrature
//! over rays.
//!
//! All angles are divided to begin with where a side of the polygon {n_i·x ≤ d_i + r/√(1−k)} ends, and where beside its
//! end the next line becomes active. Over the chord between two such points, at height h, and with the boundary at τ p
//! on the ray through its point p, A = ∫h τ²/2 ds, ∫x dA = ∫h τ³/3 p ds, ∫x xᵀ dA = ∫h τ⁴/4 p pᵀ ds. Then the part of a
//! chord with the largest bound on its error is halved, as in space (`particle::mass_properties`).

use super::raised;
use crate::particle::gauge::{Gauge, OnRay, Piece, Undecided};
use crate::particle::mass_properties::{LEAST_PART, LEAST_TOLERANCE, MOST_UNITS, MOST_WORK, OF_SUMS, SAME_UNITS};
use crate::particle::quadrature::{self, POINTS, RULE};
use crate::particle::ray_cast;
use crate::particle::shape::Shape;
use nalgebra::{Matrix2, SVector, Vector2, Vector3};
use std::collections::BinaryHeap;
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

/// Most intervals.
const MOST_INTERVALS: usize = 100_000;

/// Equal parts of the circle to begin with, so that no feature of a circle is as wide as one.
const PARTS: usize = 8;

/// Most points of an outline.
const MOST_POINTS: usize = 1_000_000;

/// A, ∫x dA (2), and xx, yy, xy of ∫x xᵀ dA.
type Moments = SVector<f64, 6>;

/// A part of a chord between two points of the boundary: p(u) = start + u (end − start).
struct Interval {
    start: Vector2<f64>,
    end: Vector2<f64>,
    u: (f64, f64),
    moments: Moments,
    /// Bound on the error of the rule, and the rounding of the rays.
    error: f64,
    rounding: f64,
    /// Number of lines evaluated on all of its rays.
    work: usize,
}

/// The units in which errors are measured, as of [`mass_properties`](crate::particle::mass_properties).
struct Norm {
    area: f64,
    square: Matrix2<f64>,
    unscaled: Matrix2<f64>,
}

/// To a relative tolerance of at least [`LEAST_TOLERANCE`].
pub(super) fn of(shape: &Shape, tolerance: f64) -> AreaProperties {
    let tolerance = tolerance.max(LEAST_TOLERANCE);
    let gauge = Gauge::of(shape);
    let point = |angle: &f64| radius(shape, *angle) * Vector2::new(angle.cos(), angle.sin());
    let points: Vec<Vector2<f64>> = angles(shape).iter().map(point).collect();
    let all = |norm: &Norm| -> Vec<Interval> {
        let chords = points.windows(2).filter(|ends| ends[0] != ends[1]);
        chords.map(|ends| Interval::of(&gauge, (ends[0], ends[1]), (0.0, 1.0), norm)).collect()
    };
    let unit = Norm { area: 1.0, square: Matrix2::identity(), unscaled: Matrix2::identity() };
    let mut norm = Norm::of(&all(&unit).iter().map(|interval| interval.moments).sum());
    let mut intervals = all(&norm);
    for _ in 0..MOST_UNITS {
        let left = tolerance / SAME_UNITS - norm.of_sums();
        intervals = refined(intervals, &gauge, &norm, left.max(LEAST_PART * tolerance));
        let total = sum(&intervals);
        let found = Norm::of(&total);
        let change = norm.change_to(&found);
        if change <= SAME_UNITS || intervals.len() >= MOST_INTERVALS {
            let error: f64 = intervals.iter().map(|interval| interval.error + interval.rounding).sum();
            return properties(&total, change * error + found.of_sums());
        }
        let again = |old: &Interval| Interval::of(&gauge, (old.start, old.end), old.u, &found);
        intervals = intervals.iter().map(again).collect();
        norm = found;
    }
    properties(&sum(&intervals), f64::INFINITY)
}

fn sum(intervals: &[Interval]) -> Moments {
    intervals.iter().map(|interval| interval.moments).sum()
}

fn properties(total: &Moments, error: f64) -> AreaProperties {
    AreaProperties {
        area: total[0],
        centroid: Vector2::new(total[1], total[2]) / total[0],
        second_moment: second(total),
        error: if error.is_nan() { f64::INFINITY } else { error },
    }
}

/// Halves intervals until their errors add up to less than the tolerance.
fn refined(intervals: Vec<Interval>, gauge: &Gauge, norm: &Norm, tolerance: f64) -> Vec<Interval> {
    let mut error: f64 = intervals.iter().map(|interval| interval.error + interval.rounding).sum();
    let mut heap = BinaryHeap::from(intervals);
    let mut work: usize = heap.iter().map(|interval| interval.work).sum();
    while error > tolerance && heap.len() < MOST_INTERVALS && work < MOST_WORK {
        let Some(worst) = heap.pop() else { break };
        // What is left is rounding.
        if worst.error <= worst.rounding {
            heap.push(worst);
            break;
        }
        error -= worst.error + worst.rounding;
        let middle = 0.5 * (worst.u.0 + worst.u.1);
        for u in [(worst.u.0, middle), (middle, worst.u.1)] {
            let half = Interval::of(gauge, (worst.start, worst.end), u, norm);
            error += half.error + half.rounding;
            work += half.work;
            heap.push(half);
        }
    }
    heap.into_vec()
}

/// Points of the boundary in order, so that no chord between two of them is further than `tolerance` (length) from the
/// boundary.
pub(super) fn outline(shape: &Shape, tolerance: f64) -> Vec<Vector2<f64>> {
    let point = |angle: f64| radius(shape, angle) * Vector2::new(angle.cos(), angle.sin());
    let angles = angles(shape);
    let mut points = Vec::new();
    // The boundary is convex, so that it is farthest from a chord near the middle of its angles; a half of the
    // tolerance covers what it is farther elsewhere.
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

impl Norm {
    fn of(moments: &Moments) -> Self {
        let square = second(moments) / moments[0];
        match square.cholesky().and_then(|factor| factor.l().try_inverse()) {
            Some(unscaled) => Self { area: moments[0], square, unscaled },
            None => {
                let radius = square.trace().sqrt();
                let square = Matrix2::from_diagonal_element(radius * radius);
                Self { area: moments[0], square, unscaled: Matrix2::from_diagonal_element(1.0 / radius) }
            }
        }
    }

    fn of_change(&self, change: &Moments) -> f64 {
        let first = self.unscaled * Vector2::new(change[1], change[2]);
        let second = self.unscaled * second(change) * self.unscaled.transpose();
        (change[0].abs() + first.norm()).max(second.norm()) / self.area
    }

    fn of_sums(&self) -> f64 {
        OF_SUMS * self.square.trace() * self.unscaled.norm_squared()
    }

    fn change_to(&self, other: &Self) -> f64 {
        let ratio = |from: &Self, to: &Self| {
            (to.unscaled * from.square * to.unscaled.transpose()).symmetric_eigenvalues().max()
        };
        let areas = self.area / other.area;
        let is_near = areas * ratio(other, self) >= 1.0 / SAME_UNITS;
        if is_near { (areas * ratio(self, other).max(1.0)).max(1.0) } else { f64::INFINITY }
    }
}

impl Interval {
    fn of(gauge: &Gauge, (start, end): (Vector2<f64>, Vector2<f64>), u: (f64, f64), norm: &Norm) -> Self {
        let (chord, du) = (end - start, u.1 - u.0);
        let at = |s: f64| raised(&(start + (u.0 + s * du) * chord));
        // Twice the area of the triangle between the origin and the interval.
        let area = start.perp(&chord).abs() * du;
        let corners = [at(0.0), at(1.0)];
        let piece = gauge.on(&corners, start.perp(&chord).abs() / chord.norm());
        let along = du * raised(&chord);
        let (mut moments, mut difference, mut rounding) = (Moments::zeros(), Moments::zeros(), 0.0);
        let mut nodes = Vec::with_capacity(POINTS);
        let mut near = Vector3::zeros();
        for (s, kronrod, lobatto) in RULE {
            let p = at(s);
            let on_ray = piece.at(&p, &near);
            near = on_ray.tangent;
            let tau = 1.0 / on_ray.gauge;
            let square = area * tau * tau;
            let (f, g) = (square * tau / 3.0, square * tau * tau / 4.0);
            let moment = Moments::from([square / 2.0, f * p.x, f * p.y, g * p.x * p.x, g * p.y * p.y, g * p.x * p.y]);
            moments += kronrod * moment;
            difference += (kronrod - lobatto) * moment;
            let x = (norm.unscaled * (tau * p.xy())).norm();
            let sensitivity = square * tau * (1.0 + x).max(x * x) / norm.area;
            rounding += kronrod * sensitivity * on_ray.rounding;
            nodes.push((p, on_ray, sensitivity));
        }
        let [first, middle, last] = [0, POINTS / 2, POINTS - 1].map(|i| (nodes[i].1.slope * nodes[i].1.gauge).powi(2));
        let share = quadrature::share(first, middle, last);
        let jump = jump(&piece, &corners, &along, &nodes);
        let error = share * norm.of_change(&difference) + (1.0 + share * quadrature::DIFFERENCE_OF_JUMP) * jump;
        Self { start, end, u, moments, error, rounding, work: POINTS * piece.len() }
    }
}

/// A point of the rule, the surface on the ray through it, and the relative change of the moments that a change of g
/// makes.
type Node = (Vector3<f64>, OnRay, f64);

/// A bound on the error that lines make which are active in a part of the interval only.
fn jump(piece: &Piece, corners: &[Vector3<f64>; 2], along: &Vector3<f64>, nodes: &[Node]) -> f64 {
    let undecided = piece.activity(corners, &[nodes[0].1.gauge, nodes[POINTS - 1].1.gauge]).undecided;
    let of_line = |line: &Undecided| {
        let (mut jump, mut most) = (0.0_f64, 0.0_f64);
        for (p, on_ray, _) in nodes {
            let scale = 2.0 * piece.plane_weight() / on_ray.slope;
            let rate = line.n.dot(along) - line.n.dot(p) / on_ray.gauge * on_ray.tangent.dot(along);
            jump = jump.max(scale / on_ray.gauge * rate * rate);
            most = most.max(scale * on_ray.gauge * line.excess * line.excess);
        }
        most.min(quadrature::OF_JUMP * jump)
    };
    let sum = undecided.iter().map(of_line).sum::<f64>();
    if sum > 0.0 { sensitivity(piece, nodes) * sum.min(gap(nodes)) } else { sum }
}

/// The largest sensitivity, also between the nodes: it is at most of degree −5 in g, of which the tangents at the nodes
/// give a lower bound.
fn sensitivity(piece: &Piece, nodes: &[Node]) -> f64 {
    let of_part = |part: &[Node]| {
        let (before, after) = (&part[0], &part[1]);
        let of_tangent = |node: &Node| node.1.tangent.dot(&before.0).min(node.1.tangent.dot(&after.0));
        let below = of_tangent(before).max(of_tangent(after));
        before.1.gauge.min(after.1.gauge) / below.max(piece.least(&before.0).min(piece.least(&after.0)))
    };
    nodes.iter().map(|node| node.2).fold(0.0, f64::max) * nodes.windows(2).map(of_part).fold(1.0, f64::max).powi(5)
}

/// A bound on the error of the integral of g that follows from convexity.
fn gap(nodes: &[Node]) -> f64 {
    let (mut low, mut high) = (0.0, 0.0);
    for i in 1..POINTS {
        let (width, [before, after]) = (RULE[i].0 - RULE[i - 1].0, [&nodes[i - 1], &nodes[i]]);
        let middle = 0.5 * (before.0 + after.0);
        low += width * before.1.tangent.dot(&middle).max(after.1.tangent.dot(&middle));
        high += width * 0.5 * (before.1.gauge + after.1.gauge);
    }
    let rule: f64 = nodes.iter().zip(RULE).map(|((_, on_ray, _), (_, weight, _))| weight * on_ray.gauge).sum();
    f64::max(high - rule, rule - low)
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
