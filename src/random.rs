//! Random numbers: a stream of its own for each body of a packing, so that no result depends on which thread drew
//! first.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use rand_pcg::Pcg64;
use rand_pcg::rand_core::{RngCore, SeedableRng};
use std::f64::consts::TAU;

/// 2⁶⁴ over the golden ratio, odd: its multiples spread the streams of a seed over all seeds.
const SPREAD: u64 = 0x9e37_79b9_7f4a_7c15;

pub(crate) struct Random(Pcg64);

impl Random {
    /// Stream number `stream` of a seed.
    pub fn new(seed: u64, stream: u64) -> Self {
        Self(Pcg64::seed_from_u64(seed.wrapping_add(stream.wrapping_mul(SPREAD))))
    }

    /// Uniform in [0, 1).
    pub fn uniform(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform in [low, high).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.uniform()
    }

    /// Uniform in 0..count.
    pub fn below(&mut self, count: usize) -> usize {
        ((self.uniform() * count as f64) as usize).min(count - 1)
    }

    /// Uniform on the unit sphere: z is uniform (Archimedes).
    pub fn direction(&mut self) -> Vector3<f64> {
        let z = self.between(-1.0, 1.0);
        let (sin, cos) = (TAU * self.uniform()).sin_cos();
        let across = (1.0 - z * z).sqrt();
        Vector3::new(across * cos, across * sin, z)
    }

    /// Any orientation, all equally likely (Shoemake 1992).
    pub fn orientation(&mut self) -> UnitQuaternion<f64> {
        let share = self.uniform();
        let ((a, b), (c, d)) = ((TAU * self.uniform()).sin_cos(), (TAU * self.uniform()).sin_cos());
        let (first, second) = ((1.0 - share).sqrt(), share.sqrt());
        UnitQuaternion::new_normalize(Quaternion::new(first * a, first * b, second * c, second * d))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mean of the rotation of e_z onto itself is 0, and of its square 1/3, as of a uniform direction.
    #[test]
    fn directions_and_orientations_are_uniform() {
        let count = 20_000;
        let mut random = Random::new(5, 0);
        let mut sums = [[0.0; 2]; 2];
        for _ in 0..count {
            let z = [random.direction().z, (random.orientation() * Vector3::z()).z];
            for (sum, z) in sums.iter_mut().zip(z) {
                sum[0] += z;
                sum[1] += z * z;
            }
        }
        for [first, second] in sums.map(|sum| sum.map(|value| value / f64::from(count))) {
            // Four standard deviations.
            assert!(first.abs() < 4.0 * (1.0 / 3.0 / f64::from(count)).sqrt(), "{first}");
            assert!((second - 1.0 / 3.0).abs() < 4.0 * (4.0 / 45.0 / f64::from(count)).sqrt(), "{second}");
        }
    }

    #[test]
    fn streams_differ() {
        let first = |seed, stream| Random::new(seed, stream).uniform();
        assert_ne!(first(1, 0), first(1, 1));
        assert_ne!(first(1, 0), first(2, 0));
        assert_eq!(first(1, 7), first(1, 7));
    }
}
