//! The first part: many pairs, each judged on its own, by several threads.

use crate::stress::cases::{Case, Shapes, family_of, next_group, stream};
use crate::stress::judge::{Shared, Trial, Verdict, judge};
use crate::stress::line::Line;
use crate::stress::tally::{Found, Tally};
use indicatif::ProgressBar;
use potential_particles::detect;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// Pairs that a thread takes at once.
const BLOCK: u64 = 512;

/// Which pairs.
pub struct Range {
    pub seed: u64,
    pub first: u64,
    pub count: u64,
    pub family: Option<usize>,
    /// One pair in this many is put to the second solver whatever its answer looks like.
    pub settle_every: u64,
}

/// One pair in this many visits the cone program, or one in this many of those that are settled in any case.
const CONE_PROGRAM_EVERY: f64 = 500.0;
const CONE_PROGRAM_EVERY_SETTLED: f64 = 25.0;

impl Range {
    /// Drawn anew for each pair: a fixed step would meet some families only.
    fn trial(&self, index: u64) -> Trial {
        let mut random = stream(self.seed, 6, index);
        let every = self.settle_every as f64;
        Trial {
            settle: random.uniform() * every < 1.0,
            cone_program: random.uniform() * CONE_PROGRAM_EVERY.max(CONE_PROGRAM_EVERY_SETTLED * every) < 1.0,
        }
    }
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
        let group_end = next_group(index).min(end);
        let family = family_of(index);
        if range.family.is_none_or(|wanted| wanted == family) {
            let shapes = Shapes::of(range.seed, index);
            let shared = Shared::of(&shapes.a, &shapes.b, &mut stream(range.seed, 3, shapes.group));
            for index in index..group_end {
                let verdict = one(&shapes, &shared, range.seed, index, range.trial(index));
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
pub fn one(shapes: &Shapes, shared: &Shared, seed: u64, index: u64, trial: Trial) -> Verdict {
    let case = Case::of(shapes, seed, index);
    judge(&case, shared, trial, detect, &mut stream(seed, 4, index))
}
