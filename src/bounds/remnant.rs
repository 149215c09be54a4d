//! What a slope that is left can hide, where the planes that are on say more than the spheres do.
//!
//! A step leaves a slope of a·S_A + b·S_B: what the solution missed, which is known, and the rounding of its sums and of the
//! directions of the forces, which is not. Both spheres together may be as soft as 1e-9 where a plane is as stiff as 1e16,
//! and far from both bodies the forces, and with them their rounding, are 1e10 times what they are at a contact. Counted
//! as if the spheres alone held the point, such a slope hides all but everything; but it does not get past the planes.
//!
//! The quadratics with depths ≥ 0 are a lower bound of S, and so they are at any other place that leaves their planes on.
//! The known part is taken away by a further step. Along a face that would be a long one, for nothing: a spring keeps it
//! short, and its force is left over, less than what is not known anyhow. Of the other part, no stationary point lies
//! further off than it takes the curvature of those planes to bring the slope to zero, as long as they are on; where the
//! bound is stationary, it is least, for it is convex.

use crate::linalg::symmetric::{Factor, Symmetric};
use crate::model::local_model::{self, Expansion, Step, TURN};
use crate::model::problem::Target;
use crate::model::quadratic_model::Model;
use crate::pair::active_set::Place;
use crate::pair::placed_particle::Body;
use nalgebra::Vector3;

/// Relative to the smaller particle, the length over which the spring weighs as much as what is not known.
const REACH: f64 = 1e-9;

/// Units in the last place of its trace by which an eigenvalue of the Hessian may be off.
const EIGENVALUE: f64 = 32.0;

impl Expansion {
    /// The step to the optimum at this λ with a spring that keeps it short where only what is not known would make it long.
    pub fn tied(&self, bodies: [&Body; 2], target: Target, lambda: f64) -> Option<Step> {
        let (a, b) = target.weights(lambda);
        let of_spheres = local_model::softest(bodies[0], bodies[1]);
        let force = a * self.q_a.gradient.norm() + b * self.q_b.gradient.norm();
        let spring = TURN * f64::EPSILON * force / (REACH * local_model::smallest(bodies));
        let hessian = self.q_a.hessian.weighted(a, &self.q_b.hessian, b);
        let least = a * of_spheres.0 + b * of_spheres.1 + spring;
        let tied = Factor::of(&hessian.scaled(1.0, spring), least)?;
        let step = -tied.solve(&(a * self.q_a.gradient + b * self.q_b.gradient));
        let optimum = Model::new(&self.q_a, &self.q_b, of_spheres, target).held(step, lambda)?;
        Some(self.step(bodies, optimum))
    }

    /// How far the dual value after a step may lie above a lower bound; infinite where a plane is in doubt. Other than
    /// [`Expansion::doubt`] it takes two factorisations. Forces that balance have the length `force`.
    #[cold]
    #[inline(never)]
    pub fn remnant(&self, bodies: [&Body; 2], target: Target, step: &Step, upper: f64, force: f64) -> f64 {
        let (a, b) = target.weights(step.optimum.lambda);
        let of_spheres = local_model::softest(bodies[0], bodies[1]);
        let soft = a * of_spheres.0 + b * of_spheres.1;
        let unknown = self.rounding_of_slope(step, (a, b)) + TURN * f64::EPSILON * force;
        let known = step.optimum.slope(target);
        let hessian = self.q_a.hessian.weighted(a, &self.q_b.hessian, b);
        let spring = unknown / (REACH * local_model::smallest(bodies));
        let Some(tied) = Factor::of(&hessian.scaled(1.0, spring), soft + spring) else { return f64::INFINITY };
        let further = -tied.solve(&known);
        let left = known + hessian.times(&further);
        let gained = -0.5 * further.dot(&(known + left));
        // How far every plane stays on from there.
        let depth = |i: usize| step.verdicts[i].least / bodies[i].particle.bounds.longest_normal;
        let stays = depth(0).min(depth(1)) - further.norm();
        if !(stays > 0.0) {
            return f64::INFINITY;
        }
        // Both the sums of what is left and the directions of the planes are rounded.
        let roots = hessian.diagonal().map(f64::sqrt);
        let of_way = TURN * f64::EPSILON * roots.norm() * roots.dot(&further.abs());
        let slope = unknown + of_way + left.norm();
        let stiff = least_curvature(&hessian, soft, bodies[0].particle.dimensions);
        let held =
            slope <= stiff * stays || self.holds(bodies, &(step.v + self.to_solver(&further)), slope, soft, &hessian);
        let curvature = if held { stiff } else { soft };
        let hidden = 0.5 * slope * slope / curvature;
        let farthest = local_model::farthest(bodies, &(self.x + step.v), upper) + further.norm();
        gained + unknown * further.norm() + hidden.min(slope * farthest)
    }
}

impl Expansion {
    /// Whether every plane stays on after a step where a slope of this length is still to be brought to zero, in whatever direction:
    /// by −H⁻¹ times the slope, which takes the depth of a plane down by |H⁻¹n| times its length at most. A stiff plane may be on
    /// by far less than a soft one needs.
    fn holds(&self, bodies: [&Body; 2], v: &Vector3<f64>, slope: f64, soft: f64, hessian: &Symmetric) -> bool {
        let Some(factor) = Factor::of(hessian, soft) else { return false };
        // The planes of a quadratic about an anchor are not those of its locals.
        let mut holds = !self.anchored;
        for (body, local) in bodies.into_iter().zip(&self.locals) {
            let e = body.turn(v);
            body.particle.visit_near(&local.y, local.early, |i, n, excess| {
                if local.counts(body.particle, i, excess) {
                    let given = factor.solve(&self.to_axes(&body.to_solver(n))).norm() * slope;
                    holds &= excess + n.dot(&e) >= AMPLE * given;
                }
            });
        }
        holds
    }
}

/// Rounding of what a plane gives way by, ample.
const AMPLE: f64 = 1.0 + 1e-2;

/// Lower bound of the curvature in any direction (in the plane: of its first two axes).
fn least_curvature(hessian: &Symmetric, soft: f64, dimensions: usize) -> f64 {
    let Some(factor) = Factor::of(hessian, soft) else { return soft };
    let inverse = factor.inverse();
    let trace = if dimensions == 2 { inverse.xx + inverse.yy } else { inverse.trace() };
    soft.max(1.0 / trace - EIGENVALUE * f64::EPSILON * hessian.trace())
}
