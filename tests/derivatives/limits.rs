//! Where derivatives are one-sided, regularised, or none: the flags say so, and every number is one.

use nalgebra::Vector3;
use potential_particles::*;

fn cube(k: f64) -> Particle {
    let sides = (0..3).flat_map(|axis| [1.0, -1.0].map(|sign| Vector3::ith(axis, sign)));
    let planes: Vec<Plane> = sides.map(|normal| Plane { normal, offset: 0.45 }).collect();
    Particle::new(&planes, 0.05, k, 1.0).unwrap()
}

fn at(x: f64, y: f64, z: f64) -> Pose {
    Pose::at([x, y, z]).unwrap()
}

#[test]
fn faces_of_k_0_leave_the_point_free_and_the_overlap_not() {
    let (cube, lower, upper) = (cube(0.0), at(0.0, 0.0, 0.0), at(0.1, 0.05, 0.99));
    let mut turned = Vec::new();
    for flat_regularisation in [0.0, 1e-4] {
        let settings = Settings::default().with_flat_regularisation(flat_regularisation);
        let contact = detect(&cube, &lower, &cube, &upper, &settings, None).unwrap();
        let d = contact_derivatives(&cube, &lower, &cube, &upper, &contact, &settings).unwrap();
        assert!(d.flags.contains(DerivativeFlags::FREE), "{}", d.flags);
        assert!((d.overlap[2] - 1.0).abs() < 1e-9 && (d.overlap[8] + 1.0).abs() < 1e-9);
        assert!((d.s[8] - 10.0).abs() < 1e-3, "{}", d.s[8]);
        assert!(d.point.iter().chain(&d.normal).chain(&d.point_on_a).all(|v| v.is_finite()));
        turned.push(d.point[(0, 4)].abs());
    }
    // Turned alike by any angle: at the contact point the overlap grows with the motion along the normal, whatever the
    // point does.
    for seed in 0..40 {
        let mut chance = crate::properties::scattered(7 * seed);
        let lower = Pose::new([0.0; 3], [chance(), chance(), chance(), chance()]).unwrap();
        let way = lower.rotate(&Vector3::new(0.1, 0.07, 0.99));
        let upper = Pose::new(way.into(), lower.orientation()).unwrap();
        let settings = Settings::default();
        let contact = detect(&cube, &lower, &cube, &upper, &settings, None).unwrap();
        let d = contact_derivatives(&cube, &lower, &cube, &upper, &contact, &settings).unwrap();
        let n = contact.normal;
        let part = |column: usize| d.overlap.fixed_columns::<3>(column).transpose();
        assert!((part(0) - n).amax() < 1e-9 && (part(6) + n).amax() < 1e-9, "{seed}: {}", d.overlap);
        // That point, which doubles know to their bound, is the same for both bodies.
        assert!((part(3) + part(9) - way.cross(&n)).amax() < 1e-9, "{seed}: {}", d.overlap);
        assert!(part(3).dot(&n).abs() < 1e-9);
        assert!((part(3) - contact.branch_a.cross(&n)).norm() < 1e-9 + contact.point_bound, "{seed}: {}", d.overlap);
    }
    // With a turn the point runs off, by the inverse of the regularisation.
    assert!(turned[0] > 1e8 && turned[1] < 1e-5 * turned[0], "{turned:?}");
}

#[test]
fn a_plane_that_may_switch_is_told() {
    // Mirror images whose plane x = 0.75 passes through the contact point.
    let sides = [
        [1.0, 0.0, 0.0, 0.75],
        [-1.0, 0.0, 0.0, 0.8],
        [0.0, 1.0, 0.0, 0.8],
        [0.0, -1.0, 0.0, 0.8],
        [0.0, 0.0, 1.0, 0.8],
        [0.0, 0.0, -1.0, 0.8],
    ];
    for (offset, switches) in [(0.75, true), (0.7, false)] {
        let planes: Vec<Plane> = sides
            .iter()
            .map(|row| Plane::from(*row))
            .map(|p| Plane { offset: if p.offset == 0.75 { offset } else { p.offset }, ..p })
            .collect();
        let body = Particle::new(&planes, 0.1, 0.5, 1.0).unwrap();
        let (left, right) = (at(0.0, 0.0, 0.0), Pose::new([1.5, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]).unwrap());
        let settings = Settings::default();
        let contact = detect(&body, &left, &body, &right, &settings, None).unwrap();
        assert_eq!(contact.point.x, 0.75);
        let d = contact_derivatives(&body, &left, &body, &right, &contact, &settings).unwrap();
        assert_eq!(d.flags.contains(DerivativeFlags::SWITCHING), switches);
        assert!(d.normal.iter().all(|v| v.is_finite()));
    }
}

#[test]
fn what_has_no_derivative_is_an_error() {
    let ball = Particle::sphere(1.0).unwrap();
    let (here, far) = (at(0.0, 0.0, 0.0), at(3.0, 0.0, 0.0));
    let settings = Settings::default();
    let derive = |pose: &Pose, settings: &Settings| {
        let contact = detect(&ball, &here, &ball, pose, settings, None).unwrap();
        contact_derivatives(&ball, &here, &ball, pose, &contact, settings)
    };
    assert!(matches!(derive(&far, &settings), Err(DerivativeError::NoPoint)));
    assert!(derive(&here, &settings).is_err());
    // Separated, but solved: s, normal and point move, and the rest is not there.
    for formulation in [Formulation::Midway, Formulation::Closest] {
        let settings = settings.with_solve_separated(true).with_formulation(formulation);
        let d = derive(&far, &settings).unwrap();
        assert!(d.flags.contains(DerivativeFlags::SEPARATED) && d.overlap.iter().all(|v| v.is_nan()));
        let of_s = if formulation == Formulation::Midway { 0.5 } else { 1.0 };
        assert!((d.s[6] - of_s).abs() < 1e-12 && (d.normal[(1, 7)] - 1.0 / 3.0).abs() < 1e-12);
    }
    // A gradient of another particle.
    let (cube, pose) = (cube(0.1), at(0.0, 0.0, 0.99));
    let contact = detect(&cube, &here, &cube, &pose, &settings, None).unwrap();
    let mut shape = ShapeGradient::zeros(&ball);
    let weights = ContactWeights::default();
    let found = contact_gradient(&cube, &here, &cube, &pose, &contact, &settings, &weights, Some(&mut shape), None);
    assert!(found.unwrap_err().to_string().contains("0 planes where the particle has 6"));
}

/// At k = 0 and k = 1 the derivative in k is that towards the inside.
#[test]
fn k_at_the_ends_of_its_range_is_one_sided() {
    let h = 1e-7;
    for (k, step) in [(0.0, h), (1.0, -h)] {
        let (body, other) = (cube(k), Particle::sphere(0.5).unwrap());
        let reach = if k == 0.0 { 0.99 } else { 1.45 };
        let (here, there) = (at(0.0, 0.0, 0.0), at(0.03, 0.02, reach));
        let settings = Settings::default().with_gap_tolerance(1e-14);
        let found = |body: &Particle| detect(body, &here, &other, &there, &settings, None).unwrap();
        let contact = found(&body);
        let mut shape = ShapeGradient::zeros(&body);
        let weights = ContactWeights { s: 1.0, ..ContactWeights::default() };
        let given = Some(&mut shape);
        contact_gradient(&body, &here, &other, &there, &contact, &settings, &weights, given, None).unwrap();
        let expected = (found(&cube(k + step)).s - contact.s) / step;
        assert!((shape.k / expected - 1.0).abs() < 1e-3, "k = {k}: {} for {expected}", shape.k);
    }
}
