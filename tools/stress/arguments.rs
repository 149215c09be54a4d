//! What the command line says.

use clap::Parser;
use std::hash::{BuildHasher, Hasher, RandomState};
use std::path::PathBuf;

/// The parts of a run that draw cases by index.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Part {
    Poses,
    Walls,
    Seams,
    Memories,
    Mass,
    Patches,
    Hulls,
}

/// Random pairs over everything that can be written down, judged without a known answer; then walks and sweeps.
///
/// Ends with exit code 1 if anything failed. Interrupted, it writes what it has.
#[derive(Parser, Clone)]
#[command(name = "stress")]
pub struct Arguments {
    /// Poses.
    #[arg(long, default_value_t = 1_000_000)]
    pub poses: u64,
    /// Contacts with planes and triangles; by default one for each ten poses.
    #[arg(long)]
    pub walls: Option<u64>,
    /// Meshes whose triangles share edges and vertices; by default one for each twenty poses.
    #[arg(long)]
    pub seams: Option<u64>,
    /// Pairs that are solved from memories of any bytes; by default one for each twenty poses.
    #[arg(long)]
    pub memories: Option<u64>,
    /// The pairs depend on this number and their index only; without it a seed is drawn, and printed first.
    #[arg(long)]
    pub seed: Option<u64>,
    /// Index of the first pose; by default 0, and with --settle-every 10^13, from where on 512 poses share their
    /// shapes.
    #[arg(long)]
    pub first: Option<u64>,
    /// Settle one pose in this many in 32 digits, and those that look doubtful; the others are judged by definition.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..))]
    pub settle_every: u64,
    /// Threads; 0: as many as there are cores.
    #[arg(long, default_value_t = 0)]
    pub threads: usize,
    /// Random walks of 1,000 steps; by default one for each 10,000 poses.
    #[arg(long)]
    pub walks: Option<u64>,
    /// Leave the continuity sweeps out.
    #[arg(long)]
    pub no_sweeps: bool,
    /// Particles, of space and of the plane, whose volume, centroid and inertia are held against closed forms or a
    /// finer tolerance; by default one for each thousand poses.
    #[arg(long)]
    pub mass: Option<u64>,
    /// Pairs whose patches are held against brute force; by default one for each thousand poses.
    #[arg(long)]
    pub patches: Option<u64>,
    /// Hulls of points and bodies of half-spaces that are held against exact arithmetic; by default one for each ten
    /// poses.
    #[arg(long)]
    pub hulls: Option<u64>,
    /// Only this family of pairs.
    #[arg(long)]
    pub family: Option<String>,
    /// Judge this one case, say all about it, and write it as JSON: a pose as a line for solve_pairs.
    #[arg(long, value_name = "INDEX", requires = "seed")]
    pub replay: Option<u64>,
    /// Which part the case to replay is of.
    #[arg(long, value_enum, default_value_t = Part::Poses)]
    pub of: Part,
    /// Folder of the results.
    #[arg(long, default_value = "out/stress")]
    pub output: PathBuf,
}

/// A seed that no earlier run has had, short enough to be typed again.
pub fn fresh_seed() -> u64 {
    RandomState::new().build_hasher().finish() % 1_000_000_000
}
