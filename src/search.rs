//! One pair being solved: the ladder of solvers, and what it has cost so far.

use crate::body::Body;
use crate::certificate::{self, Certified};
use crate::conic::{self, ConicError, Role};
use crate::contact::Flags;
use crate::pair::Pair;
use crate::settings::{BackEnd, Settings};
use crate::spine::{self, Ending, Expansion, Factorisation, Goal, Outcome, Start};
use crate::target::Target;

/// One call: the pair, what is asked, and what it has cost so far.
pub(crate) struct Search<'a> {
    pair: &'a Pair<'a>,
    body_a: Body<'a>,
    body_b: Body<'a>,
    settings: &'a Settings,
    pub iterations: u32,
    pub flags: Flags,
    pub answered: BackEnd,
}

/// An answer, with the quadratics that it is the optimum of; `None` where the cone program gave it.
pub(crate) struct Answer {
    pub outcome: Outcome,
    pub expansion: Option<Expansion>,
}

impl Answer {
    /// Where a neighbouring problem of the same pair may begin.
    fn start(&self) -> Start {
        Start { x: self.outcome.x, lambda: self.outcome.lambda, near: true }
    }
}

impl<'a> Search<'a> {
    pub fn new(pair: &'a Pair<'a>, settings: &'a Settings) -> Self {
        let (body_a, body_b) = Body::both(pair, settings.flat_regularisation);
        Self { pair, body_a, body_b, settings, iterations: 0, flags: Flags::default(), answered: settings.back_end }
    }

    /// Midway, from a start if there is one. Into a place of the caller's, since the answer is large.
    pub fn midway(&mut self, start: Option<Start>, into: &mut Option<Answer>) -> Result<(), ConicError> {
        self.solve(Target::Midway, start, None, into)
    }

    /// One of the two problems of closest, or `None` where its constraint is slack: the optimum is then the
    /// minimum of the other particle, for k > 0 its centre, for k = 0 anywhere in its core, and no contact
    /// point. Midway has no such case.
    ///
    /// `midway` lies near it on the same curve, mostly on the same planes.
    pub fn constrained(
        &mut self,
        target: Target,
        midway: Option<&Answer>,
        into: &mut Option<Answer>,
    ) -> Result<Option<Certified>, ConicError> {
        let centre_inside = match target {
            Target::OnB => self.pair.b.potential(&self.pair.centre) < 0.0,
            _ => self.pair.a.potential(&self.body_a.local(&self.body_b.centre())) < 0.0,
        };
        if centre_inside {
            return Ok(None);
        }
        let expansion = midway.and_then(|midway| midway.expansion.as_ref());
        self.solve(target, midway.map(Answer::start), expansion, into)?;
        let scale = into.as_ref().map(|answer| self.certify(answer, target));
        // A scale that cannot be told from 0 belongs to a core.
        Ok(scale.filter(|scale| scale.s > scale.gap))
    }

    /// The scale s of an answer, and the bound on its error.
    pub fn certify(&self, answer: &Answer, target: Target) -> Certified {
        certificate::scale(&answer.outcome, &self.body_a, &self.body_b, target)
    }

    /// Bound on the distance from the point of an answer to the optimum.
    pub fn bound(&self, answer: &Answer, target: Target) -> f64 {
        certificate::distance(&answer.outcome, answer.expansion.as_ref(), &self.body_a, &self.body_b, target)
    }

    /// The ladder: from the start at hand, cold, with the safer factorisation, and by the cone program.
    fn solve(
        &mut self,
        target: Target,
        start: Option<Start>,
        left: Option<&Expansion>,
        into: &mut Option<Answer>,
    ) -> Result<(), ConicError> {
        if self.settings.back_end == BackEnd::Fast {
            let usual = spine::factorisation(&self.body_a, &self.body_b);
            if let Some(start) = start
                && self.attempt(target, &start, left, usual, into)
            {
                return Ok(());
            }
            let cold = spine::cold_start(self.pair, &self.body_a, &self.body_b);
            if self.attempt(target, &cold, None, usual, into) {
                return Ok(());
            }
            if usual == Factorisation::Plain && self.attempt(target, &cold, None, Factorisation::Aligned, into) {
                self.flags.insert(Flags::SAFER);
                return Ok(());
            }
            self.flags.insert(Flags::FELL_BACK);
        }
        self.answered = BackEnd::Conic;
        *into = Some(Answer { outcome: self.conic(target)?, expansion: None });
        Ok(())
    }

    /// One rung of the ladder; whether it has led to an answer.
    fn attempt(
        &mut self,
        target: Target,
        start: &Start,
        left: Option<&Expansion>,
        factorisation: Factorisation,
        into: &mut Option<Answer>,
    ) -> bool {
        let bodies = [&self.body_a, &self.body_b];
        let mut here = match left {
            Some(expansion) => *expansion,
            None => Expansion::at(bodies, start, target, factorisation),
        };
        let goal = Goal {
            target,
            tolerance: self.settings.gap_tolerance,
            stop_when_separated: target == Target::Midway && !self.settings.solve_separated,
        };
        let outcome = spine::solve(bodies[0], bodies[1], &goal, start, factorisation, &mut here);
        self.iterations += outcome.iterations;
        if outcome.ending == Ending::RoundingLimited {
            self.flags.insert(Flags::ROUNDING_LIMITED);
        }
        let found = outcome.ending != Ending::Stuck;
        if found {
            *into = Some(Answer { outcome, expansion: Some(here) });
        }
        found
    }

    fn conic(&mut self, target: Target) -> Result<Outcome, ConicError> {
        let solution = match target {
            Target::Midway => conic::midway(self.pair)?,
            Target::OnB => conic::closest(self.pair, Role::B)?,
            Target::OnA => conic::closest(self.pair, Role::A)?,
        };
        self.iterations += solution.iterations;
        let u = solution.weight;
        let outcome = certificate::judge(&solution.x, u / (1.0 - u), solution.s, &self.body_a, &self.body_b, target);
        Ok(Outcome { iterations: solution.iterations, ..outcome })
    }
}
