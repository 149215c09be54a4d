//! Houlsby's method: Newton–Raphson on the conditions of Lagrange, in the point and the multiplier.
//!
//! ```text
//! closest (paper eq. 3)   minimise f_A       with f_B = 0        L = f_A + λ·f_B
//! midway  (paper eq. 4)   minimise f_A + f_B with f_A − f_B = 0  L = f_A + f_B + λ·(f_A − f_B)
//!
//! [ ∇²L   ∇c ] [Δx]     [ ∇L ]
//! [ ∇cᵀ   0  ] [Δλ] = − [ c  ]        c: what the constraint wants to be zero
//! ```
//!
//! It starts in the middle of the line of centres. The equations hold at every stationary point, also at
//! the far side of a particle: the multiplier tells which one was found.

use super::Solution;
use super::potential::{Expansion, Potential};
use nalgebra::{Matrix4, Vector3, Vector4};
use potential_particles::internals::Pair;
use potential_particles::{Formulation, Pose};
use std::cmp::Ordering;

/// Most Newton steps.
const MOST_STEPS: usize = 100;
/// Most halvings of one step.
const MOST_HALVINGS: usize = 30;

/// How to step.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Stepping {
    /// The full step, always.
    Plain,
    /// Half the step until the equations are met better than before.
    Halving,
}

/// The two particles, seen from B.
pub struct Equations<'a, P> {
    pub a: P,
    pub b: P,
    pub pair: &'a Pair<'a>,
    pub formulation: Formulation,
}

/// The equations at one point.
struct Conditions {
    slope: Vector3<f64>,
    constraint: f64,
    matrix: Matrix4<f64>,
    potentials: [f64; 2],
}

impl<P: Potential> Equations<'_, P> {
    /// Solves from the middle of the centre line. A step below `tolerance` (relative to the smaller particle) that
    /// leaves the constraint met to `tolerance` ends it.
    pub fn solve(&self, tolerance: f64, stepping: Stepping, pose_b: &Pose) -> Result<Solution, String> {
        self.solve_from(0.5 * self.pair.centre, tolerance, stepping, pose_b)
    }

    /// The same from any point, frame of B.
    pub fn solve_from(
        &self,
        start: Vector3<f64>,
        tolerance: f64,
        stepping: Stepping,
        pose_b: &Pose,
    ) -> Result<Solution, String> {
        let length = self.a.length().min(self.b.length());
        let mut x = start;
        // Equal weights of both gradients, in either formulation.
        let mut multiplier = if self.formulation == Formulation::Midway { 0.0 } else { 1.0 };
        let mut here = self.at(&x, multiplier);
        for _ in 0..MOST_STEPS {
            let right = -Vector4::new(here.slope.x, here.slope.y, here.slope.z, here.constraint);
            let step = here.matrix.lu().solve(&right).ok_or("singular matrix")?;
            if !step.iter().all(|v| v.is_finite()) {
                return Err("singular matrix".into());
            }
            let (dx, dl) = (step.xyz(), step.w);
            let mut next = self.at(&(x + dx), multiplier + dl);
            let mut part = 1.0;
            let close = dx.norm() <= tolerance * length;
            if stepping == Stepping::Halving && !close {
                let before = here.mismatch(length);
                let mut halvings = 0;
                // Also when it is not a number.
                while next.mismatch(length).partial_cmp(&before) != Some(Ordering::Less) {
                    if halvings == MOST_HALVINGS {
                        return Err("no step meets the equations better".into());
                    }
                    halvings += 1;
                    part *= 0.5;
                    next = self.at(&(x + part * dx), multiplier + part * dl);
                }
            }
            x += part * dx;
            multiplier += part * dl;
            here = next;
            if close && here.constraint.abs() <= tolerance {
                return self.judged(&x, multiplier, &here, pose_b);
            }
            if !here.constraint.is_finite() {
                return Err("diverged".into());
            }
        }
        Err(format!("not converged in {MOST_STEPS} steps"))
    }

    /// The solution, if the multiplier says that it is the wanted one.
    fn judged(&self, x: &Vector3<f64>, multiplier: f64, here: &Conditions, pose_b: &Pose) -> Result<Solution, String> {
        let (wanted, f) = match self.formulation {
            Formulation::Midway => (multiplier.abs() <= 1.0, here.potentials[0].max(here.potentials[1])),
            Formulation::Closest => (multiplier >= 0.0, here.potentials[0]),
        };
        if !wanted {
            return Err("wrong stationary point".into());
        }
        Ok(Solution { s: (f + 1.0).max(0.0).sqrt(), point: pose_b.rotate(x) })
    }

    fn at(&self, x: &Vector3<f64>, multiplier: f64) -> Conditions {
        let rotation = &self.pair.rotation;
        let local = self.a.at(&self.pair.in_a(x));
        let a = Expansion {
            f: local.f,
            gradient: rotation * local.gradient,
            hessian: rotation * local.hessian * rotation.transpose(),
        };
        let b = self.b.at(x);
        let (weights, constraint, across) = match self.formulation {
            Formulation::Midway => ((1.0 + multiplier, 1.0 - multiplier), a.f - b.f, a.gradient - b.gradient),
            Formulation::Closest => ((1.0, multiplier), b.f, b.gradient),
        };
        let slope = weights.0 * a.gradient + weights.1 * b.gradient;
        let curvature = weights.0 * a.hessian + weights.1 * b.hessian;
        let mut matrix = Matrix4::zeros();
        matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&curvature);
        matrix.fixed_view_mut::<3, 1>(0, 3).copy_from(&across);
        matrix.fixed_view_mut::<1, 3>(3, 0).copy_from(&across.transpose());
        Conditions { slope, constraint, matrix, potentials: [a.f, b.f] }
    }
}

impl Conditions {
    /// How far the equations are from being met, without unit.
    fn mismatch(&self, length: f64) -> f64 {
        (length * self.slope.norm()).hypot(self.constraint)
    }
}
