//! Shapes to pack.

use nalgebra::Vector3;
use potential_particles::{Particle, Plane};

/// Numbers in (0, 1) that look like chance.
pub fn scattered(seed: u32) -> impl FnMut() -> f64 {
    let mut state = f64::from(seed);
    move || {
        state += 1.0;
        (1e4 * (12.9898 * state).sin()).rem_euclid(1.0)
    }
}

/// A rock of so many planes with random normals, about 1 wide, of half axes in the ratio 1 : 0.8 : 0.6.
pub fn rock(planes: usize, seed: u32) -> Particle {
    let mut chance = scattered(1000 * seed);
    let r = 0.02;
    loop {
        let faces: Vec<Plane> = (0..planes)
            .map(|_| {
                let z = 2.0 * chance() - 1.0;
                let (sin, cos) = (std::f64::consts::TAU * chance()).sin_cos();
                let across = (1.0 - z * z).sqrt();
                let normal = Vector3::new(across * cos, across * sin, z);
                // The plane that touches an ellipsoid, moved in by r.
                let offset = normal.component_mul(&Vector3::new(0.5, 0.4, 0.3)).norm() - r;
                Plane { normal, offset }
            })
            .collect();
        // Random planes may leave a rock open, or with a needle.
        match Particle::new(&faces, r, 0.0, 1.0) {
            Ok(rock) if rock.bounding_radius() < 0.8 => return rock,
            _ => continue,
        }
    }
}
