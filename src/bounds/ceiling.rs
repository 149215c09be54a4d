//! An upper bound of the optimum that holds wherever rounding may have the planes.
//!
//! A plane of n·x − d lies somewhere within its blur, and S grows with n·x − d: S with all planes moved in by their
//! blur is nowhere below S. What that sum has for its own optimum is an upper bound, and the point moves on the way: where
//! a stiff body weighs next to nothing in the optimum, its planes move it by their blur and S of the other by that times
//! its slope, which is far less than S of the stiff body changes at a point that stays.
//!
//! Distances are read off at the point of expansion, so that the move may be far shorter than the point has digits.

use crate::model::local_model::{self, Expansion};
use crate::model::problem::Target;
use crate::model::quadratic_model::Model;
use crate::pair::placed_particle::Body;
use crate::particle::potential::Quadratic;
use nalgebra::Vector3;

/// Most Newton steps: the planes are those of the optimum, or nearly.
const MOST_STEPS: u32 = 8;

/// Most trial points between two points: of those that helped three were enough.
const MOST_TRIALS: u32 = 8;

/// A change of λ by more is not its last.
const FAR: f64 = 1e3;

/// Share of what is left above the floor that a step has to gain for the next to be tried.
const WORTH: f64 = 0.1;

/// Steps in a row that may gain less and meet other planes each.
const MOST_WORTHLESS: u32 = 2;

/// Both bodies with their planes moved in, seen from one point.
pub(crate) struct Ceiling<'a> {
    pub bodies: [&'a Body<'a>; 2],
    pub target: Target,
    pub here: &'a Expansion,
}

/// Which planes a step knows of.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Counted {
    /// Those that are on.
    On,
    /// And those that would be, were they moved in by their blur once more.
    Nearly,
}

/// The lowest point so far.
struct Best {
    v: Vector3<f64>,
    lambda: f64,
    height: f64,
    /// Planes that are on there.
    counts: [u32; 2],
}

impl Ceiling<'_> {
    /// The least upper bound of a few steps from `v` on; none lies below the `floor`, and one below `enough` is as good as any.
    pub fn lowest(&self, v: Vector3<f64>, lambda: f64, floor: f64, enough: f64) -> f64 {
        let mut best = Best { v, lambda, height: f64::INFINITY, counts: [0; 2] };
        self.descend(&mut best, floor, enough, Counted::On);
        // A stiff plane carries its share with a depth below rounding: without one that should, a step leads far astray, and
        // with one that should not, it does as well.
        if best.height > enough {
            self.descend(&mut best, floor, enough, Counted::Nearly);
        }
        best.height
    }

    /// Newton's steps from the best point so far, each on the planes that count where the last one ended.
    fn descend(&self, best: &mut Best, floor: f64, enough: f64, counted: Counted) {
        let soft = local_model::softest(self.bodies[0], self.bodies[1]);
        let (mut v, mut lambda) = (best.v, best.lambda);
        let (mut counts, mut worthless, mut settled) = ([0; 2], 0, true);
        for step in 0..MOST_STEPS {
            let mut quadratics = [0, 1].map(|i| self.quadratic(i, &v, counted));
            let counts_of = |quadratics: &[Quadratic; 2]| quadratics.each_ref().map(|q| q.count);
            if step == 0 && counted == Counted::Nearly {
                // Where it begins is known already.
                if counts_of(&quadratics) == best.counts {
                    break;
                }
            } else {
                let mut height = self.feasible(&v, quadratics.each_ref().map(|q| q.value));
                // A step that meets another plane ends higher. Where it is least on the way that plane is on, and the next step
                // knows of it.
                if height > best.height && self.target == Target::Midway {
                    v = self.least_between(&best.v, &v);
                    quadratics = [0, 1].map(|i| self.quadratic(i, &v, counted));
                    height = self.feasible(&v, quadratics.each_ref().map(|q| q.value));
                }
                let (worth, met) = (best.height - height > WORTH * (height - floor), counts_of(&quadratics));
                if height < best.height {
                    *best = Best { v, lambda, height, counts: met };
                }
                worthless = if worth { 0 } else { worthless + 1 };
                if best.height <= enough || (!worth && met == counts && settled) || worthless > MOST_WORTHLESS {
                    break;
                }
            }
            counts = counts_of(&quadratics);
            let [q_a, q_b] = quadratics;
            let Some(optimum) = Model::new(&q_a, &q_b, soft, self.target).solve(lambda, 0.0) else { break };
            v += self.here.to_solver(&optimum.step);
            // A search moves λ only so far.
            settled = optimum.lambda.max(lambda) <= FAR * optimum.lambda.min(lambda);
            lambda = optimum.lambda;
        }
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
            let [q_a, q_b] = [0, 1].map(|i| self.quadratic(i, &v, Counted::On));
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
    fn quadratic(&self, i: usize, v: &Vector3<f64>, counted: Counted) -> Quadratic {
        let local = self.bodies[i].blurred(&self.here.locals[i], v.norm());
        self.here.inset(self.bodies[i], &local, v, if counted == Counted::On { 0.0 } else { local.blur })
    }

    /// The value of a point, or of one on the way to the centre of the body that it should be in and is not.
    fn feasible(&self, v: &Vector3<f64>, values: [f64; 2]) -> f64 {
        let Some((held, free)) = self.target.held() else { return values[0].max(values[1]) };
        let s = values[held].sqrt();
        if s <= 1.0 {
            return values[free];
        }
        let way = self.bodies[held].centre() - self.here.x - v;
        let s0 = self.quadratic(held, &(v + way), Counted::On).value.sqrt();
        // s is convex on the way; a few units in the last place further in are surely inside.
        let share = (s - 1.0) / (s - s0) * (1.0 + SURELY) + SURELY;
        if s0 < 1.0 && share < 1.0 {
            self.quadratic(free, &(v + share * way), Counted::On).value
        } else {
            f64::INFINITY
        }
    }
}

/// Units in the last place of a sum of squares and its root, ample.
const SURELY: f64 = 64.0 * f64::EPSILON;
