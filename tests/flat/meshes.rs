//! Triangles that share an edge are parts of one surface.

use crate::{cube, solved, touch};
use nalgebra::Vector3;
use potential_particles::{
    Feature, FlatContact, Kind, Particle, Pose, Settings, Wall, contact_with_plane, contact_with_triangle,
};

/// The triangles of a floor of 4 × 4 squares of side 0.5 about the origin, each cut along a diagonal, and with vertices
/// in any order.
fn floor() -> Vec<[[f64; 3]; 3]> {
    let at = |i: i32, j: i32| [0.5 * f64::from(i), 0.5 * f64::from(j), 0.0];
    let squares = (-2..2).flat_map(|i| (-2..2).map(move |j| (i, j)));
    squares
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            if (i + j) % 2 == 0 { [[a, b, c], [d, a, c]] } else { [[b, d, a], [c, d, b]] }
        })
        .collect()
}

/// The triangle with the least s; of equal ones, the first.
fn owner(contacts: &[FlatContact]) -> (usize, &FlatContact) {
    let better = |(i, a): &(usize, &FlatContact), (j, b): &(usize, &FlatContact)| a.s.total_cmp(&b.s).then(i.cmp(j));
    contacts.iter().enumerate().min_by(better).expect("a mesh is not empty")
}

#[test]
fn of_a_flat_floor_the_owner_is_what_the_plane_is() {
    let wall = Wall::new([0.0; 3], [0.0, 0.0, 1.0]).unwrap();
    let particles = [cube(0.1, 0.0), cube(1e-6, 1e-6), cube(0.05, 0.2), Particle::sphere(0.55).unwrap()];
    for (number, particle) in particles.iter().enumerate() {
        // Under a flat face, s is the same but for the regularisation.
        let settings = if number == 0 { solved().with_flat_regularisation(1e-4) } else { solved() };
        for step in 0..41 {
            // Along a seam, across seams, and over vertices.
            let way = 0.02 * f64::from(step) - 0.4;
            for [x, y] in [[way, 0.0], [way, 0.1], [way, way], [way, -way]] {
                let turn = if number == 0 { [1.0, 0.0, 0.0, 0.0] } else { [1.0, 0.05, 0.1, 0.3] };
                let pose = Pose::new([x, y, 0.48], turn).unwrap();
                let plane = contact_with_plane(particle, &pose, &wall, &settings, None).unwrap();
                let contacts: Vec<_> = floor().into_iter().map(|t| touch(particle, &pose, t, &settings)).collect();
                let (_, owner) = owner(&contacts);
                assert!((owner.s - plane.s).abs() <= owner.gap + plane.gap, "{owner:?}, {plane:?}");
                // At a seam s is known to rounding, which is of second order in the way.
                assert!((owner.on_boundary - plane.on_boundary).norm() < 2e-6, "{owner:?}, {plane:?}");
                assert_eq!(owner.kind, plane.kind);
                if plane.kind == Kind::Overlapping {
                    assert!((owner.overlap - plane.overlap).abs() < 1e-9, "{owner:?}, {plane:?}");
                    // Where the point is clearly inside a triangle, that one owns the contact.
                    let distance_to_seam = |v: f64| (v / 0.5 - (v / 0.5).round()).abs();
                    let x = plane.on_boundary;
                    let seams = [x.x, x.y, x.x - x.y, x.x + x.y];
                    if seams.into_iter().all(|v| distance_to_seam(v) > 1e-6) {
                        assert_eq!(owner.feature, Feature::Interior);
                        let others = contacts.iter().filter(|other| other.s <= owner.s).count();
                        assert_eq!(others, 1, "{owner:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn on_a_ridge_both_sides_find_the_same_numbers() {
    // A roof whose ridge runs from b to c; its sides see the edge in both directions, as different edges.
    let (b, c) = ([0.1, -1.3, 0.2], [-0.2, 0.9, 0.15]);
    let (left, right) = ([-1.1, 0.3, -0.7], [1.4, -0.2, -0.9]);
    for particle in [cube(0.1, 0.05), cube(1e-7, 1e-7), Particle::sphere(0.5).unwrap()] {
        for step in 0..20 {
            let along = 0.05 * f64::from(step);
            let ridge = Vector3::from(b).lerp(&Vector3::from(c), along);
            let pose = Pose::new([ridge.x + 0.03, ridge.y, ridge.z + 0.4], [1.0, 0.2, -0.3, 0.1]).unwrap();
            let sides = [[b, c, left], [c, b, right], [left, b, c], [right, c, b]];
            let contacts = sides.map(|vertices| touch(&particle, &pose, vertices, &solved()));
            assert!(contacts.iter().all(|contact| contact.feature != Feature::Interior), "{contacts:?}");
            for other in &contacts[1..] {
                assert_eq!(other.s.to_bits(), contacts[0].s.to_bits());
                assert_eq!((other.normal, other.point), (contacts[0].normal, contacts[0].point));
                assert!(other.overlap == contacts[0].overlap && other.point_bound == contacts[0].point_bound);
            }
        }
    }
}

#[test]
fn an_answer_is_the_same_wherever_the_scene_lies() {
    // Multiples of 2⁻¹⁰, which a shift by 2²⁰ leaves without rounding.
    let particle = cube(0.05, 0.1);
    let vertices = [[-0.5, 0.25, 0.125], [1.5, -0.75, 0.25], [0.25, 1.0, -0.5]];
    let shift = Vector3::new(1048576.0, -524288.0, 2097152.0);
    for position in [[0.25, 0.125, 0.5], [0.5, 1.25, 0.25], [-0.75, 0.5, 0.375]] {
        let turn = [0.5, 0.3, -0.2, 0.9];
        let far = |p: [f64; 3]| (Vector3::from(p) + shift).into();
        let here = touch(&particle, &Pose::new(position, turn).unwrap(), vertices, &solved());
        let there = touch(&particle, &Pose::new(far(position), turn).unwrap(), vertices.map(far), &solved());
        assert_eq!((here.s, here.gap, here.branch, here.normal), (there.s, there.gap, there.branch, there.normal));
    }
}

#[test]
fn a_call_knows_nothing_of_the_one_before() {
    let (particle, settings) = (cube(0.02, 1e-4), Settings::default());
    let triangles: Vec<_> = floor().into_iter().map(crate::triangle).collect();
    let all = |pose: &Pose, backwards: bool| {
        let solve =
            |i: usize| contact_with_triangle(&particle, pose, &triangles[i], &settings, None).unwrap().s.to_bits();
        let count = triangles.len();
        let mut found: Vec<_> = (0..count).map(|i| solve(if backwards { count - 1 - i } else { i })).collect();
        if backwards {
            found.reverse();
        }
        found
    };
    let pose = Pose::new([0.12, 0.2, 0.6], [1.0, 0.3, 0.5, 0.2]).unwrap();
    assert_eq!(all(&pose, false), all(&pose, true));
}
