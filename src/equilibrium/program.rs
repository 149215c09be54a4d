//! One cone program of associated flow, solved by clarabel.
//!
//! The unknowns are the velocities v of the free bodies; the forces at the points are the multipliers of its cones.
//! With u the velocity of the second body relative to the first at a point, u_n along the normal and u_t across it:
//!
//! ```text
//! minimise    −w·v + Σ (C y + T (u_n − m y)) + Σ ½ |q|²    over v, y, q  (q in the question whether it stands alone)
//! subject to  w'·v − Σ C' y = 1                            (not in that question)
//!             |u_t + q_t| ≤ y,  m y ≤ u_n + q_n            at each point
//! multipliers of the cones: the force f on the second body, |t| ≤ C + φ C' + m n,  n ≥ −T
//! ```
//!
//! Optimality of v is E f + w + φ w' = 0, the equilibrium of all bodies, with φ the multiplier of the normalisation:
//! the largest φ or, with the signs of its row turned, the least. Optimality of q is f = q: the forces of the least
//! norm. The program has 6 unknowns a body, where the one in the forces has 3 a point, and eliminating its cones leaves
//! a matrix with the pattern of the contacts. Where T m ≥ C and C' = 0, the row of n adds nothing: then
//! y = (u_n + q_n)/m. Points without cohesion and tension that are no corners add nothing and are left out.

use super::assembly::{Assembly, Joint, Point};
use super::error::EquilibriumError;
use super::numbers::{ATTEMPTS, MANY, NO_STRENGTH, REDUCED, STALLED};
use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultInfo, DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};
use nalgebra::Vector3;

/// Strength of a point: |t| ≤ base + φ growth + slope n, n ≥ −tension, units of force.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Cone {
    pub slope: f64,
    pub base: f64,
    pub growth: f64,
    pub tension: f64,
}

/// What is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Goal {
    /// The least norm of forces; φ = 0.
    Rest,
    /// The largest φ on the live loads.
    Load,
    /// The least φ on the growth of strength.
    Strength,
}

/// What a program says.
pub(super) enum Outcome {
    Solved(Solved),
    /// No forces at all are in equilibrium: these scaled velocities prove it.
    Falls(Vec<f64>),
    /// No motion is bound by what φ multiplies: φ has no limit.
    Unlimited,
}

/// Forces and velocities.
pub(super) struct Solved {
    /// φ.
    pub factor: f64,
    /// (n, t₁, t₂) at each point, units of force.
    pub forces: Vec<Vector3<f64>>,
    /// Scaled velocities.
    pub velocities: Vec<f64>,
}

/// How a point stands in the program: its first row, or none.
enum Rows {
    None,
    /// u_n ≥ 0.
    Smooth(usize),
    /// (u_n, m u_t) in the cone.
    Cone(usize),
    /// (y, u_t) in the cone, and u_n − m y ≥ 0 in a row of its own.
    Cut(usize, usize),
}

#[derive(Default)]
struct Program {
    rows: Vec<usize>,
    columns: Vec<usize>,
    values: Vec<f64>,
    right: Vec<f64>,
    cones: Vec<SupportedConeT<f64>>,
    cost: Vec<f64>,
    /// Diagonal of the quadratic form.
    squares: Vec<(usize, f64)>,
    /// Of each point.
    places: Vec<Rows>,
}

/// Solves the program of a goal.
///
/// # Errors
/// `NotConverged`.
pub(super) fn solve(assembly: &Assembly, strengths: &[Cone], goal: Goal) -> Result<Outcome, EquilibriumError> {
    let free = assembly.dead.len();
    let mut program = Program { cost: assembly.dead.iter().map(|load| -load).collect(), ..Program::default() };
    let mut normalisation: Vec<(usize, f64)> = Vec::new();
    // The row of the normalisation, with its signs turned for the least φ.
    let sign = if goal == Goal::Strength { -1.0 } else { 1.0 };
    if goal == Goal::Load {
        normalisation.extend(assembly.live.iter().enumerate().map(|(column, load)| (column, *load)));
    }
    for (place, strength) in assembly.each_point().zip(strengths) {
        program.point(place, strength, goal == Goal::Rest, |y| normalisation.push((y, -strength.growth)));
    }
    if goal != Goal::Rest {
        program.row(normalisation.into_iter().map(|(column, value)| (column, sign * value)), -1.0);
        program.cones.push(SupportedConeT::ZeroConeT(1));
    }
    program.run(strengths, goal, free, sign)
}

impl Program {
    /// Appends the row right + Σ value x, which is to lie in the next cone.
    fn row(&mut self, entries: impl IntoIterator<Item = (usize, f64)>, right: f64) {
        for (column, value) in entries.into_iter().filter(|(_, value)| *value != 0.0) {
            self.rows.push(self.right.len());
            self.columns.push(column);
            self.values.push(-value);
        }
        self.right.push(right);
    }

    fn unknown(&mut self, cost: f64) -> usize {
        self.cost.push(cost);
        self.cost.len() - 1
    }

    /// The unknown q of ½ q² + f q.
    fn pulled(&mut self, force: f64) -> usize {
        let column = self.unknown(force);
        self.squares.push((column, 1.0));
        column
    }

    fn point(&mut self, (joint, point): (&Joint, &Point), strength: &Cone, is_pulled: bool, grows: impl FnOnce(usize)) {
        let Cone { slope, base, growth, tension } = *strength;
        if !point.counts() {
            return self.places.push(Rows::None);
        }
        let is_smooth = slope <= 0.0 && base <= NO_STRENGTH && growth <= NO_STRENGTH;
        let is_cone = slope > 0.0 && growth == 0.0 && tension * slope >= base;
        // The multiplier of the normal's row is n + shift: its cone has its apex at n = -shift.
        let shift = if is_cone { base / slope } else { tension };
        // Columns of q in the order of the frame.
        let q = is_pulled.then(|| [shift, 0.0, 0.0].map(|part| self.pulled(part)));
        let along = |axis: usize, factor: f64| {
            let of_bodies = joint.relative(point, axis).map(|(column, value)| (column, factor * value));
            let mut entries: Vec<(usize, f64)> = of_bodies.collect();
            if let Some(columns) = q {
                entries.push((columns[axis], factor));
            }
            entries
        };
        let first = self.right.len();
        if is_smooth {
            joint.relative(point, 0).for_each(|(column, value)| self.cost[column] += tension * value);
            self.row(along(0, 1.0), 0.0);
            self.cones.push(SupportedConeT::NonnegativeConeT(1));
            return self.places.push(Rows::Smooth(first));
        }
        if is_cone {
            joint.relative(point, 0).for_each(|(column, value)| self.cost[column] += shift * value);
            self.row(along(0, 1.0), 0.0);
            self.row(along(1, slope), 0.0);
            self.row(along(2, slope), 0.0);
            self.cones.push(SupportedConeT::SecondOrderConeT(3));
            return self.places.push(Rows::Cone(first));
        }
        let y = self.unknown(base - tension * slope);
        grows(y);
        joint.relative(point, 0).for_each(|(column, value)| self.cost[column] += tension * value);
        self.row([(y, 1.0)], 0.0);
        self.row(along(1, 1.0), 0.0);
        self.row(along(2, 1.0), 0.0);
        self.cones.push(SupportedConeT::SecondOrderConeT(3));
        let mut opening = along(0, 1.0);
        opening.push((y, -slope));
        self.row(opening, 0.0);
        self.cones.push(SupportedConeT::NonnegativeConeT(1));
        self.places.push(Rows::Cut(first, first + 3));
    }

    fn run(self, strengths: &[Cone], goal: Goal, free: usize, sign: f64) -> Result<Outcome, EquilibriumError> {
        let count = self.cost.len();
        let matrix = CscMatrix::new_from_triplets(self.right.len(), count, self.rows, self.columns, self.values);
        let (at, of): (Vec<usize>, Vec<f64>) = self.squares.into_iter().unzip();
        let form = CscMatrix::new_from_triplets(count, count, at.clone(), at, of);
        let settings = |(tolerance, regularisation): (f64, f64)| DefaultSettings {
            verbose: false,
            presolve_enable: false,
            tol_gap_abs: tolerance,
            tol_gap_rel: tolerance,
            tol_feas: tolerance,
            reduced_tol_gap_abs: REDUCED,
            reduced_tol_gap_rel: REDUCED,
            reduced_tol_feas: REDUCED,
            static_regularization_constant: regularisation,
            max_threads: 1,
            ..DefaultSettings::default()
        };
        let is_large = free > 6 * MANY;
        let failed = |status: String| EquilibriumError::NotConverged { status };
        let attempt = |tuning: (f64, f64)| {
            let mut solver = DefaultSolver::new(&form, &self.cost, &matrix, &self.right, &self.cones, settings(tuning))
                .map_err(|error| failed(error.to_string()))?;
            if is_large {
                let (mut least, mut since) = (f64::INFINITY, 0);
                solver.set_termination_callback(move |now: &DefaultInfo<f64>| {
                    let off = now.res_primal.max(now.res_dual).max(now.gap_abs.min(now.gap_rel));
                    if off < 0.5 * least {
                        (least, since) = (off, now.iterations);
                    }
                    least <= REDUCED && now.iterations >= since + STALLED
                });
            }
            solver.solve();
            Ok(solver.solution)
        };
        let is_answer = |status| {
            use SolverStatus::{AlmostSolved, CallbackTerminated, DualInfeasible, PrimalInfeasible, Solved};
            matches!(status, Solved | AlmostSolved | CallbackTerminated | DualInfeasible | PrimalInfeasible)
        };
        let tunings = &ATTEMPTS[usize::from(is_large)..];
        let mut solution = attempt(tunings[0])?;
        for tuning in &tunings[1..] {
            if !is_answer(solution.status) {
                solution = attempt(*tuning)?;
            }
        }
        match solution.status {
            SolverStatus::Solved | SolverStatus::AlmostSolved | SolverStatus::CallbackTerminated => {}
            SolverStatus::DualInfeasible => return Ok(Outcome::Falls(solution.x[..free].to_vec())),
            SolverStatus::PrimalInfeasible => return Ok(Outcome::Unlimited),
            status => return Err(failed(format!("{status:?}"))),
        }
        let force = |(place, strength): (&Rows, &Cone)| {
            let z = |row: usize| solution.z[row];
            let Cone { slope, base, tension, .. } = *strength;
            match *place {
                Rows::None => Vector3::zeros(),
                Rows::Smooth(row) => Vector3::new(z(row) - tension, 0.0, 0.0),
                Rows::Cone(row) => Vector3::new(z(row) - base / slope, slope * z(row + 1), slope * z(row + 2)),
                Rows::Cut(row, own) => Vector3::new(z(own) - tension, z(row + 1), z(row + 2)),
            }
        };
        let forces: Vec<_> = self.places.iter().zip(strengths).map(force).collect();
        // The row of the normalisation is the last one.
        let factor = if goal == Goal::Rest { 0.0 } else { sign * solution.z[self.right.len() - 1] };
        Ok(Outcome::Solved(Solved { factor, forces, velocities: solution.x[..free].to_vec() }))
    }
}
