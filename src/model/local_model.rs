//! Both quadratics at a point, and the step to their optimum.

use crate::linalg::number::{larger, smaller};
use crate::model::dual_path::Optimum;
use crate::model::graded_basis;
use crate::model::kkt_check::{Planes, Verdict};
use crate::model::problem::Target;
use crate::model::quadratic_model::Model;
use crate::pair::active_set::{Local, Place};
use crate::pair::placed_particle::Body;
use crate::particle::potential::Quadratic;
use nalgebra::{Matrix3, Vector3};

/// How the quadratics are factored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Factorisation {
    /// In the axes of B.
    Plain,
    /// In axes aligned with the stiffest planes, chosen anew at each point.
    Aligned,
}

/// Ratio of plane to sphere curvature above which plain axes lose the soft direction: its relative error
/// is the ratio times 1e-16, and a Newton step is still worth its cost at 1e-8 or so.
const PLAIN_STIFFNESS: f64 = 1e7;

/// Where to begin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Start {
    pub x: Vector3<f64>,
    /// Ratio of weights λ = u/(1−u).
    pub lambda: f64,
    /// Whether the planes on at x are likely those of the optimum, as from memory or a neighbouring problem.
    pub near: bool,
}

/// Units in the last place by which a rotated normal may be turned.
pub(crate) const TURN: f64 = 4.0;

/// S up to which a point is so near the surface that a quadratic from there has all its digits on the surface.
const NEARBY: f64 = 4.0;

/// Both quadratics at a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Expansion {
    pub x: Vector3<f64>,
    /// Axes of the quadratics (columns, in the solver's frame), if not the solver's own.
    axes: Option<Matrix3<f64>>,
    pub locals: [Local; 2],
    pub q_a: Quadratic,
    pub q_b: Quadratic,
    /// Weights of the planes in them, where the safe solver made them lower than they are.
    pub softened: Option<[f64; 2]>,
    /// Whether the planes in them are those of an anchor, on after a step from here, and not those of the locals.
    pub anchored: bool,
}

/// The factorisation that the shapes of a pair call for.
pub(crate) fn factorisation(a: &Body, b: &Body) -> Factorisation {
    let stiff = larger(a.plane_curvature(), b.plane_curvature());
    let soft = smaller(a.sphere_curvature(), b.sphere_curvature());
    if stiff <= PLAIN_STIFFNESS * soft { Factorisation::Plain } else { Factorisation::Aligned }
}

/// Bounding radius of the smaller body.
#[inline(always)]
pub(crate) fn smallest([a, b]: [&Body; 2]) -> f64 {
    smaller(a.particle.bounding_radius(), b.particle.bounding_radius())
}

/// Least curvatures of A and B in any direction.
pub(crate) fn softest(a: &Body, b: &Body) -> (f64, f64) {
    (a.sphere_curvature(), b.sphere_curvature())
}

impl Expansion {
    /// At a point, with planes counting from their own blur.
    #[inline(always)]
    pub fn at(bodies: [&Body; 2], start: &Start, target: Target, factorisation: Factorisation) -> Self {
        let [a, b] = bodies;
        let locals = [a.locate(&start.x, 0.0), b.locate(&start.x, 0.0)];
        Self::of(bodies, start.x, locals, target.weights(start.lambda), factorisation)
    }

    #[inline(always)]
    pub fn of(
        bodies: [&Body; 2],
        x: Vector3<f64>,
        locals: [Local; 2],
        weights: (f64, f64),
        factorisation: Factorisation,
    ) -> Self {
        match factorisation {
            Factorisation::Plain => Self::in_axes(bodies, x, locals, &locals, None),
            Factorisation::Aligned => Self::about(bodies, x, locals, &locals, weights),
        }
    }

    /// About a point, in safe axes, with the planes that count in `places`.
    pub fn about(
        bodies: [&Body; 2],
        x: Vector3<f64>,
        locals: [Local; 2],
        places: &[impl Place; 2],
        weights: (f64, f64),
    ) -> Self {
        Self::in_axes(bodies, x, locals, places, Some(graded_basis::aligned(bodies, weights, places)))
    }

    #[inline(always)]
    fn in_axes(
        bodies: [&Body; 2],
        x: Vector3<f64>,
        locals: [Local; 2],
        places: &[impl Place; 2],
        axes: Option<Matrix3<f64>>,
    ) -> Self {
        let q_a = bodies[0].at(&places[0], axes.as_ref());
        let q_b = bodies[1].at(&places[1], axes.as_ref());
        Self { x, axes, locals, q_a, q_b, softened: None, anchored: false }
    }

    /// A direction of the solver's frame in the axes of the quadratics.
    pub fn to_axes(&self, v: &Vector3<f64>) -> Vector3<f64> {
        self.axes.map_or(*v, |axes| axes.tr_mul(v))
    }

    #[inline]
    pub fn to_solver(&self, v: &Vector3<f64>) -> Vector3<f64> {
        match &self.axes {
            Some(axes) => axes * v,
            None => *v,
        }
    }

    /// S of a body after a step, with its planes moved in, in the same axes.
    pub fn inset(&self, body: &Body, local: &Local, v: &Vector3<f64>, early: f64) -> Quadratic {
        body.inset(local, v, early, self.axes.as_ref())
    }

    /// S_A and S_B along a vector of the solver's frame, from the point x on.
    #[inline]
    pub fn pieces(&self, bodies: [&Body; 2], x: &Vector3<f64>, n: &Vector3<f64>) -> [Piece; 2] {
        let (n, moved) = (self.to_axes(n), (x - self.x).norm());
        let piece = |body: &Body, q: &Quadratic| {
            // Quadratics of a softened problem tell no more than the way.
            let exact = body.is_plain() && self.softened.is_none() && q.expansion <= NEARBY;
            let reach = if exact { body.stays_for(q) - moved } else { 0.0 };
            Piece { curvature: q.hessian.times(&n).dot(&n), reach }
        };
        [piece(bodies[0], &self.q_a), piece(bodies[1], &self.q_b)]
    }

    pub fn merit(&self, target: Target, lambda: f64) -> f64 {
        target.merit(self.q_a.value, self.q_b.value, lambda)
    }

    /// Bound on its rounding.
    pub fn merit_rounding(&self, [a, b]: [&Body; 2], target: Target, lambda: f64) -> f64 {
        let (of_a, of_b) = (a.rounding(&self.locals[0], &self.q_a), b.rounding(&self.locals[1], &self.q_b));
        target.merit_rounding(of_a, of_b, lambda)
    }

    /// The model's optimum here, and what its step does to the planes of A and of B.
    ///
    /// λ is good to `enough` where another plane is met or one pulls, and to rounding where the planes are right.
    #[inline]
    pub fn optimum(&self, bodies: [&Body; 2], target: Target, guess: f64, enough: f64) -> Option<Step> {
        let model = Model::new(&self.q_a, &self.q_b, softest(bodies[0], bodies[1]), target);
        let step = self.step(bodies, model.solve(guess, enough)?);
        if step.planes == Planes::Exact && !step.optimum.settled {
            return Some(self.step(bodies, model.search(step.optimum.lambda, 0.0)?));
        }
        Some(step)
    }

    /// Drops the planes that a step says.
    pub fn drop(&mut self, bodies: [&Body; 2], step: &Step, target: Target, lambda: f64, factorisation: Factorisation) {
        for (local, verdict) in self.locals.iter_mut().zip(&step.verdicts) {
            if let Some(i) = verdict.drop {
                local.drop(i);
            }
        }
        *self = Self::of(bodies, self.x, self.locals, target.weights(lambda), factorisation);
    }

    /// Drops the plane that pushes least after a step.
    pub fn drop_weakest(
        &mut self,
        bodies: [&Body; 2],
        step: &Step,
        target: Target,
        lambda: f64,
        factorisation: Factorisation,
    ) {
        let (a, b) = target.weights(lambda);
        let force = |i: usize, weight: f64| weight * bodies[i].plane_curvature() * step.verdicts[i].least;
        let i = usize::from(force(1, b) < force(0, a));
        if let Some(place) = bodies[i].shallowest(&self.locals[i], &step.v) {
            self.locals[i].drop(place);
        }
        *self = Self::of(bodies, self.x, self.locals, target.weights(lambda), factorisation);
    }

    /// How far the dual value after a step may lie above a lower bound: the step is not solved exactly, and planes of
    /// doubtful sign may pull after all.
    ///
    /// With a curvature of at least that of the spheres, a slope that is left can hide its square over twice as much. Where
    /// the spheres are all but flat that is more than it can hide between here and the optimum, which lies in
    /// {S ≤ `upper`}. Less than what is `negligible` is not looked at again.
    ///
    /// Forces of the length `force` balance to the rounding of their directions only: two faces that look parallel are tilted
    /// by as much, and far off on them S is less than it is here.
    #[inline(always)]
    pub fn doubt(
        &self,
        bodies: [&Body; 2],
        target: Target,
        step: &Step,
        upper: f64,
        force: f64,
        negligible: f64,
    ) -> Doubt {
        let ((a, b), soft) = (target.weights(step.optimum.lambda), softest(bodies[0], bodies[1]));
        let rounding = self.rounding_of_slope(step, (a, b));
        let of_a = step.verdicts[0].doubtful_slope(bodies[0], &self.locals[0], a, rounding);
        let of_b = step.verdicts[1].doubtful_slope(bodies[1], &self.locals[1], b, rounding);
        let turned = TURN * f64::EPSILON * force;
        let slope = step.optimum.slope(target).norm() + of_a + of_b + turned;
        let held = a * soft.0 + b * soft.1;
        let by_curvature = 0.5 * slope * slope / held;
        let wide = by_curvature > negligible;
        let height =
            if wide { by_curvature.min(slope * farthest(bodies, &(self.x + step.v), upper)) } else { by_curvature };
        // A plane that pushes less than the forces may be turned by holds the point where it may not belong, if the spheres alone
        // would let it go further than it is rounded.
        let loose = turned > held * self.locals[0].shift
            && (step.verdicts[0].pushes_less(bodies[0], &self.locals[0], a, turned)
                || step.verdicts[1].pushes_less(bodies[1], &self.locals[1], b, turned));
        Doubt { height, decided: of_a + of_b == 0.0, held: !loose }
    }

    /// Bound on the rounding of the sums in the slope after a step, at these weights.
    #[inline(always)]
    pub fn rounding_of_slope(&self, step: &Step, (a, b): (f64, f64)) -> f64 {
        a * step.optimum.rounding_of_slope(&self.q_a) + b * step.optimum.rounding_of_slope(&self.q_b)
    }

    #[inline(always)]
    pub fn step(&self, [a, b]: [&Body; 2], optimum: Optimum) -> Step {
        let v = self.to_solver(&optimum.step);
        let length = v.norm();
        let verdicts =
            [a.check(&self.locals[0], &self.q_a, &v, length), b.check(&self.locals[1], &self.q_b, &v, length)];
        Step { optimum, v, verdicts, planes: verdicts[0].planes.max(verdicts[1].planes) }
    }
}

/// What a step leaves open.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Doubt {
    /// How far the dual value may lie above a lower bound.
    pub height: f64,
    /// Whether no plane's sign is in doubt.
    pub decided: bool,
    /// Whether the planes, or the spheres, hold the point where it is.
    pub held: bool,
}

/// A potential along a vector.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    /// Its second derivative; of a vector without unit, 1/length².
    pub curvature: f64,
    /// How far it is the same quadratic for sure, either way, length.
    pub reach: f64,
}

/// A step to the optimum of the quadratics at a point.
#[derive(Clone, Copy)]
pub(crate) struct Step {
    pub optimum: Optimum,
    /// The step in the solver's frame.
    pub v: Vector3<f64>,
    pub verdicts: [Verdict; 2],
    /// The worse of the two.
    pub planes: Planes,
}

/// Bound on the distance from x to any optimum of a value of at most `upper`: it lies in both level sets.
pub(crate) fn farthest([a, b]: [&Body; 2], x: &Vector3<f64>, upper: f64) -> f64 {
    let of = |body: &Body| (x - body.centre()).norm() + body.particle.reach(upper);
    of(a).min(of(b))
}
