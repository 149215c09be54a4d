//! summary.json, and each target beside what was measured.

use crate::falls::{Counts, Falls};
use crate::machine::Machine;
use crate::scene::pyramids;
use crate::solvers::{self, BUILT_IN, BUILT_IN_AREA, FAST};
use crate::speed::{AREA, AREA_BY_QUADRATURE, AREA_TOLERANCE, BATCH, Speed, planes_name, rounded_name};
use crate::summary::write_summary;
use crate::sweep::{self, Record, Row};
use potential_particles::Formulation;
use serde::Serialize;
use std::collections::BTreeMap;
use std::io;
use std::path::Path;

/// One stated target.
#[derive(Serialize)]
struct Target {
    name: String,
    /// "at most" or "at least".
    sense: &'static str,
    target: f64,
    /// `null` when it could not be measured here.
    measured: Option<f64>,
    /// The same with nothing repeated: mean over pairs called one after the other.
    in_turn: Option<f64>,
    met: Option<bool>,
}

/// Failures of one solver at one tolerance over all pairs with known answers.
#[derive(Serialize)]
struct Failures {
    solver: &'static str,
    formulation: &'static str,
    tolerance: f64,
    pairs: usize,
    failed: usize,
    wrong_side: usize,
    reasons: BTreeMap<String, usize>,
}

/// Calls per million that need more than doubles.
#[derive(Serialize)]
struct PerMillion {
    calls: usize,
    extended: f64,
    rounding_limited: f64,
    failed: f64,
}

#[derive(Serialize)]
pub struct Report {
    machine: Machine,
    /// Cost of one plain evaluation of S, ∇S, ∇²S of both particles, 5 + 5 planes, nanoseconds.
    unit_nanoseconds: f64,
    /// The same by `potential::local`.
    library_evaluation_nanoseconds: f64,
    targets: Vec<Target>,
    falls_per_million: BTreeMap<&'static str, PerMillion>,
    failures: Vec<Failures>,
    speed: Speed,
}

impl Report {
    pub fn new(speed: Speed, records: &[Record], falls: Counts, machine: Machine) -> Self {
        let mut rows = Vec::new();
        sweep::for_each_setting(records, |of_setting| rows.push(sweep::row("all", of_setting)));
        let evaluation =
            |name| speed.cost(&rounded_name(pyramids::ROUNDED[1]), name).map_or(f64::NAN, |c| c.nanoseconds);
        let mut targets = speed_targets(&speed);
        targets.extend(truth_targets(&rows));
        let falls = [("pyramids", falls.pyramids), ("any shape", falls.any_shape)];
        Self {
            machine,
            unit_nanoseconds: evaluation("evaluation"),
            library_evaluation_nanoseconds: evaluation("evaluation by potential::local"),
            targets,
            falls_per_million: falls.into_iter().map(|(name, falls)| (name, per_million(&falls))).collect(),
            failures: rows.iter().map(failures).collect(),
            speed,
        }
    }

    pub fn write(&self, path: &Path) -> io::Result<()> {
        write_summary(path, self)
    }

    pub fn print(&self) {
        let Machine { processor, cores, system, date, library, rustc, clarabel, yade } = &self.machine;
        let yade = yade.as_deref().unwrap_or("not asked");
        println!("\n{processor}, {cores} cores, {system}, {date}");
        println!("potential-particles {library}, {rustc}, clarabel {clarabel}, YADE {yade}");
        println!(
            "one evaluation of both particles, 5 + 5 planes: {:.1} ns, the unit (by potential::local: {:.1} ns)\n",
            self.unit_nanoseconds, self.library_evaluation_nanoseconds
        );
        println!("{:62} {:>10} {:>10} {:>10}  met", "target", "", "measured", "in turn");
        for target in &self.targets {
            let sense = if target.sense == "at most" { "≤" } else { "≥" };
            let met = match target.met {
                Some(true) => "yes",
                Some(false) => "NO",
                None => "not measured",
            };
            let limit = format!("{sense} {}", digits(target.target));
            let shown = |value: Option<f64>| value.map_or_else(String::new, digits);
            println!(
                "{:62} {limit:>10} {:>10} {:>10}  {met}",
                target.name,
                shown(target.measured),
                shown(target.in_turn)
            );
        }
        println!("\ncontact area {:18} {:>10} {:>10}  quadrature to {AREA_TOLERANCE:.0e}", "", "ns", "units");
        for group in &self.speed.groups {
            let cost = |name| self.speed.cost(&group.shape, name);
            if let (Some(area), Some(rays)) = (cost(AREA), cost(AREA_BY_QUADRATURE)) {
                let (area_ns, area_units) = (area.nanoseconds, area.units);
                println!("{:31} {area_ns:10.0} {area_units:10.0} {:15.0} ns", group.shape, rays.nanoseconds);
            }
        }
        println!("\ncalls in a million        extended  rounding-limited     failed");
        for (name, falls) in &self.falls_per_million {
            let PerMillion { extended, rounding_limited, failed, .. } = falls;
            println!("{name:22} {extended:11.0} {rounding_limited:17.0} {failed:10.0}");
        }
        println!("\nfailures over the pairs known to 40 digits, at each solver's usual tolerance");
        println!("{:34} {:8} {:>9} {:>6} {:>7} {:>11}", "solver", "", "tolerance", "pairs", "failed", "wrong side");
        let usual = |failures: &&Failures| failures.tolerance == solvers::usual_tolerance(failures.solver);
        for failures in self.failures.iter().filter(usual) {
            let Failures { solver, formulation, tolerance, pairs, failed, wrong_side, .. } = failures;
            println!("{solver:34} {formulation:8} {tolerance:9.0e} {pairs:6} {failed:7} {wrong_side:11}");
        }
        println!();
    }
}

/// The ratios of the speed part. Where several pyramids are meant, the worst of them counts.
fn speed_targets(speed: &Speed) -> Vec<Target> {
    let rounded = pyramids::ROUNDED.map(rounded_name);
    let sharp = [rounded_name(pyramids::SHARP)];
    let all = |name: &str, of: &[String]| {
        let costs: Vec<_> = of.iter().filter_map(|shape| speed.cost(shape, name)).collect();
        let worst = |pick: fn(&crate::speed::Cost) -> f64| costs.iter().map(|cost| pick(cost)).reduce(f64::max);
        (worst(|cost| cost.units), worst(|cost| cost.in_turn_units))
    };
    let quotient = |over: &str, under: &str, pick: fn(f64, f64) -> f64| {
        let of = |shape: &String| {
            let (over, under) = (speed.cost(shape, over)?, speed.cost(shape, under)?);
            Some((over.units / under.units, over.in_turn_units / under.in_turn_units))
        };
        let values: Vec<_> = rounded.iter().filter_map(of).collect();
        (values.iter().map(|v| v.0).reduce(pick), values.iter().map(|v| v.1).reduce(pick))
    };
    let growth = |planes: usize| {
        let (name, base) = (planes_name(planes), planes_name(10));
        let (many, few) = (speed.cost(&name, "midway, warm"), speed.cost(&base, "midway, warm"));
        match (many, few) {
            (Some(many), Some(few)) => {
                let in_turn = |cost: &crate::speed::Cost| cost.nanoseconds / cost.units * cost.in_turn_units;
                (Some(many.nanoseconds / few.nanoseconds), Some(in_turn(many) / in_turn(few)))
            }
            _ => (None, None),
        }
    };
    let built_in = speed.built_in.as_ref();
    let built_in_cold = built_in.map(|b| b.built_in_microseconds / b.cold_microseconds);
    let built_in_warm = built_in.map(|b| b.built_in_microseconds / b.warm_microseconds);
    let precision = speed.precision.fast_bound / speed.precision.clarabel;
    vec![
        at_most("midway with geometry, cold (evaluations)", 50.0, all("midway, cold", &rounded)),
        at_most("midway with geometry, warm (evaluations)", 15.0, all("midway, warm", &rounded)),
        at_most("midway carried to a pose 1e-4 away (evaluations)", 8.0, all("midway, carried", &rounded)),
        at_most("the same in a batch, one thread (evaluations)", 8.0, all(BATCH, &rounded)),
        at_most("closest / midway, cold", 1.6, quotient("closest, cold", "midway, cold", f64::max)),
        at_most("closest / midway, warm", 1.6, quotient("closest, warm", "midway, warm", f64::max)),
        at_most("midway at r/size = k = 1e-6, cold (evaluations)", 150.0, all("midway, cold", &sharp)),
        at_least("clarabel / midway, cold", 200.0, quotient("clarabel, midway", "midway, cold", f64::min)),
        at_least("clarabel / closest, cold", 200.0, quotient("clarabel, closest", "closest, cold", f64::min)),
        at_most("bound on our error of s / error of clarabel's", 1.0, (Some(precision), None)),
        at_least("YADE's built-in without area / midway, both from last contact", 200.0, (built_in_warm, None)),
        at_least("YADE's built-in without area / midway, cold", 200.0, (built_in_cold, None)),
        at_most("rejected, direction in memory (evaluations)", 3.0, all("rejected by memory", &rounded)),
        at_most("rejected by spheres, cold (evaluations)", 6.0, all("rejected by spheres", &rounded)),
        at_most("rejected by a face, cold (evaluations)", 6.0, all("rejected by a face", &rounded)),
        at_most("300 + 300 planes / 10 + 10 planes, warm", 6.0, growth(300)),
        at_most("1000 + 1000 planes / 10 + 10 planes, warm", 10.0, growth(1000)),
    ]
}

/// What must not happen at all, over the pairs known to 40 digits.
fn truth_targets(rows: &[Row]) -> Vec<Target> {
    let tolerance = solvers::usual_tolerance(FAST);
    let count = |pick: fn(&Row) -> usize, formulation: Formulation| {
        let of = |row: &&Row| row.solver == FAST && row.formulation == formulation && row.tolerance == tolerance;
        rows.iter().find(of).map(|row| pick(row) as f64)
    };
    [Formulation::Midway, Formulation::Closest]
        .into_iter()
        .flat_map(|formulation| {
            let name = sweep::name(formulation);
            [
                at_most(&format!("{name}: failures"), 0.0, (count(|row| row.failed, formulation), None)),
                at_most(&format!("{name}: wrong side of contact"), 0.0, (count(|r| r.wrong_side, formulation), None)),
            ]
        })
        .collect()
}

fn at_most(name: &str, target: f64, (measured, in_turn): (Option<f64>, Option<f64>)) -> Target {
    Target { name: name.into(), sense: "at most", target, measured, in_turn, met: measured.map(|m| m <= target) }
}

fn at_least(name: &str, target: f64, (measured, in_turn): (Option<f64>, Option<f64>)) -> Target {
    Target { name: name.into(), sense: "at least", target, measured, in_turn, met: measured.map(|m| m >= target) }
}

fn failures(row: &Row) -> Failures {
    // Exit codes and signals of the child differ in wording only.
    let mut reasons = BTreeMap::new();
    for (reason, count) in &row.reasons {
        let asked = matches!(row.solver, BUILT_IN | BUILT_IN_AREA);
        let short = if asked { reason.split(" (").next().unwrap_or(reason) } else { reason };
        *reasons.entry(short.to_owned()).or_insert(0) += count;
    }
    Failures {
        solver: row.solver,
        formulation: sweep::name(row.formulation),
        tolerance: row.tolerance,
        pairs: row.pairs,
        failed: row.failed,
        wrong_side: row.wrong_side,
        reasons,
    }
}

fn per_million(falls: &Falls) -> PerMillion {
    let scaled = |count: usize| 1e6 * count as f64 / falls.calls.max(1) as f64;
    PerMillion {
        calls: falls.calls,
        extended: scaled(falls.extended),
        rounding_limited: scaled(falls.rounding_limited),
        failed: scaled(falls.failed),
    }
}

/// Three digits of whatever size.
fn digits(value: f64) -> String {
    match value.abs() {
        0.0 => "0".into(),
        v if v < 0.01 => format!("{value:.1e}"),
        v if v < 10.0 && v.fract() != 0.0 => format!("{value:.2}"),
        v if v < 100.0 && v.fract() != 0.0 => format!("{value:.1}"),
        _ => format!("{value:.0}"),
    }
}
