//! The contact of midway, and that of a boundary: one optimum, and the surfaces along the normal from there.

use super::answer::{ContactDerivatives, ContactWeights, NO_ROW, PoseRows};
use super::optimum::{ByMotion, FieldWeights, Optimum};
use super::rows::{ByA, ToWorld};
use super::surface::SurfacePoint;
use crate::linalg::number::Single;
use nalgebra::Vector3;

/// A contact along the normal from its optimum.
pub(super) struct AlongNormal<'a, N: Single = f64> {
    pub optimum: Optimum<'a, N>,
    pub s: f64,
    /// Of A and of B; a boundary has none. `None` where they are separated.
    pub surfaces: Option<(SurfacePoint<'a, N>, Option<SurfacePoint<'a, N>>)>,
}

impl<N: Single> AlongNormal<'_, N> {
    /// Written to its place, which holds what does not apply.
    #[inline(always)]
    pub fn in_poses(&self, to: &mut ContactDerivatives) {
        let to_world = ToWorld::of(&self.optimum);
        let by_a = ByA::of(&self.optimum, self.s);
        to_world.of_number(&by_a.s, &mut to.s);
        to_world.of_point(&by_a.point, &mut to.point);
        to_world.of_normal(&by_a.normal, &mut to.normal);
        to.flags = self.optimum.flags;
        if self.optimum.places[1].is_none() {
            to.point_on_b = to.point;
        }
        let Some((on_a, on_b)) = &self.surfaces else { return };
        let normal = to_world.normal();
        // From the optimum along the normal, as far as the way there is.
        let on_surface =
            |surface: &SurfacePoint<N>, by_a: &ByMotion<N>, [point, turned]: [&PoseRows; 2], to: &mut PoseRows| {
                let (length, mut way) = (surface.way().approximate(), NO_ROW);
                to_world.of_number(by_a, &mut way);
                for j in 0..12 {
                    for i in 0..3 {
                        to[(i, j)] = point[(i, j)] + length * turned[(i, j)] + normal[i] * way[j];
                    }
                }
            };
        let mut way = on_a.way_by_a(&by_a, true);
        on_surface(on_a, &way, [&to.point, &to.normal], &mut to.point_on_a);
        match on_b {
            Some(on_b) => {
                let way_b = on_b.way_by_a(&by_a, false);
                on_surface(on_b, &way_b, [&to.point, &to.normal], &mut to.point_on_b);
                (0..5).for_each(|column| way[column] -= way_b[column]);
            }
            None => to.point = 0.5 * (to.point_on_a + to.point),
        }
        to_world.of_number(&way, &mut to.overlap);
    }

    /// The weights on the potentials at the optimum, and on S at both surface points.
    pub fn pulled_back(&self, weights: &ContactWeights) -> ([FieldWeights<N>; 2], [N; 2]) {
        let own = |v: &Vector3<f64>| self.optimum.axes.tr_mul(&v.map(N::of));
        let (mut point, mut normal) = (own(&weights.point), own(&weights.normal));
        let (mut on_a, mut on_b) = (own(&weights.point_on_a), own(&weights.point_on_b));
        on_a.z += N::of(weights.overlap);
        on_b.z -= N::of(weights.overlap);
        let mut sigmas = [N::of(0.0); 2];
        let mut add = |i: usize, surface: &SurfacePoint<N>, weight: &Vector3<N>, point: &mut Vector3<N>| {
            let (of_point, of_normal, sigma) = surface.pulled_back(weight);
            *point += of_point;
            normal += of_normal;
            sigmas[i] = sigma;
        };
        match &self.surfaces {
            Some((surface_a, Some(surface_b))) => {
                add(0, surface_a, &on_a, &mut point);
                add(1, surface_b, &on_b, &mut point);
            }
            // The contact point is half way between the boundary and the surface.
            Some((surface_a, None)) => {
                point *= N::of(0.5);
                on_a += point;
                add(0, surface_a, &on_a, &mut point);
                point += on_b;
            }
            None if self.optimum.places[1].is_none() => point += own(&weights.point_on_b),
            None => {}
        }
        let mut fields = self.optimum.pulled_back(&point, &normal);
        let of_value = N::of(weights.s) * self.optimum.of_value() / N::of(2.0 * self.s);
        (0..2).for_each(|i| fields[i].sigma += of_value * self.optimum.weights[i]);
        (fields, sigmas)
    }
}
