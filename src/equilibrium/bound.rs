//! The associated answer: the largest factor of all states in which joints open by tan φ times their slip. It is a
//! convex problem, and no state of equilibrium exceeds it.

use super::answer::{Demand, Equilibrium};
use super::assembly::{Assembly, Point};
use super::error::EquilibriumError;
use super::numbers::{BALANCED, EXCESS, HALVING, MOST_PROGRAMS, REDUCED, STRIDE, WEAKER};
use super::program::{Cone, Goal, Outcome, Solved, solve};
use nalgebra::Vector3;

/// With this part of the strength: whether any forces hold all bodies, those of the least norm or a motion.
///
/// # Errors
/// `NotConverged`.
fn rest(assembly: &Assembly, part: f64) -> Result<Outcome, EquilibriumError> {
    solve(assembly, &cones(assembly, part), Goal::Rest)
}

/// The strength of all points, this part of it.
fn cones(assembly: &Assembly, part: f64) -> Vec<Cone> {
    let cone = |(_, point): (_, &Point)| {
        let of = &point.strength;
        Cone { slope: part * of.friction, base: part * of.cohesion, growth: 0.0, tension: of.tension }
    };
    assembly.each_point().map(cone).collect()
}

/// Whether any forces hold all bodies.
///
/// # Errors
/// `NotConverged`.
pub(super) fn stands(assembly: &Assembly) -> Result<Equilibrium, EquilibriumError> {
    one(assembly, Goal::Rest)
}

/// The largest factor on the live loads.
///
/// # Errors
/// `NotConverged`, `Unlimited`.
pub(super) fn load(assembly: &Assembly) -> Result<Equilibrium, EquilibriumError> {
    one(assembly, Goal::Load)
}

/// The answer of one program with the given strength.
fn one(assembly: &Assembly, goal: Goal) -> Result<Equilibrium, EquilibriumError> {
    match solve(assembly, &cones(assembly, 1.0), goal)? {
        Outcome::Solved(solved) => {
            let at = Demand { live: solved.factor, strength: 1.0 };
            answer(assembly, &solved, at, assembly.live_factor(solved.factor), 1)
        }
        Outcome::Falls(velocities) => falls(assembly, &velocities, 1.0, 1),
        // Without a factor there is no limit to miss.
        Outcome::Unlimited if goal == Goal::Rest => {
            Err(EquilibriumError::NotConverged { status: "PrimalInfeasible".into() })
        }
        Outcome::Unlimited => Err(EquilibriumError::Unlimited),
    }
}

/// The factor of safety. With κ and forces of the last program, |t| ≤ κ (C + μ n) + (φ − κ)(C + μ n̄): the least φ is
/// the next κ, and at the end φ = κ. A scene stands at κ if and only if φ ≤ κ, or φ has no least value: the factor lies
/// between the largest κ with which it does not stand and the least with which it does.
///
/// # Errors
/// `NotConverged`, `StandsWithoutStrength`.
pub(super) fn strength(assembly: &Assembly) -> Result<Equilibrium, EquilibriumError> {
    // Before the first program n is unknown: strength is the same at all points.
    let mut forces = vec![Vector3::x(); assembly.points.len()];
    let (mut kappa, mut bracket) = (0.0, [0.0, f64::INFINITY]);
    for programs in 1..=HALVING {
        let cone = |((_, point), force): ((_, &Point), &Vector3<f64>)| {
            let (of, normal) = (&point.strength, force.x.max(-point.strength.tension));
            let (slope, growth) = (kappa * of.friction, of.cohesion + of.friction * normal);
            Cone { slope, base: kappa * of.cohesion - kappa * growth, growth, tension: of.tension }
        };
        let cones: Vec<Cone> = assembly.each_point().zip(&forces).map(cone).collect();
        match solve(assembly, &cones, Goal::Strength) {
            Ok(Outcome::Solved(solved)) if solved.factor > REDUCED => {
                if kappa > 0.0 {
                    bracket[usize::from(solved.factor <= kappa)] = kappa;
                }
                let at = Demand { live: 0.0, strength: solved.factor };
                let found = Equilibrium::standing(assembly, &solved.forces, at, programs);
                if (solved.factor - kappa).abs() <= REDUCED * solved.factor && found.excess <= EXCESS {
                    // Beside large forces of the last program φ says little.
                    let less = solved.factor * (1.0 - WEAKER);
                    if held(assembly, less, programs).is_some() {
                        return halved(assembly, [0.0, less], programs);
                    }
                    return answer(assembly, &solved, at, 1.0 / solved.factor, programs);
                }
                // Far below the limit φ says little: forces that stand with it may be of any size.
                let most = if bracket[0] > 0.0 { STRIDE * STRIDE * kappa } else { f64::INFINITY };
                (kappa, forces) = (solved.factor.min(most), solved.forces);
                if kappa >= bracket[1] {
                    return halved(assembly, bracket, programs);
                }
            }
            Ok(Outcome::Falls(velocities)) if kappa == 0.0 => {
                // Where strength may grow as it likes the motion does not slide at all.
                return falls(assembly, &velocities, 0.0, programs);
            }
            Ok(Outcome::Falls(_)) => return halved(assembly, [kappa, bracket[1]], programs),
            Ok(_) if kappa == 0.0 => return Err(EquilibriumError::StandsWithoutStrength),
            Err(error) if kappa == 0.0 => return Err(error),
            // Friction of this κ clamps blocks with forces of any size.
            Ok(_) => return halved(assembly, [bracket[0], kappa], programs),
            // This κ is too near to that for clarabel.
            Err(_) => return halved(assembly, bracket, programs),
        }
    }
    halved(assembly, bracket, HALVING)
}

/// The factor between a κ with which no forces hold the scene and one with which forces of the least norm do, by
/// halving. Where clarabel finds neither, κ counts as too weak.
fn halved(assembly: &Assembly, mut bracket: [f64; 2], mut programs: u32) -> Result<Equilibrium, EquilibriumError> {
    while let Some(kappa) = inside(bracket) {
        let stands = matches!(rest(assembly, kappa), Ok(Outcome::Solved(_)));
        bracket[usize::from(stands)] = kappa;
        programs += 1;
        if programs > MOST_PROGRAMS {
            return Err(EquilibriumError::NotFound { stands: 1.0 / bracket[1], bound: 1.0 / bracket[0] });
        }
    }
    clamped(assembly, bracket[1], programs)
}

/// The state with this part κ of the strength, below which forces that clamp blocks grow without bound.
fn clamped(assembly: &Assembly, kappa: f64, programs: u32) -> Result<Equilibrium, EquilibriumError> {
    if kappa <= REDUCED {
        return Err(EquilibriumError::StandsWithoutStrength);
    }
    // A little more strength, until the least forces are small enough to be found.
    let margins = [1.0, 10.0, 100.0, 1000.0].map(|of| 1.0 + of * EXCESS);
    if let Some(found) = margins.iter().find_map(|margin| held(assembly, margin * kappa, programs)) {
        return Ok(Equilibrium { factor: 1.0 / kappa, bound: 1.0 / kappa, ..found });
    }
    Err(EquilibriumError::NotFound { stands: 1.0 / kappa, bound: 1.0 / kappa })
}

/// The forces of the least norm with this part κ of the strength; `None` if there are none, or clarabel does not find
/// them.
fn held(assembly: &Assembly, kappa: f64, programs: u32) -> Option<Equilibrium> {
    let Ok(Outcome::Solved(solved)) = rest(assembly, kappa) else { return None };
    answer(assembly, &solved, Demand { live: 0.0, strength: kappa }, 1.0 / kappa, programs).ok()
}

/// A κ inside the bracket; `None` once its ends agree.
fn inside([low, high]: [f64; 2]) -> Option<f64> {
    let is_closed = high - low <= EXCESS * high || high <= REDUCED;
    let between = || match (low > 0.0, high.is_finite()) {
        (true, true) => (low * high).sqrt(),
        (true, false) => low * STRIDE,
        _ => high / STRIDE,
    };
    (!is_closed).then(between)
}

/// Forces of a program, if they are in equilibrium to what is promised.
fn answer(
    assembly: &Assembly,
    solved: &Solved,
    at: Demand,
    factor: f64,
    programs: u32,
) -> Result<Equilibrium, EquilibriumError> {
    let found = Equilibrium::standing(assembly, &solved.forces, at, programs);
    let largest = solved.forces.iter().map(Vector3::amax).fold(1.0, f64::max);
    if !(found.unbalanced <= BALANCED * largest) {
        let status = format!("{:.1e} of the mean load stays unbalanced", found.unbalanced);
        return Err(EquilibriumError::NotConverged { status });
    }
    Ok(Equilibrium { factor, bound: factor, mechanism: assembly.velocities(&solved.velocities), ..found })
}

/// A motion, if it is a proof: the power of the loads exceeds what strength takes up, and what its own rounding could
/// resist if all loads bore on one point. Without a part of the strength, it may not slide.
fn falls(assembly: &Assembly, velocities: &[f64], part: f64, programs: u32) -> Result<Equilibrium, EquilibriumError> {
    let power: f64 = assembly.dead.iter().zip(velocities).map(|(load, v)| load * v).sum();
    let total: f64 = assembly.dead.iter().map(|load| load.abs()).sum();
    let (mut taken, mut inadmissible) = (0.0, 0.0_f64);
    for (joint, point) in assembly.each_point().filter(|(_, point)| point.counts()) {
        let (of, u) = (&point.strength, joint.slip(point, velocities));
        let (opening, slip, slope) = (u.x, u.y.hypot(u.z), part * of.friction);
        taken += part * of.cohesion * slip + of.tension * (opening - slope * slip).max(0.0);
        inadmissible = inadmissible.max(slope * slip - opening);
    }
    if !(power > taken + inadmissible * total) {
        return Err(EquilibriumError::NotConverged { status: "the motion that was found is no proof".into() });
    }
    Ok(Equilibrium::falling(assembly, velocities, programs))
}
