//! Both potentials as quadratics at a point, and the step to their optimum.

use crate::linalg::graded_basis::{self, StiffNormals};
use crate::linalg::number::{larger, smaller};
use crate::model::dual_path::Optimum;
use crate::model::dual_search::{DualSearch, side};
use crate::model::kkt_check::{CLEAR, Change, KktCheck};
use crate::model::problem::Problem;
use crate::pair::body::Body;
use crate::pair::local_point::LocalPoint;
use crate::particle::potential::Quadratic;
use nalgebra::{Matrix3, Vector3};

/// In which axes the quadratics are summed and factored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Axes {
    /// The axes of B.
    OfB,
    /// Aligned with the stiffest planes of each point whose active planes leave a soft direction; else the axes of B.
    Graded,
    /// On a boundary: one axis for each coordinate of its points.
    OfBoundary(usize),
    /// On a boundary, aligned with the planes that are stiffest along it.
    GradedOnBoundary(usize),
}

/// Ratio of plane to sphere curvature above which the axes of B may lose a soft direction: its relative error is the
/// ratio times 1e-16, and a Newton step is still worth its cost at 1e-8 or so. Where planes resist in all directions,
/// as at a corner, there is no soft one ([`crate::linalg::symmetric::Symmetric::least_eigenvalue`]). Measured: without
/// graded axes nearly polyhedral bodies take 17 to 20 times as long.
const GRADED_FROM: f64 = 1e7;

/// S up to which a point is so near the surface that a quadratic from there has all its digits on the surface. Chosen:
/// S − 1 loses two bits at most.
const NEAR_SURFACE: f64 = 4.0;

/// Where to begin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Start {
    pub x: Vector3<f64>,
    /// Ratio of weights λ = u/(1−u).
    pub lambda: f64,
}

/// Both quadratics at a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LocalModel {
    pub x: Vector3<f64>,
    /// Axes of the quadratics (columns, in the solver's frame), if not the solver's own.
    axes: Option<Matrix3<f64>>,
    pub points: [LocalPoint; 2],
    pub q_a: Quadratic,
    pub q_b: Quadratic,
}

impl Axes {
    /// The axes that the shapes of a pair call for.
    pub fn of([a, b]: [&Body; 2]) -> Self {
        let is_boundary = b.particle.is_boundary();
        let stiff = larger(a.stiffest_curvature(), b.stiffest_curvature());
        let soft = if is_boundary { a.sphere_curvature() } else { smaller(a.sphere_curvature(), b.sphere_curvature()) };
        match (stiff <= GRADED_FROM * soft, is_boundary) {
            (true, false) => Self::OfB,
            (false, false) => Self::Graded,
            (true, true) => Self::OfBoundary(b.particle.dimensions),
            (false, true) => Self::GradedOnBoundary(b.particle.dimensions),
        }
    }
}

impl Axes {
    /// Those of a boundary, if it is one. The others are columns of zeros: so the quadratics have neither slope nor
    /// planes across it, and no step leads off it.
    #[inline(always)]
    fn on_boundary(self, bodies: [&Body; 2], points: &[LocalPoint; 2]) -> Option<Matrix3<f64>> {
        match self {
            Self::OfB | Self::Graded => None,
            Self::OfBoundary(dimensions) => Some(graded_basis::first(dimensions)),
            Self::GradedOnBoundary(dimensions) => {
                Some(graded_basis::aligned(&ActiveNormals { bodies, points, weights: (1.0, 0.0) }, dimensions))
            }
        }
    }
}

/// Bounding radius of the smaller body.
#[inline(always)]
pub(crate) fn smallest([a, b]: [&Body; 2]) -> f64 {
    smaller(a.particle.bounding_radius(), b.particle.bounding_radius())
}

/// The number of coordinates in which a point may move.
#[inline(always)]
pub(crate) fn dimensions([a, b]: [&Body; 2]) -> usize {
    a.particle.dimensions.min(b.particle.dimensions)
}

/// Least curvatures of A and B in any direction.
pub(crate) fn softest([a, b]: [&Body; 2]) -> (f64, f64) {
    (a.sphere_curvature(), b.sphere_curvature())
}

/// Bound on the distance from x to any optimum of a value of at most `upper`: it lies in both level sets.
pub(crate) fn farthest([a, b]: [&Body; 2], x: &Vector3<f64>, upper: f64) -> f64 {
    let of = |body: &Body| (x - body.centre()).norm() + body.particle.reach(upper);
    smaller(of(a), of(b))
}

impl LocalModel {
    /// Where a search begins.
    #[inline(always)]
    pub fn at(bodies: [&Body; 2], start: &Start, problem: Problem, axes: Axes) -> Self {
        let points = bodies.map(|body| body.locate(&start.x));
        Self::of(bodies, start.x, points, problem.weights(start.lambda), axes)
    }

    /// At a point with its active sets. The stiffest planes are those of the sum with these weights.
    #[inline(always)]
    pub fn of(bodies: [&Body; 2], x: Vector3<f64>, points: [LocalPoint; 2], weights: (f64, f64), axes: Axes) -> Self {
        let own = axes.on_boundary(bodies, &points);
        let q_a = bodies[0].at(&points[0], own.as_ref());
        let q_b = if own.is_some() { Quadratic::ZERO } else { bodies[1].at(&points[1], None) };
        let mut model = Self { x, axes: own, points, q_a, q_b };
        if axes == Axes::Graded && model.has_soft_direction(bodies, weights) {
            model.grade(bodies, weights);
        }
        model
    }

    /// ∇S_A and ∇S_B after a step on a boundary, solver's frame, with what they have across it, which the quadratics
    /// leave out; and the sums of their lengths where the step begins and ends.
    #[inline(never)]
    pub fn gradients_on_boundary(&self, bodies: [&Body; 2], v: &Vector3<f64>) -> ([Vector3<f64>; 2], [f64; 2]) {
        let whole = bodies[0].at(&self.points[0], None);
        let gradient = whole.gradient + whole.hessian.times(v);
        ([gradient, Vector3::zeros()], [whole.gradient.norm() + gradient.norm(), 0.0])
    }

    /// Whether the planes of the sum with these weights leave a direction without resistance, or nearly, which the
    /// spheres of the sum do not hold either: one of them may do for both.
    fn has_soft_direction(&self, bodies: [&Body; 2], (a, b): (f64, f64)) -> bool {
        let h = self.q_a.hessian.weighted(a, &self.q_b.hessian, b);
        let soft = softest(bodies);
        // Written so that what is not a number is graded.
        let held = h.trace() <= GRADED_FROM * (a * soft.0 + b * soft.1);
        !held && h.least_eigenvalue(h.determinant(&h.adjugate())) == 0.0
    }

    /// Takes the quadratics in axes aligned with the stiffest planes of that sum instead.
    #[inline(never)]
    fn grade(&mut self, bodies: [&Body; 2], weights: (f64, f64)) {
        let axes = graded_basis::aligned(&ActiveNormals { bodies, points: &self.points, weights }, 3);
        self.q_a = bodies[0].at(&self.points[0], Some(&axes));
        self.q_b = bodies[1].at(&self.points[1], Some(&axes));
        self.axes = Some(axes);
    }

    /// Whether the axes of the quadratics are the solver's own.
    pub fn in_solver_axes(&self) -> bool {
        self.axes.is_none()
    }

    /// A direction of the solver's frame in the axes of the quadratics.
    pub fn to_axes(&self, v: &Vector3<f64>) -> Vector3<f64> {
        self.axes.map_or(*v, |axes| axes.tr_mul(v))
    }

    /// A direction of the axes of the quadratics in the solver's frame.
    #[inline]
    pub fn to_solver(&self, v: &Vector3<f64>) -> Vector3<f64> {
        match &self.axes {
            Some(axes) => axes * v,
            None => *v,
        }
    }

    /// The particles' own S_A and S_B along a vector of the solver's frame, from the point x on.
    #[inline]
    pub fn pieces(&self, bodies: [&Body; 2], x: &Vector3<f64>, n: &Vector3<f64>) -> [Piece; 2] {
        let (n, moved) = (self.to_axes(n), (x - self.x).norm());
        let piece = |body: &Body, q: &Quadratic| {
            let exact = q.expansion <= NEAR_SURFACE;
            let clear = if exact { q.clear / body.particle.bounds.longest_normal - moved } else { 0.0 };
            let piece =
                Piece { curvature: q.hessian.times(&n).dot(&n), validity_radius: CLEAR * clear, ..Piece::default() };
            if body.is_plain() {
                return piece;
            }
            // n in either axes has the same length.
            let curvature = piece.curvature - body.surplus_curvature() * n.norm_squared();
            Piece { curvature, surplus: body.surplus(x), surplus_gradient: body.surplus_gradient(x), ..piece }
        };
        [piece(bodies[0], &self.q_a), piece(bodies[1], &self.q_b)]
    }

    /// The merit of the point: an upper bound of the optimum.
    pub fn merit(&self, problem: Problem, lambda: f64) -> f64 {
        problem.merit(self.q_a.value, self.q_b.value, lambda)
    }

    /// Bound on its rounding.
    pub fn merit_rounding(&self, [a, b]: [&Body; 2], problem: Problem, lambda: f64) -> f64 {
        let (of_a, of_b) = (a.rounding(&self.points[0], &self.q_a), b.rounding(&self.points[1], &self.q_b));
        problem.merit_rounding(of_a, of_b, lambda)
    }

    /// Both quadratics, to be solved.
    #[inline(always)]
    pub fn quadratics(&self, bodies: [&Body; 2], problem: Problem) -> DualSearch<'_> {
        let soft = softest(bodies);
        DualSearch::new(side(&self.q_a, soft.0), side(&self.q_b, soft.1), problem)
    }

    /// The step to the optimum of both quadratics, sought from a guess of λ.
    #[inline]
    pub fn optimum(&self, bodies: [&Body; 2], problem: Problem, guess: f64) -> Option<Step> {
        Some(self.step(bodies, self.quadratics(bodies, problem).solve(guess)?))
    }

    /// The step to an optimum, with its KKT check.
    #[inline(always)]
    pub fn step(&self, [a, b]: [&Body; 2], optimum: Optimum) -> Step {
        let v = self.to_solver(&optimum.step);
        let length = v.norm();
        let checks = [
            KktCheck::after(a, &self.points[0], &self.q_a, &v, length),
            KktCheck::after(b, &self.points[1], &self.q_b, &v, length),
        ];
        Step { optimum, v, length, checks, change: checks[0].change.max(checks[1].change) }
    }

    /// The same point without the planes that pulled after a step.
    pub fn without_leaving(&self, bodies: [&Body; 2], step: &Step, weights: (f64, f64), axes: Axes) -> Self {
        let mut points = self.points;
        for (point, check) in points.iter_mut().zip(&step.checks) {
            if let Some(place) = check.drop {
                point.drop(place);
            }
        }
        Self::of(bodies, self.x, points, weights, axes)
    }
}

/// The active planes of both bodies.
struct ActiveNormals<'a> {
    bodies: [&'a Body<'a>; 2],
    points: &'a [LocalPoint; 2],
    weights: (f64, f64),
}

impl StiffNormals for ActiveNormals<'_> {
    #[inline(always)]
    fn visit(&self, mut visit: impl FnMut(Vector3<f64>, f64)) {
        for (i, weight) in [self.weights.0, self.weights.1].into_iter().enumerate() {
            let curvature = weight * self.bodies[i].plane_curvature();
            self.bodies[i].active_normals(&self.points[i], |n| visit(n, curvature));
        }
    }
}

/// A potential along a vector, as the particle has it: without what the regularisation adds.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Piece {
    /// Second derivative along the vector, which has no unit; 1/length².
    pub curvature: f64,
    /// What the regularisation adds where the line begins, and its gradient there, solver's frame.
    pub surplus: f64,
    pub surplus_gradient: Vector3<f64>,
    /// Distance either way within which no plane switches, length.
    pub validity_radius: f64,
}

/// A step to the optimum of the quadratics at a point.
#[derive(Clone, Copy)]
pub(crate) struct Step {
    pub optimum: Optimum,
    /// The step in the solver's frame, and its length.
    pub v: Vector3<f64>,
    pub length: f64,
    pub checks: [KktCheck; 2],
    /// The worse of the two.
    pub change: Change,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pair::pair::Pair;
    use crate::particle::particle::Particle;
    use crate::pose::Pose;

    /// In axes of B and in graded ones the quadratics are S and its gradient at the point.
    #[test]
    fn both_axes_give_the_same_quadratics() {
        let cube = Particle::cube(0.4, 0.1, 0.02, 0.9);
        let (pose_a, pose_b) =
            (Pose::new([0.7, 0.4, 0.3], [0.9, 0.3, -0.2, 0.5]).unwrap(), Pose::at([0.0; 3]).unwrap());
        let pair = Pair::new(&cube, &pose_a, &cube, &pose_b);
        let (a, b) = Body::both(&pair, 0.0);
        let bodies = [&a, &b];
        let start = Start { x: Vector3::new(0.45, 0.2, 0.1), lambda: 1.0 };
        let plain = LocalModel::at(bodies, &start, Problem::Midway, Axes::OfB);
        let mut graded = plain;
        graded.grade(bodies, (0.5, 0.5));
        assert!(plain.in_solver_axes() && !graded.in_solver_axes());
        for (i, body) in bodies.into_iter().enumerate() {
            let [p, q] = [&plain, &graded].map(|model| if i == 0 { model.q_a } else { model.q_b });
            assert!((p.value - body.value(&start.x)).abs() < 1e-14 * p.value);
            assert!((p.gradient - graded.to_solver(&q.gradient)).norm() < 1e-13 * p.gradient.norm());
            let e = Vector3::new(0.3, -0.8, 0.2);
            let h = 1e-6;
            let slope = (body.value(&(start.x + h * e)) - body.value(&(start.x - h * e))) / (2.0 * h);
            assert!((slope - p.gradient.dot(&e)).abs() < 1e-7 * p.gradient.norm(), "{slope}");
            let (of_p, of_q) =
                (p.hessian.times(&e).dot(&e), q.hessian.times(&graded.to_axes(&e)).dot(&graded.to_axes(&e)));
            assert!((of_p - of_q).abs() < 1e-12 * of_p);
        }
    }

    /// The planes of a corner resist in all directions, that of a face in one.
    #[test]
    fn a_soft_direction_is_seen() {
        let cube = Particle::cube(0.4, 1e-6, 1e-9, 0.9);
        let pose = Pose::at([0.0; 3]).unwrap();
        let pair = Pair::new(&cube, &pose, &cube, &pose);
        let (a, b) = Body::both(&pair, 0.0);
        assert_eq!(Axes::of([&a, &b]), Axes::Graded);
        for (x, soft) in [([0.41, 0.41, 0.41], false), ([0.41, 0.0, 0.0], true), ([0.41, 0.41, 0.0], true)] {
            let start = Start { x: x.into(), lambda: 1.0 };
            let model = LocalModel::at([&a, &b], &start, Problem::Midway, Axes::Graded);
            assert_eq!(model.in_solver_axes(), !soft, "{x:?}");
        }
    }
}
