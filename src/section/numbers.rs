//! The numbers by which the contact area is found, all in one place. Those that enter an error say whether they
//! are estimated or measured.

use crate::linalg::number::gamma;

/// Ends of loops and sizes of buffers.
pub(super) struct Limits;

impl Limits {
    /// Most Newton steps that correct the end of an arc; none or one are usual.
    pub const CORRECTIONS: usize = 4;
    /// Sizes of the buffers for lines on the stack, which are cleared at each call: usually the smaller one is enough.
    pub const LINES: [usize; 2] = [32, 256];
    /// Most bisections of an arc: arcs that touch are then nearer to each other than rounding.
    pub const BISECTIONS: u32 = 30;
    /// Deepest halving of one sector.
    pub const HALVINGS: u32 = 24;
    /// Rays of a section, some seconds for some hundreds of planes; and points of an outline.
    pub const POINTS: u32 = 1_000_000;
}

// bernstein.rs
/// Relative step at which the search for a root ends. The square of it is left in the parameter, and the square of that
/// in an area, since both arcs are equally far from the contact point where they cross.
pub(super) const LAST_STEP: f64 = 1e-7;

// boundary.rs
/// Multiple of the estimated rounding by which S may miss 1 at the end of an arc. Of random arcs 99.9 % miss it by less
/// than once the estimate; with a wrong active set an arc misses it by many orders of magnitude (measured).
pub(super) const MISS: f64 = 100.0;
/// Sine below which a line counts as a tangent of the boundary.
pub(super) const TANGENT: f64 = 1e-8;

// cross_section.rs
/// Multiple of the estimated rounding of S up to which a point counts as on the boundary (estimated).
pub(super) const ON_BOUNDARY: f64 = gamma(8);
/// 1 − S at the contact point, as a multiple of the estimate of its rounding, below which it is evaluated in
/// double-double. Above, its relative error and with it that of the area is at most 1e-11; the estimate is ample.
pub(super) const SHALLOW: f64 = 1e11;
/// S − 1 up to which a contact point counts as on the surface: what a solver may leave.
pub(super) const ON_SURFACE: f64 = 1e-6;

// lines.rs
/// Multiple of the rounding of an excess, or of a distance, below which its sign means nothing.
///
/// The product rate·y has a relative error of γ₂ = ε and the rounding of y adds ε/2, both in units of |y|·|rate|₁; with
/// the sum that makes 2ε. The factor four on top is an estimate of what a sequence of steps adds (estimated).
pub(super) const ROUNDING: f64 = gamma(16);
/// The distance loaded first, as a part of the radius.
pub(super) const FIRST_LOADED: f64 = 0.125;

// outline.rs
/// Equal parts of the circle that an outline begins with.
pub(super) const FIRST_PARTS: usize = 8;

// quadrature.rs
/// Equal sectors before refinement: no more than a quarter of a circle may hide between two rays.
pub(super) const FIRST_SECTORS: usize = 12;
/// Part of its share of the tolerance to which a sector's estimates must agree: the errors of several sectors may add
/// up.
pub(super) const SAFETY: f64 = 0.125;
/// Least relative tolerance by rays: where this is needed, rounding leaves no more digits. And least distance of a
/// polygon from the boundary, over the bounding radius: some 70,000 points of a circle.
pub(super) const FINEST: f64 = 1e-9;
