//! The three questions: does it stand, how much more can it bear, how much weaker could its joints be.

use super::error::EquilibriumError;
use super::problem::{Equilibrium, Problem};
use super::program::{Goal, Outcome, Solved, Strength};
use super::scene::Scene;
use super::sequence::{Ended, Flow, Sequence};

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
    let sequence = Sequence { problem: &problem, goal: Goal::Load, flow, unlimited, strengths, strength: |_| 1.0 };
    match sequence.run(1.0)? {
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
    let strength = |factor| factor;
    let sequence = Sequence { problem: &problem, goal: Goal::Strength, flow, unlimited, strengths, strength };
    match sequence.run(0.0)? {
        Ended::Settled(solved, excess, programs) => {
            let answer = problem.answer(&solved, 0.0, excess, programs)?;
            Ok(Equilibrium { factor: 1.0 / solved.factor, ..answer })
        }
        Ended::Falls(answer) => Ok(answer),
    }
}
