//! Mean time of a patch by family of random contacts, and how many of them need rays.

use kit::patch::bodies::Chance;
use kit::patch::families::{Case, KINDS};
use potential_particles::{PatchFlags, PatchScratch, PatchSettings};
use serde_json::{Value, json};
use std::hint::black_box;
use std::time::Instant;

const SPHERICITIES: [f64; 2] = [0.0, 0.02];
const TOLERANCE: f64 = 1e-4;

/// Of so many calls the shortest counts.
const CALLS: usize = 6;

/// r of random bodies.
const ROUNDINGS: [f64; 4] = [1e-4, 1e-2, 0.1, 0.5];

/// A row for each kind and k, and the largest part of patches that need rays though they do not fold. Patches in the
/// plane have rays alone; `in_plane` has their times.
pub fn measure(count: usize, seed: u64) -> (Vec<Value>, f64) {
    println!("mean time of a patch at {TOLERANCE:e}; seed {seed}");
    let settings = PatchSettings { tolerance: TOLERANCE, ..PatchSettings::default() };
    let (mut rows, mut most) = (Vec::new(), 0.0_f64);
    for (kind, name) in KINDS.iter().enumerate().filter(|(_, name)| **name != "polygons") {
        for k in SPHERICITIES {
            let mut chance = Chance::new(seed + kind as u64);
            let (mut seconds, mut slowest, mut rays, mut folded, mut done) = (0.0, 0.0_f64, 0, 0, 0);
            let mut scratch = PatchScratch::new();
            while done < count {
                let Some(case) = Case::of(kind, k, &ROUNDINGS, &mut chance) else { continue };
                let Some(patch) = case.patch(&settings, &mut scratch) else { continue };
                let time = |_| {
                    let begin = Instant::now();
                    black_box(case.patch(&settings, &mut scratch));
                    begin.elapsed().as_secs_f64()
                };
                let best = (0..CALLS).map(time).fold(f64::INFINITY, f64::min);
                (done, seconds, slowest) = (done + 1, seconds + best, slowest.max(best));
                let folds = patch.flags.contains(PatchFlags::FOLDED);
                folded += usize::from(folds);
                rays += usize::from(patch.rays > 0 && !folds);
            }
            let [of_rays, of_folds] = [rays, folded].map(|number| number as f64 / count as f64);
            most = most.max(of_rays);
            let [mean, slowest] = [seconds / count as f64, slowest].map(|s| 1e6 * s);
            println!(
                "{name:22} k {k:4}: {mean:6.1} µs, slowest {slowest:6.0}; rays {:4.1} %, folded {:4.1} %",
                100.0 * of_rays,
                100.0 * of_folds
            );
            rows.push(json!({"kind": name, "k": k, "microseconds": mean, "slowest": slowest, "rays": of_rays,
                "folded": of_folds}));
        }
    }
    (rows, most)
}
