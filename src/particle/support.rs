//! The point of a particle that lies farthest along a direction u.
//!
//! It maximises u·x/g(x), g the gauge of the particle: a quotient of a linear and a convex function has no other
//! maxima. Where S is the quadratic of its active planes, the maximum is known in closed form; a step towards it that
//! does not rise is halved. Along a flat face, where a Hessian has no curvature, a little of it keeps the point where
//! it is.

use super::numbers::{ADDED, ALONG, Limits, NEARLY_ALONG};
use crate::particle::potential;
use crate::particle::ray_cast;
use crate::particle::solid::Solid;
use nalgebra::{Matrix3, Vector3};

/// The point of the surface that lies farthest along a unit vector, sought from a point near it; `None` where rounding
/// leaves no answer.
pub(crate) fn farthest(shape: &Solid, u: &Vector3<f64>, near: &Vector3<f64>) -> Option<Vector3<f64>> {
    let on_surface = |x: &Vector3<f64>| {
        let ray = x.try_normalize(0.0)?;
        Some(ray_cast::distance_near(shape, &Vector3::zeros(), &ray, x.norm())? * ray)
    };
    let mut x = on_surface(near)?;
    for _ in 0..Limits::SUPPORT_STEPS {
        let here = potential::local(shape, &x);
        let off = (here.gradient.try_normalize(0.0)? - u).norm();
        if off <= ALONG {
            return Some(x);
        }
        let (hessian, height) = (here.hessian.matrix(), u.dot(&x));
        let rises = |added: f64| {
            let curved = (hessian + Matrix3::from_diagonal_element(added * hessian.trace())).try_inverse()?;
            let (of_slope, of_height) = (curved * here.gradient, curved * u);
            let step = (here.gradient.dot(&of_slope) / u.dot(&of_height)).sqrt() * of_height - of_slope;
            let shares = (0..Limits::SUPPORT_HALVINGS).map(|halvings| 0.5f64.powi(halvings as i32));
            shares.filter_map(|share| on_surface(&(x + share * step))).find(|candidate| u.dot(candidate) > height)
        };
        match ADDED.into_iter().find_map(rises) {
            Some(better) => x = better,
            None => return (off <= NEARLY_ALONG).then_some(x),
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particle::particle::Particle;
    use crate::random::Random;

    /// Of rounded cubes, and of an ellipsoid of planes through the centre: √Σ(a_i u_i)².
    #[test]
    fn closed_forms() {
        let cube = Particle::cube(0.9, 0.1, 0.0, 1.0);
        let mut random = Random::new(7, 0);
        let axes = Vector3::new(1.0, 0.4, 2.0);
        let planes: Vec<_> = (0..3)
            .flat_map(|axis| [1.0, -1.0].map(|sign| Vector3::ith(axis, sign / axes[axis])))
            .map(|normal| crate::Plane { normal, offset: 0.0 })
            .collect();
        let ellipsoid = Particle::new(&planes, 1.0, 0.0, 1.0).unwrap();
        for _ in 0..200 {
            let (u, near) = (random.direction(), random.direction());
            let of_cube = 0.9 * u.abs().sum() + 0.1;
            let found = u.dot(&farthest(&cube, &u, &near).unwrap());
            assert!((found - of_cube).abs() < 1e-9, "{u}: {found} is not {of_cube}");
            let found = u.dot(&farthest(&ellipsoid, &u, &near).unwrap());
            assert!((found - u.component_mul(&axes).norm()).abs() < 1e-9, "{u}: {found}");
        }
    }
}
