//! Every solver at every tolerance, behind one signature.

use crate::baselines::newton::{Equations, Stepping};
use crate::baselines::potential::Potential;
use crate::baselines::{self, Placed, Solution, one_shot};
use crate::cases::{Case, Truth};
use nalgebra::Vector3;
use potential_particles::internals::Pair;
use potential_particles::{BackEnd, Flags, Formulation, Kind, Pose, Settings, detect};

/// What a solver says of a pair; NaN where it says nothing. Order as in [`Truth`].
#[derive(Clone, Copy)]
pub struct Found {
    pub s: [f64; 2],
    /// Relative to B, world axes.
    pub points: [Vector3<f64>; 2],
    pub touching: bool,
    /// The same, measured against the solver's own shape where that is not the truth's.
    pub own: Option<([f64; 2], [Vector3<f64>; 2])>,
}

/// What was found, or why there is no answer.
type Answering = dyn Fn(&Case) -> Result<Found, String>;

/// One solver at one tolerance.
pub struct Solver {
    pub name: &'static str,
    pub formulation: Formulation,
    pub tolerance: f64,
    /// What is timed.
    pub call: Box<dyn Fn(&Case)>,
    /// What is judged.
    pub answer: Box<Answering>,
}

pub const FAST: &str = "fast";
pub const CONE_PROGRAM: &str = "cone_program";
pub const ONE_SHOT: &str = "clarabel, paper's program";
pub const NEWTON: [&str; 2] = ["Newton (Houlsby), plain", "Newton (Houlsby), halved"];
pub const CUBIC: [&str; 2] = ["cubic Newton (Harkness), plain", "cubic Newton (Harkness), halved"];
pub const BUILT_IN: &str = "YADE built-in";
pub const BUILT_IN_AREA: &str = "YADE built-in, with area";

/// Tolerances of YADE's built-in.
pub const BUILT_IN_TOLERANCES: [f64; 5] = [1e-3, 1e-5, 1e-7, 1e-9, 1e-11];
const BASELINE_TOLERANCES: [f64; 6] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12];

/// The tolerance at which a user would run a solver: its default, or for those without one clarabel's.
pub fn usual_tolerance(name: &str) -> f64 {
    match name {
        FAST | CONE_PROGRAM => Settings::default().gap_tolerance,
        BUILT_IN | BUILT_IN_AREA => crate::built_in::DEFAULT_TOLERANCE,
        _ => one_shot::DEFAULT_TOLERANCE,
    }
}

/// All solvers that run in this process.
pub fn all() -> Vec<Solver> {
    let mut solvers = Vec::new();
    for formulation in [Formulation::Midway, Formulation::Closest] {
        for digits in 3..=14 {
            solvers.push(library(FAST, BackEnd::Fast, formulation, 10f64.powi(-digits)));
        }
        solvers.push(library(CONE_PROGRAM, BackEnd::ConeProgram, formulation, Settings::default().gap_tolerance));
        for tolerance in BASELINE_TOLERANCES {
            solvers.push(baseline(ONE_SHOT, formulation, tolerance, move |case| {
                solutions(&case.placed(), formulation, |pair| one_shot::solve(pair, formulation, tolerance))
            }));
        }
        for (index, stepping) in [Stepping::Plain, Stepping::Halving].into_iter().enumerate() {
            for tolerance in BASELINE_TOLERANCES {
                solvers.push(baseline(NEWTON[index], formulation, tolerance, move |case| {
                    newton(case, formulation, tolerance, stepping, [&case.a, &case.b])
                }));
            }
            for tolerance in BASELINE_TOLERANCES {
                solvers.push(cubic(CUBIC[index], formulation, tolerance, stepping));
            }
        }
    }
    solvers
}

impl Case {
    /// What is known of the pair in this formulation, if anything is.
    pub fn truth(&self, formulation: Formulation) -> Option<&Truth> {
        if formulation == Formulation::Midway { Some(&self.midway) } else { self.closest.as_ref() }
    }
}

fn library(name: &'static str, back_end: BackEnd, formulation: Formulation, tolerance: f64) -> Solver {
    let settings = Settings::default()
        .with_formulation(formulation)
        .with_back_end(back_end)
        .with_solve_separated(true)
        .with_gap_tolerance(tolerance);
    let contact = move |case: &Case, settings: &Settings| {
        detect(&case.a, &case.pose_a, &case.b, &case.pose_b, settings, None).map_err(|error| error.to_string())
    };
    let call = move |case: &Case| {
        let _ = std::hint::black_box(contact(case, &settings));
    };
    let answer = move |case: &Case| {
        let found = contact(case, &settings)?;
        if formulation == Formulation::Closest && found.flags.contains(Flags::SLACK) {
            return Err("called slack".into());
        }
        let touching = found.kind == Kind::Overlapping;
        let mut points = [Vector3::repeat(f64::NAN); 2];
        if formulation == Formulation::Midway {
            points[0] = found.branch_b;
        } else {
            // With all weight on one of them the contact point is that closest point, free of the world's origin.
            for (point, weight_on_a) in points.iter_mut().zip([0.0, 1.0]) {
                *point = contact(case, &settings.with_weight_on_a(weight_on_a))?.branch_b;
            }
        }
        Ok(Found { s: [found.s, found.s_b], points, touching, own: None })
    };
    Solver { name, formulation, tolerance, call: Box::new(call), answer: Box::new(answer) }
}

/// A solver of the literature: what is timed is what is judged.
fn baseline(
    name: &'static str,
    formulation: Formulation,
    tolerance: f64,
    solve: impl Fn(&Case) -> Result<[Solution; 2], String> + Copy + 'static,
) -> Solver {
    let call = move |case: &Case| {
        let _ = std::hint::black_box(solve(case));
    };
    let answer = move |case: &Case| {
        let found = solve(case)?;
        let s = found.map(|solution| solution.s);
        let points = found.map(|solution| solution.point);
        Ok(Found { s, points, touching: s[0] < 1.0, own: None })
    };
    Solver { name, formulation, tolerance, call: Box::new(call), answer: Box::new(answer) }
}

/// Midway once, closest for both halves.
fn solutions(
    pair: &Placed,
    formulation: Formulation,
    solve: impl Fn(&Placed) -> Result<Solution, String>,
) -> Result<[Solution; 2], String> {
    if formulation == Formulation::Closest {
        return baselines::both_halves(pair, solve);
    }
    let nothing = Solution { s: f64::NAN, point: Vector3::repeat(f64::NAN) };
    Ok([solve(pair)?, nothing])
}

/// Newton on the Lagrange conditions of any two potentials in the places of A and B.
fn newton<P: Potential + Copy>(
    case: &Case,
    formulation: Formulation,
    tolerance: f64,
    stepping: Stepping,
    [a, b]: [P; 2],
) -> Result<[Solution; 2], String> {
    solutions(&case.placed(), formulation, |placed| {
        let swapped = std::ptr::eq(placed.a, &case.b);
        let (first, second) = if swapped { (b, a) } else { (a, b) };
        let pair = Pair::new(placed.a, placed.pose_a, placed.b, placed.pose_b);
        Equations { a: first, b: second, pair: &pair, formulation }.solve(tolerance, stepping, placed.pose_b)
    })
}

/// Newton on Harkness's particles. The truth is told of the second-degree ones: s is that of the true
/// particles at the point found. Against its own shape, the answer is compared with one that Newton
/// polishes from the true solution.
fn cubic(name: &'static str, formulation: Formulation, tolerance: f64, stepping: Stepping) -> Solver {
    let solve = move |case: &Case| newton(case, formulation, tolerance, stepping, [&case.cubic[0], &case.cubic[1]]);
    let call = move |case: &Case| {
        let _ = std::hint::black_box(solve(case));
    };
    let answer = move |case: &Case| {
        let found = solve(case)?;
        let own_s = found.map(|solution| solution.s);
        let points = found.map(|solution| solution.point);
        let reference = polished(case, formulation);
        let own = reference.map(|exact| {
            let s = std::array::from_fn(|i| (own_s[i] / exact[i].s - 1.0).abs());
            (s, std::array::from_fn(|i| points[i] - exact[i].point))
        });
        let [s_a, s_b] = points.map(|point| true_scales(case, &point));
        let s = match formulation {
            Formulation::Midway => [s_a[0].max(s_a[1]), f64::NAN],
            Formulation::Closest => [s_a[0], s_b[1]],
        };
        Ok(Found { s, points, touching: own_s[0] < 1.0, own })
    };
    Solver { name, formulation, tolerance, call: Box::new(call), answer: Box::new(answer) }
}

/// s of the true particles A and B at a point relative to B, world axes.
pub fn true_scales(case: &Case, point: &Vector3<f64>) -> [f64; 2] {
    let between = case.pose_b.position() - case.pose_a.position();
    let local = |pose: &Pose, from: Vector3<f64>| pose.rotation().tr_mul(&from);
    let s_a = case.a.potential(&local(&case.pose_a, point + between));
    let s_b = case.b.potential(&local(&case.pose_b, *point));
    [s_a, s_b].map(|f| (f + 1.0).max(0.0).sqrt())
}

/// The cubic solution to rounding, from the true one as start; `None` when Newton does not get there.
fn polished(case: &Case, formulation: Formulation) -> Option<[Solution; 2]> {
    const TIGHT: f64 = 1e-13;
    let truth = case.truth(formulation)?;
    let start = |placed: &Placed, index: usize| {
        let from = truth.points[index] + case.pose_b.position() - placed.pose_b.position();
        placed.pose_b.rotation().tr_mul(&from)
    };
    let halves = solutions(&case.placed(), formulation, |placed| {
        let swapped = std::ptr::eq(placed.a, &case.b);
        let [a, b] = if swapped { [&case.cubic[1], &case.cubic[0]] } else { [&case.cubic[0], &case.cubic[1]] };
        let pair = Pair::new(placed.a, placed.pose_a, placed.b, placed.pose_b);
        let from = start(placed, usize::from(swapped));
        Equations { a, b, pair: &pair, formulation }.solve_from(from, TIGHT, Stepping::Halving, placed.pose_b)
    });
    halves.ok()
}
