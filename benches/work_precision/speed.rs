//! The stated ratios: cost of a call in units of one evaluation, and against the other solvers.

use crate::arguments::Effort;
use crate::baselines::{Placed, area, both_halves, one_shot};
use crate::built_in::{self, BuiltIn};
use crate::clock::{self, Contestant, median};
use crate::scene::polyhedra;
use crate::scene::pyramids::{self, pyramid};
use crate::scene::random::Random;
use crate::scene::touching::{self, Touching};
use indicatif::ProgressBar;
use potential_particles::Section;
use potential_particles::{Formulation, Settings, detect, detect_batch};
use serde::Serialize;
use std::cell::RefCell;
use std::hint::black_box;

/// Cost of one kind of call.
#[derive(Clone, Serialize)]
pub struct Cost {
    pub name: String,
    /// Median over pairs, each called again and again, in nanoseconds.
    pub nanoseconds: f64,
    /// The same in units of one evaluation.
    pub units: f64,
    /// Mean over pairs called one after the other, nothing repeated, in units.
    pub in_turn_units: f64,
}

/// Costs on pairs of one shape.
#[derive(Serialize)]
pub struct Group {
    pub shape: String,
    pub pairs: usize,
    pub costs: Vec<Cost>,
}

/// Error of s of two solvers on the same pairs, relative.
#[derive(Serialize)]
pub struct Precision {
    /// Median of the proved bound.
    pub fast_bound: f64,
    /// Median distance of clarabel's s from ours.
    pub clarabel: f64,
}

/// YADE's built-in and the library on the same pairs, taking turns.
#[derive(Serialize)]
pub struct AgainstBuiltIn {
    pub pairs: usize,
    /// Pairs on which it gave no answer or missed the contact.
    pub failed: usize,
    /// It begins at the last contact point, as in a simulation.
    pub built_in_microseconds: f64,
    /// Without memory.
    pub cold_microseconds: f64,
    /// From memory, as in a simulation.
    pub warm_microseconds: f64,
}

/// Everything of the speed part.
#[derive(Serialize)]
pub struct Speed {
    pub groups: Vec<Group>,
    pub precision: Precision,
    pub built_in: Option<AgainstBuiltIn>,
}

impl Speed {
    /// A cost by shape and name.
    pub fn cost(&self, shape: &str, name: &str) -> Option<&Cost> {
        let group = self.groups.iter().find(|group| group.shape == shape)?;
        group.costs.iter().find(|cost| cost.name == name)
    }
}

/// Names of two costs.
pub const AREA: &str = "contact area";
pub const AREA_BY_QUADRATURE: &str = "contact area by quadrature";

/// Name of the cost of a contact in a batch of contacts that are carried on.
pub const BATCH: &str = "midway, carried in a batch";

/// Turns of a batch and as many evaluations.
const ROUNDS_OF_BATCHES: usize = 50;

/// Relative tolerance of the contact area where one is needed.
pub const AREA_TOLERANCE: f64 = 1e-6;

pub fn rounded_name((r, k): (f64, f64)) -> String {
    format!("pyramids, r = {r}, k = {k}")
}

pub fn planes_name(planes: usize) -> String {
    format!("{planes} + {planes} planes")
}

pub fn measure(effort: &Effort, built_in: &mut BuiltIn, progress: &ProgressBar) -> Speed {
    let mut random = Random::seeded(20_090_101);
    let mut groups = Vec::new();
    let mut precision = Precision { fast_bound: 0.0, clarabel: 0.0 };
    let mut against = None;
    for shape in pyramids::ROUNDED.into_iter().chain([pyramids::SHARP]) {
        let name = rounded_name(shape);
        progress.set_message(name.clone());
        let pairs = touching::pairs(&pyramid(shape.0, shape.1), effort.pyramids, &mut random);
        groups.push(pyramid_costs(name, &pairs, effort, &mut random, progress));
        if shape == pyramids::ROUNDED[1] {
            precision = compared(&pairs);
            against = against_built_in(&pairs[..effort.slow.min(pairs.len())], built_in, progress);
        }
    }
    for planes in polyhedra::PLANE_COUNTS {
        let name = planes_name(planes);
        progress.set_message(name.clone());
        let pairs: Vec<Touching> = (0..effort.polyhedra)
            .map(|_| {
                let [a, b] = [0; 2].map(|_| polyhedra::ball(planes, &mut random));
                Touching::new(&a, &b, &mut random)
            })
            .collect();
        let cold = |i: usize| call(&pairs[i], Formulation::Midway);
        let warm = |i: usize| warm_call(&pairs[i], Formulation::Midway);
        let sections: Vec<Section> = pairs.iter().map(section).collect();
        let contestants: [(&str, Contestant); 5] = [
            ("evaluation", &|i| pairs[i].evaluate()),
            ("midway, cold", &cold),
            ("midway, warm", &warm),
            (AREA, &|i| contact_area(&pairs[i], &sections[i])),
            (AREA_BY_QUADRATURE, &|i| quadrature(&pairs[i], &sections[i])),
        ];
        groups.push(group(name, pairs.len(), &contestants, effort, progress));
    }
    Speed { groups, precision, built_in: against }
}

fn pyramid_costs(
    name: String,
    pairs: &[Touching],
    effort: &Effort,
    random: &mut Random,
    progress: &ProgressBar,
) -> Group {
    let by_spheres: Vec<Touching> = pairs.iter().map(|pair| pair.pushed(3.0, random)).collect();
    let by_faces: Vec<Touching> = pairs.iter().filter_map(|pair| pair.beyond_a_face(random)).collect();
    let by_memory = touching::barely_apart(pairs, random);
    assert!(!by_faces.is_empty(), "{name}: no pair is rejected by a face while its spheres meet");
    assert!(!by_memory.is_empty(), "{name}: every separated pair is rejected without memory");
    let sections: Vec<Section> = pairs.iter().map(section).collect();
    let contestants: [(&str, Contestant); 14] = [
        ("evaluation", &|i| pairs[i].evaluate()),
        ("evaluation by potential::local", &|i| pairs[i].evaluate_by_library()),
        ("midway, cold", &|i| call(&pairs[i], Formulation::Midway)),
        ("midway, warm", &|i| warm_call(&pairs[i], Formulation::Midway)),
        ("midway, carried", &|i| carried_call(&pairs[i])),
        ("closest, cold", &|i| call(&pairs[i], Formulation::Closest)),
        ("closest, warm", &|i| warm_call(&pairs[i], Formulation::Closest)),
        ("rejected by spheres", &|i| call(&by_spheres[i], Formulation::Midway)),
        ("rejected by a face", &|i| call(&by_faces[i % by_faces.len()], Formulation::Midway)),
        ("rejected by memory", &|i| warm_call(&by_memory[i % by_memory.len()], Formulation::Midway)),
        ("clarabel, midway", &|i| clarabel(&pairs[i], Formulation::Midway)),
        ("clarabel, closest", &|i| clarabel(&pairs[i], Formulation::Closest)),
        (AREA, &|i| contact_area(&pairs[i], &sections[i])),
        (AREA_BY_QUADRATURE, &|i| quadrature(&pairs[i], &sections[i])),
    ];
    let mut group = group(name, pairs.len(), &contestants, effort, progress);
    group.costs.push(batch(pairs, effort, progress));
    group
}

/// A contact of a batch on one thread, in which the poses of all B go to and fro between two, beside as many
/// evaluations.
fn batch(pairs: &[Touching], effort: &Effort, progress: &ProgressBar) -> Cost {
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
    let seconds = clock::race(1, &[&evaluate, &step], ROUNDS_OF_BATCHES.max(effort.rounds), progress);
    let (nanoseconds, units) = (1e9 * seconds[1][0] / pairs.len() as f64, seconds[1][0] / seconds[0][0]);
    Cost { name: BATCH.into(), nanoseconds, units, in_turn_units: units }
}

/// Measures all contestants; the first is the evaluation, and the unit.
fn group(
    shape: String,
    pairs: usize,
    contestants: &[(&str, Contestant)],
    effort: &Effort,
    progress: &ProgressBar,
) -> Group {
    let calls: Vec<Contestant> = contestants.iter().map(|(_, call)| *call).collect();
    let medians: Vec<f64> = clock::race(pairs, &calls, effort.rounds, progress).into_iter().map(median).collect();
    let in_turn = clock::in_turn(pairs, &calls);
    let unit = medians[0];
    let costs = contestants.iter().zip(medians.iter().zip(&in_turn)).map(|((name, _), (seconds, in_turn))| Cost {
        name: (*name).into(),
        nanoseconds: 1e9 * seconds,
        units: seconds / unit,
        in_turn_units: in_turn / unit,
    });
    Group { shape, pairs, costs: costs.collect() }
}

fn settings(formulation: Formulation) -> Settings {
    Settings::default().with_formulation(formulation)
}

fn carrying_on() -> Settings {
    Settings::default().with_carry_tolerance(touching::CARRY_TOLERANCE)
}

fn call(pair: &Touching, formulation: Formulation) {
    let pair = black_box(pair);
    let _ = black_box(&detect(&pair.a, &pair.pose_a, &pair.b, &pair.pose_b, &settings(formulation), None));
}

/// From the memory of the pose before.
fn warm_call(pair: &Touching, formulation: Formulation) {
    let pair = black_box(pair);
    let mut state = pair.state(formulation);
    let _ = black_box(&detect(&pair.a, &pair.pose_a, &pair.b, &pair.moved_b, &settings(formulation), Some(&mut state)));
}

/// Carried on from the pose before.
fn carried_call(pair: &Touching) {
    let pair = black_box(pair);
    let mut state = pair.state(Formulation::Midway);
    let contact = detect(&pair.a, &pair.pose_a, &pair.b, &pair.moved_b, &carrying_on(), Some(&mut state));
    let _ = black_box(&contact);
}

fn section(pair: &Touching) -> Section {
    let contact = detect(&pair.a, &pair.pose_a, &pair.b, &pair.pose_b, &settings(Formulation::Midway), None);
    let contact = contact.expect("a contact of ordinary bodies");
    Section { branch_a: contact.branch_a, branch_b: contact.branch_b, normal: contact.normal }
}

fn contact_area(pair: &Touching, section: &Section) {
    let (pair, section) = (black_box(pair), black_box(section));
    let _ = black_box(section.area(&pair.a, &pair.pose_a, &pair.b, &pair.pose_b, AREA_TOLERANCE));
}

fn quadrature(pair: &Touching, section: &Section) {
    let _ = black_box(area::by_quadrature(&placed(black_box(pair)), black_box(section), AREA_TOLERANCE));
}

fn placed(pair: &Touching) -> Placed<'_> {
    Placed { a: &pair.a, pose_a: &pair.pose_a, b: &pair.b, pose_b: &pair.pose_b }
}

fn clarabel(pair: &Touching, formulation: Formulation) {
    let solve = |pair: &Placed| one_shot::solve(pair, formulation, one_shot::DEFAULT_TOLERANCE);
    let placed = placed(black_box(pair));
    if formulation == Formulation::Closest {
        let _ = black_box(both_halves(&placed, solve));
    } else {
        let _ = black_box(solve(&placed));
    }
}

/// Our proved bound on the error of s beside clarabel's distance from our s.
fn compared(pairs: &[Touching]) -> Precision {
    let mut bounds = Vec::new();
    let mut distances = Vec::new();
    for pair in pairs {
        let ours = detect(&pair.a, &pair.pose_a, &pair.b, &pair.pose_b, &settings(Formulation::Midway), None);
        let theirs = one_shot::solve(&placed(pair), Formulation::Midway, one_shot::DEFAULT_TOLERANCE);
        if let (Ok(ours), Ok(theirs)) = (ours, theirs) {
            bounds.push(ours.gap / ours.s);
            distances.push((theirs.s - ours.s).abs() / ours.s);
        }
    }
    Precision { fast_bound: median(bounds), clarabel: median(distances) }
}

/// `None` without a YADE.
fn against_built_in(pairs: &[Touching], built_in: &mut BuiltIn, progress: &ProgressBar) -> Option<AgainstBuiltIn> {
    const ROUNDS: usize = 3;
    const BATCHES: usize = 21;
    if built_in.missing().is_some() {
        return None;
    }
    progress.inc_length((ROUNDS * pairs.len()) as u64);
    let mut theirs = vec![Vec::new(); pairs.len()];
    let (mut cold, mut warm) = (theirs.clone(), theirs.clone());
    // YADE has just emptied the caches; its own time is a median over many steps, too.
    let settled = |call: &dyn Fn()| median((0..BATCHES).map(|_| clock::one_batch(call)).collect());
    for _ in 0..ROUNDS {
        for (i, pair) in pairs.iter().enumerate() {
            let answer = built_in.ask(&placed(pair), None, built_in::DEFAULT_TOLERANCE, false);
            if let Some(found) = answer.ok().filter(|found| found.touching) {
                theirs[i].push(found.seconds);
                cold[i].push(settled(&|| call(pair, Formulation::Midway)));
                warm[i].push(settled(&|| warm_call(pair, Formulation::Midway)));
            }
            progress.inc(1);
        }
    }
    let failed = theirs.iter().filter(|times| times.len() < ROUNDS).count();
    let overall =
        |times: Vec<Vec<f64>>| 1e6 * median(times.into_iter().filter(|t| !t.is_empty()).map(median).collect());
    Some(AgainstBuiltIn {
        pairs: pairs.len(),
        failed,
        built_in_microseconds: overall(theirs),
        cold_microseconds: overall(cold),
        warm_microseconds: overall(warm),
    })
}
