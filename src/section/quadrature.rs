//! Adaptive quadrature over rays: slower by far, but robust, since every ray is cast on its own.
//!
//! Around the contact point the intersection of the two convex cross-sections is star-shaped with radius
//! ρ(φ) = min(ρ_A(φ), ρ_B(φ)), each by ray casting, and the area is ½∮ρ² dφ.

use super::numbers::{FINEST, FIRST_SECTORS, Limits, SAFETY};
use super::plane_section::PlaneSection;
use crate::particle::ray_cast;
use std::cell::Cell;
use std::f64::consts::TAU;

/// Area by Simpson's rule, to a relative tolerance of at least [`FINEST`]. `None` when a ray is not finite, or
/// the most rays do not do.
pub(super) fn area(sections: &[PlaneSection; 2], relative_tolerance: f64) -> Option<f64> {
    let left = Cell::new(Limits::POINTS);
    let half_square = |angle: f64| {
        left.set(left.get().checked_sub(1)?);
        let (sin, cos) = angle.sin_cos();
        let mut rho = f64::INFINITY;
        for PlaneSection { shape, point, axes, .. } in sections {
            rho = rho.min(ray_cast::distance(shape, point, &(cos * axes[0] + sin * axes[1]))?);
        }
        let rho = rho.max(0.0);
        Some(0.5 * rho * rho)
    };
    let step = TAU / FIRST_SECTORS as f64;
    let mut rays = [0.0; FIRST_SECTORS];
    for (i, ray) in rays.iter_mut().enumerate() {
        *ray = half_square(i as f64 * step)?;
    }
    let rough: f64 = rays.iter().sum::<f64>() * step;
    let tolerance = SAFETY * relative_tolerance.max(FINEST) * rough / FIRST_SECTORS as f64;
    let mut area = 0.0;
    for i in 0..FIRST_SECTORS {
        let from = i as f64 * step;
        let middle = half_square(from + 0.5 * step)?;
        let sector = Sector { from, width: step, values: [rays[i], middle, rays[(i + 1) % FIRST_SECTORS]] };
        area += sector.integral(&half_square, tolerance, Limits::HALVINGS)?;
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

    /// Halved until both estimates agree to the tolerance, which is the same at every depth: halved as well, it would
    /// soon be below the rounding of the rays.
    fn integral(&self, f: &impl Fn(f64) -> Option<f64>, tolerance: f64, deeper: u32) -> Option<f64> {
        let half = 0.5 * self.width;
        let [start, middle, end] = self.values;
        let left = Self { from: self.from, width: half, values: [start, f(self.from + 0.5 * half)?, middle] };
        let right = Self { from: self.from + half, width: half, values: [middle, f(self.from + 1.5 * half)?, end] };
        let fine = left.simpson() + right.simpson();
        let change = fine - self.simpson();
        // Richardson: on smooth sectors the error of the fine sum is a fifteenth of the change, at a kink less than the
        // change. The negation ends the recursion for NaN.
        if !(change.abs() > tolerance) || deeper == 0 {
            return Some(fine + change / 15.0);
        }
        Some(left.integral(f, tolerance, deeper - 1)? + right.integral(f, tolerance, deeper - 1)?)
    }
}
