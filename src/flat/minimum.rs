//! The least S on a plane, a line or at a point, with what rounding does to it.

use crate::bounds::rounding;
use crate::linalg::number::{larger, smaller};
use crate::linalg::symmetric::Symmetric;
use crate::model::kkt_check::KktCheck;
use crate::pair::body::Body;
use crate::pair::local_point::LocalPoint;
use crate::particle::potential::Quadratic;
use nalgebra::{Matrix3, Vector3};

/// S as a quadratic at a point of the local frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Model {
    pub point: LocalPoint,
    /// Columns: the axes of the quadratic in the local frame. Those in which the point may move come first.
    pub axes: Matrix3<f64>,
    pub q: Quadratic,
}

/// The step to the minimum of the quadratic where the point may move, in its axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    pub v: Vector3<f64>,
    /// What the step makes of a slope: the inverse of the part of the Hessian of axes along which the point may move, 0 for the
    /// others.
    pub answer: Symmetric,
    /// The number of these axes.
    pub dimensions: usize,
}

/// (Regularised) S where it is least, local frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Minimum {
    pub x: Vector3<f64>,
    /// S.
    pub value: f64,
    /// ∇S.
    pub gradient: Vector3<f64>,
    /// Bound on the rounding of S.
    pub rounding: f64,
    /// Bound on the rounding of ∇S as the slope of a lower bound of S: what is left of sums and of planes of doubtful sign. The
    /// rounding of depths is no part of it, as it is of `rounding`: any depths give a lower bound.
    pub slope: f64,
    /// Estimated bound on the distance of x to the exact minimum; infinite where the active set is not certain.
    pub way: f64,
    /// How far the minimum moves, at most, when what it lies on moves by a unit of length.
    follows: f64,
    axes: Matrix3<f64>,
    hessian: Symmetric,
}

/// Rounding of the planes' share of tr H⁻¹, relative to that trace (estimated).
const TRACE_ROUNDING: f64 = 16.0 * f64::EPSILON;

impl Minimum {
    /// After a step of the model, to v in the local frame, that leaves its planes on.
    pub fn after(body: &Body, model: &Model, step: &Step, v: &Vector3<f64>, check: &KktCheck) -> Self {
        let (q, point) = (&model.q, &model.point);
        let curved = q.hessian.times(&step.v);
        let gradient = q.gradient + curved;
        let value = q.expansion + (q.gradient + 0.5 * curved).dot(&step.v);
        let (shift, blur) = body.after(point, v.norm());
        // The rounding of the sums at the point of expansion is carried along.
        let of_places = check.pull * blur + gradient.norm() * shift + q.pull * (blur - point.blur);
        let of_sums = body.rounding_of_value(value, q.count) + q.rounding_after(q.terms(&step.v));
        // A plane that is left out at a depth of one blur may be on by two.
        let of_second_order = 4.0 * check.near * body.plane_weight() * blur * blur;
        let of_slope = rounding::of_slope(q, &step.v);
        let doubtful = check.doubtful_slope(body, 1.0, of_slope);
        let certain = doubtful == 0.0 && !check.near_inactive && check.pushes_more(body, 1.0, of_slope);
        Self {
            x: point.y + v,
            value,
            gradient: model.axes * gradient,
            rounding: of_places + of_sums + of_second_order,
            slope: of_slope + doubtful,
            way: if certain { shift + step.way(body, q, blur) } else { f64::INFINITY },
            follows: 1.0 + step.follows(&q.hessian),
            axes: model.axes,
            hessian: q.hessian,
        }
    }

    /// At a point that cannot move.
    pub fn at(body: &Body, y: &Vector3<f64>) -> Self {
        let point = body.locate(y);
        // Planes that are on by rounding would pull.
        let on = LocalPoint::new(point.y, point.shift, 0.0);
        let q = body.at(&on, None);
        Self {
            x: *y,
            value: q.value,
            gradient: q.gradient,
            rounding: body.rounding(&point, &q),
            slope: rounding::of_slope(&q, &Vector3::zeros()),
            way: 0.0,
            follows: 1.0,
            axes: Matrix3::identity(),
            hessian: q.hessian,
        }
    }

    /// At a point where a search has ended without a minimum.
    pub fn unsettled(body: &Body, y: &Vector3<f64>) -> Self {
        Self { way: f64::INFINITY, ..Self::at(body, y) }
    }

    /// The same where what it lies on may be off by so much.
    pub fn displaced(self, by: f64) -> Self {
        let rounding = self.rounding + self.gradient.norm() * by + 0.5 * self.hessian.trace() * by * by;
        Self { rounding, way: self.way + self.follows * by, ..self }
    }

    /// The second derivative of S along a vector.
    pub fn curvature(&self, v: &Vector3<f64>) -> f64 {
        let v = self.axes.tr_mul(v);
        self.hessian.times(&v).dot(&v)
    }

    /// Bound on the way from x to any point where S is at most `upper`.
    pub fn farthest(&self, body: &Body, upper: f64) -> f64 {
        self.x.norm() + body.particle.reach(upper)
    }

    /// How far S may fall below its value within a distance, if it descends by no more than this slope: what is below it has the
    /// curvature of the shadow sphere at least.
    pub fn height(&self, body: &Body, slope: f64, within: f64) -> f64 {
        smaller(slope * within, 0.5 * slope * slope / body.sphere_curvature())
    }
}

impl Step {
    /// How far the rounding of each plane's place, at most `blur`, and that of the sums move the minimum of a quadratic, to first
    /// order.
    ///
    /// A plane that is off by δ turns the slope by 2wδn, and the minimum moves by A·2wδn, A the answer. By Cauchy's inequality
    /// the sum over N planes is at most δ√(2wN·tr(A·2wΣnnᵀ·A)), where 2wΣnnᵀ is what the sphere leaves of H and A·H·A = A. The
    /// sums are rounded on each axis by its own share (docs/theory.md, 4.5).
    fn way(&self, body: &Body, q: &Quadratic, blur: f64) -> f64 {
        let (answer, trace) = (&self.answer, self.answer.trace());
        let of_planes = trace - body.sphere_curvature() * answer.square() + TRACE_ROUNDING * trace;
        let planes = blur * (2.0 * body.plane_weight() * f64::from(q.count) * larger(of_planes, 0.0)).sqrt();
        let of_axis = |i: usize| answer.times(&Vector3::ith(i, 1.0)).norm() * q.hessian.diagonal()[i].sqrt();
        let axes: f64 = (0..self.dimensions).map(of_axis).sum();
        planes + rounding::sums(q.count) * axes * q.terms(&self.v).sqrt()
    }

    /// How far the minimum moves along its plane or line, at most, when that moves across itself by a unit of length.
    fn follows(&self, hessian: &Symmetric) -> f64 {
        let moved = |i: usize| self.answer.times(&hessian.times(&Vector3::ith(i, 1.0))).norm();
        (self.dimensions..3).map(moved).sum()
    }
}
