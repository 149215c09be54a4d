//! What derivatives cost beside a contact from memory; `make bench` adds the figures to out/bench/summary.json.

#[path = "../scene/mod.rs"]
mod scene;
#[path = "../target/mod.rs"]
mod target;

use potential_particles::{
    Contact, ContactWeights, Formulation, PairState, Settings, ShapeGradient, contact_derivatives, contact_gradient,
    detect,
};
use scene::random::Random;
use scene::touching::{self, Touching};
use scene::{polyhedra, pyramids};
use serde_json::{Value, json};
use std::hint::black_box;
use std::time::Instant;
use target::{at_most, write_summary};

/// Pairs walked over, and rounds of which the fastest counts.
const PAIRS: usize = 300;
const ROUNDS: usize = 40;

type Call<'a> = &'a dyn Fn(usize, &Touching);

/// Seconds of one call on each pair, by the fastest of all rounds, each of which has all calls in turn.
fn times<const N: usize>(pairs: &[Touching], calls: [Call; N]) -> [f64; N] {
    let mut least = [f64::INFINITY; N];
    for _ in 0..ROUNDS {
        for (least, call) in least.iter_mut().zip(calls) {
            let start = Instant::now();
            pairs.iter().enumerate().for_each(|(i, pair)| call(i, black_box(pair)));
            *least = least.min(start.elapsed().as_secs_f64() / pairs.len() as f64);
        }
    }
    least
}

/// Nanoseconds of a contact from memory, of its pose derivatives, and of a product with the derivatives in both shapes.
fn measured(pairs: &[Touching], formulation: Formulation) -> [f64; 3] {
    let settings = Settings::default().with_formulation(formulation);
    let contacts: Vec<Contact> = pairs
        .iter()
        .map(|p| detect(&p.a, &p.pose_a, &p.b, &p.pose_b, &settings, None).expect("a contact of ordinary bodies"))
        .collect();
    let warm = |_: usize, p: &Touching| {
        let mut state: PairState = p.state(formulation);
        black_box(detect(&p.a, &p.pose_a, &p.b, &p.moved_b, &settings, Some(&mut state)).is_ok());
    };
    let poses = |i: usize, p: &Touching| {
        let found = contact_derivatives(&p.a, &p.pose_a, &p.b, &p.pose_b, &contacts[i], &settings);
        black_box(&found.expect("derivatives of an overlapping contact"));
    };
    let weights = ContactWeights {
        s: 0.1,
        overlap: 1.0,
        normal: [0.3, 0.2, 0.1].into(),
        point: [0.1, 0.2, 0.3].into(),
        ..ContactWeights::default()
    };
    let sums = std::cell::RefCell::new([ShapeGradient::zeros(&pairs[0].a), ShapeGradient::zeros(&pairs[0].b)]);
    let shapes = |i: usize, p: &Touching| {
        let [a, b] = &mut *sums.borrow_mut();
        let (a, b) = (Some(a), Some(b));
        let found = contact_gradient(&p.a, &p.pose_a, &p.b, &p.pose_b, &contacts[i], &settings, &weights, a, b);
        black_box(&found.expect("a gradient of an overlapping contact"));
    };
    times(pairs, [&warm, &poses, &shapes]).map(|seconds| 1e9 * seconds)
}

fn main() {
    let mut random = Random::seeded(20_261_125);
    let mut targets: Vec<Value> = Vec::new();
    let mut rows: Vec<Value> = Vec::new();
    let mut add = |name: &str, pairs: &[Touching], limits: bool| {
        for formulation in [Formulation::Midway, Formulation::Closest] {
            let [warm, poses, shapes] = measured(pairs, formulation);
            println!("{name}, {formulation}: warm {warm:.0} ns, poses {poses:.0} ns, shapes {shapes:.0} ns");
            rows.push(json!({"pairs": name, "formulation": formulation.to_string(), "warm_ns": warm, "poses_ns": poses, "shapes_ns": shapes}));
            if limits {
                targets.push(at_most(&format!("pose derivatives / warm call, {formulation}"), 0.3, poses / warm));
                targets.push(at_most(&format!("product in the shape / warm call, {formulation}"), 1.0, shapes / warm));
            }
        }
    };
    // `-- quick`: the pairs of the targets alone.
    let quick = std::env::args().any(|argument| argument == "quick");
    for (r, k) in pyramids::ROUNDED.into_iter().chain([pyramids::SHARP]) {
        if quick && (r, k) != pyramids::ROUNDED[1] {
            continue;
        }
        let pairs = touching::pairs(&pyramids::pyramid(r, k), PAIRS, &mut random);
        add(&format!("pyramids r={r} k={k}"), &pairs, (r, k) == pyramids::ROUNDED[1]);
    }
    for planes in if quick { vec![] } else { vec![10, 300] } {
        let pairs: Vec<Touching> = (0..20)
            .map(|_| {
                let [a, b] = [0; 2].map(|_| polyhedra::ball(planes, &mut random));
                Touching::new(&a, &b, &mut random)
            })
            .collect();
        add(&format!("{planes} + {planes} planes"), &pairs, false);
    }
    // Beside the targets of the other benchmarks, in place of those of an earlier run.
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/out/bench/summary.json");
    let text = std::fs::read_to_string(path).unwrap_or_else(|_| "{}".into());
    let mut summary: Value = serde_json::from_str(&text).unwrap_or_else(|_| json!({}));
    let mut all: Vec<Value> = summary["targets"].as_array().cloned().unwrap_or_default();
    all.retain(|old| !targets.iter().any(|new| new["name"] == old["name"]));
    all.extend(targets);
    summary["targets"] = all.into();
    summary["derivatives"] = rows.into();
    match write_summary(path, &summary) {
        Ok(()) => println!("added to {path}"),
        Err(error) => println!("{path}: {error}"),
    }
}
