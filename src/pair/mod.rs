//! Two particles in one frame.

pub mod body;
pub mod boundary_part;
pub mod extended_body;
pub mod local_point;
pub mod pair;
pub mod pair_state;
pub mod role;
pub mod separation;

/// Numbers in (−1, 1) that look like chance, for tests.
#[cfg(test)]
fn scattered(seed: usize) -> impl FnMut() -> f64 {
    let mut state = seed as f64;
    move || {
        state += 1.0;
        2.0 * (1e4 * (12.9898 * state).sin()).rem_euclid(1.0) - 1.0
    }
}
