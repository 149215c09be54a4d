//! What the regularisation of flat faces leaves in the answer is in its bounds.

use kit::patch::bodies;
use nalgebra::Vector3;
use potential_particles::{Contact, Flags, Formulation, Kind, Particle, Pose, Settings, detect};

fn cuboid(half: [f64; 3], r: f64) -> Particle {
    bodies::cuboid(half, r, 0.0)
}

fn at(x: f64, y: f64, z: f64) -> Pose {
    Pose::at([x, y, z]).unwrap()
}

const STRENGTHS: [f64; 6] = [1e-13, 1e-10, 1e-7, 1e-4, 1e-2, 0.1];

/// A ball whose centre lies in the core of a cube of k = 0: without the regularisation s = 0 at the centre of the ball,
/// and nowhere else.
#[test]
fn the_point_of_a_ball_in_a_core_is_its_centre_but_for_its_bound() {
    for strength in STRENGTHS {
        let settings = Settings::default().with_flat_regularisation(strength);
        for (radius, centre) in
            [(0.5, [0.3, 0.2, 0.1]), (0.5, [0.4, 0.0, 0.0]), (0.1, [0.2, 0.2, 0.3]), (3.0, [0.1, 0.0, 0.3])]
        {
            let (ball, cube) = (Particle::sphere(radius).unwrap(), cuboid([0.5; 3], 0.05));
            let [x, y, z] = centre;
            for swapped in [false, true] {
                let (a, b) = ((&ball, &at(x, y, z)), (&cube, &at(0.0, 0.0, 0.0)));
                let (a, b) = if swapped { (b, a) } else { (a, b) };
                let contact = detect(a.0, a.1, b.0, b.1, &settings, None).unwrap();
                let off = (contact.point - Vector3::from(centre)).norm();
                assert!(
                    off <= contact.point_bound * (1.0 + 1e-9),
                    "{strength:e}: {off:e} of {:e}",
                    contact.point_bound
                );
                assert!(
                    contact.point_bound <= 20.0 * off + 1e-12,
                    "{strength:e}: {off:e} of {:e}",
                    contact.point_bound
                );
            }
        }
    }
}

/// A ball on a face and over an edge of a cube: the regularised point is off the one that a solution with next to none
/// gives by no more than its bound.
#[test]
fn what_a_stronger_regularisation_moves_is_in_the_bound() {
    let least = |a: &Particle, at_a: &Pose, b: &Particle, at_b: &Pose| {
        let settings = Settings::default().with_gap_tolerance(1e-15).with_flat_regularisation(0.0);
        detect(a, at_a, b, at_b, &settings, None).unwrap()
    };
    let cube = cuboid([0.5; 3], 0.05);
    let turned = |x: f64, y: f64, z: f64, q: [f64; 4]| Pose::new([x, y, z], q).unwrap();
    let here = turned(0.0, 0.0, 0.0, [1.0, 0.0, 0.0, 0.0]);
    let mut compared = 0;
    for strength in STRENGTHS {
        let settings = Settings::default().with_flat_regularisation(strength);
        for q in [[1.0, 0.0, 0.0, 0.0], [0.9, 0.3, -0.2, 0.1], [1.0, 0.4, 0.0, 0.0], [0.7, 0.1, 0.5, 0.3]] {
            for (x, y, z) in [(0.1, 0.2, 0.95), (0.4, 0.1, 0.9), (0.55, 0.0, 0.8), (0.6, 0.5, 0.6)] {
                let there = turned(x, y, z, q);
                for other in [Particle::sphere(0.5).unwrap(), cuboid([0.4, 0.5, 0.6], 0.02)] {
                    let is_ball = other.sphericity() == 1.0;
                    if !is_ball && q[0] == 1.0 {
                        // Faces or edges that lie along each other: an optimum may lie anywhere on them.
                        continue;
                    }
                    let found = detect(&other, &there, &cube, &here, &settings, None).unwrap();
                    let right = least(&other, &there, &cube, &here);
                    if found.kind != Kind::Overlapping || right.kind != Kind::Overlapping || right.point_bound > 1e-9 {
                        continue;
                    }
                    let off = (found.point - right.point).norm();
                    compared += 1;
                    assert!(
                        off <= found.point_bound + right.point_bound + 1e-12,
                        "{strength:e}, {q:?} at {x}, {y}, {z}, ball {is_ball}: {off:e} of {:e}",
                        found.point_bound
                    );
                }
            }
        }
    }
    assert!(compared > 60, "{compared}");
}

/// The closest points of a plate and a cube beside its middle: by definition each minimises the scale of the other
/// particle, which all points of the common face do; what the regularisation chooses lies apart along the face, and is
/// flagged.
#[test]
fn closest_points_that_are_free_along_a_face_are_flagged() {
    let (plate, cube) = (cuboid([5.0, 5.0, 0.5], 0.01), cuboid([0.5; 3], 0.01));
    let contact = |formulation, aside: f64, q: [f64; 4]| -> Contact {
        let settings = Settings::default().with_formulation(formulation);
        let above = Pose::new([aside, 0.0, 1.0 - 1e-3], q).unwrap();
        detect(&plate, &at(0.0, 0.0, 0.0), &cube, &above, &settings, None).unwrap()
    };
    let flat = [1.0, 0.0, 0.0, 0.0];
    let free = contact(Formulation::Closest, 3.0, flat);
    assert!(free.flags.contains(Flags::FREE) && free.overlap > 5e-3, "{free:?}");
    let normal = (free.point_on_a - free.point_on_b).dot(&free.normal);
    assert!((normal - 1e-3).abs() < 1e-9, "{normal}");
    let midway = contact(Formulation::Midway, 3.0, flat);
    assert!(!midway.flags.contains(Flags::FREE) && (midway.overlap - 1e-3).abs() < 1e-9);
    // Above the middle they lie on one line; of a corner on the face they are held.
    let middle = contact(Formulation::Closest, 0.0, flat);
    assert!((middle.overlap - 1e-3).abs() < 1e-9, "{middle:?}");
    let tilted = Pose::new([3.0, 0.0, 1.3], [1.0, 0.2, 0.1, 0.0]).unwrap();
    let settings = Settings::default().with_formulation(Formulation::Closest);
    let corner = detect(&plate, &at(0.0, 0.0, 0.0), &cube, &tilted, &settings, None).unwrap();
    assert!(!corner.flags.contains(Flags::FREE), "{corner:?}");
}

/// Faces that bulge a little free them nearly as much: where the points are farther apart along the surface than across
/// it, that is flagged, too; with one between others it is not.
#[test]
fn closest_points_that_are_nearly_free_are_flagged() {
    let rounded = |half: [f64; 3]| bodies::cuboid(half, 0.01, 1e-3);
    let (plate, cube) = (rounded([5.0, 5.0, 0.5]), rounded([0.5; 3]));
    for (aside, is_free) in [(0.0, false), (3.0, true), (3.7, true), (4.4, true), (4.8, true)] {
        let [closest, midway] = [Formulation::Closest, Formulation::Midway].map(|formulation| {
            let settings = Settings::default().with_formulation(formulation);
            detect(&plate, &at(0.0, 0.0, 0.0), &cube, &at(aside, 0.0, 1.0 - 1e-3), &settings, None).unwrap()
        });
        assert_eq!(closest.flags.contains(Flags::FREE), is_free, "{aside}: {closest:?}");
        assert!(!is_free || closest.overlap > 2.0 * midway.overlap, "{aside}: {}, {}", closest.overlap, midway.overlap);
    }
}

/// With cores that meet s is 0, and no gap is small beside it: what was asked for is not reached, which is flagged. Of
/// a pair beside it that is reached.
#[test]
fn a_gap_that_is_not_reached_is_flagged() {
    let settings = Settings::default().with_gap_tolerance(1e-14);
    for r in [1e-3, 2.3e-4] {
        let (a, b) = (cuboid([1.0, 0.8, 0.6], r), cuboid([0.7, 0.5, 0.9], r));
        for turn in 0..40 {
            let q = [0.9, 0.3 * f64::from(turn).sin(), 0.2 * f64::from(turn).cos(), -0.1];
            let length = q.iter().map(|c: &f64| c * c).sum::<f64>().sqrt();
            for x in [0.9, 1.3] {
                let pose = Pose::new([x, 0.1, 0.2], q.map(|c| c / length)).unwrap();
                let contact = detect(&a, &at(0.0, 0.0, 0.0), &b, &pose, &settings, None).unwrap();
                if contact.kind == Kind::Overlapping {
                    let [low, high] = [(contact.s - contact.gap).max(0.0), contact.s + contact.gap];
                    let is_reached = high * high - low * low <= 1.001e-14 * high * high;
                    let is_flagged = contact.flags.contains(Flags::ROUNDING_LIMITED);
                    assert!(is_reached || is_flagged, "r = {r}, turn {turn}: {contact:?}");
                }
            }
        }
    }
}

/// Deeper in each other than the potential is made for: r of flat faces, R of spheres.
#[test]
fn overlaps_above_the_rounding_radius_are_flagged() {
    let (cube, ball) = (cuboid([0.5; 3], 0.1), Particle::sphere(0.3).unwrap());
    for (overlap, is_deep) in [(1e-4, false), (0.09, false), (0.12, true), (0.36, true)] {
        let contact =
            detect(&cube, &at(0.0, 0.0, 0.0), &cube, &at(0.1, 0.0, 1.0 - overlap), &Settings::default(), None);
        let contact = contact.unwrap();
        assert_eq!(contact.flags.contains(Flags::DEEP), is_deep, "{overlap}: {contact:?}");
    }
    for (away, is_deep) in [(0.59, false), (0.31, false), (0.29, true)] {
        let contact =
            detect(&ball, &at(0.0, 0.0, 0.0), &ball, &at(away, 0.0, 0.0), &Settings::default(), None).unwrap();
        assert_eq!(contact.flags.contains(Flags::DEEP), is_deep, "{away}: {contact:?}");
    }
}

/// Of a pair that is solved to the end in spite of being apart, the distance is a lower bound that the faces know.
#[test]
fn solved_to_the_end_a_pair_apart_has_its_distance() {
    let cube = cuboid([0.5; 3], 0.05);
    for formulation in [Formulation::Midway, Formulation::Closest] {
        let settings = Settings::default().with_solve_separated(true).with_formulation(formulation);
        for gap in [1e-6, 1e-3, 0.1, 2.0] {
            let contact = detect(&cube, &at(0.0, 0.0, 0.0), &cube, &at(0.2, 0.1, 1.0 + gap), &settings, None).unwrap();
            assert_eq!(contact.kind, Kind::Separated);
            assert!(contact.distance <= gap * (1.0 + 1e-9) && contact.distance >= 0.7 * gap, "{gap}: {contact:?}");
        }
    }
}
