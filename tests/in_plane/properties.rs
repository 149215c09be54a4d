//! What holds for every pair of polygons.

use crate::body::{Body, least, midway, searched_closest, searched_midway, solve};
use nalgebra::Vector3;
use potential_particles::{BackEnd, Flags, Formulation, Kind, PairState, Particle, ParticleError, Plane, Pose};
use potential_particles::{Role, Settings, Wall, closest_point, contact_with_plane, detect};
use proptest::prelude::*;
use std::f64::consts::TAU;

/// Polygons with sides all around, some redundant, at the origin.
fn polygons() -> impl Strategy<Value = Body> {
    let lines = (3usize..9, 0.0..TAU).prop_flat_map(|(count, phase)| {
        prop::collection::vec((-0.2..0.2, 0.2..0.6, 0.5..2.0), count).prop_map(move |lines| {
            let sector = TAU / count as f64;
            let line = |(i, (jitter, offset, length)): (usize, (f64, f64, f64))| {
                let angle = phase + (i as f64 + jitter) * sector;
                [length * angle.cos(), length * angle.sin(), length * offset]
            };
            lines.into_iter().enumerate().map(line).collect::<Vec<[f64; 3]>>()
        })
    });
    (
        lines,
        -3.0..-0.5,
        prop_oneof![1 => Just(0.0), 4 => (-3.0..0.0).prop_map(|e| 10f64.powf(e)), 1 => Just(1.0)],
        0.5..1.0,
    )
        .prop_map(|(lines, log_r, k, shadow_radius)| Body {
            lines,
            r: 10f64.powf(log_r),
            k,
            shadow_radius,
            position: [0.0; 2],
            angle: 0.0,
        })
}

/// A pair with overlap or a small gap in a random direction.
fn pairs() -> impl Strategy<Value = (Body, Body)> {
    (polygons(), polygons(), 0.0..TAU, 0.0..TAU, 0.0..TAU, 0.4..1.1).prop_map(|(a, b, angle_a, angle_b, way, share)| {
        let distance = share * 0.7 * (a.particle().bounding_radius() + b.particle().bounding_radius());
        (a.at([0.2, -0.1], angle_a), b.at([0.2 + distance * way.cos(), -0.1 + distance * way.sin()], angle_b))
    })
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 256,
        failure_persistence: None,
        rng_seed: prop::test_runner::RngSeed::Fixed(1),
        ..ProptestConfig::default()
    })]

    #[test]
    fn midway_is_what_a_search_finds((a, b) in pairs()) {
        let searched = searched_midway(&a, &b);
        let noise = a.noise() + b.noise();
        let contact = midway(&a, &b);
        prop_assert!((contact.s - searched).abs() <= contact.gap + noise, "{} for {searched}, gap {:e}", contact.s, contact.gap);
        prop_assert!((contact.s - searched).abs() <= 1e-8 * searched.max(1.0), "{} for {searched}", contact.s);
        prop_assert!(a.s(&contact.point).max(b.s(&contact.point)) <= contact.s + contact.gap + noise);
        // Where s vanishes (cores that overlap) its root is less sharp than s².
        prop_assert!(contact.gap * (contact.s + contact.gap) < 1e-7 * contact.s.max(1.0).powi(2), "gap {:e}", contact.gap);
        let cone_program = solve(&a, &b, Formulation::Midway, BackEnd::ConeProgram);
        prop_assert!((cone_program.s - contact.s).abs() <= 1e-7 * searched.max(1.0), "{} and {}", cone_program.s, contact.s);
        prop_assert!((cone_program.s - searched).abs() <= cone_program.gap + noise, "{} for {searched}, gap {:e}", cone_program.s, cone_program.gap);
    }

    #[test]
    fn near_polygons_keep_their_digits((a, b) in pairs()) {
        let sharp = |body: Body| Body { r: 1e-6, k: 1e-6, ..body };
        let (a, mut b) = (sharp(a), sharp(b));
        let mut contact = midway(&a, &b);
        // To where s lies between 0 and 1, unless the pair is apart from the first.
        for _ in 0..50 {
            if contact.kind == Kind::Separated || contact.overlap < 1.5e-6 {
                break;
            }
            b = b.moved((contact.overlap - 1e-6) * contact.normal);
            contact = midway(&a, &b);
        }
        let (searched, noise) = (searched_midway(&a, &b), a.noise() + b.noise());
        prop_assert!((contact.s - searched).abs() <= contact.gap + noise, "{} for {searched}, gap {:e}", contact.s, contact.gap);
        prop_assert!(contact.gap <= 16.0 * noise, "s {} gap {:e}", contact.s, contact.gap);
        let cone_program = solve(&a, &b, Formulation::Midway, BackEnd::ConeProgram);
        prop_assert!((cone_program.s - contact.s).abs() <= 1e-7 * searched.max(1.0), "{} and {}", cone_program.s, contact.s);
    }

    #[test]
    fn closest_is_what_a_search_along_the_boundary_finds((a, b) in pairs()) {
        let contact = solve(&a, &b, Formulation::Closest, BackEnd::Fast);
        let overlapping = contact.kind == Kind::Overlapping;
        let inside = [b.s(&a.centre()) < 1.0, overlapping && a.s(&b.centre()) < 1.0];
        if contact.flags.contains(Flags::SLACK) {
            prop_assert!(inside.contains(&true) || a.k == 0.0 || b.k == 0.0);
            prop_assert_eq!(contact.formulation, Formulation::Midway);
        } else {
            prop_assert!(!inside.contains(&true));
            let cone_program = solve(&a, &b, Formulation::Closest, BackEnd::ConeProgram);
            let noise = a.noise() + b.noise();
            let mut sides = vec![(contact.s, cone_program.s, searched_closest(&a, &b))];
            if overlapping {
                sides.push((contact.s_b, cone_program.s_b, searched_closest(&b, &a)));
            }
            for (fast, cone_program, searched) in sides {
                // The search holds the other s at 1 as closely as the boundary is known.
                prop_assert!((fast - searched).abs() <= contact.gap + 1e4 * noise, "{fast} for {searched}, gap {:e}", contact.gap);
                prop_assert!((fast - searched).abs() <= 1e-8 * searched.max(1.0), "{fast} for {searched}");
                prop_assert!((fast - cone_program).abs() <= 1e-7 * searched.max(1.0), "{fast} and {cone_program}");
            }
        }
    }

    #[test]
    fn a_closest_point_alone_is_the_least_on_its_boundary((a, b) in pairs()) {
        let settings = Settings::default();
        for (on, held, free) in [(Role::A, &a, &b), (Role::B, &b, &a)] {
            let found = closest_point(&a.particle(), &a.pose(), &b.particle(), &b.pose(), on, &settings).unwrap();
            let inside = held.s(&free.centre()) < 1.0;
            let Some(found) = found else {
                prop_assert!(inside || free.k == 0.0);
                continue;
            };
            prop_assert!(!inside);
            let (searched, noise) = (searched_closest(free, held), a.noise() + b.noise());
            prop_assert!((found.s - searched).abs() <= found.gap + 1e4 * noise, "{} for {searched}, gap {:e}", found.s, found.gap);
            prop_assert!((held.s(&found.point) - 1.0).abs() <= found.gap + 4.0 * noise, "{:e}", held.s(&found.point) - 1.0);
            prop_assert!((free.s(&found.point) - found.s).abs() <= found.gap + 4.0 * noise, "{:e}", free.s(&found.point) - found.s);
            for (branch, body) in [(found.branch_a, &a), (found.branch_b, &b)] {
                prop_assert!((found.point - branch - body.centre()).norm() < 1e-14);
            }
        }
    }

    #[test]
    fn surface_points_lie_on_both_boundaries((a, b) in pairs()) {
        for formulation in [Formulation::Midway, Formulation::Closest] {
            let contact = solve(&a, &b, formulation, BackEnd::Fast);
            if contact.kind == Kind::Overlapping {
                prop_assert!((a.s(&contact.point_on_a) - 1.0).abs() <= 4.0 * a.noise(), "{:e}", a.s(&contact.point_on_a) - 1.0);
                prop_assert!((b.s(&contact.point_on_b) - 1.0).abs() <= 4.0 * b.noise(), "{:e}", b.s(&contact.point_on_b) - 1.0);
                let apart = contact.point_on_a - contact.point_on_b;
                prop_assert!((apart.norm() - contact.overlap).abs() < 1e-13);
                if contact.formulation == Formulation::Midway {
                    prop_assert!((apart.dot(&contact.normal) - contact.overlap).abs() < 1e-13);
                }
            }
        }
    }

    #[test]
    fn moving_apart_by_the_overlap_separates((a, b) in pairs()) {
        // Brings B to a small overlap along the normal, then a little less and a little more than that apart.
        let small = 1e-3 * a.r.min(b.r);
        let mut b = b;
        let mut contact = midway(&a, &b);
        for _ in 0..50 {
            if contact.kind == Kind::Separated || contact.overlap < 2.0 * small {
                break;
            }
            b = b.moved((contact.overlap - small) * contact.normal);
            contact = midway(&a, &b);
        }
        if contact.kind == Kind::Overlapping && contact.overlap < 2.0 * small {
            let moved = |share: f64| b.moved(share * contact.overlap * contact.normal);
            prop_assert_eq!(midway(&a, &moved(0.99)).kind, Kind::Overlapping);
            prop_assert_eq!(midway(&a, &moved(1.01)).kind, Kind::Separated);
        }
    }

    #[test]
    fn swapping_the_bodies_mirrors_the_contact((a, b) in pairs()) {
        let (one, other) = (midway(&a, &b), midway(&b, &a));
        prop_assert!((one.s - other.s).abs() <= one.gap + other.gap);
        if a.k > 0.0 && b.k > 0.0 && one.s > 0.05 {
            prop_assert!((one.point - other.point).norm() < 1e-7, "{} {}", one.point, other.point);
            prop_assert!((one.normal + other.normal).norm() < 1e-6, "{} {}", one.normal, other.normal);
        }
    }

    #[test]
    fn a_rigid_motion_carries_the_contact_along((a, b) in pairs(), turn in -10.0..10.0, shift in prop::array::uniform2(-1e3..1e3)) {
        let motion = Pose::in_plane(shift, turn).unwrap();
        let carry = |body: &Body| {
            let position = motion.rotate(&body.centre()) + motion.position();
            body.clone().at([position.x, position.y], body.angle + turn)
        };
        let (moved_a, moved_b) = (carry(&a), carry(&b));
        let (before, after) = (midway(&a, &b), midway(&moved_a, &moved_b));
        // Positions of size 1e3 are known to 1e-13 only; times the steepness of s, that is the change allowed.
        let noise = moved_a.noise() + moved_b.noise();
        prop_assert!((before.s - after.s).abs() <= before.gap + after.gap + noise);
        if a.k > 0.0 && b.k > 0.0 && before.s > 0.05 {
            prop_assert!((motion.rotate(&before.branch_a) - after.branch_a).norm() < 1e-7);
            prop_assert!((motion.rotate(&before.normal) - after.normal).norm() < 1e-6);
        }
    }

    #[test]
    fn a_reject_is_a_proof((a, b) in pairs(), further in 1.0..2.0) {
        let b = b.moved((further - 1.0) * (b.centre() - a.centre()));
        let quick = detect(&a.particle(), &a.pose(), &b.particle(), &b.pose(), &Settings::default(), None).unwrap();
        if quick.flags.contains(Flags::REJECTED) {
            let searched = searched_midway(&a, &b);
            prop_assert!(quick.kind == Kind::Separated && quick.s >= 1.0);
            prop_assert!(quick.s <= searched + a.noise() + b.noise(), "{} for {searched}", quick.s);
        } else {
            prop_assert_eq!(quick.kind, midway(&a, &b).kind);
        }
    }

    #[test]
    fn no_state_changes_the_answer_beyond_its_gap((a, b) in pairs(), solution in prop::array::uniform8(prop_oneof![Just(1.0), -2.0..2.0, Just(1e300)])) {
        // Of another pair, even of one in space, so that z is not 0.
        let mut solution = solution;
        solution[0] = 1.0;
        let cold = midway(&a, &b);
        let settings = Settings::default().with_solve_separated(true);
        let mut state = PairState::from_raw(solution);
        for _ in 0..2 {
            let warm = detect(&a.particle(), &a.pose(), &b.particle(), &b.pose(), &settings, Some(&mut state)).unwrap();
            prop_assert!((cold.s - warm.s).abs() <= cold.gap + warm.gap);
            prop_assert_eq!(cold.kind, warm.kind);
            prop_assert!(warm.point.z == 0.0 && warm.normal.z == 0.0, "{warm:?}");
        }
    }

    #[test]
    fn bounds_hold_every_point_of_the_boundary(body in polygons()) {
        let (particle, pose) = (body.particle(), body.clone().at([3.0, -2.0], 0.8).pose());
        let (lower, upper) = particle.bounding_box(&pose);
        let mut fullest: f64 = 0.0;
        for i in 0..500 {
            let (sin, cos) = (f64::from(i) * TAU / 500.0).sin_cos();
            let e = Vector3::new(cos, sin, 0.0);
            let x = particle.surface_distance(&Vector3::zeros(), &e).unwrap() * e;
            prop_assert!((body.s(&x) - 1.0).abs() <= 4.0 * body.noise());
            prop_assert!(x.norm() <= particle.bounding_radius());
            prop_assert!(x.dot(&e) <= particle.bounding_corners().iter().map(|c| c.dot(&e)).fold(0.0, f64::max));
            let world = pose.position() + pose.rotate(&x);
            prop_assert!((0..2).all(|axis| lower[axis] <= world[axis] && world[axis] <= upper[axis]));
            fullest = fullest.max(x.norm());
        }
        // A corner of a triangle of lines reaches further than the round one of the particle.
        prop_assert!(particle.bounding_radius() < 3.0 * fullest, "{} for {fullest}", particle.bounding_radius());
    }

    #[test]
    fn on_a_line_the_least_scale_is_what_a_search_finds((body, _) in pairs(), way in 0.0..TAU, share in 0.05..1.2) {
        let radius = body.particle().bounding_radius();
        let normal = Vector3::new(way.cos(), way.sin(), 0.0);
        let along = Vector3::new(-way.sin(), way.cos(), 0.0);
        let point: Vector3<f64> = body.centre() + share * radius * normal;
        let at = |t: f64| body.s(&(point + t * along));
        let searched = least(-3.0 * radius, 3.0 * radius, &at).1;
        let line = Wall::new(point.into(), normal.into()).unwrap();
        let settings = Settings::default().with_solve_separated(true);
        for gap_tolerance in [settings.gap_tolerance, 1e-14] {
            let settings = settings.with_gap_tolerance(gap_tolerance);
            let found = contact_with_plane(&body.particle(), &body.pose(), &line, &settings, None).unwrap();
            let allowed = found.gap + body.noise();
            prop_assert!((found.s - searched).abs() <= allowed + 1e-9 * searched, "{} for {searched}, {found:?}", found.s);
            prop_assert!(body.s(&found.on_boundary) <= found.s + allowed, "{found:?}");
            prop_assert!([found.point, found.branch, found.normal, found.on_boundary].iter().all(|v| v.z == 0.0));
            if found.kind == Kind::Overlapping {
                prop_assert!((body.s(&found.on_particle) - 1.0).abs() <= 4.0 * body.noise(), "{found:?}");
                prop_assert!(((found.on_particle - found.on_boundary).norm() - found.overlap).abs() < 1e-13);
            }
        }
    }

    #[test]
    fn a_prism_at_the_same_place_is_the_same_contact((a, b) in pairs()) {
        // In space the circle becomes a sphere, and cuts at z = 0 are what the plane has.
        let prism = |body: &Body| {
            let planes: Vec<Plane> = body.lines.iter().map(|&[a, b, d]| [a, b, 0.0, d].into()).collect();
            let turned = [(0.5 * body.angle).cos(), 0.0, 0.0, (0.5 * body.angle).sin()];
            let [x, y] = body.position;
            let particle = Particle::new(&planes, body.r, body.k, body.shadow_radius);
            (particle, Pose::new([x, y, 0.0], turned).unwrap())
        };
        if a.k > 0.0 && b.k > 0.0 {
            let ((prism_a, at_a), (prism_b, at_b)) = (prism(&a), prism(&b));
            let (prism_a, prism_b) = (prism_a.unwrap(), prism_b.unwrap());
            for back_end in [BackEnd::Fast, BackEnd::ConeProgram] {
                let settings = Settings::default().with_back_end(back_end).with_solve_separated(true);
                let space = detect(&prism_a, &at_a, &prism_b, &at_b, &settings, None).unwrap();
                let plane = solve(&a, &b, Formulation::Midway, back_end);
                prop_assert!((space.s - plane.s).abs() <= space.gap + plane.gap + a.noise() + b.noise());
                let accuracy = if back_end == BackEnd::Fast { 1e-7 } else { 1e-3 };
                prop_assert!((space.point - plane.point).norm() < accuracy);
            }
            for on in [Role::A, Role::B] {
                let settings = Settings::default();
                let space = closest_point(&prism_a, &at_a, &prism_b, &at_b, on, &settings).unwrap();
                let plane = closest_point(&a.particle(), &a.pose(), &b.particle(), &b.pose(), on, &settings).unwrap();
                prop_assert_eq!(space.is_some(), plane.is_some());
                if let (Some(space), Some(plane)) = (space, plane) {
                    prop_assert!((space.s - plane.s).abs() <= space.gap + plane.gap + a.noise() + b.noise());
                    let off = (space.point - plane.point).norm();
                    prop_assert!(off <= space.point_bound + plane.point_bound + 1e-15, "{off:e}");
                }
            }
        } else {
            prop_assert!(a.k > 0.0 || matches!(prism(&a).0, Err(ParticleError::Unbounded)));
        }
    }
}

/// The same polygon with normals of any length, and d and r with them, or d alone and so with sharp corners, or neither
/// and so as many times smaller: its area is told, and the call ends.
#[test]
fn areas_are_right_for_normals_of_any_length() {
    let area = |sides: usize, length: f64, of_d: f64, of_r: f64| {
        let lines = (0..sides).map(|i| {
            let (sin, cos) = (0.3 + TAU * i as f64 / sides as f64).sin_cos();
            [length * cos, length * sin, 0.4 * of_d]
        });
        let made = Particle::in_plane(&lines.collect::<Vec<_>>(), 0.1 * of_r, 0.0, 1.0);
        made.map(|particle| particle.mass_properties(1e-6).unwrap())
    };
    for sides in [3, 4, 5, 7] {
        let known = area(sides, 1.0, 1.0, 1.0).unwrap();
        let sharp = sides as f64 * 0.16 * (std::f64::consts::PI / sides as f64).tan();
        for length in [1e-8, 1e3, 1e8, 1e16, 1e25, 1e29] {
            let alike = area(sides, length, length, length).unwrap();
            assert!(
                (alike.volume / known.volume - 1.0).abs() <= alike.error + known.error,
                "{sides}, {length:e}: {alike:?}"
            );
            let small = area(sides, length, 1.0, 1.0).unwrap();
            let off = small.volume * length * length / known.volume - 1.0;
            assert!(off.abs() <= small.error + known.error, "{sides}, {length:e}: {small:?}");
            if length > 1e8 {
                let found = area(sides, length, length, 1.0).unwrap();
                assert!(
                    (found.volume / sharp - 1.0).abs() <= found.error + 10.0 / length,
                    "{sides}, {length:e}: {found:?}"
                );
            }
        }
        // Beyond the range of sizes the length is named.
        let error = area(sides, 1e40, 1.0, 1.0).unwrap_err();
        assert!(matches!(error, ParticleError::Size { radius } if radius < 1e-30), "{error}");
    }
}
