//! Mass properties of space and of the plane against closed forms, and against sums over points by the definition of S.

use nalgebra::{Matrix3, Rotation3, Vector2, Vector3};
use potential_particles::{MassProperties, Particle, Plane};
use std::f64::consts::PI;

/// Signs along each axis.
const SIGNS: [f64; 2] = [1.0, -1.0];

/// The planes of a cuboid about `centre`, turned, and moved in by r.
fn cuboid_planes(half: [f64; 3], r: f64, turn: &Rotation3<f64>, centre: Vector3<f64>) -> Vec<Plane> {
    (0..3)
        .flat_map(|axis| {
            SIGNS.map(|sign| {
                let normal = turn * Vector3::ith(axis, sign);
                Plane { normal, offset: half[axis] - r + normal.dot(&centre) }
            })
        })
        .collect()
}

/// Volume and ∫x xᵀ of a cuboid whose edges and corners are rounded by r: the Minkowski sum of a box with half edges a
/// and a ball.
///
/// It is the sum over slabs of the box times parts of a ball (Steiner): with s_i the part of the ball's coordinate i,
/// x_i = a_i sign + s_i outside the box. Each integral is one over the box' own coordinates times one over a ball of
/// the dimension left.
fn steiner(a: [f64; 3], r: f64) -> (f64, [f64; 3]) {
    let (mut volume, mut second) = (0.0, [0.0; 3]);
    for outside in 0..8_u32 {
        let free: Vec<usize> = (0..3).filter(|axis| outside >> axis & 1 == 1).collect();
        let boxed: f64 = (0..3).filter(|axis| !free.contains(axis)).map(|axis| 2.0 * a[axis]).product();
        // Volume, ∫|s_i| and ∫s_i² of the whole ball of that dimension; both signs of each free axis together make it
        // whole.
        let (ball, first, square) = match free.len() {
            0 => (1.0, 0.0, 0.0),
            1 => (2.0 * r, r * r, 2.0 * r.powi(3) / 3.0),
            2 => (PI * r * r, 4.0 * r.powi(3) / 3.0, PI * r.powi(4) / 4.0),
            _ => (4.0 * PI * r.powi(3) / 3.0, PI * r.powi(4) / 2.0, 4.0 * PI * r.powi(5) / 15.0),
        };
        volume += boxed * ball;
        for axis in 0..3 {
            second[axis] += boxed
                * if free.contains(&axis) {
                    a[axis] * a[axis] * ball + 2.0 * a[axis] * first + square
                } else {
                    a[axis] * a[axis] / 3.0 * ball
                };
        }
    }
    (volume, second)
}

/// Checks volume, centroid and inertia about the origin against those about `centre` with ∫x xᵀ =
/// turn·diag(second)·turnᵀ, in the measure in which `error` is documented, and that `error` is no less than what is
/// found.
fn assert_near(
    found: &MassProperties,
    volume: f64,
    second: [f64; 3],
    turn: &Rotation3<f64>,
    centre: Vector3<f64>,
    tolerance: f64,
) {
    let second = turn.matrix() * Matrix3::from_diagonal(&second.into()) * turn.matrix().transpose()
        + volume * centre * centre.transpose();
    let inverse = (second / volume).cholesky().unwrap().l().try_inverse().unwrap();
    let found_second = Matrix3::from_diagonal_element(0.5 * found.inertia.trace()) - found.inertia;
    let errors = [
        (found.volume / volume - 1.0).abs(),
        (inverse * (found.centroid - centre)).norm(),
        (inverse * (found_second - second) * inverse.transpose() / volume).norm(),
    ];
    let rounding = 1e-13;
    assert!(found.error <= tolerance, "error {:e} for {tolerance:e}", found.error);
    for (what, error) in ["volume", "centroid", "inertia"].into_iter().zip(errors) {
        assert!(error <= found.error + rounding, "{what}: off by {error:e}, said {:e}", found.error);
    }
}

#[test]
fn rounded_cuboids_are_those_of_steiner() {
    let turn = Rotation3::from_euler_angles(0.3, -0.7, 1.1);
    for half in [[0.5, 0.6, 0.7], [1.0, 1.0, 1.0], [100.0, 1.0, 0.1]] {
        for share in [1e-8, 1e-6, 1e-4, 1e-2, 0.1, 0.5, 0.99] {
            let r = share * half.into_iter().fold(f64::INFINITY, f64::min);
            let (volume, second) = steiner(half.map(|h| h - r), r);
            for (centre, tolerance) in
                [(Vector3::zeros(), 1e-6), (Vector3::new(0.05, -0.2, 0.1) * half[2], 1e-5), (Vector3::zeros(), 1e-8)]
            {
                let particle = Particle::new(&cuboid_planes(half, r, &turn, centre), r, 0.0, 0.0).unwrap();
                assert_near(&particle.mass_properties(tolerance).unwrap(), volume, second, &turn, centre, tolerance);
            }
        }
    }
}

#[test]
fn spheres_by_planes_that_do_not_count() {
    let (radius, none) = (2.0_f64, Rotation3::identity());
    let volume = 4.0 / 3.0 * PI * radius.powi(3);
    let far = cuboid_planes([5.0; 3], 0.1, &none, Vector3::zeros());
    for (planes, k, shadow) in [(&[][..], 1.0, radius), (&far[..], 1.0, radius), (&far[..], 0.25, 0.5 * radius)] {
        for tolerance in [1e-3, 1e-6, 1e-10] {
            let found = Particle::new(planes, 0.1, k, shadow).unwrap().mass_properties(tolerance).unwrap();
            assert_near(&found, volume, [volume * radius * radius / 5.0; 3], &none, Vector3::zeros(), tolerance);
        }
    }
}

/// With all offsets 0, S = x·A·x in each octant: planes n and −n together give ⟨n·x⟩² + ⟨−n·x⟩² = (n·x)², an ellipsoid.
#[test]
fn ellipsoids() {
    let turn = Rotation3::from_euler_angles(1.0, 0.2, -0.4);
    for (weights, k) in
        [([1.0, 2.0, 3.0], 0.1), ([0.1, 1.0, 10.0], 0.0), ([1.0, 1.0, 1.0], 0.9), ([0.02, 0.5, 1.0], 0.5)]
    {
        let (r, shadow) = (1.0, 1.5);
        let planes: Vec<Plane> = (0..3)
            .flat_map(|axis| {
                SIGNS.map(|sign| Plane { normal: turn * Vector3::ith(axis, sign * weights[axis]), offset: 0.0 })
            })
            .collect();
        let axes = weights.map(|w| 1.0 / (w * w * (1.0 - k) / (r * r) + k / (shadow * shadow)).sqrt());
        let volume = 4.0 / 3.0 * PI * axes.iter().product::<f64>();
        let found = Particle::new(&planes, r, k, shadow).unwrap().mass_properties(1e-7).unwrap();
        assert_near(&found, volume, axes.map(|a| volume * a * a / 5.0), &turn, Vector3::zeros(), 1e-7);
    }
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
    let single = cuboid_planes([0.5; 3], r, &Rotation3::identity(), Vector3::zeros());
    let (volume, _) = steiner([0.5 - r; 3], r);
    for angle in [0.0, 1e-15, 1e-12, 1e-9, 1e-7] {
        let mut twice = single.clone();
        let turn = Rotation3::from_euler_angles(angle, -angle, angle);
        twice.extend(cuboid_planes([0.5; 3], r, &turn, Vector3::zeros()));
        let particle = Particle::new(&twice, r, 0.0, 0.0).unwrap();
        assert_eq!(particle.planes().collect::<Vec<_>>(), single, "{angle:e}");
        let found = particle.mass_properties(1e-6).unwrap();
        assert!((found.volume / volume - 1.0).abs() < 1e-6, "{angle:e}: {found:?}");
    }
    // At a larger angle both are faces.
    let mut both = single.clone();
    both.extend(cuboid_planes([0.5; 3], r, &Rotation3::from_euler_angles(1e-5, 0.0, 0.0), Vector3::zeros()));
    assert!(Particle::new(&both, r, 0.0, 0.0).unwrap().plane_count() > 6);
}

#[test]
fn a_finer_tolerance_gives_a_smaller_error() {
    let planes = cuboid_planes([0.5, 0.6, 0.7], 0.1, &Rotation3::identity(), Vector3::zeros());
    let particle = Particle::new(&planes, 0.1, 0.3, 1.05).unwrap();
    let best = particle.mass_properties(1e-9).unwrap();
    for tolerance in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7] {
        let found = particle.mass_properties(tolerance).unwrap();
        let off = (found.volume / best.volume - 1.0).abs();
        assert!(
            found.error <= tolerance && off <= found.error + best.error,
            "{tolerance:e}: off by {off:e}, said {:e}",
            found.error
        );
    }
}

fn rectangle(half: [f64; 2], r: f64, centre: Vector2<f64>) -> Particle {
    let lines = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]]
        .map(|n| [n[0], n[1], half[usize::from(n[0] == 0.0)] - r + Vector2::from(n).dot(&centre)]);
    Particle::in_plane(&lines, r, 0.0, 1.0).unwrap()
}

#[test]
fn rounded_rectangles_and_circles_in_the_plane() {
    for (half, centre) in [([0.5, 0.7], Vector2::zeros()), ([0.5, 50.0], Vector2::new(0.1, 3.0))] {
        for r in [1e-8, 1e-5, 1e-2, 0.2] {
            let [a, b] = half.map(|h| h - r);
            let area = 4.0 * a * b + 4.0 * r * (a + b) + PI * r * r;
            // Rectangle, the slabs beside it, and the quarters of a circle.
            let second = |a: f64, b: f64| {
                let beyond = 2.0 * (2.0 * b) * (a * a * r + a * r * r + r.powi(3) / 3.0);
                let corners = PI * r * r * a * a + 2.0 * a * 4.0 * r.powi(3) / 3.0 + PI * r.powi(4) / 4.0;
                4.0 * a * b * a * a / 3.0 + 4.0 * a * r * a * a / 3.0 + beyond + corners
            };
            let found = rectangle(half, r, centre).mass_properties(1e-8).unwrap();
            assert!(
                found.error <= 1e-8 && (found.volume / area - 1.0).abs() <= found.error + 1e-13,
                "{found:?} for {area}"
            );
            assert!((found.centroid.xy() - centre).norm() <= 2e-8 * half[1]);
            let about_centre =
                [found.inertia.m22 - area * centre.x * centre.x, found.inertia.m11 - area * centre.y * centre.y];
            for (found, second) in about_centre.into_iter().zip([second(a, b), second(b, a)]) {
                assert!((found / second - 1.0).abs() < 2e-8 * (1.0 + centre.norm_squared()), "{found} for {second}");
            }
        }
    }
    let circle = Particle::in_plane(&[], 0.0, 1.0, 3.0).unwrap().mass_properties(1e-12).unwrap();
    assert!((circle.volume / (9.0 * PI) - 1.0).abs() < 1e-13 && circle.centroid.norm() < 1e-13);
    assert!((circle.inertia.m33 / (81.0 * PI / 2.0) - 1.0).abs() < 1e-12);
}
