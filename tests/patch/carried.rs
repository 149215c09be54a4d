//! Patches that are carried on, against those that are integrated where they are.

use kit::patch::bodies::{Chance, FAMILIES, Pair, body, contact, cuboid, moved};
use kit::patch::boundaries::{Boundary, resting};
use nalgebra::{Matrix3, UnitQuaternion, Vector3};
use potential_particles::{
    Patch, PatchFlags, PatchScratch, PatchSettings, PatchState, Pose, Triangle, Wall, patch_of_contact,
};

const SETTINGS: PatchSettings = PatchSettings { tolerance: 1e-4, with_energy: false, with_stiffness: false };

/// Part of the largest depth by which a patch may move at that tolerance.
const LIMIT: f64 = 3e-3;

/// A small motion: a shift and a turn.
fn small(chance: &mut Chance, depth: f64, reach: f64) -> (Vector3<f64>, Vector3<f64>) {
    let (share, part) = (0.99 * LIMIT * chance.uniform(), chance.uniform());
    let shift = share * part * depth * chance.direction();
    let turn = share * (1.0 - part) * depth / reach * chance.direction();
    (shift, turn)
}

/// With the torque about another point: that of the contact may be anywhere on a face.
fn about(patch: &Patch, contact_point: &Vector3<f64>, point: &Vector3<f64>) -> Patch {
    let mut patch = *patch;
    patch.torque += (contact_point - point).cross(&patch.force);
    patch
}

/// How far the centre of a long patch is from its ends.
fn half_length(patch: &Patch) -> f64 {
    (3.0 * patch.second_moment.trace() / patch.area).sqrt()
}

/// How far two patches are apart: force and torque, relative to the force and the reach.
fn distance(a: &Patch, b: &Patch, reach: f64) -> [Vector3<f64>; 2] {
    let size = b.force.norm();
    [(a.force - b.force) / size, (a.torque - b.torque) / (size * reach)]
}

/// What was found over many walks.
#[derive(Default)]
struct Tally {
    count: usize,
    beyond: usize,
    worst: f64,
}

impl Tally {
    /// How much more a carried patch is off than the one that it was carried on from was, against what its estimate has
    /// grown by.
    fn add(&mut self, carried: [&Patch; 2], exact: [&Patch; 2], reach: f64, name: &str) {
        let [before, now] = [0, 1].map(|i| distance(carried[i], exact[i], reach));
        let grown = (0..2).map(|i| (now[i] - before[i]).norm()).fold(0.0, f64::max);
        let estimate = carried[1].error - carried[0].error;
        assert!(estimate <= 0.6 * SETTINGS.tolerance, "{name}: {estimate:e}");
        let area = ((carried[1].area - exact[1].area) - (carried[0].area - exact[0].area)).abs() / exact[1].area;
        assert!(area < 1e-4 + carried[1].area_error, "{name}: area {area:e}");
        self.count += 1;
        self.beyond += usize::from(grown > estimate);
        self.worst = self.worst.max(grown);
    }

    fn check(&self, least: usize) {
        let Self { count, beyond, worst } = self;
        assert!(*count >= least, "{count} patches");
        assert!(*beyond * 200 <= *count && *worst < SETTINGS.tolerance, "{beyond} of {count}, {worst:e}");
    }
}

fn look(pair: &Pair, settings: &PatchSettings, state: &mut PatchState) -> Patch {
    let Pair { a, pose_a, b, pose_b, contact, .. } = pair;
    state.patch_of_contact(a, pose_a, b, pose_b, contact, settings, &mut PatchScratch::new()).unwrap()
}

/// Nearly exact, and the reach of its points.
fn exact(pair: &Pair) -> (Patch, f64) {
    let Pair { a, pose_a, b, pose_b, contact, .. } = pair;
    let (settings, mut reach) = (PatchSettings { tolerance: 1e-8, ..SETTINGS }, 0.0_f64);
    let patch = patch_of_contact(a, pose_a, b, pose_b, contact, &settings, &mut PatchScratch::new(), |point| {
        reach = reach.max(point.position.norm());
    });
    (patch.unwrap(), reach)
}

/// Cubes face on face, tilted by up to the angle at which they part, with edges that coincide or not.
fn faces(k: [f64; 2], r: f64, depth: f64, chance: &mut Chance) -> Pair {
    let [a, b] = k.map(|k| cuboid([0.5; 3], r, k));
    let overlap = depth * r;
    let tilt = chance.pick(&[0.0, 0.3, 1.0, 3.0]) * overlap;
    let tilt = UnitQuaternion::from_scaled_axis(tilt * Vector3::z().cross(&chance.direction()).normalize());
    let spin = UnitQuaternion::from_scaled_axis(Vector3::z() * chance.pick(&[0.0, 1e-4, 0.4]));
    let aside = chance.pick(&[0.0, 0.3, 0.9]);
    let turn = (tilt * spin).to_rotation_matrix().into_inner();
    Pair::at_overlap(a, &Matrix3::identity(), b, &turn, &Vector3::new(aside, 0.5 * aside, 1.0), overlap)
}

#[test]
fn pairs_stay_within_the_estimate() {
    let (mut chance, mut tally) = (Chance::new(41), Tally::default());
    for round in 0..800 {
        let k = [0; 2].map(|_| chance.pick(&[0.0, 0.0, 1e-6, 0.02, 0.3]));
        let (r, depth) = (chance.pick(&[1e-6, 1e-4, 1e-3, 0.05, 0.3, 1.0]), chance.pick(&[0.01, 0.1, 0.3]));
        let families = [0; 2].map(|_| chance.pick(&FAMILIES));
        let mut pair = match round % 8 {
            7 => Pair::flat(r, k[0], depth, &mut chance),
            0 | 3 | 6 => faces(k, 0.3 * r, depth, &mut chance),
            _ => Pair::random(families, k, r, depth, &mut chance),
        };
        let name = format!("{round}: {families:?}, k {k:?}, r {r}, depth {depth}");
        let mut state = PatchState::default();
        let first = [(); 2].map(|()| look(&pair, &SETTINGS, &mut state))[1];
        let (exact_first, reach) = exact(&pair);
        // Flagged ones are integrated, or known less, and motions of rounding are none.
        if first.flags.bits() | exact_first.flags.bits() != 0 || first.largest_depth < 1e-12 {
            continue;
        }
        let (pose, point) = (pair.pose_a, pair.contact.point);
        for _ in 0..4 {
            let (mut shift, mut turn) = small(&mut chance, first.largest_depth, reach);
            if pair.is_flat() {
                (shift.z, turn) = (0.0, turn.z * Vector3::z());
            }
            pair.pose_a = moved(&pose, &point, &shift, &turn);
            pair.contact = contact(&pair.a, &pair.pose_a, &pair.b, &pair.pose_b);
            let carried = look(&pair, &SETTINGS, &mut state);
            assert!(carried.flags.contains(PatchFlags::CARRIED), "{name}: {}", carried.flags);
            let exact_now = exact(&pair).0;
            if exact_now.flags.bits() == 0 {
                let [now, exact_now] = [carried, exact_now].map(|patch| about(&patch, &pair.contact.point, &point));
                tally.add([&first, &now], [&exact_first, &exact_now], reach, &name);
            }
        }
    }
    tally.check(2000);
}

#[test]
fn both_bodies_may_move_together() {
    let mut chance = Chance::new(42);
    for _ in 0..20 {
        let mut pair = Pair::random(["rock", "cube"], [0.0, 0.02], 0.3, 0.1, &mut chance);
        let mut state = PatchState::default();
        let first = [(); 2].map(|()| look(&pair, &SETTINGS, &mut state))[1];
        let turn = UnitQuaternion::from_scaled_axis(2.0 * chance.direction());
        let (about, shift) = (pair.contact.point, 3.0 * chance.direction());
        pair.pose_a = moved(&pair.pose_a, &about, &shift, &turn.scaled_axis());
        pair.pose_b = moved(&pair.pose_b, &about, &shift, &turn.scaled_axis());
        pair.contact = contact(&pair.a, &pair.pose_a, &pair.b, &pair.pose_b);
        let carried = look(&pair, &SETTINGS, &mut state);
        assert!(carried.flags.contains(PatchFlags::CARRIED));
        // The contact point is another one of those within its bounds.
        let away = about + shift - pair.contact.point;
        let (size, arm) = (first.force.norm(), first.area.sqrt());
        let centre = about + shift + turn * (first.pressure_centre - about);
        assert!((carried.force - turn * first.force).norm() < 1e-9 * size);
        assert!((carried.torque - turn * first.torque - away.cross(&carried.force)).norm() < 1e-9 * size * arm);
        assert!((carried.pressure_centre - centre).norm() < 1e-9 * arm);
        assert!((pair.pose_b.position() + carried.branch_b - centre).norm() < 1e-9 * arm);
        assert!((carried.centroid - turn * first.centroid).norm() < 1e-9 * arm);
        let second = turn.to_rotation_matrix() * first.second_moment * turn.to_rotation_matrix().inverse();
        assert!((carried.second_moment - second).norm() < 1e-9 * arm.powi(4));
        assert!((carried.couple - first.couple).abs() < 1e-9 * size * arm);
    }
}

#[test]
fn the_energy_goes_along() {
    let mut chance = Chance::new(43);
    let settings = PatchSettings { with_energy: true, ..SETTINGS };
    for k in [0.0, 0.02] {
        for _ in 0..10 {
            let mut pair = Pair::random(["rock", "cube"], [k; 2], 0.3, 0.1, &mut chance);
            let mut state = PatchState::default();
            let first = [(); 2].map(|()| look(&pair, &settings, &mut state))[1];
            let (pose, point) = (pair.pose_a, pair.contact.point);
            let away = LIMIT * first.largest_depth * -first.force.normalize();
            let energies = [1.0, -1.0].map(|sign| {
                pair.pose_a = moved(&pose, &point, &(0.99 * sign * away), &Vector3::zeros());
                pair.contact = contact(&pair.a, &pair.pose_a, &pair.b, &pair.pose_b);
                let carried = look(&pair, &settings, &mut state);
                assert!(carried.flags.contains(PatchFlags::CARRIED));
                let fine = PatchSettings { tolerance: 1e-9, ..settings };
                let [out, exact] = [carried, look(&pair, &fine, &mut PatchState::default())].map(|patch| patch.energy);
                assert!((out / exact - 1.0).abs() < 1.1 * SETTINGS.tolerance, "{out} {exact}");
                out
            });
            assert!(energies[0] < first.energy && first.energy < energies[1]);
        }
    }
}

#[test]
fn what_has_changed_is_integrated() {
    let mut chance = Chance::new(44);
    let mut pair = Pair::random(["cube", "rock"], [0.0; 2], 0.3, 0.1, &mut chance);
    let mut known = PatchState::default();
    let is_carried = |pair: &Pair, settings: &PatchSettings, state: &mut PatchState| {
        look(pair, settings, state).flags.contains(PatchFlags::CARRIED)
    };
    assert_eq!([(); 3].map(|()| is_carried(&pair, &SETTINGS, &mut known)), [false, false, true]);
    for other in [PatchSettings { tolerance: 1e-5, ..SETTINGS }, PatchSettings { with_energy: true, ..SETTINGS }] {
        let mut state = known;
        assert!(!is_carried(&pair, &other, &mut state));
        assert!(!is_carried(&pair, &SETTINGS, &mut state));
    }
    // Other bodies of the same shape.
    let others = Pair::random(["cube", "rock"], [0.0; 2], 0.3, 0.1, &mut Chance::new(44));
    assert!(!is_carried(&others, &SETTINGS, &mut { known }));
    // Too far, and from there on again.
    let depth = look(&pair, &SETTINGS, &mut known).largest_depth;
    pair.pose_a =
        moved(&pair.pose_a, &pair.contact.point, &(1.1 * LIMIT * depth * chance.direction()), &Vector3::zeros());
    pair.contact = contact(&pair.a, &pair.pose_a, &pair.b, &pair.pose_b);
    assert_eq!([(); 2].map(|()| is_carried(&pair, &SETTINGS, &mut known)), [false, true]);
}

#[test]
fn walls_stay_within_the_estimate() {
    let (mut chance, mut tally) = (Chance::new(45), Tally::default());
    for round in 0..400 {
        let k = chance.pick(&[0.0, 0.0, 0.02, 0.3]);
        let (r, depth) = (chance.pick(&[1e-4, 1e-3, 0.05, 0.3]), chance.pick(&[0.01, 0.1, 0.3]));
        let family = chance.pick(&FAMILIES);
        let a = body(family, r, k, &mut chance);
        let turn = chance.rotation();
        let overlap = depth * if family == "ball" { 0.5 } else { a.rounding_radius() };
        let pose = resting(&a, &turn, overlap);
        let plane = Boundary::Plane(Wall::new([0.0; 3], [0.0, 0.0, 1.0]).unwrap());
        let look =
            |boundary: &Boundary, pose: &Pose, state: &mut PatchState| boundary.carried(&a, pose, &SETTINGS, state);
        let fine = PatchSettings { tolerance: 1e-8, ..SETTINGS };
        let Some(whole) = plane.patch(&a, &pose, &SETTINGS) else { continue };
        let middle = whole.pressure_centre;
        let size = whole.area.sqrt();
        // A triangle whose border cuts the patch.
        let corner = |x: f64, y: f64| [middle.x + x * size, middle.y + y * size, 0.0];
        let triangle = Triangle::new([corner(-9.0, -0.1), corner(9.0, -0.2), corner(0.0, 9.0)]).unwrap();
        for boundary in [plane, Boundary::Triangle(triangle)] {
            let name = format!("{round}: {family}, k {k}, r {r}, depth {depth}, {boundary:?}");
            let mut state = PatchState::default();
            let first = [(); 2].map(|()| look(&boundary, &pose, &mut state))[1];
            let (Some(first), Some(exact_first)) = (first, boundary.patch(&a, &pose, &fine)) else { continue };
            if first.flags.bits() | exact_first.flags.bits() != 0 {
                continue;
            }
            let reach = 4.0 * half_length(&first) + a.bounding_radius();
            for _ in 0..4 {
                // No point of a convex patch is farther away than its width.
                let (shift, turn) = small(&mut chance, first.largest_depth, reach);
                let point = first.pressure_centre;
                let there = moved(&pose, &point, &shift, &turn);
                let carried = look(&boundary, &there, &mut state).unwrap();
                assert!(carried.flags.contains(PatchFlags::CARRIED), "{name}: {}", carried.flags);
                let exact_now = boundary.patch(&a, &there, &fine).unwrap();
                let at = |place: &Pose| boundary.contact(&a, place).unwrap().on_boundary;
                let [now, exact_now] = [carried, exact_now].map(|patch| about(&patch, &at(&there), &point));
                let [then, exact_then] = [first, exact_first].map(|patch| about(&patch, &at(&pose), &point));
                tally.add([&then, &now], [&exact_then, &exact_now], half_length(&first), &name);
            }
        }
    }
    tally.check(1500);
}

/// Two faces that meet within rounding: s may be above 1 at each point of their patch. What follows, however far they
/// move, is not carried on from it.
#[test]
fn nothing_follows_from_a_touch_within_rounding() {
    let (mut chance, mut without_depth) = (Chance::new(61), 0);
    for round in 0..300 {
        let [a, b] = [0; 2].map(|_| cuboid([0.5, 0.4, 0.3], 0.01, 0.0));
        let turn = chance.rotation();
        let pose_a = Pose::from_rotation([0.0; 3], &turn).unwrap();
        let at = |overlap: f64, tilt: f64| {
            let tilted = turn * UnitQuaternion::from_scaled_axis(tilt * Vector3::y()).to_rotation_matrix().into_inner();
            Pose::from_rotation((turn * Vector3::new(1.0 - overlap, 0.1, 0.05)).into(), &tilted).unwrap()
        };
        let (mut state, mut scratch) = (PatchState::default(), PatchScratch::new());
        let apart = chance.pick(&[-4.0, -2.0, -1.0, 0.0, 1.0, 2.0]) * f64::EPSILON;
        for overlap in [apart, apart, 1e-13, 1e-9, 1e-6, 1e-4] {
            let pose_b = at(overlap, chance.pick(&[0.0, 0.5]) * overlap);
            let contact = contact(&a, &pose_a, &b, &pose_b);
            let Ok(found) = state.patch_of_contact(&a, &pose_a, &b, &pose_b, &contact, &SETTINGS, &mut scratch) else {
                continue;
            };
            without_depth += usize::from(found.largest_depth == 0.0);
            assert!(found.largest_depth >= 0.0, "round {round}: {:e}", found.largest_depth);
            if overlap >= 1e-9 {
                let anew =
                    patch_of_contact(&a, &pose_a, &b, &pose_b, &contact, &SETTINGS, &mut scratch, |_| ()).unwrap();
                let off = (found.force - anew.force).norm() / anew.force.norm();
                assert!(off < 1e-4, "round {round}, overlap {overlap:e}: {off:e}, {:?}", found.flags);
            }
        }
    }
    assert!(without_depth > 5, "{without_depth} patches without a depth");
}
