//! What every right answer must satisfy, whatever the truth is.

use super::solutions::{explained, is_right, same};
use super::{Doubt, EPS, FULL, Fault, LOOSE, Scene, Shared, Verdict};
use crate::pair_line::Place;
use crate::random::Random;
use crate::stress::cases::{Case, Shapes};
use crate::stress::reference::{Body, sum};
use crate::wide::{Wide, Wide3, solve};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use potential_particles::{Contact, Formulation, Kind, Settings, detect, detect_batch};

pub(super) fn well_formed(verdict: &mut Verdict, scene: &Scene, c: &Contact) {
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
        && stays_in_plane(scene.case.shapes, c)
        && overlapping == (c.s < 1.0)
        && overlapping == (c.overlap.is_finite() && c.overlap >= 0.0)
        && overlapping == finite(&c.point_on_a)
        && overlapping == finite(&c.point_on_b)
        && c.overlap.is_nan() != overlapping;
    let rounding = 8.0 * EPS * (scene.length + scene.far + c.branch_b.norm());
    let consistent = (c.point - scene.at_a.position() - c.branch_a).norm() <= rounding
        && (c.point - scene.at_b.position() - c.branch_b).norm() <= rounding
        && (!overlapping
            || ((c.point_on_a - c.point_on_b).norm() - c.overlap).abs() <= rounding
                && (c.formulation != Formulation::Midway
                    || (c.point_on_a - c.point_on_b - c.overlap * c.normal).norm() <= rounding));
    verdict.check(fine && consistent, Fault::Malformed, || format!("{c:?}"));
}

/// Of shapes in the plane z stays 0, unless it is no number.
pub fn stays_in_plane(shapes: &Shapes, c: &Contact) -> bool {
    let all = [c.point, c.normal, c.branch_a, c.branch_b, c.point_on_a, c.point_on_b];
    !shapes.is_flat() || all.iter().all(|v| v.z.is_nan() || v.z == 0.0)
}

/// A gap beyond this that leaves open whether they touch is no answer.
const MOST_GAP: f64 = 1e-2;

pub(super) fn says_something(verdict: &mut Verdict, c: &Contact) {
    let open = c.gap > MOST_GAP && c.s - c.gap < 1.0 && 1.0 < c.s + c.gap;
    verdict.check(!open, Fault::SaysNothing, || format!("s={:e} ± {:e}", c.s, c.gap));
}

/// A batch of one pair is, to the last bit, the call for it alone.
pub(super) fn batched(verdict: &mut Verdict, scene: &Scene) {
    let settings = Settings::default();
    let alone = detect(scene.a, &scene.at_a, scene.b, &scene.at_b, &settings, None);
    let (particles, poses) = ([scene.a, scene.b], [scene.at_a, scene.at_b]);
    let same = match detect_batch(&particles, &poses, &[[0, 1]], &settings, 1, &mut []) {
        Ok(answers) => match (&alone, &answers[0]) {
            (Ok(alone), Ok(batched)) => {
                alone.kind == batched.kind && alone.flags == batched.flags && alone.s.to_bits() == batched.s.to_bits()
            }
            (Err(alone), Err(batched)) => alone.to_string() == batched.to_string(),
            _ => false,
        },
        Err(_) => alone.is_err(),
    };
    verdict.check(same, Fault::Batch, || format!("{alone:?}"));
}

/// Relative to s or 1: nearer than this doubles need not come.
const NEAR: f64 = 1e-6;
/// The same, in what the rounding of lengths does to s².
const ROUGHLY: f64 = 1e2;
/// Share of what is allowed beyond which the second solver is asked.
pub(super) const NEARLY: f64 = 0.5;
/// The same of a gap that is too loose; lower, since the point is not quite that of the truth.
const NEARLY_LOOSE: f64 = 0.1;
/// Steps by which the linear functions are levelled.
const MOST_STEPS: usize = 4;

/// What is proved at the answer's point: s² is at most the larger S there, and at least what linear functions below
/// both bodies have in common. Where that is near the answer, and its gap is what rounding explains, nothing is in
/// doubt.
pub(super) fn enclosed(verdict: &mut Verdict, scene: &Scene, contact: &Contact, start: &Vector3<f64>) {
    let (s, gap) = (contact.s, contact.gap);
    let mut x = Wide3::from(*start);
    let risen = scene.bodies.each_ref().map(|body| body.risen(&x, EPS * scene.length));
    let rounding = explained(scene, s.max(1.0), contact.weight, risen);
    verdict.doubt(!(gap * (2.0 * s + gap) <= NEARLY_LOOSE * LOOSE * rounding), Doubt::Gap);

    let at = |x: &Wide3| scene.bodies.each_ref().map(|body| body.at(x));
    // Weights that sum up to 1 in 32 digits.
    let of_b = Wide::from(contact.weight);
    let of_a = Wide::ONE - of_b;
    let (mut least, mut most) = (0.0_f64, f64::INFINITY);
    let mut near = false;
    for _ in 0..MOST_STEPS {
        let [a, b] = at(&x);
        most = most.min(a.value.max(b.value).f64());
        let slope = a.gradient.times(of_a).plus(&b.gradient.times(of_b));
        let reach = scene.bodies.each_ref().map(|body| body.farthest(&x, most));
        let reach = Wide::from(reach[0].min(reach[1]) * (1.0 + 1e-10));
        least = least.max((a.value * of_a + b.value * of_b - slope.norm() * reach).f64());
        // Where s vanishes its square is what is known; and no one knows more than rounding allows.
        near = most.sqrt() - least.sqrt() <= NEAR * s.max(1.0) + gap || most - least <= ROUGHLY * rounding;
        if near {
            break;
        }
        // Newton's step levels the sum, where the planes stay, and what λ would do on top makes both S equal.
        let hessian = sum(&a.hessian.map(|entry| entry * of_a), &b.hessian, of_b);
        let (level, apart) = (solve(&hessian, &slope), a.gradient.minus(&b.gradient));
        let way = solve(&hessian, &apart);
        let behind = a.value - b.value - apart.dot(&level);
        let share = behind / apart.dot(&way);
        x = x.minus(&level);
        if share.is_finite() {
            let [a, b] = at(&x.minus(&way.times(share)));
            most = most.min(a.value.max(b.value).f64());
        }
    }
    let (below, above) = (least.sqrt() * (1.0 - 2.0 * EPS), most.sqrt() * (1.0 + 2.0 * EPS));
    verdict.check(!(s - gap > above), Fault::BoundOfS, || format!("s={s:e} ± {gap:e}, but at most {above:e}"));
    verdict.check(!(s + gap < below), Fault::BoundOfS, || format!("s={s:e} ± {gap:e}, but at least {below:e}"));
    verdict.doubt(!near, Doubt::Enclosure);
}

pub(super) fn surfaces(verdict: &mut Verdict, scene: &Scene, contact: &Contact) {
    if contact.kind != Kind::Overlapping {
        return;
    }
    let allowed = 32.0 * EPS * scene.length + 2.0 * EPS * scene.far + closest_slack(contact);
    let n = contact.normal;
    for (i, point, outwards, name) in [(0, contact.point_on_a, n, "A"), (1, contact.point_on_b, -n, "B")] {
        let point = point - scene.at_b.position();
        let body = &scene.bodies[i];
        let off = off_surface(body, &point);
        // Where s bends within the rounding of the point, the first order says nothing: then there has to be a point
        // inside and one outside within that.
        let inside = |p: Vector3<f64>| body.at(&Wide3::from(p)).value.f64() <= 1.0;
        let straddles =
            |way: Vector3<f64>| (inside(point) || inside(point - allowed * way)) && !inside(point + allowed * way);
        // A line that grazes a face crosses it later than a point is off it: across the face as well.
        let across = || {
            let steps =
                std::iter::successors(Some(allowed), |step| Some(2.0 * step)).take_while(|step| *step < scene.length);
            let outside = steps.map(|step| point + step * outwards).find(|p| !inside(*p))?;
            body.at(&Wide3::from(outside)).gradient.f64().try_normalize(0.0)
        };
        // A plane nearly parallel to the line may bound the body at the exact point and be inactive at the rounded one.
        let beside = || inside(point) && body.inset(allowed).at(&Wide3::from(point)).value.f64() > 1.0;
        let between = off <= allowed || straddles(outwards) || across().is_some_and(straddles) || beside();
        verdict.check(between, Fault::OffSurface, || {
            format!("{:?}: point on {name} {off:e} off, allowed {allowed:e}", contact.formulation)
        });
    }
}

/// Distance of a point from the surface {S = 1}, to first order from s.
fn off_surface(body: &Body, point: &Vector3<f64>) -> f64 {
    let local = body.at(&Wide3::from(*point));
    let s = local.value.sqrt();
    let steepness = (local.gradient.norm() / (s + s)).f64();
    ((s - Wide::ONE).f64() / steepness).abs()
}

/// P1 and P2 are solutions and as good as their bound; the surface points of midway are roots along a line.
fn closest_slack(contact: &Contact) -> f64 {
    if contact.formulation == Formulation::Closest { contact.point_bound } else { 0.0 }
}

/// Moves B along the normal: by a little less than the overlap the surface points keep a common segment; beyond the
/// tangent planes of both at P3 nothing is common.
pub(super) fn flips(verdict: &mut Verdict, scene: &Scene, contact: &Contact, start: &Vector3<f64>, thorough: bool) {
    let n = contact.normal;
    let rounding = 64.0 * EPS * scene.length + 4.0 * EPS * scene.far;
    let less = contact.overlap * (1.0 - 1e-3) - rounding;
    let overlaps = contact.kind == Kind::Overlapping && less > 0.0;
    if let Some(after) = overlaps.then(|| moved(verdict, scene, less * n, Kind::Overlapping, thorough)).flatten() {
        let doubt = after.gap + displaced(scene, &after, &(less * n));
        let right = after.kind == Kind::Overlapping || after.s - doubt <= 1.0;
        verdict.check(right, Fault::FlipsEarly, || {
            format!("moved by {less:e} of {:e}: s={:e} ± {:e}", contact.overlap, after.s, after.gap)
        });
    }
    let apart = rounding + tangents(scene, contact, start);
    let apart = apart + 1e-3 * apart.abs();
    let sensible = apart.is_finite() && apart.abs() < 4.0 * scene.length;
    if let Some(after) = sensible.then(|| moved(verdict, scene, apart * n, Kind::Separated, thorough)).flatten() {
        let doubt = after.gap + displaced(scene, &after, &(apart * n));
        let right = after.kind == Kind::Separated || after.s + doubt >= 1.0;
        verdict.check(right, Fault::FlipsLate, || {
            format!("moved by {apart:e}, overlap {:e}: s={:e} ± {:e}", contact.overlap, after.s, after.gap)
        });
    }
}

/// The answer after a move, solved to the end where default settings do not find the kind that is expected, or where
/// all is asked for.
fn moved(verdict: &mut Verdict, scene: &Scene, by: Vector3<f64>, kind: Kind, thorough: bool) -> Option<Contact> {
    let at_b = scene.moved(by);
    let mut answer = |settings: &Settings| match scene.detect(&at_b, settings, None) {
        Ok(after) => Some(after),
        Err(error) => {
            verdict.fail(Fault::NotSolved, format!("moved by {:e}: {error}", by.norm()));
            None
        }
    };
    if thorough {
        return answer(&FULL);
    }
    let quick = answer(&Settings::default())?;
    if quick.kind == kind {
        return Some(quick);
    }
    let full = answer(&FULL)?;
    verdict.check(quick.kind == full.kind || (full.s - 1.0).abs() <= full.gap, Fault::Reject, || {
        format!(
            "moved by {:e}: quick {:?} {:?}, full s={:e} ± {:e}",
            by.norm(),
            quick.kind,
            quick.flags,
            full.s,
            full.gap
        )
    });
    Some(full)
}

/// How far both bodies together reach beyond P3 along the normal: their tangent planes, tilted by what the normal is
/// off.
fn tangents(scene: &Scene, contact: &Contact, start: &Vector3<f64>) -> f64 {
    let x = Wide3::from(*start);
    let reach = |(body, direction): (&Body, Vector3<f64>)| {
        let local = body.at(&x);
        let steep = local.gradient.norm().f64();
        let tilt = (local.gradient.f64() / steep - direction).norm();
        (Wide::ONE - local.value).f64() / steep + tilt * body.farthest(&x, 1.0)
    };
    scene.bodies.iter().zip([contact.normal, -contact.normal]).map(reach).sum()
}

pub(super) fn swapped(verdict: &mut Verdict, scene: &Scene, one: &Contact) {
    let answer = (scene.solver)(scene.b, &scene.at_b, scene.a, &scene.at_a, &FULL, None);
    match answer {
        Ok(mut other) => {
            // What was B is A now.
            other.branch_b = other.branch_a;
            same(verdict, Fault::Swap, one, &other, scene);
        }
        Err(error) => verdict.fail(Fault::NotSolved, format!("swapped: {error}")),
    }
}

pub(super) fn carried(verdict: &mut Verdict, case: &Case, scene: &Scene, before: &Contact, random: &mut Random) {
    let [w, x, y, z] = random.turn_in(case.shapes.is_flat());
    let turn = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
    let shift = scene.length * scene.direction(random);
    let carry = |place: &Place| {
        let [w, x, y, z] = place.pose().orientation();
        let q = turn.quaternion() * Quaternion::new(w, x, y, z);
        let position = (turn * Vector3::from(place.position) + shift).into();
        Place { position, orientation: [q.w, q.i, q.j, q.k], angle: None }
    };
    let (at_a, at_b) = (carry(&case.at_a), carry(&case.at_b));
    match (scene.solver)(scene.a, &at_a.pose(), scene.b, &at_b.pose(), &FULL, None) {
        Ok(after) => {
            // The rounding of a turn moves a point in proportion to its distance from the centres, which can be any
            // length where a body has no plane on one side.
            let branches = [before.branch_a, before.branch_b, after.branch_a, after.branch_b];
            let lever = branches.iter().map(|branch| branch.norm()).fold(scene.length, f64::max);
            let rounding = 16.0 * EPS * (lever + scene.far);
            // Deep inside nothing is steep; a wall that rounding carries over the point is.
            let there = turn.inverse() * after.branch_b;
            let steepest = steepness(scene, &before.branch_b).max(steepness(scene, &there));
            let allowed = before.gap + after.gap + steepest * rounding;
            // Where s vanishes its square is what moves smoothly.
            let squares = (before.s * before.s - after.s * after.s).abs();
            let right = (before.s - after.s).abs() <= allowed || squares <= allowed * allowed;
            // The poses are rounded anew. Where that does more to s than the first order, each answer has to be that of
            // its own poses.
            let right = right || {
                let [of_a, of_b] =
                    [(scene.a, &at_a), (scene.b, &at_b)].map(|(body, at)| Body::new(body, at, at_b.position));
                is_right(&scene.bodies, before) && is_right(&[of_a, of_b], &after)
            };
            let right = right || (before.s - after.s).abs() <= allowed + moved_along_normal(scene, before, rounding);
            verdict.check(right, Fault::RigidMotion, || {
                format!("s={:e} and {:e}, allowed {allowed:e}", before.s, after.s)
            });
        }
        Err(error) => verdict.fail(Fault::NotSolved, format!("carried along: {error}")),
    }
}

/// By how much s changes when B is moved along the normal, both ways, by this length; 0 where it is not found. With a
/// radius near the rounding of a position, a plane carries the contact by less than doubles can tell of a point, and 32
/// digits do not settle the pair: no gradient at the point shows then how steep s is, while the change of s itself
/// does.
fn moved_along_normal(scene: &Scene, before: &Contact, length: f64) -> f64 {
    let s_at = |way: f64| scene.detect(&scene.moved(way * before.normal), &FULL, None).ok().map(|contact| contact.s);
    s_at(-length).zip(s_at(length)).map_or(0.0, |(nearer, farther)| (farther - nearer).max(0.0))
}

/// What the rounding of a position far from the origin does to s after B was moved: it is not moved by just that.
fn displaced(scene: &Scene, after: &Contact, by: &Vector3<f64>) -> f64 {
    let steep = |i: usize, at: Vector3<f64>| scene.bodies[i].at(&Wide3::from(at)).steepness();
    4.0 * EPS * scene.far * steep(0, after.branch_b + by).max(steep(1, after.branch_b))
}

/// What the rounding of lengths does to s, both ways of rounding counted.
fn steepness(scene: &Scene, at: &Vector3<f64>) -> f64 {
    scene.bodies.iter().map(|body| body.at(&Wide3::from(*at)).steepness()).fold(0.0, f64::max)
}

pub(super) fn in_other_units(verdict: &mut Verdict, scene: &Scene, before: &Contact, shared: &Shared) {
    let unit = 2f64.powi(shared.exponent);
    let [a, b] = &shared.in_other_units;
    let [at_a, at_b] = [scene.case.at_a, scene.case.at_b].map(|at| at.at(unit * Vector3::from(at.position)).pose());
    match (scene.solver)(a, &at_a, b, &at_b, &FULL, None) {
        Ok(after) => {
            let same = after.s == before.s && after.branch_b == unit * before.branch_b && after.normal == before.normal;
            verdict.unit_digits = !same;
            let both = before.gap + after.gap;
            verdict.check((before.s - after.s).abs() <= both, Fault::Units, || {
                format!("unit 2^{}: s={:e} and {:e}, gaps {both:e}", shared.exponent, before.s, after.s)
            });
        }
        Err(error) => verdict.fail(Fault::NotSolved, format!("unit 2^{}: {error}", shared.exponent)),
    }
}
