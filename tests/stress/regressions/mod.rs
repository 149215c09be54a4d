//! Every pair that once failed, by what must hold of it.

mod closest;
mod fuzzed;
mod gap;
mod point;
mod surface;

use kit::stress::cases::{Case, stream};
use kit::stress::judge::{Failure, Shared, Trial, judge};
use kit::stress::line::Line;
use potential_particles::{Contact, Formulation, Settings, detect};

/// The pair of this name.
fn line(name: &str) -> Line {
    let text = include_str!("../../data/regressions.jsonl");
    text.lines()
        .map(|line| serde_json::from_str::<Line>(line).expect("a pair a line"))
        .find(|line| line.what == name)
        .unwrap_or_else(|| panic!("no pair is called {name}"))
}

/// Judges the pair of this name; of failures only those asked for count.
fn judged(name: &str, kinds: &[Failure]) {
    // The motions and steps by which it is judged.
    (1..=50).for_each(|seed| judged_by(name, kinds, seed, 0));
}

/// The same with the very motions and steps of pair `index` of a run.
fn judged_by(name: &str, kinds: &[Failure], seed: u64, index: u64) {
    let line = line(name);
    let shapes = line.shapes().expect("two particles");
    let [at_a, at_b] = line.places();
    let case = Case { shapes: &shapes, at_a, at_b };
    let shared = Shared::of(&shapes.a, &shapes.b, &mut stream(seed, 3, 0));
    let verdict = judge(&case, &shared, Trial::WHOLE, detect, &mut stream(seed, 4, index));
    let failures: Vec<_> = verdict.failures.iter().filter(|(failure, _)| kinds.contains(failure)).collect();
    assert!(failures.is_empty(), "{name}: {failures:?}");
}

/// The contact of the pair of this name, with default settings and without memory.
fn solved(name: &str, formulation: Formulation) -> Contact {
    let line = line(name);
    let shapes = line.shapes().expect("two particles");
    let [at_a, at_b] = line.places().map(|place| place.pose());
    let settings = Settings::default().with_formulation(formulation);
    detect(&shapes.a, &at_a, &shapes.b, &at_b, &settings, None).expect("an answer")
}
