//! One pair being solved: the ladder of solvers, and what it has cost so far.

use crate::anchored;
use crate::body::Body;
use crate::certificate::{self, Certified};
use crate::conic::{self, ConicError, Role};
use crate::contact::Flags;
use crate::expansion::{self, Expansion, Factorisation, Piece, Start};
use crate::outcome::{Ending, Outcome};
use crate::pair::Pair;
use crate::settings::{BackEnd, Settings};
use crate::spine::{self, Goal};
use crate::start;
use crate::target::Target;
use nalgebra::Vector3;

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

/// An answer, with the quadratics that it is the optimum of, or at its point where the cone program gave it.
pub(crate) struct Answer {
    pub outcome: Outcome,
    pub expansion: Expansion,
    /// Weights of the planes in the problem that it answers, where the safe solver gave it.
    pub softened: Option<[f64; 2]>,
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

    /// Midway, from a start if there is one.
    #[inline(always)]
    pub fn midway(&mut self, start: Option<Start>) -> Result<Answer, ConicError> {
        self.solve(Target::Midway, start, None)
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
    ) -> Result<Option<(Answer, Certified)>, ConicError> {
        let centre_inside = match target {
            Target::OnB => self.pair.b.potential(&self.pair.centre) < 0.0,
            _ => self.pair.a.potential(&self.body_a.local(&self.body_b.centre())) < 0.0,
        };
        if centre_inside {
            return Ok(None);
        }
        // The quadratics of a softened problem are those of no other.
        let left = midway.filter(|midway| midway.softened.is_none()).map(|midway| &midway.expansion);
        let answer = self.solve(target, midway.map(Answer::start), left)?;
        let scale = self.certify(&answer, target);
        // A scale that cannot be told from 0 belongs to a core.
        Ok((scale.s > scale.gap).then_some((answer, scale)))
    }

    /// The scale s of an answer, and the bound on its error.
    pub fn certify(&self, answer: &Answer, target: Target) -> Certified {
        certificate::scale(&answer.outcome, &self.body_a, &self.body_b, target)
    }

    /// S_A and S_B along a direction from the point of an answer.
    pub fn pieces(&self, answer: &Answer, n: &Vector3<f64>) -> [Piece; 2] {
        let pieces = answer.expansion.pieces([&self.body_a, &self.body_b], &answer.outcome.x, n);
        // Quadratics of a softened problem tell no more than the way.
        if answer.softened.is_some() { pieces.map(|piece| Piece { reach: 0.0, ..piece }) } else { pieces }
    }

    /// Bound on the distance from the point of an answer to the optimum.
    pub fn bound(&self, answer: &Answer, target: Target) -> f64 {
        let bound = |a: &Body, b: &Body| certificate::distance(&answer.outcome, &answer.expansion, a, b, target);
        match answer.softened {
            None => bound(&self.body_a, &self.body_b),
            Some([w_a, w_b]) => bound(&self.body_a.softened(w_a), &self.body_b.softened(w_b)),
        }
    }

    /// The ladder: from the start at hand, cold, by the safe solver, and by the cone program.
    #[inline(always)]
    fn solve(&mut self, target: Target, start: Option<Start>, left: Option<&Expansion>) -> Result<Answer, ConicError> {
        let (bodies, usual) = ([&self.body_a, &self.body_b], expansion::factorisation(&self.body_a, &self.body_b));
        if self.settings.back_end != BackEnd::Fast {
            return self.by_cone_program(target, usual);
        }
        let first = start.unwrap_or_else(|| start::cold(self.pair, &self.body_a, &self.body_b));
        let expansion = match left {
            Some(expansion) => *expansion,
            None => Expansion::at(bodies, &first, target, usual),
        };
        match spine::at_once(bodies, &self.goal(target), &first, &expansion) {
            Some(outcome) => {
                self.iterations += 1;
                if outcome.ending == Ending::RoundingLimited {
                    self.flags.insert(Flags::ROUNDING_LIMITED);
                }
                Ok(Answer { outcome, expansion, softened: None })
            }
            None => self.climb(target, &first, start.is_some(), usual, expansion),
        }
    }

    /// The ladder from quadratics on.
    #[inline(never)]
    fn climb(
        &mut self,
        target: Target,
        first: &Start,
        warm: bool,
        usual: Factorisation,
        expansion: Expansion,
    ) -> Result<Answer, ConicError> {
        let mut answer = Answer { outcome: Outcome::UNKNOWN, expansion, softened: None };
        self.rung(target, first, usual, &mut answer);
        if answer.outcome.ending == Ending::Stuck {
            self.further(target, warm, usual, &mut answer);
        }
        if answer.outcome.ending == Ending::Stuck {
            self.flags.insert(Flags::FELL_BACK);
            return self.by_cone_program(target, usual);
        }
        if answer.outcome.ending == Ending::RoundingLimited {
            self.flags.insert(Flags::ROUNDING_LIMITED);
        }
        Ok(answer)
    }

    #[cold]
    fn by_cone_program(&mut self, target: Target, usual: Factorisation) -> Result<Answer, ConicError> {
        self.answered = BackEnd::Conic;
        let outcome = self.conic(target)?;
        let start = Start { x: outcome.x, lambda: outcome.lambda, near: true };
        let expansion = Expansion::at([&self.body_a, &self.body_b], &start, target, usual);
        Ok(Answer { outcome, expansion, softened: None })
    }

    /// The rungs after the first: cold, and by the safe solver.
    #[cold]
    fn further(&mut self, target: Target, warm: bool, usual: Factorisation, answer: &mut Answer) {
        if warm {
            let cold = start::cold(self.pair, &self.body_a, &self.body_b);
            answer.expansion = Expansion::at([&self.body_a, &self.body_b], &cold, target, usual);
            self.rung(target, &cold, usual, answer);
        }
        if answer.outcome.ending == Ending::Stuck {
            let cold = start::on_centre_line(self.pair, &self.body_a, &self.body_b);
            let bodies = [&self.body_a, &self.body_b];
            let found = anchored::solve(bodies, &self.goal(target), &cold, &mut answer.expansion);
            self.iterations += found.models;
            answer.outcome = found.outcome;
            if answer.outcome.ending != Ending::Stuck {
                answer.softened = Some(found.plane_weights);
                self.flags.insert(Flags::SAFER);
            }
        }
    }

    /// The fast solver from the quadratics of an answer on.
    fn rung(&mut self, target: Target, start: &Start, factorisation: Factorisation, answer: &mut Answer) {
        let goal = self.goal(target);
        answer.outcome =
            spine::solve(&self.body_a, &self.body_b, &goal, start, factorisation, &mut answer.expansion);
        self.iterations += answer.outcome.iterations;
    }

    fn goal(&self, target: Target) -> Goal {
        Goal {
            target,
            tolerance: self.settings.gap_tolerance,
            stop_when_separated: target == Target::Midway && !self.settings.solve_separated,
        }
    }

    #[cold]
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
