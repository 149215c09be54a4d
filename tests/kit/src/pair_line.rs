//! One line of input, read and checked.

use nalgebra::Vector3;
use potential_particles::{Particle, Plane, Pose};
use serde::Deserialize;

/// Two particles and where they are.
pub struct Input {
    pub a: Particle,
    pub b: Particle,
    /// Moved together so that B is at the origin, or off it by the rounding of the difference of both positions.
    pub pose_a: Pose,
    pub pose_b: Pose,
}

#[derive(Deserialize)]
#[serde(expecting = "an object {A, B, a, b}")]
struct Line {
    #[serde(rename = "A")]
    shape_a: Shape,
    #[serde(rename = "B")]
    shape_b: Shape,
    a: Place,
    b: Place,
}

#[derive(Deserialize)]
#[serde(expecting = "a particle {n, d, r, k, R}")]
struct Shape {
    n: Vec<[f64; 3]>,
    d: Vec<f64>,
    r: f64,
    k: f64,
    #[serde(rename = "R")]
    shadow_radius: f64,
}

#[derive(Deserialize)]
#[serde(expecting = "a place {pos, q}")]
struct Place {
    pos: [f64; 3],
    q: [f64; 4],
}

/// Reads a pair.
pub fn pair(text: &[u8]) -> Result<Input, String> {
    let line: Line = serde_json::from_slice(text).map_err(|error| {
        // The parser counts lines within this one.
        error.to_string().replace("at line 1 column", "at column")
    })?;
    let (a, b) = (line.shape_a.particle("A")?, line.shape_b.particle("B")?);
    let (pose_a, pose_b) = (line.a.pose("a")?, line.b.pose("b")?);
    // About the centre of B no digit of a surface point is lost to a position of 10⁷, and with what rounding took from
    // the difference of the positions no digit of that either.
    let parts = pose_a.position().zip_map(pose_b.position(), difference);
    let at = |position: Vector3<f64>, pose: &Pose| {
        Pose::new(position.into(), pose.orientation()).map_err(|error| error.to_string())
    };
    Ok(Input { a, b, pose_a: at(parts.map(|part| part.0), &pose_a)?, pose_b: at(parts.map(|part| -part.1), &pose_b)? })
}

/// a − b without rounding, as the sum of the nearest double and what that leaves (Knuth's two-sum).
fn difference(a: f64, b: f64) -> (f64, f64) {
    let high = a - b;
    let part = high - a;
    (high, (a - (high - part)) - (b + part))
}

impl Shape {
    fn particle(&self, name: &str) -> Result<Particle, String> {
        if self.n.len() != self.d.len() {
            return Err(format!("{name}: {} normals n, but {} offsets d", self.n.len(), self.d.len()));
        }
        let plane = |(normal, &offset): (&[f64; 3], &f64)| Plane { normal: Vector3::from(*normal), offset };
        let planes: Vec<Plane> = self.n.iter().zip(&self.d).map(plane).collect();
        Particle::new(&planes, self.r, self.k, self.shadow_radius).map_err(|error| format!("{name}: {error}"))
    }
}

impl Place {
    fn pose(&self, name: &str) -> Result<Pose, String> {
        Pose::new(self.pos, self.q).map_err(|error| format!("{name}: {error}"))
    }
}
