//! How far the point of a solution can be from the optimum.

use crate::bounds::solution::Solution;
use crate::linalg::number::larger;
use crate::model::local_model::{self, LocalModel};
use crate::model::problem::{Problem, TURN};
use crate::pair::body::Body;

/// Units in the last place by which two sides that meet may still differ (estimated).
const SIDES: f64 = 8.0;

/// Bound on the distance from the point of a solution to the optimum, length.
///
/// Where the active set is certain, the optimum is that of known quadratics and only their data is in doubt: each plane's distance
/// by its rounding, each body's force a·∇S_A by the rounding of its direction. The answer of the optimum to each is
/// a linear problem that is solved already, and the lengths are added: an estimate of first order, with bounds on all data.
/// Elsewhere strong convexity bounds it: ½·curvature·(½·distance)² ≤ upper − lower.
#[inline(always)]
pub(crate) fn point_bound(solution: &Solution, model: &LocalModel, bodies: [&Body; 2], problem: Problem) -> f64 {
    if let Some(bound) = solution.point_bound {
        return bound;
    }
    // Carried along from the point of expansion, and rounded at the end.
    let step = solution.x - model.x;
    let length = step.norm();
    let carried = TURN * f64::EPSILON * (length + solution.x.norm());
    let Some(sensitivity) = solution.sensitivity.as_ref() else {
        return by_convexity(solution, bodies, problem) + carried;
    };
    let weights = problem.weights(solution.lambda);
    let in_axes = model.to_axes(&step);
    let turn = problem.turn() * f64::EPSILON * sensitivity.per_slope();
    let (mut sum, mut sides) = (sensitivity.unsolved(), [0.0; 2]);
    for (i, (q, weight)) in [(&model.q_a, weights.0), (&model.q_b, weights.1)].into_iter().enumerate() {
        let (shift, blur) = bodies[i].after(&model.points[i], length);
        let planes = sensitivity.to_planes(i, q.count, problem, solution.lambda, bodies[i].plane_weight());
        // The force, rounded at either end of the step.
        let force = weight * solution.force(problem, i, q);
        sum += shift + blur * planes + force * turn + sensitivity.to_sums(q, weight, q.terms(&in_axes));
        sides[i] =
            SIDES * f64::EPSILON * q.expansion + solution.sums[i] + bodies[i].sphere_slope(solution.values[i]) * shift;
    }
    // What is left of the mismatch, and the rounding of both sides. A shift of the sphere's centre enters S with its full slope
    // 2m|y|.
    let left = problem.mismatch(solution.values[0], solution.values[1]);
    let (side_a, side_b) = problem.changes(sides[0], sides[1]);
    sum += sensitivity.to_value(left + side_a + side_b + SIDES * f64::EPSILON * larger(solution.upper, 1.0));
    // Where both gradients vanish, the sensitivity has no digits; and where a plane may go off, the quadratics are others.
    let longest_normals = bodies.map(|body| body.particle.bounds.longest_normal);
    let holds = sum.is_finite() && sensitivity.holds_within(sum, longest_normals);
    if holds { sum + carried } else { by_convexity(solution, bodies, problem) + carried }
}

/// By strong convexity: what the bounds of the value leave.
///
/// The weighted sum has its minimum at some z, where it is at least `lower`; the point of the solution and the optimum both lie
/// where it is at most `upper`, so that either is within √(2·open/curvature) of z.
pub(crate) fn by_convexity(solution: &Solution, bodies: [&Body; 2], problem: Problem) -> f64 {
    let (weights, soft) = (problem.weights(solution.lambda), local_model::softest(bodies));
    farthest_apart(solution.duality_gap + 2.0 * solution.rounding, weights.0 * soft.0 + weights.1 * soft.1)
}

/// Bound on the distance of two points at which a function of this curvature at least is no more than so much above its minimum.
pub(crate) fn farthest_apart(above: f64, curvature: f64) -> f64 {
    2.0 * (2.0 * above / curvature).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pair::pair::Pair;
    use crate::particle::particle::Particle;
    use crate::pose::Pose;
    use nalgebra::Vector3;

    /// Two balls of radius 1: φ = ½|x − c|² + ½|x|² has its minimum half way. A point as far to one side of it as the optimum may lie
    /// to the other is twice as far from that as from the minimum.
    #[test]
    fn points_on_either_side_of_the_minimum_are_within_the_bound_by_convexity() {
        let ball = Particle::sphere(1.0).unwrap();
        let (pose_a, pose_b) = (Pose::at([1.0, 0.0, 0.0]).unwrap(), Pose::at([0.0; 3]).unwrap());
        let pair = Pair::new(&ball, &pose_a, &ball, &pose_b);
        let (a, b) = Body::both(&pair, 0.0);
        let side = 0.01;
        let points = [side, -side].map(|y| Vector3::new(0.5, y, 0.0));
        let level = a.value(&points[0]);
        let open = Solution { duality_gap: level - 0.25, rounding: 0.0, ..Solution::unsettled(points[0], 1.0, 0) };
        let bound = by_convexity(&open, [&a, &b], Problem::Midway);
        assert!(a.value(&points[1]) <= level && (points[0] - points[1]).norm() <= bound * (1.0 + 1e-12), "{bound}");
        assert!(bound <= 2.0 * side * (1.0 + 1e-9), "{bound}");
    }
}
