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
        let (mut lowest, mut counts) = (f64::INFINITY, [0; 2]);
        for _ in 0..MOST_STEPS {
            let [q_a, q_b] = [0, 1].map(|i| self.quadratic(i, &v));
            let height = self.feasible(&v, [q_a.value, q_b.value]);
            let worth = lowest - height > WORTH * (height - floor);
            lowest = lowest.min(height);
            // A step that meets another plane ends higher, and the next one knows of it.
            let met = [q_a.count, q_b.count];
            if !worth && met == counts {
                break;
            }
            counts = met;
            let Some(optimum) = Model::new(&q_a, &q_b, soft, self.target).solve(lambda, 0.0) else { break };
            v += self.here.to_solver(&optimum.step);
            lambda = optimum.lambda;
        }
        lowest
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
