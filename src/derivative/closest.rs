//! The contact of closest: two optima, P1 on A and P2 on B.

use super::answer::{ContactDerivatives, ContactWeights, PoseRows};
use super::optimum::{FieldWeights, Optimum, unit};
use super::rows::{ByA, ToWorld};
use crate::linalg::number::Single;
use nalgebra::Vector3;

/// P1 and P2.
pub(super) struct ClosestPoints<'a, N: Single = f64> {
    pub optima: [Optimum<'a, N>; 2],
    /// s_B at P1 and s_A at P2.
    scales: [f64; 2],
    /// The sum of both normals, unit vectors: the normal of the contact at another length.
    sum_of_normals: Vector3<f64>,
    /// Unit vector from P2 to P1.
    across: Vector3<f64>,
    weight_on_a: f64,
    is_overlap: bool,
}

impl<'a, N: Single> ClosestPoints<'a, N> {
    pub fn new(optima: [Optimum<'a, N>; 2], scales: [f64; 2], weight_on_a: f64, is_overlap: bool) -> Self {
        let double = |v: Vector3<N>| v.map(N::approximate);
        let normals = optima.each_ref().map(|optimum| double(optimum.axes.column(2).into_owned()));
        let branch = |i: usize| optima[i].places[0].as_ref().map_or_else(Vector3::zeros, |place| place.branch);
        let way = branch(0) - branch(1);
        let sum_of_normals = normals[0] + normals[1];
        // Where both points meet it is the normal.
        let across = if double(way).amax() > 0.0 { double(unit(&way)) } else { sum_of_normals.normalize() };
        Self { optima, scales, sum_of_normals, across, weight_on_a, is_overlap }
    }

    /// Written to its place, which holds what does not apply.
    pub fn in_poses(&self, to: &mut ContactDerivatives) {
        let [mut p1, mut p2, mut turned_2] = [PoseRows::zeros(); 3];
        let scales = [&mut to.s_b, &mut to.s];
        let places = [(&mut p1, &mut to.normal), (&mut p2, &mut turned_2)];
        for (i, ((point, normal), scale)) in places.into_iter().zip(scales).enumerate() {
            let optimum = &self.optima[i];
            let (to_world, by_a) = (ToWorld::of(optimum), ByA::of(optimum, self.scales[i]));
            to_world.of_number(&by_a.s, scale);
            to_world.of_point(&by_a.point, point);
            to_world.of_normal(&by_a.normal, normal);
            to.flags.set(optimum.flags, true);
        }
        let length = self.sum_of_normals.norm();
        let normal = self.sum_of_normals / length;
        let apart = p1 - p2;
        for j in 0..12 {
            let turned = to.normal.column(j) + turned_2.column(j);
            to.normal.set_column(j, &((turned - normal * normal.dot(&turned)) / length));
        }
        to.point = p2 + apart * self.weight_on_a;
        if self.is_overlap {
            (0..12).for_each(|j| to.overlap[j] = self.across.dot(&apart.column(j)));
            (to.point_on_a, to.point_on_b) = (p1, p2);
        }
    }

    /// The optima with the weights on the potentials there.
    pub fn pulled_back(&self, weights: &ContactWeights) -> [(&Optimum<'a, N>, [FieldWeights<N>; 2]); 2] {
        let length = self.sum_of_normals.norm();
        let normal = self.sum_of_normals / length;
        let on_normal = (weights.normal - normal * normal.dot(&weights.normal)) / length;
        let apart = weights.overlap * self.across;
        let on_points = [
            weights.point_on_a + apart + weights.point * self.weight_on_a,
            weights.point_on_b - apart + weights.point * (1.0 - self.weight_on_a),
        ];
        let on_scales = [weights.s_b, weights.s];
        [0, 1].map(|i| {
            let optimum = &self.optima[i];
            let own = |v: &Vector3<f64>| optimum.axes.tr_mul(&v.map(N::of));
            let mut fields = optimum.pulled_back(&own(&on_points[i]), &own(&on_normal));
            let of_value = N::of(on_scales[i]) * optimum.of_value() / N::of(2.0 * self.scales[i]);
            (0..2).for_each(|body| fields[body].sigma += of_value * optimum.weights[body]);
            (optimum, fields)
        })
    }
}
