//! Point, normal and overlap from a solution.

use crate::bounds::scale::Scale;
use crate::bounds::solution::Solution;
use crate::contact::contact::{Contact, Kind};
use crate::flags::Flags;
use crate::linalg::number::{direction, larger, smaller};
use crate::model::local_model::Piece;
use crate::model::problem::Problem;
use crate::pair::body;
use crate::pair::pair::Pair;
use crate::particle::particle::Particle;
use crate::particle::{potential, ray_cast};
use crate::pose::Pose;
use crate::settings::Formulation;
use crate::solver::call::{Call, Solved};
use crate::solver::closest::CertifiedPoint;
use nalgebra::Vector3;

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

/// Places of both surfaces.
#[derive(Clone, Copy, Debug)]
enum Surface {
    /// Distances from the contact point along the normal, and against it.
    Along(f64, f64),
    /// P1 and P2.
    At(Vector3<f64>, Vector3<f64>),
}

impl LocalContact {
    /// Midway: normal from both unit gradients at P3, surface points along it from there.
    #[inline(always)]
    pub fn midway(call: &Call, midway: &Solved, scale: Scale, overlapping: bool) -> Option<Self> {
        let bound = call.point_bound(midway, Problem::Midway);
        let across = Across::of(call.pair, &midway.solution.gradients, midway.solution.gradient_norms);
        let pieces = overlapping.then(|| call.pieces(midway, across.vector()));
        Self::along_normal(call.pair, &midway.solution, across, scale, bound, pieces)
    }

    /// Midway from the bound of its point and, where the particles overlap, S_A and S_B along the vector of `across`:
    /// on the quadratics at P3 the surface is a square root away.
    #[inline(always)]
    pub fn along_normal(
        pair: &Pair,
        solution: &Solution,
        across: Across,
        scale: Scale,
        point_bound: f64,
        pieces: Option<[Piece; 2]>,
    ) -> Option<Self> {
        let (x, gradients) = (&solution.x, &solution.gradients);
        let normal = across.normal();
        let surface = if let Some(pieces) = pieces {
            let (ray_a, ray_b) = (|| Ray::of_a(pair, x, &normal), || Ray::of_b(pair, x, &normal));
            let slope_a = (gradients[0] - pieces[0].surplus_gradient).dot(&across.vector);
            let slope_b = (gradients[1] - pieces[1].surplus_gradient).dot(&across.vector);
            let to_a = across.way(solution.values[0], pieces[0], slope_a, |guess| ray_a().way(guess))?;
            let to_b = across.way(solution.values[1], pieces[1], -slope_b, |guess| ray_b().way(guess))?;
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
            point_bound,
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
        // An s beyond 1 by rounding is taken back to 1, which counts as error.
        let consistent = |s: f64| if overlapping { smaller(s, LARGEST_BELOW_1) } else { larger(s, 1.0) };
        let gap = |scale: &Scale| scale.gap + (consistent(scale.s) - scale.s).abs();
        Self {
            formulation: Formulation::Closest,
            s: consistent(p2.scale.s),
            s_b: consistent(p1.scale.s),
            lambda: p2.lambda,
            gap: gap(&p2.scale).max(gap(&p1.scale)),
            point_bound: p2.bound.max(p1.bound),
            point: p2.x + weight_on_a * way,
            normal: across.normal(),
            normal_by_centres: across.by_centres,
            surface: overlapping.then_some(Surface::At(p1.x, p2.x)),
        }
    }

    pub fn point_bound(&self) -> f64 {
        self.point_bound
    }

    /// Fills the geometric fields of `call`, in world axes; the others stay.
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
            branch_a: pair.branch_a(&branch_b),
            point,
            ..call
        };
        let (point_on_a, point_on_b, overlap) = match self.surface {
            None => return contact,
            // The sum may be < 0 if s < 1 by rounding alone.
            Some(Surface::Along(to_a, to_b)) => {
                let (on_a, on_b) = (branch_b + to_a * normal, branch_b - to_b * normal);
                (pose_b.position() + on_a, pose_b.position() + on_b, larger(to_a + to_b, 0.0))
            }
            Some(Surface::At(p1, p2)) => {
                (pose_b.position() + pose_b.rotate(&p1), pose_b.position() + pose_b.rotate(&p2), (p1 - p2).norm())
            }
        };
        let is_deep = overlap > smaller(pair.a.depth_length(), pair.b.depth_length());
        let flags = if is_deep { contact.flags.with(Flags::DEEP) } else { contact.flags };
        Contact { kind: Kind::Overlapping, flags, distance: f64::NAN, overlap, point_on_a, point_on_b, ..contact }
    }
}

/// The direction from A to B.
pub(crate) struct Across {
    /// Along the normal, of any length: what needs no unit vector does not wait for the root.
    vector: Vector3<f64>,
    length: f64,
    /// Whether it had to be taken from the centres because both gradients vanish.
    by_centres: bool,
}

impl Across {
    /// Along a vector whose length is a number above 0.
    #[inline(always)]
    pub fn balanced(vector: Vector3<f64>) -> Self {
        Self { vector, length: vector.norm(), by_centres: false }
    }

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

    #[inline(always)]
    pub fn vector(&self) -> &Vector3<f64> {
        &self.vector
    }

    /// At unit length.
    #[inline(always)]
    fn normal(&self) -> Vector3<f64> {
        self.vector / self.length
    }

    /// Distance to the surface where S is this piece, of this slope along the vector: by the quadratic, or from the
    /// place that it gives. A piece without a validity radius proves nothing, not even that a point with S = 1 lies on
    /// the surface.
    #[inline(always)]
    fn way(&self, value: f64, piece: Piece, slope: f64, from_there: impl Fn(f64) -> Option<f64>) -> Option<f64> {
        let way = self.length * ray_cast::root_of_piece(value - piece.surplus - 1.0, slope, piece.curvature);
        if way.abs() < piece.validity_radius { Some(way) } else { from_there(way) }
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
        let shift = body::shift_in_a(from.norm(), pair.centre.norm());
        Self { particle: pair.a, from, outwards: pair.rotation.tr_mul(normal), shift }
    }

    fn of_b(pair: &Pair<'a>, x: &Vector3<f64>, normal: &Vector3<f64>) -> Self {
        Self { particle: pair.b, from: *x, outwards: -normal, shift: body::shift_in_b(x.norm()) }
    }

    /// Distance to the surface, near a guess.
    fn way(&self, guess: f64) -> Option<f64> {
        ray_cast::distance_near(self.particle, &self.from, &self.outwards, guess).or_else(|| self.beside())
    }

    /// Distance to the surface from a point of the body within twice the rounding of the beginning.
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

/// Resolves a negative overlap that is rounding: both surfaces are moved to a common point, each by a share of the
/// overlap in inverse proportion to the cosine at which the normal meets it.
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

/// Unit normal where a gradient vanishes, both point the same way, or a square is no number; and whether it had to be
/// taken from the centres.
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

/// The double before 1 (derived).
const LARGEST_BELOW_1: f64 = 1.0 - 0.5 * f64::EPSILON;

/// Square of the difference of two unit vectors that is too small to tell a direction. Chosen: a difference of 1e-3 has
/// lost three digits.
const OPPOSED: f64 = 1e-6;
