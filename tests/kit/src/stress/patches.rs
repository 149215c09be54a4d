//! Patches against brute force from the definition, and from states that were left by other poses of the pair.

use crate::pair_line::Shape;
use crate::patch::bodies::cuboid;
use crate::patch::brute::{brute, frame_of};
use crate::random::Random;
use crate::stress::cases::stream;
use crate::stress::ledger::{Fault, Finding, Ledger};
use crate::stress::shapes::flattened;
use nalgebra::{Quaternion, Rotation3, UnitQuaternion, Vector3};
use potential_particles::{
    Kind, Particle, Patch, PatchFlags, PatchPoint, PatchScratch, PatchSettings, PatchState, Plane, Pose, Settings,
    detect, patch_of_contact,
};

/// Tolerances that are asked for.
const ASKED: [f64; 3] = [1e-3, 1e-4, 1e-6];

/// How much more than the larger of tolerance and estimate an error may be.
const ALLOWED: f64 = 3.0;

/// Error of the brute force, relative.
const OF_BRUTE: f64 = 1e-7;

const FAMILIES: [&str; 5] = ["boxes in line", "boxes turned by a little", "boxes", "grains", "outlines of grains"];

fn grain(r: f64, k: f64, random: &mut Random) -> Particle {
    loop {
        let planes: Vec<Plane> = (0..random.whole(8, 40))
            .map(|_| {
                let normal = Vector3::new(random.normal(), random.normal(), random.normal()).normalize();
                Plane { normal, offset: 0.35 + 0.15 * random.uniform() - r }
            })
            .collect();
        if let Some(grain) = Particle::new(&planes, r, k, 0.8).ok().filter(|grain| grain.bounding_radius() < 1.5) {
            return grain;
        }
    }
}

struct Pair {
    a: Particle,
    b: Particle,
    at_a: Pose,
    at_b: Pose,
}

/// A lies on the origin, B above it.
fn pair(family: usize, random: &mut Random) -> Pair {
    let r = 10f64.powf(-3.5 + 3.0 * random.uniform()).min(0.15);
    let k = if family < 2 { 0.0 } else { random.pick(&[0.0, 0.0, 1e-3, 0.1]) };
    let overlap = r * random.pick(&[1e-3, 0.02, 0.2, 0.5]);
    if family >= 3 {
        let flat = family == 4;
        let mut grain = || loop {
            let grain = grain(r, k, random);
            let outline = if flat { flattened(&grain) } else { Some(grain) };
            if let Some(grain) = outline.filter(|grain| grain.bounding_radius() < 1.5) {
                break grain;
            }
        };
        let (a, b) = (grain(), grain());
        let (turn_a, turn_b) = (random.turn_in(flat), random.turn_in(flat));
        let at_a = Pose::new([0.0; 3], turn_a).expect("a pose");
        // Brought into contact along an axis by bisection.
        let (mut near, mut far) = (0.0, 3.0);
        let at = |z: f64| Pose::new(if flat { [z, 0.0, 0.0] } else { [0.0, 0.0, z] }, turn_b).expect("a pose");
        for _ in 0..50 {
            let z = 0.5 * (near + far);
            let found = detect(&a, &at_a, &b, &at(z), &Settings::default(), None);
            let is_apart = found.map_or(true, |found| found.kind == Kind::Separated);
            if is_apart { far = z } else { near = z }
        }
        return Pair { a, b, at_a, at_b: at(near - overlap) };
    }
    let half = |random: &mut Random| [0; 3].map(|_| 0.25 + 0.5 * random.uniform());
    let half_a = half(random);
    let half_b = if random.uniform() < 0.3 { half_a } else { half(random) };
    let step = random.pick(&[0.0, 1e-16, 1e-13, 1e-10, 1e-7, 1e-5, 1e-3]);
    let shift = [0, 1].map(|i| match random.whole(0, 4) {
        0 => step,
        1 => half_a[i] - half_b[i] + step,
        2 => half_a[i] + step,
        _ => (half_a[i] + half_b[i]) * 0.9 * (2.0 * random.uniform() - 1.0),
    });
    let most = if family == 1 { random.pick(&[1e-15, 1e-10, 1e-6, 1e-3]) } else { 0.7 };
    let turn = match family {
        0 => Rotation3::identity(),
        _ => Rotation3::new(
            most * overlap.max(1e-6) / r * Vector3::new(random.normal(), random.normal(), random.normal()),
        ),
    };
    let q = UnitQuaternion::from_rotation_matrix(&turn);
    let at_b = Pose::new([shift[0], shift[1], half_a[2] + half_b[2] - overlap], [q.w, q.i, q.j, q.k]).expect("a pose");
    let at_a = Pose::at([0.0; 3]).expect("a pose");
    Pair { a: cuboid(half_a, r, k), b: cuboid(half_b, r, k), at_a, at_b }
}

/// Case `index`: what is found is added to the ledger.
pub fn one(seed: u64, index: u64, ledger: &mut Ledger) {
    let mut random = stream(seed, 17, index);
    let family = (index % FAMILIES.len() as u64) as usize;
    let Pair { a, b, at_a, at_b } = pair(family, &mut random);
    *ledger.families.entry(FAMILIES[family].into()).or_default() += 1;
    let Ok(contact) = detect(&a, &at_a, &b, &at_b, &Settings::default(), None) else { return };
    if contact.kind == Kind::Separated || contact.s < 1e-3 {
        return;
    }
    let mut scratch = PatchScratch::new();
    let mut farthest = 0.0_f64;
    let visit = |point: PatchPoint| farthest = farthest.max(point.position.norm());
    let _ = patch_of_contact(&a, &at_a, &b, &at_b, &contact, &PatchSettings::default(), &mut scratch, visit);
    let frame = frame_of(&contact.normal);
    let right = brute((&a, &at_a), Some((&b, &at_b)), &contact.point, &frame, &[], 2.0 * farthest);
    let mut fault = |detail: String| {
        let case = serde_json::json!({
            "A": Shape::from(&a), "B": Shape::from(&b), "a": format!("{at_a:?}"), "b": format!("{at_b:?}")
        });
        let planes = a.plane_count() + b.plane_count();
        ledger.find(Finding {
            fault: Fault::Patch,
            family: FAMILIES[family].into(),
            seed,
            index,
            detail,
            case,
            planes,
        });
    };
    let mut judged = 0;
    for tolerance in ASKED {
        let settings = PatchSettings { tolerance, ..PatchSettings::default() };
        let found = patch_of_contact(&a, &at_a, &b, &at_b, &contact, &settings, &mut scratch, |_| ());
        let Ok(found) = found else { return fault("an overlapping contact has no patch".into()) };
        let told = [PatchFlags::FOLDED, PatchFlags::EMPTY, PatchFlags::DEEP];
        if told.iter().any(|flag| found.flags.contains(*flag)) {
            return;
        }
        if let Some(right) = right.as_ref().filter(|right| right.doubt <= tolerance) {
            judged += 1;
            let allowed = ALLOWED * tolerance.max(found.error) + OF_BRUTE + right.doubt;
            let size = right.force.norm();
            let of_force = (found.force - right.force).norm() / size;
            let of_torque = (found.torque - right.torque).norm() / (size * right.reach);
            let of_area = (found.area / right.area - 1.0).abs();
            // The estimate is of the force; of the area it is one of its own.
            let allowed_area = ALLOWED * found.area_error.max(10.0 * tolerance) + 10.0 * (OF_BRUTE + right.doubt);
            if !(of_force <= allowed && of_torque <= allowed && of_area <= allowed_area) {
                fault(format!(
                    "at {tolerance:e} off by {of_force:e}, {of_torque:e}, {of_area:e}: {found:?}, {right:?}"
                ));
            }
        }
        if let Some(detail) = carried((&a, &at_a), (&b, &at_b), &settings, &found, &mut random) {
            fault(detail);
        }
    }
    ledger.judged += judged;
}

/// From a state that another pose has left: half a turn, a mirrored place, a small step.
fn carried(
    a: (&Particle, &Pose),
    b: (&Particle, &Pose),
    settings: &PatchSettings,
    found: &Patch,
    random: &mut Random,
) -> Option<String> {
    let contact = detect(a.0, a.1, b.0, b.1, &Settings::default(), None).ok()?;
    let flat = a.0.is_in_plane();
    let about = if flat { Vector3::z() } else { random.pick(&[contact.normal, Vector3::x(), Vector3::y()]) };
    let angle = random.pick(&[std::f64::consts::PI, 1e-9, 1e-5, std::f64::consts::FRAC_PI_2]);
    let turn = UnitQuaternion::from_axis_angle(&nalgebra::Unit::new_normalize(about), angle);
    let position = contact.point + turn * (a.1.position() - contact.point);
    let [w, x, y, z] = a.1.orientation();
    let q = turn.quaternion() * Quaternion::new(w, x, y, z);
    let turned = Pose::new(position.into(), [q.w, q.i, q.j, q.k]).ok()?;
    let (mut state, mut scratch) = (PatchState::default(), PatchScratch::new());
    for pose in [&turned, &turned, a.1] {
        let contact = detect(a.0, pose, b.0, b.1, &Settings::default(), None).ok()?;
        if contact.kind == Kind::Separated {
            return None;
        }
        let patch = state.patch_of_contact(a.0, pose, b.0, b.1, &contact, settings, &mut scratch).ok()?;
        if std::ptr::eq(pose, a.1) {
            let off = (patch.force - found.force).norm() / found.force.norm();
            let allowed = ALLOWED * (patch.error.max(settings.tolerance) + found.error.max(settings.tolerance));
            return (!(off <= allowed))
                .then(|| format!("from a state turned by {angle} off by {off:e}: {patch:?}, {found:?}"));
        }
    }
    None
}
