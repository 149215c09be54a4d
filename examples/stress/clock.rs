//! What a call costs.

use crate::evaluation::Plain;
use nalgebra::Vector3;
use potential_particles::{Particle, Plane};
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

/// Seconds of the calls of one pair.
#[derive(Default)]
pub struct Cost {
    pub costs: Vec<(Call, f64)>,
}

/// Longer calls are repeated, so that an interruption by another process does not pass for a slow pair.
const SUSPICIOUS: f64 = 10e-6;
const REPEATS: usize = 4;

impl Cost {
    pub fn time<T>(&mut self, call: Call, work: impl Fn() -> T) -> T {
        let begin = Instant::now();
        let result = work();
        let mut seconds = begin.elapsed().as_secs_f64();
        if seconds > SUSPICIOUS {
            for _ in 0..REPEATS {
                let begin = Instant::now();
                std::hint::black_box(work());
                seconds = seconds.min(begin.elapsed().as_secs_f64());
            }
        }
        self.costs.push((call, seconds));
        result
    }
}

/// Seconds of one evaluation of S, ∇S and ∇²S of two pyramids (5 + 5 planes): the unit of cost.
pub fn evaluation() -> f64 {
    let length = 5f64.sqrt();
    let side = |x: f64, y: f64| Plane { normal: Vector3::new(2.0 * x, 2.0 * y, 1.0) / length, offset: 0.29 };
    let base = Plane { normal: -Vector3::z(), offset: 0.24 };
    let planes = [side(1.0, 0.0), side(-1.0, 0.0), side(0.0, 1.0), side(0.0, -1.0), base];
    let pyramid = Particle::new(&planes, 0.01, 0.05, 0.9).expect("a pyramid around the origin");
    let plain = Plain::new(&pyramid);
    // Next to a corner of the base: three planes count.
    let point = Vector3::new(0.3, 0.28, -0.26);
    let calls = 20_000;
    let round = || {
        let begin = Instant::now();
        for _ in 0..calls {
            std::hint::black_box(&plain.at(std::hint::black_box(&point)));
            std::hint::black_box(&plain.at(std::hint::black_box(&point)));
        }
        begin.elapsed().as_secs_f64() / f64::from(calls)
    };
    (0..9).map(|_| round()).fold(f64::INFINITY, f64::min)
}
