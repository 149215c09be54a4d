//! The unit of cost: one evaluation of S, ∇S and ∇²S, as plainly as it can be written.
//!
//! A yardstick of its own, so that the library cannot become "fewer evaluations" by evaluating more slowly. The
//! change of frame, bounds on rounding and whatever else a solver needs are not in it.

use nalgebra::Vector3;
use potential_particles::{Particle, Plane};

/// Planes in one array for each coefficient, and the weights of planes and sphere.
pub struct Plain {
    a: Vec<f64>,
    b: Vec<f64>,
    c: Vec<f64>,
    d: Vec<f64>,
    plane_weight: f64,
    sphere_weight: f64,
}

/// What an evaluation gives.
pub struct Expansion {
    pub value: f64,
    pub gradient: Vector3<f64>,
    /// xx, yy, zz, xy, yz, zx.
    pub hessian: [f64; 6],
}

impl Plain {
    /// A particle with 0 < k < 1.
    pub fn new(particle: &Particle) -> Self {
        let (r, k, shadow) = (particle.rounding_radius(), particle.sphericity(), particle.shadow_radius());
        Self::of(particle.planes().collect(), r, k, shadow)
    }

    /// Of planes that need not close.
    pub fn of(planes: Vec<Plane>, r: f64, k: f64, shadow: f64) -> Self {
        let column = |pick: fn(&Vector3<f64>) -> f64| planes.iter().map(|plane| pick(&plane.normal)).collect();
        Self {
            a: column(|n| n.x),
            b: column(|n| n.y),
            c: column(|n| n.z),
            d: planes.iter().map(|plane| plane.offset).collect(),
            plane_weight: (1.0 - k) / (r * r),
            sphere_weight: k / (shadow * shadow),
        }
    }

    /// S, ∇S, ∇²S at a local point. Never inlined: a solver calls it from more than one place.
    #[inline(never)]
    pub fn at(&self, y: &Vector3<f64>) -> Expansion {
        let mut square = 0.0;
        let mut g = Vector3::zeros();
        let mut h = [0.0; 6];
        for (((a, b), c), d) in self.a.iter().zip(&self.b).zip(&self.c).zip(&self.d) {
            let excess = a * y.x + b * y.y + c * y.z - d;
            if excess > 0.0 {
                square += excess * excess;
                g += excess * Vector3::new(*a, *b, *c);
                h[0] += a * a;
                h[1] += b * b;
                h[2] += c * c;
                h[3] += a * b;
                h[4] += b * c;
                h[5] += c * a;
            }
        }
        let (w, m) = (2.0 * self.plane_weight, 2.0 * self.sphere_weight);
        Expansion {
            value: self.plane_weight * square + self.sphere_weight * y.norm_squared(),
            gradient: w * g + m * y,
            hessian: [w * h[0] + m, w * h[1] + m, w * h[2] + m, w * h[3], w * h[4], w * h[5]],
        }
    }
}
