//! The cells of a network: the faces of the planar graph that its sides make.
//!
//! Each side is traced in both directions. At a vertex the way continues with the next side clockwise, so that the
//! face lies on its left; which planes are active in it is found at a point inside. Nothing depends on which curve a
//! side is part of: coinciding curves are one side, and coinciding vertices one vertex. What lies between them enters
//! to second order.

use super::network::{Network, Side};
use super::numbers::{ROUNDED, SAME_VERTEX};

/// A corner of a face, and the middle of the side to the next one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub at: [f64; 2],
    pub middle: [f64; 2],
}

/// Buffers.
#[derive(Debug, Default)]
pub(super) struct Faces {
    /// The vertex that each is the same as.
    same: Vec<u32>,
    by_u: Vec<u32>,
    sides: Vec<Side>,
    /// The ways away from vertices: vertex, direction, way. Way 2 i is along side i, and 2 i + 1 against it.
    around: Vec<(u32, f64, u32)>,
    next: Vec<u32>,
    is_done: Vec<bool>,
    outline: Vec<Corner>,
}

impl Faces {
    /// Gives the outline of each face, counter-clockwise; `None` where the sides make no planar graph.
    ///
    /// With `is_split`, a side is split at each vertex that lies on it: a curve may have met only one of two that
    /// coincide.
    pub fn visit(
        &mut self,
        network: &Network,
        is_split: bool,
        mut give: impl FnMut(&[Corner]) -> Option<()>,
    ) -> Option<()> {
        let size =
            network.vertices.iter().flat_map(|vertex| [vertex.x[0].abs(), vertex.x[1].abs()]).fold(0.0, f64::max);
        self.unite(network, is_split, SAME_VERTEX * size)?;
        let vertices = self.link(network);
        self.is_done.clear();
        self.is_done.resize(self.next.len(), false);
        let (mut faces, mut outer) = (0, 0);
        for first in 0..self.next.len() {
            if self.is_done[first] {
                continue;
            }
            self.outline.clear();
            let mut way = first;
            while !self.is_done[way] {
                self.is_done[way] = true;
                let Side { ends, middle, .. } = self.sides[way / 2];
                let [u, v, _] = network.vertices[ends[way % 2] as usize].x;
                self.outline.push(Corner { at: [u, v], middle });
                way = self.next[way] as usize;
            }
            faces += 1;
            let area = area(&self.outline);
            if area < -ROUNDED * size * size {
                outer += 1;
            } else if area > ROUNDED * size * size {
                give(&self.outline)?;
            }
        }
        // Euler's formula.
        (outer == 1 && vertices + faces == self.sides.len() + 2).then_some(())
    }

    /// Finds vertices and sides that are the same; `None` where the sides make no planar graph.
    fn unite(&mut self, network: &Network, is_split: bool, near: f64) -> Option<()> {
        let Network { vertices, sides, .. } = network;
        let Self { same, by_u, .. } = self;
        same.clear();
        same.extend(0..vertices.len() as u32);
        by_u.clear();
        by_u.extend(0..vertices.len() as u32);
        by_u.sort_unstable_by(|a, b| vertices[*a as usize].x[0].total_cmp(&vertices[*b as usize].x[0]));
        for (place, i) in by_u.iter().enumerate() {
            let [u, v, _] = vertices[*i as usize].x;
            let close = by_u[..place].iter().rev().take_while(|j| u - vertices[**j as usize].x[0] <= near);
            if let Some(j) = close.into_iter().find(|j| (vertices[**j as usize].x[1] - v).abs() <= near) {
                same[*i as usize] = same[*j as usize];
            }
        }
        self.sides.clear();
        for side in sides {
            let ends = side.ends.map(|end| same[end as usize]);
            if ends[0] != ends[1] {
                self.sides.push(Side { ends, ..*side });
            }
        }
        if is_split {
            self.split(network, near)?;
        }
        let order = |side: &Side| [side.ends[0].min(side.ends[1]), side.ends[0].max(side.ends[1])];
        self.sides.sort_unstable_by_key(order);
        // Parabolas with the same ends are the same if equally far off the chord.
        let at = |end: u32| vertices[end as usize].x;
        let off = |side: &Side| {
            let ([a, b], [u, v]) = (order(side).map(at), side.middle);
            let [x, y] = [b[0] - a[0], b[1] - a[1]];
            (x * (v - a[1]) - y * (u - a[0])) / (x * x + y * y).sqrt()
        };
        self.sides.dedup_by(|b, a| order(a) == order(b) && (off(a) - off(b)).abs() <= near);
        Some(())
    }

    /// Splits sides at the vertices that lie on them and farther than `near` from both ends; `None` where that does not
    /// end.
    fn split(&mut self, network: &Network, near: f64) -> Option<()> {
        // A planar graph has fewer than three sides a vertex.
        let most = self.sides.len() + 3 * network.vertices.len();
        let mut place = 0;
        while place < self.sides.len() {
            let side = self.sides[place];
            let length = network.length(&side);
            let on_it = self.by_u.iter().copied().filter(|i| self.same[*i as usize] == *i && !side.ends.contains(i));
            let on_it = on_it.filter_map(|i| {
                let (off, t) = network.off(&side, &network.vertices[i as usize].x);
                (off <= near && t.min(1.0 - t) * length > near).then_some((i, t))
            });
            match on_it.into_iter().next() {
                Some((vertex, t)) => {
                    let [first, second] = network.halves(&side, t, vertex);
                    self.sides[place] = first;
                    self.sides.push(second);
                    (self.sides.len() <= most).then_some(())?;
                }
                None => place += 1,
            }
        }
        Some(())
    }

    /// Finds the way that follows each; the number of vertices.
    fn link(&mut self, network: &Network) -> usize {
        let at = |vertex: u32| network.vertices[vertex as usize].x;
        self.around.clear();
        for (i, Side { ends, middle, .. }) in self.sides.iter().enumerate() {
            for (back, [from, to]) in [*ends, [ends[1], ends[0]]].into_iter().enumerate() {
                // The tangent of the parabola.
                let [u, v] = [0, 1].map(|c| 4.0 * middle[c] - 3.0 * at(from)[c] - at(to)[c]);
                let along = u / (u.abs() + v.abs());
                let direction = if v < 0.0 { along - 1.0 } else { 1.0 - along };
                self.around.push((from, direction, (2 * i + back) as u32));
            }
        }
        self.around.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        self.next.clear();
        self.next.resize(2 * self.sides.len(), 0);
        let (mut from, mut vertices) = (0, 0);
        while from < self.around.len() {
            let count = self.around[from..].iter().take_while(|way| way.0 == self.around[from].0).count();
            let ways = &self.around[from..from + count];
            for i in 0..count {
                let before = ways[(i + count - 1) % count].2;
                self.next[(ways[i].2 ^ 1) as usize] = before;
            }
            from += count;
            vertices += 1;
        }
        vertices
    }
}

/// Area of an outline: of the polygon through corners and middles, which is enough for its sign.
pub(super) fn area(outline: &[Corner]) -> f64 {
    let count = outline.len();
    let cross = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
    let side = |i: usize| {
        let (Corner { at, middle }, next) = (outline[i], outline[(i + 1) % count].at);
        cross(at, middle) + cross(middle, next)
    };
    0.5 * (0..count).map(side).sum::<f64>()
}
