//! One zone with its rule of quadrature: a strip, a cap or a disc.

use super::cap::Cap;
use super::chart::Vector;
use super::disc::Disc;
use super::ray::Node;
use super::rules::FINE;
use super::strip::Strip;

/// Number of rules.
pub(super) const MOST_RULES: usize = 5;

/// Points of the rules, from coarse to fine: across a strip, along it, in a cap, in a disc outwards and around.
const RULES: [[usize; 5]; MOST_RULES] =
    [[3, 2, 1, 3, 7], [3, 2, 2, 3, 7], [4, 4, 3, 4, 10], [5, 8, 5, 6, 14], [8, 14, 8, 10, 24]];

/// Part of a cap's load by which rules of one point and of two in each angle are wrong at most, about: the difference of the two may vanish by
/// chance.
const COARSE_CAP: [f64; 2] = [0.3, 0.1];

/// A part of the patch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub kind: Kind,
    /// The rule in use.
    pub rule: usize,
    /// What is neglected: of the force.
    pub neglected: f64,
    pub error: f64,
}

#[derive(Clone, Copy, Debug)]
pub(super) enum Kind {
    Strip(Strip),
    Cap(Cap),
    Disc(Disc),
}

impl Piece {
    /// Appends its points; the estimated errors of force and area from a coarser rule.
    pub fn integrate(&self, tolerance: f64, deepest: f64, nodes: &mut Vec<Node>) -> Option<(f64, f64)> {
        let [across, along, cap, outwards, around] = RULES[self.rule];
        let mut fine = [0.0; 4];
        let mut coarse = [0.0; 4];
        let add = |sums: &mut [f64; 4], node: &Node| {
            let load = node.weight * node.pressure;
            let [u, v] = node.normal;
            sums[0] += load * u;
            sums[1] += load * v;
            sums[2] += load;
            sums[3] += node.weight * (1.0 + u * u + v * v).sqrt();
        };
        let into = |node: Node| {
            add(&mut fine, &node);
            nodes.push(node);
        };
        let only = |node: Node| add(&mut coarse, &node);
        match &self.kind {
            Kind::Strip(strip) => {
                strip.integrate(across, along, into)?;
                strip.integrate(across - 1, along - 1, only)?;
            }
            Kind::Cap(zone) => {
                zone.integrate(cap, into)?;
                if let Some(part) = COARSE_CAP.get(cap - 1) {
                    let size = Vector::new(fine[0], fine[1], fine[2]).norm();
                    return Some((part * size, part * fine[3]));
                }
                zone.integrate(cap - 1, only)?;
            }
            Kind::Disc(disc) => {
                disc.integrate(outwards, around, into)?;
                disc.integrate(outwards - 1, around - 2, only)?;
            }
        }
        let off = [0, 1, 2].map(|i| fine[i] - coarse[i]);
        let (off, size) = (Vector::from(off).norm(), Vector::new(fine[0], fine[1], fine[2]).norm());
        let least = if tolerance < FINE { 1.0 } else { (0.02 / deepest).min(1.0) };
        // The nearer s = √S comes to the kink at its 0, the slower the rules converge.
        let of = |off: f64, size: f64| {
            if off > 0.0 { off * (3.0 * off / (deepest * size)).clamp(least, 1.0) } else { 0.0 }
        };
        Some((of(off, size), of((fine[3] - coarse[3]).abs(), fine[3])))
    }
}
