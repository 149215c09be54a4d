//! Reads the pairs that were solved to 40 digits.
#![allow(dead_code)]

use nalgebra::Vector3;
use potential_particles::{Particle, Plane, Pose};
use serde::Deserialize;

#[derive(Deserialize)]
pub struct Shape {
    pub n: Vec<[f64; 3]>,
    pub d: Vec<f64>,
    pub r: f64,
    pub k: f64,
    #[serde(rename = "R")]
    pub shadow_radius: f64,
}

#[derive(Deserialize)]
pub struct Place {
    pub pos: [f64; 3],
    pub q: [f64; 4],
}

/// Decimal strings; the nearest double of each is exact enough to judge doubles by.
#[derive(Deserialize)]
pub struct Truth {
    pub s4: String,
    pub u4: String,
    pub x4: [String; 3],
    pub ok1: bool,
    pub ok2: bool,
    #[serde(rename = "sA")]
    pub s_a: Option<String>,
    #[serde(rename = "sB")]
    pub s_b: Option<String>,
    #[serde(rename = "P1")]
    pub p1: Option<[String; 3]>,
    #[serde(rename = "P2")]
    pub p2: Option<[String; 3]>,
}

#[derive(Deserialize)]
pub struct Pair {
    #[serde(rename = "A")]
    pub shape_a: Shape,
    #[serde(rename = "B")]
    pub shape_b: Shape,
    pub a: Place,
    pub b: Place,
    pub family: String,
    pub truth: Truth,
}

impl Shape {
    pub fn particle(&self) -> Particle {
        let planes: Vec<Plane> =
            self.n.iter().zip(&self.d).map(|(n, d)| Plane { normal: Vector3::from(*n), offset: *d }).collect();
        Particle::new(&planes, self.r, self.k, self.shadow_radius).expect("a particle of the truth data is valid")
    }
}

impl Place {
    pub fn pose(&self) -> Pose {
        Pose::new(self.pos, self.q).expect("a pose of the truth data is valid")
    }
}

pub fn number(text: &str) -> f64 {
    text.parse().expect("a decimal number")
}

pub fn vector(text: &[String; 3]) -> Vector3<f64> {
    Vector3::new(number(&text[0]), number(&text[1]), number(&text[2]))
}

/// All 360 pairs.
pub fn pairs() -> Vec<Pair> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/pairs.jsonl");
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{path}: {error}"));
    text.lines().map(|line| serde_json::from_str(line).expect("a pair per line")).collect()
}
