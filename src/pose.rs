//! Rigid poses, and the one change of frame that a contact call makes.

use crate::linalg::sine_and_cosine::LARGEST;
use nalgebra::{Isometry3, Matrix3, Rotation3, UnitQuaternion, Vector3};
use thiserror::Error;

/// Why numbers do not make a pose.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[allow(missing_docs)]
pub enum PoseError {
    #[error("position ({0:?}, {1:?}, {2:?}) is not finite")]
    Position(f64, f64, f64),
    #[error("orientation w={0:?}, x={1:?}, y={2:?}, z={3:?} is not a quaternion that can be normalised")]
    Orientation(f64, f64, f64, f64),
    #[error(
        "the rotation matrix is off from a rotation by {0:e} in an entry of its square: columns must be orthonormal"
    )]
    Rotation(f64),
    #[error(
        "angle {0:?} is not finite or beyond 2^30 = 1073741824: give it in radians, anticlockwise, less whole turns"
    )]
    Angle(f64),
}

/// Largest error of an entry of RᵀR − 1 at which R still counts as a rotation that was rounded or stored in few digits.
const ORTHONORMAL: f64 = 1e-6;

/// Where a body is: world = rotation · local + position. There is no invalid pose: every constructor checks.
///
/// ```
/// use nalgebra::{Isometry3, Vector3};
/// use potential_particles::Pose;
/// // A quarter turn about z, from a quaternion (w, x, y, z) of any length, or from nalgebra's isometry.
/// let pose = Pose::new([1.0, 2.0, 3.0], [2.0, 0.0, 0.0, 2.0])?;
/// assert_eq!(pose.rotate(&Vector3::x()), Vector3::y());
/// let same = Isometry3::new(Vector3::new(1.0, 2.0, 3.0), Vector3::z() * std::f64::consts::FRAC_PI_2);
/// assert!((Pose::try_from(&same)?.rotation() - pose.rotation()).norm() < 1e-15);
/// assert!(Pose::new([f64::NAN, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]).is_err());
/// # Ok::<(), potential_particles::PoseError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Pose {
    position: Vector3<f64>,
    /// A quaternion of any length; or, where its w is infinite, as that of no pose is, an angle about z in place of x.
    /// The extended tier takes its own digits of the rotation from it.
    turn: [f64; 4],
    rotation: Matrix3<f64>,
}

/// A rotation as given.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Turn {
    /// (w, x, y, z), of any length.
    Quaternion([f64; 4]),
    /// About z, anticlockwise, radians.
    Angle(f64),
}

impl Pose {
    /// From a position and a quaternion (w, x, y, z), local to world, normalised here.
    ///
    /// # Errors
    /// A position or quaternion that is not finite, or a quaternion shorter than 1e-150 or longer
    /// than 1e150 (its square would leave the range of f64).
    pub fn new(position: [f64; 3], orientation: [f64; 4]) -> Result<Self, PoseError> {
        let [x, y, z] = position;
        if !position.iter().all(|v| v.is_finite()) {
            return Err(PoseError::Position(x, y, z));
        }
        let [w, i, j, k] = orientation;
        let square = w * w + i * i + j * j + k * k;
        if !(1e-300..=1e300).contains(&square) {
            return Err(PoseError::Orientation(w, i, j, k));
        }
        // The matrix of the unit quaternion, without its root.
        let t = 2.0 / square;
        let (ti, tj, tk) = (t * i, t * j, t * k);
        let rotation = Matrix3::new(
            1.0 - (tj * j + tk * k),
            ti * j - tk * w,
            ti * k + tj * w,
            ti * j + tk * w,
            1.0 - (ti * i + tk * k),
            tj * k - ti * w,
            ti * k - tj * w,
            tj * k + ti * w,
            1.0 - (ti * i + tj * j),
        );
        Ok(Self { position: Vector3::from(position), turn: orientation, rotation })
    }

    /// Of a particle in the plane z = 0: from its position there and the paper's angle θ (eqs 7, 8), radians,
    /// anticlockwise, local to world, from −2³⁰ to 2³⁰. It counts as exact.
    ///
    /// ```
    /// use nalgebra::Vector3;
    /// use potential_particles::Pose;
    /// let pose = Pose::in_plane([1.0, 2.0], std::f64::consts::FRAC_PI_2)?;
    /// let world = pose.rotate(&Vector3::x()) + pose.position();
    /// assert!((world - Vector3::new(1.0, 3.0, 0.0)).norm() < 1e-15);
    /// # Ok::<(), potential_particles::PoseError>(())
    /// ```
    ///
    /// # Errors
    /// A position or angle that is not finite, or an angle beyond that range.
    pub fn in_plane(position: [f64; 2], angle: f64) -> Result<Self, PoseError> {
        let [x, y] = position;
        if !(x.is_finite() && y.is_finite()) {
            return Err(PoseError::Position(x, y, 0.0));
        }
        if !(-LARGEST..=LARGEST).contains(&angle) {
            return Err(PoseError::Angle(angle));
        }
        let (sin, cos) = angle.sin_cos();
        let rotation = Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
        Ok(Self { position: Vector3::new(x, y, 0.0), turn: [f64::INFINITY, angle, 0.0, 0.0], rotation })
    }

    /// No rotation, at a position.
    pub fn at(position: [f64; 3]) -> Result<Self, PoseError> {
        Self::new(position, [1.0, 0.0, 0.0, 0.0])
    }

    /// From a rotation matrix, local to world. One that is orthonormal to rounding is kept as it is, and extended
    /// precision takes the quaternion nearest to it, a few ε away; of any other, the pose is that of the nearest
    /// quaternion.
    ///
    /// # Errors
    /// A position that is not finite, or a matrix that is no rotation to six digits.
    pub fn from_rotation(position: [f64; 3], rotation: &Matrix3<f64>) -> Result<Self, PoseError> {
        let off = (rotation.tr_mul(rotation) - Matrix3::identity()).amax();
        if !(off <= ORTHONORMAL && rotation.determinant() > 0.0) {
            return Err(PoseError::Rotation(off));
        }
        let quaternion = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*rotation));
        let pose = Self::new(position, [quaternion.w, quaternion.i, quaternion.j, quaternion.k])?;
        Ok(if off <= 8.0 * f64::EPSILON { Self { rotation: *rotation, ..pose } } else { pose })
    }

    /// Centre of the particle, world frame.
    pub fn position(&self) -> &Vector3<f64> {
        &self.position
    }

    /// The quaternion (w, x, y, z), local to world, as it was given: of any length.
    pub fn orientation(&self) -> [f64; 4] {
        match self.turn() {
            Turn::Quaternion(orientation) => orientation,
            Turn::Angle(angle) => {
                let (sin, cos) = (0.5 * angle).sin_cos();
                [cos, 0.0, 0.0, sin]
            }
        }
    }

    /// The rotation as given.
    pub(crate) fn turn(&self) -> Turn {
        match self.turn {
            [f64::INFINITY, angle, ..] => Turn::Angle(angle),
            quaternion => Turn::Quaternion(quaternion),
        }
    }

    /// Local to world.
    pub fn rotation(&self) -> &Matrix3<f64> {
        &self.rotation
    }

    /// World point to local point.
    pub fn to_local(&self, world: &Vector3<f64>) -> Vector3<f64> {
        self.rotation.tr_mul(&(world - self.position))
    }

    /// Local direction to world direction.
    #[inline(always)]
    pub fn rotate(&self, local: &Vector3<f64>) -> Vector3<f64> {
        self.rotation * local
    }
}

impl TryFrom<&Isometry3<f64>> for Pose {
    type Error = PoseError;

    fn try_from(isometry: &Isometry3<f64>) -> Result<Self, PoseError> {
        let q = isometry.rotation.quaternion();
        Self::new(isometry.translation.vector.into(), [q.w, q.i, q.j, q.k])
    }
}
