//! The cost of each kind of call, in units of one evaluation of both bodies.

use crate::Effort;
use crate::clock::{self, Contestant, median};
use kit::random::Random;
use kit::scene::facets::Facet;
use kit::scene::polyhedra;
use kit::scene::pyramids::{self, pyramid};
use kit::scene::touching::{self, Touching};
use kit::target::{at_least, at_most};
use nalgebra::{Matrix3, Vector3};
use potential_particles::internals::{Pair, reject};
use potential_particles::{
    BackEnd, Contact, ContactWeights, Formulation, Section, Settings, ShapeGradient, contact_derivatives,
    contact_gradient, detect, detect_batch,
};
use serde::Serialize;
use serde_json::Value;
use std::cell::RefCell;
use std::hint::black_box;

/// Cost of one kind of call: the median over pairs, each called again and again.
#[derive(Serialize)]
struct Cost {
    name: String,
    nanoseconds: f64,
    /// The same over that of one evaluation.
    units: f64,
}

/// Costs on pairs of one shape.
#[derive(Serialize)]
pub struct Group {
    shape: String,
    pairs: usize,
    costs: Vec<Cost>,
}

/// Name of the cost of a contact in a batch of contacts that are carried on.
const BATCH: &str = "midway, carried in a batch";

/// Turns of a batch and as many evaluations.
const ROUNDS_OF_BATCHES: usize = 50;

/// Relative tolerance of the contact area where one is needed.
const AREA_TOLERANCE: f64 = 1e-6;

fn rounded_name((r, k): (f64, f64)) -> String {
    format!("pyramids, r = {r}, k = {k}")
}

fn planes_name(planes: usize) -> String {
    format!("{planes} + {planes} planes")
}

pub fn measure(effort: &Effort) -> Vec<Group> {
    let mut random = Random::seeded(20_090_101);
    let mut groups = Vec::new();
    for shape in pyramids::ROUNDED.into_iter().chain([pyramids::SHARP]) {
        let pyramid = pyramid(shape.0, shape.1);
        let pairs = touching::pairs(&pyramid, effort.pyramids, &mut random);
        groups.push(pyramid_costs(rounded_name(shape), &pairs, effort, &mut random));
        groups.push(triangle_costs(shape, &pairs, effort, &mut random));
    }
    for planes in polyhedra::PLANE_COUNTS {
        let pairs: Vec<Touching> = (0..effort.polyhedra)
            .map(|_| {
                let [a, b] = [0; 2].map(|_| polyhedra::ball(planes, &mut random));
                Touching::new(&a, &b, &mut random)
            })
            .collect();
        let contacts: Vec<Contact> = pairs.iter().map(|pair| cold(pair, &midway())).collect();
        let slopes = Slopes::new(&pairs, Formulation::Midway);
        let contestants: [(&str, Contestant); 6] = [
            ("evaluation", &|i| pairs[i].evaluate()),
            ("midway, cold", &|i| _ = black_box(cold(&pairs[i], &midway()))),
            ("midway, warm", &|i| _ = black_box(warm(&pairs[i], &midway()))),
            ("midway, pose derivatives", &|i| slopes.of_poses(i)),
            ("midway, product in the shapes", &|i| slopes.of_shapes(i)),
            ("contact area", &|i| contact_area(&pairs[i], &contacts[i])),
        ];
        groups.push(group(planes_name(planes), pairs.len(), &contestants, effort));
    }
    groups
}

fn pyramid_costs(name: String, pairs: &[Touching], effort: &Effort, random: &mut Random) -> Group {
    let by_spheres: Vec<Touching> = pairs.iter().map(|pair| pair.pushed(3.0, random)).collect();
    let by_faces: Vec<Touching> = pairs.iter().filter_map(|pair| pair.beyond_a_face(random)).collect();
    let by_memory = touching::barely_apart(pairs, random);
    assert!(!by_faces.is_empty(), "{name}: no pair is rejected by a face while its spheres meet");
    assert!(!by_memory.is_empty(), "{name}: every separated pair is rejected without memory");
    let contacts: Vec<Contact> = pairs.iter().map(|pair| cold(pair, &midway())).collect();
    let (closest, carrying) = (midway().with_formulation(Formulation::Closest), carrying_on());
    let cone = |settings: Settings| settings.with_back_end(BackEnd::ConeProgram);
    let slopes = Slopes::new(pairs, Formulation::Midway);
    let of_closest = Slopes::new(pairs, Formulation::Closest);
    let contestants: [(&str, Contestant); 18] = [
        ("evaluation", &|i| pairs[i].evaluate()),
        ("evaluation by potential::local", &|i| pairs[i].evaluate_by_library()),
        ("midway, cold", &|i| _ = black_box(cold(&pairs[i], &midway()))),
        ("midway, warm", &|i| _ = black_box(warm(&pairs[i], &midway()))),
        ("midway, carried", &|i| _ = black_box(warm(&pairs[i], &carrying))),
        ("closest, cold", &|i| _ = black_box(cold(&pairs[i], &closest))),
        ("closest, warm", &|i| _ = black_box(warm(&pairs[i], &closest))),
        ("rejected by spheres", &|i| _ = black_box(cold(&by_spheres[i], &midway()))),
        ("rejected by a face", &|i| _ = black_box(cold(&by_faces[i % by_faces.len()], &midway()))),
        ("test by a face", &|i| proof(&by_faces[i % by_faces.len()])),
        ("rejected by memory", &|i| _ = black_box(warm(&by_memory[i % by_memory.len()], &midway()))),
        ("clarabel, midway", &|i| _ = black_box(cold(&pairs[i], &cone(midway())))),
        ("clarabel, closest", &|i| _ = black_box(cold(&pairs[i], &cone(closest)))),
        ("midway, pose derivatives", &|i| slopes.of_poses(i)),
        ("midway, product in the shapes", &|i| slopes.of_shapes(i)),
        ("closest, pose derivatives", &|i| of_closest.of_poses(i)),
        ("closest, product in the shapes", &|i| of_closest.of_shapes(i)),
        ("contact area", &|i| contact_area(&pairs[i], &contacts[i])),
    ];
    let mut group = group(name, pairs.len(), &contestants, effort);
    group.costs.push(batch(pairs, effort));
    group
}

/// A particle and a triangle of its size: a contact, a near miss that is solved to the end in most cases, and one far
/// off; and what follows a solution, both surface points along a normal.
fn triangle_costs((r, k): (f64, f64), pairs: &[Touching], effort: &Effort, random: &mut Random) -> Group {
    let touching: Vec<Facet> = pairs.iter().map(|pair| Facet::touching(&pair.a, random)).collect();
    let pushed = |way: f64| touching.iter().map(|facet| facet.pushed(way)).collect::<Vec<Facet>>();
    let (near, far) = (pushed(2.0 * touching::OVERLAP), pushed(3.0));
    let contacts: Vec<Contact> = pairs.iter().map(|pair| cold(pair, &midway())).collect();
    let along = |turn: &Matrix3<f64>, v: Vector3<f64>| turn.tr_mul(&v);
    let contestants: [(&str, Contestant); 5] = [
        ("evaluation", &|i| pairs[i].evaluate()),
        ("touching", &|i| _ = black_box(black_box(&touching[i]).contact())),
        ("near", &|i| _ = black_box(black_box(&near[i]).contact())),
        ("far", &|i| _ = black_box(black_box(&far[i]).contact())),
        ("both surface points of a pair", &|i| {
            let (pair, Contact { branch_a, branch_b, normal, .. }) = (black_box(&pairs[i]), contacts[i]);
            let (a, b) = (pair.pose_a.rotation(), pair.pose_b.rotation());
            black_box(pair.a.surface_distance(&along(a, branch_a), &along(a, normal)));
            black_box(pair.b.surface_distance(&along(b, branch_b), &along(b, -normal)));
        }),
    ];
    group(format!("particle against triangle, r = {r}, k = {k}"), pairs.len(), &contestants, effort)
}

/// A contact of a batch on one thread, in which the poses of all B go to and fro between two, beside as many
/// evaluations.
fn batch(pairs: &[Touching], effort: &Effort) -> Cost {
    let particles: Vec<_> = pairs.iter().flat_map(|pair| [&pair.a, &pair.b]).collect();
    let poses = [true, false].map(|moved| -> Vec<_> {
        pairs.iter().flat_map(|pair| [pair.pose_a, if moved { pair.moved_b } else { pair.pose_b }]).collect()
    });
    let bodies: Vec<_> = (0..pairs.len() as u32).map(|i| [2 * i, 2 * i + 1]).collect();
    let states: Vec<_> = pairs.iter().map(|pair| pair.state(Formulation::Midway)).collect();
    let kept = RefCell::new((states, 0));
    let step = |_| {
        let (states, count) = &mut *kept.borrow_mut();
        let poses = &poses[*count % 2];
        *count += 1;
        let _ = black_box(&detect_batch(&particles, poses, &bodies, &carrying_on(), 1, states));
    };
    let evaluate = |_| pairs.iter().for_each(Touching::evaluate);
    let seconds = clock::race(1, &[&evaluate, &step], ROUNDS_OF_BATCHES.max(effort.rounds));
    let (nanoseconds, units) = (1e9 * seconds[1][0] / pairs.len() as f64, seconds[1][0] / seconds[0][0]);
    Cost { name: BATCH.into(), nanoseconds, units }
}

/// Measures all contestants; the first is the evaluation, and the unit.
fn group(shape: String, pairs: usize, contestants: &[(&str, Contestant)], effort: &Effort) -> Group {
    let calls: Vec<Contestant> = contestants.iter().map(|(_, call)| *call).collect();
    let medians: Vec<f64> = clock::race(pairs, &calls, effort.rounds).into_iter().map(median).collect();
    println!("\n{shape}");
    let costs = contestants.iter().zip(&medians).map(|((name, _), seconds)| {
        let (name, nanoseconds, units) = ((*name).to_owned(), 1e9 * seconds, seconds / medians[0]);
        println!("  {name:32} {nanoseconds:10.0} ns {units:8.1} evaluations");
        Cost { name, nanoseconds, units }
    });
    Group { costs: costs.collect(), shape, pairs }
}

fn midway() -> Settings {
    Settings::default()
}

fn carrying_on() -> Settings {
    Settings::default().with_carry_tolerance(touching::CARRY_TOLERANCE)
}

fn cold(pair: &Touching, settings: &Settings) -> Contact {
    let pair = black_box(pair);
    detect(&pair.a, &pair.pose_a, &pair.b, &pair.pose_b, settings, None).expect("a contact of ordinary bodies")
}

/// From the memory of the pose before.
fn warm(pair: &Touching, settings: &Settings) -> Contact {
    let pair = black_box(pair);
    let mut state = pair.state(settings.formulation);
    detect(&pair.a, &pair.pose_a, &pair.b, &pair.moved_b, settings, Some(&mut state))
        .expect("a contact of ordinary bodies")
}

fn proof(pair: &Touching) {
    let pair = black_box(pair);
    black_box(reject::proof_of_separation(&Pair::new(&pair.a, &pair.pose_a, &pair.b, &pair.pose_b)).is_some());
}

fn contact_area(pair: &Touching, contact: &Contact) {
    let Contact { branch_a, branch_b, normal, .. } = *black_box(contact);
    let (pair, section) = (black_box(pair), Section { branch_a, branch_b, normal });
    let _ = black_box(section.area(&pair.a, &pair.pose_a, &pair.b, &pair.pose_b, AREA_TOLERANCE));
}

/// The derivatives of contacts in the poses, and a product with those in both shapes; of the pairs that have such: in a
/// core no gradient tells a normal.
struct Slopes<'a> {
    pairs: Vec<&'a Touching>,
    settings: Settings,
    contacts: Vec<Contact>,
    /// What products are added to: all pairs of a group have as many planes.
    sums: RefCell<[ShapeGradient; 2]>,
}

impl<'a> Slopes<'a> {
    fn new(pairs: &'a [Touching], formulation: Formulation) -> Self {
        let settings = midway().with_formulation(formulation);
        let known = |pair: &&Touching| {
            let contact = cold(pair, &settings);
            let found = contact_derivatives(&pair.a, &pair.pose_a, &pair.b, &pair.pose_b, &contact, &settings);
            if let Err(error) = &found {
                println!("  without derivatives: {error}");
            }
            found.is_ok()
        };
        let all = pairs.len();
        let pairs: Vec<&Touching> = pairs.iter().filter(known).collect();
        assert!(10 * pairs.len() >= 9 * all, "{} of {all} pairs have no derivatives", all - pairs.len());
        let contacts = pairs.iter().map(|pair| cold(pair, &settings)).collect();
        let sums = RefCell::new([ShapeGradient::zeros(&pairs[0].a), ShapeGradient::zeros(&pairs[0].b)]);
        Self { pairs, settings, contacts, sums }
    }

    fn of_poses(&self, i: usize) {
        let i = i % self.pairs.len();
        let p = black_box(self.pairs[i]);
        let found = contact_derivatives(&p.a, &p.pose_a, &p.b, &p.pose_b, &self.contacts[i], &self.settings);
        black_box(&found.expect("derivatives of an overlapping contact"));
    }

    fn of_shapes(&self, i: usize) {
        let weights = ContactWeights {
            s: 0.1,
            overlap: 1.0,
            normal: [0.3, 0.2, 0.1].into(),
            point: [0.1, 0.2, 0.3].into(),
            ..ContactWeights::default()
        };
        let i = i % self.pairs.len();
        let (p, contact) = (black_box(self.pairs[i]), &self.contacts[i]);
        let [a, b] = &mut *self.sums.borrow_mut();
        let (a, b) = (Some(a), Some(b));
        let found = contact_gradient(&p.a, &p.pose_a, &p.b, &p.pose_b, contact, &self.settings, &weights, a, b);
        black_box(&found.expect("a gradient of an overlapping contact"));
    }
}

/// The stated ratios. Where several pyramids are meant, the worst of them counts.
pub fn targets(groups: &[Group]) -> Vec<Value> {
    let rounded = pyramids::ROUNDED.map(rounded_name);
    let cost = |shape: &str, name: &str| {
        let group = groups.iter().find(|group| group.shape == shape).expect("a group of this shape");
        group.costs.iter().find(|cost| cost.name == name).expect("a cost of this name")
    };
    let units = |name: &str| rounded.iter().map(|shape| cost(shape, name).units).fold(0.0, f64::max);
    let quotients = |over: &str, under: &str| {
        let of = |shape: &String| cost(shape, over).units / cost(shape, under).units;
        rounded.each_ref().map(of)
    };
    let most = |over: &str, under: &str| quotients(over, under).into_iter().fold(0.0, f64::max);
    let least = |over: &str, under: &str| quotients(over, under).into_iter().fold(f64::INFINITY, f64::min);
    let warm_ns = |planes: usize| cost(&planes_name(planes), "midway, warm").nanoseconds;
    let sharp = cost(&rounded_name(pyramids::SHARP), "midway, cold").units;
    // Of the pyramids in the middle.
    let slope = |name: &str, warm: &str| cost(&rounded[1], name).units / cost(&rounded[1], warm).units;
    vec![
        at_most("pose derivatives / warm call, midway", 0.3, slope("midway, pose derivatives", "midway, warm")),
        at_most(
            "product in the shapes / warm call, midway",
            1.0,
            slope("midway, product in the shapes", "midway, warm"),
        ),
        at_most("pose derivatives / warm call, closest", 0.3, slope("closest, pose derivatives", "closest, warm")),
        at_most(
            "product in the shapes / warm call, closest",
            1.0,
            slope("closest, product in the shapes", "closest, warm"),
        ),
        at_most("midway with geometry, cold (evaluations)", 50.0, units("midway, cold")),
        at_most("midway with geometry, warm (evaluations)", 15.0, units("midway, warm")),
        at_most("midway carried to a pose 1e-4 away (evaluations)", 8.0, units("midway, carried")),
        at_most("the same in a batch, one thread (evaluations)", 8.0, units(BATCH)),
        at_most("closest / midway, cold", 1.6, most("closest, cold", "midway, cold")),
        at_most("closest / midway, warm", 1.6, most("closest, warm", "midway, warm")),
        at_most("midway at r/size = k = 1e-6, cold (evaluations)", 150.0, sharp),
        at_least("clarabel / midway, cold", 200.0, least("clarabel, midway", "midway, cold")),
        at_least("clarabel / closest, cold", 200.0, least("clarabel, closest", "closest, cold")),
        at_most("rejected, direction in memory (evaluations)", 3.0, units("rejected by memory")),
        at_most("rejected by spheres, cold (evaluations)", 6.0, units("rejected by spheres")),
        at_most("rejected by a face, cold (evaluations)", 6.0, units("rejected by a face")),
        at_most("300 + 300 planes / 10 + 10 planes, warm", 6.0, warm_ns(300) / warm_ns(10)),
        at_most("1000 + 1000 planes / 10 + 10 planes, warm", 10.0, warm_ns(1000) / warm_ns(10)),
    ]
}
