//! One call: the pair being solved, the order in which solvers are tried, and what it has cost so far.
//!
//! 1. One Newton step from the start, which is enough for nearly all pairs (`first_step`).
//! 2. Newton's method from there ([`newton`]).
//! 3. The extended tier, where that did not settle, where its bound is looser than rounding explains, or where the caller asks for
//!    a smaller gap than doubles can give ([`extended`]).

use crate::bounds::judged::judged;
use crate::bounds::point_bound::point_bound;
use crate::bounds::scale::Scale;
use crate::bounds::solution::{Ending, Solution};
use crate::flags::Flags;
use crate::model::dual_path;
use crate::model::dual_search;
use crate::model::local_model::{self, Axes, LocalModel, Piece, Start, Step};
use crate::model::problem::Problem;
use crate::pair::body::Body;
use crate::pair::pair::Pair;
use crate::pair::pair_state::Remembered;
use crate::pair::role::Role;
use crate::reference::{self, ConicError};
use crate::settings::{BackEnd, Settings};
use crate::solver::newton::{self, Goal};
use crate::solver::{extended, initial_guess};
use nalgebra::Vector3;
use std::ops::ControlFlow::{self, Break, Continue};
use thiserror::Error;

/// A gap this many times what rounding, regularisation and tolerance explain is looked at in extended precision.
const LOOSE: f64 = 20.0;

/// Why no solver had an answer.
#[derive(Clone, Debug, Error)]
pub(crate) enum SolveError {
    #[error("the iteration in extended precision did not settle: values of S leave the range of numbers")]
    Unsettled,
    #[error("the cone program: {0}")]
    Conic(#[from] ConicError),
}

/// One of the closest points, with its bounds.
pub(crate) struct CertifiedPoint {
    pub x: Vector3<f64>,
    /// Ratio of weights λ = u/(1−u).
    pub lambda: f64,
    pub gradients: [Vector3<f64>; 2],
    pub gradient_norms: [f64; 2],
    /// S_A and S_B.
    pub values: [f64; 2],
    pub scale: Scale,
    /// Bound on the distance to the optimum.
    pub bound: f64,
}

/// The pair, what is asked, and what it has cost so far.
pub(crate) struct Call<'a> {
    pub pair: &'a Pair<'a>,
    body_a: Body<'a>,
    body_b: Body<'a>,
    settings: &'a Settings,
    pub iterations: u32,
    pub flags: Flags,
    pub answered: BackEnd,
}

impl<'a> Call<'a> {
    pub fn new(pair: &'a Pair<'a>, settings: &'a Settings) -> Self {
        let (body_a, body_b) = Body::both(pair, settings.least_sphericity());
        let answered = settings.back_end;
        Self { pair, body_a, body_b, settings, iterations: 0, flags: Flags::default(), answered }
    }

    /// Both bodies, as the solver sees them.
    pub fn bodies(&self) -> [&Body<'a>; 2] {
        [&self.body_a, &self.body_b]
    }

    /// Where to begin if nothing is known.
    pub fn cold(&self) -> Start {
        initial_guess::cold(self.pair, self.bodies())
    }

    /// Both quadratics where a search begins.
    #[inline(always)]
    pub fn model(&self, start: &Start, problem: Problem) -> LocalModel {
        LocalModel::at(self.bodies(), start, problem, self.axes())
    }

    fn axes(&self) -> Axes {
        Axes::of(self.bodies())
    }

    /// The solution of the first step, if that is all that it takes; else to go on with the step, if there is one.
    #[inline(always)]
    pub fn first_step(
        &mut self,
        problem: Problem,
        lambda: f64,
        model: &LocalModel,
    ) -> ControlFlow<Solution, Option<Step>> {
        if self.settings.back_end != BackEnd::Fast {
            return Continue(None);
        }
        let (bodies, goal) = (self.bodies(), self.goal(problem));
        let Some(optimum) = model.quadratics(bodies, problem).solve(lambda) else { return Continue(None) };
        let step = model.step(bodies, optimum);
        let Some(solution) = newton::accepted(bodies, &goal, model, &step) else { return Continue(Some(step)) };
        self.count(&solution);
        Break(solution)
    }

    /// By all solvers in their order, beginning with the model at hand and the step from there, if it is known; the model of the
    /// solution is left there.
    #[inline(never)]
    pub fn solve(
        &mut self,
        problem: Problem,
        lambda: f64,
        model: &mut LocalModel,
        first: Option<Step>,
    ) -> Result<Solution, SolveError> {
        if self.settings.back_end == BackEnd::Conic {
            return self.by_cone_program(problem, model);
        }
        let goal = self.goal(problem);
        let mut solution = newton::solve(self.bodies(), &goal, lambda, self.axes(), model, first);
        if self.wants_more(&solution, model, &goal) {
            self.iterations += solution.iterations;
            solution = self.extended(&goal, solution, model)?;
        }
        self.count(&solution);
        Ok(solution)
    }

    /// Whether a solution is unsettled, or its gap wider than rounding, regularisation and tolerance explain, or than was asked for.
    fn wants_more(&self, solution: &Solution, model: &LocalModel, goal: &Goal) -> bool {
        let [a, b] = self.bodies();
        let level = solution.upper.max(1.0);
        let flat = goal.problem.weighted(a.most_surplus(level), b.most_surplus(level), solution.lambda);
        let explained = solution.least_rounding([a, b], model, goal.problem) + flat + goal.tolerance * level;
        match solution.ending {
            Ending::Separated => false,
            Ending::Unsettled => true,
            Ending::Converged => !solution.linear,
            Ending::RoundingLimited => !solution.linear || !goal.takes_rounding() || solution.gap() > LOOSE * explained,
        }
    }

    #[cold]
    fn extended(&mut self, goal: &Goal, first: Solution, model: &mut LocalModel) -> Result<Solution, SolveError> {
        // Where Newton's method ended without a solution may be anywhere, and so may what it began with from memory.
        let known = first.ending != Ending::Unsettled;
        let start = if known { Start { x: first.x, lambda: first.lambda } } else { self.cold() };
        let solution = extended::solve(self.pair, self.bodies(), goal, &start);
        let settled = solution.ending != Ending::Unsettled;
        if known && !(settled && solution.gap() < first.gap()) {
            return Ok(first);
        }
        if !settled {
            return Err(SolveError::Unsettled);
        }
        self.flags.insert(Flags::EXTENDED);
        let start = Start { x: solution.x, lambda: solution.lambda };
        *model = self.model(&start, goal.problem);
        Ok(solution)
    }

    #[cold]
    fn by_cone_program(&mut self, problem: Problem, model: &mut LocalModel) -> Result<Solution, SolveError> {
        let found = match problem {
            Problem::Midway => reference::midway(self.pair)?,
            Problem::OnB => reference::closest(self.pair, Role::B)?,
            Problem::OnA => reference::closest(self.pair, Role::A)?,
        };
        self.iterations += found.iterations;
        // A weight rounded to 1 stands for a λ of 2/ε or more.
        let weight = found.weight.min(1.0 - 0.5 * f64::EPSILON);
        let lambda = weight / (1.0 - weight);
        let solution = judged(&found.x, lambda, found.s, self.bodies(), problem);
        *model = self.model(&Start { x: solution.x, lambda }, problem);
        Ok(solution)
    }

    fn count(&mut self, solution: &Solution) {
        self.iterations += solution.iterations;
        if solution.ending == Ending::RoundingLimited {
            self.flags.insert(Flags::ROUNDING_LIMITED);
        }
    }

    fn goal(&self, problem: Problem) -> Goal {
        Goal {
            problem,
            tolerance: self.settings.gap_tolerance,
            stop_when_separated: problem == Problem::Midway && !self.settings.solve_separated,
        }
    }

    /// One of the two problems of closest, or `None` where its constraint is slack: the optimum is then the
    /// minimum of the other particle, for k > 0 its centre, for k = 0 anywhere in its core, and no contact
    /// point. Midway has no such case.
    ///
    /// `midway`, with its model, lies near it on the same path, mostly with the same active set.
    #[inline(never)]
    pub fn closest_point(
        &mut self,
        problem: Problem,
        midway: Option<(&Solution, &LocalModel)>,
    ) -> Result<Option<CertifiedPoint>, SolveError> {
        if self.centre_is_inside(problem) {
            return Ok(None);
        }
        let start = match midway {
            Some((midway, _)) => Start { x: midway.x, lambda: midway.towards(problem) },
            None => self.cold(),
        };
        let mut model = match midway {
            Some((_, model)) => *model,
            None => self.model(&start, problem),
        };
        let solution = match self.first_step(problem, start.lambda, &model) {
            Break(solution) => solution,
            Continue(step) => self.solve(problem, start.lambda, &mut model, step)?,
        };
        let found = self.certified(problem, &solution, &model);
        // A scale that cannot be told from 0 is a sign of a core only if there is one.
        let free = if problem == Problem::OnB { self.pair.a } else { self.pair.b };
        Ok((free.sphericity() > 0.0 || !found.scale.tells_nothing()).then_some(found))
    }

    /// P1 and P2 from the model at hand and what the last call left, where one step is enough for both and either scale
    /// tells that the particles overlap: midway is then needed neither for that nor as a start.
    #[inline(never)]
    pub fn both_from_memory(&mut self, last: &Remembered, model: &LocalModel) -> Option<[CertifiedPoint; 2]> {
        let values = [model.q_a.expansion, model.q_b.expansion];
        let [of_p1, of_p2] = dual_path::closest_from_between(values, last.lambda);
        let lambdas = [last.closest[0] * of_p1, last.closest[1] * of_p2];
        self.both(lambdas, model, |found| found.scale.s + found.scale.gap < 1.0)
    }

    /// P1 and P2 from midway and its model, where one step is enough for both.
    #[inline(never)]
    pub fn both_from_midway(&mut self, midway: &Solution, model: &LocalModel) -> Option<[CertifiedPoint; 2]> {
        self.both([midway.towards(Problem::OnA), midway.towards(Problem::OnB)], model, |_| true)
    }

    /// P1 and P2 by one step from guesses of their λ, if both will do.
    #[inline(always)]
    fn both(
        &mut self,
        lambdas: [f64; 2],
        model: &LocalModel,
        will_do: impl Fn(&CertifiedPoint) -> bool,
    ) -> Option<[CertifiedPoint; 2]> {
        if self.settings.back_end != BackEnd::Fast {
            return None;
        }
        let bodies = self.bodies();
        let soft = local_model::softest(bodies);
        let [p1, p2] = dual_search::both_closest([&model.q_a, &model.q_b], soft, lambdas)?;
        let on_a = newton::accepted(bodies, &self.goal(Problem::OnA), model, &model.step(bodies, p1))?;
        let on_b = newton::accepted(bodies, &self.goal(Problem::OnB), model, &model.step(bodies, p2))?;
        let points = [self.certified(Problem::OnA, &on_a, model), self.certified(Problem::OnB, &on_b, model)];
        if !points.iter().all(|found| !found.scale.tells_nothing() && will_do(found)) {
            return None;
        }
        self.count(&on_a);
        self.count(&on_b);
        Some(points)
    }

    fn centre_is_inside(&self, problem: Problem) -> bool {
        match problem {
            Problem::OnB => self.pair.b.potential(&self.pair.centre) < 0.0,
            _ => self.pair.a.potential(&self.body_a.local(&self.body_b.centre())) < 0.0,
        }
    }

    fn certified(&self, problem: Problem, solution: &Solution, model: &LocalModel) -> CertifiedPoint {
        let Solution { x, lambda, gradients, gradient_norms, values, .. } = *solution;
        let bound = self.point_bound(solution, model, problem);
        CertifiedPoint { x, lambda, gradients, gradient_norms, values, scale: self.scale(solution, problem), bound }
    }

    /// The scale s of a solution, and the bound on its error.
    #[inline]
    pub fn scale(&self, solution: &Solution, problem: Problem) -> Scale {
        Scale::of(solution, self.bodies(), problem)
    }

    /// Bound on the distance from the point of a solution to the optimum.
    #[inline]
    pub fn point_bound(&self, solution: &Solution, model: &LocalModel, problem: Problem) -> f64 {
        point_bound(solution, model, self.bodies(), problem)
    }

    /// S_A and S_B along a direction from the point of a solution.
    #[inline]
    pub fn pieces(&self, solution: &Solution, model: &LocalModel, n: &Vector3<f64>) -> [Piece; 2] {
        model.pieces(self.bodies(), &solution.x, n)
    }
}
