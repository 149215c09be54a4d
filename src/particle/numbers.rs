//! The numbers by which particles are bounded, cut, cast upon and integrated, all in one place. Lengths are over the
//! bounding radius unless another is named. Those that enter a bound say whether they are derived.

use crate::linalg::number::gamma;
use std::ops::RangeInclusive;

/// Ends of loops and sizes of buffers.
pub(super) struct Limits;

impl Limits {
    /// Most planes whose corners are enumerated; further ones only make the polyhedron smaller.
    pub const FACES: usize = 24;
    /// Up to this many edges are matched by looking at all of them; more are sorted.
    pub const UNSORTED_EDGES: usize = 24;
    /// Most faces that are always followed: fewer than the cells that most bodies need.
    pub const FOLLOWED_FACES: usize = 1_000;
    /// Most Newton steps on a ray: far outside each halves the distance, and beside the surface each doubles the
    /// digits.
    pub const GAUGE_STEPS: usize = 200;
    /// Steps of a linear program with the half-space that cuts most; from then on the first one enters, and the first
    /// leaves, which never leads in circles (Bland).
    pub const STEEPEST_PIVOTS: usize = 200;
    /// Steps of a linear program: far more than any body has taken.
    pub const PIVOTS: usize = 100_000;
    /// Cells of mass properties, some seconds of work for some tens of planes; and planes evaluated on all rays
    /// together, some tens of seconds.
    pub const CELLS: usize = 200_000;
    pub const WORK: usize = 1_000_000_000;
    /// How often the units of the errors of mass properties are computed again.
    pub const UNITS: usize = 8;
    /// Most planes of a particle without bounds, and of an undivided cluster: evaluating them costs about as much as
    /// two bounds.
    pub const CLUSTER: usize = 12;
    /// Steps towards the highest point of a surface, and halvings of one.
    pub const SUPPORT_STEPS: usize = 100;
    pub const SUPPORT_HALVINGS: usize = 20;
}

// bounding_volumes.rs
/// Relative error of a corner. A corner is kept when a face cuts off less than this, which makes the polyhedron larger
/// at most. Estimated: up to a condition number of 1e8.
pub(super) const CORNER_SLACK: f64 = 1e-6;
/// Largest half edge of a cube, length: the square of its diagonal is still finite. And most bounding radii in units of
/// r/√(1−k): a plane that bounds the particle along a ray rises by at least the inverse of this along the ray; depth
/// times rise and the square of the rise, at the surface, are then no smaller than 1e-304 and 1e-300, normal numbers
/// (derived).
pub(super) const SQUARABLE: f64 = 1e150;
/// Half the edge of the cube tried first, in distances of the farthest face: the corners of few particles lie beyond
/// it.
pub(super) const FIRST_CUBE: f64 = 8.0;
/// Distance in radii within which planes count as nearby (chosen).
pub(super) const NEARBY: f64 = 4.0;
/// Factor by which bounds are enlarged. It covers the error of a corner and the corner into which it was merged, each
/// at most [`CORNER_SLACK`] (estimated).
pub(super) const BOUND_MARGIN: f64 = 1.0 + 1e-5;

// coplanar.rs
/// Distance at which faces are one, as a share of the extent, the largest edge of the box about the body. The numbers
/// of a binary .stl file are good to 6e-8.
pub(crate) const COPLANAR: f64 = 1e-6;
/// Area, over the square of the extent, up to which a face has none: its normal is rounding, and may point inwards. The
/// product of two edges is known to some 12 ε of that square.
pub(super) const NO_AREA: f64 = gamma(64);
/// Least cosine between the normals of faces that are one. The normal of a sliver is rounding, but lies between those
/// of its neighbours, and so within 60° of one of them unless they meet in a sharp edge.
pub(super) const LEAST_COSINE: f64 = 0.5;

// minkowski_gauge.rs
/// Least step of Newton's method on a ray, relative.
pub(super) const LEAST_STEP: f64 = gamma(8);
/// Part of the terms of the slope on a ray below which its sign is not trusted.
pub(super) const UNDECIDED_SLOPE: f64 = gamma(32);

// linear_program.rs
/// Half the edge of the cube in which optima are sought, in distances of the farthest face. An optimum on the cube
/// means unbounded: with unit normals a larger polyhedron has multipliers above 1e9, which [`LARGEST_RESIDUAL`]
/// refuses.
pub(super) const OPTIMA_CUBE: f64 = 1e10;
/// Part of the terms of a·x − h, or of 1 for multipliers, below which a sign is not trusted. Far above rounding, so
/// that planes through one corner are not taken to cut each other off; what is overlooked is covered by the dual bound.
pub(super) const UNDECIDED: f64 = 1e-12;
/// Changes of a multiplier below this share of the largest are rounding: with such a half-space leaving, the others
/// would be dependent.
pub(super) const PIVOT: f64 = 1e-9;
/// Rounding in the dual bound, in units of the multipliers' sum: γ₄ = 2ε for each of the three components of ρ, with
/// |n|₁ ≤ √3 together 3.5ε; as much for the normalisation of n; one more for h and the sum.
pub(super) const DUAL_ROUNDING: f64 = gamma(16);
/// Largest |ρ|₁ at which the half-spaces count as bounded. The half edge is then right to 1e-6, and two planes that
/// face each other at an angle below 2e-9 count as parallel.
pub(super) const LARGEST_RESIDUAL: f64 = 1e-6;
/// Part of the scale below which an extent is so small that the units may have cost digits.
pub(super) const TINY_EXTENT: f64 = 1e-100;

// mass_properties.rs
/// Least relative tolerance: where this is not enough, rounding leaves no more digits.
pub(super) const LEAST_TOLERANCE: f64 = 1e-12;
/// Where the two parts of a cell's error differ by less than this factor, it is halved in both directions.
pub(super) const ALIKE: f64 = 4.0;
/// Least share of the tolerance that is left to the cells, where rounding takes more than all of it.
pub(super) const LEAST_PART: f64 = 0.1;
/// Factor by which the units of the errors may be off.
pub(super) const SAME_UNITS: f64 = 1.05;
/// Rounding of a sum of moments, relative.
pub(crate) const OF_SUMS: f64 = gamma(8);

// neighbours.rs
/// Least height of a face and least depth of a cut, and by how much a surface point may lie beyond the bounding ball,
/// which is rounded, too: far more than the rounding of corners.
pub(super) const FACES_APART: f64 = 1e-9;

// plane_clusters.rs
/// Bound on the rounding of a cluster's bound and of separation tests, relative to the lengths in them: 45ε.
///
/// Separation tests need 40ε (docs/theory.md, "Separation tests"). The bound of a cluster is off by at most 10ε·(|m| +
/// ρ)|y|: γ₃ for m·y, γ₃ for |y| and for ρ, ε for the differences n_i − m, and two additions. The rounding of d needs
/// no more: where it decides the sign of the bound, |d| is about (|m| + ρ)|y| itself (derived).
pub(crate) const MARGIN: f64 = 1e-14;

// quadrature.rs
/// Limits of the share of the difference of both rules of quadrature that counts as their error.
pub(super) const LEAST_SHARE: f64 = 0.01;
pub(super) const MOST_SHARE: f64 = 4.0;
/// Share over ρ⁻⁴, by which the terms that both rules miss are smaller than those that only one misses. For functions
/// with a root or a pole at any place around the interval the error of the rule of 7 points is up to 10 ρ⁻⁴ of the
/// difference.
pub(super) const OF_FOURTH_POWER: f64 = 16.0;

// solid.rs
/// The bounding radius lies in this range: moments of inertia go with the fifth power of lengths, and the products and
/// squares that are taken of them and of the wrench of a patch are normal numbers then.
pub(super) const SIZES: RangeInclusive<f64> = 1e-30..=1e30;

// support.rs
/// Curvatures that are added in all directions, as shares of the trace of the Hessian: the next where one leads
/// nowhere.
pub(super) const ADDED: [f64; 3] = [1e-11, 1e-5, 1e-2];
/// How far the normal of the surface may be from u in the end, and where nothing rises any more: the height is missed
/// by the curvature times half the square of that.
pub(super) const ALONG: f64 = 1e-8;
pub(super) const NEARLY_ALONG: f64 = 1e-4;
