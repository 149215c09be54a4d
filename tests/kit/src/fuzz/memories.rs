//! A pair from a memory of any bytes: where it has an answer without, it has the same one with it, and with what is
//! remembered after.

use super::bytes::Bytes;
use super::detect::pose;
use super::particle;
use super::whole::Whole;
use potential_particles::{Formulation, PairState, Settings, detect};

pub fn run(data: &[u8]) {
    let mut bytes = Bytes(data);
    let choices = bytes.byte();
    let mut state = [0; 8].map(|_| match choices & 3 {
        0 => f64::from_bits(u64::from_le_bytes([0; 8].map(|_: u8| bytes.byte()))),
        1 => bytes.ordinary() * 10f64.powi(i32::from(bytes.byte())),
        _ => bytes.number(),
    });
    if choices & 4 != 0 {
        state[0] = 1.0;
    }
    let (Ok(a), Ok(b)) = (particle::likely(&mut bytes), particle::likely(&mut bytes)) else { return };
    let (Some(at_a), Some(at_b)) = (pose(&mut bytes), pose(&mut bytes)) else { return };
    let mut settings = Settings::default().with_solve_separated(choices & 8 != 0);
    if choices & 16 != 0 {
        settings.formulation = Formulation::Closest;
    }
    // Farther apart s says little beyond that, and is beyond all numbers at last.
    let reach = a.bounding_radius() + b.bounding_radius();
    if !((at_a.position() - at_b.position()).norm() < 1e6 * reach) {
        return;
    }
    let Ok(cold) = detect(&a, &at_a, &b, &at_b, &settings, None) else { return };
    let mut memory = PairState::from_raw(state);
    for _ in 0..2 {
        let warm = detect(&a, &at_a, &b, &at_b, &settings, Some(&mut memory)).expect("an answer, as without a memory");
        warm.assert_whole();
        let wrong = crate::stress::memories::wrong(&Ok(cold), &Ok(warm));
        assert!(wrong.is_none(), "{wrong:?}: {cold:?} {warm:?}");
    }
}
