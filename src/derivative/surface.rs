//! The points at which the line along the normal leaves a body.

use super::answer::DerivativeError;
use super::field::Place;
use super::numbers::Limits;
use super::optimum::ByMotion;
use super::rows::ByA;
use crate::linalg::number::Single;
use nalgebra::{Matrix3, Vector3};

/// A surface point P = x + way·n of a body: S(P) = 1. Components along the axes of the optimum x.
pub(super) struct SurfacePoint<'a, N: Single = f64> {
    pub place: Place<'a, N>,
    way: N,
    /// ∇S at P.
    gradient: Vector3<N>,
}

impl<'a, N: Single> SurfacePoint<'a, N> {
    /// Of a body at an optimum, near a guess.
    #[inline(always)]
    pub fn new(at_optimum: Place<'a, N>, axes: &Matrix3<N>, guess: f64) -> Result<Self, DerivativeError> {
        let normal = axes.column(2).into_owned();
        let mut way = N::of(guess);
        let rounding = 8.0 * N::UNIT * (at_optimum.branch.map(N::approximate).norm() + guess.abs());
        let mut corrections = 0;
        loop {
            let place = at_optimum.moved(&(normal * way));
            let (value, gradient) = place.tangent();
            let gradient = axes.tr_mul(&gradient);
            let correction = (N::of(1.0) - value) / gradient.z;
            if !correction.is_finite() {
                return Err(DerivativeError::NoGradient);
            }
            if correction.approximate().abs() <= rounding || corrections == Limits::CORRECTIONS {
                return Ok(Self { place, way, gradient });
            }
            way += correction;
            corrections += 1;
        }
    }

    /// Signed distance from the optimum, along the normal.
    pub fn way(&self) -> N {
        self.way
    }

    /// ∇S there.
    pub fn gradient(&self) -> Vector3<N> {
        self.gradient
    }

    /// How the way there changes with A, where optimum and normal move so.
    #[inline(always)]
    pub fn way_by_a(&self, ByA { point, normal, .. }: &ByA<N>, is_of_a: bool) -> ByMotion<N> {
        let mut across = [0, 1]
            .map(|i| -> ByMotion<N> { std::array::from_fn(|column| point[i][column] + normal[i][column] * self.way) });
        let one = N::of(1.0);
        let mut along = point[2].map(|z| -z);
        if is_of_a {
            // Beside what the body moves by itself at P, v + ω × way·n.
            along[2] += one;
            across[0][0] -= one;
            across[1][1] -= one;
            across[0][4] -= self.way;
            across[1][3] += self.way;
        }
        let [x, y] = [self.gradient.x / self.gradient.z, self.gradient.y / self.gradient.z];
        std::array::from_fn(|column| along[column] - (x * across[0][column] + y * across[1][column]))
    }

    /// Weights on the optimum and on the normal, and σ on S at P, that a weight on P comes to.
    pub fn pulled_back(&self, weight: &Vector3<N>) -> (Vector3<N>, Vector3<N>, N) {
        let along = weight.z / self.gradient.z;
        let across = weight.xy() - self.gradient.xy() * along;
        let point = Vector3::new(across.x, across.y, N::of(0.0));
        (point, point * self.way, -along)
    }
}
