//! What the rounding of S_A and S_B does to the optimum.
//!
//! The distances to the planes carry an error proportional to the lengths they are made from; times the pull 2(1−k)/r²
//! Σ⟨n_i·x − d_i⟩ of the planes it is that of S. To first order it moves the optimum by its weighted sum, as long as it
//! leaves the weights where they are.

use crate::linalg::number::{larger, smaller};
use crate::model::dual_path::Optimum;
use crate::model::local_model::{LocalModel, Step};
use crate::model::problem::Problem;
use crate::pair::body::Body;
use crate::particle::potential::Quadratic;
use nalgebra::Vector3;

/// Largest change of ln λ by rounding at which the weights count as unmoved; the bound is raised by four times as much.
/// Estimated (docs/theory.md, 4.7).
const UNMOVED: f64 = 0.02;

/// Bound on the rounding of the sums in a slope, relative to the root of the terms of S times the curvature: γ with
/// n = 2·(17 + count) for sums over so many planes (docs/theory.md, "Rounding").
#[inline(always)]
pub(crate) fn sums(count: u32) -> f64 {
    (17.0 + f64::from(count)) * f64::EPSILON
}

/// Bounds on the rounding of S_A and S_B at the end of a step.
#[derive(Clone, Copy)]
pub(crate) struct Rounding {
    /// In all.
    all: [f64; 2],
    /// Second-order term of the displacement of the point that it induces.
    by_curvature: [f64; 2],
    /// Of the sums alone.
    pub sums: [f64; 2],
}

impl Rounding {
    /// After a step to where ∇S_A and ∇S_B are as long as `gradients`.
    #[inline(always)]
    pub fn after(model: &LocalModel, bodies: [&Body; 2], problem: Problem, step: &Step, gradients: [f64; 2]) -> Self {
        let (mut all, mut sums, mut blurs) = ([0.0; 2], [0.0; 2], [0.0; 2]);
        let values = [step.optimum.values.0, step.optimum.values.1];
        for (i, q) in [&model.q_a, &model.q_b].into_iter().enumerate() {
            let (body, point, check) = (bodies[i], &model.points[i], &step.checks[i]);
            let (shift, blur) = body.after(point, step.length);
            // The last term: the step adds to the blur of the depths at the point of expansion, too.
            let of_places = check.pull * blur + gradients[i] * shift + q.pull * (blur - point.blur);
            sums[i] = body.rounding_of_value(values[i], q.count) + of_sums(q, &step.optimum);
            let of_second_order = body.second_order(check.near, shift, blur);
            all[i] = of_places + sums[i] + of_second_order;
            blurs[i] = blur;
        }
        let by_curvature = by_curvature(bodies, problem, step, [all, gradients, blurs]);
        Self { all, by_curvature, sums }
    }

    /// Bound on what it does to the optimum; `None` where it moves the weights.
    #[inline(always)]
    pub fn of_optimum(&self, problem: Problem, optimum: &Optimum) -> Option<f64> {
        let [of_a, of_b] = self.all;
        let (change_a, change_b) = problem.changes(of_a, of_b);
        let swing = larger(change_a, change_b) / optimum.rate(problem).abs();
        let [more_a, more_b] = self.by_curvature;
        let bound = problem.weighted(of_a + more_a, of_b + more_b, optimum.lambda) * (1.0 + 4.0 * swing);
        // Midway the point may as well stay where it is.
        let bound = if problem == Problem::Midway { smaller(bound, larger(of_a, of_b)) } else { bound };
        (swing < UNMOVED).then_some(bound)
    }

    /// Bound on the rounding of the merit of the point, whatever the weights do.
    #[cold]
    pub fn of_merit(&self, problem: Problem, lambda: f64) -> f64 {
        problem.merit_rounding(self.all[0], self.all[1], lambda)
    }
}

/// Second-order terms of S_A and S_B for the displacement induced by `rounding`: against the gradient of the side that
/// is too high, of length rounding over slope. Inactive planes that may switch within that length and their blur count
/// as well.
#[inline(always)]
fn by_curvature(
    bodies: [&Body; 2],
    problem: Problem,
    step: &Step,
    [rounding, gradients, blurs]: [[f64; 2]; 3],
) -> [f64; 2] {
    let (high_a, high_b) = problem.changes(rounding[0], rounding[1]);
    let (fall_a, fall_b) = problem.changes(gradients[0], gradients[1]);
    // NaN where gradients and rounding are both 0: no displacement.
    let way = larger((high_a + high_b) / (fall_a + fall_b), 0.0);
    [0, 1].map(|i| {
        let (body, check, blur) = (bodies[i], &step.checks[i], blurs[i]);
        let moved = body.particle.bounds.longest_normal * way;
        let near = if blur + moved <= check.clear { check.near } else { body.particle.plane_count() as f64 };
        // w(2·blur + moved)², less the second order of the blur.
        near * body.plane_weight() * moved * (4.0 * blur + moved)
    })
}

/// Bound on the rounding of the sums by which S of one body is taken along the step.
#[inline]
pub(crate) fn of_sums(q: &Quadratic, optimum: &Optimum) -> f64 {
    q.rounding_after(q.terms(&optimum.step))
}

/// Bound on the rounding of the sums by which the slope of one body was made to vanish, in whatever direction.
#[inline]
pub(crate) fn of_slope(q: &Quadratic, step: &Vector3<f64>) -> f64 {
    sums(q.count) * (q.terms(step) * q.hessian.trace()).sqrt()
}
