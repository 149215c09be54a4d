//! How far an answer can be from the optimum, from the answer's own numbers.
//!
//! For any weight u the minimum over x of (1−u)S_A + u·S_B is a lower bound of t², and any point x gives
//! the upper bound max(S_A, S_B). The solver's quadratic model with the multipliers ⟨n·x − d⟩ + n·v ≥ 0 is
//! such a minimum, solved exactly, so that its value is a lower bound too. What remains is rounding: the
//! distances to the planes carry an error proportional to the lengths they are made from, times the
//! pull 2(1−k)/r² Σ⟨·⟩ of the planes; that product is the condition number of S, and it is added.

use crate::bounds::rounding::Care;
use crate::bounds::solution::{Ending, Outcome};
use crate::linalg::number::{larger, smaller};
use crate::model::kkt_check::Planes;
use crate::model::local_model::{self, Expansion, Factorisation, Start, TURN};
use crate::model::problem::Target;
use crate::pair::placed_particle::Body;
use nalgebra::Vector3;

/// Bound on |s − s*| for s = √(true S estimate), see [`scale`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Certified {
    /// Best estimate of s.
    pub s: f64,
    /// |s − s*| ≤ gap.
    pub gap: f64,
    /// s* ≥ low.
    pub low: f64,
}

/// The scale s of an outcome, with the regularisation taken out again, and the bound on its error.
#[inline(always)]
pub(crate) fn scale(outcome: &Outcome, a: &Body, b: &Body, target: Target) -> Certified {
    let weighted = |of_a, of_b| target.dual_weighted(of_a, of_b, outcome.lambda);
    // Regularised S exceeds S by at most this where the optimum can be.
    let level = larger(outcome.upper, 1.0);
    let most = weighted(a.most_surplus(level), b.most_surplus(level));
    let square = larger(outcome.estimate - weighted(a.surplus(&outcome.x), b.surplus(&outcome.x)), 0.0);
    let low = larger(outcome.lower - most - outcome.rounding, 0.0);
    let high = larger(larger(outcome.upper, outcome.lower), square) + outcome.rounding;
    let low = smaller(low, square);
    let s = square.sqrt();
    let low = low.sqrt() * (1.0 - f64::EPSILON);
    Certified { s, gap: larger(high.sqrt() - s, s - low) + f64::EPSILON * s + UNDERFLOW, low }
}

/// Root of the least normal number: an s below it has a square that is lost.
const UNDERFLOW: f64 = 1.5e-154;

/// Bound on the distance from the point of an outcome to the optimum, length.
///
/// Where the optimum is that of known quadratics, only their data is in doubt: each plane's distance by its
/// rounding, each body's force a·∇S_A by the rounding of its direction. The answer of the optimum to each is
/// a linear problem that is solved already, and the lengths are added. Elsewhere strong convexity bounds it:
/// ½·curvature·distance² ≤ upper − lower. So it is where planes were softened: as stiff as they are, they move the point
/// by more than the first order tells.
#[inline(always)]
pub(crate) fn distance(outcome: &Outcome, expansion: &Expansion, a: &Body, b: &Body, target: Target) -> f64 {
    let weights = target.weights(outcome.lambda);
    let convexity = || {
        let soft = local_model::softest(a, b);
        let excess = (outcome.upper - outcome.lower).max(0.0) + outcome.rounding;
        (2.0 * excess / (weights.0 * soft.0 + weights.1 * soft.1)).sqrt()
    };
    let known = outcome.sure && expansion.softened.is_none();
    let Some(response) = outcome.response.as_ref().filter(|_| known) else { return convexity() };
    let step = outcome.x - expansion.x;
    let (length, in_axes) = (step.norm(), expansion.to_axes(&step));
    let turn = TURN * f64::EPSILON * response.per_slope(a.particle.dimensions);
    let (mut sum, mut sides) = (response.unsolved() + outcome.beside, [0.0; 2]);
    for (i, (body, q, weight)) in
        [(a, &expansion.q_a, weights.0), (b, &expansion.q_b, weights.1)].into_iter().enumerate()
    {
        let (shift, blur) = body.after(&expansion.locals[i], length);
        let planes = response.to_planes(i, q, target, outcome.lambda, body.plane_weight());
        // The force, rounded at either end of the step.
        let force = weight * (outcome.steep[i] + q.gradient.norm());
        let terms = q.terms(&in_axes);
        sum += shift + blur * planes + force * turn + response.to_sums(q, weight, terms);
        sides[i] = SIDES * f64::EPSILON * q.expansion + outcome.sums[i] + body.sphere_slope(outcome.values[i]) * shift;
    }
    // The two sides meet to what was left, and to the rounding of what they are summed from. The centre of a sphere that is
    // off by the shift moves the slope by its share, less than the shift moves the point, but S by more.
    let left = target.mismatch(outcome.values[0], outcome.values[1]);
    let (side_a, side_b) = target.changes(sides[0], sides[1]);
    sum += response.to_value(left + side_a + side_b + SIDES * f64::EPSILON * larger(outcome.upper, 1.0));
    // Carried along from the point of expansion, and rounded at the end.
    let carried = TURN * f64::EPSILON * (length + outcome.x.norm());
    // Where both gradients vanish, the response has no digits.
    if sum.is_finite() { sum + carried } else { convexity() + carried }
}

/// Units in the last place by which two sides that meet may still differ.
const SIDES: f64 = 8.0;

/// The merit of x, or of a point on the way to the centre of the body that x should be in and is not: λ may be wrong, and
/// with it the price of what is missing. s is convex on that way.
fn feasible(x: &Vector3<f64>, values: [f64; 2], bodies: [&Body; 2], target: Target) -> f64 {
    let Some((held, free)) = target.held() else { return values[0].max(values[1]) };
    let (s, centre) = (values[held].sqrt(), bodies[held].centre());
    if s <= 1.0 {
        return values[free];
    }
    let s0 = bodies[held].value(&centre).sqrt();
    let share = (1.0 - s0) / (s - s0);
    values[free].max(bodies[free].value(&(centre + share * (x - centre))))
}

/// One of the closest points.
pub(crate) struct Closest {
    pub x: Vector3<f64>,
    /// Ratio of weights λ = u/(1−u).
    pub lambda: f64,
    pub gradients: [Vector3<f64>; 2],
    pub steep: [f64; 2],
    /// S_A and S_B.
    pub values: [f64; 2],
    pub scale: Certified,
    /// Bound on the distance to the optimum.
    pub bound: f64,
}

impl Closest {
    pub fn of(outcome: &Outcome, here: &Expansion, a: &Body, b: &Body, target: Target) -> Self {
        let Outcome { x, lambda, gradients, steep, values, .. } = *outcome;
        let bound = distance(outcome, here, a, b, target);
        Self { x, lambda, gradients, steep, values, scale: scale(outcome, a, b, target), bound }
    }

    /// Whether the scale cannot be told from 0, as where a constraint is slack.
    pub fn tells_nothing(&self) -> bool {
        !(self.scale.s > self.scale.gap)
    }
}

/// A lower bound without the planes of doubtful sign, rounding taken off, near the point of an outcome.
///
/// S is nowhere larger without them. What they may pull costs no more where other planes hold the point than it can move
/// between those, while the doubt about their sign is counted as if nothing held it.
pub(crate) fn without_doubtful(outcome: &Outcome, bodies: [&Body; 2], target: Target) -> f64 {
    let start = Start { x: outcome.x, lambda: outcome.lambda, near: true };
    let mut expansion = Expansion::at(bodies, &start, target, Factorisation::Aligned);
    let mut lower = f64::NEG_INFINITY;
    for _ in 0..MOST_DROPS {
        // Along a face what holds the point may be but a plane of doubtful sign.
        let tied = expansion.tied(bodies, target, outcome.lambda);
        if let Some(step) = tied.filter(|step| step.planes <= Planes::Met) {
            let found = Outcome::of(&expansion, bodies, target, &step, Care::Careful);
            lower = lower.max(found.lower - found.rounding);
        }
        let Some(step) = expansion.optimum(bodies, target, outcome.lambda, 0.0) else { break };
        match step.planes {
            Planes::Pulling => break,
            Planes::Dropped => expansion.drop(bodies, &step, target, outcome.lambda, Factorisation::Aligned),
            Planes::Exact | Planes::Met => {
                let found = Outcome::of(&expansion, bodies, target, &step, Care::Careful);
                lower = lower.max(found.lower - found.rounding);
                // Without one more the optimum is lower still.
                if found.sure || found.estimate <= lower.max(outcome.lower - outcome.rounding) {
                    break;
                }
                expansion.drop_weakest(bodies, &step, target, outcome.lambda, Factorisation::Aligned);
            }
        }
    }
    lower
}

/// Most planes that are dropped for a lower bound.
const MOST_DROPS: u32 = 12;

/// Bounds for a point and a scale s that another solver found, with the ratio of weights λ that came with them.
///
/// Two dual bounds are tried: the quadratic model's where its multipliers are admissible, and the
/// linear one, φ(x) − |∇φ|·D, for any optimum within a distance D of x.
pub(crate) fn judge(x: &Vector3<f64>, lambda: f64, s: f64, a: &Body, b: &Body, target: Target) -> Outcome {
    let locals = [a.locate(x, 0.0), b.locate(x, 0.0)];
    let (q_a, q_b) = (a.at(&locals[0], None), b.at(&locals[1], None));
    let upper = feasible(x, [q_a.value, q_b.value], [a, b], target);
    let rounding = target.dual_weighted(a.rounding(&locals[0], &q_a), b.rounding(&locals[1], &q_b), lambda);
    let weights = target.weights(lambda);
    let bodies = [a, b];
    let slope = (weights.0 * q_a.gradient + weights.1 * q_b.gradient).norm();
    let linear = target.dual(q_a.value, q_b.value, lambda) - slope * local_model::farthest(bodies, x, upper);
    let mut lower = linear;
    // Planes that only seem to be on are dropped one by one, as in the solver.
    let start = Start { x: *x, lambda, near: true };
    let mut expansion = Expansion::at(bodies, &start, target, Factorisation::Aligned);
    while let Some(step) = expansion.optimum(bodies, target, lambda, 0.0) {
        match step.planes {
            Planes::Exact | Planes::Met => {
                let optimum = &step.optimum;
                let of_a = optimum.rounding(&expansion.q_a);
                let of_b = optimum.rounding(&expansion.q_b);
                let dual = target.dual(optimum.values.0, optimum.values.1, optimum.lambda);
                let force = target.dual_weighted(optimum.gradients[0].norm(), optimum.gradients[1].norm(), lambda);
                let doubt = expansion.doubt(bodies, target, &step, upper, force, 0.0).height;
                lower = lower.max(dual - doubt - target.dual_weighted(of_a, of_b, lambda));
                break;
            }
            Planes::Pulling => break,
            Planes::Dropped => expansion.drop(bodies, &step, target, lambda, Factorisation::Aligned),
        }
    }
    let gradients = [q_a.gradient, q_b.gradient];
    Outcome {
        x: *x,
        lambda,
        gradients,
        steep: gradients.map(|g| g.norm()),
        values: [q_a.value, q_b.value],
        estimate: s * s,
        lower,
        upper,
        rounding,
        iterations: 0,
        rough: false,
        ending: Ending::Converged,
        sure: false,
        rate: 0.0,
        response: None,
        sums: [f64::INFINITY; 2],
        beside: 0.0,
    }
}
