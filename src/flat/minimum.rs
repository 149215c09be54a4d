//! The least S on a plane, a line or at a point, with what rounding does to it.

use crate::bounds::rounding;
use crate::linalg::number::smaller;
use crate::linalg::symmetric::Symmetric;
use crate::model::kkt_check::KktCheck;
use crate::pair::active_set::LocalPoint;
use crate::pair::placed_particle::Body;
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
    /// Bound on the rounding of x.
    pub shift: f64,
    axes: Matrix3<f64>,
    hessian: Symmetric,
}

impl Minimum {
    /// After a step of the model (in its axes) that leaves its planes on.
    pub fn after(body: &Body, model: &Model, step: &Vector3<f64>, v: &Vector3<f64>, check: &KktCheck) -> Self {
        let (q, point) = (&model.q, &model.point);
        let curved = q.hessian.times(step);
        let gradient = q.gradient + curved;
        let value = q.expansion + (q.gradient + 0.5 * curved).dot(step);
        let (shift, blur) = body.after(point, v.norm());
        // The rounding of the sums at the point of expansion is carried along.
        let of_places = check.pull * blur + gradient.norm() * shift + q.pull * (blur - point.blur);
        let of_sums = body.rounding_of_value(value, q.count) + q.rounding_after(q.terms(step));
        // A plane that is left out at a depth of one blur may be on by two.
        let of_second_order = 4.0 * check.near * body.plane_weight() * blur * blur;
        let of_slope = rounding::of_slope(q, step);
        Self {
            x: point.y + v,
            value,
            gradient: model.axes * gradient,
            rounding: of_places + of_sums + of_second_order,
            slope: of_slope + check.doubtful_slope(body, 1.0, of_slope),
            shift,
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
            shift: point.shift,
            axes: Matrix3::identity(),
            hessian: q.hessian,
        }
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

    /// How far S may fall below its value within a distance, if it descends by no more than this slope beside what is in doubt:
    /// what is below it has the curvature of the shadow sphere at least.
    pub fn height(&self, body: &Body, descent: f64, within: f64) -> f64 {
        let slope = descent + self.slope;
        smaller(slope * within, 0.5 * slope * slope / body.sphere_curvature())
    }
}
