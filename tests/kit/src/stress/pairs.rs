//! The first part: many pairs, each judged on its own, by several threads.

use crate::stress::cases::{Case, FAMILIES, Shapes, family_of, next_group, stream};
use crate::stress::judge::{Shared, Trial, Verdict, judge};
use crate::stress::ledger::{Finding, parallel};
use crate::stress::tally::Tally;
use indicatif::ProgressBar;
use potential_particles::detect;
use std::sync::atomic::AtomicBool;

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
    let pairs = range.first..range.first + range.count;
    let of = |block: std::ops::Range<u64>, tally: &mut Tally| self::block(range, block, tally);
    parallel((pairs, BLOCK), threads, stop, progress, Tally::merge, of)
}

fn block(range: &Range, block: std::ops::Range<u64>, tally: &mut Tally) {
    let (mut index, seed) = (block.start, range.seed);
    while index < block.end {
        let group_end = next_group(index).min(block.end);
        let family = family_of(index);
        if range.family.is_none_or(|wanted| wanted == family) {
            let shapes = Shapes::of(seed, index);
            let shared = Shared::of(&shapes.a, &shapes.b, &mut stream(seed, 3, shapes.group));
            for index in index..group_end {
                let verdict = one(&shapes, &shared, seed, index, range.trial(index));
                tally.add(index, family, &verdict);
                for (fault, detail) in verdict.faults {
                    let line =
                        Case::of(&shapes, seed, index).line(format!("seed {seed} index {index}: {fault:?}: {detail}"));
                    let (family, planes) = (FAMILIES[family].name.into(), line.planes());
                    let case = serde_json::to_value(line).unwrap_or_default();
                    tally.ledger.find(Finding { fault, family, seed, index, detail, case, planes });
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
