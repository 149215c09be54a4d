//! What a plane takes away from a polyhedron, and the edges that it cuts.
//!
//! A cutter is reused from cut to cut: it keeps its buffers, so that cutting allocates nothing.

use super::numbers::Limits;
use crate::particle::polyhedron::Corner;
use nalgebra::Vector3;

/// An edge that the plane cuts, from a corner that is kept to one that is removed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    pub kept: u32,
    pub gone: u32,
    /// Which of the kept corner's three edges it is.
    pub side: usize,
    /// The faces on both sides of it.
    pub left: u32,
    pub right: u32,
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Cutter {
    /// Corners that are taken away, each marked by the stamp of this search.
    pub(super) removed: Vec<u32>,
    marks: Vec<u32>,
    stamp: u32,
    pub(super) edges: Vec<Edge>,
    /// For each of these edges the one whose right face is its left face and the one whose left face is its right face.
    pub(super) following: Vec<u32>,
    pub(super) preceding: Vec<u32>,
    /// Heights of the corners above the plane, and the places that they get in a part: for whoever cuts.
    pub(super) heights: Vec<f64>,
    pub(super) places: Vec<u32>,
    /// Right faces with their edges, in order.
    by_right: Vec<(u32, u32)>,
    left: Vec<u32>,
}

impl Cutter {
    /// The corner that lies farthest along n: uphill from `start` from corner to corner, also between those that are
    /// level but for `level`, length.
    pub(super) fn highest(&mut self, corners: &[Corner], n: &Vector3<f64>, start: u32, level: f64) -> u32 {
        let seen = self.next_stamp(corners.len());
        let mut best = (n.dot(&corners[start as usize].at), start);
        self.left.clear();
        self.left.push(start);
        while let Some(corner) = self.left.pop() {
            for next in corners[corner as usize].next {
                let height = n.dot(&corners[next as usize].at);
                if self.marks[next as usize] != seen && height >= best.0 - level {
                    self.marks[next as usize] = seen;
                    self.left.push(next);
                    if height > best.0 {
                        best = (height, next);
                    }
                }
            }
        }
        best.1
    }

    /// Finds all corners of positive excess that are connected with the highest one, and the edges that lead out of
    /// them. False unless these lie around one new face and cut every other once, as rounding may have it.
    pub(super) fn trace(&mut self, corners: &[Corner], highest: u32, excess: impl Fn(u32) -> f64) -> bool {
        let stamp = self.next_stamp(corners.len());
        self.removed.clear();
        self.removed.push(highest);
        self.marks[highest as usize] = stamp;
        let mut i = 0;
        while i < self.removed.len() {
            for next in corners[self.removed[i] as usize].next {
                if self.marks[next as usize] != stamp && excess(next) > 0.0 {
                    self.marks[next as usize] = stamp;
                    self.removed.push(next);
                }
            }
            i += 1;
        }
        self.edges.clear();
        for &gone in &self.removed {
            for kept in corners[gone as usize].next {
                let corner = &corners[kept as usize];
                if self.marks[kept as usize] != stamp {
                    let side = corner.next.iter().position(|&to| to == gone);
                    let edge = |side: usize| {
                        let (left, right) = (corner.faces[side], corner.faces[(side + 2) % 3]);
                        Edge { kept, gone, side, left, right }
                    };
                    self.edges.extend(side.map(edge));
                }
            }
        }
        self.lies_around()
    }

    /// Whether the last trace has taken a corner away.
    pub(super) fn is_removed(&self, corner: usize) -> bool {
        self.marks[corner] == self.stamp
    }

    /// A number that no corner is marked with.
    fn next_stamp(&mut self, corners: usize) -> u32 {
        if self.stamp == u32::MAX {
            self.marks.clear();
            self.stamp = 0;
        }
        self.stamp += 1;
        if self.marks.len() < corners {
            self.marks.resize(corners, 0);
        }
        self.stamp
    }

    /// Finds for each edge the one whose right face is its left face; whether one walk along them visits all.
    fn lies_around(&mut self) -> bool {
        let Self { edges, following, preceding, by_right, .. } = self;
        let count = edges.len();
        following.clear();
        if count > Limits::UNSORTED_EDGES {
            by_right.clear();
            by_right.extend(edges.iter().enumerate().map(|(i, edge)| (edge.right, i as u32)));
            by_right.sort_unstable();
        }
        for edge in edges.iter() {
            let found = if count > Limits::UNSORTED_EDGES {
                let end = by_right.partition_point(|(right, _)| *right <= edge.left);
                by_right[..end].last().filter(|(right, _)| *right == edge.left).map(|(_, i)| *i)
            } else {
                edges.iter().rposition(|other| other.right == edge.left).map(|i| i as u32)
            };
            match found {
                Some(found) => following.push(found),
                None => return false,
            }
        }
        preceding.clear();
        preceding.resize(count, 0);
        following.iter().enumerate().for_each(|(i, &j)| preceding[j as usize] = i as u32);
        let mut at = 0;
        for step in 1..=count {
            at = following[at] as usize;
            if at == 0 {
                return step == count;
            }
        }
        false
    }
}
