//! A pair as one line of JSON, as solve_pairs reads it: what was found can be solved again anywhere.

use crate::stress::cases::{Case, Place, Shapes};
use nalgebra::Vector3;
use potential_particles::{Particle, ParticleError, Plane};
use serde::{Deserialize, Serialize};

#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Shape {
    n: Vec<[f64; 3]>,
    d: Vec<f64>,
    r: f64,
    k: f64,
    #[serde(rename = "R")]
    shadow_radius: f64,
}

#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct At {
    pos: [f64; 3],
    q: [f64; 4],
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Line {
    /// What went wrong, for the reader; whoever solves it ignores it.
    pub what: String,
    #[serde(rename = "A")]
    a: Shape,
    #[serde(rename = "B")]
    b: Shape,
    #[serde(rename = "a")]
    at_a: At,
    #[serde(rename = "b")]
    at_b: At,
}

impl From<&Place> for At {
    fn from(place: &Place) -> Self {
        Self { pos: place.position, q: place.orientation }
    }
}

impl Line {
    pub fn of(case: &Case, what: String) -> Self {
        Self::placed(&case.shapes.a, &case.at_a, &case.shapes.b, &case.at_b, what)
    }

    pub fn planes(&self) -> usize {
        self.a.d.len() + self.b.d.len()
    }

    pub fn placed(a: &Particle, at_a: &Place, b: &Particle, at_b: &Place, what: String) -> Self {
        Self { what, a: shape(a), b: shape(b), at_a: at_a.into(), at_b: at_b.into() }
    }
}

pub fn shape(particle: &Particle) -> Shape {
    Shape {
        n: particle.planes().map(|p| p.normal.into()).collect(),
        d: particle.planes().map(|p| p.offset).collect(),
        r: particle.rounding_radius(),
        k: particle.sphericity(),
        shadow_radius: particle.shadow_radius(),
    }
}

impl Line {
    /// The two shapes again, of no family.
    pub fn shapes(&self) -> Result<Shapes, ParticleError> {
        Ok(Shapes { a: self.a.particle()?, b: self.b.particle()?, group: 0, family: 0 })
    }

    /// The places of A and of B.
    pub fn places(&self) -> [Place; 2] {
        [self.at_a, self.at_b].map(|at| Place { position: at.pos, orientation: at.q })
    }
}

impl Shape {
    fn particle(&self) -> Result<Particle, ParticleError> {
        let plane = |(normal, offset): (&[f64; 3], &f64)| Plane { normal: Vector3::from(*normal), offset: *offset };
        let planes: Vec<Plane> = self.n.iter().zip(&self.d).map(plane).collect();
        Particle::new(&planes, self.r, self.k, self.shadow_radius)
    }
}
