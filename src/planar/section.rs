//! The contact length, counterpart of the contact area.

use super::contact::Contact;
use super::particle::Particle;
use super::pose::Pose;
use nalgebra::Vector2;

/// The line through the contact point at right angles to the contact normal, world axes.
#[derive(Clone, Copy, Debug)]
pub struct Section {
    /// Contact point minus position of A.
    pub branch_a: Vector2<f64>,
    /// Contact point minus position of B.
    pub branch_b: Vector2<f64>,
    /// Unit normal of the line.
    pub normal: Vector2<f64>,
}

impl From<&Contact> for Section {
    /// Of an overlapping contact.
    fn from(contact: &Contact) -> Self {
        Self { branch_a: contact.branch_a, branch_b: contact.branch_b, normal: contact.normal }
    }
}

impl Section {
    /// Contact length (YADE: jointLength): how much of this line lies in both particles. The counterpart of
    /// the area in space.
    ///
    /// Exact: both cuts are intervals, and two rays find the ends of each. `None` when the section holds no
    /// finite point or normal.
    ///
    /// ```
    /// use potential_particles::planar::{Particle, Pose, Section, detect};
    /// let disc = Particle::circle(1.0)?;
    /// let (left, right) = (Pose::new([0.0, 0.0], 0.0)?, Pose::new([1.2, 0.0], 0.0)?);
    /// let contact = detect(&disc, &left, &disc, &right, &Default::default(), None)?;
    /// let length = Section::from(&contact).length(&disc, &left, &disc, &right).expect("an overlapping contact");
    /// assert!((length - 2.0 * 0.8).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn length(&self, a: &Particle, pose_a: &Pose, b: &Particle, pose_b: &Pose) -> Option<f64> {
        let normal = self.normal.try_normalize(0.0)?;
        let along = Vector2::new(-normal.y, normal.x);
        let to_boundary = |particle: &Particle, pose: &Pose, branch: &Vector2<f64>, direction: &Vector2<f64>| {
            particle.surface_distance(&pose.rotation().tr_mul(branch), &pose.rotation().tr_mul(direction))
        };
        let mut length = 0.0;
        for direction in [along, -along] {
            let to_a = to_boundary(a, pose_a, &self.branch_a, &direction)?;
            let to_b = to_boundary(b, pose_b, &self.branch_b, &direction)?;
            length += to_a.min(to_b);
        }
        // A point that rounding left outside gives intervals that may miss each other by as much.
        Some(length.max(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::planar::Line;

    /// The line enters the bulge of a face where it touches it, and comes out as far on the other side of the middle.
    #[test]
    fn a_line_through_a_point_that_rounding_left_outside_has_its_length() {
        let lines = [[1.0, 0.0, 0.5], [0.0, 1.0, 0.5], [-1.0, 0.0, 0.5], [0.0, -1.0, 0.5]].map(Line::from);
        let square = Particle::new(&lines, 0.05, 0.3, 0.8).unwrap();
        let pose = Pose::new([3.0, -1.0], 0.4).unwrap();
        let (middle, up) = (Vector2::new(0.3, 0.0), Vector2::y());
        let height = square.surface_distance(&middle, &up).unwrap();
        for off in -20..=20 {
            let branch = pose.rotation() * (middle + height * (1.0 + f64::from(off) * f64::EPSILON) * up);
            let section = Section { branch_a: branch, branch_b: branch, normal: pose.rotation() * up };
            let length = section.length(&square, &pose, &square, &pose).unwrap();
            assert!((length - 0.6).abs() < 1e-12, "{off}: {length}");
        }
    }
}
