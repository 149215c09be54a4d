//! The numbers by which shapes are built, all in one place.

use crate::linalg::number::gamma;

/// Ends of loops and sizes of buffers.
pub(super) struct Limits;

impl Limits {
    /// Planes of a fitted shape beyond which they do not turn: so many have the directions of the hull all around.
    pub const TURNED_PLANES: usize = 100;
    /// Planes of a fitted shape.
    pub const FITTED_PLANES: usize = 1_000;
    /// Directions along which the height of the hull is to be reached.
    pub const SAMPLES: usize = 800;
    /// Steps for each of POWERS.
    pub const FITTING_STEPS: usize = 40;
    /// Rounds of Lloyd's method.
    pub const LLOYD_ROUNDS: usize = 15;
    /// Points over the surface of a superquadric.
    pub const SURFACE_POINTS: usize = 2_000;
    /// Rays over half of a side that measure a section: its area is good to more digits than the shape needs. Steps
    /// towards the place of a side, and rounds in which planes are moved until they touch.
    pub const SECTION_RAYS: usize = 17;
    pub const STEPS: usize = 60;
    /// Planes that are rounded: beyond, it takes more than some seconds.
    pub const ROUNDED_PLANES: usize = 4_096;
    /// Rows times rounds of planes that are moved until they touch, for all places of the centre together.
    pub const TOUCHING_WORK: usize = 20_000;
}

// fitting.rs
/// The r of a fit to begin with, over the size; of more planes than turn only the middle one, for the time they take.
pub(super) const FIRST_SHARES: [f64; 3] = [0.05, 0.15, 0.45];
/// Powers of the missing heights whose sum is to be the least, one after the other, and what is added to their squares,
/// as a share of the mean, so that no sample is without weight.
pub(super) const POWERS: [i32; 2] = [2, 6];
pub(super) const LEAST_WEIGHT: f64 = 0.01;
/// A power ends with a step that leaves more than this share of what is missing.
pub(super) const ENOUGH: f64 = 0.995;
/// What is added to the diagonal of the normal equations at first, as a share of its mean.
pub(super) const DAMPING: f64 = 1e-3;
/// How near to each other normals of two rounds of Lloyd's method are in the end.
pub(super) const SETTLED: f64 = 1e-6;

// hull.rs
/// Coordinates below this share of the extent are 0: products of three of them are then normal numbers.
pub(super) const ZERO_COORDINATE: f64 = 1e-60;

// principal_frame.rs
/// Moments that differ by less than this share belong to one axis of symmetry, about which any axis is principal: some
/// times the error to which they are known.
pub(super) const EQUAL_MOMENTS: f64 = 2e-5;

// curved_solids.rs
/// How much of its radius and height a cone loses at most where r is chosen, as a share.
pub(super) const LOST: f64 = 1e-3;
/// Sides beyond which a polygon is a circle to 3e-6.
pub(super) const CIRCLE_SIDES: usize = 1_000;

// rounding.rs
/// The repetition ends when the centre is the centroid to this share of the size, with fewer digits, which takes far
/// less time. For bodies too flat or long for these digits, it ends when the centre comes no nearer and is the centroid
/// to their precision. A last step with all digits follows; it changes the shape only by the product of this share and
/// k.
pub(super) const CENTRED: f64 = 1e-5;
/// Planes beyond which mass properties are found to `FEWER_DIGITS`: the time goes with their number.
pub(super) const FEW_PLANES: usize = 30;
/// The tolerance of mass properties with fewer digits.
pub(super) const FEWER_DIGITS: f64 = 1e-4;

// sharp_body.rs
/// A centroid nearer to the origin than this share of the farthest corner's distance is set to it: sums over the faces
/// are rounded by a few units.
pub(super) const OF_SUMS: f64 = gamma(32);

// surface.rs
/// How far the area of the triangles may be from that of the hull, as a share.
pub(super) const COVERED: f64 = 1e-3;

// touching.rs
/// Distance at which a face is touched, and least distance that is made up for, over the depth of planes below faces.
pub(super) const TOUCHED: f64 = 1e-5;
pub(super) const UNTOUCHED: f64 = 1e-7;
