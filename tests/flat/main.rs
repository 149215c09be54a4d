//! The contact with flat boundaries against 40-digit answers, closed forms and its definition.

mod closed_forms;
mod found;

use kit::truth;
use nalgebra::Vector3;
use potential_particles::{
    BoundaryError, FlatContact, Kind, Particle, Plane, Pose, Settings, Triangle, Wall, contact_with_plane,
    contact_with_triangle,
};
use serde::Deserialize;
use std::collections::BTreeMap;

/// Solved to the end, also where it is apart.
pub fn solved() -> Settings {
    Settings::default().with_solve_separated(true)
}

/// A cube of edge 1 with edges and corners rounded by r.
pub fn cube(r: f64, k: f64) -> Particle {
    let normals = (0..3).flat_map(|axis| [1.0, -1.0].map(|sign| Vector3::ith(axis, sign)));
    let planes: Vec<Plane> = normals.map(|normal| Plane { normal, offset: 0.5 - r }).collect();
    Particle::new(&planes, r, k, 1.0).expect("a cube")
}

/// A triangle with these vertices.
pub fn triangle(vertices: [[f64; 3]; 3]) -> Triangle {
    Triangle::new(vertices).expect("a triangle with an area")
}

/// The contact with a triangle.
pub fn touch(a: &Particle, pose: &Pose, vertices: [[f64; 3]; 3], settings: &Settings) -> FlatContact {
    contact_with_triangle(a, pose, &triangle(vertices), settings, None).expect("an answer")
}

/// The point of the boundary where s is least, minus the position of A.
pub fn boundary_point(contact: &FlatContact) -> Vector3<f64> {
    match contact.kind {
        Kind::Overlapping => contact.branch - 0.5 * contact.overlap * contact.normal,
        Kind::Separated => contact.branch,
    }
}

#[derive(Deserialize)]
struct Known {
    family: String,
    #[serde(rename = "A")]
    shape: truth::Shape,
    #[serde(flatten)]
    place: truth::Place,
    vertices: Option<[[f64; 3]; 3]>,
    point: Option<[f64; 3]>,
    normal: Option<[f64; 3]>,
    s: String,
    x: Option<[String; 3]>,
}

impl Known {
    fn contact(&self, particle: &Particle, pose: &Pose, settings: &Settings) -> FlatContact {
        match (self.vertices, self.point, self.normal) {
            (Some(vertices), ..) => touch(particle, pose, vertices, settings),
            (None, Some(point), Some(normal)) => {
                let wall = Wall::new(point, normal).expect("a plane");
                contact_with_plane(particle, pose, &wall, settings, None).expect("an answer")
            }
            _ => panic!("a case has vertices, or a point and a normal"),
        }
    }
}

/// The largest errors and bounds of a family.
#[derive(Default)]
struct Worst {
    count: usize,
    s: [f64; 2],
    /// The largest gap of s².
    square: f64,
    point: [f64; 2],
}

/// Every known contact by these settings, within its bounds.
fn worst_of_known(settings: &Settings) -> BTreeMap<String, Worst> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/flats.jsonl");
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let mut families: BTreeMap<String, Worst> = BTreeMap::new();
    for line in text.lines() {
        let known: Known = serde_json::from_str(line).expect("a contact per line");
        let (particle, pose) = (known.shape.particle(), known.place.pose());
        let contact = known.contact(&particle, &pose, settings);
        let (family, s) = (&known.family, truth::number(&known.s));
        let error = truth::minus(contact.s, &known.s).abs();
        assert!(error <= contact.gap, "{family}: s {s} off by {error:e}, {contact:?}");
        if (s - 1.0).abs() > contact.gap {
            assert_eq!(contact.kind == Kind::Overlapping, s < 1.0, "{family}: s {s}, {contact:?}");
        }
        // With cheap proofs the kind is the same.
        let quick = settings.with_solve_separated(false);
        assert_eq!(known.contact(&particle, &pose, &quick).kind, contact.kind, "{family}: s {s}");
        let worst = families.entry(family.clone()).or_default();
        worst.count += 1;
        let scale = s.max(1.0);
        worst.s = [worst.s[0].max(error / scale), worst.s[1].max(contact.gap / scale)];
        worst.square = worst.square.max((2.0 * s + contact.gap) * contact.gap / (scale * scale));
        if let Some(x) = &known.x {
            let off = truth::distance(&boundary_point(&contact), x);
            assert!(off <= contact.point_bound, "{family}: x off by {off:e}, {contact:?}");
            worst.point = [worst.point[0].max(off), worst.point[1].max(contact.point_bound)];
        }
    }
    println!("family             cases   s off by      gap   x off by    bound");
    for (family, Worst { count, s, point, .. }) in &families {
        println!("{family:18} {count:5} {:10.1e} {:8.1e} {:10.1e} {:8.1e}", s[0], s[1], point[0], point[1]);
    }
    assert!(families.values().map(|worst| worst.count).sum::<usize>() >= 200);
    families
}

#[test]
fn contacts_known_to_40_digits() {
    worst_of_known(&solved());
}

#[test]
fn contacts_known_to_40_digits_to_the_last_digits() {
    let gap_tolerance = 1e-14;
    let families = worst_of_known(&solved().with_gap_tolerance(gap_tolerance));
    for (family, Worst { square, .. }) in families {
        assert!(square <= gap_tolerance, "{family}: a gap of s² of {square:e}");
    }
}

#[test]
fn what_is_no_boundary_is_refused() {
    let nan = f64::NAN;
    let corner = [0.0, 0.0, 0.0];
    let area = |b, c| Triangle::new([corner, b, c]).unwrap_err();
    assert!(matches!(area([1.0, 0.0, 0.0], [2.0, 0.0, 0.0]), BoundaryError::Area(_)));
    assert!(matches!(area(corner, corner), BoundaryError::Area(_)));
    // Thirds along a line are on it but for rounding.
    assert!(matches!(area([1.0 / 3.0, 0.7 / 3.0, 0.0], [2.0 / 3.0, 1.4 / 3.0, 0.0]), BoundaryError::Area(_)));
    assert!(matches!(area([1.0, nan, 0.0], [0.0, 1.0, 0.0]), BoundaryError::Point(..)));
    assert!(area([1.0, f64::INFINITY, 0.0], [0.0, 1.0, 0.0]).to_string().contains("inf"));
    assert!(matches!(Wall::new(corner, corner), Err(BoundaryError::Normal(..))));
    assert!(matches!(Wall::new(corner, [0.0, nan, 1.0]), Err(BoundaryError::Normal(..))));
    assert!(matches!(Wall::new([nan, 0.0, 0.0], [0.0, 0.0, 1.0]), Err(BoundaryError::Point(..))));
    // Any length will do that has a direction.
    assert!(Wall::new(corner, [0.0, 1e-300, 1e-300]).is_ok() && Wall::new(corner, [1e300, 1e300, 0.0]).is_ok());
    assert!(Triangle::new([corner, [1e-160, 0.0, 0.0], [0.0, 1e-160, 0.0]]).is_ok());
    let wall = Wall::new(corner, [0.0, 0.0, 1.0]).unwrap();
    let settings = Settings::default().with_gap_tolerance(0.0);
    assert!(contact_with_plane(&cube(0.1, 0.1), &Pose::at(corner).unwrap(), &wall, &settings, None).is_err());
}

#[test]
fn an_answer_is_the_same_wherever_the_scene_lies() {
    // Multiples of 2⁻¹⁰, which a shift by 2²⁰ leaves without rounding.
    let particle = cube(0.05, 0.1);
    let vertices = [[-0.5, 0.25, 0.125], [1.5, -0.75, 0.25], [0.25, 1.0, -0.5]];
    let shift = Vector3::new(1048576.0, -524288.0, 2097152.0);
    for position in [[0.25, 0.125, 0.5], [0.5, 1.25, 0.25], [-0.75, 0.5, 0.375]] {
        let turn = [0.5, 0.3, -0.2, 0.9];
        let far = |p: [f64; 3]| (Vector3::from(p) + shift).into();
        let here = touch(&particle, &Pose::new(position, turn).unwrap(), vertices, &solved());
        let there = touch(&particle, &Pose::new(far(position), turn).unwrap(), vertices.map(far), &solved());
        assert_eq!((here.s, here.gap, here.branch, here.normal), (there.s, there.gap, there.branch, there.normal));
    }
}
