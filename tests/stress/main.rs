//! "make stress" in small: random pairs, walks, sweeps, walls, seams, memories, patches and mass
//! properties in seconds; and every pair that once failed.

mod parts;
mod planted;
mod regressions;
mod yardstick;

use indicatif::ProgressBar;
use kit::stress::ledger::{self, Ledger};
use kit::stress::{pairs, sweeps, walks};
use std::sync::atomic::AtomicBool;

const THREADS: usize = 2;

/// Cases of seed 1.
fn ledger(count: u64, one: impl Fn(u64, &mut Ledger) + Sync) -> Ledger {
    ledger::run((1, count), THREADS, &AtomicBool::new(false), &ProgressBar::hidden(), one)
}

/// No failure, and a reference that settles nearly all.
fn check(part: &str, ledger: &Ledger, most_unsettled: f64) {
    if ledger.failures() > 0 {
        ledger.print(part);
    }
    assert!(ledger.judged > 0 && ledger.share_unsettled() <= most_unsettled, "{} unsettled", ledger.unsettled);
    assert_eq!(ledger.failures(), 0, "{:?}", ledger.by_fault());
}

#[test]
fn random_pairs_of_all_families() {
    const POSES: u64 = 8_000;
    let range = pairs::Range { seed: 1, first: 0, count: POSES, family: None, settle_every: 1 };
    let tally = pairs::run(&range, THREADS, &AtomicBool::new(false), &ProgressBar::hidden());
    assert_eq!(tally.ledger.cases, POSES);
    assert!(tally.families.iter().all(|family| family.pairs > 0));
    assert_eq!(tally.unit_digits, 0, "another unit of length gives other digits");
    // A judge that settles nothing would find nothing.
    check("pairs", &tally.ledger, 0.05);
}

#[test]
fn random_walks_from_memory() {
    check("walks", &ledger(40, |walk, ledger| walks::one(1, walk, ledger)), 0.0);
}

#[test]
fn smooth_motions_have_no_jumps() {
    let mut ledger = Ledger::default();
    let found = sweeps::all(&mut ledger, || ());
    assert_eq!(found.len() as u64, sweeps::COUNT);
    assert!(ledger.faults.is_empty(), "{:?}", ledger.found);
    // Points may run along a face and normals turn at a corner, but forces go by the overlap.
    for sweep in &found {
        let (left, motion) = (sweep.left[2], sweep.motion);
        assert!(left < 1e-10, "the overlap jumps by {left:e} in {motion}, r={:e}, k={:e}", sweep.r, sweep.k);
    }
    // They do move: a sweep that stands still would never jump.
    assert!(found.iter().all(|sweep| sweep.rates[0] > 0.05), "a motion without motion");
}
