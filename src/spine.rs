//! The fast solver: Newton on the exact quadratic pieces, with a dual bound at every step.
//!
//! Each iteration expands both potentials at x, solves the pair of quadratics exactly ([`crate::model`]),
//! and moves there. The model's optimum is also a dual bound: once the active planes stay, upper and
//! lower bound meet, and the answer is proved. A step that overshoots (a plane switched on behind x) is
//! shortened by an exact search along it.

use crate::body::{Body, Counted, Planes};
use crate::frame;
use crate::line;
use crate::model::{self, Target};
use crate::pair::Pair;
use nalgebra::Vector3;

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

/// A point with the ratio of weights λ = u/(1−u).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Start {
    pub x: Vector3<f64>,
    pub lambda: f64,
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
        return Start { x: Vector3::zeros(), lambda: 1.0 };
    }
    let line::Descent { alpha, slope_a, slope_b, .. } =
        line::descend(a, b, Target::Midway, 1.0, &from, &direction, (guess, 1.0));
    // (1−u) S_A' + u S_B' = 0 on the line.
    let lambda = -slope_a / slope_b;
    Start { x: from + alpha * direction, lambda: if lambda > 0.0 && lambda.is_finite() { lambda } else { 1.0 } }
}

/// Solves for the goal from a start.
pub(crate) fn solve(a: &Body, b: &Body, goal: &Goal, start: Start, factorisation: Factorisation) -> Outcome {
    let target = goal.target;
    let Start { mut x, mut lambda } = start;
    let mut previous: Option<Attempt> = None;
    let mut outcome = Outcome {
        x,
        lambda,
        gradients: [Vector3::zeros(); 2],
        estimate: f64::NAN,
        lower: f64::NEG_INFINITY,
        upper: f64::INFINITY,
        rounding: f64::INFINITY,
        iterations: 0,
        ending: Ending::Stuck,
    };
    let mut counted = [Counted::default(); 2];
    let (mut proved, mut arriving) = (None::<Outcome>, 0);
    let check = |x: &Vector3<f64>, step: &Vector3<f64>, counted: &mut [Counted; 2]| {
        a.check(x, step, &mut counted[0]).max(b.check(x, step, &mut counted[1]))
    };
    let reach = a.particle.bounding_radius().min(b.particle.bounding_radius());
    while outcome.iterations < MOST_ITERATIONS {
        outcome.iterations += 1;
        let axes = match factorisation {
            Factorisation::Plain => None,
            Factorisation::Aligned => Some(frame::aligned([a, b], target.weights(lambda), &x, &counted)),
        };
        let (q_a, q_b) = (a.at(&x, axes.as_ref(), &counted[0]), b.at(&x, axes.as_ref(), &counted[1]));
        if let Some(attempt) = &mut previous {
            let merit = target.merit(q_a.value, q_b.value, attempt.lambda);
            // Two values of S cannot be told apart below their rounding.
            let rounding = target.merit_rounding(a.rounding(&x, &q_a), b.rounding(&x, &q_b), attempt.lambda);
            let worse = merit > attempt.merit - 1e-4 * attempt.promised + rounding;
            if !attempt.shortened && (worse || !merit.is_finite()) {
                attempt.shortened = true;
                let descent = line::descend(a, b, target, attempt.lambda, &attempt.from, &attempt.step, (0.5, 1.0));
                x = attempt.from + descent.alpha * attempt.step;
                let early = descent.ahead * attempt.step.norm();
                counted = [Counted::from(early); 2];
                continue;
            }
        }
        let upper = target.merit(q_a.value, q_b.value, lambda);
        if !upper.is_finite() {
            break;
        }
        // Early on a rough λ will do; near the end, and after a step that failed, nothing but the best.
        let best = 2.0 * f64::EPSILON * upper.max(f64::MIN_POSITIVE);
        let behind = if target == Target::Midway { upper - outcome.lower } else { 0.0 };
        let rough = (1e-2 * target.mismatch(&q_a, &q_b).max(behind)).min(1e-2 * upper).max(best);
        let enough = if previous.as_ref().is_some_and(|p| p.shortened) { best } else { rough };
        let to_solver = |v: Vector3<f64>| axes.map_or(v, |axes| axes * v);
        let Some(mut model) = model::solve(&q_a, &q_b, softest(a, b), target, lambda, enough) else { break };
        let mut step = to_solver(model.step);
        let mut planes = check(&x, &step, &mut counted);
        if planes == Planes::Exact && !model.settled {
            // The right planes: now the exact optimum of their quadratics.
            let Some(settled) = model::solve(&q_a, &q_b, softest(a, b), target, model.lambda, best) else { break };
            (model, step) = (settled, to_solver(settled.step));
            planes = check(&x, &step, &mut counted);
        }
        lambda = model.lambda;
        if planes == Planes::Dropped {
            previous = None;
            continue;
        }
        let upper = target.merit(q_a.value, q_b.value, lambda);
        outcome = Outcome {
            x: x + step,
            lambda,
            gradients: model.gradients.map(to_solver),
            estimate: model.lower,
            lower: model.lower,
            upper: if planes == Planes::Exact { model.upper } else { upper },
            rounding: model.doubt + target.dual_weighted(a.rounding(&x, &q_a), b.rounding(&x, &q_b), lambda),
            ..outcome
        };
        let gap = outcome.upper - outcome.lower + outcome.rounding;
        if planes == Planes::Exact {
            let precise = gap <= goal.tolerance * outcome.upper;
            let ending = if precise { Ending::Converged } else { Ending::RoundingLimited };
            if precise || (step.norm() <= SHORT * reach && gap <= SHARP * outcome.upper) {
                return Outcome { ending, ..outcome };
            }
            // Proved, but over a long step; the same from nearby is sharper.
            proved = Some(Outcome { ending, ..outcome })
                .filter(|new| proved.is_none_or(|old| new.rounding < old.rounding))
                .or(proved);
        }
        if goal.stop_when_separated && planes != Planes::Pulling && model.lower - outcome.rounding > 1.0 {
            return Outcome { ending: Ending::Separated, ..outcome };
        }
        arriving += u32::from(proved.is_some());
        if arriving > MOST_TO_ARRIVE {
            break;
        }
        previous = Some(Attempt {
            from: x,
            step,
            lambda,
            merit: upper,
            promised: (upper - model.lower).max(0.0),
            shortened: false,
        });
        x += step;
        counted = [Counted::default(); 2];
    }
    proved.map_or(outcome, |proved| Outcome { iterations: outcome.iterations, ..proved })
}

/// A step that was tried, to be shortened if it made things worse.
struct Attempt {
    from: Vector3<f64>,
    step: Vector3<f64>,
    lambda: f64,
    merit: f64,
    promised: f64,
    shortened: bool,
}
