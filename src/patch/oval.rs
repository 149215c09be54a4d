//! A patch with a smooth rim: rays at equal steps around an ellipse.
//!
//! Where a plane comes on, the pressure changes by the square of the distance beyond. The load of a ray is therefore smooth enough in its
//! direction for the sum over equal steps to converge with the fourth power of the step, and no direction has to be found in which the
//! sequence of cells changes.

use super::field::{Owner, dot};
use super::pieces::Estimate;
use super::ray::{Line, Node, SUMS, Walker};
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
}

/// Fills `points`; `None` where the sum has not converged.
///
/// `centre`: a point in the middle of the patch; `axis` and `lengths`: how long the patch is along an axis and across it; `rough`: the load on
/// four rays along those.
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
    let mut oval = Oval { walker, centre, axes, spokes, count: 0, sums, radial: 0.0, extent: 0.0 };
    (0..FIRST / 2).try_for_each(|step| oval.cast(step as f64 / (FIRST / 2) as f64))?;
    let (mut before, mut last) = (f64::INFINITY, oval.mean());
    while oval.count < MOST {
        let half = oval.count;
        (0..half).try_for_each(|step| oval.cast((step as f64 + 0.5) / half as f64))?;
        let mean = oval.mean();
        let off: [f64; SUMS] = std::array::from_fn(|i| mean[i] - last[i]);
        let force = norm(&mean[..3]);
        let change = norm(&off[..3]).max(norm(&off[3..6]) / oval.extent);
        let error = (OF_HALF * change).max(OF_QUARTER * before.min(force)) + oval.radial / oval.count as f64;
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
        (before, last) = (change, mean);
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
        if ray.is_folded || !weight.is_finite() {
            return None;
        }
        self.sums.iter_mut().zip(ray.sums).for_each(|(sum, value)| *sum += weight * value);
        self.radial += weight * ray.error;
        self.extent = self.extent.max(ray.length());
        self.spokes[self.count] = Spoke { nodes: ray.nodes, weight };
        self.count += 1;
        Some(())
    }

    /// Whether the edges of a triangle may cut something off, between two rays, too: the load of a ray is not smooth there.
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
