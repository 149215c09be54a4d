//! Derivatives of numbers in both poses, and their way from the axes of an optimum to the world.

use super::answer::{PoseRow, PoseRows};
use super::optimum::Optimum;
use nalgebra::{Matrix2x6, Matrix3, RowVector6, Vector3};
use std::ops::{Add, Mul, Sub};

/// The derivative of a number: in the shift and turn of A, and in those of B.
#[derive(Clone, Copy)]
pub(super) struct Row(pub [Vector3<f64>; 4]);

impl Row {
    pub const ZERO: Self = Self([Vector3::new(0.0, 0.0, 0.0); 4]);

    pub fn pose_row(&self) -> PoseRow {
        PoseRow::from_fn(|_, column| self.0[column / 3][column % 3])
    }
}

impl Add for Row {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self([0, 1, 2, 3].map(|i| self.0[i] + other.0[i]))
    }
}

impl Sub for Row {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self([0, 1, 2, 3].map(|i| self.0[i] - other.0[i]))
    }
}

impl Mul<Row> for f64 {
    type Output = Row;

    fn mul(self, row: Row) -> Row {
        Row(row.0.map(|v| self * v))
    }
}

/// The derivative of a vector from those of its components along axes (columns).
pub(super) fn vector(axes: &Matrix3<f64>, components: &[Row; 3]) -> PoseRows {
    let mut rows = PoseRows::zeros();
    for part in 0..4 {
        let of = |i: usize| axes.column(i) * components[i].0[part].transpose();
        rows.fixed_view_mut::<3, 3>(0, 3 * part).copy_from(&(of(0) + of(1) + of(2)));
    }
    rows
}

/// How an optimum, and the normal there, move with both poses; components along its axes.
pub(super) struct Moved {
    /// Across the normal, and along it.
    pub point: [Row; 3],
    /// Across the normal.
    pub normal: [Row; 2],
    /// The least S over √S: that of s.
    pub value: Row,
}

/// From motions at the optimum in its axes to those of both bodies in the world.
pub(super) struct ToWorld {
    axes: Matrix3<f64>,
    /// From the centres to the optimum.
    branches: [Vector3<f64>; 2],
}

impl ToWorld {
    pub fn of(optimum: &Optimum, branches: [Vector3<f64>; 2]) -> Self {
        Self { axes: optimum.axes, branches }
    }

    /// From the derivative in the motion of A, and in that of both together: in the velocity, and in the turn, world axes.
    fn row(&self, by_a: RowVector6<f64>, together: [Vector3<f64>; 2]) -> Row {
        let velocity = self.axes * by_a.fixed_columns::<3>(0).transpose();
        let turn = self.axes * by_a.fixed_columns::<3>(3).transpose();
        self.of_both([velocity, turn], [together[0] - velocity, together[1] - turn])
    }

    /// A body turned about its centre moves the point as well.
    fn of_both(&self, a: [Vector3<f64>; 2], b: [Vector3<f64>; 2]) -> Row {
        Row([a[0], a[1] + self.branches[0].cross(&a[0]), b[0], b[1] + self.branches[1].cross(&b[0])])
    }

    /// Of a component that a motion of both moves with the bodies along this axis.
    pub fn of_point(&self, by_a: RowVector6<f64>, axis: usize) -> Row {
        self.row(by_a, [self.axes.column(axis).into_owned(), Vector3::zeros()])
    }

    /// Of a component of the normal along this axis.
    fn of_normal(&self, by_a: RowVector6<f64>, axis: usize) -> Row {
        let turn = self.axes.column(2).cross(&self.axes.column(axis));
        self.row(by_a, [Vector3::zeros(), turn])
    }

    /// Of a number that is the same wherever both bodies are, and changes with how far A moves along the normal alone.
    fn of_invariant(&self, by_approach: f64) -> Row {
        let along = by_approach * self.axes.column(2);
        self.of_both([along, Vector3::zeros()], [-along, Vector3::zeros()])
    }
}

impl Moved {
    /// `s` is the root of the least S; also gives the derivatives with A alone, own axes: across the normal of the point, and of the normal.
    pub fn of(optimum: &Optimum, to_world: &ToWorld, s: f64) -> (Self, Matrix2x6<f64>, Matrix2x6<f64>) {
        let by_a = optimum.moved_by(0);
        let normal = optimum.normal_by_a(&by_a);
        let moved = Self {
            point: [0, 1, 2].map(|axis| to_world.of_point(by_a.row(axis).into_owned(), axis)),
            normal: [0, 1].map(|axis| to_world.of_normal(normal.row(axis).into_owned(), axis)),
            value: to_world.of_invariant(-0.5 / s * optimum.of_value() * optimum.weights[0] * optimum.slope(0)),
        };
        (moved, by_a.fixed_rows::<2>(0).into_owned(), normal)
    }
}
