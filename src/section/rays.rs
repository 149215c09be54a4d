//! Adaptive quadrature over rays: slower by far, but there is nothing to spoil.
//!
//! Around the contact point the intersection of the two convex cuts is star-shaped with radius
//! ρ(φ) = min(ρ_A(φ), ρ_B(φ)), each an exact ray hit, and the area is ½∮ρ² dφ.

use super::Side;
use crate::particle::ray_cast;
use std::f64::consts::TAU;

/// Equal sectors before refinement: no more than a quarter of a circle may hide between two rays.
const SECTORS: usize = 12;

/// Deepest halving of one sector.
const DEEPEST: u32 = 24;

/// Part of its share of the tolerance to which a sector's estimates must agree: several may err the same way.
const SAFETY: f64 = 0.125;

/// Relative tolerance below which nothing but rounding is left where this is needed.
const LEAST_TOLERANCE: f64 = 1e-9;

/// Area by Simpson's rule, to a relative tolerance of at least [`LEAST_TOLERANCE`]. `None` when a ray is not finite.
pub(super) fn area(sides: &[Side; 2], relative_tolerance: f64) -> Option<f64> {
    let half_square = |angle: f64| {
        let (sin, cos) = angle.sin_cos();
        let mut rho = f64::INFINITY;
        for Side { particle, point, axes, .. } in sides {
            rho = rho.min(ray_cast::distance(particle, point, &(cos * axes[0] + sin * axes[1]))?);
        }
        let rho = rho.max(0.0);
        Some(0.5 * rho * rho)
    };
    let step = TAU / SECTORS as f64;
    let mut rays = [0.0; SECTORS];
    for (i, ray) in rays.iter_mut().enumerate() {
        *ray = half_square(i as f64 * step)?;
    }
    let rough: f64 = rays.iter().sum::<f64>() * step;
    let tolerance = SAFETY * relative_tolerance.max(LEAST_TOLERANCE) * rough / SECTORS as f64;
    let mut area = 0.0;
    for i in 0..SECTORS {
        let from = i as f64 * step;
        let middle = half_square(from + 0.5 * step)?;
        let sector = Sector { from, width: step, values: [rays[i], middle, rays[(i + 1) % SECTORS]] };
        area += sector.integral(&half_square, tolerance, DEEPEST)?;
    }
    Some(area)
}

/// A sector with the integrand at its start, middle and end.
struct Sector {
    from: f64,
    width: f64,
    values: [f64; 3],
}

impl Sector {
    fn simpson(&self) -> f64 {
        let [start, middle, end] = self.values;
        self.width / 6.0 * (start + 4.0 * middle + end)
    }

    /// Halved until both estimates agree to the tolerance. Both halves get the whole of it: with less at every
    /// halving it would sink below the rounding of the rays, and the halvings never end.
    fn integral(&self, f: &impl Fn(f64) -> Option<f64>, tolerance: f64, deeper: u32) -> Option<f64> {
        let half = 0.5 * self.width;
        let [start, middle, end] = self.values;
        let left = Self { from: self.from, width: half, values: [start, f(self.from + 0.5 * half)?, middle] };
        let right = Self { from: self.from + half, width: half, values: [middle, f(self.from + 1.5 * half)?, end] };
        let fine = left.simpson() + right.simpson();
        let change = fine - self.simpson();
        // Richardson: the fine sum errs by a fifteenth of the change on smooth sectors; at a kink by less
        // than the change.
        // What is no number, halving does not mend.
        if !(change.abs() > tolerance) || deeper == 0 {
            return Some(fine + change / 15.0);
        }
        Some(left.integral(f, tolerance, deeper - 1)? + right.integral(f, tolerance, deeper - 1)?)
    }
}

#[cfg(test)]
mod tests {
    use crate::pair::pose::Pose;
    use crate::particle::particle::{Particle, Plane};
    use crate::section::{Section, Trouble, exact};
    use nalgebra::Vector3;

    /// Hardly any section needs it, so that it is asked here what the walk answers as well.
    #[test]
    fn the_fallback_agrees_with_the_walk() {
        for (r, k) in [(0.2, 0.3), (0.02, 0.05), (1e-4, 0.0), (0.1, 1.0)] {
            let planes: Vec<Plane> = (0..3)
                .flat_map(|axis| [1.0, -1.0].map(|sign| Plane { normal: Vector3::ith(axis, sign), offset: 0.4 - r }))
                .collect();
            let particle = Particle::new(&planes, r, k, 0.6).unwrap();
            let pose_a = Pose::new([0.0; 3], [1.0, 0.2, 0.3, -0.1]).unwrap();
            let pose_b = Pose::new([0.0; 3], [0.3, -0.8, 0.1, 0.5]).unwrap();
            for (i, tolerance) in [1e-3, 1e-6, 1e-9].into_iter().enumerate() {
                let i = i as f64;
                let section = Section {
                    branch_a: Vector3::new(0.1 * i, 0.2, 0.05),
                    branch_b: Vector3::new(-0.1, 0.15 * i, 0.1),
                    normal: Vector3::new(0.3, 0.5 - i, 0.8),
                };
                let sides = section.sides([(&particle, &pose_a), (&particle, &pose_b)]).unwrap();
                let walked = exact(&sides).unwrap();
                let area = super::area(&sides, tolerance).unwrap();
                assert!((area / walked - 1.0).abs() < tolerance, "r {r}, k {k}: {area} for {walked} to {tolerance}");
            }
            // From a point outside there is nothing to walk around.
            let outside = Section { branch_a: Vector3::z(), branch_b: Vector3::zeros(), normal: Vector3::z() };
            let sides = outside.sides([(&particle, &pose_a), (&particle, &pose_b)]).unwrap();
            assert_eq!(exact(&sides), Err(Trouble::Outside));
        }
    }
}
