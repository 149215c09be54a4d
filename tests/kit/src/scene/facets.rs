//! Particles at a stated overlap with, or distance from, a triangle.

use super::touching::OVERLAP;
use crate::random::Random;
use nalgebra::Vector3;
use potential_particles::{FlatContact, Kind, Particle, Pose, Settings, Triangle, contact_with_triangle};

/// A particle beside a triangle of about its size, whose centre is the origin.
pub struct Facet {
    particle: Particle,
    triangle: Triangle,
    pose: Pose,
    /// Unit vector in which the particle lies, and its distance there.
    away: Vector3<f64>,
    distance: f64,
}

impl Facet {
    /// At the distance where the overlap is [`OVERLAP`].
    pub fn touching(particle: &Particle, random: &mut Random) -> Self {
        let [a, b] = [0; 2].map(|_| random.direction());
        let vertices = [a, b, -(a + b)].map(Into::into);
        let triangle = Triangle::new(vertices).expect("random directions are not parallel");
        let (pose, away) = (random.pose(Vector3::zeros()), random.direction());
        let mut facet = Self { particle: particle.clone(), triangle, pose, away, distance: 0.0 };
        let (mut deep, mut apart) = (0.0, 3.0 * particle.bounding_radius());
        for _ in 0..60 {
            facet = facet.at(0.5 * (deep + apart));
            let contact = facet.contact();
            let too_deep = contact.kind == Kind::Overlapping && contact.overlap > OVERLAP;
            if too_deep { deep = facet.distance } else { apart = facet.distance }
        }
        facet
    }

    /// Further off by so much.
    pub fn pushed(&self, way: f64) -> Self {
        self.at(self.distance + way)
    }

    fn at(&self, distance: f64) -> Self {
        let pose = Pose::new((distance * self.away).into(), self.pose.orientation()).expect("finite");
        Self { particle: self.particle.clone(), pose, distance, ..*self }
    }

    pub fn contact(&self) -> FlatContact {
        contact_with_triangle(&self.particle, &self.pose, &self.triangle, &Settings::default(), None)
            .expect("an ordinary triangle")
    }
}
