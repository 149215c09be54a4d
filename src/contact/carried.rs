//! The last contact of a pair carried on to new poses, without a solution from the planes.
//!
//! At a contact that is solved, S_A and S_B are known as quadratics, each in the frame of its own body, and so is how
//! far a point may move there before a plane switches. While the contact point stays within, midway at new poses is the
//! problem of the same two quadratics: (1−u)∇S_A + u∇S_B = 0 and S_A = S_B (paper eq. 4). Newton's method from the last
//! point solves it, with one 3×3 inverse for all its rounds; what a further round would change, from the slope and the
//! mismatch that are left, bounds the error (docs/theory.md, "Carrying a contact on").

use crate::bounds::scale::Scale;
use crate::bounds::solution::Solution;
use crate::contact::contact::{Contact, Kind};
use crate::contact::geometry::{Across, LocalContact};
use crate::contact::recentred::{MORE_ROUNDING, MOST_OPEN};
use crate::flags::Flags;
use crate::linalg::number::{gamma, larger, smaller};
use crate::linalg::symmetric::{Factor, Symmetric};
use crate::model::local_model::{self, LocalModel, Piece};
use crate::model::problem::Problem;
use crate::pair::body::Body;
use crate::pair::pair::Pair;
use crate::pair::pair_state::{How, KnownPiece, LastContact, PairState, Remembered};
use crate::pair::separation;
use crate::particle::particle::Particle;
use crate::pose::Pose;
use crate::settings::{Formulation, Settings};
use crate::solver::call::{Call, Solved};
use nalgebra::Vector3;

/// A piece at another point.
struct Here {
    value: f64,
    gradient: Vector3<f64>,
}

/// Most rounds: each takes a fiftieth of the instructions of a solve from the planes (chosen).
const MOST_ROUNDS: u32 = 8;

/// Each change is at most this share of the last: the method converges then (Kantorovich's theorem asks for the half).
/// Chosen.
const CONVERGING: f64 = 0.25;

/// The change that is left is at most this share of the last. It is predicted from two changes and may be ten times as
/// large: ten times this share is the half that the theorem asks for. Chosen.
const LAST_CHANGE: f64 = 0.05;

/// Share of the tolerance that the predicted next change may take: the prediction from the first two changes is up to
/// ten times too small (measured).
const ENOUGH: f64 = 0.02;

/// Largest share by which the weighted curvatures may change on the way: what is left is then known to a factor of two
/// (docs/theory.md). Chosen: 1/(1 − ρ) is at most 2.
const MOST_CHANGE: f64 = 0.5;

/// Ratio of curvatures up to which the inverse is taken by minors: it loses as many digits, and what is left is
/// measured at the end (chosen).
const MOST_STIFF: f64 = 1e9;

/// Most that the regularisation may have moved the solved point, relative to the smaller bounding radius: less than a
/// contact point has to be known to (chosen).
const MOST_MOVED: f64 = 1e-10;

/// The bound of a carried point is at least so many times that of the solved one: once for the data of the quadratics,
/// once for the new place. Derived: 1 + growth, which is 1 at least.
const INHERITED: f64 = 2.0;

/// Share of the validity radius beyond which the quadratics are set up anew about the point: bounds have grown 42 times
/// there, and would grow without limit towards 1 (chosen).
const MOST_USED: f64 = 0.75;

/// Units of rounding, times the ratio of curvatures, in a slope that is carried along a distance (estimated).
const SLOPE_ROUNDING: f64 = gamma(32);

impl KnownPiece {
    /// The piece of a body's own potential, in its own frame: the quadratic of the model without its regularisation.
    fn of(model: &LocalModel, body: &Body, i: usize) -> Self {
        let q = if i == 0 { &model.q_a } else { &model.q_b };
        let point = &model.points[i];
        let clear = q.clear - MORE_ROUNDING * point.blur;
        let added = body.surplus_curvature();
        Self {
            from: point.y,
            value: q.expansion - 0.5 * added * point.y.norm_squared(),
            gradient: body.turn(&q.gradient) - added * point.y,
            hessian: body.turn_matrix(&q.hessian.scaled(1.0, -added)),
            validity_radius: smaller(clear / body.particle.bounds.longest_normal, point.y.norm()),
        }
    }

    /// A piece of A in the frame of B.
    #[inline(always)]
    fn seen_from_b(&self, pair: &Pair) -> Self {
        Self {
            from: pair.rotation * self.from + pair.centre,
            gradient: pair.rotation * self.gradient,
            hessian: self.hessian.turned(&pair.rotation),
            ..*self
        }
    }

    #[inline(always)]
    fn at(&self, x: &Vector3<f64>) -> Here {
        let way = x - self.from;
        let change = self.hessian.times(&way);
        Here { value: self.value + (self.gradient + 0.5 * change).dot(&way), gradient: self.gradient + change }
    }
}

/// The equations of midway about a point x and weight u, for a way v and a change δ of the weight.
///
/// With slope σ, d = ∇S_B − ∇S_A and E = H_B − H_A they are H v + d·δ = −σ − δ·E v and d·v = S_A − S_B − ½ v·E v,
/// exactly.
struct Equations {
    slope: Vector3<f64>,
    mismatch: f64,
    apart: Vector3<f64>,
    bend: Symmetric,
    /// H⁻¹ times a unit: the adjugate, whose unit is the determinant of H, or the inverse itself. No solution waits for
    /// that division.
    inverse: Symmetric,
    unit: f64,
    per_unit: f64,
    /// H⁻¹d, and 1/(d·H⁻¹d), with H⁻¹ in that unit.
    along: Vector3<f64>,
    inverse_rate: f64,
    /// Ratio of the sum of the curvatures of H to the least one.
    stiffness: f64,
}

/// A round of the iteration.
#[derive(Clone, Copy)]
struct Converged {
    step: Step,
    /// Square of the change of the way by it.
    change: f64,
    number: u32,
}

/// How a point lies in what is known of a body.
#[derive(Clone, Copy)]
struct Within {
    /// Its distance from the solved point, length.
    moved: f64,
    /// By which share depths and distances from the centre have changed at most.
    share: f64,
    /// Distance from there within which no plane switches, length.
    left: f64,
}

impl Within {
    #[inline(always)]
    fn of([a, b]: &[KnownPiece; 2], x: &Vector3<f64>) -> [Self; 2] {
        [Self::of_one(a, x), Self::of_one(b, x)]
    }

    #[inline(always)]
    fn of_one(&KnownPiece { from, validity_radius, .. }: &KnownPiece, x: &Vector3<f64>) -> Self {
        let moved = (x - from).norm();
        Self { moved, share: moved / validity_radius, left: validity_radius - moved }
    }

    /// The rest of a piece from there on, along a vector.
    #[inline(always)]
    fn along(&self, piece: &KnownPiece, n: &Vector3<f64>) -> Piece {
        Piece { curvature: piece.hessian.times(n).dot(n), validity_radius: self.left, ..Piece::default() }
    }
}

/// A solution of the equations.
#[derive(Clone, Copy)]
struct Step {
    way: Vector3<f64>,
    /// Change of the weight u.
    weight: f64,
    /// σ·H⁻¹σ: twice what the slope alone leaves of the weighted sum.
    open: f64,
    /// H⁻¹σ, with the sign of a step: the way to where the slope is 0 with the weight as it is.
    at_weight: Vector3<f64>,
}

impl Equations {
    /// `soft` are the least curvatures of A and B.
    #[inline(always)]
    fn of([a, b]: &[KnownPiece; 2], x: &Vector3<f64>, u: f64, soft: [f64; 2]) -> Option<Self> {
        let here = [a.at(x), b.at(x)];
        let apart = here[1].gradient - here[0].gradient;
        let h = a.hessian.weighted(1.0 - u, &b.hessian, u);
        let adjugate = h.adjugate();
        let determinant = h.determinant(&adjugate);
        let least = larger((1.0 - u) * soft[0] + u * soft[1], h.least_eigenvalue(determinant));
        let stiffness = h.trace() / least;
        // By minors, whose divisions wait for nothing but each other: in a factorisation they follow one another.
        let (inverse, unit) =
            if stiffness <= MOST_STIFF { (adjugate, determinant) } else { (Factor::of(&h, least)?.inverse(), 1.0) };
        let along = inverse.times(&apart);
        Some(Self {
            slope: slope(&here, u),
            mismatch: here[0].value - here[1].value,
            apart,
            bend: b.hessian.weighted(1.0, &a.hessian, -1.0),
            inverse,
            along,
            inverse_rate: 1.0 / apart.dot(&along),
            per_unit: 1.0 / unit,
            unit,
            stiffness,
        })
    }

    /// The step that these right-hand sides, σ and S_A − S_B, call for.
    #[inline(always)]
    fn step(&self, slope: &Vector3<f64>, mismatch: f64) -> Step {
        let first = self.inverse.times(slope);
        let weight = -(mismatch * self.unit + self.apart.dot(&first)) * self.inverse_rate;
        let way = -self.per_unit * (first + weight * self.along);
        Step { way, weight, open: self.per_unit * slope.dot(&first), at_weight: -self.per_unit * first }
    }

    /// The solution of the equations to within `tolerance`; `None` where the rounds do not converge.
    #[inline(always)]
    fn solve(&self, tolerance: f64) -> Option<Converged> {
        let mut step = self.step(&self.slope, self.mismatch);
        let mut last = step.way.norm_squared();
        for number in 2..=MOST_ROUNDS {
            let bent = self.bend.times(&step.way);
            let next = self.step(&(self.slope + step.weight * bent), self.mismatch - 0.5 * step.way.dot(&bent));
            let change = (next.way - step.way).norm_squared();
            // Written so that what is not a number fails.
            if !(change <= CONVERGING * CONVERGING * last) {
                return None;
            }
            step = next;
            // Twice the next change, which must be at most `LAST_CHANGE` of this one, must be within `tolerance`.
            let short = 4.0 * LAST_CHANGE * LAST_CHANGE * change <= tolerance * tolerance;
            if short && change * change <= (ENOUGH * tolerance) * (ENOUGH * tolerance) * last {
                return Some(Converged { step, change, number });
            }
            last = change;
        }
        None
    }
}

/// The weighted sum (1−u)·a + u·b of gradients.
#[inline(always)]
fn slope([a, b]: &[Here; 2], u: f64) -> Vector3<f64> {
    (1.0 - u) * a.gradient + u * b.gradient
}

fn precision_of(settings: &Settings) -> [f64; 2] {
    [settings.gap_tolerance, settings.flat_regularisation]
}

/// Bound on how far the regularisation, which is left off from here on, has moved the solved point: it adds a slope to
/// the balance of forces and a value to either side. Infinite where that is not known, or where it was raised to move
/// the point.
fn moved_by_regularisation(bodies: [&Body; 2], solution: &Solution, settings: &Settings) -> f64 {
    if bodies.iter().all(|body| body.is_plain()) {
        return 0.0;
    }
    let Some(sensitivity) = solution.sensitivity.as_ref().filter(|_| !settings.raises_regularisation()) else {
        return f64::INFINITY;
    };
    let (a, b) = Problem::Midway.weights(solution.lambda);
    let slope = |body: &Body| body.surplus_gradient(&solution.x).norm();
    let value = larger(bodies[0].surplus(&solution.x), bodies[1].surplus(&solution.x));
    (a * slope(bodies[0]) + b * slope(bodies[1])) * sensitivity.per_slope() + sensitivity.to_value(value)
}

impl LastContact {
    /// The last contact of a pair that was solved in doubles, as an overlap or surely apart; empty where its quadratics
    /// do not say enough, or where no contact that is carried on could be known as well as the settings ask for.
    pub fn of(call: &Call, Solved { solution, model }: &Solved, scale: Scale, point_bound: f64) -> Self {
        let (pair, bodies, settings) = (call.pair, call.bodies(), call.settings);
        if !(model.in_solver_axes() && solution.linear) {
            return Self::default();
        }
        let moved = moved_by_regularisation(bodies, solution, settings);
        let radius = local_model::smallest(bodies);
        let known = INHERITED * (point_bound + moved) <= settings.carry_tolerance * radius;
        if !(moved <= MOST_MOVED * radius && known) {
            return Self::default();
        }
        let pieces = [KnownPiece::of(model, bodies[0], 0), KnownPiece::of(model, bodies[1], 1)];
        if !pieces.iter().all(|piece| piece.validity_radius > 0.0) {
            return Self::default();
        }
        Self {
            of: [pair.a.serial(), pair.b.serial()],
            pieces,
            gap: scale.gap,
            point_bound: point_bound + moved,
            square: scale.s * scale.s,
            roundings: [
                bodies[0].rounding(&model.points[0], &model.q_a),
                bodies[1].rounding(&model.points[1], &model.q_b),
            ],
            growth: 1.0,
            recentrings: 0.0,
            precision: precision_of(settings),
        }
    }

    /// The optimum near the last one, if it can be known to within `tolerance`.
    #[inline(always)]
    fn optimum(&self, pair: &Pair, pieces: &[KnownPiece; 2], last: &Remembered, tolerance: f64) -> Option<Optimum> {
        let soft = [2.0 * pair.a.sphere_weight, 2.0 * pair.b.sphere_weight];
        let weight = last.lambda / (1.0 + last.lambda);
        let equations = Equations::of(pieces, &last.x, weight, soft)?;
        let Converged { step, change, number } = equations.solve(tolerance)?;
        let (x, u) = (last.x + step.way, weight + step.weight);
        let here = [pieces[0].at(&x), pieces[1].at(&x)];
        // Residuals there, rounding included.
        let mismatch = here[0].value - here[1].value;
        let next = equations.step(&slope(&here, u), mismatch);
        let way = next.way.norm();
        // The curvatures there, H + δ·E, differ from those that were factored by no more than this share of H.
        let share = step.weight.abs() / smaller(weight, 1.0 - weight);
        let left_out = 1.0 + 2.0 * share * equations.stiffness.sqrt();
        let converges = way * way <= LAST_CHANGE * LAST_CHANGE * change && 2.0 * way * left_out <= tolerance;
        // A step that is not much shorter must be rounding.
        if !(share <= MOST_CHANGE && (converges || way <= self.point_bound)) {
            return None;
        }
        let left = Left {
            square: mismatch.abs() + next.open,
            way: way * left_out,
            at_weight: next.at_weight.norm() * left_out,
            stiffness: equations.stiffness,
        };
        Some(Optimum { x, u, here, left, rounds: number })
    }

    /// The optimum at new poses, known to within `tolerance`, or, where its point is followed out of the reach of the
    /// pieces, to within `recentred`.
    #[inline(always)]
    fn moved(&mut self, pair: &Pair, last: Remembered, tolerance: f64, recentred: f64) -> Option<Moved> {
        let mut pieces = [self.pieces[0].seen_from_b(pair), self.pieces[1]];
        let mut optimum = self.optimum(pair, &pieces, &last, tolerance)?;
        let mut within = Within::of(&pieces, &optimum.x);
        // Written so that what is not a number is looked at, and fails there.
        if !within.iter().all(|within| within.share <= MOST_USED) {
            let Optimum { x, u, .. } = optimum;
            self.recentre(pair, &x, optimum.square())?;
            // From there to the end: what long steps leave may be more than their changes tell.
            pieces = [self.pieces[0].seen_from_b(pair), self.pieces[1]];
            let near = Remembered { x, lambda: u / (1.0 - u), ..last };
            optimum = self.optimum(pair, &pieces, &near, recentred)?;
            within = Within::of(&pieces, &optimum.x);
        }
        Some(Moved { pieces, optimum, within })
    }

    /// Whether the particles were apart when they were solved.
    #[inline(always)]
    fn is_apart(&self) -> bool {
        self.square > 1.0
    }

    /// s there, with its bound, and the growth of the solved contact's bounds; `None` where weight or share is invalid.
    #[inline(always)]
    fn scale(&self, optimum: &Optimum, within: &[Within; 2]) -> Option<(Scale, f64)> {
        let s = optimum.square().sqrt();
        let share = larger(within[0].share, within[1].share);
        // Depths and distances from the centres change by that share at most, places are rounded as much more.
        let grown = self.growth * (1.0 + 3.0 * share) * (1.0 + 3.0 * share) / (1.0 - share);
        let gap = grown * self.gap + optimum.left.square / s;
        let certain = optimum.u > 0.0 && optimum.u < 1.0 && share < 1.0;
        certain.then_some((Scale { s, gap, low: s - gap, high: s + gap }, grown))
    }

    /// Lower bound of s, where it is above 1: weak duality, of quadratics that are S as far as their optimum.
    #[inline(always)]
    fn low(&self, optimum: &Optimum, within: &[Within; 2]) -> Option<f64> {
        let (Scale { low, .. }, _) = self.scale(optimum, within)?;
        let inside = within.iter().all(|within| within.left > optimum.left.at_weight);
        (inside && low > 1.0 && low < f64::INFINITY).then_some(low)
    }

    /// Its contact, frame of B; `None` where it is not certain, or its point not known to within `tolerance`.
    #[inline(always)]
    fn local(
        &self,
        pair: &Pair,
        pieces: &[KnownPiece; 2],
        optimum: &Optimum,
        within: [Within; 2],
        tolerance: f64,
    ) -> Option<LocalContact> {
        let Optimum { x, u, here: [a, b], left, rounds } = optimum;
        let (values, gradients) = ([a.value, b.value], [a.gradient, b.gradient]);
        let (scale, grown) = self.scale(optimum, &within)?;
        let steep = SLOPE_ROUNDING * left.stiffness * (within[0].moved + within[1].moved);
        // The bound of the pieces, which are turned back and forth, and that of this place.
        let bound = (1.0 + grown) * self.point_bound + 2.0 * left.way + steep;
        if !(scale.high < 1.0 && bound <= tolerance) {
            return None;
        }
        let lambda = u / (1.0 - u);
        let solution = Solution { gradients, values, ..Solution::unsettled(*x, lambda, *rounds) };
        // Forces balance: (1−u)∇S_A and −u∇S_B are equal, and no unit vectors are needed to weigh them alike.
        let across = Across::balanced((1.0 - u) * gradients[0] - *u * gradients[1]);
        let n = across.vector();
        let along = [within[0].along(&pieces[0], n), within[1].along(&pieces[1], n)];
        LocalContact::along_normal(pair, &solution, across, scale, bound, Some(along))
    }
}

impl PairState {
    /// The contact at these poses, if the particles surely overlap there, as they did where it was solved, and the
    /// contact point is known as well as the settings ask for; or if they were surely apart and are so still.
    #[inline(always)]
    pub(crate) fn carry_on(
        &mut self,
        a: (&Particle, &Pose),
        b: (&Particle, &Pose),
        settings: &Settings,
    ) -> Option<Contact> {
        let last = self.remembered(a, b);
        let known = &mut self.last_contact;
        if !(known.is_of(a.0, b.0) && known.precision == precision_of(settings)) {
            return None;
        }
        let last = last?;
        if known.is_apart() {
            return self.still_apart(a, b, settings, last);
        }
        let pair = Pair::new(a.0, a.1, b.0, b.1);
        let radius = smaller(a.0.bounding_radius(), b.0.bounding_radius());
        let tolerance = settings.carry_tolerance * radius;
        let Moved { pieces, optimum, within } = known.moved(&pair, last, tolerance, MOST_OPEN * radius)?;
        let local = known.local(&pair, &pieces, &optimum, within, tolerance)?;
        let (x, lambda) = (optimum.x, optimum.u / (1.0 - optimum.u));
        self.remember(Remembered { x, lambda, ..last });
        let call = Contact { flags: Flags::WARM.with(Flags::CARRIED), iterations: optimum.rounds, ..Contact::UNKNOWN };
        let contact = local.placed(&pair, b.1, call);
        debug_assert!(contact.kind == Kind::Overlapping && contact.overlap >= 0.0);
        Some(contact)
    }

    /// The answer of particles that were surely apart, if they are so still. Not inlined: contacts need none of it.
    #[inline(never)]
    fn still_apart(
        &mut self,
        a: (&Particle, &Pose),
        b: (&Particle, &Pose),
        settings: &Settings,
        last: Remembered,
    ) -> Option<Contact> {
        if settings.solve_separated() {
            return None;
        }
        let pair = Pair::new(a.0, a.1, b.0, b.1);
        let tolerance = settings.carry_tolerance * smaller(a.0.bounding_radius(), b.0.bounding_radius());
        let Moved { optimum, within, .. } = self.last_contact.moved(&pair, last, tolerance, tolerance)?;
        let low = self.last_contact.low(&optimum, &within)?;
        let (x, lambda) = (optimum.x, optimum.u / (1.0 - optimum.u));
        self.remember(Remembered { x, lambda, how: How::Apart, ..last });
        let distance = separation::distance_of_scale(a.0, b.0, low);
        let flags = Flags::REJECTED.with(Flags::WARM).with(Flags::CARRIED);
        let apart = Contact::separated(Formulation::Midway, low);
        Some(Contact { flags, distance, iterations: optimum.rounds, ..apart })
    }
}

/// The last contact at new poses.
struct Moved {
    /// Frame of B.
    pieces: [KnownPiece; 2],
    optimum: Optimum,
    within: [Within; 2],
}

/// The point at which the rounds ended, frame of B.
struct Optimum {
    x: Vector3<f64>,
    u: f64,
    here: [Here; 2],
    left: Left,
    rounds: u32,
}

impl Optimum {
    /// S.
    #[inline(always)]
    fn square(&self) -> f64 {
        (1.0 - self.u) * self.here[0].value + self.u * self.here[1].value
    }
}

/// Residuals at the optimum.
struct Left {
    /// Residual of S.
    square: f64,
    /// Bound on the length of the next step, in whatever direction the curvatures have changed.
    way: f64,
    /// Bound on the length of the step to the minimum of the weighted sum, with the weight as it is.
    at_weight: f64,
    /// Ratio of the sum of the curvatures to the least one.
    stiffness: f64,
}
