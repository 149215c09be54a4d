//! A potential at a point, and its derivatives in the pose and the shape of its body.

use super::answer::ShapeGradient;
use crate::linalg::symmetric::Symmetric;
use crate::pair::body::shift_in_a;
use crate::particle::particle::Particle;
use crate::particle::potential;
use crate::pose::Pose;
use nalgebra::{Matrix3, Vector3};

/// A body and a point, seen from its centre.
#[derive(Clone, Copy)]
pub(super) struct Place<'a> {
    pub particle: &'a Particle,
    /// Local to world.
    pub rotation: &'a Matrix3<f64>,
    /// From the centre to the point, world axes.
    pub branch: Vector3<f64>,
    /// Bound on the error of the point, length.
    pub error: f64,
    /// Weight of the shadow sphere that the solver used.
    pub sphere_weight: f64,
}

/// (Regularised) S about a point, in given axes.
#[derive(Clone, Copy)]
pub(super) struct Field {
    pub gradient: Vector3<f64>,
    pub hessian: Symmetric,
    /// Whether no plane is within the doubt about the point of being switched.
    pub clear: bool,
    /// Whether the active planes, by which the gradient is made, have lost most of their digits.
    pub imprecise: bool,
    /// Whether the particle's own potential has a slope, and not that of the regularisation alone.
    pub sloped: bool,
}

/// Share of the pull of the planes that their rounding may be, for four digits.
const IMPRECISE: f64 = 1e-5;

impl<'a> Place<'a> {
    pub fn new(particle: &'a Particle, pose: &'a Pose, branch: Vector3<f64>, error: f64, least_sphericity: f64) -> Self {
        let regularised = least_sphericity / particle.bounding_radius().powi(2);
        let sphere_weight = particle.sphere_weight.max(regularised);
        Self { particle, rotation: pose.rotation(), branch, error, sphere_weight }
    }

    /// The same body and another point, so far from this one.
    pub fn moved(&self, way: &Vector3<f64>) -> Self {
        Self { branch: self.branch + way, ..*self }
    }

    /// The point in the local frame.
    pub fn local(&self) -> Vector3<f64> {
        self.rotation.tr_mul(&self.branch)
    }

    /// How far the point may be off, and the excess of a plane with it.
    fn doubt(&self) -> [f64; 2] {
        let bounds = &self.particle.bounds;
        let length = self.branch.norm();
        let shift = self.error + shift_in_a(length, length);
        [shift, bounds.longest_normal * shift + f64::EPSILON * bounds.offset_within(length)]
    }

    /// S about the point in the axes that are the columns of a matrix, world axes.
    pub fn field(&self, axes: &Matrix3<f64>) -> Field {
        let turn = axes.tr_mul(self.rotation);
        let (y, [_, doubt]) = (self.local(), self.doubt());
        let q = potential::turned(self.particle, self.sphere_weight, |n| turn * n, &y, 0.0, |_, excess| excess > 0.0);
        let rounding = f64::EPSILON * (self.particle.bounds.longest_normal * self.branch.norm() + doubt);
        Field {
            gradient: q.gradient,
            hessian: q.hessian,
            clear: q.clear > doubt,
            imprecise: 2.0 * self.particle.plane_weight * f64::from(q.count) * rounding > IMPRECISE * q.pull,
            sloped: q.count > 0 || self.particle.sphere_weight > 0.0,
        }
    }

    /// S and ∇S at the point, world axes, of the particle itself.
    pub fn tangent(&self) -> (f64, Vector3<f64>) {
        let tangent = potential::tangent(self.particle, &self.local());
        (tangent.value, self.rotation * tangent.gradient)
    }

    /// Adds the derivative of σ·S + Γ·∇S at the point, Γ in world axes, in the shape.
    pub fn add_to_shape(&self, sigma: f64, gamma: &Vector3<f64>, sum: &mut ShapeGradient) {
        let shape = self.particle;
        let (y, gamma) = (self.local(), self.rotation.tr_mul(gamma));
        let w2 = 2.0 * shape.plane_weight;
        let mut of_weight = 0.0;
        let mut add = |place: usize, n: Vector3<f64>, excess: f64| {
            if excess > 0.0 {
                let (pull, along) = (sigma * excess + gamma.dot(&n), excess * gamma);
                let plane = &mut sum.planes[shape.given_index(place)];
                plane.normal += w2 * (pull * y + along);
                plane.offset -= w2 * pull;
                of_weight += excess * (sigma * excess + 2.0 * gamma.dot(&n));
            }
        };
        let (r, k, shadow) = (shape.rounding_radius(), shape.sphericity(), shape.shadow_radius());
        if shape.plane_weight > 0.0 {
            shape.visit_near(&y, 0.0, &mut add);
        } else if r > 0.0 {
            // At k = 1 the planes come on with the first step below it.
            (0..shape.len()).for_each(|i| add(i, shape.normal(i), shape.normal(i).dot(&y) - shape.offset(i)));
        }
        let of_sphere = sigma * y.norm_squared() + 2.0 * gamma.dot(&y);
        if r > 0.0 {
            sum.r -= w2 / r * of_weight;
            sum.k -= of_weight / (r * r);
        }
        if shadow > 0.0 {
            sum.k += of_sphere / (shadow * shadow);
            sum.shadow_radius -= 2.0 * k / shadow.powi(3) * of_sphere;
        }
    }
}
