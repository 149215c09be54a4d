//! Two balls, spheres or circles of the plane, whose contact is known in closed form.

use nalgebra::Vector3;
use potential_particles::{BackEnd, Formulation, Kind, Particle, Pose, Settings, detect};

/// Asserts midway and closest of balls of radii 2 and 0.5 whose centres lie along n, at poses that differ by more than
/// that, `near` to touching and farther from it.
pub fn match_their_closed_form(
    ball: impl Fn(f64) -> Particle,
    n: Vector3<f64>,
    at_a: &Pose,
    at_b: impl Fn(Vector3<f64>) -> Pose,
    near: f64,
) {
    let (ra, rb) = (2.0, 0.5);
    let (a, b) = (ball(ra), ball(rb));
    for back_end in [BackEnd::Fast, BackEnd::ConeProgram] {
        for distance in [2.2, 2.5 - near, 2.5 + near, 3.0] {
            let at_b = at_b(at_a.position() + distance * n);
            let settings = Settings::default().with_back_end(back_end).with_solve_separated(true);
            let contact = detect(&a, at_a, &b, &at_b, &settings, None).unwrap();
            let accuracy = if back_end == BackEnd::Fast { 1e-14 } else { 1e-7 };
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
