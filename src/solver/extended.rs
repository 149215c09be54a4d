//! The extended tier: the same problem in numbers of 32 digits, by a method that converges from any start.
//!
//! For a fixed ratio of weights λ the sum φ = a·S_A + b·S_B is strictly convex, continuously differentiable and
//! piecewise quadratic: Newton's method with an exact line search ends at its minimum. Along the minima one side of the
//! problem grows with λ and the other falls, so that λ is bracketed; from each minimum the dual path of its quadratics
//! leads to the next λ, and if the active set is unchanged there, that is the optimum.
//!
//! The bounds need no active set: with the depths of the last point as multipliers, the dual value less half the square
//! of the slope over the curvature of the spheres is a lower bound, and the merit of the point an upper one.

use crate::bounds::point_bound::{self, Added};
use crate::bounds::sensitivity::Sensitivity;
use crate::bounds::solution::{Ending, Solution};
use crate::linalg::double_double::DoubleDouble;
use crate::linalg::graded_basis::{self, StiffNormals};
use crate::linalg::line::Line;
use crate::linalg::number::{Number, Single, larger, smaller};
use crate::linalg::root::{Bracket, MOST_STEPS};
use crate::linalg::symmetric::{Factor, Symmetric};
use crate::linalg::wide::{Wide, rounded, wide};
use crate::model::dual_path::{Optimum, Side};
use crate::model::dual_search::DualSearch;
use crate::model::local_model::{self, Start};
use crate::model::problem::Problem;
use crate::pair::body::Body;
use crate::pair::extended_body::{DEPTH_AFTER, ExtendedBody, Undecided, WideQuadratic, WideValue};
use crate::pair::pair::{Given, Pair};
use crate::solver::newton::{self, Goal};
use nalgebra::{Matrix3, Vector3};

/// Most values of λ. Chosen: the bounds do not assume convergence.
const MOST_WEIGHTS: u32 = 60;

/// Reach of the first planes about the start, in radii of the smaller particle; a solution farther away is solved again
/// about itself (chosen).
const FIRST_REACH: f64 = 0.05;

/// Factor by which λ moves while only one end of its bracket is known, at most. Chosen: ten strides span λ from 1 to
/// either end of `LAMBDA_RANGE`.
const STRIDE: f64 = 1e3;

/// Share of the bracket of ln λ that a value of λ from the dual path has to leave at each end, after two that did not
/// halve it. Chosen: any share below ½ bounds the number of steps.
const INSIDE: f64 = 0.1;

/// Both bodies about the start.
struct Extended<'a> {
    bodies: [ExtendedBody<'a>; 2],
    problem: Problem,
    x: Vector3<f64>,
    /// The number of coordinates in which a point may move.
    dimensions: usize,
    /// Distance of the origin from the centre that a point of a boundary is placed from.
    placed_from: f64,
    /// Quadratics made so far.
    steps: u32,
}

/// Both quadratics at x₀ + δ in graded axes.
struct WideModel {
    /// How planes count whose depth is 0 to rounding.
    undecided: Undecided,
    axes: Matrix3<f64>,
    sides: [WideQuadratic; 2],
    /// Bounds on the least curvatures from below.
    soft: [DoubleDouble; 2],
}

/// Where a search ended.
struct Found {
    delta: Wide,
    lambda: DoubleDouble,
    /// The optimum of its quadratics, where their active set is right, and their axes.
    optimum: Option<(Optimum<DoubleDouble>, Matrix3<f64>)>,
}

/// The values of λ between which that of the optimum lies, halved where the dual path narrows them too slowly.
struct SafeguardedBracket {
    ends: Bracket,
    /// Values of λ in a row that did not halve the logarithm of high/low.
    slow: u32,
}

impl SafeguardedBracket {
    fn new() -> Self {
        Self { ends: Bracket { low: 0.0, high: f64::INFINITY }, slow: 0 }
    }

    /// The next λ. At the last one the side that grows with λ was too large or too small, and the dual path leads to
    /// `wanted`. `None` where the bracket has no double inside.
    fn next(&mut self, lambda: f64, too_large: bool, wanted: DoubleDouble) -> Option<DoubleDouble> {
        let width = (self.ends.high / self.ends.low).ln();
        self.ends.narrow(lambda, too_large);
        let Bracket { low, high } = self.ends;
        let proposed = wanted.rounded();
        let next = if low > 0.0 && high < f64::INFINITY {
            self.slow = if (high / low).ln() > 0.5 * width { self.slow + 1 } else { 0 };
            let margin = if self.slow > 1 { (high / low).powf(INSIDE) } else { 1.0 };
            let inside = low * margin < proposed && proposed < high / margin;
            if inside { wanted } else { DoubleDouble::from((low * high).sqrt()) }
        } else if high < f64::INFINITY {
            DoubleDouble::from(if proposed < high { proposed.max(high / STRIDE) } else { high / STRIDE })
        } else {
            DoubleDouble::from(if proposed > low { proposed.min(low * STRIDE) } else { low * STRIDE })
        };
        self.ends.contains(next.rounded()).then_some(next)
    }
}

/// Solves for the goal from a start.
pub(crate) fn solve(pair: &Pair, bodies: [&Body; 2], goal: &Goal, start: &Start) -> Solution {
    let solution = solve_about(pair, bodies, goal, start);
    let is_far = (solution.x - start.x).norm() > FIRST_REACH * local_model::smallest(bodies);
    if solution.ending != Ending::RoundingLimited || !is_far {
        return solution;
    }
    // Depths about a far point have lost digits that those about the solution have.
    let nearer = solve_about(pair, bodies, goal, &solution.start());
    let best = if nearer.gap() < solution.gap() { nearer } else { solution };
    Solution { iterations: solution.iterations + nearer.iterations, ..best }
}

/// The same with all depths taken about the start.
fn solve_about(pair: &Pair, bodies: [&Body; 2], goal: &Goal, start: &Start) -> Solution {
    let mut extended = Extended {
        bodies: ExtendedBody::both(pair, bodies, &start.x),
        problem: goal.problem,
        x: start.x,
        dimensions: local_model::dimensions(bodies),
        placed_from: if pair.b.is_boundary() { pair.centre.norm() } else { 0.0 },
        steps: 0,
    };
    let first = FIRST_REACH * local_model::smallest(bodies);
    extended.bodies.iter_mut().for_each(|body| body.cover(first));
    let found = extended.search(DoubleDouble::from(start.lambda));
    let solution = extended.bounded(&found, &pair.given);
    let point_bound = extended.point_bound(&found, &solution, bodies);
    Solution { ending: ending(&solution, bodies, goal), point_bound: Some(point_bound), ..solution }
}

/// Why the search ended, by the bounds of its solution.
fn ending(solution: &Solution, bodies: [&Body; 2], goal: &Goal) -> Ending {
    let gap = solution.gap();
    match () {
        () if !gap.is_finite() => Ending::Unsettled,
        () if goal.stop_when_separated && solution.separates(newton::max_regularisation_error(bodies)) => {
            Ending::Separated
        }
        () if gap <= goal.tolerance * solution.upper => Ending::Converged,
        () => Ending::RoundingLimited,
    }
}

impl Extended<'_> {
    fn search(&mut self, first: DoubleDouble) -> Found {
        let mut found = Found { delta: wide(&Vector3::zeros()), lambda: first, optimum: None };
        // The active set at the start may be that of the optimum.
        let model = self.model(&found.delta, Undecided::BySign, first);
        let at_once = model.quadratics(self.problem).solve(first);
        if let Some(accepted) = at_once.and_then(|optimum| self.accepted(&found.delta, &model, optimum)) {
            return accepted;
        }
        let (mut bracket, mut lambda) = (SafeguardedBracket::new(), first);
        for round in 0..MOST_WEIGHTS {
            let mut delta = found.delta;
            let Some((last, v)) = self.minimise(&mut delta, lambda) else {
                // The minimum of the λ before bounds the optimum; of the first λ there is none, and the point that the
                // steps reached does.
                if round == 0 {
                    found.delta = delta;
                }
                break;
            };
            found = Found { delta: delta + v, lambda, optimum: None };
            // The quadratics are those of the last step, but about another point.
            let model = self.model(&found.delta, last.undecided, lambda);
            if self.is_slack(&model) {
                break;
            }
            let Some(optimum) = model.quadratics(self.problem).solve(lambda) else { break };
            let wanted = optimum.lambda;
            // By rounding a plane may have switched in the step: then the quadratics are those before it.
            let accepted = self.accepted(&found.delta, &model, optimum).or_else(|| {
                let optimum = last.quadratics(self.problem).solve(lambda)?;
                self.accepted(&delta, &last, optimum)
            });
            if let Some(accepted) = accepted {
                return accepted;
            }
            if self.problem == Problem::OnBoundary {
                break;
            }
            let (growing, falling) = self.problem.sides(model.sides[0].value.rounded(), model.sides[1].value.rounded());
            let Some(next) = bracket.next(lambda.rounded(), growing > falling, wanted) else { break };
            lambda = next;
        }
        found
    }

    /// Whether the point lies in the held body and in the core of the free one (k = 0), where S is at most the
    /// regularisation. The minimum of S is then 0, and the minimiser of the regularised S adds nothing.
    fn is_slack(&self, model: &WideModel) -> bool {
        let Some((held, free)) = self.problem.held() else { return false };
        let [value_of_held, value] = [held, free].map(|i| model.sides[i].value.rounded());
        self.bodies[free].may_be_all_regularisation(value) && value_of_held < 1.0
    }

    /// The optimum of a model about x₀ + δ, if the active set is the same there.
    fn accepted(&mut self, delta: &Wide, model: &WideModel, optimum: Optimum<DoubleDouble>) -> Option<Found> {
        let v = model.to_solver(&optimum.step);
        let same = optimum.settled && self.keeps_active_sets(delta, model.undecided, &v);
        same.then(|| Found { delta: delta + v, lambda: optimum.lambda, optimum: Some((optimum, model.axes)) })
    }

    fn keeps_active_sets(&mut self, delta: &Wide, undecided: Undecided, v: &Wide) -> bool {
        let reach = rounded(delta).norm() + rounded(v).norm();
        // Both, since a line search along v needs the planes on the way.
        self.bodies.iter_mut().for_each(|body| body.cover(reach));
        self.bodies.iter().all(|body| body.keeps_active_set(delta, undecided, v))
    }

    /// Moves δ to where one step leads to the minimum of a·S_A + b·S_B, by Newton's method with an exact line search:
    /// the quadratics there and the step, or `None` where all steps do not suffice or a number leaves its range.
    fn minimise(&mut self, delta: &mut Wide, lambda: DoubleDouble) -> Option<(WideModel, Wide)> {
        let (a, b) = self.problem.weights(lambda);
        let mut undecided = Undecided::BySign;
        for _ in 0..MOST_STEPS {
            let model = self.model(delta, undecided, lambda);
            let [q_a, q_b] = &model.sides;
            let hessian = q_a.hessian.weighted(a, &q_b.hessian, b);
            let soft = a * model.soft[0] + b * model.soft[1];
            let factor = Factor::of(&hessian, soft)?;
            let gradient = q_a.gradient * a + q_b.gradient * b;
            let step = -factor.solve(&gradient);
            let v = model.to_solver(&step);
            if !rounded(&v).iter().all(|c| c.is_finite()) {
                return None;
            }
            if self.keeps_active_sets(delta, undecided, &v) {
                return Some((model, v));
            }
            let alpha = self.best_step(delta, &v, [a, b], gradient.dot(&step));
            if alpha.rounded() * rounded(&v).norm() > DoubleDouble::UNIT * rounded(delta).norm() {
                *delta += v * alpha;
                undecided = Undecided::BySign;
            } else if undecided == Undecided::BySign {
                // The step has length 0: a plane of zero depth counts as off but is on along it.
                undecided = Undecided::On;
                self.bodies.iter_mut().for_each(|body| body.restore());
            } else if !self.drop_most_negative(delta, &v) {
                return Some((model, wide(&Vector3::zeros())));
            }
        }
        None
    }

    /// Leaves out the undecided plane with the most negative multiplier after a step; whether there is one.
    fn drop_most_negative(&mut self, delta: &Wide, v: &Wide) -> bool {
        let [of_a, of_b] = [0, 1].map(|i| self.bodies[i].most_negative(delta, v));
        let pull = |found: Option<(usize, f64)>| found.map_or(0.0, |(_, pull)| pull);
        let i = usize::from(pull(of_b) > pull(of_a));
        let Some((place, _)) = [of_a, of_b][i] else { return false };
        self.bodies[i].drop(place);
        true
    }

    /// α at which a·S_A + b·S_B, with this slope at α = 0, is least along v.
    fn best_step(&mut self, delta: &Wide, v: &Wide, weights: [DoubleDouble; 2], slope: DoubleDouble) -> DoubleDouble {
        let least = |bodies: &[ExtendedBody; 2]| {
            let mut line = Line::new(slope);
            bodies.iter().zip(weights).for_each(|(body, weight)| body.add_to_line(&mut line, delta, v, weight));
            line.least()
        };
        let alpha = least(&self.bodies);
        // Planes farther away may shorten the step.
        let reach = rounded(delta).norm() + alpha.rounded() * rounded(v).norm();
        if self.bodies.iter().all(|body| body.covers(reach)) {
            return alpha;
        }
        self.bodies.iter_mut().for_each(|body| body.cover(reach));
        least(&self.bodies)
    }

    fn model(&mut self, delta: &Wide, undecided: Undecided, lambda: DoubleDouble) -> WideModel {
        self.steps += 1;
        let reach = rounded(delta).norm();
        self.bodies.iter_mut().for_each(|body| body.cover(reach));
        let (a, b) = self.problem.weights(lambda.rounded());
        let normals = ActiveNormals { bodies: &self.bodies, delta, undecided, weights: [a, b] };
        let axes = graded_basis::aligned(&normals, self.dimensions);
        // Doubles are orthonormal to rounding only; the metric says by how much they are off.
        let mut metric = Symmetric::default();
        for i in 0..3 {
            metric.add_square(&wide(&axes.row(i).transpose()));
        }
        let sides = [0, 1].map(|i| self.bodies[i].quadratic(delta, undecided, &axes, &metric));
        let soft = [0, 1].map(|i| DoubleDouble::from(LESS * self.bodies[i].soft()));
        WideModel { undecided, axes, sides, soft }
    }

    /// The slope that the optimum of the quadratics has, by multipliers that are negative by rounding at most.
    fn slope_of_model(&self, optimum: &Optimum<DoubleDouble>, (a, b): (f64, f64)) -> f64 {
        let stiffest = a * self.bodies[0].stiffest() + b * self.bodies[1].stiffest();
        let left = rounded(&optimum.slope(self.problem)).norm();
        left + DEPTH_AFTER * DoubleDouble::UNIT * stiffest * rounded(&optimum.step).norm()
    }

    /// The solution where a search ended, with the bounds of its value.
    fn bounded(&mut self, Found { delta, lambda, optimum }: &Found, given: &Given) -> Solution {
        let (problem, weights) = (self.problem, self.problem.weights(*lambda));
        let values = [self.bodies[0].value(delta), self.bodies[1].value(delta)];
        let [of_a, of_b] = &values;
        let (a, b) = (weights.0.rounded(), weights.1.rounded());
        // Rounded after the sum: a step from afar is rounded by more than the point.
        let x = rounded(&(wide(&self.x) + delta));
        let dual = problem.dual(of_a.value, of_b.value, *lambda);
        let upper = self.upper(delta, &values);
        let error = values.map(|of| of.rounding());
        let inward_descent = match given {
            Given::Boundary(placed) => placed.wide_descent(&of_a.gradient),
            Given::Poses(_) => None,
        };
        let slope = rounded(&(of_a.gradient * weights.0 + of_b.gradient * weights.1)).rows(0, self.dimensions).norm();
        // Where the places of 32 digits are too coarse for the forces to balance, those of the quadratics still do.
        let slope = optimum.as_ref().map_or(slope, |(optimum, _)| smaller(slope, self.slope_of_model(optimum, (a, b))));
        let slope = slope + a * of_a.turn + b * of_b.turn;
        let height = 0.5 * slope * slope / (LESS * (a * self.bodies[0].soft() + b * self.bodies[1].soft()));
        // The difference is taken before it is rounded.
        let above = larger((upper - dual).rounded(), 0.0);
        let (estimate, gradients) = (dual.rounded(), values.map(|of| rounded(&of.gradient)));
        Solution {
            gradients,
            gradient_norms: gradients.map(|g| g.norm()),
            values: values.map(|of| of.value.rounded()),
            estimate,
            slope,
            inward_descent,
            lower: estimate - height,
            upper: estimate + above,
            duality_gap: above + height,
            rounding: larger(problem.weighted(error[0], error[1], lambda.rounded()), larger(error[0], error[1])),
            linear: true,
            rate: optimum.as_ref().map_or(0.0, |(optimum, _)| approximate(optimum).rate(problem)),
            ..Solution::unsettled(x, lambda.rounded(), self.steps)
        }
    }

    /// The merit of the point or, if it lies outside the held body, of one towards that body's centre. S of that body
    /// is convex: a share of the way covers its rounding, along which the other S rises by at most its slope and
    /// curvature.
    fn upper(&mut self, delta: &Wide, values: &[WideValue; 2]) -> DoubleDouble {
        let Some((held, free)) = self.problem.held() else { return values[0].value.larger(values[1].value) };
        let one = DoubleDouble::from(1.0);
        let to_centre = self.bodies[held].to_centre(delta);
        let way =
            2.0 * values[held].rounding() / (1.0 - self.bodies[held].value_at_centre()) * rounded(&to_centre).norm();
        let stiffest = self.bodies[free].stiffest();
        let rise = |from: &WideValue| way * (rounded(&from.gradient).norm() + 0.5 * way * stiffest);
        if values[held].value.is_at_most(one) {
            return values[free].value + DoubleDouble::from(rise(&values[free]));
        }
        self.bodies.iter_mut().for_each(|body| body.cover(rounded(delta).norm() + rounded(&to_centre).norm()));
        let s0 = self.bodies[held].value(&(*delta + to_centre)).value.sqrt();
        let s = values[held].value.sqrt();
        // √S is convex on that way.
        let share = (s - one) / (s - s0);
        let inside = *delta + to_centre * share;
        let inside = self.bodies[free].value(&inside);
        values[free].value.larger(inside.value) + DoubleDouble::from(rise(&inside))
    }

    /// Bound on the distance of the point to the optimum: by strong convexity, or by its sensitivity to the data where
    /// that is less.
    fn point_bound(&self, found: &Found, solution: &Solution, bodies: [&Body; 2]) -> f64 {
        let by_convexity = point_bound::by_convexity(solution, bodies, self.problem);
        let by_sensitivity = found.optimum.as_ref().and_then(|(optimum, axes)| {
            let to_axes = |v: &Vector3<f64>| axes.tr_mul(v);
            let added = Added::at(&solution.x, solution.lambda, bodies, self.problem, to_axes);
            self.by_sensitivity(&approximate(optimum), &found.delta, &added)
        });
        let is_plain = bodies.iter().all(|body| body.is_plain());
        let by_convexity = if is_plain { by_convexity } else { point_bound::farthest(solution, bodies, self.problem) };
        // A point of a boundary is placed from the centre of the particle.
        let placed = PLACED * f64::EPSILON * (solution.x.norm() + self.placed_from);
        by_sensitivity.map_or(by_convexity, |bound| smaller(bound, by_convexity)) + placed
    }

    /// The bound by sensitivity, where the active set is certain.
    fn by_sensitivity(&self, optimum: &Optimum, delta: &Wide, added: &Added) -> Option<f64> {
        let values = [self.bodies[0].value(delta), self.bodies[1].value(delta)];
        let soft = (self.bodies[0].soft(), self.bodies[1].soft());
        // Whether planes still push is seen below, once it is known how far the point may move.
        let sensitivity = Sensitivity::of(optimum, self.problem, soft, [f64::INFINITY; 2], self.dimensions)?;
        let (a, b) = self.problem.weights(optimum.lambda);
        let (mut sum, mut sides) = (sensitivity.unsolved(), [0.0; 2]);
        for (i, (of, weight)) in values.iter().zip([a, b]).enumerate() {
            let body = &self.bodies[i];
            let planes = sensitivity.to_planes(i, of.count, self.problem, optimum.lambda, body.plane_weight());
            sum += body.shift(delta) + of.blur * planes + weight * of.turn * sensitivity.per_slope();
            sides[i] = of.rounding();
        }
        let left = self.problem.mismatch(values[0].value, values[1].value).approximate();
        let (side_a, side_b) = self.problem.changes(sides[0], sides[1]);
        sum += sensitivity.to_value(left + side_a + side_b);
        sum += added.moves(&sensitivity, sum);
        // The active set is certain if no plane switches within the bound.
        let switches = (0..2).any(|i| values[i].clear <= values[i].blur + self.bodies[i].longest_normal() * sum);
        (sum.is_finite() && !switches).then_some(sum)
    }
}

/// Bound, in units of ε, on the rounding of a point to doubles and on its way to the world (docs/theory.md,
/// "Rounding"). Derived: 12.
const PLACED: f64 = 16.0;

/// Factor below 1 by which axes that are orthonormal to rounding may lower a curvature (derived: about 1e-14).
const LESS: f64 = 1.0 - 1e-12;

impl WideModel {
    fn quadratics(&self, problem: Problem) -> DualSearch<'_, DoubleDouble> {
        let side = |i: usize| {
            let WideQuadratic { value, gradient, hessian } = &self.sides[i];
            Side { value: *value, gradient, hessian, soft: self.soft[i] }
        };
        DualSearch::new(side(0), side(1), problem)
    }

    /// A step in the graded axes in the solver's frame.
    fn to_solver(&self, v: &Wide) -> Wide {
        let row = |i: usize| v.x * self.axes[(i, 0)] + v.y * self.axes[(i, 1)] + v.z * self.axes[(i, 2)];
        Vector3::new(row(0), row(1), row(2))
    }
}

/// The active planes of both bodies.
struct ActiveNormals<'a> {
    bodies: &'a [ExtendedBody<'a>; 2],
    delta: &'a Wide,
    undecided: Undecided,
    weights: [f64; 2],
}

impl StiffNormals for ActiveNormals<'_> {
    fn visit(&self, mut visit: impl FnMut(Vector3<f64>, f64)) {
        for (body, weight) in self.bodies.iter().zip(self.weights) {
            let curvature = 2.0 * weight * body.plane_weight();
            body.active_normals(self.delta, self.undecided, |n| visit(n, curvature));
        }
    }
}

/// An optimum in doubles, for bounds.
fn approximate(optimum: &Optimum<DoubleDouble>) -> Optimum {
    let scalar = DoubleDouble::rounded;
    Optimum {
        step: rounded(&optimum.step),
        gradients: [rounded(&optimum.gradients[0]), rounded(&optimum.gradients[1])],
        values: (scalar(optimum.values.0), scalar(optimum.values.1)),
        lambda: scalar(optimum.lambda),
        settled: optimum.settled,
        factor: optimum.factor.map(scalar),
        factored: scalar(optimum.factored),
        along: rounded(&optimum.along),
        mismatch_rate: scalar(optimum.mismatch_rate),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particle::particle::Particle;
    use crate::pose::Pose;

    /// λ proposed just beyond one end each time: the other end would stay where it is.
    #[test]
    fn a_bracket_shrinks_whatever_is_proposed() {
        for root in [7.3, 1e-9, 4e12] {
            let (mut bracket, mut lambda, mut steps) = (SafeguardedBracket::new(), DoubleDouble::from(1.0), 0);
            while bracket.ends.high > (1.0 + 1e-12) * bracket.ends.low {
                let proposed = DoubleDouble::from(bracket.ends.low.max(1e-300) * (1.0 + 1e-15));
                match bracket.next(lambda.rounded(), lambda.rounded() > root, proposed) {
                    Some(next) => lambda = next,
                    None => break,
                }
                steps += 1;
                assert!(bracket.ends.low <= root && root < bracket.ends.high && steps < 500, "{:?}", bracket.ends);
            }
        }
    }

    /// Balls of radii 1 and 3, whose centres are 2 apart: s = ½, λ = 3, and P3 is 1.5 from the centre of B. The doubles
    /// given are exact.
    #[test]
    fn balls_are_solved_to_the_last_digit() {
        let (small, large) = (Particle::sphere(1.0).unwrap(), Particle::sphere(3.0).unwrap());
        let (pose_a, pose_b) = (Pose::at([0.0, 2.0, 0.0]).unwrap(), Pose::at([0.0; 3]).unwrap());
        let pair = Pair::new(&small, &pose_a, &large, &pose_b);
        let (a, b) = Body::both(&pair, 0.0);
        let goal = Goal { problem: Problem::Midway, tolerance: 1e-15, stop_when_separated: false };
        let start = Start { x: Vector3::new(0.3, 0.2, -0.4), lambda: 0.01 };
        let found = solve(&pair, [&a, &b], &goal, &start);
        assert_eq!(found.ending, Ending::Converged);
        assert!((found.estimate - 0.25).abs() <= f64::EPSILON && found.gap() < f64::EPSILON, "{found:?}");
        assert!((found.lambda - 3.0).abs() < 1e-15 * 3.0);
        let off = (found.x - Vector3::new(0.0, 1.5, 0.0)).norm();
        assert!(off <= found.point_bound.unwrap() && found.point_bound.unwrap() < 1e-13, "{found:?}");
    }
}
