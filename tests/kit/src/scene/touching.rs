//! Pairs at a stated overlap or distance.

use super::evaluation::Plain;
use crate::random::Random;
use nalgebra::Vector3;
use potential_particles::internals::{Pair, potential, reject};
use potential_particles::{Formulation, Kind, PairState, Particle, Pose, Settings, detect};
use std::hint::black_box;

/// Overlap, relative to the size 1 of the particles of this scene.
pub const OVERLAP: f64 = 1e-3;

/// Move and turn between two calls of a warm pair, relative to the size 1.
pub const STEP: f64 = 1e-4;

/// To what part of the size the contact point of a contact that is carried on is known: YADE's default here.
pub const CARRY_TOLERANCE: f64 = 1e-9;

/// Two particles at fixed poses.
pub struct Touching {
    pub a: Particle,
    pub b: Particle,
    pub pose_a: Pose,
    pub pose_b: Pose,
    /// A slightly later pose of B.
    pub moved_b: Pose,
    /// A point that a solver would evaluate: the contact point, or between the centres when apart. In the
    /// frames of A and of B.
    points: [Vector3<f64>; 2],
    plain: [Plain; 2],
    /// The state of the pair after a call at `pose_b`: of midway, to be carried on, and of closest.
    states: [PairState; 2],
}

impl Touching {
    /// A at the origin, B in a random direction at the distance where the overlap of midway is [`OVERLAP`].
    pub fn new(a: &Particle, b: &Particle, random: &mut Random) -> Self {
        let pose_a = random.pose(Vector3::zeros());
        let turned_b = random.pose(Vector3::zeros());
        let direction = random.direction();
        let at = |distance: f64| Pose::new((distance * direction).into(), turned_b.orientation()).expect("finite");
        let settings = Settings::default();
        let too_deep = |distance: f64| {
            let contact = detect(a, &pose_a, b, &at(distance), &settings, None).expect("a contact of ordinary bodies");
            contact.kind == Kind::Overlapping && contact.overlap > OVERLAP
        };
        let (mut deep, mut apart) = (0.0, a.bounding_radius() + b.bounding_radius());
        for _ in 0..60 {
            let middle = 0.5 * (deep + apart);
            if too_deep(middle) { deep = middle } else { apart = middle }
        }
        Self::placed(a.clone(), b.clone(), pose_a, at(apart), random)
    }

    /// This pair with B pushed away from A until it is `factor` times as far.
    pub fn pushed(&self, factor: f64, random: &mut Random) -> Self {
        let pose_b = Pose::new((factor * self.pose_b.position()).into(), self.pose_b.orientation()).expect("finite");
        Self::placed(self.a.clone(), self.b.clone(), self.pose_a, pose_b, random)
    }

    /// This pair pushed apart until face bounds prove the separation while the bounding spheres still meet; `None`
    /// when the spheres part first.
    pub fn beyond_a_face(&self, random: &mut Random) -> Option<Self> {
        let meet = self.a.bounding_radius() + self.b.bounding_radius();
        (1..200)
            .map(|i| 1.0 + 0.01 * f64::from(i))
            .take_while(|factor| factor * self.pose_b.position().norm() < 0.98 * meet)
            .map(|factor| self.pushed(factor, random))
            .find(Self::is_rejected)
    }

    /// The state of the pair after a call at `pose_b`.
    pub fn state(&self, formulation: Formulation) -> PairState {
        self.states[usize::from(formulation == Formulation::Closest)]
    }

    /// The unit of cost: S, ∇S, ∇²S of both particles at one point.
    pub fn evaluate(&self) {
        black_box(&self.plain[0].at(black_box(&self.points[0])));
        black_box(&self.plain[1].at(black_box(&self.points[1])));
    }

    /// The same by the library, which keeps more of it.
    pub fn evaluate_by_library(&self) {
        black_box(&potential::local(&self.a, black_box(&self.points[0])));
        black_box(&potential::local(&self.b, black_box(&self.points[1])));
    }

    /// Whether a cheap test proves the separation.
    pub fn is_rejected(&self) -> bool {
        reject::proof_of_separation(&Pair::new(&self.a, &self.pose_a, &self.b, &self.pose_b)).is_some()
    }

    fn placed(a: Particle, b: Particle, pose_a: Pose, pose_b: Pose, random: &mut Random) -> Self {
        let moved_b = random.moved(&pose_b, STEP, STEP);
        let after = |formulation| {
            let settings = Settings::default().with_formulation(formulation).with_carry_tolerance(CARRY_TOLERANCE);
            let mut state = PairState::default();
            let contact = detect(&a, &pose_a, &b, &pose_b, &settings, Some(&mut state));
            (contact.expect("a contact of ordinary bodies"), state)
        };
        let ((contact, midway), (_, closest)) = (after(Formulation::Midway), after(Formulation::Closest));
        let touching = contact.kind == Kind::Overlapping;
        let point = if touching { contact.point } else { 0.5 * (pose_a.position() + pose_b.position()) };
        let points = [pose_a, pose_b].map(|pose| pose.to_local(&point));
        let plain = [Plain::new(&a), Plain::new(&b)];
        Self { a, b, pose_a, pose_b, moved_b, points, plain, states: [midway, closest] }
    }
}

/// `count` pairs of one shape.
pub fn pairs(shape: &Particle, count: usize, random: &mut Random) -> Vec<Touching> {
    (0..count).map(|_| Touching::new(shape, shape, random)).collect()
}

/// The pairs a tenth of their distance further apart, as far as no cheap test proves it: neighbours that come and
/// go, for which a memory of what separates them pays.
pub fn barely_apart(pairs: &[Touching], random: &mut Random) -> Vec<Touching> {
    let pushed = pairs.iter().map(|pair| pair.pushed(1.1, random));
    pushed.filter(|pair| !pair.is_rejected()).collect()
}
