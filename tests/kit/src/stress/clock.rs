//! What a call costs.

use crate::random::Random;
use crate::scene::evaluation::Plain;
use nalgebra::Vector3;
use potential_particles::Plane;
use serde::Serialize;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

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
pub struct Clock {
    /// Seconds of one evaluation of S, ∇S and ∇²S of both particles of the pair.
    unit: f64,
    /// Seconds.
    pub costs: Vec<(Call, f64)>,
}

/// Evaluations beyond which a call is repeated, so that an interruption by another process does not pass for a slow
/// pair: one call in a hundred takes that long.
const SUSPICIOUS: f64 = 400.0;
const REPEATS: usize = 4;
/// What may become the slowest of all is repeated so often that an interruption each time is out of the question.
const EXTREME: f64 = 1500.0;
const REPEATS_OF_EXTREMES: usize = 20;

impl Clock {
    pub fn new(unit: f64) -> Self {
        Self { unit, costs: Vec::new() }
    }

    pub fn time<T>(&mut self, call: Call, work: impl Fn() -> T) -> T {
        let begin = Instant::now();
        let result = work();
        let mut seconds = begin.elapsed().as_secs_f64();
        for (limit, repeats) in [(SUSPICIOUS, REPEATS), (EXTREME, REPEATS_OF_EXTREMES)] {
            for _ in 0..repeats {
                if seconds <= limit * self.unit {
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

/// Numbers of planes of which the cost is measured.
const PLANES: [u32; 8] = [0, 4, 8, 16, 32, 64, 128, 256];

/// Passes over them, and seconds between two: some will be undisturbed by other processes.
const PASSES: u32 = 12;
const PAUSE: f64 = 0.015;

/// What an evaluation of one body costs by its number of planes, measured once in each run: (planes, seconds).
static COSTS: LazyLock<Vec<(f64, f64)>> = LazyLock::new(|| {
    let mut costs = PLANES.map(|planes| (f64::from(planes), f64::INFINITY)).to_vec();
    for _ in 0..PASSES {
        for ((_, least), planes) in costs.iter_mut().zip(PLANES) {
            *least = least.min(measured(planes));
        }
        std::thread::sleep(Duration::from_secs_f64(PAUSE));
    }
    costs
});

/// Seconds of one evaluation of S, ∇S and ∇²S of both bodies at a point: the unit of cost. Between the measured numbers
/// of planes, and beyond the last, along straight lines.
pub fn evaluation(planes: [usize; 2]) -> f64 {
    planes.iter().map(|&planes| of_one(planes as f64)).sum()
}

fn of_one(planes: f64) -> f64 {
    let after = COSTS.iter().position(|(known, _)| *known >= planes).unwrap_or(COSTS.len() - 1).max(1);
    let ((from, low), (to, high)) = (COSTS[after - 1], COSTS[after]);
    low + (high - low) * (planes - from) / (to - from)
}

/// Seconds of one evaluation near the surface of a body of this many planes.
fn measured(planes: u32) -> f64 {
    let mut random = Random::seeded(u64::from(planes) + 1);
    let plane = |_| Plane { normal: random.direction(), offset: 0.95 };
    let body = Plain::of((0..planes).map(plane).collect(), 0.05, 0.1, 1.0);
    let points: Vec<Vector3<f64>> = (0..8).map(|_| 0.99 * random.direction()).collect();
    let evaluations = 64_000 / (planes + 16);
    let round = || {
        let begin = Instant::now();
        for point in &points {
            for _ in 0..evaluations {
                std::hint::black_box(&body.at(std::hint::black_box(point)));
            }
        }
        begin.elapsed().as_secs_f64() / f64::from(evaluations) / points.len() as f64
    };
    // Each a tenth of a millisecond long.
    (0..3).map(|_| round()).fold(f64::INFINITY, f64::min)
}
