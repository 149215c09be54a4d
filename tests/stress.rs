//! "make stress" in small: random pairs, walks, sweeps, walls, seams, pairs of the plane, memories, patches and mass
//! properties in seconds; and every pair that once failed.

#[path = "../tools/stress/boundaries.rs"]
mod boundaries;
#[path = "patch/brute.rs"]
mod brute;
#[path = "../tools/stress/cases.rs"]
mod cases;
#[path = "../tools/stress/clock.rs"]
#[allow(dead_code)]
mod clock;
#[path = "../tools/stress/double.rs"]
mod double;
#[path = "../benches/scene/evaluation.rs"]
#[allow(dead_code)]
mod evaluation;
#[path = "../tools/stress/exact.rs"]
mod exact;
#[path = "../tools/stress/hulls.rs"]
#[allow(dead_code)]
mod hulls;
#[path = "../tools/stress/judge.rs"]
mod judge;
#[path = "../tools/stress/least.rs"]
#[allow(dead_code)]
mod least;
#[path = "../tools/stress/ledger.rs"]
#[allow(dead_code)]
mod ledger;
#[path = "../tools/stress/line.rs"]
mod line;
#[path = "../tools/stress/mass.rs"]
#[allow(dead_code)]
mod mass;
#[path = "../tools/stress/memories.rs"]
#[allow(dead_code)]
mod memories;
#[path = "../tools/stress/pairs.rs"]
mod pairs;
#[path = "stress/parts.rs"]
mod parts;
#[path = "../tools/stress/patches.rs"]
#[allow(dead_code)]
mod patches;
#[path = "../tools/stress/placed_boundary.rs"]
mod placed_boundary;
#[path = "../tools/stress/planar.rs"]
#[allow(dead_code)]
mod planar;
#[path = "stress/planted.rs"]
mod planted;
#[path = "../benches/scene/random.rs"]
#[allow(dead_code)]
mod random;
#[path = "../tools/stress/reference.rs"]
mod reference;
#[path = "stress/regressions/mod.rs"]
mod regressions;
#[path = "../tools/stress/seams.rs"]
#[allow(dead_code)]
mod seams;
#[path = "../tools/stress/shapes.rs"]
mod shapes;
#[path = "../tools/stress/sweeps.rs"]
mod sweeps;
#[path = "../tools/stress/tally.rs"]
#[allow(dead_code)]
mod tally;
#[path = "../tools/stress/walks.rs"]
mod walks;
#[path = "../tools/stress/walls.rs"]
#[allow(dead_code)]
mod walls;
#[path = "../tools/stress/wide.rs"]
mod wide;
#[path = "stress/yardstick.rs"]
mod yardstick;

use indicatif::ProgressBar;
use std::sync::atomic::AtomicBool;
use tally::Tally;

const THREADS: usize = 2;

fn check(tally: &Tally) {
    for found in &tally.found {
        println!("{:?}, {}, index {}: {}", found.failure, found.family, found.index, found.detail);
    }
    assert_eq!(tally.failures(), 0, "{:?}", tally.failures);
}

#[test]
fn random_pairs_of_all_families() {
    const POSES: u64 = 8_000;
    let range = pairs::Range { seed: 1, first: 0, count: POSES, family: None, settle_every: 1 };
    let tally = pairs::run(&range, THREADS, &AtomicBool::new(false), &ProgressBar::hidden());
    assert_eq!(tally.pairs, POSES);
    // A judge that settles nothing would find nothing.
    assert!(tally.judged > 20 * tally.unjudged, "{} settled, {} not", tally.judged, tally.unjudged);
    assert!(tally.families.iter().all(|family| family.pairs > 0));
    assert_eq!(tally.unit_digits, 0, "another unit of length gives other digits");
    check(&tally);
}

#[test]
fn random_walks_from_memory() {
    const WALKS: u64 = 40;
    let tally = walks::run(1, WALKS, THREADS, &AtomicBool::new(false), &ProgressBar::hidden());
    assert_eq!(tally.walk_steps, WALKS * walks::STEPS);
    assert_eq!(tally.failures(), 0, "{:?}", tally.found);
}

#[test]
fn smooth_motions_have_no_jumps() {
    let mut tally = Tally::default();
    let found = sweeps::all(&mut tally, || ());
    assert_eq!(found.len() as u64, sweeps::COUNT);
    assert!(tally.failures.is_empty(), "{:?}", tally.found);
    // Points may run along a face and normals turn at a corner, but forces go by the overlap.
    for sweep in &found {
        assert!(
            sweep.left[2] < 1e-10,
            "the overlap jumps by {:e} in {}, r={:e}, k={:e}",
            sweep.left[2],
            sweep.motion,
            sweep.r,
            sweep.k
        );
    }
    // They do move: a sweep that stands still would never jump.
    assert!(found.iter().all(|sweep| sweep.rates[0] > 0.05), "a motion without motion");
}
