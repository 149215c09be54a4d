//! A scene with its strength: forces of the least norm, and answers that prove themselves.

use super::assembly::{Assembly, Corner};
use super::error::EquilibriumError;
use super::program::{Goal, Near, Outcome, Solved, Strength, solve};
use super::scene::{Scene, Velocity};
use nalgebra::Vector3;

/// Largest force that may stay unbalanced on a body, over the largest force.
const BALANCED: f64 = 1e-6;

/// Forces in equilibrium, and the motion at the limit.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Equilibrium {
    /// Whether there are forces in equilibrium, for a load factor or a strength factor: for any factor.
    pub stands: bool,
    /// The load factor or the factor of safety; 0 where nothing stands, and in [`stands()`](super::stands).
    pub factor: f64,
    /// Force on the second body at each corner, contact after contact, in the axes of the scene; empty where nothing
    /// stands.
    pub forces: Vec<Vector3<f64>>,
    /// Velocity of each body in the mechanism, the fastest at 1; empty in [`stands()`](super::stands) of a scene that
    /// does.
    pub mechanism: Vec<Velocity>,
    /// The largest force, or torque over the size of the body, that is left on a body, over the mean load of one.
    pub unbalanced: f64,
    /// The largest friction beyond its strength at a corner, over the mean load of a body: of a sequence that was
    /// solved.
    pub excess: f64,
    /// Number of cone programs.
    pub programs: u32,
}

/// A scene in its own units, and its strength as given.
pub(super) struct Problem {
    pub assembly: Assembly,
    pub strengths: Vec<Strength>,
}

impl Problem {
    pub fn new(scene: &Scene) -> Result<Self, EquilibriumError> {
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
    pub fn with_part(&self, kappa: f64) -> Result<Outcome, EquilibriumError> {
        let reduced = |given: &Strength| Strength { slope: kappa * given.slope, base: kappa * given.base, ..*given };
        self.at_rest(&self.strengths.iter().map(reduced).collect::<Vec<_>>())
    }

    /// The forces of the least norm that keep all bodies at rest with these strengths.
    pub fn at_rest(&self, strengths: &[Strength]) -> Result<Outcome, EquilibriumError> {
        let none = vec![[0.0; 3]; strengths.len()];
        solve(&self.assembly, strengths, Goal::Rest, Some(Near { weight: 1.0, forces: &none }))
    }

    /// The largest friction beyond `part` of its strength.
    pub fn excess(&self, solved: &Solved, part: f64) -> f64 {
        let beyond = |(given, [n, t, s]): (&Strength, &[f64; 3])| t.hypot(*s) - part * (given.base + given.slope * n);
        self.strengths.iter().zip(&solved.forces).map(beyond).fold(0.0, f64::max)
    }

    /// Forces, if they are in equilibrium to what is promised.
    pub fn answer(
        &self,
        solved: &Solved,
        live: f64,
        excess: f64,
        programs: u32,
    ) -> Result<Equilibrium, EquilibriumError> {
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
    pub fn falls(
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
