//! One pair judged by definition: what every right answer must satisfy, whatever the truth is.

use crate::cases::{Case, Place, scaled};
use crate::clock::{Call, Cost};
use crate::random::Random;
use crate::reference::{Body, Optimum, Wanted, optimum};
use crate::wide::{Wide, Wide3};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use potential_particles::{BackEnd, Contact, Flags, Formulation, Kind, Memory, Particle, Pose, Settings, detect};
use serde::Serialize;
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

fn well_formed(verdict: &mut Verdict, scene: &Scene, c: &Contact) {
    let finite = |v: &Vector3<f64>| v.iter().all(|c| c.is_finite());
    let overlapping = c.kind == Kind::Overlapping;
    let fine = c.s.is_finite()
        && c.s >= 0.0
        && c.gap.is_finite()
        && c.gap >= 0.0
        && c.point_bound >= 0.0
        && (0.0..=1.0).contains(&c.weight)
        && (c.normal.norm() - 1.0).abs() < 1e-14
        && finite(&c.point)
        && finite(&c.branch_a)
        && finite(&c.branch_b)
        && overlapping == (c.s < 1.0)
        && overlapping == (c.overlap.is_finite() && c.overlap >= 0.0)
        && overlapping == finite(&c.point_on_a)
        && overlapping == finite(&c.point_on_b)
        && c.overlap.is_nan() != overlapping;
    let rounding = 8.0 * EPS * (scene.length + scene.far + c.branch_b.norm());
    let consistent = (c.point - scene.at_a.position - c.branch_a).norm() <= rounding
        && (c.point - scene.at_b.position - c.branch_b).norm() <= rounding
        && (!overlapping
            || ((c.point_on_a - c.point_on_b).norm() - c.overlap).abs() <= rounding
                && (c.formulation != Formulation::Midway
                    || (c.point_on_a - c.point_on_b - c.overlap * c.normal).norm() <= rounding));
    verdict.check(fine && consistent, Failure::Malformed, || format!("{c:?}"));
}

fn midway(
    verdict: &mut Verdict,
    scene: &Scene,
    contact: &Contact,
    bodies: &[Body; 2],
    truth: &Optimum,
    start: &Vector3<f64>,
) {
    let (s, gap) = (contact.s, contact.gap);
    let scale = truth.most.max(1.0);
    let off = (s - truth.most).abs().min((s - truth.least).abs());
    verdict.measures.error = Some(off / scale);
    verdict.check(s + gap >= truth.least && s - gap <= truth.most, Failure::BoundOfS, || {
        format!(
            "s={s:e} ± {gap:e}, truth {:e} (± {:e}): {:.2} gaps off",
            truth.most,
            truth.most - truth.least,
            off / gap
        )
    });
    let overlapping = contact.kind == Kind::Overlapping;
    let wrong = if overlapping { truth.least > 1.0 + gap } else { truth.most < 1.0 - gap };
    verdict.check(!wrong, Failure::WrongSide, || format!("{:?}, s={s:e}, truth {:e}", contact.kind, truth.most));

    // The least that rounding lengths of this size does to s², and the tolerance asked for.
    let u = truth.lambda.f64() / (1.0 + truth.lambda.f64());
    let [a, b] = [0, 1].map(|i| bodies[i].risen(&truth.x, EPS * scene.length));
    let explained = 1e-12 * scale * scale + (1.0 - u) * a + u * b + flat_share(scene, truth);
    let looseness = gap * (2.0 * s + gap) / explained;
    verdict.measures.looseness = Some(looseness);
    verdict.check(looseness <= LOOSE, Failure::LooseBound, || {
        format!("s={s:e} ± {gap:e}, truth {:e}: {looseness:.1e} times what rounding explains", truth.most)
    });

    let small = scene.a.bounding_radius().min(scene.b.bounding_radius());
    let distance = truth.x.minus(&Wide3::from(*start)).norm().f64();
    let flat = scene.a.sphericity().min(scene.b.sphericity()) < 1e-12;
    if !flat && truth.doubt < 0.05 * contact.point_bound {
        verdict.measures.point_error = Some(distance / small);
        verdict.measures.point_bound = Some(contact.point_bound / small);
        verdict.check(distance <= contact.point_bound + truth.doubt, Failure::BoundOfPoint, || {
            format!("{distance:e} off, bound {:e}, small {small:e}", contact.point_bound)
        });
        if let Some(normal) = truth.normal()
            && !contact.flags.contains(Flags::NORMAL_BY_CENTRES)
        {
            let angle = (contact.normal - normal).norm();
            verdict.measures.normal_error = Some(angle);
            // How fast a normal turns along the surface, times how well the point is known.
            let known = contact.point_bound + 8.0 * EPS * scene.length;
            let allowed = 8.0 * EPS + 2.0 * (truth.a.bend() + truth.b.bend()) * known;
            verdict.check(angle <= allowed, Failure::Normal, || format!("{angle:e} off, allowed {allowed:e}"));
        }
    }
}

/// What the regularisation of flat faces adds to the gap of s².
fn flat_share(scene: &Scene, truth: &Optimum) -> f64 {
    let missing = |p: &Particle| (FULL.flat_regularisation - p.sphericity()).max(0.0);
    2.0 * (missing(scene.a) + missing(scene.b)) * truth.most.max(1.0).powi(2)
}

/// Distance of a point from the surface {S = 1}, to first order from s.
fn off_surface(body: &Body, point: &Vector3<f64>) -> f64 {
    let local = body.at(&Wide3::from(*point));
    let s = local.value.sqrt();
    let steepness = (local.gradient.norm() / (s + s)).f64();
    ((s - Wide::ONE).f64() / steepness).abs()
}

fn surfaces(verdict: &mut Verdict, scene: &Scene, contact: &Contact, bodies: &[Body; 2]) {
    if contact.kind != Kind::Overlapping {
        return;
    }
    let allowed = 32.0 * EPS * scene.length + 2.0 * EPS * scene.far + closest_slack(contact);
    let n = contact.normal;
    for (body, point, outwards, name) in
        [(&bodies[0], contact.point_on_a, n, "A"), (&bodies[1], contact.point_on_b, -n, "B")]
    {
        let point = point - scene.at_b.position;
        let off = off_surface(body, &point);
        // Where s bends within the rounding of the point, the first order says nothing: then there has to be a point inside
        // and one outside within that.
        let inside = |by: f64| body.at(&Wide3::from(point + by * outwards)).value.f64() <= 1.0;
        let between = (inside(0.0) || inside(-allowed)) && !inside(allowed);
        verdict.check(off <= allowed || between, Failure::OffSurface, || {
            format!("{:?}: point on {name} {off:e} off, allowed {allowed:e}", contact.formulation)
        });
    }
}

/// P1 and P2 are solutions and as good as their bound; the surface points of midway are roots along a line.
fn closest_slack(contact: &Contact) -> f64 {
    if contact.formulation == Formulation::Closest { contact.point_bound } else { 0.0 }
}

/// Moves B along the normal: by a little less than the overlap the surface points keep a common segment; beyond the
/// tangent planes of both at P3 nothing is common.
fn flips(
    verdict: &mut Verdict,
    scene: &Scene,
    contact: &Contact,
    bodies: &[Body; 2],
    start: &Vector3<f64>,
) -> Option<()> {
    let n = contact.normal;
    let rounding = 64.0 * EPS * scene.length + 4.0 * EPS * scene.far;
    let answer = |by: f64| scene.detect(&scene.moved(by * n), &FULL, None);
    if contact.kind == Kind::Overlapping {
        let less = contact.overlap * (1.0 - 1e-3) - rounding;
        if less > 0.0 {
            match answer(less) {
                Ok(after) => {
                    let right = after.kind == Kind::Overlapping || after.s - after.gap <= 1.0;
                    verdict.check(right, Failure::FlipsEarly, || {
                        format!("moved by {less:e} of {:e}: s={:e} ± {:e}", contact.overlap, after.s, after.gap)
                    });
                }
                Err(error) => verdict.fail(Failure::Error, format!("moved by {less:e}: {error}")),
            }
        }
    }
    let x = Wide3::from(*start);
    let mut apart = rounding;
    for (body, direction) in [(&bodies[0], n), (&bodies[1], -n)] {
        let local = body.at(&x);
        let steep = local.gradient.norm().f64();
        let outward = local.gradient.f64() / steep;
        // How far the body reaches beyond P3 along the normal: its tangent plane, tilted by what the normal is off.
        let reach = (Wide::ONE - local.value).f64() / steep;
        let farthest = (start - body.centre()).norm() + body.particle.bounding_radius();
        apart += reach + (outward - direction).norm() * farthest;
    }
    apart += 1e-3 * apart.abs();
    if apart.is_finite() && apart.abs() < 4.0 * scene.length {
        match answer(apart) {
            Ok(after) => {
                let right = after.kind == Kind::Separated || after.s + after.gap >= 1.0;
                verdict.check(right, Failure::FlipsLate, || {
                    format!("moved by {apart:e}, overlap {:e}: s={:e} ± {:e}", contact.overlap, after.s, after.gap)
                });
            }
            Err(error) => verdict.fail(Failure::Error, format!("moved by {apart:e}: {error}")),
        }
    }
    Some(())
}

/// What the rounding of lengths does to s, both ways of rounding counted.
fn steepness(bodies: &[Body; 2], at: &Vector3<f64>) -> f64 {
    let x = Wide3::from(*at);
    bodies
        .iter()
        .map(|body| {
            let local = body.at(&x);
            (local.pull + local.gradient.norm().f64()) / (2.0 * local.value.sqrt().f64()).max(f64::MIN_POSITIVE)
        })
        .fold(0.0, f64::max)
}

fn swapped(verdict: &mut Verdict, scene: &Scene, one: &Contact) {
    let answer = detect(scene.b, &scene.at_b, scene.a, &scene.at_a, &FULL, None);
    match answer {
        Ok(other) => {
            let both = one.gap + other.gap;
            verdict.check((one.s - other.s).abs() <= both, Failure::Swap, || {
                format!("s={:e} and {:e}, gaps {both:e}", one.s, other.s)
            });
            let flat = scene.a.sphericity().min(scene.b.sphericity()) < 1e-12;
            let off = (one.branch_b - other.branch_a).norm();
            let allowed = one.point_bound + other.point_bound + 8.0 * EPS * scene.length;
            verdict
                .check(flat || off <= allowed, Failure::Swap, || format!("points {off:e} apart, bounds {allowed:e}"));
        }
        Err(error) => verdict.fail(Failure::Error, format!("swapped: {error}")),
    }
}

fn carried(
    verdict: &mut Verdict,
    case: &Case,
    scene: &Scene,
    before: &Contact,
    bodies: &[Body; 2],
    random: &mut Random,
) {
    let q = [random.normal(), random.normal(), random.normal(), random.normal()];
    let turn = UnitQuaternion::from_quaternion(Quaternion::new(q[0], q[1], q[2], q[3]));
    let shift = scene.length * random.direction();
    let carry = |place: &Place| {
        let [w, x, y, z] = place.orientation;
        let q = turn.quaternion() * Quaternion::new(w, x, y, z);
        let position = turn * Vector3::from(place.position) + shift;
        Pose::new(position.into(), [q.w, q.i, q.j, q.k]).expect("a pose turned is a pose")
    };
    match detect(scene.a, &carry(&case.at_a), scene.b, &carry(&case.at_b), &FULL, None) {
        Ok(after) => {
            let rounding = 16.0 * EPS * (scene.length + scene.far);
            let allowed = before.gap + after.gap + steepness(bodies, &before.branch_b) * rounding;
            // Where s vanishes its square is what moves smoothly.
            let squares = (before.s * before.s - after.s * after.s).abs();
            let right = (before.s - after.s).abs() <= allowed || squares <= allowed * allowed;
            verdict.check(right, Failure::RigidMotion, || {
                format!("s={:e} and {:e}, allowed {allowed:e}", before.s, after.s)
            });
        }
        Err(error) => verdict.fail(Failure::Error, format!("carried along: {error}")),
    }
}

fn in_other_units(verdict: &mut Verdict, scene: &Scene, before: &Contact, units: &Units) {
    let unit = 2f64.powi(units.exponent);
    let place = |pose: &Pose| Pose { position: unit * pose.position, ..*pose };
    match detect(&units.a, &place(&scene.at_a), &units.b, &place(&scene.at_b), &FULL, None) {
        Ok(after) => {
            let same = after.s == before.s && after.branch_b == unit * before.branch_b && after.normal == before.normal;
            verdict.unit_digits = !same;
            let both = before.gap + after.gap;
            verdict.check((before.s - after.s).abs() <= both, Failure::Units, || {
                format!("unit 2^{}: s={:e} and {:e}, gaps {both:e}", units.exponent, before.s, after.s)
            });
        }
        Err(error) => verdict.fail(Failure::Error, format!("unit 2^{}: {error}", units.exponent)),
    }
}

/// Remembers a pose a step away, or another pair, and solves this one.
fn warm(verdict: &mut Verdict, scene: &Scene, cold: &Contact, clock: &mut Cost, random: &mut Random) {
    let small = scene.a.bounding_radius().min(scene.b.bounding_radius());
    let step = small * 10f64.powf(-6.0 + 5.0 * random.uniform());
    let mut memory = Memory::default();
    if let Err(error) = scene.detect(&scene.moved(step * random.direction()), &FULL, Some(&mut memory)) {
        verdict.fail(Failure::Error, format!("a step of {step:e}: {error}"));
        return;
    }
    let answer = clock.time(Call::Warm, || scene.detect(&scene.at_b, &FULL, Some(&mut memory.clone())));
    match answer {
        Ok(warm) => {
            verdict.paths.push((Call::Warm, path(&warm)));
            same(verdict, cold, &warm, scene);
        }
        Err(error) => verdict.fail(Failure::Error, format!("warm: {error}")),
    }
    let quick =
        clock.time(Call::QuickWarm, || scene.detect(&scene.at_b, &Settings::default(), Some(&mut memory.clone())));
    match quick {
        Ok(quick) => {
            verdict.paths.push((Call::QuickWarm, path(&quick)));
            let right = quick.kind == cold.kind || (cold.s - 1.0).abs() <= cold.gap;
            verdict.check(right, Failure::Warm, || format!("quick {:?}, cold s={:e}", quick.flags, cold.s));
        }
        Err(error) => verdict.fail(Failure::Error, format!("quick and warm: {error}")),
    }
}

fn same(verdict: &mut Verdict, cold: &Contact, warm: &Contact, scene: &Scene) {
    let both = cold.gap + warm.gap;
    verdict.check((cold.s - warm.s).abs() <= both, Failure::Warm, || {
        format!("s={:e} cold and {:e} warm, gaps {both:e}", cold.s, warm.s)
    });
    let flat = scene.a.sphericity().min(scene.b.sphericity()) < 1e-12;
    let off = (cold.branch_b - warm.branch_b).norm();
    let allowed = cold.point_bound + warm.point_bound + 8.0 * EPS * scene.length;
    verdict.check(flat || off <= allowed, Failure::Warm, || format!("points {off:e} apart, bounds {allowed:e}"));
}

fn closest(verdict: &mut Verdict, scene: &Scene, midway: &Contact, bodies: &[Body; 2], clock: &mut Cost) {
    let settings = |weight_on_a| Settings { formulation: Formulation::Closest, weight_on_a, ..FULL };
    let answer = clock.time(Call::Closest, || scene.detect(&scene.at_b, &settings(0.0), None));
    let (on_b, on_a) = match (answer, scene.detect(&scene.at_b, &settings(1.0), None)) {
        (Ok(on_b), Ok(on_a)) => (on_b, on_a),
        (Err(error), _) | (_, Err(error)) => {
            verdict.fail(Failure::Error, format!("closest: {error}"));
            return;
        }
    };
    verdict.paths.push((Call::Closest, path(&on_b)));
    verdict.check(on_b.kind == midway.kind, Failure::WrongSide, || {
        format!("closest {:?}, midway {:?}", on_b.kind, midway.kind)
    });
    if on_b.flags.contains(Flags::SLACK) {
        verdict.check(on_b.formulation == Formulation::Midway && on_b.s == midway.s, Failure::Malformed, || {
            format!("slack, but {on_b:?}")
        });
        return;
    }
    surfaces(verdict, scene, &on_b, bodies);
    let flat = scene.a.sphericity().min(scene.b.sphericity()) < 1e-12;
    let lambda = on_b.weight / (1.0 - on_b.weight);
    for (wanted, contact, s) in [(Wanted::OnB, &on_b, on_b.s), (Wanted::OnA, &on_a, on_a.s_b)] {
        let point = &contact.branch_b;
        let truth = optimum(&bodies[0], &bodies[1], wanted, point, lambda);
        let Some(truth) = truth.filter(|truth| (truth.most - truth.least).abs() <= 0.1 * contact.gap) else {
            verdict.unjudged += 1;
            continue;
        };
        verdict.judged += 1;
        let off = (s - truth.most).abs().min((s - truth.least).abs());
        verdict.check(off <= contact.gap, Failure::BoundOfS, || {
            format!("{wanted:?}: s={s:e} ± {:e}, truth {:e}", contact.gap, truth.most)
        });
        let distance = truth.x.minus(&Wide3::from(*point)).norm().f64();
        if !flat && truth.doubt < 0.05 * contact.point_bound {
            verdict.check(distance <= contact.point_bound + truth.doubt, Failure::BoundOfPoint, || {
                format!("{wanted:?}: {distance:e} off, bound {:e}", contact.point_bound)
            });
        }
    }
}

fn by_cone_program(verdict: &mut Verdict, scene: &Scene, fast: &Contact) {
    match scene.detect(&scene.at_b, &Settings { back_end: BackEnd::Conic, ..FULL }, None) {
        Ok(conic) => {
            verdict.conic = Some(true);
            // clarabel stops at about 1e-8 of its own scaled numbers; its bound is no proof below that.
            let allowed = 1e-6 * fast.s.max(1.0) + fast.gap + conic.gap;
            verdict.check((conic.s - fast.s).abs() <= allowed, Failure::Conic, || {
                format!("cone program s={:e} ± {:e}, fast {:e} ± {:e}", conic.s, conic.gap, fast.s, fast.gap)
            });
        }
        // The judge may give up where the judged does not.
        Err(_) => verdict.conic = Some(false),
    }
}
