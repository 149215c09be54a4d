//! Where a search ended, and how far that can be from the optimum.

use crate::body::{Body, Planes};
use crate::expansion::{self, Expansion, Step};
use crate::model::{Optimum, Response};
use crate::potential::Quadratic;
use crate::target::Target;
use nalgebra::Vector3;

/// Where the solver ended; everything in the solver's frame, potentials as regularised.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outcome {
    pub x: Vector3<f64>,
    pub lambda: f64,
    /// ∇S_A and ∇S_B at the optimum.
    pub gradients: [Vector3<f64>; 2],
    /// Best estimate of the optimal S.
    pub estimate: f64,
    /// Lower bound up to `rounding`.
    pub lower: f64,
    /// Merit of a point that was evaluated: an upper bound up to `rounding`.
    pub upper: f64,
    /// Bound on the rounding of both.
    pub rounding: f64,
    pub iterations: u32,
    pub ending: Ending,
    /// Whether every plane of the quadratics pushes beyond doubt.
    pub sure: bool,
    /// How the optimum answers to changes of its data, where it is that of known quadratics.
    pub response: Option<Response>,
}

impl Outcome {
    /// Of a search that has found nothing.
    pub const UNKNOWN: Self = Self {
        x: Vector3::new(f64::NAN, f64::NAN, f64::NAN),
        lambda: 1.0,
        gradients: [Vector3::new(f64::NAN, f64::NAN, f64::NAN); 2],
        estimate: f64::NAN,
        lower: f64::NEG_INFINITY,
        upper: f64::INFINITY,
        rounding: f64::INFINITY,
        iterations: 0,
        ending: Ending::Stuck,
        sure: false,
        response: None,
    };

    /// The optimum that a step leads to, with its bounds.
    pub fn of(here: &Expansion, bodies: [&Body; 2], target: Target, step: &Step) -> Self {
        let (optimum, soft, lambda) = (&step.optimum, expansion::softest(bodies[0], bodies[1]), step.optimum.lambda);
        let (s_a, s_b) = optimum.values;
        let estimate = target.dual(s_a, s_b, lambda);
        let upper = match step.planes {
            Planes::Exact => target.merit(s_a, s_b, lambda),
            _ => here.merit(target, lambda),
        };
        let length = step.v.norm();
        let rounding = |i: usize, q: &Quadratic, value: f64| {
            let (local, verdict, slope) = (&here.locals[i], &step.verdicts[i], optimum.gradients[i].norm());
            bodies[i].rounding_after(local, q, verdict, length, value, slope) + optimum.rounding(q)
        };
        let rounding = swayed(target, optimum, rounding(0, &here.q_a, s_a), rounding(1, &here.q_b, s_b));
        let (doubt, sure) = here.doubt(bodies, target, step, upper, rounding);
        Self {
            x: here.x + step.v,
            lambda,
            gradients: optimum.gradients.map(|g| here.to_solver(&g)),
            estimate,
            lower: estimate - doubt,
            upper,
            rounding,
            iterations: 0,
            ending: Ending::Stuck,
            sure,
            response: optimum.response(target, soft),
        }
    }

    /// Bound on the error of the optimal S.
    pub fn gap(&self) -> f64 {
        self.upper - self.lower + self.rounding
    }
}

/// Why the solver stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ending {
    /// The bounds meet within the tolerance.
    Converged,
    /// The bounds meet within rounding, which is more than the tolerance.
    RoundingLimited,
    /// The lower bound exceeds 1, which was enough.
    Separated,
    /// Neither; the outcome is not to be used.
    Stuck,
}

/// Bound on the effect of rounding on the optimum, from bounds on that of S_A and S_B.
///
/// An error in S_A or S_B moves the optimum by its weight, while the weights stay what they are; where the
/// error itself decides about the weights, by no more than the whole of it.
fn swayed(target: Target, optimum: &Optimum, of_a: f64, of_b: f64) -> f64 {
    let lambda = optimum.lambda;
    let weighted = target.dual_weighted(of_a, of_b, lambda);
    let (change_a, change_b) = target.changes(of_a, of_b);
    let swing = change_a.max(change_b) / optimum.rate(target).abs();
    if swing < 0.25 { weighted * (1.0 + 4.0 * swing) } else { target.merit_rounding(of_a, of_b, lambda).max(weighted) }
}
