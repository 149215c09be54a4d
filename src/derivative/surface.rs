//! The points at which the line along the normal leaves a body.

use super::answer::DerivativeError;
use super::field::Place;
use nalgebra::{Matrix2x6, Matrix3, RowVector6, Vector3};

/// Most corrections of a surface point that is given to the rounding of its position in the world.
const MOST_CORRECTIONS: usize = 4;

/// A surface point P = x + way·n of a body: S(P) = 1. Components along the axes of the optimum x.
pub(super) struct SurfacePoint<'a> {
    pub place: Place<'a>,
    way: f64,
    /// ∇S at P.
    gradient: Vector3<f64>,
}

impl<'a> SurfacePoint<'a> {
    /// Of a body at an optimum, near a guess.
    pub fn new(place: &Place<'a>, axes: &Matrix3<f64>, guess: f64) -> Result<Self, DerivativeError> {
        let normal = axes.column(2);
        let (mut way, rounding) = (guess, 4.0 * f64::EPSILON * (place.branch.norm() + guess.abs()));
        for _ in 0..MOST_CORRECTIONS {
            let place = place.moved(&(way * normal));
            let (value, gradient) = place.tangent();
            let gradient = axes.tr_mul(&gradient);
            let correction = (1.0 - value) / gradient.z;
            if !correction.is_finite() {
                return Err(DerivativeError::NoGradient);
            }
            if correction.abs() <= rounding {
                return Ok(Self { place, way, gradient });
            }
            way += correction;
        }
        let place = place.moved(&(way * normal));
        let (_, gradient) = place.tangent();
        Ok(Self { place, way, gradient: axes.tr_mul(&gradient) })
    }

    /// Signed distance from the optimum, along the normal.
    pub fn way(&self) -> f64 {
        self.way
    }

    /// ∇S there.
    pub fn gradient(&self) -> Vector3<f64> {
        self.gradient
    }

    /// How it moves along the normal with A, where optimum and normal move so across it.
    pub fn along_normal(&self, point: &Matrix2x6<f64>, normal: &Matrix2x6<f64>, is_of_a: bool) -> RowVector6<f64> {
        let mut across = point + normal * self.way;
        let mut along = RowVector6::zeros();
        if is_of_a {
            // Beside what the body moves by itself at P, v + ω × way·n.
            along[2] = 1.0;
            (across[(0, 0)], across[(1, 1)]) = (across[(0, 0)] - 1.0, across[(1, 1)] - 1.0);
            (across[(0, 4)], across[(1, 3)]) = (across[(0, 4)] - self.way, across[(1, 3)] + self.way);
        }
        along - self.gradient.xy().transpose() * across / self.gradient.z
    }

    /// Weights on the optimum and on the normal, and σ on S at P, that a weight on P comes to.
    pub fn pulled_back(&self, weight: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>, f64) {
        let along = weight.z / self.gradient.z;
        let across = weight.xy() - along * self.gradient.xy();
        let point = Vector3::new(across.x, across.y, 0.0);
        (point, self.way * point, -along)
    }
}
