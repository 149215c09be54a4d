//! A polyhedron about the origin, cut out of a cube by one plane after the other.
//!
//! Three faces meet in every corner: a plane takes away the corners beyond it, which are connected, and puts a new one on each edge that
//! it cuts. Each corner is found beyond or not once for all its edges, so that the surface stays closed whatever
//! rounding does, with every edge between two faces; and it stays about the origin, since what is taken away and what is put in its
//! place both lie beyond the plane.

use nalgebra::Vector3;
use std::collections::HashMap;

/// Where three faces meet.
#[derive(Clone, Copy, Debug)]
struct Corner {
    at: Vector3<f64>,
    /// Counter-clockwise from outside.
    faces: [usize; 3],
    /// The next corner, counter-clockwise, on each of these faces; on the other side of that edge is the face before.
    next: [usize; 3],
    state: State,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    /// With the last search that came by.
    Kept(usize),
    Removed,
}

/// One face: its number, and its corners counter-clockwise, each with the number of the face beyond the edge to the next one.
#[derive(Clone, Debug)]
pub(crate) struct Face {
    pub number: usize,
    pub corners: Vec<(Vector3<f64>, usize)>,
}

#[derive(Clone, Debug)]
pub(crate) struct Polyhedron {
    corners: Vec<Corner>,
    /// Least depth of a cut, length.
    least_cut: f64,
    /// Where the next search begins, and how many there were.
    start: usize,
    searches: usize,
}

/// The cube's faces: x, −x, y, −y, z, −z.
pub(crate) const OF_CUBE: usize = 6;

impl Polyhedron {
    /// A cube about the origin, whose faces are the numbers below [`OF_CUBE`]; planes that cut off less than `least_cut` will not count.
    pub fn cube(half: f64, least_cut: f64) -> Self {
        let corner = |i: usize| {
            let is_low = |axis: usize| i >> axis & 1;
            let at = Vector3::from_fn(|axis, _| if is_low(axis) == 0 { half } else { -half });
            // Along the edges of x, y and z. Seen from where all are positive, the faces follow each other as x, y, z.
            let odd = (0..3).map(is_low).sum::<usize>() % 2 == 1;
            let order = if odd { [0, 2, 1] } else { [0, 1, 2] };
            let faces = order.map(|axis| 2 * axis + is_low(axis));
            // The edge with this face on one side and the face before on the other is along the third axis.
            let next = [0, 1, 2].map(|j: usize| i ^ (1 << order[(j + 1) % 3]));
            Corner { at, faces, next, state: State::Kept(0) }
        };
        Self { corners: (0..8).map(corner).collect(), least_cut, start: 0, searches: 0 }
    }

    /// Cuts off what lies beyond n·x = `height`, with n of unit length; the new face is `number`. Whether it did: not where that is less
    /// than the least cut, or where rounding leaves no closed surface.
    pub fn cut(&mut self, number: usize, n: &Vector3<f64>, height: f64) -> bool {
        let excess = |corner: &Corner| n.dot(&corner.at) - height;
        let highest = self.highest(n);
        if !(excess(&self.corners[highest]) > self.least_cut) {
            return false;
        }
        // All corners beyond the plane, and the edges that lead out of them: from corner, its edge, to corner.
        let mut removed = vec![highest];
        self.corners[highest].state = State::Removed;
        let mut i = 0;
        while i < removed.len() {
            for next in self.corners[removed[i]].next {
                if self.corners[next].state != State::Removed && excess(&self.corners[next]) > 0.0 {
                    self.corners[next].state = State::Removed;
                    removed.push(next);
                }
            }
            i += 1;
        }
        // The edges that the plane cuts, each from a corner that is kept, with the faces on its left and its right.
        let mut edges = Vec::new();
        for &from in &removed {
            for next in self.corners[from].next {
                let corner = &self.corners[next];
                if corner.state != State::Removed {
                    let side = corner.next.iter().position(|&to| to == from);
                    edges.extend(side.map(|side| (next, from, side, corner.faces[side], corner.faces[(side + 2) % 3])));
                }
            }
        }
        let Some(following) = around(edges.iter().map(|&(.., left, right)| (left, right))) else {
            removed.iter().for_each(|&i| self.corners[i].state = State::Kept(0));
            return false;
        };
        let first = self.corners.len();
        let mut preceding = vec![0; following.len()];
        following.iter().enumerate().for_each(|(i, &j)| preceding[j] = i);
        for (i, &(kept, gone, side, left, right)) in edges.iter().enumerate() {
            let (here, there) = (&self.corners[kept], &self.corners[gone]);
            let (low, high) = (excess(here), excess(there));
            let at = here.at + low / (low - high) * (there.at - here.at);
            let next = [kept, first + preceding[i], first + following[i]];
            self.corners.push(Corner { at, faces: [right, number, left], next, state: State::Kept(0) });
            self.corners[kept].next[side] = first + i;
        }
        self.start = first;
        true
    }

    /// Whether it reaches farther than the least cut on both sides of n·x = `height`.
    pub fn is_crossed(&self, n: &Vector3<f64>, height: f64) -> bool {
        let excess = self.corners().map(|at| n.dot(at) - height);
        let (low, high) = excess.fold((0.0_f64, 0.0_f64), |(low, high), excess| (low.min(excess), high.max(excess)));
        low < -self.least_cut && high > self.least_cut
    }

    /// The parts below and beyond n·x = `height`, both with the new face `number`; `None` where it is not crossed, or rounding leaves no
    /// closed surface.
    pub fn split(&self, number: usize, n: &Vector3<f64>, height: f64) -> Option<[Self; 2]> {
        let (mut below, mut beyond) = (self.clone(), self.clone());
        let is_cut = below.cut(number, n, height) && beyond.cut(number, &-n, -height);
        is_cut.then(|| [below.compacted(), beyond.compacted()])
    }

    /// The same without the corners that were taken away.
    fn compacted(mut self) -> Self {
        let mut place = vec![usize::MAX; self.corners.len()];
        let is_left = |corner: &Corner| corner.state != State::Removed;
        let left = (0..self.corners.len()).filter(|&i| is_left(&self.corners[i]));
        left.enumerate().for_each(|(new, old)| place[old] = new);
        self.corners.retain(is_left);
        self.corners.iter_mut().for_each(|corner| corner.next = corner.next.map(|next| place[next]));
        self.start = 0;
        self
    }

    /// Least depth of a cut, length.
    pub fn least_cut(&self) -> f64 {
        self.least_cut
    }

    /// All corners.
    pub fn corners(&self) -> impl Iterator<Item = &Vector3<f64>> {
        self.corners.iter().filter(|corner| corner.state != State::Removed).map(|corner| &corner.at)
    }

    /// The mean of all corners.
    pub fn middle(&self) -> Vector3<f64> {
        self.corners().sum::<Vector3<f64>>() / self.corners().count() as f64
    }

    /// The least and the largest coordinates of all corners.
    pub fn extremes(&self) -> [Vector3<f64>; 2] {
        [f64::min, f64::max].map(|of| self.corners().copied().reduce(|a, b| a.zip_map(&b, of)).unwrap_or_default())
    }

    /// All corners with the numbers of their faces, counter-clockwise from outside.
    pub fn corners_with_faces(&self) -> impl Iterator<Item = (&Vector3<f64>, [usize; 3])> {
        self.corners.iter().filter(|corner| corner.state != State::Removed).map(|corner| (&corner.at, corner.faces))
    }

    /// The corner that lies farthest along n: uphill from corner to corner, also between those that are level but for `least_cut`.
    fn highest(&mut self, n: &Vector3<f64>) -> usize {
        self.searches += 1;
        let seen = State::Kept(self.searches);
        let mut best = (n.dot(&self.corners[self.start].at), self.start);
        let mut left = vec![self.start];
        while let Some(corner) = left.pop() {
            for next in self.corners[corner].next {
                let height = n.dot(&self.corners[next].at);
                if self.corners[next].state != seen && height >= best.0 - self.least_cut {
                    self.corners[next].state = seen;
                    left.push(next);
                    if height > best.0 {
                        best = (height, next);
                    }
                }
            }
        }
        best.1
    }

    /// All faces that are left.
    pub fn faces(&self) -> Vec<Face> {
        let mut seen = vec![[false; 3]; self.corners.len()];
        let mut faces = Vec::new();
        for i in 0..self.corners.len() {
            for side in 0..3 {
                if self.corners[i].state == State::Removed || seen[i][side] {
                    continue;
                }
                let number = self.corners[i].faces[side];
                let (mut corners, mut at, mut here) = (Vec::new(), i, side);
                while !seen[at][here] {
                    seen[at][here] = true;
                    let corner = &self.corners[at];
                    corners.push((corner.at, corner.faces[(here + 2) % 3]));
                    at = corner.next[here];
                    here = self.corners[at].faces.iter().position(|&face| face == number).unwrap_or(0);
                }
                faces.push(Face { number, corners });
            }
        }
        faces
    }
}

/// For each cut edge, given by the faces on its left and its right, the one by which its left face comes back. `None` unless they lie
/// around one new face and cut every other once, as rounding may have it.
fn around(edges: impl ExactSizeIterator<Item = (usize, usize)> + Clone) -> Option<Vec<usize>> {
    let by_right: HashMap<usize, usize> = edges.clone().enumerate().map(|(i, (_, right))| (right, i)).collect();
    let following: Vec<usize> = edges.map(|(left, _)| by_right.get(&left).copied()).collect::<Option<_>>()?;
    let mut at = 0;
    for step in 1..=following.len() {
        at = following[at];
        if at == 0 {
            return (step == following.len()).then_some(following);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Six times the volume, by the corners alone.
    fn volume(polyhedron: &Polyhedron) -> f64 {
        let of_face = |Face { corners, .. }: Face| {
            let of_edge = |i: usize| corners[0].0.dot(&corners[i].0.cross(&corners[(i + 1) % corners.len()].0));
            (1..corners.len() - 1).map(of_edge).sum::<f64>() / 6.0
        };
        polyhedron.faces().into_iter().map(of_face).sum()
    }

    /// Every edge has two sides, and V − E + F = 2.
    fn assert_closed(polyhedron: &Polyhedron) {
        let faces = polyhedron.faces();
        let (mut edges, mut corners) = (Vec::new(), 0);
        for face in &faces {
            corners += face.corners.len();
            edges.extend(face.corners.iter().map(|(_, beyond)| (face.number, *beyond)));
        }
        for (face, beyond) in &edges {
            let count = |pair: (usize, usize)| edges.iter().filter(|edge| **edge == pair).count();
            assert_eq!(count((*face, *beyond)), count((*beyond, *face)), "{face} and {beyond}");
        }
        assert!(corners % 3 == 0 && corners / 3 + faces.len() == corners / 2 + 2);
    }

    #[test]
    fn cuts_take_away_what_lies_beyond() {
        let mut polyhedron = Polyhedron::cube(1.0, 1e-9);
        assert!((volume(&polyhedron) - 8.0).abs() < 1e-15);
        // An octahedron, whose corners are four faces each.
        for i in 0..8 {
            let sign = |axis: usize| if i >> axis & 1 == 0 { 1.0 } else { -1.0 };
            let n = Vector3::from_fn(|axis, _| sign(axis)) / 3f64.sqrt();
            polyhedron.cut(OF_CUBE + i, &n, 1.0 / 3f64.sqrt());
            assert_closed(&polyhedron);
        }
        assert!((volume(&polyhedron) - 4.0 / 3.0).abs() < 1e-14);
        // Once more, and tilted by rounding: nothing is left to cut.
        let faces = polyhedron.faces().len();
        polyhedron.cut(20, &Vector3::new(1.0 + 1e-15, 1.0, 1.0).normalize(), 1.0 / 3f64.sqrt());
        assert_eq!(polyhedron.faces().len(), faces);
    }

    #[test]
    fn planes_that_meet_in_a_point_or_all_but_coincide_leave_it_closed() {
        for tilt in [1e-1, 1e-6, 1e-9, 1e-12, 1e-15] {
            let mut polyhedron = Polyhedron::cube(1.0, 1e-15);
            for i in 0..40 {
                let angle = f64::from(i) * 2.399963;
                let n = Vector3::new(tilt * angle.cos(), tilt * angle.sin(), 1.0).normalize();
                // All through (0, 0, ½), and from below as well.
                polyhedron.cut(OF_CUBE + 2 * i as usize, &n, 0.5 * n.z);
                polyhedron.cut(OF_CUBE + 2 * i as usize + 1, &-n, 1e-12);
                assert_closed(&polyhedron);
            }
            // A box but for what planes of this slope take away above and below, at most 8 times the half of its diagonal.
            let (found, whole) = (volume(&polyhedron), 4.0 * (0.5 + 1e-12));
            assert!(found <= whole + 1e-14 && found >= whole - 12.0 * tilt, "{tilt:e}: {found}");
        }
    }
}
