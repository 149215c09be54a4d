//! Newton's method for the least S on a plane or a line.
//!
//! At a point the active planes are frozen, and S is a quadratic whose minimum on the plane or line is a step away. If the
//! active planes still push there and no other has become active, that is the minimum of S. If not, the step is taken when S
//! falls, and is shortened to the least S along it when it does not.

use super::minimum::{Minimum, Model, Step};
use crate::linalg::graded_basis;
use crate::linalg::root::{self, Bracket};
use crate::linalg::symmetric::{Factor, Symmetric};
use crate::model::kkt_check::{Change, KktCheck};
use crate::pair::body::Body;
use crate::pair::local_point::LocalPoint;
use nalgebra::{Matrix3, Vector3};

/// Where a point may move, by unit vectors of the local frame.
#[derive(Clone, Copy, Debug)]
pub(super) enum Freedom {
    /// In the plane with this normal.
    Plane(Vector3<f64>),
    /// Along a line.
    Line(Vector3<f64>),
}

/// Most models of one search; a handful is usual, and 25 the most of 80,000 triangles of all sizes and kinds of particles.
const MOST_MODELS: u32 = 40;

/// Models granted to sharpen a minimum that is known already.
const MOST_SHARPENING: u32 = 3;

/// Relative to the particle, a step too short for the next one to be more precise.
const SHORT: f64 = 1e-9;

/// Factor of the least possible rounding that is as good as any.
const AS_SHARP: f64 = 8.0;

/// Relative accuracy of the minimum along a step: the step is itself an approximation.
const CLOSE: f64 = 1e-3;

/// Ratio of plane to sphere curvature above which axes in the plane are aligned with the stiffest active normal, as for pairs.
const GRADED_FROM: f64 = 1e7;

/// Where a search ended.
#[derive(Clone, Copy, Debug)]
pub(super) struct Found {
    pub minimum: Minimum,
    /// Whether it is one; if not, a point whose bounds may say little.
    pub settled: bool,
    pub models: u32,
}

/// The least S that is reached from `start`; `None` if something is not finite.
///
/// `tolerance` is the relative rounding at which a minimum is sharp enough.
pub(super) fn minimise(body: &Body, freedom: &Freedom, start: &Vector3<f64>, tolerance: f64) -> Option<Found> {
    let mut model = Model::at(body, freedom, body.locate(start));
    let mut best: Option<Minimum> = None;
    let (mut sharpened, mut last) = (0, None);
    for models in 1..=MOST_MODELS {
        if let Some(shortened) = shorten(body, last.take(), &model) {
            model = Model::at(body, freedom, body.locate(&shortened));
        }
        let step = model.step(freedom, body)?;
        let v = model.axes * step.v;
        let length = v.norm();
        let check = KktCheck::after(body, &model.point, &model.q, &v, length);
        if let (Change::Leaving, Some(place)) = (check.change, check.drop) {
            let mut point = model.point;
            point.drop(place);
            model = Model::at(body, freedom, point);
            continue;
        }
        if check.change == Change::None {
            let minimum = Minimum::after(body, &model, &step, &v, &check);
            let sharper = best.is_none_or(|best| minimum.rounding < best.rounding);
            let kept = if sharper { minimum } else { best? };
            let short = length <= SHORT * body.particle.bounding_radius();
            if short || model.is_as_sharp_as(&minimum, tolerance) || sharpened == MOST_SHARPENING {
                return Some(Found { minimum: kept, settled: true, models });
            }
            (best, sharpened) = (Some(kept), sharpened + 1);
        }
        last = Some(Attempt::from(body, &model, v));
        model = Model::at(body, freedom, body.locate(&(model.point.y + v)));
    }
    let minimum = best.unwrap_or_else(|| Minimum::unsettled(body, &model.point.y));
    Some(Found { minimum, settled: best.is_some(), models: MOST_MODELS })
}

/// A step that was taken.
struct Attempt {
    from: Vector3<f64>,
    v: Vector3<f64>,
    value: f64,
    rounding: f64,
}

impl Attempt {
    fn from(body: &Body, model: &Model, v: Vector3<f64>) -> Self {
        Self { from: model.point.y, v, value: model.q.value, rounding: body.rounding(&model.point, &model.q) }
    }
}

/// The least S along the last step, if S has not fallen by all of it.
fn shorten(body: &Body, last: Option<Attempt>, model: &Model) -> Option<Vector3<f64>> {
    let Attempt { from, v, value, rounding } = last?;
    if model.q.value <= value + rounding {
        return None;
    }
    let slope = |share: f64| {
        let line = body.on_line(&(from + share * v), &v);
        (line.slope, line.curvature)
    };
    let share = root::newton(Bracket { low: 0.0, high: 1.0 }, 0.5, CLOSE, slope);
    Some(from + share * v)
}

impl Model {
    fn at(body: &Body, freedom: &Freedom, point: LocalPoint) -> Self {
        let axes = freedom.axes(body, &point);
        Self { point, axes, q: body.at(&point, Some(&axes)) }
    }

    /// Whether the minimum has all the digits that are asked for, or that there are.
    fn is_as_sharp_as(&self, minimum: &Minimum, tolerance: f64) -> bool {
        let least = AS_SHARP * self.point.blur * minimum.gradient.norm();
        minimum.rounding <= tolerance * minimum.value || minimum.rounding <= least
    }

    /// To the minimum of the quadratic; `None` if something is not finite.
    fn step(&self, freedom: &Freedom, body: &Body) -> Option<Step> {
        let (h, g, least) = (&self.q.hessian, &self.q.gradient, body.sphere_curvature());
        let fixed = Symmetric { zx: 0.0, zy: 0.0, zz: least, ..*h };
        let (h, slope, dimensions) = match freedom {
            Freedom::Plane(_) => (fixed, Vector3::new(-g.x, -g.y, 0.0), 2),
            Freedom::Line(_) => (Symmetric { yx: 0.0, yy: least, ..fixed }, Vector3::new(-g.x, 0.0, 0.0), 1),
        };
        let factor = Factor::of(&h, least)?;
        let inverse = factor.inverse();
        let yy = if dimensions == 2 { inverse.yy } else { 0.0 };
        let (v, answer) = (factor.solve(&slope), Symmetric { yy, zz: 0.0, ..inverse });
        v.iter().all(|c| c.is_finite()).then_some(Step { v, answer, dimensions })
    }
}

impl Freedom {
    /// Orthonormal axes (columns), those in which the point may move first, and of these the stiffest.
    fn axes(&self, body: &Body, point: &LocalPoint) -> Matrix3<f64> {
        let first = match self {
            Self::Line(along) => *along,
            Self::Plane(normal) => {
                let graded = body.stiffest_curvature() > GRADED_FROM * body.sphere_curvature();
                let stiffest = if graded { stiffest_in_plane(normal, body, point) } else { None };
                stiffest.unwrap_or_else(|| graded_basis::any_across(normal))
            }
        };
        let third = match self {
            Self::Line(along) => graded_basis::any_across(along),
            Self::Plane(normal) => *normal,
        };
        Matrix3::from_columns(&[first, third.cross(&first), third])
    }
}

/// The direction in the plane in which one active plane alone is stiffest.
fn stiffest_in_plane(normal: &Vector3<f64>, body: &Body, point: &LocalPoint) -> Option<Vector3<f64>> {
    let across = |n: Vector3<f64>| n - n.dot(normal) * normal;
    let (mut stiffest, mut most) = (Vector3::zeros(), 0.0);
    body.active_normals(point, |n| {
        let rest = across(n);
        let stiffness = rest.norm_squared();
        // What is left of a normal to the plane is rounding.
        if stiffness > most && stiffness > graded_basis::PARALLEL * n.norm_squared() {
            (stiffest, most) = (rest, stiffness);
        }
    });
    // Twice is enough (Kahan).
    stiffest.try_normalize(0.0).and_then(|v| across(v).try_normalize(0.5))
}
