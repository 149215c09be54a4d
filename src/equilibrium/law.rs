//! The law of joints at a point of a contact, without memory.
//!
//! With u the displacement of the second body relative to the first, k_n and k_t the stiffness of the point, and n, t
//! the force on the second body along the normal and across it:
//!
//! ```text
//! n = −k_n u_n + n₀, at least −T;   t = −k_t u_t + t₀, cut off at |t| = μ n + C;   T = min(σ a, C/μ),  C = c a
//! ```
//!
//! a is the share of the point of the area, n₀ and t₀ the force of the initial stress. Slip neither opens the joint nor
//! is it remembered: a state depends on where the bodies are, and not on their way.

use nalgebra::{Matrix3, Vector3};

/// Stiffness and strength of a point, in units of the scene.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Strength {
    /// k_n and k_t.
    pub stiffness: [f64; 2],
    /// n₀ and t₀, in the axes of the contact.
    pub initial: Vector3<f64>,
    /// μ.
    pub friction: f64,
    /// C.
    pub cohesion: f64,
    /// T.
    pub tension: f64,
}

impl Strength {
    /// Force of a displacement, with μ and C times `part`.
    pub fn force(&self, u: &Vector3<f64>, part: f64) -> Vector3<f64> {
        let trial = self.trial(u);
        let n = trial.x.max(-self.tension);
        let (size, most) = (trial.y.hypot(trial.z), self.most(n, part));
        let kept = if size > most { most / size } else { 1.0 };
        Vector3::new(n, kept * trial.y, kept * trial.z)
    }

    /// −∂f/∂u. It is not symmetric where a point slips: friction follows the normal force, not the reverse.
    pub fn tangent(&self, u: &Vector3<f64>, part: f64) -> Matrix3<f64> {
        let ([k_n, k_t], trial) = (self.stiffness, self.trial(u));
        let is_open = trial.x < -self.tension;
        let normal = if is_open { 0.0 } else { k_n };
        let (size, most) = (trial.y.hypot(trial.z), self.most(trial.x.max(-self.tension), part));
        if size <= most {
            // Sticks. Where nothing can be borne it is open.
            let along = if is_open && most == 0.0 { 0.0 } else { k_t };
            return Matrix3::from_diagonal(&Vector3::new(normal, along, along));
        }
        let ([d, e], turns) = ([trial.y / size, trial.z / size], k_t * most / size);
        let follows = part * self.friction * normal;
        Matrix3::new(
            normal,
            0.0,
            0.0,
            follows * d,
            turns * e * e,
            -turns * d * e,
            follows * e,
            -turns * d * e,
            turns * d * d,
        )
    }

    /// The largest |t|.
    pub fn most(&self, n: f64, part: f64) -> f64 {
        (part * (self.friction * n + self.cohesion)).max(0.0)
    }

    fn trial(&self, u: &Vector3<f64>) -> Vector3<f64> {
        let [k_n, k_t] = self.stiffness;
        self.initial - Vector3::new(k_n * u.x, k_t * u.y, k_t * u.z)
    }
}
