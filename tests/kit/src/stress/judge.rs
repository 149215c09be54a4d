//! One pair judged: by definition, and beside other solutions.

mod definition;
mod solutions;

use crate::random::Random;
use crate::stress::cases::Case;
use crate::stress::clock::{Call, Clock};
use crate::stress::ledger::Fault;
use crate::stress::reference::Body;
pub use definition::stays_in_plane;
use definition::{batched, carried, enclosed, flips, in_other_units, says_something, surfaces, swapped, well_formed};
use nalgebra::Vector3;
use potential_particles::{Contact, DetectError, Flags, PairState, Particle, Pose, Settings};
use serde::Serialize;
use solutions::{by_cone_program, closest, settle, warm};
use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// What is measured of an answer.
#[derive(Clone, Copy, Debug, Default)]
pub struct Measures {
    /// Gap over max(s, 1).
    pub gap: f64,
    /// |s − truth| over max(s, 1).
    pub error: Option<f64>,
    /// Distance of the point to the optimum, over the smaller particle.
    pub point_error: Option<f64>,
}

/// The path that answered a call.
pub const PATHS: [&str; 7] = [
    "rejected by spheres",
    "rejected by a face",
    "rejected from memory",
    "separated, proved on the way",
    "solved cold",
    "solved warm",
    "solved in extended precision",
];

/// From here on, paths that few pairs take.
const RARE: usize = 6;

/// Why a pair whose turn it is not is put to the second solver all the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Doubt {
    /// The gap is larger than rounding seems to explain.
    Gap,
    /// s, as far as doubles tell at the point, is no more than near the answer.
    Enclosure,
    /// Two answers to the same question use up most of their bounds.
    Disagreement,
    /// Solved in extended precision.
    Path,
    /// Something failed already.
    Failed,
}

#[derive(Default)]
pub struct Verdict {
    pub faults: Vec<(Fault, String)>,
    pub doubts: BTreeSet<Doubt>,
    /// Put to the second solver.
    pub settled: bool,
    pub measures: Measures,
    pub paths: Vec<(Call, usize)>,
    /// Seconds.
    pub costs: Vec<(Call, f64)>,
    /// Midway, closest P2 or P1 that the reference could not settle.
    pub unjudged: u32,
    pub judged: u32,
    /// Not the same bits in another unit.
    pub unit_digits: bool,
    pub cone_program: Option<bool>,
    pub rounding_limited: bool,
}

impl Verdict {
    fn fail(&mut self, failure: Fault, detail: impl Into<String>) {
        self.faults.push((failure, detail.into()));
    }

    fn check(&mut self, holds: bool, failure: Fault, detail: impl FnOnce() -> String) {
        if !holds {
            self.fail(failure, detail());
        }
    }

    fn doubt(&mut self, doubtful: bool, doubt: Doubt) {
        if doubtful {
            self.doubts.insert(doubt);
        }
    }
}

/// What is asked of the judge for one pair.
#[derive(Clone, Copy, Debug)]
pub struct Trial {
    /// Whether the second solver is asked, and closest judged, whatever the answer looks like.
    pub settle: bool,
    /// Whether the cone program is asked.
    pub cone_program: bool,
}

impl Trial {
    #[allow(dead_code)]
    pub const WHOLE: Self = Self { settle: true, cone_program: true };
    /// What every pair goes through in bulk.
    #[allow(dead_code)]
    pub const BY_DEFINITION: Self = Self { settle: false, cone_program: false };
}

/// What is judged; any other solver must be found out.
pub type Solver =
    fn(&Particle, &Pose, &Particle, &Pose, &Settings, Option<&mut PairState>) -> Result<Contact, DetectError>;

/// The most planes that the cone program is bothered with.
const CONE_PROGRAM_PLANES: usize = 80;

pub const FULL: Settings = Settings::DEFAULT.with_solve_separated(true);

/// What all poses of two shapes share: the shapes in another unit.
pub struct Shared {
    exponent: i32,
    in_other_units: [Particle; 2],
}

impl Shared {
    pub fn of(a: &Particle, b: &Particle, random: &mut Random) -> Self {
        let exponent = random.whole(0, 61) as i32 - 30;
        let unit = 2f64.powi(exponent);
        let scaled = |particle: &Particle| particle.scaled(unit).expect("a particle is one in any unit");
        Self { exponent, in_other_units: [scaled(a), scaled(b)] }
    }
}

pub fn judge(case: &Case, shared: &Shared, trial: Trial, solver: Solver, random: &mut Random) -> Verdict {
    let mut verdict = Verdict::default();
    let judged = catch_unwind(AssertUnwindSafe(|| all(case, shared, trial, solver, random, &mut verdict)));
    if let Err(panic) = judged {
        let text =
            panic.downcast_ref::<String>().cloned().or_else(|| panic.downcast_ref::<&str>().map(|s| (*s).into()));
        verdict.fail(Fault::Panic, text.unwrap_or_default());
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
    solver: Solver,
    case: &'a Case<'a>,
    /// In 32 digits.
    bodies: [Body<'a>; 2],
}

impl Scene<'_> {
    fn detect(&self, at_b: &Pose, settings: &Settings, state: Option<&mut PairState>) -> Result<Contact, String> {
        (self.solver)(self.a, &self.at_a, self.b, at_b, settings, state).map_err(|error| error.to_string())
    }

    fn moved(&self, by: Vector3<f64>) -> Pose {
        self.case.at_b.at(self.at_b.position() + by).pose()
    }

    /// Any direction in which a body may move.
    fn direction(&self, random: &mut Random) -> Vector3<f64> {
        random.direction_in(self.case.shapes.is_flat())
    }

    /// The smaller size.
    fn small(&self) -> f64 {
        self.a.bounding_radius().min(self.b.bounding_radius())
    }

    /// Whether the minimiser need not be unique.
    fn is_flat_faced(&self) -> bool {
        self.a.sphericity().min(self.b.sphericity()) < 1e-12
    }
}

const EPS: f64 = f64::EPSILON;

/// A gap this many times what the rounding of lengths explains proves too little.
const LOOSE: f64 = 1e4;

fn all(
    case: &Case,
    shared: &Shared,
    trial: Trial,
    solver: Solver,
    random: &mut Random,
    verdict: &mut Verdict,
) -> Option<()> {
    let (a, b) = (&case.shapes.a, &case.shapes.b);
    let (at_a, at_b) = (case.at_a.pose(), case.at_b.pose());
    let branch = (at_b.position() - at_a.position()).norm();
    let length = branch + a.bounding_radius() + b.bounding_radius();
    let far = at_a.position().amax().max(at_b.position().amax());
    let scene = Scene { a, b, at_a, at_b, length, far, solver, case, bodies: bodies(case) };

    let mut clock = Clock::default();
    let answer = clock.time(Call::Full, || scene.detect(&at_b, &FULL, None));
    let contact = match answer {
        Ok(contact) => contact,
        Err(error) => {
            verdict.fail(Fault::NotSolved, error);
            return None;
        }
    };
    verdict.paths.push((Call::Full, path(&contact)));
    verdict.rounding_limited = contact.flags.contains(Flags::ROUNDING_LIMITED);
    verdict.measures.gap = contact.gap / contact.s.max(1.0);
    well_formed(verdict, &scene, &contact);
    says_something(verdict, &contact);
    if trial.settle {
        batched(verdict, &scene);
    }
    let start = at_b_relative(&scene, &contact.point, &contact.branch_b);
    enclosed(verdict, &scene, &contact, &start);
    surfaces(verdict, &scene, &contact);
    flips(verdict, &scene, &contact, &start, trial.settle);
    let quick = clock.time(Call::Quick, || scene.detect(&at_b, &Settings::default(), None));
    match quick {
        Ok(quick) => {
            verdict.paths.push((Call::Quick, path(&quick)));
            let least = if quick.flags.contains(Flags::REJECTED) { quick.s } else { 0.0 };
            let right = quick.kind == contact.kind || (contact.s - 1.0).abs() <= contact.gap;
            verdict.check(right && least <= contact.s + contact.gap, Fault::Reject, || {
                format!(
                    "quick {:?} {:?} s={:e}, full s={:e} ± {:e}",
                    quick.kind, quick.flags, quick.s, contact.s, contact.gap
                )
            });
        }
        Err(error) => verdict.fail(Fault::NotSolved, format!("default settings: {error}")),
    }
    swapped(verdict, &scene, &contact);
    carried(verdict, case, &scene, &contact, random);
    in_other_units(verdict, &scene, &contact, shared);
    warm(verdict, &scene, &contact, &mut clock, random);

    let unusual = verdict.paths.iter().any(|(_, path)| *path >= RARE);
    verdict.doubt(unusual, Doubt::Path);
    verdict.doubt(!verdict.faults.is_empty(), Doubt::Failed);
    verdict.settled = trial.settle || !verdict.doubts.is_empty();
    if verdict.settled {
        settle(verdict, &scene, &contact, &start);
    }
    // Whatever the answer of midway looks like, so that the times of closest are those of any pair.
    if trial.settle {
        closest(verdict, &scene, &contact, &mut clock, random);
    }
    if trial.cone_program && a.plane_count() + b.plane_count() <= CONE_PROGRAM_PLANES {
        by_cone_program(verdict, &scene, &contact);
    }
    verdict.costs = clock.costs;
    Some(())
}

/// Both bodies in world axes about the centre of B.
pub fn bodies<'a>(case: &Case<'a>) -> [Body<'a>; 2] {
    let origin = case.at_b.position;
    [Body::new(&case.shapes.a, &case.at_a, origin), Body::new(&case.shapes.b, &case.at_b, origin)]
}

/// A point relative to the centre of B, from the branch where there is one.
fn at_b_relative(scene: &Scene, point: &Vector3<f64>, branch_b: &Vector3<f64>) -> Vector3<f64> {
    if branch_b.iter().all(|c| c.is_finite()) { *branch_b } else { point - scene.at_b.position() }
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
    } else if has(Flags::EXTENDED) {
        6
    } else if has(Flags::REJECTED) {
        3
    } else if has(Flags::WARM) {
        5
    } else {
        4
    }
}
