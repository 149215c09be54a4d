//! Mass properties of any particle: numbers that a body can have, and two tolerances that agree within their errors.

use super::bytes::Bytes;
use super::particle;
use potential_particles::MassProperties;

pub fn run(data: &[u8]) {
    let mut bytes = Bytes(data);
    let Ok(particle) = particle::likely(&mut bytes) else { return };
    let radius = particle.bounding_radius();
    let found = [1e-1, 1e-3].map(|tolerance| particle.mass_properties(tolerance).unwrap());
    // Beyond these a volume or moment leaves the range of numbers.
    if !(1e-60..1e60).contains(&radius) {
        return;
    }
    for mass in &found {
        holds_together(mass, radius);
    }
    let [rough, fine] = &found;
    let off = (rough.volume - fine.volume).abs();
    let allowed = rough.error * rough.volume + fine.error * fine.volume;
    assert!(off <= allowed * (1.0 + 1e-9), "volumes {off:e} apart, errors {allowed:e}: {rough:?} {fine:?}");
}

fn holds_together(mass: &MassProperties, radius: f64) {
    let ball = 4.2 * radius.powi(3);
    assert!(mass.error >= 0.0, "{mass:?}");
    assert!(mass.volume > 0.0 && mass.volume <= ball * (1.0 + mass.error), "{mass:?}, radius {radius}");
    assert!(mass.centroid.norm() <= radius * (1.0 + mass.error), "{mass:?}, radius {radius}");
    assert!((mass.inertia - mass.inertia.transpose()).amax() <= 1e-12 * mass.inertia.amax(), "{mass:?}");
    assert!(mass.inertia.trace() > 0.0, "{mass:?}");
}
