//! A particle placed in the frame in which a pair is solved.

use crate::pair::Pair;
use crate::particle::Particle;
use crate::potential::{self, OnLine, Quadratic};
use nalgebra::{Matrix3, Vector3};

/// A particle with its pose in the solver's frame (local axes of B, origin at the centre of B).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Body<'a> {
    pub particle: &'a Particle,
    /// Local to solver frame.
    rotation: Matrix3<f64>,
    /// Centre in the solver frame.
    centre: Vector3<f64>,
    /// Weight of the shadow sphere that the solver uses: the particle's own, or the regularised one.
    sphere_weight: f64,
}

impl<'a> Body<'a> {
    /// Both bodies of a pair; k below `least_sphericity` is raised to it (see `Settings`).
    pub fn both(pair: &Pair<'a>, least_sphericity: f64) -> (Self, Self) {
        let body = |particle: &'a Particle, rotation, centre| Self {
            particle,
            rotation,
            centre,
            sphere_weight: particle.sphere_weight.max(least_sphericity / particle.bounding_radius().powi(2)),
        };
        (body(pair.a, pair.rotation, pair.centre), body(pair.b, Matrix3::identity(), Vector3::zeros()))
    }

    /// Solver frame to local frame.
    pub fn local(&self, x: &Vector3<f64>) -> Vector3<f64> {
        self.rotation.tr_mul(&(x - self.centre))
    }

    pub fn centre(&self) -> Vector3<f64> {
        self.centre
    }

    /// (Regularised) S at x with derivatives in the axes of `frame` (columns: axes in the solver frame).
    pub fn at(&self, x: &Vector3<f64>, frame: Option<&Matrix3<f64>>) -> Quadratic {
        let rotation = match frame {
            Some(axes) => axes.tr_mul(&self.rotation),
            None => self.rotation,
        };
        potential::in_frame(self.particle, self.sphere_weight, &rotation, &self.local(x))
    }

    /// (Regularised) S at x along the direction e.
    pub fn on_line(&self, x: &Vector3<f64>, e: &Vector3<f64>) -> OnLine {
        potential::on_line(self.particle, self.sphere_weight, &self.local(x), &self.rotation.tr_mul(e))
    }

    /// Largest curvature that one plane can give S.
    pub fn plane_curvature(&self) -> f64 {
        self.particle.plane_weight
    }

    /// Curvature of the shadow sphere's share of S, the least in any direction.
    pub fn sphere_curvature(&self) -> f64 {
        self.sphere_weight
    }

    /// How much the regularisation adds to S at x.
    pub fn surplus(&self, x: &Vector3<f64>) -> f64 {
        (self.sphere_weight - self.particle.sphere_weight) * (x - self.centre).norm_squared()
    }

    /// Upper bound of what the regularisation adds anywhere in {S ≤ `level`}.
    pub fn most_surplus(&self, level: f64) -> f64 {
        let reach = self.particle.reach(level);
        (self.sphere_weight - self.particle.sphere_weight) * reach * reach
    }

    /// Bound on the rounding of S at x, given the quadratic there: distances to planes are sums of terms
    /// as long as the point, the centre and the offsets, each known to a few units in the last place.
    pub fn rounding(&self, x: &Vector3<f64>, q: &Quadratic) -> f64 {
        let length = x.norm() + 2.0 * self.centre.norm() + self.particle.bounds.longest_offset;
        ROUNDING * f64::EPSILON * (q.pull * length + q.gradient.norm() * length + q.value)
    }

    /// Whether every plane that is active at x stays non-negative after the step v, up to rounding: then
    /// the quadratic model with those planes is a lower bound of S everywhere (its multipliers
    /// ⟨n·x − d⟩ + n·v are admissible in ⟨t⟩² ≥ 2λt − λ², λ ≥ 0).
    pub fn keeps_planes(&self, x: &Vector3<f64>, v: &Vector3<f64>) -> bool {
        let (y, e) = (self.local(x), self.rotation.tr_mul(v));
        let slack = ROUNDING * f64::EPSILON * (x.norm() + 2.0 * self.centre.norm() + self.particle.bounds.longest_offset);
        let p = self.particle;
        p.a.iter().zip(&p.b).zip(&p.c).zip(&p.d).all(|(((a, b), c), d)| {
            let excess = a * y.x + b * y.y + c * y.z - d;
            excess <= 0.0 || excess + a * e.x + b * e.y + c * e.z >= -slack
        })
    }

    /// Calls `visit` with the (solver frame) normal and weight of each plane that is active at x.
    pub fn active_rows(&self, x: &Vector3<f64>, mut visit: impl FnMut(Vector3<f64>, f64)) {
        let y = self.local(x);
        let p = self.particle;
        for i in 0..p.plane_count() {
            let n = p.normal(i);
            if n.dot(&y) > p.d[i] {
                visit(self.rotation * n, p.plane_weight);
            }
        }
    }
}

/// Units in the last place per length in [`Body::rounding`]; measured against 40-digit solutions.
const ROUNDING: f64 = 4.0;
