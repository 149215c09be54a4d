//! What is minimised, and what is held.

use super::solution::Role;
use crate::pair::pair::Pair;
use crate::particle::potential;
use nalgebra::Vector3;

/// The objective and the constraints of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Goal {
    Midway,
    /// s of this particle is held at ≤ 1, that of the other is minimised.
    Constrained(Role),
}

impl Goal {
    /// The objective, from s of both particles.
    pub fn objective(self, s: [f64; 2]) -> f64 {
        match self {
            Self::Midway => s[0].max(s[1]),
            Self::Constrained(Role::A) => s[1],
            Self::Constrained(Role::B) => s[0],
        }
    }

    /// s of the particle that is held at ≤ 1; 0 for midway.
    pub fn held(self, s: [f64; 2]) -> f64 {
        match self {
            Self::Midway => 0.0,
            Self::Constrained(Role::A) => s[0],
            Self::Constrained(Role::B) => s[1],
        }
    }

    /// Units of s of the two cones, `unit` being that of the objective.
    pub fn scales(self, unit: f64) -> [f64; 2] {
        match self {
            Self::Midway => [unit, unit],
            Self::Constrained(Role::A) => [1.0, unit],
            Self::Constrained(Role::B) => [unit, 1.0],
        }
    }

    /// Whether s of this particle (0 = A, 1 = B) is held at ≤ 1 and not part of the objective.
    pub fn holds(self, side: usize) -> bool {
        matches!((self, side), (Self::Constrained(Role::A), 0) | (Self::Constrained(Role::B), 1))
    }

    /// u of B from the duals of the two cone heads, in units of 1/`scales`.
    ///
    /// The duals weigh ∇s; with ∇S = 2s·∇s their weights of ∇S carry another 1/s. An s of zero is
    /// the bottom of that particle's S: all weight is on it.
    pub fn weight(self, heads: [f64; 2], scales: [f64; 2], s: [f64; 2]) -> f64 {
        // In midway both s are t wherever both duals count.
        let s = if self == Self::Midway { [1.0; 2] } else { s };
        let [a, b] = [0, 1].map(|side| heads[side].max(0.0) / (scales[side] * s[side]));
        match (a.is_infinite(), b.is_infinite()) {
            (true, false) => 0.0,
            (false, true) => 1.0,
            _ if a + b > 0.0 && (a + b).is_finite() => b / (a + b),
            _ => 0.5,
        }
    }
}

/// s of the two particles at x, by definition.
pub(super) fn both(pair: &Pair, x: &Vector3<f64>) -> [f64; 2] {
    [potential::value(pair.a, &pair.in_a(x)).sqrt(), potential::value(pair.b, x).sqrt()]
}
