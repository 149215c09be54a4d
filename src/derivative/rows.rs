//! How points, normals and numbers move with both poses, from how they move with A alone.
//!
//! If both bodies move alike, a point and a normal go with them and a number stays: the motion of B is that of both
//! less that of A.

use super::answer::{PoseRow, PoseRows};
use super::field::times;
use super::optimum::{ByMotion, Optimum};
use crate::linalg::number::Single;
use nalgebra::{Matrix3, Vector3};

/// The columns of a matrix.
type Columns = [Vector3<f64>; 3];

/// From motions at the optimum in its axes to those of both bodies in the world.
pub(super) struct ToWorld {
    axes: Matrix3<f64>,
    /// From the centres to the optimum; of a boundary from that of A.
    branches: [Vector3<f64>; 2],
}

/// M [b]×, which takes a turn about a centre to the motion at a point so far from it, and that to M.
#[inline(always)]
fn crossed([x, y, z]: &Columns, b: &Vector3<f64>) -> Columns {
    [y * b.z - z * b.y, z * b.x - x * b.z, x * b.y - y * b.x]
}

impl ToWorld {
    #[inline(always)]
    pub fn of<N: Single>(optimum: &Optimum<N>) -> Self {
        let branch = |i: usize| optimum.places[i].as_ref().map(|place| place.branch.map(N::approximate));
        let of_a = branch(0).unwrap_or_else(Vector3::zeros);
        Self { axes: optimum.axes.map(N::approximate), branches: [of_a, branch(1).unwrap_or(of_a)] }
    }

    pub fn normal(&self) -> Vector3<f64> {
        self.axes.column(2).into_owned()
    }

    /// From the derivative in the motion of A, and from that in motions of both together, world axes. Written out, and
    /// into its place: closures and copies would take longer than the numbers.
    #[inline(always)]
    fn of_both<N: Single>(&self, [x, y, z]: &[ByMotion<N>; 3], together: &[Columns; 2], rows: &mut PoseRows) {
        let q = &self.axes;
        let mut own = [Vector3::zeros(); 5];
        for i in 0..5 {
            own[i] = times(q, &Vector3::new(x[i].approximate(), y[i].approximate(), z[i].approximate()));
        }
        let (mut by_a, mut by_b) = ([Vector3::zeros(); 3], [Vector3::zeros(); 3]);
        for j in 0..3 {
            by_a[j] = own[0] * q[(j, 0)] + own[1] * q[(j, 1)] + own[2] * q[(j, 2)];
            by_b[j] = together[0][j] - by_a[j];
        }
        let (arm_a, arm_b) = (crossed(&by_a, &self.branches[0]), crossed(&by_b, &self.branches[1]));
        let columns = &mut rows.data.0;
        for j in 0..3 {
            let turn = own[3] * q[(j, 0)] + own[4] * q[(j, 1)];
            columns[j] = by_a[j].into();
            columns[3 + j] = (turn - arm_a[j]).into();
            columns[6 + j] = by_b[j].into();
            columns[9 + j] = (together[1][j] - turn - arm_b[j]).into();
        }
    }

    /// Of a point.
    #[inline(always)]
    pub fn of_point<N: Single>(&self, by_a: &[ByMotion<N>; 3], rows: &mut PoseRows) {
        self.of_both(by_a, &[UNIT, ZERO], rows);
    }

    /// Of the normal, whose components across itself move so.
    #[inline(always)]
    pub fn of_normal<N: Single>(&self, [x, y]: &[ByMotion<N>; 2], rows: &mut PoseRows) {
        self.of_both(&[*x, *y, [N::of(0.0); 5]], &[ZERO, crossed(&UNIT, &-self.normal())], rows);
    }

    /// Of a number that is the same wherever both bodies are.
    #[inline(always)]
    pub fn of_number<N: Single>(&self, [x, y, z, on_x, on_y]: &ByMotion<N>, row: &mut PoseRow) {
        let velocity = times(&self.axes, &Vector3::new(x.approximate(), y.approximate(), z.approximate()));
        let turn = times(&self.axes, &Vector3::new(on_x.approximate(), on_y.approximate(), 0.0));
        let turn_a = turn + self.branches[0].cross(&velocity);
        let turn_b = turn + self.branches[1].cross(&velocity);
        for j in 0..3 {
            row[j] = velocity[j];
            row[3 + j] = turn_a[j];
            row[6 + j] = -velocity[j];
            row[9 + j] = -turn_b[j];
        }
    }
}

const ZERO: Columns = [Vector3::new(0.0, 0.0, 0.0); 3];
const UNIT: Columns = [Vector3::new(1.0, 0.0, 0.0), Vector3::new(0.0, 1.0, 0.0), Vector3::new(0.0, 0.0, 1.0)];

/// How an optimum moves with A alone, own axes: the point, across the normal and along it, the normal across itself,
/// and the root of the least S.
pub(super) struct ByA<N> {
    pub point: [ByMotion<N>; 3],
    pub normal: [ByMotion<N>; 2],
    pub s: ByMotion<N>,
}

impl<N: Single> ByA<N> {
    /// `s` is the root of the least S.
    #[inline(always)]
    pub fn of(optimum: &Optimum<N>, s: f64) -> Self {
        let point = optimum.moved_by_a();
        let (zero, slope) = (N::of(0.0), optimum.of_value() * optimum.weights[0] * optimum.slope(0));
        Self { normal: optimum.normal_by_a(&point), point, s: [zero, zero, -slope / N::of(2.0 * s), zero, zero] }
    }
}
