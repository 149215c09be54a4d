//! Where a search ended, and how far that can be from the optimum.

use crate::bounds::dual_bound::DualBound;
use crate::bounds::rounding::Rounding;
use crate::bounds::scale::INCONCLUSIVE;
use crate::bounds::sensitivity::Sensitivity;
use crate::linalg::number::{UNKNOWN_VECTOR, larger, smaller};
use crate::model::kkt_check::Change;
use crate::model::local_model::{self, LocalModel, Start, Step};
use crate::model::problem::Problem;
use crate::pair::body::Body;
use crate::pair::local_point::LocalPoint;
use crate::particle::potential::Quadratic;
use nalgebra::Vector3;

/// Where a solver ended; everything in the solver's frame, potentials as regularised.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Solution {
    pub x: Vector3<f64>,
    pub lambda: f64,
    /// ∇S_A and ∇S_B at the optimum, and their lengths.
    pub gradients: [Vector3<f64>; 2],
    pub gradient_norms: [f64; 2],
    /// On a boundary, whose quadratics leave a part of them out: sums of those lengths at both ends of the last step.
    pub forces: [f64; 2],
    /// S_A and S_B at x: midway equal but for rounding; closest, that of the held body 1 but for rounding.
    pub values: [f64; 2],
    /// Best estimate of the optimal S.
    pub estimate: f64,
    /// Bound on the residual of the weighted gradient, rounding included.
    pub slope: f64,
    /// How steeply S falls from a part of a boundary into the rest of it, where that came with the solution.
    pub inward_descent: Option<f64>,
    /// Lower bound up to `rounding`.
    pub lower: f64,
    /// Upper bound up to `rounding`.
    pub upper: f64,
    /// The difference of both, which may be less than they are rounded by.
    pub duality_gap: f64,
    /// Bound on the rounding of both.
    pub rounding: f64,
    /// Whether rounding moves λ by so little that `rounding` holds to first order.
    pub linear: bool,
    pub iterations: u32,
    pub ending: Ending,
    /// Rate of the mismatch with ln λ, where known; else 0.
    pub rate: f64,
    /// How the optimum answers to changes of its data, where it is that of known quadratics.
    pub sensitivity: Option<Sensitivity>,
    /// Bounds on the rounding of the sums for S_A and S_B.
    pub sums: [f64; 2],
    /// Bound on the distance of x to the optimum, where it came with the solution.
    pub point_bound: Option<f64>,
}

/// Why a solver stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ending {
    /// The bounds meet within the tolerance.
    Converged,
    /// The bounds meet within rounding, which is more than the tolerance.
    RoundingLimited,
    /// The lower bound exceeds 1, which was enough.
    Separated,
    /// None of these: there is no solution, or its bounds are too wide.
    Unsettled,
}

impl Solution {
    /// Of a search that has found nothing but where it ended.
    pub fn unsettled(x: Vector3<f64>, lambda: f64, iterations: u32) -> Self {
        Self {
            x,
            lambda,
            gradients: [UNKNOWN_VECTOR; 2],
            gradient_norms: [f64::NAN; 2],
            forces: [f64::NAN; 2],
            values: [f64::NAN; 2],
            estimate: f64::NAN,
            slope: f64::INFINITY,
            inward_descent: None,
            lower: f64::NEG_INFINITY,
            upper: f64::INFINITY,
            duality_gap: f64::INFINITY,
            rounding: f64::INFINITY,
            linear: false,
            iterations,
            ending: Ending::Unsettled,
            rate: 0.0,
            sensitivity: None,
            sums: [f64::INFINITY; 2],
            point_bound: None,
        }
    }

    /// The optimum that a step leads to, with its bounds.
    #[inline(always)]
    pub fn of(model: &LocalModel, bodies: [&Body; 2], problem: Problem, step: &Step) -> Self {
        let (optimum, lambda) = (&step.optimum, step.optimum.lambda);
        let (s_a, s_b) = optimum.values;
        let estimate = problem.dual(s_a, s_b, lambda);
        let upper = match step.change {
            Change::None => problem.merit(s_a, s_b, lambda),
            _ => model.merit(problem, lambda),
        };
        let (gradients, forces) = if problem == Problem::OnBoundary {
            model.gradients_on_boundary(bodies, &step.v)
        } else {
            ([model.to_solver(&optimum.gradients[0]), model.to_solver(&optimum.gradients[1])], [f64::NAN; 2])
        };
        let gradient_norms = [gradients[0].norm(), gradients[1].norm()];
        let rounding = Rounding::after(model, bodies, problem, step, gradient_norms);
        let of_optimum = rounding.of_optimum(problem, optimum);
        let force = problem.weighted(gradient_norms[0], gradient_norms[1], lambda);
        let DualBound { slope, height, certain } = DualBound::after(model, bodies, problem, step, (upper, force));
        let pushes = [step.checks[0].least_push, step.checks[1].least_push];
        let soft = local_model::softest(bodies);
        let dimensions = local_model::dimensions(bodies);
        let sensitivity = if certain { Sensitivity::of(optimum, problem, soft, pushes, dimensions) } else { None };
        Self {
            x: model.x + step.v,
            lambda,
            gradients,
            gradient_norms,
            forces,
            values: [s_a, s_b],
            estimate,
            slope,
            inward_descent: None,
            lower: estimate - height,
            upper,
            duality_gap: larger(upper - estimate, 0.0) + height,
            rounding: of_optimum.unwrap_or_else(|| rounding.of_merit(problem, lambda)),
            linear: of_optimum.is_some(),
            iterations: 0,
            ending: Ending::Unsettled,
            rate: optimum.rate(problem),
            sensitivity,
            sums: rounding.sums,
            point_bound: None,
        }
    }

    /// Where another search goes on from here.
    pub fn start(&self) -> Start {
        Start { x: self.x, lambda: self.lambda }
    }

    /// The lengths of ∇S of a body at both ends of the last step together, which began with this quadratic.
    #[inline(always)]
    pub fn force(&self, problem: Problem, body: usize, q: &Quadratic) -> f64 {
        if problem == Problem::OnBoundary { self.forces[body] } else { self.gradient_norms[body] + q.gradient.norm() }
    }

    /// Whether the optimum provably exceeds 1 without what a regularisation adds, `flat` at most.
    #[inline]
    pub fn separates(&self, flat: f64) -> bool {
        self.lower - self.rounding - flat > 1.0
    }

    /// Least effect of rounding on the optimum: the weighted change of S when each body moves by the rounding of a
    /// length.
    #[inline(always)]
    pub fn least_rounding(&self, bodies: [&Body; 2], model: &LocalModel, problem: Problem) -> f64 {
        // How far rounding moves the planes of the longest normal. At most twice the shift, since their offsets are
        // rounded less than the point; without planes 0/0, which is not smaller.
        let place = |i: usize| {
            let LocalPoint { blur, shift, .. } = model.points[i];
            smaller(blur / bodies[i].particle.bounds.longest_normal, 2.0 * shift)
        };
        let of = |i: usize| place(i) * self.gradient_norms[i];
        problem.weighted(of(0), of(1), self.lambda)
    }

    /// Whether so much is open of S, beside what a regularisation adds, that it may be no answer.
    pub fn is_inconclusive(duality_gap: f64, upper: f64) -> bool {
        !(duality_gap <= INCONCLUSIVE * larger(upper, 1.0))
    }

    /// Bound on the error of the optimal S.
    #[inline]
    pub fn gap(&self) -> f64 {
        self.upper - self.lower + self.rounding
    }
}
