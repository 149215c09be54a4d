//! Points add up; deep contacts and those within rounding are flagged; work ends.

use crate::patch;
use kit::patch::bodies::{Chance, FAMILIES, Pair, contact, cuboid};
use nalgebra::{Matrix3, Vector3};
use potential_particles::{Kind, Particle, PatchFlags, PatchScratch, PatchSettings, Plane, Pose, patch_of_contact};

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

/// Where bodies overlap by little more than rounding, a patch takes no more rays than elsewhere, and says that it is
/// not known well.
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

/// Round bodies have a smooth rim, of which a few arcs enclose all.
#[test]
fn a_smooth_rim_takes_no_rays() {
    let mut chance = Chance::new(31);
    for k in [0.02, 0.3, 1.0] {
        for depth in [0.001, 0.03, 0.3] {
            let pair = Pair::random(["ball", "ball"], [k, k], 1.0, depth, &mut chance);
            let found = patch(&pair, 1e-4, false);
            assert!(found.rays == 0 && found.error < 1e-4, "k {k}, depth {depth}: {} rays", found.rays);
        }
    }
}

/// Two stones whose cores have met: the patch runs along a side of one of them, which leans over, and ends where it
/// turns back. Further out there is another branch of the same conic, a hundred sizes away.
#[test]
fn a_patch_in_two_cores_ends_where_it_turns_back() {
    let lower = [
        [9.408834318949266e-17, 0.9999999896244285, 0.00014405256942602584, 0.028388413257095402],
        [-1.7735507003637937e-16, -0.9999999896244286, -0.00014405256942558176, 0.028965369815053266],
        [-1.1535911115245767e-16, -0.09366465834754625, -0.9956038026125842, 0.1924987365861789],
        [1.0609406657157493e-16, -0.10715119443072468, 0.9942427377316212, 0.1934654288414339],
        [0.9659258262890689, -0.25768122549262573, 0.024242197433365854, 0.49520323418038376],
        [-0.9659258262890683, -0.2576812254926279, 0.024242197433365913, 0.4952032341803837],
    ];
    let upper = [
        [7.40850499876268e-17, 0.9999999145718116, 0.00041334775867446494, 0.02845839937067512],
        [3.693725247488884e-17, -0.9999999145718117, -0.0004133477586743539, 0.029036778302854057],
        [4.617291937223793e-17, -0.08064690599114122, -0.9967427333841247, 0.19096803717337207],
        [-8.585270643253849e-17, -0.11909696198815523, 0.9928826283328721, 0.1939987575067612],
        [0.9659258262890684, -0.24860353137690488, 0.07199709921040476, 0.47664746740157754],
        [-0.9659258262890682, -0.2486035313769053, 0.07199709921040508, 0.4766474674015771],
    ];
    let a = Particle::new(&lower.map(Plane::from), 0.00017309994890990588, 0.0, 0.5615733162767249).unwrap();
    let b = Particle::new(&upper.map(Plane::from), 0.00017352669317966362, 0.0, 0.5515733927791652).unwrap();
    let pose_a = Pose::new(
        [0.4953763341292937, 1.8487696478377393, 0.1926718365350889],
        [0.990354615099656, 0.04648278708668762, -0.006119575014785643, -0.13038265857507397],
    )
    .unwrap();
    let mut chance = Chance::new(41);
    for round in 0..1000 {
        let size = chance.pick(&[1e-4, 1e-5, 1e-6, 1e-7, 1e-9]);
        let mut near = |value: f64| value + size * (chance.uniform() - 0.5);
        let position = [0.4772110852824913, 1.7809518838025824, 0.5710400870810807].map(&mut near);
        let turn = [0.9821407640728007, 0.13550315287254905, -0.01783145924943189, -0.1293075951718605].map(&mut near);
        let pose_b = Pose::new(position, turn).unwrap();
        let contact = contact(&a, &pose_a, &b, &pose_b);
        let pair = Pair { a: a.clone(), b: b.clone(), pose_a, pose_b, contact };
        let found = patch(&pair, 1e-4, false);
        // The stones share 0.046 of their faces, at an overlap of 3.5e-4 at most.
        assert!(
            found.area < 0.06 && found.force.norm() < 0.06 * 3.5e-4,
            "{round}: {} and {:?}",
            found.area,
            found.force
        );
    }
}
