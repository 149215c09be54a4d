//! What must hold for any section.

use crate::quadrature;
use crate::sections::{Cut, cuboid};
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use potential_particles::Section;
use potential_particles::{Formulation, Kind, Particle, Plane, Pose, Settings, detect};
use proptest::prelude::*;

fn direction() -> impl Strategy<Value = Vector3<f64>> {
    prop::array::uniform3(-1.0..1.0).prop_filter_map("too short", |v: [f64; 3]| Vector3::from(v).try_normalize(0.1))
}

fn turn() -> impl Strategy<Value = Matrix3<f64>> {
    prop::array::uniform4(-1.0..1.0).prop_filter_map("too short", |[w, x, y, z]: [f64; 4]| {
        UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 0.1).map(|q| q.to_rotation_matrix().into_inner())
    })
}

/// Boxes from needles to plates, and particles of many planes in all directions; r down to 10^`least` of the size.
fn shape(least: f64) -> impl Strategy<Value = Particle> {
    let k = || prop_oneof![Just(0.0), (-6.0..-0.1).prop_map(|e: f64| 10f64.powf(e)), Just(1.0)];
    let boxes = (prop::array::uniform3(-2.0..0.0), least..-0.5, k()).prop_map(|(half, r, k)| {
        let half = half.map(|e: f64| 10f64.powf(e));
        cuboid(half, 10f64.powf(r) * half.iter().copied().fold(1.0, f64::min), k)
    });
    let balls = (4usize..80, 0.0..1.0, least..-0.5, k()).prop_map(|(count, twist, r, k)| {
        let r = 0.5 * 10f64.powf(r);
        let planes: Vec<Plane> = (0..count)
            .map(|i| {
                let z = 1.0 - (2 * i + 1) as f64 / count as f64;
                let (sin, cos) = f64::sin_cos(2.399963 * i as f64 + twist);
                let across = (1.0 - z * z).sqrt();
                Plane { normal: Vector3::new(across * cos, across * sin, z), offset: 0.5 + 0.1 * twist * cos - r }
            })
            .collect();
        Particle::new(&planes, r, k, 0.9).expect("planes all around")
    });
    prop_oneof![boxes, balls]
}

/// Any two overlapping particles, with the overlap as a part of the size.
pub fn contact(least: f64) -> impl Strategy<Value = Cut> {
    let overlap = (-9.0..-0.5).prop_map(|e: f64| 10f64.powf(e));
    let formulation = prop_oneof![Just(Formulation::Midway), Just(Formulation::Closest)];
    (shape(least), shape(least), turn(), turn(), direction(), overlap, formulation).prop_filter_map(
        "no contact",
        |(a, b, turn_a, turn_b, direction, overlap, formulation)| {
            let settings = Settings::default().with_formulation(formulation);
            let pose_a = Pose::from_rotation([0.0; 3], &turn_a).unwrap();
            let at = |distance: f64| Pose::from_rotation((distance * direction).into(), &turn_b).unwrap();
            let found = |distance: f64| detect(&a, &pose_a, &b, &at(distance), &settings, None).ok();
            let (mut deep, mut apart) = (0.0, a.bounding_radius() + b.bounding_radius());
            for _ in 0..50 {
                let middle = 0.5 * (deep + apart);
                let contact = found(middle)?;
                if contact.kind == Kind::Overlapping && contact.overlap > overlap {
                    deep = middle;
                } else {
                    apart = middle;
                }
            }
            let contact = found(deep)?;
            (contact.kind == Kind::Overlapping).then(|| Cut::of_contact(&a, &pose_a, &b, &at(deep), &contact))
        },
    )
}

fn close(one: f64, other: f64, relative: f64) -> bool {
    (one - other).abs() <= relative * one.max(other)
}

/// How well 1 − S, and with it the area, is known after the section was rounded anew.
fn blur(cut: &Cut, length: f64) -> f64 {
    let of = |particle: &Particle, point: &Vector3<f64>| {
        f64::EPSILON * (1.0 + particle.gradient(point).norm() * length) / -particle.potential(point).min(-f64::EPSILON)
    };
    let [from_a, from_b] = cut.points();
    16.0 * of(&cut.a, &from_a).max(of(&cut.b, &from_b))
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 256,
        failure_persistence: None,
        rng_seed: prop::test_runner::RngSeed::Fixed(1),
        ..ProptestConfig::default()
    })]

    #[test]
    fn the_area_is_the_integral_over_rays(cut in contact(-3.0)) {
        // Rays know 1 − S in plain numbers only.
        let known = 1e-10 + blur(&cut, 1.0);
        let expected = quadrature::area(&cut, known);
        prop_assert!(close(cut.area(), expected, 2.0 * known), "{} for {expected}", cut.area());
    }

    #[test]
    fn the_same_section_said_otherwise_has_the_same_area(cut in contact(-6.0), turn in turn(), exponent in -30i32..20) {
        let (Cut { a, pose_a, b, pose_b, section }, area) = (cut.clone(), cut.area());
        let Section { branch_a, branch_b, normal } = section;
        let other = |section, a: &Particle, b: &Particle| Cut { section, a: a.clone(), b: b.clone(), ..cut.clone() };
        // The bodies swapped.
        let section = Section { branch_a: branch_b, branch_b: branch_a, normal: -normal };
        let swapped = Cut { pose_a: pose_b, pose_b: pose_a, ..other(section, &b, &a) };
        let walked = cut.is_exact() && swapped.is_exact();
        let known = 2e-12 + 2.0 * f64::EPSILON / a.rounding_radius().min(b.rounding_radius());
        prop_assert!(close(area, swapped.area(), if walked { known } else { 1e-6 }), "swapped: {area} {}", swapped.area());
        // Turned as a whole.
        let carry = |pose: &Pose| Pose::from_rotation((turn * pose.position()).into(), &(turn * pose.rotation())).unwrap();
        let section = Section { branch_a: turn * branch_a, branch_b: turn * branch_b, normal: turn * normal };
        let moved = Cut { pose_a: carry(&pose_a), pose_b: carry(&pose_b), ..other(section, &a, &b) };
        prop_assert!(close(area, moved.area(), 1e-9 + blur(&cut, 1.0)), "turned: {area} {}", moved.area());
        // In another unit; powers of two scale without rounding.
        let unit = 2f64.powi(exponent);
        let section = Section { branch_a: unit * branch_a, branch_b: unit * branch_b, normal };
        let after = other(section, &a.scaled(unit).unwrap(), &b.scaled(unit).unwrap()).area() / (unit * unit);
        prop_assert!(close(area, after, 1e-12), "in another unit: {area} {after}");
    }

    #[test]
    fn the_contact_point_need_not_be_the_middle(cut in contact(-3.0), towards in direction(), share in 0.0..0.999) {
        // Along the section the point may go anywhere in it.
        let Section { branch_a, branch_b, normal } = cut.section;
        let along = normal.cross(&towards);
        prop_assume!(along.norm() > 0.1);
        let along = along.normalize();
        let reach = |particle: &Particle, pose: &Pose, branch: &Vector3<f64>| {
            let turned = |v: &Vector3<f64>| pose.rotation().tr_mul(v);
            particle.surface_distance(&turned(branch), &turned(&along)).expect("a hit")
        };
        let step = share * reach(&cut.a, &cut.pose_a, &branch_a).min(reach(&cut.b, &cut.pose_b, &branch_b)) * along;
        let section = Section { branch_a: branch_a + step, branch_b: branch_b + step, normal };
        let moved = Cut { section, ..cut.clone() };
        let known = 1e-9 + blur(&cut, 1.0) + blur(&moved, 1.0);
        prop_assert!(close(cut.area(), moved.area(), known), "{} {}", cut.area(), moved.area());
    }
}

/// Whatever was rounded, the walk answers: the quadrature is for the very few.
#[test]
fn hardly_any_section_needs_quadrature() {
    let mut runner = proptest::test_runner::TestRunner::new_with_rng(
        ProptestConfig::default(),
        proptest::test_runner::TestRng::deterministic_rng(proptest::test_runner::RngAlgorithm::ChaCha),
    );
    let sections = contact(-8.0);
    let (mut walked, mut all) = (0, 0);
    while all < 1000 {
        if let Ok(tree) = sections.new_tree(&mut runner) {
            walked += usize::from(proptest::strategy::ValueTree::current(&tree).is_exact());
            all += 1;
        }
    }
    assert!(walked >= 995, "{walked} of {all}");
}

/// A box slides and turns over another one: the contact meets faces, edges and corners on its way.
#[test]
fn the_area_moves_as_the_bodies_do() {
    let (a, b) = (cuboid([0.5, 0.4, 0.3], 0.05, 0.05), cuboid([0.3, 0.3, 0.3], 0.03, 0.05));
    let pose_a = Pose::new([0.0; 3], [1.0, 0.1, -0.2, 0.3]).unwrap();
    let area = |time: f64| {
        let half = 0.3 * time;
        let slide = Vector3::new(-0.35 + 0.7 * time, 0.2 * (3.0 * time).sin(), 0.52 + 0.02 * (5.0 * time).cos());
        let pose_b = Pose::new((pose_a.rotation() * slide).into(), [half.cos(), 0.2 * half.sin(), 0.1, half.sin()]);
        let pose_b = pose_b.unwrap();
        let contact = detect(&a, &pose_a, &b, &pose_b, &Settings::default(), None).unwrap();
        assert_eq!(contact.kind, Kind::Overlapping, "at {time}");
        Cut::of_contact(&a, &pose_a, &b, &pose_b, &contact).area()
    };
    // The largest change between two steps shrinks as the steps do; a jump would stay.
    let largest = |steps: usize| {
        let areas: Vec<f64> = (0..=steps).map(|i| area(i as f64 / steps as f64)).collect();
        let range = areas.iter().fold((f64::INFINITY, 0f64), |(l, h), &a| (l.min(a), h.max(a)));
        assert!(range.1 > 1.3 * range.0, "the area hardly changes: {range:?}");
        areas.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max)
    };
    let changes = [1000, 4000, 16000].map(largest);
    assert!(changes[1] < 0.3 * changes[0] && changes[2] < 0.3 * changes[1], "{changes:?}");
}
