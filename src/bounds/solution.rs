//! Where a search ended, and how far that can be from the optimum.

use crate::bounds::rounding::{Care, Sway};
use crate::bounds::sensitivity::Response;
use crate::linalg::number::larger;
use crate::model::kkt_check::Planes;
use crate::model::local_model::{self, Doubt, Expansion, Step};
use crate::model::problem::Target;
use crate::pair::active_set::Place;
use crate::pair::placed_particle::Body;
use nalgebra::Vector3;

/// Largest factor by which a first guess changes λ.
const FAR: f64 = 20.0;

/// Where the solver ended; everything in the solver's frame, potentials as regularised.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outcome {
    pub x: Vector3<f64>,
    pub lambda: f64,
    /// ∇S_A and ∇S_B at the optimum.
    pub gradients: [Vector3<f64>; 2],
    /// Their lengths.
    pub steep: [f64; 2],
    /// S_A and S_B at x, which differ by rounding.
    pub values: [f64; 2],
    /// Best estimate of the optimal S.
    pub estimate: f64,
    /// Lower bound up to `rounding`.
    pub lower: f64,
    /// Merit of a point that was evaluated: an upper bound up to `rounding`.
    pub upper: f64,
    /// Bound on the rounding of both.
    pub rounding: f64,
    /// Whether that may be narrowed, which would hardly narrow the gap.
    pub rough: bool,
    pub iterations: u32,
    pub ending: Ending,
    /// Whether every plane of the quadratics pushes beyond doubt.
    pub sure: bool,
    /// How fast the two sides of the target part with ln λ, where known; else 0.
    pub rate: f64,
    /// How the optimum answers to changes of its data, where it is that of known quadratics.
    pub response: Option<Response>,
    /// Bounds on the rounding of the sums for S_A and S_B.
    pub sums: [f64; 2],
    /// Bound on how far planes that do not count, and may be on by rounding, move the point.
    pub beside: f64,
}

impl Outcome {
    /// Of a search that has found nothing.
    pub const UNKNOWN: Self = Self {
        x: Vector3::new(f64::NAN, f64::NAN, f64::NAN),
        lambda: 1.0,
        gradients: [Vector3::new(f64::NAN, f64::NAN, f64::NAN); 2],
        steep: [f64::NAN; 2],
        values: [f64::NAN; 2],
        estimate: f64::NAN,
        lower: f64::NEG_INFINITY,
        upper: f64::INFINITY,
        rounding: f64::INFINITY,
        rough: false,
        iterations: 0,
        ending: Ending::Stuck,
        sure: false,
        rate: 0.0,
        response: None,
        sums: [f64::INFINITY; 2],
        beside: 0.0,
    };

    /// The optimum that a step leads to, with its bounds.
    #[inline(always)]
    pub fn of(here: &Expansion, bodies: [&Body; 2], target: Target, step: &Step, care: Care) -> Self {
        let (optimum, soft, lambda) = (&step.optimum, local_model::softest(bodies[0], bodies[1]), step.optimum.lambda);
        let (s_a, s_b) = optimum.values;
        let estimate = target.dual(s_a, s_b, lambda);
        let upper = match step.planes {
            Planes::Exact => target.merit(s_a, s_b, lambda),
            _ => here.merit(target, lambda),
        };
        let steep = [optimum.gradients[0].norm(), optimum.gradients[1].norm()];
        let sway = Sway::of(here, bodies, step, steep);
        let bound = sway.bound(target, optimum, care);
        let force = target.dual_weighted(steep[0], steep[1], lambda);
        let negligible = bound.unwrap_or_else(|| sway.least(target, lambda));
        let Doubt { mut height, decided, held } = here.doubt(bodies, target, step, upper, force, negligible);
        if care == Care::Careful && decided && height > negligible {
            height = height.min(here.remnant(bodies, target, step, upper, force));
        }
        let (rounding, rough) = match bound {
            Some(rounding) => (rounding, false),
            None if care == Care::Once => sway.decisive(here, bodies, target, *step, 0.0),
            None => sway.decisive(here, bodies, target, *step, height),
        };
        let is_beside = step.verdicts[0].has_beside(&here.q_a) || step.verdicts[1].has_beside(&here.q_b);
        let beside = if is_beside { beside(here, bodies, target, *step, &here.locals) } else { 0.0 };
        Self {
            x: here.x + step.v,
            lambda,
            gradients: [here.to_solver(&optimum.gradients[0]), here.to_solver(&optimum.gradients[1])],
            steep,
            values: [s_a, s_b],
            estimate,
            lower: estimate - height,
            upper,
            rounding,
            rough,
            iterations: 0,
            ending: Ending::Stuck,
            sure: decided && held,
            rate: optimum.rate(target),
            response: optimum.response(target, soft),
            sums: sway.sums,
            beside,
        }
    }

    /// Narrows its rounding as far as it can be, which takes time.
    #[cold]
    #[inline(never)]
    pub fn refine(&mut self, here: &Expansion, bodies: [&Body; 2], target: Target, step: &Step) {
        if self.rough {
            let sway = Sway::of(here, bodies, step, self.steep);
            (self.rounding, self.rough) = sway.decisive(here, bodies, target, *step, 0.0);
        }
    }

    /// The same of the point where the step began, which is no optimum of known quadratics.
    pub fn at(self, here: &Expansion) -> Self {
        Self { x: here.x, values: [here.q_a.value, here.q_b.value], response: None, ..self }
    }

    /// The λ of a closest point, as seen from midway.
    ///
    /// Where a single curvature decides along their common curve, as for two spheres or two faces, 1/√S of the held body is
    /// linear in its weight μ beside the other's: this is Newton's step to where it is 1.
    pub fn towards(&self, target: Target) -> f64 {
        let weights = Target::Midway.weights(self.lambda);
        let (rate_a, rate_b) = Target::Midway.apart(0.0, -self.rate, weights);
        let on_b = target == Target::OnB;
        // S and dS/d ln μ.
        let (s, rate) = if on_b { (self.values[1], rate_b) } else { (self.values[0], -rate_a) };
        let change = 1.0 + 2.0 * (1.0 - s.sqrt()) * s / rate;
        // NaN and what is far fail the test.
        if !(change > 1.0 / FAR && change < FAR) {
            self.lambda
        } else if on_b {
            self.lambda * change
        } else {
            self.lambda / change
        }
    }

    /// Whether the optimum exceeds 1 for sure, where a regularisation adds no more than `flat`: what it adds proves nothing.
    #[inline]
    pub fn separates(&self, flat: f64) -> bool {
        self.lower - self.rounding - flat > 1.0
    }

    /// What rounding leaves at the optimum itself, with the least that it can do to the places of the planes.
    #[inline(always)]
    pub fn least_rounding(&self, here: &Expansion, target: Target) -> f64 {
        let of_a = here.locals[0].least_rounding(self.steep[0]);
        let of_b = here.locals[1].least_rounding(self.steep[1]);
        target.dual_weighted(of_a, of_b, self.lambda)
    }

    /// Bound on the error of the optimal S.
    #[inline]
    pub fn gap(&self) -> f64 {
        self.upper - self.lower + self.rounding
    }
}

/// Why the solver stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ending {
    /// The bounds meet within the tolerance.
    Converged,
    /// The bounds meet within rounding, which is more than the tolerance.
    RoundingLimited,
    /// The lower bound exceeds 1, which was enough.
    Separated,
    /// Neither: from elsewhere it may come to an end.
    Stuck,
    /// Neither: planes take turns, or stay in doubt, as they would from elsewhere. There is no outcome, or one with bounds that another
    /// solver should better.
    Circling,
}

impl Ending {
    /// Whether the outcome is one.
    pub fn is_answer(self) -> bool {
        !matches!(self, Self::Stuck | Self::Circling)
    }
}

/// Bound on what planes that do not count in the quadratics, which are those of `places`, and may be on by rounding, do to the
/// point: each pushes, and raises S by w·depth².
#[cold]
#[inline(never)]
pub(crate) fn beside(
    here: &Expansion,
    bodies: [&Body; 2],
    target: Target,
    step: Step,
    places: &[impl Place; 2],
) -> f64 {
    // Without a response there is no bound that this would add to.
    let Some(response) = step.optimum.response(target, local_model::softest(bodies[0], bodies[1])) else { return 0.0 };
    let (a, b) = target.weights(step.optimum.lambda);
    let (mut planes, mut raised) = (Vec::new(), 0.0);
    for (i, (body, weight)) in bodies.into_iter().zip([a, b]).enumerate() {
        let local = body.blurred(&here.locals[i], step.v.norm());
        body.beside(&places[i], &local, &step.v, |n, depth, blur| {
            let depth = larger(depth, 0.0) + blur;
            raised += response.to_body_value(i, target) * body.plane_weight() * depth * depth;
            planes.push((here.to_axes(&body.to_solver(n)), weight * body.plane_curvature(), depth));
        });
    }
    // What S is raised by moves the point into the planes, too.
    raised
        + response.to_planes_beside(planes.into_iter().map(|(n, stiff, depth)| (n, stiff, depth + n.norm() * raised)))
}
