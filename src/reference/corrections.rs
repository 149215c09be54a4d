//! The sequence of programs, each a correction to the point before.

use super::goal::{Goal, both};
use super::numbers::{
    AGREEMENT, BINDING, BOTTOM, CERTIFIED, FIRST_BOX, GROW, LAST_BOX, LEAST_SCALE, MAX_PASSES, REPEAT, RESCUE, SHRINK,
};
use super::program::{Answer, Program, Tuning};
use super::solution::{ConeProgramError, ConeProgramSolution};
use crate::linalg::root::{Bracket, halved};
use crate::pair::pair::Pair;
use clarabel::solver::SolverStatus;
use nalgebra::Vector3;

/// The first pass: loose, since every later pass is checked by itself.
const FIRST: Tuning = Tuning {
    tolerance: 1e-6,
    feasibility: 1e-6,
    almost: 1e-5,
    equilibrate: true,
    regularisation: 1e-8,
    refine_relative: 1e-9,
    refine_absolute: 1e-10,
};

/// Factor on the box, and settings, most accurate first. Each fails on different pairs.
const ATTEMPTS: [(f64, Tuning); 9] = [
    (1.0, setting(1e-10, 1e-9, false, 1e-9)),
    (1.0, setting(1e-10, 1e-8, false, 1e-8)),
    (1.0, setting(1e-9, 1e-8, false, 1e-8)),
    (3.0, setting(1e-9, 1e-8, true, 1e-8)),
    (0.3, setting(1e-9, 1e-8, false, 1e-9)),
    (0.1, setting(1e-9, 1e-8, true, 1e-8)),
    (10.0, setting(1e-8, 1e-8, false, 1e-8)),
    (0.03, setting(1e-8, 1e-8, true, 1e-8)),
    (30.0, setting(1e-8, 1e-8, true, 1e-8)),
];

const fn setting(tolerance: f64, feasibility: f64, equilibrate: bool, regularisation: f64) -> Tuning {
    Tuning {
        tolerance,
        feasibility,
        almost: 1e-8,
        equilibrate,
        regularisation,
        refine_relative: 1e-13,
        refine_absolute: 1e-14,
    }
}

/// The lengths of a pair from which scales follow.
struct Sizes {
    /// Smaller bounding radius: the unit of length of the first pass.
    length: f64,
    /// For each particle, the largest w by which s grows with a length, 1/length.
    steepness: [f64; 2],
    /// For each particle, what rounding of a point does to s, no unit.
    noise: [f64; 2],
    /// Distance between the centres and both bounding radii, length.
    extent: f64,
}

impl Sizes {
    fn of(pair: &Pair) -> Self {
        let extent = pair.centre.norm() + pair.a.bounding_radius() + pair.b.bounding_radius();
        let mut sizes = Self { length: f64::INFINITY, steepness: [0.0; 2], noise: [0.0; 2], extent };
        for (side, particle) in [pair.a, pair.b].into_iter().enumerate() {
            let normal = (0..particle.plane_count()).map(|i| particle.normal(i).norm()).fold(0.0, f64::max);
            let planes = particle.plane_weight.sqrt() * normal;
            sizes.steepness[side] = planes.max(particle.sphere_weight.sqrt());
            sizes.length = sizes.length.min(particle.bounding_radius());
            sizes.noise[side] = 8.0 * f64::EPSILON * extent * sizes.steepness[side];
        }
        sizes
    }

    /// The box below which a correction gains nothing, s being counted in `scales`.
    fn smallest_box(&self, scales: [f64; 2]) -> f64 {
        LAST_BOX / (self.steepness[0] / scales[0]).max(self.steepness[1] / scales[1])
    }
}

/// Solves one of the paper's programs.
///
/// # Errors
/// See [`ConeProgramError`].
pub(super) fn solve(pair: &Pair, goal: Goal) -> Result<ConeProgramSolution, ConeProgramError> {
    let sizes = Sizes::of(pair);
    let noise = goal.objective(sizes.noise);
    let (mut x, mut iterations) = initial_point(pair, goal, &sizes)?;
    let mut s = goal.objective(both(pair, &x));
    let mut half = FIRST_BOX * (sizes.length + pair.centre.norm());
    let mut bound = f64::NEG_INFINITY;
    let mut accepted: Option<ConeProgramSolution> = None;
    for _ in 0..MAX_PASSES {
        let unit = s.max(LEAST_SCALE);
        let scales = goal.scales(unit);
        let smallest = sizes.smallest_box(scales);
        half = half.max(smallest);
        let pass = match correct(pair, goal, &sizes, &x, half, unit, &mut iterations)? {
            Ok(pass) => pass,
            Err(status) if half > sizes.extent => return Err(ConeProgramError::Status(format!("{status:?}"))),
            Err(_) => {
                half *= RESCUE;
                continue;
            }
        };
        let reach = pass.answer.step.amax() / pass.half;
        let wider = pass.half * GROW;
        let smaller = pass.half * (3.0 * reach).clamp(SHRINK, 0.3);
        x += pass.answer.step;
        if !pass.trusted {
            x = inside(pair, goal, &x);
            s = goal.objective(both(pair, &x));
            half = if reach > BINDING { wider } else { smaller };
            continue;
        }
        let previous = std::mem::replace(&mut s, goal.objective(pass.at));
        bound = bound.max(unit * (pass.answer.dual - pass.answer.pull * (1.0 + sizes.extent / pass.half)));
        if reach > BINDING {
            half = wider;
            continue;
        }
        let repeats = (s - previous).abs() <= REPEAT * s + noise;
        if accepted.is_none() && (repeats || half <= smallest || s < BOTTOM) {
            let weight = goal.weight(pass.answer.heads, scales, pass.at);
            accepted = Some(ConeProgramSolution { x, s, weight, iterations });
        }
        half = match accepted {
            Some(found) if found.s - bound <= CERTIFIED * found.s.max(LEAST_SCALE) + noise => return Ok(found),
            // The lower bound is not good enough yet: a larger box improves it.
            Some(found) if s >= found.s * (1.0 - CERTIFIED) - noise => wider,
            _ => {
                accepted = None;
                smaller
            }
        };
    }
    Err(ConeProgramError::Unsettled(MAX_PASSES))
}

/// One correction, solved.
struct Pass {
    answer: Answer,
    /// s of both particles at the corrected point, by definition.
    at: [f64; 2],
    /// Half-width of the box.
    half: f64,
    /// Whether clarabel's objectives agree with the definition; if not, the point is at most a better initial point.
    trusted: bool,
}

/// The correction with the first settings that give a trusted one, else the first one solved, else clarabel's last
/// status.
fn correct(
    pair: &Pair,
    goal: Goal,
    sizes: &Sizes,
    x: &Vector3<f64>,
    half: f64,
    unit: f64,
    iterations: &mut u32,
) -> Result<Result<Pass, SolverStatus>, ConeProgramError> {
    let mut best = Err(SolverStatus::Unsolved);
    for (factor, tuning) in &ATTEMPTS {
        let half = half * factor;
        let answer = Program::correction(pair, goal, x, half, goal.scales(unit)).run(tuning)?;
        *iterations += answer.iterations;
        if !matches!(answer.status, SolverStatus::Solved | SolverStatus::AlmostSolved) {
            best = best.map_err(|_| answer.status);
            continue;
        }
        let at = both(pair, &(x + answer.step));
        let agreement = (10.0 * tuning.tolerance).min(AGREEMENT);
        let near =
            |value: f64| (goal.objective(at) - value * unit).abs() <= agreement * unit + goal.objective(sizes.noise);
        let kept = goal.held(at) <= 1.0 + agreement + goal.held(sizes.noise);
        let trusted = near(answer.head) && near(answer.dual) && kept;
        if trusted || best.is_err() {
            best = Ok(Pass { answer, at, half, trusted });
        }
        if trusted {
            break;
        }
    }
    Ok(best)
}

/// The first pass: the program of the whole particles. Its point serves as initial point, whatever its status.
fn initial_point(pair: &Pair, goal: Goal, sizes: &Sizes) -> Result<(Vector3<f64>, u32), ConeProgramError> {
    // A unit for s: its least value on a few points between the centres is an upper bound of t.
    let between = (0..=16).map(|i| pair.centre * (f64::from(i) / 16.0));
    let least = between.map(|x| Goal::Midway.objective(both(pair, &x))).fold(f64::INFINITY, f64::min);
    let unit = least.max(LEAST_SCALE);
    let answer = Program::whole(pair, goal, sizes.length, goal.scales(unit)).run(&FIRST)?;
    let x = if answer.step.iter().all(|v| v.is_finite()) { answer.step } else { pair.centre };
    Ok((inside(pair, goal, &x), answer.iterations))
}

/// x, or where the ray from the centre of the constrained particle to x leaves that particle: around
/// a point too far outside, a box would hold no feasible point.
fn inside(pair: &Pair, goal: Goal, x: &Vector3<f64>) -> Vector3<f64> {
    let home = if goal.holds(0) { pair.centre } else { Vector3::zeros() };
    let held = |part: f64| goal.held(both(pair, &(home + (x - home) * part)));
    if held(1.0) <= 1.0 + AGREEMENT {
        return *x;
    }
    home + (x - home) * halved(Bracket { low: 0.0, high: 1.0 }, |part| !(held(part) <= 1.0))
}
