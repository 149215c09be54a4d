//! What the rounding of S_A and S_B does to the optimum.
//!
//! It moves the optimum by its weight, while the weights stay what they are. Where the rounding itself decides about the
//! weights, it is S with all planes moved in by their rounding that tells ([`crate::bounds::ceiling`]).

use crate::bounds::ceiling::Ceiling;
use crate::linalg::number::larger;
use crate::model::dual_path::Optimum;
use crate::model::local_model::{Expansion, Step};
use crate::model::problem::Target;
use crate::pair::placed_particle::Body;
use crate::particle::potential::Quadratic;

/// How much more than its first order the whole of the rounding may be before it is looked at again; and how much more than
/// the whole something else may leave open before the rounding is what decides no more.
const DEEP: f64 = 8.0;

/// What the bounds of an outcome may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Care {
    /// What it takes for one outcome.
    Once,
    /// For one of many: what would hardly narrow its gap is left for the one that is kept ([`crate::bounds::solution::Outcome::refine`]).
    OnTheWay,
    /// The same, and second looks at what is deep beside rounding, and at what a slope can hide.
    Careful,
}

/// Bounds on the rounding of S_A and S_B at the end of a step.
#[derive(Clone, Copy)]
pub(crate) struct Sway {
    /// Of first order in the places of the planes, with that of the sums.
    first: [f64; 2],
    /// Of second order.
    second: [f64; 2],
    /// Of the sums alone.
    pub sums: [f64; 2],
}

impl Sway {
    /// After a step to where ∇S_A and ∇S_B are as long as `steep`.
    #[inline(always)]
    pub fn of(here: &Expansion, bodies: [&Body; 2], step: &Step, steep: [f64; 2]) -> Self {
        let (optimum, length) = (&step.optimum, step.v.norm());
        let of_places =
            |i: usize, q: &Quadratic| bodies[i].rounding_after(&here.locals[i], q, &step.verdicts[i], length, steep[i]);
        let of_sums = |i: usize, q: &Quadratic, value: f64| bodies[i].rounding_of_value(value) + optimum.rounding(q);
        let (first_a, second_a) = of_places(0, &here.q_a);
        let (first_b, second_b) = of_places(1, &here.q_b);
        let sums = [of_sums(0, &here.q_a, optimum.values.0), of_sums(1, &here.q_b, optimum.values.1)];
        Self { first: [first_a + sums[0], first_b + sums[1]], second: [second_a, second_b], sums }
    }

    /// What it does to the optimum of first order while the weights stay: the least that any bound counts.
    #[inline(always)]
    pub fn least(&self, target: Target, lambda: f64) -> f64 {
        target.dual_weighted(self.first[0], self.first[1], lambda)
    }

    /// Bound on what it does to the optimum. `None` where it decides about the weights, or, if that is to be looked at with care,
    /// is more than the planes' depths.
    #[inline(always)]
    pub fn bound(&self, target: Target, optimum: &Optimum, care: Care) -> Option<f64> {
        let (of_a, of_b) = (self.first[0] + self.second[0], self.first[1] + self.second[1]);
        let (change_a, change_b) = target.changes(of_a, of_b);
        let swing = larger(change_a, change_b) / optimum.rate(target).abs();
        let of_first = self.least(target, optimum.lambda);
        let of_all = target.dual_weighted(of_a, of_b, optimum.lambda);
        (swing < 0.25 && (care != Care::Careful || of_all <= DEEP * of_first)).then_some(of_all * (1.0 + 4.0 * swing))
    }

    /// The same where it decides. S is convex in where the planes lie, and so is the optimum: from below, what is of first
    /// order, with the weights at hand, is all. From above it is the whole of it at most, or what is left where the point
    /// follows the planes: a small, sharp body at a large one needs that. It takes time: where far more is left `open` by something
    /// else the whole will do, and that is told.
    #[cold]
    pub fn decisive(&self, here: &Expansion, bodies: [&Body; 2], target: Target, step: Step, open: f64) -> (f64, bool) {
        let lambda = step.optimum.lambda;
        let below = self.least(target, lambda);
        let whole = target.merit_rounding(self.first[0] + self.second[0], self.first[1] + self.second[1], lambda);
        if whole <= below {
            return (below, false);
        }
        if open > DEEP * whole {
            return (whole, true);
        }
        let floor = target.dual(step.optimum.values.0, step.optimum.values.1, lambda);
        let summed = target.merit_rounding(self.sums[0], self.sums[1], lambda);
        let ceiling = Ceiling { bodies, target, here }.lowest(step.v, lambda, floor, floor + (below - summed));
        let followed = (ceiling - floor).max(0.0) + summed;
        (whole.min(followed).max(below), false)
    }
}
