//! The numbers by which rock is cut, all in one place. None changes which blocks there are, beyond rounding.

use std::ops::RangeInclusive;

/// Ends of loops and sizes of buffers.
pub(super) struct Limits;

impl Limits {
    /// Pairs or triples of joints that are all looked at; of more, a sample is drawn, of as many at most and of
    /// LEAST_DRAWN at least: each costs a look at every joint, and all together LOOKS.
    pub const DRAWN: usize = 20_000;
    pub const LOOKS: usize = 4_000_000;
    /// Joints of a set: more are taken for a mistake.
    pub const JOINTS: f64 = 1e7;
    /// Parts of a chunk that a thread takes, and pieces that it makes before it reports them.
    pub const CHUNK: usize = 256;
    /// Rounds of joints while parts are few.
    pub const ROUNDS: usize = 100;
}

// domain.rs
/// Least depth of a cut over the size of the domain: some rounding of corners.
pub(super) const LEAST_CUT: f64 = 1e-13;
/// Half of the cube in which a domain is looked for, over the largest distance of its planes from the origin: the
/// second where it does not end in the first, as a flat one.
pub(super) const FAR: [f64; 2] = [1e4, 1e8];
/// Half extents of domains. Fifth powers of lengths, as moments of inertia are, and those of blocks a millionth as
/// large, are doubles with all their digits.
pub(crate) const EXTENTS: RangeInclusive<f64> = 1e-50..=1e50;

// expected.rs
/// Least size of a sample.
pub(super) const LEAST_DRAWN: usize = 1_000;
/// Planes this near, over the size of the domain, are one, and go through a point; two faces that share less than this
/// of the smaller one do not meet: some rounding of corners over the size of a block.
pub(super) const ONE_PLANE: f64 = 1e-9;
/// Standard deviations by which a number found by chance is taken lower.
pub(super) const DEVIATIONS: f64 = 4.0;

// joint.rs
/// A side this short over the size of its polygon has no direction.
pub(super) const SHORT: f64 = 1e-10;
/// How far corners of an outline may lie off their plane, over its size.
pub(super) const FLAT: f64 = 1e-6;

// parallel_cut.rs
/// Chunks of parts for each thread: so many that none waits long for the last one.
pub(super) const CHUNKS: usize = 16;

// slicing.rs
/// Parts for each thread from which on a round is as long as [`PIECES`] says: fewer may be of unlike cost.
pub(super) const FEW_PARTS: usize = 64;
/// Pieces that a round should add, which takes a fraction of a second; with four times as many it is given up, and done
/// again with half its joints.
pub(super) const PIECES: usize = 1 << 17;
