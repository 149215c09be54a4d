//! The answer for one pair.

use crate::flags::Flags;
use crate::linalg::number::{UNKNOWN_VECTOR, equality};
use crate::settings::{BackEnd, Formulation};
use nalgebra::Vector3;
use std::fmt;

/// Whether the particles overlap. A failure is an error, never a kind, so that there will be no third.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "lowercase"))]
pub enum Kind {
    /// s ≥ 1.
    Separated,
    /// s < 1.
    Overlapping,
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(match self {
            Self::Separated => "separated",
            Self::Overlapping => "overlapping",
        })
    }
}

/// The answer for one pair, world axes, lengths in the caller's unit. What does not apply is NaN.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Contact {
    /// Separated or overlapping.
    pub kind: Kind,
    /// The formulation that the geometry answers (midway where closest is slack).
    pub formulation: Formulation,
    /// Who answered.
    pub back_end: BackEnd,
    /// What else is to be known.
    pub flags: Flags,
    /// Pairs of quadratics solved; rounds of a contact carried on; interior-point iterations of the cone-program back end.
    pub iterations: u32,
    /// Midway: t. Closest: s_A at P2. Rejected: a proved lower bound, ≥ 1.
    pub s: f64,
    /// Closest: s_B at P1; NaN for midway.
    pub s_b: f64,
    /// Weight u of B: (1−u)∇S_A + u∇S_B = 0 at the solution (closest: at P2).
    pub weight: f64,
    /// |s − s*| ≤ gap (and the same for s_b). Every constant in it is derived (docs/theory.md). In extended precision it is proved;
    /// in doubles it counts rounding to first order: estimated.
    pub gap: f64,
    /// Estimated bound on the distance of the point (of closest: of each of P1 and P2) to the optimum, length: of first order in
    /// the rounding of the data.
    pub point_bound: f64,
    /// Overlap, length, ≥ 0 when overlapping (0 where s < 1 by rounding alone); NaN when separated.
    pub overlap: f64,
    /// Separated: lower bound on the distance between the particles, length, with the rounding of s and of their bounding volumes estimated; 0 when
    /// none is known, as for pairs that were solved to the end. NaN when overlapping.
    pub distance: f64,
    /// Unit normal from A to B.
    pub normal: Vector3<f64>,
    /// Contact point, world frame.
    pub point: Vector3<f64>,
    /// Contact point minus position of A.
    pub branch_a: Vector3<f64>,
    /// Contact point minus position of B.
    pub branch_b: Vector3<f64>,
    /// Point on the surface of A (P1 of closest), world frame; NaN when separated.
    pub point_on_a: Vector3<f64>,
    /// Point on the surface of B (P2 of closest), world frame; NaN when separated.
    pub point_on_b: Vector3<f64>,
}

equality!(Contact: kind, formulation, back_end, flags, iterations; s, s_b, weight, gap, point_bound, overlap, distance;
    normal, point, branch_a, branch_b, point_on_a, point_on_b);

impl Contact {
    /// A pair of which nothing is known yet.
    pub(crate) const UNKNOWN: Self = Self {
        kind: Kind::Separated,
        formulation: Formulation::Midway,
        back_end: BackEnd::Fast,
        flags: Flags::NONE,
        iterations: 0,
        s: f64::NAN,
        s_b: f64::NAN,
        weight: f64::NAN,
        gap: f64::NAN,
        point_bound: f64::NAN,
        overlap: f64::NAN,
        distance: 0.0,
        normal: UNKNOWN_VECTOR,
        point: UNKNOWN_VECTOR,
        branch_a: UNKNOWN_VECTOR,
        branch_b: UNKNOWN_VECTOR,
        point_on_a: UNKNOWN_VECTOR,
        point_on_b: UNKNOWN_VECTOR,
    };

    /// A contact of which only the proof of separation is known.
    pub(crate) fn separated(formulation: Formulation, s: f64) -> Self {
        Self { formulation, flags: Flags::REJECTED, s, ..Self::UNKNOWN }
    }
}
