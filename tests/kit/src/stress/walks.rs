//! The second part: random walks, on which each answer from memory must be the one without.

use crate::pair_line::{Line, Place};
use crate::random::Random;
use crate::stress::cases::{Case, FAMILIES, POSES_A_PAIR, Shapes, stream};
use crate::stress::judge::FULL;
use crate::stress::ledger::{Fault, Finding, Ledger};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use potential_particles::{Contact, Formulation, Kind, PairState, Pose, Settings, detect};
use std::panic::{AssertUnwindSafe, catch_unwind};

pub const STEPS: u64 = 1000;

/// Walk `walk`, of the family of that number modulo theirs: what is found is added to the ledger.
pub fn one(seed: u64, walk: u64, ledger: &mut Ledger) {
    // Past any pair of the first part of eight poses, so that the shapes are others; below those of more poses.
    let index =
        (1 << 40) / POSES_A_PAIR / FAMILIES.len() as u64 * POSES_A_PAIR * FAMILIES.len() as u64 + walk * POSES_A_PAIR;
    let shapes = Shapes::of(seed, index);
    let case = Case::of(&shapes, seed, index);
    let mut random = stream(seed, 5, walk);
    let mut states = [PairState::default(); 3];
    let mut at_b = case.at_b;
    let small = shapes.a.bounding_radius().min(shapes.b.bounding_radius());
    let meet = shapes.a.bounding_radius() + shapes.b.bounding_radius();
    *ledger.families.entry(case.family().into()).or_default() += 1;
    for step in 0..STEPS {
        let judged = catch_unwind(AssertUnwindSafe(|| compare(&case, &at_b, &mut states)));
        let wrong = judged.unwrap_or_else(|_| Some((Fault::Panic, "panicked".into())));
        ledger.judged += 1;
        if let Some((fault, detail)) = wrong {
            let detail = format!("walk {walk} step {step}: {detail}");
            let line = Line::of(&shapes.a, &case.at_a, &shapes.b, &at_b, format!("{fault:?}: {detail}"));
            let (family, index, planes) = (case.family().into(), walk, line.planes());
            let case = serde_json::to_value(line).unwrap_or_default();
            ledger.find(Finding { fault, family, seed, index, detail, case, planes });
        }
        at_b = walked(&case, &at_b, small, meet, &mut random);
    }
}

/// A small step, now and then a large one; back towards A from too far.
fn walked(case: &Case, at_b: &Place, small: f64, meet: f64, random: &mut Random) -> Place {
    let flat = case.shapes.is_flat();
    let size = if random.uniform() < 0.02 { 0.3 } else { 1e-3 };
    let mut position = Vector3::from(at_b.position) + small * size * random.direction_in(flat);
    let away = position - Vector3::from(case.at_a.position);
    if away.norm() > 1.05 * meet {
        position -= 0.2 * away;
    }
    let [w, x, y, z] = at_b.pose().orientation();
    let about = if flat { Vector3::z() } else { random.direction() };
    let turn = UnitQuaternion::new(size * about);
    let q = turn.quaternion() * Quaternion::new(w, x, y, z);
    let length = q.norm();
    Place { position: position.into(), orientation: [q.w, q.i, q.j, q.k].map(|c| c / length), angle: None }
}

/// From memory, full, with default settings and by closest, as without.
fn compare(case: &Case, at_b: &Place, states: &mut [PairState; 3]) -> Option<(Fault, String)> {
    let (a, b) = (&case.shapes.a, &case.shapes.b);
    let (pose_a, pose_b): (Pose, Pose) = (case.at_a.pose(), at_b.pose());
    let answer = |settings: &Settings, state: Option<&mut PairState>| {
        detect(a, &pose_a, b, &pose_b, settings, state).map_err(|error| error.to_string())
    };
    let [full, quick, closest] = states;
    let mut answers = || -> Result<_, String> {
        let by_closest = [answer(&CLOSEST, None)?, answer(&CLOSEST, Some(closest))?];
        Ok((answer(&FULL, None)?, answer(&FULL, Some(full))?, answer(&Settings::default(), Some(quick))?, by_closest))
    };
    let (cold, warm, quick, by_closest) = match answers() {
        Ok(answers) => answers,
        Err(error) => return Some((Fault::NotSolved, error)),
    };
    let length = (pose_a.position() - pose_b.position()).norm() + a.bounding_radius() + b.bounding_radius();
    let flat = a.sphericity().min(b.sphericity()) < 1e-12;
    let same = |cold: &Contact, warm: &Contact| {
        let both = cold.gap + warm.gap;
        if !((cold.s - warm.s).abs() <= both) {
            return Some((Fault::Warm, format!("s={:e} cold, {:e} warm, gaps {both:e}", cold.s, warm.s)));
        }
        let off = (cold.branch_b - warm.branch_b).norm();
        let allowed = cold.point_bound + warm.point_bound + 8.0 * f64::EPSILON * length;
        let apart = !flat && !(off <= allowed);
        apart.then(|| (Fault::Warm, format!("{:?} {off:e} apart, bounds {allowed:e}", cold.formulation)))
    };
    let wrong = same(&cold, &warm);
    if wrong.is_some() {
        return wrong;
    }
    // Whether closest is slack may be left open by its gaps.
    let [cold_closest, warm_closest] = &by_closest;
    if cold_closest.formulation == warm_closest.formulation {
        let wrong = same(cold_closest, warm_closest);
        if wrong.is_some() {
            return wrong;
        }
    }
    let decided = (cold.s - 1.0).abs() > cold.gap;
    for other in [&quick, cold_closest, warm_closest] {
        if decided && other.kind != cold.kind {
            return Some((Fault::Warm, format!("{:?} {:?}, cold s={:e}", other.kind, other.flags, cold.s)));
        }
    }
    let malformed = [&warm, warm_closest].into_iter().find(|c| c.kind == Kind::Overlapping && !(c.overlap >= 0.0));
    malformed.map(|contact| (Fault::Malformed, format!("overlap {:e}", contact.overlap)))
}

const CLOSEST: Settings = FULL.with_formulation(Formulation::Closest);
