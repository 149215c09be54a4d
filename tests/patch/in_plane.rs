//! Patches in the plane against faces, discs, and the gradient of their energy.

use kit::patch::bodies::difference;
use nalgebra::{Vector2, Vector3};
use potential_particles::{
    Kind, Particle, Patch, PatchFlags, PatchScratch, PatchSettings, PatchState, Pose, Settings, detect,
    patch_of_contact,
};
use std::f64::consts::TAU;

fn circle(radius: f64) -> Particle {
    Particle::in_plane(&[], 0.0, 1.0, radius).unwrap()
}

fn square(r: f64, k: f64) -> Particle {
    Particle::polygon(&[[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]], r, k).unwrap()
}

fn pentagon(r: f64, k: f64) -> Particle {
    let corners: Vec<[f64; 2]> =
        (0..5).map(|i| (TAU * f64::from(i) / 5.0).sin_cos()).map(|(sin, cos)| [0.5 * cos, 0.5 * sin]).collect();
    Particle::polygon(&corners, r, k).unwrap()
}

fn patch(a: &Particle, pose_a: &Pose, b: &Particle, pose_b: &Pose) -> (Patch, Vector3<f64>) {
    let contact = detect(a, pose_a, b, pose_b, &Settings::default(), None).unwrap();
    assert_eq!(contact.kind, Kind::Overlapping);
    let settings = PatchSettings { tolerance: 1e-9, with_energy: true, with_stiffness: true };
    let scratch = &mut PatchScratch::new();
    let found = patch_of_contact(a, pose_a, b, pose_b, &contact, &settings, scratch, |_| ()).unwrap();
    (found, contact.branch_b)
}

#[test]
fn discs_press_as_parabolas() {
    let (radius_a, radius_b) = (1.0, 0.5);
    let overlap = 1e-6;
    let (a, b) = (circle(radius_a), circle(radius_b));
    let pose_a = Pose::in_plane([3.0, 2.0], 0.4).unwrap();
    let pose_b = Pose::in_plane([3.0 + radius_a + radius_b - overlap, 2.0], 1.0).unwrap();
    let (found, _) = patch(&a, &pose_a, &b, &pose_b);
    let half = (2.0 * overlap / (1.0 / radius_a + 1.0 / radius_b)).sqrt();
    let force = 4.0 / 3.0 * overlap * half;
    assert!((found.force.x / force - 1.0).abs() < 1e-5, "{found:?}");
    assert!((found.area / (2.0 * half) - 1.0).abs() < 1e-5);
    assert!((found.energy / (force * overlap * 0.4) - 1.0).abs() < 1e-5);
    assert!((found.second_moment.trace() / (2.0 * half.powi(3) / 3.0) - 1.0).abs() < 1e-5);
}

fn turned_about(pose: &Pose, point: &Vector3<f64>, turn: f64, shift: Vector2<f64>) -> Pose {
    let away = (pose.position() - point).xy();
    let (sin, cos) = turn.sin_cos();
    let position = point.xy() + Vector2::new(cos * away.x - sin * away.y, sin * away.x + cos * away.y) + shift;
    let rotation = pose.rotation();
    Pose::in_plane(position.into(), rotation[(1, 0)].atan2(rotation[(0, 0)]) + turn).unwrap()
}

/// Rounded squares and polygons at many angles.
#[test]
fn the_force_is_the_gradient_of_the_energy_and_the_stiffness_that_of_the_force() {
    let mut count = 0;
    for (r, k) in [(0.1, 0.0), (0.05, 0.02), (0.2, 0.3), (1e-3, 0.0)] {
        let a = square(r, k);
        let b = pentagon(r, k);
        for i in 0..12 {
            let (angle, around) = (0.7 + 0.41 * f64::from(i), 0.53 * f64::from(i));
            let pose_a = Pose::in_plane([0.0, 0.0], 0.1).unwrap();
            let at = |distance: f64, shift: Vector2<f64>, turn: f64| {
                let position = distance * Vector2::new(around.cos(), around.sin()) + shift;
                Pose::in_plane(position.into(), angle + turn).unwrap()
            };
            let (mut deep, mut apart) = (0.3, 2.0);
            for _ in 0..60 {
                let middle = 0.5 * (deep + apart);
                let pose_b = at(middle, Vector2::zeros(), 0.0);
                let found = detect(&a, &pose_a, &b, &pose_b, &Settings::default(), None).unwrap();
                if found.kind == Kind::Overlapping && found.overlap > 0.3 * r { deep = middle } else { apart = middle }
            }
            let pose_b_now = at(deep, Vector2::zeros(), 0.0);
            let (here, branch) = patch(&a, &pose_a, &b, &pose_b_now);
            if here.flags.contains(PatchFlags::FOLDED) {
                continue;
            }
            let force = here.force.norm();
            // Stiffness of the bed over its length.
            let size = here.area;
            let along = Vector2::new(0.6, 0.8);
            let energy = |shift: Vector2<f64>, turn: f64| patch(&a, &pose_a, &b, &at(deep, shift, turn)).0.energy;
            let by_shift = -difference(|h| energy(h * along, 0.0), 1e-2 * r);
            let by_turn = -difference(|h| energy(Vector2::zeros(), h), 1e-2 * r);
            let torque = here.torque.z + branch.cross(&here.force).z;
            let errors = [(by_shift - here.force.xy().dot(&along)).abs() / force, (by_turn - torque).abs() / force];
            assert!(errors.iter().all(|error| *error < 1e-5), "r {r}, k {k}, {i}: {errors:?}");
            // A moves, and the torque is about the point at which both touch now.
            let (point, arm) = (pose_b_now.position() + branch, here.area);
            for column in 0..3 {
                let wrench = |h: f64| {
                    let shift = Vector2::new(f64::from(column == 0), f64::from(column == 1)) * h;
                    let turn = if column == 2 { h } else { 0.0 };
                    let pose_a = turned_about(&pose_a, &point, turn, shift);
                    let (there, branch) = patch(&a, &pose_a, &b, &pose_b_now);
                    let torque = there.torque.z + (pose_b_now.position() + branch - point).cross(&there.force).z;
                    [there.force.x, there.force.y, torque]
                };
                let scale = if column == 2 { 1.0 / arm } else { 1.0 };
                for row in 0..3 {
                    let unit = if row == 2 { 1.0 / arm } else { 1.0 };
                    let expected = difference(|h| wrench(h * scale)[row], 3e-3 * r) * unit;
                    let at = [0, 1, 5];
                    let off = (here.stiffness[(at[row], at[column])] * unit * scale - expected).abs() / size;
                    assert!(off < 1e-5, "r {r}, k {k}, {i}: stiffness of {row}, {column} off by {off:e}");
                }
            }
            let leaving = [2, 3, 4].map(|i| here.stiffness.row(i).amax() + here.stiffness.column(i).amax());
            assert_eq!(leaving, [0.0; 3]);
            // The force acts along a line through the centre of pressure.
            let about = (here.torque - (here.branch_b - branch).cross(&here.force)).z;
            assert!(about.abs() < 1e-9 * force, "{about:e}");
            count += 1;
        }
    }
    assert!(count > 40, "{count}");
}

/// Both bodies drift and turn, the pair by little: force, torque and energy within the estimate of those that are
/// integrated.
#[test]
fn patches_are_carried_on_within_the_estimate() {
    let scratch = &mut PatchScratch::new();
    for (k, angle) in [(0.0, 0.0), (0.0, 0.8), (0.02, 0.3), (0.3, 0.1)] {
        let r = 0.1;
        let (a, b) = (square(r, k), pentagon(r, k));
        let find = |height: f64| {
            let (low, high) = (Pose::in_plane([0.0, 0.0], 0.2).unwrap(), Pose::in_plane([0.1, height], angle).unwrap());
            detect(&a, &low, &b, &high, &Settings::default(), None).unwrap()
        };
        let (mut deep, mut apart) = (0.3, 2.0);
        for _ in 0..60 {
            let middle = 0.5 * (deep + apart);
            let found = find(middle);
            if found.kind == Kind::Overlapping && found.overlap > 0.2 * r { deep = middle } else { apart = middle }
        }
        let (mut state, mut carried) = (PatchState::default(), 0);
        for step in 0..60 {
            let t = f64::from(step);
            // The whole scene turns and moves; the pair by 2e-6 a step in each of its ways.
            let (sin, cos) = (0.1 * t).sin_cos();
            let placed = |x: f64, y: f64, turn: f64| {
                Pose::in_plane([cos * x - sin * y + t, sin * x + cos * y], turn + 0.1 * t).unwrap()
            };
            let pose_a = placed(0.0, 0.0, 0.2);
            let pose_b = placed(0.1 + 2e-6 * t, deep - 1e-6 * t, angle + 2e-6 * t);
            let contact = detect(&a, &pose_a, &b, &pose_b, &Settings::default(), None).unwrap();
            let settings = PatchSettings { with_energy: true, ..PatchSettings::default() };
            let found = state.patch_of_contact(&a, &pose_a, &b, &pose_b, &contact, &settings, scratch).unwrap();
            let (exact, _) = patch(&a, &pose_a, &b, &pose_b);
            let (force, size) = (exact.force.norm(), exact.area);
            let errors = [
                (found.force - exact.force).norm() / force,
                (found.torque - exact.torque).norm() / (force * size),
                found.energy / exact.energy - 1.0,
                (found.pressure_centre - exact.pressure_centre).norm() / size,
            ];
            let what = format!("k {k}, angle {angle}, step {step}: {errors:?}, {found:?}");
            assert!(errors.iter().all(|error| error.abs() < found.error.max(1e-9) * 1.5), "{what}");
            assert!(found.error < 2e-4, "{what}");
            let size = found.area / exact.area - 1.0;
            assert!(size.abs() < 1e-2, "{what}");
            carried += u32::from(found.flags.contains(PatchFlags::CARRIED));
        }
        assert!(carried > 40, "k {k}, angle {angle}: {carried} of 60");
    }
}
