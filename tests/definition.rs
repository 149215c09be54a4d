//! What a contact is, tested from closed forms, not from earlier output. What holds of every pair by definition
//! (`kit/src/stress/judge`) is judged of random ones in `stress`.

use nalgebra::{UnitQuaternion, Vector3};
use potential_particles::{
    BackEnd, Contact, Flags, Formulation, Kind, PairState, Particle, Plane, Pose, Settings, detect,
};

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

/// Midway and closest of balls of radii 2 and 0.5 whose centres lie along n, spheres or circles of the plane, near to
/// touching and farther from it.
#[test]
fn balls_match_their_closed_form() {
    let sphere = |radius| Particle::sphere(radius).unwrap();
    let circle = |radius| Particle::in_plane(&[], 0.0, 1.0, radius).unwrap();
    let turned = |centre: Vector3<f64>| pose(centre.into(), [0.5, 0.5, -0.5, 0.5]);
    let spun = |centre: Vector3<f64>| Pose::in_plane([centre.x, centre.y], 12.0).unwrap();
    let (in_space, in_plane) = (pose([1.0, 2.0, 3.0], [1.0, 0.0, 0.0, 0.0]), Pose::in_plane([1.0, 2.0], -0.7).unwrap());
    ball_on_ball([sphere(2.0), sphere(0.5)], Vector3::new(1.0, 2.0, -2.0) / 3.0, &in_space, turned, 1e-9);
    ball_on_ball([circle(2.0), circle(0.5)], Vector3::new(-0.6, 0.8, 0.0), &in_plane, spun, 1e-6);
}

fn ball_on_ball([a, b]: [Particle; 2], n: Vector3<f64>, at_a: &Pose, at_b: impl Fn(Vector3<f64>) -> Pose, near: f64) {
    let (ra, rb) = (2.0, 0.5);
    for (back_end, accuracy) in [(BackEnd::Fast, 1e-14), (BackEnd::ConeProgram, 1e-7)] {
        for distance in [2.2, 2.5 - near, 2.5 + near, 3.0] {
            let at_b = at_b(at_a.position() + distance * n);
            let settings = Settings::default().with_back_end(back_end).with_solve_separated(true);
            let contact = detect(&a, at_a, &b, &at_b, &settings, None).unwrap();
            // Both scaled by s they touch: s (ra + rb) = distance.
            assert!((contact.s - distance / (ra + rb)).abs() < accuracy, "{back_end:?}: s = {}", contact.s);
            assert_eq!(contact.kind == Kind::Overlapping, distance < ra + rb);
            assert!((contact.normal - n).norm() < 10.0 * accuracy);
            let off = (contact.branch_a - n * distance * ra / (ra + rb)).norm();
            assert!(off < 10.0 * accuracy && off <= contact.point_bound, "{off:e}, bound {:e}", contact.point_bound);
            if distance < ra + rb {
                assert!((contact.overlap - (ra + rb - distance)).abs() < 10.0 * accuracy);
                assert!((contact.point_on_a - at_a.position() - ra * n).norm() < 10.0 * accuracy);
                assert!((contact.point_on_b - at_b.position() + rb * n).norm() < 10.0 * accuracy);
            } else {
                assert!(contact.overlap.is_nan() && contact.point_on_a.x.is_nan());
            }
            let settings = settings.with_formulation(Formulation::Closest);
            let contact = detect(&a, at_a, &b, &at_b, &settings, None).unwrap();
            assert!((contact.s - (distance - rb) / ra).abs() < accuracy);
            if distance < ra + rb {
                assert!((contact.s_b - (distance - ra) / rb).abs() < 10.0 * accuracy);
                assert!((contact.point - at_a.position() - 0.5 * (ra + distance - rb) * n).norm() < 10.0 * accuracy);
            }
        }
    }
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
