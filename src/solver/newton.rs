//! Newton's method on the exact quadratic pieces, with a dual bound at every step.
//!
//! Each iteration makes both quadratics at x, solves the pair exactly ([`crate::model::quadratic_model`]) and steps to their
//! optimum. If the active set is unchanged after the step, the point is optimal and the dual value is a lower bound. A step that
//! does not reduce the merit (planes became active on the way) is shortened by an exact line search.

use crate::bounds::solution::{Ending, Solution};
use crate::linalg::number::larger;
use crate::model::dual_path::Optimum;
use crate::model::kkt_check::Change;
use crate::model::local_model::{self, Axes, LocalModel};
use crate::model::problem::Problem;
use crate::pair::placed_particle::Body;
use crate::settings::LEAST_OF_DOUBLES;
use crate::solver::line_search::{self, Merit};
use nalgebra::Vector3;

/// Most iterations; few searches come to an end after more.
const MOST_ITERATIONS: u32 = 30;

/// Relative to the smaller particle, a step too short for the next one to be more precise.
const SHORT: f64 = 1e-9;

/// Factor of the least possible gap that is as good as any.
const AS_SHARP: f64 = 8.0;

/// Relative gap above which an optimum is sought again from nearby.
const SHARP: f64 = 1e-2;

/// Iterations granted to sharpen an optimum that is known already.
const MOST_SHARPENING: u32 = 3;

/// What the solver is asked for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Goal {
    pub problem: Problem,
    /// Relative gap at which to stop.
    pub tolerance: f64,
    /// Whether a proof that the optimum exceeds 1 is enough.
    pub stop_when_separated: bool,
}

impl Goal {
    /// Whether an answer that is as good as doubles allow will do, though its gap exceeds the tolerance.
    pub fn takes_rounding(&self) -> bool {
        self.tolerance >= LEAST_OF_DOUBLES
    }
}

/// The solution that an optimum of unchanged active set is, if its bounds are as good as they can be.
#[inline(always)]
pub(crate) fn accepted(bodies: [&Body; 2], goal: &Goal, model: &LocalModel, optimum: Optimum) -> Option<Solution> {
    let step = model.step(bodies, optimum);
    if step.change != Change::None || !step.optimum.settled {
        return None;
    }
    let solution = Solution { iterations: 1, ..Solution::of(model, bodies, goal.problem, &step) };
    if goal.stop_when_separated && solution.separates(flat(bodies)) {
        return Some(Solution { ending: Ending::Separated, ..solution });
    }
    let quality = Quality::of(&solution, goal, model);
    let good = quality.precise || (quality.rounded && quality.telling && goal.takes_rounding());
    (good && solution.linear).then_some(Solution { ending: quality.ending(), ..solution })
}

/// What the regularisation itself leaves open.
pub(crate) fn flat([a, b]: [&Body; 2]) -> f64 {
    larger(a.most_surplus(1.0), b.most_surplus(1.0))
}

/// How good the bounds of a solution are.
struct Quality {
    /// They meet within the tolerance.
    precise: bool,
    /// As near as rounding lets any bounds come.
    rounded: bool,
    /// They leave little open, however large what rounding leaves.
    telling: bool,
}

impl Quality {
    #[inline(always)]
    fn of(solution: &Solution, goal: &Goal, model: &LocalModel) -> Self {
        let gap = solution.gap();
        Self {
            precise: gap <= goal.tolerance * solution.upper,
            rounded: gap <= AS_SHARP * solution.least_rounding(model, goal.problem),
            telling: gap <= SHARP * solution.upper,
        }
    }

    fn ending(&self) -> Ending {
        if self.precise { Ending::Converged } else { Ending::RoundingLimited }
    }
}

/// The best solution so far, with the model it is an optimum of.
struct Best {
    solution: Solution,
    model: LocalModel,
    /// Iterations since the first.
    age: u32,
}

/// Solves for the goal, beginning with the model at hand; that of the solution is left there.
pub(crate) fn solve(bodies: [&Body; 2], goal: &Goal, mut lambda: f64, axes: Axes, model: &mut LocalModel) -> Solution {
    let problem = goal.problem;
    let (flat, shortest) = (flat(bodies), SHORT * local_model::smallest(bodies));
    let (mut attempt, mut best, mut iterations) = (None::<Attempt>, None::<Best>, 0);
    while iterations < MOST_ITERATIONS {
        iterations += 1;
        if let Some(attempt) = attempt.as_ref().filter(|attempt| !attempt.is_descent(bodies, problem, model)) {
            *model = attempt.shortened(bodies, problem, lambda, axes);
        }
        if !model.merit(problem, lambda).is_finite() {
            break;
        }
        let Some(step) = model.optimum(bodies, problem, lambda) else { break };
        lambda = step.optimum.lambda;
        if step.change == Change::Leaving {
            *model = model.without_leaving(bodies, &step, problem.weights(lambda), axes);
            attempt = None;
            continue;
        }
        let lower = problem.dual(step.optimum.values.0, step.optimum.values.1, lambda);
        let separating = goal.stop_when_separated && lower > 1.0 && step.change != Change::Pulling;
        let optimal = step.change == Change::None && step.optimum.settled;
        if separating || optimal {
            let solution = Solution { iterations, ..Solution::of(model, bodies, problem, &step) };
            if separating && solution.separates(flat) {
                return Solution { ending: Ending::Separated, ..solution };
            }
            if optimal {
                let quality = Quality::of(&solution, goal, model);
                let solution = Solution { ending: quality.ending(), ..solution };
                let short = step.length <= shortest;
                if quality.precise || ((short || quality.rounded) && quality.telling) {
                    return solution;
                }
                // Optimal, but over a long step; the same from nearby is sharper.
                if best.as_ref().is_none_or(|best| solution.gap() < best.solution.gap()) {
                    let age = best.map_or(0, |best| best.age);
                    best = Some(Best { solution, model: *model, age });
                }
            }
        }
        if let Some(best) = &mut best {
            best.age += 1;
            if best.age > MOST_SHARPENING {
                break;
            }
        }
        let x = model.x + step.v;
        attempt = Some(Attempt { from: *model, step: step.v, lambda, merit: model.merit(problem, lambda) });
        *model = LocalModel::of(bodies, x, bodies.map(|body| body.locate(&x)), problem.weights(lambda), axes);
    }
    match best {
        Some(best) => {
            *model = best.model;
            Solution { iterations, ..best.solution }
        }
        None => Solution::unsettled(model.x, lambda, iterations),
    }
}

/// A step that was tried, to be shortened if it made things worse.
struct Attempt {
    from: LocalModel,
    step: Vector3<f64>,
    lambda: f64,
    merit: f64,
}

impl Attempt {
    /// Whether the merit at the end of the step is no larger than before, but for rounding.
    fn is_descent(&self, bodies: [&Body; 2], problem: Problem, model: &LocalModel) -> bool {
        let merit = model.merit(problem, self.lambda);
        merit <= self.merit || merit <= self.merit + model.merit_rounding(bodies, problem, self.lambda)
    }

    /// The model at the best point along the step instead.
    #[cold]
    fn shortened(&self, bodies: [&Body; 2], problem: Problem, lambda: f64, axes: Axes) -> LocalModel {
        let x = self.from.x
            + line_search::descend(bodies, Merit(problem, self.lambda), &self.from.x, &self.step) * self.step;
        LocalModel::of(bodies, x, bodies.map(|body| body.locate(&x)), problem.weights(lambda), axes)
    }
}
