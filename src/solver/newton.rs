//! Newton's method on the exact quadratic pieces, with a dual bound at every step.
//!
//! Each iteration makes both quadratics at x, solves the pair exactly ([`crate::model::dual_search`]) and steps to
//! their optimum. If the active set is unchanged after the step, the point is optimal and the dual value is a lower
//! bound. A step that does not reduce the merit (planes became active on the way) is shortened by an exact line search.

use crate::bounds::solution::{Ending, Solution};
use crate::linalg::number::larger;
use crate::model::kkt_check::Change;
use crate::model::local_model::{self, Axes, LocalModel, Step};
use crate::model::problem::Problem;
use crate::pair::body::Body;
use crate::settings::LEAST_OF_DOUBLES;
use crate::solver::line_search::{self, Merit};
use nalgebra::Vector3;
use std::ops::ControlFlow::{self, Break, Continue};

/// Most iterations; few searches come to an end after more (chosen; searches that take more repeat themselves).
const MOST_ITERATIONS: u32 = 30;

/// Step length at convergence, relative to the smaller particle. Chosen: the next step is shorter than rounding.
const SHORT: f64 = 1e-9;

/// Accepted multiple of the rounding floor of a gap (chosen).
const AS_SHARP: f64 = 8.0;

/// Relative gap above which an optimum is sought again from nearby (chosen).
const SHARP: f64 = 1e-2;

/// Iterations granted to sharpen an optimum that is known already (chosen).
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
    /// Whether an answer at the rounding floor of doubles is accepted although its gap exceeds the tolerance.
    pub fn takes_rounding(&self) -> bool {
        self.tolerance >= LEAST_OF_DOUBLES
    }
}

/// The solution that a step of unchanged active set leads to, if its bounds are as good as they can be.
#[inline(always)]
pub(crate) fn accepted(bodies: [&Body; 2], goal: &Goal, model: &LocalModel, step: &Step) -> Option<Solution> {
    if step.change != Change::None || !step.optimum.settled {
        return None;
    }
    let solution = Solution { iterations: 1, ..Solution::of(model, bodies, goal.problem, step) };
    if goal.stop_when_separated && solution.separates(max_regularisation_error(bodies)) {
        return Some(Solution { ending: Ending::Separated, ..solution });
    }
    let quality = Quality::of(&solution, bodies, goal, model);
    let good = quality.precise || (quality.rounded && quality.telling && goal.takes_rounding());
    (good && solution.linear).then_some(Solution { ending: quality.ending(), ..solution })
}

/// Bound on what the regularisation adds to S where s < 1.
pub(crate) fn max_regularisation_error([a, b]: [&Body; 2]) -> f64 {
    larger(a.most_surplus(1.0), b.most_surplus(1.0))
}

/// How good the bounds of a solution are.
struct Quality {
    /// They meet within the tolerance.
    precise: bool,
    /// As near as rounding lets any bounds come.
    rounded: bool,
    /// They are narrow, even where rounding is large.
    telling: bool,
}

impl Quality {
    #[inline(always)]
    fn of(solution: &Solution, bodies: [&Body; 2], goal: &Goal, model: &LocalModel) -> Self {
        let gap = solution.gap();
        Self {
            precise: gap <= goal.tolerance * solution.upper,
            rounded: gap <= AS_SHARP * solution.least_rounding(bodies, model, goal.problem),
            telling: gap <= SHARP * solution.upper,
        }
    }

    fn ending(&self) -> Ending {
        if self.precise { Ending::Converged } else { Ending::RoundingLimited }
    }
}

/// Solves for the goal, beginning with the quadratics at a point, and with the step from there if it is known; `model`
/// becomes that of the solution.
pub(crate) fn solve(
    bodies: [&Body; 2],
    goal: &Goal,
    lambda: f64,
    axes: Axes,
    model: &mut LocalModel,
    first: Option<Step>,
) -> Solution {
    let mut search = Search { bodies, goal, axes, model, lambda, first, attempt: None, best: None, iterations: 0 };
    while search.iterations < MOST_ITERATIONS {
        match search.iterate() {
            Continue(()) => {}
            Break(Some(solution)) => return solution,
            Break(None) => break,
        }
    }
    search.end()
}

/// What is known on the way.
struct Search<'a> {
    bodies: [&'a Body<'a>; 2],
    goal: &'a Goal,
    axes: Axes,
    /// The current model.
    model: &'a mut LocalModel,
    lambda: f64,
    /// The step from there, while it is the first.
    first: Option<Step>,
    /// The step that led to the current model.
    attempt: Option<Attempt>,
    best: Option<Best>,
    iterations: u32,
}

/// The best solution so far, with the model it is an optimum of.
struct Best {
    solution: Solution,
    model: LocalModel,
    /// Iterations since the first.
    age: u32,
}

impl Search<'_> {
    /// Continues with another model, or ends: with an answer, or without one if no step is possible or worthwhile.
    fn iterate(&mut self) -> ControlFlow<Option<Solution>> {
        self.iterations += 1;
        self.shorten_if_failed();
        if !self.merit().is_finite() {
            return Break(None);
        }
        let known = self.first.take();
        let next = known.or_else(|| self.model.optimum(self.bodies, self.goal.problem, self.lambda));
        let Some(step) = next else { return Break(None) };
        self.lambda = step.optimum.lambda;
        if step.change == Change::Leaving {
            *self.model = self.model.without_leaving(self.bodies, &step, self.weights(), self.axes);
            self.attempt = None;
            return Continue(());
        }
        let answer = self.answer(&step);
        if answer.is_some() {
            return Break(answer);
        }
        if self.count_sharpening() > MOST_SHARPENING {
            return Break(None);
        }
        self.take(&step);
        Continue(())
    }

    /// Shortens the last step if it did not reduce the merit.
    fn shorten_if_failed(&mut self) {
        let problem = self.goal.problem;
        if let Some(last) = self.attempt.as_ref().filter(|last| !last.is_descent(self.bodies, problem, self.model)) {
            *self.model = last.shortened(self.bodies, problem, self.lambda, self.axes);
        }
    }

    /// The optimum of the model as a solution, if it is optimal and good enough. If only optimal, it is kept if it is
    /// the best so far: its step is long, and the same optimum from nearby is sharper.
    fn answer(&mut self, step: &Step) -> Option<Solution> {
        let lower = self.goal.problem.dual(step.optimum.values.0, step.optimum.values.1, self.lambda);
        let separating = self.goal.stop_when_separated && lower > 1.0 && step.change != Change::Pulling;
        let optimal = step.change == Change::None && step.optimum.settled;
        if !separating && !optimal {
            return None;
        }
        let of_step = Solution::of(self.model, self.bodies, self.goal.problem, step);
        let solution = Solution { iterations: self.iterations, ..of_step };
        if separating && solution.separates(max_regularisation_error(self.bodies)) {
            return Some(Solution { ending: Ending::Separated, ..solution });
        }
        if !optimal {
            return None;
        }
        let quality = Quality::of(&solution, self.bodies, self.goal, self.model);
        let solution = Solution { ending: quality.ending(), ..solution };
        let short = step.length <= SHORT * local_model::smallest(self.bodies);
        if quality.precise || ((short || quality.rounded) && quality.telling) {
            return Some(solution);
        }
        if self.best.as_ref().is_none_or(|best| solution.gap() < best.solution.gap()) {
            let age = self.best.as_ref().map_or(0, |best| best.age);
            self.best = Some(Best { solution, model: *self.model, age });
        }
        None
    }

    /// Counts this iteration if an optimum is known already, and gives how many there have been since.
    fn count_sharpening(&mut self) -> u32 {
        self.best.as_mut().map_or(0, |best| {
            best.age += 1;
            best.age
        })
    }

    /// Goes to the optimum of the model.
    fn take(&mut self, step: &Step) {
        let x = self.model.x + step.v;
        self.attempt = Some(Attempt { from: *self.model, step: step.v, lambda: self.lambda, merit: self.merit() });
        let points = self.bodies.map(|body| body.locate(&x));
        *self.model = LocalModel::of(self.bodies, x, points, self.weights(), self.axes);
    }

    /// The best solution, to whose model it goes back, or where the search ended.
    fn end(self) -> Solution {
        let iterations = self.iterations;
        match self.best {
            Some(best) => {
                *self.model = best.model;
                Solution { iterations, ..best.solution }
            }
            None => Solution::unsettled(self.model.x, self.lambda, iterations),
        }
    }

    fn merit(&self) -> f64 {
        self.model.merit(self.goal.problem, self.lambda)
    }

    fn weights(&self) -> (f64, f64) {
        self.goal.problem.weights(self.lambda)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pair::pair::Pair;
    use crate::pair::scattered;
    use crate::particle::particle::Particle;
    use crate::pose::Pose;

    fn solved(bodies: [&Body; 2], goal: &Goal, from: Vector3<f64>, lambda: f64) -> Solution {
        let axes = Axes::of(bodies);
        let points = bodies.map(|body| body.locate(&from));
        let mut model = LocalModel::of(bodies, from, points, goal.problem.weights(lambda), axes);
        solve(bodies, goal, lambda, axes, &mut model, None)
    }

    fn goal(problem: Problem) -> Goal {
        Goal { problem, tolerance: 1e-12, stop_when_separated: false }
    }

    /// Other planes are active at the start. At the end the forces balance, both S are equal, and their maximum is
    /// least nearby.
    #[test]
    fn the_solution_is_the_optimum_by_its_definition() {
        let cube = Particle::cube(0.4, 0.1, 0.02, 0.9);
        for seed in 0..50 {
            let mut chance = scattered(50 * seed);
            let mut vector = || Vector3::<f64>::from_fn(|_, _| chance());
            let (turn, towards, start) = (vector(), vector().normalize(), 0.6 * vector());
            let pose_a = Pose::new((0.9 * towards).into(), [0.5, turn.x, turn.y, turn.z]).unwrap();
            let pose_b = Pose::at([0.0; 3]).unwrap();
            let pair = Pair::new(&cube, &pose_a, &cube, &pose_b);
            let (a, b) = Body::both(&pair, 0.0);
            let found = solved([&a, &b], &goal(Problem::Midway), start, 30.0);
            assert!(matches!(found.ending, Ending::Converged | Ending::RoundingLimited), "{found:?}");
            let [of_a, of_b] = [&a, &b].map(|body| body.at(&body.locate(&found.x), None));
            let (u, v) = Problem::Midway.weights(found.lambda);
            assert!((u * of_a.gradient + v * of_b.gradient).norm() < 1e-11 * of_a.gradient.norm(), "{found:?}");
            assert!((of_a.value - of_b.value).abs() < 1e-11 * of_a.value, "{found:?}");
            for _ in 0..20 {
                let x = found.x + 1e-3 * vector();
                assert!(a.value(&x).max(b.value(&x)) >= found.lower - found.rounding, "{found:?}");
            }
        }
    }

    /// Balls of radii 1 and 2 whose centres are 3.3 apart: s = 1.1.
    #[test]
    fn balls_apart_are_separated_where_that_is_enough() {
        let balls = [1.0, 2.0].map(|radius| Particle::sphere(radius).unwrap());
        let (pose_a, pose_b) = (Pose::at([0.0, 0.0, 3.3]).unwrap(), Pose::at([0.0; 3]).unwrap());
        let pair = Pair::new(&balls[0], &pose_a, &balls[1], &pose_b);
        let (a, b) = Body::both(&pair, 0.0);
        let to_the_end = solved([&a, &b], &goal(Problem::Midway), Vector3::new(1.0, -0.5, 0.3), 1.0);
        assert!((to_the_end.estimate.sqrt() - 1.1).abs() < 1e-14 && (to_the_end.lambda - 2.0).abs() < 1e-13);
        assert!((to_the_end.x - Vector3::new(0.0, 0.0, 2.2)).norm() < 1e-14, "{to_the_end:?}");
        let enough = Goal { stop_when_separated: true, ..goal(Problem::Midway) };
        let separated = solved([&a, &b], &enough, Vector3::new(1.0, -0.5, 0.3), 1.0);
        assert!(separated.ending == Ending::Separated && separated.lower > 1.0, "{separated:?}");
        assert!(separated.lower <= 1.21 * (1.0 + 1e-14));
    }
}
