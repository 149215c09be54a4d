//! A box or an upright cylinder, and whether it holds a particle.

use crate::packing::error::PackError;
use crate::particle::particle::Particle;
use crate::pose::Pose;
use crate::random::Random;
use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};

/// What is filled, world frame, z upwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Container {
    lower: Vector3<f64>,
    upper: Vector3<f64>,
    /// Of the cylinder that stands in the box; infinite for the box itself.
    radius: f64,
}

impl Container {
    /// The box between two corners, sides along the axes.
    ///
    /// # Errors
    /// Corners that are not finite or enclose no volume.
    pub fn cuboid(lower: [f64; 3], upper: [f64; 3]) -> Result<Self, PackError> {
        // Written so that what is not a number fails.
        if !(0..3).all(|axis| lower[axis] < upper[axis] && (upper[axis] - lower[axis]).is_finite()) {
            return Err(PackError::EmptyContainer { lower, upper });
        }
        Ok(Self { lower: lower.into(), upper: upper.into(), radius: f64::INFINITY })
    }

    /// The cylinder with a vertical axis that stands on a disc about `base`.
    ///
    /// # Errors
    /// A radius or height that is not positive and finite, or a base that is not finite.
    pub fn cylinder(base: [f64; 3], radius: f64, height: f64) -> Result<Self, PackError> {
        if !(radius > 0.0 && radius.is_finite() && height > 0.0 && height.is_finite()) {
            return Err(PackError::EmptyCylinder { radius, height });
        }
        let [x, y, z] = base;
        let around = Self::cuboid([x - radius, y - radius, z], [x + radius, y + radius, z + height])?;
        Ok(Self { radius, ..around })
    }

    /// Area of the cross-section times height, length³.
    pub fn volume(&self) -> f64 {
        self.area() * (self.upper.z - self.lower.z)
    }

    /// Area of the horizontal cross-section.
    pub(crate) fn area(&self) -> f64 {
        let widths = self.widths();
        if self.radius.is_finite() { PI * self.radius * self.radius } else { widths.x * widths.y }
    }

    /// The lowest corner of the box about it.
    pub(crate) fn lower(&self) -> Vector3<f64> {
        self.lower
    }

    /// The highest corner of the box about it.
    pub(crate) fn upper(&self) -> Vector3<f64> {
        self.upper
    }

    /// Edges of the box about it.
    pub(crate) fn widths(&self) -> Vector3<f64> {
        self.upper - self.lower
    }

    /// A random point, uniform in it.
    pub(crate) fn point(&self, random: &mut Random) -> Vector3<f64> {
        let z = random.between(self.lower.z, self.upper.z);
        if self.radius.is_finite() {
            let centre = self.axis();
            let away = self.radius * random.uniform().sqrt();
            let (sin, cos) = (TAU * random.uniform()).sin_cos();
            Vector3::new(centre.x + away * cos, centre.y + away * sin, z)
        } else {
            let x = random.between(self.lower.x, self.upper.x);
            Vector3::new(x, random.between(self.lower.y, self.upper.y), z)
        }
    }

    /// Whether the particle surely lies within: by its box, and within the wall of a cylinder by its ball or by the
    /// corners of the polyhedron that holds it.
    pub(crate) fn holds(&self, particle: &Particle, pose: &Pose) -> bool {
        let (lower, upper) = particle.bounding_box(pose);
        let axes = if self.radius.is_finite() { 2..3 } else { 0..3 };
        axes.into_iter().all(|axis| lower[axis] >= self.lower[axis] && upper[axis] <= self.upper[axis])
            && (!self.radius.is_finite() || self.holds_across(particle, pose))
    }

    /// Whether the particle lies within the wall of the cylinder, which is convex: so does what its corners span.
    fn holds_across(&self, particle: &Particle, pose: &Pose) -> bool {
        let from_axis = pose.position() - self.axis();
        let across = |v: &Vector3<f64>| v.x.hypot(v.y);
        across(&from_axis) + particle.bounding_radius() <= self.radius
            || particle
                .bounding_corners()
                .iter()
                .all(|corner| across(&(from_axis + pose.rotate(corner))) <= self.radius)
    }

    /// The middle of the base.
    fn axis(&self) -> Vector3<f64> {
        let middle = 0.5 * (self.lower + self.upper);
        Vector3::new(middle.x, middle.y, self.lower.z)
    }
}
