//! One zone with its rule of quadrature: a strip, a cap or a disc.

use super::cap::Cap;
use super::chart::Vector;
use super::disc::Disc;
use super::ray::Node;
use super::rules::FINE;
use super::strip::Strip;

/// Points of the rules of a strip, across and along, from coarse to fine.
const OF_STRIPS: [[usize; 2]; 5] = [[3, 2], [3, 3], [4, 4], [5, 8], [8, 14]];

/// Of a cap, in both angles.
const OF_CAPS: [usize; 5] = [1, 2, 3, 5, 8];

/// Of a disc, outwards and around.
const OF_DISCS: [[usize; 2]; 4] = [[3, 7], [4, 10], [6, 14], [10, 24]];

/// Part of a cap's load by which rules of one point and of two in each angle are wrong at most, about: the difference of the two may vanish by
/// chance.
const COARSE_CAP: [f64; 2] = [0.3, 0.1];

/// A part of the patch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub kind: Kind,
    /// The rule in use, of those of its kind.
    rule: usize,
    /// What is neglected: of the force.
    pub neglected: f64,
    /// Estimated errors of force and area.
    pub errors: [f64; 2],
    /// Where its points are.
    nodes: (usize, usize),
}

#[derive(Clone, Copy, Debug)]
pub(super) enum Kind {
    Strip(Strip),
    Cap(Cap),
    Disc(Disc),
}

impl Piece {
    pub fn new(kind: Kind, neglected: f64) -> Self {
        Self { kind, rule: 0, neglected, errors: [0.0; 2], nodes: (0, 0) }
    }

    /// The next finer rule: of a cap one that may bring its error, so far no more than assumed, to a share.
    pub fn refine(&mut self, share: f64) {
        let skips = matches!(self.kind, Kind::Cap(_))
            && self.rule == 0
            && self.errors[0] * COARSE_CAP[1] > share * COARSE_CAP[0];
        self.rule += 1 + usize::from(skips);
    }

    /// Appends its points, takes the weight of those of its last rule, and estimates the errors from a coarser rule. `None` where the
    /// patch is no graph, and after the finest rule.
    pub fn integrate(&mut self, tolerance: f64, deepest: f64, nodes: &mut Vec<Node>) -> Option<()> {
        nodes[self.nodes.0..self.nodes.1].iter_mut().for_each(|node| node.weight = 0.0);
        let first = nodes.len();
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
                let [across, along] = *OF_STRIPS.get(self.rule)?;
                strip.integrate(across, along, into)?;
                strip.integrate(across - 1, along - 1, only)?;
            }
            Kind::Cap(cap) => {
                let points = *OF_CAPS.get(self.rule)?;
                cap.integrate(points, into)?;
                if let Some(part) = COARSE_CAP.get(self.rule) {
                    let size = Vector::new(fine[0], fine[1], fine[2]).norm();
                    self.errors = [part * size, part * fine[3]];
                    self.nodes = (first, nodes.len());
                    return Some(());
                }
                cap.integrate(points - 1, only)?;
            }
            Kind::Disc(disc) => {
                let [outwards, around] = *OF_DISCS.get(self.rule)?;
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
        self.errors = [of(off, size), of((fine[3] - coarse[3]).abs(), fine[3])];
        self.nodes = (first, nodes.len());
        Some(())
    }
}
