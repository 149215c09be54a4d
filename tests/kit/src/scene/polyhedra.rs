//! Particles of any number of planes.

use crate::random::Random;
use nalgebra::Vector3;
use potential_particles::{Particle, Plane};
use std::f64::consts::TAU;

/// Plane counts over which growth is measured.
pub const PLANE_COUNTS: [usize; 6] = [4, 10, 30, 100, 300, 1000];

/// Largest offset of a plane above the least, relative.
const JITTER: f64 = 0.05;

/// Planes with normals on a golden spiral, offsets about 0.5: radius 0.5, r = 0.01, k = 0.05.
///
/// The spiral spreads any number of points evenly; the jitter of the offsets makes faces of all sizes and,
/// among many planes, hides some of them behind their neighbours.
pub fn ball(planes: usize, random: &mut Random) -> Particle {
    let golden = TAU / ((1.0 + 5f64.sqrt()) / 2.0);
    let planes: Vec<Plane> = (0..planes)
        .map(|i| {
            let z = 1.0 - (2 * i + 1) as f64 / planes as f64;
            let (sin, cos) = (golden * i as f64).sin_cos();
            let across = (1.0 - z * z).sqrt();
            let normal = Vector3::new(across * cos, across * sin, z);
            Plane { normal, offset: 0.49 * (1.0 + JITTER * random.uniform()) }
        })
        .collect();
    Particle::new(&planes, 0.01, 0.05, 0.9).expect("planes around the origin")
}

/// Any shape that a user may write down: 4 to 24 planes, r over six decades, k over six and now and then 0.
pub fn any(random: &mut Random) -> Particle {
    let r = random.log_uniform(1e-7, 0.1);
    let k = if random.uniform() < 0.1 { 0.0 } else { random.log_uniform(1e-7, 0.9) };
    let count = random.whole(4, 25);
    loop {
        let planes: Vec<Plane> = (0..count)
            .map(|_| Plane { normal: random.direction(), offset: 0.5 * random.log_uniform(0.3, 1.0) })
            .collect();
        // With k = 0 the planes alone must enclose a volume; few random ones often do not.
        if let Ok(particle) = Particle::new(&planes, r, k, 0.9) {
            return particle;
        }
    }
}
