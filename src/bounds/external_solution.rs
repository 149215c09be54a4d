//! Bounds for a point and a scale s that another solver found.

use crate::bounds::dual_bound::DualBound;
use crate::bounds::rounding::{of_slope, of_sums};
use crate::bounds::solution::{Ending, Solution};
use crate::linalg::number::larger;
use crate::model::kkt_check::Change;
use crate::model::local_model::{self, Axes, LocalModel, Start};
use crate::model::problem::{Problem, TURN};
use crate::pair::body::Body;
use nalgebra::Vector3;

/// The solution at x with the ratio of weights λ that came with it.
///
/// Two dual bounds are tried: the local model's where its multipliers are admissible, and the
/// linear one, φ(x) − |∇φ|·D, for any optimum within a distance D of x.
pub(crate) fn external_solution(
    x: &Vector3<f64>,
    lambda: f64,
    s: f64,
    bodies: [&Body; 2],
    problem: Problem,
) -> Solution {
    let start = Start { x: *x, lambda };
    let plain = LocalModel::at(bodies, &start, problem, Axes::OfB);
    let values = [plain.q_a.value, plain.q_b.value];
    let gradients = [plain.q_a.gradient, plain.q_b.gradient];
    let upper = feasible(x, values, bodies, problem);
    let of = |i: usize, q| bodies[i].rounding(&plain.points[i], q);
    let rounding = problem.weighted(of(0, &plain.q_a), of(1, &plain.q_b), lambda);
    let weights = problem.weights(lambda);
    // Away from the optimum a|∇S_A| may be nearly all of the sum, not half of it: TURN is doubled.
    let force = problem.weighted(gradients[0].norm(), gradients[1].norm(), lambda);
    let sums = [&plain.q_a, &plain.q_b].map(|q| of_slope(q, &Vector3::zeros()));
    let doubt = 2.0 * TURN * f64::EPSILON * force + problem.weighted(sums[0], sums[1], lambda);
    let slope = (weights.0 * gradients[0] + weights.1 * gradients[1]).norm() + doubt;
    let linear = problem.dual(values[0], values[1], lambda) - slope * local_model::farthest(bodies, x, upper);
    let by_model = dual_value(bodies, &start, problem, upper).unwrap_or(f64::NEG_INFINITY);
    Solution {
        gradients,
        gradient_norms: gradients.map(|g| g.norm()),
        values,
        estimate: s * s,
        lower: linear.max(by_model),
        upper,
        duality_gap: larger(upper - linear.max(by_model), 0.0),
        rounding,
        ending: Ending::Converged,
        ..Solution::unsettled(*x, lambda, 0)
    }
}

/// The dual value of the local model at its own optimal λ, sought from the given one, less its
/// rounding. Planes that are wrongly in the active set are dropped one by one, as in the solver.
fn dual_value(bodies: [&Body; 2], start: &Start, problem: Problem, upper: f64) -> Option<f64> {
    let weights = problem.weights(start.lambda);
    let mut model = LocalModel::at(bodies, start, problem, Axes::Graded);
    loop {
        let step = model.optimum(bodies, problem, start.lambda)?;
        match step.change {
            Change::Pulling => return None,
            Change::Leaving => model = model.without_leaving(bodies, &step, weights, Axes::Graded),
            Change::None | Change::Entering => {
                let (optimum, lambda) = (&step.optimum, step.optimum.lambda);
                let (of_a, of_b) = (of_sums(&model.q_a, optimum), of_sums(&model.q_b, optimum));
                let value = problem.dual(optimum.values.0, optimum.values.1, lambda);
                let force = problem.weighted(optimum.gradients[0].norm(), optimum.gradients[1].norm(), lambda);
                let bound = DualBound::after(&model, bodies, problem, &step, (upper, force));
                return Some(value - bound.height - problem.weighted(of_a, of_b, lambda));
            }
        }
    }
}

/// The merit of x, or of a point on the way to the centre of the body that x should be in and is not: λ may be wrong,
/// and with it the penalty. s is convex on that way.
fn feasible(x: &Vector3<f64>, values: [f64; 2], bodies: [&Body; 2], problem: Problem) -> f64 {
    let Some((held, free)) = problem.held() else { return values[0].max(values[1]) };
    let (s, centre) = (values[held].sqrt(), bodies[held].centre());
    if s <= 1.0 {
        return values[free];
    }
    let s0 = bodies[held].value(&centre).sqrt();
    let share = (1.0 - s0) / (s - s0);
    values[free].max(bodies[free].value(&(centre + share * (x - centre))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pair::pair::Pair;
    use crate::pair::scattered;
    use crate::particle::particle::Particle;
    use crate::pose::Pose;

    /// Balls of radii 1 and 2 at a distance of 2.4: s = 0.8 midway, 0.4 on B and 0.7 on A, whatever point and λ are
    /// given.
    #[test]
    fn the_bounds_of_any_point_hold_the_optimum() {
        let balls = [1.0, 2.0].map(|radius| Particle::sphere(radius).unwrap());
        let (pose_a, pose_b) = (Pose::at([0.0, 0.0, 2.4]).unwrap(), Pose::at([0.0; 3]).unwrap());
        let pair = Pair::new(&balls[0], &pose_a, &balls[1], &pose_b);
        let (a, b) = Body::both(&pair, 0.0);
        for seed in 0..300 {
            let mut chance = scattered(10 * seed);
            let x = Vector3::new(0.0, 0.0, 1.6)
                + 0.1_f64.powi((seed % 7) as i32) * Vector3::<f64>::from_fn(|_, _| chance());
            for (problem, s) in [(Problem::Midway, 0.8), (Problem::OnB, 0.4), (Problem::OnA, 0.7)] {
                let found = external_solution(&x, 2.0 * f64::exp(3.0 * chance()), s, [&a, &b], problem);
                let (low, high) = (found.lower - found.rounding, found.upper + found.rounding);
                assert!(low <= s * s && s * s <= high, "{problem:?} at {x:?}: {low}, {high}");
            }
        }
    }
}
