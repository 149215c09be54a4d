//! The contact: point, normal and overlap from a solution.

use crate::expansion::Piece;
use crate::outcome::Outcome;
use crate::pair::Pair;
use crate::pose::Pose;
use crate::settings::{BackEnd, Formulation};
use crate::surface;
use nalgebra::Vector3;

/// Whether the particles overlap. A failure is an error, never a kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// s ≥ 1.
    Separated,
    /// s < 1.
    Overlapping,
}

/// What else is to be known about an answer; a set of bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Flags(u32);

impl Flags {
    /// A centre lies inside the other particle: the constraint of closest is slack, the geometry midway's.
    pub const SLACK: Self = Self(1);
    /// Separation was proved without solving to the end; s is a lower bound.
    pub const REJECTED: Self = Self(2);
    /// Both gradients vanish: the normal is the line of centres.
    pub const NORMAL_BY_CENTRES: Self = Self(4);
    /// Started from memory.
    pub const WARM: Self = Self(8);
    /// The fast solver needed its safer factorisation after the plain one had failed.
    pub const SAFER: Self = Self(16);
    /// The fast solver failed; the conic back end answered.
    pub const FELL_BACK: Self = Self(32);
    /// The gap exceeds the tolerance, because rounding allows no better.
    pub const ROUNDING_LIMITED: Self = Self(64);

    /// Rejected: two balls that hold the particles do not meet.
    pub const BY_SPHERES: Self = Self(128);
    /// Rejected: one particle lies beyond a face of the other.
    pub const BY_FACE: Self = Self(256);
    /// Rejected: what separated the pair at the last call still does.
    pub const BY_MEMORY: Self = Self(512);

    /// The bits, as in the C interface.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// Whether all bits of `other` are set.
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// The bits of both.
    pub(crate) const fn with(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    pub(crate) fn insert(&mut self, other: Self) {
        self.0 |= other.0;
    }
}

/// The answer for one pair, world axes, lengths in the caller's unit. What does not apply is NaN.
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    /// Separated or overlapping.
    pub kind: Kind,
    /// The formulation that the geometry answers (midway where closest is slack).
    pub formulation: Formulation,
    /// Who answered.
    pub back_end: BackEnd,
    /// What else is to be known.
    pub flags: Flags,
    /// Pairs of quadratics solved (fast) or interior-point iterations (conic).
    pub iterations: u32,
    /// Midway: t. Closest: s_A at P2. Rejected: a proved lower bound, ≥ 1.
    pub s: f64,
    /// Closest: s_B at P1; NaN for midway.
    pub s_b: f64,
    /// Weight u of B: (1−u)∇S_A + u∇S_B = 0.
    pub weight: f64,
    /// |s − s*| ≤ gap (and the same for s_b).
    pub gap: f64,
    /// Bound on the distance of the point (of closest: of each of P1 and P2) to the optimum, length.
    pub point_bound: f64,
    /// Overlap, > 0 when overlapping; NaN when separated.
    pub overlap: f64,
    /// Separated: the particles are at least this far from each other, as far as the proof knows; NaN when overlapping.
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

/// A contact in the local frame of B, before it is taken to the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LocalContact {
    pub point: Vector3<f64>,
    pub normal: Vector3<f64>,
    pub normal_by_centres: bool,
    /// On A, on B, and their distance; `None` when separated.
    pub surface: Option<(Vector3<f64>, Vector3<f64>, f64)>,
}

impl LocalContact {
    /// Midway: normal from both unit gradients at P3, surface points along it from there.
    ///
    /// `pieces` gives S_A and S_B along the normal: on the quadratics at P3 the surface is a square root away.
    pub fn midway(
        pair: &Pair,
        outcome: &Outcome,
        pieces: impl Fn(&Vector3<f64>) -> [Piece; 2],
        overlapping: bool,
    ) -> Option<Self> {
        let (x, gradients) = (&outcome.x, &outcome.gradients);
        let (normal, normal_by_centres) = normal(pair, gradients);
        let surface = if overlapping {
            let [of_a, of_b] = pieces(&normal);
            let way = |value: f64, piece: Piece, slope: f64, from_there: &dyn Fn(f64) -> Option<f64>| {
                let way = surface::root_of_piece(value - 1.0, slope, piece.curvature);
                if way.abs() <= piece.reach { Some(way) } else { from_there(way) }
            };
            let to_a = way(outcome.values[0], of_a, gradients[0].dot(&normal), &|guess| {
                surface::distance_near(pair.a, &pair.in_a(x), &pair.rotation.tr_mul(&normal), guess)
            })?;
            let to_b = way(outcome.values[1], of_b, -gradients[1].dot(&normal), &|guess| {
                surface::distance_near(pair.b, x, &-normal, guess)
            })?;
            let overlap = to_a + to_b;
            if overlap < 0.0 {
                // Where s < 1 by less than the rounding of the point, the surfaces seem to have passed: they meet half way.
                let touch = x + 0.5 * (to_a - to_b) * normal;
                Some((touch, touch, 0.0))
            } else {
                Some((x + to_a * normal, x - to_b * normal, overlap))
            }
        } else {
            None
        };
        Some(Self { point: *x, normal, normal_by_centres, surface })
    }

    /// Closest: overlap distance |P1 − P2|, contact point their weighted mean, normal from the gradients
    /// of A at P1 and of B at P2.
    pub fn closest(
        pair: &Pair,
        [p1, p2]: [&Vector3<f64>; 2],
        gradients: &[Vector3<f64>; 2],
        weight_on_a: f64,
        overlapping: bool,
    ) -> Self {
        let (normal, normal_by_centres) = normal(pair, gradients);
        Self {
            point: p2 + weight_on_a * (p1 - p2),
            normal,
            normal_by_centres,
            surface: overlapping.then(|| (*p1, *p2, (p1 - p2).norm())),
        }
    }
}

impl Contact {
    /// A contact of which only the proof of separation is known.
    pub(crate) fn separated(formulation: Formulation, s: f64) -> Self {
        let nan = Vector3::repeat(f64::NAN);
        let mut flags = Flags::default();
        flags.insert(Flags::REJECTED);
        Self {
            kind: Kind::Separated,
            formulation,
            back_end: BackEnd::Fast,
            flags,
            iterations: 0,
            s,
            s_b: f64::NAN,
            weight: f64::NAN,
            gap: f64::NAN,
            point_bound: f64::NAN,
            overlap: f64::NAN,
            distance: 0.0,
            normal: nan,
            point: nan,
            branch_a: nan,
            branch_b: nan,
            point_on_a: nan,
            point_on_b: nan,
        }
    }

    /// Fills in the geometry, taken to world axes last.
    pub(crate) fn place(&mut self, local: &LocalContact, pair: &Pair, pose_a: &Pose, pose_b: &Pose) {
        self.normal = pose_b.rotate(&local.normal);
        self.branch_b = pose_b.rotate(&local.point);
        self.branch_a = pose_a.rotate(&pair.in_a(&local.point));
        self.point = pose_b.position + self.branch_b;
        if local.normal_by_centres {
            self.flags.insert(Flags::NORMAL_BY_CENTRES);
        }
        if let Some((on_a, on_b, overlap)) = local.surface {
            self.overlap = overlap;
            self.point_on_a = pose_b.position + pose_b.rotate(&on_a);
            self.point_on_b = pose_b.position + pose_b.rotate(&on_b);
        }
    }
}

/// Unit normal from A to B in the frame of B, from ∇S_A and ∇S_B; and whether it had to be taken from the centres
/// because both vanish.
fn normal(pair: &Pair, gradients: &[Vector3<f64>; 2]) -> (Vector3<f64>, bool) {
    let [outward_a, outward_b] = gradients.map(|g| g.try_normalize(0.0));
    let combined = match (outward_a, outward_b) {
        (Some(a), Some(b)) => (a - b).try_normalize(1e-3).or(Some(a)),
        (Some(a), None) => Some(a),
        (None, Some(b)) => Some(-b),
        (None, None) => None,
    };
    match combined {
        Some(normal) => (normal, false),
        None => ((-pair.centre).try_normalize(0.0).unwrap_or_else(Vector3::x), true),
    }
}
