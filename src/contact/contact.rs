//! The contact: point, normal and overlap from a solution.

use crate::bounds::gap::Scale;
use crate::bounds::solution::Solution;
use crate::linalg::number::larger;
use crate::model::local_model::Piece;
use crate::pair::placed_particle;
use crate::pair::pose::Pose;
use crate::pair::relative_pose::Pair;
use crate::particle::particle::Particle;
use crate::particle::potential;
use crate::particle::ray_cast;
use crate::settings::{BackEnd, Formulation};
use crate::solver::call::CertifiedPoint;
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

/// What else is to be known about an answer; a set of bits.
///
/// ```
/// use potential_particles::Flags;
/// let flags = Flags::REJECTED | Flags::BY_FACE;
/// assert!(flags.contains(Flags::BY_FACE) && !flags.contains(Flags::WARM));
/// assert_eq!(flags.to_string(), "rejected, by face");
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(transparent))]
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
    /// Answered in extended precision (about 32 digits): doubles did not settle it, or not to the gap that was asked for.
    pub const EXTENDED: Self = Self(16);
    /// The gap exceeds the tolerance, because rounding allows no better.
    pub const ROUNDING_LIMITED: Self = Self(64);

    /// Rejected: two balls that hold the particles do not meet.
    pub const BY_SPHERES: Self = Self(128);
    /// Rejected: one particle lies beyond a face of the other.
    pub const BY_FACE: Self = Self(256);
    /// Rejected: what separated the pair at the last call still does.
    pub const BY_MEMORY: Self = Self(512);
    /// [`crate::Settings::flat_regularisation`] was raised, and its default value was used in this call instead: the raised one
    /// would have left open whether the particles overlap.
    pub const DEFAULT_REGULARISATION: Self = Self(1024);

    /// Every flag with its name, in the order of the bits.
    const NAMES: [(Self, &'static str); 10] = [
        (Self::SLACK, "slack"),
        (Self::REJECTED, "rejected"),
        (Self::NORMAL_BY_CENTRES, "normal by centres"),
        (Self::WARM, "warm"),
        (Self::EXTENDED, "extended"),
        (Self::ROUNDING_LIMITED, "rounding limited"),
        (Self::BY_SPHERES, "by spheres"),
        (Self::BY_FACE, "by face"),
        (Self::BY_MEMORY, "by memory"),
        (Self::DEFAULT_REGULARISATION, "default regularisation"),
    ];

    /// The bits, as in the C interface.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// Whether all bits of `other` are set.
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// Whether any bit of `other` is set.
    #[cfg(feature = "capi")]
    pub(crate) const fn has_any(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }

    /// The bits of both.
    pub(crate) const fn with(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    pub(crate) fn insert(&mut self, other: Self) {
        self.0 |= other.0;
    }
}

impl std::ops::BitOr for Flags {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        self.with(other)
    }
}

/// The names of the flags that are set, with commas between them; "none" where none is.
impl fmt::Display for Flags {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if self.0 == 0 {
            return f.write_str("none");
        }
        let set = Self::NAMES.iter().filter(|(flag, _)| self.contains(*flag));
        for (i, (_, name)) in set.enumerate() {
            write!(f, "{}{name}", if i == 0 { "" } else { ", " })?;
        }
        Ok(())
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
    /// Pairs of quadratics solved; interior-point iterations of the conic back end.
    pub iterations: u32,
    /// Midway: t. Closest: s_A at P2. Rejected: a proved lower bound, ≥ 1.
    pub s: f64,
    /// Closest: s_B at P1; NaN for midway.
    pub s_b: f64,
    /// Weight u of B: (1−u)∇S_A + u∇S_B = 0.
    pub weight: f64,
    /// |s − s*| ≤ gap (and the same for s_b). Every constant in it is derived (docs/theory.md). In extended precision it is proved;
    /// in doubles it counts rounding to first order: estimated.
    pub gap: f64,
    /// Estimated bound on the distance of the point (of closest: of each of P1 and P2) to the optimum, length: of first order in
    /// the rounding of the data.
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

/// A contact in the local frame of B, before it is taken to the world; the numbers as in [`Contact`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct LocalContact {
    formulation: Formulation,
    s: f64,
    s_b: f64,
    lambda: f64,
    gap: f64,
    point_bound: f64,
    point: Vector3<f64>,
    normal: Vector3<f64>,
    normal_by_centres: bool,
    /// `None` when separated.
    surface: Option<Surface>,
}

/// Where the surfaces are.
#[derive(Clone, Copy, Debug)]
enum Surface {
    /// So far from the contact point along the normal, and against it.
    Along(f64, f64),
    /// P1 and P2.
    At(Vector3<f64>, Vector3<f64>),
}

impl LocalContact {
    /// Midway: normal from both unit gradients at P3, surface points along it from there.
    ///
    /// `pieces` gives S_A and S_B along a vector: on the quadratics at P3 the surface is a square root away.
    #[inline(always)]
    pub fn midway(
        pair: &Pair,
        solution: &Solution,
        scale: Scale,
        point_bound: impl Fn() -> f64,
        pieces: impl Fn(&Vector3<f64>) -> [Piece; 2],
        overlapping: bool,
    ) -> Option<Self> {
        let (x, gradients) = (&solution.x, &solution.gradients);
        let across = Across::of(pair, gradients, solution.gradient_norms);
        let normal = across.normal();
        let surface = if overlapping {
            let pieces = pieces(&across.vector);
            let (ray_a, ray_b) = (|| Ray::of_a(pair, x, &normal), || Ray::of_b(pair, x, &normal));
            let to_a = across.way(solution.values[0], pieces[0], &gradients[0], |guess| ray_a().way(guess))?;
            let to_b = across.way(solution.values[1], pieces[1], &-gradients[1], |guess| ray_b().way(guess))?;
            // Where s < 1 by less than the rounding of the point, the surfaces seem to have passed each other.
            let passed = to_a + to_b < 0.0;
            let (to_a, to_b) = if passed { meeting([ray_a(), ray_b()], [to_a, to_b]) } else { (to_a, to_b) };
            Some(Surface::Along(to_a, to_b))
        } else {
            None
        };
        Some(Self {
            formulation: Formulation::Midway,
            s: scale.s,
            s_b: f64::NAN,
            lambda: solution.lambda,
            gap: scale.gap,
            point_bound: point_bound(),
            point: *x,
            normal,
            normal_by_centres: across.by_centres,
            surface,
        })
    }

    /// Closest: overlap distance |P1 − P2|, contact point their weighted mean, normal from the gradients
    /// of A at P1 and of B at P2.
    pub fn closest(pair: &Pair, [p1, p2]: &[CertifiedPoint; 2], weight_on_a: f64, overlapping: bool) -> Self {
        let across =
            Across::of(pair, &[p1.gradients[0], p2.gradients[1]], [p1.gradient_norms[0], p2.gradient_norms[1]]);
        let way = p1.x - p2.x;
        Self {
            formulation: Formulation::Closest,
            s: p2.scale.s,
            s_b: p1.scale.s,
            lambda: p2.lambda,
            gap: p2.scale.gap.max(p1.scale.gap),
            point_bound: p2.bound.max(p1.bound),
            point: p2.x + weight_on_a * way,
            normal: across.normal(),
            normal_by_centres: across.by_centres,
            surface: overlapping.then_some(Surface::At(p1.x, p2.x)),
        }
    }

    /// In world axes; what is not of the geometry is taken from `call`.
    #[inline(always)]
    pub fn placed(&self, pair: &Pair, pose_b: &Pose, call: Contact) -> Contact {
        let (normal, branch_b) = (pose_b.rotate(&self.normal), pose_b.rotate(&self.point));
        let point = pose_b.position() + branch_b;
        let by_centres = if self.normal_by_centres { Flags::NORMAL_BY_CENTRES } else { Flags::default() };
        let contact = Contact {
            formulation: self.formulation,
            flags: call.flags.with(by_centres),
            s: self.s,
            s_b: self.s_b,
            weight: self.lambda / (1.0 + self.lambda),
            gap: self.gap,
            point_bound: self.point_bound,
            normal,
            branch_b,
            // From the centre of A before anything is rotated: a short branch keeps its digits.
            branch_a: pose_b.rotate(&(self.point - pair.centre)),
            point,
            ..call
        };
        let (point_on_a, point_on_b, overlap) = match self.surface {
            None => return contact,
            // Where s < 1 by rounding alone, so may be the sum.
            Some(Surface::Along(to_a, to_b)) => {
                let (on_a, on_b) = (branch_b + to_a * normal, branch_b - to_b * normal);
                (pose_b.position() + on_a, pose_b.position() + on_b, larger(to_a + to_b, 0.0))
            }
            Some(Surface::At(p1, p2)) => {
                (pose_b.position() + pose_b.rotate(&p1), pose_b.position() + pose_b.rotate(&p2), (p1 - p2).norm())
            }
        };
        Contact { kind: Kind::Overlapping, distance: f64::NAN, overlap, point_on_a, point_on_b, ..contact }
    }
}

impl Contact {
    /// A pair of which nothing is known yet.
    pub(crate) const UNKNOWN: Self = {
        let nan = Vector3::new(f64::NAN, f64::NAN, f64::NAN);
        Self {
            kind: Kind::Separated,
            formulation: Formulation::Midway,
            back_end: BackEnd::Fast,
            flags: Flags(0),
            iterations: 0,
            s: f64::NAN,
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
    };

    /// A contact of which only the proof of separation is known.
    pub(crate) fn separated(formulation: Formulation, s: f64) -> Self {
        Self { formulation, flags: Flags::REJECTED, s, ..Self::UNKNOWN }
    }
}

/// The direction from A to B.
struct Across {
    /// Along the normal, of any length: what needs no unit vector does not wait for the root.
    vector: Vector3<f64>,
    length: f64,
    /// Whether it had to be taken from the centres because both gradients vanish.
    by_centres: bool,
}

impl Across {
    /// From ∇S_A and ∇S_B and their lengths, frame of B.
    #[inline(always)]
    fn of(pair: &Pair, gradients: &[Vector3<f64>; 2], gradient_norms: [f64; 2]) -> Self {
        let vector = gradients[0] * (1.0 / gradient_norms[0]) - gradients[1] * (1.0 / gradient_norms[1]);
        let square = vector.norm_squared();
        if square > OPPOSED && square < f64::INFINITY {
            Self { vector, length: square.sqrt(), by_centres: false }
        } else {
            let (vector, by_centres) = normal_of_extremes(pair, gradients);
            Self { vector, length: 1.0, by_centres }
        }
    }

    /// At unit length.
    #[inline(always)]
    fn normal(&self) -> Vector3<f64> {
        self.vector / self.length
    }

    /// How far the surface is where S is this piece, with the gradient at its beginning: on the quadratic at hand, or from
    /// where that would be. A piece of no reach says nothing, not even that a point where it is 1 lies on the surface.
    #[inline(always)]
    fn way(
        &self,
        value: f64,
        piece: Piece,
        gradient: &Vector3<f64>,
        from_there: impl Fn(f64) -> Option<f64>,
    ) -> Option<f64> {
        let way = self.length * ray_cast::root_of_piece(value - 1.0, gradient.dot(&self.vector), piece.curvature);
        if way.abs() < piece.reach { Some(way) } else { from_there(way) }
    }
}

/// A line from the contact point to the surface of one body, in its own frame.
struct Ray<'a> {
    particle: &'a Particle,
    from: Vector3<f64>,
    outwards: Vector3<f64>,
    /// Bound on the rounding of where it begins.
    shift: f64,
}

impl<'a> Ray<'a> {
    fn of_a(pair: &Pair<'a>, x: &Vector3<f64>, normal: &Vector3<f64>) -> Self {
        let from = pair.in_a(x);
        let shift = placed_particle::shift_in_a(from.norm(), pair.centre.norm());
        Self { particle: pair.a, from, outwards: pair.rotation.tr_mul(normal), shift }
    }

    fn of_b(pair: &Pair<'a>, x: &Vector3<f64>, normal: &Vector3<f64>) -> Self {
        Self { particle: pair.b, from: *x, outwards: -normal, shift: placed_particle::shift_in_b(x.norm()) }
    }

    /// How far the surface is, near a guess.
    fn way(&self, guess: f64) -> Option<f64> {
        ray_cast::distance_near(self.particle, &self.from, &self.outwards, guess).or_else(|| self.beside())
    }

    /// The same from a point of the body within twice the rounding of the beginning.
    #[cold]
    fn beside(&self) -> Option<f64> {
        ray_cast::distance_beside(self.particle, &self.from, &self.outwards, self.shift)
    }

    /// |cos| of the angle at which it meets the level surface where it begins.
    fn slant(&self) -> f64 {
        let gradient = potential::tangent(self.particle, &self.from).gradient;
        (gradient.dot(&self.outwards) / gradient.norm()).abs()
    }
}

/// Ways to where two surfaces that have passed each other by rounding meet, as far from the one as from the other. One that is met
/// aslant is that much nearer than it seems along the normal.
#[cold]
fn meeting(rays: [Ray; 2], ways: [f64; 2]) -> (f64, f64) {
    // From a point that rounding has put in front of a face along the normal it is a long way to that face.
    let [to_a, to_b] = [0, 1].map(|i| {
        let astray = ways[i] < -2.0 * rays[i].shift;
        astray.then(|| rays[i].beside()).flatten().unwrap_or(ways[i])
    });
    let passed = to_a + to_b;
    if passed >= 0.0 {
        return (to_a, to_b);
    }
    let [of_a, of_b] = rays.map(|ray| ray.slant());
    let share = of_b / (of_a + of_b);
    // Without a gradient, half way.
    let share = if share.is_finite() { share } else { 0.5 };
    (to_a - share * passed, to_b - (1.0 - share) * passed)
}

/// Unit normal where a gradient vanishes, both point the same way, or a square is no number; and whether it had to be taken
/// from the centres.
#[cold]
fn normal_of_extremes(pair: &Pair, gradients: &[Vector3<f64>; 2]) -> (Vector3<f64>, bool) {
    let [outward_a, outward_b] = gradients.map(|g| direction(&g));
    let combined = match (outward_a, outward_b) {
        (Some(a), Some(b)) => (a - b).try_normalize(OPPOSED.sqrt()).or(Some(a)),
        (a, b) => a.or(b.map(|b| -b)),
    };
    match combined {
        Some(normal) => (normal, false),
        None => (direction(&-pair.centre).unwrap_or_else(Vector3::x), true),
    }
}

/// Square of the difference of two unit vectors that is too small to tell a direction.
const OPPOSED: f64 = 1e-6;

/// A vector at unit length, also where its square is lost or infinite; `None` if it has no direction.
fn direction(v: &Vector3<f64>) -> Option<Vector3<f64>> {
    let scaled = v / v.amax();
    scaled.iter().all(|c| c.is_finite()).then(|| scaled.normalize())
}
