//! Harkness's particle: the Macaulay terms to the third power, so that second derivatives are continuous.
//!
//! ```text
//! f(x) = (1−k)/r³ · Σ ⟨n_i·x − d_i⟩³  +  k/R² · |x|²  −  1
//! ```
//!
//! With the planes, r, R and k of the second-degree particle this is another, slightly larger or
//! smaller body: for k = 0 the faces agree, while edges and corners follow a³ + b³ = r³ instead of
//! a circle; for k > 0 the faces differ a little as well.

use super::potential::{Expansion, Potential};
use nalgebra::{Matrix3, Vector3};
use potential_particles::Particle;

/// The third-degree particle with the same planes, r, k and R.
pub struct Cubic {
    normals: Vec<Vector3<f64>>,
    offsets: Vec<f64>,
    plane_weight: f64,
    sphere_weight: f64,
    length: f64,
}

impl Cubic {
    pub fn new(particle: &Particle) -> Self {
        let (r, k, shadow) = (particle.rounding_radius(), particle.sphericity(), particle.shadow_radius());
        Self {
            normals: particle.planes().map(|plane| plane.normal).collect(),
            offsets: particle.planes().map(|plane| plane.offset).collect(),
            plane_weight: if k < 1.0 { (1.0 - k) / r.powi(3) } else { 0.0 },
            sphere_weight: if k > 0.0 { k / (shadow * shadow) } else { 0.0 },
            length: particle.bounding_radius(),
        }
    }
}

impl Potential for &Cubic {
    fn at(&self, y: &Vector3<f64>) -> Expansion {
        let mut f = self.sphere_weight * y.norm_squared() - 1.0;
        let mut gradient = 2.0 * self.sphere_weight * y;
        let mut hessian = Matrix3::from_diagonal_element(2.0 * self.sphere_weight);
        for (n, d) in self.normals.iter().zip(&self.offsets) {
            let excess = n.dot(y) - d;
            if excess > 0.0 {
                let weighted = self.plane_weight * excess;
                f += weighted * excess * excess;
                gradient += 3.0 * weighted * excess * n;
                hessian += 6.0 * weighted * n * n.transpose();
            }
        }
        Expansion { f, gradient, hessian }
    }

    fn length(&self) -> f64 {
        self.length
    }
}
