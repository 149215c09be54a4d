//! The numbers by which a patch is integrated, all in one place. None is of the definition of the patch: they decide
//! how much work is done and what error is stated. Lengths are over the size of the bodies unless another is named, and
//! pressures over `length`. docs/patch.md has the errors and times that they lead to.

use crate::linalg::number::gamma;

/// The finest and the coarsest tolerance that is taken.
pub(super) const FINEST: f64 = 1e-12;
pub(super) const COARSEST: f64 = 0.1;

/// Ends of loops and sizes of buffers. Where one is met, another method takes over, and in the end the flag
/// TOLERANCE_NOT_REACHED.
pub(super) struct Limits;

impl Limits {
    /// Rays of one patch, points on them, and planes looked at in their cells: some tens of milliseconds together.
    pub const RAYS: usize = 1500;
    pub const NODES: usize = 500_000;
    pub const WORK: usize = 2_000_000;
    /// Cells on a ray, on the way to the surface along which the energy is integrated, and on a curve up to the rim.
    pub const RAY_CELLS: usize = 400;
    pub const ENERGY_CELLS: usize = 200;
    pub const CURVE_CELLS: usize = 64;
    /// Fixed-point and Newton steps without a bracket, and rounds in which planes of the network are found.
    pub const ITERATIONS: usize = 12;
    /// Halvings of an arc or a curve of the network.
    pub const HALVINGS: usize = 6;
    /// Halvings in the search for the direction in which the sequence of cells changes: the last is 6e-5 of a sector.
    pub const BORDER_HALVINGS: u32 = 14;
    /// Starts of the rays from a better centre.
    pub const STARTS: usize = 3;
    /// Planes of the network that may be loaded, as many as bits are kept, and its vertices.
    pub const PLANES: usize = 128;
    pub const VERTICES: usize = 400;
    /// Sides of an outline, halved or not, that is cut ear by ear.
    pub const SIDES: usize = 48;
    /// Triangles of a patch in cells.
    pub const TRIANGLES: usize = 256;
    /// Points around a disc.
    pub const AROUND_DISC: usize = 24;
}

/// How the tolerance of force and torque is split among the errors that add up to it: MAIN for the rules over cells,
/// zones or sectors, whose errors are estimated and refined to it, and MINOR for what is bounded once, before the rules
/// begin (the rules on a ray, or the load of an arc, a plane without a curve). One error of that kind dominates in a
/// patch, so that MAIN + MINOR = 1.
pub(super) struct ErrorBudget;

impl ErrorBudget {
    /// Part of the tolerance for each error that is bounded once.
    pub const MINOR: f64 = 0.1;
    /// Part of the tolerance for the rules.
    pub const MAIN: f64 = 1.0 - Self::MINOR;
    /// Part of MAIN that the sides of cells may take; where they take more they are drawn again, with PART of the
    /// tolerance. NEGLIGIBLE is left for the rules.
    pub const SIDES: f64 = 1.0 - Self::NEGLIGIBLE;
    pub const PART: f64 = 0.25;
    /// Part of the tolerance for the pieces of a fan next to borders that are not cut off there.
    pub const NEGLIGIBLE: f64 = 0.05;
}

/// Factors between what a rule shows of its error and the error itself, fitted to random pairs of bodies. Together they
/// are judged by `PATCH_ROUNDS=20000 cargo test --release --test patch patches_are_within_tolerance_and_estimate` (of
/// 59,539 patches 25 were off by more than twice their estimate: docs/patch.md).
pub(super) struct Fitted;

impl Fitted {
    /// By which an estimate without a second rule may be too small: the load beside the sides of cells, a disc's rule.
    pub const OPTIMISM: f64 = 3.0;
    /// Factor c of the coarse and the fine rule of triangles: the relative error is c d² over the least S, d the
    /// relative difference to the rule of lower degree. The nearer s = √S comes to its kink at 0, the slower the rules
    /// converge.
    pub const DIFFERENCE: [f64; 2] = [30.0, 10.0];
    /// What is left of the misfit in area once the middle of an arc is corrected by it.
    pub const CORRECTED: f64 = 0.2;
    /// Part of what lies beyond an event of a ray that another sequence of cells changes.
    pub const OTHER_SEQUENCE: f64 = 0.15;
    /// Error of three rays of a sector with a tip, over its load.
    pub const TIP_ERROR: f64 = 0.1;
    /// Error of 3 rays in a sector over the third power of the variation of their loads, both relative.
    pub const VARIATION: f64 = 0.05;
    /// Error of 3 and 7 rays over the distance by which their polynomial misses the loads at the ends.
    pub const ENDS: [f64; 2] = [0.02, 0.004];
    /// Relative error of a cap by one point; with two in each angle it is c + f d², [c, f] here, d the relative
    /// difference of both rules. d may be small by chance, hence c.
    pub const CAP_BY_ONE: f64 = 0.3;
    pub const CAP_BY_TWO: [f64; 2] = [0.003, 0.3];
    /// Error over the load by two points along a strip that tapers: one point along it would tell nothing.
    pub const TAPERED: f64 = 1e-3;
    /// A carried patch: relative error of force and torque over the square of the motion over the depth, and of the
    /// area over that motion: those of a corner, whose force grows with the third power of the depth.
    pub const CARRIED_FORCE: f64 = 3.0;
    pub const CARRIED_AREA: f64 = 2.0;
}

/// Rounding of s at a point, in units of the size of the bodies over r: of distances from planes and of the point
/// itself.
pub(super) const ROUNDING: f64 = gamma(8);
/// Lengths, areas over their square, and parts of a normal below this are rounding: products of a few doubles.
pub(super) const ROUNDED: f64 = 1e-12;
/// A step back on a ray that is rounding.
pub(super) const TINY_STEP: f64 = 1e-13;
/// Two events of one plane this near count as none, and two tangents at this angle are parallel.
pub(super) const COINCIDENT: f64 = 1e-9;
/// Distance of two walks, over that from the origin, that meet the same vertex.
pub(super) const SAME_VERTEX: f64 = 1e-6;
/// Distance from a side over its length of a place that is on it.
pub(super) const ON_CURVE: f64 = 1e-2;
/// Distance of the middle of an arc from the rim, over its length: the error of the patch is of second order in it.
pub(super) const ON_RIM: f64 = 1e-5;
/// How much farther than the points of it that are computed a curved border may be.
pub(super) const BULGE: f64 = 1.1;
/// tan ½θ of the largest turn θ = 1.1 of half an arc, and the most that a turn counts for in a first guess of its
/// middle.
pub(super) const HALF_TURN: f64 = 0.6;
pub(super) const MOST_HALF_TURN: f64 = 1.5;
/// Weight of a point of quadrature beside a curve over the square of its length.
pub(super) const POINT_BESIDE_CURVE: f64 = 1.0 / 32.0;

/// S at the contact point below which a contact is deep; k is then raised to DEEP_SPHERICITY, so that S has one least
/// point.
pub(super) const DEEP: f64 = 1e-3;
pub(super) const DEEP_SPHERICITY: f64 = 1e-5;
/// Overlaps within which planes are loaded first; further ones follow where they are met.
pub(super) const NEARBY: f64 = 4.0;
/// Bodies with no more planes than this together are loaded at once.
pub(super) const LOADED_AT_ONCE: usize = 48;

/// Zones come before cells up to this number of planes of both bodies: for boxes they cost less, but with many planes
/// they mostly fail.
pub(super) const ZONES_FIRST: usize = 16;
/// Least tolerance of zones and cells: zones have no rules of higher degree, and the parabolas that bound cells are not
/// refined any further.
pub(super) const FINEST_OF_PARTS: f64 = 1e-8;
/// Tolerance below which rules of few points are not trusted: the error of a rule then counts as much as its difference
/// to a coarser one, and edges are not made of zones.
pub(super) const FINE: f64 = 1e-5;
/// Error of the coarse rule in one triangle, over the allowed one, above which it is tried in no other: about corners
/// all triangles are alike.
pub(super) const HOPELESS: f64 = 60.0;

/// Slope beyond which a patch is no graph over the plane of its zones.
pub(super) const STEEPEST_GRAPH: f64 = 30.0;
/// Points of the rules of a strip, across and along, from coarse to fine; of a cap in both angles; of a disc outwards
/// and around, after its first rule, which has AROUND_DISC points around: on a sphere moments up to the second are
/// exact, on a torus they converge.
pub(super) const STRIP_RULES: [[usize; 2]; 5] = [[3, 2], [3, 3], [4, 4], [5, 8], [8, 14]];
pub(super) const CAP_RULES: [usize; 5] = [1, 2, 3, 5, 8];
pub(super) const DISC_RULES: [[usize; 2]; 3] = [[4, 10], [6, 14], [10, 24]];
pub(super) const AROUND_DISC: [usize; 2] = [5, 7];
/// Points on either side of the foot of a polygon's side that is seen under a wide angle: exact for squares of the
/// place along it.
pub(super) const WIDE_SIDE_POINTS: usize = 3;
/// Step in the search for the corner of a strip at which it has converged, and last step above which it has not, both
/// relative: the pressure is 0 at the corner, so that its error enters the load by a higher power.
pub(super) const SETTLED: f64 = 1e-6;
pub(super) const UNSETTLED: f64 = 1e-5;

/// Rays start again where the centre of pressure is farther from their centre than this share of the patch's radius.
pub(super) const OFF_CENTRE: f64 = 0.25;
/// Distance of two events on a ray at which it borders on another sequence of cells, relative and over the root of the
/// tolerance: the error is of second order in it.
pub(super) const EVENTS_MEET: f64 = 0.1;
/// Distance from a straight line, over its length, of a border that counts as straight: the loads of flat cells are
/// then polynomials.
pub(super) const STRAIGHT_BORDER: f64 = 1e-7;
/// A sector has a tip where its middle ray is this many times as long as the way to the middle of the chord between its
/// ends.
pub(super) const TIP: f64 = 2.0;
/// The load jumps between two neighbouring rays where its relative change exceeds JUMP and also STEEPEST_LOAD times
/// their angle.
pub(super) const JUMP: f64 = 0.1;
pub(super) const STEEPEST_LOAD: f64 = 30.0;
/// Largest angle of a sector that is made of several.
pub(super) const WIDEST_SECTOR: f64 = 1.7;
/// Distance of two points of a patch over the radius about the start of the walk, at most.
pub(super) const SPREAD: f64 = 2.0;
/// Length of the triangle that bounds a cell over the estimated distance of the rim, and the distance beyond which
/// there is none.
pub(super) const BEYOND_RIM: f64 = 1.25;
pub(super) const FARTHEST_RIM: f64 = 100.0;
/// Incline beyond which a walk goes on with its axes turned, as it does where the patch turns back: over upright axes
/// rules converge slowly there. From GENTLE at the start of a cell on they are turned at once, else after half of the
/// bend.
pub(super) const STEEP: f64 = 3.0;
pub(super) const GENTLE: f64 = 0.1;
/// Part of the way to where the patch turns back from which on a rim counts as beyond: rounding places it on either
/// side.
pub(super) const NEAR_TURN: f64 = 0.999;
/// Shortest part of a cell that gets a rule of its own.
pub(super) const SHORTEST_CELL: f64 = 1.0 / 256.0;
/// Gauss points in a cell for the energy.
pub(super) const ENERGY_POINTS: usize = 5;

/// Largest motion over the largest depth up to which a patch is carried on, over the root of the tolerance:
/// CARRIED_FORCE times its square is about a quarter of the tolerance.
pub(super) const FARTHEST_CARRIED: f64 = 0.3;
