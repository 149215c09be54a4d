//! What holds for every particle and every triangle.

use crate::{boundary_point, solved, touch};
use nalgebra::{Rotation3, Vector3};
use potential_particles::{Kind, Particle, Plane, Pose, Settings};
use proptest::prelude::*;

fn direction() -> impl Strategy<Value = Vector3<f64>> {
    let cube = prop::array::uniform3(-1.0..1.0).prop_map(Vector3::from);
    cube.prop_filter("no direction", |v| v.norm() > 0.1).prop_map(|v| v.normalize())
}

fn exponent(from: f64, to: f64) -> impl Strategy<Value = f64> {
    (from..to).prop_map(|e| 10f64.powf(e))
}

/// Six planes about the axes and some more.
fn particles() -> impl Strategy<Value = Particle> {
    let planes = prop::collection::vec((direction(), 0.4..0.8), 6..14);
    let k = prop_oneof![1 => Just(0.0), 5 => exponent(-6.0, 0.0), 1 => Just(1.0)];
    (planes, exponent(-6.0, -0.5), k).prop_map(|(given, r, k)| {
        let axes = (0..3).flat_map(|axis| [0.5, -0.5].map(|sign| Vector3::ith(axis, sign)));
        let planes = axes.zip(&given).map(|(axis, (n, offset))| (axis + 0.2 * n, 0.5 * offset));
        let planes = planes.chain(given.iter().skip(6).copied());
        let planes: Vec<Plane> = planes.map(|(normal, offset)| Plane { normal, offset }).collect();
        Particle::new(&planes, r, k, 1.0).expect("a particle")
    })
}

/// A triangle of any size about a point near the origin, not all but flat.
fn triangles() -> impl Strategy<Value = [[f64; 3]; 3]> {
    let size = prop_oneof![3 => exponent(-0.3, 0.5), 1 => exponent(-4.0, 4.0)];
    let corners = prop::array::uniform3(prop::array::uniform3(-1.0..1.0));
    let about = prop::array::uniform3(-0.8..0.8);
    (size, corners, about).prop_filter_map("all but flat", |(size, corners, about)| {
        let [a, b, c] = corners.map(Vector3::from);
        let area = (b - a).cross(&(c - a)).norm();
        (area > 0.05).then(|| {
            let to = (a + b + c) / 3.0;
            [a, b, c].map(|v| (size * (v - to) + Vector3::from(about)).into())
        })
    })
}

fn poses() -> impl Strategy<Value = Pose> {
    let turn =
        prop::array::uniform4(-1.0..1.0).prop_filter("too short", |q: &[f64; 4]| q.iter().any(|c| c.abs() > 0.1));
    (prop::array::uniform3(-0.7..0.7), turn).prop_map(|(position, turn)| Pose::new(position, turn).unwrap())
}

/// s at a point of the world, and a bound on its rounding.
fn scale_at(particle: &Particle, pose: &Pose, point: &Vector3<f64>) -> (f64, f64) {
    let y = pose.to_local(point);
    let value = particle.potential(&y) + 1.0;
    let lengths = point.norm() + pose.position().norm() + 1.0;
    let noise = 64.0 * f64::EPSILON * (lengths * particle.gradient(&y).norm() + value + 1.0);
    (value.max(0.0).sqrt(), noise / value.sqrt().max(noise.sqrt()))
}

fn inside(vertices: &[[f64; 3]; 3], weights: &[f64; 3]) -> Vector3<f64> {
    let sum: f64 = weights.iter().sum();
    vertices.iter().zip(weights).map(|(v, w)| Vector3::from(*v) * (w / sum)).sum()
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 400,
        failure_persistence: None,
        rng_seed: prop::test_runner::RngSeed::Fixed(1),
        ..ProptestConfig::default()
    })]

    #[test]
    fn s_is_least_at_the_point_and_the_rest_follows(
        particle in particles(),
        pose in poses(),
        vertices in triangles(),
        samples in prop::collection::vec(prop::array::uniform3(1e-3..1.0), 20),
        near in exponent(-8.0, -1.0),
    ) {
        let contact = touch(&particle, &pose, vertices, &solved());
        let x = pose.position() + boundary_point(&contact);
        let (at_x, noise_at_x) = scale_at(&particle, &pose, &x);
        prop_assert!((at_x - contact.s).abs() <= contact.gap + noise_at_x, "{at_x} at x, {contact:?}");
        for weights in &samples {
            let sample = inside(&vertices, weights);
            // Anywhere, and near x.
            for point in [sample, x + near * (sample - x)] {
                let (s, noise) = scale_at(&particle, &pose, &point);
                prop_assert!(s >= contact.s - contact.gap - noise, "{s} at {point:?}, {contact:?}");
            }
        }
        prop_assert!((contact.normal.norm() - 1.0).abs() < 1e-14);
        if let Some(i) = contact.feature.edge() {
            let [from, to] = [0, 1].map(|j| Vector3::from(vertices[(i + j) % 3]));
            prop_assert!(contact.normal.dot(&(to - from).normalize()).abs() < 1e-9);
        }
        if let Some(i) = contact.feature.vertex() {
            prop_assert!((x - Vector3::from(vertices[i])).norm() < 1e-13 * (1.0 + x.norm()));
        }
        if contact.kind == Kind::Overlapping {
            let (on_surface, noise) = scale_at(&particle, &pose, &contact.on_particle);
            prop_assert!((on_surface - 1.0).abs() <= noise + contact.gap, "{on_surface}, {contact:?}");
            prop_assert!(contact.overlap > 0.0 || contact.s > 1.0 - 1e-9);
            prop_assert!((contact.on_boundary + contact.overlap * contact.normal - contact.on_particle).norm() < 1e-14 * (1.0 + x.norm()));
            prop_assert!((contact.point - 0.5 * (contact.on_boundary + contact.on_particle)).norm() < 1e-14 * (1.0 + x.norm()));
        }
    }

    #[test]
    fn parts_of_a_triangle_are_the_whole(
        particle in particles(),
        pose in poses(),
        vertices in triangles(),
        share in 0.05..0.95,
    ) {
        let whole = touch(&particle, &pose, vertices, &solved());
        let [a, b, c] = vertices;
        let middle = Vector3::from(b).lerp(&Vector3::from(c), share).into();
        let parts = [[a, b, middle], [middle, c, a]].map(|part| touch(&particle, &pose, part, &solved()));
        let least = if parts[1].s < parts[0].s { parts[1] } else { parts[0] };
        // The point in the middle is rounded.
        let (_, noise) = scale_at(&particle, &pose, &whole.on_boundary);
        let size = vertices.iter().flatten().fold(1.0, |size: f64, c| size.max(c.abs()));
        prop_assert!((whole.s - least.s).abs() <= whole.gap + least.gap + size * noise, "{whole:?}, {least:?}");
    }

    #[test]
    fn whoever_moves_by_less_than_the_distance_touches_nothing(
        particle in particles(),
        pose in poses(),
        vertices in triangles(),
        away in direction(),
        far in 0.5..2.5,
        towards in direction(),
    ) {
        let position = pose.position() + far * away;
        let turn = Rotation3::from_matrix_unchecked(*pose.rotation());
        let at = |position: Vector3<f64>| Pose::from_rotation(position.into(), turn.matrix()).unwrap();
        for settings in [Settings::default(), solved()] {
            let contact = touch(&particle, &at(position), vertices, &settings);
            if contact.kind == Kind::Overlapping {
                prop_assert!(contact.distance.is_nan());
                continue;
            }
            let whole = touch(&particle, &at(position), vertices, &solved());
            prop_assert!(whole.kind == Kind::Separated && contact.s <= whole.s + whole.gap);
            for way in [towards, whole.normal, (whole.on_boundary - position).normalize()] {
                let moved = position + 0.999_999 * contact.distance * way;
                prop_assert_eq!(touch(&particle, &at(moved), vertices, &solved()).kind, Kind::Separated);
            }
        }
    }
}
