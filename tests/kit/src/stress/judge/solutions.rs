//! The answer beside other solutions: in 32 digits, from memory, by closest and by the cone program.

use super::definition::{NEARLY, stays_in_plane, surfaces};
use super::{Doubt, EPS, FULL, Fault, LOOSE, Scene, Verdict, path};
use crate::random::Random;
use crate::stress::clock::{Call, Clock};
use crate::stress::reference::{Body, Optimum, Wanted, optimum};
use crate::wide::Wide3;
use nalgebra::Vector3;
use potential_particles::{
    BackEnd, Contact, Flags, Formulation, Kind, PairState, Particle, Role, Settings, closest_point,
};

/// Asks the second solver, from a start near the answer.
pub(super) fn settle(verdict: &mut Verdict, scene: &Scene, contact: &Contact, start: &Vector3<f64>) {
    let [a, b] = &scene.bodies;
    let lambda = contact.weight / (1.0 - contact.weight);
    match optimum(a, b, Wanted::Midway, start, lambda) {
        Some(truth) if is_settled(&truth, contact.gap) => {
            verdict.judged += 1;
            midway(verdict, scene, contact, &truth, start);
        }
        Some(truth) => {
            verdict.unjudged += 1;
            unsettled(verdict, Wanted::Midway, (contact.s, contact.gap), &truth);
        }
        None => verdict.unjudged += 1,
    }
}

/// What is proved counts, settled or not.
fn unsettled(verdict: &mut Verdict, wanted: Wanted, (s, gap): (f64, f64), truth: &Optimum) {
    let outside = s + gap < truth.least || s - gap > truth.most;
    verdict.check(!outside, Fault::BoundOfS, || {
        format!("{wanted:?}: s={s:e} ± {gap:e}, but in [{:e}, {:e}]", truth.least, truth.most)
    });
}

fn midway(verdict: &mut Verdict, scene: &Scene, contact: &Contact, truth: &Optimum, start: &Vector3<f64>) {
    let (s, gap) = (contact.s, contact.gap);
    let scale = truth.most.max(1.0);
    let off = (s - truth.most).abs().min((s - truth.least).abs());
    verdict.measures.error = Some(off / scale);
    verdict.check(s + gap >= truth.least && s - gap <= truth.most, Fault::BoundOfS, || {
        format!(
            "s={s:e} ± {gap:e}, truth {:e} (± {:e}): {:.2} gaps off",
            truth.most,
            truth.most - truth.least,
            off / gap
        )
    });
    let overlapping = contact.kind == Kind::Overlapping;
    let wrong = if overlapping { truth.least > 1.0 + gap } else { truth.most < 1.0 - gap };
    verdict.check(!wrong, Fault::WrongSide, || format!("{:?}, s={s:e}, truth {:e}", contact.kind, truth.most));

    let u = truth.lambda.f64() / (1.0 + truth.lambda.f64());
    // A point far from both centres is a length as well.
    let risen = scene.bodies.each_ref().map(|body| {
        let far = (truth.x.f64() - body.centre()).norm();
        body.risen(&truth.x, EPS * scene.length.max(far))
    });
    let excess = gap * (2.0 * s + gap);
    let mut looseness = excess / explained(scene, scale, u, risen);
    if looseness > LOOSE {
        looseness = looseness.min(excess / shaken(scene, contact, truth));
    }
    verdict.check(looseness <= LOOSE, Fault::LooseBound, || {
        format!("s={s:e} ± {gap:e}, truth {:e}: {looseness:.1e} times what rounding explains", truth.most)
    });

    let small = scene.small();
    let distance = truth.x.minus(&Wide3::from(*start)).norm().f64();
    if scene.is_flat_faced() {
        regularised(verdict, scene, contact, start);
    } else if truth.doubt < 0.05 * contact.point_bound {
        verdict.measures.point_error = Some(distance / small);
        verdict.check(distance <= contact.point_bound + truth.doubt, Fault::BoundOfPoint, || {
            format!("{distance:e} off, bound {:e}, small {small:e}", contact.point_bound)
        });
        precise(verdict, scene, truth);
        let told = !contact.flags.contains(Flags::NORMAL_BY_CENTRES);
        if let Some(normal) = truth.normal().filter(|_| told) {
            let angle = (contact.normal - normal).norm();
            // How fast a normal turns along the surface, times how well the point is known.
            let known = contact.point_bound + 8.0 * EPS * scene.length;
            let allowed = 8.0 * EPS + 2.0 * (truth.a.bend() + truth.b.bend()) * known;
            verdict.check(angle <= allowed, Fault::Normal, || format!("{angle:e} off, allowed {allowed:e}"));
        }
    }
}

/// The point of flat faces is that of the particles as they are regularised.
fn regularised(verdict: &mut Verdict, scene: &Scene, contact: &Contact, start: &Vector3<f64>) {
    let [a, b] = scene.bodies.each_ref().map(|body| {
        let weight = FULL.flat_regularisation / body.particle.bounding_radius().powi(2);
        body.rounder(weight)
    });
    let lambda = contact.weight / (1.0 - contact.weight);
    let Some(truth) = optimum(&a, &b, Wanted::Midway, start, lambda) else { return };
    if is_settled(&truth, contact.gap) && truth.doubt < 0.05 * contact.point_bound {
        let off = truth.x.minus(&Wide3::from(*start)).norm().f64();
        let allowed = contact.point_bound + truth.doubt + 8.0 * EPS * start.norm();
        verdict.check(off <= allowed, Fault::BoundOfPoint, || format!("{off:e} off, bound {:e}", contact.point_bound));
    }
}

/// To the last digits: s within its gap, and the branch from A without the rounding of the way between the centres.
fn precise(verdict: &mut Verdict, scene: &Scene, truth: &Optimum) {
    let settings = FULL.with_gap_tolerance(1e-14);
    let contact = match scene.detect(&scene.at_b, &settings, None) {
        Ok(contact) => contact,
        Err(error) => return verdict.fail(Fault::NotSolved, format!("to 1e-14: {error}")),
    };
    let off = (contact.s - truth.most).max(truth.least - contact.s);
    verdict.check(off <= contact.gap + EPS * contact.s, Fault::BoundOfS, || {
        format!("to 1e-14: s={:e} ± {:e}, truth {:e}", contact.s, contact.gap, truth.most)
    });
    let [of_a, _] = &scene.bodies;
    let from_a = of_a.from_centre(&truth.x);
    let off = from_a.minus(&Wide3::from(contact.branch_a)).norm().f64();
    let overlap = if contact.overlap.is_finite() { contact.overlap } else { 0.0 };
    let allowed = contact.point_bound + truth.doubt + 4.0 * EPS * (from_a.norm().f64() + overlap);
    verdict.check(off <= allowed, Fault::Branch, || {
        format!("branch from A {off:e} off, allowed {allowed:e}, bound {:e}", contact.point_bound)
    });
}

/// What rounding does to s² where that is not of first order: from solving again with all planes moved in by the
/// rounding of a length, and with B turned either way by that of a direction.
///
/// At the tip of a wedge both sides push, and moved in by a tenth of r they leave no room in which to push so; faces
/// that lie on each other and are tilted by rounding leave a force along them that a plane at the edge may be too weak
/// to hold.
fn shaken(scene: &Scene, contact: &Contact, truth: &Optimum) -> f64 {
    let [a, b] = &scene.bodies;
    let (start, lambda) = (truth.x.f64(), truth.lambda.f64());
    let change = |a: &Body, b: &Body| {
        optimum(a, b, Wanted::Midway, &start, lambda).map_or(0.0, |other| {
            let square = |s: f64| s * s;
            (square(other.least) - square(truth.most)).max(square(truth.least) - square(other.most))
        })
    };
    let far = [a, b].map(|body| (start - body.centre()).norm()).into_iter().fold(scene.length, f64::max);
    let moved_in = change(&a.inset(EPS * far), &b.inset(EPS * far));
    let n = contact.normal;
    let across = n.cross(&Vector3::ith(n.iamin(), 1.0)).normalize();
    let axes = [across, n.cross(&across)].map(|axis| TURNED * EPS * axis);
    axes.iter().flat_map(|axis| [*axis, -axis]).map(|by| change(a, &b.tilted(&by))).fold(moved_in, f64::max)
}

/// Whether midway of two bodies lies within the gap of an answer, as far as 32 digits tell it.
pub(super) fn is_right([a, b]: &[Body; 2], contact: &Contact) -> bool {
    let (s, gap) = (contact.s, contact.gap);
    let lambda = contact.weight / (1.0 - contact.weight);
    let truth = optimum(a, b, Wanted::Midway, &contact.branch_b, lambda);
    truth.is_some_and(|truth| is_settled(&truth, gap) && s + gap >= truth.least && s - gap <= truth.most)
}

/// Whether the interval of an optimum is narrow enough to judge an answer with this gap.
fn is_settled(truth: &Optimum, gap: f64) -> bool {
    truth.most - truth.least <= 0.1 * gap + f64::MIN_POSITIVE
}

/// Units in the last place by which the direction of a normal is off that is turned by the product of two rotations,
/// each made from a quaternion.
const TURNED: f64 = 4.0;

/// The least that rounding lengths of this size does to s², the tolerance asked for, and what the regularisation of
/// flat faces adds. `scale` is s or 1; both S rise by `risen` when the planes move in by the rounding of a length.
pub(super) fn explained(scene: &Scene, scale: f64, weight: f64, [a, b]: [f64; 2]) -> f64 {
    let missing = |p: &Particle| (FULL.flat_regularisation - p.sphericity()).max(0.0);
    let flat = 2.0 * (missing(scene.a) + missing(scene.b));
    (1e-12 + flat) * scale * scale + (1.0 - weight) * a + weight * b
}

/// Remembers a pose a step away, or another pair, and solves this one.
pub(super) fn warm(verdict: &mut Verdict, scene: &Scene, cold: &Contact, clock: &mut Clock, random: &mut Random) {
    let Some(state) = remembered(verdict, scene, &FULL, random) else { return };
    let answer = clock.time(Call::Warm, || scene.detect(&scene.at_b, &FULL, Some(&mut state.clone())));
    match answer {
        Ok(warm) => {
            verdict.paths.push((Call::Warm, path(&warm)));
            same(verdict, Fault::Warm, cold, &warm, scene);
        }
        Err(error) => verdict.fail(Fault::NotSolved, format!("warm: {error}")),
    }
    let quick =
        clock.time(Call::QuickWarm, || scene.detect(&scene.at_b, &Settings::default(), Some(&mut state.clone())));
    match quick {
        Ok(quick) => {
            verdict.paths.push((Call::QuickWarm, path(&quick)));
            // Of two answers on either side of contact both may be right within their gaps.
            let right = quick.kind == cold.kind || (cold.s - 1.0).abs() <= cold.gap.max(quick.gap);
            verdict.check(right, Fault::Warm, || format!("quick {:?}, cold s={:e}", quick.flags, cold.s));
        }
        Err(error) => verdict.fail(Fault::NotSolved, format!("quick and warm: {error}")),
    }
}

/// What is remembered of a pose a step away.
fn remembered(verdict: &mut Verdict, scene: &Scene, settings: &Settings, random: &mut Random) -> Option<PairState> {
    let small = scene.small();
    let step = small * 10f64.powf(-6.0 + 5.0 * random.uniform());
    let mut state = PairState::default();
    match scene.detect(&scene.moved(step * scene.direction(random)), settings, Some(&mut state)) {
        Ok(_) => Some(state),
        Err(error) => {
            verdict.fail(Fault::NotSolved, format!("{:?}, a step of {step:e}: {error}", settings.formulation));
            None
        }
    }
}

/// Two answers to the same question, within their bounds.
pub(super) fn same(verdict: &mut Verdict, failure: Fault, one: &Contact, other: &Contact, scene: &Scene) {
    let both = one.gap + other.gap;
    verdict
        .check((one.s - other.s).abs() <= both, failure, || format!("s={:e} and {:e}, gaps {both:e}", one.s, other.s));
    let flat = scene.is_flat_faced();
    let off = (one.branch_b - other.branch_b).norm();
    let allowed = one.point_bound + other.point_bound + 8.0 * EPS * scene.length;
    verdict.check(flat || off <= allowed, failure, || format!("points {off:e} apart, bounds {allowed:e}"));
    let much = !((one.s - other.s).abs() <= NEARLY * both + 4.0 * EPS * one.s) || !(flat || off <= NEARLY * allowed);
    verdict.doubt(much, Doubt::Disagreement);
}

pub(super) fn closest(verdict: &mut Verdict, scene: &Scene, midway: &Contact, clock: &mut Clock, random: &mut Random) {
    let settings = |weight_on_a| FULL.with_formulation(Formulation::Closest).with_weight_on_a(weight_on_a);
    let answer = clock.time(Call::Closest, || scene.detect(&scene.at_b, &settings(0.0), None));
    let (on_b, on_a) = match (answer, scene.detect(&scene.at_b, &settings(1.0), None)) {
        (Ok(on_b), Ok(on_a)) => (on_b, on_a),
        (Err(error), _) | (_, Err(error)) => {
            verdict.fail(Fault::NotSolved, format!("closest: {error}"));
            return;
        }
    };
    verdict.paths.push((Call::Closest, path(&on_b)));
    let flat = [&on_a, &on_b].iter().all(|contact| stays_in_plane(scene.case.shapes, contact));
    verdict.check(flat, Fault::Malformed, || format!("leaves the plane: {on_a:?}, {on_b:?}"));
    closest_again(verdict, scene, [(&on_a, settings(1.0)), (&on_b, settings(0.0))], random);
    // Where the scale of midway leaves it open, one of closest may tell.
    let is_open = (midway.s - 1.0).abs() <= midway.gap;
    verdict.check(on_b.kind == midway.kind || is_open, Fault::WrongSide, || {
        format!("closest {:?}, midway {:?}", on_b.kind, midway.kind)
    });
    if on_b.flags.contains(Flags::SLACK) {
        verdict.check(on_b.formulation == Formulation::Midway && on_b.s == midway.s, Fault::Malformed, || {
            format!("slack, but {on_b:?}")
        });
        return;
    }
    surfaces(verdict, scene, &on_b);
    let bodies = &scene.bodies;
    let flat = scene.is_flat_faced();
    let lambda = on_b.weight / (1.0 - on_b.weight);
    for (wanted, on, contact, s) in [(Wanted::OnB, Role::B, &on_b, on_b.s), (Wanted::OnA, Role::A, &on_a, on_a.s_b)] {
        let point = &contact.branch_b;
        alone(verdict, scene, on, contact, s);
        let Some(truth) = optimum(&bodies[0], &bodies[1], wanted, point, lambda) else {
            verdict.unjudged += 1;
            continue;
        };
        if (truth.most - truth.least).abs() > 0.1 * contact.gap {
            verdict.unjudged += 1;
            unsettled(verdict, wanted, (s, contact.gap), &truth);
            continue;
        }
        verdict.judged += 1;
        let off = (s - truth.most).abs().min((s - truth.least).abs());
        verdict.check(off <= contact.gap, Fault::BoundOfS, || {
            format!("{wanted:?}: s={s:e} ± {:e}, truth {:e}", contact.gap, truth.most)
        });
        let distance = truth.x.minus(&Wide3::from(*point)).norm().f64();
        if !flat && truth.doubt < 0.05 * contact.point_bound {
            verdict.check(distance <= contact.point_bound + truth.doubt, Fault::BoundOfPoint, || {
                format!("{wanted:?}: {distance:e} off, bound {:e}", contact.point_bound)
            });
        }
    }
}

/// The one closest point, asked for alone, is that of both.
fn alone(verdict: &mut Verdict, scene: &Scene, on: Role, both: &Contact, s: f64) {
    match closest_point(scene.a, &scene.at_a, scene.b, &scene.at_b, on, &FULL) {
        Ok(Some(found)) => {
            let (off, gaps) = ((found.s - s).abs(), found.gap + both.gap);
            let aside = (found.branch_b - both.branch_b).norm();
            let bounds = found.point_bound + both.point_bound + 8.0 * EPS * scene.length;
            let between = found.point - found.branch_a - scene.at_a.position();
            let right = off <= gaps
                && (scene.is_flat_faced() || aside <= bounds)
                && between.norm() <= 8.0 * EPS * (scene.length + scene.far + found.branch_a.norm());
            verdict.check(right, Fault::BoundOfS, || format!("{on:?} alone: {off:e} off, {aside:e} aside, {found:?}"));
        }
        // Whether a scale can be told from 0 depends on its gap.
        Ok(None) => verdict.check(s <= both.gap, Fault::BoundOfS, || format!("{on:?} alone: none, but s={s:e}")),
        Err(error) => verdict.fail(Fault::NotSolved, format!("{on:?} alone: {error}")),
    }
}

/// Closest from what it remembers of a pose a step away.
fn closest_again(verdict: &mut Verdict, scene: &Scene, cold: [(&Contact, Settings); 2], random: &mut Random) {
    let Some(state) = remembered(verdict, scene, &cold[0].1, random) else { return };
    for (cold, settings) in cold {
        match scene.detect(&scene.at_b, &settings, Some(&mut state.clone())) {
            Ok(warm) if warm.formulation == cold.formulation => {
                same(verdict, Fault::Warm, cold, &warm, scene);
                let (both, off) = (cold.gap + warm.gap, (cold.s_b - warm.s_b).abs());
                // Slack, midway has one s only.
                let right = off <= both || cold.formulation == Formulation::Midway;
                verdict.check(right, Fault::Warm, || format!("s_b {off:e} apart, gaps {both:e}"));
            }
            // Whether a scale can be told from 0 depends on its gap.
            Ok(warm) => {
                let found = if warm.formulation == Formulation::Closest { &warm } else { cold };
                let right = found.s.min(found.s_b) <= warm.gap + cold.gap;
                verdict.check(right, Fault::Warm, || format!("slack {:?}, {:?} from memory", cold.flags, warm.flags));
            }
            Err(error) => verdict.fail(Fault::NotSolved, format!("closest, warm: {error}")),
        }
    }
}

pub(super) fn by_cone_program(verdict: &mut Verdict, scene: &Scene, fast: &Contact) {
    match scene.detect(&scene.at_b, &FULL.with_back_end(BackEnd::ConeProgram), None) {
        Ok(cone_program) => {
            verdict.cone_program = Some(true);
            let flat = stays_in_plane(scene.case.shapes, &cone_program);
            verdict.check(flat, Fault::Malformed, || format!("leaves the plane: {cone_program:?}"));
            // clarabel stops at about 1e-8 of its own scaled numbers; its bound is no proof below that.
            let allowed = 1e-6 * fast.s.max(1.0) + fast.gap + cone_program.gap;
            verdict.check((cone_program.s - fast.s).abs() <= allowed, Fault::ConeProgram, || {
                format!(
                    "cone program s={:e} ± {:e}, fast {:e} ± {:e}",
                    cone_program.s, cone_program.gap, fast.s, fast.gap
                )
            });
        }
        // The judge may give up where the judged does not.
        Err(_) => verdict.cone_program = Some(false),
    }
}
