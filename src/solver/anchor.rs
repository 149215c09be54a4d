//! The problem at one anchor: distances to all planes read off once, and what follows exact arithmetic on them (see
//! `anchored`).

use crate::bounds::ceiling::Ceiling;
use crate::bounds::rounding::Care;
use crate::bounds::solution::{self, Outcome};
use crate::model::dual_path::Optimum;
use crate::model::kkt_check::{DOUBT, Planes, Verdict};
use crate::model::local_model::{self, Expansion, Step};
use crate::model::problem::Target;
use crate::model::quadratic_model::Model;
use crate::pair::active_set::{Local, Place};
use crate::pair::placed_particle::Body;
use crate::particle::particle::Particle;
use nalgebra::Vector3;

/// Most values of λ that are tried at an anchor, and most steps for each.
const MOST_WEIGHTS: u32 = 60;
const MOST_STEPS: u32 = 40;

/// A move that is none, in units of the rounding of a distance to a plane, and how many in a row are too many.
const SHORT: f64 = 1e-2;
const MOST_STALLS: u32 = 2;

/// A step so short that `v` does not change, though a plane is met on it, is made this long, relative to `v`.
const GRAIN: f64 = 8.0 * f64::EPSILON;

/// Minima that may not be found at one anchor: another is better then.
const MOST_FAILED: u32 = 1;

/// Slope, relative to the first, at which a search along a line may end.
const FLAT: f64 = 1e-3;

/// Most trial points of a search along a line.
const MOST_TRIALS: u32 = 40;

/// ln λ stays within ±this; beyond, one body's weight is lost in rounding altogether.
const FARTHEST: f64 = 92.0;

/// Mismatch, relative to what the regularisation adds, that is not worth many values of λ; bracket of ln λ that is narrow; and
/// how many values in a row may leave the mismatch what it is then. Where both cores overlap, faces of k = 0 let the minimiser
/// jump with λ; and where forces are but rounding, it depends on the side from which λ comes. Another anchor tells more.
const IDLE: f64 = 1e-3;
const NARROW: f64 = 1e-3;
const MOST_IDLE: u32 = 4;

/// Values of λ in a row for which the point stays and the planes that are on ask for one beyond an end of the bracket, before
/// that end is looked at again.
const MOST_BEYOND: u32 = 2;

/// Farthest move of ln λ while only one end of the bracket is known.
const STRIDE: f64 = 7.0;

/// Both bodies as seen from one point.
pub(crate) struct Anchor<'a> {
    pub bodies: [&'a Body<'a>; 2],
    pub target: Target,
    pub x: Vector3<f64>,
    pub locals: [Local; 2],
    /// Forces of the planes of A and of B that are but rounding.
    pub noise: [f64; 2],
    /// Length over which a spring to the anchor outweighs such forces.
    pub reach: f64,
    /// Most models in all, with those of earlier anchors.
    pub most: u32,
    /// Whether to go on where a plane is met closer than a step has digits.
    pub through: bool,
}

/// The optimum at an anchor, as far as it was found.
pub(crate) struct Saddle {
    pub expansion: Expansion,
    pub step: Step,
    /// Greatest depth of a plane of A and of B.
    pub depths: [f64; 2],
    /// Sum of the depths.
    pub sums: [f64; 2],
    /// The step after which the planes of the quadratics are on.
    on: Vector3<f64>,
}

/// A body from an anchor: the planes that are on after a step count.
struct After {
    /// The anchor and the step in the particle's own frame.
    y: Vector3<f64>,
    e: Vector3<f64>,
    early: f64,
}

impl After {
    fn of(body: &Body, local: &Local, v: &Vector3<f64>) -> Self {
        let e = body.turn(v);
        Self { y: *local.point(), e, early: body.particle.bounds.longest_normal * e.norm() * (1.0 + 1e-14) }
    }
}

/// The depth of a plane after a step: the same sum, however it is asked for.
fn depth(n: &Vector3<f64>, excess: f64, e: &Vector3<f64>) -> f64 {
    excess + (n.x * e.x + n.y * e.y + n.z * e.z)
}

impl Place for After {
    fn point(&self) -> &Vector3<f64> {
        &self.y
    }

    fn early(&self) -> f64 {
        self.early
    }

    fn counts(&self, particle: &Particle, i: usize, excess: f64) -> bool {
        depth(&particle.normal(i), excess, &self.e) > 0.0
    }
}

impl Anchor<'_> {
    /// The point and λ of the target.
    pub fn saddle(&self, lambda: f64, enough: f64, models: &mut u32) -> Option<Saddle> {
        let (mut low, mut high) = (-FARTHEST, FARTHEST);
        let (mut found_low, mut found_high) = (false, false);
        let mut at = lambda.ln().clamp(low, high);
        let mut v = Vector3::zeros();
        let (mut width, mut failed) = (f64::INFINITY, 0);
        let soft = local_model::softest(self.bodies[0], self.bodies[1]);
        let flat = self.bodies[0].most_surplus(1.0).max(self.bodies[1].most_surplus(1.0));
        let (mut least, mut idle) = (f64::INFINITY, 0);
        let (mut beyond, mut checked) = (0, false);
        for round in 0..MOST_WEIGHTS {
            let from = v;
            let at_lambda = self.minimise(at.exp(), &mut v, models)?;
            let on = v;
            failed += u32::from(at_lambda.step.planes != Planes::Exact);
            if failed > MOST_FAILED {
                return Some(at_lambda);
            }
            let (s_a, s_b) = at_lambda.step.optimum.values;
            let (growing, falling) = self.target.sides(s_a, s_b);
            let difference = growing - falling;
            if !difference.is_finite() {
                return None;
            }
            let model = Model::new(&at_lambda.expansion.q_a, &at_lambda.expansion.q_b, soft, self.target);
            let better = model.search(at_lambda.step.optimum.lambda, enough * growing.max(falling))?;
            let saddle = self.judge(&at_lambda.expansion, better, &on);
            let done = better.settled
                || self.target.mismatch(better.values.0, better.values.1) <= enough * growing.max(falling);
            if saddle.step.planes == Planes::Exact && done {
                return Some(saddle);
            }
            if difference > 0.0 {
                (high, found_high) = (at, true);
            } else {
                (low, found_low) = (at, true);
            }
            let gained = difference.abs() < 0.5 * least;
            let pointless = difference.abs() <= IDLE * flat || high - low <= NARROW;
            idle = if found_low && found_high && !gained && pointless { idle + 1 } else { 0 };
            least = if gained { difference.abs() } else { least };
            let ended = match (found_low, found_high) {
                _ if idle > MOST_IDLE => true,
                (true, true) => high - low <= 4.0 * f64::EPSILON * (1.0 + at.abs()),
                // At the end of its range: the other body has the say no more.
                (true, false) => low >= FARTHEST,
                (false, true) => high <= -FARTHEST,
                (false, false) => true,
            };
            if ended {
                return Some(at_lambda);
            }
            let proposed = better.lambda.ln();
            // Found from the other side, where forces are but rounding, an end may not be one for the planes that are on now.
            let outside = found_low && found_high && v == from && !(low < proposed && proposed < high);
            beyond = if outside { beyond + 1 } else { 0 };
            let next = match (found_low, found_high) {
                (true, true) if beyond >= MOST_BEYOND && !checked => {
                    checked = true;
                    if proposed >= high { high } else { low }
                }
                (true, false) => proposed.clamp(low + 0.1, low + STRIDE).min(FARTHEST),
                (false, true) => proposed.clamp(high - STRIDE, high - 0.1).max(-FARTHEST),
                // Every other time the bracket has to shrink to half, or is halved.
                _ if round % 2 == 1 && high - low > 0.5 * width => 0.5 * (low + high),
                _ if low < proposed && proposed < high => proposed,
                _ => 0.5 * (low + high),
            };
            if round % 2 == 1 {
                width = high - low;
            }
            at = next;
        }
        None
    }

    /// The minimum of the weighted sum from the step `v` on, which is moved along.
    fn minimise(&self, lambda: f64, v: &mut Vector3<f64>, models: &mut u32) -> Option<Saddle> {
        let (a, b) = self.target.weights(lambda);
        let soft = local_model::softest(self.bodies[0], self.bodies[1]);
        let (mut steps, mut stalls) = (0, 0);
        let short = SHORT * self.locals[0].blur.max(self.locals[1].blur);
        loop {
            if *models >= self.most {
                return None;
            }
            *models += 1;
            steps += 1;
            let places = [0, 1].map(|i| After::of(self.bodies[i], &self.locals[i], v));
            let mut expansion = Expansion::about(self.bodies, self.x, self.locals, &places, (a, b));
            self.tie(&mut expansion);
            let optimum = Model::new(&expansion.q_a, &expansion.q_b, soft, self.target).at(lambda)?;
            let mut saddle = self.judge(&expansion, optimum, v);
            if saddle.step.planes == Planes::Exact || steps >= MOST_STEPS || stalls > 2 * MOST_STALLS {
                return Some(saddle);
            }
            let way = saddle.step.v - *v;
            // Where a plane takes turns over a distance of nothing, its pull is but a doubt.
            if stalls >= MOST_STALLS && saddle.step.planes == Planes::Pulling && way.norm() <= short {
                saddle.step.planes = Planes::Exact;
                return Some(saddle);
            }
            let share = self.descend(v, &way, (a, b));
            let mut next = *v + share * way;
            let nudged = self.through && next == *v && saddle.step.planes == Planes::Met;
            if nudged {
                next = *v + (GRAIN * v.norm() / way.norm()).min(1.0) * way;
            }
            if next == *v || !next.iter().all(|c| c.is_finite()) {
                return Some(saddle);
            }
            stalls = if nudged || (next - *v).norm() <= short { stalls + 1 } else { 0 };
            *v = next;
        }
    }

    /// What the step of an optimum does to the planes that were on after `v`.
    fn judge(&self, expansion: &Expansion, optimum: Optimum, v: &Vector3<f64>) -> Saddle {
        let step = expansion.to_solver(&optimum.step);
        let (mut depths, mut sums) = ([0.0; 2], [0.0; 2]);
        let verdicts = [0, 1].map(|i| {
            let body = self.bodies[i];
            let (on, e) = (After::of(body, &self.locals[i], v), body.turn(&step));
            let p = body.particle;
            let far = on.early.max(p.bounds.longest_normal * e.norm() * (1.0 + 1e-14));
            let (mut planes, mut doubtful, mut pulled) = (Planes::Exact, 0.0, 0.0);
            let (mut lowest, mut push, mut near) = (f64::INFINITY, f64::INFINITY, 0.0);
            let least = if body.plane_curvature() > 0.0 { self.noise[i] / body.plane_curvature() } else { 0.0 };
            p.visit_near(&on.y, far, |_, n, excess| {
                let after = depth(&n, excess, &e);
                let doubt = least + DOUBT * (excess.abs() + n.component_mul(&e).abs().sum());
                if depth(&n, excess, &on.e) > 0.0 {
                    depths[i] = after.max(depths[i]);
                    sums[i] += after.max(0.0);
                    lowest = after.min(lowest);
                    push = push.min(after * n.norm());
                    near += 1.0;
                    if after < -doubt {
                        planes = planes.max(Planes::Pulling);
                        pulled -= n.norm() * after;
                    } else if after < doubt {
                        doubtful += n.norm() * (doubt + (-after).max(0.0));
                    }
                } else if after > -self.locals[i].blur {
                    near += 1.0;
                    if after > doubt {
                        planes = planes.max(Planes::Met);
                    }
                }
            });
            let pull = body.plane_curvature() * sums[i];
            Verdict { planes, drop: None, doubtful: doubtful + pulled, least: lowest, push, pull, near }
        });
        let planes = verdicts[0].planes.max(verdicts[1].planes);
        Saddle { expansion: *expansion, step: Step { optimum, v: step, verdicts, planes }, depths, sums, on: *v }
    }

    /// Ties the quadratics to the anchor by springs that rounding cannot tell from nothing.
    fn tie(&self, expansion: &mut Expansion) {
        for (q, noise) in [(&mut expansion.q_a, self.noise[0]), (&mut expansion.q_b, self.noise[1])] {
            q.hessian = q.hessian.scaled(1.0, noise / self.reach);
        }
    }

    /// The share of a Newton step `way` from `v` at which the weighted sum is least.
    ///
    /// The step ends where the slope is zero if no plane switches, which says all about the slope but what the planes that
    /// switch add. So told it is free of the rounding of large forces that cancel: at v it always points down.
    fn descend(&self, v: &Vector3<f64>, way: &Vector3<f64>, weights: (f64, f64)) -> f64 {
        let sides = [(0, weights.0), (1, weights.1)].map(|(i, weight)| {
            let body = self.bodies[i];
            let (on, d) = (After::of(body, &self.locals[i], v), body.turn(way));
            (body, on, d, weight, body.particle.bounds.longest_normal * d.norm() * (1.0 + 1e-14))
        });
        let mut curvature = 0.0;
        for (i, (body, on, d, weight, _)) in sides.iter().enumerate() {
            let mut squares = 0.0;
            body.particle.visit_near(&on.y, on.early, |_, n, excess| {
                let rate = n.dot(d);
                squares += if depth(&n, excess, &on.e) > 0.0 { rate * rate } else { 0.0 };
            });
            let spring = body.sphere_curvature() + self.noise[i] / self.reach;
            curvature += weight * (body.plane_curvature() * squares + spring * d.norm_squared());
        }
        let slope = |share: f64| {
            let (mut slope, mut change) = ((share - 1.0) * curvature, curvature);
            for (body, on, d, weight, far) in &sides {
                let stiffness = weight * body.plane_curvature();
                body.particle.visit_near(&on.y, on.early + share * far, |_, n, excess| {
                    let (before, rate) = (depth(&n, excess, &on.e), n.dot(d));
                    let after = before + share * rate;
                    if (before > 0.0) != (after > 0.0) {
                        let sign = if after > 0.0 { stiffness } else { -stiffness };
                        slope += sign * after * rate;
                        change += sign * rate * rate;
                    }
                });
            }
            (slope, change)
        };
        let (mut low, mut high, mut share) = (0.0, 1.0, 1.0);
        for _ in 0..MOST_TRIALS {
            let (slope, change) = slope(share);
            if slope.abs() <= FLAT * curvature || (slope < 0.0 && share == 1.0) {
                break;
            }
            if slope > 0.0 {
                high = share
            } else {
                low = share
            }
            let newton = share - slope / change;
            share = if low < newton && newton < high { newton } else { 0.5 * (low + high) };
            if !(low < share && share < high) {
                break;
            }
        }
        share
    }

    /// The optimum with its bounds; planes of the given bodies may be deeper by `shifts` than if they had their own weight.
    pub fn outcome(&self, given: [&Body; 2], saddle: &mut Saddle, shifts: [f64; 2]) -> Outcome {
        let (expansion, step) = (&mut saddle.expansion, &mut saddle.step);
        let soft = local_model::softest(self.bodies[0], self.bodies[1]);
        // Where λ was not found, it says nothing of the price of what is missing from a constraint.
        let priced = step.optimum.settled || self.target.held().is_none();
        // Without the springs, whose pull is left over.
        let places = [0, 1].map(|i| After::of(self.bodies[i], &self.locals[i], &saddle.on));
        let weights = self.target.weights(step.optimum.lambda);
        *expansion = Expansion::about(self.bodies, self.x, self.locals, &places, weights);
        expansion.anchored = true;
        let model = Model::new(&expansion.q_a, &expansion.q_b, soft, self.target);
        if let Some(optimum) = model.held(expansion.to_axes(&step.v), step.optimum.lambda) {
            step.optimum = optimum;
        }
        for (local, shift) in expansion.locals.iter_mut().zip(shifts) {
            local.blur += shift;
        }
        let mut outcome = Outcome::of(expansion, self.bodies, self.target, step, Care::Careful);
        outcome.refine(expansion, self.bodies, self.target, step);
        // The planes of the quadratics are not those of the anchor.
        outcome.beside = solution::beside(expansion, self.bodies, self.target, *step, &places);
        let ceiling = Ceiling { bodies: given, target: self.target, here: expansion };
        let followed = |v: Vector3<f64>| {
            let lowest = ceiling.lowest(v, outcome.lambda, outcome.estimate, outcome.upper);
            lowest + given[0].rounding_of_value(lowest)
        };
        if !priced {
            return Outcome { upper: outcome.upper.max(followed(step.v)), ..outcome };
        }
        if shifts == [0.0; 2] {
            return outcome;
        }
        // Where all planes of the softened bodies would be, were they shifted in by their depth and twice their rounding.
        let lambda = step.optimum.lambda;
        let (a, b) = self.target.weights(lambda);
        let mut slope = Vector3::zeros();
        for (i, weight) in [(0, a), (1, b)] {
            if shifts[i] > 0.0 {
                let after = After::of(self.bodies[i], &self.locals[i], &step.v);
                let mut normals = Vector3::zeros();
                self.bodies[i].normals(&after, |n| normals += n);
                let depth = saddle.depths[i] + 2.0 * self.locals[i].blur;
                slope += weight * self.bodies[i].plane_curvature() * depth * normals;
            }
        }
        let back = match &outcome.response {
            Some(response) => expansion.to_solver(&response.to(&expansion.to_axes(&slope))),
            None => Vector3::zeros(),
        };
        let values = [0, 1].map(|i| self.highest(given[i], i, &(step.v + back), shifts[i] > 0.0));
        let upper = self.target.merit(values[0], values[1], lambda);
        // No more than the rounding that both bounds have anyhow.
        if upper <= outcome.upper + outcome.rounding {
            return Outcome { upper: upper.max(outcome.upper), ..outcome };
        }
        // One move may not be all that it takes to follow the planes.
        Outcome { upper: outcome.upper.max(upper.min(followed(step.v + back))), ..outcome }
    }

    /// The given S after a step, with planes as near as rounding may have them if wanted.
    fn highest(&self, body: &Body, i: usize, v: &Vector3<f64>, rounded: bool) -> f64 {
        let local = if rounded { self.locals[i] } else { self.locals[i].blurred(0.0, 0.0) };
        body.inset(&local, v, 0.0, None).value
    }
}
