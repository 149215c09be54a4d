//! The path of states of rest from given loads and strength to the limit.
//!
//! On the path displacements v and the parameter p, the factor on the live loads or the part of the strength, change
//! together. A step predicts both along the last one and then settles them across it, so that it passes where p turns.
//! At the limit displacements grow without bound along the mechanism, and p no longer changes.

use super::answer::Demand;
use super::error::EquilibriumError;
use super::numbers::{
    ASTRAY, BACK, FIRST_STEP, GROWTH, LEAST_STEP, NEAR, OF_DRIFT, OF_PATH, OF_STEP, RAISED, RAISED_DRAG, SETTLED,
    STEP_DRAG, WITHOUT_LIMIT,
};
use super::rest::{Drift, End, State, Unknown};

/// The end of a path.
pub(super) struct Limit {
    /// The parameter at the limit.
    pub parameter: f64,
    /// A state of rest there.
    pub state: State,
    /// Scaled velocities of the mechanism.
    pub mechanism: Vec<f64>,
}

/// Where a path is, and where it goes.
struct Way {
    state: State,
    /// Change of displacements and of the parameter.
    along: Vec<f64>,
    by: f64,
    /// How much of it the next step takes.
    length: f64,
}

/// Follows the states of rest from one of them to the limit, with load that grows, or strength that falls.
///
/// # Errors
/// `Unlimited` or `StandsWithoutStrength`; `NotFound` if the path is lost, with the parameter that was reached.
pub(super) fn limit(drift: &mut Drift, state: State, unknown: Unknown) -> Result<Limit, EquilibriumError> {
    let start = size(drift, &state).max(1.0);
    let mut way = begin(drift, state, unknown)?;
    let mut best = way.state.clone();
    let (mut mark, mut before_it) = ((0.0, f64::NAN), f64::NAN);
    while drift.stiffness.solves < OF_PATH {
        let across = drift.metric(&way.along, &way.state);
        let v = way.state.v.iter().zip(&way.along).map(|(v, along)| v + way.length * along).collect();
        let mut next = State { v, at: unknown.moved(way.state.at, way.length * way.by) };
        let before = drift.stiffness.solves;
        if drift.settle(&mut next, unknown, &across, STEP_DRAG, (OF_STEP, f64::INFINITY)) != End::Rest {
            way.length *= 0.25;
            let step = way.length * drift.length(&way.along, &way.state);
            if !(step >= LEAST_STEP * size(drift, &way.state) && step.is_finite()) {
                way = raised(drift, best, unknown)?;
                best = way.state.clone();
            }
            continue;
        }
        way.by = (unknown.of(next.at) - unknown.of(way.state.at)) / way.length;
        way.along = next.v.iter().zip(&way.state.v).map(|(next, v)| (next - v) / way.length).collect();
        way.state = next;
        let parameter = unknown.of(way.state.at);
        if parameter > WITHOUT_LIMIT || unknown == Unknown::Strength && parameter <= 1.0 / WITHOUT_LIMIT {
            return Err(unlimited(unknown));
        }
        let gained = unknown.sense() * (parameter - unknown.of(best.at));
        if gained > 0.0 {
            best = way.state.clone();
        } else if gained < -BACK * unknown.of(best.at).abs() {
            way = raised(drift, best.clone(), unknown)?;
            best = way.state.clone();
            continue;
        }
        let grown = size(drift, &way.state);
        if grown >= GROWTH * f64::max(mark.0, start) {
            let found = (parameter * grown - mark.1 * mark.0) / (grown - mark.0);
            let is_near = (found - parameter).abs() <= NEAR * found.abs();
            if is_near && (found - before_it).abs() <= SETTLED * found.abs() {
                return Ok(Limit { parameter: found, state: way.state, mechanism: way.along });
            }
            (mark, before_it) = ((grown, parameter), found);
        }
        way.length *= match drift.stiffness.solves - before {
            0..=3 => 3.0,
            4..=8 => 1.5,
            _ => 0.8,
        };
    }
    Err(lost(&way.state, unknown))
}

/// Displacements over those of elastic bodies.
fn size(drift: &Drift, state: &State) -> f64 {
    drift.length(&state.v, state)
}

/// From a state along its tangent.
fn begin(drift: &mut Drift, state: State, unknown: Unknown) -> Result<Way, EquilibriumError> {
    let by = unknown.sense();
    let mut along = drift.tangent(&state, unknown).ok_or_else(|| lost(&state, unknown))?;
    along.iter_mut().for_each(|part| *part *= by);
    let length = FIRST_STEP * size(drift, &state).max(1.0) / drift.length(&along, &state);
    if length.is_finite() {
        return Ok(Way { state, along, by, length });
    }
    // No displacement changes with the parameter: no live load moves anything, or no point slips before strength has
    // fallen to what is used.
    let used = if unknown == Unknown::Strength { drift.used(&state) } else { 0.0 };
    if !(used > 1.0 / WITHOUT_LIMIT) {
        return Err(unlimited(unknown));
    }
    raised(drift, State { at: Demand { strength: used, ..state.at }, ..state }, unknown)
}

/// Where the path turns back sharply: what bodies do under a little more load. They come to rest elsewhere, or go along
/// a mechanism, on which a state of rest is then looked for.
fn raised(drift: &mut Drift, state: State, unknown: Unknown) -> Result<Way, EquilibriumError> {
    for raise in RAISED {
        let more = unknown.sense() * raise * unknown.of(state.at).abs().max(raise);
        let mut next = State { at: unknown.moved(state.at, more), ..state.clone() };
        match drift.settle(&mut next, Unknown::Displacements, &[], RAISED_DRAG, (OF_DRIFT, ASTRAY)) {
            End::Rest => return begin(drift, next, unknown),
            End::Undecided => continue,
            End::Gone => {}
        }
        let along: Vec<f64> = next.v.iter().zip(&state.v).map(|(next, v)| next - v).collect();
        let across = drift.metric(&along, &next);
        if drift.settle(&mut next, unknown, &across, RAISED_DRAG, (OF_DRIFT, f64::INFINITY)) == End::Rest {
            let along = next.v.iter().zip(&state.v).map(|(next, v)| next - v).collect();
            return Ok(Way { by: 0.0, length: 1.0, along, state: next });
        }
    }
    Err(lost(&state, unknown))
}

fn unlimited(unknown: Unknown) -> EquilibriumError {
    if unknown == Unknown::Load { EquilibriumError::Unlimited } else { EquilibriumError::StandsWithoutStrength }
}

fn lost(state: &State, unknown: Unknown) -> EquilibriumError {
    EquilibriumError::NotFound { stands: unknown.of(state.at), bound: f64::NAN }
}
