//! A target of a benchmark beside what was measured; the time of the processor.

use serde::Serialize;
use serde_json::{Value, json};
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::Path;

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

/// Seconds for which this thread has had a processor, by Linux; where that does not tell, of the clock.
pub fn own_time() -> f64 {
    // Linux counts up to here when a thread gives way.
    std::thread::yield_now();
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = told.and_then(|told| told.split(' ').next()?.parse::<f64>().ok());
    let clock = || std::time::SystemTime::UNIX_EPOCH.elapsed().map_or(0.0, |since| since.as_secs_f64());
    nanoseconds.map_or_else(clock, |nanoseconds| 1e-9 * nanoseconds)
}

/// Writes results beside, and moves them over only when they are whole and on the disk, as `files.write_summary` of the
/// Python packages does.
pub fn write_summary(path: impl AsRef<Path>, summary: &impl Serialize) -> io::Result<()> {
    let path = path.as_ref();
    fs::create_dir_all(path.parent().unwrap_or(Path::new(".")))?;
    let mut part = path.as_os_str().to_owned();
    part.push(".part");
    let mut file = File::create(&part)?;
    file.write_all((serde_json::to_string_pretty(summary)? + "\n").as_bytes())?;
    file.sync_all()?;
    fs::rename(part, path)
}
