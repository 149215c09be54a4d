//! The pyramid on which the speed is stated: five planes, size 1.

use nalgebra::Vector3;
use potential_particles::{Particle, Plane};

/// r/size and k of the measured pyramids.
pub const ROUNDED: [(f64, f64); 3] = [(5e-3, 0.05), (1e-2, 0.05), (5e-2, 0.05)];

/// r/size and k of the nearly polyhedral pyramids.
pub const SHARP: (f64, f64) = (1e-6, 1e-6);

/// Base 0.92 × 0.92 and height 0.92 with rounding; the finished faces stay where they are as r changes.
pub fn pyramid(r: f64, k: f64) -> Particle {
    let length = 5f64.sqrt();
    let side = |x: f64, y: f64| Plane { normal: Vector3::new(2.0 * x, 2.0 * y, 1.0) / length, offset: 0.3 - r };
    let base = Plane { normal: -Vector3::z(), offset: 0.25 - r };
    let planes = [side(1.0, 0.0), side(-1.0, 0.0), side(0.0, 1.0), side(0.0, -1.0), base];
    Particle::new(&planes, r, k, 0.9).expect("a pyramid around the origin")
}
