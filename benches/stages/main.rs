//! criterion benchmarks of each stage of a contact call.
//!
//! Every benchmark walks over its pairs, so that a call never repeats the one before.

// criterion's macro makes a public function without a word on it.
#![allow(missing_docs)]

#[path = "../scene/mod.rs"]
mod scene;

use criterion::{Criterion, criterion_group, criterion_main};
use nalgebra::Vector3;
use potential_particles::Section;
use potential_particles::internals::{Pair, reject};
use potential_particles::{Contact, Formulation, PairState, Settings, detect};
use scene::facets::Facet;
use scene::random::Random;
use scene::touching::{self, Touching};
use scene::{polyhedra, pyramids};
use std::hint::black_box;
use std::time::Duration;

/// Pairs of each benchmark.
const PAIRS: usize = 500;
/// Fewer pairs where one has up to 2,000 planes.
const POLYHEDRA: usize = 50;
/// Relative tolerance of a contact area where one is needed.
const AREA_TOLERANCE: f64 = 1e-6;

/// Measures `call` on one pair after the other.
fn walk<T>(c: &mut Criterion, group: &str, name: &str, pairs: &[Touching], call: impl Fn(&Touching) -> T) {
    let mut next = 0;
    c.benchmark_group(group).bench_function(name, |bencher| {
        bencher.iter(|| {
            next = (next + 1) % pairs.len();
            call(black_box(&pairs[next]))
        });
    });
}

fn contact(pair: &Touching, formulation: Formulation) -> Contact {
    let settings = Settings::default().with_formulation(formulation);
    detect(&pair.a, &pair.pose_a, &pair.b, &pair.pose_b, &settings, None).expect("a contact of ordinary bodies")
}

fn warm(pair: &Touching, formulation: Formulation) -> Contact {
    let settings = Settings::default().with_formulation(formulation);
    let mut state: PairState = pair.state(formulation);
    detect(&pair.a, &pair.pose_a, &pair.b, &pair.moved_b, &settings, Some(&mut state))
        .expect("a contact of ordinary bodies")
}

fn solve(c: &mut Criterion) {
    for shape @ (r, k) in pyramids::ROUNDED.into_iter().chain([pyramids::SHARP]) {
        let mut random = Random::seeded(20_090_101);
        let pairs = touching::pairs(&pyramids::pyramid(r, k), PAIRS, &mut random);
        let group = format!("pyramids r={r} k={k}");
        for (name, formulation) in [("midway", Formulation::Midway), ("closest", Formulation::Closest)] {
            walk(c, &group, &format!("{name} cold"), &pairs, |pair| contact(pair, formulation));
            walk(c, &group, &format!("{name} warm"), &pairs, |pair| warm(pair, formulation));
        }
        if shape == pyramids::ROUNDED[1] {
            walk(c, "evaluate", "plain, the unit", &pairs, Touching::evaluate);
            walk(c, "evaluate", "potential::local", &pairs, Touching::evaluate_by_library);
            rejects(c, &pairs, &mut random);
            describe(c, &pairs);
        }
    }
}

fn rejects(c: &mut Criterion, pairs: &[Touching], random: &mut Random) {
    let by_spheres: Vec<Touching> = pairs.iter().map(|pair| pair.pushed(3.0, random)).collect();
    let by_faces: Vec<Touching> = pairs.iter().filter_map(|pair| pair.beyond_a_face(random)).collect();
    let apart = touching::barely_apart(pairs, random);
    for (name, pairs) in [("test by spheres", &by_spheres), ("test by a face", &by_faces)] {
        walk(c, "reject", name, pairs, |pair| {
            let pair = Pair::new(&pair.a, &pair.pose_a, &pair.b, &pair.pose_b);
            reject::proof_of_separation(&pair)
        });
    }
    walk(c, "reject", "call, by spheres", &by_spheres, |pair| contact(pair, Formulation::Midway));
    walk(c, "reject", "call, by a face", &by_faces, |pair| contact(pair, Formulation::Midway));
    walk(c, "reject", "call, apart, cold", &apart, |pair| contact(pair, Formulation::Midway));
    walk(c, "reject", "call, by memory", &apart, |pair| warm(pair, Formulation::Midway));
}

/// A particle and a triangle of its size: a contact, a near miss that is solved to the end in most cases, and one far
/// off.
fn facets(c: &mut Criterion) {
    for (r, k) in pyramids::ROUNDED.into_iter().chain([pyramids::SHARP]) {
        let mut random = Random::seeded(20_090_103);
        let pyramid = pyramids::pyramid(r, k);
        let touching: Vec<Facet> = (0..PAIRS).map(|_| Facet::touching(&pyramid, &mut random)).collect();
        for (name, way) in [("touching", 0.0), ("near", 2.0 * touching::OVERLAP), ("far", 3.0)] {
            let facets: Vec<Facet> = touching.iter().map(|facet| facet.pushed(way)).collect();
            let mut next = 0;
            let group = format!("particle against triangle r={r} k={k}");
            c.benchmark_group(group).bench_function(name, |bencher| {
                bencher.iter(|| {
                    next = (next + 1) % facets.len();
                    black_box(&facets[next]).contact()
                });
            });
        }
    }
}

/// What follows the solution: surface points along the normal, and the area.
fn describe(c: &mut Criterion, pairs: &[Touching]) {
    let contacts: Vec<Contact> = pairs.iter().map(|pair| contact(pair, Formulation::Midway)).collect();
    let mut next = 0;
    c.benchmark_group("geometry").bench_function("both surface points", |bencher| {
        bencher.iter(|| {
            next = (next + 1) % pairs.len();
            let (pair, contact) = (black_box(&pairs[next]), &contacts[next]);
            let along = |rotation: &nalgebra::Matrix3<f64>, v: Vector3<f64>| rotation.tr_mul(&v);
            let (pose_a, pose_b) = (&pair.pose_a.rotation(), &pair.pose_b.rotation());
            [
                pair.a.surface_distance(&along(pose_a, contact.branch_a), &along(pose_a, contact.normal)),
                pair.b.surface_distance(&along(pose_b, contact.branch_b), &along(pose_b, -contact.normal)),
            ]
        });
    });
    areas(c, "geometry", pairs);
}

fn areas(c: &mut Criterion, group: &str, pairs: &[Touching]) {
    let sections: Vec<Section> = pairs
        .iter()
        .map(|pair| {
            let Contact { branch_a, branch_b, normal, .. } = contact(pair, Formulation::Midway);
            Section { branch_a, branch_b, normal }
        })
        .collect();
    let mut next = 0;
    c.benchmark_group(group).bench_function("contact area", |bencher| {
        bencher.iter(|| {
            next = (next + 1) % pairs.len();
            let (pair, section) = (black_box(&pairs[next]), &sections[next]);
            section.area(&pair.a, &pair.pose_a, &pair.b, &pair.pose_b, AREA_TOLERANCE)
        });
    });
}

fn plane_counts(c: &mut Criterion) {
    for planes in polyhedra::PLANE_COUNTS {
        let mut random = Random::seeded(planes as u64);
        let pairs: Vec<Touching> = (0..POLYHEDRA)
            .map(|_| {
                let [a, b] = [0; 2].map(|_| polyhedra::ball(planes, &mut random));
                Touching::new(&a, &b, &mut random)
            })
            .collect();
        let group = format!("{planes} + {planes} planes");
        walk(c, &group, "evaluate", &pairs, Touching::evaluate_by_library);
        walk(c, &group, "midway cold", &pairs, |pair| contact(pair, Formulation::Midway));
        walk(c, &group, "midway warm", &pairs, |pair| warm(pair, Formulation::Midway));
        areas(c, &group, &pairs);
    }
}

criterion_group! {
    name = stages;
    config = Criterion::default()
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(1000))
        .sample_size(50);
    targets = solve, facets, plane_counts
}
criterion_main!(stages);
