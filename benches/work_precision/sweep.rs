//! Run time against error over the pairs whose answers are known to 40 digits.

use crate::Effort;
use crate::clock::{self, Contestant};
use kit::target::at_most;
use kit::truth::{self, number, vector};
use nalgebra::Vector3;
use potential_particles::{BackEnd, Flags, Formulation, Kind, Particle, Pose, Settings, detect};
use serde_json::Value;
use std::fs::File;
use std::hint::black_box;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// Closer to contact than this, no solver is blamed for the side it says.
const EDGE: f64 = 1e-12;

/// The slow solver is long enough to be timed a few times.
const ROUNDS: usize = 5;

/// One pair and its answer.
struct Case {
    family: String,
    a: Particle,
    b: Particle,
    poses: [Pose; 2],
    /// Smaller bounding radius: the R by which errors of points are divided.
    size: f64,
    midway: Truth,
    /// `None` where a constraint is slack, so that closest is not defined by the truth data.
    closest: Option<Truth>,
}

/// What is known. Midway: s and P3. Closest: s_A at P2, then s_B at P1. Points relative to B, world axes.
struct Truth(Vec<(f64, Vector3<f64>)>);

/// One solver at one tolerance on one pair.
pub struct Record {
    solver: &'static str,
    formulation: Formulation,
    tolerance: f64,
    family: String,
    /// Per call.
    seconds: f64,
    /// What went wrong, or the errors of s, relative, and of the point over R; of closest the larger of both halves.
    outcome: Result<[f64; 2], String>,
    wrong_side: bool,
}

pub fn run(effort: &Effort) -> Vec<Record> {
    let cases: Vec<Case> = truth::pairs().into_iter().step_by(effort.stride).map(case).collect();
    let mut records = Vec::new();
    for formulation in [Formulation::Midway, Formulation::Closest] {
        let of = |case: &&Case| formulation == Formulation::Midway || case.closest.is_some();
        let cases: Vec<&Case> = cases.iter().filter(of).collect();
        let fast = (3..=14).map(|digits| ("fast", BackEnd::Fast, 10f64.powi(-digits)));
        let usual = Settings::default().gap_tolerance;
        let solvers: Vec<_> = fast.chain([("cone_program", BackEnd::ConeProgram, usual)]).collect();
        let settings = |back_end, tolerance| {
            let plain = Settings::default().with_formulation(formulation).with_back_end(back_end);
            plain.with_solve_separated(true).with_gap_tolerance(tolerance)
        };
        let call = |&(_, back_end, tolerance): &(&str, _, f64)| {
            let (settings, cases) = (settings(back_end, tolerance), &cases);
            Box::new(move |i: usize| _ = black_box(found(black_box(cases[i]), &settings))) as Box<dyn Fn(usize)>
        };
        let calls: Vec<_> = solvers.iter().map(call).collect();
        let contestants: Vec<Contestant> = calls.iter().map(|call| &**call).collect();
        let seconds = clock::race(cases.len(), &contestants, effort.rounds.min(ROUNDS));
        for (&(solver, back_end, tolerance), seconds) in solvers.iter().zip(seconds) {
            for (case, seconds) in cases.iter().zip(seconds) {
                let (outcome, wrong_side) = judged(case, &settings(back_end, tolerance));
                let family = case.family.clone();
                records.push(Record { solver, formulation, tolerance, family, seconds, outcome, wrong_side });
            }
        }
    }
    records
}

fn case(pair: truth::Pair) -> Case {
    let (a, b, truth) = (pair.shape_a.particle(), pair.shape_b.particle(), &pair.truth);
    let closest = (truth.ok1 && truth.ok2).then(|| {
        let known = (truth.s_a.as_deref(), truth.p2.as_ref(), truth.s_b.as_deref(), truth.p1.as_ref());
        let (Some(s_a), Some(p2), Some(s_b), Some(p1)) = known else { panic!("the truth data lack a closest answer") };
        Truth(vec![(number(s_a), vector(p2)), (number(s_b), vector(p1))])
    });
    Case {
        size: a.bounding_radius().min(b.bounding_radius()),
        poses: [pair.a.pose(), pair.b.pose()],
        midway: Truth(vec![(number(&truth.s4), vector(&truth.x4))]),
        closest,
        family: pair.family,
        a,
        b,
    }
}

fn found(case: &Case, settings: &Settings) -> Result<potential_particles::Contact, String> {
    let Case { a, b, poses: [pose_a, pose_b], .. } = case;
    detect(a, pose_a, b, pose_b, settings, None).map_err(|error| error.to_string())
}

fn judged(case: &Case, settings: &Settings) -> (Result<[f64; 2], String>, bool) {
    let contact = match found(case, settings) {
        Ok(contact) => contact,
        Err(error) => return (Err(error), false),
    };
    let exact = case.midway.0[0].0;
    let wrong_side = (exact - 1.0).abs() > EDGE && (contact.kind == Kind::Overlapping) != (exact < 1.0);
    let midway = settings.formulation == Formulation::Midway;
    let answers = if midway {
        Ok(vec![(contact.s, contact.branch_b)])
    } else if contact.flags.contains(Flags::SLACK) {
        Err("called slack".to_owned())
    } else {
        // With all weight on one of them the contact point is that closest point, free of the world's origin.
        let point = |weight| found(case, &settings.with_weight_on_a(weight)).map(|contact| contact.branch_b);
        [(contact.s, 0.0), (contact.s_b, 1.0)].into_iter().map(|(s, weight)| Ok((s, point(weight)?))).collect()
    };
    let truth = if midway { &case.midway } else { case.closest.as_ref().expect("asked only where there is one") };
    let errors = |answers: Vec<(f64, Vector3<f64>)>| {
        truth.0.iter().zip(answers).fold([0.0_f64; 2], |worst, ((exact, place), (s, point))| {
            [worst[0].max((s - exact).abs() / exact), worst[1].max((point - place).norm() / case.size)]
        })
    };
    (answers.map(errors), wrong_side)
}

/// What must not happen at all: no answer, and an answer on the wrong side of contact.
pub fn targets(records: &[Record]) -> Vec<Value> {
    let ours = |record: &&Record| record.solver == "fast" && record.tolerance == Settings::default().gap_tolerance;
    let count = |name: &str, is_meant: &dyn Fn(&Record) -> bool| {
        let found = records.iter().filter(ours).filter(|record| is_meant(record)).count();
        at_most(&format!("pairs known to 40 digits, {name}"), 0.0, found as f64)
    };
    let of = |formulation| move |record: &Record| record.formulation == formulation;
    let mut targets = Vec::new();
    for formulation in [Formulation::Midway, Formulation::Closest] {
        let of = of(formulation);
        targets.push(count(&format!("{formulation}: failures"), &|record| of(record) && record.outcome.is_err()));
        targets.push(count(&format!("{formulation}: wrong side"), &|record| of(record) && record.wrong_side));
    }
    targets
}

/// A line for each solver, tolerance and pair.
pub fn write(path: &Path, records: &[Record]) -> io::Result<()> {
    let mut file = BufWriter::new(File::create(path)?);
    writeln!(file, "solver,formulation,tolerance,family,time_us,s_error,point_error,wrong_side,failure")?;
    for Record { solver, formulation, tolerance, family, seconds, outcome, wrong_side } in records {
        write!(file, "{solver},{formulation},{tolerance:e},{family},{:.3e},", 1e6 * seconds)?;
        match outcome {
            Ok([s, point]) => writeln!(file, "{s:.3e},{point:.3e},{},", u8::from(*wrong_side))?,
            Err(reason) => writeln!(file, ",,,\"{}\"", reason.replace('"', "'"))?,
        }
    }
    file.flush()
}
