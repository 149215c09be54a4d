//! Planes in a tree of clusters of similar normals, so that most planes of a many-faced particle are never evaluated.
//!
//! Every excess n_i·y − d_i of a cluster is at most m·y + ρ|y| − d, with m the mean of its normals, ρ their largest
//! distance from it and d its least offset. Where that bound is negative, no plane of the cluster is active.

use super::numbers::{Limits, MARGIN};
use crate::particle::plane::Plane;
use nalgebra::Vector3;
use std::ops::Range;

/// A run of consecutive planes with similar normals.
#[derive(Clone, Debug)]
struct Cluster {
    mean: Vector3<f64>,
    /// Largest distance of a normal from the mean, enlarged by [`MARGIN`].
    spread: f64,
    least_offset: f64,
    planes: Range<usize>,
    /// The first cluster after this one that holds none of its planes; the one right after it, if this one is not
    /// divided.
    next: usize,
}

/// The clusters of a particle, which keeps its planes in their order: each before the two halves it is divided into.
#[derive(Clone, Debug, Default)]
pub(crate) struct PlaneClusters(Box<[Cluster]>);

impl PlaneClusters {
    /// The clusters, and for each place in the new order the index of the given plane.
    pub fn of(planes: &[Plane]) -> (Self, Box<[usize]>) {
        let mut order: Vec<usize> = (0..planes.len()).collect();
        let mut clusters = Vec::new();
        divide(planes, &mut order, 0, &mut clusters);
        (Self(clusters.into()), order.into())
    }

    /// No cluster, and the order as given: for planes without weight, which are never visited.
    pub fn none(count: usize) -> (Self, Box<[usize]>) {
        (Self::default(), (0..count).collect())
    }

    /// Whether there is at most one cluster, whose planes are visited without a bound.
    pub fn is_single(&self) -> bool {
        self.0.len() <= 1
    }

    /// Where to begin: all planes together are never left out.
    fn first(&self) -> usize {
        usize::from(!self.is_single())
    }

    /// Calls `visit` with runs of planes that may have an excess above −`early`. Returns an upper bound on the excess
    /// of all other planes.
    #[inline(always)]
    pub fn visit_near(&self, y: &Vector3<f64>, early: f64, mut visit: impl FnMut(Range<usize>)) -> f64 {
        let single = self.is_single();
        let length = if single { 0.0 } else { y.norm() * (1.0 + MARGIN) };
        let mut most_left_out = f64::NEG_INFINITY;
        let mut i = self.first();
        while let Some(cluster) = self.0.get(i) {
            let bound = if single { f64::INFINITY } else { cluster.bound(y, length) };
            if bound > -early {
                i += 1;
                if single || i == cluster.next {
                    visit(cluster.planes.clone());
                }
            } else {
                most_left_out = bound.max(most_left_out);
                i = cluster.next;
            }
        }
        most_left_out
    }

    /// The largest of the numbers that `largest_of` returns for runs of planes, each with its plane; runs whose bound
    /// does not exceed the largest so far are left out.
    pub fn largest(&self, y: &Vector3<f64>, mut largest_of: impl FnMut(Range<usize>) -> (f64, usize)) -> (f64, usize) {
        if let [all] = &self.0[..] {
            return largest_of(all.planes.clone());
        }
        let length = y.norm() * (1.0 + MARGIN);
        let likely = self.likely(y, length);
        let mut largest = (f64::NEG_INFINITY, 0);
        if let Some(cluster) = self.0.get(likely) {
            largest = largest_of(cluster.planes.clone());
        }
        let mut i = self.first();
        while let Some(cluster) = self.0.get(i) {
            let beyond = i != likely && cluster.bound(y, length) > largest.0;
            if beyond && i + 1 == cluster.next {
                let found = largest_of(cluster.planes.clone());
                if found.0 > largest.0 {
                    largest = found;
                }
            }
            i = if beyond { i + 1 } else { cluster.next };
        }
        largest
    }

    /// The planes of the undivided cluster to which the larger bounds lead.
    pub fn most_likely(&self, y: &Vector3<f64>) -> Range<usize> {
        self.0.get(self.likely(y, y.norm())).map_or(0..0, |cluster| cluster.planes.clone())
    }

    /// That cluster.
    fn likely(&self, y: &Vector3<f64>, length: f64) -> usize {
        let mut i = 0;
        while self.0.get(i).is_some_and(|cluster| i + 1 < cluster.next) {
            let (left, right) = (i + 1, self.0[i + 1].next);
            i = if self.0[left].bound(y, length) > self.0[right].bound(y, length) { left } else { right };
        }
        i
    }
}

impl Cluster {
    /// Of the planes `order`, which take the places from `start` on, not divided.
    fn of(planes: &[Plane], order: &[usize], start: usize, at: usize) -> Self {
        let mean = order.iter().map(|&i| planes[i].normal).sum::<Vector3<f64>>() / order.len() as f64;
        let spread = order.iter().map(|&i| (planes[i].normal - mean).norm()).fold(0.0, f64::max);
        let least_offset = order.iter().map(|&i| planes[i].offset).fold(f64::INFINITY, f64::min);
        Self {
            mean,
            spread: spread + MARGIN * mean.norm().max(spread),
            least_offset,
            planes: start..start + order.len(),
            next: at + 1,
        }
    }

    fn bound(&self, y: &Vector3<f64>, length: f64) -> f64 {
        self.mean.dot(y) + self.spread * length - self.least_offset
    }
}

/// Halves a run of planes along the axis on which their normals differ most, until the halves are small.
fn divide(planes: &[Plane], order: &mut [usize], start: usize, clusters: &mut Vec<Cluster>) {
    let (count, at) = (order.len(), clusters.len());
    if count == 0 {
        return;
    }
    clusters.push(Cluster::of(planes, order, start, at));
    if count <= Limits::CLUSTER {
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
    divide(planes, left, start, clusters);
    divide(planes, right, start + count / 2, clusters);
    clusters[at].next = clusters.len();
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Planes all around, at distances that differ, some with long normals.
    fn scattered() -> Vec<Plane> {
        let plane = |i: i32| {
            let (z, phi) = (1.0 - (2.0 * f64::from(i) + 1.0) / 500.0, f64::from(i) * 2.399963);
            let s = (1.0 - z * z).sqrt();
            let length = if i % 50 == 0 { 3.0 } else { 1.0 };
            let normal = length * Vector3::new(s * phi.cos(), s * phi.sin(), z);
            Plane { normal, offset: length * (0.4 + 0.03 * f64::from(i % 5)) }
        };
        (0..500).map(plane).collect()
    }

    fn excess(plane: &Plane, y: &Vector3<f64>) -> f64 {
        plane.normal.dot(y) - plane.offset
    }

    #[test]
    fn no_active_plane_is_left_out() {
        let planes = scattered();
        let (clusters, order) = PlaneClusters::of(&planes);
        let mut fewest = planes.len();
        for p in planes.iter().step_by(7) {
            let y = p.normal.normalize() * 0.45;
            let mut near = Vec::new();
            let most_left_out = clusters.visit_near(&y, 0.0, |run| near.extend(run.map(|place| order[place])));
            for (i, plane) in planes.iter().enumerate() {
                let excess = excess(plane, &y);
                assert!(excess <= most_left_out.min(0.0) || near.contains(&i), "plane {i} was left out");
            }
            fewest = fewest.min(near.len());
        }
        assert!(fewest < 150, "{fewest} of 500 planes visited");
    }

    #[test]
    fn the_largest_excess_is_that_of_all_planes() {
        let planes = scattered();
        let (clusters, order) = PlaneClusters::of(&planes);
        let mut looked_at = 0;
        for p in planes.iter().step_by(7) {
            for way in [-0.2, 0.1, 0.45, 3.0] {
                let y = way * p.normal;
                let of = |place: usize| (excess(&planes[order[place]], &y), place);
                let (most, place) = clusters.largest(&y, |run| {
                    looked_at += run.len();
                    run.map(of).max_by(|a, b| a.0.total_cmp(&b.0)).expect("no run is empty")
                });
                let all = planes.iter().map(|plane| excess(plane, &y)).fold(f64::NEG_INFINITY, f64::max);
                assert_eq!((most, excess(&planes[order[place]], &y)), (all, all));
            }
        }
        let asked = planes.len().div_ceil(7) * 4;
        assert!(looked_at < 100 * asked, "{} of 500 planes at a time", looked_at / asked);
    }
}
