//! An upper bound of the optimum that holds wherever rounding may have the planes.
//!
//! A plane of n·x − d lies somewhere within its blur, and S grows with n·x − d: S with all planes moved in by their
//! blur is nowhere below S. What that sum has for its own optimum is an upper bound, and the point moves on the way: where
//! a stiff body weighs next to nothing in the optimum, its planes move it by their blur and S of the other by that times
//! its slope, which is far less than S of the stiff body changes at a point that stays.
//!
//! Distances are read off at the point of expansion, so that the move may be far shorter than the point has digits.

use crate::body::Body;
use crate::expansion::{self, Expansion};
use crate::model::Model;
use crate::potential::Quadratic;
use crate::target::Target;
use nalgebra::Vector3;

/// Most Newton steps: the planes are those of the optimum, or nearly.
const MOST_STEPS: u32 = 8;

/// Most trial points between two points.
const MOST_TRIALS: u32 = 40;

/// A change of λ by more is not its last.
const FAR: f64 = 1e3;

/// Share of what is left above the floor that a step has to gain for the next to be tried.
const WORTH: f64 = 0.1;

/// Both bodies with their planes moved in, seen from one point.
pub(crate) struct Ceiling<'a> {
    pub bodies: [&'a Body<'a>; 2],
    pub target: Target,
    pub here: &'a Expansion,
}

impl Ceiling<'_> {
    /// The least upper bound of a few steps from `v` on; none lies below the `floor`.
    pub fn lowest(&self, mut v: Vector3<f64>, mut lambda: f64, floor: f64) -> f64 {
        let soft = expansion::softest(self.bodies[0], self.bodies[1]);
        let (mut lowest, mut counts, mut best) = (f64::INFINITY, [0; 2], v);
        let mut settled = true;
        for _ in 0..MOST_STEPS {
            let mut quadratics = [0, 1].map(|i| self.quadratic(i, &v));
            let mut height = self.feasible(&v, quadratics.each_ref().map(|q| q.value));
            // A step that meets another plane ends higher. Where it is least on the way that plane is on, and the next step knows
            // of it.
            if height > lowest && self.target == Target::Midway {
                v = self.least_between(&best, &v);
                quadratics = [0, 1].map(|i| self.quadratic(i, &v));
                height = self.feasible(&v, quadratics.each_ref().map(|q| q.value));
            }
            let worth = lowest - height > WORTH * (height - floor);
            if height < lowest {
                (lowest, best) = (height, v);
            }
            let [q_a, q_b] = quadratics;
            let met = [q_a.count, q_b.count];
            if !worth && met == counts && settled {
                break;
            }
            counts = met;
            let Some(optimum) = Model::new(&q_a, &q_b, soft, self.target).solve(lambda, 0.0) else { break };
            v += self.here.to_solver(&optimum.step);
            // A search moves λ only so far.
            settled = optimum.lambda.max(lambda) <= FAR * optimum.lambda.min(lambda);
            lambda = optimum.lambda;
        }
        lowest
    }

    /// Where the larger of both S is least between two points: Newton's method on its slope, which grows along the way, halving
    /// where that leaves the bracket.
    fn least_between(&self, from: &Vector3<f64>, to: &Vector3<f64>) -> Vector3<f64> {
        let way = to - from;
        let along = self.here.to_axes(&way);
        let (mut low, mut high, mut share) = (0.0, 1.0, 1.0);
        let (mut found, mut least) = (*from, f64::INFINITY);
        let mut beyond = None;
        for _ in 0..MOST_TRIALS {
            let v = from + share * way;
            let [q_a, q_b] = [0, 1].map(|i| self.quadratic(i, &v));
            let q = if q_a.value > q_b.value { q_a } else { q_b };
            if q.value < least {
                (found, least) = (v, q.value);
            }
            let (slope, curvature) = (q.gradient.dot(&along), q.hessian.times(&along).dot(&along));
            if slope > 0.0 {
                high = share;
                beyond = Some((v, q.value));
            } else {
                low = share
            }
            let newton = share - slope / curvature;
            let next = if low < newton && newton < high { newton } else { 0.5 * (low + high) };
            if !(low < next && next < high) || slope.abs() * (high - low) <= WORTH * WORTH * least {
                break;
            }
            share = next;
        }
        // From just beyond, the next step knows of the plane.
        beyond.filter(|(_, value)| *value <= (1.0 + WORTH * WORTH) * least).map_or(found, |(v, _)| v)
    }

    /// Convex in v, as is the blur of the way.
    fn quadratic(&self, i: usize, v: &Vector3<f64>) -> Quadratic {
        let local = self.bodies[i].blurred(&self.here.locals[i], v.norm());
        self.here.inset(self.bodies[i], &local, v)
    }

    /// The value of a point, or of one on the way to the centre of the body that it should be in and is not.
    fn feasible(&self, v: &Vector3<f64>, values: [f64; 2]) -> f64 {
        let Some((held, free)) = self.target.held() else { return values[0].max(values[1]) };
        let s = values[held].sqrt();
        if s <= 1.0 {
            return values[free];
        }
        let way = self.bodies[held].centre() - self.here.x - v;
        let s0 = self.quadratic(held, &(v + way)).value.sqrt();
        // s is convex on the way; a few units in the last place further in are surely inside.
        let share = (s - 1.0) / (s - s0) * (1.0 + SURELY) + SURELY;
        if s0 < 1.0 && share < 1.0 { self.quadratic(free, &(v + share * way)).value } else { f64::INFINITY }
    }
}

/// Units in the last place of a sum of squares and its root, ample.
const SURELY: f64 = 64.0 * f64::EPSILON;
