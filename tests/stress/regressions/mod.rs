//! Every pair that once failed, by what must hold of it.

mod closest;
mod fuzzed;
mod gap;
mod point;
mod surface;

use kit::pair_line::Line;
use kit::stress::cases::{Case, Shapes, stream};
use kit::stress::judge::{Shared, Trial, judge};
use kit::stress::ledger::Fault;
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
fn judged(name: &str, kinds: &[Fault]) {
    // The motions and steps by which it is judged.
    (1..=50).for_each(|seed| judged_by(name, kinds, seed, 0));
}

/// The same with the very motions and steps of pair `index` of a run.
fn judged_by(name: &str, kinds: &[Fault], seed: u64, index: u64) {
    let line = line(name);
    let shapes = Shapes::of_line(&line);
    let case = Case { shapes: &shapes, at_a: line.a, at_b: line.b };
    let shared = Shared::of(&shapes.a, &shapes.b, &mut stream(seed, 3, 0));
    let verdict = judge(&case, &shared, Trial::WHOLE, detect, &mut stream(seed, 4, index));
    let faults: Vec<_> = verdict.faults.iter().filter(|(fault, _)| kinds.contains(fault)).collect();
    assert!(faults.is_empty(), "{name}: {faults:?}");
}

/// The contact of the pair of this name, with default settings and without memory.
fn solved(name: &str, formulation: Formulation) -> Contact {
    let line = line(name);
    let shapes = Shapes::of_line(&line);
    let settings = Settings::default().with_formulation(formulation);
    detect(&shapes.a, &line.a.pose(), &shapes.b, &line.b.pose(), &settings, None).expect("an answer")
}
