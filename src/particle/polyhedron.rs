//! A polyhedron about the origin, cut out of a cube by one plane after the other.
//!
//! Three faces meet in every corner: a plane takes away the corners beyond it, which are connected, and puts a new one
//! on each edge that it cuts. Each corner is found beyond or not once for all its edges, so that the surface stays
//! closed whatever rounding does, with every edge between two faces; and it stays about the origin, since what is taken
//! away and what is put in its place both lie beyond the plane.

use crate::particle::cutter::{Cutter, Edge};
use crate::particle::outlines::Outlines;
use nalgebra::Vector3;

/// Where three faces meet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub at: Vector3<f64>,
    /// Counter-clockwise from outside.
    pub faces: [u32; 3],
    /// The next corner, counter-clockwise, on each of these faces; on the other side of that edge is the face before.
    /// [`REMOVED`] of one that was taken away.
    pub next: [u32; 3],
}

/// Stands for the next corners where there are none.
const REMOVED: [u32; 3] = [u32::MAX; 3];

impl Corner {
    /// The one that a plane, whose face is `number`, puts on an edge; `low` and `high` are the heights of the edge's
    /// ends.
    fn on(edge: &Edge, corners: &[Self], [low, high]: [f64; 2], number: u32, next: [u32; 3]) -> Self {
        let [here, there] = [edge.kept, edge.gone].map(|i| corners[i as usize].at);
        Self { at: here + low / (low - high) * (there - here), faces: [edge.right, number, edge.left], next }
    }
}

/// The number of a face, and those of its corners, counter-clockwise from outside.
pub(crate) type Numbered = (usize, Vec<u32>);

/// What became of a polyhedron that a plane was to split.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Split {
    /// It does not reach farther than the least cut on both sides.
    Missed,
    /// By rounding a part would not have closed.
    Unclosed,
    /// Both parts were made.
    Parted,
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Polyhedron {
    corners: Vec<Corner>,
    /// Least depth of a cut, length.
    least_cut: f64,
    /// Where the next search begins.
    start: u32,
}

/// The cube's faces: x, −x, y, −y, z, −z.
pub(crate) const OF_CUBE: usize = 6;

impl Polyhedron {
    /// A cube about the origin, whose faces are the numbers below [`OF_CUBE`]; planes that cut off less than
    /// `least_cut` will not count.
    pub fn cube(half: f64, least_cut: f64) -> Self {
        let corner = |i: usize| {
            let is_low = |axis: usize| i >> axis & 1;
            let at = Vector3::from_fn(|axis, _| if is_low(axis) == 0 { half } else { -half });
            // Along the edges of x, y and z. Seen from where all are positive, the faces follow each other as x, y, z.
            let odd = (0..3).map(is_low).sum::<usize>() % 2 == 1;
            let order = if odd { [0, 2, 1] } else { [0, 1, 2] };
            let faces = order.map(|axis| (2 * axis + is_low(axis)) as u32);
            // The edge with this face on one side and the face before on the other is along the third axis.
            let next = [0, 1, 2].map(|j: usize| (i ^ (1 << order[(j + 1) % 3])) as u32);
            Corner { at, faces, next }
        };
        Self { corners: (0..8).map(corner).collect(), least_cut, start: 0 }
    }

    /// Cuts off what lies beyond n·x = `height`, with n of unit length; the new face is `number`. False, without a cut,
    /// if that is less than the least cut or rounding leaves no closed surface.
    pub fn cut(&mut self, cutter: &mut Cutter, number: usize, n: &Vector3<f64>, height: f64) -> bool {
        let highest = cutter.highest(&self.corners, n, self.start, self.least_cut);
        let excess = |corners: &[Corner], i: u32| n.dot(&corners[i as usize].at) - height;
        if !(excess(&self.corners, highest) > self.least_cut)
            || !cutter.trace(&self.corners, highest, |i| excess(&self.corners, i))
        {
            return false;
        }
        let first = self.corners.len() as u32;
        for (i, edge) in cutter.edges.iter().enumerate() {
            let heights = [edge.kept, edge.gone].map(|i| excess(&self.corners, i));
            let next = [edge.kept, first + cutter.preceding[i], first + cutter.following[i]];
            self.corners.push(Corner::on(edge, &self.corners, heights, number as u32, next));
            self.corners[edge.kept as usize].next[edge.side] = first + i as u32;
        }
        cutter.removed.iter().for_each(|&i| self.corners[i as usize].next = REMOVED);
        self.start = first;
        true
    }

    /// The parts below and beyond n·x = `height`, both with the new face `number`, where it is crossed: with less than
    /// the least cut on either side it is missed.
    pub fn split(
        &self,
        cutter: &mut Cutter,
        number: usize,
        n: &Vector3<f64>,
        height: f64,
        [below, beyond]: [&mut Self; 2],
    ) -> Split {
        let mut heights = std::mem::take(&mut cutter.heights);
        heights.clear();
        heights.extend(self.corners.iter().map(|corner| n.dot(&corner.at) - height));
        let split = match self.ends(&heights) {
            None => Split::Missed,
            Some([lowest, highest]) => {
                let is_parted = self.part(cutter, number, highest, |i| heights[i as usize], below)
                    && self.part(cutter, number, lowest, |i| -heights[i as usize], beyond);
                if is_parted { Split::Parted } else { Split::Unclosed }
            }
        };
        cutter.heights = heights;
        split
    }

    /// The lowest and the highest corner, if both are farther from the plane than the least cut.
    fn ends(&self, heights: &[f64]) -> Option<[u32; 2]> {
        let (mut low, mut high) = ((0.0, 0), (0.0, 0));
        for (i, (corner, &height)) in self.corners.iter().zip(heights).enumerate() {
            if corner.next != REMOVED {
                low = if height < low.0 { (height, i) } else { low };
                high = if height > high.0 { (height, i) } else { high };
            }
        }
        (low.0 < -self.least_cut && high.0 > self.least_cut).then_some([low.1 as u32, high.1 as u32])
    }

    /// What is left without the corners of positive excess that are connected with the highest one; whether it is
    /// closed.
    fn part(
        &self,
        cutter: &mut Cutter,
        number: usize,
        highest: u32,
        excess: impl Fn(u32) -> f64,
        into: &mut Self,
    ) -> bool {
        if !cutter.trace(&self.corners, highest, &excess) {
            return false;
        }
        let mut places = std::mem::take(&mut cutter.places);
        places.clear();
        let made = &mut into.corners;
        made.clear();
        for (i, corner) in self.corners.iter().enumerate() {
            places.push(made.len() as u32);
            if !cutter.is_removed(i) && corner.next != REMOVED {
                made.push(*corner);
            }
        }
        let first = made.len() as u32;
        // Wrong for edges that are cut, until these get their new corners.
        made.iter_mut().for_each(|corner| corner.next = corner.next.map(|next| places[next as usize]));
        for (i, edge) in cutter.edges.iter().enumerate() {
            let kept = places[edge.kept as usize];
            let next = [kept, first + cutter.preceding[i], first + cutter.following[i]];
            let heights = [excess(edge.kept), excess(edge.gone)];
            made.push(Corner::on(edge, &self.corners, heights, number as u32, next));
            made[kept as usize].next[edge.side] = first + i as u32;
        }
        (into.least_cut, into.start) = (self.least_cut, 0);
        cutter.places = places;
        true
    }

    /// Becomes a copy of another, in its own room.
    pub fn copy_from(&mut self, other: &Self) {
        self.corners.clone_from(&other.corners);
        (self.least_cut, self.start) = (other.least_cut, other.start);
    }

    /// Least depth of a cut, length.
    pub fn least_cut(&self) -> f64 {
        self.least_cut
    }

    fn left(&self) -> impl Iterator<Item = &Corner> {
        self.corners.iter().filter(|corner| corner.next != REMOVED)
    }

    /// All corners.
    pub fn corners(&self) -> impl Iterator<Item = &Vector3<f64>> {
        self.left().map(|corner| &corner.at)
    }

    /// The mean of all corners.
    pub fn middle(&self) -> Vector3<f64> {
        self.corners().sum::<Vector3<f64>>() / self.corners().count() as f64
    }

    /// The least and the largest coordinates of all corners.
    pub fn extremes(&self) -> [Vector3<f64>; 2] {
        [f64::min, f64::max].map(|of| self.corners().copied().reduce(|a, b| a.zip_map(&b, of)).unwrap_or_default())
    }

    /// The height along n, of unit length, of the corner that lies deepest.
    pub fn lowest(&self, cutter: &mut Cutter, n: &Vector3<f64>) -> f64 {
        n.dot(&self.corners[cutter.highest(&self.corners, &-n, self.start, self.least_cut) as usize].at)
    }

    /// All corners, and all faces.
    pub fn numbered(&self) -> (Vec<Vector3<f64>>, Vec<Numbered>) {
        let mut places = Vec::with_capacity(self.corners.len());
        let mut corners = Vec::new();
        for corner in &self.corners {
            places.push(corners.len() as u32);
            if corner.next != REMOVED {
                corners.push(corner.at);
            }
        }
        let (mut outlines, mut outline) = (Vec::new(), Vec::new());
        self.walk(&mut Vec::new(), |number, corner| match corner {
            Some((at, _)) => outline.push(places[at]),
            None => outlines.push((number as usize, std::mem::take(&mut outline))),
        });
        (corners, outlines)
    }

    /// All faces.
    pub fn outlines(&self) -> Outlines {
        let mut outlines = Outlines::default();
        self.read_outlines(&mut outlines);
        outlines
    }

    /// All faces, in the place of what was read before.
    pub fn read_outlines(&self, into: &mut Outlines) {
        let Outlines { faces, corners, beyond, seen } = into;
        faces.clear();
        corners.clear();
        beyond.clear();
        self.walk(seen, |number, corner| match corner {
            Some((at, side)) => {
                let corner = &self.corners[at];
                corners.push(corner.at);
                beyond.push(corner.faces[(side + 2) % 3] as usize);
            }
            None => faces.push((number as usize, corners.len())),
        });
    }

    /// Walks around each face in turn, counter-clockwise: `visit` is called with the face's number and each corner, as
    /// its place and which of its three faces this one is, and with `None` at the end of the face. `seen` is room that
    /// is lent.
    #[inline]
    fn walk(&self, seen: &mut Vec<[bool; 3]>, mut visit: impl FnMut(u32, Option<(usize, usize)>)) {
        seen.clear();
        seen.resize(self.corners.len(), [false; 3]);
        for i in 0..self.corners.len() {
            for side in 0..3 {
                if self.corners[i].next == REMOVED || seen[i][side] {
                    continue;
                }
                let number = self.corners[i].faces[side];
                let (mut at, mut here) = (i, side);
                while !seen[at][here] {
                    seen[at][here] = true;
                    visit(number, Some((at, here)));
                    at = self.corners[at].next[here] as usize;
                    here = self.corners[at].faces.iter().position(|&face| face == number).unwrap_or(0);
                }
                visit(number, None);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particle::outlines::Outline;

    /// Six times the volume, by the corners alone.
    fn volume(polyhedron: &Polyhedron) -> f64 {
        let of_face = |Outline { corners, .. }: Outline<'_>| {
            let of_edge = |i: usize| corners[0].dot(&corners[i].cross(&corners[(i + 1) % corners.len()]));
            (1..corners.len() - 1).map(of_edge).sum::<f64>() / 6.0
        };
        polyhedron.outlines().iter().map(of_face).sum()
    }

    /// Every edge has two sides, and V − E + F = 2.
    fn assert_closed(polyhedron: &Polyhedron) {
        let faces = polyhedron.outlines();
        let mut edges = Vec::new();
        for face in faces.iter() {
            edges.extend(face.beyond.iter().map(|beyond| (face.number, *beyond)));
        }
        let corners = faces.corner_count();
        for (face, beyond) in &edges {
            let count = |pair: (usize, usize)| edges.iter().filter(|edge| **edge == pair).count();
            assert_eq!(count((*face, *beyond)), count((*beyond, *face)), "{face} and {beyond}");
        }
        assert!(corners % 3 == 0 && corners / 3 + faces.len() == corners / 2 + 2);
    }

    #[test]
    fn cuts_take_away_what_lies_beyond() {
        let mut cutter = Cutter::default();
        let mut polyhedron = Polyhedron::cube(1.0, 1e-9);
        assert!((volume(&polyhedron) - 8.0).abs() < 1e-15);
        // An octahedron, whose corners are four faces each.
        for i in 0..8 {
            let sign = |axis: usize| if i >> axis & 1 == 0 { 1.0 } else { -1.0 };
            let n = Vector3::from_fn(|axis, _| sign(axis)) / 3f64.sqrt();
            polyhedron.cut(&mut cutter, OF_CUBE + i, &n, 1.0 / 3f64.sqrt());
            assert_closed(&polyhedron);
        }
        assert!((volume(&polyhedron) - 4.0 / 3.0).abs() < 1e-14);
        // Once more, and tilted by rounding: nothing is left to cut.
        let faces = polyhedron.outlines().len();
        polyhedron.cut(&mut cutter, 20, &Vector3::new(1.0 + 1e-15, 1.0, 1.0).normalize(), 1.0 / 3f64.sqrt());
        assert_eq!(polyhedron.outlines().len(), faces);
    }

    #[test]
    fn planes_that_meet_in_a_point_or_all_but_coincide_leave_it_closed() {
        let mut cutter = Cutter::default();
        for tilt in [1e-1, 1e-6, 1e-9, 1e-12, 1e-15] {
            let mut polyhedron = Polyhedron::cube(1.0, 1e-15);
            for i in 0..40 {
                let angle = f64::from(i) * 2.399963;
                let n = Vector3::new(tilt * angle.cos(), tilt * angle.sin(), 1.0).normalize();
                // All through (0, 0, ½), and from below as well.
                polyhedron.cut(&mut cutter, OF_CUBE + 2 * i as usize, &n, 0.5 * n.z);
                polyhedron.cut(&mut cutter, OF_CUBE + 2 * i as usize + 1, &-n, 1e-12);
                assert_closed(&polyhedron);
            }
            // A box but for what planes of this slope take away above and below, at most 8 times the half of its
            // diagonal.
            let (found, whole) = (volume(&polyhedron), 4.0 * (0.5 + 1e-12));
            assert!(found <= whole + 1e-14 && found >= whole - 12.0 * tilt, "{tilt:e}: {found}");
        }
    }
}
