//! How far the point of a solution can be from the optimum.

use crate::bounds::sensitivity::Sensitivity;
use crate::bounds::solution::Solution;
use crate::linalg::number::{larger, smaller};
use crate::model::local_model::{self, LocalModel};
use crate::model::problem::{Problem, TURN};
use crate::pair::body::Body;
use nalgebra::Vector3;

/// Factor on the first-order move by the regularisation. Where both S are 0 without it, as for a ball whose centre lies
/// in a core, the point moves as its root: first order gives half of a small move, and a third of one by a third of the
/// way to the centre of the regularised body; for longer ones it gives nothing. Derived: with ρ of the way moved, a
/// move as the root has 2/(1 − ρ) times the first order.
const OF_ROOT: f64 = 3.0;
const LONGEST: f64 = 0.5;

/// Units in the last place by which two sides that meet may still differ (estimated).
const SIDES: f64 = 8.0;

/// Bound on the distance from the point of a solution to the optimum, length.
///
/// Where the active set is certain, the optimum is that of known quadratics and only their data is in doubt: each
/// plane's distance by its rounding, each body's force a·∇S_A by the rounding of its direction. The answer of the
/// optimum to each is a linear problem that is solved already, and the lengths are added: an estimate of first order,
/// with bounds on all data. Elsewhere strong convexity bounds it: ½·curvature·(½·distance)² ≤ upper − lower.
///
/// For regularised particles the optimum is that without the regularisation, the nearest one if it is not unique.
#[inline(always)]
pub(crate) fn point_bound(solution: &Solution, model: &LocalModel, bodies: [&Body; 2], problem: Problem) -> f64 {
    let bound = of_solved(solution, model, bodies, problem);
    if bodies[0].is_plain() && bodies[1].is_plain() { bound } else { of_given(bound, solution, model, bodies, problem) }
}

/// The same to the optimum that was solved for.
#[inline(always)]
fn of_solved(solution: &Solution, model: &LocalModel, bodies: [&Body; 2], problem: Problem) -> f64 {
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
    // What is left of the mismatch, and the rounding of both sides. A shift of the sphere's centre enters S with its
    // full slope 2m|y|.
    let left = problem.mismatch(solution.values[0], solution.values[1]);
    let (side_a, side_b) = problem.changes(sides[0], sides[1]);
    sum += sensitivity.to_value(left + side_a + side_b + SIDES * f64::EPSILON * larger(solution.upper, 1.0));
    // Where both gradients vanish, the sensitivity has no digits; and where a plane may go off, the quadratics are
    // others.
    let longest_normals = bodies.map(|body| body.particle.bounds.longest_normal);
    let holds = sum.is_finite() && sensitivity.holds_within(sum, longest_normals);
    if holds { sum + carried } else { by_convexity(solution, bodies, problem) + carried }
}

/// From the bound to the optimum that was solved for, with what the regularisation has moved that by.
#[inline(never)]
fn of_given(bound: f64, solution: &Solution, model: &LocalModel, bodies: [&Body; 2], problem: Problem) -> f64 {
    if solution.point_bound.is_some() {
        // Extended precision has counted it.
        return smaller(bound, farthest(solution, bodies, problem));
    }
    let Some(sensitivity) = solution.sensitivity.as_ref() else { return farthest(solution, bodies, problem) };
    let to_axes = |v: &Vector3<f64>| model.to_axes(v);
    let moved = Added::at(&solution.x, solution.lambda, bodies, problem, to_axes).moves(sensitivity, bound);
    if moved <= bound {
        return bound + moved;
    }
    let lengths = bodies.map(|body| body.particle.bounds.longest_normal);
    let way = moved + (solution.x - model.x).norm();
    let is_clear = [&model.q_a, &model.q_b].into_iter().zip(lengths).all(|(q, length)| way * length <= q.clear);
    let holds = is_clear && sensitivity.holds_within(moved, lengths);
    let farthest = farthest(solution, bodies, problem);
    if holds { smaller(bound + moved, farthest) } else { farthest }
}

/// What the regularisation adds to the conditions of the optimum: to the slope, to its curvature in all directions, and
/// to the mismatch.
pub(crate) struct Added {
    slope: Vector3<f64>,
    curvature: f64,
    value: f64,
    /// Square of the way to the nearer centre of the regularised bodies.
    square: f64,
}

impl Added {
    /// At a point, with the slope in the axes of the sensitivity.
    pub fn at(
        x: &Vector3<f64>,
        lambda: f64,
        bodies: [&Body; 2],
        problem: Problem,
        to_axes: impl Fn(&Vector3<f64>) -> Vector3<f64>,
    ) -> Self {
        let ((a, b), [of_a, of_b]) = (problem.weights(lambda), bodies);
        let (alpha, beta): (f64, f64) = problem.weight_rates();
        Self {
            slope: to_axes(&(a * of_a.surplus_gradient(x) + b * of_b.surplus_gradient(x))),
            curvature: a * of_a.surplus_curvature() + b * of_b.surplus_curvature(),
            value: (alpha * of_a.surplus(x) + beta * of_b.surplus(x)).abs(),
            square: smaller(of_a.regularised_square(x), of_b.regularised_square(x)),
        }
    }

    /// How far it moves the optimum, which is known to `bound`.
    ///
    /// Where it adds a share of the curvature, the move without that share grows by its geometric series. Along flat
    /// faces it is all of the curvature, and the slope is 0 where the point that it selects is an optimum without it,
    /// too.
    pub fn moves(&self, sensitivity: &Sensitivity, bound: f64) -> f64 {
        let first = sensitivity.to_slope(&self.slope);
        let (by_slope, by_value) = (first.norm(), sensitivity.to_value(self.value));
        if by_slope + by_value <= bound {
            return by_slope + by_value;
        }
        let again = self.curvature * sensitivity.to_slope(&first).norm();
        let share = if by_slope > 0.0 { again / by_slope } else { 0.0 };
        // Infinite, or not a number, where there is no other curvature.
        let moved = OF_ROOT * (by_slope + by_value) / (1.0 - share);
        if moved >= 0.0 && moved <= LONGEST * self.square.sqrt() { moved } else { f64::INFINITY }
    }
}

/// Bound on the distance to an optimum without regularisation, from where that can be: at the level of what was found
/// both in the ball of each shadow sphere and within its reach, and, by the curvature of the spheres, no farther than
/// the gap allows.
pub(crate) fn farthest(solution: &Solution, bodies: [&Body; 2], problem: Problem) -> f64 {
    let upper = larger(solution.upper, 0.0) + solution.rounding;
    let levels = match problem {
        Problem::OnB => [upper, 1.0],
        Problem::OnA => [1.0, upper],
        Problem::Midway | Problem::OnBoundary => [upper; 2],
    };
    let of_body = |i: usize| {
        let particle = bodies[i].particle;
        let of_sphere = (levels[i] / particle.sphere_weight).sqrt();
        let reach = particle.reach(larger(levels[i], 1.0));
        (solution.x - bodies[i].centre()).norm() + if of_sphere < reach { of_sphere } else { reach }
    };
    let (a, b) = problem.weights(solution.lambda);
    let [level_a, level_b] = problem.levels(solution.upper);
    let most = a * bodies[0].most_surplus(level_a) + b * bodies[1].most_surplus(level_b);
    let own = 2.0 * (a * bodies[0].particle.sphere_weight + b * bodies[1].particle.sphere_weight);
    let by_convexity = farthest_apart(solution.duality_gap + 2.0 * solution.rounding + most, own);
    smaller(smaller(of_body(0), of_body(1)), by_convexity)
}

/// By strong convexity: what the bounds of the value leave.
///
/// The weighted sum has its minimum at some z, where it is at least `lower`; the point of the solution and the optimum
/// both lie where it is at most `upper`, so that either is within √(2·open/curvature) of z.
pub(crate) fn by_convexity(solution: &Solution, bodies: [&Body; 2], problem: Problem) -> f64 {
    let (weights, soft) = (problem.weights(solution.lambda), local_model::softest(bodies));
    farthest_apart(solution.duality_gap + 2.0 * solution.rounding, weights.0 * soft.0 + weights.1 * soft.1)
}

/// Bound on the distance of two points where a function of at least this curvature exceeds its minimum by at most
/// `above`.
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

    /// Two balls of radius 1: φ = ½|x − c|² + ½|x|² has its minimum half way. A point as far to one side of it as the
    /// optimum may lie to the other is twice as far from that as from the minimum.
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
