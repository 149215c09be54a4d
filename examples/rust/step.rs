// SPDX-License-Identifier: MIT OR Apache-2.0
//! Two steps of 1,000 bodies: all their pairs in one call, on two threads, first from nothing and then from state.
//!
//!     cargo run --release --example step

use potential_particles::{Flags, Kind, PairState, Particle, Plane, Pose, Settings, detect_batch};

const SIDE: i32 = 10;
const THREADS: usize = 2;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let faces =
        [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
    let cube = Particle::new(&faces.map(|[a, b, c]| Plane::from([a, b, c, 0.45])), 0.05, 0.0, 1.0)?;
    let cells: Vec<_> = (0..SIDE.pow(3)).map(|i| [i % SIDE, i / SIDE % SIDE, i / SIDE.pow(2)]).collect();
    let particles = vec![&cube; cells.len()]; // bodies of one shape share one particle
    let pairs = neighbours(&cells);
    let mut states = vec![PairState::default(); pairs.len()];
    for step in 0..2 {
        let poses = cells.iter().map(|&cell| pose(cell, step)).collect::<Result<Vec<_>, _>>()?;
        // The call itself fails only if nothing was done; each pair has a result of its own, where an error is not
        // "apart".
        let contacts = detect_batch(&particles, &poses, &pairs, &Settings::default(), THREADS, &mut states)?;
        let found: Vec<_> = contacts.iter().flatten().collect();
        let solved = found.iter().filter(|one| !one.flags.contains(Flags::REJECTED)).count();
        let overlapping = found.iter().filter(|one| one.kind == Kind::Overlapping).count();
        let failed = contacts.len() - found.len();
        println!("step {step}: {} pairs, {solved} solved, {overlapping} overlap, {failed} failed", pairs.len());
    }
    Ok(())
}

/// What a neighbour search gives: here each body of a grid with the 13 neighbours that come after it.
fn neighbours(cells: &[[i32; 3]]) -> Vec<[u32; 2]> {
    let mut pairs = Vec::new();
    for (i, [x, y, z]) in (0..).zip(cells) {
        for step in 14..27 {
            let [x, y, z] = [x + step % 3 - 1, y + step / 3 % 3 - 1, z + step / 9 - 1];
            if [x, y, z].iter().all(|one| (0..SIDE).contains(one)) {
                pairs.push([i, (x + SIDE * (y + SIDE * z)) as u32]);
            }
        }
    }
    pairs
}

/// Each body turned in its own way; from step to step it sinks a little.
fn pose(cell: [i32; 3], step: i32) -> Result<Pose, potential_particles::PoseError> {
    let [x, y, z] = cell.map(|one| 1.05 * f64::from(one));
    let turn = [0.2 * (7.0 * x + y).sin(), 0.2 * (5.0 * y + z).sin(), 0.2 * (3.0 * z + x).sin()];
    Pose::new([x, y, z - 1e-4 * f64::from(step)], [1.0, turn[0], turn[1], turn[2]])
}
