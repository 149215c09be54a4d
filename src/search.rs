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

/// A gap this many times what the rounding of its place explains is one that another proof may narrow.
const LOOSE: f64 = 100.0;

/// Most second proofs, and the share of the gap that one has to leave for the next to be tried.
const MOST_PROOFS: u32 = 3;
const WORTH: f64 = 0.5;

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
///
/// It is large: whoever asks provides the place for it.
pub(crate) struct Answer {
    pub outcome: Outcome,
    pub expansion: Expansion,
    /// Weights of the planes in the problem that it answers, where the safe solver gave it.
    pub softened: Option<[f64; 2]>,
}

impl Answer {
    pub const BLANK: Self = Self { outcome: Outcome::UNKNOWN, expansion: Expansion::BLANK, softened: None };

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
    pub fn midway(&mut self, start: Option<Start>, answer: &mut Answer) -> Result<(), ConicError> {
        self.solve(Target::Midway, start, None, answer)
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
        answer: &mut Answer,
    ) -> Result<Option<Certified>, ConicError> {
        let centre_inside = match target {
            Target::OnB => self.pair.b.potential(&self.pair.centre) < 0.0,
            _ => self.pair.a.potential(&self.body_a.local(&self.body_b.centre())) < 0.0,
        };
        if centre_inside {
            return Ok(None);
        }
        // The quadratics of a softened problem are those of no other.
        let left = midway.filter(|midway| midway.softened.is_none()).map(|midway| &midway.expansion);
        self.solve(target, midway.map(Answer::start), left, answer)?;
        let scale = self.certify(answer, target);
        // A scale that cannot be told from 0 belongs to a core.
        Ok((scale.s > scale.gap).then_some(scale))
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
    fn solve(
        &mut self,
        target: Target,
        start: Option<Start>,
        left: Option<&Expansion>,
        answer: &mut Answer,
    ) -> Result<(), ConicError> {
        let usual = expansion::factorisation(&self.body_a, &self.body_b);
        if self.settings.back_end == BackEnd::Fast {
            let first = start.unwrap_or_else(|| start::cold(self.pair, &self.body_a, &self.body_b));
            self.rung(target, &first, left, usual, answer);
            if answer.outcome.ending == Ending::Stuck {
                self.further(target, start.is_some(), usual, answer);
            }
            if answer.outcome.ending != Ending::Stuck {
                if answer.outcome.ending == Ending::RoundingLimited {
                    self.sharpen(target, usual, answer);
                }
                return Ok(());
            }
            self.flags.insert(Flags::FELL_BACK);
        }
        self.answered = BackEnd::Conic;
        answer.outcome = self.conic(target)?;
        let start = answer.start();
        answer.expansion = Expansion::at([&self.body_a, &self.body_b], &start, target, usual);
        Ok(())
    }

    /// The rungs after the first: cold, and by the safe solver.
    #[cold]
    fn further(&mut self, target: Target, warm: bool, usual: Factorisation, answer: &mut Answer) {
        if warm {
            let cold = start::cold(self.pair, &self.body_a, &self.body_b);
            self.rung(target, &cold, None, usual, answer);
        }
        if answer.outcome.ending == Ending::Stuck {
            let cold = start::on_centre_line(self.pair, &self.body_a, &self.body_b);
            self.safely(target, &cold, answer);
            if answer.outcome.ending != Ending::Stuck {
                self.flags.insert(Flags::SAFER);
            }
        }
    }

    /// An answer whose gap is more than the tolerance: where that is also far more than the rounding of its place explains,
    /// the planes that it stands on are in doubt, and a second proof is sought: from there, by the safe solver, and without the
    /// planes of doubtful sign.
    #[cold]
    fn sharpen(&mut self, target: Target, usual: Factorisation, answer: &mut Answer) {
        for _ in 0..MOST_PROOFS {
            if !self.is_loose(answer, target) {
                break;
            }
            let (gap, from) = (answer.outcome.gap(), answer.start());
            let mut second = Answer::BLANK;
            self.rung(target, &from, None, usual, &mut second);
            keep_better(answer, second);
            if self.is_loose(answer, target) {
                let mut second = Answer::BLANK;
                self.safely(target, &from, &mut second);
                keep_better(answer, second);
            }
            if self.is_loose(answer, target) && !answer.outcome.sure {
                let lower = certificate::without_doubtful(&answer.outcome, [&self.body_a, &self.body_b], target);
                let outcome = &mut answer.outcome;
                outcome.lower = outcome.lower.max(lower + outcome.rounding);
            }
            if answer.outcome.gap() > WORTH * gap {
                break;
            }
        }
        if answer.outcome.ending == Ending::RoundingLimited {
            self.flags.insert(Flags::ROUNDING_LIMITED);
        }
        if answer.softened.is_some() {
            self.flags.insert(Flags::SAFER);
        }
    }

    /// Whether the gap is far more than the rounding of the place, the regularisation and the tolerance explain.
    fn is_loose(&self, answer: &Answer, target: Target) -> bool {
        let (a, b, outcome) = (&self.body_a, &self.body_b, &answer.outcome);
        let least = target.dual_weighted(
            answer.expansion.locals[0].least_rounding(&outcome.gradients[0]),
            answer.expansion.locals[1].least_rounding(&outcome.gradients[1]),
            outcome.lambda,
        );
        let level = outcome.upper.max(1.0);
        let flat = target.dual_weighted(a.most_surplus(level), b.most_surplus(level), outcome.lambda);
        outcome.ending == Ending::RoundingLimited
            && outcome.gap() > LOOSE * (least + flat + self.settings.gap_tolerance * level)
    }

    /// By the safe solver.
    fn safely(&mut self, target: Target, start: &Start, answer: &mut Answer) {
        let bodies = [&self.body_a, &self.body_b];
        let found = anchored::solve(bodies, &self.goal(target), start, &mut answer.expansion);
        self.iterations += found.models;
        answer.outcome = found.outcome;
        answer.softened = (answer.outcome.ending != Ending::Stuck).then_some(found.plane_weights);
    }

    #[inline(always)]
    fn rung(
        &mut self,
        target: Target,
        start: &Start,
        left: Option<&Expansion>,
        factorisation: Factorisation,
        answer: &mut Answer,
    ) {
        let bodies = [&self.body_a, &self.body_b];
        answer.expansion = match left {
            Some(expansion) => *expansion,
            None => Expansion::at(bodies, start, target, factorisation),
        };
        answer.outcome =
            spine::solve(bodies[0], bodies[1], &self.goal(target), start, factorisation, &mut answer.expansion);
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

/// Keeps the answer with the smaller gap.
fn keep_better(answer: &mut Answer, second: Answer) {
    let proved = matches!(second.outcome.ending, Ending::Converged | Ending::RoundingLimited);
    if proved && second.outcome.gap() < answer.outcome.gap() {
        *answer = second;
    }
}
