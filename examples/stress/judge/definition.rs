//! What every right answer must satisfy, whatever the truth is.

use super::solutions::same;
use super::{EPS, FULL, Failure, Scene, Units, Verdict};
use crate::cases::{Case, Place};
use crate::random::Random;
use crate::reference::Body;
use crate::wide::{Wide, Wide3};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use potential_particles::{Contact, Formulation, Kind, Pose, detect};

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

pub(super) fn surfaces(verdict: &mut Verdict, scene: &Scene, contact: &Contact, bodies: &[Body; 2]) {
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
        let inside = |p: Vector3<f64>| body.at(&Wide3::from(p)).value.f64() <= 1.0;
        let straddles =
            |way: Vector3<f64>| (inside(point) || inside(point - allowed * way)) && !inside(point + allowed * way);
        // A line that grazes a face crosses it later than a point is off it: across the face as well.
        let across = || {
            let outside = (0..8).map(|i| point + allowed * f64::from(1 << i) * outwards).find(|p| !inside(*p))?;
            body.at(&Wide3::from(outside)).gradient.f64().try_normalize(0.0)
        };
        let between = off <= allowed || straddles(outwards) || across().is_some_and(straddles);
        verdict.check(between, Failure::OffSurface, || {
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
pub(super) fn flips(
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

pub(super) fn swapped(verdict: &mut Verdict, scene: &Scene, one: &Contact) {
    let answer = detect(scene.b, &scene.at_b, scene.a, &scene.at_a, &FULL, None);
    match answer {
        Ok(other) => {
            // What was B is A now.
            let other = Contact { branch_b: other.branch_a, ..other };
            same(verdict, Failure::Swap, one, &other, scene);
        }
        Err(error) => verdict.fail(Failure::Error, format!("swapped: {error}")),
    }
}

pub(super) fn carried(
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

pub(super) fn in_other_units(verdict: &mut Verdict, scene: &Scene, before: &Contact, units: &Units) {
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
