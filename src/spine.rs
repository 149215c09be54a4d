//! The fast solver: Newton on the exact quadratic pieces, with a dual bound at every step.
//!
//! Each iteration expands both potentials at x, solves the pair of quadratics exactly ([`crate::model`]),
//! and moves there. The model's optimum is also a dual bound: once the active planes stay, upper and
//! lower bound meet, and the answer is proved. A step that overshoots (a plane switched on behind x) is
//! shortened by an exact search along it.

use crate::body::{Body, Local, Planes};
use crate::frame;
use crate::line;
use crate::model::{self, Optimum, Target};
use crate::pair::Pair;
use crate::potential::Quadratic;
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
    /// The quadratics whose optimum this is.
    pub expansion: Option<Expansion>,
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

/// A start without memory: the best point on the line of centres.
pub(crate) fn cold_start(pair: &Pair, a: &Body, b: &Body) -> Start {
    let from = a.centre();
    let direction = -from;
    let (ra, rb) = (pair.a.bounding_radius(), pair.b.bounding_radius());
    let guess = ra / (ra + rb);
    if direction.norm_squared() == 0.0 {
        return Start { x: Vector3::zeros(), lambda: 1.0, near: false };
    }
    let line::Descent { alpha, slope_a, slope_b, .. } =
        line::descend(a, b, Target::Midway, 1.0, &from, &direction, (guess, 1.0));
    // (1−u) S_A' + u S_B' = 0 on the line.
    let lambda = -slope_a / slope_b;
    let lambda = if lambda > 0.0 && lambda.is_finite() { lambda } else { 1.0 };
    Start { x: from + alpha * direction, lambda, near: false }
}

impl Expansion {
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
        let [q_a, q_b] = [0, 1].map(|i| bodies[i].at(&locals[i], axes.as_ref()));
        Self { x, axes, locals, q_a, q_b }
    }

    /// A direction of the solver's frame in the axes of the quadratics.
    pub fn to_axes(&self, v: &Vector3<f64>) -> Vector3<f64> {
        self.axes.map_or(*v, |axes| axes.tr_mul(v))
    }

    fn to_solver(&self, v: Vector3<f64>) -> Vector3<f64> {
        self.axes.map_or(v, |axes| axes * v)
    }

    /// Bounds on the rounding of S_A and S_B.
    fn rounding(&self, a: &Body, b: &Body) -> (f64, f64) {
        (a.rounding(&self.locals[0], &self.q_a), b.rounding(&self.locals[1], &self.q_b))
    }

    /// What `step` does to the planes of both quadratics.
    ///
    /// Also returned: how far the model's value may lie above a lower bound, should planes of doubtful sign pull.
    fn check(a: &Body, b: &Body, step: &Vector3<f64>, locals: &mut [Local; 2], weights: (f64, f64)) -> (Planes, f64) {
        let [of_a, of_b] = locals;
        let ((planes_a, slope_a), (planes_b, slope_b)) = (a.check(of_a, step), b.check(of_b, step));
        let slope = weights.0 * slope_a + weights.1 * slope_b;
        let (soft_a, soft_b) = softest(a, b);
        (planes_a.max(planes_b), slope * slope / (weights.0 * soft_a + weights.1 * soft_b))
    }

    fn merit(&self, target: Target, lambda: f64) -> f64 {
        target.merit(self.q_a.value, self.q_b.value, lambda)
    }
}

/// Solves for the goal from a start, or from quadratics that another problem of the same pair has left.
pub(crate) fn solve(
    a: &Body,
    b: &Body,
    goal: &Goal,
    start: Start,
    left: Option<Expansion>,
    factorisation: Factorisation,
) -> Outcome {
    let target = goal.target;
    let reach = a.particle.bounding_radius().min(b.particle.bounding_radius());
    let mut lambda = start.lambda;
    let expand = |x, lambda, locals| Expansion::of([a, b], x, locals, target.weights(lambda), factorisation);
    let locate = |x: &Vector3<f64>, early| [a.locate(x, early), b.locate(x, early)];
    let mut here = left.unwrap_or_else(|| expand(start.x, lambda, locate(&start.x, 0.0)));
    let mut thorough = start.near;
    let mut previous: Option<Attempt> = None;
    let (mut proved, mut arriving) = (None::<Outcome>, 0);
    let mut lower = f64::NEG_INFINITY;
    let mut iterations = u32::from(left.is_none());
    while iterations < MOST_ITERATIONS {
        if let Some(attempt) = previous.filter(|_| !thorough) {
            let merit = here.merit(target, attempt.lambda);
            // Two values of S cannot be told apart below their rounding.
            let (of_a, of_b) = here.rounding(a, b);
            let rounding = target.merit_rounding(of_a, of_b, attempt.lambda);
            if merit > attempt.merit - 1e-4 * attempt.promised + rounding || !merit.is_finite() {
                let descent = line::descend(a, b, target, attempt.lambda, &attempt.from, &attempt.step, (0.5, 1.0));
                let x = attempt.from + descent.alpha * attempt.step;
                let mut locals = locate(&x, descent.ahead * attempt.step.norm());
                if (x - attempt.from).norm() <= attempt.locals[0].blur.max(attempt.locals[1].blur) {
                    a.carry_dropped(&attempt.locals[0], &attempt.step, &mut locals[0]);
                    b.carry_dropped(&attempt.locals[1], &attempt.step, &mut locals[1]);
                }
                here = expand(x, lambda, locals);
                iterations += 1;
                thorough = true;
            }
        }
        let upper = here.merit(target, lambda);
        if !upper.is_finite() {
            break;
        }
        // Early on a rough λ will do; near the end, and after a step that failed, nothing but the best.
        let behind = if target == Target::Midway { upper - lower } else { 0.0 };
        let rough = (1e-2 * target.mismatch(&here.q_a, &here.q_b).max(behind)).min(1e-2 * upper);
        let optimum = |guess, enough| model::solve(&here.q_a, &here.q_b, softest(a, b), target, guess, enough);
        let Some(mut model) = optimum(lambda, if thorough { 0.0 } else { rough }) else { break };
        let mut step = here.to_solver(model.step);
        let mut locals = here.locals;
        let (mut planes, mut pulled) = Expansion::check(a, b, &step, &mut locals, target.weights(model.lambda));
        if planes == Planes::Exact && !model.settled {
            // The right planes: now the exact optimum of their quadratics.
            let Some(settled) = optimum(model.lambda, 0.0) else { break };
            (model, step) = (settled, here.to_solver(settled.step));
            (planes, pulled) = Expansion::check(a, b, &step, &mut locals, target.weights(model.lambda));
        }
        lambda = model.lambda;
        if planes == Planes::Dropped {
            here = expand(here.x, lambda, locals);
            iterations += 1;
            (previous, thorough) = (None, false);
            continue;
        }
        let upper = here.merit(target, lambda);
        let (of_a, of_b) = here.rounding(a, b);
        let mut outcome = Outcome {
            x: here.x + step,
            lambda,
            gradients: model.gradients.map(|g| here.to_solver(g)),
            estimate: model.lower,
            lower: model.lower,
            upper: if planes == Planes::Exact { model.upper } else { upper },
            // (x + y)² ≤ 2x² + 2y² for the two slopes in doubt.
            rounding: 2.0 * model.doubt + pulled + rounding(target, &model, of_a, of_b),
            iterations,
            ending: Ending::Stuck,
            expansion: Some(here),
        };
        lower = model.lower;
        if goal.stop_when_separated && planes != Planes::Pulling && lower - outcome.rounding > 1.0 {
            return Outcome { ending: Ending::Separated, ..outcome };
        }
        if planes == Planes::Exact && model.settled {
            let gap = outcome.upper - outcome.lower + outcome.rounding;
            let precise = gap <= goal.tolerance * outcome.upper;
            outcome.ending = if precise { Ending::Converged } else { Ending::RoundingLimited };
            // What rounding leaves at the optimum itself: no other point of expansion will do much better.
            let least = target.dual_weighted(
                here.locals[0].least_rounding(&outcome.gradients[0]),
                here.locals[1].least_rounding(&outcome.gradients[1]),
                lambda,
            );
            let sharp = gap <= AS_SHARP * least || step.norm() <= SHORT * reach;
            if precise || (sharp && gap <= SHARP * outcome.upper) {
                return outcome;
            }
            // Proved, but over a long step; the same from nearby is sharper.
            if proved.is_none_or(|old| outcome.rounding < old.rounding) {
                proved = Some(outcome);
            }
        }
        arriving += u32::from(proved.is_some());
        if arriving > MOST_TO_ARRIVE {
            break;
        }
        let promised = (upper - model.lower).max(0.0);
        previous = Some(Attempt { from: here.x, locals: here.locals, step, lambda, merit: upper, promised });
        thorough = false;
        let x = here.x + step;
        here = expand(x, lambda, locate(&x, 0.0));
        iterations += 1;
    }
    match proved {
        Some(proved) => Outcome { iterations, ..proved },
        None => Outcome {
            x: here.x,
            lambda,
            gradients: [Vector3::zeros(); 2],
            estimate: f64::NAN,
            lower,
            upper: f64::INFINITY,
            rounding: f64::INFINITY,
            iterations,
            ending: Ending::Stuck,
            expansion: None,
        },
    }
}

/// Bound on the effect of rounding on the optimum, from bounds on that of S_A and S_B at the expansion.
///
/// An error in S_A or S_B moves the optimum by its weight, while the weights stay what they are; where the
/// error itself decides about the weights, by no more than the whole of it.
fn rounding(target: Target, model: &Optimum, of_a: f64, of_b: f64) -> f64 {
    let (of_a, of_b) = (of_a + model.rounding.0, of_b + model.rounding.1);
    let weighted = target.dual_weighted(of_a, of_b, model.lambda);
    let whole = target.merit_rounding(of_a, of_b, model.lambda);
    let swing = target.mismatch_of(0, of_a).max(target.mismatch_of(1, of_b)) / model.rate.abs();
    if swing < 0.25 { weighted * (1.0 + 4.0 * swing) } else { whole.max(weighted) }
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
