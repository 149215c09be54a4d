//! The safe solver: the distances to all planes are read off at one anchor, and what follows is exact arithmetic on them.
//!
//! A stiff plane carries its share of a deep contact with a depth far below the rounding of a distance to a plane:
//! with k = 10⁻⁸ and r = 10⁻⁹ it is 10⁻²⁶ of the size. Read off anew at each point, such a distance says at random
//! whether the plane is on, and the planes take turns without end. Two things end that.
//!
//! **An anchor.** At x = anchor + v the distance of a plane is its excess at the anchor + n·v. The excess is wrong by
//! its rounding, but it is the same number for every v: the problem in v is a convex one of its own, near the given one,
//! and a finite method solves it. For a fixed ratio of weights λ the sum a·S_A + b·S_B is smooth and piecewise quadratic, and
//! Newton's method with an exact line search ends at its minimum; along the minima one of the two sides grows with λ and
//! the other falls, so that λ is bracketed.
//!
//! **Softer planes first.** S with a smaller weight of its planes is a lower bound of S, and has its planes deeper. From
//! 10⁹ times the curvature of the sphere, where planes that act as walls sink in by 10⁻⁹ of the size, the planes are
//! stiffened by steps, each solved from an anchor at the end of the last, until they weigh what they should, or until
//! all of a body are less deep than the rounding of a distance. What remains then is a shift of the planes by less
//! than their rounding.
//!
//! **Forces that are but rounding.** A force F along a flat face is turned aside by ε·F, which may be more than the whole
//! pull of the sphere along the face. Springs to the anchor that hold just such forces keep the point where it is, and
//! planes whose force is smaller are not asked for their sign. The certificate is made without the springs.
//!
//! The minimum of the softened problem is a lower bound. The upper one is S itself, at a point within all planes by
//! more than their rounding.

use crate::bounds::solution::{Ending, Outcome};
use crate::model::kkt_check::Planes;
use crate::model::local_model::{self, Expansion, Start};
use crate::pair::placed_particle::Body;
use crate::solver::anchor::Anchor;
use crate::solver::newton::Goal;

/// First ratio of plane to sphere curvature, and its growth.
const FIRST_CONTRAST: f64 = 1e9;
const STIFFENING: f64 = 1e3;

/// Models that one degree of softness takes when the planes stay what they are, or nearly.
const EASY: u32 = 2;

/// Most models in all. A search that gets anywhere takes about 100 or fewer.
pub(crate) const MOST_MODELS: u32 = 200;

/// Relative to the smaller particle, an anchor near enough for the answer to have all its digits.
const NEAR: f64 = 1e-9;

/// Anchors at the same softness.
const MOST_ANCHORS: u32 = 4;

/// Mismatch of the two sides, relative to the larger, that will do before the planes have their weight.
const CLOSE: f64 = 1e-3;

/// Units in the last place of the sum of its planes' forces by which a body's force may be turned aside.
const NOISE: f64 = 32.0;

/// How the planes are stiffened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pace {
    /// By three steps at once where the last was no work, with forces that grow as the planes do: so it is where bodies
    /// overlap deeply.
    Brisk,
    /// By one step at a time, with forces that stay what they are: so it is where planes act as walls. Springs for forces that
    /// do not come about would hold the point where it does not belong, and λ with it.
    Gentle,
}

/// How to go about it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Effort {
    pub pace: Pace,
    /// Most models in all; what is found by then is the answer.
    pub most: u32,
    /// Whether to go on where a plane is met closer than a step has digits.
    pub through: bool,
}

/// Solves for the goal; the quadratics of the answer are left in `here`.
pub(crate) fn solve(bodies: [&Body; 2], goal: &Goal, from: &Start, effort: Effort, here: &mut Expansion) -> Outcome {
    let Effort { pace, most, through } = effort;
    let target = goal.target;
    let (mut found, mut models) = (Outcome::UNKNOWN, 0);
    let (mut x, mut lambda) = (from.x, from.lambda);
    // The body that is held at S = 1 has its planes as deep as they can be.
    let held = [0, 1].map(|i| target.held().is_some_and(|(held, _)| held == i));
    let mut contrasts = held.map(|held| if held { f64::INFINITY } else { FIRST_CONTRAST });
    let reach = local_model::smallest(bodies);
    // Sums of the forces of the planes, and the weights that they had.
    let mut pulls = [0, 1].map(|i| if held[i] { 2.0 * bodies[i].plane_weight().sqrt() } else { 0.0 });
    let mut weights = bodies.map(|body| body.plane_weight());
    let mut anchors = 0;
    loop {
        let softened = [0, 1].map(|i| bodies[i].softened(contrasts[i] * bodies[i].sphere_weight()));
        let soft = [&softened[0], &softened[1]];
        let as_given = [0, 1].map(|i| soft[i].plane_weight() == bodies[i].plane_weight());
        let noise = [0, 1].map(|i| {
            let stiffened = soft[i].plane_weight() / weights[i];
            let grown = if pace == Pace::Brisk { stiffened } else { 1.0 };
            NOISE * f64::EPSILON * if stiffened > 0.0 { pulls[i] * grown } else { 0.0 }
        });
        let locals = [0, 1].map(|i| soft[i].locate(&x, 0.0));
        let anchor = Anchor { bodies: soft, target, x, locals, noise, reach, most, through };
        let enough = if as_given == [true; 2] || anchors > 0 { 0.0 } else { CLOSE };
        let before = models;
        let Some(mut saddle) = anchor.saddle(lambda, enough, &mut models) else { break };
        let shifts = [0, 1].map(|i| if as_given[i] { 0.0 } else { saddle.depths[i] });
        let stiff = [0, 1].map(|i| shifts[i] <= anchor.locals[i].blur);
        anchors += u32::from(stiff == [true; 2]);
        if stiff == [true; 2] && enough == 0.0 {
            let mut outcome = anchor.outcome(bodies, &mut saddle, shifts);
            let (old, new) = (found.gap(), outcome.gap());
            // The later is from nearer by.
            if saddle.step.planes == Planes::Exact && new.is_finite() && !(new >= 2.0 * old) {
                let precise = new <= goal.tolerance * outcome.upper;
                outcome.ending = if precise { Ending::Converged } else { Ending::RoundingLimited };
                let softened = Some(soft.map(|body| body.plane_weight()));
                (found, *here) = (outcome, saddle.expansion);
                here.softened = softened;
            }
            let near = saddle.step.v.norm() <= NEAR * reach;
            if new > 0.5 * old || (near && new <= goal.tolerance * outcome.upper) || anchors >= MOST_ANCHORS {
                break;
            }
        }
        // Where the last stage was no work, the next one may be three at once.
        let factor = if models - before <= EASY && pace == Pace::Brisk { STIFFENING.powi(3) } else { STIFFENING };
        for i in 0..2 {
            // Walls sink in as little as they are stiff: to a tenth of the rounding, and no less.
            let left = 10.0 * shifts[i] / anchor.locals[i].blur;
            contrasts[i] *= if stiff[i] { 1.0 } else { left.min(factor) };
        }
        (x, lambda) = (x + saddle.step.v, saddle.step.optimum.lambda);
        weights = soft.map(|body| body.plane_weight());
        pulls = [0, 1].map(|i| 2.0 * weights[i] * bodies[i].particle.bounds.longest_normal * saddle.sums[i]);
    }
    Outcome { iterations: models, ..found }
}
