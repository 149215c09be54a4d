//! Searches for what breaks contact detection: random pairs over everything that can be written down, random walks,
//! and smooth motions, each answer judged by definition and against a second solution in 32 digits.
//!
//!     cargo run --release --example stress -- --poses 1000000
//!
//! Each run draws a seed of its own and prints it first; `--seed` repeats a run. Ctrl-C ends a run early and keeps its
//! results. docs/reliability.md says what is checked and what was found.

mod arguments;
mod replay;
mod report;

use arguments::{Arguments, Part};
use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};
use kit::machine;
use kit::stress::cases::{BULK, FAMILIES};
use kit::stress::ledger::{self, Ledger};
use kit::stress::{hulls, mass, memories, pairs, patches, seams, sweeps, walks, walls};
use report::Findings;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let seed = arguments.seed.unwrap_or_else(arguments::fresh_seed);
    if let Some(index) = arguments.replay {
        let passed = match arguments.of {
            Part::Poses => return replay::one(seed, index),
            Part::Walls => ledger::replay(|ledger| walls::one(seed, index, walls::solve, ledger)),
            Part::Seams => ledger::replay(|ledger| seams::one(seed, index, ledger)),
            Part::Memories => ledger::replay(|ledger| memories::one(seed, index, ledger)),
            Part::Mass => ledger::replay(|ledger| mass::one(seed, index, ledger)),
            Part::Patches => ledger::replay(|ledger| patches::one(seed, index, ledger)),
            Part::Hulls => ledger::replay(|ledger| hulls::one(seed, index, ledger)),
        };
        return if passed { ExitCode::SUCCESS } else { ExitCode::FAILURE };
    }
    println!("seed {seed}");
    match run(&arguments, seed) {
        Ok(0) => ExitCode::SUCCESS,
        Ok(_) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("stress: {error}");
            ExitCode::from(2)
        }
    }
}

/// The number of failures.
fn run(arguments: &Arguments, seed: u64) -> Result<u64, String> {
    let family = match &arguments.family {
        Some(name) => Some(FAMILIES.iter().position(|family| family.name == name).ok_or_else(|| {
            let names: Vec<_> = FAMILIES.iter().map(|family| family.name).collect();
            format!("there is no family '{name}'; there are: {}", names.join("; "))
        })?),
        None => None,
    };
    let stop = Arc::new(AtomicBool::new(false));
    let asked = Arc::clone(&stop);
    ctrlc::set_handler(move || {
        // A second one ends the program at once.
        if asked.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
        eprintln!("\nstopping; results are being written");
    })
    .map_err(|error| error.to_string())?;
    // A panic is a finding: it is counted, and needs no trace of its own.
    std::panic::set_hook(Box::new(|_| ()));
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let threads = if arguments.threads == 0 { cores } else { arguments.threads };
    let begin = Instant::now();
    let settle_every = arguments.settle_every;
    let first = arguments.first.unwrap_or(if settle_every > 1 { BULK } else { 0 });
    let range = pairs::Range { seed, first, count: arguments.poses, family, settle_every };
    let bar = progress("poses", arguments.poses);
    let tally = pairs::run(&range, threads, &stop, &bar);
    bar.finish_and_clear();
    let walls = |index, ledger: &mut Ledger| walls::one(seed, index, walls::solve, ledger);
    let seams = |index, ledger: &mut Ledger| seams::one(seed, index, ledger);
    let walks = |index, ledger: &mut Ledger| walks::one(seed, index, ledger);
    let mass = |index, ledger: &mut Ledger| mass::one(seed, index, ledger);
    let memories = |index, ledger: &mut Ledger| memories::one(seed, index, ledger);
    let patches = |index, ledger: &mut Ledger| patches::one(seed, index, ledger);
    let hulls = |index, ledger: &mut Ledger| hulls::one(seed, index, ledger);
    type One<'a> = &'a (dyn Fn(u64, &mut Ledger) + Sync);
    let each: [(&'static str, Option<u64>, u64, One); 7] = [
        ("walks", arguments.walks, 10_000, &walks),
        ("walls", arguments.walls, 10, &walls),
        ("seams", arguments.seams, 20, &seams),
        ("memories", arguments.memories, 20, &memories),
        ("patches", arguments.patches, 1000, &patches),
        ("hulls", arguments.hulls, 10, &hulls),
        ("mass", arguments.mass, 1000, &mass),
    ];
    let mut parts = Vec::new();
    for (name, count, share, one) in each {
        let count = count.unwrap_or(arguments.poses / share);
        let bar = progress(name, count);
        parts.push((name, ledger::run((seed, count), threads, &stop, &bar, one)));
        bar.finish_and_clear();
    }
    let mut sweeps = Vec::new();
    if !arguments.no_sweeps && !stop.load(Ordering::Relaxed) {
        let bar = progress("sweeps", sweeps::COUNT);
        let mut jumps = Ledger::default();
        sweeps = sweeps::all(&mut jumps, || bar.inc(1));
        parts.push(("sweeps", jumps));
        bar.finish_and_clear();
    }

    let findings = Findings {
        seed,
        first,
        settle_every,
        wanted: arguments.poses,
        interrupted: stop.load(Ordering::Relaxed),
        seconds: begin.elapsed().as_secs_f64(),
        tally,
        sweeps,
        parts,
        machine: machine::Machine::here(),
    };
    findings.write(&arguments.output).map_err(|error| format!("{}: {error}", arguments.output.display()))?;
    findings.print();
    Ok(findings.failures())
}

fn progress(what: &'static str, length: u64) -> ProgressBar {
    let template = format!("{{bar:40}} {{human_pos}} of {{human_len}} {what}  {{per_sec}}  {{eta}} left");
    ProgressBar::new(length).with_style(ProgressStyle::with_template(&template).expect("a valid template"))
}
