//! Contact area: the cut of both particles with the plane through the contact point.
//!
//! In that plane, around the contact point, the intersection of the two convex cuts is star-shaped with
//! radius ρ(φ) = min(ρ_A(φ), ρ_B(φ)), each an exact ray hit, and the area is ½∮ρ² dφ.

use crate::particle::Particle;
use crate::pose::Pose;
use crate::surface;
use nalgebra::Vector3;
use std::f64::consts::TAU;

/// A plane through the contact point, at right angles to the contact normal, world axes.
#[derive(Clone, Copy, Debug)]
pub struct Section {
    /// Contact point minus position of A.
    pub branch_a: Vector3<f64>,
    /// Contact point minus position of B.
    pub branch_b: Vector3<f64>,
    /// Unit normal of the plane.
    pub normal: Vector3<f64>,
}

/// Equal sectors before refinement: no more than a quarter of a circle may hide between two rays.
const SECTORS: usize = 12;

/// Deepest halving of one sector.
const DEEPEST: u32 = 24;

impl Section {
    /// Area of the intersection of both particles with this plane, length².
    ///
    /// Adaptive Simpson quadrature over the angle; a sector is halved until its two estimates agree to its
    /// share of `relative_tolerance`. `None` when the section holds no finite point or normal.
    pub fn area(
        &self,
        a: &Particle,
        pose_a: &Pose,
        b: &Particle,
        pose_b: &Pose,
        relative_tolerance: f64,
    ) -> Option<f64> {
        let unit = self.normal.try_normalize(0.0)?;
        let first = unit.cross(&Vector3::ith(unit.iamin(), 1.0)).try_normalize(0.0)?;
        let second = unit.cross(&first);
        let (from_a, from_b) = (pose_a.rotation.tr_mul(&self.branch_a), pose_b.rotation.tr_mul(&self.branch_b));
        let in_plane = |rotation: &nalgebra::Matrix3<f64>| (rotation.tr_mul(&first), rotation.tr_mul(&second));
        let (axes_a, axes_b) = (in_plane(&pose_a.rotation), in_plane(&pose_b.rotation));
        let half_square = |angle: f64| {
            let (sin, cos) = angle.sin_cos();
            let to_a = surface::distance(a, &from_a, &(cos * axes_a.0 + sin * axes_a.1))?;
            let to_b = surface::distance(b, &from_b, &(cos * axes_b.0 + sin * axes_b.1))?;
            let rho = to_a.min(to_b).max(0.0);
            Some(0.5 * rho * rho)
        };
        let step = TAU / SECTORS as f64;
        let mut rays = [0.0; SECTORS];
        for (i, ray) in rays.iter_mut().enumerate() {
            *ray = half_square(i as f64 * step)?;
        }
        let rough: f64 = rays.iter().sum::<f64>() * step;
        let mut area = 0.0;
        for i in 0..SECTORS {
            let from = i as f64 * step;
            let middle = half_square(from + 0.5 * step)?;
            let sector = Sector { from, width: step, values: [rays[i], middle, rays[(i + 1) % SECTORS]] };
            area += sector.integral(&half_square, relative_tolerance * rough / SECTORS as f64, DEEPEST)?;
        }
        Some(area)
    }
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

    fn integral(&self, f: &impl Fn(f64) -> Option<f64>, tolerance: f64, deeper: u32) -> Option<f64> {
        let half = 0.5 * self.width;
        let [start, middle, end] = self.values;
        let left = Self { from: self.from, width: half, values: [start, f(self.from + 0.5 * half)?, middle] };
        let right = Self { from: self.from + half, width: half, values: [middle, f(self.from + 1.5 * half)?, end] };
        let fine = left.simpson() + right.simpson();
        let change = fine - self.simpson();
        // Richardson: the fine sum errs by a fifteenth of the change on smooth sectors; at a kink by less
        // than the change.
        if change.abs() <= tolerance || deeper == 0 {
            return Some(fine + change / 15.0);
        }
        Some(left.integral(f, 0.5 * tolerance, deeper - 1)? + right.integral(f, 0.5 * tolerance, deeper - 1)?)
    }
}
