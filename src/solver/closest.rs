//! The two closest points P1 and P2 (paper eqs 3, 9, 34–43).
//!
//! Both lie on the dual path of midway, beyond its point P3: from there, or from the last call, one step along the
//! current quadratics is mostly enough for both at once, in two lanes ([`crate::model::dual_search::both_closest`]).
//! Else each is solved by itself.

use crate::bounds::point_bound::point_bound;
use crate::bounds::scale::Scale;
use crate::bounds::solution::Solution;
use crate::flags::Flags;
use crate::linalg::number::gamma;
use crate::model::dual_search;
use crate::model::local_model::{self, LocalModel};
use crate::model::problem::Problem;
use crate::pair::body::Body;
use crate::pair::pair_state::{How, Remembered};
use crate::settings::BackEnd;
use crate::solver::call::{Call, SolveError, Solved};
use crate::solver::newton;
use nalgebra::Vector3;

/// Largest factor by which a first guess changes λ. Chosen: beyond it the linear extrapolation of a guess says nothing.
const FAR: f64 = 20.0;

/// One of the closest points, with its bounds.
pub(crate) struct CertifiedPoint {
    pub x: Vector3<f64>,
    /// Ratio of weights λ = u/(1−u).
    pub lambda: f64,
    pub gradients: [Vector3<f64>; 2],
    pub gradient_norms: [f64; 2],
    /// S_A and S_B.
    pub values: [f64; 2],
    pub scale: Scale,
    /// Bound on the distance to the optimum.
    pub bound: f64,
}

impl Call<'_> {
    /// P1 and P2 from midway, near which they lie. `None` where a constraint is slack, or may be; which is flagged.
    #[inline(never)]
    pub fn closest(&mut self, midway: &Solved) -> Result<Option<[CertifiedPoint; 2]>, SolveError> {
        let Solved { solution, model } = midway;
        let lambdas = [towards(solution, Problem::OnA), towards(solution, Problem::OnB)];
        if let Some(both) = self.both(lambdas, model, |_| true) {
            return Ok(Some(both));
        }
        // A constraint that may be slack is treated as a slack one.
        let point = |call: &mut Self, problem| match call.closest_point(problem, Some(midway)) {
            Err(SolveError::Undecided { .. }) => Ok(None),
            found => found,
        };
        if let Some(p2) = point(self, Problem::OnB)? {
            if let Some(p1) = point(self, Problem::OnA)? {
                return Ok(Some([p1, p2]));
            }
        }
        self.flags.set(Flags::SLACK, true);
        Ok(None)
    }

    /// P1 and P2 from the current quadratics and the remembered factors, where one step is enough for both and either
    /// scale shows that the particles overlap: midway is then needed neither for that nor as a start.
    #[inline(never)]
    pub fn closest_from_memory(&mut self, last: &Remembered, model: &LocalModel) -> Option<[CertifiedPoint; 2]> {
        let [of_p1, of_p2] = from_between([model.q_a.expansion, model.q_b.expansion], last.lambda);
        let lambdas = [last.closest[0] * of_p1, last.closest[1] * of_p2];
        self.both(lambdas, model, |found| found.scale.s + found.scale.gap < 1.0)
    }

    /// P1 and P2 by one step from guesses of their λ, if both are accepted.
    #[inline(always)]
    fn both(
        &mut self,
        lambdas: [f64; 2],
        model: &LocalModel,
        will_do: impl Fn(&CertifiedPoint) -> bool,
    ) -> Option<[CertifiedPoint; 2]> {
        if self.back_end != BackEnd::Fast {
            return None;
        }
        let bodies = self.bodies();
        let soft = local_model::softest(bodies);
        let [p1, p2] = dual_search::both_closest([&model.q_a, &model.q_b], soft, lambdas)?;
        let on_a = newton::accepted(bodies, &self.goal(Problem::OnA), model, &model.step(bodies, p1))?;
        let on_b = newton::accepted(bodies, &self.goal(Problem::OnB), model, &model.step(bodies, p2))?;
        let points = [self.certified(Problem::OnA, &on_a, model), self.certified(Problem::OnB, &on_b, model)];
        if !points.iter().all(|found| !found.scale.may_be_zero() && will_do(found)) {
            return None;
        }
        self.count(&on_a);
        self.count(&on_b);
        Some(points)
    }

    /// One of the two points, or `None` where its constraint is slack: the optimum is then the other particle's minimum
    /// (for k > 0 its centre, for k = 0 any point of its core), not a contact point. Midway has no constraint.
    #[inline(never)]
    pub fn closest_point(
        &mut self,
        problem: Problem,
        midway: Option<&Solved>,
    ) -> Result<Option<CertifiedPoint>, SolveError> {
        if self.centre_is_inside(problem) {
            return Ok(None);
        }
        let (lambda, mut model) = match midway {
            Some(Solved { solution, model }) => (towards(solution, problem), **model),
            None => {
                let start = self.cold();
                (start.lambda, self.model(&start, problem))
            }
        };
        let Solved { solution, model } = self.solve(problem, lambda, &mut model)?;
        let found = self.certified(problem, &solution, model);
        let free = if problem == Problem::OnB { self.pair.a } else { self.pair.b };
        if free.sphericity() > 0.0 || !found.scale.may_be_zero() {
            return Ok(Some(found));
        }
        // Only in a core is s = 0; bounds that reach 1 do not decide.
        let Scale { low, high, .. } = found.scale;
        if high < 1.0 { Ok(None) } else { Err(SolveError::Undecided { low, high }) }
    }

    fn centre_is_inside(&self, problem: Problem) -> bool {
        let [a, b] = self.bodies();
        match problem {
            Problem::OnB => self.pair.b.potential(&self.pair.centre) < 0.0,
            _ => self.pair.a.potential(&a.local(&b.centre())) < 0.0,
        }
    }

    /// Flags points that are free to move along flat faces, where the part of P1 − P2 along the faces depends on the
    /// regularisation, and points that are farther apart along the surface than across it, as along faces that are
    /// nearly flat: their distance is no depth.
    pub fn flag_free(&mut self, points: &[CertifiedPoint; 2]) {
        let bodies = self.bodies();
        let is_plain = bodies.iter().any(|body| body.is_plain());
        self.flags.set(Flags::FREE, is_aslant(points) || !is_plain && is_free(bodies, points));
    }

    fn certified(&self, problem: Problem, solution: &Solution, model: &LocalModel) -> CertifiedPoint {
        let Solution { x, lambda, gradients, gradient_norms, values, .. } = *solution;
        let bound = point_bound(solution, model, self.bodies(), problem);
        CertifiedPoint { x, lambda, gradients, gradient_norms, values, scale: self.scale(solution, problem), bound }
    }
}

/// Whether P1 − P2 is longer along the surface at P1 than across it.
fn is_aslant([p1, p2]: &[CertifiedPoint; 2]) -> bool {
    let (across, way) = (p1.gradients[0].dot(&(p1.x - p2.x)), p1.x - p2.x);
    way.norm_squared() * p1.gradient_norms[0] * p1.gradient_norms[0] > 2.0 * across * across
}

/// Share of P1 − P2 along the faces above which P1 − P2 is longer by more than rounding. Chosen: the overlap changes by
/// its square.
const ALONG: f64 = 1e-6;

/// Rounding of a gradient, relative (estimated).
const OF_GRADIENT: f64 = gamma(64);

/// Whether P1 − P2 has a part along the level surfaces on which gradients change by the regularisation only.
fn is_free(bodies: [&Body; 2], [p1, p2]: &[CertifiedPoint; 2]) -> bool {
    let (normal, way) = (p1.gradients[0] / p1.gradient_norms[0], p1.x - p2.x);
    let along = way - way.dot(&normal) * normal;
    let length = along.norm();
    let is_flat = |i: usize| {
        let change = (p1.gradients[i] - p2.gradients[i]).dot(&along).abs();
        let sizes = p1.gradient_norms[i] + p2.gradient_norms[i];
        change <= 2.0 * bodies[i].surplus_curvature() * length * length + OF_GRADIENT * sizes * length
    };
    length > ALONG * way.norm() && is_flat(0) && is_flat(1)
}

/// The λ of a closest point, as seen from midway.
///
/// Where a single curvature decides along their common path, as for two spheres or two faces, 1/√S of the held body is
/// linear in the ratio μ of its weight to the other's: this is Newton's step to where it is 1.
fn towards(midway: &Solution, problem: Problem) -> f64 {
    let weights = Problem::Midway.weights(midway.lambda);
    let (rate_a, rate_b) = Problem::Midway.apart(0.0, -midway.rate, weights);
    let on_b = problem == Problem::OnB;
    // S and dS/d ln μ.
    let (value, rate) = if on_b { (midway.values[1], rate_b) } else { (midway.values[0], -rate_a) };
    let change = 1.0 + 2.0 * (1.0 - value.sqrt()) * value / rate;
    // Not for NaN, nor for a change beyond the range of the extrapolation.
    if !(change > 1.0 / FAR && change < FAR) {
        midway.lambda
    } else if on_b {
        midway.lambda * change
    } else {
        midway.lambda / change
    }
}

/// The λ of P1 and of P2 as seen from a point between them where S_A and S_B have these values, and the λ of midway.
///
/// Where a single curvature decides along the dual path, √S_A and √S_B are linear on it, with slopes whose ratio is λ.
/// With s_a, s_b for √S_A, √S_B here, √S_A at P2 is s_a + λ·(s_b − 1) and √S_B at P1 is s_b + (s_a − 1)/λ; their λ are
/// λ times the first, and λ over the second.
#[inline(always)]
fn from_between([value_a, value_b]: [f64; 2], lambda: f64) -> [f64; 2] {
    let (s_a, s_b) = (value_a.sqrt(), value_b.sqrt());
    [lambda / (s_b + (s_a - 1.0) / lambda), lambda * (s_a + lambda * (s_b - 1.0))]
}

/// Whether the particles overlap, by the scale that shows it best: s_A at P2 and s_B at P1 lie on the same side of 1,
/// but that of a large body lies nearer to 1.
pub(crate) fn is_overlap([p1, p2]: &[CertifiedPoint; 2]) -> bool {
    let from_1 = |point: &CertifiedPoint| (point.scale.s - 1.0) / point.scale.gap;
    let (of_p1, of_p2) = (from_1(p1), from_1(p2));
    if of_p1.abs() > of_p2.abs() { of_p1 < 0.0 } else { of_p2 < 0.0 }
}

/// What to remember of P1 and P2 with the place and λ of midway, where S_A and S_B have these values.
pub(crate) fn seen_from(midway: Remembered, values: [f64; 2], [p1, p2]: &[CertifiedPoint; 2]) -> Remembered {
    let [of_p1, of_p2] = from_between(values, midway.lambda);
    Remembered { closest: [p1.lambda / of_p1, p2.lambda / of_p2], ..midway }
}

/// What to remember of an overlapping pair from P1 and P2 alone: a point between them and a λ, both near those of
/// midway.
pub(crate) fn midway_between(points: &[CertifiedPoint; 2]) -> Remembered {
    let [p1, p2] = points;
    let square = (p1.lambda * p1.scale.s) * (p2.lambda / p2.scale.s);
    // On the way from one to the other S is the same quadratic.
    let way = p1.x - p2.x;
    let value = |i: usize| 0.5 * (p1.values[i] + p2.values[i]) - 0.125 * (p1.gradients[i] - p2.gradients[i]).dot(&way);
    let midway = Remembered { x: p2.x + 0.5 * way, lambda: square.sqrt(), how: How::Overlapping, closest: [1.0; 2] };
    seen_from(midway, [value(0), value(1)], points)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pair::pair::Pair;
    use crate::particle::particle::Particle;
    use crate::pose::Pose;
    use crate::settings::Settings;

    const RADII: [f64; 2] = [0.7, 1.6];

    /// s and λ of midway, P1 and P2 of balls of these radii at a distance d, on whose line of centres all lie.
    fn known(d: f64) -> [[f64; 2]; 3] {
        let [a, b] = RADII;
        let (at_p1, at_p2) = ((d - a) / b, (d - b) / a);
        [[d / (a + b), b / a], [at_p1, b / (a * at_p1)], [at_p2, at_p2 * b / a]]
    }

    #[test]
    fn between_balls_the_guesses_of_lambda_are_exact() {
        for d in [1.7, 2.0, 2.25] {
            let [[s, lambda], [_, of_p1], [_, of_p2]] = known(d);
            let guesses = from_between([s * s, s * s], lambda);
            assert!((guesses[0] / of_p1 - 1.0).abs() < 1e-13 && (guesses[1] / of_p2 - 1.0).abs() < 1e-13, "{d}");
        }
    }

    #[test]
    fn the_closest_points_of_balls_are_those_of_the_line_of_centres() {
        let [small, large] = RADII.map(|radius| Particle::sphere(radius).unwrap());
        for d in [1.7, 2.0, 2.25] {
            let (pose_a, pose_b) = (Pose::at([0.0, d, 0.0]).unwrap(), Pose::at([0.0; 3]).unwrap());
            let (pair, settings) = (Pair::new(&small, &pose_a, &large, &pose_b), Settings::default());
            let mut call = Call::new(&pair, &settings);
            let start = call.cold();
            let mut model = call.model(&start, Problem::Midway);
            let midway = call.solve(Problem::Midway, start.lambda, &mut model).unwrap();
            let [p1, p2] = call.closest(&midway).unwrap().unwrap();
            let [_, of_p1, of_p2] = known(d);
            for (point, y, [s, lambda]) in [(p1, d - RADII[0], of_p1), (p2, RADII[1], of_p2)] {
                assert!((point.x - Vector3::new(0.0, y, 0.0)).norm() <= point.bound, "{d}");
                assert!((point.scale.s - s).abs() <= point.scale.gap && (point.lambda / lambda - 1.0).abs() < 1e-12);
            }
        }
    }

    /// A small ball in the core of a cube of k = 0, beside its centre: all of the ball has S = 0 of the cube, and no
    /// point of it is the closest.
    #[test]
    fn a_body_inside_the_core_of_another_has_no_closest_point() {
        let (cube, ball) = (Particle::cube(0.4, 0.1, 0.0, 0.0), Particle::sphere(0.05).unwrap());
        let (pose_a, pose_b) = (Pose::at([0.0; 3]).unwrap(), Pose::at([0.2, 0.1, 0.0]).unwrap());
        let (pair, settings) = (Pair::new(&cube, &pose_a, &ball, &pose_b), Settings::default());
        assert!(Call::new(&pair, &settings).closest_point(Problem::OnB, None).unwrap().is_none());
        // With the ball's centre inside the cube, neither has the cube one nearest to the ball.
        assert!(Call::new(&pair, &settings).closest_point(Problem::OnA, None).unwrap().is_none());
    }
}
