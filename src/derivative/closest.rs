//! The contact of closest: two optima, P1 on A and P2 on B.

use super::answer::{ContactDerivatives, ContactWeights, DerivativeError};
use super::field::Place;
use super::midway::{NO_ROW, NO_ROWS};
use super::optimum::{FieldWeights, Kind, Optimum};
use super::rows::{Moved, Row, ToWorld, vector};
use nalgebra::Vector3;

/// P1 and P2.
pub(super) struct ClosestPoints<'a> {
    optima: [Optimum<'a>; 2],
    /// s_B at P1 and s_A at P2.
    scales: [f64; 2],
    /// The sum of both normals, unit vectors: the normal of the contact at another length.
    sum_of_normals: Vector3<f64>,
    /// Unit vector from P2 to P1.
    across: Vector3<f64>,
    weight_on_a: f64,
    is_overlap: bool,
}

/// The normal at an optimum, from both gradients there.
fn normal_at(places: &[Place; 2]) -> Result<Vector3<f64>, DerivativeError> {
    let [of_a, of_b] = places.each_ref().map(|place| place.tangent().1.normalize());
    (of_a - of_b).try_normalize(0.0).filter(|n| n.iter().all(|c| c.is_finite())).ok_or(DerivativeError::NoGradient)
}

impl<'a> ClosestPoints<'a> {
    /// From both bodies at P1, and at P2.
    pub fn new(
        places: [[Place<'a>; 2]; 2],
        scales: [f64; 2],
        weight_on_a: f64,
        is_overlap: bool,
    ) -> Result<Self, DerivativeError> {
        let optimum = |kind, places: &[Place<'a>; 2]| Optimum::new(kind, places.map(Some), &normal_at(places)?, None);
        let optima = [optimum(Kind::OnA, &places[0])?, optimum(Kind::OnB, &places[1])?];
        let sum_of_normals = optima[0].axes.column(2) + optima[1].axes.column(2);
        let way = places[0][1].branch - places[1][1].branch;
        let across = way.try_normalize(0.0).unwrap_or_else(|| sum_of_normals.normalize());
        Ok(Self { optima, scales, sum_of_normals, across, weight_on_a, is_overlap })
    }

    pub fn derivatives(&self) -> ContactDerivatives {
        let moved = [0, 1].map(|i| {
            let optimum = &self.optima[i];
            let branches = optimum.places.each_ref().map(|place| place.as_ref().map_or_else(Vector3::zeros, |p| p.branch));
            Moved::of(optimum, &ToWorld::of(optimum, branches), self.scales[i]).0
        });
        let [p1, p2] = [0, 1].map(|i| vector(&self.optima[i].axes, &moved[i].point));
        let normals = [0, 1].map(|i| {
            let [x, y] = moved[i].normal;
            vector(&self.optima[i].axes, &[x, y, Row::ZERO])
        });
        let (turned, length) = (normals[0] + normals[1], self.sum_of_normals.norm());
        let normal = self.sum_of_normals / length;
        let mut flags = self.optima[0].flags;
        flags.set(self.optima[1].flags, true);
        let derivatives = ContactDerivatives {
            s: moved[1].value.pose_row(),
            s_b: moved[0].value.pose_row(),
            overlap: NO_ROW,
            normal: (turned - normal * normal.tr_mul(&turned)) / length,
            point: p2 + (p1 - p2) * self.weight_on_a,
            point_on_a: NO_ROWS,
            point_on_b: NO_ROWS,
            flags,
        };
        if !self.is_overlap {
            return derivatives;
        }
        ContactDerivatives {
            overlap: self.across.tr_mul(&(p1 - p2)),
            point_on_a: p1,
            point_on_b: p2,
            ..derivatives
        }
    }

    /// The optima with the weights on the potentials there.
    pub fn pulled_back(&self, weights: &ContactWeights) -> [(&Optimum<'a>, [FieldWeights; 2]); 2] {
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
            let own = |v: &Vector3<f64>| optimum.axes.tr_mul(v);
            let mut fields = optimum.pulled_back(&own(&on_points[i]), &own(&on_normal));
            let of_value = 0.5 * on_scales[i] / self.scales[i] * optimum.of_value();
            (0..2).for_each(|body| fields[body].sigma += of_value * optimum.weights[body]);
            (optimum, fields)
        })
    }
}
