//! Poses of the plane: a shift and a turn about z.

use crate::linalg::sine_and_cosine::LARGEST;
use crate::pose;
use nalgebra::{Matrix2, Vector2};
use thiserror::Error;

/// Why numbers do not make a pose of the plane.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum PoseError {
    /// A position (x, y) that is not finite.
    #[error("position ({0:?}, {1:?}) is not finite")]
    Position(f64, f64),
    /// An angle that is not finite, or beyond 2³⁰ radians.
    #[error(
        "angle {0:?} is not finite or beyond 2^30 = 1073741824: give it in radians, anticlockwise, less whole turns"
    )]
    Angle(f64),
}

/// Where a body is: world = rotation · local + position (paper eqs 7, 8).
///
/// ```
/// use potential_particles::planar::Pose;
/// let pose = Pose::new([1.0, 2.0], std::f64::consts::FRAC_PI_2)?;
/// let world = pose.rotate(&[1.0, 0.0].into()) + pose.position();
/// assert!((world - nalgebra::Vector2::new(1.0, 3.0)).norm() < 1e-15);
/// # Ok::<(), potential_particles::planar::PoseError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    position: Vector2<f64>,
    rotation: Matrix2<f64>,
    in_space: pose::Pose,
}

impl Pose {
    /// From a position and the paper's angle θ: radians, anticlockwise, local to world, from −2³⁰ to 2³⁰. It counts as
    /// exact.
    ///
    /// # Errors
    /// A position or angle that is not finite, or an angle beyond that range.
    pub fn new(position: [f64; 2], angle: f64) -> Result<Self, PoseError> {
        let [x, y] = position;
        if !(x.is_finite() && y.is_finite()) {
            return Err(PoseError::Position(x, y));
        }
        if !(-LARGEST..=LARGEST).contains(&angle) {
            return Err(PoseError::Angle(angle));
        }
        let in_space = pose::Pose::about_z([x, y, 0.0], angle);
        let rotation = in_space.rotation().fixed_view::<2, 2>(0, 0).into();
        Ok(Self { position: position.into(), rotation, in_space })
    }

    /// Centre of the particle, world frame.
    pub fn position(&self) -> &Vector2<f64> {
        &self.position
    }

    /// Local to world.
    pub fn rotation(&self) -> &Matrix2<f64> {
        &self.rotation
    }

    /// World point to local point.
    pub fn to_local(&self, world: &Vector2<f64>) -> Vector2<f64> {
        self.rotation.tr_mul(&(world - self.position))
    }

    /// Local direction to world direction.
    pub fn rotate(&self, local: &Vector2<f64>) -> Vector2<f64> {
        self.rotation * local
    }

    pub(crate) fn in_space(&self) -> pose::Pose {
        self.in_space
    }
}
