//! The contact of midway, and that of a boundary: one optimum, and the surfaces along the normal from there.

use super::answer::{ContactDerivatives, ContactWeights, PoseRow, PoseRows};
use super::optimum::{FieldWeights, Optimum};
use super::rows::{Moved, Row, ToWorld, along, vector};
use super::surface::SurfacePoint;
use crate::linalg::number::Single;
use nalgebra::{ArrayStorage, Vector3};

/// A contact along the normal from its optimum.
pub(super) struct AlongNormal<'a, N: Single = f64> {
    pub optimum: Optimum<'a, N>,
    pub s: f64,
    /// Of A and of B; a boundary has none. `None` where they are separated.
    pub surfaces: Option<(SurfacePoint<'a, N>, Option<SurfacePoint<'a, N>>)>,
}

/// Of what does not apply.
pub(super) const NO_ROW: PoseRow = PoseRow::from_array_storage(ArrayStorage([[f64::NAN]; 12]));
pub(super) const NO_ROWS: PoseRows = PoseRows::from_array_storage(ArrayStorage([[f64::NAN; 3]; 12]));

impl<N: Single> AlongNormal<'_, N> {
    #[inline(always)]
    pub fn in_poses(&self) -> ContactDerivatives {
        let axes = &self.optimum.axes;
        let to_world = ToWorld::of(&self.optimum);
        let (moved, [point, normal]) = Moved::of(&self.optimum, &to_world, self.s);
        let across = |rows: &[Row<N>; 2]| vector(axes, &[rows[0], rows[1], Row::zero()]);
        let along = |row: &Row<N>| along(&axes.column(2).map(N::approximate), &row.pose_row());
        let [x, y, z] = moved.point;
        let (point_across, turned) = (across(&[x, y]), across(&moved.normal));
        let at_optimum = point_across + along(&z);
        let is_boundary = self.optimum.places[1].is_none();
        let mut derivatives = ContactDerivatives {
            s: moved.s.pose_row(),
            s_b: NO_ROW,
            overlap: NO_ROW,
            normal: turned,
            point: at_optimum,
            point_on_a: NO_ROWS,
            point_on_b: if is_boundary { at_optimum } else { NO_ROWS },
            flags: self.optimum.flags,
        };
        let Some((on_a, on_b)) = &self.surfaces else { return derivatives };
        let on_surface = |surface: &SurfacePoint<N>, is_of_a: bool| {
            let row = to_world.of_point(surface.along_normal(&point, &normal, is_of_a), 2);
            (point_across + turned * surface.way().approximate() + along(&row), row)
        };
        let (point_on_a, along_a) = on_surface(on_a, true);
        let mut along_b = z;
        derivatives.point_on_a = point_on_a;
        match on_b {
            Some(on_b) => (derivatives.point_on_b, along_b) = on_surface(on_b, false),
            None => derivatives.point = 0.5 * (point_on_a + at_optimum),
        }
        derivatives.overlap = (along_a - along_b).pose_row();
        derivatives
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
