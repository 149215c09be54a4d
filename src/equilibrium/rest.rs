//! States of rest: where the forces of the law of joints balance the loads.
//!
//! With R(v) the forces left on the bodies at displacements v, bodies drift in a viscous medium of drag ε W, W the
//! diagonal of the stiffness, by linearly implicit steps (D + ε W) δ = R, D = −∂R/∂v. A step is taken if R after it is
//! nearly what the linear law says; ε falls where it is, and grows where it is not. Where a state exists the steps
//! become those of Newton's method; where none does, v grows by 1/ε along the mechanism.

use super::answer::Demand;
use super::assembly::{Assembly, Joint, Point, largest};
use super::error::EquilibriumError;
use super::numbers::{
    AT_REST, CLAMPED, GOING, KEEPS, LEAST_DRAG, MISSED, MOST_DRAG, SHORTER, SHORTEST, SOFTEST, STEP_DRAG,
};
use super::stiffness::{Stiffness, weights};
use nalgebra::Vector3;

/// What is solved for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unknown {
    /// Displacements under given loads.
    Displacements,
    /// Displacements and the factor on the live loads.
    Load,
    /// Displacements and the part of the strength.
    Strength,
}

impl Unknown {
    /// The parameter.
    pub fn of(self, at: Demand) -> f64 {
        if self == Self::Strength { at.strength } else { at.live }
    }

    /// The sign of a change of the parameter for the worse.
    pub fn sense(self) -> f64 {
        if self == Self::Strength { -1.0 } else { 1.0 }
    }

    /// The demand with the parameter changed.
    pub fn moved(self, at: Demand, by: f64) -> Demand {
        match self {
            Self::Displacements => at,
            Self::Load => Demand { live: at.live + by, ..at },
            Self::Strength => Demand { strength: at.strength + by, ..at },
        }
    }
}

/// How a drift ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    Rest,
    /// Farther than the limit that was set.
    Gone,
    /// Neither, after as many steps as were allowed.
    Undecided,
}

/// Displacements, and what they bear.
#[derive(Clone, Debug)]
pub(super) struct State {
    pub v: Vec<f64>,
    pub at: Demand,
}

/// A scene with what its solution needs again and again.
pub(super) struct Drift<'a> {
    pub assembly: &'a Assembly,
    pub stiffness: Stiffness,
    weights: Vec<f64>,
}

impl<'a> Drift<'a> {
    pub fn new(assembly: &'a Assembly) -> Result<Self, EquilibriumError> {
        Ok(Self { assembly, stiffness: Stiffness::new(assembly)?, weights: weights(assembly) })
    }

    /// Forces at the points.
    pub fn forces(&self, v: &[f64], at: Demand) -> impl Iterator<Item = Vector3<f64>> {
        let force = move |(joint, point): (&Joint, &Point)| point.strength.force(&joint.slip(point, v), at.strength);
        self.assembly.each_point().map(force)
    }

    /// The largest part of its strength that a point uses.
    pub fn used(&self, state: &State) -> f64 {
        let used = |((_, point), f): ((_, &Point), Vector3<f64>)| {
            let along = f.y.hypot(f.z);
            if along > 0.0 { along / point.strength.most(f.x, 1.0) } else { 0.0 }
        };
        self.assembly.each_point().zip(self.forces(&state.v, state.at)).map(used).fold(0.0, f64::max)
    }

    /// R, and the sum of the sizes of all forces on each body; a body without any has the rounding of the mean load.
    fn left(&self, v: &[f64], at: Demand) -> (Vec<f64>, Vec<f64>) {
        let (left, mut sizes) = self.assembly.left(self.forces(v, at), at.live);
        let total: f64 = self.assembly.loads(at.live).chunks(6).map(largest).sum();
        sizes.iter_mut().for_each(|size| *size = size.clamp(f64::EPSILON, CLAMPED * total.max(1.0)));
        (left, sizes)
    }

    /// The largest force left on a body, over the sum of the sizes of all on it.
    pub fn largest_left(&self, state: &State) -> f64 {
        let (left, sizes) = self.left(&state.v, state.at);
        relative(&left, &sizes)
    }

    /// Displacements over those of elastic bodies: the metric c with v·c = Σ (v W / size)².
    pub fn metric(&self, v: &[f64], at: &State) -> Vec<f64> {
        let sizes = self.left(&at.v, at.at).1;
        let scaled = |(i, (v, weight)): (usize, (&f64, &f64))| v * (weight / sizes[i / 6]).powi(2);
        v.iter().zip(&self.weights).enumerate().map(scaled).collect()
    }

    /// The length of displacements by this metric.
    pub fn length(&self, v: &[f64], at: &State) -> f64 {
        dot(v, &self.metric(v, at)).sqrt()
    }

    /// How far the farthest body is displaced, over its displacement if it were elastic and alone.
    fn farthest(&self, v: &[f64], sizes: &[f64]) -> f64 {
        let of = |((v, weights), size): ((&[f64], &[f64]), &f64)| {
            v.iter().zip(weights).map(|(v, weight)| (v * weight).abs()).fold(0.0, f64::max) / size
        };
        v.chunks(6).zip(self.weights.chunks(6)).zip(sizes).map(of).fold(0.0, f64::max)
    }

    /// Drifts to rest. With an unknown parameter v keeps its part along `across`. `drag`: the first ε; `most` steps;
    /// bodies are gone when displacements have grown `far` times.
    pub fn settle(
        &mut self,
        state: &mut State,
        unknown: Unknown,
        across: &[f64],
        mut drag: f64,
        (most, far): (u32, f64),
    ) -> End {
        let (mut left, mut sizes) = self.left(&state.v, state.at);
        let mut going = 0;
        let limit = self.farthest(&state.v, &sizes).max(1.0) * far;
        for _ in 0..most {
            if !(relative(&left, &sizes) >= AT_REST) {
                return if left.iter().all(|part| part.is_finite()) { End::Rest } else { End::Undecided };
            }
            if unknown == Unknown::Displacements && (going >= GOING || self.farthest(&state.v, &sizes) > limit) {
                return End::Gone;
            }
            let (assembly, weights) = (self.assembly, &self.weights);
            if !self.stiffness.factorise(assembly, &state.v, state.at, drag, weights) {
                drag = grown(drag);
                continue;
            }
            let mut step = self.stiffness.solve(&left);
            let mut by = 0.0;
            if unknown != Unknown::Displacements {
                let response = self.response(state, unknown, &left);
                let response = self.stiffness.solve(&response);
                by = -dot(across, &step) / dot(across, &response);
                step.iter_mut().zip(&response).for_each(|(step, of)| *step += by * of);
            }
            let size = norm(&left, &sizes);
            let mut part = 1.0;
            let taken = loop {
                let v: Vec<f64> = state.v.iter().zip(&step).map(|(v, step)| v + part * step).collect();
                let at = unknown.moved(state.at, part * by);
                let (next, next_sizes) = self.left(&v, at);
                let linear = |i: usize| (1.0 - part) * left[i] + part * drag * self.weights[i] * step[i];
                let missed: Vec<f64> = next.iter().enumerate().map(|(i, next)| next - linear(i)).collect();
                let missed = norm(&missed, &sizes) / (part * size);
                if missed < MISSED {
                    let is_going = drag <= SOFTEST && part == 1.0 && norm(&next, &sizes) > KEEPS * size;
                    going = if is_going { going + 1 } else { 0 };
                    (*state, left, sizes) = (State { v, at }, next, next_sizes);
                    break Some(missed);
                }
                part *= SHORTER;
                if part < SHORTEST {
                    break None;
                }
            };
            drag = match taken {
                None => grown(drag),
                Some(_) if part < 1.0 => 2.0 * drag,
                // By the square of what a step misses, as of Newton's method.
                Some(missed) => (drag * (missed * missed * 4.0).clamp(0.03, 0.7)).max(LEAST_DRAG),
            };
            if drag > MOST_DRAG {
                return End::Undecided;
            }
        }
        End::Undecided
    }

    /// ∂R of the unknown parameter, by a difference.
    fn response(&self, state: &State, unknown: Unknown, left: &[f64]) -> Vec<f64> {
        if unknown != Unknown::Strength {
            return self.assembly.live.clone();
        }
        let by = 1e-6 * state.at.strength.abs().max(1e-6);
        let more = self.left(&state.v, unknown.moved(state.at, by)).0;
        more.iter().zip(left).map(|(more, left)| (more - left) / by).collect()
    }

    /// How displacements answer to the parameter.
    pub fn tangent(&mut self, state: &State, unknown: Unknown) -> Option<Vec<f64>> {
        let left = self.left(&state.v, state.at).0;
        let response = self.response(state, unknown, &left);
        let (assembly, weights) = (self.assembly, &self.weights);
        let found = self.stiffness.factorise(assembly, &state.v, state.at, STEP_DRAG, weights);
        found.then(|| self.stiffness.solve(&response))
    }
}

/// The drag after a step that nothing of could be taken.
fn grown(drag: f64) -> f64 {
    (10.0 * drag).max(1e-5)
}

pub(super) fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}

/// The largest force, or torque over size, over the sizes of all forces on its body.
fn relative(left: &[f64], sizes: &[f64]) -> f64 {
    left.chunks(6).zip(sizes).map(|(six, size)| largest(six) / size).fold(0.0, f64::max)
}

/// The Euclidean norm of the same.
fn norm(left: &[f64], sizes: &[f64]) -> f64 {
    let square = |(six, size): (&[f64], &f64)| six.iter().map(|part| (part / size).powi(2)).sum::<f64>();
    left.chunks(6).zip(sizes).map(square).sum::<f64>().sqrt()
}
