//! Run time against error, of this library and of everything else a user could pick.
//!
//! `cargo bench --bench work_precision` writes `work_precision.csv`, `work_precision_pairs.csv` and
//! `summary.json` to out/bench, and prints every stated target beside what was measured. The picture is
//! drawn from these files by `benches/plot.py`.

#[path = "../baselines/mod.rs"]
mod baselines;
#[path = "../scene/mod.rs"]
mod scene;
#[path = "../target/summary.rs"]
mod summary;
#[path = "../../tests/support/mod.rs"]
mod support;

mod arguments;
mod built_in;
mod cases;
mod clock;
mod falls;
mod machine;
mod report;
mod solvers;
mod speed;
mod sweep;

use arguments::Arguments;
use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};
use report::Report;
use std::io;
use std::path::Path;

fn main() -> io::Result<()> {
    let arguments = Arguments::parse();
    std::fs::create_dir_all(&arguments.out)?;
    // Drawn on stderr, and only where that is a terminal.
    let progress = ProgressBar::new(0).with_style(
        ProgressStyle::with_template("{msg:32} {bar:40} {percent:>3} % {elapsed} ").expect("a valid template"),
    );
    let effort = arguments.effort();
    let mut built_in = built_in::BuiltIn::new(&arguments.yade);

    let speed = speed::measure(&effort, &mut built_in, &progress);
    let cases = cases::all(&effort);
    let records = sweep::run(&cases, &effort, &mut built_in, &progress);
    let falls = falls::count(&effort, &progress);
    progress.finish_and_clear();

    let table = sweep::table(&records);
    sweep::write_pairs(&arguments.out.join("work_precision_pairs.csv"), &records)?;
    sweep::write_table(&arguments.out.join("work_precision.csv"), &table)?;
    let report = Report::new(speed, &records, falls, machine::Machine::here(built_in.version()));
    report.write(&arguments.out.join("summary.json"))?;
    report.print();
    println!("written: {}", listing(&arguments.out));
    Ok(())
}

fn listing(folder: &Path) -> String {
    ["work_precision.csv", "work_precision_pairs.csv", "summary.json"]
        .map(|name| folder.join(name).display().to_string())
        .join(", ")
}
