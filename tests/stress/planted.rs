//! The judge's own test: solvers with a planted error must be found out in bulk, where the second solver is asked only
//! about answers that look doubtful; and the right one must not.

use kit::stress::cases::{BULK, Case, Shapes, family_of, next_group, stream};
use kit::stress::judge::{FULL, Shared, Solver, Trial, judge};
use kit::stress::ledger::Fault;
use nalgebra::Vector3;
use potential_particles::{Contact, DetectError, Kind, PairState, Particle, Plane, Pose, Settings, detect};
use std::collections::BTreeMap;

type Answer = Result<Contact, DetectError>;

/// What is seen of the right and the given answer.
type Counts = fn(&Contact, &Contact) -> bool;

/// Pairs of `families` of which `counts` holds: how many were judged, how many failed, and the failures by kind.
fn found(solver: Solver, families: &[usize], pairs: usize, counts: Counts) -> (usize, usize, BTreeMap<Fault, u64>) {
    let (mut judged, mut failed, mut kinds) = (0, 0, BTreeMap::new());
    let mut index = BULK;
    while judged < pairs {
        if families.contains(&family_of(index)) {
            let shapes = Shapes::of(1, index);
            let shared = Shared::of(&shapes.a, &shapes.b, &mut stream(1, 3, shapes.group));
            for index in index..index + POSES {
                let case = Case::of(&shapes, 1, index);
                let answer =
                    |solver: Solver| solver(&shapes.a, &case.at_a.pose(), &shapes.b, &case.at_b.pose(), &FULL, None);
                let (right, given) = (answer(detect), answer(solver));
                if !counts(&right.expect("an answer"), &given.expect("an answer")) {
                    continue;
                }
                let verdict = judge(&case, &shared, Trial::BY_DEFINITION, solver, &mut stream(1, 4, index));
                judged += 1;
                failed += usize::from(!verdict.faults.is_empty());
                verdict.faults.iter().for_each(|(kind, _)| *kinds.entry(*kind).or_default() += 1);
            }
        }
        index = next_group(index);
    }
    (judged, failed, kinds)
}

const ANY: Counts = |_, _| true;
/// An overlap of which a millionth is more than rounding.
const DEEP: Counts = |right, _| {
    right.kind == Kind::Overlapping && right.overlap > 1e-3 * right.branch_a.norm().max(right.branch_b.norm())
};

/// Poses of two shapes that are looked at.
const POSES: u64 = 20;
/// generic, few planes, needles, aligned boxes.
const FAMILIES: [usize; 4] = [0, 1, 7, 13];

/// What the right answer is made into.
fn spoilt(
    (a, at_a, b, at_b): (&Particle, &Pose, &Particle, &Pose),
    settings: &Settings,
    state: Option<&mut PairState>,
    spoil: impl Fn(&mut Contact),
) -> Answer {
    let mut contact = detect(a, at_a, b, at_b, settings, state)?;
    spoil(&mut contact);
    Ok(contact)
}

macro_rules! planted {
    ($spoil:expr) => {
        |a, at_a, b, at_b, settings, state| spoilt((a, at_a, b, at_b), settings, state, $spoil)
    };
}

#[test]
fn right_answers_pass_in_bulk() {
    let (judged, failed, kinds) = found(detect, &FAMILIES, 400, ANY);
    assert_eq!(failed, 0, "of {judged}: {kinds:?}");
}

#[test]
fn an_overlap_too_large_by_a_millionth_is_found() {
    let (judged, failed, kinds) = found(planted!(|c| c.overlap *= 1.0 + 1e-6), &FAMILIES, 100, DEEP);
    assert_eq!(failed, judged, "{kinds:?}");
}

/// The same, with surface points to match.
#[test]
fn surface_points_off_by_a_millionth_of_the_overlap_are_found() {
    let solver: Solver = planted!(|c| {
        c.point_on_a += 1e-6 * c.overlap * c.normal;
        c.overlap *= 1.0 + 1e-6;
    });
    let (judged, failed, kinds) = found(solver, &FAMILIES, 100, DEEP);
    assert_eq!(failed, judged, "{kinds:?}");
}

/// Across the normal, where neither s nor the surface points tell. Where the centres coincide the bound is 0, and ten
/// times that is no error: such pairs do not count. Those that are missed have k = 0, of which the judge compares no
/// points.
#[test]
fn a_point_ten_bounds_off_is_found() {
    let solver: Solver = planted!(|c| {
        let across = c.normal.cross(&Vector3::new(0.31, 0.52, 0.79)).normalize();
        let by = 10.0 * c.point_bound * across;
        c.point += by;
        c.branch_a += by;
        c.branch_b += by;
    });
    let moved: Counts = |right, given| DEEP(right, given) && right.branch_b != given.branch_b;
    let (judged, failed, kinds) = found(solver, &FAMILIES, 100, moved);
    assert!(failed * 10 >= judged * 9, "{failed} of {judged}: {kinds:?}");
}

#[test]
fn a_scale_off_by_ten_gaps_is_found() {
    let (judged, failed, kinds) = found(planted!(|c| c.s += 10.0 * c.gap), &FAMILIES, 100, DEEP);
    assert!(failed * 10 >= judged * 9, "{failed} of {judged}: {kinds:?}");
}

/// A particle without the plane that is pressed hardest, if it is one without it.
fn with_a_plane_forgotten(particle: &Particle, towards: &Vector3<f64>) -> Option<Particle> {
    let mut planes: Vec<Plane> = particle.planes().collect();
    let facing = |plane: &Plane| plane.normal.dot(towards) / plane.normal.norm();
    let (worst, _) = planes.iter().enumerate().max_by(|(_, p), (_, q)| facing(p).total_cmp(&facing(q)))?;
    planes.remove(worst);
    Particle::new(&planes, particle.rounding_radius(), particle.sphericity(), particle.shadow_radius()).ok()
}

/// Wherever that plane is part of the contact.
#[test]
fn a_plane_that_is_forgotten_is_found() {
    let solver: Solver = |a, at_a, b, at_b, settings, state| {
        let right = detect(a, at_a, b, at_b, settings, None)?;
        let towards = at_a.rotation().tr_mul(&right.normal);
        match with_a_plane_forgotten(a, &towards) {
            Some(less) => detect(&less, at_a, b, at_b, settings, state),
            None => detect(a, at_a, b, at_b, settings, state),
        }
    };
    let changed: Counts = |right, given| (right.s - given.s).abs() > 2.0 * (right.gap + given.gap);
    let (judged, failed, kinds) = found(solver, &[0], 40, changed);
    assert_eq!(failed, judged, "{kinds:?}");
}
