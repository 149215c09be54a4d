//! Sections of two particles, and those whose areas are known to 40 digits.

pub use kit::patch::bodies::cuboid;
use kit::truth::{Shape, number};
use nalgebra::{Matrix3, Vector3};
use potential_particles::Section;
use potential_particles::{Contact, Particle, Pose};
use serde::Deserialize;

/// Two particles and the plane that cuts them. Nothing depends on the positions.
#[derive(Clone, Debug)]
pub struct Cut {
    pub a: Particle,
    pub pose_a: Pose,
    pub b: Particle,
    pub pose_b: Pose,
    pub section: Section,
}

impl Cut {
    pub fn of_contact(a: &Particle, pose_a: &Pose, b: &Particle, pose_b: &Pose, contact: &Contact) -> Self {
        let Contact { branch_a, branch_b, normal, .. } = *contact;
        let section = Section { branch_a, branch_b, normal };
        Self { a: a.clone(), pose_a: *pose_a, b: b.clone(), pose_b: *pose_b, section }
    }

    pub fn area_to(&self, relative_tolerance: f64) -> Option<f64> {
        self.section.area(&self.a, &self.pose_a, &self.b, &self.pose_b, relative_tolerance)
    }

    pub fn area(&self) -> f64 {
        self.area_to(1e-6).unwrap_or_else(|| panic!("no area of {self:?}"))
    }

    /// Whether the area needed no quadrature: its tolerance then changes nothing.
    pub fn is_exact(&self) -> bool {
        self.area_to(0.1) == self.area_to(1e-4)
    }

    /// The contact point in the frames of A and of B.
    pub fn points(&self) -> [Vector3<f64>; 2] {
        [self.pose_a.rotation().tr_mul(&self.section.branch_a), self.pose_b.rotation().tr_mul(&self.section.branch_b)]
    }
}

/// A section with its area.
pub struct Known {
    pub family: String,
    pub cut: Cut,
    pub area: f64,
}

#[derive(Deserialize)]
struct Line {
    family: String,
    #[serde(rename = "A")]
    shape_a: Shape,
    #[serde(rename = "B")]
    shape_b: Shape,
    rotation_a: [[f64; 3]; 3],
    rotation_b: [[f64; 3]; 3],
    branch_a: [f64; 3],
    branch_b: [f64; 3],
    normal: [f64; 3],
    area: String,
}

/// All sections of tests/data/areas.jsonl.
pub fn known() -> Vec<Known> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/areas.jsonl");
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{path}: {error}"));
    text.lines().map(|line| serde_json::from_str::<Line>(line).expect("a section per line").known()).collect()
}

impl Line {
    fn known(&self) -> Known {
        let pose = |rows: &[[f64; 3]; 3]| {
            Pose::from_rotation([0.0; 3], &Matrix3::from(*rows).transpose()).expect("a rotation")
        };
        let section =
            Section { branch_a: self.branch_a.into(), branch_b: self.branch_b.into(), normal: self.normal.into() };
        let cut = Cut {
            a: self.shape_a.particle(),
            pose_a: pose(&self.rotation_a),
            b: self.shape_b.particle(),
            pose_b: pose(&self.rotation_b),
            section,
        };
        Known { family: self.family.clone(), cut, area: number(&self.area) }
    }
}
