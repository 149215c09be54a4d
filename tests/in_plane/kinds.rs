//! Particles in the plane in every call that takes a particle: answered there, or refused with the remedy.

use crate::body::{Body, circle, rectangle};
use nalgebra::{Matrix3, Vector3};
use potential_particles::packing::{PackError, Sizes, Supply};
use potential_particles::{
    Contact, ContactDerivatives, ContactWeights, DetectError, Formulation, InPlaneError, Kind, Particle, PatchScratch,
    PatchSettings, Plane, Pose, PoseRow, Section, Settings, ShapeGradient, SurfaceMesh, Triangle, Wall,
    boundary_derivatives, closest_point, contact_derivatives, contact_gradient, contact_with_plane,
    contact_with_triangle, detect, detect_batch, patch_of_contact, patch_on_plane,
};

fn refused<T: std::fmt::Debug>(answer: Result<T, DetectError>) -> InPlaneError {
    match answer {
        Err(DetectError::InPlane(error)) => error,
        other => panic!("{other:?}"),
    }
}

#[test]
fn other_kinds_and_poses_that_leave_the_plane_are_refused() {
    let (disc, ball, settings) = (circle(1.0), Particle::sphere(1.0).unwrap(), Settings::default());
    let (home, near) = (Pose::in_plane([0.0; 2], 0.0).unwrap(), Pose::in_plane([1.5, 0.0], 1.0).unwrap());
    let mixed = refused(detect(&disc, &home, &ball, &near, &settings, None));
    assert_eq!(mixed, InPlaneError::Mixed);
    assert!(mixed.to_string().contains("make both by in_plane"));
    let raised = Pose::new([1.5, 0.0, 0.25], [1.0, 0.0, 0.0, 0.0]).unwrap();
    assert_eq!(refused(detect(&disc, &home, &disc, &raised, &settings, None)), InPlaneError::Height(0.25));
    assert_eq!(refused(detect(&disc, &raised, &disc, &home, &settings, None)), InPlaneError::Height(0.25));
    for leaning in [[1.0, 0.5, 0.0, 0.0], [1.0, 0.0, 1e-300, 0.2], [0.0, 1.0, 0.0, 0.0]] {
        let [w, x, y, z] = leaning;
        let pose = Pose::new([1.5, 0.0, 0.0], leaning).unwrap();
        let error = refused(closest_point(&disc, &home, &disc, &pose, potential_particles::Role::A, &settings));
        assert_eq!(error, InPlaneError::Turn(w, x, y, z));
        let batch = detect_batch(&[&disc, &disc], &[home, pose], &[[0, 1]], &settings, 1, &mut []).unwrap();
        assert!(matches!(batch[0], Err(DetectError::InPlane(_))));
    }
    let floor = Wall::new([0.0, -0.5, 0.0], [0.0, 1.0, 0.1]).unwrap();
    assert!(matches!(
        refused(contact_with_plane(&disc, &home, &floor, &settings, None)),
        InPlaneError::Normal(z) if z > 0.0
    ));
    let triangle = Triangle::new([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]).unwrap();
    let error = refused(contact_with_triangle(&disc, &home, &triangle, &settings, None));
    assert!(error == InPlaneError::Triangle && error.to_string().contains("(x, y, 0)"));
    let contact = detect(&disc, &home, &disc, &near, &settings, None).unwrap();
    let section = Section::from(&contact);
    assert!(section.area(&disc, &home, &disc, &near, 1e-6).is_some());
    assert_eq!(section.area(&disc, &home, &ball, &near, 1e-6), None);
    let scratch = &mut PatchScratch::new();
    let patch = patch_of_contact(&disc, &home, &ball, &near, &contact, &PatchSettings::default(), scratch, |_| ());
    assert!(patch.unwrap_err().to_string().contains("make both by in_plane"));
    let packed = Supply::new(&[ball, disc], &Sizes::as_given(), 0.0);
    assert!(matches!(packed, Err(PackError::InPlane(1))), "{packed:?}");
}

/// A scaled particle and one that was written down and read back lie in the plane, too.
#[test]
fn copies_stay_in_the_plane() {
    let square = rectangle(0.5, 0.7, 0.1, 0.2);
    let twice = square.scaled(2.0).unwrap();
    assert!(twice.is_in_plane() && (twice.bounding_radius() / square.bounding_radius() - 2.0).abs() < 1e-12);
    let text = serde_json::to_string(&square).unwrap();
    let back: Particle = serde_json::from_str(&text).unwrap();
    assert!(back.is_in_plane() && back.planes().eq(square.planes()));
    let ball = Particle::sphere(1.0).unwrap();
    assert!(
        !ball.is_in_plane()
            && !serde_json::from_str::<Particle>(&serde_json::to_string(&ball).unwrap()).unwrap().is_in_plane()
    );
    let pose = Pose::in_plane([1.0, 2.0], 0.3).unwrap();
    assert_eq!(serde_json::from_str::<Pose>(&serde_json::to_string(&pose).unwrap()).unwrap(), pose);
}

/// The mesh is a polygon within the tolerance of the outline, its corners in order, its triangles the area.
#[test]
fn meshes_are_polygons() {
    let particle = rectangle(0.5, 0.7, 0.1, 0.02);
    let area = particle.mass_properties(1e-9).unwrap().volume;
    for tolerance in [1e-2, 1e-4, 1e-6] {
        let mesh = SurfaceMesh::of(&particle, tolerance).unwrap();
        let length = tolerance * particle.bounding_radius();
        assert!(mesh.error <= length);
        let (mut enclosed, mut perimeter) = (0.0, 0.0);
        for (here, next) in mesh.vertices.iter().zip(mesh.vertices.iter().cycle().skip(1)) {
            assert!(particle.potential(here).abs() < 1e-9 && here.z == 0.0 && here.cross(next).z > 0.0);
            perimeter += (next - here).norm();
            let across = (next - here).cross(&Vector3::z()).normalize();
            for t in 1..20 {
                let on = here + f64::from(t) / 20.0 * (next - here);
                let beyond = particle.surface_distance(&on, &across).unwrap();
                assert!(beyond <= length, "{beyond:e} beyond {length:e}");
            }
        }
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.map(|i| mesh.vertices[i as usize]);
            enclosed += 0.5 * (b - a).cross(&(c - a)).z;
        }
        assert!(enclosed < area && area - enclosed < length * perimeter, "{enclosed} of {area}");
        for (normal, vertex) in mesh.normals.iter().zip(&mesh.vertices) {
            assert!((normal - particle.gradient(vertex).normalize()).norm() < 1e-12);
        }
    }
}

/// A square on a line: the overlap, the patch and the cut of a face that lies flat, and the derivatives of a corner.
#[test]
fn lines_are_boundaries() {
    let (half, r, depth) = (0.5, 0.1, 1e-3);
    let square = rectangle(half, half, r, 0.0);
    for turn in [0.0, 0.3, 2.0] {
        let (sin, cos) = f64::sin_cos(turn);
        let up = Vector3::new(-sin, cos, 0.0);
        let line = Wall::new([3.0, 4.0, 0.0], up.into()).unwrap();
        let at = |height: f64, tilt: f64| {
            let place = Vector3::new(3.0, 4.0, 0.0) + height * up + 7.0 * Vector3::new(cos, sin, 0.0);
            Pose::in_plane([place.x, place.y], turn + tilt).unwrap()
        };
        let pose = at(half - depth, 0.0);
        let contact = contact_with_plane(&square, &pose, &line, &Settings::default(), None).unwrap();
        assert!(contact.kind == Kind::Overlapping && (contact.overlap - depth).abs() < 1e-9, "{contact:?}");
        assert!((contact.normal + up).norm() < 1e-9 && contact.normal.z == 0.0 && contact.point.z == 0.0);
        let (settings, scratch) =
            (PatchSettings { tolerance: 1e-8, ..PatchSettings::default() }, &mut PatchScratch::new());
        let patch = patch_on_plane(&square, &pose, &contact, &settings, scratch, |_| ()).unwrap();
        // The flat part presses by its depth, the rounded ends by what √(1 − v²) leaves, v = 1 − depth/r.
        let v = 1.0 - depth / r;
        let ends = r * (1.0 - v * v).sqrt();
        let u = ends / r;
        let beyond = r * (u - 0.5 * (u * (v * v + u * u).sqrt() + v * v * (u / v).asinh()));
        let force = r * (2.0 * (half - r) * (1.0 - v) + 2.0 * beyond);
        assert!((patch.area / (2.0 * (half - r + ends)) - 1.0).abs() < 1e-7, "{patch:?}");
        assert!((patch.force.norm() / force - 1.0).abs() < 1e-6 && patch.force.z == 0.0, "{patch:?} for {force:e}");
        // A corner, k > 0: the derivatives are differences.
        let rounder = rectangle(half, half, r, 0.05);
        let height = 0.5;
        let derivatives = |pose: &Pose| {
            let found = contact_with_plane(&rounder, pose, &line, &Settings::default(), None).unwrap();
            (found.overlap, boundary_derivatives(&rounder, pose, None, &found, &Settings::default()).unwrap().overlap)
        };
        let (_, row) = derivatives(&at(height, 0.6));
        let h = 1e-6;
        let along = (derivatives(&at(height + h, 0.6)).0 - derivatives(&at(height - h, 0.6)).0) / (2.0 * h);
        let turned = (derivatives(&at(height, 0.6 + h)).0 - derivatives(&at(height, 0.6 - h)).0) / (2.0 * h);
        assert!((row[0] * up.x + row[1] * up.y - along).abs() < 1e-7, "{row} for {along}");
        assert!((row[5] - turned).abs() < 1e-7, "{row} for {turned}");
        assert!([2, 3, 4, 8, 9, 10].iter().all(|&i| row[i] == 0.0));
    }
}

/// A number of a contact.
type Of<'a> = &'a dyn Fn(&Contact) -> f64;

/// Central differences of it in the six motions that stay in the plane.
fn differences(of: Of, found: &dyn Fn([f64; 6]) -> Contact) -> [f64; 6] {
    let h = 1e-6;
    std::array::from_fn(|i| {
        let moved = |by: f64| of(&found(std::array::from_fn(|j| if i == j { by } else { 0.0 })));
        (moved(h) - moved(-h)) / (2.0 * h)
    })
}

#[test]
fn derivatives_are_differences_and_leave_nothing_beside_the_plane() {
    let settings_of = |formulation| Settings::default().with_formulation(formulation).with_gap_tolerance(1e-15);
    let mut count = [0; 2];
    for (i, k, formulation) in (0..12)
        .flat_map(|i| [(i, 0.1, Formulation::Midway), (i, 0.1, Formulation::Closest), (i, 0.0, Formulation::Midway)])
    {
        let (a, b) = (Body::square(0.5, 0.1, k), Body::square(0.4, 0.08, 2.0 * k));
        let (settings, way) = (settings_of(formulation), 0.5 * f64::from(i));
        let place = |[x, y, turn]: [f64; 3]| Pose::in_plane([x, y], turn).unwrap();
        let (at_a, at_b) = ([0.1, 0.2, 0.3], [0.1 + 0.85 * way.cos(), 0.2 + 0.85 * way.sin(), 1.0 + way]);
        let (particle_a, particle_b) = (a.particle(), b.particle());
        let found = |m: [f64; 6]| {
            let pose_a = place([at_a[0] + m[0], at_a[1] + m[1], at_a[2] + m[2]]);
            let pose_b = place([at_b[0] + m[3], at_b[1] + m[4], at_b[2] + m[5]]);
            detect(&particle_a, &pose_a, &particle_b, &pose_b, &settings, None).unwrap()
        };
        let contact = found([0.0; 6]);
        // In the cores of both there are none.
        if contact.kind == Kind::Separated || contact.formulation != formulation || contact.s < 1e-3 {
            continue;
        }
        let (pose_a, pose_b) = (place(at_a), place(at_b));
        let all = contact_derivatives(&particle_a, &pose_a, &particle_b, &pose_b, &contact, &settings).unwrap();
        count[usize::from(k > 0.0)] += 1;
        let ContactDerivatives { s, overlap, normal, point, .. } = all;
        let rows: [(PoseRow, Of); 6] = [
            (s, &|c| c.s),
            (overlap, &|c| c.overlap),
            (normal.row(0).into(), &|c| c.normal.x),
            (normal.row(1).into(), &|c| c.normal.y),
            (point.row(0).into(), &|c| c.point.x),
            (point.row(1).into(), &|c| c.point.y),
        ];
        for (n, (row, of)) in rows.into_iter().enumerate() {
            let expected = differences(of, &found);
            for (column, expected) in [0, 1, 5, 6, 7, 11].into_iter().zip(expected) {
                let off = (row[column] - expected).abs();
                assert!(off < 2e-4 * (1.0 + expected.abs()), "{formulation}, {i}: row {n}, column {column}: {off:e}");
            }
            assert!([2, 3, 4, 8, 9, 10].iter().all(|&column| row[column] == 0.0));
        }
        assert!(normal.row(2).iter().chain(point.row(2).iter()).all(|entry| *entry == 0.0), "{normal} {point}");
        // Backwards the same, and into the shape.
        let weights = ContactWeights { overlap: 1.0, point: Vector3::new(0.3, -0.2, 9.0), ..ContactWeights::default() };
        let mut shape = ShapeGradient::zeros(&particle_a);
        let (poses, _) = contact_gradient(
            &particle_a,
            &pose_a,
            &particle_b,
            &pose_b,
            &contact,
            &settings,
            &weights,
            Some(&mut shape),
            None,
        )
        .unwrap();
        let expected: PoseRow = overlap + 0.3 * point.row(0) - 0.2 * point.row(1);
        let forward =
            [poses[0].shift.x, poses[0].shift.y, poses[0].turn.z, poses[1].shift.x, poses[1].shift.y, poses[1].turn.z];
        for (column, found) in [0, 1, 5, 6, 7, 11].into_iter().zip(forward) {
            assert!((found - expected[column]).abs() < 1e-9 * (1.0 + found.abs()), "{found} for {}", expected[column]);
        }
        assert!(poses.iter().all(|pose| pose.shift.z == 0.0 && pose.turn.x == 0.0 && pose.turn.y == 0.0));
        assert!(shape.planes.iter().all(|plane| plane.normal.z == 0.0));
    }
    assert!(count[0] > 2 && count[1] > 12, "{count:?}");
}

/// The inertia of a sheet: moments about x and y add up to that about z, and the area is that of the cut through a
/// prism.
#[test]
fn mass_is_per_unit_of_depth() {
    let lines = [[1.0, 0.0, 0.4], [-0.6, 0.8, 0.3], [0.0, -1.0, 0.45], [0.28, 0.96, 0.5]];
    for (r, k) in [(0.1, 0.0), (1e-3, 0.0)] {
        let sheet = Particle::in_plane(&lines, r, k, 1.0).unwrap().mass_properties(1e-9).unwrap();
        let mut planes: Vec<Plane> = lines.map(|[a, b, d]| Plane::from([a, b, 0.0, d])).to_vec();
        planes.extend([1.0, -1.0].map(|z| Plane::from([0.0, 0.0, z, 1.0])));
        let prism = Particle::new(&planes, r, k, 1.0).unwrap();
        let at = Pose::in_plane([0.0; 2], 0.0).unwrap();
        let section = Section { branch_a: Vector3::zeros(), branch_b: Vector3::zeros(), normal: Vector3::z() };
        let area = section.area(&prism, &at, &prism, &at, 1e-9).unwrap();
        assert!((sheet.volume / area - 1.0).abs() <= sheet.error + 1e-9, "{} for {area}", sheet.volume);
        let i: Matrix3<f64> = sheet.inertia;
        assert!((i.m11 + i.m22 - i.m33).abs() < 1e-15 && i.m13 == 0.0 && i.m23 == 0.0 && sheet.centroid.z == 0.0);
    }
}
