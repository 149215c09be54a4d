//! The cone programs word for word as the paper writes them (eqs 34–44), handed to clarabel once.
//!
//! Unknowns s_A, x_A,c, p_A,c, s_B, x_B,c, p_B,c; world axes; no scaling but the paper's own. A user who
//! types the paper's equations into clarabel gets this. For k = 0 the cone holds no x_c, and x itself is the
//! unknown; for k = 1 it holds no p_c, and the planes have no rows: the paper's "more concise" programs.

use super::{Placed, Solution};
use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};
use nalgebra::Vector3;
use potential_particles::{Formulation, Particle, Pose};

/// clarabel's own default.
pub const DEFAULT_TOLERANCE: f64 = 1e-8;

/// Rows of M in M·z + slack = right, slack in a product of cones.
#[derive(Default)]
struct Rows {
    rows: Vec<usize>,
    columns: Vec<usize>,
    values: Vec<f64>,
    right: Vec<f64>,
}

/// Where the unknowns of one particle stand, and their weights.
struct Block<'a> {
    particle: &'a Particle,
    s: usize,
    x: usize,
    p: usize,
    planes: usize,
    /// x = w_s · x_c, p = w_p · p_c.
    w_s: f64,
    w_p: f64,
}

impl<'a> Block<'a> {
    fn new(particle: &'a Particle, first: usize) -> Self {
        let (r, k, shadow) = (particle.rounding_radius(), particle.sphericity(), particle.shadow_radius());
        Self {
            particle,
            s: first,
            x: first + 1,
            p: first + 4,
            planes: if k < 1.0 { particle.plane_count() } else { 0 },
            w_s: if k > 0.0 { shadow / k.sqrt() } else { 1.0 },
            w_p: r / (1.0 - k).sqrt(),
        }
    }

    fn end(&self) -> usize {
        self.p + self.planes
    }

    /// n·x − p ≤ d and p ≥ 0 (40–43).
    fn planes(&self, rows: &mut Rows) {
        for (i, plane) in self.particle.planes().take(self.planes).enumerate() {
            let n = self.w_s * plane.normal;
            rows.push(&[(self.x, n.x), (self.x + 1, n.y), (self.x + 2, n.z), (self.p + i, -self.w_p)], plane.offset);
            rows.push(&[(self.p + i, -1.0)], 0.0);
        }
    }

    /// ‖(p_c, x_c)‖ ≤ s (35, 36); the number of rows.
    fn cone(&self, rows: &mut Rows) -> usize {
        let start = rows.right.len();
        rows.push(&[(self.s, -1.0)], 0.0);
        for i in 0..self.planes {
            rows.push(&[(self.p + i, -1.0)], 0.0);
        }
        if self.particle.sphericity() > 0.0 {
            for i in 0..3 {
                rows.push(&[(self.x + i, -1.0)], 0.0);
            }
        }
        rows.right.len() - start
    }
}

impl Rows {
    fn push(&mut self, entries: &[(usize, f64)], right: f64) {
        for &(column, value) in entries {
            self.rows.push(self.right.len());
            self.columns.push(column);
            self.values.push(value);
        }
        self.right.push(right);
    }
}

/// One program, built and solved: midway, or the point of B closest to A. `tolerance` is clarabel's on gap and
/// feasibility.
pub fn solve(pair: &Placed, formulation: Formulation, tolerance: f64) -> Result<Solution, String> {
    let a = Block::new(pair.a, 0);
    let b = Block::new(pair.b, a.end());
    let mut rows = Rows::default();
    // Q_A x_A − Q_B x_B = c_B − c_A (37–39).
    let between = pair.pose_b.position() - pair.pose_a.position();
    for i in 0..3 {
        let of = |block: &Block, pose: &Pose, j: usize| block.w_s * pose.rotation()[(i, j)];
        let entries: Vec<(usize, f64)> = (0..3)
            .map(|j| (a.x + j, of(&a, pair.pose_a, j)))
            .chain((0..3).map(|j| (b.x + j, -of(&b, pair.pose_b, j))))
            .collect();
        rows.push(&entries, between[i]);
    }
    if formulation == Formulation::Midway {
        rows.push(&[(a.s, 1.0), (b.s, -1.0)], 0.0);
    }
    let equalities = rows.right.len();
    if formulation == Formulation::Closest {
        rows.push(&[(b.s, 1.0)], 1.0);
    }
    a.planes(&mut rows);
    b.planes(&mut rows);
    let inequalities = rows.right.len() - equalities;
    let mut cones = vec![SupportedConeT::ZeroConeT(equalities), SupportedConeT::NonnegativeConeT(inequalities)];
    cones.push(SupportedConeT::SecondOrderConeT(a.cone(&mut rows)));
    cones.push(SupportedConeT::SecondOrderConeT(b.cone(&mut rows)));
    cones.retain(|cone| !matches!(cone, SupportedConeT::NonnegativeConeT(0)));

    let unknowns = b.end();
    let mut objective = vec![0.0; unknowns];
    objective[a.s] = 1.0;
    if formulation == Formulation::Midway {
        objective[b.s] = 1.0;
    }
    let settings = DefaultSettings {
        verbose: false,
        tol_gap_abs: tolerance,
        tol_gap_rel: tolerance,
        tol_feas: tolerance,
        ..DefaultSettings::default()
    };
    let matrix = CscMatrix::new_from_triplets(rows.right.len(), unknowns, rows.rows, rows.columns, rows.values);
    let nothing = CscMatrix::zeros((unknowns, unknowns));
    let mut solver = DefaultSolver::new(&nothing, &objective, &matrix, &rows.right, &cones, settings)
        .map_err(|error| error.to_string())?;
    solver.solve();
    match solver.solution.status {
        SolverStatus::Solved | SolverStatus::AlmostSolved => {}
        status => return Err(format!("{status:?}")),
    }
    let z = &solver.solution.x;
    let s = if formulation == Formulation::Midway { 0.5 * (z[a.s] + z[b.s]) } else { z[a.s] };
    let local = b.w_s * Vector3::new(z[b.x], z[b.x + 1], z[b.x + 2]);
    Ok(Solution { s, point: pair.pose_b.rotate(&local) })
}
