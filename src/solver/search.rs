//! One pair being solved: the ladder of solvers, and what it has cost so far.

use crate::bounds::certificate::{self, Certified, Closest};
use crate::bounds::rounding::Care;
use crate::bounds::solution::{Ending, Outcome};
use crate::contact::contact::{Contact, Flags};
use crate::model::dual_path;
use crate::model::local_model::{self, Expansion, Factorisation, Piece, Start};
use crate::model::problem::Target;
use crate::model::quadratic_model;
use crate::pair::placed_particle::Body;
use crate::pair::relative_pose::Pair;
use crate::pair::warm_start::Remembered;
use crate::reference::{self, ConicError, Role};
use crate::settings::{BackEnd, Settings};
use crate::solver::anchored::{self, Effort, Pace};
use crate::solver::initial_guess;
use crate::solver::newton::{self, Goal};
use nalgebra::Vector3;

/// S at a point that is outside whatever rounding did to it.
const CLEARLY: f64 = 2.0;

/// A gap this many times what the rounding of its place explains is one that another proof may narrow.
const LOOSE: f64 = 100.0;

/// Most second proofs, and the share of the gap that one has to leave for the next to be tried.
const MOST_PROOFS: u32 = 4;
const WORTH: f64 = 0.5;

/// Relative difference of two λ that are the same but for rounding, ample.
const SAME: f64 = 1e-3;

/// The safe solver as it is asked first.
const BRISK: Effort = Effort { pace: Pace::Brisk, most: anchored::MOST_MODELS, through: true };

/// Models that the safe solver may take for a second proof, from the answer and from the line of centres. Of 300,000 pairs and
/// the slowest of a million, what helped took up to 58 and 6; the others went in circles.
const MOST_FROM_NEARBY: u32 = 64;
const MOST_FROM_AFAR: u32 = 24;

/// One call: the pair, what is asked, and what it has cost so far.
pub(crate) struct Search<'a> {
    pub pair: &'a Pair<'a>,
    body_a: Body<'a>,
    body_b: Body<'a>,
    settings: &'a Settings,
    pub iterations: u32,
    pub flags: Flags,
    pub answered: BackEnd,
    /// Whether the last climb went on from a cold start.
    anew: bool,
}

impl<'a> Search<'a> {
    pub fn new(pair: &'a Pair<'a>, settings: &'a Settings) -> Self {
        let (body_a, body_b) = Body::both(pair, settings.flat_regularisation);
        Self {
            pair,
            body_a,
            body_b,
            settings,
            iterations: 0,
            flags: Flags::default(),
            answered: settings.back_end,
            anew: false,
        }
    }

    /// Where to begin if nothing is known.
    pub fn cold(&self) -> Start {
        initial_guess::cold(self.pair, &self.body_a, &self.body_b)
    }

    /// Both quadratics where a search for a target begins.
    #[inline(always)]
    pub fn expansion(&self, start: &Start, target: Target) -> Expansion {
        Expansion::at([&self.body_a, &self.body_b], start, target, self.usual())
    }

    /// One of the two problems of closest, or `None` where its constraint is slack: the optimum is then the
    /// minimum of the other particle, for k > 0 its centre, for k = 0 anywhere in its core, and no contact
    /// point. Midway has no such case.
    ///
    /// `midway`, with its quadratics, lies near it on the same curve, mostly on the same planes.
    #[inline(never)]
    pub fn constrained(
        &mut self,
        target: Target,
        midway: Option<(&Outcome, &Expansion)>,
    ) -> Result<Option<Closest>, ConicError> {
        if !midway.is_some_and(|(midway, here)| self.centre_is_outside(target, midway, here)) {
            let centre_inside = match target {
                Target::OnB => self.pair.b.potential(&self.pair.centre) < 0.0,
                _ => self.pair.a.potential(&self.body_a.local(&self.body_b.centre())) < 0.0,
            };
            if centre_inside {
                return Ok(None);
            }
        }
        let start = match midway {
            Some((midway, _)) => Start { x: midway.x, lambda: midway.towards(target), near: true },
            None => self.cold(),
        };
        let own;
        let here = match midway {
            // The quadratics of a softened problem are those of no other.
            Some((_, expansion)) if expansion.softened.is_none() => expansion,
            _ => {
                own = self.expansion(&start, target);
                &own
            }
        };
        self.anew = false;
        let found = match self.at_once(target, start.lambda, here) {
            Some(outcome) => self.closest(target, &outcome, here),
            None => {
                let mut there = *here;
                let outcome = self.climb(target, &start, midway.is_some(), &mut there)?;
                self.closest(target, &outcome, &there)
            }
        };
        if !found.tells_nothing() {
            return Ok(Some(found));
        }
        // A bound that leaves everything open may be that of where the search began, unless that was anywhere. It is a sign of a core only if there is one.
        let free = if target == Target::OnB { self.pair.a } else { self.pair.b };
        match midway {
            Some(_) if !self.anew => self.constrained(target, None),
            _ => Ok((free.sphericity() > 0.0).then_some(found)),
        }
    }

    /// P1 and P2 from the quadratics at hand and what the last call left, where one step is enough for both and either scale
    /// tells that the particles overlap: midway is then needed neither for that nor as a start.
    #[inline(never)]
    pub fn overlapping_still(&mut self, last: &Remembered, here: &Expansion) -> Option<[Closest; 2]> {
        let [of_p1, of_p2] = dual_path::closest_from_between([here.q_a.expansion, here.q_b.expansion], last.lambda);
        let lambdas = [last.closest[0] * of_p1, last.closest[1] * of_p2];
        self.both(lambdas, here, |found| found.scale.s + found.scale.gap < 1.0)
    }

    /// P1 and P2 from midway and its quadratics, where one step is enough for both.
    #[inline(never)]
    pub fn both_at_once(&mut self, (midway, here): (&Outcome, &Expansion)) -> Option<[Closest; 2]> {
        self.both([midway.towards(Target::OnA), midway.towards(Target::OnB)], here, |_| true)
    }

    /// P1 and P2 by one step from guesses of their λ, if both will do.
    #[inline(always)]
    fn both(
        &mut self,
        lambdas: [f64; 2],
        here: &Expansion,
        will_do: impl Fn(&Closest) -> bool,
    ) -> Option<[Closest; 2]> {
        if !self.may_be_at_once() || here.softened.is_some() {
            return None;
        }
        let bodies = [&self.body_a, &self.body_b];
        let soft = local_model::softest(bodies[0], bodies[1]);
        let [p1, p2] = quadratic_model::both_closest([&here.q_a, &here.q_b], soft, lambdas)?;
        let on_a = newton::proved(bodies, &self.goal(Target::OnA), here, p1)?;
        let on_b = newton::proved(bodies, &self.goal(Target::OnB), here, p2)?;
        let points = [self.closest(Target::OnA, &on_a, here), self.closest(Target::OnB, &on_b, here)];
        if !points.iter().all(|found| !found.tells_nothing() && will_do(found)) {
            return None;
        }
        self.iterations += 2;
        if on_a.ending == Ending::RoundingLimited || on_b.ending == Ending::RoundingLimited {
            self.flags.insert(Flags::ROUNDING_LIMITED);
        }
        Some(points)
    }

    /// What the call has cost so far, and who answered.
    pub fn call(&self) -> Contact {
        let Self { flags, iterations, answered: back_end, .. } = *self;
        Contact { flags, iterations, back_end, ..Contact::UNKNOWN }
    }

    /// Whether the tangent of one potential at midway, which lies below it, is clearly above 1 at the other's centre.
    #[inline(always)]
    fn centre_is_outside(&self, target: Target, midway: &Outcome, here: &Expansion) -> bool {
        let (i, body, centre) = match target {
            Target::OnB => (1, &self.body_b, self.body_a.centre()),
            _ => (0, &self.body_a, self.body_b.centre()),
        };
        let tangent = midway.values[i] + midway.gradients[i].dot(&(centre - midway.x));
        body.is_plain() && here.softened.is_none() && tangent > CLEARLY
    }

    fn closest(&self, target: Target, outcome: &Outcome, here: &Expansion) -> Closest {
        Closest::of(outcome, here, &self.body_a, &self.body_b, target)
    }

    /// The scale s of an outcome, and the bound on its error.
    #[inline]
    pub fn certify(&self, outcome: &Outcome, target: Target) -> Certified {
        certificate::scale(outcome, &self.body_a, &self.body_b, target)
    }

    /// S_A and S_B along a direction from the point of an outcome.
    #[inline]
    pub fn pieces(&self, outcome: &Outcome, here: &Expansion, n: &Vector3<f64>) -> [Piece; 2] {
        here.pieces([&self.body_a, &self.body_b], &outcome.x, n)
    }

    /// Bound on the distance from the point of an outcome to the optimum.
    #[inline]
    pub fn bound(&self, outcome: &Outcome, here: &Expansion, target: Target) -> f64 {
        certificate::distance(outcome, here, &self.body_a, &self.body_b, target)
    }

    fn usual(&self) -> Factorisation {
        local_model::factorisation(&self.body_a, &self.body_b)
    }

    /// Whether a first step can be the last: where the axes have to follow the planes, it takes more.
    fn may_be_at_once(&self) -> bool {
        self.settings.back_end == BackEnd::Fast && self.usual() == Factorisation::Plain
    }

    /// The answer of the first step, if that is all that it takes.
    #[inline(always)]
    pub fn at_once(&mut self, target: Target, lambda: f64, here: &Expansion) -> Option<Outcome> {
        if !self.may_be_at_once() {
            return None;
        }
        let outcome = newton::at_once([&self.body_a, &self.body_b], &self.goal(target), lambda, here)?;
        self.iterations += outcome.iterations;
        if outcome.ending == Ending::RoundingLimited {
            self.flags.insert(Flags::ROUNDING_LIMITED);
        }
        Some(outcome)
    }

    /// The ladder: from the start at hand, cold if that was `near` only, by the safe solver, and by the cone program.
    #[inline(never)]
    pub fn climb(
        &mut self,
        target: Target,
        start: &Start,
        near: bool,
        here: &mut Expansion,
    ) -> Result<Outcome, ConicError> {
        if self.settings.back_end == BackEnd::Fast {
            let goal = self.goal(target);
            let most = if near { newton::MOST_FROM_MEMORY } else { newton::MOST_ITERATIONS };
            let mut outcome = self.fast(&Goal { most, ..goal }, start, here);
            self.anew = !near || outcome.ending == Ending::Stuck;
            if self.anew && near {
                let cold = self.cold();
                *here = self.expansion(&cold, target);
                outcome = self.fast(&goal, &cold, here);
            }
            if !outcome.ending.is_answer() {
                let spare = (outcome, *here);
                let cold = initial_guess::on_centre_line(self.pair, &self.body_a, &self.body_b);
                outcome = self.safe(target, &cold, BRISK, here);
                // No answer, or one that tells nothing.
                if !outcome.ending.is_answer() || outcome.gap() > outcome.upper.max(1.0) {
                    let mut there = *here;
                    let second = self.safe(target, &cold, Effort { pace: Pace::Gentle, ..BRISK }, &mut there);
                    keep_better((&mut outcome, here), (second, there));
                }
                // What the fast solver had found before it went in circles.
                let spare = (Outcome { ending: Ending::RoundingLimited, ..spare.0 }, spare.1);
                keep_better((&mut outcome, here), spare);
                self.flags.insert(if outcome.ending.is_answer() { Flags::SAFER } else { Flags::FELL_BACK });
            }
            if outcome.ending == Ending::RoundingLimited {
                self.sharpen(target, &mut outcome, here);
            }
            if outcome.ending.is_answer() {
                return Ok(outcome);
            }
        }
        self.answered = BackEnd::Conic;
        let outcome = self.conic(target)?;
        *here = self.expansion(&Start { x: outcome.x, lambda: outcome.lambda, near: true }, target);
        Ok(outcome)
    }

    /// An answer whose gap is more than the tolerance: where that is also far more than the rounding of its place explains,
    /// the planes that it stands on are in doubt, and a second proof is sought: from there, by the safe solver, and without the
    /// planes of doubtful sign.
    #[cold]
    fn sharpen(&mut self, target: Target, outcome: &mut Outcome, here: &mut Expansion) {
        for round in 0..MOST_PROOFS {
            if !self.is_loose(outcome, here, target) {
                break;
            }
            let (gap, mut found_again) = (outcome.gap(), false);
            // A λ that is wrong leads nowhere from nearby.
            let (from, most) = match round {
                1 => (initial_guess::on_centre_line(self.pair, &self.body_a, &self.body_b), MOST_FROM_AFAR),
                _ => (Start { x: outcome.x, lambda: outcome.lambda, near: true }, MOST_FROM_NEARBY),
            };
            let mut there = self.expansion(&from, target);
            let second = self.fast(&Goal { care: Care::Careful, ..self.goal(target) }, &from, &mut there);
            keep_better((outcome, here), (second, there));
            if self.is_loose(outcome, here, target) {
                let second = self.safe(target, &from, Effort { most, through: false, ..BRISK }, &mut there);
                found_again = (second.lambda - from.lambda).abs() <= SAME * from.lambda && second.ending.is_answer();
                keep_better((outcome, here), (second, there));
            }
            if self.is_loose(outcome, here, target) && !outcome.sure {
                let lower = certificate::without_doubtful(outcome, [&self.body_a, &self.body_b], target);
                outcome.lower = outcome.lower.max(lower + outcome.rounding);
            }
            // A gap above the scale itself would pass for a constraint that is slack.
            let says_nothing = target != Target::Midway && outcome.gap() > outcome.upper;
            // Where the safe solver, which brackets λ, finds that of the answer, no other is to be had from elsewhere.
            let nothing_elsewhere = round > 0 || (found_again && !says_nothing);
            if nothing_elsewhere && outcome.gap() > WORTH * gap {
                break;
            }
        }
        if outcome.ending == Ending::RoundingLimited {
            self.flags.insert(Flags::ROUNDING_LIMITED);
        }
        if here.softened.is_some() {
            self.flags.insert(Flags::SAFER);
        }
    }

    /// Whether the gap is far more than the rounding of the place, the regularisation and the tolerance explain.
    fn is_loose(&self, outcome: &Outcome, here: &Expansion, target: Target) -> bool {
        let (a, b) = (&self.body_a, &self.body_b);
        let level = outcome.upper.max(1.0);
        let flat = target.dual_weighted(a.most_surplus(level), b.most_surplus(level), outcome.lambda);
        let explained = outcome.least_rounding(here, target) + flat + self.settings.gap_tolerance * level;
        outcome.ending == Ending::RoundingLimited && outcome.gap() > LOOSE * explained
    }

    /// By the fast solver, from the quadratics at hand on.
    fn fast(&mut self, goal: &Goal, start: &Start, here: &mut Expansion) -> Outcome {
        let outcome = newton::solve(&self.body_a, &self.body_b, goal, start, self.usual(), here);
        self.iterations += outcome.iterations;
        outcome
    }

    /// By the safe solver.
    fn safe(&mut self, target: Target, start: &Start, effort: Effort, here: &mut Expansion) -> Outcome {
        let outcome = anchored::solve([&self.body_a, &self.body_b], &self.goal(target), start, effort, here);
        self.iterations += outcome.iterations;
        outcome
    }

    fn goal(&self, target: Target) -> Goal {
        Goal {
            target,
            tolerance: self.settings.gap_tolerance,
            stop_when_separated: target == Target::Midway && !self.settings.solve_separated,
            most: newton::MOST_ITERATIONS,
            care: Care::OnTheWay,
        }
    }

    #[cold]
    fn conic(&mut self, target: Target) -> Result<Outcome, ConicError> {
        let solution = match target {
            Target::Midway => reference::midway(self.pair)?,
            Target::OnB => reference::closest(self.pair, Role::B)?,
            Target::OnA => reference::closest(self.pair, Role::A)?,
        };
        self.iterations += solution.iterations;
        let u = solution.weight;
        let outcome = certificate::judge(&solution.x, u / (1.0 - u), solution.s, &self.body_a, &self.body_b, target);
        Ok(Outcome { iterations: solution.iterations, ..outcome })
    }
}

/// Keeps the answer with the smaller gap. A proof of separation comes only where the goal asks for one, and then is the answer
/// whatever its gap.
fn keep_better((outcome, here): (&mut Outcome, &mut Expansion), (second, there): (Outcome, Expansion)) {
    let proved = matches!(second.ending, Ending::Converged | Ending::RoundingLimited);
    if second.ending == Ending::Separated || (proved && second.gap() < outcome.gap()) {
        (*outcome, *here) = (second, there);
    }
}
