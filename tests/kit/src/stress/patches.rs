//! Patches against brute force from the definition, and from states that were left by other poses of the pair.

use crate::pair_line::Shape;
use crate::patch::bodies::{Chance, Pair};
use crate::patch::families::{Case, KINDS};
use crate::random::Random;
use crate::stress::cases::stream;
use crate::stress::ledger::{Fault, Finding, Ledger};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use potential_particles::{
    Kind, Particle, Patch, PatchFlags, PatchScratch, PatchSettings, PatchState, Pose, Settings, detect,
};

/// Tolerances that are asked for.
const ASKED: [f64; 3] = [1e-3, 1e-4, 1e-6];

/// How much more than the larger of tolerance and estimate an error may be.
const ALLOWED: f64 = 3.0;

/// Error of the brute force, relative.
const OF_BRUTE: f64 = 1e-7;

/// All of [`KINDS`] but random bodies: beside their patches both potentials may be equal once more, which brute force
/// does not tell apart.
const JUDGED: [usize; 11] = [0, 1, 3, 4, 5, 6, 7, 8, 9, 10, 11];

/// r of polygons and of bodies on boundaries.
const ROUNDINGS: [f64; 4] = [1e-3, 1e-2, 0.1, 0.5];

/// Case `index`: what is found is added to the ledger.
pub fn one(seed: u64, index: u64, ledger: &mut Ledger) {
    let mut random = stream(seed, 17, index);
    let mut chance = Chance::new(seed ^ index.wrapping_mul(0x9E37_79B9_7F4A_7C15));
    let kind = JUDGED[(index % JUDGED.len() as u64) as usize];
    let k = random.pick(&[0.0, 0.0, 1e-3, 0.1]);
    let Some(case) = Case::of(kind, k, &ROUNDINGS, &mut chance) else { return };
    *ledger.families.entry(KINDS[kind].into()).or_default() += 1;
    let mut fault = |detail: String| {
        let case = match &case {
            Case::Pair(Pair { a, pose_a, b, pose_b, .. }) => serde_json::json!({
                "A": Shape::from(a), "B": Shape::from(b), "a": format!("{pose_a:?}"), "b": format!("{pose_b:?}")
            }),
            Case::Boundary { boundary, a, pose, .. } => serde_json::json!({
                "A": Shape::from(a), "a": format!("{pose:?}"), "boundary": format!("{boundary:?}")
            }),
        };
        let family = KINDS[kind].into();
        ledger.find(Finding { fault: Fault::Patch, family, seed, index, detail, case, planes: 0 });
    };
    let mut scratch = PatchScratch::new();
    let (mut right, mut judged) = (None, 0);
    for tolerance in ASKED {
        let settings = PatchSettings { tolerance, ..PatchSettings::default() };
        let Some((found, point)) = case.patch(&settings, &mut scratch).zip(case.point()) else {
            return fault("an overlapping contact has no patch".into());
        };
        let told = [PatchFlags::FOLDED, PatchFlags::EMPTY, PatchFlags::DEEP];
        if told.iter().any(|flag| found.flags.contains(*flag)) {
            return;
        }
        let (right, origin) = right.get_or_insert_with(|| (case.brute(&found), found.pressure_centre));
        if let Some(right) = right.as_ref().filter(|right| right.doubt <= tolerance) {
            judged += 1;
            let allowed = ALLOWED * tolerance.max(found.error) + OF_BRUTE + right.doubt;
            let size = right.force.norm();
            let of_force = (found.force - right.force).norm() / size;
            let torque = found.torque + (point - *origin).cross(&found.force);
            let of_torque = (torque - right.torque).norm() / (size * right.reach);
            let of_area = (found.area / right.area - 1.0).abs();
            // The estimate is of the force; of the area it is one of its own.
            let allowed_area = ALLOWED * found.area_error.max(10.0 * tolerance) + 10.0 * (OF_BRUTE + right.doubt);
            if !(of_force <= allowed && of_torque <= allowed && of_area <= allowed_area) {
                fault(format!(
                    "at {tolerance:e} off by {of_force:e}, {of_torque:e}, {of_area:e}: {found:?}, {right:?}"
                ));
            }
        }
        if let Case::Pair(Pair { a, pose_a, b, pose_b, .. }) = &case {
            carried((a, pose_a), (b, pose_b), &settings, &found, &mut random).into_iter().for_each(&mut fault);
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
