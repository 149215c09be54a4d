//! A target of a benchmark beside what was measured.
#![allow(dead_code)]

mod summary;

pub use summary::write_summary;

use serde_json::{Value, json};

/// Prints a target that is a limit from above, and returns its entry for summary.json.
pub fn at_most(name: &str, target: f64, measured: f64) -> Value {
    judged(name, "at most", target, measured, measured <= target)
}

/// The same of a limit from below.
pub fn at_least(name: &str, target: f64, measured: f64) -> Value {
    judged(name, "at least", target, measured, measured >= target)
}

fn judged(name: &str, sense: &str, target: f64, measured: f64, met: bool) -> Value {
    println!("{} {name}: {measured:.3e} ({sense} {target:e})", if met { "met   " } else { "MISSED" });
    json!({"name": name, "sense": sense, "target": target, "measured": measured, "met": met})
}
