//! Volume, centroid and inertia of a particle, by adaptive quadrature over rays.
//!
//! With ρ the distance from the origin to the surface, V = ∫ρ³/3 dω, ∫x dV = ∫ρ⁴/4 e dω, ∫x xᵀ dV = ∫ρ⁵/5 e eᵀ dω. A
//! patch p(u, v) of `direction_mesh` covers dω = w du dv/|p|³ with w = p·(∂p/∂u × ∂p/∂v), so that with τ = ρ/|p| they
//! are integrals of w τ³/3, w τ⁴/4 p and w τ⁵/5 p pᵀ over u and v: polynomials on a flat face, where τ = 1.
//!
//! Each cell is integrated by the product of the Lobatto and Kronrod rule of 7 points with itself (`quadrature`). Its
//! error is bounded by two parts, each of which is found for both directions of the cell:
//!
//! - As far as g = 1/τ is analytic over the cell, the error is a share of the difference from the rule of 4 points, by
//!   how far from the cell g may be singular.
//! - A plane that is active in a part of the cell only lets ∇²g jump, by what `gauge` says. Whatever the place of that
//!   jump, the error is at most `quadrature::OF_JUMP` times it. Where the jump is sharper than the cell is wide,
//!   convexity says more: g lies below its bilinear interpolant between neighbouring points, and above its tangents
//!   there.
//!
//! The second part does not depend on what the points sample, so that no feature between them is missed. The cell with
//! the largest bound is halved in the direction that has the larger part of it, until the bounds of all cells add up to
//! less than the tolerance.

use super::numbers::{ALIKE, LEAST_PART, LEAST_TOLERANCE, Limits, OF_SUMS, SAME_UNITS};
use crate::particle::direction_mesh::{self, Patch};
use crate::particle::minkowski_gauge::{Activity, Gauge, OnRay, Piece, Undecided};
use crate::particle::quadrature::{self, POINTS, RULE};
use crate::particle::solid::Solid;
use nalgebra::{Matrix3, SVector, Vector3};
use std::collections::BinaryHeap;

/// Volume and moments of a particle of unit density, local frame.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MassProperties {
    /// Volume, length³.
    pub volume: f64,
    /// Centroid, length.
    pub centroid: Vector3<f64>,
    /// ∫ (|x|² I − x xᵀ) dV about the local origin, length⁵.
    pub inertia: Matrix3<f64>,
    /// Estimated bound on the relative error: of the volume, of each moment of inertia about an axis through the
    /// origin, and of the centroid as a share of the radii of gyration across the axes' planes. It exceeds the
    /// tolerance where that cannot be reached, and is infinite where lengths are so different that nothing is known.
    pub error: f64,
}

/// Default tolerance of volume, centroid and inertia, relative.
pub const MASS_TOLERANCE: f64 = 1e-6;

/// V, ∫x dV (3), and xx, yy, zz, xy, yz, zx of ∫x xᵀ dV.
type Moments = SVector<f64, 10>;

/// The moments of one cell, a rectangle of u and v on a patch.
struct Cell {
    patch: usize,
    u: (f64, f64),
    v: (f64, f64),
    moments: Moments,
    /// Bounds on the error of the rule in u and in v, and the rounding of the rays.
    errors: [f64; 2],
    rounding: f64,
    /// Number of planes evaluated on all of its rays.
    work: usize,
}

/// The units in which errors are measured: the volume and the radii of gyration about the origin.
struct Norm {
    volume: f64,
    /// ∫x xᵀ dV/V = L·Lᵀ.
    square: Matrix3<f64>,
    /// L⁻¹.
    unscaled: Matrix3<f64>,
}

/// A point of the rule on a cell.
struct Node {
    p: Vector3<f64>,
    /// ∂p/∂u and ∂p/∂v, for u and v from 0 to 1 over the cell.
    along: [Vector3<f64>; 2],
    on_ray: OnRay,
    /// w du dv.
    volume: f64,
}

/// Volume, centroid and inertia to a relative tolerance of at least [`LEAST_TOLERANCE`].
pub(crate) fn of(shape: &Solid, tolerance: f64) -> MassProperties {
    let tolerance = tolerance.max(LEAST_TOLERANCE);
    let gauge = Gauge::of(shape);
    let patches = direction_mesh::of(shape);
    let (mut cells, mut norm) = first_pass(&gauge, &patches);
    for _ in 0..Limits::UNITS {
        let left = tolerance / SAME_UNITS - norm.of_sums();
        let (refined, error) = refined(cells, &gauge, &patches, &norm, left.max(LEAST_PART * tolerance));
        let found = Norm::of(&sum(&refined));
        let change = norm.change_to(&found);
        if change <= SAME_UNITS || refined.len() >= Limits::CELLS {
            return properties(&sum(&refined), change * error + found.of_sums());
        }
        // Cells so coarse that they missed most of the particle gave units of another one.
        norm = found;
        cells = refined
            .iter()
            .map(|cell| {
                Cell::of(|corners, height| gauge.on(corners, height), &patches, cell.patch, [cell.u, cell.v], &norm)
            })
            .collect();
    }
    properties(&sum(&cells), f64::INFINITY)
}

/// Halves cells until their errors add up to less than the tolerance; the cells and that sum.
fn refined(cells: Vec<Cell>, gauge: &Gauge, patches: &[Patch], norm: &Norm, tolerance: f64) -> (Vec<Cell>, f64) {
    let total = |cells: &[Cell]| cells.iter().map(|cell| cell.error() + cell.rounding).sum::<f64>();
    let mut error = total(&cells);
    let mut heap = BinaryHeap::from(cells);
    let mut work: usize = heap.iter().map(|cell| cell.work).sum();
    while error > tolerance && heap.len() < Limits::CELLS && work < Limits::WORK {
        let Some(worst) = heap.pop() else { break };
        // What is left is rounding.
        if worst.error() <= worst.rounding {
            heap.push(worst);
            break;
        }
        error -= worst.error() + worst.rounding;
        for part in worst.parts(gauge, patches, norm) {
            error += part.error() + part.rounding;
            work += part.work;
            heap.push(part);
        }
    }
    let cells = heap.into_vec();
    let error = total(&cells);
    (cells, error)
}

/// One cell on each part of each patch, and the norm that their moments give.
fn first_pass(gauge: &Gauge, patches: &[Patch]) -> (Vec<Cell>, Norm) {
    let all = |norm: &Norm| -> Vec<Cell> {
        let parts = (0..patches.len()).flat_map(|i| patches[i].intervals().map(move |v| (i, v)));
        parts
            .map(|(i, v)| Cell::of(|corners, height| gauge.on(corners, height), patches, i, [(0.0, 1.0), v], norm))
            .collect()
    };
    let norm = Norm::of(&sum(&all(&Norm::unit())));
    (all(&norm), norm)
}

fn sum(cells: &[Cell]) -> Moments {
    cells.iter().map(|cell| cell.moments).sum()
}

fn properties(moments: &Moments, error: f64) -> MassProperties {
    let second = second(moments);
    MassProperties {
        volume: moments[0],
        centroid: first(moments) / moments[0],
        inertia: Matrix3::from_diagonal_element(second.trace()) - second,
        error: if error.is_nan() { f64::INFINITY } else { error },
    }
}

fn first(moments: &Moments) -> Vector3<f64> {
    moments.fixed_rows::<3>(1).into()
}

fn second(m: &Moments) -> Matrix3<f64> {
    Matrix3::new(m[4], m[7], m[9], m[7], m[5], m[8], m[9], m[8], m[6])
}

impl Norm {
    fn unit() -> Self {
        Self { volume: 1.0, square: Matrix3::identity(), unscaled: Matrix3::identity() }
    }

    fn of(moments: &Moments) -> Self {
        let square = second(moments) / moments[0];
        let unscaled = square.cholesky().and_then(|factor| factor.l().try_inverse());
        match unscaled {
            Some(unscaled) => Self { volume: moments[0], square, unscaled },
            None => {
                let radius = square.trace().sqrt();
                let square = Matrix3::from_diagonal_element(radius * radius);
                Self { volume: moments[0], square, unscaled: Matrix3::from_diagonal_element(1.0 / radius) }
            }
        }
    }

    /// A bound on the relative error of volume, centroid and every moment of inertia that this change of the moments
    /// makes.
    fn of_change(&self, change: &Moments) -> f64 {
        let first = self.unscaled * first(change);
        let second = self.unscaled * second(change) * self.unscaled.transpose();
        // The centroid has the error of ∫x and that of the volume.
        (change[0].abs() + first.norm()).max(second.norm()) / self.volume
    }

    /// The relative change of the moments that a change of g makes, where w du dv is `volume` and p, in these units,
    /// has that length.
    fn sensitivity(&self, volume: f64, length: f64, gauge: f64) -> f64 {
        let x = length / gauge;
        volume / gauge.powi(4) * (1.0 + x).max(x * x) / self.volume
    }

    /// The rounding of sums of moments: where a particle is thin, that of its length counts.
    fn of_sums(&self) -> f64 {
        OF_SUMS * self.square.trace() * self.unscaled.norm_squared()
    }

    /// By what factor an error in these units may be larger in those; infinite if theirs are far smaller.
    fn change_to(&self, other: &Self) -> f64 {
        let lengths = (other.unscaled * self.square * other.unscaled.transpose()).symmetric_eigenvalues().max();
        let change = self.volume / other.volume * lengths.max(1.0);
        let back = (self.unscaled * other.square * self.unscaled.transpose()).symmetric_eigenvalues().max();
        if change > 0.0 && self.volume / other.volume * back >= 1.0 / SAME_UNITS {
            change.max(1.0)
        } else {
            f64::INFINITY
        }
    }
}

impl Cell {
    /// `piece` gives the particle over its corners, in a plane at this distance.
    fn of(
        piece: impl FnOnce(&[Vector3<f64>], f64) -> Piece,
        patches: &[Patch],
        patch: usize,
        [u, v]: [(f64, f64); 2],
        norm: &Norm,
    ) -> Self {
        let here = &patches[patch];
        let (du, dv) = (u.1 - u.0, v.1 - v.0);
        let at = |s: f64, t: f64| here.at(u.0 + s * du, v.0 + t * dv);
        let corners = corners(here, u, v);
        let piece = piece(&corners, here.height);
        let mut moments = Moments::zeros();
        let mut differences = [Moments::zeros(); 2];
        let mut rounding = 0.0;
        let mut nodes = Vec::with_capacity(POINTS * POINTS);
        let mut near = [Vector3::zeros(); POINTS];
        for (s, kronrod_u, lobatto_u) in RULE {
            let row = RULE.map(|(t, ..)| at(s, t));
            let on_rays = piece.along_row(&row.map(|(p, _)| p), &near);
            near = on_rays.map(|on_ray| on_ray.tangent);
            for (((t, kronrod_v, lobatto_v), (p, volume)), on_ray) in RULE.into_iter().zip(row).zip(on_rays) {
                let tau = 1.0 / on_ray.gauge;
                let volume = volume * du * dv;
                let moment = moments_of_ray(&p, tau, volume);
                moments += kronrod_u * kronrod_v * moment;
                differences[0] += (kronrod_u - lobatto_u) * kronrod_v * moment;
                differences[1] += kronrod_u * (kronrod_v - lobatto_v) * moment;
                let sensitivity = norm.sensitivity(volume.abs(), (norm.unscaled * p).norm(), on_ray.gauge);
                rounding += kronrod_u * kronrod_v * sensitivity * on_ray.rounding;
                let along = here.along(u.0 + s * du, v.0 + t * dv);
                nodes.push(Node { p, along: [du * along[0], dv * along[1]], on_ray, volume });
            }
        }
        let shares = [0, 1].map(|direction| share(&nodes, direction));
        let mut errors = [0, 1].map(|i| shares[i] * norm.of_change(&differences[i]));
        let jumps = jumps(&piece, &corners, &nodes, norm);
        errors
            .iter_mut()
            .zip(jumps)
            .zip(shares)
            .for_each(|((error, jump), share)| *error += (1.0 + quadrature::DIFFERENCE_OF_JUMP * share) * jump);
        Self { patch, u, v, moments, errors, rounding, work: piece.len() * POINTS * POINTS }
    }

    fn error(&self) -> f64 {
        self.errors[0] + self.errors[1]
    }

    /// Two or four equal parts.
    fn parts(&self, gauge: &Gauge, patches: &[Patch], norm: &Norm) -> Vec<Self> {
        let divided = |(from, to): (f64, f64), own: f64, other: f64| {
            let middle = 0.5 * (from + to);
            if ALIKE * own >= other { vec![(from, middle), (middle, to)] } else { vec![(from, to)] }
        };
        let of_u = divided(self.u, self.errors[0], self.errors[1]);
        let of_v = divided(self.v, self.errors[1], self.errors[0]);
        let parts = of_u.iter().flat_map(|&u| of_v.iter().map(move |&v| (u, v)));
        let whole = gauge.on(&corners(&patches[self.patch], self.u, self.v), patches[self.patch].height);
        let within = |corners: &[Vector3<f64>], height: f64| whole.within(corners, height);
        parts.map(|(u, v)| Self::of(within, patches, self.patch, [u, v], norm)).collect()
    }
}

/// The corners of a cell.
fn corners(patch: &Patch, u: (f64, f64), v: (f64, f64)) -> [Vector3<f64>; 4] {
    [(u.0, v.0), (u.0, v.1), (u.1, v.0), (u.1, v.1)].map(|(u, v)| patch.at(u, v).0)
}

/// Error over difference of the rules for the analytic part of g, the largest of all rows in a direction.
fn share(nodes: &[Node], direction: usize) -> f64 {
    let root = |node: &Node| node.on_ray.slope * node.on_ray.gauge;
    let (row, step) = if direction == 0 { (1, POINTS) } else { (POINTS, 1) };
    let of_row = |start: usize| {
        let [first, middle, last] = [0, POINTS / 2, POINTS - 1].map(|i| root(&nodes[start + i * step]).powi(2));
        quadrature::share(first, middle, last)
    };
    (0..POINTS).map(|i| of_row(i * row)).fold(0.0, f64::max)
}

/// Bounds on the errors in u and in v that planes make which are active in a part of the cell only.
fn jumps(piece: &Piece, corners: &[Vector3<f64>; 4], nodes: &[Node], norm: &Norm) -> [f64; 2] {
    let last = POINTS - 1;
    let at_corners = [0, last, last * POINTS, POINTS * POINTS - 1].map(|i| nodes[i].on_ray.gauge);
    let Activity { undecided, least_slope } = piece.activity(corners, &at_corners);
    let mut sum = [0.0; 2];
    if undecided.is_empty() {
        return sum;
    }
    let Extremes { gauge, sensitivity } = Extremes::of(piece, nodes, norm);
    let scale = 2.0 * piece.plane_weight() * sensitivity / least_slope;
    let highest = at_corners.into_iter().fold(0.0, f64::max);
    for plane in &undecided {
        let rates = [0, 1].map(|direction| rate(plane, nodes, direction));
        let bounds = rates.map(|rate| quadrature::OF_JUMP * scale / gauge * rate * rate);
        let both = bounds[0] + bounds[1];
        // Of the integral and of the rule.
        let most = scale * highest * plane.excess * plane.excess;
        let part = if both > most { most / both } else { 1.0 };
        sum = [sum[0] + part * bounds[0], sum[1] + part * bounds[1]];
    }
    let both = sum[0] + sum[1];
    if both > 0.0 {
        let gap = sensitivity * gap(nodes);
        if gap < both {
            return sum.map(|bound| gap / both * bound);
        }
    }
    sum
}

/// The largest rate at which the excess of a plane changes on the surface, in a direction, where the plane is active:
/// n·x there lies between d and d + `excess`, and ∇g along a row of points, since g is convex, between its values at
/// the ends.
fn rate(plane: &Undecided, nodes: &[Node], direction: usize) -> f64 {
    let (row, step) = if direction == 0 { (1, POINTS) } else { (POINTS, 1) };
    let ends = (0..POINTS).flat_map(|i| [i * row, i * row + (POINTS - 1) * step]);
    let of_end = |node: &Node| {
        let along = &node.along[direction];
        let (own, of_gauge) = (plane.n.dot(along), node.on_ray.tangent.dot(along));
        [0.0, plane.excess].map(|excess| (own - (plane.d + excess) * of_gauge).abs())
    };
    ends.flat_map(|i| of_end(&nodes[i])).fold(0.0, f64::max)
}

/// Bounds of what changes over a cell, also between the nodes: in each rectangle of four of them the tangents there
/// give a lower bound of g, and w and the length of p are largest at its corners.
struct Extremes {
    /// A lower bound of g.
    gauge: f64,
    /// An upper bound of the sensitivity. A node that is a corner without area says nothing of what lies beside it.
    sensitivity: f64,
}

impl Extremes {
    fn of(piece: &Piece, nodes: &[Node], norm: &Norm) -> Self {
        let mut extremes = Self { gauge: f64::INFINITY, sensitivity: 0.0 };
        for (_, around) in rectangles(nodes) {
            let least = |of: &dyn Fn(&Node) -> f64| around.iter().map(|node| of(node)).fold(f64::INFINITY, f64::min);
            let most = |of: &dyn Fn(&Node) -> f64| around.iter().map(|node| of(node)).fold(0.0, f64::max);
            let below = around.iter().map(|node| least(&|other| node.on_ray.tangent.dot(&other.p)));
            let gauge = below.fold(least(&|node| piece.least(&node.p)), f64::max);
            let (volume, length) = (most(&|node| node.volume.abs()), most(&|node| (norm.unscaled * node.p).norm()));
            extremes.gauge = extremes.gauge.min(gauge);
            extremes.sensitivity = extremes.sensitivity.max(norm.sensitivity(volume, length, gauge));
        }
        extremes
    }
}

/// The rectangles between the nodes, with the index of their first one.
fn rectangles(nodes: &[Node]) -> impl Iterator<Item = (usize, [&Node; 4])> {
    let first = (0..POINTS - 1).flat_map(|i| (0..POINTS - 1).map(move |j| i * POINTS + j));
    first.map(|i| (i, [i, i + 1, i + POINTS, i + POINTS + 1].map(|i| &nodes[i])))
}

/// A bound on the error of the integral of g that follows from convexity.
fn gap(nodes: &[Node]) -> f64 {
    let (mut low, mut high, mut rule) = (0.0, 0.0, 0.0);
    for (i, node) in nodes.iter().enumerate() {
        rule += RULE[i / POINTS].1 * RULE[i % POINTS].1 * node.on_ray.gauge;
    }
    for (i, around) in rectangles(nodes) {
        let area = (RULE[i / POINTS + 1].0 - RULE[i / POINTS].0) * (RULE[i % POINTS + 1].0 - RULE[i % POINTS].0);
        let middle = 0.25 * around.iter().map(|node| node.p).sum::<Vector3<f64>>();
        low += area * around.iter().map(|node| node.on_ray.tangent.dot(&middle)).fold(0.0, f64::max);
        high += area * 0.25 * around.iter().map(|node| node.on_ray.gauge).sum::<f64>();
    }
    f64::max(high - rule, rule - low)
}

/// The integrands where the ray through p leaves the particle, at τ p, with w du dv.
fn moments_of_ray(p: &Vector3<f64>, tau: f64, volume: f64) -> Moments {
    let cube = volume * tau * tau * tau;
    let (f, s) = (cube * tau / 4.0 * p, cube * tau * tau / 5.0 * p);
    let moments = [cube / 3.0, f.x, f.y, f.z, s.x * p.x, s.y * p.y, s.z * p.z, s.x * p.y, s.y * p.z, s.z * p.x];
    moments.into()
}

/// Cells are ordered by their error.
impl Ord for Cell {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.error().total_cmp(&other.error())
    }
}

impl PartialOrd for Cell {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Cell {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Cell {}
