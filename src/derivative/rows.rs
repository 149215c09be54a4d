//! Derivatives of numbers in both poses, and their way from the axes of an optimum to the world.

use super::answer::{PoseRow, PoseRows};
use super::field::times;
use super::optimum::{ByMotion, Optimum};
use crate::linalg::number::Single;
use nalgebra::{Matrix3, Vector3};
use std::ops::{Add, Mul, Sub};

/// The derivative of a number: in the shift and turn of A, and in those of B.
#[derive(Clone, Copy)]
pub(super) struct Row<N>(pub [Vector3<N>; 4]);

impl<N: Single> Row<N> {
    pub fn zero() -> Self {
        Self([Vector3::zeros(); 4])
    }

    #[inline(always)]
    pub fn pose_row(&self) -> PoseRow {
        PoseRow::from_fn(|_, column| self.0[column / 3][column % 3].approximate())
    }
}

impl<N: Single> Add for Row<N> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self([0, 1, 2, 3].map(|i| self.0[i] + other.0[i]))
    }
}

impl<N: Single> Sub for Row<N> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self([0, 1, 2, 3].map(|i| self.0[i] - other.0[i]))
    }
}

impl<N: Single> Mul<N> for Row<N> {
    type Output = Self;

    fn mul(self, factor: N) -> Self {
        Self(self.0.map(|v| v * factor))
    }
}

/// The derivative of a vector from those of its components along axes (columns).
#[inline(always)]
pub(super) fn vector<N: Single>(axes: &Matrix3<N>, components: &[Row<N>; 3]) -> PoseRows {
    let axes = axes.map(N::approximate);
    let [x, y, z] = components.each_ref().map(Row::pose_row);
    let mut rows = PoseRows::zeros();
    for column in 0..12 {
        for i in 0..3 {
            rows[(i, column)] = axes[(i, 0)] * x[column] + axes[(i, 1)] * y[column] + axes[(i, 2)] * z[column];
        }
    }
    rows
}

/// The derivative of a vector along an axis from that of its length.
#[inline(always)]
pub(super) fn along(axis: &Vector3<f64>, row: &PoseRow) -> PoseRows {
    let mut rows = PoseRows::zeros();
    for column in 0..12 {
        (0..3).for_each(|i| rows[(i, column)] = axis[i] * row[column]);
    }
    rows
}

/// How an optimum, and the normal there, move with both poses; components along its axes.
pub(super) struct Moved<N> {
    /// Across the normal, and along it.
    pub point: [Row<N>; 3],
    /// Across the normal.
    pub normal: [Row<N>; 2],
    /// Of the root of the least S.
    pub s: Row<N>,
}

/// From motions at the optimum in its axes to those of both bodies in the world.
pub(super) struct ToWorld<N> {
    axes: Matrix3<N>,
    /// From the centres to the optimum; of a boundary from that of A.
    branches: [Vector3<N>; 2],
}

impl<N: Single> ToWorld<N> {
    #[inline(always)]
    pub fn of(optimum: &Optimum<N>) -> Self {
        let of_a = optimum.places[0].as_ref().map_or_else(Vector3::zeros, |place| place.branch);
        let of_b = optimum.places[1].as_ref().map_or(of_a, |place| place.branch);
        Self { axes: optimum.axes, branches: [of_a, of_b] }
    }

    /// From the derivative in the motion of A, and that of both together: in the velocity, and in the turn, world axes.
    #[inline(always)]
    fn row(&self, by_a: ByMotion<N>, together: [Vector3<N>; 2]) -> Row<N> {
        let [vx, vy, vz, tx, ty, tz] = by_a;
        let (velocity, turn) =
            (times(&self.axes, &Vector3::new(vx, vy, vz)), times(&self.axes, &Vector3::new(tx, ty, tz)));
        self.of_both([velocity, turn], [together[0] - velocity, together[1] - turn])
    }

    /// A body turned about its centre moves the point as well.
    #[inline(always)]
    fn of_both(&self, a: [Vector3<N>; 2], b: [Vector3<N>; 2]) -> Row<N> {
        Row([a[0], a[1] + self.branches[0].cross(&a[0]), b[0], b[1] + self.branches[1].cross(&b[0])])
    }

    /// Of a component that a motion of both moves with the bodies along this axis.
    #[inline(always)]
    pub fn of_point(&self, by_a: ByMotion<N>, axis: usize) -> Row<N> {
        self.row(by_a, [self.axes.column(axis).into_owned(), Vector3::zeros()])
    }

    /// Of a component of the normal along this axis.
    #[inline(always)]
    fn of_normal(&self, by_a: ByMotion<N>, axis: usize) -> Row<N> {
        let turn = self.axes.column(2).cross(&self.axes.column(axis));
        self.row(by_a, [Vector3::zeros(), turn])
    }

    /// Of a number that is the same wherever both bodies are, and changes with how far A moves along the normal alone.
    #[inline(always)]
    fn of_invariant(&self, by_approach: N) -> Row<N> {
        let along = self.axes.column(2) * by_approach;
        self.of_both([along, Vector3::zeros()], [-along, Vector3::zeros()])
    }
}

impl<N: Single> Moved<N> {
    /// `s` is the root of the least S. Also gives how the point moves across the normal, and the normal, with A alone: own axes.
    #[inline(always)]
    pub fn of(optimum: &Optimum<N>, to_world: &ToWorld<N>, s: f64) -> (Self, [[ByMotion<N>; 2]; 2]) {
        let by_a = optimum.moved_by_a();
        let normal = optimum.normal_by_a(&by_a);
        let slope = -optimum.of_value() * optimum.weights[0] * optimum.slope(0) / N::of(2.0 * s);
        let moved = Self {
            point: [0, 1, 2].map(|axis| to_world.of_point(by_a[axis], axis)),
            normal: [0, 1].map(|axis| to_world.of_normal(normal[axis], axis)),
            s: to_world.of_invariant(slope),
        };
        (moved, [[by_a[0], by_a[1]], normal])
    }
}
