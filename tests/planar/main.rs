//! Particles of the plane, against closed forms and against searches that know nothing of the solver.

mod batch;
mod body;
mod closest;
mod polygon;
mod properties;

use body::{Body, midway, solve};
use nalgebra::Vector2;
use potential_particles::planar::{Line, Particle, Pose, PoseError, Section, detect};
use potential_particles::{BackEnd, Formulation, Kind, ParticleError, Settings};
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, FRAC_PI_4, SQRT_2};

#[test]
fn circles_match_their_closed_form() {
    let (ra, rb) = (2.0, 0.5);
    let (a, b) = (Particle::circle(ra).unwrap(), Particle::circle(rb).unwrap());
    let n = Vector2::new(-0.6, 0.8);
    for back_end in [BackEnd::Fast, BackEnd::ConeProgram] {
        for distance in [2.2, 2.5 - 1e-6, 2.5 + 1e-6, 3.0] {
            let at_a = Pose::new([1.0, 2.0], -0.7).unwrap();
            let centre: Vector2<f64> = at_a.position() + distance * n;
            let at_b = Pose::new(centre.into(), 12.0).unwrap();
            let settings = Settings::default().with_back_end(back_end).with_solve_separated(true);
            let contact = detect(&a, &at_a, &b, &at_b, &settings, None).unwrap();
            let accuracy = if back_end == BackEnd::Fast { 1e-14 } else { 1e-7 };
            // Both scaled by s the circles touch: s (ra + rb) = distance.
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
            let contact = detect(&a, &at_a, &b, &at_b, &settings, None).unwrap();
            assert!((contact.s - (distance - rb) / ra).abs() < accuracy);
            if distance < ra + rb {
                assert!((contact.s_b - (distance - ra) / rb).abs() < 10.0 * accuracy);
                assert!((contact.point - at_a.position() - 0.5 * (ra + distance - rb) * n).norm() < 10.0 * accuracy);
            }
        }
    }
}

#[test]
fn stacked_squares_touch_at_the_centre_of_the_patch() {
    for (half, r, k) in [(0.5, 0.1, 0.0), (0.5, 1e-6, 0.0), (0.5, 1e-3, 0.2), (2.0, 1e-6, 1e-6)] {
        for (angle, shift) in [(0.0, 0.0), (0.0, 0.3 * half), (0.4, 0.0), (0.4, -0.7 * half)] {
            let height = 2.0 * half - 0.5 * r;
            let (across, up) =
                (Vector2::new(f64::cos(angle), f64::sin(angle)), Vector2::new(-f64::sin(angle), f64::cos(angle)));
            let a = Body::square(half, r, k).at([0.3, -0.2], angle);
            let b = Body::square(half, r, k).at(a.position, angle).moved(shift * across + height * up);
            let centre = Vector2::from(a.position) + 0.5 * (shift * across + height * up);
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
            assert!(contact.point.x.abs() < 1e-4 && (contact.normal + Vector2::y()).norm() < 1e-4, "{contact:?}");
        }
    }
}

#[test]
fn contact_length_matches_closed_forms() {
    let length = |a: &Body, b: &Body| {
        let contact = midway(a, b);
        let section = Section { branch_a: contact.branch_a, branch_b: contact.branch_b, normal: contact.normal };
        section.length(&a.particle(), &a.pose(), &b.particle(), &b.pose()).unwrap()
    };
    // Two unit circles at distance 1.
    let circle = Body { k: 1.0, lines: vec![], ..Body::square(1.0, 1.0, 1.0) };
    let circle = Body { shadow_radius: 1.0, ..circle };
    assert!((length(&circle, &circle.clone().at([0.6, 0.8], 2.0)) - 3f64.sqrt()).abs() < 1e-14);
    // Squares side on side, one shifted by `shift`: the core, and on each end what the cut leaves of r.
    let (half, r) = (0.5, 0.1);
    for (shift, angle) in [(0.0, 0.0), (0.25, 0.0), (-0.6, 1.0)] {
        let a = Body::square(half, r, 0.0).at([3.0, 4.0], angle);
        let (sin, cos) = f64::sin_cos(angle);
        let s: f64 = 0.5;
        let height = 2.0 * (half - r + s * r);
        let b = a.moved(Vector2::new(shift * cos - height * sin, shift * sin + height * cos));
        let rim = r * (1.0 - s * s).sqrt();
        let expected = 2.0 * (half - r + rim) - f64::abs(shift);
        assert!((length(&a, &b) - expected).abs() < 1e-12, "{} for {expected}", length(&a, &b));
    }
    let section = Section { branch_a: Vector2::zeros(), branch_b: Vector2::zeros(), normal: Vector2::zeros() };
    let (particle, pose) = (circle.particle(), circle.pose());
    assert!(section.length(&particle, &pose, &particle, &pose).is_none());
    let nowhere = Section { branch_a: Vector2::repeat(f64::NAN), normal: Vector2::x(), ..section };
    assert!(nowhere.length(&particle, &pose, &particle, &pose).is_none());
}

#[test]
fn each_violation_is_its_own_error_and_names_the_value() {
    type E = ParticleError;
    let lines: Vec<Line> = Body::square(0.5, 0.05, 0.1).lines.into_iter().map(Line::from).collect();
    let with = |change: &dyn Fn(&mut Vec<Line>)| {
        let mut lines = lines.clone();
        change(&mut lines);
        Particle::new(&lines, 0.05, 0.1, 0.9).unwrap_err()
    };
    let open = "the lines do not enclose an area";
    let cases: Vec<(E, &str)> = vec![
        (with(&|l| l[3].offset = f64::NAN), "line 3 is not finite: a=0.0, b=-1.0, d=NaN"),
        (with(&|l| l[2].normal.y = f64::INFINITY), "line 2 is not finite"),
        (with(&|l| l[1].normal = Vector2::zeros()), "line 1 has a normal of length zero"),
        (with(&|l| l[1].offset = -0.06), "line 1 (d=-0.06)"),
        (Particle::new(&lines, 0.05, -0.1, 0.9).unwrap_err(), "k=-0.1"),
        (Particle::new(&lines, 0.0, 0.1, 0.9).unwrap_err(), "r=0"),
        (Particle::new(&lines, 0.05, 0.1, -2.0).unwrap_err(), "R=-2"),
        (Particle::new(&lines[..3], 0.05, 0.0, 0.9).unwrap_err(), open),
        (Particle::new(&[], 0.05, 0.0, 0.9).unwrap_err(), open),
        // A strip, bounded one way only.
        (Particle::new(&[lines[0], lines[2]], 0.05, 0.0, 0.9).unwrap_err(), open),
        (Particle::new(&vec![lines[0]; 65_537], 0.05, 0.1, 0.9).unwrap_err(), "65537 lines"),
        (Particle::circle(0.0).unwrap_err(), "R=0"),
    ];
    for (error, text) in &cases {
        let message = error.to_string();
        assert!(message.contains(text) && !message.contains("plane") && !message.contains("c="), "{message}: {text}");
    }
    // Three lines are enough, and the circle closes what lines leave open.
    assert!(
        Particle::new(&[[0.8, 0.6, 0.3], [-0.8, 0.6, 0.3], [0.0, -1.0, 0.3]].map(Line::from), 0.1, 0.0, 0.0).is_ok()
    );
    assert!(Particle::new(&lines[..1], 0.05, 0.1, 0.9).is_ok());
    let position = Pose::new([0.0, f64::NAN], 0.0).unwrap_err();
    assert!(matches!(position, PoseError::Position(..)) && position.to_string().contains("(0.0, NaN)"));
    let angle = Pose::new([0.0; 2], f64::INFINITY).unwrap_err();
    assert!(matches!(angle, PoseError::Angle(_)) && angle.to_string().contains("angle inf"));
    let turns = Pose::new([0.0; 2], -1.1e9).unwrap_err().to_string();
    assert!(turns.contains("-1100000000.0") && turns.contains("whole turns") && Pose::new([0.0; 2], -1.07e9).is_ok());
    let bad = Settings::default().with_gap_tolerance(0.0);
    let (circle, home) = (Particle::circle(1.0).unwrap(), Pose::new([0.0; 2], 0.0).unwrap());
    assert!(detect(&circle, &home, &circle, &home, &bad, None).is_err());
}

#[test]
fn angles_turn_anticlockwise() {
    let pose = Pose::new([1.0, 2.0], FRAC_PI_2).unwrap();
    assert!((pose.rotate(&Vector2::x()) - Vector2::y()).norm() < 1e-15);
    assert!((pose.to_local(&Vector2::new(1.0, 5.0)) - Vector2::new(3.0, 0.0)).norm() < 1e-15);
}
