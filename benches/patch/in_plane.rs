//! What a patch in the plane costs beside its contact, in the units of `speed`.

use crate::speed::time;
use potential_particles::{
    Contact, Kind, PairState, Particle, PatchFlags, PatchScratch, PatchSettings, PatchState, Pose, Settings, detect,
    patch_of_contact,
};
use serde_json::{Value, json};
use std::f64::consts::{FRAC_PI_4, TAU};
use std::hint::black_box;

/// The overlap over r.
const DEPTH: f64 = 0.1;

struct Case {
    a: Particle,
    b: Particle,
    poses: [Pose; 2],
    contact: Contact,
}

/// B above A at this overlap.
fn above(a: Particle, b: Particle, angle: f64, overlap: f64) -> Case {
    let pose_a = Pose::in_plane([0.0, 0.0], 0.0).expect("a pose");
    let at = |height: f64| Pose::in_plane([0.13, height], angle).expect("a pose");
    let find = |pose: &Pose| detect(&a, &pose_a, &b, pose, &Settings::default(), None).expect("a contact");
    let (mut deep, mut apart) = (0.3, 2.0);
    for _ in 0..60 {
        let middle = 0.5 * (deep + apart);
        let found = find(&at(middle));
        if found.kind == Kind::Overlapping && found.overlap > overlap { deep = middle } else { apart = middle }
    }
    let pose_b = at(deep);
    let contact = find(&pose_b);
    Case { a, b, poses: [pose_a, pose_b], contact }
}

/// A row for each kind of contact.
pub fn measure(unit: f64) -> Vec<Value> {
    let r = 0.02;
    let mut rows = Vec::new();
    for k in [0.0, 0.02] {
        let corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];
        let square = || Particle::polygon(&corners, r, k).expect("a square");
        let round = |i: i32| (TAU * f64::from(i) / 24.0).sin_cos();
        let corners: Vec<[f64; 2]> = (0..24).map(round).map(|(sin, cos)| [0.5 * cos, 0.5 * sin]).collect();
        let many = || Particle::polygon(&corners, r, k).expect("a polygon");
        for (kind, case) in [
            ("side on side", above(square(), square(), 0.0, DEPTH * r)),
            ("corner on side", above(square(), square(), FRAC_PI_4, DEPTH * r)),
            ("24 sides on 24", above(many(), many(), 0.1, DEPTH * r)),
        ] {
            let Case { a, b, poses: [pose_a, pose_b], contact } = &case;
            let (mut state, mut scratch) = (PairState::default(), PatchScratch::new());
            let of_contact = time(|| {
                let found = detect(a, pose_a, b, black_box(pose_b), &Settings::default(), Some(&mut state));
                black_box(found.expect("a contact"));
            });
            let of_patch = [false, true].map(|with_stiffness| {
                let settings = PatchSettings { with_stiffness, ..PatchSettings::default() };
                time(|| {
                    let contact = black_box(contact);
                    let found = patch_of_contact(a, pose_a, b, pose_b, contact, &settings, &mut scratch, |_| ());
                    black_box(found.expect("a patch"));
                })
            });
            let mut kept = PatchState::default();
            let mut carried = || {
                let settings = PatchSettings::default();
                let (a, b, contact) = (black_box(a), black_box(b), black_box(contact));
                let found = kept.patch_of_contact(a, pose_a, b, pose_b, contact, &settings, &mut scratch);
                found.expect("a patch").flags
            };
            let last = [carried(), carried(), carried()][2];
            assert!(last.contains(PatchFlags::CARRIED), "{last}");
            let carried = time(|| _ = black_box(carried())) / unit;
            let [contact, patch, with_stiffness] = [of_contact, of_patch[0], of_patch[1]].map(|seconds| seconds / unit);
            println!(
                "in the plane, {kind}, k {k}: contact {contact:.0}, patch {patch:.0}, with stiffness {with_stiffness:.0}, carried on {carried:.1} units"
            );
            rows.push(
                json!({"kind": kind, "k": k, "contact": contact, "patch": patch, "with_stiffness": with_stiffness, "carried": carried}),
            );
        }
    }
    rows
}
