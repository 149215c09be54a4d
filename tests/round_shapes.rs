//! The size of round bodies, against closed forms.

use nalgebra::Vector3;
use potential_particles::SurfaceMesh;
use potential_particles::shapes::{self, Rounding, Shape};
use std::f64::consts::{PI, TAU};

/// Directions spread evenly over the sphere: Fibonacci's spiral.
fn directions(count: usize) -> impl Iterator<Item = Vector3<f64>> {
    (0..count).map(move |i| {
        let z = 1.0 - (2 * i + 1) as f64 / count as f64;
        let (sin, cos) = (PI * (3.0 - 5f64.sqrt()) * i as f64).sin_cos();
        let across = (1.0 - z * z).sqrt();
        Vector3::new(across * cos, across * sin, z)
    })
}

/// Where a ray from the origin of the builder's frame leaves a shape.
fn reach(shape: &Shape, ray: &Vector3<f64>) -> f64 {
    let pose = shape.pose();
    let along = pose.rotation().tr_mul(ray);
    shape.particle.surface_distance(&pose.to_local(&Vector3::zeros()), &along).unwrap()
}

fn within(found: f64, right: f64, share: f64, what: &str) {
    assert!((found / right - 1.0).abs() <= share, "{what}: {found}, not {right}, by {:e}", found / right - 1.0);
}

/// Whatever the number of sides, and whether r is small or large beside them: the volume is that of the cylinder but
/// for its rim, the height is kept, and from 24 sides on all diameters are.
#[test]
fn cylinders_keep_their_size() {
    for (sides, radius, height, share) in [
        (3, 0.05, 0.1, 0.05),
        (8, 0.05, 0.1, 0.05),
        (24, 0.05, 0.1, 0.05),
        (32, 0.3, 2.0, 0.05),
        (48, 0.05, 0.1, 0.05),
        (48, 1.0, 0.1, 0.05),
        (48, 0.05, 0.1, 0.2),
        (48, 0.05, 0.1, 1e-3),
        (256, 0.05, 0.1, 0.05),
        (1000, 0.05, 0.1, 0.05),
    ] {
        let shape = shapes::cylinder(radius, height, sides, &Rounding::new(share, 0.0)).unwrap();
        let what = format!("{sides} sides, {share} of the size");
        let volume = PI * radius * radius * height;
        assert_eq!(shape.sharp_volume, volume, "{what}");
        // At most a quarter of a disc in place of a square is lost, all along both rims.
        let r = shape.particle.rounding_radius();
        let rims = 2.0 * TAU * radius * (1.0 - PI / 4.0) * r * r;
        let found = shape.mass.volume;
        assert!(found > 0.998 * (volume - rims) && found < 1.001 * volume, "{what}: {found}, not {volume}");
        within(reach(&shape, &Vector3::z()), 0.5 * height, 1e-6, &what);
        for turn in (0..200).filter(|_| sides >= 24) {
            let (sin, cos) = (f64::from(turn) * 0.7).sin_cos();
            let diameter = reach(&shape, &Vector3::new(cos, sin, 0.0)) + reach(&shape, &Vector3::new(-cos, -sin, 0.0));
            within(diameter, 2.0 * radius, if sides == 24 { 4e-3 } else { 2e-3 }, &what);
        }
    }
}

/// Exact: their surfaces, and what is known of them in closed form, which the particle's own integrals have too.
#[test]
fn ellipsoids_and_capsules_are_exact() {
    for axes in [[1.0, 1.0, 1.0], [1.0, 0.7, 0.5], [0.02, 3.0, 0.4]] {
        let shape = shapes::ellipsoid(axes).unwrap();
        for ray in directions(300) {
            let right = ray.component_div(&Vector3::from(axes)).norm().recip();
            within(reach(&shape, &ray), right, 1e-13, "ellipsoid");
        }
        let found = shape.particle.mass_properties(1e-7).unwrap();
        within(found.volume, shape.mass.volume, 1e-7, "its volume");
        assert!((found.inertia - shape.mass.inertia).amax() < 1e-7 * found.inertia.amax(), "its inertia");
    }
    for (radius, length) in [(0.5, 1.0), (0.1, 3.0), (2.0, 0.01)] {
        let shape = shapes::capsule(radius, length).unwrap();
        for ray in directions(300) {
            let at = reach(&shape, &ray) * ray;
            let beyond = (at.z.abs() - 0.5 * length).max(0.0);
            within(at.x.hypot(at.y).hypot(beyond), radius, 1e-13, "capsule");
        }
        let found = shape.particle.mass_properties(1e-7).unwrap();
        within(found.volume, shape.mass.volume, 1e-7, "its volume");
        assert!((found.inertia - shape.mass.inertia).amax() < 1e-7 * found.inertia.amax(), "its inertia");
    }
    assert!(shapes::ellipsoid([1.0, 0.0, 1.0]).unwrap_err().to_string().contains("semi-axis y=0.0"));
    assert!(shapes::capsule(1.0, f64::NAN).unwrap_err().to_string().contains("length=NaN"));
}

#[test]
fn cones_keep_their_size() {
    for (radius, height) in [(0.5, 1.0), (1.0, 0.3), (0.1, 2.0)] {
        let shape = shapes::cone(radius, height, shapes::SIDES, &Rounding::chosen(0.02)).unwrap();
        within(shape.mass.volume, PI * radius * radius * height / 3.0, 5e-3, "its volume");
        let mesh = SurfaceMesh::of(&shape.particle, 1e-4).unwrap();
        let extent = |ray: Vector3<f64>| {
            let along = shape.pose().rotation().tr_mul(&ray);
            let heights = || mesh.vertices.iter().map(|at| at.dot(&along));
            heights().fold(f64::NEG_INFINITY, f64::max) - heights().fold(f64::INFINITY, f64::min)
        };
        within(extent(Vector3::z()), height, 2e-3, "its height");
        for turn in 0..20 {
            let (sin, cos) = (f64::from(turn) * 0.7).sin_cos();
            within(extent(Vector3::new(cos, sin, 0.0)), 2.0 * radius, 3e-3, "its base");
        }
    }
}

/// Points of an ellipsoid, as few planes and as many: the volume of the hull, and diameters within 0.2 % of its own; of
/// the thinnest, most of them.
#[test]
fn fitted_scans_keep_their_size() {
    for (axes, planes, mean, most) in [
        ([1.0, 1.0, 1.0], 60, 4e-4, 1.5e-3),
        ([1.0, 0.7, 0.5], 60, 6e-4, 2e-3),
        ([1.0, 0.5, 0.3], 60, 1.2e-3, 3e-3),
        ([1.0, 0.7, 0.5], 200, 6e-4, 2e-3),
    ] {
        let volume = 4.0 / 3.0 * PI * axes.iter().product::<f64>();
        let points: Vec<[f64; 3]> =
            directions(1500).map(|at| (at.component_mul(&Vector3::from(axes)) + Vector3::repeat(3.0)).into()).collect();
        let shape = shapes::fitted(&points, planes, &Rounding::chosen(0.02)).unwrap();
        assert!(shape.particle.plane_count() <= planes);
        within(shape.mass.volume, volume, 5e-3, "its volume");
        within(shape.mass.volume, shape.sharp_volume, 1e-12, "that of the hull");
        let middle = shape.pose().to_local(&Vector3::repeat(3.0));
        let off = |ray: Vector3<f64>| {
            let along = shape.pose().rotation().tr_mul(&ray);
            let both = [along, -along].map(|ray| shape.particle.surface_distance(&middle, &ray).unwrap());
            let right = 2.0 * ray.component_div(&Vector3::from(axes)).norm().recip();
            both.iter().sum::<f64>() / right - (shape.sharp_volume / volume).cbrt()
        };
        let squares: Vec<f64> = directions(1000).map(|ray| off(ray).powi(2)).collect();
        let found = (squares.iter().sum::<f64>() / squares.len() as f64).sqrt();
        let largest = squares.iter().fold(0.0f64, |a, b| a.max(*b)).sqrt();
        assert!(found < mean && largest < most, "diameters of {axes:?} are off by {found:e}, at most {largest:e}");
    }
}

/// With the exponents of an ellipsoid it is one; the volume of others is that of their rays.
#[test]
fn superquadrics_keep_their_volume() {
    let axes = [1.0, 0.8, 0.6];
    for [n, e] in [[1.0, 1.0], [0.3, 0.3], [0.5, 1.0], [1.5, 1.7]] {
        let shape = shapes::superquadric(axes, [n, e], shapes::SIDES, &Rounding::chosen(0.02)).unwrap();
        let count = 200_000;
        let cubes = directions(count).map(|ray| {
            let across = ray.x.abs().powf(2.0 / e) + ray.y.abs().powf(2.0 / e);
            (across.powf(e / n) + ray.z.abs().powf(2.0 / n)).powf(-1.5 * n)
        });
        let volume = 4.0 / 3.0 * PI * cubes.sum::<f64>() / count as f64 * axes.iter().product::<f64>();
        within(shape.mass.volume, volume, 1e-3, &format!("{n}, {e}"));
        assert!(shape.particle.plane_count() <= shapes::SIDES);
    }
}

/// The hull of many points of an ellipsoid: every face is touched to 0.1 %, none is passed, and the volume is that of
/// the hull, with few faces and with many.
#[test]
fn hulls_of_round_bodies_touch_their_faces() {
    for (count, share) in [(250, 0.02), (600, 0.01)] {
        let axes = Vector3::new(1.0, 0.7, 0.5);
        let points: Vec<[f64; 3]> = directions(count).map(|at| at.component_mul(&axes).into()).collect();
        let shape = shapes::hull(&points, &Rounding::default()).unwrap();
        within(shape.mass.volume, shape.sharp_volume, share, &format!("{count} points"));
        let (middle, planes) = potential_particles::internals::sharp_hull(&points).unwrap();
        for ray in directions(500) {
            let at = reach(&shape, &ray) * ray - middle;
            let beyond =
                planes.iter().map(|plane| plane.normal.dot(&at) - plane.offset).fold(f64::NEG_INFINITY, f64::max);
            assert!(beyond < 1e-9, "{beyond:e} outside of the hull");
        }
    }
}
