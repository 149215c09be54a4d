//! One call: the pair being solved, the order in which solvers are tried, and what it has cost so far.

use crate::bounds::external_solution::external_solution;
use crate::bounds::point_bound::point_bound;
use crate::bounds::scale::Scale;
use crate::bounds::solution::{Ending, Solution};
use crate::flags::Flags;
use crate::model::local_model::{Axes, LocalModel, Piece, Start, Step};
use crate::model::problem::Problem;
use crate::pair::body::Body;
use crate::pair::pair::Pair;
use crate::pair::role::Role;
use crate::reference::{self, ConeProgramError};
use crate::settings::{BackEnd, Settings};
use crate::solver::initial_guess::Guess;
use crate::solver::newton::{self, Goal};
use crate::solver::{extended, initial_guess};
use nalgebra::Vector3;
use std::ops::ControlFlow::{self, Break, Continue};
use thiserror::Error;

/// A gap this many times what rounding, regularisation and tolerance explain is solved again in extended precision
/// (chosen; docs/theory.md, section 9).
const LOOSE: f64 = 20.0;

/// Upper bound of s above which an s that may be 0 is solved again in extended precision: in a core, s is far less
/// (chosen).
const NEAR_ZERO: f64 = 1e-2;

/// Why no solver had an answer.
#[derive(Clone, Debug, Error)]
pub(crate) enum SolveError {
    #[error("the iteration in extended precision did not settle: values of S leave the range of numbers")]
    Unsettled,
    #[error("in extended precision the bounds of s, {low:e} and {high:e}, still leave open what it is")]
    Undecided { low: f64, high: f64 },
    #[error("the cone program: {0}")]
    ConeProgram(#[from] ConeProgramError),
}

/// A solution, with the quadratics whose optimum it is or, from other solvers, those at its point. The quadratics are
/// borrowed: copying costs a twentieth of a call from memory.
pub(crate) struct Solved<'m> {
    pub solution: Solution,
    pub model: &'m LocalModel,
}

/// The pair, what is asked, and what it has cost so far.
pub(crate) struct Call<'a> {
    pub pair: &'a Pair<'a>,
    body_a: Body<'a>,
    body_b: Body<'a>,
    pub settings: &'a Settings,
    pub iterations: u32,
    pub flags: Flags,
    /// Who answers.
    pub back_end: BackEnd,
    /// Whether extended precision is always required.
    pub precise: bool,
}

impl<'a> Call<'a> {
    pub fn new(pair: &'a Pair<'a>, settings: &'a Settings) -> Self {
        let (body_a, body_b) = Body::both(pair, settings.least_sphericity());
        // The cone programs are those of two particles.
        let back_end = if pair.b.is_boundary() { BackEnd::Fast } else { settings.back_end };
        Self { pair, body_a, body_b, settings, iterations: 0, flags: Flags::default(), back_end, precise: false }
    }

    /// Both bodies, as the solver sees them.
    pub fn bodies(&self) -> [&Body<'a>; 2] {
        [&self.body_a, &self.body_b]
    }

    /// Where to begin if nothing is known.
    pub fn cold(&self) -> Start {
        self.cold_or_apart().0
    }

    /// The same, with the planes that prove the pair separated, if they were found.
    pub fn cold_or_apart(&self) -> Guess {
        initial_guess::cold(self.pair, self.bodies())
    }

    /// Whether a cold start is as good as one from where the pair was separated.
    pub fn is_sharp(&self) -> bool {
        initial_guess::is_sharp(self.bodies())
    }

    /// Both quadratics where a search begins.
    #[inline(always)]
    pub fn model(&self, start: &Start, problem: Problem) -> LocalModel {
        LocalModel::at(self.bodies(), start, problem, self.axes())
    }

    fn axes(&self) -> Axes {
        Axes::of(self.bodies())
    }

    /// Solves a problem from the quadratics at a point, which become those of the solution, and a guess of λ:
    ///
    /// 1. one Newton step, which is enough for nearly all pairs from memory;
    /// 2. Newton's method from there;
    /// 3. in extended precision, where doubles do not settle it ([`Self::wants_more`]).
    #[inline(always)]
    pub fn solve<'m>(
        &mut self,
        problem: Problem,
        lambda: f64,
        model: &'m mut LocalModel,
    ) -> Result<Solved<'m>, SolveError> {
        let step = match self.first_step(problem, lambda, model) {
            Break(solution) => return Ok(Solved { solution, model }),
            Continue(step) => step,
        };
        let solution = self.go_on(problem, lambda, model, step)?;
        Ok(Solved { solution, model })
    }

    /// The solution of one Newton step, if that is all that it takes; else the step to go on with, if there is one.
    #[inline(always)]
    fn first_step(&mut self, problem: Problem, lambda: f64, model: &LocalModel) -> ControlFlow<Solution, Option<Step>> {
        if self.back_end == BackEnd::ConeProgram {
            return Continue(None);
        }
        let (bodies, goal) = (self.bodies(), self.goal(problem));
        let Some(optimum) = model.quadratics(bodies, problem).solve(lambda) else { return Continue(None) };
        let step = model.step(bodies, optimum);
        let Some(solution) = newton::accepted(bodies, &goal, model, &step) else { return Continue(Some(step)) };
        if self.precise {
            return Continue(Some(step));
        }
        self.count(&solution);
        Break(solution)
    }

    /// Continues where the first step, if any, did not suffice.
    #[inline(never)]
    fn go_on(
        &mut self,
        problem: Problem,
        lambda: f64,
        model: &mut LocalModel,
        step: Option<Step>,
    ) -> Result<Solution, SolveError> {
        if self.back_end == BackEnd::ConeProgram {
            return self.by_cone_program(problem, model);
        }
        let goal = self.goal(problem);
        let mut solution = newton::solve(self.bodies(), &goal, lambda, self.axes(), model, step);
        if self.wants_more(&solution, model, &goal) {
            self.iterations += solution.iterations;
            solution = self.extended(&goal, solution, model)?;
        }
        self.count(&solution);
        Ok(solution)
    }

    /// Whether a solution in doubles is unsettled, its gap wider than rounding, regularisation and tolerance explain,
    /// or than was asked for, or its bounds leave open what matters: on which side of 1 s lies, or whether the
    /// constraint of closest is slack.
    fn wants_more(&self, solution: &Solution, model: &LocalModel, goal: &Goal) -> bool {
        let [a, b] = self.bodies();
        let level = solution.upper.max(1.0);
        let [level_a, level_b] = goal.problem.levels(level);
        let flat = goal.problem.weighted(a.most_surplus(level_a), b.most_surplus(level_b), solution.lambda);
        let explained = solution.least_rounding([a, b], model, goal.problem) + flat + goal.tolerance * level;
        match solution.ending {
            _ if self.precise => true,
            Ending::Separated => false,
            Ending::Unsettled => true,
            _ if !solution.linear || self.leaves_open(solution, goal.problem) => true,
            Ending::Converged => false,
            Ending::RoundingLimited => !goal.takes_rounding() || solution.gap() > LOOSE * explained,
        }
    }

    fn leaves_open(&self, solution: &Solution, problem: Problem) -> bool {
        let scale = self.scale(solution, problem);
        let slack = problem.held().is_some() && scale.may_be_zero() && scale.high > NEAR_ZERO;
        slack || Solution::is_inconclusive(solution.gap(), solution.upper)
    }

    #[cold]
    fn extended(&mut self, goal: &Goal, first: Solution, model: &mut LocalModel) -> Result<Solution, SolveError> {
        // Without a solution, Newton's last point may be anywhere, and so may the remembered start.
        let known = first.ending != Ending::Unsettled;
        let start = if known { first.start() } else { self.cold() };
        let solution = extended::solve(self.pair, self.bodies(), goal, &start);
        let settled = solution.ending != Ending::Unsettled;
        if known && !(settled && solution.gap() < first.gap()) {
            return Ok(first);
        }
        if !settled {
            return Err(SolveError::Unsettled);
        }
        self.flags.set(Flags::EXTENDED, true);
        *model = self.model(&solution.start(), goal.problem);
        Ok(solution)
    }

    #[cold]
    fn by_cone_program(&mut self, problem: Problem, model: &mut LocalModel) -> Result<Solution, SolveError> {
        let found = match problem {
            Problem::OnB => reference::closest(self.pair, Role::B)?,
            Problem::OnA => reference::closest(self.pair, Role::A)?,
            Problem::Midway | Problem::OnBoundary => reference::midway(self.pair)?,
        };
        self.iterations += found.iterations;
        // A weight rounded to 1 stands for a λ of 2/ε or more.
        let weight = found.weight.min(1.0 - 0.5 * f64::EPSILON);
        let lambda = weight / (1.0 - weight);
        let solution = external_solution(&found.x, lambda, found.s, self.bodies(), problem);
        *model = self.model(&Start { x: solution.x, lambda }, problem);
        Ok(solution)
    }

    pub(super) fn count(&mut self, solution: &Solution) {
        self.iterations += solution.iterations;
        self.flags.set(Flags::ROUNDING_LIMITED, solution.ending == Ending::RoundingLimited);
    }

    pub(super) fn goal(&self, problem: Problem) -> Goal {
        Goal {
            problem,
            tolerance: self.settings.gap_tolerance,
            stop_when_separated: problem == Problem::Midway && !self.settings.solve_separated(),
        }
    }

    /// The scale s of a solution, with its bounds.
    #[inline]
    pub fn scale(&self, solution: &Solution, problem: Problem) -> Scale {
        Scale::of(solution, self.bodies(), problem)
    }

    /// Bound on the distance from the point of a solution to the optimum.
    #[inline]
    pub fn point_bound(&self, Solved { solution, model }: &Solved, problem: Problem) -> f64 {
        point_bound(solution, model, self.bodies(), problem)
    }

    /// S_A and S_B along a direction from the point of a solution.
    #[inline]
    pub fn pieces(&self, Solved { solution, model }: &Solved, n: &Vector3<f64>) -> [Piece; 2] {
        model.pieces(self.bodies(), &solution.x, n)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particle::particle::Particle;
    use crate::pose::Pose;

    /// Two turned cubes solved in doubles and, where that is asked for, in 32 digits: both contain the same s, and only
    /// the second is flagged.
    #[test]
    fn either_tier_bounds_the_answer_of_the_other() {
        let cube = Particle::cube(0.4, 0.1, 0.02, 0.9);
        let (pose_a, pose_b) =
            (Pose::new([0.7, 0.4, 0.3], [0.9, 0.3, -0.2, 0.5]).unwrap(), Pose::at([0.0; 3]).unwrap());
        let (pair, settings) = (Pair::new(&cube, &pose_a, &cube, &pose_b), Settings::default());
        for problem in [Problem::Midway, Problem::OnB, Problem::OnA] {
            let solve = |precise: bool| {
                let mut call = Call::new(&pair, &settings);
                call.precise = precise;
                let start = call.cold();
                let mut model = call.model(&start, problem);
                let solution = call.solve(problem, start.lambda, &mut model).unwrap().solution;
                (call.scale(&solution, problem), call.flags.contains(Flags::EXTENDED), solution)
            };
            let ((doubles, by_doubles, _), (wide, by_wide, _)) = (solve(false), solve(true));
            assert!(!by_doubles && by_wide, "{problem:?}");
            assert!((doubles.s - wide.s).abs() <= doubles.gap + wide.gap, "{problem:?}: {doubles:?}, {wide:?}");
            assert!(wide.gap < 0.1 * doubles.gap, "{problem:?}: {doubles:?}, {wide:?}");
        }
    }

    #[test]
    fn from_its_own_solution_a_call_takes_one_step() {
        let cube = Particle::cube(0.4, 0.1, 0.02, 0.9);
        let (pose_a, pose_b) =
            (Pose::new([0.7, 0.4, 0.3], [0.9, 0.3, -0.2, 0.5]).unwrap(), Pose::at([0.0; 3]).unwrap());
        let (pair, settings) = (Pair::new(&cube, &pose_a, &cube, &pose_b), Settings::default());
        let from = |start: Start| {
            let mut call = Call::new(&pair, &settings);
            let mut model = call.model(&start, Problem::Midway);
            let solution = call.solve(Problem::Midway, start.lambda, &mut model).unwrap().solution;
            (solution, call.iterations)
        };
        let (first, iterations) = from(Start { x: Vector3::new(-0.3, 0.5, 0.6), lambda: 7.0 });
        let (again, once) = from(first.start());
        assert!(iterations > 1 && once == 1, "{iterations}, {once}");
        assert!(
            (again.x - first.x).norm() < 1e-13 && (again.estimate - first.estimate).abs() <= first.gap() + again.gap()
        );
    }
}
