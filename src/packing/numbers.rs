//! The numbers by which bodies are packed, all in one place. None decides whether bodies overlap.

/// Ends of loops and sizes of buffers.
pub(super) struct Limits;

impl Limits {
    /// Cells of the grid, however small the bodies and however flat the region.
    pub const CELLS: f64 = 4e6;
    /// Bodies without a place, one after the other, after which no further one is tried.
    pub const FAILURES: usize = 64;
    /// Bodies of a packing.
    pub const BODIES: usize = 10_000_000;
    /// Bodies that look for their places at once.
    pub const AT_ONCE: f64 = 64.0;
    /// Poses that are tried for a scattered body where the caller names no number.
    pub const TRIALS: usize = 5_000;
    /// Random points of the box about a region that are tried until one lies in it.
    pub const POINTS: usize = 1_000;
    /// Poses above the pile that are tried for the start of a fall.
    pub const STARTS: usize = 30;
    /// Moves of a walk.
    pub const MOVES: usize = 300;
}

// pack.rs
/// Share of the container's cross-section, in squares of the bodies' widths, that a body has for itself in a round:
/// with less, many would find their places taken.
pub(super) const ROOM: f64 = 32.0;

// pile.rs
/// How far a body may move, in bounding radii, before neighbours are looked up again.
pub(super) const NEIGHBOURS_HOLD: f64 = 0.5;

// settled.rs
/// Falls of one body, of which the lowest place counts.
pub(super) const FALLS: usize = 4;
/// Steps in bounding radii: the first of a walk, and one so short that the walk ends.
pub(super) const FIRST_STEP: f64 = 0.5;
pub(super) const LAST_STEP: f64 = 2e-3;
/// Growth of the step by a move that fits, shrinkage by one that does not: one growth balances four shrinkages.
pub(super) const GROWTH: f64 = 1.5;
pub(super) const SHRINKAGE: f64 = 0.903_602; // 1.5^(-1/4)

// sizes.rs
/// How far the sum of shares, which are written with a few digits, may be off 1.
pub(super) const ADD_UP: f64 = 1e-6;

// supply.rs
/// Bodies of which the typical width is the mean.
pub(super) const TYPICAL_OF: usize = 256;
/// Least share by which a body is enlarged while it is packed: the finished bodies are as far apart, so that no other
/// rounding of their planes makes them overlap.
pub(super) const LEAST_ENLARGEMENT: f64 = 1e-6;
