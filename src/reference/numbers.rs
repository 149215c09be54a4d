//! The numbers by which the answers of cone programs are corrected, all in one place.

/// Box of the first correction, as a part of the length unit: well above the error of the first pass.
pub(super) const FIRST_BOX: f64 = 1e-4;
/// A box need not be smaller than this part of the distance over which s doubles.
pub(super) const LAST_BOX: f64 = 0.1;
/// Most that one pass shrinks the box.
pub(super) const SHRINK: f64 = 1e-3;
/// Growth of the box when it binds.
pub(super) const GROW: f64 = 30.0;
/// Growth of the box when every setting failed: it may hold no feasible point.
pub(super) const RESCUE: f64 = 1e3;
/// A correction longer than this part of the box asks for a wider one.
pub(super) const BINDING: f64 = 0.5;
/// Least s used as a unit; below it s is as good as zero.
pub(super) const LEAST_SCALE: f64 = 1e-6;
/// An s below this is rounding at the minimum of S.
pub(super) const BOTTOM: f64 = 1e-12;
/// Largest relative difference between clarabel's objectives and s by definition in a pass that is trusted.
pub(super) const AGREEMENT: f64 = 1e-8;
/// Largest relative distance of s from a lower bound that holds outside the box as well. The bound assumes the worst
/// case, an optimum at the far end of the pair; s itself is some four digits more accurate.
pub(super) const CERTIFIED: f64 = 1e-5;
/// Relative change of s below which two passes agree.
pub(super) const REPEAT: f64 = 1e-10;
/// Most corrections. Ordinary pairs need one or two, near-polyhedral ones up to 4; sizes, radii and
/// distances drawn at random from eight decades up to 18 (measured).
pub(super) const MAX_PASSES: u32 = 40;
