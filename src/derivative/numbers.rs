//! The numbers by which derivatives are found, all in one place.

/// Ends of loops and sizes of buffers.
pub(super) struct Limits;

impl Limits {
    /// Steps of Newton's method in 32 digits, from a point that is right to the digits of a double.
    pub const NEWTON_STEPS: usize = 30;
    /// Corrections of a surface point that is given to the rounding of its position in the world.
    pub const CORRECTIONS: usize = 6;
}

// contact.rs
/// Relative rounding of P1 − P2 above which 32 digits are used.
pub(super) const LOST_ACROSS: f64 = 1e-12;

// optimum.rs
/// Where the least curvature across the normal is below this share of the sum, the axes are aligned with the
/// curvatures, so that it keeps its digits.
pub(super) const GRADED: f64 = 1e-4;
/// Relative rounding of depths from which on numbers of 32 digits are taken, and from which less than five digits are
/// right.
pub(super) const LOST: f64 = 1e-13;
pub(super) const IMPRECISE: f64 = 1e-5;
/// Run of the point by rounding from which on numbers of 32 digits are taken, too.
pub(super) const RUN: f64 = 1e-10;
/// Change of the normals at which they have converged, and below which they have if a further step changes them no
/// less: the rest is rounding.
pub(super) const CONVERGED: [f64; 2] = [1e-24, 1e-13];
