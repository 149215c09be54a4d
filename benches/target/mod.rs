//! A target of a benchmark beside what was measured.

mod summary;

pub use summary::write_summary;

use serde_json::{Value, json};

/// Prints a target that is a limit from above, and returns its entry for summary.json.
pub fn at_most(name: &str, target: f64, measured: f64) -> Value {
    let met = measured <= target;
    println!("{} {name}: {measured:.3e} (at most {target:e})", if met { "met   " } else { "MISSED" });
    json!({"name": name, "sense": "at most", "target": target, "measured": measured, "met": met})
}
