//! Patches that are known by a formula.

use crate::patch;
use kit::patch::bodies::{Pair, contact, cuboid};
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use potential_particles::{Particle, Pose};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

fn pair(a: Particle, turn_a: Matrix3<f64>, b: Particle, position: [f64; 3], turn_b: Matrix3<f64>) -> Pair {
    let pose_a = Pose::from_rotation([0.0; 3], &turn_a).unwrap();
    let pose_b = Pose::from_rotation(position, &turn_b).unwrap();
    let contact = contact(&a, &pose_a, &b, &pose_b);
    Pair { a, b, pose_a, pose_b, contact }
}

fn turn(axis: [f64; 3], angle: f64) -> Matrix3<f64> {
    Rotation3::new(angle * Vector3::from(axis)).into_inner()
}

fn check(what: &str, found: f64, expected: f64, tolerance: f64) {
    assert!((found / expected - 1.0).abs() < tolerance, "{what}: {found:e} for {expected:e}");
}

/// A block of half sides 0.3, 0.2, 0.3 on a large one, its lower face `overlap` deep and tilted by an angle about y.
fn tilted(r: f64, overlap: f64, angle: f64) -> Pair {
    let rotation = turn([0.0, 1.0, 0.0], angle);
    // The middle of its lower face comes to rest under the origin.
    let position = Vector3::new(0.0, 0.0, 0.5 - overlap) + rotation * Vector3::new(0.0, 0.0, 0.3);
    pair(
        cuboid([1.0, 1.0, 0.5], r, 0.0),
        Matrix3::identity(),
        cuboid([0.3, 0.2, 0.3], r, 0.0),
        position.into(),
        rotation,
    )
}

#[test]
fn a_face_is_a_bed_of_springs() {
    let r: f64 = 1e-4;
    let (length, width) = (0.6 - 2.0 * r, 0.4 - 2.0 * r);
    let (area, second) = (length * width, width * length.powi(3) / 12.0);
    for overlap in [1e-3 * r, 1e-2 * r] {
        let level = patch(&tilted(r, overlap, 0.0), 1e-6, true);
        // What the rounding adds around the flat part: a strip of √(2 r · overlap/2).
        let strip = 2.0 * (length + width) * (2.0 * r * overlap).sqrt() / area;
        check("force", level.force.z, area * overlap, strip);
        check("area", level.area, area, strip);
        check("energy", level.energy, 0.5 * area * overlap * overlap, strip);
        check("pressure", level.largest_depth, overlap, 1e-9);
        for part in [0.1, 0.9] {
            let angle = part * overlap / (0.5 * length);
            let pair = tilted(r, overlap, angle);
            let found = patch(&pair, 1e-6, false);
            // About the middle of the face.
            let torque = found.torque.y + (pair.contact.point - Vector3::new(0.0, 0.0, 0.5)).cross(&found.force).y;
            check("force, tilted", found.force.z, area * overlap, 2.0 * strip);
            check("moment", torque.abs(), second * angle, 10.0 * strip);
            let arm = second * angle / (area * overlap);
            check("centre of pressure", found.pressure_centre.x.abs(), arm, 10.0 * strip);
        }
    }
}

#[test]
fn a_face_opens_beyond_the_middle_third() {
    let r: f64 = 1e-4;
    let (length, width) = (0.6 - 2.0 * r, 0.4 - 2.0 * r);
    let overlap = 1e-3 * r;
    for times in [2.0, 5.0] {
        let angle = times * overlap / (0.5 * length);
        let found = patch(&tilted(r, overlap, angle), 1e-6, false);
        let contact_length = 0.5 * length + overlap / angle;
        let deepest = angle * contact_length;
        check("force", found.force.z, 0.5 * deepest * contact_length * width, 2e-3);
        let eccentricity = found.pressure_centre.x.abs();
        check("contact length", 3.0 * (0.5 * length - eccentricity), contact_length, 2e-3);
        check("area", found.area, contact_length * width, 2e-3);
        check("largest pressure", 2.0 * found.force.z / (found.area * found.largest_depth), 1.0, 2e-3);
    }
}

#[test]
fn spheres_press_as_paraboloids() {
    for (radius_a, radius_b, turned) in [(1.0, 0.5, 0.0), (0.2, 0.2, 0.3), (1.0, 30.0, 1.0)] {
        let overlap = 1e-5 * f64::min(radius_a, radius_b);
        let (a, b) = (Particle::sphere(radius_a).unwrap(), Particle::sphere(radius_b).unwrap());
        let direction = turn([0.3, 0.4, 0.1], turned) * Vector3::x();
        let position = (radius_a + radius_b - overlap) * direction;
        let found = patch(&pair(a, Matrix3::identity(), b, position.into(), Matrix3::identity()), 1e-6, true);
        let reduced = radius_a * radius_b / (radius_a + radius_b);
        check("force", found.force.dot(&direction), PI * reduced * overlap.powi(2), 1e-4);
        check("energy", found.energy, PI * reduced * overlap.powi(3) / 3.0, 1e-4);
        let rim = (2.0 * reduced * overlap).sqrt();
        check("area", found.area, PI * rim * rim, 1e-4);
        check("polar moment", found.polar_moment, 0.5 * PI * rim.powi(4), 1e-4);
        check("second moment", found.second_moment.trace(), 0.5 * PI * rim.powi(4), 1e-4);
        // ∫ (1 − ρ²) ρ² dρ / ∫ (1 − ρ²) ρ dρ = 8/15.
        check("lever", found.twist_lever, 8.0 / 15.0 * rim, 1e-4);
        assert!(found.couple.abs() < 1e-9 * found.force.norm() * rim, "{:e}", found.couple);
    }
}

/// In the plane, per unit of depth: parabolas.
#[test]
fn discs_press_as_parabolas() {
    let (radius_a, radius_b, overlap) = (1.0, 0.5, 1e-6);
    let [a, b] = [radius_a, radius_b].map(|radius| Particle::in_plane(&[], 0.0, 1.0, radius).unwrap());
    let position = [radius_a + radius_b - overlap, 0.0, 0.0];
    let found = patch(&pair(a, turn([0.0, 0.0, 1.0], 0.4), b, position, Matrix3::identity()), 1e-9, true);
    let half = (2.0 * overlap / (1.0 / radius_a + 1.0 / radius_b)).sqrt();
    let force = 4.0 / 3.0 * overlap * half;
    check("force", found.force.x, force, 1e-5);
    check("length", found.area, 2.0 * half, 1e-5);
    check("energy", found.energy, force * overlap * 0.4, 1e-5);
    check("second moment", found.second_moment.trace(), 2.0 * half.powi(3) / 3.0, 1e-5);
}

#[test]
fn a_square_resists_twist() {
    let r = 1e-6;
    let (a, b) = (cuboid([1.0, 1.0, 0.5], r, 0.0), cuboid([0.3; 3], r, 0.0));
    let rotation = turn([0.0, 0.0, 1.0], 0.4);
    let found = patch(&pair(a, Matrix3::identity(), b, [0.2, -0.1, 0.8 - 1e-3 * r], rotation), 1e-6, false);
    let side = 0.6;
    let lever = (2.0_f64.sqrt() + (1.0 + 2.0_f64.sqrt()).ln()) / 6.0 * side;
    check("lever", found.twist_lever, lever, 1e-3);
    check("polar moment", found.polar_moment, side.powi(4) / 6.0, 1e-4);
}

#[test]
fn crossed_edges_turn_each_other() {
    let r = 0.05;
    for crossing in [0.5, 1.0, FRAC_PI_2] {
        for share in [1e-4, 1e-3] {
            let overlap = share * r;
            let edge_up = turn([1.0, 0.0, 0.0], FRAC_PI_4);
            let edge_down = turn([0.0, 0.0, 1.0], crossing) * edge_up;
            let half = 0.5 - r;
            let height = 2.0 * (half * 2.0_f64.sqrt() + r) - overlap;
            let (a, b) = (cuboid([0.5; 3], r, 0.0), cuboid([0.5; 3], r, 0.0));
            let found = patch(&pair(a, edge_up, b, [0.0, 0.0, height], edge_down), 1e-7, false);
            let expected = found.force.norm() * overlap / 3.0 / crossing.tan();
            let off = (found.couple.abs() - expected.abs()).abs();
            assert!(
                off < 3.0 * share * found.force.norm() * overlap,
                "{crossing} {share}: {} {expected}",
                found.couple
            );
            // Cylinders of radius r: an elliptic paraboloid.
            check("force", found.force.z, 2.0 * PI * r / crossing.sin() * overlap.powi(2) * 0.5, 3.0 * share);
        }
    }
}

#[test]
fn a_corner_on_a_face_has_its_formula() {
    let (r_a, r_b) = (0.08, 0.05);
    // The corner of A points up.
    let axis = Vector3::new(1.0, 1.0, 1.0).normalize();
    let up = UnitQuaternion::rotation_between(&axis, &Vector3::z()).unwrap().to_rotation_matrix().into_inner();
    for share in [0.01, 0.1] {
        let overlap = share * (r_a + r_b);
        let corner = (0.5 - r_a) * 3.0_f64.sqrt();
        let (a, b) = (cuboid([0.5; 3], r_a, 0.0), cuboid([1.0, 1.0, 0.5], r_b, 0.0));
        let height = corner + r_a + 0.5 - overlap;
        let found = patch(&pair(a, up, b, [0.0, 0.0, height], Matrix3::identity()), 1e-7, false);
        // From A's core corner to B's core plane.
        let between = r_a + r_b - overlap;
        let first = between / (r_a + r_b);
        // ∫ t² r_A² − (H − t r_B)² dt, while the arc of the sphere lies within the three planes.
        let antiderivative = |t: f64| {
            let rest: f64 = between - t * r_b;
            t.powi(3) * r_a * r_a / 3.0 + rest.powi(3) / (3.0 * r_b)
        };
        let exact = (r_a + r_b) * PI * (antiderivative(1.0) - antiderivative(first));
        check("force", found.force.z, exact, 1e-6);
    }
}
