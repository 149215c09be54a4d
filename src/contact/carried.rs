//! The last contact of a pair carried on to new poses, without a look at any plane.
//!
//! At a contact that is solved, S_A and S_B are known as quadratics, each in the frame of its own body, and so is how far a
//! point may move there before a plane switches. While the contact point stays within, midway at new poses is the problem of
//! the same two quadratics: (1−u)∇S_A + u∇S_B = 0 and S_A = S_B (paper eq. 4). Newton's method from the last point solves
//! it, a step or two of one 3×3 factorisation each; what a further step would change, from the slope and the mismatch that are
//! left, bounds the error (docs/theory.md, "Carrying a contact on").

use crate::bounds::gap::Scale;
use crate::bounds::solution::Solution;
use crate::contact::contact::{Contact, Kind};
use crate::contact::geometry::LocalContact;
use crate::flags::Flags;
use crate::linalg::number::{larger, smaller};
use crate::linalg::symmetric::{Factor, Symmetric};
use crate::model::local_model::{LocalModel, Piece};
use crate::pair::placed_particle::Body;
use crate::pair::relative_pose::Pair;
use crate::particle::particle::Particle;
use crate::pose::Pose;
use crate::settings::Settings;
use nalgebra::Vector3;

/// What a solved contact of one ordered pair says about poses near by; empty by default.
///
/// Unlike [`crate::Memory`] it is no hint: the answer rests on it. So it is written by the library only, and is of use to the
/// two particles alone for which it was written.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub struct Carried {
    /// Serial numbers of A and B; 0 where nothing is known.
    of: [u64; 2],
    pieces: [KnownPiece; 2],
    /// The contact point, frame of B.
    x: Vector3<f64>,
    /// Weight u of B.
    weight: f64,
    /// Bounds that the contact had when it was solved.
    gap: f64,
    point_bound: f64,
    /// `gap_tolerance` and `flat_regularisation` with which it was solved.
    precision: [f64; 2],
}

/// S about a point in the frame of its body.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
struct KnownPiece {
    from: Vector3<f64>,
    value: f64,
    gradient: Vector3<f64>,
    hessian: Symmetric,
    /// How far from there it is S for sure, and places are rounded by no more than three times as much; length.
    reach: f64,
}

/// A piece at another point.
struct Here {
    value: f64,
    gradient: Vector3<f64>,
    /// Distance to where the piece is known from.
    moved: f64,
}

/// Newton steps, of which nearly every contact takes one; a contact that wants more is solved from its planes.
const MOST_STEPS: usize = 3;

/// Each step is at most this share of the last: Newton's method converges then (Kantorovich's theorem asks for the half).
const CONVERGING: f64 = 0.25;

/// Bound on how many times that of the solved contact the rounding of places is within reach (derived: 3.1).
const MORE_ROUNDING: f64 = 4.0;

/// Units of rounding, times the ratio of curvatures, in a slope that is carried along a distance (estimated).
const SLOPE_ROUNDING: f64 = 16.0 * f64::EPSILON;

impl KnownPiece {
    /// Of the potential of a body whose quadratic at this point has its axes turned into the body's own by `turn`.
    fn of(model: &LocalModel, body: &Body, i: usize) -> Self {
        let q = if i == 0 { &model.q_a } else { &model.q_b };
        let point = &model.points[i];
        let clear = q.clear - MORE_ROUNDING * point.blur;
        Self {
            from: point.y,
            value: q.expansion,
            gradient: body.turn(&q.gradient),
            hessian: body.turn_matrix(&q.hessian),
            reach: smaller(clear / body.particle.bounds.longest_normal, point.y.norm()),
        }
    }

    #[inline(always)]
    fn at(&self, y: &Vector3<f64>) -> Here {
        let way = y - self.from;
        let change = self.hessian.times(&way);
        Here {
            value: self.value + (self.gradient + 0.5 * change).dot(&way),
            gradient: self.gradient + change,
            moved: way.norm(),
        }
    }
}

fn precision_of(settings: &Settings) -> [f64; 2] {
    [settings.gap_tolerance, settings.flat_regularisation]
}

impl Carried {
    /// From a contact that was solved as an overlap in doubles; empty where its quadratics do not say enough.
    pub(crate) fn of(
        pair: &Pair,
        bodies: [&Body; 2],
        model: &LocalModel,
        solution: &Solution,
        settings: &Settings,
        scale: Scale,
        point_bound: f64,
    ) -> Self {
        let exact = model.in_solver_axes() && solution.linear && bodies.iter().all(|body| body.is_plain());
        let pieces = [KnownPiece::of(model, bodies[0], 0), KnownPiece::of(model, bodies[1], 1)];
        if !(exact && pieces.iter().all(|piece| piece.reach > 0.0)) {
            return Self::default();
        }
        Self {
            of: [pair.a.serial(), pair.b.serial()],
            pieces,
            x: solution.x,
            weight: solution.lambda / (1.0 + solution.lambda),
            gap: scale.gap,
            point_bound,
            precision: precision_of(settings),
        }
    }

    /// Whether the last contact was solved with these settings, as far as they matter.
    pub(crate) fn is_for(&self, settings: &Settings) -> bool {
        self.precision == precision_of(settings)
    }

    /// Contact point, frame of B, and ratio of weights λ of the last contact of these two, if known.
    pub(crate) fn last(&self, a: &Particle, b: &Particle) -> Option<(Vector3<f64>, f64)> {
        (self.of == [a.serial(), b.serial()]).then(|| (self.x, self.weight / (1.0 - self.weight)))
    }

    /// The contact at these poses, if the particles surely overlap there and the contact point is known to within
    /// `tolerance` times the smaller bounding radius.
    #[inline]
    pub(crate) fn contact(&mut self, a: (&Particle, &Pose), b: (&Particle, &Pose), tolerance: f64) -> Option<Contact> {
        if self.of != [a.0.serial(), b.0.serial()] {
            return None;
        }
        let pair = Pair::new(a.0, a.1, b.0, b.1);
        let room = tolerance * smaller(pair.a.bounding_radius(), pair.b.bounding_radius());
        let [known_a, known_b] = &self.pieces;
        let (h_a, h_b) = (known_a.hessian.turned(&pair.rotation), known_b.hessian);
        let (mut x, mut u, mut last) = (self.x, self.weight, f64::INFINITY);
        for step in 1..=MOST_STEPS {
            let (here_a, here_b) = (known_a.at(&pair.in_a(&x)), known_b.at(&x));
            let (g_a, g_b) = (pair.rotation * here_a.gradient, here_b.gradient);
            let h = h_a.weighted(1.0 - u, &h_b, u);
            let soft = 2.0 * ((1.0 - u) * pair.a.sphere_weight + u * pair.b.sphere_weight);
            let factor = Factor::of(&h, soft)?;
            // H v + d·du = −slope and d·v = S_A − S_B, with d = ∇S_B − ∇S_A.
            let apart = g_b - g_a;
            let along = factor.solve(&apart);
            let rate = apart.dot(&along);
            // With it, twice what the slope alone leaves of the weighted sum.
            let newton = |slope: &Vector3<f64>, behind: f64| {
                let first = factor.solve(slope);
                let du = -(behind + apart.dot(&first)) / rate;
                (-(first + du * along), du, slope.dot(&first))
            };
            let (v, du, _) = newton(&((1.0 - u) * g_a + u * g_b), here_a.value - here_b.value);
            // What the quadratics leave after it, exactly, and what that would change.
            let bend = h_b.times(&v) - h_a.times(&v);
            let (rest, behind) = (du * bend, -0.5 * v.dot(&bend));
            let (more, du_more, _) = newton(&rest, behind);
            let (length, off) = (v.norm(), more.norm());
            // Written so that what is not a number fails.
            if !(off <= CONVERGING * length || off <= f64::MIN_POSITIVE) || !(length <= CONVERGING * last) {
                return None;
            }
            let way = v + more;
            (x, u, last) = (x + way, u + du + du_more, length);
            if off <= room {
                let changes = [h_a.times(&way), h_b.times(&way)];
                let gradients = [g_a + changes[0], g_b + changes[1]];
                let values = [
                    here_a.value + (g_a + 0.5 * changes[0]).dot(&way),
                    here_b.value + (g_b + 0.5 * changes[1]).dot(&way),
                ];
                let (next, _, open) = newton(&((1.0 - u) * gradients[0] + u * gradients[1]), values[0] - values[1]);
                let next = next.norm();
                // Where it is no shorter by far, it must be rounding.
                if !(next <= larger(CONVERGING * off, self.point_bound)) {
                    return None;
                }
                let moved = [here_a.moved + way.norm(), here_b.moved + way.norm()];
                let steep = SLOPE_ROUNDING * h.trace() / soft * (moved[0] + moved[1]);
                let left = ((values[0] - values[1]).abs() + open, 2.0 * next + steep);
                let optimum = Optimum { x, u, gradients, values, moved, left };
                return self.placed(&pair, b.1, &optimum, [&h_a, &h_b], step as u32);
            }
        }
        None
    }

    #[inline(always)]
    fn placed(
        &mut self,
        pair: &Pair,
        pose_b: &Pose,
        optimum: &Optimum,
        hessians: [&Symmetric; 2],
        steps: u32,
    ) -> Option<Contact> {
        let &Optimum { x, u, gradients, values, moved, left } = optimum;
        let square = (1.0 - u) * values[0] + u * values[1];
        let s = square.sqrt();
        let share = |i: usize| moved[i] / self.pieces[i].reach;
        let share = larger(share(0), share(1));
        // Depths and distances from the centres change by that share at most, places are rounded as much more.
        let grown = (1.0 + 3.0 * share) * (1.0 + 3.0 * share) / (1.0 - share);
        let gap = grown * self.gap + left.0 / s;
        let rest = [self.pieces[0].reach - moved[0], self.pieces[1].reach - moved[1]];
        if !(u > 0.0 && u < 1.0 && rest[0] > 0.0 && rest[1] > 0.0 && s + gap < 1.0) {
            return None;
        }
        let lambda = u / (1.0 - u);
        let gradient_norms = [gradients[0].norm(), gradients[1].norm()];
        let solution = Solution { gradients, gradient_norms, values, ..Solution::unsettled(x, lambda, steps) };
        let pieces =
            |n: &Vector3<f64>| [0, 1].map(|i| Piece { curvature: hessians[i].times(n).dot(n), reach: rest[i] });
        // That of the pieces, which are turned back and forth, and that of this place.
        let bound = (1.0 + grown) * self.point_bound + left.1;
        let local = LocalContact::midway(pair, &solution, Scale { s, gap, low: s - gap }, || bound, pieces, true)?;
        (self.x, self.weight) = (x, u);
        let call = Contact { flags: Flags::WARM.with(Flags::CARRIED), iterations: steps, ..Contact::UNKNOWN };
        let contact = local.placed(pair, pose_b, call);
        debug_assert!(contact.kind == Kind::Overlapping && larger(contact.overlap, 0.0) == contact.overlap);
        Some(contact)
    }
}

/// Where Newton's method ended, frame of B.
struct Optimum {
    x: Vector3<f64>,
    u: f64,
    gradients: [Vector3<f64>; 2],
    values: [f64; 2],
    /// From where each piece is known.
    moved: [f64; 2],
    /// What is left of S, and of the point.
    left: (f64, f64),
}
