//! The answer: what a law of contact needs of a patch.

use crate::flags::flag_set;
use nalgebra::{Matrix3, Matrix6, Vector3};

/// The contact patch of two bodies, or of a body and a flat boundary, world axes, lengths in the caller's unit.
///
/// With the scale s of both bodies, Σ = {s_A = s_B ≤ 1} and the pressure p = K ℓ (1 − s) on it; K is the caller's
/// stiffness per area (force/length³) and all that is proportional to it is given over K. The normal n of Σ points from
/// A to B. In the plane Σ is a curve: areas are lengths, and all is per unit of depth.
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Patch {
    /// ℓ = ℓ_A + ℓ_B, against a boundary ℓ_A ([`crate::Particle::depth_length`]), length.
    pub length: f64,
    /// ∫ p n dΣ / K, the force on B (−force on A) over K, length³. Its direction is the mean normal.
    pub force: Vector3<f64>,
    /// ∫ (x − contact point) × p n dΣ / K: the torque on B about the contact point over K, length⁴.
    pub torque: Vector3<f64>,
    /// The point of the axis of the wrench that lies in the plane of the patch: where a law applies the force. World
    /// frame.
    pub pressure_centre: Vector3<f64>,
    /// The same minus position of A.
    pub branch_a: Vector3<f64>,
    /// The same minus position of B; of a boundary, of A again.
    pub branch_b: Vector3<f64>,
    /// The couple along the axis, torque·force/|force|, over K, length⁴.
    pub couple: f64,
    /// Area of Σ, length².
    pub area: f64,
    /// Centroid of Σ minus the centre of pressure.
    pub centroid: Vector3<f64>,
    /// ∫ y yᵀ dΣ about the centroid, length⁴.
    pub second_moment: Matrix3<f64>,
    /// ∫ |y|² dΣ, y from the axis of the wrench at right angles to it, length⁴.
    pub polar_moment: f64,
    /// ∫ p |y| dΣ / ∫ p dΣ: the lever of friction against twist, |M| ≤ μ N λ, length.
    pub twist_lever: f64,
    /// ∫ p dΣ / (K·area): the mean overlap, length.
    pub mean_depth: f64,
    /// Largest ℓ (1 − s), that of the contact point, length.
    pub largest_depth: f64,
    /// Elastic energy over K, length⁴; NaN unless it was asked for.
    pub energy: f64,
    /// Change of force and torque on B (rows) with a shift of A and a turn of A about the contact point (columns), over
    /// K, while B is held, and with it the point of reference and the axes: length² (force by shift) to length⁴ (torque
    /// by turn). NaN unless it was asked for and integrated; 0 for what would leave the plane.
    pub stiffness: Matrix6<f64>,
    /// The farthest point of quadrature from the contact point.
    pub(super) reach: f64,
    /// Estimated error of the force over its size, of the torque over |force| times the reach of the patch, and of the
    /// energy, if asked for, over itself: the largest.
    pub error: f64,
    /// Estimated relative error of the area; NaN in the plane, where nobody estimates it.
    pub area_error: f64,
    /// What else is to be known.
    pub flags: PatchFlags,
    /// Number of points of quadrature.
    pub points: usize,
    /// Number of rays that were followed.
    pub rays: usize,
}

/// A point of quadrature on a patch.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
pub struct PatchPoint {
    /// Its place minus the point of the contact (of a boundary: on_boundary), world axes.
    pub position: Vector3<f64>,
    /// Its share of the area, length^2.
    pub area: f64,
    /// p/K = length (1 - s) there, length.
    pub depth: f64,
    /// Unit normal of the patch, from A to B, world axes.
    pub normal: Vector3<f64>,
}

/// What else is to be known about a patch; a set of bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PatchFlags(u32);

impl PatchFlags {
    /// The patch turns back under itself, as in deep overlaps of round bodies, or ends where no ray goes on. What
    /// turns back is part of the answer, but a part that no ray from the contact point reaches may be missing,
    /// which the estimated error does not tell: the far side of a rod that goes through the other body.
    pub const FOLDED: Self = Self(1);
    /// The tolerance was not reached with the most rays (1500, or two million planes looked at), or is beyond what
    /// rounding allows where the bodies hardly touch (overlaps of 1e-11 of their size at 1e-4); error tells how far
    /// off the answer may be.
    pub const TOLERANCE_NOT_REACHED: Self = Self(2);
    /// The contact point lies in the core of both bodies, or the boundary reaches through that of A (s is 0 or
    /// nearly): the patch is that of slightly rounder bodies.
    pub const DEEP: Self = Self(4);
    /// No patch was found around the contact point, and force and area are 0: an overlap within rounding.
    pub const EMPTY: Self = Self(8);
    /// The patch follows from that of an earlier pose by its stiffness ([`PatchState`](crate::PatchState)): it has no
    /// points, and area and moments are those of that pose.
    pub const CARRIED: Self = Self(16);

    const NAMES: [(Self, &'static str); 5] = [
        (Self::FOLDED, "folded"),
        (Self::TOLERANCE_NOT_REACHED, "tolerance not reached"),
        (Self::DEEP, "deep"),
        (Self::EMPTY, "empty"),
        (Self::CARRIED, "carried"),
    ];
}

flag_set!(PatchFlags);
