//! The fast solver: Newton on the exact quadratic pieces, with a dual bound at every step.
//!
//! Each iteration expands both potentials at x, solves the pair of quadratics exactly ([`crate::model::quadratic_model`]),
//! and moves there. The model's optimum is also a dual bound: once the active planes stay, upper and
//! lower bound meet, and the answer is proved. A step that overshoots (a plane switched on behind x) is
//! shortened by an exact search along it.

use crate::bounds::rounding::Care;
use crate::bounds::solution::{Ending, Outcome};
use crate::linalg::number::larger;
use crate::model::dual_path::Optimum;
use crate::model::kkt_check::Planes;
use crate::model::local_model::{self, Expansion, Factorisation, Start, Step};
use crate::model::problem::Target;
use crate::model::quadratic_model::{LAMBDA_RANGE, Model};
use crate::pair::active_set::Local;
use crate::pair::placed_particle::Body;
use crate::solver::line_search::{self, Merit};
use nalgebra::Vector3;

/// Most iterations. One call in 20,000 would come to its end after more; the others are in circles, and the safe
/// solver is faster.
pub(crate) const MOST_ITERATIONS: u32 = 30;

/// The same from memory or from midway: what takes longer than from a cold start goes on from there.
pub(crate) const MOST_FROM_MEMORY: u32 = 20;

/// Relative to the smaller particle, a step too short for the next one to be more precise.
const SHORT: f64 = 1e-9;

/// Factor of the least possible gap that is as good as any.
const AS_SHARP: f64 = 8.0;

/// Relative gap above which a proof is not taken for good at once.
const SHARP: f64 = 1e-2;

/// Share of what is still to be gained to which λ is searched, early on and after a step that failed.
const ROUGH: f64 = 1e-2;
const FINE: f64 = 1e-4;

/// Steps in a row that may come to nothing.
const MOST_STOPS: u32 = 3;

/// Steps in a row that may leave λ at the very end of its range, where one body has no weight: it does not come back.
const MOST_LOST: u32 = 3;

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
    /// Most iterations.
    pub most: u32,
    /// What the bounds may take.
    pub care: Care,
}

/// The answer where the first step is the last: the planes of the quadratics stay on, no other is met, and the bounds
/// meet. So it is for nearly all pairs whose start is from memory or from the polyhedra.
#[inline(always)]
pub(crate) fn at_once(bodies: [&Body; 2], goal: &Goal, lambda: f64, here: &Expansion) -> Option<Outcome> {
    let [a, b] = bodies;
    let model = Model::new(&here.q_a, &here.q_b, local_model::softest(a, b), goal.target);
    proved(bodies, goal, here, model.solve(lambda, 0.0)?)
}

/// The outcome of an optimum, if it is final.
#[inline(always)]
pub(crate) fn proved(bodies: [&Body; 2], goal: &Goal, here: &Expansion, optimum: Optimum) -> Option<Outcome> {
    let step = here.step(bodies, optimum);
    if step.planes != Planes::Exact || !step.optimum.settled {
        return None;
    }
    let outcome = Outcome { iterations: 1, ..Outcome::of(here, bodies, goal.target, &step, Care::Once) };
    if goal.stop_when_separated && outcome.separates(flat(bodies)) {
        return Some(Outcome { ending: Ending::Separated, ..outcome });
    }
    let proof = Proof::of(&outcome, goal, bodies, here, step.v.norm());
    // What is merely short may be proved again ([`crate::solver::search`]).
    let good = proof.precise || proof.rounded;
    (good && proof.is_final(false)).then_some(Outcome { ending: proof.ending(), ..outcome })
}

/// What the regularisation itself leaves open.
fn flat([a, b]: [&Body; 2]) -> f64 {
    larger(a.most_surplus(1.0), b.most_surplus(1.0))
}

/// How good the bounds of an outcome are.
struct Proof {
    /// They meet within the tolerance.
    precise: bool,
    /// As near as rounding lets any bounds come.
    rounded: bool,
    /// The step was so short that the next one is no more precise.
    short: bool,
    /// A plane that only seems to push holds the point where it does not belong, whatever it does to s: from nearby its
    /// sign is known.
    decided: bool,
    /// They leave little open, however large what rounding leaves.
    telling: bool,
}

impl Proof {
    #[inline(always)]
    fn of(outcome: &Outcome, goal: &Goal, bodies: [&Body; 2], here: &Expansion, length: f64) -> Self {
        let (gap, short) = (outcome.gap(), length <= SHORT * local_model::smallest(bodies));
        Self {
            precise: gap <= goal.tolerance * outcome.upper,
            rounded: gap <= AS_SHARP * outcome.least_rounding(here, goal.target),
            short,
            decided: outcome.sure || short,
            telling: gap <= SHARP * outcome.upper,
        }
    }

    fn ending(&self) -> Ending {
        if self.precise { Ending::Converged } else { Ending::RoundingLimited }
    }

    /// Whether to look no further. After a step that should have gained more, this is what rounding allows, however much
    /// it is.
    fn is_final(&self, again: bool) -> bool {
        self.decided && (self.precise || ((self.short || self.rounded) && (self.telling || again)))
    }
}

/// Solves for the goal, beginning with the quadratics in `here`; those of the answer are left there.
pub(crate) fn solve(
    a: &Body,
    b: &Body,
    goal: &Goal,
    start: &Start,
    factorisation: Factorisation,
    here: &mut Expansion,
) -> Outcome {
    let (bodies, target) = ([a, b], goal.target);
    let flat = flat(bodies);
    let mut lambda = start.lambda;
    let mut thorough = start.near;
    let mut previous: Option<Attempt> = None;
    let (mut proved, mut arriving, mut stopped) = (None::<(Outcome, Step, Expansion)>, 0, 0);
    let (mut nearest, mut dropped) = (None::<(f64, Step, Expansion)>, false);
    let (mut lower, mut lost) = (f64::NEG_INFINITY, 0);
    let mut iterations = 0;
    while iterations < goal.most {
        iterations += 1;
        if let Some(attempt) = previous.as_ref().filter(|_| !thorough) {
            let merit = here.merit(target, attempt.lambda);
            let enough = attempt.merit - 1e-4 * attempt.promised;
            // Two values of S cannot be told apart below their rounding.
            if !(merit <= enough || merit <= enough + here.merit_rounding(bodies, target, attempt.lambda)) {
                let moved = attempt.shorten(bodies, target, lambda, factorisation, here);
                // Stopped at once, again and again: the planes take turns, and λ has to be found otherwise.
                stopped = if moved { 0 } else { stopped + 1 };
                if stopped > MOST_STOPS {
                    break;
                }
                thorough = true;
            }
        }
        let upper = here.merit(target, lambda);
        if !upper.is_finite() {
            break;
        }
        // Where the planes are likely right, at once the best λ; else a rough one will do, but for a better one after
        // a step that failed.
        let share = match () {
            () if start.near && iterations == 1 => 0.0,
            () if thorough => FINE,
            () => ROUGH,
        };
        let behind = if target == Target::Midway { upper - lower } else { 0.0 };
        let mismatch = target.mismatch(here.q_a.expansion, here.q_b.expansion);
        let enough = share * mismatch.max(behind).min(upper);
        let Some(step) = here.optimum(bodies, target, lambda, enough) else { break };
        let at_end = step.optimum.lambda == lambda && !(LAMBDA_RANGE.0..=LAMBDA_RANGE.1).contains(&lambda);
        lost = if at_end { lost + 1 } else { 0 };
        lambda = step.optimum.lambda;
        if lost > MOST_LOST {
            break;
        }
        if step.planes == Planes::Dropped {
            here.drop(bodies, &step, target, lambda, factorisation);
            (previous, thorough, dropped) = (None, false, true);
            continue;
        }
        let upper = here.merit(target, lambda);
        lower = target.dual(step.optimum.values.0, step.optimum.values.1, lambda);
        let separating = goal.stop_when_separated && lower > 1.0 && step.planes != Planes::Pulling;
        let proving = step.planes == Planes::Exact && step.optimum.settled;
        // Inside both cores nothing but the regularisation tells one point from another.
        let inside = flat > 0.0 && step.planes == Planes::Met && upper - lower <= flat;
        // Where planes act as walls it may be rounding that tells whether one is on, and the search goes in circles about the optimum.
        let left = if target == Target::Midway && dropped { upper - lower } else { f64::INFINITY };
        if step.planes == Planes::Met
            && left <= SHARP * upper
            && nearest.as_ref().is_none_or(|(least, ..)| left < *least)
        {
            nearest = Some((left, step, *here));
        }
        if separating || proving || inside {
            let mut outcome = Outcome { iterations, ..Outcome::of(here, bodies, target, &step, goal.care) };
            if separating && outcome.separates(flat) {
                return Outcome { ending: Ending::Separated, ..outcome };
            }
            if proving {
                let proof = Proof::of(&outcome, goal, bodies, here, step.v.norm());
                outcome.ending = proof.ending();
                if proof.is_final(arriving > 1) {
                    outcome.refine(here, bodies, target, &step);
                    return outcome;
                }
            } else if inside {
                outcome = Outcome { ending: Ending::RoundingLimited, ..outcome.at(here) };
            }
            // Proved, but over a long step; the same from nearby is sharper.
            if (proving || inside) && proved.as_ref().is_none_or(|(old, ..)| outcome.gap() < old.gap()) {
                proved = Some((outcome, step, *here));
            }
        }
        arriving += u32::from(proved.is_some());
        if arriving > MOST_TO_ARRIVE {
            break;
        }
        let promised = (upper - lower).max(0.0);
        let x = here.x + step.v;
        previous = Some(Attempt { from: here.x, locals: here.locals, step: step.v, lambda, merit: upper, promised });
        thorough = false;
        *here = Expansion::of(bodies, x, [a.locate(&x, 0.0), b.locate(&x, 0.0)], target.weights(lambda), factorisation);
    }
    // A proof that leaves everything open is none. Where S all but vanishes, deep inside both, what counts is its gap beside the
    // 1 of the surfaces.
    let tells = |outcome: &Outcome| outcome.gap() <= (SHARP * outcome.upper.max(flat)).max(goal.tolerance);
    let unproved = if stopped > MOST_STOPS || arriving > MOST_TO_ARRIVE { Ending::Circling } else { Ending::Stuck };
    let refined = |(mut outcome, step, expansion): (Outcome, Step, Expansion)| {
        outcome.refine(&expansion, bodies, target, &step);
        (outcome, expansion)
    };
    let bracketed = || {
        let (_, step, expansion) = nearest?;
        let outcome = Outcome::of(&expansion, bodies, target, &step, goal.care).at(&expansion);
        let (outcome, expansion) = refined((outcome, step, expansion));
        let rounding = larger(outcome.rounding, expansion.merit_rounding(bodies, target, outcome.lambda));
        Some((Outcome { rounding, ending: unproved, ..outcome }, expansion)).filter(|(outcome, _)| tells(outcome))
    };
    match proved.filter(|(outcome, ..)| tells(outcome)).map(refined).or_else(bracketed) {
        Some((outcome, expansion)) => {
            *here = expansion;
            Outcome { iterations, ..outcome }
        }
        None => Outcome { x: here.x, lambda, lower, iterations, ending: unproved, ..Outcome::UNKNOWN },
    }
}

/// A step that was tried, to be shortened if it made things worse.
#[derive(Clone, Copy)]
struct Attempt {
    from: Vector3<f64>,
    locals: [Local; 2],
    step: Vector3<f64>,
    lambda: f64,
    merit: f64,
    promised: f64,
}

impl Attempt {
    /// Expands at the best point along the step instead; whether that is another point.
    #[cold]
    fn shorten(
        &self,
        bodies: [&Body; 2],
        target: Target,
        lambda: f64,
        factorisation: Factorisation,
        here: &mut Expansion,
    ) -> bool {
        let [a, b] = bodies;
        let descent = line_search::descend(a, b, Merit(target, self.lambda), &self.from, &self.step, (0.5, 1.0));
        let x = self.from + descent.alpha * self.step;
        let early = descent.ahead * self.step.norm();
        let mut locals = [a.locate(&x, early), b.locate(&x, early)];
        let moved = (x - self.from).norm() > self.locals[0].shift.max(self.locals[1].shift);
        if !moved {
            locals[0].carry_dropped(&self.locals[0], a, &self.step);
            locals[1].carry_dropped(&self.locals[1], b, &self.step);
        }
        *here = Expansion::of(bodies, x, locals, target.weights(lambda), factorisation);
        moved
    }
}
