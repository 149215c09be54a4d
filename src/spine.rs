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

/// Relative to the smaller particle, the longest last step that needs no look at where it leads: beyond it a
/// plane that the model does not know could be met.
const SHORT: f64 = 1e-9;

/// Iterations granted to a point whose s is proved already.
const MOST_TO_ARRIVE: u32 = 20;

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
    let line::Descent { alpha, slope_a, slope_b, .. } = line::descend(a, b, Target::Midway, 1.0, &from, &direction, (guess, 1.0));
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
    let mut proved: Option<Outcome> = None;
    let reach = a.particle.bounding_radius().min(b.particle.bounding_radius());
    while outcome.iterations < MOST_ITERATIONS {
        outcome.iterations += 1;
        let axes = match factorisation {
            Factorisation::Plain => None,
            Factorisation::Aligned => Some(frame::aligned([a, b], target.weights(lambda), &x, &counted)),
        };
        let (q_a, q_b) = (a.at(&x, axes.as_ref(), &counted[0]), b.at(&x, axes.as_ref(), &counted[1]));
        let rounding = target.dual_weighted(a.rounding(&x, &q_a), b.rounding(&x, &q_b), lambda);
        if let Some(attempt) = &mut previous {
            let merit = target.merit(q_a.value, q_b.value, attempt.lambda);
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
        let rough = 1e-2 * target.mismatch(&q_a, &q_b).max(if target == Target::Midway { upper - outcome.lower } else { 0.0 });
        let enough = if previous.as_ref().is_some_and(|p| p.shortened) { best } else { rough.min(1e-2 * upper).max(best) };
        let Some(model) = model::solve(&q_a, &q_b, softest(a, b), target, lambda, enough) else { break };
        let to_solver = |v: Vector3<f64>| axes.map_or(v, |axes| axes * v);
        let step = to_solver(model.step);
        lambda = model.lambda;
        let planes = [a.check(&x, &step, &mut counted[0]), b.check(&x, &step, &mut counted[1])];
        if !planes.contains(&Planes::Pulling) && planes.contains(&Planes::Dropped) {
            previous = None;
            continue;
        }
        let upper = target.merit(q_a.value, q_b.value, lambda);
        (outcome.x, outcome.lambda, outcome.estimate) = (x + step, lambda, model.lower);
        outcome.gradients = model.gradients.map(to_solver);
        (outcome.lower, outcome.upper, outcome.rounding) = (model.lower, upper, rounding + model.doubt);
        let gap = upper - model.lower;
        let exact = model.doubt <= rounding.max(goal.tolerance * upper);
        let done = exact && (gap <= goal.tolerance * upper || gap <= rounding);
        let apart = goal.stop_when_separated && model.lower - outcome.rounding > 1.0;
        if (done || apart) && planes == [Planes::Kept; 2] {
            outcome.ending = match (done, gap + outcome.rounding <= goal.tolerance * upper) {
                (false, _) => Ending::Separated,
                (true, true) => Ending::Converged,
                (true, false) => Ending::RoundingLimited,
            };
            if done && step.norm() > SHORT * reach {
                // s is proved, but where S is flat the point is still on its way: let it arrive, within reason.
                let here = Outcome { x, gradients: [q_a.gradient, q_b.gradient].map(to_solver), ..outcome };
                proved.get_or_insert(here);
            } else {
                if done && !model.settled {
                    // The bounds meet, but the point is only as good as λ: once more, to rounding.
                    let last = model::solve(&q_a, &q_b, softest(a, b), target, lambda, best).unwrap_or(model);
                    let step = to_solver(last.step);
                    if [a.check(&x, &step, &mut counted[0]), b.check(&x, &step, &mut counted[1])] == [Planes::Kept; 2] {
                        (outcome.x, outcome.lambda, outcome.estimate) = (x + step, last.lambda, last.lower);
                        outcome.gradients = last.gradients.map(to_solver);
                    }
                }
                return outcome;
            }
        }
        outcome.ending = Ending::Stuck;
        if let Some(proved) = proved.filter(|proved| outcome.iterations > proved.iterations + MOST_TO_ARRIVE) {
            return Outcome { iterations: outcome.iterations, ..proved };
        }
        previous = Some(Attempt { from: x, step, lambda, merit: upper, promised: gap.max(0.0), shortened: false });
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
