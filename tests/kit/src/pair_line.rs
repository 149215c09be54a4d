//! A pair as one line of JSON, read and checked: of solve_pairs, of the pairs known to 40 digits, and of what stress
//! tests find.

use crate::wide::{Wide, Wide3};
use nalgebra::Vector3;
use potential_particles::{Particle, Plane, Pose};
use serde::{Deserialize, Serialize};

/// Two particles and where they are.
pub struct Input {
    pub a: Particle,
    pub b: Particle,
    /// Moved together so that B is at the origin, or off it by the rounding of the difference of both positions.
    pub pose_a: Pose,
    pub pose_b: Pose,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(expecting = "an object {A, B, a, b}")]
pub struct Line {
    /// What went wrong, for the reader; whoever solves it ignores it.
    #[serde(default)]
    pub what: String,
    #[serde(rename = "A")]
    pub shape_a: Shape,
    #[serde(rename = "B")]
    pub shape_b: Shape,
    pub a: Place,
    pub b: Place,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(expecting = "a particle {n, d, r, k, R}")]
pub struct Shape {
    pub n: Vec<[f64; 3]>,
    pub d: Vec<f64>,
    pub r: f64,
    pub k: f64,
    #[serde(rename = "R")]
    pub shadow_radius: f64,
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub in_plane: bool,
}

/// Where a body is.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[serde(expecting = "a place {pos, q}")]
pub struct Place {
    #[serde(rename = "pos")]
    pub position: [f64; 3],
    /// w, x, y, z; of any length.
    #[serde(rename = "q")]
    pub orientation: [f64; 4],
    /// In its place, of a body in the plane.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angle: Option<f64>,
}

/// Reads a pair.
pub fn pair(text: &[u8]) -> Result<Input, String> {
    let line: Line = serde_json::from_slice(text).map_err(|error| {
        // The parser counts lines within this one.
        error.to_string().replace("at line 1 column", "at column")
    })?;
    let named = |name: &'static str| move |error: String| format!("{name}: {error}");
    let (a, b) = (line.shape_a.read().map_err(named("A"))?, line.shape_b.read().map_err(named("B"))?);
    let (pose_a, pose_b) = (line.a.read().map_err(named("a"))?, line.b.read().map_err(named("b"))?);
    // About the centre of B no digit of a surface point is lost to a position of 10⁷, and with what rounding took from
    // the difference of the positions no digit of that either.
    let parts = pose_a.position().zip_map(pose_b.position(), |a, b| Wide::difference(a, b).parts());
    let at = |position: Vector3<f64>, place: &Place| place.at(position).read();
    let (pose_a, pose_b) = (at(parts.map(|part| part.0), &line.a)?, at(parts.map(|part| -part.1), &line.b)?);
    Ok(Input { a, b, pose_a, pose_b })
}

impl Line {
    pub fn of(a: &Particle, at_a: &Place, b: &Particle, at_b: &Place, what: String) -> Self {
        Self { what, shape_a: a.into(), shape_b: b.into(), a: *at_a, b: *at_b }
    }

    pub fn planes(&self) -> usize {
        self.shape_a.d.len() + self.shape_b.d.len()
    }
}

impl From<&Particle> for Shape {
    fn from(particle: &Particle) -> Self {
        Self {
            n: particle.planes().map(|p| p.normal.into()).collect(),
            d: particle.planes().map(|p| p.offset).collect(),
            r: particle.rounding_radius(),
            k: particle.sphericity(),
            shadow_radius: particle.shadow_radius(),
            in_plane: particle.is_in_plane(),
        }
    }
}

impl Shape {
    fn read(&self) -> Result<Particle, String> {
        if self.n.len() != self.d.len() {
            return Err(format!("{} normals n, but {} offsets d", self.n.len(), self.d.len()));
        }
        let plane = |(normal, &offset): (&[f64; 3], &f64)| Plane { normal: Vector3::from(*normal), offset };
        let planes: Vec<Plane> = self.n.iter().zip(&self.d).map(plane).collect();
        let made = if self.in_plane {
            outline(&planes, self.r, self.k, self.shadow_radius)
        } else {
            Particle::new(&planes, self.r, self.k, self.shadow_radius)
        };
        made.map_err(|error| error.to_string())
    }

    pub fn particle(&self) -> Particle {
        self.read().expect("a particle that was written is one")
    }
}

/// The particle in the plane of the lines in which planes cut it.
pub fn outline(planes: &[Plane], r: f64, k: f64, shadow: f64) -> Result<Particle, potential_particles::ParticleError> {
    let lines: Vec<[f64; 3]> = planes.iter().map(|plane| [plane.normal.x, plane.normal.y, plane.offset]).collect();
    Particle::in_plane(&lines, r, k, shadow)
}

impl Place {
    fn read(&self) -> Result<Pose, String> {
        let [x, y, _] = self.position;
        let turned = || Pose::new(self.position, self.orientation);
        self.angle.map_or_else(turned, |angle| Pose::in_plane([x, y], angle)).map_err(|error| error.to_string())
    }

    pub fn pose(&self) -> Pose {
        self.read().expect("finite numbers and a quaternion that is not zero")
    }

    /// Turned alike, elsewhere.
    pub fn at(&self, position: Vector3<f64>) -> Self {
        Self { position: position.into(), ..*self }
    }

    /// Rows of its rotation.
    pub fn rows(&self) -> [Wide3; 3] {
        let Some(angle) = self.angle else { return rows(self.orientation) };
        let (sine, cosine) = sine_and_cosine(angle);
        let zero = Wide::ZERO;
        [Wide3([cosine, -sine, zero]), Wide3([sine, cosine, zero]), Wide3([zero, zero, Wide::ONE])]
    }
}

/// Of a quaternion of any length, w x y z.
fn rows([w, x, y, z]: [f64; 4]) -> [Wide3; 3] {
    let p = Wide::product;
    let square = p(w, w) + p(x, x) + p(y, y) + p(z, z);
    let two = |v: Wide| (v + v) / square;
    [
        Wide3([(p(w, w) + p(x, x) - p(y, y) - p(z, z)) / square, two(p(x, y) - p(w, z)), two(p(x, z) + p(w, y))]),
        Wide3([two(p(x, y) + p(w, z)), (p(w, w) - p(x, x) + p(y, y) - p(z, z)) / square, two(p(y, z) - p(w, x))]),
        Wide3([two(p(x, z) - p(w, y)), two(p(y, z) + p(w, x)), (p(w, w) - p(x, x) - p(y, y) + p(z, z)) / square]),
    ]
}

/// π/2 to three doubles.
const QUARTER: [f64; 3] = [std::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_169_8e-33];

/// Of an angle as given, to 32 digits: reduced by quarters of a turn, then summed until terms are below 1e-40.
pub fn sine_and_cosine(angle: f64) -> (Wide, Wide) {
    let quarters = (angle / QUARTER[0]).round();
    let rest = QUARTER.iter().fold(Wide::from(angle), |rest, part| rest - Wide::product(quarters, *part));
    let (mut sine, mut cosine, mut term) = (Wide::ZERO, Wide::ZERO, Wide::ONE);
    for n in 0..36 {
        let sum = if n % 2 == 0 { &mut cosine } else { &mut sine };
        *sum += if n % 4 < 2 { term } else { -term };
        term = term * rest / Wide::from(f64::from(n + 1));
    }
    match quarters.rem_euclid(4.0) as u8 {
        0 => (sine, cosine),
        1 => (cosine, -sine),
        2 => (-sine, -cosine),
        _ => (-cosine, sine),
    }
}
