//! Run time against error over the pairs with known answers.

use crate::arguments::Effort;
use crate::built_in::{self, BuiltIn, DEFAULT_TOLERANCE};
use crate::cases::Case;
use crate::clock::{self, Contestant, median};
use crate::solvers::{self, BUILT_IN, BUILT_IN_AREA, BUILT_IN_TOLERANCES, Found, Solver};
use indicatif::ProgressBar;
use nalgebra::Vector3;
use potential_particles::Formulation;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// Closer to contact than this, no solver is blamed for the side it says.
const EDGE: f64 = 1e-12;

/// Fewer rounds than the speed part: the slow solvers are long enough to be timed once.
const ROUNDS: usize = 5;

/// One solver at one tolerance on one pair.
pub struct Record {
    pub solver: &'static str,
    pub formulation: Formulation,
    pub tolerance: f64,
    pub line: usize,
    pub family: String,
    /// Per call.
    pub seconds: f64,
    /// Errors, or why there is no answer.
    pub outcome: Result<Errors, String>,
}

/// Distance from the truth; NaN where the solver gives or the truth knows nothing.
#[derive(Clone, Copy)]
pub struct Errors {
    /// |s − s*| / s*; of closest the larger of both halves.
    pub s: f64,
    /// |x − x*| / R; of closest the larger of both halves.
    pub point: f64,
    /// The same against the solver's own shape, where that is another than the truth's.
    pub own_s: f64,
    pub own_point: f64,
    /// Called touching and is not, or the reverse.
    pub wrong_side: bool,
}

pub fn run(cases: &[Case], effort: &Effort, built_in: &mut BuiltIn, progress: &ProgressBar) -> Vec<Record> {
    progress.set_message("pairs known to 40 digits");
    let solvers = solvers::all();
    let calls: Vec<Box<dyn Fn(usize)>> = solvers
        .iter()
        .map(|solver| {
            let call = move |item: usize| {
                if cases[item].truth(solver.formulation).is_some() {
                    (solver.call)(&cases[item]);
                }
            };
            Box::new(call) as Box<dyn Fn(usize)>
        })
        .collect();
    let contestants: Vec<Contestant> = calls.iter().map(|call| &**call).collect();
    let seconds = clock::race(cases.len(), &contestants, effort.rounds.min(ROUNDS), progress);
    let mut records = Vec::new();
    for (solver, seconds) in solvers.iter().zip(&seconds) {
        for (case, &seconds) in cases.iter().zip(seconds) {
            records.extend(record(solver, case, seconds));
        }
    }
    progress.set_message("YADE's built-in");
    progress.inc_length(cases.len() as u64);
    for case in cases {
        if built_in.missing().is_none() {
            records.extend(built_in_records(built_in, case));
        }
        progress.inc(1);
    }
    records
}

/// `None` where the formulation is not defined by the truth.
fn record(solver: &Solver, case: &Case, seconds: f64) -> Option<Record> {
    case.truth(solver.formulation)?;
    let outcome = (solver.answer)(case).and_then(|found| errors(case, solver.formulation, &found));
    let (solver, formulation, tolerance) = (solver.name, solver.formulation, solver.tolerance);
    Some(Record { solver, formulation, tolerance, line: case.line, family: case.family.clone(), seconds, outcome })
}

fn errors(case: &Case, formulation: Formulation, found: &Found) -> Result<Errors, String> {
    let truth = case.truth(formulation).expect("asked only where there is one");
    if !found.s[0].is_finite() {
        return Err("not a number".into());
    }
    let s = truth.s.iter().zip(found.s).map(|(exact, s)| (s - exact).abs() / exact);
    let point = truth.points.iter().zip(found.points).map(|(exact, point)| (point - exact).norm() / case.size);
    let (own_s, own_point) = match found.own {
        Some((s, points)) => (largest(s), largest(points.map(|point: Vector3<f64>| point.norm() / case.size))),
        None => (f64::NAN, f64::NAN),
    };
    Ok(Errors { s: largest(s), point: largest(point), own_s, own_point, wrong_side: wrong_side(case, found.touching) })
}

fn wrong_side(case: &Case, touching: bool) -> bool {
    (case.midway.s[0] - 1.0).abs() > EDGE && touching != case.touching
}

/// Without the NaN; NaN of nothing.
fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(f64::NAN, f64::max)
}

/// The functor answers touching pairs only; of others it says that they are apart. What fails at its usual
/// tolerance (a crash, an endless loop) costs a restart or a long wait, and is not tried again at the others.
fn built_in_records(built_in: &mut BuiltIn, case: &Case) -> Vec<Record> {
    let mut ask = |tolerance, area| built_in.ask(&case.placed(), Some(case.quaternions), tolerance, area);
    let usual = ask(DEFAULT_TOLERANCE, false);
    let mut unless_failed = |tolerance, area| match &usual {
        Ok(_) => ask(tolerance, area),
        Err(reason) => Err(reason.clone()),
    };
    let with_area = unless_failed(DEFAULT_TOLERANCE, true);
    let plain = BUILT_IN_TOLERANCES.map(|tolerance| {
        let found = if tolerance == DEFAULT_TOLERANCE { usual.clone() } else { unless_failed(tolerance, false) };
        (BUILT_IN, tolerance, found)
    });
    let all = plain.into_iter().chain([(BUILT_IN_AREA, DEFAULT_TOLERANCE, with_area)]);
    all.map(|(solver, tolerance, found)| {
        let seconds = found.as_ref().map_or(f64::NAN, |found| found.seconds);
        let outcome = found.and_then(|found| judged(case, &found));
        let (family, formulation) = (case.family.clone(), Formulation::Midway);
        Record { solver, formulation, tolerance, line: case.line, family, seconds, outcome }
    })
    .collect()
}

fn judged(case: &Case, found: &built_in::Found) -> Result<Errors, String> {
    if case.touching && !found.touching {
        return Err("missed the contact".into());
    }
    let nothing = Vector3::repeat(f64::NAN);
    let known = case.touching && found.touching;
    let point = if known { found.point() } else { nothing };
    // It does not tell s: that of its point.
    let [s_a, s_b] = solvers::true_scales(case, &point);
    let s = if known { s_a.max(s_b) } else { f64::NAN };
    let error = (s - case.midway.s[0]).abs() / case.midway.s[0];
    let distance = (point - case.midway.points[0]).norm() / case.size;
    let wrong_side = wrong_side(case, found.touching);
    Ok(Errors { s: error, point: distance, own_s: f64::NAN, own_point: f64::NAN, wrong_side })
}

/// One line of the published table.
pub struct Row {
    pub solver: &'static str,
    pub formulation: Formulation,
    pub tolerance: f64,
    /// A family, or "all".
    pub family: String,
    pub pairs: usize,
    pub failed: usize,
    pub wrong_side: usize,
    /// Median over the pairs that were answered.
    pub seconds: f64,
    /// (median, worst) of the errors of [`Errors`].
    pub s: [f64; 2],
    pub point: [f64; 2],
    pub own_s: [f64; 2],
    pub own_point: [f64; 2],
    /// Each reason of failure with its count.
    pub reasons: Vec<(String, usize)>,
}

/// Medians and worst cases by solver, tolerance and family, and over all families.
pub fn table(records: &[Record]) -> Vec<Row> {
    let mut rows: Vec<Row> = Vec::new();
    for_each_setting(records, |of_setting| {
        rows.push(row("all", of_setting));
        let mut families: Vec<&str> = of_setting.iter().map(|record| record.family.as_str()).collect();
        families.sort_unstable();
        families.dedup();
        for family in families {
            let of_family: Vec<&Record> = of_setting.iter().copied().filter(|record| record.family == family).collect();
            rows.push(row(family, &of_family));
        }
    });
    rows
}

/// Calls for each (solver, formulation, tolerance), in order of first appearance.
pub fn for_each_setting<'a>(records: &'a [Record], mut visit: impl FnMut(&[&'a Record])) {
    let key = |record: &Record| (record.solver, record.formulation == Formulation::Closest, record.tolerance.to_bits());
    let mut keys = Vec::new();
    for record in records {
        if !keys.contains(&key(record)) {
            keys.push(key(record));
        }
    }
    for wanted in keys {
        let of_setting: Vec<&Record> = records.iter().filter(|record| key(record) == wanted).collect();
        visit(&of_setting);
    }
}

/// Sums up records of one setting; at least one.
pub fn row(family: &str, records: &[&Record]) -> Row {
    let answered: Vec<(f64, Errors)> =
        records.iter().filter_map(|record| Some((record.seconds, *record.outcome.as_ref().ok()?))).collect();
    let spread = |pick: fn(&Errors) -> f64| {
        let known: Vec<f64> = answered.iter().map(|(_, errors)| pick(errors)).filter(|e| !e.is_nan()).collect();
        let worst = largest(known.iter().copied());
        [median(known), worst]
    };
    let mut reasons: Vec<(String, usize)> = Vec::new();
    for reason in records.iter().filter_map(|record| record.outcome.as_ref().err()) {
        match reasons.iter_mut().find(|(known, _)| known == reason) {
            Some((_, count)) => *count += 1,
            None => reasons.push((reason.clone(), 1)),
        }
    }
    let first = records[0];
    Row {
        solver: first.solver,
        formulation: first.formulation,
        tolerance: first.tolerance,
        family: family.into(),
        pairs: records.len(),
        failed: records.len() - answered.len(),
        wrong_side: answered.iter().filter(|(_, errors)| errors.wrong_side).count(),
        seconds: median(answered.iter().map(|(seconds, _)| *seconds).collect()),
        s: spread(|e| e.s),
        point: spread(|e| e.point),
        own_s: spread(|e| e.own_s),
        own_point: spread(|e| e.own_point),
        reasons,
    }
}

/// "midway" or "closest".
pub fn name(formulation: Formulation) -> &'static str {
    if formulation == Formulation::Midway { "midway" } else { "closest" }
}

pub fn write_table(path: &Path, rows: &[Row]) -> io::Result<()> {
    let mut file = BufWriter::new(File::create(path)?);
    writeln!(
        file,
        "solver,formulation,tolerance,family,pairs,failed,wrong_side,median_time_us,median_s_error,worst_s_error,\
         median_point_error,worst_point_error,own_median_s_error,own_worst_s_error,own_median_point_error,\
         own_worst_point_error,reasons"
    )?;
    for row in rows {
        write!(file, "\"{}\",{},{:e},{},", row.solver, name(row.formulation), row.tolerance, row.family)?;
        write!(file, "{},{},{},{}", row.pairs, row.failed, row.wrong_side, shown(1e6 * row.seconds))?;
        for value in [row.s, row.point, row.own_s, row.own_point].concat() {
            write!(file, ",{}", shown(value))?;
        }
        let reasons: Vec<String> = row.reasons.iter().map(|(reason, count)| format!("{count} × {reason}")).collect();
        writeln!(file, ",\"{}\"", reasons.join("; ").replace('"', "'"))?;
    }
    file.flush()
}

pub fn write_pairs(path: &Path, records: &[Record]) -> io::Result<()> {
    let mut file = BufWriter::new(File::create(path)?);
    writeln!(
        file,
        "solver,formulation,tolerance,line,family,time_us,s_error,point_error,own_s_error,own_point_error,\
         wrong_side,failure"
    )?;
    for record in records {
        write!(file, "\"{}\",{},{:e},", record.solver, name(record.formulation), record.tolerance)?;
        write!(file, "{},{},{}", record.line, record.family, shown(1e6 * record.seconds))?;
        match &record.outcome {
            Ok(errors) => {
                for value in [errors.s, errors.point, errors.own_s, errors.own_point] {
                    write!(file, ",{}", shown(value))?;
                }
                writeln!(file, ",{},", u8::from(errors.wrong_side))?;
            }
            Err(reason) => writeln!(file, ",,,,,,\"{}\"", reason.replace('"', "'"))?,
        }
    }
    file.flush()
}

/// Nothing for NaN, else four digits.
fn shown(value: f64) -> String {
    if value.is_nan() { String::new() } else { format!("{value:.3e}") }
}
