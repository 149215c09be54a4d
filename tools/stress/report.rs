//! What was found: a table for the terminal, summary.json, and the pairs themselves.

use kit::machine::Machine;
use kit::stress::cases::{Case, FAMILIES, Shapes, family_of};
use kit::stress::clock::CALLS;
use kit::stress::judge::{Doubt, PATHS};
use kit::stress::ledger::{Fault, Ledger};
use kit::stress::sweeps::Sweep;
use kit::stress::tally::{Distribution, OfFamily, Tally};
use kit::target::write_summary;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fs;
use std::io::{self, Write};
use std::path::Path;

/// Everything that a run found.
pub struct Findings {
    pub seed: u64,
    pub first: u64,
    pub wanted: u64,
    pub settle_every: u64,
    pub interrupted: bool,
    pub seconds: f64,
    pub tally: Tally,
    pub sweeps: Vec<Sweep>,
    /// By name.
    pub parts: Vec<(&'static str, Ledger)>,
    pub machine: Machine,
}

/// One stated target.
#[derive(Serialize)]
struct Target {
    name: String,
    sense: &'static str,
    target: f64,
    measured: f64,
    met: bool,
}

impl Target {
    fn at_most(name: impl Into<String>, target: f64, measured: f64) -> Self {
        Self { name: name.into(), sense: "at most", target, measured, met: measured <= target }
    }
}

/// Share of the answers of a part that its reference may leave open.
const MOST_UNSETTLED: f64 = 0.05;

/// Times that each kind of call keeps to, ms: all but one call in 10,000, and every one.
const MOST_P99_99: f64 = 0.5;
const MOST_SLOWEST: f64 = 5.0;

#[derive(Serialize)]
struct Summary<'a> {
    targets: Vec<Target>,
    poses: u64,
    wanted: u64,
    seed: u64,
    first: u64,
    interrupted: bool,
    failures: u64,
    failures_by_kind: BTreeMap<Fault, u64>,
    settle_every: u64,
    /// Pairs put to the second solver, and why those whose turn it was not.
    put_to_second_solver: u64,
    doubts: &'a BTreeMap<Doubt, u64>,
    /// Answers of midway and closest checked against 32 digits, and those that these could not settle.
    settled: u64,
    unsettled: u64,
    rounding_limited: f64,
    other_digits_in_other_units: u64,
    cone_program: Cone,
    calls: Vec<Calls<'a>>,
    families: Vec<FamilySummary<'a>>,
    sweeps: &'a [Sweep],
    parts: Vec<PartSummary<'a>>,
    seconds: f64,
    machine: &'a Machine,
}

#[derive(Serialize)]
struct Cone {
    answered: u64,
    gave_up: u64,
}

#[derive(Serialize)]
struct Calls<'a> {
    call: &'a str,
    count: u64,
    microseconds: Microseconds,
    slowest_family: &'a str,
    paths: BTreeMap<&'a str, u64>,
    histogram: Vec<(f64, u64)>,
}

#[derive(Serialize)]
struct Microseconds {
    median: f64,
    p99: f64,
    p99_99: f64,
    slowest: f64,
    slowest_index: u64,
}

impl Microseconds {
    fn of(seconds: &Distribution) -> Self {
        let [median, p99, p99_99] = [0.5, 0.99, 0.9999].map(|share| 1e6 * seconds.quantile(share));
        Self { median, p99, p99_99, slowest: 1e6 * seconds.most, slowest_index: seconds.worst }
    }
}

#[derive(Serialize)]
struct FamilySummary<'a> {
    family: &'a str,
    poses: u64,
    failed: u64,
    unsettled: u64,
    extended: u64,
    gap: Spread,
    error: Spread,
    point_error: Spread,
    time: Spread,
    error_histogram: Vec<(f64, u64)>,
    time_histogram: Vec<(f64, u64)>,
}

/// Median, largest, and the pair of the largest.
#[derive(Serialize)]
struct Spread {
    median: Option<f64>,
    worst: Option<f64>,
    index: u64,
}

impl Spread {
    fn of(distribution: &Distribution) -> Self {
        let finite = |v: f64| v.is_finite().then_some(v);
        Self { median: finite(distribution.quantile(0.5)), worst: finite(distribution.most), index: distribution.worst }
    }
}

/// A part beside the pairs.
#[derive(Serialize)]
struct PartSummary<'a> {
    part: &'a str,
    cases: u64,
    judged: u64,
    unsettled: u64,
    failures: u64,
    faults: BTreeMap<Fault, u64>,
    faults_by_family: Vec<(Fault, &'a str, u64)>,
    families: &'a BTreeMap<String, u64>,
}

impl<'a> PartSummary<'a> {
    fn of(part: &'a str, ledger: &'a Ledger) -> Self {
        Self {
            part,
            cases: ledger.cases,
            judged: ledger.judged,
            unsettled: ledger.unsettled,
            failures: ledger.failures(),
            faults: ledger.by_fault(),
            faults_by_family: ledger.faults.iter().map(|((fault, family), n)| (*fault, family.as_str(), *n)).collect(),
            families: &ledger.families,
        }
    }
}

impl Findings {
    /// Of all parts.
    pub fn failures(&self) -> u64 {
        self.tally.ledger.failures() + self.parts.iter().map(|(_, ledger)| ledger.failures()).sum::<u64>()
    }

    /// Writes summary.json, failures.jsonl, faults.jsonl and slowest.jsonl.
    pub fn write(&self, folder: &Path) -> io::Result<()> {
        write_summary(folder.join("summary.json"), &self.summary())?;
        let mut failures = fs::File::create(folder.join("failures.jsonl"))?;
        for finding in &self.tally.ledger.found {
            writeln!(failures, "{}", finding.case)?;
        }
        let mut faults = fs::File::create(folder.join("faults.jsonl"))?;
        for (part, ledger) in &self.parts {
            for finding in &ledger.found {
                let line = serde_json::json!({ "part": part, "finding": finding });
                writeln!(faults, "{line}")?;
            }
        }
        let mut slowest = fs::File::create(folder.join("slowest.jsonl"))?;
        for ((_, name), time) in CALLS.iter().zip(&self.tally.seconds).filter(|(_, time)| time.count > 0) {
            let shapes = Shapes::of(self.seed, time.worst);
            let what = format!("seed {} index {}: {name}: {:.1} µs", self.seed, time.worst, 1e6 * time.most);
            let line = Case::of(&shapes, self.seed, time.worst).line(what);
            writeln!(slowest, "{}", serde_json::to_string(&line).map_err(io::Error::other)?)?;
        }
        Ok(())
    }

    fn summary(&self) -> Summary<'_> {
        let t = &self.tally;
        let calls = CALLS.iter().zip(&t.seconds).zip(&t.paths);
        let calls = calls.map(|(((_, call), time), paths)| Calls {
            call,
            count: time.count,
            microseconds: Microseconds::of(time),
            slowest_family: FAMILIES[family_of(time.worst)].name,
            paths: PATHS.iter().copied().zip(paths.iter().copied()).filter(|(_, count)| *count > 0).collect(),
            histogram: time.filled().collect(),
        });
        let family = |(name, of): (&'static str, &OfFamily)| FamilySummary {
            family: name,
            poses: of.pairs,
            failed: of.failures,
            unsettled: of.unjudged,
            extended: of.extended,
            gap: Spread::of(&of.gap),
            error: Spread::of(&of.error),
            point_error: Spread::of(&of.point_error),
            time: Spread::of(&of.time),
            error_histogram: of.error.filled().collect(),
            time_histogram: of.time.filled().collect(),
        };
        Summary {
            targets: self.targets(),
            poses: t.ledger.cases,
            wanted: self.wanted,
            seed: self.seed,
            first: self.first,
            interrupted: self.interrupted,
            failures: self.failures(),
            failures_by_kind: t.ledger.by_fault(),
            settle_every: self.settle_every,
            put_to_second_solver: t.settled,
            doubts: &t.doubts,
            settled: t.ledger.judged - t.ledger.unsettled,
            unsettled: t.ledger.unsettled,
            rounding_limited: t.rounding_limited as f64 / t.ledger.cases.max(1) as f64,
            other_digits_in_other_units: t.unit_digits,
            cone_program: Cone { answered: t.cone_program[0], gave_up: t.cone_program[1] },
            calls: calls.collect(),
            families: FAMILIES.iter().map(|f| f.name).zip(&t.families).map(family).collect(),
            sweeps: &self.sweeps,
            parts: self.parts.iter().map(|(part, ledger)| PartSummary::of(part, ledger)).collect(),
            seconds: self.seconds,
            machine: &self.machine,
        }
    }

    /// No failures, and the tail of the times of each kind of call that was made.
    fn targets(&self) -> Vec<Target> {
        let mut targets = vec![Target::at_most("failures", 0.0, self.tally.ledger.failures() as f64)];
        for ((_, call), seconds) in CALLS.iter().zip(&self.tally.seconds).filter(|(_, seconds)| seconds.count > 0) {
            let of = Microseconds::of(seconds);
            targets.push(Target::at_most(format!("{call}: p99.99, ms"), MOST_P99_99, 1e-3 * of.p99_99));
            targets.push(Target::at_most(format!("{call}: slowest, ms"), MOST_SLOWEST, 1e-3 * of.slowest));
        }
        for (part, ledger) in &self.parts {
            targets.push(Target::at_most(format!("{part}: failures"), 0.0, ledger.failures() as f64));
            targets.push(Target::at_most(format!("{part}: unsettled"), MOST_UNSETTLED, ledger.share_unsettled()));
        }
        targets
    }

    /// Tables by family, call and motion, and the targets.
    pub fn print(&self) {
        let t = &self.tally;
        println!(
            "\n| family | poses | failed | gap, median | worst | error of s, median | worst | point, median | worst | time, µs, median | p99.99 | slowest |"
        );
        println!("|---|---|---|---|---|---|---|---|---|---|---|---|");
        for (family, of) in FAMILIES.iter().zip(&t.families).filter(|(_, of)| of.pairs > 0) {
            println!(
                "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {:.1} | {:.1} | {:.1} |",
                family.name,
                of.pairs,
                of.failures,
                number(of.gap.quantile(0.5)),
                number(of.gap.most),
                number(of.error.quantile(0.5)),
                number(of.error.most),
                number(of.point_error.quantile(0.5)),
                number(of.point_error.most),
                1e6 * of.time.quantile(0.5),
                1e6 * of.time.quantile(0.9999),
                1e6 * of.time.most,
            );
        }
        println!("\n| call | count | µs: median | p99 | p99.99 | slowest | its pair | paths |");
        println!("|---|---|---|---|---|---|---|---|");
        for (((_, name), time), paths) in CALLS.iter().zip(&t.seconds).zip(&t.paths) {
            let share = |count: &u64| 100.0 * *count as f64 / time.count.max(1) as f64;
            let paths: Vec<String> = PATHS
                .iter()
                .zip(paths)
                .filter(|(_, count)| **count > 0)
                .map(|(path, count)| format!("{path} {:.3} %", share(count)))
                .collect();
            let absolute = Microseconds::of(time);
            println!(
                "| {name} | {} | {:.1} | {:.1} | {:.1} | {:.1} | {} | {} |",
                time.count,
                absolute.median,
                absolute.p99,
                absolute.p99_99,
                absolute.slowest,
                absolute.slowest_index,
                paths.join(", ")
            );
        }
        if !self.sweeps.is_empty() {
            println!(
                "\n| motion | r | k | rate of the point | of the normal | of the overlap | point, left | normal, left | overlap, left | jumps |"
            );
            println!("|---|---|---|---|---|---|---|---|---|---|");
            for s in &self.sweeps {
                let [a, b, c] = s.rates.map(number);
                let [d, e, f] = s.left.map(number);
                println!("| {} | {:e} | {:e} | {a} | {b} | {c} | {d} | {e} | {f} | {} |", s.motion, s.r, s.k, s.jumps);
            }
        }
        println!(
            "\nPut to the second solver: {} of {} pairs, doubtful {:?}. Against 32 digits: {} answers settled, {} not. Cone \
             program: {} agreed or were judged, {} gave up.",
            t.settled,
            t.ledger.cases,
            t.doubts,
            t.ledger.judged - t.ledger.unsettled,
            t.ledger.unsettled,
            t.cone_program[0],
            t.cone_program[1]
        );
        t.ledger.print("poses");
        for (part, ledger) in &self.parts {
            ledger.print(part);
        }
        println!("\n| target | at most | measured | met |\n|---|---|---|---|");
        for Target { name, target, measured, met, .. } in self.targets() {
            println!("| {name} | {target} | {measured:.3} | {} |", if met { "met" } else { "MISSED" });
        }
        println!(
            "\n{} poses in {:.0} s, seed {}: {} failures {:?}",
            t.ledger.cases,
            self.seconds,
            self.seed,
            self.failures(),
            t.ledger.by_fault()
        );
    }
}

fn number(value: f64) -> String {
    if value.is_finite() { format!("{value:.1e}") } else { "-".into() }
}
