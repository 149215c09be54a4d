//! Estimated errors hold, from rounded to sharp bodies; points add up; deep contacts are flagged.

use crate::bodies::{Chance, FAMILIES, Pair, cuboid};
use crate::patch;
use nalgebra::{Matrix3, Vector3};
use potential_particles::{Kind, PatchFlags, PatchScratch, PatchSettings, patch_of_contact};

#[test]
fn the_error_is_within_the_estimate() {
    for (tolerance, seed) in [(1e-4, 11), (1e-6, 12)] {
        let mut chance = Chance::new(seed);
        let (mut count, mut over, mut missed) = (0, 0, 0);
        for family in FAMILIES {
            for k in [0.0, 1e-6, 0.02, 0.3, 1.0] {
                for r in [1e-6, 1e-3, 0.05, 0.3, 0.9] {
                    for depth in [0.001, 0.05, 0.4] {
                        let other = chance.pick(&FAMILIES);
                        let pair = Pair::random([family, other], [k, k], r, depth, &mut chance);
                        let (found, finest) = (patch(&pair, tolerance, false), patch(&pair, 0.01 * tolerance, false));
                        if finest.flags.contains(PatchFlags::FOLDED) {
                            continue;
                        }
                        let force = finest.force.norm();
                        let reach = finest.area.sqrt();
                        let error = ((found.force - finest.force).norm() / force)
                            .max(0.1 * (found.torque - finest.torque).norm() / (force * reach));
                        count += 1;
                        over += usize::from(error > found.error.max(0.1 * tolerance));
                        // Smaller overlaps are not known as well as that.
                        let is_missed = found.flags.contains(PatchFlags::TOLERANCE_NOT_REACHED);
                        missed += usize::from(is_missed && pair.contact.overlap * tolerance > 1e-14);
                        assert!(
                            error < 20.0 * tolerance,
                            "{family} on {other}, k {k}, r {r}, depth {depth}: {error:e}"
                        );
                    }
                }
            }
        }
        assert!(count > 350, "{count} pairs");
        assert!(50 * over < count && 15 * missed < count, "{tolerance}: {over} and {missed} of {count}");
    }
}

#[test]
fn the_points_add_up() {
    let mut chance = Chance::new(3);
    let pair = Pair::random(["rock", "pyramid"], [0.02, 0.0], 0.05, 0.1, &mut chance);
    let (mut force, mut torque, mut area, mut count) = (Vector3::zeros(), Vector3::zeros(), 0.0, 0);
    let (settings, scratch) = (PatchSettings::default(), &mut PatchScratch::new());
    let found =
        patch_of_contact(&pair.a, &pair.pose_a, &pair.b, &pair.pose_b, &pair.contact, &settings, scratch, |point| {
            let load = point.area * point.depth * point.normal;
            force += load;
            torque += point.position.cross(&load);
            area += point.area;
            count += 1;
            assert!((point.normal.norm() - 1.0).abs() < 1e-12 && point.area > 0.0 && point.depth >= 0.0);
            assert!(point.depth <= found_depth(&pair) * (1.0 + 1e-9));
        })
        .unwrap();
    assert_eq!(count, found.points);
    assert!((force - found.force).norm() < 1e-12 * force.norm());
    assert!((torque - found.torque).norm() < 1e-12 * force.norm());
    assert!((area - found.area).abs() < 1e-12 * area);
    // The wrench about its axis is the force and the couple along it.
    let arm = found.branch_a - pair.contact.branch_a;
    let couple = found.torque - arm.cross(&found.force);
    assert!((couple - found.couple * found.force.normalize()).norm() < 1e-12 * force.norm());
}

fn found_depth(pair: &Pair) -> f64 {
    (pair.a.depth_length() + pair.b.depth_length()) * (1.0 - pair.contact.s)
}

#[test]
fn depth_lengths_are_the_slopes_of_faces() {
    for (r, k) in [(0.1, 0.0), (1e-6, 0.0), (0.1, 0.3), (0.01, 0.9), (1e-6, 1e-6)] {
        let cube = cuboid([0.5; 3], r, k);
        let height = cube.surface_distance(&Vector3::zeros(), &Vector3::z()).unwrap();
        // s = √S has half the slope of S on the surface.
        let slope = 0.5 * cube.gradient(&Vector3::new(0.0, 0.0, height)).z;
        assert!((cube.depth_length() * slope - 1.0).abs() < 1e-9, "r {r}, k {k}: {} {slope}", cube.depth_length());
    }
}

#[test]
fn cores_that_meet_are_flagged() {
    let (a, b) = (cuboid([0.5; 3], 0.1, 0.0), cuboid([0.4; 3], 0.1, 0.0));
    let pair = Pair::at_overlap(a, &Matrix3::identity(), b, &Matrix3::identity(), &Vector3::z(), 0.22);
    let found = patch(&pair, 1e-4, false);
    assert!(found.flags.contains(PatchFlags::DEEP), "{}", found.flags);
    // At the core the pressure ends its rise: K (ℓ_A + ℓ_B) on the smaller face.
    assert!(found.force.z > 0.9 * 0.2 * 0.36 && found.force.z < 1.1 * 0.2 * 0.8 * 0.8, "{}", found.force);
}

/// A contact that is not that of the poses leads to some answer, soon, and to no number of points without end.
#[test]
fn a_contact_of_other_poses_ends() {
    let mut chance = Chance::new(8);
    let mut empty = 0;
    for _ in 0..300 {
        let k = chance.pick(&[0.0, 1e-6, 0.3]);
        let families = [chance.pick(&FAMILIES), chance.pick(&FAMILIES)];
        let mut pair = Pair::random(families, [k, k], chance.pick(&[1e-6, 0.05, 0.9]), 0.1, &mut chance);
        let far = chance.pick(&[1e-9, 1e-3, 0.1, 1.0, 1e6]);
        let (moved, turned) = (far * chance.direction(), far * chance.direction());
        pair.contact.branch_a += moved;
        pair.contact.branch_b -= 0.3 * moved;
        pair.contact.normal = (pair.contact.normal + turned).normalize();
        pair.contact.overlap = chance.pick(&[0.0, 1e-300, 1e300, f64::NAN, f64::INFINITY]);
        let found = patch(&pair, 1e-4, chance.uniform() < 0.2);
        assert!(found.force.iter().all(|c| c.is_finite()), "{found:?}");
        assert!(found.rays < 10_000, "{} rays, {} points, {}", found.rays, found.points, found.flags);
        empty += usize::from(found.flags.contains(PatchFlags::EMPTY));
    }
    assert!(empty > 20, "{empty}");
}

/// Whatever patch the buffers held last, one of other kinds of bodies and another path of the integration among them.
#[test]
fn buffers_that_were_used_change_nothing() {
    let (mut chance, mut used) = (Chance::new(41), PatchScratch::new());
    for turn in 0..120 {
        let k = [0.0, 0.02, 0.0, 1.0][turn % 4];
        let families = [chance.pick(&FAMILIES), chance.pick(&FAMILIES)];
        // Face on face, every other time, where a flat part is found.
        let pair = if k == 0.0 && turn % 8 == 0 {
            let (a, b) = (cuboid([0.5; 3], 0.02, 0.0), cuboid([0.4; 3], 0.02, 0.0));
            Pair::at_overlap(a, &Matrix3::identity(), b, &Matrix3::identity(), &Vector3::z(), 0.005)
        } else {
            Pair::random(families, [k, k], 0.3, 0.1, &mut chance)
        };
        let (settings, fresh) = (PatchSettings::default(), patch(&pair, 1e-4, false));
        let Pair { a, pose_a, b, pose_b, contact, .. } = &pair;
        let found = patch_of_contact(a, pose_a, b, pose_b, contact, &settings, &mut used, |_| ()).unwrap();
        assert_eq!(
            (found.force, found.area, found.points),
            (fresh.force, fresh.area, fresh.points),
            "{families:?}, k {k}"
        );
    }
}

/// Where bodies overlap by little more than rounding, a patch takes no more rays than elsewhere, and says that it is not known well.
#[test]
fn faces_that_touch_to_rounding_take_no_more_than_others() {
    let mut chance = Chance::new(29);
    let mut count = 0;
    for round in 0..600 {
        let (r, k) = (chance.pick(&[1e-3, 0.05, 0.3]), chance.pick(&[0.0, 1e-6, 1e-3, 0.1]));
        let body = cuboid([0.5, 0.4, 0.3], 0.5 * r, k);
        let turn = chance.rotation();
        let beside = Vector3::new(1.0, 0.6 * chance.uniform(), 0.4 * chance.uniform());
        let overlap = chance.pick(&[0.0, 1e-17, 1e-16, 1e-15, 1e-14, 1e-13]);
        let pair = Pair::at_overlap(body.clone(), &turn, body, &turn, &(turn * beside.normalize()), overlap);
        if pair.contact.kind != Kind::Overlapping {
            continue;
        }
        count += 1;
        let found = patch(&pair, 1e-4, false);
        assert!(found.rays <= 400 && found.points <= 4000, "{round}: {} rays, {} points", found.rays, found.points);
        let is_told = found.flags.contains(PatchFlags::EMPTY) || found.error > 1e-4;
        assert!(is_told || pair.contact.overlap > 1e-13, "{round}: overlap {:e}", pair.contact.overlap);
        assert!(found.force.iter().chain(found.torque.iter()).all(|c| c.is_finite()) && found.area.is_finite());
    }
    assert!(count > 400, "{count}");
}
