//! The pairs whose answers are known to 40 digits.

use crate::arguments::Effort;
use crate::baselines::Placed;
use crate::baselines::cubic::Cubic;
use crate::support::{self, number, vector};
use nalgebra::Vector3;
use potential_particles::{Particle, Pose};

/// One pair and its answer.
pub struct Case {
    /// Line in the file, from 1.
    pub line: usize,
    pub family: String,
    pub a: Particle,
    pub b: Particle,
    /// Harkness's particles with the same planes; made beforehand, as all particles are.
    pub cubic: [Cubic; 2],
    pub pose_a: Pose,
    pub pose_b: Pose,
    /// As written, for a program that wants quaternions.
    pub quaternions: [[f64; 4]; 2],
    /// Smaller bounding radius: the R by which errors of points are divided.
    pub size: f64,
    pub midway: Truth,
    /// `None` where a constraint is slack, so that closest is not defined by the truth data.
    pub closest: Option<Truth>,
    pub touching: bool,
}

/// What is known. Midway: s and P3. Closest: s_A at P2, then s_B at P1. Points relative to B, world axes.
pub struct Truth {
    pub s: Vec<f64>,
    pub points: Vec<Vector3<f64>>,
}

impl Case {
    pub fn placed(&self) -> Placed<'_> {
        Placed { a: &self.a, pose_a: &self.pose_a, b: &self.b, pose_b: &self.pose_b }
    }
}

/// Every pair, or every `stride`-th.
pub fn all(effort: &Effort) -> Vec<Case> {
    support::pairs().into_iter().enumerate().step_by(effort.stride).map(|(index, pair)| case(index + 1, pair)).collect()
}

fn case(line: usize, pair: support::Pair) -> Case {
    let (a, b) = (pair.shape_a.particle(), pair.shape_b.particle());
    let truth = &pair.truth;
    let closest = if truth.ok1 && truth.ok2 {
        let known = (truth.s_a.as_deref(), truth.s_b.as_deref(), truth.p1.as_ref(), truth.p2.as_ref());
        let (Some(s_a), Some(s_b), Some(p1), Some(p2)) = known else {
            panic!("line {line} of the truth data says that closest is known, yet does not tell it")
        };
        Some(Truth { s: vec![number(s_a), number(s_b)], points: vec![vector(p2), vector(p1)] })
    } else {
        None
    };
    Case {
        line,
        cubic: [Cubic::new(&a), Cubic::new(&b)],
        size: a.bounding_radius().min(b.bounding_radius()),
        a,
        b,
        pose_a: pair.a.pose(),
        pose_b: pair.b.pose(),
        quaternions: [pair.a.q, pair.b.q],
        midway: Truth { s: vec![number(&truth.s4)], points: vec![vector(&truth.x4)] },
        closest,
        touching: number(&truth.s4) < 1.0,
        family: pair.family,
    }
}
