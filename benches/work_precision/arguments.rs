//! What the command line says.

use clap::Parser;
use std::path::PathBuf;

/// Run time against error: writes work_precision.csv and summary.json, prints each target beside what was measured.
#[derive(Parser)]
pub struct Arguments {
    /// Folder for the results.
    #[arg(long, default_value = "out/bench")]
    pub out: PathBuf,
    /// Debian's YADE, for its built-in functor.
    #[arg(long, default_value = "/usr/bin/yade")]
    pub yade: PathBuf,
    /// A part of the pairs and rounds: to see that it runs, not to publish.
    #[arg(long)]
    quick: bool,
    /// Given by "cargo bench" to every benchmark.
    #[arg(long, hide = true)]
    bench: bool,
}

/// How much to measure.
pub struct Effort {
    /// Pyramid pairs of each rounding.
    pub pyramids: usize,
    /// Pairs of each plane count.
    pub polyhedra: usize,
    /// Pairs that YADE's built-in and clarabel are given in the speed part.
    pub slow: usize,
    /// Rounds over all contestants; the median of the rounds counts.
    pub rounds: usize,
    /// Every how many-th truth pair is used.
    pub stride: usize,
    /// Calls over which those are counted that need the extended tier.
    pub calls: usize,
}

impl Arguments {
    pub fn effort(&self) -> Effort {
        if self.quick {
            Effort { pyramids: 50, polyhedra: 10, slow: 5, rounds: 3, stride: 7, calls: 20_000 }
        } else {
            Effort { pyramids: 500, polyhedra: 100, slow: 25, rounds: 9, stride: 1, calls: 1_000_000 }
        }
    }
}
