//! f and its derivatives, for solvers that do not mind which f it is.

use nalgebra::{Matrix3, Vector3};
use potential_particles::Particle;
use potential_particles::internals::potential;

/// f = S − 1, ∇f and ∇²f at a point.
#[derive(Clone, Copy)]
pub struct Expansion {
    pub f: f64,
    pub gradient: Vector3<f64>,
    pub hessian: Matrix3<f64>,
}

/// A potential function in the local frame of its particle.
pub trait Potential {
    /// f, ∇f, ∇²f at a local point.
    fn at(&self, y: &Vector3<f64>) -> Expansion;
    /// Length by which steps are judged.
    fn length(&self) -> f64;
}

/// The second-degree potential of the library.
impl Potential for &Particle {
    fn at(&self, y: &Vector3<f64>) -> Expansion {
        let q = potential::local(self, y);
        Expansion { f: q.value - 1.0, gradient: q.gradient, hessian: q.hessian.matrix() }
    }

    fn length(&self) -> f64 {
        self.bounding_radius()
    }
}
