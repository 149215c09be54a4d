//! What is given and what is asked for.

use crate::contact::contact::Kind;
use crate::contact::error::DetectError;
use crate::flags::flag_set;
use crate::particle::in_plane::InPlaneError;
use crate::particle::particle::{Particle, Plane};
use crate::settings::SettingsError;
use nalgebra::{ArrayStorage, RowSVector, SMatrix, Vector3};
use thiserror::Error;

/// The derivative of a number in both poses: [`PoseRows`] has the order of the columns.
pub type PoseRow = RowSVector<f64, 12>;

/// The derivative of a vector, world axes, in both poses. Columns: a shift of A along x, y, z and a turn of A about its
/// position (of a boundary: see [`crate::boundary_derivatives`]) and x, y, z, world axes, radians; then the same of B.
/// In the plane the columns that leave it are 0.
pub type PoseRows = SMatrix<f64, 3, 12>;

/// The derivatives of a contact in the poses of both bodies. What is NaN in the contact is NaN here.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ContactDerivatives {
    /// Of s, 1/length and no unit.
    pub s: PoseRow,
    /// Of s_b; NaN for midway.
    pub s_b: PoseRow,
    /// Of the overlap; NaN when separated.
    pub overlap: PoseRow,
    /// Of the normal.
    pub normal: PoseRows,
    /// Of the point, world frame.
    pub point: PoseRows,
    /// Of the point on the surface of A; NaN when separated.
    pub point_on_a: PoseRows,
    /// Of the point on the surface of B, NaN when separated; of a boundary that of the point on it.
    pub point_on_b: PoseRows,
    /// What else is to be known.
    pub flags: DerivativeFlags,
}

/// Of what does not apply.
pub(super) const NO_ROW: PoseRow = PoseRow::from_array_storage(ArrayStorage([[f64::NAN]; 12]));
const NO_ROWS: PoseRows = PoseRows::from_array_storage(ArrayStorage([[f64::NAN; 3]; 12]));

impl ContactDerivatives {
    pub(super) const NONE: Self = Self {
        s: NO_ROW,
        s_b: NO_ROW,
        overlap: NO_ROW,
        normal: NO_ROWS,
        point: NO_ROWS,
        point_on_a: NO_ROWS,
        point_on_b: NO_ROWS,
        flags: DerivativeFlags(0),
    };

    /// Of a contact in the plane, where bodies shift along x and y and turn about z.
    pub(super) fn stay_in_plane(&mut self) {
        for leaving in [2, 3, 4, 8, 9, 10] {
            for row in [&mut self.s, &mut self.s_b, &mut self.overlap] {
                row[leaving] = 0.0 * row[0];
            }
            for rows in [&mut self.normal, &mut self.point, &mut self.point_on_a, &mut self.point_on_b] {
                let zero = 0.0 * rows[(0, 0)];
                rows.column_mut(leaving).fill(zero);
            }
        }
    }
}

impl ContactWeights {
    /// Of a contact in the plane, where nothing has a z.
    pub(super) fn in_plane(mut self) -> Self {
        let vectors = [&mut self.normal, &mut self.point, &mut self.point_on_a, &mut self.point_on_b];
        vectors.into_iter().for_each(|vector| vector.z = 0.0);
        self
    }
}

impl PoseGradient {
    /// Of a body in the plane.
    pub(super) fn stay_in_plane(&mut self) {
        (self.shift.z, self.turn.x, self.turn.y) = (0.0, 0.0, 0.0);
    }
}

/// Derivatives of the caller's cost with respect to the fields of a contact. For a field that is NaN in the
/// contact the derivative must be 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
pub struct ContactWeights {
    /// In s.
    pub s: f64,
    /// In s_b.
    pub s_b: f64,
    /// In overlap.
    pub overlap: f64,
    /// In normal.
    pub normal: Vector3<f64>,
    /// In point.
    pub point: Vector3<f64>,
    /// In point_on_a (of a boundary: on_particle).
    pub point_on_a: Vector3<f64>,
    /// In point_on_b (of a boundary: on_boundary).
    pub point_on_b: Vector3<f64>,
}

/// Derivatives of a cost in the pose of a body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
pub struct PoseGradient {
    /// In a shift, world axes.
    pub shift: Vector3<f64>,
    /// In a turn about its position, world axes, per radian.
    pub turn: Vector3<f64>,
}

/// The derivative of a cost in the shape of a body; sums over many contacts add up in it.
///
/// At the ends of the range of k its derivative is that towards the inside: at k = 0 towards a sphere of the given R
/// (without one, where R is not positive, only the planes count), at k = 1 towards the given planes.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ShapeGradient {
    /// In the normal and the offset of each plane, in the order in which they were given.
    pub planes: Vec<Plane>,
    /// In the rounding radius r.
    pub r: f64,
    /// In the sphericity k.
    pub k: f64,
    /// In the radius R of the shadow sphere.
    pub shadow_radius: f64,
}

impl ShapeGradient {
    /// Zeros for the planes of a particle.
    pub fn zeros(particle: &Particle) -> Self {
        let plane = Plane { normal: Vector3::zeros(), offset: 0.0 };
        Self { planes: vec![plane; particle.plane_count()], r: 0.0, k: 0.0, shadow_radius: 0.0 }
    }
}

/// What else is to be known about derivatives; a set of bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DerivativeFlags(u32);

impl DerivativeFlags {
    /// Whether a plane is active at the contact point, or at a surface point, is uncertain within the bound on that
    /// point. The derivatives are those with the plane inactive; the derivative of s is the same either way.
    pub const SWITCHING: Self = Self(1);
    /// Flat faces or edges touch (k = 0, or nearly): along them flat_regularisation alone holds the point, whose
    /// derivatives may be as large as 1/flat_regularisation, and hold for motions of about its size only. Raise it
    /// for derivatives of practical use.
    pub const FREE: Self = Self(2);
    /// The contact is separated: overlap and surface points have no derivatives, and are NaN.
    pub const SEPARATED: Self = Self(4);
    /// Fewer than four digits may be right: depths of active planes are of the size of their rounding (at a
    /// boundary, by bodies whose r is 1e-11 of their size), or planes switch even in 32 digits.
    pub const IMPRECISE: Self = Self(8);

    const NAMES: [(Self, &'static str); 4] = [
        (Self::SWITCHING, "switching"),
        (Self::FREE, "free"),
        (Self::SEPARATED, "separated"),
        (Self::IMPRECISE, "imprecise"),
    ];
}

flag_set!(DerivativeFlags);

impl DerivativeError {
    /// Of a contact some numbers of which are missing.
    pub(super) fn without_point(kind: Kind) -> Self {
        if kind == Kind::Separated { Self::NoPoint } else { Self::NotFinite }
    }
}

/// Why a contact has no derivatives.
#[derive(Clone, Debug, Error)]
#[non_exhaustive]
pub enum DerivativeError {
    /// A setting is out of range.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// One particle lies in the plane and the other does not, or something leaves the plane.
    #[error(transparent)]
    InPlane(#[from] InPlaneError),
    /// The pair was rejected without a contact point.
    #[error("the contact has no point: separation was proved without one; detect it with solve_separated")]
    NoPoint,
    /// A number of an overlapping contact is not finite.
    #[error("the contact is not finite: take the answer of a call for the same bodies and poses")]
    NotFinite,
    /// Both gradients vanish, as in the core of both bodies or where centres coincide.
    #[error("the gradients of the potentials vanish at the contact point: there no normal is right, and no derivative")]
    NoGradient,
    /// The curvature across the normal vanishes in spite of the regularisation, or leaves the range of numbers.
    #[error("the curvature of the potentials across the normal vanishes or is not finite")]
    NoCurvature,
    /// A contact with an edge was given without its triangle.
    #[error("the contact is with an edge of a triangle, whose direction is not known: give the triangle")]
    NoTriangle,
    /// Closest points of a separated pair, which the contact does not hold, could not be found again.
    #[error(transparent)]
    Detect(#[from] DetectError),
    /// Gradients of a shape with another number of planes.
    #[error("the gradient has {given} planes where the particle has {expected}")]
    Planes {
        /// In the gradient.
        given: usize,
        /// Of the particle.
        expected: usize,
    },
}
