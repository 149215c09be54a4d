//! Against differences in arithmetic of 130 digits (tests/data/derivatives.py).

use kit::truth::pairs;
use nalgebra::Vector3;
use potential_particles::{
    Contact, ContactDerivatives, ContactWeights, Formulation, PoseRow, PoseRows, Settings, ShapeGradient,
    contact_derivatives, contact_gradient, detect,
};
use serde::Deserialize;
use std::collections::BTreeMap;

/// The targets, relative.
const MEDIAN: f64 = 1e-12;
const WORST: f64 = 1e-10;

type Row = [f64; 12];

#[derive(Deserialize)]
struct Poses {
    s: [Row; 1],
    s_b: Option<[Row; 1]>,
    overlap: Option<[Row; 1]>,
    normal: [Row; 3],
    point: [Row; 3],
    on_a: Option<[Row; 3]>,
    on_b: Option<[Row; 3]>,
}

#[derive(Deserialize)]
struct Weights {
    s: Option<f64>,
    s_b: Option<f64>,
    overlap: Option<f64>,
    normal: Option<[f64; 3]>,
    point: Option<[f64; 3]>,
    on_a: Option<[f64; 3]>,
    on_b: Option<[f64; 3]>,
}

#[derive(Deserialize)]
#[allow(non_snake_case)]
struct BodyGradient {
    planes: BTreeMap<usize, [f64; 4]>,
    rkR: [Option<f64>; 3],
}

#[derive(Deserialize)]
struct Weighted {
    weights: Weights,
    a: BodyGradient,
    b: BodyGradient,
}

#[derive(Deserialize)]
struct Line {
    pair: usize,
    formulation: String,
    pose: Poses,
    shape: Vec<Weighted>,
}

impl Weights {
    fn of_contact(&self) -> ContactWeights {
        let vector = |v: Option<[f64; 3]>| v.map_or_else(Vector3::zeros, Vector3::from);
        ContactWeights {
            s: self.s.unwrap_or(0.0),
            s_b: self.s_b.unwrap_or(0.0),
            overlap: self.overlap.unwrap_or(0.0),
            normal: vector(self.normal),
            point: vector(self.point),
            point_on_a: vector(self.on_a),
            point_on_b: vector(self.on_b),
        }
    }
}

/// Largest error of rows beside their largest entry, turns counted in units of 1/size.
fn off(found: &[Row], truth: &[Row], size: f64) -> f64 {
    let unit = |column: usize| if column % 6 < 3 { 1.0 } else { 1.0 / size };
    let (mut worst, mut most) = (0.0_f64, 0.0_f64);
    for (found, truth) in found.iter().zip(truth) {
        for column in 0..12 {
            let error = (found[column] - truth[column]).abs();
            assert!(error.is_finite());
            worst = worst.max(error * unit(column));
            most = most.max(truth[column].abs() * unit(column));
        }
    }
    worst / most
}

fn row(row: &PoseRow) -> [Row; 1] {
    [std::array::from_fn(|column| row[column])]
}

fn rows(rows: &PoseRows) -> [Row; 3] {
    std::array::from_fn(|i| std::array::from_fn(|column| rows[(i, column)]))
}

fn pose_errors(found: &ContactDerivatives, truth: &Poses, size: f64) -> Vec<(&'static str, f64)> {
    let mut errors = vec![
        ("s", off(&row(&found.s), &truth.s, size)),
        ("normal", off(&rows(&found.normal), &truth.normal, size)),
        ("point", off(&rows(&found.point), &truth.point, size)),
    ];
    if let Some(truth) = &truth.s_b {
        errors.push(("s_b", off(&row(&found.s_b), truth, size)));
    }
    match (&truth.overlap, &truth.on_a, &truth.on_b) {
        (Some(overlap), Some(on_a), Some(on_b)) => errors.extend([
            ("overlap", off(&row(&found.overlap), overlap, size)),
            ("on_a", off(&rows(&found.point_on_a), on_a, size)),
            ("on_b", off(&rows(&found.point_on_b), on_b, size)),
        ]),
        _ => assert!(found.overlap.iter().chain(&found.point_on_a).chain(&found.point_on_b).all(|v| v.is_nan())),
    }
    errors
}

/// Largest errors of normals, offsets, r and R, with lengths in units of the size, beside the largest of all of them;
/// and that of k beside itself or the others. What is less than `least` counts as that: where nothing changes,
/// differences are noise.
fn shape_errors(found: &ShapeGradient, truth: &BodyGradient, size: f64, least: f64) -> Vec<(&'static str, f64)> {
    let mut errors = [("n", 0.0_f64), ("d", 0.0), ("r", 0.0), ("k", 0.0), ("R", 0.0)];
    let mut most = least;
    let mut meet = |i: usize, found: f64, truth: f64, unit: f64| {
        let error = unit * (found - truth).abs();
        assert!(error.is_finite());
        errors[i].1 = errors[i].1.max(error);
        if i != 3 {
            most = most.max(unit * truth.abs());
        }
    };
    for (i, plane) in found.planes.iter().enumerate() {
        let [a, b, c, d] = truth.planes.get(&i).copied().unwrap_or([0.0; 4]);
        for (found, truth) in plane.normal.iter().zip([a, b, c]) {
            meet(0, *found, truth, 1.0);
        }
        meet(1, plane.offset, d, size);
    }
    for (i, (found, unit)) in [(found.r, size), (found.k, 1.0), (found.shadow_radius, size)].into_iter().enumerate() {
        if let Some(truth) = truth.rkR[i] {
            meet(2 + i, found, truth, unit);
        }
    }
    let of_k = truth.rkR[1].map_or(0.0, f64::abs);
    errors.into_iter().map(|(name, error)| (name, error / if name == "k" { most.max(of_k) } else { most })).collect()
}

fn lines() -> Vec<Line> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/derivatives.jsonl");
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{path}: {error}"));
    text.lines().map(|line| serde_json::from_str(line).expect("a contact per line")).collect()
}

fn sorted(errors: &[f64]) -> Vec<f64> {
    let mut sorted = errors.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted
}

#[test]
fn derivatives_are_those_of_differences_in_130_digits() {
    let pairs = pairs();
    let mut by_kind: BTreeMap<(String, &'static str), Vec<f64>> = BTreeMap::new();
    let mut all = Vec::new();
    let mut flags = BTreeMap::<String, usize>::new();
    for line in lines() {
        let pair = &pairs[line.pair];
        let (a, b) = (pair.shape_a.particle(), pair.shape_b.particle());
        let (pose_a, pose_b) = (pair.a.pose(), pair.b.pose());
        let formulation = if line.formulation == "midway" { Formulation::Midway } else { Formulation::Closest };
        let settings =
            Settings::default().with_formulation(formulation).with_solve_separated(true).with_gap_tolerance(1e-14);
        let contact: Contact = detect(&a, &pose_a, &b, &pose_b, &settings, None).unwrap();
        assert_eq!(contact.formulation, formulation);
        let size = (pose_a.position() - pose_b.position()).norm();
        let found = contact_derivatives(&a, &pose_a, &b, &pose_b, &contact, &settings).unwrap();
        *flags.entry(found.flags.to_string()).or_default() += 1;
        let mut errors = pose_errors(&found, &line.pose, size);
        for weighted in &line.shape {
            let (mut of_a, mut of_b) = (ShapeGradient::zeros(&a), ShapeGradient::zeros(&b));
            let weights = weighted.weights.of_contact();
            let lengths =
                weights.overlap.abs() + (weights.point.norm() + weights.point_on_a.norm() + weights.point_on_b.norm());
            let least = 1e-3 * (weights.s.abs() + weights.s_b.abs() + weights.normal.norm() + size * lengths);
            let shapes = (Some(&mut of_a), Some(&mut of_b));
            contact_gradient(&a, &pose_a, &b, &pose_b, &contact, &settings, &weights, shapes.0, shapes.1).unwrap();
            errors.extend(shape_errors(&of_a, &weighted.a, size, least));
            errors.extend(shape_errors(&of_b, &weighted.b, size, least));
        }
        for (name, error) in errors {
            if error > WORST {
                println!(
                    "pair {} ({}, {}): {name} off by {error:e}; {}",
                    line.pair, pair.family, line.formulation, found.flags
                );
            }
            by_kind.entry((pair.family.clone(), name)).or_default().push(error);
            all.push(error);
        }
    }
    for ((family, name), errors) in &by_kind {
        let sorted = sorted(errors);
        println!(
            "{family:16} {name:9} {:4} median {:8.1e} worst {:8.1e}",
            sorted.len(),
            sorted[sorted.len() / 2],
            sorted[sorted.len() - 1]
        );
    }
    let sorted = sorted(&all);
    let at = |share: f64| sorted[(share * (sorted.len() - 1) as f64) as usize];
    println!(
        "{} numbers: median {:e}, 90 % {:e}, 99 % {:e}, worst {:e}",
        sorted.len(),
        at(0.5),
        at(0.9),
        at(0.99),
        at(1.0)
    );
    println!("{flags:?}");
    assert!(at(0.5) < MEDIAN && at(1.0) < WORST);
}
