//! "make stress" in small: random pairs, walks, sweeps, walls, seams, pairs of the plane, memories, patches and mass
//! properties in seconds; and every pair that once failed.

mod parts;
mod planted;
mod regressions;
mod yardstick;

use indicatif::ProgressBar;
use kit::stress::tally::Tally;
use kit::stress::{pairs, sweeps, walks};
use std::sync::atomic::AtomicBool;

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
