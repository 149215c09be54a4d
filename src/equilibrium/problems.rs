//! The three questions: does it stand, how much more can it bear, how much weaker could its joints be.

use super::assembly::{Assembly, Corner};
use super::error::EquilibriumError;
use super::program::{BEST, Goal, Near, Outcome, Solved, Strength, solve};
use super::scene::{Scene, Velocity};
use nalgebra::Vector3;

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
/// Largest force that may stay unbalanced on a body, over the largest force.
const BALANCED: f64 = 1e-6;

/// How a contact opens as it slides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flow {
    /// By tan φ times the slip. One convex program; its factor is an upper bound of all states of equilibrium: "may
    /// stand".
    Associated,
    /// Not at all, as Coulomb's friction does: a sequence of programs (Gilbert, Casapulla & Ahmed 2006).
    NonDilatant,
}

/// Forces in equilibrium, and the motion at the limit.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Equilibrium {
    /// Whether there are forces in equilibrium, for a load factor or a strength factor: for any factor.
    pub stands: bool,
    /// The load factor or the factor of safety; 0 where nothing stands, and in [`stands()`].
    pub factor: f64,
    /// Force on the second body at each corner, contact after contact, in the axes of the scene; empty where nothing
    /// stands.
    pub forces: Vec<Vector3<f64>>,
    /// Velocity of each body in the mechanism, the fastest at 1; empty in [`stands()`] of a scene that does.
    pub mechanism: Vec<Velocity>,
    /// The largest force, or torque over the size of the body, that is left on a body, over the mean load of one.
    pub unbalanced: f64,
    /// The largest friction beyond its strength at a corner, over the mean load of a body: of a sequence that was
    /// solved.
    pub excess: f64,
    /// Number of cone programs.
    pub programs: u32,
}

/// Whether forces exist that keep every body in equilibrium under its dead load: of all such forces, those of the
/// least norm. If none exist, the velocities of a motion in which the loads do more work than strength can take up.
///
/// # Errors
/// An invalid scene, and a solver that reaches neither forces nor a motion: that does not mean that it falls.
pub fn stands(scene: &Scene) -> Result<Equilibrium, EquilibriumError> {
    let problem = Problem::new(scene)?;
    match problem.at_rest(&problem.strengths)? {
        Outcome::Solved(solved) => {
            let answer = problem.answer(&solved, 0.0, 0.0, 1)?;
            Ok(Equilibrium { mechanism: Vec::new(), ..answer })
        }
        Outcome::Falls(velocities) => problem.falls(&velocities, &problem.strengths, 1),
        // Without a factor there is no limit to miss.
        Outcome::Unlimited => Err(EquilibriumError::NotConverged { status: "PrimalInfeasible".into() }),
    }
}

/// The largest factor λ for which dead + λ live loads can be carried, with the forces and the mechanism there. Below 0
/// the dead loads alone cannot be.
///
/// # Errors
/// As of [`stands()`]; no live load, or a load that can be carried whatever its size.
pub fn load_factor(scene: &Scene, flow: Flow) -> Result<Equilibrium, EquilibriumError> {
    let problem = Problem::new(scene)?;
    if problem.assembly.live.iter().all(|load| *load == 0.0) {
        return Err(EquilibriumError::NoLiveLoad);
    }
    // With forces of the last program n̄: |t| ≤ c a + (1 − α) μ n̄ + α μ n.
    let strengths = |dilatancy: f64, last: Option<&Solved>| -> Vec<Strength> {
        let held = |(given, i): (&Strength, usize)| {
            let normal = last.map_or(0.0, |last| last.forces[i][0].max(0.0));
            let base = given.base + (1.0 - dilatancy) * given.slope * normal;
            Strength { slope: dilatancy * given.slope, base, ..*given }
        };
        problem.strengths.iter().zip(0..).map(held).collect()
    };
    let unlimited = EquilibriumError::Unlimited;
    let sequence = Sequence { problem: &problem, goal: Goal::Load, flow, unlimited };
    match sequence.run(1.0, strengths, |_| 1.0)? {
        Ended::Settled(solved, excess, programs) => problem.answer(&solved, solved.factor, excess, programs),
        Ended::Falls(answer) => Ok(answer),
    }
}

/// The factor of safety F: tan φ and c over F are the least with which the scene stands under its dead loads; with the
/// forces and the mechanism there.
///
/// # Errors
/// As of [`stands()`]; a scene that needs no strength.
pub fn strength_factor(scene: &Scene, flow: Flow) -> Result<Equilibrium, EquilibriumError> {
    let problem = Problem::new(scene)?;
    // With κ and forces of the last program: |t| ≤ α κ (c a + μ n) + (φ − α κ) (c a + μ n̄). At the end φ = κ and
    // n = n̄. Before the first program n is unknown: strength is the same at all corners.
    let strengths = |dilatancy: f64, last: Option<&Solved>| -> Vec<Strength> {
        let reduced = |(given, i): (&Strength, usize)| {
            let (normal, kappa) = last.map_or((1.0, 0.0), |last| (last.forces[i][0].max(0.0), last.factor));
            let slope = dilatancy * kappa * given.slope;
            Strength { slope, base: -slope * normal, growth: given.base + given.slope * normal, ..*given }
        };
        problem.strengths.iter().zip(0..).map(reduced).collect()
    };
    let unlimited = EquilibriumError::StandsWithoutStrength;
    let sequence = Sequence { problem: &problem, goal: Goal::Strength, flow, unlimited };
    match sequence.run(0.0, strengths, |factor| factor)? {
        Ended::Settled(solved, ..) if solved.factor <= SETTLED => Err(EquilibriumError::StandsWithoutStrength),
        Ended::Settled(solved, excess, programs) => {
            let answer = problem.answer(&solved, 0.0, excess, programs)?;
            Ok(Equilibrium { factor: 1.0 / solved.factor, ..answer })
        }
        Ended::Falls(answer) => Ok(answer),
    }
}

/// Programs, each with the forces of the last one, until nothing changes.
struct Sequence<'a> {
    problem: &'a Problem,
    goal: Goal,
    flow: Flow,
    unlimited: EquilibriumError,
}

enum Ended {
    Settled(Solved, f64, u32),
    Falls(Equilibrium),
}

impl Sequence<'_> {
    /// The state with this part κ of the strength, below which forces that clamp blocks grow without bound.
    fn clamped(self, kappa: f64, programs: u32) -> Result<Ended, EquilibriumError> {
        if kappa <= SETTLED {
            return Err(self.unlimited);
        }
        for margin in CLAMPED {
            let kappa = kappa * (1.0 + margin);
            if let Ok(Outcome::Solved(solved)) = self.problem.with_part(kappa) {
                return Ok(Ended::Settled(Solved { factor: kappa, ..solved }, 0.0, programs));
            }
        }
        Err(EquilibriumError::NotConverged { status: "clamped forces grow without bound".into() })
    }

    /// `first`: dilatancy of the first program; `strengths` from the dilatancy and the last program; `strength`: what
    /// multiplies the given one at a factor.
    fn run(
        self,
        first: f64,
        strengths: impl Fn(f64, Option<&Solved>) -> Vec<Strength>,
        strength: impl Fn(f64) -> f64,
    ) -> Result<Ended, EquilibriumError> {
        let mut dilatancy = first;
        let mut last: Option<Solved> = None;
        // With full dilatancy a scene stands at κ if and only if its program has φ ≤ κ, or no least φ: the factor lies
        // between the largest κ with which it does not stand and the least with which it does.
        let mut bracket = [0.0, f64::INFINITY];
        let mut factors = Vec::new();
        let (mut step_before, mut pace) = (0.0, 1.0_f64);
        let mut halves = false;
        for programs in 1..=MOST {
            match (inside(bracket), last.as_mut()) {
                _ if !halves => {}
                (Some(kappa), Some(last)) => last.factor = kappa,
                _ if self.flow == Flow::NonDilatant => dilatancy = less(dilatancy),
                _ => return self.clamped(bracket[1], programs - 1),
            }
            halves = false;
            let now = strengths(dilatancy, last.as_ref());
            let near = last.as_ref().filter(|_| dilatancy < 1.0);
            let near =
                near.map(|last| Near { weight: NEARNESS * strength(last.factor).min(1.0), forces: &last.forces });
            let outcome = solve(&self.problem.assembly, &now, self.goal, near);
            // A strength factor has a least φ above 0, or none.
            let has_factor = |solved: &Solved| self.goal == Goal::Load || solved.factor > SETTLED;
            let solved = match (outcome, last.as_mut().filter(|_| self.goal == Goal::Strength)) {
                (Ok(Outcome::Solved(solved)), _) if has_factor(&solved) => solved,
                (Ok(Outcome::Falls(velocities)), _) if programs == 1 => {
                    return self.problem.falls(&velocities, &now, programs).map(Ended::Falls);
                }
                // The strength that the last normal forces give is too small, or, where they are large, so great that φ
                // says nothing: with more dilatancy the normal forces of the program count, too.
                (Ok(Outcome::Falls(_) | Outcome::Solved(_)), Some(_)) if dilatancy < 1.0 => {
                    dilatancy = more(dilatancy);
                    pace *= SLOWER;
                    continue;
                }
                (Ok(Outcome::Falls(_)), _) => {
                    let status = format!("program {programs} of the sequence has no equilibrium");
                    return Err(EquilibriumError::NotConverged { status });
                }
                // Friction of this κ clamps blocks with forces of any size, or this κ is too near to that for clarabel:
                // forces of the least norm are found there, too. If they are not, it counts as too weak: the safe side.
                (
                    unknown
                    @ (Ok(Outcome::Unlimited | Outcome::Solved(_)) | Err(EquilibriumError::NotConverged { .. })),
                    Some(last),
                ) if dilatancy == 1.0 => {
                    let stands =
                        unknown.is_ok() || matches!(self.problem.with_part(last.factor), Ok(Outcome::Solved(_)));
                    bracket[usize::from(stands)] = last.factor;
                    halves = true;
                    continue;
                }
                (Ok(Outcome::Unlimited | Outcome::Solved(_)), None) => return Err(self.unlimited),
                (Ok(Outcome::Unlimited | Outcome::Solved(_)), Some(_)) => {
                    dilatancy = less(dilatancy);
                    continue;
                }
                (Err(error), _) => return Err(error),
            };
            if let Some(last) = last.as_ref().filter(|_| self.goal == Goal::Strength && dilatancy == 1.0) {
                bracket[usize::from(solved.factor <= last.factor)] = last.factor;
            }
            let step = last.as_ref().map_or(f64::INFINITY, |last| solved.factor - last.factor);
            let excess = self.problem.excess(&solved, strength(solved.factor));
            // With associated flow one program gives the load factor.
            let whole = self.goal == Goal::Load && dilatancy == 1.0;
            let settled = whole || step.abs() <= (SETTLED * solved.factor.abs()).max(BEST) && excess <= EXCESS;
            if settled && dilatancy == if self.flow == Flow::Associated { 1.0 } else { 0.0 } {
                return Ok(Ended::Settled(solved, excess, programs));
            }
            // The associated state comes first: from anywhere else normal forces may vanish where they are needed.
            dilatancy = match dilatancy {
                0.0 if last.is_none() => 1.0,
                1.0 if !settled => 1.0,
                _ => less(dilatancy),
            };
            factors.push(solved.factor);
            // Far below the limit φ says little: forces that stand with it may be of any size.
            let most = last.as_ref().filter(|_| dilatancy == 1.0 && bracket[0] > 0.0);
            let most = most.map_or(f64::INFINITY, |last| last.factor / (KEPT * KEPT));
            if dilatancy == 0.0 {
                // A change within the accuracy of a program is no turning back.
                let turns = step * step_before < 0.0 && step.abs() > SETTLED * solved.factor.abs();
                pace = if turns { SLOWER * pace } else { (FASTER * pace).min(1.0) };
            }
            step_before = step;
            last = Some(match last {
                Some(last) if solved.factor > most => Solved { factor: most, ..last },
                Some(last) if pace < 1.0 => Solved { forces: mixed(&last.forces, &solved.forces, pace), ..solved },
                _ => solved,
            });
            let is_slow = self.goal == Goal::Strength && programs > UNTIL_HALVED;
            halves = dilatancy == 1.0 && last.as_ref().is_some_and(|last| is_slow || last.factor >= bracket[1]);
        }
        let end = &factors[factors.len().saturating_sub(10)..];
        let [least, most] = [f64::min, f64::max].map(|of| end.iter().copied().reduce(of).unwrap_or(f64::NAN));
        let is_rough = dilatancy == 0.0 && most - least <= ROUGHLY * most.abs();
        let rough = last.filter(|_| is_rough).map(|last| (self.problem.excess(&last, strength(last.factor)), last));
        match rough {
            Some((excess, last)) if excess <= ROUGH_EXCESS => Ok(Ended::Settled(last, excess, MOST)),
            // κ is the inverse of the factor.
            _ if self.goal == Goal::Strength => {
                Err(EquilibriumError::NotSettled { programs: MOST, least: 1.0 / most, most: 1.0 / least })
            }
            _ => Err(EquilibriumError::NotSettled { programs: MOST, least, most }),
        }
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

/// A scene in its own units, and its strength as given.
struct Problem {
    assembly: Assembly,
    strengths: Vec<Strength>,
}

impl Problem {
    fn new(scene: &Scene) -> Result<Self, EquilibriumError> {
        let assembly = Assembly::new(scene)?;
        let strength = |corner: &Corner| {
            let contact = &scene.contacts[corner.contact];
            let share = contact.area / (corner.of * assembly.unit);
            let [base, tension] = [contact.cohesion * share, contact.tension * share];
            Strength { slope: contact.friction, base, growth: 0.0, tension }
        };
        let strengths = assembly.corners.iter().map(strength).collect();
        Ok(Self { assembly, strengths })
    }

    /// The forces of the least norm that keep all bodies at rest with this part of the strength.
    fn with_part(&self, kappa: f64) -> Result<Outcome, EquilibriumError> {
        let reduced = |given: &Strength| Strength { slope: kappa * given.slope, base: kappa * given.base, ..*given };
        self.at_rest(&self.strengths.iter().map(reduced).collect::<Vec<_>>())
    }

    /// The forces of the least norm that keep all bodies at rest with these strengths.
    fn at_rest(&self, strengths: &[Strength]) -> Result<Outcome, EquilibriumError> {
        let none = vec![[0.0; 3]; strengths.len()];
        solve(&self.assembly, strengths, Goal::Rest, Some(Near { weight: 1.0, forces: &none }))
    }

    /// The largest friction beyond `part` of its strength.
    fn excess(&self, solved: &Solved, part: f64) -> f64 {
        let beyond = |(given, [n, t, s]): (&Strength, &[f64; 3])| t.hypot(*s) - part * (given.base + given.slope * n);
        self.strengths.iter().zip(&solved.forces).map(beyond).fold(0.0, f64::max)
    }

    /// Forces, if they are in equilibrium to what is promised.
    fn answer(&self, solved: &Solved, live: f64, excess: f64, programs: u32) -> Result<Equilibrium, EquilibriumError> {
        let unbalanced = self.assembly.unbalanced(&solved.forces, live);
        let largest = solved.forces.iter().flatten().fold(1.0_f64, |most, part| most.max(part.abs()));
        if !(unbalanced <= BALANCED * largest) {
            let status = format!("{unbalanced:.1e} of the mean load stays unbalanced");
            return Err(EquilibriumError::NotConverged { status });
        }
        Ok(Equilibrium {
            stands: true,
            factor: solved.factor,
            forces: self.assembly.forces(&solved.forces),
            mechanism: self.assembly.velocities(&solved.velocities),
            unbalanced,
            excess,
            programs,
        })
    }

    /// A motion, if it is a proof: the power of the loads exceeds what strength takes up, and what its own rounding
    /// could resist if all loads bore on one corner.
    fn falls(
        &self,
        velocities: &[f64],
        strengths: &[Strength],
        programs: u32,
    ) -> Result<Equilibrium, EquilibriumError> {
        let assembly = &self.assembly;
        let power: f64 = assembly.dead.iter().zip(velocities).map(|(load, v)| load * v).sum();
        let total: f64 = assembly.dead.iter().map(|load| load.abs()).sum();
        let (mut dissipated, mut inadmissible) = (0.0, 0.0_f64);
        for (corner, strength) in assembly.corners.iter().zip(strengths) {
            let along = |axis| corner.relative(axis).map(|(column, value)| value * velocities[column]).sum::<f64>();
            let (opening, slip) = (along(0), along(1).hypot(along(2)));
            dissipated += strength.base.max(0.0) * slip + strength.tension * (opening - strength.slope * slip).max(0.0);
            inadmissible = inadmissible.max(strength.slope * slip - opening);
        }
        // Where strength may grow as it likes the motion does not slide at all.
        if !(power > dissipated + inadmissible * total) {
            let status = "the motion that was found is no proof".into();
            return Err(EquilibriumError::NotConverged { status });
        }
        let mechanism = assembly.velocities(velocities);
        Ok(Equilibrium {
            stands: false,
            factor: 0.0,
            forces: Vec::new(),
            mechanism,
            unbalanced: 0.0,
            excess: 0.0,
            programs,
        })
    }
}
