//! The sequence of programs, each with the forces of the last one, that ends at a factor.

use super::error::EquilibriumError;
use super::problem::{Equilibrium, Problem};
use super::program::{BEST, Goal, Near, Outcome, Solved, Strength, solve};

/// Factor from the dilatancy of one program of a sequence to that of the next; the last has none.
const KEPT: f64 = 0.2;
/// Dilatancy, as a part of tan φ, that counts as 0: it changes the factor by less than the tolerance of the sequence.
const NO_DILATANCY: f64 = 1e-4;
/// Weight of the distance from the forces of the last program, over units of force. Forces are not unique where a
/// contact has more than three corners, and without this weight they jump from program to program. At the end of the
/// sequence the distance is 0. A strength factor above 1 is small as κ, and with it the weight.
const NEARNESS: f64 = 1e-3;
/// Where the factor has turned back, this part of the step before is made towards the forces of a program, and a little
/// more at each that goes on. Whole steps can go round in circles of two or three states for ever (8 free blocks).
const SLOWER: f64 = 0.7;
const FASTER: f64 = 1.1;
/// A sequence has settled if its factor changes by no more than this part, or than a program is accurate,
const SETTLED: f64 = 1e-7;
/// and if no friction exceeds its strength by more than this, over the mean load of a body.
const EXCESS: f64 = 1e-5;
/// Strength above that at which clamped forces have no bound, as a part of it: the first with which they are found.
const CLAMPED: [f64; 3] = [EXCESS, 1e-4, 1e-3];
/// Programs with full dilatancy after which each halves the bracket of the strength factor.
const UNTIL_HALVED: u32 = 30;
/// Most programs of a sequence. Slopes of 69 blocks and walls of 52 need 16, walls of some 100 more than 40 (measured).
const MOST: u32 = 200;
/// After so many programs the factor is taken if the last ten agree to this part of it,
const ROUGHLY: f64 = 1e-4;
/// and if the excess, which is reported, is below this.
const ROUGH_EXCESS: f64 = 1e-3;
/// How a contact opens as it slides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flow {
    /// By tan φ times the slip. One convex program; its factor is an upper bound of all states of equilibrium: "may
    /// stand".
    Associated,
    /// Not at all, as Coulomb's friction does: a sequence of programs (Gilbert, Casapulla & Ahmed 2006).
    NonDilatant,
}

/// A sequence for one question.
pub(super) struct Sequence<'a, S, F> {
    pub problem: &'a Problem,
    pub goal: Goal,
    pub flow: Flow,
    /// What it means that a program has no limit.
    pub unlimited: EquilibriumError,
    /// Strengths from the dilatancy and the last program.
    pub strengths: S,
    /// What multiplies the given strength at a factor.
    pub strength: F,
}

/// How a sequence ends.
pub(super) enum Ended {
    /// With the forces at the factor, the excess of friction, and the number of programs.
    Settled(Solved, f64, u32),
    /// The scene falls whatever the factor.
    Falls(Equilibrium),
}

/// Where a sequence is.
struct State {
    dilatancy: f64,
    last: Option<Solved>,
    /// With full dilatancy a scene stands at κ if and only if its program has φ ≤ κ, or no least φ: the factor lies
    /// between the largest κ with which it does not stand and the least with which it does.
    bracket: [f64; 2],
    /// Whether the next program halves the bracket.
    halves: bool,
    factors: Vec<f64>,
    step: f64,
    /// Part of a step that is made towards the forces of a program.
    pace: f64,
}

/// What a program says.
enum Verdict {
    Solved(Solved),
    /// Nothing that counts: the next program has another dilatancy or another κ.
    Again,
    Falls(Equilibrium),
}

impl<S: Fn(f64, Option<&Solved>) -> Vec<Strength>, F: Fn(f64) -> f64> Sequence<'_, S, F> {
    /// Programs from one of this dilatancy on, until nothing changes.
    pub fn run(&self, first: f64) -> Result<Ended, EquilibriumError> {
        let mut state = State {
            dilatancy: first,
            last: None,
            bracket: [0.0, f64::INFINITY],
            halves: false,
            factors: Vec::new(),
            step: 0.0,
            pace: 1.0,
        };
        for programs in 1..=MOST {
            if state.halves && !self.moves_on(&mut state) {
                return self.clamped(state.bracket[1], programs - 1);
            }
            state.halves = false;
            let solved = match self.program(&mut state, programs)? {
                Verdict::Solved(solved) => solved,
                Verdict::Falls(answer) => return Ok(Ended::Falls(answer)),
                Verdict::Again => continue,
            };
            if let Some(ended) = self.accept(solved, &mut state, programs) {
                return Ok(ended);
            }
        }
        self.rough(state)
    }

    /// To a κ inside the bracket; once its ends agree, to less dilatancy, if that is asked for.
    fn moves_on(&self, state: &mut State) -> bool {
        match (inside(state.bracket), state.last.as_mut()) {
            (Some(kappa), Some(last)) => last.factor = kappa,
            _ if self.flow == Flow::NonDilatant => state.dilatancy = less(state.dilatancy),
            _ => return false,
        }
        true
    }

    /// The next program, and what it says.
    fn program(&self, state: &mut State, programs: u32) -> Result<Verdict, EquilibriumError> {
        let now = (self.strengths)(state.dilatancy, state.last.as_ref());
        let near = state.last.as_ref().filter(|_| state.dilatancy < 1.0);
        let weight = |last: &Solved| NEARNESS * (self.strength)(last.factor).min(1.0);
        let near = near.map(|last| Near { weight: weight(last), forces: &last.forces });
        let outcome = solve(&self.problem.assembly, &now, self.goal, near);
        // A strength factor has a least φ above 0, or none.
        let has_factor = |solved: &Solved| self.goal == Goal::Load || solved.factor > SETTLED;
        match (outcome, state.last.as_ref().filter(|_| self.goal == Goal::Strength)) {
            (Ok(Outcome::Solved(solved)), _) if has_factor(&solved) => return Ok(Verdict::Solved(solved)),
            (Ok(Outcome::Falls(velocities)), _) if programs == 1 => {
                return self.problem.falls(&velocities, &now, programs).map(Verdict::Falls);
            }
            // The strength that the last normal forces give is too small, or, where they are large, so great that φ
            // says nothing: with more dilatancy the normal forces of the program count, too.
            (Ok(Outcome::Falls(_) | Outcome::Solved(_)), Some(_)) if state.dilatancy < 1.0 => {
                state.dilatancy = more(state.dilatancy);
                state.pace *= SLOWER;
            }
            (Ok(Outcome::Falls(_)), _) => {
                let status = format!("program {programs} of the sequence has no equilibrium");
                return Err(EquilibriumError::NotConverged { status });
            }
            // Friction of this κ clamps blocks with forces of any size, or this κ is too near to that for clarabel:
            // forces of the least norm are found there, too. If they are not, it counts as too weak: the safe side.
            (
                unknown @ (Ok(Outcome::Unlimited | Outcome::Solved(_)) | Err(EquilibriumError::NotConverged { .. })),
                Some(last),
            ) if state.dilatancy == 1.0 => {
                let stands = unknown.is_ok() || matches!(self.problem.with_part(last.factor), Ok(Outcome::Solved(_)));
                state.bracket[usize::from(stands)] = last.factor;
                state.halves = true;
            }
            (Ok(Outcome::Unlimited | Outcome::Solved(_)), None) => return Err(self.unlimited.clone()),
            (Ok(Outcome::Unlimited | Outcome::Solved(_)), Some(_)) => state.dilatancy = less(state.dilatancy),
            (Err(error), _) => return Err(error),
        }
        Ok(Verdict::Again)
    }

    /// Takes the forces of a program for the last ones; the end, if nothing changes any more.
    fn accept(&self, solved: Solved, state: &mut State, programs: u32) -> Option<Ended> {
        let (dilatancy, last) = (state.dilatancy, state.last.take());
        if let Some(last) = last.as_ref().filter(|_| self.goal == Goal::Strength && dilatancy == 1.0) {
            state.bracket[usize::from(solved.factor <= last.factor)] = last.factor;
        }
        let step = last.as_ref().map_or(f64::INFINITY, |last| solved.factor - last.factor);
        let excess = self.problem.excess(&solved, (self.strength)(solved.factor));
        // With associated flow one program gives the load factor.
        let whole = self.goal == Goal::Load && dilatancy == 1.0;
        let settled = whole || step.abs() <= (SETTLED * solved.factor.abs()).max(BEST) && excess <= EXCESS;
        if settled && dilatancy == if self.flow == Flow::Associated { 1.0 } else { 0.0 } {
            return Some(Ended::Settled(solved, excess, programs));
        }
        // The associated state comes first: from anywhere else normal forces may vanish where they are needed.
        state.dilatancy = match dilatancy {
            0.0 if last.is_none() => 1.0,
            1.0 if !settled => 1.0,
            _ => less(dilatancy),
        };
        state.factors.push(solved.factor);
        // Far below the limit φ says little: forces that stand with it may be of any size.
        let most = last.as_ref().filter(|_| state.dilatancy == 1.0 && state.bracket[0] > 0.0);
        let most = most.map_or(f64::INFINITY, |last| last.factor / (KEPT * KEPT));
        if state.dilatancy == 0.0 {
            // A change within the accuracy of a program is no turning back.
            let turns = step * state.step < 0.0 && step.abs() > SETTLED * solved.factor.abs();
            state.pace = if turns { SLOWER * state.pace } else { (FASTER * state.pace).min(1.0) };
        }
        state.step = step;
        let last = match last {
            Some(last) if solved.factor > most => Solved { factor: most, ..last },
            Some(last) if state.pace < 1.0 => {
                Solved { forces: mixed(&last.forces, &solved.forces, state.pace), ..solved }
            }
            _ => solved,
        };
        let is_slow = self.goal == Goal::Strength && programs > UNTIL_HALVED;
        state.halves = state.dilatancy == 1.0 && (is_slow || last.factor >= state.bracket[1]);
        state.last = Some(last);
        None
    }

    /// The end of a sequence that has not settled: its last state, if the factor hardly changes.
    fn rough(&self, State { dilatancy, last, factors, .. }: State) -> Result<Ended, EquilibriumError> {
        let end = &factors[factors.len().saturating_sub(10)..];
        let [least, most] = [f64::min, f64::max].map(|of| end.iter().copied().reduce(of).unwrap_or(f64::NAN));
        let is_rough = dilatancy == 0.0 && most - least <= ROUGHLY * most.abs();
        let rough =
            last.filter(|_| is_rough).map(|last| (self.problem.excess(&last, (self.strength)(last.factor)), last));
        match rough {
            Some((excess, last)) if excess <= ROUGH_EXCESS => Ok(Ended::Settled(last, excess, MOST)),
            // κ is the inverse of the factor.
            _ if self.goal == Goal::Strength => {
                Err(EquilibriumError::NotSettled { programs: MOST, least: 1.0 / most, most: 1.0 / least })
            }
            _ => Err(EquilibriumError::NotSettled { programs: MOST, least, most }),
        }
    }

    /// The state with this part κ of the strength, below which forces that clamp blocks grow without bound.
    fn clamped(&self, kappa: f64, programs: u32) -> Result<Ended, EquilibriumError> {
        if kappa <= SETTLED {
            return Err(self.unlimited.clone());
        }
        for margin in CLAMPED {
            let kappa = kappa * (1.0 + margin);
            if let Ok(Outcome::Solved(solved)) = self.problem.with_part(kappa) {
                return Ok(Ended::Settled(Solved { factor: kappa, ..solved }, 0.0, programs));
            }
        }
        Err(EquilibriumError::NotConverged { status: "clamped forces grow without bound".into() })
    }
}

/// From one state of forces a part of the way to the next.
fn mixed(one: &[[f64; 3]], next: &[[f64; 3]], part: f64) -> Vec<[f64; 3]> {
    one.iter().zip(next).map(|(a, b)| [0, 1, 2].map(|i| a[i] + part * (b[i] - a[i]))).collect()
}

/// The dilatancy of the next program.
fn less(dilatancy: f64) -> f64 {
    if KEPT * dilatancy > NO_DILATANCY { KEPT * dilatancy } else { 0.0 }
}

/// The dilatancy of the program before.
fn more(dilatancy: f64) -> f64 {
    (dilatancy.max(NO_DILATANCY) / KEPT).min(1.0)
}

/// A κ inside the bracket; `None` once its ends agree.
fn inside([low, high]: [f64; 2]) -> Option<f64> {
    let is_closed = high - low <= EXCESS * high || high <= SETTLED;
    let between = || match (low > 0.0, high.is_finite()) {
        (true, true) => (low * high).sqrt(),
        (true, false) => low / KEPT,
        _ => KEPT * high,
    };
    (!is_closed).then(between)
}
