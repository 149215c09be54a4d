//! One pair judged: by definition, and beside other solutions.

#[path = "judge/definition.rs"]
mod definition;
#[path = "judge/solutions.rs"]
mod solutions;

use crate::cases::{Case, Place, scaled};
use crate::clock::{Call, Cost};
use crate::random::Random;
use crate::reference::{Body, Wanted, optimum};
use definition::{carried, flips, in_other_units, surfaces, swapped, well_formed};
use nalgebra::Vector3;
use potential_particles::{BackEnd, Contact, Flags, Formulation, Memory, Particle, Pose, Settings, detect};
use serde::Serialize;
use solutions::{by_cone_program, closest, midway, warm};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// What can be wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Failure {
    Panic,
    /// No answer.
    Error,
    /// A field that should be a number, a unit vector or positive is not; or fields contradict each other.
    Malformed,
    /// s is further than its gap from the truth.
    BoundOfS,
    /// The contact point is further than its bound from the optimum.
    BoundOfPoint,
    /// Overlapping told of a separated pair or the other way round, beyond the gap.
    WrongSide,
    /// The gap is much larger than the rounding of the input explains.
    LooseBound,
    /// A surface point is not on its surface.
    OffSurface,
    /// The normal is not that of both surfaces.
    Normal,
    /// B moved by less than the overlap, and they overlap no more.
    FlipsEarly,
    /// B moved beyond the tangent planes, and they still overlap.
    FlipsLate,
    /// A with B is not B with A.
    Swap,
    /// Both turned and shifted together.
    RigidMotion,
    /// Another unit of length.
    Units,
    /// From memory and without.
    Warm,
    /// Rejected, although they overlap; or the quick answer has another kind than the full one.
    Reject,
    /// The cone program disagrees.
    Conic,
    /// A jump along a smooth motion.
    Jump,
}

/// What is measured of an answer.
#[derive(Clone, Copy, Debug, Default)]
pub struct Measures {
    /// Gap over max(s, 1).
    pub gap: f64,
    /// |s − truth| over max(s, 1).
    pub error: Option<f64>,
    /// Distance of the point to the optimum, over the smaller particle.
    pub point_error: Option<f64>,
    /// Its bound, likewise.
    pub point_bound: Option<f64>,
    /// Angle of the normal to the true one.
    pub normal_error: Option<f64>,
    /// The gap over what the rounding of the input explains.
    pub looseness: Option<f64>,
}

/// The path that answered a call.
pub const PATHS: [&str; 8] = [
    "rejected by spheres",
    "rejected by a face",
    "rejected from memory",
    "separated, proved on the way",
    "solved cold",
    "solved warm",
    "solved by the safer factorisation",
    "fell back to the cone program",
];

#[derive(Default)]
pub struct Verdict {
    pub failures: Vec<(Failure, String)>,
    pub measures: Measures,
    pub paths: Vec<(Call, usize)>,
    pub costs: Vec<(Call, f64)>,
    /// Midway, closest P2 or P1 that the reference could not settle.
    pub unjudged: u32,
    pub judged: u32,
    /// Not the same bits in another unit.
    pub unit_digits: bool,
    pub conic: Option<bool>,
    pub rounding_limited: bool,
}

impl Verdict {
    fn fail(&mut self, failure: Failure, detail: impl Into<String>) {
        self.failures.push((failure, detail.into()));
    }

    fn check(&mut self, holds: bool, failure: Failure, detail: impl FnOnce() -> String) {
        if !holds {
            self.fail(failure, detail());
        }
    }
}

/// How many pairs share one visit to the cone program, and the most planes it is bothered with.
const CONIC_EVERY: u64 = 500;
const CONIC_PLANES: usize = 80;

pub const FULL: Settings = Settings {
    formulation: Formulation::Midway,
    back_end: BackEnd::Fast,
    solve_separated: true,
    gap_tolerance: 1e-12,
    weight_on_a: 0.5,
    flat_regularisation: 1e-13,
};

/// The two bodies of a case in another unit, made once for all its poses.
pub struct Units {
    exponent: i32,
    pub a: Particle,
    pub b: Particle,
}

impl Units {
    pub fn of(a: &Particle, b: &Particle, random: &mut Random) -> Self {
        let exponent = random.whole(0, 61) as i32 - 30;
        let unit = 2f64.powi(exponent);
        Self { exponent, a: scaled(a, unit), b: scaled(b, unit) }
    }
}

pub fn judge(case: &Case, units: &Units, random: &mut Random) -> Verdict {
    let mut verdict = Verdict::default();
    let judged = catch_unwind(AssertUnwindSafe(|| all(case, units, random, &mut verdict)));
    if let Err(panic) = judged {
        let text =
            panic.downcast_ref::<String>().cloned().or_else(|| panic.downcast_ref::<&str>().map(|s| (*s).into()));
        verdict.fail(Failure::Panic, text.unwrap_or_default());
    }
    verdict
}

struct Scene<'a> {
    a: &'a Particle,
    b: &'a Particle,
    at_a: Pose,
    at_b: Pose,
    /// A length that all coordinates are made from: rounding is relative to it.
    length: f64,
    /// Of the coordinates in the world.
    far: f64,
}

impl Scene<'_> {
    fn detect(&self, at_b: &Pose, settings: &Settings, memory: Option<&mut Memory>) -> Result<Contact, String> {
        detect(self.a, &self.at_a, self.b, at_b, settings, memory).map_err(|error| error.to_string())
    }

    fn moved(&self, by: Vector3<f64>) -> Pose {
        Pose { position: self.at_b.position + by, ..self.at_b }
    }
}

const EPS: f64 = f64::EPSILON;

/// A gap this many times what the rounding of lengths explains proves too little.
const LOOSE: f64 = 1e4;

fn all(case: &Case, units: &Units, random: &mut Random, verdict: &mut Verdict) -> Option<()> {
    let (a, b) = (&case.shapes.a, &case.shapes.b);
    let (at_a, at_b) = (case.at_a.pose(), case.at_b.pose());
    let branch = (at_b.position - at_a.position).norm();
    let length = branch + a.bounding_radius() + b.bounding_radius();
    let scene = Scene { a, b, at_a, at_b, length, far: at_a.position.amax().max(at_b.position.amax()) };

    let mut clock = Cost::default();
    let answer = clock.time(Call::Full, || scene.detect(&at_b, &FULL, None));
    let contact = match answer {
        Ok(contact) => contact,
        Err(error) => {
            verdict.fail(Failure::Error, error);
            return None;
        }
    };
    verdict.paths.push((Call::Full, path(&contact)));
    verdict.rounding_limited = contact.flags.contains(Flags::ROUNDING_LIMITED);
    verdict.measures.gap = contact.gap / contact.s.max(1.0);
    well_formed(verdict, &scene, &contact);

    let bodies = bodies(case);
    let start = at_b_relative(&scene, &contact.point, &contact.branch_b);
    let lambda = contact.weight / (1.0 - contact.weight);
    let truth = optimum(&bodies[0], &bodies[1], Wanted::Midway, &start, lambda);
    match truth {
        Some(truth) if truth.most - truth.least <= 0.1 * contact.gap + 1e-300 => {
            verdict.judged += 1;
            midway(verdict, &scene, &contact, &bodies, &truth, &start);
        }
        Some(truth) => {
            verdict.unjudged += 1;
            // Not settled, but what is proved still counts.
            let outside = contact.s + contact.gap < truth.least || contact.s - contact.gap > truth.most;
            verdict.check(!outside, Failure::BoundOfS, || {
                format!("s={:e} ± {:e}, but in [{:e}, {:e}]", contact.s, contact.gap, truth.least, truth.most)
            });
        }
        None => verdict.unjudged += 1,
    }
    surfaces(verdict, &scene, &contact, &bodies);
    flips(verdict, &scene, &contact, &bodies, &start)?;
    let quick = clock.time(Call::Quick, || scene.detect(&at_b, &Settings::default(), None));
    match quick {
        Ok(quick) => {
            verdict.paths.push((Call::Quick, path(&quick)));
            let least = if quick.flags.contains(Flags::REJECTED) { quick.s } else { 0.0 };
            let right = quick.kind == contact.kind || (contact.s - 1.0).abs() <= contact.gap;
            verdict.check(right && least <= contact.s + contact.gap, Failure::Reject, || {
                format!(
                    "quick {:?} {:?} s={:e}, full s={:e} ± {:e}",
                    quick.kind, quick.flags, quick.s, contact.s, contact.gap
                )
            });
        }
        Err(error) => verdict.fail(Failure::Error, format!("default settings: {error}")),
    }
    swapped(verdict, &scene, &contact);
    carried(verdict, case, &scene, &contact, &bodies, random);
    in_other_units(verdict, &scene, &contact, units);
    warm(verdict, &scene, &contact, &mut clock, random);
    closest(verdict, &scene, &contact, &bodies, &mut clock);
    if case.index.is_multiple_of(CONIC_EVERY) && a.plane_count() + b.plane_count() <= CONIC_PLANES {
        by_cone_program(verdict, &scene, &contact);
    }
    verdict.costs = clock.costs;
    Some(())
}

/// Both bodies in world axes about the centre of B.
pub fn bodies<'a>(case: &Case<'a>) -> [Body<'a>; 2] {
    let origin = case.at_b.position;
    let body = |particle: &'a Particle, at: &Place| Body::new(particle, at.position, at.orientation, origin);
    [body(&case.shapes.a, &case.at_a), body(&case.shapes.b, &case.at_b)]
}

/// A point relative to the centre of B, from the branch where there is one.
fn at_b_relative(scene: &Scene, point: &Vector3<f64>, branch_b: &Vector3<f64>) -> Vector3<f64> {
    if branch_b.iter().all(|c| c.is_finite()) { *branch_b } else { point - scene.at_b.position }
}

/// Index into [`PATHS`].
pub fn path(contact: &Contact) -> usize {
    let has = |flag| contact.flags.contains(flag);
    if has(Flags::BY_SPHERES) {
        0
    } else if has(Flags::BY_FACE) {
        1
    } else if has(Flags::BY_MEMORY) {
        2
    } else if has(Flags::FELL_BACK) {
        7
    } else if has(Flags::SAFER) {
        6
    } else if has(Flags::REJECTED) {
        3
    } else if has(Flags::WARM) {
        5
    } else {
        4
    }
}
