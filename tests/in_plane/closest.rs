//! One closest point alone, against closed forms.

use crate::body::Body;
use nalgebra::Vector3;
use potential_particles::{BackEnd, ClosestPoint, Role, Settings, closest_point};

/// By both back ends, with the accuracy of each.
fn found(a: &Body, b: &Body, on: Role) -> [(Option<ClosestPoint>, f64); 2] {
    [(BackEnd::Fast, 1e-12), (BackEnd::ConeProgram, 1e-5)].map(|(back_end, accuracy)| {
        let settings = Settings::default().with_back_end(back_end);
        let found = closest_point(&a.particle(), &a.pose(), &b.particle(), &b.pose(), on, &settings);
        (found.expect("an answer"), accuracy)
    })
}

fn circle(radius: f64) -> Body {
    Body { lines: vec![], k: 1.0, shadow_radius: radius, ..Body::square(radius, radius, 1.0) }
}

fn check(a: &Body, b: &Body, on: Role, s: f64, point: Vector3<f64>) {
    for (found, accuracy) in found(a, b, on) {
        let found = found.expect("a point");
        assert!((found.s - s).abs() <= found.gap + 4.0 * f64::EPSILON * s, "{} for {s}, {found:?}", found.s);
        assert!(found.gap < 10.0 * accuracy * s.max(1.0), "{found:?}");
        let off = (found.point - point).norm();
        assert!(off < accuracy && off <= found.point_bound + 1e-15, "{off:e} from {point}, {found:?}");
        assert!((found.branch_a - (point - a.centre())).norm() < accuracy, "{found:?}");
        assert!((found.branch_b - (point - b.centre())).norm() < accuracy, "{found:?}");
    }
}

/// A circle is its own shadow: s at a distance x from its centre is x over its radius.
#[test]
fn points_of_two_circles() {
    let (ra, rb, n) = (2.0, 0.5, Vector3::new(-0.6, 0.8, 0.0));
    let a = circle(ra).at([1.0, 2.0], -0.7);
    let centre = a.centre();
    for distance in [2.2, 2.4, 3.0] {
        let b = circle(rb).at(a.position, 12.0).moved(distance * n);
        check(&a, &b, Role::A, (distance - ra).abs() / rb, centre + ra * n);
        check(&a, &b, Role::B, (distance - rb) / ra, centre + (distance - rb) * n);
        check(&b, &a, Role::B, (distance - ra).abs() / rb, centre + ra * n);
    }
}

/// k = 0: s above the middle of a side is the depth behind its line over r.
#[test]
fn points_of_a_circle_above_a_side() {
    let (half, r, radius, angle) = (0.5, 0.1, 0.3, 0.4);
    let up = Vector3::new(-f64::sin(angle), f64::cos(angle), 0.0);
    let square = Body { shadow_radius: 0.0, ..Body::square(half, r, 0.0) }.at([3.0, -1.0], angle);
    let centre = square.centre();
    for height in [0.75, 0.79, 1.0] {
        let circle = circle(radius).at(square.position, 0.0).moved(height * up);
        check(&square, &circle, Role::A, (height - half) / radius, centre + half * up);
        check(&square, &circle, Role::B, (height - radius - (half - r)) / r, centre + (height - radius) * up);
    }
}

/// The centre of the small circle inside the large one: the large one has no such point, the small one has.
#[test]
fn a_centre_inside_leaves_no_point() {
    let (small, large) = (circle(0.5).at([0.0, 1.0], 0.3), circle(2.0));
    assert!(found(&small, &large, Role::B).iter().all(|(found, _)| found.is_none()));
    check(&small, &large, Role::A, 0.5 / 2.0, Vector3::new(0.0, 0.5, 0.0));
}
