//! Mass properties against sums over points by the definition of S; closed forms of random bodies are in
//! `kit/src/stress/mass.rs`.

use nalgebra::{Matrix3, Rotation3, Vector3};
use potential_particles::{Particle, Plane};

/// The planes of a cube of edge 1, turned, and moved in by r.
fn cube_planes(r: f64, turn: &Rotation3<f64>) -> Vec<Plane> {
    (0..3)
        .flat_map(|axis| [1.0, -1.0].map(|sign| Plane { normal: turn * Vector3::ith(axis, sign), offset: 0.5 - r }))
        .collect()
}

/// Sums over the points of a grid where S ≤ 1, with nothing of rays or meshes: fine enough to tell errors of some 1e-4.
#[test]
fn any_shape_is_what_its_definition_says() {
    let mut state = 7_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    for case in 0..6 {
        let planes: Vec<Plane> = (0..9 + 3 * case)
            .map(|_| {
                let normal =
                    Vector3::from_fn(|_, _| random() + random() + random() - 1.5).normalize() * (0.5 + random());
                Plane { normal, offset: normal.norm() * (0.5 + 0.3 * random()) }
            })
            .collect();
        let particle = Particle::new(&planes, [0.01, 0.1, 0.3][case % 3], [0.02, 0.4][case % 2], 0.9).unwrap();
        let found = particle.mass_properties(1e-6).unwrap();
        assert!(found.error <= 1e-6);
        let (cells, reach) = (120, particle.bounding_radius());
        let step = 2.0 * reach / cells as f64;
        let (mut count, mut first, mut second) = (0.0, Vector3::zeros(), Matrix3::zeros());
        let place = |i: usize| (i as f64 + 0.5) * step - reach;
        for i in 0..cells {
            for j in 0..cells {
                for l in 0..cells {
                    let x = Vector3::new(place(i), place(j), place(l));
                    if particle.potential(&x) <= 0.0 {
                        count += 1.0;
                        first += x;
                        second += x * x.transpose();
                    }
                }
            }
        }
        let cell = step.powi(3);
        let inertia = cell * (Matrix3::from_diagonal_element(second.trace()) - second);
        assert!((found.volume / (count * cell) - 1.0).abs() < 3e-4, "case {case}: volume");
        assert!((found.centroid - first / count).norm() < 3e-4 * reach, "case {case}: centroid");
        assert!((found.inertia - inertia).norm() < 5e-4 * inertia.norm(), "case {case}: inertia");
    }
}

#[test]
fn planes_given_twice_count_once() {
    let r = 1e-4;
    let single = cube_planes(r, &Rotation3::identity());
    let volume = Particle::new(&single, r, 0.0, 0.0).unwrap().mass_properties(1e-8).unwrap().volume;
    for angle in [0.0, 1e-15, 1e-12, 1e-9, 1e-7] {
        let mut twice = single.clone();
        let turn = Rotation3::from_euler_angles(angle, -angle, angle);
        twice.extend(cube_planes(r, &turn));
        let particle = Particle::new(&twice, r, 0.0, 0.0).unwrap();
        assert_eq!(particle.planes().collect::<Vec<_>>(), single, "{angle:e}");
        let found = particle.mass_properties(1e-6).unwrap();
        assert!((found.volume / volume - 1.0).abs() < 1e-6, "{angle:e}: {found:?}");
    }
    // At a larger angle both are faces.
    let mut both = single.clone();
    both.extend(cube_planes(r, &Rotation3::from_euler_angles(1e-5, 0.0, 0.0)));
    assert!(Particle::new(&both, r, 0.0, 0.0).unwrap().plane_count() > 6);
}
