//! Random numbers from a fixed seed.

use nalgebra::{Rotation3, Vector3};
use potential_particles::Pose;
use std::f64::consts::TAU;

/// Marsaglia's xorshift with 64 bits: a measurement needs repeatable numbers, not good ones.
pub struct Random(u64);

impl Random {
    /// Any seed but 0, which the generator would never leave.
    pub fn seeded(seed: u64) -> Self {
        assert_ne!(seed, 0, "0 is the one seed that yields nothing but 0");
        let mut random = Self(seed);
        // Small seeds start with small numbers; a few rounds mix their bits.
        for _ in 0..16 {
            random.uniform();
        }
        random
    }

    /// Uniform in [0, 1).
    pub fn uniform(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform in [low, high) on a logarithmic scale.
    pub fn log_uniform(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.uniform())
    }

    /// Whole number in [low, high).
    pub fn whole(&mut self, low: usize, high: usize) -> usize {
        low + (self.uniform() * (high - low) as f64) as usize
    }

    /// Ten to a power between `low` and `high`.
    pub fn power(&mut self, low: f64, high: f64) -> f64 {
        10f64.powf(low + (high - low) * self.uniform())
    }

    /// One of several values.
    pub fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.whole(0, of.len())]
    }

    /// Standard normal (Box and Muller).
    pub fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        radius * (TAU * self.uniform()).cos()
    }

    /// Uniform on the unit sphere.
    pub fn direction(&mut self) -> Vector3<f64> {
        Vector3::new(self.normal(), self.normal(), self.normal()).normalize()
    }

    /// The same, or on the unit circle of the plane z = 0.
    pub fn direction_in(&mut self, is_flat: bool) -> Vector3<f64> {
        if !is_flat {
            return self.direction();
        }
        let (sin, cos) = (TAU * self.uniform()).sin_cos();
        Vector3::new(cos, sin, 0.0)
    }

    /// w, x, y, z of any turn, all equally likely, or of one about z.
    pub fn turn_in(&mut self, is_flat: bool) -> [f64; 4] {
        let q = [self.normal(), self.normal(), self.normal(), self.normal()];
        if is_flat { [q[0], 0.0, 0.0, q[3]] } else { q }
    }

    /// Any orientation, all equally likely, at a position.
    pub fn pose(&mut self, position: Vector3<f64>) -> Pose {
        let quaternion = [self.normal(), self.normal(), self.normal(), self.normal()];
        Pose::new(position.into(), quaternion).expect("four normal numbers are never all zero")
    }

    /// The pose after a move by `length` and a turn by `angle`, in random directions.
    pub fn moved(&mut self, pose: &Pose, length: f64, angle: f64) -> Pose {
        let turn = Rotation3::new(angle * self.direction()).into_inner();
        Pose::from_rotation((pose.position() + length * self.direction()).into(), &(turn * pose.rotation()))
            .expect("two turns in a row")
    }
}
