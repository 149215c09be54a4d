//! Planes in groups of similar normals, so that most planes of a many-faced particle are never touched.
//!
//! All n_i·y − d_i of a group lie below m·y + ρ|y| − d, with m the middle of its normals, ρ their largest distance
//! from it and d its least offset. Where that bound is negative, the whole group is off.

use crate::particle::particle::Plane;
use nalgebra::Vector3;
use std::ops::Range;

/// Most planes of a group: about as many as one bound costs to evaluate.
pub(crate) const MOST: usize = 12;

/// A run of consecutive planes with similar normals.
#[derive(Clone, Debug)]
pub(crate) struct Leaf {
    middle: Vector3<f64>,
    spread: f64,
    least_offset: f64,
    planes: Range<usize>,
}

/// The groups of a particle, which keeps its planes in the order that they need.
#[derive(Clone, Debug, Default)]
pub(crate) struct Leaves(Box<[Leaf]>);

impl Leaves {
    /// The groups, and for each place in the new order the index of the given plane.
    pub fn of(planes: &[Plane]) -> (Self, Box<[usize]>) {
        let mut order: Vec<usize> = (0..planes.len()).collect();
        let mut leaves = Vec::new();
        divide(planes, &mut order, 0, &mut leaves);
        (Self(leaves.into()), order.into())
    }

    /// No group, and the order as given: of planes without weight, which are never looked at.
    pub fn none(count: usize) -> (Self, Box<[usize]>) {
        (Self::default(), (0..count).collect())
    }

    /// Whether there is but one group, or none: it is cheaper to go through than to judge.
    pub fn single(&self) -> bool {
        self.0.len() <= 1
    }

    /// Calls `visit` with runs of planes that may have n·y − d > −`early`. Gives a number that no n·y − d of the others
    /// exceeds.
    #[inline(always)]
    pub fn visit_near(&self, y: &Vector3<f64>, early: f64, mut visit: impl FnMut(Range<usize>)) -> f64 {
        // The margin covers the rounding of the bound itself; a single group is not judged.
        let single = self.single();
        let length = if single { 0.0 } else { y.norm() * (1.0 + 1e-14) };
        let mut most_left_out = f64::NEG_INFINITY;
        for leaf in &self.0 {
            let bound = if single { f64::INFINITY } else { leaf.bound(y, length) };
            if bound > -early {
                visit(leaf.planes.clone());
            } else {
                most_left_out = bound.max(most_left_out);
            }
        }
        most_left_out
    }

    /// The largest of the numbers that `largest_of` gives for runs of planes, each with n·y − d; runs that cannot
    /// hold a larger one than is known already are left out.
    pub fn largest(&self, y: &Vector3<f64>, mut largest_of: impl FnMut(Range<usize>) -> (f64, usize)) -> (f64, usize) {
        if let [all] = &self.0[..] {
            return largest_of(all.planes.clone());
        }
        let length = y.norm() * (1.0 + 1e-14);
        let mut largest = (f64::NEG_INFINITY, 0);
        for leaf in &self.0 {
            if leaf.bound(y, length) > largest.0 {
                let found = largest_of(leaf.planes.clone());
                if found.0 > largest.0 {
                    largest = found;
                }
            }
        }
        largest
    }
}

impl Leaf {
    fn bound(&self, y: &Vector3<f64>, length: f64) -> f64 {
        self.middle.dot(y) + self.spread * length - self.least_offset
    }
}

/// Halves a run of planes along the axis on which their normals differ most, until the halves are small.
fn divide(planes: &[Plane], order: &mut [usize], start: usize, leaves: &mut Vec<Leaf>) {
    let count = order.len();
    if count <= MOST {
        if count > 0 {
            leaves.push(leaf(planes, order, start));
        }
        return;
    }
    let extent = |axis: usize| {
        let (low, high) = order
            .iter()
            .map(|&i| planes[i].normal[axis])
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        high - low
    };
    let widest = (0..3).max_by(|&i, &j| extent(i).total_cmp(&extent(j))).unwrap_or(0);
    order.sort_by(|&i, &j| planes[i].normal[widest].total_cmp(&planes[j].normal[widest]));
    let (left, right) = order.split_at_mut(count / 2);
    divide(planes, left, start, leaves);
    divide(planes, right, start + count / 2, leaves);
}

fn leaf(planes: &[Plane], order: &[usize], start: usize) -> Leaf {
    let middle = order.iter().map(|&i| planes[i].normal).sum::<Vector3<f64>>() / order.len() as f64;
    let spread = order.iter().map(|&i| (planes[i].normal - middle).norm()).fold(0.0, f64::max);
    let least_offset = order.iter().map(|&i| planes[i].offset).fold(f64::INFINITY, f64::min);
    // A few units in the last place for the rounding of the middle.
    Leaf {
        middle,
        spread: spread + 1e-14 * middle.norm().max(spread),
        least_offset,
        planes: start..start + order.len(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_plane_that_is_on_is_left_out() {
        let planes: Vec<Plane> = (0..500)
            .map(|i| {
                let (z, phi) = (1.0 - (2.0 * f64::from(i) + 1.0) / 500.0, f64::from(i) * 2.399963);
                let s = (1.0 - z * z).sqrt();
                Plane { normal: Vector3::new(s * phi.cos(), s * phi.sin(), z), offset: 0.4 + 0.03 * f64::from(i % 5) }
            })
            .collect();
        let (leaves, order) = Leaves::of(&planes);
        let mut fewest = planes.len();
        for p in planes.iter().step_by(7) {
            let y = p.normal * 0.45;
            let mut near = Vec::new();
            let most_left_out = leaves.visit_near(&y, 0.0, |run| near.extend(run.map(|place| order[place])));
            for (i, plane) in planes.iter().enumerate() {
                let excess = plane.normal.dot(&y) - plane.offset;
                assert!(excess <= most_left_out.min(0.0) || near.contains(&i), "plane {i} was left out");
            }
            fewest = fewest.min(near.len());
        }
        assert!(fewest < 150, "{fewest} of 500 planes looked at");
    }
}
