//! Particles of the plane of any numbers: refused, or pairs whose answers hold together, and batches that are single
//! calls.

use super::bytes::Bytes;
use super::whole::Whole;
use potential_particles::planar::{Line, Particle, Pose, detect, detect_batch};
use potential_particles::{Formulation, PairState, ParticleError, Settings};

/// Most lines.
const MOST_LINES: u8 = 16;

pub fn run(data: &[u8]) {
    let mut bytes = Bytes(data);
    let (Ok(a), Ok(b)) = (particle(&mut bytes), particle(&mut bytes)) else { return };
    for particle in [&a, &b] {
        let area = particle.area_properties(1e-2).expect("a tolerance in range");
        let circle = std::f64::consts::PI * particle.bounding_radius().powi(2);
        assert!(area.error >= 0.0, "{area:?}");
        // Where the error is as large as the area nothing is said of it.
        assert!(area.error >= 1.0 || area.area > 0.0 && area.area <= circle * (1.0 + area.error), "{area:?}, {circle}");
    }
    let (Some(at_a), Some(at_b)) = (pose(&mut bytes), pose(&mut bytes)) else { return };
    let choices = bytes.byte();
    let mut settings = Settings::default();
    if choices & 1 != 0 {
        settings.formulation = Formulation::Closest;
    }
    settings = settings.with_solve_separated(choices & 2 != 0);
    if choices & 4 != 0 {
        settings.gap_tolerance = 10f64.powi(-i32::from(bytes.byte() % 17));
    }
    let mut memory = PairState::from_raw([0; 8].map(|_| if choices & 8 != 0 { bytes.number() } else { 0.0 }));
    let first = detect(&a, &at_a, &b, &at_b, &settings, None);
    if settings.validate().is_err() {
        assert!(first.is_err());
        return;
    }
    let batch = detect_batch(&[&a, &b], &[at_a, at_b], &[[0, 1]], &settings, 1, &mut []).expect("lengths that fit");
    assert_eq!(first.is_ok(), batch[0].is_ok());
    let Ok(first) = first else { return };
    first.assert_whole();
    if let Ok(warm) = detect(&a, &at_a, &b, &at_b, &settings, Some(&mut memory)) {
        warm.assert_whole();
    }
}

fn particle(bytes: &mut Bytes) -> Result<Particle, ParticleError> {
    let choice = bytes.byte();
    if choice > 200 {
        let count = bytes.byte() % MOST_LINES;
        let lines: Vec<Line> =
            (0..count).map(|_| Line::from([bytes.number(), bytes.number(), bytes.number()])).collect();
        let (r, k, shadow) = (bytes.number(), bytes.number(), bytes.number());
        return Particle::new(&lines, r, k, shadow);
    }
    let (width, height) = (bytes.small(), bytes.small());
    let r = 0.5 * bytes.small() * width.min(height);
    let k = match bytes.byte() {
        0..=80 => 0.0,
        81..=100 => 1.0,
        _ => bytes.small(),
    };
    Particle::rectangle(width, height, r, k)
}

fn pose(bytes: &mut Bytes) -> Option<Pose> {
    let position = if bytes.byte() < 200 {
        [0.25 * bytes.ordinary(), 0.25 * bytes.ordinary()]
    } else {
        [bytes.number(), bytes.number()]
    };
    let angle = match bytes.byte() {
        0..=60 => 0.0,
        61..=120 => std::f64::consts::FRAC_PI_2 * f64::from(bytes.byte() % 4),
        121..=220 => bytes.ordinary(),
        _ => bytes.number(),
    };
    Pose::new(position, angle).ok()
}
