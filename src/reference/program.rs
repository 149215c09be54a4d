//! One second-order cone program: its rows and cones, and clarabel's answer.
//!
//! clarabel solves: minimise q·z subject to M·z + slack = b, slack in a product of cones. Columns of
//! M, in units that make them of order 1 (h the length unit, T_A and T_B the units of s):
//!
//! ```text
//! 0                head / T          t, or s of the objective
//! 1–3, 4–6         δ_A, δ_B          x = x₀ + h·δ, local frame of each particle
//! 7 …              √(1−k)/r · p / T  one for each plane that the box can reach, A then B
//! ```
//!
//! Rows, in order: three ties (zero cone); for each plane its row and p ≥ 0, then six for the box
//! (non-negative cone); one second-order cone for each particle.
//!
//! For particles of the plane this becomes eqs 19–31: z is no unknown, so that δ has two columns, and there
//! are two ties, four rows for the box and two entries of x in a cone. (With k = 0 nothing would hold z.)

use super::goal::Goal;
use super::solution::ConeProgramError;
use crate::pair::pair::Pair;
use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};
use nalgebra::Vector3;
use std::ops::Range;

/// The settings of clarabel that differ from its defaults.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tuning {
    /// Gap at which a program is solved.
    pub tolerance: f64,
    /// Residuals at which a program is solved.
    pub feasibility: f64,
    /// Gap and residuals at which a program is almost solved.
    pub almost: f64,
    /// Whether clarabel rescales rows and columns.
    pub equilibrate: bool,
    /// Static regularisation of the KKT matrix.
    pub regularisation: f64,
    /// Where iterative refinement of a KKT solve stops, relative.
    pub refine_relative: f64,
    /// Where iterative refinement of a KKT solve stops, absolute.
    pub refine_absolute: f64,
}

/// clarabel's answer.
#[derive(Clone, Copy, Debug)]
pub(super) struct Answer {
    /// Step of the point from x₀, frame of B, length.
    pub step: Vector3<f64>,
    /// Objective, in its unit.
    pub head: f64,
    /// Dual objective, in the same unit: a lower bound inside the box.
    pub dual: f64,
    /// By how much the box and the dual residual can lower that bound for each half-width of the box beyond it.
    pub pull: f64,
    /// Duals of the heads of the two cones.
    pub heads: [f64; 2],
    /// Interior-point iterations.
    pub iterations: u32,
    /// Why clarabel stopped.
    pub status: SolverStatus,
}

/// A program in the form that clarabel takes.
pub(super) struct Program {
    rows: Vec<usize>,
    columns: Vec<usize>,
    values: Vec<f64>,
    right: Vec<f64>,
    cones: Vec<SupportedConeT<f64>>,
    variables: usize,
    heads: [usize; 2],
    /// The rows of the box, or none.
    box_rows: Range<usize>,
    /// Columns of δ_B.
    point: Range<usize>,
    unit: f64,
}

impl Program {
    /// The program of the whole particles, local coordinates about their centres, no box.
    pub fn whole(pair: &Pair, goal: Goal, unit: f64, scales: [f64; 2]) -> Self {
        Self::build(pair, goal, [Vector3::zeros(); 2], &(pair.centre / unit), unit, f64::INFINITY, scales)
    }

    /// The program of the correction to x, frame of B, inside the box of half-width `half`.
    pub fn correction(pair: &Pair, goal: Goal, x: &Vector3<f64>, half: f64, scales: [f64; 2]) -> Self {
        // Half the diagonal of the box, with a margin for rounding: how far any point of it is from x.
        let reach = 1.001 * (pair.b.dimensions as f64).sqrt() * half;
        // The local point of A is by definition that of x: no tie is left over.
        Self::build(pair, goal, [pair.in_a(x), *x], &Vector3::zeros(), half, reach, scales)
    }

    fn build(
        pair: &Pair,
        goal: Goal,
        origins: [Vector3<f64>; 2],
        untied: &Vector3<f64>,
        unit: f64,
        reach: f64,
        scales: [f64; 2],
    ) -> Self {
        let dimensions = pair.b.dimensions;
        // First columns of δ_A and δ_B, and the entries of v·δ in a row.
        let firsts = [1, 1 + dimensions];
        let along = |side: usize, v: &Vector3<f64>| -> Vec<(usize, f64)> {
            (0..dimensions).map(|j| (firsts[side] + j, v[j])).collect()
        };
        let mut program = Self {
            rows: Vec::new(),
            columns: Vec::new(),
            values: Vec::new(),
            right: Vec::new(),
            cones: Vec::new(),
            variables: 1 + 2 * dimensions,
            heads: [0; 2],
            box_rows: 0..0,
            point: firsts[1]..firsts[1] + dimensions,
            unit,
        };
        for i in 0..dimensions {
            let mut row = along(0, &pair.rotation.row(i).transpose());
            row.push((firsts[1] + i, -1.0));
            program.row(&row, -untied[i]);
        }
        program.cone_since(0, SupportedConeT::ZeroConeT);

        let start = program.right.len();
        let mut columns = [0..0, 0..0];
        for (side, particle) in [pair.a, pair.b].into_iter().enumerate() {
            let first = program.variables;
            // One unit of the scaled p as a length, in units of h.
            let length = scales[side] / (particle.plane_weight.sqrt() * unit);
            let planes = if particle.plane_weight > 0.0 { particle.plane_count() } else { 0 };
            for i in 0..planes {
                let n = particle.normal(i);
                let norm = n.norm();
                let slack = particle.offset(i) - n.dot(&origins[side]);
                if slack > norm * reach {
                    continue;
                }
                let p = program.variables;
                let mut row = along(side, &(n / norm));
                row.push((p, -length / norm));
                program.row(&row, slack / (norm * unit));
                program.row(&[(p, -1.0)], 0.0);
                program.variables += 1;
            }
            columns[side] = first..program.variables;
        }
        if reach.is_finite() {
            let first = program.right.len();
            program.box_rows = first..first + 2 * dimensions;
            for column in program.point.clone() {
                program.row(&[(column, 1.0)], 1.0);
                program.row(&[(column, -1.0)], 1.0);
            }
        }
        program.cone_since(start, SupportedConeT::NonnegativeConeT);

        for (side, particle) in [pair.a, pair.b].into_iter().enumerate() {
            let start = program.right.len();
            program.heads[side] = start;
            if goal.holds(side) {
                program.row(&[], 1.0 / scales[side]);
            } else {
                program.row(&[(0, -1.0)], 0.0);
            }
            for column in columns[side].clone() {
                program.row(&[(column, -1.0)], 0.0);
            }
            if particle.sphere_weight > 0.0 {
                let weight = particle.sphere_weight.sqrt() / scales[side];
                for (j, origin) in origins[side].iter().take(dimensions).enumerate() {
                    program.row(&[(firsts[side] + j, -weight * unit)], weight * origin);
                }
            }
            program.cone_since(start, SupportedConeT::SecondOrderConeT);
        }
        program
    }

    /// Appends a row; zero entries are left out of the sparse matrix.
    fn row(&mut self, entries: &[(usize, f64)], right: f64) {
        for &(column, value) in entries {
            if value != 0.0 {
                self.rows.push(self.right.len());
                self.columns.push(column);
                self.values.push(value);
            }
        }
        self.right.push(right);
    }

    /// Closes the rows from `start` on with a cone, if there are any.
    fn cone_since(&mut self, start: usize, cone: fn(usize) -> SupportedConeT<f64>) {
        if self.right.len() > start {
            self.cones.push(cone(self.right.len() - start));
        }
    }

    /// Solves the program with clarabel.
    pub fn run(self, tuning: &Tuning) -> Result<Answer, ConeProgramError> {
        let n = self.variables;
        let matrix = CscMatrix::new_from_triplets(self.right.len(), n, self.rows, self.columns, self.values);
        let mut objective = vec![0.0; n];
        objective[0] = 1.0;
        let settings = DefaultSettings {
            verbose: false,
            presolve_enable: false,
            tol_gap_abs: tuning.tolerance,
            tol_gap_rel: tuning.tolerance,
            tol_feas: tuning.feasibility,
            tol_ktratio: 1e-8,
            reduced_tol_gap_abs: tuning.almost,
            reduced_tol_gap_rel: tuning.almost,
            reduced_tol_feas: tuning.almost,
            equilibrate_enable: tuning.equilibrate,
            static_regularization_constant: tuning.regularisation,
            iterative_refinement_reltol: tuning.refine_relative,
            iterative_refinement_abstol: tuning.refine_absolute,
            ..DefaultSettings::default()
        };
        let nothing = CscMatrix::zeros((n, n));
        let mut solver = DefaultSolver::new(&nothing, &objective, &matrix, &self.right, &self.cones, settings)
            .map_err(|error| ConeProgramError::Refused(error.to_string()))?;
        solver.solve();
        let solution = &solver.solution;
        let mut step = Vector3::zeros();
        for (coordinate, value) in step.iter_mut().zip(&solution.x[self.point]) {
            *coordinate = value * self.unit;
        }
        Ok(Answer {
            step,
            head: solution.obj_val,
            dual: solution.obj_val_dual,
            pull: solution.z[self.box_rows].iter().sum::<f64>() + solution.r_dual,
            heads: self.heads.map(|row| solution.z[row]),
            iterations: solution.iterations,
            status: solution.status,
        })
    }
}
