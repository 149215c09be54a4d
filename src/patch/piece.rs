//! One zone with its rule of quadrature: a strip, a cap or a disc.

use super::cap::Cap;
use super::disc::Disc;
use super::local_coordinates::Vector;
use super::numbers::{CAP_RULES, DISC_RULES, FINE, Fitted, STRIP_RULES};
use super::ray::Node;
use super::strip::Strip;

/// A part of the patch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub kind: Kind,
    /// The rule in use, of those of its kind.
    rule: usize,
    /// Force that is neglected.
    pub neglected: f64,
    /// Estimated errors of force and area.
    pub errors: [f64; 2],
    /// Range of its points.
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

    /// The next finer rule; of a cap, whose first error is assumed, the first that may reach `allowed`.
    pub fn refine(&mut self, allowed: f64) {
        let skips = matches!(self.kind, Kind::Cap(_))
            && self.rule == 0
            && self.errors[0] * Fitted::CAP_BY_TWO[0] > allowed * Fitted::CAP_BY_ONE;
        self.rule += 1 + usize::from(skips);
    }

    /// Appends its points, takes the weight of those of its last rule, and estimates the errors from a coarser rule.
    /// `None` where the patch is no graph, and after the finest rule.
    pub fn integrate(&mut self, tolerance: f64, deepest: f64, nodes: &mut Vec<Node>) -> Option<()> {
        nodes[self.nodes.0..self.nodes.1].iter_mut().for_each(|node| node.weight = 0.0);
        let first = nodes.len();
        let mut fine = [0.0; 4];
        let mut coarse = [0.0; 4];
        let mut tapers = false;
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
                let [across, along] = *STRIP_RULES.get(self.rule)?;
                strip.integrate(across, along, into)?;
                // One point along a strip that tapers tells nothing.
                tapers = along == 2 && strip.tapers().is_some();
                strip.integrate(across - 1, if tapers { along } else { along - 1 }, only)?;
            }
            Kind::Cap(cap) => {
                let points = *CAP_RULES.get(self.rule)?;
                cap.integrate(points, into)?;
                if points > 1 {
                    cap.integrate(points - 1, only)?;
                }
            }
            Kind::Disc(disc) => {
                if tolerance < FINE {
                    self.rule = self.rule.max(1);
                }
                let Some(finer) = self.rule.checked_sub(1) else {
                    self.errors = disc.first(into)?;
                    self.nodes = (first, nodes.len());
                    return Some(());
                };
                let [outwards, around] = *DISC_RULES.get(finer)?;
                disc.integrate(outwards, around, into)?;
                disc.integrate(outwards - 1, around - 2, only)?;
            }
        }
        let off = [0, 1, 2].map(|i| fine[i] - coarse[i]);
        let (off, size) = (Vector::from(off).norm(), Vector::new(fine[0], fine[1], fine[2]).norm());
        let least = if tolerance < FINE { 1.0 } else { (0.02 / deepest).min(1.0) };
        let of = |off: f64, size: f64| match (&self.kind, self.rule) {
            (Kind::Cap(_), 0) => Fitted::CAP_BY_ONE * size,
            (Kind::Cap(_), 1) => {
                Fitted::CAP_BY_TWO[0] * size + if off > 0.0 { Fitted::CAP_BY_TWO[1] * off * off / size } else { 0.0 }
            }
            // The nearer s = √S comes to the kink at its 0, the slower the rules converge.
            _ if off > 0.0 => {
                off * (3.0 * off / (deepest * size)).clamp(least, 1.0)
                    + if tapers { Fitted::TAPERED * size } else { 0.0 }
            }
            _ => 0.0,
        };
        self.errors = [of(off, size), of((fine[3] - coarse[3]).abs(), fine[3])];
        self.nodes = (first, nodes.len());
        Some(())
    }
}
