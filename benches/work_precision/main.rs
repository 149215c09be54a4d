//! Run time against error: the cost of each kind of call, and every tolerance on the pairs known to 40 digits.
//!
//! `cargo bench --bench work_precision` writes `work_precision.csv` and `summary.json` to out/bench, and prints every
//! stated target beside what was measured; `-- quick` takes a part of the pairs and rounds. The picture is drawn from
//! these files by `benches/plot.py`.

mod clock;
mod speed;
mod sweep;

use kit::machine::Machine;
use kit::target;
use serde_json::json;
use std::io;
use std::path::Path;

/// How much to measure.
pub struct Effort {
    /// Pyramid pairs of each rounding.
    pub pyramids: usize,
    /// Pairs of each plane count.
    pub polyhedra: usize,
    /// Rounds over all contestants; the median of the rounds counts.
    pub rounds: usize,
    /// Every how many-th pair known to 40 digits is used.
    pub stride: usize,
}

fn main() -> io::Result<()> {
    let quick = std::env::args().any(|argument| argument == "quick");
    let effort = if quick {
        Effort { pyramids: 50, polyhedra: 10, rounds: 3, stride: 7 }
    } else {
        Effort { pyramids: 500, polyhedra: 100, rounds: 9, stride: 1 }
    };
    let machine = Machine::here();
    println!("{}, {} cores, {}, {}", machine.processor, machine.cores, machine.system, machine.date);
    let groups = speed::measure(&effort);
    let mut targets = speed::targets(&groups);
    let records = sweep::run(&effort);
    targets.extend(sweep::targets(&records));
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/out/bench"));
    let summary = json!({"machine": machine, "targets": targets, "groups": groups});
    target::write_summary(folder.join("summary.json"), &summary)?;
    sweep::write(&folder.join("work_precision.csv"), &records)
}
