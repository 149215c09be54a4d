//! The answer for one pair.

use crate::answer::{answer, words};
use crate::flags::Flags;
use crate::linalg::number::unknown_vector;
use crate::settings::{BackEnd, Formulation};
use nalgebra::Vector3;
use std::fmt;

/// Whether the particles overlap. A failure is an error, never a kind, so that there will be no third.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "lowercase"))]
#[repr(i32)]
pub enum Kind {
    /// s ≥ 1.
    Separated = 1,
    /// s < 1.
    Overlapping = 2,
}

words!(Kind, "i4", |kind| (kind as i32));

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(match self {
            Self::Separated => "separated",
            Self::Overlapping => "overlapping",
        })
    }
}

answer! {
    /// The answer for one pair. Frames: world axes unless said otherwise; lengths in the caller's unit; s, weight
    /// and gap have no unit. Of particles in the plane every vector has z = 0. Fields that do not apply are NaN.
    pub struct Contact {
        /// [`Kind::Separated`] or [`Kind::Overlapping`]. A failed solve has no kind: it returns a status.
        pub kind: Kind = Kind::Separated,
        /// The formulation that the geometry below answers ([`Formulation::Midway`] if [`Flags::SLACK`] is set).
        pub formulation: Formulation = Formulation::Midway,
        /// The back end that answered: [`BackEnd::Fast`] or [`BackEnd::ConeProgram`].
        pub back_end: BackEnd = BackEnd::Fast,
        /// Sum of [`Flags`].
        pub flags: Flags = Flags::NONE,
        /// Pairs of quadratics solved; rounds of a contact carried on; interior-point iterations of the cone-program
        /// back end.
        pub iterations: u32 = 0,
        /// Always 0.
        pub(crate) reserved: u32 = 0,
        /// Midway: t, the common scale at which the two particles touch at one point; t < 1 overlap.
        /// Closest: s_A at P2. Rejected pairs: a lower bound, >= 1. No unit.
        pub s: f64 = f64::NAN,
        /// Closest: s_B at P1; NaN for midway.
        pub s_b: f64 = f64::NAN,
        /// Weight u of B, in [0, 1]: (1-u) grad S_A + u grad S_B = 0 at the solution (closest: at P2).
        pub weight: f64 = f64::NAN,
        /// Bound on the error of s, and of s_b: |s - s*| <= gap. Proved for answers in extended precision
        /// ([`Flags::EXTENDED`]); in doubles rounding is counted to first order, so that it is an estimate
        /// (docs/theory.md).
        pub gap: f64 = f64::NAN,
        /// Estimated bound on the distance of the point (closest: of each of P1 and P2) to the exact optimum,
        /// length: of first order in the rounding of the data.
        pub point_bound: f64 = f64::NAN,
        /// Overlap (YADE: penetrationDepth), length, >= 0 when overlapping (0 where s < 1 by rounding alone); NaN
        /// when separated.
        pub overlap: f64 = f64::NAN,
        /// Unit contact normal, from A to B (positive force on B pushes it along +normal), from the gradients
        /// of S_A and S_B; for k below flat_regularisation from those of the regularised shapes, so that it is
        /// defined even where flat-faced cores overlap.
        pub normal: Vector3<f64> = unknown_vector(),
        /// Contact point, world frame: P3 of midway, or the weighted mean of P1 and P2 of closest.
        pub point: Vector3<f64> = unknown_vector(),
        /// Contact point minus position of A: exact lever arm even far from the world origin.
        pub branch_a: Vector3<f64> = unknown_vector(),
        /// Contact point minus position of B.
        pub branch_b: Vector3<f64> = unknown_vector(),
        /// Point on the surface of A inside B, world frame; P1 of closest. NaN when separated.
        pub point_on_a: Vector3<f64> = unknown_vector(),
        /// Point on the surface of B inside A, world frame; P2 of closest. NaN when separated.
        pub point_on_b: Vector3<f64> = unknown_vector(),
        /// Separated: lower bound on the distance between the two particles, length, with the rounding of s and
        /// of their bounding volumes estimated; 0 when none is known.
        /// NaN when overlapping.
        pub distance: f64 = 0.0,
    }
}

impl Contact {
    /// A contact of which only the proof of separation is known.
    pub(crate) fn separated(formulation: Formulation, s: f64) -> Self {
        Self { formulation, flags: Flags::REJECTED, s, ..Self::UNKNOWN }
    }
}
