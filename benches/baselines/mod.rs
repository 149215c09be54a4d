//! The solvers of the literature, written from its equations, and a quadrature, to compare with. Not part of the
//! library.

pub mod area;
pub mod cubic;
pub mod newton;
pub mod one_shot;
pub mod potential;

use nalgebra::Vector3;
use potential_particles::{Particle, Pose};

/// A pair as it comes: two particles in the world.
#[derive(Clone, Copy)]
pub struct Placed<'a> {
    pub a: &'a Particle,
    pub pose_a: &'a Pose,
    pub b: &'a Particle,
    pub pose_b: &'a Pose,
}

/// What a solver found: s and where.
#[derive(Clone, Copy, Debug)]
pub struct Solution {
    /// Midway: t. Closest: s of the particle that is not held.
    pub s: f64,
    /// The point, relative to the centre of B, world axes.
    pub point: Vector3<f64>,
}

impl<'a> Placed<'a> {
    /// The same pair with A and B in each other's place.
    pub fn swapped(&self) -> Self {
        Placed { a: self.b, pose_a: self.pose_b, b: self.a, pose_b: self.pose_a }
    }
}

/// Both closest points, P2 on B and P1 on A, from a solver of the first alone.
pub fn both_halves(pair: &Placed, half: impl Fn(&Placed) -> Result<Solution, String>) -> Result<[Solution; 2], String> {
    let on_b = half(pair)?;
    let mut on_a = half(&pair.swapped())?;
    on_a.point += pair.pose_a.position() - pair.pose_b.position();
    Ok([on_b, on_a])
}
