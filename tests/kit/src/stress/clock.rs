//! What a call costs.

use serde::Serialize;
use std::time::Instant;

/// Kinds of calls.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Call {
    /// Default settings, cold: may be rejected.
    Quick,
    /// Midway, cold, solved to the end.
    Full,
    /// The same from the memory of a step away.
    Warm,
    /// Default settings, from memory.
    QuickWarm,
    /// Closest, cold, solved to the end.
    Closest,
}

pub const CALLS: [(Call, &str); 5] = [
    (Call::Quick, "midway, default settings, cold"),
    (Call::Full, "midway, solved to the end, cold"),
    (Call::Warm, "midway, solved to the end, warm"),
    (Call::QuickWarm, "midway, default settings, warm"),
    (Call::Closest, "closest, solved to the end, cold"),
];

/// The calls of one pair.
#[derive(Default)]
pub struct Clock {
    /// Seconds.
    pub costs: Vec<(Call, f64)>,
}

/// Seconds beyond which a call is repeated, and how often, so that an interruption by another process does not pass for
/// a slow pair: one call in a hundred takes the first; of what may become the slowest of all, an interruption each time
/// is out of the question.
const REPEATS: [(f64, usize); 2] = [(4e-5, 4), (1.5e-4, 20)];

impl Clock {
    pub fn time<T>(&mut self, call: Call, work: impl Fn() -> T) -> T {
        let begin = Instant::now();
        let result = work();
        let mut seconds = begin.elapsed().as_secs_f64();
        for (limit, repeats) in REPEATS {
            for _ in 0..repeats {
                if seconds <= limit {
                    break;
                }
                let begin = Instant::now();
                std::hint::black_box(work());
                seconds = seconds.min(begin.elapsed().as_secs_f64());
            }
        }
        self.costs.push((call, seconds));
        result
    }
}
