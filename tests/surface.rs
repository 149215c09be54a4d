//! The surface mesh against the definition of the particle: closed, inside, and as close as it says.

use potential_particles::{MeshError, Particle, Plane, SurfaceMesh};
use std::collections::HashMap;

type Vector = nalgebra::Vector3<f64>;

fn particle(faces: &[[f64; 3]], r: f64, k: f64) -> Particle {
    let planes: Vec<Plane> =
        faces.iter().map(|&face| Plane { normal: Vector::from(face).normalize(), offset: 1.0 - r }).collect();
    Particle::new(&planes, r, k, 1.8).unwrap()
}

const CUBE: [[f64; 3]; 6] =
    [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
/// Four faces meet in its apex, which lies on no axis.
const PYRAMID: [[f64; 3]; 5] = [[2.0, 0.1, 1.0], [-2.0, 0.3, 0.9], [0.2, 2.0, 1.1], [0.0, -2.0, 1.0], [0.1, 0.2, -1.0]];
/// Fifty faces in all directions.
fn gem() -> Vec<[f64; 3]> {
    (0..50)
        .map(|i| {
            let (z, angle) = (1.0 - (2.0 * f64::from(i) + 1.0) / 50.0, 2.4 * f64::from(i));
            let flat = (1.0 - z * z).sqrt();
            [flat * angle.cos(), flat * angle.sin(), z]
        })
        .collect()
}

fn bodies() -> Vec<(String, Particle)> {
    let mut all = vec![("sphere".to_string(), Particle::sphere(3.0).unwrap())];
    for (name, faces) in [("cube", CUBE.to_vec()), ("pyramid", PYRAMID.to_vec()), ("gem", gem())] {
        for (r, k) in [(0.2, 0.0), (0.2, 0.4), (0.05, 0.01), (1e-3, 1e-3), (1e-6, 0.0), (1e-6, 1e-6)] {
            all.push((format!("{name} r={r} k={k}"), particle(&faces, r, k)));
        }
    }
    // Distances of the faces along +x, -x, +y, -y, +z, -z: a needle, a plate, a cube with its centre near a corner.
    for (name, distances, r) in [
        ("needle", [20.0, 20.0, 0.5, 0.5, 0.5, 0.5], 0.05),
        ("plate", [5.0, 5.0, 5.0, 5.0, 0.05, 0.05], 0.01),
        ("corner", [1.98, 0.02, 1.98, 0.02, 1.98, 0.02], 1e-3),
    ] {
        let planes: Vec<Plane> = CUBE
            .iter()
            .zip(distances)
            .map(|(&normal, distance)| Plane { normal: normal.into(), offset: distance - r })
            .collect();
        for k in [0.0, 1e-3] {
            all.push((format!("{name} r={r} k={k}"), Particle::new(&planes, r, k, 30.0).unwrap()));
        }
    }
    all
}

/// Every edge is met twice, once each way round, and corners − edges + triangles = 2.
fn assert_closed(name: &str, mesh: &SurfaceMesh) {
    let mut edges: HashMap<(u32, u32), u32> = HashMap::new();
    for [a, b, c] in &mesh.triangles {
        for edge in [(*a, *b), (*b, *c), (*c, *a)] {
            *edges.entry(edge).or_default() += 1;
        }
    }
    assert!(edges.iter().all(|((a, b), count)| *count == 1 && edges.contains_key(&(*b, *a))), "{name}");
    assert_eq!(mesh.vertices.len() + mesh.triangles.len(), edges.len() / 2 + 2, "{name}");
}

/// Distance of a point from a triangle, by its nearest point (Ericson, Real-Time Collision Detection, 5.1.5).
fn distance(p: &Vector, [a, b, c]: [&Vector; 3]) -> f64 {
    let on_segment = |from: &Vector, to: &Vector| {
        let along = to - from;
        let t = ((p - from).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
        (p - (from + t * along)).norm()
    };
    let normal = (b - a).cross(&(c - a));
    let inside =
        [(a, b), (b, c), (c, a)].iter().all(|(from, to)| normal.dot(&(*to - *from).cross(&(p - *from))) >= 0.0);
    let sides = on_segment(a, b).min(on_segment(b, c)).min(on_segment(c, a));
    if inside { sides.min(((p - a).dot(&normal) / normal.norm()).abs()) } else { sides }
}

/// The largest distance from surface points above each triangle to that triangle, over a grid of rays.
fn measured(body: &Particle, mesh: &SurfaceMesh, fineness: i32) -> f64 {
    let mut largest: f64 = 0.0;
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|corner| &mesh.vertices[corner as usize]);
        for i in 0..=fineness {
            for j in 0..=fineness - i {
                let k = fineness - i - j;
                let below = f64::from(i) * a + f64::from(j) * b + f64::from(k) * c;
                let direction = below.normalize();
                let surface = body.surface_distance(&Vector::zeros(), &direction).unwrap() * direction;
                largest = largest.max(distance(&surface, [a, b, c]));
            }
        }
    }
    largest
}

#[test]
fn it_is_closed_inside_and_as_close_as_it_says() {
    for (name, body) in bodies() {
        for tolerance in [0.1, 1e-2, 1e-3] {
            let mesh = SurfaceMesh::of(&body, tolerance).unwrap();
            let name = format!("{name}, tolerance {tolerance}");
            assert_closed(&name, &mesh);
            assert!(mesh.error <= tolerance * body.bounding_radius(), "{name}: {}", mesh.error);
            let rounding = 1e-12 * body.bounding_radius();
            let found = measured(&body, &mesh, 6);
            assert!(found <= mesh.error + rounding, "{name}: measured {found:e}, stated {:e}", mesh.error);
            // One rounding of the point, over the radius of the bends there.
            let bend = if body.plane_count() > 0 { body.rounding_radius() } else { body.shadow_radius() };
            let turn = 1e-14 * body.bounding_radius() / bend;
            for (vertex, normal) in mesh.vertices.iter().zip(&mesh.normals) {
                let gradient = body.gradient(vertex);
                // s changes by one rounding of the point times |∇s|.
                assert!(body.potential(vertex).abs() <= 1e-12 * gradient.norm() * body.bounding_radius(), "{name}");
                assert!((gradient.normalize() - normal).norm() < turn, "{name}");
            }
            for triangle in &mesh.triangles {
                let [a, b, c] = triangle.map(|corner| &mesh.vertices[corner as usize]);
                assert!(a.dot(&b.cross(c)) > 0.0, "{name}: a triangle faces the centre");
            }
        }
    }
}

/// The volume tends to that of the body, which is known.
#[test]
fn volume_of_the_mesh_tends_to_that_of_the_body() {
    let volume = |mesh: &SurfaceMesh| -> f64 {
        let cone = |[a, b, c]: [&Vector; 3]| a.dot(&b.cross(c)) / 6.0;
        mesh.triangles.iter().map(|t| cone(t.map(|corner| &mesh.vertices[corner as usize]))).sum()
    };
    let sphere = SurfaceMesh::of(&Particle::sphere(1.0).unwrap(), 1e-3).unwrap();
    let missing = 1.0 - volume(&sphere) / (4.0 / 3.0 * std::f64::consts::PI);
    assert!(missing > 0.0 && missing < 3e-3, "{missing}");
    let cube = SurfaceMesh::of(&particle(&CUBE, 1e-6, 0.0), 1e-3).unwrap();
    assert!((volume(&cube) - 8.0).abs() < 1e-4, "{}", volume(&cube));
}

/// An edge sharper than the tolerance costs no more than its corners: as many triangles as the polyhedron has, or few
/// more.
#[test]
fn sharp_bodies_need_few_triangles() {
    assert_eq!(SurfaceMesh::of(&particle(&CUBE, 1e-6, 0.0), 1e-3).unwrap().triangles.len(), 24);
    let pyramid = SurfaceMesh::of(&particle(&PYRAMID, 1e-6, 0.0), 1e-3).unwrap();
    assert!(pyramid.triangles.len() < 100, "{}", pyramid.triangles.len());
}

/// Normals of lengths from 1e-40 to 1e40 leave a mesh that is closed and says how far off it is, or none; either ends
/// soon.
#[test]
fn normals_of_any_length_end_at_the_most_vertices() {
    let mut state = 3_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let (tolerance, mut most) = (1e-3, 0);
    for _ in 0..40 {
        let planes: Vec<Plane> = (0..12)
            .map(|_| {
                let normal = Vector::from_fn(|_, _| random() + random() + random() - 1.5).normalize();
                let length = 10f64.powf(40.0 * (2.0 * random() - 1.0));
                Plane { normal: length * normal, offset: length * (0.8 + 0.2 * random()) }
            })
            .collect();
        let Ok(body) = Particle::new(&planes, 10f64.powf(-9.0 * random()), 0.0, 1.0) else { continue };
        if let Ok(mesh) = SurfaceMesh::of(&body, tolerance) {
            assert_closed("normals of any length", &mesh);
            let count = mesh.vertices.len();
            assert!(count < 51_000 || mesh.error > tolerance * body.bounding_radius(), "{count}, {}", mesh.error);
            most = most.max(count);
        }
    }
    assert_eq!(most, 51_000);
}

#[test]
fn a_tolerance_out_of_range_is_refused() {
    let sphere = Particle::sphere(1.0).unwrap();
    for tolerance in [0.0, -1.0, 1e-6, 1.5, f64::NAN, f64::INFINITY] {
        let error = SurfaceMesh::of(&sphere, tolerance).unwrap_err();
        assert!(matches!(error, MeshError::Tolerance(_)) && error.to_string().contains("[1e-5, 1]"), "{error}");
    }
}

/// Prints the table of docs/output.md: cargo test --release --test surface -- --ignored --nocapture
#[test]
#[ignore = "a table for the documentation"]
fn table() {
    for (name, body) in bodies() {
        for tolerance in [1e-1, 1e-2, 1e-3, 1e-4] {
            let start = std::time::Instant::now();
            let mesh = SurfaceMesh::of(&body, tolerance).unwrap();
            let seconds = start.elapsed().as_secs_f64();
            let radius = body.bounding_radius();
            let found = measured(&body, &mesh, 4) / radius;
            let (stated, count) = (mesh.error / radius, mesh.triangles.len());
            println!(
                "{name:24} {tolerance:.0e}: {count:8} triangles, bound {stated:.1e}, measured {found:.1e}, {seconds:.2e} s"
            );
        }
    }
}
