//! How far the dual value after a step may lie above a lower bound of the optimum.
//!
//! With depths p ≥ 0 as multipliers, ⟨t⟩² ≥ 2pt − p² makes of S_A and S_B functions that are linear in the planes;
//! their weighted sum has the curvature of the spheres, so that it falls below its value at a point by at most half the
//! square of the slope there over that curvature. The slope is what the solution has left of a·∇S_A + b·∇S_B, the
//! rounding of that sum, and what planes contribute whose depth is negative by rounding and is taken as 0.

use crate::bounds::rounding;
use crate::linalg::number::smaller;
use crate::model::local_model::{self, LocalModel, Step};
use crate::model::problem::Problem;
use crate::pair::body::Body;

/// The gap of the dual value after a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DualBound {
    /// The slope that is left, with all that is in doubt about it.
    pub slope: f64,
    /// How far the dual value may lie above a lower bound.
    pub height: f64,
    /// Whether each active plane pushes by more than the slope that is in doubt, and none but they can be on: then the
    /// active set is that of the optimum.
    pub certain: bool,
}

impl DualBound {
    /// After a step to where ∇S_A and ∇S_B, weighted, have the length `force`. The optimum lies in {S ≤ `upper`}: if
    /// the spheres have little curvature, the slope times the way to its far end is the smaller bound.
    #[inline(always)]
    pub fn after(
        model: &LocalModel,
        bodies: [&Body; 2],
        problem: Problem,
        step: &Step,
        (upper, force): (f64, f64),
    ) -> Self {
        let ((a, b), soft) = (problem.weights(step.optimum.lambda), local_model::softest(bodies));
        let [check_a, check_b] = &step.checks;
        let optimum = &step.optimum;
        let rounding =
            a * rounding::of_slope(&model.q_a, &optimum.step) + b * rounding::of_slope(&model.q_b, &optimum.step);
        let doubtful = check_a.doubtful_slope(bodies[0], a, rounding) + check_b.doubtful_slope(bodies[1], b, rounding);
        // Forces balance to the rounding of their directions and of their sums only.
        let turned = problem.turn() * f64::EPSILON * force;
        let slope = optimum.slope(problem).norm() + rounding + doubtful + turned;
        let by_curvature = 0.5 * slope * slope / (a * soft.0 + b * soft.1);
        let height = smaller(slope * local_model::farthest(bodies, &(model.x + step.v), upper), by_curvature);
        let certain = doubtful == 0.0
            && !check_a.near_inactive
            && !check_b.near_inactive
            && check_a.pushes_more(bodies[0], a, turned)
            && check_b.pushes_more(bodies[1], b, turned);
        Self { slope, height, certain }
    }
}
