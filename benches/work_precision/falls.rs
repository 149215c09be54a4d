//! How often doubles are not enough, over many calls on random pairs.

use crate::arguments::Effort;
use crate::scene::random::Random;
use crate::scene::{polyhedra, pyramids};
use indicatif::ProgressBar;
use potential_particles::{Flags, Particle, Settings, detect};
use serde::Serialize;
use std::time::{Duration, Instant};

/// Shapes in the pool of all shapes.
const SHAPES: usize = 300;
/// Enough for any count; slow calls must not make the benchmark endless.
const LIMIT: Duration = Duration::from_secs(60);
/// Calls between looks at the clock.
const BLOCK: usize = 1000;

/// Counts over cold calls that solve every pair to the end.
#[derive(Clone, Copy, Default, Serialize)]
pub struct Falls {
    pub calls: usize,
    /// Answered by the extended tier.
    pub extended: usize,
    /// Answered with a gap above the tolerance, because rounding allows no better.
    pub rounding_limited: usize,
    /// Not answered at all.
    pub failed: usize,
}

/// Pyramids of the speed part; and shapes of any k, r and number of planes.
#[derive(Serialize)]
pub struct Counts {
    pub pyramids: Falls,
    pub any_shape: Falls,
}

pub fn count(effort: &Effort, progress: &ProgressBar) -> Counts {
    progress.set_message("calls that need the extended tier");
    progress.inc_length(2 * (effort.calls / BLOCK) as u64);
    let rounded: Vec<Particle> = pyramids::ROUNDED.iter().map(|&(r, k)| pyramids::pyramid(r, k)).collect();
    let mut random = Random::seeded(31);
    let any: Vec<Particle> = (0..SHAPES).map(|_| polyhedra::any(&mut random)).collect();
    Counts { pyramids: over(&rounded, effort.calls, progress), any_shape: over(&any, effort.calls, progress) }
}

fn over(pool: &[Particle], calls: usize, progress: &ProgressBar) -> Falls {
    let settings = Settings::default().with_solve_separated(true);
    let mut random = Random::seeded(47);
    let mut falls = Falls::default();
    let begin = Instant::now();
    while falls.calls < calls && begin.elapsed() < LIMIT {
        for _ in 0..BLOCK {
            let [a, b] = [0; 2].map(|_| &pool[random.whole(0, pool.len())]);
            let distance = (0.1 + 0.9 * random.uniform()) * (a.bounding_radius() + b.bounding_radius());
            let pose_a = random.pose(nalgebra::Vector3::zeros());
            let direction = random.direction();
            let pose_b = random.pose(distance * direction);
            falls.calls += 1;
            match detect(a, &pose_a, b, &pose_b, &settings, None) {
                Ok(contact) => {
                    falls.extended += usize::from(contact.flags.contains(Flags::EXTENDED));
                    falls.rounding_limited += usize::from(contact.flags.contains(Flags::ROUNDING_LIMITED));
                }
                Err(_) => falls.failed += 1,
            }
        }
        progress.inc(1);
    }
    falls
}
