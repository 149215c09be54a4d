//! The contact area against 40-digit answers, its definition, and closed forms.

mod properties;
mod quadrature;
mod sections;

use nalgebra::Vector3;
use potential_particles::Section;
use potential_particles::{Formulation, Kind, Particle, Plane, Pose, Settings, detect};
use sections::{Cut, Known, cuboid};
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Relative error that is allowed: ε·size/r, or 1e-12 where that is less.
fn allowed(cut: &Cut) -> f64 {
    let of = |particle: &Particle| match particle.sphericity() {
        1.0 => 0.0,
        _ => f64::EPSILON * particle.bounding_radius() / particle.rounding_radius(),
    };
    1e-12 + of(&cut.a).max(of(&cut.b))
}

#[test]
fn areas_known_to_40_digits() {
    let mut families: BTreeMap<String, (usize, f64)> = BTreeMap::new();
    let mut quadratures = 0;
    for Known { family, cut, area } in sections::known() {
        let error = (cut.area() - area).abs() / area;
        assert!(error <= allowed(&cut), "{family}: {error:e}, {} for {area}", cut.area());
        quadratures += usize::from(!cut.is_exact());
        let (count, worst) = families.entry(family).or_default();
        *count += 1;
        *worst = worst.max(error);
    }
    for (family, (count, worst)) in &families {
        println!("{family:12} {count:3} sections, worst relative error {worst:.1e}");
    }
    assert_eq!(families.len(), 10);
    assert_eq!(quadratures, 0, "sections that need quadrature");
}

/// A contact along z through the middle of two bodies at these heights.
fn stacked(a: &Particle, b: &Particle, shift: [f64; 2], height: f64, contact_height: f64) -> Cut {
    let pose_a = Pose::at([0.0; 3]).unwrap();
    let pose_b = Pose::at([shift[0], shift[1], height]).unwrap();
    let point = Vector3::new(0.5 * shift[0], 0.5 * shift[1], contact_height);
    let section = Section { branch_a: point, branch_b: point - pose_b.position(), normal: Vector3::z() };
    Cut { a: a.clone(), pose_a, b: b.clone(), pose_b, section }
}

#[test]
fn spheres_show_discs_and_their_lens() {
    let (ra, rb) = (2.0, 0.5);
    let (a, b) = (Particle::sphere(ra).unwrap(), Particle::sphere(rb).unwrap());
    for overlap in [0.4, 1e-3, 1e-6, 1e-9, 1e-12] {
        let distance = ra + rb - overlap;
        // Where both spheres intersect their cuts are the same disc.
        let height = (distance * distance + ra * ra - rb * rb) / (2.0 * distance);
        let cut = stacked(&a, &b, [0.0; 2], distance, height);
        let [from_a, from_b] = cut.points();
        let square = ((ra - from_a.norm()) * (ra + from_a.norm())).min((rb - from_b.norm()) * (rb + from_b.norm()));
        assert!((cut.area() / (PI * square) - 1.0).abs() < 1e-12, "overlap {overlap}: {}", cut.area());
    }
    // Discs of radius √3/2 and 1/2 about centres at a distance of 0.9: their lens.
    let (a, b) = (Particle::sphere(1.0).unwrap(), Particle::sphere(0.5).unwrap());
    let (large, small, distance) = (0.75f64.sqrt(), 0.5, 0.9);
    let part = |r: f64, other: f64| {
        let to_chord = (distance * distance + r * r - other * other) / (2.0 * distance);
        r * r * (to_chord / r).acos() - to_chord * (r * r - to_chord * to_chord).sqrt()
    };
    let lens = part(large, small) + part(small, large);
    let cut = |at: f64| Cut {
        section: Section {
            branch_a: Vector3::new(at, 0.0, 0.5),
            branch_b: Vector3::new(at - distance, 0.0, 0.0),
            normal: Vector3::z(),
        },
        ..stacked(&a, &b, [distance, 0.0], 0.5, 0.5)
    };
    // It does not matter from where in the section it is seen, be it from its rim.
    for at in [0.401, 0.5, 0.7, 0.86, 0.4 + 1e-12, 0.75f64.sqrt() - 1e-12] {
        assert!((cut(at).area() / lens - 1.0).abs() < 1e-12, "from {at}: {} for {lens}", cut(at).area());
    }
}

#[test]
fn parallel_boxes_share_a_rounded_rectangle() {
    for r in [0.1, 1e-3, 1e-6, 1e-8] {
        for share in [0.9, 1e-3, 1e-9] {
            let overlap = share * r;
            let (a, b) = (cuboid([0.5, 0.4, 0.3], r, 0.0), cuboid([0.5, 0.3, 0.2], r, 0.0));
            let cut = |shift: f64| stacked(&a, &b, [shift, 0.0], 0.5 - overlap, 0.3 - 0.5 * overlap);
            // The faces have used up part of the rounding: the corners of both cuts keep what is left as their radius,
            // the same but for rounding.
            let [from_a, from_b] = cut(0.0).points();
            let rim = |up: f64| r * ((1.0 - up) * (1.0 + up)).sqrt();
            let (rim_a, rim_b) = (rim((from_a.z - (0.3 - r)) / r), rim((-from_b.z - (0.2 - r)) / r));
            // B lies in A, with one pair of edges on the edges of A, and keeps its corners.
            let (end_a, end_b, side) = (0.5 - r + rim_a, 0.5 - r + rim_b, 0.3 - r + rim_b);
            let corner = (1.0 - 0.25 * PI) * rim_b * rim_b;
            let whole = 4.0 * end_a.min(end_b) * side - 4.0 * corner;
            assert!((cut(0.0).area() / whole - 1.0).abs() < 1e-12, "r {r}: {} for {whole}", cut(0.0).area());
            // Shifted along x it keeps two of them.
            for shift in [0.5, -0.2] {
                let rest = (end_a + end_b - f64::abs(shift)) * 2.0 * side - 2.0 * corner;
                let area = cut(shift).area();
                assert!((area / rest - 1.0).abs() < 1e-12, "r {r}, shift {shift}: {area} for {rest}");
            }
        }
    }
}

#[test]
fn a_plane_counts_as_written_whatever_the_length_of_its_normal() {
    // Stretched normals and offsets of one box, r the same: the definition by ray hits judges.
    let planes: Vec<Plane> = cuboid([0.5, 0.4, 0.3], 0.1, 0.05)
        .planes()
        .enumerate()
        .map(|(i, plane)| {
            let stretch = 0.5 + 0.3 * i as f64;
            Plane { normal: stretch * plane.normal, offset: stretch * plane.offset }
        })
        .collect();
    let a = Particle::new(&planes, 0.1, 0.05, 0.9).unwrap();
    let cut = stacked(&a, &a, [0.2, 0.1], 0.4, 0.2);
    let expected = quadrature::area(&cut, 1e-10);
    assert!((cut.area() / expected - 1.0).abs() < 1e-9, "{} for {expected}", cut.area());
}

#[test]
fn closest_may_put_the_point_onto_a_surface() {
    let (a, b) = (cuboid([0.5, 0.4, 0.3], 0.1, 0.2), cuboid([0.4, 0.4, 0.4], 0.05, 0.1));
    let (pose_a, pose_b) = (
        Pose::new([0.0; 3], [1.0, 0.2, 0.3, 0.1]).unwrap(),
        Pose::new([0.55, 0.35, 0.1], [0.3, -0.4, 1.0, 0.2]).unwrap(),
    );
    let area = |weight_on_a: f64| {
        let settings = Settings::default().with_formulation(Formulation::Closest).with_weight_on_a(weight_on_a);
        let contact = detect(&a, &pose_a, &b, &pose_b, &settings, None).unwrap();
        assert_eq!((contact.kind, contact.formulation), (Kind::Overlapping, Formulation::Closest));
        Cut::of_contact(&a, &pose_a, &b, &pose_b, &contact).area()
    };
    let scale = area(0.5);
    for (on, beside) in [(0.0, 1e-9), (1.0, 1.0 - 1e-9)] {
        assert!((area(on) - area(beside)).abs() < 1e-5 * scale, "{} {} of {scale}", area(on), area(beside));
    }
}

#[test]
fn a_section_that_is_none_is_refused() {
    let cube = cuboid([0.5; 3], 0.05, 0.1);
    let good = stacked(&cube, &cube, [0.1, 0.2], 0.98, 0.49);
    assert!(good.area() > 0.5);
    let refused = |section: Section| assert_eq!(Cut { section, ..good.clone() }.area_to(1e-6), None, "{section:?}");
    let section = good.section;
    refused(Section { normal: Vector3::zeros(), ..section });
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for axis in 0..3 {
            let spoilt = |v: &Vector3<f64>| {
                let mut v = *v;
                v[axis] = bad;
                v
            };
            refused(Section { normal: spoilt(&section.normal), ..section });
            refused(Section { branch_a: spoilt(&section.branch_a), ..section });
            refused(Section { branch_b: spoilt(&section.branch_b), ..section });
        }
    }
    // Outside one of the particles, from clearly to hardly.
    let surface = cube.surface_distance(&Vector3::zeros(), &Vector3::z()).unwrap();
    for out in [1e200, 1.0, 0.1, 1e-3, 1e-6] {
        refused(Section { branch_a: Vector3::new(0.0, 0.0, surface + out), ..section });
        refused(Section { branch_b: Vector3::new(surface + out, 0.0, 0.0), ..section });
    }
}

/// Offsets of 1e308 overflow where the arcs of both cuts are compared: the comparison then halved what was no number,
/// down to a thousandth of a millionth of the arc on every side, for minutes.
#[test]
fn offsets_that_overflow_end_at_once() {
    let cube = |offsets: [f64; 6]| {
        let planes: Vec<Plane> =
            (0..6).map(|i| Plane { normal: Vector3::ith(i / 2, [1.0, -1.0][i % 2]), offset: offsets[i] }).collect();
        Particle::new(&planes, 0.05, 0.05, 0.9).unwrap()
    };
    let small = cube([0.45; 6]);
    let plate = cube([1e308, 9.2e18, 9e-4, 1e160, -1e-4, -2e-3]);
    let unturned = [1.0, 0.0, 0.0, 0.0];
    let below = Pose::new([0.0; 3], unturned).unwrap();
    let above = Pose::new([0.0, 0.95, 0.0], [1.0, 1.2e-13, 0.0, 5.8e-14]).unwrap();
    let aside = Pose::new([0.9, 0.0, 0.0], unturned).unwrap();
    let mut asked = 0;
    for (a, at_a, b, at_b) in [(&small, &below, &plate, &above), (&plate, &above, &small, &aside)] {
        let Ok(contact) = detect(a, at_a, b, at_b, &Settings::default(), None) else { continue };
        if contact.kind != Kind::Overlapping {
            continue;
        }
        let section = Section { branch_a: contact.branch_a, branch_b: contact.branch_b, normal: contact.normal };
        let area = section.area(a, at_a, b, at_b, 1e-6);
        assert!(area.is_none_or(|area| area.is_finite() && area >= 0.0), "{area:?} of {contact:?}");
        asked += 1;
    }
    assert!(asked > 0, "no contact to ask for");
}
