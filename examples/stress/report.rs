//! What was found: a table for the terminal, summary.json, and the pairs themselves.

use crate::cases::{Case, FAMILIES, Shapes};
use crate::clock::{CALLS, Call};
use crate::judge::{Failure, PATHS};
use crate::line::Line;
use crate::machine::Machine;
use crate::sweeps::Sweep;
use crate::tally::{Distribution, OfFamily, Tally};
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
    pub interrupted: bool,
    pub seconds: f64,
    /// Seconds of one evaluation of S, ∇S and ∇²S of both particles, 5 + 5 planes.
    pub evaluation: f64,
    pub tally: Tally,
    pub walks: u64,
    pub sweeps: Vec<Sweep>,
    pub machine: Machine,
}

#[derive(Serialize)]
struct Summary<'a> {
    poses: u64,
    wanted: u64,
    seed: u64,
    first: u64,
    interrupted: bool,
    walks: u64,
    walk_steps: u64,
    failures: u64,
    failures_by_kind: &'a BTreeMap<Failure, u64>,
    /// Answers of midway and closest checked against 32 digits, and those that these could not settle.
    settled: u64,
    unsettled: u64,
    rounding_limited: f64,
    other_digits_in_other_units: u64,
    cone_program: Cone,
    evaluation_ns: f64,
    /// Longest call solved to the end over the median one.
    slowest_over_median: f64,
    calls: Vec<Calls<'a>>,
    families: Vec<FamilySummary<'a>>,
    sweeps: &'a [Sweep],
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
    /// In evaluations.
    median: f64,
    p99: f64,
    p99_99: f64,
    slowest: f64,
    slowest_index: u64,
    slowest_family: &'a str,
    paths: BTreeMap<&'a str, u64>,
    histogram: Vec<(f64, u64)>,
}

#[derive(Serialize)]
struct FamilySummary<'a> {
    family: &'a str,
    poses: u64,
    failed: u64,
    unsettled: u64,
    fell_back: u64,
    gap: Spread,
    error: Spread,
    point_bound: Spread,
    point_error: Spread,
    normal_error: Spread,
    gap_over_rounding: Spread,
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
        Self::scaled(distribution, 1.0)
    }

    fn scaled(distribution: &Distribution, unit: f64) -> Self {
        let finite = |v: f64| v.is_finite().then_some(v / unit);
        Self { median: finite(distribution.quantile(0.5)), worst: finite(distribution.most), index: distribution.worst }
    }
}

fn histogram(distribution: &Distribution, unit: f64) -> Vec<(f64, u64)> {
    distribution.filled().map(|(edge, count)| (edge / unit, count)).collect()
}

impl Findings {
    /// Writes summary.json, failures.jsonl and slowest.jsonl.
    pub fn write(&self, folder: &Path) -> io::Result<()> {
        fs::create_dir_all(folder)?;
        let text = serde_json::to_string_pretty(&self.summary()).map_err(io::Error::other)?;
        fs::write(folder.join("summary.json"), text + "\n")?;
        let mut failures = fs::File::create(folder.join("failures.jsonl"))?;
        for line in self.tally.found.iter().filter_map(|found| found.line.as_ref()) {
            writeln!(failures, "{}", serde_json::to_string(line).map_err(io::Error::other)?)?;
        }
        let mut slowest = fs::File::create(folder.join("slowest.jsonl"))?;
        for (call, name) in CALLS {
            let time = self.tally.time(call);
            if time.count > 0 {
                let shapes = Shapes::of(self.seed, time.worst);
                let case = Case::of(&shapes, self.seed, time.worst);
                let units = time.most / self.evaluation;
                let what = format!("seed {} index {}: {name}: {units:.0} evaluations", self.seed, time.worst);
                writeln!(slowest, "{}", serde_json::to_string(&Line::of(&case, what)).map_err(io::Error::other)?)?;
            }
        }
        Ok(())
    }

    fn slowest_over_median(&self) -> f64 {
        let time = self.tally.time(Call::Full);
        time.most / time.quantile(0.5)
    }

    fn summary(&self) -> Summary<'_> {
        let t = &self.tally;
        let calls = CALLS.iter().zip(&t.times).zip(&t.paths).map(|(((_, call), time), paths)| {
            let units = |seconds: f64| seconds / self.evaluation;
            Calls {
                call,
                count: time.count,
                median: units(time.quantile(0.5)),
                p99: units(time.quantile(0.99)),
                p99_99: units(time.quantile(0.9999)),
                slowest: units(time.most),
                slowest_index: time.worst,
                slowest_family: FAMILIES[family_of(time.worst)].name,
                paths: PATHS.iter().copied().zip(paths.iter().copied()).filter(|(_, count)| *count > 0).collect(),
                histogram: histogram(time, self.evaluation),
            }
        });
        let family = |(name, of): (&'static str, &OfFamily)| FamilySummary {
            family: name,
            poses: of.pairs,
            failed: of.failures,
            unsettled: of.unjudged,
            fell_back: of.fell_back,
            gap: Spread::of(&of.gap),
            error: Spread::of(&of.error),
            point_bound: Spread::of(&of.point_bound),
            point_error: Spread::of(&of.point_error),
            normal_error: Spread::of(&of.normal_error),
            gap_over_rounding: Spread::of(&of.looseness),
            time: Spread::scaled(&of.time, self.evaluation),
            error_histogram: histogram(&of.error, 1.0),
            time_histogram: histogram(&of.time, self.evaluation),
        };
        Summary {
            poses: t.pairs,
            wanted: self.wanted,
            seed: self.seed,
            first: self.first,
            interrupted: self.interrupted,
            walks: self.walks,
            walk_steps: t.walk_steps,
            failures: t.failures(),
            failures_by_kind: &t.failures,
            settled: t.judged,
            unsettled: t.unjudged,
            rounding_limited: t.rounding_limited as f64 / t.pairs.max(1) as f64,
            other_digits_in_other_units: t.unit_digits,
            cone_program: Cone { answered: t.conic[0], gave_up: t.conic[1] },
            evaluation_ns: 1e9 * self.evaluation,
            slowest_over_median: self.slowest_over_median(),
            calls: calls.collect(),
            families: FAMILIES.iter().map(|f| f.name).zip(&t.families).map(family).collect(),
            sweeps: &self.sweeps,
            seconds: self.seconds,
            machine: &self.machine,
        }
    }

    /// The tables of docs/reliability.md.
    pub fn print(&self) {
        let t = &self.tally;
        println!(
            "\n| family | poses | failed | gap, median | worst | error of s, median | worst | point, median | worst | time, median | p99.99 | slowest |"
        );
        println!("|---|---|---|---|---|---|---|---|---|---|---|---|");
        for (family, of) in FAMILIES.iter().zip(&t.families).filter(|(_, of)| of.pairs > 0) {
            let unit = |seconds: f64| format!("{:.0}", seconds / self.evaluation);
            println!(
                "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |",
                family.name,
                of.pairs,
                of.failures,
                number(of.gap.quantile(0.5)),
                number(of.gap.most),
                number(of.error.quantile(0.5)),
                number(of.error.most),
                number(of.point_error.quantile(0.5)),
                number(of.point_error.most),
                unit(of.time.quantile(0.5)),
                unit(of.time.quantile(0.9999)),
                unit(of.time.most),
            );
        }
        println!("\n| call | count | median | p99 | p99.99 | slowest | its pair | paths |");
        println!("|---|---|---|---|---|---|---|---|");
        for (((_, name), time), paths) in CALLS.iter().zip(&t.times).zip(&t.paths) {
            let unit = |share: f64| time.quantile(share) / self.evaluation;
            let share = |count: &u64| 100.0 * *count as f64 / time.count.max(1) as f64;
            let paths: Vec<String> = PATHS
                .iter()
                .zip(paths)
                .filter(|(_, count)| **count > 0)
                .map(|(path, count)| format!("{path} {:.3} %", share(count)))
                .collect();
            println!(
                "| {name} | {} | {:.0} | {:.0} | {:.0} | {:.0} | {} | {} |",
                time.count,
                unit(0.5),
                unit(0.99),
                unit(0.9999),
                time.most / self.evaluation,
                time.worst,
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
            "\nOne evaluation: {:.1} ns. Slowest over median, solved to the end: {:.0}. Against 32 digits: {} answers \
             settled, {} not. Cone program: {} agreed or were judged, {} gave up. Walks: {} steps.",
            1e9 * self.evaluation,
            self.slowest_over_median(),
            t.judged,
            t.unjudged,
            t.conic[0],
            t.conic[1],
            t.walk_steps
        );
        for found in t.found.iter().take(MOST_PRINTED) {
            let detail: String = found.detail.chars().take(180).collect();
            println!("{:?}, {}, index {}: {detail}", found.failure, found.family, found.index);
        }
        println!(
            "\n{} poses in {:.0} s, seed {}: {} failures {:?}",
            t.pairs,
            self.seconds,
            self.seed,
            t.failures(),
            t.failures
        );
    }
}

const MOST_PRINTED: usize = 30;

fn family_of(index: u64) -> usize {
    (index / crate::cases::POSES_A_PAIR) as usize % FAMILIES.len()
}

fn number(value: f64) -> String {
    if value.is_finite() { format!("{value:.1e}") } else { "-".into() }
}
