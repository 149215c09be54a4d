//! What the command line says.

use clap::{Parser, ValueEnum};
use potential_particles::Settings;
use std::path::PathBuf;

/// Solves the contact of each pair of a JSON-lines file; writes one JSON line a pair.
///
/// Every pair is solved to the end, also a separated one. Points are relative to b.pos, world axes. What does not
/// apply is null.
#[derive(Parser)]
#[command(name = "solve_pairs")]
pub struct Arguments {
    /// File of pairs, or - for stdin.
    #[arg(value_name = "FILE.jsonl")]
    pub file: PathBuf,
    /// Which problem to solve.
    #[arg(long, value_enum, default_value_t = Formulation::Both)]
    pub formulation: Formulation,
    /// Who solves it.
    #[arg(long, value_enum, default_value_t = BackEnd::Fast)]
    pub back_end: BackEnd,
    /// Relative gap of s² at which to stop, in (0, 0.1]; below 1e-13 the solver goes on in extended precision.
    #[arg(long, default_value_t = Settings::default().gap_tolerance)]
    pub gap_tolerance: f64,
}

/// The problems on offer.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Formulation {
    /// Minimise t with s_A ≤ t and s_B ≤ t.
    Midway,
    /// Minimise s_A with s_B ≤ 1, and the swap.
    Closest,
    /// One after the other.
    Both,
}

/// The solvers on offer.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum BackEnd {
    /// This library's own.
    Fast,
    /// The paper's cone programs through clarabel.
    ConeProgram,
}
