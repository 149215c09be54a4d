//! A patch with a smooth rim: rays at equal steps around an ellipse.
//!
//! Where a plane comes on, the pressure changes by the square of the distance beyond. The load of a ray is therefore
//! smooth enough in its direction for the sum over equal steps to converge with the fourth power of the step, and no
//! direction has to be found in which the sequence of cells changes.

use super::field::{Owner, dot};
use super::pieces::Estimate;
use super::ray::{Line, Node, Ray, SUMS, Walker};
use super::smoothness::norm;
use super::zones::BETWEEN;
use std::f64::consts::TAU;

/// Fewest rays whose sum is trusted, and most.
const FIRST: usize = 8;
const MOST: usize = 64;

/// Part of the tolerance that a rule on a ray may take.
const RADIAL: f64 = 0.2;

/// Part of the difference to half as many rays by which the sum is wrong at most, about: 1/15 if its order is four.
const OF_HALF: f64 = 1.0 / 4.0;

/// The same of the difference between half and a quarter as many.
const OF_QUARTER: f64 = 1.0 / 50.0;

/// Error of the sum over the area that the directions of the rim tell of between the rays: at a corner they meet
/// farther out than the curve that is drawn by them. And over that between half as many.
const OF_BETWEEN: f64 = 4.0;
const OF_LAST_BETWEEN: f64 = 0.4;

/// A ray of the sum.
#[derive(Clone, Copy, Default)]
struct Spoke {
    nodes: (u32, u32),
    /// Change of its direction with the angle on the ellipse.
    weight: f64,
}

/// The rays so far, and their sums.
struct Oval<'w, 'f, 'a, 's> {
    walker: &'w mut Walker<'f, 'a, 's>,
    centre: [f64; 3],
    /// Half axes of the ellipse.
    axes: [[f64; 2]; 2],
    spokes: [Spoke; MOST],
    count: usize,
    sums: [f64; SUMS],
    radial: f64,
    extent: f64,
    /// By parts of the way around.
    ends: [End; MOST],
}

/// Where a ray ends, at R times the radius of the ellipse.
#[derive(Clone, Copy, Default)]
struct End {
    /// 1/R², and its change with the angle on the ellipse: of a straight side, or of another ellipse, a wave of twice
    /// the angle.
    inverse: f64,
    change: f64,
}

/// Fills `points`; `None` where the sum has not converged.
///
/// `centre`: a point in the middle of the patch; `axis` and `lengths`: how long the patch is along an axis and across
/// it; `rough`: the load on four rays along those.
pub(super) fn oval(
    walker: &mut Walker,
    centre: [f64; 3],
    (axis, lengths): ([f64; 2], [f64; 2]),
    rough: f64,
    tolerance: f64,
    points: &mut Vec<Node>,
) -> Option<Estimate> {
    walker.nodes.clear();
    walker.budget = RADIAL * tolerance * 0.25 * rough;
    let axes = [axis.map(|c| 0.5 * c * lengths[0]), [-0.5 * axis[1] * lengths[1], 0.5 * axis[0] * lengths[1]]];
    let (spokes, sums) = ([Spoke::default(); MOST], [0.0; SUMS]);
    let mut oval =
        Oval { walker, centre, axes, spokes, count: 0, sums, radial: 0.0, extent: 0.0, ends: [End::default(); MOST] };
    (0..FIRST / 2).try_for_each(|step| oval.cast(step as f64 / (FIRST / 2) as f64))?;
    let (mut before, mut last, mut between_last) = (f64::INFINITY, oval.mean(), 0.0_f64);
    while oval.count < MOST {
        let half = oval.count;
        (0..half).try_for_each(|step| oval.cast((step as f64 + 0.5) / half as f64))?;
        let mean = oval.mean();
        let off: [f64; SUMS] = std::array::from_fn(|i| mean[i] - last[i]);
        let force = norm(&mean[..3]);
        let change = norm(&off[..3]).max(norm(&off[3..6]) / oval.extent);
        // A corner between two rays changes neither sum.
        let between = oval.between();
        let missed = (OF_BETWEEN * between).max(OF_LAST_BETWEEN * between_last) * force;
        let error =
            (OF_HALF * change).max(OF_QUARTER * before.min(force)).max(missed) + oval.radial / oval.count as f64;
        if oval.meets_edges() {
            return None;
        }
        if error <= tolerance * force {
            oval.give(points);
            let area = (OF_HALF * off[6].abs()).max(error / force * mean[6]);
            return Some(Estimate { force: TAU * error, area: TAU * area, rays: oval.count });
        }
        // The most rays would hardly do either: a rim with corners.
        if !(OF_HALF * change * (oval.count as f64 / MOST as f64).powi(3) <= 0.5 * tolerance * force) {
            return None;
        }
        (before, last, between_last) = (change, mean, between.min(1.0));
    }
    None
}

impl Oval<'_, '_, '_, '_> {
    /// Adds the ray at a part of the way around.
    fn cast(&mut self, turn: f64) -> Option<()> {
        let (sin, cos) = (TAU * turn).sin_cos();
        let [a, b] = self.axes;
        let at = [0, 1].map(|c| cos * a[c] + sin * b[c]);
        let square = at[0] * at[0] + at[1] * at[1];
        let direction = at.map(|c| c / square.sqrt());
        let weight = (a[0] * b[1] - a[1] * b[0]) / square;
        let ray = self.walker.walk(&Line { origin: self.centre, direction, is_polar: true });
        if ray.is_tilted || ray.is_folded || !weight.is_finite() {
            return None;
        }
        self.sums.iter_mut().zip(ray.sums).for_each(|(sum, value)| *sum += weight * value);
        self.radial += weight * ray.error;
        self.extent = self.extent.max(ray.length());
        self.ends[(MOST as f64 * turn) as usize] = self.end(&ray, [cos, sin])?;
        self.spokes[self.count] = Spoke { nodes: ray.nodes, weight };
        self.count += 1;
        Some(())
    }

    /// The end of a ray at an angle, where S is 1 along the rim.
    fn end(&self, ray: &Ray, [cos, sin]: [f64; 2]) -> Option<End> {
        let ([a, b], field) = (self.axes, &self.walker.field);
        let [on, around] = [[cos, sin], [-sin, cos]].map(|[p, q]| [0, 1].map(|c| p * a[c] + q * b[c]));
        let last = ray.event(ray.count.checked_sub(1)?)?;
        let (rho, [e, f], [u, v, z]) = (last.rho, ray.direction, self.centre);
        let slope = field.look(&[u + rho * e, v + rho * f, z + last.zeta]).slope(field.b.is_some());
        let along = |way: &[f64; 2]| slope[0] * way[0] + slope[1] * way[1];
        let inverse = (on[0] * on[0] + on[1] * on[1]) / (rho * rho);
        Some(End { inverse, change: 2.0 * inverse * along(&around) / along(&on) })
    }

    /// How far the area is off by what the directions of the rim at the ends of all rays tell of the places midway
    /// between, over the area.
    fn between(&self) -> f64 {
        let (every, step) = (MOST / self.count, TAU / self.count as f64);
        let (mut area, mut more) = (0.0, 0.0);
        for i in (0..MOST).step_by(every) {
            let (this, next) = (&self.ends[i], &self.ends[(i + every) % MOST]);
            let middle = 0.5 * (this.inverse + next.inverse) + 0.125 * step * (this.change - next.change);
            if !(middle > 0.0) {
                return f64::INFINITY;
            }
            area += 1.0 / this.inverse;
            more += 1.0 / middle - 1.0 / this.inverse;
        }
        0.5 * more.abs() / area
    }

    /// Whether the edges of a triangle may cut something off, between two rays, too: the load of a ray is not smooth
    /// there.
    fn meets_edges(&self) -> bool {
        let mut edges = self.walker.field.planes.iter().filter(|plane| plane.owner == Owner::Edge);
        edges.any(|edge| edge.excess + dot(&edge.normal, &self.centre) + BETWEEN * self.extent > 0.0)
    }

    /// The sums over 2π.
    fn mean(&self) -> [f64; SUMS] {
        self.sums.map(|sum| sum / self.count as f64)
    }

    fn give(&self, points: &mut Vec<Node>) {
        points.clear();
        let step = TAU / self.count as f64;
        for Spoke { nodes: (from, to), weight } in &self.spokes[..self.count] {
            let nodes = &self.walker.nodes[*from as usize..*to as usize];
            points.extend(nodes.iter().map(|node| Node { weight: step * weight * node.weight, ..*node }));
        }
    }
}
