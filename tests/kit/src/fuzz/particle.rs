//! A particle of any numbers is refused, or is one: bounded, its centre inside, its surface where its box is.

use super::bytes::Bytes;
use nalgebra::Vector3;
use potential_particles::{Particle, ParticleError, Plane, Pose};

/// Most planes; the pairs of the stress test have more.
const MOST_PLANES: u8 = 40;

pub fn run(data: &[u8]) {
    let mut bytes = Bytes(data);
    let Ok(particle) = any(&mut bytes) else { return };
    assert!(particle.potential(&Vector3::zeros()) < 0.0);
    let radius = particle.bounding_radius();
    assert!(radius > 0.0 && radius.is_finite(), "radius {radius}");
    let (low, high) = particle.bounding_box(&Pose::at([0.0; 3]).expect("the origin"));
    assert!((0..3).all(|i| low[i] <= 0.0 && high[i] >= 0.0), "box {low} {high}");
    for _ in 0..6 {
        let Some(way) = Vector3::from(bytes.triple()).try_normalize(1e-100).filter(|v| v.norm().is_finite()) else {
            continue;
        };
        if let Some(distance) = particle.surface_distance(&Vector3::zeros(), &way) {
            // The centre may lie on the surface but for the last digit.
            let least = -4.0 * f64::EPSILON * radius;
            assert!(distance >= least && distance <= radius * (1.0 + 1e-9), "distance {distance}, radius {radius}");
        }
    }
}

/// Anything.
pub fn any(bytes: &mut Bytes) -> Result<Particle, ParticleError> {
    let count = bytes.byte() % MOST_PLANES;
    let planes: Vec<Plane> =
        (0..count).map(|_| Plane { normal: Vector3::from(bytes.triple()), offset: bytes.number() }).collect();
    let (r, k, shadow) = (bytes.number(), bytes.number(), bytes.number());
    Particle::new(&planes, r, k, shadow)
}

/// Mostly a particle: a box of ordinary size with more planes, a small rounding and any k.
pub fn likely(bytes: &mut Bytes) -> Result<Particle, ParticleError> {
    if bytes.byte() > 200 {
        return any(bytes);
    }
    let half = [bytes.small(), bytes.small(), bytes.small()];
    let r = bytes.small() * half.iter().copied().fold(f64::INFINITY, f64::min);
    let mut planes: Vec<Plane> = (0..3)
        .flat_map(|axis| [1.0, -1.0].map(|sign| Plane { normal: Vector3::ith(axis, sign), offset: half[axis] - r }))
        .collect();
    for _ in 0..bytes.byte() % 12 {
        let normal = Vector3::new(bytes.ordinary(), bytes.ordinary(), bytes.ordinary());
        planes.push(Plane { normal, offset: bytes.small() * normal.norm() });
    }
    let k = match bytes.byte() {
        0..=40 => 0.0,
        41..=60 => 1.0,
        _ => bytes.small(),
    };
    Particle::new(&planes, r, k, 2.0 * half.iter().copied().fold(0.0, f64::max))
}

/// In the plane: any lines, or mostly a rounded rectangle, of an area that a body can have.
pub fn in_plane(bytes: &mut Bytes) -> Result<Particle, ParticleError> {
    let particle = if bytes.byte() > 200 {
        let count = bytes.byte() % MOST_PLANES;
        let lines: Vec<[f64; 3]> = (0..count).map(|_| bytes.triple()).collect();
        let (r, k, shadow) = (bytes.number(), bytes.number(), bytes.number());
        Particle::in_plane(&lines, r, k, shadow)?
    } else {
        let (x, y) = (bytes.small(), bytes.small());
        let r = bytes.small() * x.min(y);
        let k = match bytes.byte() {
            0..=80 => 0.0,
            81..=100 => 1.0,
            _ => bytes.small(),
        };
        Particle::polygon(&[[-x, -y], [x, -y], [x, y], [-x, y]], r, k)?
    };
    let mass = particle.mass_properties(1e-2).expect("a tolerance in range");
    let circle = std::f64::consts::PI * particle.bounding_radius().powi(2);
    assert!(mass.error >= 0.0, "{mass:?}");
    // Where the error is as large as the area nothing is said of it.
    let is_told = mass.error < 1.0;
    assert!(!is_told || mass.volume > 0.0 && mass.volume <= circle * (1.0 + mass.error), "{mass:?}, {circle}");
    Ok(particle)
}
