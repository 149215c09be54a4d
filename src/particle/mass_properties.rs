//! Volume, centroid and inertia of a particle, by adaptive quadrature over rays.
//!
//! With ρ the distance from the origin to the surface, V = ∫ρ³/3 dω, ∫x dV = ∫ρ⁴/4 e dω, ∫x xᵀ dV = ∫ρ⁵/5 e eᵀ dω. A patch in a
//! plane at height h (`direction_mesh`) covers dω = h dA/|p|³, so that with τ = ρ/|p| they are integrals of h τ³/3,
//! h τ⁴/4 p and h τ⁵/5 p pᵀ over its area: polynomials on a flat face, where τ = 1.
//!
//! On a ray through p the surface is reached at τ ≤ 1, where Newton's method from τ = 1 does not overshoot, since S is convex. Planes that are
//! active at no corner of a patch are active nowhere on rays through it up to there, and are left out.
//!
//! On each cell the product of Kronrod's rule of 7 points with itself is compared with those in which one factor is Gauss' rule of
//! the 3 points among them, once in u and once in v. The cell with the largest difference is halved in that direction, until
//! the estimated errors of all cells add up to less than the tolerance. The error of the rule with 7 points, of degree 11, is
//! mostly far less than its difference from the other, of degree 5: what halving a cell changes shows how far. Where a second
//! derivative jumps within a cell it need not be less, and a direction in which a cell was never halved counts [`UNSEEN`] times.

use crate::particle::direction_mesh::{self, Patch};
use crate::particle::shape::Shape;
use nalgebra::{Matrix3, SVector, Vector3};
use std::collections::BinaryHeap;

/// Volume and moments of a particle of unit density, local frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassProperties {
    /// Volume, length³.
    pub volume: f64,
    /// Centroid, length.
    pub centroid: Vector3<f64>,
    /// ∫ (|x|² I − x xᵀ) dV about the local origin, length⁵.
    pub inertia: Matrix3<f64>,
    /// Estimated bound on the relative error: of the volume, of each moment of inertia about an axis through the origin, and of the
    /// centroid as a share of the radii of gyration across the axes' planes. It may exceed the tolerance where that cannot be reached.
    pub error: f64,
}

/// Default tolerance of volume, centroid and inertia, relative.
pub const MASS_TOLERANCE: f64 = 1e-6;

/// Least relative tolerance: where this is not enough, rounding leaves no more digits.
pub(crate) const LEAST_TOLERANCE: f64 = 1e-12;

/// Most cells: some seconds of work.
const MOST_CELLS: usize = 200_000;

/// Share of the tolerance that overlaps and gaps of the mesh may take.
const OF_MESH: f64 = 0.1;

/// Estimated error over difference of the rules: in a direction in which the cell was never halved, and the least elsewhere. Chosen: over
/// twice what closed forms ask for.
const UNSEEN: f64 = 8.0;
const LEAST_SHARE: f64 = 0.05;

/// Most Newton steps on a ray: far outside each halves the distance, and beside the surface each doubles the digits.
const MOST_STEPS: usize = 200;

/// Least step, relative.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Kronrod's rule of 7 points on [0, 1]: point, weight, and weight in Gauss' rule of 3 points.
pub(crate) const RULE: [(f64, f64, f64); 7] = [
    (0.019_754_365_645_989_858, 0.052_328_113_013_233_63, 0.0),
    (0.112_701_665_379_258_31, 0.134_244_044_934_166_72, 5.0 / 18.0),
    (0.282_878_125_326_598_72, 0.200_698_707_387_981_11, 0.0),
    (0.5, 0.225_458_269_329_237_07, 4.0 / 9.0),
    (0.717_121_874_673_401_3, 0.200_698_707_387_981_11, 0.0),
    (0.887_298_334_620_741_7, 0.134_244_044_934_166_72, 5.0 / 18.0),
    (0.980_245_634_354_010_1, 0.052_328_113_013_233_63, 0.0),
];

/// V, ∫x dV (3), and xx, yy, zz, xy, yz, zx of ∫x xᵀ dV.
type Moments = SVector<f64, 10>;

/// A patch with what S is on rays through it: the weights, and the planes that may be active.
struct Sector {
    patch: Patch,
    plane_weight: f64,
    sphere_weight: f64,
    planes: Vec<(Vector3<f64>, f64)>,
}

/// The moments of one cell, a rectangle of u and v on the patch of a sector.
struct Cell {
    sector: usize,
    u: (f64, f64),
    v: (f64, f64),
    moments: Moments,
    /// Differences of the two rules in u, and in v.
    differences: [Moments; 2],
    /// Estimated error over difference, in u and in v.
    shares: [f64; 2],
    /// Sum of both estimates, and which is larger.
    error: f64,
    largest: usize,
}

/// The length scales in which errors are measured: the radii of gyration about the origin.
struct Norm {
    volume: f64,
    /// L⁻¹, for ∫x xᵀ dV = V·L·Lᵀ.
    unscaled: Matrix3<f64>,
}

/// Volume, centroid and inertia to a relative tolerance of at least [`LEAST_TOLERANCE`].
pub(crate) fn of(shape: &Shape, tolerance: f64) -> MassProperties {
    let tolerance = tolerance.max(LEAST_TOLERANCE);
    let mut patches = direction_mesh::along_faces(shape);
    let (mut sectors, mut cells, mut norm) = first_pass(shape, &patches);
    if !(norm.of_mesh(&patches) <= OF_MESH * tolerance) {
        patches = direction_mesh::plain(shape);
        (sectors, cells, norm) = first_pass(shape, &patches);
    }
    let of_mesh = norm.of_mesh(&patches);
    cells.iter_mut().for_each(|cell| cell.judge(&norm));
    let mut heap = BinaryHeap::from(cells);
    let mut error = heap.iter().map(|cell| cell.error).sum::<f64>() + of_mesh;
    while error > tolerance && heap.len() < MOST_CELLS {
        let Some(worst) = heap.pop() else { break };
        error -= worst.error;
        for half in worst.halves(&sectors, &norm) {
            error += half.error;
            heap.push(half);
        }
    }
    let cells = heap.into_vec();
    let error = cells.iter().map(|cell| cell.error).sum::<f64>() + of_mesh;
    properties(&sum(&cells), error)
}

/// One cell on each part of each patch, and the norm that their moments give.
fn first_pass(shape: &Shape, patches: &[Patch]) -> (Vec<Sector>, Vec<Cell>, Norm) {
    // Behind these the origin lies: they may be active anywhere.
    let behind: Vec<usize> = (0..shape.len()).filter(|&i| shape.offset(i) < 0.0).collect();
    let sectors: Vec<Sector> = patches.iter().map(|patch| Sector::of(shape, *patch, &behind)).collect();
    let parts = (0..sectors.len()).flat_map(|i| sectors[i].patch.intervals().map(move |v| (i, v)));
    let cells: Vec<Cell> = parts.map(|(i, v)| Cell::of(&sectors, i, (0.0, 1.0), v)).collect();
    let norm = Norm::of(&sum(&cells));
    (sectors, cells, norm)
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
        error,
    }
}

fn first(moments: &Moments) -> Vector3<f64> {
    moments.fixed_rows::<3>(1).into()
}

fn second(m: &Moments) -> Matrix3<f64> {
    Matrix3::new(m[4], m[7], m[9], m[7], m[5], m[8], m[9], m[8], m[6])
}

impl Norm {
    fn of(moments: &Moments) -> Self {
        let scaled = (second(moments) / moments[0]).cholesky().map(|factor| factor.l());
        let unscaled = scaled.and_then(|l| l.try_inverse()).unwrap_or_else(|| {
            let length = second(moments).trace() / moments[0];
            Matrix3::from_diagonal_element(1.0 / length.sqrt())
        });
        Self { volume: moments[0], unscaled }
    }

    /// Share of the volume by which overlaps and gaps of the mesh may be wrong.
    fn of_mesh(&self, patches: &[Patch]) -> f64 {
        direction_mesh::missing_volume(patches, &self.unscaled) / (self.volume * self.unscaled.determinant())
    }

    /// A bound on the relative error of volume, centroid and every moment of inertia that this change of the moments makes.
    fn of_change(&self, change: &Moments) -> f64 {
        let first = self.unscaled * first(change);
        let second = self.unscaled * second(change) * self.unscaled.transpose();
        (change[0] * change[0] + first.norm_squared() + second.norm_squared()).sqrt() / self.volume
    }
}

impl Sector {
    fn of(shape: &Shape, patch: Patch, behind: &[usize]) -> Self {
        let mut counted = behind.to_vec();
        for corner in patch.corners() {
            shape.visit_near(corner, 0.0, |i, _, excess| {
                if excess > 0.0 {
                    counted.push(i);
                }
            });
        }
        counted.sort_unstable();
        counted.dedup();
        let planes = counted.into_iter().map(|i| (shape.normal(i), shape.offset(i))).collect();
        Self { patch, plane_weight: shape.plane_weight, sphere_weight: shape.sphere_weight, planes }
    }

    /// τ ≤ 1 with S(τ p) = 1, for p on the patch, where S ≥ 1.
    fn exit(&self, p: &Vector3<f64>) -> f64 {
        let sphere = self.sphere_weight * p.norm_squared();
        let mut tau = 1.0;
        for _ in 0..MOST_STEPS {
            let (mut value, mut half_slope) = (sphere * tau * tau - 1.0, sphere * tau);
            for (n, d) in &self.planes {
                let rate = n.dot(p);
                let excess = (tau * rate - d).max(0.0);
                value += self.plane_weight * excess * excess;
                half_slope += self.plane_weight * excess * rate;
            }
            let step = 0.5 * value / half_slope;
            // Also where a step is not a number.
            if !(step > ROUNDING * tau) {
                break;
            }
            tau -= step;
        }
        tau
    }
}

impl Cell {
    fn of(sectors: &[Sector], sector: usize, u: (f64, f64), v: (f64, f64)) -> Self {
        let here = &sectors[sector];
        let (du, dv) = (u.1 - u.0, v.1 - v.0);
        let mut moments = Moments::zeros();
        let mut differences = [Moments::zeros(); 2];
        for (s, kronrod_u, gauss_u) in RULE {
            for (t, kronrod_v, gauss_v) in RULE {
                let (p, area) = here.patch.at(u.0 + s * du, v.0 + t * dv);
                let at = moments_of_ray(&p, here.exit(&p), here.patch.height * area * du * dv);
                moments += kronrod_u * kronrod_v * at;
                differences[0] += (kronrod_u - gauss_u) * kronrod_v * at;
                differences[1] += kronrod_u * (kronrod_v - gauss_v) * at;
            }
        }
        Self { sector, u, v, moments, differences, shares: [UNSEEN; 2], error: 0.0, largest: 0 }
    }

    fn judge(&mut self, norm: &Norm) {
        let [in_u, in_v] = [0, 1].map(|i| self.shares[i] * norm.of_change(&self.differences[i]));
        self.error = in_u + in_v;
        self.largest = usize::from(in_v > in_u);
    }

    /// Two halves. By what they change of the whole, the error of the whole, they are judged: their own is less.
    fn halves(&self, sectors: &[Sector], norm: &Norm) -> [Self; 2] {
        let halved = |(from, to): (f64, f64)| [(from, 0.5 * (from + to)), (0.5 * (from + to), to)];
        let mut halves = match self.largest {
            0 => halved(self.u).map(|u| Self::of(sectors, self.sector, u, self.v)),
            _ => halved(self.v).map(|v| Self::of(sectors, self.sector, self.u, v)),
        };
        let change = norm.of_change(&(halves[0].moments + halves[1].moments - self.moments));
        let differences: f64 = halves.iter().map(|half| norm.of_change(&half.differences[self.largest])).sum();
        for half in &mut halves {
            half.shares = self.shares;
            // Also for 0/0.
            half.shares[self.largest] = (change / differences).clamp(LEAST_SHARE, 1.0).max(LEAST_SHARE);
            half.judge(norm);
        }
        halves
    }
}

/// The integrands where the ray through p leaves the particle, at τ p, times `area`.
fn moments_of_ray(p: &Vector3<f64>, tau: f64, area: f64) -> Moments {
    let cube = area * tau * tau * tau;
    let (f, s) = (cube * tau / 4.0 * p, cube * tau * tau / 5.0 * p);
    let moments = [cube / 3.0, f.x, f.y, f.z, s.x * p.x, s.y * p.y, s.z * p.z, s.x * p.y, s.y * p.z, s.z * p.x];
    moments.into()
}

/// Cells are ordered by their error.
impl Ord for Cell {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.error.total_cmp(&other.error)
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
