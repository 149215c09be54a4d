//! Where a search ended, and how far that can be from the optimum.

use crate::body::Body;
use crate::expansion::{self, Expansion, Step};
use crate::model::{Optimum, Response};
use crate::number::larger;
use crate::potential::Quadratic;
use crate::target::Target;
use crate::verdict::Planes;
use nalgebra::Vector3;

/// Largest change of ln λ that a first guess makes.
const FAR: f64 = 3.0;

/// Where the solver ended; everything in the solver's frame, potentials as regularised.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outcome {
    pub x: Vector3<f64>,
    pub lambda: f64,
    /// ∇S_A and ∇S_B at the optimum.
    pub gradients: [Vector3<f64>; 2],
    /// S_A and S_B at x, which differ by rounding.
    pub values: [f64; 2],
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
    /// How fast the two sides of the target part with ln λ, where known; else 0.
    pub rate: f64,
    /// How the optimum answers to changes of its data, where it is that of known quadratics.
    pub response: Option<Response>,
}

impl Outcome {
    /// Of a search that has found nothing.
    pub const UNKNOWN: Self = Self {
        x: Vector3::new(f64::NAN, f64::NAN, f64::NAN),
        lambda: 1.0,
        gradients: [Vector3::new(f64::NAN, f64::NAN, f64::NAN); 2],
        values: [f64::NAN; 2],
        estimate: f64::NAN,
        lower: f64::NEG_INFINITY,
        upper: f64::INFINITY,
        rounding: f64::INFINITY,
        iterations: 0,
        ending: Ending::Stuck,
        sure: false,
        rate: 0.0,
        response: None,
    };

    /// The optimum that a step leads to, with its bounds.
    #[inline(always)]
    pub fn of(here: &Expansion, bodies: [&Body; 2], target: Target, step: &Step) -> Self {
        let (optimum, soft, lambda) = (&step.optimum, expansion::softest(bodies[0], bodies[1]), step.optimum.lambda);
        let (s_a, s_b) = optimum.values;
        let estimate = target.dual(s_a, s_b, lambda);
        let upper = match step.planes {
            Planes::Exact => target.merit(s_a, s_b, lambda),
            _ => here.merit(target, lambda),
        };
        let length = step.v.norm();
        let of_places = |i: usize, q: &Quadratic| {
            let (local, verdict, slope) = (&here.locals[i], &step.verdicts[i], optimum.gradients[i].norm());
            bodies[i].rounding_after(local, q, verdict, length, slope)
        };
        let of_sums = |i: usize, q: &Quadratic, value: f64| bodies[i].rounding_of_value(value) + optimum.rounding(q);
        let places = [of_places(0, &here.q_a), of_places(1, &here.q_b)];
        let sums = [of_sums(0, &here.q_a, s_a), of_sums(1, &here.q_b, s_b)];
        let rounding = swayed(target, optimum, (places[0] + sums[0], places[1] + sums[1]))
            .unwrap_or_else(|| decisive(here, bodies, target, step, places, sums));
        let (doubt, sure) = here.doubt(bodies, target, step, upper, rounding);
        Self {
            x: here.x + step.v,
            lambda,
            gradients: [here.to_solver(&optimum.gradients[0]), here.to_solver(&optimum.gradients[1])],
            values: [s_a, s_b],
            estimate,
            lower: estimate - doubt,
            upper,
            rounding,
            iterations: 0,
            ending: Ending::Stuck,
            sure,
            rate: optimum.rate(target),
            response: optimum.response(target, soft),
        }
    }

    /// Near the λ of a closest point, seen from midway: along their common curve ln S of either body is nearly linear in ln λ.
    /// Rational functions will do for the logarithm and its inverse.
    pub fn towards(&self, target: Target) -> f64 {
        let weights = Target::Midway.weights(self.lambda);
        let (rate_a, rate_b) = Target::Midway.apart(0.0, -self.rate, weights);
        let (s, rate) = if target == Target::OnB { (self.values[1], rate_b) } else { (self.values[0], rate_a) };
        let logarithm = 3.0 * (s - 1.0) * (s + 1.0) / (s * s + 4.0 * s + 1.0);
        let change = -logarithm * s / rate;
        // NaN and what is far fail the test.
        if change.abs() < FAR {
            let even = 12.0 + change * change;
            self.lambda * (even + 6.0 * change) / (even - 6.0 * change)
        } else {
            self.lambda
        }
    }

    /// Whether the optimum exceeds 1 for sure, where a regularisation adds no more than `flat`: what it adds proves nothing.
    #[inline]
    pub fn separates(&self, flat: f64) -> bool {
        self.lower - self.rounding - flat > 1.0
    }

    /// Bound on the error of the optimal S.
    #[inline]
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

/// Bound on the effect of rounding on the optimum, from bounds on that of S_A and S_B: it moves the optimum by its weight,
/// while the weights stay what they are. `None` where the rounding itself decides about the weights.
fn swayed(target: Target, optimum: &Optimum, (of_a, of_b): (f64, f64)) -> Option<f64> {
    let (change_a, change_b) = target.changes(of_a, of_b);
    let swing = larger(change_a, change_b) / optimum.rate(target).abs();
    (swing < 0.25).then(|| target.dual_weighted(of_a, of_b, optimum.lambda) * (1.0 + 4.0 * swing))
}

/// The same where rounding decides about the weights: from below the weights at hand are as good as any, from above it
/// is the whole of it at most.
///
/// Where the planes of one body lie moves that body, and the point may follow. A way towards its centre, as a share of
/// the whole way, by which no plane is deeper than before undoes all of it, and changes the other S, which is convex, by
/// no more than that share of what it changes on the whole way. A small, sharp body at a large one needs that.
#[cold]
fn decisive(
    here: &Expansion,
    bodies: [&Body; 2],
    target: Target,
    step: &Step,
    places: [f64; 2],
    sums: [f64; 2],
) -> f64 {
    let lambda = step.optimum.lambda;
    let whole = [places[0] + sums[0], places[1] + sums[1]];
    let values: [f64; 2] = step.optimum.values.into();
    let followed = [0, 1].map(|i| {
        let other = 1 - i;
        let further = bodies[other].value(&bodies[i].centre()) - values[other];
        let share = bodies[i].share_of_way(&here.locals[i], step.v.norm());
        let mut errors = whole;
        errors[i] = sums[i];
        errors[other] += share * further.max(0.0);
        target.merit_rounding(errors[0], errors[1], lambda)
    });
    let above = target.merit_rounding(whole[0], whole[1], lambda).min(followed[0]).min(followed[1]);
    above.max(target.dual_weighted(whole[0], whole[1], lambda))
}
