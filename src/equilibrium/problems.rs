//! The three questions: does it stand, how much more can it bear, how much weaker could its joints be.

use super::answer::{Demand, Equilibrium};
use super::assembly::Assembly;
use super::bound;
use super::error::EquilibriumError;
use super::numbers::{DRIFT_DRAG, OF_DRIFT, STRONGER};
use super::path::{Limit, limit};
use super::rest::{Drift, End, State, Unknown};
use super::scene::Scene;

/// How a contact opens as it slides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flow {
    /// By tan φ times the slip: one convex problem, whose factor no state of equilibrium exceeds. "May stand".
    Associated,
    /// Not at all, as Coulomb's friction does, with elastic joints: the state that loads lead to from nothing.
    NonDilatant,
}

/// Whether the scene comes to rest under its dead loads, from nothing; with the forces, or the motion. Associated:
/// whether any forces hold it; with those of the least norm, or a motion that proves that there are none.
///
/// # Errors
/// An invalid scene; `Undecided` or `NotConverged`, which does not mean that it falls.
pub fn stands(scene: &Scene, flow: Flow) -> Result<Equilibrium, EquilibriumError> {
    let assembly = Assembly::new(scene)?;
    if flow == Flow::Associated {
        let mut found = bound::stands(&assembly)?;
        if found.stands {
            found.mechanism.clear();
        }
        return Ok(found);
    }
    let mut drift = Drift::new(&assembly)?;
    match from_nothing(&mut drift, Demand::GIVEN)? {
        Begin::Rest(state) => Ok(standing(&drift, &state)),
        Begin::Falls(motion) => {
            let may_stand = bound::stands(&assembly).map_or(true, |found| found.stands);
            Ok(Equilibrium { may_stand, ..Equilibrium::falling(&assembly, &motion, drift.stiffness.solves) })
        }
    }
}

/// The largest factor λ for which dead + λ live loads can be carried, with the forces and the mechanism there. The dead
/// loads come first, from nothing, then the live loads grow.
///
/// # Errors
/// As of [`stands()`]; no live load, or a load that can be carried whatever its size; `NotFound`.
pub fn load_factor(scene: &Scene, flow: Flow) -> Result<Equilibrium, EquilibriumError> {
    let assembly = Assembly::new(scene)?;
    if assembly.live.iter().all(|load| *load == 0.0) {
        return Err(EquilibriumError::NoLiveLoad);
    }
    // Where no forces bear the dead loads alone there is no load to begin with.
    let associated = || match bound::stands(&assembly) {
        Ok(found) if !found.stands => Ok(found),
        _ => bound::load(&assembly),
    };
    if flow == Flow::Associated {
        return associated();
    }
    let mut drift = Drift::new(&assembly)?;
    match from_nothing(&mut drift, Demand::GIVEN)? {
        // Its forces are some that bear the dead loads.
        Begin::Rest(start) => {
            let bound = bound::load(&assembly);
            at_limit(&mut drift, start, Unknown::Load, bound, |scaled| assembly.live_factor(scaled))
        }
        Begin::Falls(motion) => fallen(&drift, &motion, associated()),
    }
}

/// The factor of safety F: tan φ and c over F are the least with which the scene stands under its dead loads; with the
/// forces and the mechanism there. The loads come first, from nothing, with the given strength or with the least of its
/// doubles that holds the scene; then the strength falls.
///
/// # Errors
/// As of [`stands()`]; a scene that needs no strength; `NotFound`.
pub fn strength_factor(scene: &Scene, flow: Flow) -> Result<Equilibrium, EquilibriumError> {
    let assembly = Assembly::new(scene)?;
    let associated = bound::strength(&assembly);
    if flow == Flow::Associated {
        return associated;
    }
    let mut drift = Drift::new(&assembly)?;
    // What falls whatever its strength is not tried with more.
    let falls = matches!(&associated, Ok(found) if !found.stands);
    let (mut motion, mut undecided) = (None, None);
    for doubled in 0..if falls { 1 } else { STRONGER } {
        match from_nothing(&mut drift, Demand { live: 0.0, strength: 2.0_f64.powi(doubled) }) {
            Ok(Begin::Rest(start)) => {
                return at_limit(&mut drift, start, Unknown::Strength, associated, |part| 1.0 / part);
            }
            Ok(Begin::Falls(found)) => _ = motion.get_or_insert(found),
            // With more strength it may stand.
            Err(error) => undecided = Some(error),
        }
    }
    match undecided {
        None => fallen(&drift, &motion.unwrap_or_default(), associated),
        Some(error) if motion.is_none() => Err(error),
        // It falls with the given strength.
        Some(_) => Err(EquilibriumError::NotFound { stands: 0.0, bound: bound_of(&associated).min(1.0) }),
    }
}

enum Begin {
    Rest(State),
    /// The displacements along which bodies go.
    Falls(Vec<f64>),
}

/// The state that the loads lead to from nothing.
fn from_nothing(drift: &mut Drift, at: Demand) -> Result<Begin, EquilibriumError> {
    let mut state = State { v: vec![0.0; drift.assembly.dead.len()], at };
    match drift.settle(&mut state, Unknown::Displacements, &[], DRIFT_DRAG, (OF_DRIFT, f64::INFINITY)) {
        End::Rest => Ok(Begin::Rest(state)),
        End::Gone => Ok(Begin::Falls(state.v)),
        End::Undecided => {
            Err(EquilibriumError::Undecided { solves: drift.stiffness.solves, left: drift.largest_left(&state) })
        }
    }
}

fn standing(drift: &Drift, state: &State) -> Equilibrium {
    let forces: Vec<_> = drift.forces(&state.v, state.at).collect();
    Equilibrium::standing(drift.assembly, &forces, state.at, drift.stiffness.solves)
}

/// The answer of a scene that stands with no factor, with what is known of its associated one.
fn fallen(
    drift: &Drift,
    motion: &[f64],
    associated: Result<Equilibrium, EquilibriumError>,
) -> Result<Equilibrium, EquilibriumError> {
    let may_stand = associated.as_ref().map_or(true, |found| found.stands);
    let found = Equilibrium::falling(drift.assembly, motion, drift.stiffness.solves);
    Ok(Equilibrium { may_stand, bound: bound_of(&associated), ..found })
}

fn bound_of(associated: &Result<Equilibrium, EquilibriumError>) -> f64 {
    match associated {
        Ok(found) => found.bound,
        Err(EquilibriumError::Unlimited | EquilibriumError::StandsWithoutStrength) => f64::INFINITY,
        Err(EquilibriumError::NotFound { bound, .. }) => *bound,
        Err(_) => f64::NAN,
    }
}

/// The answer at the end of the path from a state of rest.
fn at_limit(
    drift: &mut Drift,
    start: State,
    unknown: Unknown,
    associated: Result<Equilibrium, EquilibriumError>,
    factor: impl Fn(f64) -> f64,
) -> Result<Equilibrium, EquilibriumError> {
    let bound = bound_of(&associated);
    let Limit { parameter, state, mechanism } = limit(drift, start, unknown).map_err(|error| match error {
        EquilibriumError::NotFound { stands, .. } => EquilibriumError::NotFound { stands: factor(stands), bound },
        // A path without end is one only if no bound ends it.
        _ if bound.is_finite() => EquilibriumError::NotFound { stands: 0.0, bound },
        other => other,
    })?;
    let mechanism = drift.assembly.velocities(&mechanism);
    Ok(Equilibrium { factor: factor(parameter), bound, mechanism, ..standing(drift, &state) })
}
