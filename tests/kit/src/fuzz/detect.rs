//! Detection of any two particles at any poses, with any settings and any state: an error, or an answer that holds
//! together. How exact it is, the stress test judges.

use super::bytes::Bytes;
use super::particle;
use super::whole::Whole;
use potential_particles::{
    BackEnd, Formulation, PairState, Particle, PatchFlags, PatchScratch, PatchSettings, PatchState, Pose, Settings,
    detect,
};

pub fn run(data: &[u8]) {
    let mut bytes = Bytes(data);
    let in_plane = bytes.byte() > 190;
    let particle = if in_plane { particle::in_plane } else { particle::likely };
    let pose = if in_plane { pose_in_plane } else { pose };
    let (Ok(a), Ok(b)) = (particle(&mut bytes), particle(&mut bytes)) else { return };
    let (Some(at_a), Some(at_b)) = (pose(&mut bytes), pose(&mut bytes)) else { return };
    let mut settings = Settings::default();
    let choices = bytes.byte();
    if choices & 1 != 0 {
        settings.formulation = Formulation::Closest;
    }
    settings = settings.with_solve_separated(choices & 2 != 0);
    if choices & 4 != 0 {
        settings = Settings::NUMBERS.iter().fold(settings, |settings, (_, with)| with(settings, bytes.number()));
    }
    // Where S is beyond all numbers, the cone program is asked at length, in vain: a few such pairs are enough.
    let reach = a.bounding_radius() + b.bounding_radius();
    if choices < 250 && !((at_a.position() - at_b.position()).norm() < 1e9 * reach) {
        settings = settings.with_solve_separated(false);
    }
    let mut solution = [0.0; 8];
    for number in &mut solution {
        *number = if choices & 8 != 0 { bytes.number() } else { 0.0 };
    }
    if choices & 16 != 0 {
        solution[0] = 1.0;
    }
    let mut state = PairState::from_raw(solution);
    let first = detect(&a, &at_a, &b, &at_b, &settings, Some(&mut state));
    if settings.validate().is_err() {
        assert!(first.is_err());
        return;
    }
    let Ok(first) = first else { return };
    first.assert_whole();
    assert!(!in_plane || !(first.point.z.abs() > 0.0 || first.normal.z.abs() > 0.0), "{first:?}");
    // The cone program costs a hundred times the rest: mostly once is enough.
    if first.back_end == BackEnd::ConeProgram && choices & 96 != 0 {
        return unharmed(&a, &b);
    }
    // From what it has just remembered, and the other way round.
    if let Ok(again) = detect(&a, &at_a, &b, &at_b, &settings, Some(&mut state)) {
        again.assert_whole();
    }
    if let Ok(swapped) = detect(&b, &at_b, &a, &at_a, &settings, None) {
        swapped.assert_whole();
    }
    patches((&a, &at_a), (&b, &at_b));
    unharmed(&a, &b);
}

/// A patch and the one that follows from a state are numbers, or say that they are none.
fn patches(a: (&Particle, &Pose), b: (&Particle, &Pose)) {
    let Ok(contact) = detect(a.0, a.1, b.0, b.1, &Settings::default(), None) else { return };
    let (mut state, mut scratch, settings) = (PatchState::default(), PatchScratch::new(), PatchSettings::default());
    for _ in 0..3 {
        let Ok(patch) = state.patch_of_contact(a.0, a.1, b.0, b.1, &contact, &settings, &mut scratch) else { return };
        let is_told =
            patch.flags.contains(PatchFlags::EMPTY) || patch.flags.contains(PatchFlags::TOLERANCE_NOT_REACHED);
        assert!(is_told || patch.force.norm() > 0.0 && patch.force.norm().is_finite() && patch.area > 0.0, "{patch:?}");
        assert!(patch.error >= 0.0, "{patch:?}");
    }
}

pub fn pose(bytes: &mut Bytes) -> Option<Pose> {
    let position = if bytes.byte() < 200 { [0; 3].map(|_| 0.25 * bytes.ordinary()) } else { bytes.triple() };
    let orientation = match bytes.byte() {
        0..=60 => [1.0, 0.0, 0.0, 0.0],
        61..=200 => [0; 4].map(|_| bytes.ordinary()),
        _ => [0; 4].map(|_| bytes.number()),
    };
    Pose::new(position, orientation).ok()
}

fn pose_in_plane(bytes: &mut Bytes) -> Option<Pose> {
    let position = [0; 2].map(|_| if bytes.byte() < 200 { 0.25 * bytes.ordinary() } else { bytes.number() });
    let angle = match bytes.byte() {
        0..=60 => 0.0,
        61..=120 => std::f64::consts::FRAC_PI_2 * f64::from(bytes.byte() % 4),
        121..=220 => bytes.ordinary(),
        _ => bytes.number(),
    };
    Pose::in_plane(position, angle).ok()
}

fn unharmed(a: &Particle, b: &Particle) {
    for particle in [a, b] {
        assert!(particle.potential(&nalgebra::Vector3::zeros()) < 0.0);
    }
}
