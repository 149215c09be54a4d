//! What a contact is, tested from definitions and closed forms, not from earlier output.

use kit::balls;
use nalgebra::{UnitQuaternion, Vector3};
use potential_particles::{Contact, Flags, Formulation, Kind, PairState, Particle, Plane, Pose, Settings, detect};
use proptest::prelude::*;

/// A box with half edges, rounded by r (faces of the finished particle near the half edges).
fn cuboid(half: [f64; 3], r: f64, k: f64, shadow_radius: f64) -> Particle {
    let planes: Vec<Plane> = (0..3)
        .flat_map(|axis| [1.0, -1.0].map(|sign| Plane { normal: Vector3::ith(axis, sign), offset: half[axis] - r }))
        .collect();
    Particle::new(&planes, r, k, shadow_radius).expect("a valid box")
}

fn pose(position: [f64; 3], orientation: [f64; 4]) -> Pose {
    Pose::new(position, orientation).expect("a valid pose")
}

/// Solves to the end, whatever the kind.
fn solve(a: &Particle, at_a: &Pose, b: &Particle, at_b: &Pose, formulation: Formulation) -> Contact {
    let settings = Settings::default().with_formulation(formulation).with_solve_separated(true);
    detect(a, at_a, b, at_b, &settings, None).expect("an answer")
}

/// S by its definition, world point.
fn s_of(particle: &Particle, pose: &Pose, point: &Vector3<f64>) -> f64 {
    (particle.potential(&pose.to_local(point)) + 1.0).sqrt()
}

#[test]
fn spheres_match_their_closed_form() {
    let at_a = pose([1.0, 2.0, 3.0], [1.0, 0.0, 0.0, 0.0]);
    let at_b = |centre: Vector3<f64>| pose(centre.into(), [0.5, 0.5, -0.5, 0.5]);
    let n = Vector3::new(1.0, 2.0, -2.0) / 3.0;
    balls::match_their_closed_form(|radius| Particle::sphere(radius).unwrap(), n, &at_a, at_b, 1e-9);
}

#[test]
fn stacked_cubes_with_flat_faces_match_their_closed_form() {
    // k = 0: S = ((z − d)/r)² above a face, so that both cubes scaled by t touch when t·2r = gap of the cores.
    let (half, r) = (0.5, 0.05);
    let cube = cuboid([half; 3], r, 0.0, 0.0);
    for overlap in [1e-12, 1e-6, 1e-3, 0.05] {
        let height = 2.0 * half - overlap;
        let (low, high) = (pose([0.0; 3], [1.0, 0.0, 0.0, 0.0]), pose([0.0, 0.0, height], [1.0, 0.0, 0.0, 0.0]));
        let contact = solve(&cube, &low, &cube, &high, Formulation::Midway);
        let t = (height - 2.0 * (half - r)) / (2.0 * r);
        assert!((contact.s - t).abs() <= 1e-14, "s = {} for {t}", contact.s);
        assert!((contact.overlap - overlap).abs() < 1e-15);
        // Of the whole patch of solutions the one nearest to the centres: the limit k -> 0.
        assert!((contact.point - Vector3::new(0.0, 0.0, 0.5 * height)).norm() < 1e-12, "{}", contact.point);
        assert!((contact.normal - Vector3::z()).norm() < 1e-14);
    }
}

#[test]
fn coincident_centres_have_a_defined_answer() {
    let cube = cuboid([0.5; 3], 0.05, 0.2, 0.9);
    let at = pose([3.0, 4.0, 5.0], [1.0, 0.0, 0.0, 0.0]);
    for formulation in [Formulation::Midway, Formulation::Closest] {
        let contact = solve(&cube, &at, &cube, &at, formulation);
        assert_eq!(contact.kind, Kind::Overlapping);
        assert!(contact.s.abs() <= contact.gap);
        assert!(contact.flags.contains(Flags::NORMAL_BY_CENTRES));
        assert!((contact.normal.norm() - 1.0).abs() < 1e-15 && contact.overlap > 0.9);
        assert_eq!(contact.flags.contains(Flags::SLACK), formulation == Formulation::Closest);
        assert_eq!(contact.formulation, Formulation::Midway);
    }
}

#[test]
fn a_contained_particle_makes_closest_slack_and_says_so() {
    let (large, small) = (cuboid([1.0; 3], 0.1, 0.1, 2.0), cuboid([0.1; 3], 0.01, 0.1, 0.2));
    let contact = solve(
        &large,
        &pose([0.0; 3], [1.0, 0.0, 0.0, 0.0]),
        &small,
        &pose([0.3, 0.1, 0.0], [1.0, 0.1, 0.2, 0.3]),
        Formulation::Closest,
    );
    assert!(contact.flags.contains(Flags::SLACK));
    assert_eq!((contact.kind, contact.formulation), (Kind::Overlapping, Formulation::Midway));
}

/// Shapes that matter: round, flat, needle, near-polyhedral, exactly polyhedral.
fn shapes() -> impl Strategy<Value = Particle> {
    let half = prop::array::uniform3(0.1..1.0);
    (half, -4.0..-1.0, prop_oneof![Just(0.0), (-5.0..-0.1).prop_map(|e: f64| 10f64.powf(e)), Just(1.0)]).prop_map(
        |(half, log_r, k)| {
            let least = half.iter().copied().fold(1.0, f64::min);
            cuboid(half, least * 10f64.powf(log_r), k, 1.2 * Vector3::from(half).norm())
        },
    )
}

fn directions() -> impl Strategy<Value = Vector3<f64>> {
    prop::array::uniform3(-1.0..1.0).prop_filter_map("too short", |v: [f64; 3]| Vector3::from(v).try_normalize(0.1))
}

fn orientations() -> impl Strategy<Value = [f64; 4]> {
    prop::array::uniform4(-1.0..1.0)
        .prop_filter("too short", |q: &[f64; 4]| q.iter().map(|c| c * c).sum::<f64>() > 0.01)
}

/// A pair with overlap or a small gap along a random direction.
fn pairs() -> impl Strategy<Value = (Particle, Pose, Particle, Pose)> {
    (shapes(), shapes(), orientations(), orientations(), directions(), 0.4..1.1).prop_map(|(a, b, qa, qb, n, share)| {
        let distance = share * 0.7 * (a.bounding_radius() + b.bounding_radius());
        (a, pose([0.0; 3], qa), b, pose([distance * n.x, distance * n.y, distance * n.z], qb))
    })
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 512,
        failure_persistence: None,
        rng_seed: prop::test_runner::RngSeed::Fixed(1),
        ..ProptestConfig::default()
    })]

    #[test]
    fn surface_points_lie_on_both_surfaces((a, at_a, b, at_b) in pairs()) {
        for formulation in [Formulation::Midway, Formulation::Closest] {
            let contact = solve(&a, &at_a, &b, &at_b, formulation);
            if contact.kind == Kind::Overlapping {
                // |s − 1| in lengths: divided by how steep s is there.
                let off = |particle: &Particle, pose: &Pose, point: &Vector3<f64>| {
                    (s_of(particle, pose, point) - 1.0).abs() / (0.5 * particle.gradient(&pose.to_local(point)).norm())
                };
                prop_assert!(off(&a, &at_a, &contact.point_on_a) < 1e-12, "{:e} {:?}", off(&a, &at_a, &contact.point_on_a), contact);
                prop_assert!(off(&b, &at_b, &contact.point_on_b) < 1e-12, "{:e} {:?}", off(&b, &at_b, &contact.point_on_b), contact);
                if contact.formulation == Formulation::Closest {
                    prop_assert!(s_of(&a, &at_a, &contact.point_on_b) < 1.0 + 1e-9);
                    prop_assert!(s_of(&b, &at_b, &contact.point_on_a) < 1.0 + 1e-9);
                }
                let along = (contact.point_on_a - contact.point_on_b).dot(&contact.normal);
                if contact.formulation == Formulation::Midway {
                    prop_assert!((along - contact.overlap).abs() < 1e-13, "{along} {}", contact.overlap);
                }
            }
        }
    }

    #[test]
    fn midway_is_the_least_common_scale((a, at_a, b, at_b) in pairs(), n in directions(), step in 1e-6..0.1) {
        let contact = solve(&a, &at_a, &b, &at_b, Formulation::Midway);
        let scale = |x: &Vector3<f64>| s_of(&a, &at_a, x).max(s_of(&b, &at_b, x));
        // No other point may do better than the proved bound allows.
        prop_assert!(scale(&(contact.point + step * n)) >= contact.s - contact.gap - 1e-15);
        // The gap is proved for s²: where s vanishes (cores with flat faces that overlap) its root is less sharp.
        // The normal is that of A's level surface through the point (where rounding lets it be known so well). A
        // last step that was carried over by derivatives once left it behind by 1e-9.
        if a.rounding_radius() > 1e-3 && a.sphericity() > 1e-3 && b.sphericity() > 1e-3 && contact.s > 0.1 {
            let outward = at_a.rotate(&a.gradient(&at_a.to_local(&contact.point))).normalize();
            prop_assert!((contact.normal - outward).norm() < 1e-10, "{:e}", (contact.normal - outward).norm());
        }
        prop_assert!(contact.gap * (contact.s + contact.gap) < 1e-7 * contact.s.max(1.0).powi(2), "{contact:?}");
    }

    #[test]
    fn moving_apart_by_the_overlap_separates((a, at_a, b, at_b) in pairs()) {
        // Brings B to a small overlap along the normal, then a little less and a little more than that apart.
        let small = 1e-3 * a.rounding_radius().min(b.rounding_radius());
        let apart = |at: &Pose, n: &Vector3<f64>, by: f64| Pose::new((at.position() + by * n).into(), at.orientation()).unwrap();
        let mut at_b = at_b;
        let mut contact = solve(&a, &at_a, &b, &at_b, Formulation::Midway);
        for _ in 0..50 {
            if contact.kind == Kind::Separated || contact.overlap < 2.0 * small {
                break;
            }
            at_b = apart(&at_b, &contact.normal, contact.overlap - small);
            contact = solve(&a, &at_a, &b, &at_b, Formulation::Midway);
        }
        if contact.kind == Kind::Overlapping && contact.overlap < 2.0 * small {
            let moved = |share: f64| apart(&at_b, &contact.normal, share * contact.overlap);
            prop_assert_eq!(solve(&a, &at_a, &b, &moved(0.99), Formulation::Midway).kind, Kind::Overlapping);
            prop_assert_eq!(solve(&a, &at_a, &b, &moved(1.01), Formulation::Midway).kind, Kind::Separated);
        }
    }

    #[test]
    fn swapping_the_bodies_mirrors_the_contact((a, at_a, b, at_b) in pairs()) {
        let (one, other) = (solve(&a, &at_a, &b, &at_b, Formulation::Midway), solve(&b, &at_b, &a, &at_a, Formulation::Midway));
        prop_assert!((one.s - other.s).abs() <= one.gap + other.gap);
        if a.sphericity() > 0.0 && b.sphericity() > 0.0 && one.s > 0.05 {
            prop_assert!((one.point - other.point).norm() < 1e-7, "{} {}", one.point, other.point);
            prop_assert!((one.normal + other.normal).norm() < 1e-6, "{:e} point {:e} {} {}", (one.normal + other.normal).norm(), (one.point-other.point).norm(), one.s, one.gap);
        }
    }

    #[test]
    fn a_rigid_motion_carries_the_contact_along((a, at_a, b, at_b) in pairs(), q in orientations(), shift in prop::array::uniform3(-1e3..1e3)) {
        let turn_by = nalgebra::Quaternion::new(q[0], q[1], q[2], q[3]);
        let turn = UnitQuaternion::from_quaternion(turn_by).to_rotation_matrix().into_inner();
        let carry = |p: &Pose| {
            let [w, x, y, z] = p.orientation();
            let turned = turn_by * nalgebra::Quaternion::new(w, x, y, z);
            Pose::new((turn * p.position() + Vector3::from(shift)).into(), [turned.w, turned.i, turned.j, turned.k]).unwrap()
        };
        let before = solve(&a, &at_a, &b, &at_b, Formulation::Midway);
        let after = solve(&a, &carry(&at_a), &b, &carry(&at_b), Formulation::Midway);
        // Positions of size 1e3 are known to 1e-13 only; times the steepness of s, that is the change allowed.
        let steepness = |p: &Particle| 2.0 / p.rounding_radius().max(1e-4);
        prop_assert!((before.s - after.s).abs() <= before.gap + after.gap + 1e-12 * steepness(&a).max(steepness(&b)));
    }

    #[test]
    fn units_do_not_matter((a, at_a, b, at_b) in pairs(), exponent in -30i32..20) {
        // Powers of two scale without rounding: the answer must be the same to the last bit.
        let unit = 2f64.powi(exponent);
        let scaled = |p: &Particle| {
            let planes: Vec<Plane> = p.planes().map(|plane| Plane { offset: unit * plane.offset, ..plane }).collect();
            Particle::new(&planes, unit * p.rounding_radius(), p.sphericity(), unit * p.shadow_radius()).unwrap()
        };
        let place = |p: &Pose| Pose::new((unit * p.position()).into(), p.orientation()).unwrap();
        let before = solve(&a, &at_a, &b, &at_b, Formulation::Midway);
        let after = solve(&scaled(&a), &place(&at_a), &scaled(&b), &place(&at_b), Formulation::Midway);
        prop_assert!((before.s - after.s).abs() <= before.gap + after.gap);
        prop_assert_eq!(before.kind, after.kind);
        if before.kind == Kind::Overlapping && a.sphericity() > 0.0 && b.sphericity() > 0.0 {
            prop_assert!((after.overlap - unit * before.overlap).abs() < 1e-9 * unit);
        }
    }

    #[test]
    fn no_state_changes_the_answer_beyond_its_gap((a, at_a, b, at_b) in pairs(), solution in prop::array::uniform8(prop_oneof![Just(1.0), -2.0..2.0, Just(f64::NAN), Just(1e300)])) {
        let cold = solve(&a, &at_a, &b, &at_b, Formulation::Midway);
        let settings = Settings::default().with_solve_separated(true);
        let mut solution = solution;
        solution[0] = 1.0;
        let mut state = PairState::from_raw(solution);
        let warm = detect(&a, &at_a, &b, &at_b, &settings, Some(&mut state)).unwrap();
        prop_assert!((cold.s - warm.s).abs() <= cold.gap + warm.gap);
        let again = detect(&a, &at_a, &b, &at_b, &settings, Some(&mut state)).unwrap();
        prop_assert!((cold.s - again.s).abs() <= cold.gap + again.gap);
    }

    #[test]
    fn a_reject_is_a_proof((a, at_a, b, at_b) in pairs(), further in 1.0f64..2.0) {
        let at_b = Pose::new((at_b.position() * further).into(), at_b.orientation()).unwrap();
        let quick = detect(&a, &at_a, &b, &at_b, &Settings::default(), None).unwrap();
        let full = solve(&a, &at_a, &b, &at_b, Formulation::Midway);
        if quick.flags.contains(Flags::REJECTED) {
            prop_assert!(full.s + full.gap > 1.0);
            prop_assert!(quick.s <= full.s + full.gap && quick.s >= 1.0);
        } else {
            prop_assert_eq!(quick.kind, full.kind);
        }
    }
}

/// Solved to the end, a pair that is just apart has a lower bound on its distance above 0, whatever it remembers: the
/// way along which it was moved is longer.
#[test]
fn what_is_just_apart_knows_a_distance() {
    let at_a = pose([0.0; 3], [1.0, 0.0, 0.0, 0.0]);
    let turn = UnitQuaternion::from_euler_angles(0.3, -0.5, 0.8);
    let orientation = [turn.w, turn.i, turn.j, turn.k];
    let along = Vector3::new(0.3, -0.2, 1.0).normalize();
    for (k, orientation) in [(0.0, [1.0, 0.0, 0.0, 0.0]), (0.0, orientation), (0.3, orientation)] {
        let body = cuboid([0.5; 3], 0.05, k, 1.0);
        for formulation in [Formulation::Midway, Formulation::Closest] {
            let settings = Settings::default().with_formulation(formulation).with_solve_separated(true);
            let found = |length: f64, state: Option<&mut PairState>| {
                let at_b = pose((length * along).into(), orientation);
                detect(&body, &at_a, &body, &at_b, &settings, state).expect("an answer")
            };
            let (mut touching, mut apart) = (0.3, 2.5);
            for _ in 0..60 {
                let middle = 0.5 * (touching + apart);
                let side = if found(middle, None).kind == Kind::Overlapping { &mut touching } else { &mut apart };
                *side = middle;
            }
            for before in [-1e-2, -1e-4, 1e-4] {
                for gap in [1e-2, 1e-3, 1e-6, 1e-9] {
                    let mut state = PairState::default();
                    found(apart + before, Some(&mut state));
                    let contact = found(apart + gap, Some(&mut state));
                    assert_eq!(contact.kind, Kind::Separated);
                    assert!(contact.distance > 0.2 * gap && contact.distance <= gap + 1e-12, "{gap}: {contact:?}");
                }
            }
        }
    }
}

#[test]
fn raised_regularisation_loses_no_contact() {
    let cube = cuboid([0.5; 3], 0.05, 0.0, 1.0);
    let at_a = pose([0.0; 3], [1.0, 0.0, 0.0, 0.0]);
    for flat_regularisation in [1e-13, 1e-5, 1e-4, 1e-3, 1e-2] {
        for exponent in -8..=-3 {
            for (aside, tilt) in [(0.0, 0.0), (0.3, 0.0), (0.2, 1e-4)] {
                let overlap = 10f64.powi(exponent);
                let settings = Settings::default().with_flat_regularisation(flat_regularisation);
                let at_b = pose([aside, 0.1, 1.0 - overlap], [1.0, tilt, 0.0, 0.0]);
                let case =
                    format!("regularisation {flat_regularisation}, overlap {overlap}, aside {aside}, tilt {tilt}");
                let contact = detect(&cube, &at_a, &cube, &at_b, &settings, None).expect(&case);
                // Tilted, the edges overlap by 1e-4 more or less than the middles.
                let plain = detect(&cube, &at_a, &cube, &at_b, &Settings::default(), None).expect(&case);
                assert_eq!(contact.kind, plain.kind, "{case}: {contact:?}");
                assert!(contact.kind == Kind::Separated || contact.overlap > 0.0, "{case}: {contact:?}");
                if tilt == 0.0 {
                    assert_eq!(contact.kind, Kind::Overlapping, "{case}: {contact:?}");
                    assert!((contact.overlap - overlap).abs() <= 1e-3 * overlap, "{case}: {}", contact.overlap);
                }
            }
        }
    }
}

/// Faces that are tilted by less than the bulge of the raised regularisation and overlap by their edges: the library
/// decides with the default one, says so, and gives the default's answer.
#[test]
fn a_regularisation_that_was_overridden_is_told() {
    let cube = cuboid([0.5; 3], 0.05, 0.0, 1.0);
    let at_a = pose([0.0; 3], [1.0, 0.0, 0.0, 0.0]);
    let (mut told, mut untold) = (0, 0);
    for flat_regularisation in [1e-13, 1e-6, 1e-4, 1e-2] {
        for exponent in [-12, -8, -4, -2] {
            for tilt in [0.0, 1e-8, 1e-6, 1e-4] {
                for formulation in [Formulation::Midway, Formulation::Closest] {
                    let default = Settings::default().with_formulation(formulation);
                    let at_b = pose([0.3, 0.1, 1.0 + tilt - 10f64.powi(exponent)], [1.0, tilt, tilt, 0.0]);
                    let case = format!("{flat_regularisation}, {exponent}, {tilt}, {formulation}");
                    let settings = default.with_flat_regularisation(flat_regularisation);
                    let contact = detect(&cube, &at_a, &cube, &at_b, &settings, None).expect(&case);
                    let plain = detect(&cube, &at_a, &cube, &at_b, &default, None).expect(&case);
                    assert!(!plain.flags.contains(Flags::DEFAULT_REGULARISATION), "{case}");
                    if contact.flags.contains(Flags::DEFAULT_REGULARISATION) {
                        told += 1;
                        assert!(flat_regularisation > default.flat_regularisation, "{case}");
                        assert_eq!(contact.kind, plain.kind, "{case}");
                        assert!((contact.s - plain.s).abs() <= contact.gap + plain.gap, "{case}");
                        assert!(
                            (contact.point - plain.point).norm() <= contact.point_bound + plain.point_bound,
                            "{case}"
                        );
                    } else {
                        untold += 1;
                    }
                }
            }
        }
    }
    assert!(told > 5 && untold > 30, "{told} overridden, {untold} not");
}

/// Two cubes that overlap corner to corner, so that their planes alone fix the point.
#[test]
fn a_regularisation_below_the_default_counts_as_the_default() {
    let cube = cuboid([0.5; 3], 0.05, 0.0, 0.0);
    let at_a = pose([0.0; 3], [1.0, 0.0, 0.0, 0.0]);
    for at_b in [pose([0.93; 3], [1.0, 0.0, 0.0, 0.0]), pose([0.2, 0.1, 0.98], [1.0, 0.0, 0.0, 0.0])] {
        let of = |flat_regularisation: f64| {
            let settings = Settings::default().with_flat_regularisation(flat_regularisation);
            detect(&cube, &at_a, &cube, &at_b, &settings, None).unwrap()
        };
        let default = of(Settings::default().flat_regularisation);
        for least in [0.0, 1e-300, 1e-20] {
            let contact = of(least);
            assert_eq!((contact.s, contact.gap, contact.point), (default.s, default.gap, default.point), "{least:e}");
        }
    }
}

/// (n, d) and r times any number are the same body: the answer and its bounds are the same but for rounding.
#[test]
fn the_length_of_normals_changes_nothing() {
    // Faces that are not those of the local axes, in which the curvature of a plane is spread over all entries.
    let aside = UnitQuaternion::from_euler_angles(0.4, -0.7, 1.1);
    let body = |half: f64, r: f64, k: f64, length: f64| {
        let faces = (0..3).flat_map(|axis| [1.0, -1.0].map(|sign| aside * Vector3::ith(axis, sign)));
        let planes: Vec<Plane> = faces.map(|n| Plane { normal: length * n, offset: length * (half - r) }).collect();
        Particle::new(&planes, length * r, k, 2.0 * half).unwrap()
    };
    let placed = |position: [f64; 3], turn: UnitQuaternion<f64>| {
        let q = turn * aside.inverse();
        pose(position, [q.w, q.i, q.j, q.k])
    };
    let turns = [(0.0, 0.0, 0.0), (1e-9, 2e-9, 0.3), (0.8, 0.3, -0.2)];
    for (r, k) in [(1e-3, 1e-8), (1e-3, 1e-10), (1e-5, 1e-5), (0.05, 0.0), (1e-3, 0.5)] {
        for (roll, pitch, yaw) in turns {
            for height in [1.5 - 1e-4, 1.6] {
                let at_a = placed([0.0; 3], UnitQuaternion::identity());
                let at_b = placed([0.3, 0.1, height], UnitQuaternion::from_euler_angles(roll, pitch, yaw));
                let answer = |of_a: f64, of_b: f64| {
                    solve(&body(1.0, r, k, of_a), &at_a, &body(0.5, r, k, of_b), &at_b, Formulation::Midway)
                };
                let one = answer(1.0, 1.0);
                for (of_a, of_b) in [(1e4, 1e4), (1e-4, 1e-4), (1e4, 1e-4), (3.0, 3e2), (1e-2, 1e-3)] {
                    let case = format!("r={r:e}, k={k:e}, roll {roll}, height {height}, |n|={of_a:e} and {of_b:e}");
                    let other = answer(of_a, of_b);
                    assert!((one.s - other.s).abs() <= one.gap + other.gap, "{case}: {:e} {:e}", one.s, other.s);
                    let apart = (one.point - other.point).norm();
                    assert!(apart <= one.point_bound + other.point_bound, "{case}: points {apart:e} apart");
                    // Within the tolerance either may stop a step earlier.
                    let most = 4.0 * one.gap + Settings::default().gap_tolerance;
                    assert!(other.gap <= most, "{case}: gaps {:e} and {:e}", one.gap, other.gap);
                    let extended = |contact: &Contact| contact.flags.contains(Flags::EXTENDED);
                    assert_eq!(extended(&other), extended(&one), "{case}");
                }
            }
        }
    }
}

/// Two tall blocks whose faces lie 2e-8 of their size apart or overlap by some more: with any regularisation there is
/// an answer, and the right kind. A proof of separation on the way leaves the upper bound where it is, and a raised
/// regularisation widens the gap by itself.
#[test]
fn blocks_face_to_face_are_answered_by_any_regularisation() {
    let (a, b) = (cuboid([5.0, 5.0, 14.0], 4e-3, 0.0, 20.0), cuboid([5.0, 5.0, 11.0], 4e-3, 0.0, 20.0));
    let orientation = [0.9999999998739891, -2.3675613622455604e-13, 1.5875192733942338e-05, 3.036264186188587e-11];
    let at_a = pose([-114.99953205051497, -3.309720340851244e-10, 26.000135299378865], orientation);
    let orientation = [0.9999999998609699, -3.55642490621162e-13, 1.667514058417154e-05, 3.014308169986809e-11];
    for flat_regularisation in [1e-13, 1e-8, 1e-4, 1e-2, 2.5e-2, 0.1] {
        for (closer, kind) in [(0.0, Kind::Separated), (8.5e-5, Kind::Overlapping), (1e-3, Kind::Overlapping)] {
            let at_b = pose([closer - 124.99961318552711, -2.54879564075102e-10, 24.000147783915253], orientation);
            for solve_separated in [true, false] {
                let settings = Settings::default()
                    .with_flat_regularisation(flat_regularisation)
                    .with_solve_separated(solve_separated);
                let found = detect(&a, &at_a, &b, &at_b, &settings, None).expect("an answer");
                assert_eq!(found.kind, kind, "{flat_regularisation:e}, {closer:e} closer: {found:?}");
            }
        }
    }
}
