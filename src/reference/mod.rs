//! The reference back end: the paper's second-order cone programs, handed to clarabel.
//!
//! # The programs (paper eqs 34–44, written in the frame of B; eqs 19–31 are the same without z)
//!
//! ```text
//! unknowns   head (t, or s of the objective), x_A, x_B (both local), p_A,i, p_B,i
//! closest    minimise s_A  subject to  s_B ≤ 1               (34), and with A and B swapped
//! midway     minimise t    subject to  s_A ≤ t, s_B ≤ t      (44)
//! cones      ‖(p_A,c , x_A,c)‖ ≤ s_A,  ‖(p_B,c , x_B,c)‖ ≤ s_B       (35, 36)   dimension 1 + N + 3
//!            p_c,i = √(1−k)/r · p_i,   x_c = √k/R · x
//! ties       Q x_A + c = x_B,  Q, c the pose of A in the frame of B    (37–39)
//! planes     n_i·x − d_i ≤ p_i,  p_i ≥ 0                              (40–43)
//! ```
//!
//! Minimising t with two inequalities is (44): where the two s can be equal, they are; where one
//! of them stays below the other at the minimum of the other, (44) as printed would leave that
//! minimum, and the inequality does not. The concise programs follow from dead weights: for k = 0
//! the cone loses x_c (dimension 1 + N), for k = 1 it loses p_c and the particle its rows (1 + 3).
//! Local points x are kept as unknowns instead of x_c, so that k = 0 needs no case of its own.
//!
//! # The scalings, and why
//!
//! An interior-point method is right to some 1e-9 of the largest number in sight. With lengths of
//! order 1 and r = 1e-8 that is an error of s of order 0.1. So the program is solved several times,
//! each time as a correction to the point found before:
//!
//! 1. once for the whole particles, about their centres, lengths in units of the smaller bounding
//!    radius; this only has to find the place;
//! 2. then with x = x₀ + h·δ, δ unknown, inside the box |δ_B| ≤ 1. Right-hand sides become the slacks
//!    d_i − n_i·x₀ at the last point, which double precision holds to full relative accuracy where
//!    it matters. A plane that no point of the box can reach has p_i = 0 all over it and is left out.
//!    If the correction ends far out in its box, the box is moved and widened; otherwise h shrinks, down
//!    to the distance over which s changes by a tenth (some tenth of r or R/√k, times s), or until
//!    s repeats itself.
//!
//! In every pass p_c and s are counted in units of s at the last point (1 for the constrained
//! particle), which makes the entries of the cones of order 1; rows are divided by |n_i|. clarabel's
//! own equilibration undoes part of this and costs two digits, so that it is off at first. Its
//! static regularisation is lowered to 1e-9 for the same reason. No one setting gets through every
//! pair, hence a ladder of settings and box sizes.
//!
//! # What is believed
//!
//! The program is convex, so that an optimum well inside its box is the optimum of the whole program,
//! however its start was found. An answer leaves only if
//! - clarabel calls the pass solved or almost solved;
//! - s = √S at the returned point, clarabel's objective and its dual objective agree to 1e-8 or better,
//!   and the constraint holds to the same; s as returned is always that of the definition;
//! - one of the passes bounds s from below to 1e-5, also for points outside its box: the dual objective
//!   less what the duals of the box and the dual residual could lose on the way to the far end of the
//!   pair. This is a worst case, there to catch an optimum in the wrong place; measured errors of s are
//!   1e-9 and below, and what rounding of x does to s (ε·size·√(1−k)/r) where that is more.
//!
//! Otherwise the answer is a [`ConicError`].

mod program;

use crate::pair::relative_pose::Pair;
pub use crate::pair::role::Role;
use crate::particle::potential;
use clarabel::solver::SolverStatus;
use nalgebra::Vector3;
use program::{Answer, Program, Tuning};
use thiserror::Error;

/// Solution of one cone program, in the frame of B.
#[derive(Clone, Copy, Debug)]
pub struct ConicSolution {
    /// The minimiser, local frame of B, length: P3 of midway, P1 or P2 of closest.
    pub x: Vector3<f64>,
    /// The objective, no unit: max(s_A, s_B) at x for midway, s of the free particle for closest.
    pub s: f64,
    /// Weight u of B, in [0, 1], from the duals: (1−u)·∇S_A + u·∇S_B = 0 at the exact optimum.
    pub weight: f64,
    /// Interior-point iterations, summed over all passes.
    pub iterations: u32,
}

/// Why a cone program gave no answer. There is never a number beside it.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum ConicError {
    /// clarabel would not take the program.
    #[error("clarabel refused the cone program: {0}; look for numbers near the limits of f64 in the particles")]
    Refused(String),
    /// No rung of the ladder solved a pass.
    #[error(
        "clarabel stopped with status {0} at every scaling of the cone program: look for r, R or a distance \
         many orders of magnitude away from the size of the particles"
    )]
    Status(String),
    /// The passes did not settle.
    #[error(
        "the cone program did not settle in {0} passes: look for r, R or a distance many orders of magnitude \
         away from the size of the particles"
    )]
    Unsettled(u32),
}

/// The objective and the constraints of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Goal {
    Midway,
    /// s of this particle is held at ≤ 1, that of the other is minimised.
    Constrained(Role),
}

/// Midway: the point of least t with s_A ≤ t and s_B ≤ t (P3, paper eqs 4, 44).
///
/// # Errors
/// See [`ConicError`].
pub fn midway(pair: &Pair) -> Result<ConicSolution, ConicError> {
    solve(pair, Goal::Midway)
}

/// Closest: the point of the particle `constrained` where s of the other is least (paper eqs 34–43).
///
/// [`Role::B`] gives P2 with s = s_A, [`Role::A`] gives P1 with s = s_B. The constraint may be slack: then the
/// point is a minimiser of the other particle's S, inside the constrained one, with s = 0.
///
/// # Errors
/// See [`ConicError`].
pub fn closest(pair: &Pair, constrained: Role) -> Result<ConicSolution, ConicError> {
    solve(pair, Goal::Constrained(constrained))
}

/// Box of the first correction, as a part of the length unit: well above the error of the first pass.
const FIRST_BOX: f64 = 1e-4;
/// A box need not be smaller than this part of the distance over which s doubles.
const LAST_BOX: f64 = 0.1;
/// Most that one pass shrinks the box.
const SHRINK: f64 = 1e-3;
/// Growth of the box when it binds.
const GROW: f64 = 30.0;
/// Growth of the box when every rung failed: it may not hold a feasible point at all.
const RESCUE: f64 = 1e3;
/// A correction longer than this part of the box asks for a wider one.
const BINDING: f64 = 0.5;
/// Least s used as a unit; below it s is as good as zero.
const LEAST_SCALE: f64 = 1e-6;
/// An s this small is the bottom of S; no smaller value can be told from rounding.
const BOTTOM: f64 = 1e-12;
/// Largest disagreement of clarabel's objectives with s by definition, relative, in a pass that is trusted.
const AGREEMENT: f64 = 1e-8;
/// Largest distance of s, relative, from a bound that holds outside the box as well. The bound assumes
/// the worst, an optimum at the far end of the pair; s itself is found some four digits closer.
const CERTIFIED: f64 = 1e-5;
/// Change of s, relative, below which two passes say the same.
const REPEAT: f64 = 1e-10;
/// Most corrections. Ordinary pairs need one or two, near-polyhedral ones up to 4; sizes, radii and
/// distances drawn from eight decades at random needed up to 18.
const MAX_PASSES: u32 = 40;

/// The first pass: loose, since every later pass is judged on its own.
const PLACE: Tuning = Tuning {
    tolerance: 1e-6,
    feasibility: 1e-6,
    almost: 1e-5,
    equilibrate: true,
    regularisation: 1e-8,
    refine_relative: 1e-9,
    refine_absolute: 1e-10,
};

/// The ladder: factor on the box, and settings. Ordered by accuracy; each rung fails on other pairs.
const LADDER: [(f64, Tuning); 9] = [
    (1.0, rung(1e-10, 1e-9, false, 1e-9)),
    (1.0, rung(1e-10, 1e-8, false, 1e-8)),
    (1.0, rung(1e-9, 1e-8, false, 1e-8)),
    (3.0, rung(1e-9, 1e-8, true, 1e-8)),
    (0.3, rung(1e-9, 1e-8, false, 1e-9)),
    (0.1, rung(1e-9, 1e-8, true, 1e-8)),
    (10.0, rung(1e-8, 1e-8, false, 1e-8)),
    (0.03, rung(1e-8, 1e-8, true, 1e-8)),
    (30.0, rung(1e-8, 1e-8, true, 1e-8)),
];

const fn rung(tolerance: f64, feasibility: f64, equilibrate: bool, regularisation: f64) -> Tuning {
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

/// s of the two particles at x, by definition.
fn both(pair: &Pair, x: &Vector3<f64>) -> [f64; 2] {
    [potential::value(pair.a, &pair.in_a(x)).sqrt(), potential::value(pair.b, x).sqrt()]
}

impl Goal {
    /// The objective, from s of both particles.
    fn objective(self, s: [f64; 2]) -> f64 {
        match self {
            Self::Midway => s[0].max(s[1]),
            Self::Constrained(Role::A) => s[1],
            Self::Constrained(Role::B) => s[0],
        }
    }

    /// s of the particle that is held at ≤ 1; 0 for midway.
    fn held(self, s: [f64; 2]) -> f64 {
        match self {
            Self::Midway => 0.0,
            Self::Constrained(Role::A) => s[0],
            Self::Constrained(Role::B) => s[1],
        }
    }

    /// Units of s of the two cones, `unit` being that of the objective.
    fn scales(self, unit: f64) -> [f64; 2] {
        match self {
            Self::Midway => [unit, unit],
            Self::Constrained(Role::A) => [1.0, unit],
            Self::Constrained(Role::B) => [unit, 1.0],
        }
    }

    /// Whether s of this particle (0 = A, 1 = B) is held at ≤ 1 and not part of the objective.
    fn holds(self, side: usize) -> bool {
        matches!((self, side), (Self::Constrained(Role::A), 0) | (Self::Constrained(Role::B), 1))
    }

    /// u of B from the duals of the two cone heads, in units of 1/`scales`.
    ///
    /// The duals weigh ∇s; with ∇S = 2s·∇s their weights of ∇S carry another 1/s. An s of zero is
    /// the bottom of that particle's S: all weight is on it.
    fn weight(self, heads: [f64; 2], scales: [f64; 2], s: [f64; 2]) -> f64 {
        // In midway both s are t wherever both duals count.
        let s = if self == Self::Midway { [1.0; 2] } else { s };
        let [a, b] = [0, 1].map(|side| heads[side].max(0.0) / (scales[side] * s[side]));
        match (a.is_infinite(), b.is_infinite()) {
            (true, false) => 0.0,
            (false, true) => 1.0,
            _ if a + b > 0.0 && (a + b).is_finite() => b / (a + b),
            _ => 0.5,
        }
    }
}

/// What of a pair sets the scales.
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

fn solve(pair: &Pair, goal: Goal) -> Result<ConicSolution, ConicError> {
    let sizes = Sizes::of(pair);
    let noise = goal.objective(sizes.noise);
    let (mut x, mut iterations) = place(pair, goal, &sizes)?;
    let mut s = goal.objective(both(pair, &x));
    let mut half = FIRST_BOX * (sizes.length + pair.centre.norm());
    let mut bound = f64::NEG_INFINITY;
    let mut settled: Option<ConicSolution> = None;
    for _ in 0..MAX_PASSES {
        let unit = s.max(LEAST_SCALE);
        let scales = goal.scales(unit);
        let smallest = sizes.smallest_box(scales);
        half = half.max(smallest);
        let pass = match correct(pair, goal, &sizes, &x, half, unit, &mut iterations)? {
            Ok(pass) => pass,
            Err(status) if half > sizes.extent => return Err(ConicError::Status(format!("{status:?}"))),
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
        if settled.is_none() && (repeats || half <= smallest || s < BOTTOM) {
            let weight = goal.weight(pass.answer.heads, scales, pass.at);
            settled = Some(ConicSolution { x, s, weight, iterations });
        }
        half = match settled {
            Some(found) if found.s - bound <= CERTIFIED * found.s.max(LEAST_SCALE) + noise => return Ok(found),
            // The place is not proven yet: a wider box says more about the world outside.
            Some(found) if s >= found.s * (1.0 - CERTIFIED) - noise => wider,
            _ => {
                settled = None;
                smaller
            }
        };
    }
    Err(ConicError::Unsettled(MAX_PASSES))
}

/// One correction, solved.
struct Pass {
    answer: Answer,
    /// s of both particles at the corrected point, by definition.
    at: [f64; 2],
    /// Half-width of the box.
    half: f64,
    /// Whether clarabel's numbers are those of the definition; if not, the point is a better start at most.
    trusted: bool,
}

/// Climbs the ladder to the first trusted correction, else to the first one solved, else to no more
/// than clarabel's last status.
fn correct(
    pair: &Pair,
    goal: Goal,
    sizes: &Sizes,
    x: &Vector3<f64>,
    half: f64,
    unit: f64,
    iterations: &mut u32,
) -> Result<Result<Pass, SolverStatus>, ConicError> {
    let mut best = Err(SolverStatus::Unsolved);
    for (factor, tuning) in &LADDER {
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

/// The first pass: the program of the whole particles. Its point is a start, whatever its status.
fn place(pair: &Pair, goal: Goal, sizes: &Sizes) -> Result<(Vector3<f64>, u32), ConicError> {
    // A unit for s: its least value on a few points between the centres is an upper bound of t.
    let between = (0..=16).map(|i| pair.centre * (f64::from(i) / 16.0));
    let least = between.map(|x| Goal::Midway.objective(both(pair, &x))).fold(f64::INFINITY, f64::min);
    let unit = least.max(LEAST_SCALE);
    let answer = Program::whole(pair, goal, sizes.length, goal.scales(unit)).run(&PLACE)?;
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
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if held(middle) <= 1.0 { low = middle } else { high = middle }
    }
    home + (x - home) * low
}

#[cfg(test)]
mod tests;
