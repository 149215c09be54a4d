//! Every pair that once failed: `tests/data/regressions.jsonl` has them with the cause of each. And what fuzzing found,
//! by shapes of its own.

use crate::THREADS;
use indicatif::ProgressBar;
use kit::pair_line::Line;
use kit::stress::cases::{Case, Shapes, stream};
use kit::stress::judge::{Shared, Trial, judge};
use kit::stress::ledger::parallel;
use nalgebra::Vector3;
use potential_particles::{Contact, Formulation, Kind, Particle, Plane, Pose, Settings, detect};
use serde::Deserialize;
use std::sync::atomic::AtomicBool;

#[derive(Deserialize)]
struct Regression {
    #[serde(flatten)]
    pair: Line,
    /// Seed and index of the motions and steps by which it failed, where others did not do.
    #[serde(default)]
    by: Vec<[u64; 2]>,
}

fn regressions() -> Vec<Regression> {
    let text = include_str!("../data/regressions.jsonl");
    text.lines().map(|line| serde_json::from_str(line).expect("a pair a line")).collect()
}

/// By the motions and steps of 50 seeds.
#[test]
fn every_pair_that_once_failed_is_right() {
    let regressions = regressions();
    let judged = |Regression { pair, by }: &Regression, wrong: &mut Vec<String>| {
        let shapes = Shapes::of_line(pair);
        let case = Case { shapes: &shapes, at_a: pair.a, at_b: pair.b };
        for [seed, index] in (1..=50).map(|seed| [seed, 0]).chain(by.iter().copied()) {
            let shared = Shared::of(&shapes.a, &shapes.b, &mut stream(seed, 3, 0));
            let verdict = judge(&case, &shared, Trial::WHOLE, detect, &mut stream(seed, 4, index));
            let faults = verdict.faults.iter();
            wrong.extend(faults.map(|fault| format!("{}, seed {seed}, index {index}: {fault:?}", pair.what)));
        }
    };
    let all = (0..regressions.len() as u64, 1);
    let merge = |sum: &mut Vec<String>, more: Vec<String>| sum.extend(more);
    let wrong = parallel(all, THREADS, &AtomicBool::new(false), &ProgressBar::hidden(), merge, |range, wrong| {
        range.for_each(|index| judged(&regressions[index as usize], wrong));
    });
    assert!(regressions.len() > 90 && wrong.is_empty(), "{wrong:#?}");
}

/// The contact of the pair of this name, with default settings and without memory.
fn solved(name: &str, formulation: Formulation) -> Contact {
    let found = regressions().into_iter().find(|each| each.pair.what == name);
    let Line { shape_a, shape_b, a, b, .. } = found.unwrap_or_else(|| panic!("no pair is called {name}")).pair;
    let settings = Settings::default().with_formulation(formulation);
    detect(&shape_a.particle(), &a.pose(), &shape_b.particle(), &b.pose(), &settings, None).expect("an answer")
}

#[test]
fn closest_points_in_the_core_of_a_sharp_body_are_known() {
    for name in ["closest_in_a_core", "closest_deep_in_each_other", "closest_deep_in_each_other_again"] {
        for formulation in [Formulation::Midway, Formulation::Closest] {
            let contact = solved(name, formulation);
            assert!(contact.gap < 1e-9, "{name}, {formulation:?}: {contact:?}");
        }
    }
    let contact = solved("closest_at_s_of_9e-6", Formulation::Closest);
    assert!((contact.s - 9.3376e-6).abs() < 1e-9 + contact.gap && contact.gap < 1e-6, "{contact:?}");
}

/// A plane a billion away changes nothing about two cubes but the accuracy of their surface points, which is taken
/// relative to the furthest plane.
#[test]
fn a_plane_that_is_never_reached_changes_no_answer() {
    let cube = |far: Option<Plane>, r: f64, k: f64| {
        let faces = (0..3).flat_map(|axis| [1.0, -1.0].map(|sign| Vector3::ith(axis, sign)));
        let mut planes: Vec<Plane> = faces.map(|normal| Plane { normal, offset: 0.5 - r }).collect();
        planes.extend(far);
        Particle::new(&planes, r, k, 0.9).expect("a cube")
    };
    let (at_a, at_b) = (Pose::at([0.0; 3]).expect("the origin"), Pose::new([0.2, 0.1, 0.93], [1.0, 0.1, 0.2, 0.3]));
    let at_b = at_b.expect("a pose");
    let answer = |cube: &Particle| detect(cube, &at_a, cube, &at_b, &Settings::default(), None).expect("an answer");
    let far_away = Plane { normal: Vector3::new(0.6, 0.0, 0.8), offset: 1e9 };
    let (without, with) = (answer(&cube(None, 0.05, 0.1)), answer(&cube(Some(far_away), 0.05, 0.1)));
    assert!((without.overlap - with.overlap).abs() < 1e-14, "{} and {}", without.overlap, with.overlap);
    assert!(with.gap < 1e-11, "the gap is {:e}, without the plane {:e}", with.gap, without.gap);
    // Nor does one that would hardly push: edge across edge, the forces of both hold the point.
    let at_a = Pose::new([0.0; 3], [1.0, 0.4, 0.0, 0.0]).expect("a pose");
    let at_b = Pose::new([0.02, 0.03, 1.35], [1.0, 0.0, 0.4, 0.0]).expect("a pose");
    let answer = |cube: &Particle| detect(cube, &at_a, cube, &at_b, &Settings::default(), None).expect("an answer");
    let short = Plane { normal: Vector3::new(1e-16, 0.0, 0.0), offset: 1.0 };
    for (r, k) in [(0.05, 0.1), (1e-3, 1e-3), (1e-3, 1e-6)] {
        let (cube_without, cube_with) = (cube(None, r, k), cube(Some(short), r, k));
        let deep = answer(&cube_without);
        let moved = at_b.position() + (deep.overlap - 1e-3 * r) * deep.normal;
        let touching = Pose::new(moved.into(), at_b.orientation()).expect("a pose");
        let answer = |cube| detect(cube, &at_a, cube, &touching, &Settings::default(), None).expect("an answer");
        let (without, with) = (answer(&cube_without), answer(&cube_with));
        assert_eq!((with.kind, with.iterations), (Kind::Overlapping, without.iterations), "r = {r}, k = {k}");
        let ratio = with.point_bound / without.point_bound;
        assert!(ratio < 2.0, "r = {r}, k = {k}: a bound {ratio} times as long");
    }
}

/// A plane with a normal of length 5 and a reach of 1e54 along the axis of the sphere's box: corners are lost to
/// rounding, and the box leaves the centre of the particle out.
#[test]
fn a_bounding_box_holds_the_centre_of_a_particle_that_hardly_ends() {
    let planes = [
        [1.0, 6.0, 0.0, 0.75],
        [-1.0, 0.0, 0.0, 0.75],
        [0.0, 1.0, 0.0, 0.75],
        [0.0, -1.0, 0.0, 0.0],
        [0.0, 0.0029296875, 0.0, 0.0],
        [-4.74609375, -1.4560546875, 0.0, 0.0],
    ]
    .map(Plane::from);
    let particle = Particle::new(&planes, 3.026123046875, 5.489088441883201e-56, 0.69).expect("a particle");
    let (low, high) = particle.bounding_box(&Pose::at([0.0; 3]).expect("the origin"));
    let centre = Vector3::<f64>::zeros();
    assert!((0..3).all(|i| low[i] < centre[i] && high[i] > centre[i]), "box from {low} to {high}");
}
