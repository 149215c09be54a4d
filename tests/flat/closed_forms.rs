//! Spheres and cubes, of which everything is known.

use crate::{boundary_point, cube, solved, touch};
use nalgebra::Vector3;
use potential_particles::{Feature, Flags, Kind, Particle, Pose, Section, Settings, Wall, contact_with_plane};
use std::f64::consts::PI;

const VERTICES: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

/// Where the nearest point of the triangle is inside, on each edge and at each vertex.
const PLACES: [([f64; 3], Feature, [f64; 3]); 7] = [
    ([0.25, 0.25, 0.75], Feature::Interior, [0.25, 0.25, 0.0]),
    ([0.5, -0.5, 0.25], Feature::Edge0, [0.5, 0.0, 0.0]),
    ([1.0, 1.0, 0.25], Feature::Edge1, [0.5, 0.5, 0.0]),
    ([-0.5, 0.25, -0.25], Feature::Edge2, [0.0, 0.25, 0.0]),
    ([-0.25, -0.5, 0.5], Feature::Vertex0, [0.0, 0.0, 0.0]),
    ([1.5, -0.25, -0.25], Feature::Vertex1, [1.0, 0.0, 0.0]),
    ([-0.5, 1.25, 0.25], Feature::Vertex2, [0.0, 1.0, 0.0]),
];

#[test]
fn a_sphere_and_each_part_of_a_triangle() {
    for radius in [0.25, 0.9, 1.0, 3.0] {
        let ball = Particle::sphere(radius).unwrap();
        for (position, feature, nearest) in PLACES {
            let way = Vector3::from(nearest) - Vector3::from(position);
            let distance = way.norm();
            let contact = touch(&ball, &Pose::new(position, [0.3, -0.2, 0.7, 0.4]).unwrap(), VERTICES, &solved());
            assert_eq!(contact.feature, feature, "{position:?}");
            assert!((contact.s - distance / radius).abs() <= contact.gap && contact.gap < 1e-13 * contact.s.max(1.0));
            assert!((contact.normal - way / distance).norm() < 1e-15, "{contact:?}");
            assert!((boundary_point(&contact) - way).norm() < 1e-15, "{contact:?}");
            assert!((contact.on_boundary - Vector3::from(nearest)).norm() < 1e-15);
            if distance < radius {
                assert_eq!(contact.kind, Kind::Overlapping);
                assert!((contact.overlap - (radius - distance)).abs() < 2e-15 * radius, "{contact:?}");
                let halfway = Vector3::from(position) + 0.5 * (radius + distance) * contact.normal;
                assert!((contact.point - halfway).norm() < 2e-15 * radius);
                assert!((contact.on_particle - Vector3::from(position)).norm() - radius < 2e-15 * radius);
            } else {
                assert_eq!(contact.kind, Kind::Separated);
                let gap = distance - radius;
                assert!(contact.distance <= gap && contact.distance > gap - 1e-12, "{contact:?}");
                let cheaply = touch(&ball, &Pose::at(position).unwrap(), VERTICES, &Settings::default());
                assert!(cheaply.flags.contains(Flags::REJECTED) || gap < 2e-5 * radius);
                assert!(cheaply.distance <= gap && cheaply.distance > gap - 2e-5 * radius);
            }
        }
    }
}

#[test]
fn a_sphere_and_a_plane_from_either_side_with_its_area() {
    let ball = Particle::sphere(2.0).unwrap();
    let wall = Wall::new([7.0, -3.0, 1.0], [0.0, 3.0, 4.0]).unwrap();
    let normal = Vector3::new(0.0, 0.6, 0.8);
    for height in [1.75_f64, -1.75, 0.5, -1e-3] {
        let position = Vector3::new(2.0, -3.0, 1.0) + height * normal;
        let pose = Pose::new(position.into(), [0.5, 0.1, -0.7, 0.2]).unwrap();
        let contact = contact_with_plane(&ball, &pose, &wall, &Settings::default(), None).unwrap();
        assert!((contact.overlap - (2.0 - height.abs())).abs() < 4e-15, "{contact:?}");
        assert_eq!(contact.normal, -height.signum() * normal);
        let middle = 0.5 * (2.0 + height.abs());
        let area = Section::from(&contact).area(&ball, &pose, &ball, &pose, 1e-6).unwrap();
        assert!((area - PI * (4.0 - middle * middle)).abs() < 1e-12, "{area}");
    }
}

#[test]
fn a_centre_on_the_boundary_counts_as_in_front_of_it() {
    let ball = Particle::sphere(1.0).unwrap();
    let at_origin = Pose::at([0.0; 3]).unwrap();
    let wall = Wall::new([3.0, 2.0, 0.0], [0.0, 0.0, 5.0]).unwrap();
    let on_plane = contact_with_plane(&ball, &at_origin, &wall, &Settings::default(), None).unwrap();
    for contact in
        [on_plane, touch(&ball, &at_origin, [[-1.0, -1.0, 0.0], [3.0, -1.0, 0.0], [-1.0, 3.0, 0.0]], &solved())]
    {
        assert!(contact.flags.contains(Flags::NORMAL_BY_BOUNDARY));
        assert!(contact.normal == -Vector3::z() && (contact.overlap - 1.0).abs() < 1e-15, "{contact:?}");
    }
    // On an edge and a vertex, too.
    let on_edge = touch(&ball, &Pose::at([0.5, 0.0, 0.0]).unwrap(), VERTICES, &solved());
    let at_vertex = touch(&ball, &at_origin, VERTICES, &solved());
    assert!(on_edge.normal == -Vector3::z() && at_vertex.normal == -Vector3::z(), "{on_edge:?}, {at_vertex:?}");
}

#[test]
fn a_rounded_cube_lies_flat_on_a_plane() {
    for r in [0.25, 0.125, 1e-3, 1e-6] {
        let cube = cube(r, 0.0);
        let floor = Wall::new([40.0, -30.0, 2.0], [0.0, 0.0, 1.0]).unwrap();
        for overlap in [0.5 * r, 0.01 * r, 0.99 * r] {
            // Its lower face is at 0.5 below the centre.
            let height = 0.5 - overlap;
            let pose = Pose::at([1.0, -5.0, 2.0 + height]).unwrap();
            let contact = contact_with_plane(&cube, &pose, &floor, &Settings::default(), None).unwrap();
            assert!((contact.overlap - overlap).abs() < 4.0 * f64::EPSILON, "{r}: {contact:?}");
            let s = 1.0 - overlap / r;
            assert!((contact.s - s).abs() <= contact.gap, "{r}: {contact:?}");
            // Nearest to the centre, of all points of the face.
            assert!(contact.normal == -Vector3::z() && (contact.branch.xy()).norm() < 1e-12, "{contact:?}");
        }
        let pose = Pose::at([1.0, -5.0, 2.0 + 0.5 + 1e-9]).unwrap();
        let contact = contact_with_plane(&cube, &pose, &floor, &solved(), None).unwrap();
        assert!(contact.kind == Kind::Separated && (contact.distance - 1e-9).abs() < 1e-12, "{contact:?}");
    }
}

#[test]
fn a_cube_stands_on_a_corner_and_an_edge() {
    // The scale of a corner of three planes: all three rounded depths are alike.
    let (r, cube) = (0.125, cube(0.125, 0.0));
    let upright = Pose::new([0.0; 3], {
        // Turns (1, 1, 1) to −z: half the angle about (1, −1, 0).
        let cosine = -1.0 / 3f64.sqrt();
        let (c, s) = (((1.0 + cosine) / 2.0).sqrt(), ((1.0 - cosine) / 2.0).sqrt());
        [c, s / 2f64.sqrt(), -s / 2f64.sqrt(), 0.0]
    })
    .unwrap();
    let height = 0.375 * 3f64.sqrt() + 0.5 * r;
    let floor = Wall::new([0.0, 0.0, -height], [0.0, 0.0, 1.0]).unwrap();
    let contact = contact_with_plane(&cube, &upright, &floor, &solved(), None).unwrap();
    assert!((contact.s - 0.5).abs() <= contact.gap, "{contact:?}");
    assert!((contact.overlap - 0.5 * r).abs() < 1e-15 && contact.branch.xy().norm() < 1e-12, "{contact:?}");
}
