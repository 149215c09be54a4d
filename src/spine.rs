//! The fast solver: Newton on the exact quadratic pieces, with a dual bound at every step.
//!
//! Each iteration expands both potentials at x, solves the pair of quadratics exactly ([`crate::model`]),
//! and moves there. The model's optimum is also a dual bound: once the active planes stay, upper and
//! lower bound meet, and the answer is proved. A step that overshoots (a plane switched on behind x) is
//! shortened by an exact search along it.

use crate::body::{Body, Local, Planes, Verdict};
use crate::frame;
use crate::line::{self, Merit};
use crate::model::{Model, Optimum, Response};
use crate::potential::Quadratic;
use crate::target::Target;
use nalgebra::{Matrix3, Vector3};

/// How the quadratics are factored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Factorisation {
    /// In the axes of B.
    Plain,
    /// In axes aligned with the stiffest planes, chosen anew at each point.
    Aligned,
}

/// Ratio of plane to sphere curvature above which plain axes lose the soft direction: its relative error
/// is the ratio times 1e-16, and a Newton step is still worth its cost at 1e-8 or so.
const PLAIN_STIFFNESS: f64 = 1e7;

/// Most iterations; what needs more is stuck in rounding and left to the next solver.
const MOST_ITERATIONS: u32 = 100;

/// Relative to the smaller particle, a step too short for the next one to be more precise.
const SHORT: f64 = 1e-9;

/// Factor of the least possible gap that is as good as any.
const AS_SHARP: f64 = 8.0;

/// Relative gap above which a proof is not taken for good at once.
const SHARP: f64 = 1e-2;

/// Share of what is still to be gained to which λ is searched, early on and after a step that failed.
const ROUGH: f64 = 1e-2;
const FINE: f64 = 1e-4;

/// Steps in a row that may come to nothing.
const MOST_STOPS: u32 = 3;

/// Iterations granted to sharpen what is proved already.
const MOST_TO_ARRIVE: u32 = 5;

/// What the solver is asked for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Goal {
    pub target: Target,
    /// Relative gap at which to stop.
    pub tolerance: f64,
    /// Whether a proof that the optimum exceeds 1 is enough.
    pub stop_when_separated: bool,
}

/// Where to begin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Start {
    pub x: Vector3<f64>,
    /// Ratio of weights λ = u/(1−u).
    pub lambda: f64,
    /// Whether the planes on at x are likely those of the optimum, as from memory or a neighbouring problem.
    pub near: bool,
}

/// Both quadratics at a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Expansion {
    pub x: Vector3<f64>,
    /// Axes of the quadratics (columns, in the solver's frame), if not the solver's own.
    axes: Option<Matrix3<f64>>,
    pub locals: [Local; 2],
    pub q_a: Quadratic,
    pub q_b: Quadratic,
}

/// Where the solver ended; everything in the solver's frame, potentials as regularised.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outcome {
    pub x: Vector3<f64>,
    pub lambda: f64,
    /// ∇S_A and ∇S_B at the optimum.
    pub gradients: [Vector3<f64>; 2],
    /// Best estimate of the optimal S.
    pub estimate: f64,
    /// Lower bound up to `rounding`.
    pub lower: f64,
    /// Merit of a point that was evaluated: an upper bound up to `rounding`.
    pub upper: f64,
    /// Bound on the rounding of both.
    pub rounding: f64,
    pub iterations: u32,
    pub ending: Ending,
    /// How the optimum answers to changes of its data, where it is that of known quadratics.
    pub response: Option<Response>,
}

impl Outcome {
    /// Of a search that has found nothing.
    pub const UNKNOWN: Self = Self {
        x: NOWHERE,
        lambda: 1.0,
        gradients: [NOWHERE; 2],
        estimate: f64::NAN,
        lower: f64::NEG_INFINITY,
        upper: f64::INFINITY,
        rounding: f64::INFINITY,
        iterations: 0,
        ending: Ending::Stuck,
        response: None,
    };

    /// Bound on the error of the optimal S.
    fn gap(&self) -> f64 {
        self.upper - self.lower + self.rounding
    }
}

/// Why the solver stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ending {
    /// The bounds meet within the tolerance.
    Converged,
    /// The bounds meet within rounding, which is more than the tolerance.
    RoundingLimited,
    /// The lower bound exceeds 1, which was enough.
    Separated,
    /// Neither; the outcome is not to be used.
    Stuck,
}

/// The factorisation that the shapes of a pair call for.
pub(crate) fn factorisation(a: &Body, b: &Body) -> Factorisation {
    let stiff = a.plane_curvature().max(b.plane_curvature());
    let soft = a.sphere_curvature().min(b.sphere_curvature());
    if stiff <= PLAIN_STIFFNESS * soft { Factorisation::Plain } else { Factorisation::Aligned }
}

/// Least curvatures of A and B in any direction.
pub(crate) fn softest(a: &Body, b: &Body) -> (f64, f64) {
    (a.sphere_curvature(), b.sphere_curvature())
}

const NOWHERE: Vector3<f64> = Vector3::new(0.0, 0.0, 0.0);

impl Expansion {
    pub const BLANK: Self =
        Self { x: NOWHERE, axes: None, locals: [Local::BLANK; 2], q_a: Quadratic::ZERO, q_b: Quadratic::ZERO };

    /// At a point, with planes counting from their own blur.
    pub fn at(bodies: [&Body; 2], start: &Start, target: Target, factorisation: Factorisation) -> Self {
        let locals = bodies.map(|body| body.locate(&start.x, 0.0));
        Self::of(bodies, start.x, locals, target.weights(start.lambda), factorisation)
    }

    #[inline]
    fn of(
        bodies: [&Body; 2],
        x: Vector3<f64>,
        locals: [Local; 2],
        weights: (f64, f64),
        factorisation: Factorisation,
    ) -> Self {
        let axes = match factorisation {
            Factorisation::Plain => None,
            Factorisation::Aligned => Some(frame::aligned(bodies, weights, &locals)),
        };
        let q_a = bodies[0].at(&locals[0], axes.as_ref());
        let q_b = bodies[1].at(&locals[1], axes.as_ref());
        Self { x, axes, locals, q_a, q_b }
    }

    /// A direction of the solver's frame in the axes of the quadratics.
    pub fn to_axes(&self, v: &Vector3<f64>) -> Vector3<f64> {
        self.axes.map_or(*v, |axes| axes.tr_mul(v))
    }

    #[inline]
    fn to_solver(&self, v: &Vector3<f64>) -> Vector3<f64> {
        match &self.axes {
            Some(axes) => axes * v,
            None => *v,
        }
    }

    /// Second derivatives of the quadratics of A and B along a unit vector of the solver's frame.
    pub fn curvatures(&self, n: &Vector3<f64>) -> [f64; 2] {
        let n = self.to_axes(n);
        [&self.q_a, &self.q_b].map(|q| q.hessian.times(&n).dot(&n))
    }

    /// Bounds on the rounding of S_A and S_B.
    fn rounding(&self, a: &Body, b: &Body) -> (f64, f64) {
        (a.rounding(&self.locals[0], &self.q_a), b.rounding(&self.locals[1], &self.q_b))
    }

    fn merit(&self, target: Target, lambda: f64) -> f64 {
        target.merit(self.q_a.value, self.q_b.value, lambda)
    }

    /// The model's optimum here, and what its step does to the planes of A and of B.
    ///
    /// λ is good to `enough` where another plane is met or one pulls, and to rounding where the planes are right.
    #[inline]
    pub fn optimum(&self, bodies: [&Body; 2], target: Target, guess: f64, enough: f64) -> Option<Step> {
        let model = Model::new(&self.q_a, &self.q_b, softest(bodies[0], bodies[1]), target);
        let step = self.step(bodies, model.solve(guess, enough)?);
        if step.planes == Planes::Exact && !step.optimum.settled {
            return Some(self.step(bodies, model.settle(step.optimum)?));
        }
        Some(step)
    }

    /// The same for a fixed λ.
    pub fn weighted(&self, bodies: [&Body; 2], target: Target, lambda: f64) -> Option<Step> {
        let model = Model::new(&self.q_a, &self.q_b, softest(bodies[0], bodies[1]), target);
        Some(self.step(bodies, model.at(lambda)?))
    }

    /// Drops the planes that a step says.
    pub fn drop(&mut self, bodies: [&Body; 2], step: &Step, target: Target, lambda: f64, factorisation: Factorisation) {
        for (local, verdict) in self.locals.iter_mut().zip(&step.verdicts) {
            if let Some(i) = verdict.drop {
                local.drop(i);
            }
        }
        *self = Self::of(bodies, self.x, self.locals, target.weights(lambda), factorisation);
    }

    #[inline]
    fn step(&self, [a, b]: [&Body; 2], optimum: Optimum) -> Step {
        let v = self.to_solver(&optimum.step);
        let verdicts = [a.check(&self.locals[0], &v), b.check(&self.locals[1], &v)];
        Step { optimum, v, verdicts, planes: verdicts[0].planes.max(verdicts[1].planes) }
    }

    /// The optimum that a step leads to, with its bounds.
    fn outcome(&self, bodies: [&Body; 2], target: Target, step: &Step) -> Outcome {
        let (optimum, soft, lambda) = (&step.optimum, softest(bodies[0], bodies[1]), step.optimum.lambda);
        let (s_a, s_b) = optimum.values;
        let lower = target.dual(s_a, s_b, lambda);
        let upper = match step.planes {
            Planes::Exact => target.merit(s_a, s_b, lambda),
            _ => self.merit(target, lambda),
        };
        let doubt = step.doubt(target, soft);
        let of_a = bodies[0].rounding_after(&self.locals[0], &self.q_a, s_a);
        let of_b = bodies[1].rounding_after(&self.locals[1], &self.q_b, s_b);
        Outcome {
            x: self.x + step.v,
            lambda,
            gradients: optimum.gradients.map(|g| self.to_solver(&g)),
            estimate: lower,
            lower,
            upper,
            rounding: doubt
                + rounding(target, optimum, of_a + optimum.rounding(&self.q_a), of_b + optimum.rounding(&self.q_b)),
            iterations: 0,
            ending: Ending::Stuck,
            response: optimum.response(target),
        }
    }
}

/// A step to the optimum of the quadratics at a point.
pub(crate) struct Step {
    pub optimum: Optimum,
    /// The step in the solver's frame.
    pub v: Vector3<f64>,
    verdicts: [Verdict; 2],
    /// The worse of the two.
    pub planes: Planes,
}

impl Step {
    /// How far the dual value may lie above a lower bound: the step is not solved exactly, and planes of doubtful sign may
    /// pull after all.
    pub fn doubt(&self, target: Target, soft: (f64, f64)) -> f64 {
        let (a, b) = target.weights(self.optimum.lambda);
        let slope = a * self.verdicts[0].slope + b * self.verdicts[1].slope;
        // (x + y)² ≤ 2x² + 2y² for the two slopes in doubt.
        2.0 * self.optimum.doubt(target, soft) + slope * slope / (a * soft.0 + b * soft.1)
    }
}

/// Solves for the goal, beginning with the quadratics in `here`; those of the answer are left there.
pub(crate) fn solve(
    a: &Body,
    b: &Body,
    goal: &Goal,
    start: &Start,
    factorisation: Factorisation,
    here: &mut Expansion,
) -> Outcome {
    let (bodies, target) = ([a, b], goal.target);
    let reach = a.particle.bounding_radius().min(b.particle.bounding_radius());
    // What the regularisation itself leaves open.
    let flat = a.most_surplus(1.0).max(b.most_surplus(1.0));
    let mut lambda = start.lambda;
    let mut thorough = start.near;
    let mut previous: Option<Attempt> = None;
    let (mut proved, mut arriving, mut stopped) = (None::<(Outcome, Expansion)>, 0, 0);
    let mut lower = f64::NEG_INFINITY;
    let mut iterations = 0;
    while iterations < MOST_ITERATIONS {
        iterations += 1;
        if let Some(attempt) = previous.as_ref().filter(|_| !thorough) {
            let merit = here.merit(target, attempt.lambda);
            let enough = attempt.merit - 1e-4 * attempt.promised;
            // Two values of S cannot be told apart below their rounding.
            let rounding = || {
                let (of_a, of_b) = here.rounding(a, b);
                target.merit_rounding(of_a, of_b, attempt.lambda)
            };
            if !(merit <= enough || merit <= enough + rounding()) {
                let moved = attempt.shorten(bodies, target, lambda, factorisation, here);
                // Stopped at once, again and again: the planes take turns, and λ has to be found otherwise.
                stopped = if moved { 0 } else { stopped + 1 };
                if stopped > MOST_STOPS {
                    break;
                }
                thorough = true;
            }
        }
        let upper = here.merit(target, lambda);
        if !upper.is_finite() {
            break;
        }
        // Where the planes are likely right, at once the best λ; else a rough one will do, but for a better one after
        // a step that failed.
        let share = match () {
            () if start.near && iterations == 1 => 0.0,
            () if thorough => FINE,
            () => ROUGH,
        };
        let behind = if target == Target::Midway { upper - lower } else { 0.0 };
        let mismatch = target.mismatch(here.q_a.expansion, here.q_b.expansion);
        let enough = share * mismatch.max(behind).min(upper);
        let Some(step) = here.optimum(bodies, target, lambda, enough) else { break };
        lambda = step.optimum.lambda;
        if step.planes == Planes::Dropped {
            here.drop(bodies, &step, target, lambda, factorisation);
            (previous, thorough) = (None, false);
            continue;
        }
        let upper = here.merit(target, lambda);
        lower = target.dual(step.optimum.values.0, step.optimum.values.1, lambda);
        if goal.stop_when_separated && lower > 1.0 && step.planes != Planes::Pulling {
            let outcome = here.outcome(bodies, target, &step);
            // What the regularisation adds proves nothing.
            if lower - outcome.rounding - flat > 1.0 {
                return Outcome { ending: Ending::Separated, iterations, ..outcome };
            }
        }
        if step.planes == Planes::Exact && step.optimum.settled {
            let mut outcome = here.outcome(bodies, target, &step);
            outcome.iterations = iterations;
            let gap = outcome.gap();
            let precise = gap <= goal.tolerance * outcome.upper;
            outcome.ending = if precise { Ending::Converged } else { Ending::RoundingLimited };
            if precise {
                return outcome;
            }
            // What rounding leaves at the optimum itself: no other point of expansion will do much better.
            let least = target.dual_weighted(
                here.locals[0].least_rounding(&outcome.gradients[0]),
                here.locals[1].least_rounding(&outcome.gradients[1]),
                lambda,
            );
            let short = step.v.norm() <= SHORT * reach;
            let sharp = short || gap <= AS_SHARP * least;
            // Again after a step too short to gain anything: this is what rounding allows, however much it is.
            if sharp && (gap <= SHARP * outcome.upper || (short && arriving > 1)) {
                return outcome;
            }
            // Proved, but over a long step; the same from nearby is sharper.
            if proved.as_ref().is_none_or(|(old, _)| outcome.gap() < old.gap()) {
                proved = Some((outcome, *here));
            }
        } else if flat > 0.0 && step.planes == Planes::Met && upper - lower <= flat {
            // Inside both cores nothing but the regularisation tells one point from another.
            let outcome = here.outcome(bodies, target, &step);
            if proved.as_ref().is_none_or(|(old, _)| outcome.gap() < old.gap()) {
                let ending = Ending::RoundingLimited;
                proved = Some((Outcome { x: here.x, ending, response: None, ..outcome }, *here));
            }
        }
        arriving += u32::from(proved.is_some());
        if arriving > MOST_TO_ARRIVE {
            break;
        }
        let promised = (upper - lower).max(0.0);
        let x = here.x + step.v;
        previous = Some(Attempt { from: here.x, locals: here.locals, step: step.v, lambda, merit: upper, promised });
        thorough = false;
        *here = Expansion::of(bodies, x, [a.locate(&x, 0.0), b.locate(&x, 0.0)], target.weights(lambda), factorisation);
    }
    match proved {
        // A proof that leaves everything open is none. Where S all but vanishes, deep inside both, what counts is its
        // gap beside the 1 of the surfaces.
        Some((outcome, expansion)) if outcome.gap() <= (SHARP * outcome.upper.max(flat)).max(goal.tolerance) => {
            *here = expansion;
            Outcome { iterations, ..outcome }
        }
        _ => Outcome { x: here.x, lambda, lower, iterations, ..Outcome::UNKNOWN },
    }
}

/// Bound on the effect of rounding on the optimum, from bounds on that of S_A and S_B.
///
/// An error in S_A or S_B moves the optimum by its weight, while the weights stay what they are; where the
/// error itself decides about the weights, by no more than the whole of it.
fn rounding(target: Target, optimum: &Optimum, of_a: f64, of_b: f64) -> f64 {
    let lambda = optimum.lambda;
    let weighted = target.dual_weighted(of_a, of_b, lambda);
    let (change_a, change_b) = target.changes(of_a, of_b);
    let swing = change_a.max(change_b) / optimum.rate(target).abs();
    if swing < 0.25 { weighted * (1.0 + 4.0 * swing) } else { target.merit_rounding(of_a, of_b, lambda).max(weighted) }
}

/// A step that was tried, to be shortened if it made things worse.
#[derive(Clone, Copy)]
struct Attempt {
    from: Vector3<f64>,
    locals: [Local; 2],
    step: Vector3<f64>,
    lambda: f64,
    merit: f64,
    promised: f64,
}

impl Attempt {
    /// Expands at the best point along the step instead; whether that is another point.
    #[cold]
    fn shorten(
        &self,
        bodies: [&Body; 2],
        target: Target,
        lambda: f64,
        factorisation: Factorisation,
        here: &mut Expansion,
    ) -> bool {
        let [a, b] = bodies;
        let descent = line::descend(a, b, Merit::Of(target, self.lambda), &self.from, &self.step, (0.5, 1.0));
        let x = self.from + descent.alpha * self.step;
        let early = descent.ahead * self.step.norm();
        let mut locals = [a.locate(&x, early), b.locate(&x, early)];
        let moved = (x - self.from).norm() > self.locals[0].blur.max(self.locals[1].blur);
        if !moved {
            a.carry_dropped(&self.locals[0], &self.step, &mut locals[0]);
            b.carry_dropped(&self.locals[1], &self.step, &mut locals[1]);
        }
        *here = Expansion::of(bodies, x, locals, target.weights(lambda), factorisation);
        moved
    }
}
