//! Particles in the plane (the paper's eqs 1 and 5 to 31), against closed forms and against searches that know nothing
//! of the solver.

mod body;
mod closest;
mod kinds;
mod polygon;
mod properties;

use body::{Body, circle, midway, solve};
use kit::balls;
use nalgebra::Vector3;
use potential_particles::{BackEnd, Formulation, Kind, PairState, Particle, ParticleError, Pose, PoseError};
use potential_particles::{Role, Section, Settings, closest_point, detect};
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_4, SQRT_2};

#[test]
fn circles_match_their_closed_form() {
    let at_a = Pose::in_plane([1.0, 2.0], -0.7).unwrap();
    let at_b = |centre: Vector3<f64>| Pose::in_plane([centre.x, centre.y], 12.0).unwrap();
    balls::match_their_closed_form(circle, Vector3::new(-0.6, 0.8, 0.0), &at_a, at_b, 1e-6);
}

#[test]
fn stacked_squares_touch_at_the_centre_of_the_patch() {
    for (half, r, k) in [(0.5, 0.1, 0.0), (0.5, 1e-6, 0.0), (0.5, 1e-3, 0.2), (2.0, 1e-6, 1e-6)] {
        for (angle, shift) in [(0.0, 0.0), (0.0, 0.3 * half), (0.4, 0.0), (0.4, -0.7 * half)] {
            let height = 2.0 * half - 0.5 * r;
            let across = Vector3::new(f64::cos(angle), f64::sin(angle), 0.0);
            let up = Vector3::z().cross(&across);
            let a = Body::square(half, r, k).at([0.3, -0.2], angle);
            let b = Body::square(half, r, k).at(a.position, angle).moved(shift * across + height * up);
            let centre = a.centre() + 0.5 * (shift * across + height * up);
            // A half turn about the centre of the patch swaps the two.
            let s = a.s(&centre);
            let gradient = a.particle().gradient(&a.pose().to_local(&centre));
            let normal = if k == 0.0 { up } else { a.pose().rotate(&gradient).normalize() };
            for back_end in [BackEnd::Fast, BackEnd::ConeProgram] {
                let contact = solve(&a, &b, Formulation::Midway, back_end);
                let accuracy = if back_end == BackEnd::Fast { a.noise() } else { 1e-7 };
                assert!((contact.s - s).abs() <= accuracy + contact.gap, "{back_end:?} {} for {s}", contact.s);
                assert!((contact.normal - normal).norm() < 1e-6, "{back_end:?} {}", contact.normal);
                // The boundary is flat there for k = 0 only.
                if k == 0.0 {
                    assert!((contact.overlap - 0.5 * r).abs() < 1e-9, "{}", contact.overlap);
                }
                if back_end == BackEnd::Fast {
                    let off = (contact.point - centre).norm();
                    assert!(off < 1e-9 && off <= contact.point_bound, "{off:e}, bound {:e}", contact.point_bound);
                } else {
                    // Any point of the patch solves the cone program.
                    let off = contact.point - centre;
                    assert!(off.dot(&up).abs() < 1e-6 && off.dot(&across).abs() < half, "{off}");
                }
            }
        }
    }
}

#[test]
fn a_corner_on_a_side_keeps_its_digits() {
    for r in [1e-2, 1e-4, 1e-6] {
        let (half, k) = (0.5, 1e-6);
        let d = half - r;
        // √2·p + v = 1 with line depths p·r of the corner's two lines and v·r of the side's.
        let s = |lines: f64, depth: f64, distance: f64, shadow: f64| {
            (lines * (1.0 - k) * depth * depth + k * (distance / shadow).powi(2)).sqrt()
        };
        let a = Body::square(half, r, k).at([0.0, d + SQRT_2 * d + r], FRAC_PI_4);
        let b = Body::square(half, r, k);
        let (mut low, mut high) = (0.0, FRAC_1_SQRT_2);
        let both = |p: f64| {
            let v = 1.0 - SQRT_2 * p;
            (s(2.0, p, SQRT_2 * (d + r * p), a.shadow_radius), s(1.0, v, d + r * v, b.shadow_radius))
        };
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            let (of_a, of_b) = both(middle);
            if of_a < of_b { low = middle } else { high = middle }
        }
        for back_end in [BackEnd::Fast, BackEnd::ConeProgram] {
            let contact = solve(&a, &b, Formulation::Midway, back_end);
            let accuracy = if back_end == BackEnd::Fast { a.noise() } else { 1e-8 };
            assert!(
                (contact.s - both(low).0).abs() <= accuracy,
                "{back_end:?}, r = {r}: {} for {}",
                contact.s,
                both(low).0
            );
            assert!(contact.gap <= 10.0 * accuracy, "{back_end:?}, r = {r}: gap {}", contact.gap);
            assert!(contact.point.x.abs() < 1e-4 && (contact.normal + Vector3::y()).norm() < 1e-4, "{contact:?}");
        }
    }
}

#[test]
fn contact_length_matches_closed_forms() {
    let length = |a: &Body, b: &Body| {
        let contact = midway(a, b);
        let section = Section { branch_a: contact.branch_a, branch_b: contact.branch_b, normal: contact.normal };
        section.area(&a.particle(), &a.pose(), &b.particle(), &b.pose(), 1e-6).unwrap()
    };
    // Two unit circles at distance 1.
    let disc = Body { k: 1.0, lines: vec![], ..Body::square(1.0, 1.0, 1.0) };
    let disc = Body { shadow_radius: 1.0, ..disc };
    assert!((length(&disc, &disc.clone().at([0.6, 0.8], 2.0)) - 3f64.sqrt()).abs() < 1e-14);
    // Squares side on side, one shifted by `shift`: the core, and on each end what the cut leaves of r.
    let (half, r) = (0.5, 0.1);
    for (shift, angle) in [(0.0, 0.0), (0.25, 0.0), (-0.6, 1.0)] {
        let a = Body::square(half, r, 0.0).at([3.0, 4.0], angle);
        let (sin, cos) = f64::sin_cos(angle);
        let s: f64 = 0.5;
        let height = 2.0 * (half - r + s * r);
        let b = a.moved(Vector3::new(shift * cos - height * sin, shift * sin + height * cos, 0.0));
        let rim = r * (1.0 - s * s).sqrt();
        let expected = 2.0 * (half - r + rim) - f64::abs(shift);
        assert!((length(&a, &b) - expected).abs() < 1e-12, "{} for {expected}", length(&a, &b));
    }
    let section = Section { branch_a: Vector3::zeros(), branch_b: Vector3::zeros(), normal: Vector3::zeros() };
    let (particle, pose) = (disc.particle(), disc.pose());
    assert!(section.area(&particle, &pose, &particle, &pose, 1e-6).is_none());
    let nowhere = Section { branch_a: Vector3::repeat(f64::NAN), normal: Vector3::x(), ..section };
    assert!(nowhere.area(&particle, &pose, &particle, &pose, 1e-6).is_none());
}

#[test]
fn each_violation_is_its_own_error_and_names_the_value() {
    type E = ParticleError;
    let lines = Body::square(0.5, 0.05, 0.1).lines;
    let with = |change: &dyn Fn(&mut Vec<[f64; 3]>)| {
        let mut lines = lines.clone();
        change(&mut lines);
        Particle::in_plane(&lines, 0.05, 0.1, 0.9).unwrap_err()
    };
    let open = "the lines do not enclose an area";
    let cases: Vec<(E, &str)> = vec![
        (with(&|l| l[3][2] = f64::NAN), "line 3 is not finite: a=0.0, b=-1.0, d=NaN"),
        (with(&|l| l[2][1] = f64::INFINITY), "line 2 is not finite"),
        (with(&|l| l[1][..2].fill(0.0)), "line 1 has a normal of length zero"),
        (with(&|l| l[1][2] = -0.06), "line 1 (d=-0.06)"),
        (Particle::in_plane(&lines, 0.05, -0.1, 0.9).unwrap_err(), "k=-0.1"),
        (Particle::in_plane(&lines, 0.0, 0.1, 0.9).unwrap_err(), "r=0"),
        (Particle::in_plane(&lines, 0.05, 0.1, -2.0).unwrap_err(), "R=-2"),
        (Particle::in_plane(&lines[..3], 0.05, 0.0, 0.9).unwrap_err(), open),
        (Particle::in_plane(&[], 0.05, 0.0, 0.9).unwrap_err(), open),
        // A strip, bounded one way only.
        (Particle::in_plane(&[lines[0], lines[2]], 0.05, 0.0, 0.9).unwrap_err(), open),
        (Particle::in_plane(&vec![lines[0]; 65_537], 0.05, 0.1, 0.9).unwrap_err(), "65537 lines"),
        (Particle::in_plane(&[], 0.0, 1.0, 0.0).unwrap_err(), "R=0"),
    ];
    for (error, text) in &cases {
        let message = error.to_string();
        assert!(message.contains(text) && !message.contains("plane") && !message.contains("c="), "{message}: {text}");
    }
    // Three lines are enough, and the circle closes what lines leave open.
    assert!(Particle::in_plane(&[[0.8, 0.6, 0.3], [-0.8, 0.6, 0.3], [0.0, -1.0, 0.3]], 0.1, 0.0, 0.0).is_ok());
    assert!(Particle::in_plane(&lines[..1], 0.05, 0.1, 0.9).is_ok());
    let position = Pose::in_plane([0.0, f64::NAN], 0.0).unwrap_err();
    assert!(matches!(position, PoseError::Position(..)) && position.to_string().contains("(0.0, NaN, 0.0)"));
    let angle = Pose::in_plane([0.0; 2], f64::INFINITY).unwrap_err();
    assert!(matches!(angle, PoseError::Angle(_)) && angle.to_string().contains("angle inf"));
    let turns = Pose::in_plane([0.0; 2], -1.1e9).unwrap_err().to_string();
    assert!(
        turns.contains("-1100000000.0") && turns.contains("whole turns") && Pose::in_plane([0.0; 2], -1.07e9).is_ok()
    );
}

/// z stays 0: by every formulation, back end and state, and from quaternions, too.
#[test]
fn nothing_leaves_the_plane() {
    let square = |k: f64| Body::square(0.5, 0.05, k).particle();
    let triangle = Particle::in_plane(&[[0.8, 0.6, 0.3], [-0.8, 0.6, 0.3], [0.0, -1.0, 0.3]], 1e-6, 0.0, 0.0).unwrap();
    let particles = [square(0.0), square(0.3), square(1.0), triangle];
    let mut overlapping = 0;
    for (a, b) in particles.iter().flat_map(|a| particles.iter().map(move |b| (a, b))) {
        for i in 0..40 {
            let (angle, distance) = (f64::from(i), 1.2 - f64::from(i % 8) / 8.0);
            let [x, y] = [1.0 + distance * angle.cos(), -2.0 + distance * angle.sin()];
            let at_a = Pose::in_plane([1.0, -2.0], 0.7 * angle).unwrap();
            let by_angle = Pose::in_plane([x, y], angle).unwrap();
            let turned = Pose::new([x, y, 0.0], [(0.5 * angle).cos(), 0.0, 0.0, (0.5 * angle).sin()]).unwrap();
            for (at_b, formulation, back_end) in [
                (by_angle, Formulation::Midway, BackEnd::Fast),
                (by_angle, Formulation::Closest, BackEnd::Fast),
                (turned, Formulation::Midway, BackEnd::Fast),
                (by_angle, Formulation::Midway, BackEnd::ConeProgram),
                (by_angle, Formulation::Closest, BackEnd::ConeProgram),
            ] {
                let settings = Settings::default().with_formulation(formulation).with_back_end(back_end);
                let settings = settings.with_solve_separated(true);
                let mut state = PairState::default();
                let contact = detect(a, &at_a, b, &at_b, &settings, Some(&mut state)).unwrap();
                let mut vectors = vec![contact.normal, contact.point, contact.branch_a, contact.branch_b];
                if contact.kind == Kind::Overlapping {
                    overlapping += 1;
                    vectors.extend([contact.point_on_a, contact.point_on_b]);
                }
                for on in [Role::A, Role::B] {
                    let found = closest_point(a, &at_a, b, &at_b, on, &settings).unwrap();
                    vectors.extend(found.into_iter().flat_map(|found| [found.point, found.branch_a, found.branch_b]));
                }
                assert!(vectors.iter().all(|v| v.z == 0.0), "{contact:?}");
                // Number 3 of a solution is z.
                assert_eq!(state.into_raw()[3], 0.0);
            }
        }
    }
    assert!(overlapping > 500, "{overlapping}");
}
