//! The first part: many pairs, each judged on its own, by several threads.

use crate::cases::{Case, FAMILIES, POSES_A_PAIR, Shapes, stream};
use crate::judge::{Units, Verdict, judge};
use crate::line::Line;
use crate::tally::{Found, Tally};
use indicatif::ProgressBar;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// Pairs that a thread takes at once.
const BLOCK: u64 = 64 * POSES_A_PAIR;

/// Which pairs.
pub struct Range {
    pub seed: u64,
    pub first: u64,
    pub count: u64,
    pub family: Option<usize>,
}

pub fn run(range: &Range, threads: usize, stop: &AtomicBool, progress: &ProgressBar) -> Tally {
    let total = Mutex::new(Tally::default());
    let next = AtomicU64::new(range.first);
    let end = range.first + range.count;
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                let mut tally = Tally::default();
                loop {
                    let begin = next.fetch_add(BLOCK, Ordering::Relaxed);
                    if begin >= end || stop.load(Ordering::Relaxed) {
                        break;
                    }
                    block(range, begin, (begin + BLOCK).min(end), &mut tally);
                    progress.inc((begin + BLOCK).min(end) - begin);
                }
                total.lock().expect("no thread panics while it holds the sum").merge(tally);
            });
        }
    });
    total.into_inner().expect("no thread panics while it holds the sum")
}

fn block(range: &Range, begin: u64, end: u64, tally: &mut Tally) {
    let mut index = begin;
    while index < end {
        let group_end = ((index / POSES_A_PAIR + 1) * POSES_A_PAIR).min(end);
        let family = (index / POSES_A_PAIR) as usize % FAMILIES.len();
        if range.family.is_none_or(|wanted| wanted == family) {
            let shapes = Shapes::of(range.seed, index);
            let units = Units::of(&shapes.a, &shapes.b, &mut stream(range.seed, 3, shapes.group));
            for index in index..group_end {
                let verdict = one(&shapes, &units, range.seed, index);
                tally.add(index, family, &verdict);
                for (failure, detail) in verdict.failures {
                    let case = Case::of(&shapes, range.seed, index);
                    let line = Line::of(&case, format!("seed {} index {index}: {failure:?}: {detail}", range.seed));
                    tally.find(Found { failure, index, family: case.family(), detail, line: Some(line) });
                }
            }
        }
        index = group_end;
    }
}

/// The verdict on one pair.
pub fn one(shapes: &Shapes, units: &Units, seed: u64, index: u64) -> Verdict {
    let case = Case::of(shapes, seed, index);
    judge(&case, units, &mut stream(seed, 4, index))
}
