//! The safe way to λ: the weighted sum minimised for one λ after the other.
//!
//! At a fixed ratio of weights a·S_A + b·S_B is convex, smooth and piecewise quadratic, so that Newton's method with a
//! line search ends at its minimum after finitely many steps, whatever planes take turns on the way. Along the minima
//! the one side grows with λ and the other falls (it is the dual function's slope), so that λ can be bracketed.
//! Slower than the spine, which moves point and λ together; it only has to come near enough for the spine to end.

use crate::body::{Body, Planes};
use crate::expansion::{Expansion, Factorisation, Start};
use crate::line::{self, Merit};
use crate::target::Target;

/// Most values of λ that are tried, and most steps for each.
const MOST_WEIGHTS: u32 = 60;
const MOST_STEPS: u32 = 40;

/// Mismatch of the two sides, relative to the larger, from which the spine finds the end.
const CLOSE: f64 = 1e-9;

/// Farthest move of ln λ while only one end of the bracket is known.
const FARTHEST: f64 = 5.0;

/// A start near the optimum, with the number of models that were solved. `None` when something is not finite.
pub(crate) fn start(
    bodies: [&Body; 2],
    target: Target,
    from: &Start,
    factorisation: Factorisation,
) -> (Option<Start>, u32) {
    let (mut x, mut at) = (from.x, from.lambda.ln());
    // ln λ where the difference of the sides is negative, and where it is positive, with the difference.
    let mut below: Option<(f64, f64)> = None;
    let mut above: Option<(f64, f64)> = None;
    let mut models = 0;
    for _ in 0..MOST_WEIGHTS {
        let lambda = at.exp();
        let start = Start { x, lambda, near: true };
        let Some(minimum) = minimise(bodies, target, &start, factorisation, &mut models) else { return (None, models) };
        x = minimum.x;
        let (growing, falling) = target.sides(minimum.values.0, minimum.values.1);
        let difference = (growing - falling) / growing.max(falling);
        if !difference.is_finite() {
            return (None, models);
        }
        if difference < 0.0 {
            below = Some((at, difference));
        } else {
            above = Some((at, difference));
        }
        let next = match (below, above) {
            (Some((low, under)), Some((high, over))) => {
                // Regula falsi, kept away from the ends so that the bracket shrinks on both sides.
                let share = (under / (under - over)).clamp(0.1, 0.9);
                low + share * (high - low)
            }
            (Some((low, _)), None) => low + FARTHEST,
            (None, Some((high, _))) => high - FARTHEST,
            (None, None) => return (None, models),
        };
        if difference.abs() <= CLOSE || next == at {
            break;
        }
        at = next;
    }
    (Some(Start { x, lambda: at.exp(), near: true }), models)
}

/// Minimum of the weighted sum: the point, and S_A and S_B there.
struct Minimum {
    x: nalgebra::Vector3<f64>,
    values: (f64, f64),
}

fn minimise(
    bodies: [&Body; 2],
    target: Target,
    start: &Start,
    factorisation: Factorisation,
    models: &mut u32,
) -> Option<Minimum> {
    let (a, b) = target.weights(start.lambda);
    let mut here = Expansion::at(bodies, start, target, factorisation);
    for _ in 0..MOST_STEPS {
        *models += 1;
        let step = here.weighted(bodies, target, start.lambda)?;
        match step.planes {
            Planes::Exact => return Some(Minimum { x: here.x + step.v, values: step.optimum.values }),
            Planes::Dropped => here.drop(bodies, &step, target, start.lambda, factorisation),
            Planes::Met | Planes::Pulling => {
                let descent =
                    line::descend(bodies[0], bodies[1], Merit::Sum(a, b), &here.x, &step.v, (1.0, 1.0 + 1e-9));
                let x = here.x + descent.alpha * step.v;
                if x == here.x {
                    break;
                }
                here = Expansion::at(bodies, &Start { x, ..*start }, target, factorisation);
            }
        }
    }
    Some(Minimum { x: here.x, values: (here.q_a.value, here.q_b.value) })
}
