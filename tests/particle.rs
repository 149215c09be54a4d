//! Particles: every violation is its own error and names the value; bounds hold; derivatives match.

use nalgebra::Vector3;
use potential_particles::{
    Particle, ParticleError, PatchScratch, PatchSettings, Plane, Pose, PoseError, Settings, detect, patch_of_contact,
};

fn cube_planes(offset: f64) -> Vec<Plane> {
    (0..3).flat_map(|axis| [1.0, -1.0].map(|sign| Plane { normal: Vector3::ith(axis, sign), offset })).collect()
}

fn tetrahedron(offset: f64) -> Vec<Plane> {
    [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]]
        .map(|n| Plane { normal: Vector3::from(n) / 3f64.sqrt(), offset })
        .to_vec()
}

#[test]
fn each_violation_is_its_own_error_and_names_the_value() {
    let planes = cube_planes(0.45);
    let with = |change: &dyn Fn(&mut Vec<Plane>)| {
        let mut planes = planes.clone();
        change(&mut planes);
        Particle::new(&planes, 0.05, 0.1, 0.9).unwrap_err()
    };
    type E = ParticleError;
    let cases: Vec<(E, &str)> = vec![
        (with(&|p| p[3].offset = f64::NAN), "plane 3 is not finite"),
        (with(&|p| p[2].normal.y = f64::INFINITY), "plane 2 is not finite"),
        (with(&|p| p[4].normal = Vector3::zeros()), "plane 4 has a normal of length zero"),
        (with(&|p| p[4].normal.z = -1e-160), "plane 4 has a normal with a largest component of 1e-160: its square"),
        (with(&|p| p[4].normal.z = -1e160), "plane 4 has a normal with a largest component of 1e160: its square"),
        (
            Particle::new(
                &planes.iter().map(|p| Plane { normal: 1e100 * p.normal, offset: p.offset }).collect::<Vec<_>>(),
                1e-100,
                0.1,
                0.9,
            )
            .unwrap_err(),
            "plane 0 has a normal with a largest component of 1e100",
        ),
        (with(&|p| p[1].offset = -0.06), "plane 1 (d=-0.06)"),
        (Particle::new(&planes, 0.05, -0.1, 0.9).unwrap_err(), "k=-0.1"),
        (Particle::new(&planes, 0.05, 1.1, 0.9).unwrap_err(), "k=1.1"),
        (Particle::new(&planes, 0.05, f64::NAN, 0.9).unwrap_err(), "k=NaN"),
        (Particle::new(&planes, 0.0, 0.1, 0.9).unwrap_err(), "r=0.0"),
        (Particle::new(&planes, f64::NAN, 0.1, 0.9).unwrap_err(), "r=NaN"),
        (Particle::new(&planes, 1e-200, 0.1, 0.9).unwrap_err(), "r=1e-200"),
        (Particle::new(&planes, 0.05, 0.1, -2.0).unwrap_err(), "R=-2.0"),
        (Particle::new(&planes, 0.05, 0.1, f64::INFINITY).unwrap_err(), "R=inf"),
        (Particle::new(&planes[..5], 0.05, 0.0, 0.9).unwrap_err(), "do not enclose a volume"),
        (Particle::new(&[], 0.05, 0.0, 0.9).unwrap_err(), "do not enclose a volume"),
        (Particle::new(&vec![planes[0]; 65_537], 0.05, 0.1, 0.9).unwrap_err(), "65537 planes"),
    ];
    for (error, text) in &cases {
        assert!(error.to_string().contains(text), "{error} should contain {text}");
    }
    // Values that are dead for the given k are not looked at.
    assert!(Particle::new(&planes, f64::NAN, 1.0, 0.9).is_ok());
    assert!(Particle::new(&planes, 0.05, 0.0, f64::NAN).is_ok());
    assert!(matches!(Particle::sphere(0.0), Err(E::ShadowRadius(_))));
    assert!(matches!(Pose::at([0.0, f64::NAN, 0.0]), Err(PoseError::Position(..))));
    assert!(matches!(Pose::new([0.0; 3], [0.0; 4]), Err(PoseError::Orientation(..))));
}

/// Found by fuzzing: corners at 1e308 were lost, and the box left out the centre.
#[test]
fn a_particle_too_large_to_be_squared_is_no_particle() {
    // Only the second plane bounds it along x and −z.
    let planes = [
        [-6.0, -6.0, 0.0, 0.0],
        [0.27, 5.4, -0.6, f64::MAX],
        [0.0, -6.4, 0.0, 0.003],
        [0.0, 2.0, 2.1, 0.003],
        [-2.4e-4, 0.0, 6.3, 0.0],
        [0.0, 0.0, 0.003, 0.0],
    ];
    let planes = planes.map(Plane::from);
    assert_eq!(Particle::new(&planes, 0.0078, 0.0, 0.0).unwrap_err(), ParticleError::Unbounded);
    // As long as 1e28: still one, and its box still holds its ends.
    let mut planes = cube_planes(0.4);
    planes[0].offset = 1e140;
    assert!(matches!(Particle::new(&planes, 0.1, 0.0, 0.0), Err(ParticleError::Size { radius }) if radius >= 1e140));
    planes[0].offset = 1e28;
    let needle = Particle::new(&planes, 0.1, 0.0, 0.0).unwrap();
    let (low, high) = needle.bounding_box(&Pose::at([0.0; 3]).unwrap());
    assert!(high.x >= 1e28 && low.x <= -0.5 && low.y <= -0.5 && high.y >= 0.5, "{low} {high}");
}

/// A cube and a ball of any size that is taken have the volume, the inertia, the overlap and the patch of those of size
/// 1 in that unit of length; of others the error names the length. With faces or a radius out of range powers of
/// lengths would be 0 or infinite.
#[test]
fn what_is_made_is_right_in_any_unit_of_length() {
    for unit in [1e-200, 1e-110, 1e-80, 1e-31, 2e-30, 1e-20, 1.0, 1e20, 5e29, 1e31, 1e100, 1e150] {
        let planes: Vec<Plane> = cube_planes(0.4).iter().map(|p| Plane { offset: unit * p.offset, ..*p }).collect();
        for made in [Particle::new(&planes, 0.1 * unit, 0.0, 0.0), Particle::sphere(0.5 * unit)] {
            let is_in_range = (2e-30..1e30).contains(&unit);
            let particle = match made {
                Ok(particle) if is_in_range => particle,
                Ok(_) => panic!("{unit:e} is taken"),
                Err(error) => {
                    assert!(!is_in_range, "{unit:e}: {error}");
                    let text = error.to_string();
                    assert!(
                        text.len() <= 200 && (text.contains("1e-30") || text.contains("r=") || text.contains("R=")),
                        "{text}"
                    );
                    continue;
                }
            };
            let of_unit = particle.scaled(1.0 / unit).unwrap();
            let (mass, expected) = (particle.mass_properties(1e-6).unwrap(), of_unit.mass_properties(1e-6).unwrap());
            assert!((mass.volume / unit.powi(3) / expected.volume - 1.0).abs() < 1e-5, "{unit:e}: {mass:?}");
            assert!((mass.inertia.m11 / unit.powi(5) / expected.inertia.m11 - 1.0).abs() < 1e-5, "{unit:e}: {mass:?}");
            let patch = |particle: &Particle, unit: f64| {
                let (here, above) = (Pose::at([0.0; 3]).unwrap(), Pose::at([0.1 * unit, 0.0, 0.99 * unit]).unwrap());
                let contact = detect(particle, &here, particle, &above, &Settings::default(), None).unwrap();
                assert!((contact.overlap / unit - 0.01).abs() < 0.01, "{unit:e}: {contact:?}");
                let (settings, mut scratch) = (PatchSettings::default(), PatchScratch::new());
                patch_of_contact(particle, &here, particle, &above, &contact, &settings, &mut scratch, |_| ()).unwrap()
            };
            let (found, expected) = (patch(&particle, unit), patch(&of_unit, 1.0));
            assert!(
                (found.force / unit.powi(3) - expected.force).norm() < 1e-3 * expected.force.norm(),
                "{unit:e}: {found:?}"
            );
            assert!(
                (found.polar_moment / unit.powi(4) / expected.polar_moment - 1.0).abs() < 1e-3,
                "{unit:e}: {found:?}"
            );
        }
    }
}

/// Found by fuzzing: where all planes hide below the rounding of a point, the sphere alone put the surface at 1e29.
#[test]
fn no_surface_is_further_off_than_the_bounding_radius() {
    let particle = Particle::new(&cube_planes(0.5), 1e-17, 1e-150, 1e-16).unwrap();
    for way in [Vector3::x(), Vector3::new(0.3, 0.7, -0.2).normalize(), Vector3::new(1.0, 1.0, 1.0).normalize()] {
        let distance = particle.surface_distance(&Vector3::zeros(), &way).unwrap();
        assert!((distance * way.amax() - 0.5).abs() < 1e-12, "{distance}");
    }
}

/// Found by fuzzing: of planes that rise by 1e-193 along a ray, the slope of S was lost, and the surface lay at -1e99.
#[test]
fn a_rounding_radius_too_small_for_the_bounding_radius_is_refused() {
    let planes =
        [[1e-150, 0.0, 1e-8, 1e-150], [1e-150, 1e-8, 1e-150, 1e-150], [-1.0, 1e-150, 0.0, 1e-8]].map(Plane::from);
    let error = Particle::new(&planes, 1e-150, 1e-150, 1e-8).unwrap_err();
    assert!(
        matches!(error, ParticleError::RoundingTooSmall { r: 1e-150, radius } if (0.99e67..1.01e67).contains(&radius)),
        "{error}"
    );
    // Within the limit a plane that rises by 1e-138 along a ray bounds the particle where it should: at r/1e-138.
    let half_ball = Particle::new(&[Plane::from([0.0, 0.0, 1.0, 0.0])], 1e-140, 1e-6, 1.0).unwrap();
    let distance = half_ball.surface_distance(&Vector3::zeros(), &Vector3::new(1.0, 0.0, 1e-138)).unwrap();
    assert!((distance - 1e-2).abs() < 1e-8, "{distance:e}");
}

/// Found by fuzzing: normals of 1e150, whose planes lie 1e143 times as near as the bounding ball says; the search from
/// the ball lost the crossing, and where n·x cancels, a slope without digits led to -1e248.
#[test]
fn planes_far_nearer_than_the_bounding_radius_are_found() {
    let planes = [[1e150, 1e150, 1e150, 1.0], [1e150, 0.23, 0.0, 0.0]].map(Plane::from);
    let particle = Particle::new(&planes, 0.5, 1e-3, 1e-8).unwrap();
    let distance = |x: f64, y: f64, z: f64| {
        let way = Vector3::new(x, y, z).normalize();
        (particle.surface_distance(&Vector3::zeros(), &way).unwrap(), way)
    };
    let (along_second, way) = distance(1.0, 0.0, -1.0);
    let depth = 0.5 / (1.0 - 1e-3_f64).sqrt();
    assert!((along_second * 1e150 * way.x / depth - 1.0).abs() < 1e-12, "{along_second:e}");
    let (along_first, way) = distance(-1e-3, 1.0, 1.0);
    assert!((along_first * 1e150 * (way.x + way.y + way.z) / (1.0 + depth) - 1.0).abs() < 1e-12, "{along_first:e}");
    // Across the first normal but for rounding.
    let (across, _) = distance(-0.784_464_540_552_736_2, 0.588_348_405_414_552_1, 0.196_116_135_138_184_04);
    assert!((0.0..=particle.bounding_radius()).contains(&across), "{across:e}");
}

#[test]
fn planes_that_leave_a_way_out_are_told_from_those_that_enclose() {
    let encloses = |planes: &[Plane], scale: f64| {
        let planes: Vec<Plane> =
            planes.iter().map(|p| Plane { normal: 3.0 * p.normal, offset: 3.0 * scale * p.offset }).collect();
        Particle::new(&planes, 0.3 * scale, 0.1, 2.0 * scale).unwrap().planes_enclose()
    };
    for scale in [1e-6, 1.0, 1e6] {
        for closed in [cube_planes(0.5), cube_planes(-0.02), tetrahedron(0.4)] {
            assert!(encloses(&closed, scale), "{closed:?}");
            for missing in 0..closed.len() {
                let open: Vec<_> = (0..closed.len()).filter(|&i| i != missing).map(|i| closed[i]).collect();
                assert!(!encloses(&open, scale), "without plane {missing}: {open:?}");
            }
        }
        // A needle whose ends lie far outside the shadow sphere.
        let mut needle = cube_planes(0.2);
        needle[4].offset = 1e3;
        needle[5].offset = 1e3;
        assert!(encloses(&needle, scale));
        assert!(!encloses(&needle[..4], scale), "a prism without ends");
    }
    assert!(!Particle::sphere(1.0).unwrap().planes_enclose());
}

#[test]
fn derivatives_match_differences() {
    for (planes, k) in [(cube_planes(0.4), 0.2), (tetrahedron(0.2), 0.0), (cube_planes(0.4), 1.0)] {
        let particle = Particle::new(&planes, 0.1, k, 0.8).unwrap();
        for x in [Vector3::new(0.45, 0.1, -0.05), Vector3::new(0.47, 0.48, -0.46), Vector3::new(0.1, 0.05, 0.0)] {
            let h = 1e-5;
            for axis in 0..3 {
                let e = Vector3::ith(axis, h);
                let slope = (particle.potential(&(x + e)) - particle.potential(&(x - e))) / (2.0 * h);
                let bend = (particle.gradient(&(x + e)) - particle.gradient(&(x - e))) / (2.0 * h);
                assert!((slope - particle.gradient(&x)[axis]).abs() < 1e-6);
                assert!((bend - particle.hessian(&x).column(axis)).norm() < 1e-5);
            }
        }
    }
}

#[test]
fn the_given_normals_are_used_as_they_are() {
    // Twice the normal and offset: that plane counts four times in S.
    let mut planes = cube_planes(0.4);
    planes[0] = Plane { normal: 2.0 * planes[0].normal, offset: 0.8 };
    let particle = Particle::new(&planes, 0.1, 0.0, 0.0).unwrap();
    assert!((particle.potential(&Vector3::new(0.45, 0.0, 0.0)) + 1.0 - 1.0).abs() < 1e-14);
    assert!((particle.potential(&Vector3::new(-0.45, 0.0, 0.0)) + 1.0 - 0.25).abs() < 1e-14);
}

/// They weigh nothing, and stopped steps all the same.
#[test]
fn the_planes_of_a_sphere_are_not_looked_at() {
    let plane = |i: i32| Plane { normal: Vector3::new(f64::from(i).cos(), f64::from(i).sin(), 0.1), offset: 0.45 };
    let planes: Vec<Plane> = (0..200).map(plane).collect();
    let with = Particle::new(&planes, 1e-6, 1.0, 1.0).unwrap();
    let without = Particle::sphere(1.0).unwrap();
    assert_eq!(with.planes().collect::<Vec<_>>(), planes);
    let other = Particle::new(&tetrahedron(0.45), 1e-4, 1e-6, 0.9).unwrap();
    for i in 1..40 {
        let position = [0.03 * f64::from(i), 0.4, 0.7];
        let (here, there) = (Pose::at([0.0; 3]).unwrap(), Pose::new(position, [1.0, 0.3, f64::from(i), 0.2]).unwrap());
        let settings = Settings::default().with_solve_separated(true);
        let solved = |sphere| detect(sphere, &here, &other, &there, &settings, None).unwrap();
        let (of_with, of_without) = (solved(&with), solved(&without));
        assert_eq!(of_with.iterations, of_without.iterations, "{i}");
        assert!((of_with.s - of_without.s).abs() <= of_with.gap + of_without.gap, "{i}");
    }
}

#[test]
fn bounds_hold_every_surface_point() {
    let many: Vec<Plane> = (0..400)
        .map(|i| {
            // Golden spiral: planes all around.
            let (z, phi) = (1.0 - (2.0 * i as f64 + 1.0) / 400.0, i as f64 * 2.399963);
            let s = (1.0 - z * z).sqrt();
            Plane { normal: Vector3::new(s * phi.cos(), s * phi.sin(), z), offset: 0.4 + 0.02 * (i % 7) as f64 }
        })
        .collect();
    let mut doubled = cube_planes(0.4);
    doubled.extend(cube_planes(0.4));
    for (planes, r, k) in [
        (cube_planes(0.4), 0.1, 0.3),
        (tetrahedron(0.2), 0.01, 1e-6),
        (tetrahedron(0.2), 0.01, 0.0),
        (many, 0.05, 0.0),
        (doubled, 0.1, 0.0),
    ] {
        let particle = Particle::new(&planes, r, k, 0.9).unwrap();
        let pose = Pose::new([1.0, 2.0, 3.0], [0.3, -0.4, 0.5, 0.6]).unwrap();
        let (lower, upper) = particle.bounding_box(&pose);
        let mut fullest: f64 = 0.0;
        for i in 0..2000 {
            let (z, phi) = (1.0 - (2.0 * i as f64 + 1.0) / 2000.0, i as f64 * 2.399963);
            let s = (1.0 - z * z).sqrt();
            let e = Vector3::new(s * phi.cos(), s * phi.sin(), z);
            let x = particle.surface_distance(&Vector3::zeros(), &e).unwrap() * e;
            assert!(particle.potential(&x).abs() < 1e-9 / r);
            assert!(x.norm() <= particle.bounding_radius());
            let world = pose.position() + pose.rotate(&x);
            assert!((0..3).all(|axis| lower[axis] <= world[axis] && world[axis] <= upper[axis]));
            assert!(x.dot(&e) <= particle.support(&e).unwrap());
            fullest = fullest.max(x.norm());
        }
        assert!(particle.bounding_radius() < 2.0 * fullest, "a ball of {} for {fullest}", particle.bounding_radius());
    }
}

#[test]
fn directions_have_any_length() {
    // A cube of half edge 0.5.
    let cube = Particle::new(&cube_planes(0.45), 0.05, 0.0, 1.0).unwrap();
    for length in [1.0, 0.1, 2.0, 1e-300, 1e300, 5e-324] {
        let x = length * Vector3::x();
        assert!((cube.surface_distance(&Vector3::zeros(), &x).unwrap() - 0.5).abs() < 1e-14);
        assert!((cube.surface_distance(&Vector3::new(0.25, 0.0, 0.0), &x).unwrap() - 0.25).abs() < 1e-14);
        assert_eq!(cube.support(&x), cube.support(&Vector3::x()));
    }
    for none in [Vector3::zeros(), Vector3::new(f64::NAN, 0.0, 1.0), Vector3::new(f64::INFINITY, 0.0, 0.0)] {
        assert_eq!((cube.support(&none), cube.surface_distance(&Vector3::zeros(), &none)), (None, None));
    }
}
