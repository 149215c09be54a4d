//! What fuzzing found, by shapes of its own.

use nalgebra::Vector3;
use potential_particles::{Kind, Particle, Plane, Pose, Settings, detect};

/// A plane a billion away changes nothing about two cubes but the accuracy of their surface points, which is taken
/// relative to the furthest plane.
#[test]
fn a_plane_that_is_never_reached_changes_no_answer() {
    let cube = |far: Option<Plane>, r: f64, k: f64| {
        let faces = (0..3).flat_map(|axis| [1.0, -1.0].map(|sign| Vector3::ith(axis, sign)));
        let mut planes: Vec<Plane> = faces.map(|normal| Plane { normal, offset: 0.5 - r }).collect();
        planes.extend(far);
        Particle::new(&planes, r, k, 0.9).expect("a cube")
    };
    let (at_a, at_b) = (Pose::at([0.0; 3]).expect("the origin"), Pose::new([0.2, 0.1, 0.93], [1.0, 0.1, 0.2, 0.3]));
    let at_b = at_b.expect("a pose");
    let answer = |cube: &Particle| detect(cube, &at_a, cube, &at_b, &Settings::default(), None).expect("an answer");
    let far_away = Plane { normal: Vector3::new(0.6, 0.0, 0.8), offset: 1e9 };
    let (without, with) = (answer(&cube(None, 0.05, 0.1)), answer(&cube(Some(far_away), 0.05, 0.1)));
    assert!((without.overlap - with.overlap).abs() < 1e-14, "{} and {}", without.overlap, with.overlap);
    assert!(with.gap < 1e-11, "the gap is {:e}, without the plane {:e}", with.gap, without.gap);
    // Nor does one that would hardly push: edge across edge, the forces of both hold the point.
    let at_a = Pose::new([0.0; 3], [1.0, 0.4, 0.0, 0.0]).expect("a pose");
    let at_b = Pose::new([0.02, 0.03, 1.35], [1.0, 0.0, 0.4, 0.0]).expect("a pose");
    let answer = |cube: &Particle| detect(cube, &at_a, cube, &at_b, &Settings::default(), None).expect("an answer");
    let short = Plane { normal: Vector3::new(1e-16, 0.0, 0.0), offset: 1.0 };
    for (r, k) in [(0.05, 0.1), (1e-3, 1e-3), (1e-3, 1e-6)] {
        let (cube_without, cube_with) = (cube(None, r, k), cube(Some(short), r, k));
        let deep = answer(&cube_without);
        let moved = at_b.position() + (deep.overlap - 1e-3 * r) * deep.normal;
        let touching = Pose::new(moved.into(), at_b.orientation()).expect("a pose");
        let answer = |cube| detect(cube, &at_a, cube, &touching, &Settings::default(), None).expect("an answer");
        let (without, with) = (answer(&cube_without), answer(&cube_with));
        assert_eq!((with.kind, with.iterations), (Kind::Overlapping, without.iterations), "r = {r}, k = {k}");
        let ratio = with.point_bound / without.point_bound;
        assert!(ratio < 2.0, "r = {r}, k = {k}: a bound {ratio} times as long");
    }
}

/// A plane with a normal of length 5 and a reach of 1e54 along the axis of the sphere's box: corners are lost to
/// rounding, and the box leaves the centre of the particle out.
#[test]
fn a_bounding_box_holds_the_centre_of_a_particle_that_hardly_ends() {
    let planes = [
        [1.0, 6.0, 0.0, 0.75],
        [-1.0, 0.0, 0.0, 0.75],
        [0.0, 1.0, 0.0, 0.75],
        [0.0, -1.0, 0.0, 0.0],
        [0.0, 0.0029296875, 0.0, 0.0],
        [-4.74609375, -1.4560546875, 0.0, 0.0],
    ]
    .map(Plane::from);
    let particle = Particle::new(&planes, 3.026123046875, 5.489088441883201e-56, 0.69).expect("a particle");
    let (low, high) = particle.bounding_box(&Pose::at([0.0; 3]).expect("the origin"));
    let centre = Vector3::<f64>::zeros();
    assert!((0..3).all(|i| low[i] < centre[i] && high[i] > centre[i]), "box from {low} to {high}");
}
