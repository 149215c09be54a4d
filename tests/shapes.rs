//! Builders of shapes against closed forms.

use nalgebra::{Matrix3, Vector3};
use potential_particles::shapes::{self, Rounding, Shape, ShapeError};
use potential_particles::{Plane, SurfaceMesh};

/// So little rounding that volumes are those of the sharp body to 1e-5.
fn sharp() -> Rounding {
    Rounding::new(1e-4, 0.0)
}

fn assert_volume(shape: &Shape, expected: f64) {
    assert!((shape.mass.volume / expected - 1.0).abs() < 1e-5, "{} for {expected}", shape.mass.volume);
}

/// The centroid is the origin, and the axes are principal.
fn assert_framed(shape: &Shape) {
    let mass = &shape.mass;
    let size = mass.volume.cbrt();
    assert!(mass.centroid.amax() < 2e-5 * size, "{}", mass.centroid);
    let off = mass.inertia - Matrix3::from_diagonal(&mass.inertia.diagonal());
    assert!(off.amax() < 1e-4 * mass.inertia.amax(), "{}", mass.inertia);
}

#[test]
fn solids_have_their_volumes() {
    let rounding = sharp();
    let cases = [
        (shapes::cuboid([2.0, 1.0, 0.5], &rounding), 1.0),
        (shapes::prism(6, 0.5, 2.0, &rounding), 6.0 * 0.25 * 30f64.to_radians().tan() * 2.0),
        (shapes::frustum(4, 0.5, 0.0, 3.0, &rounding), 1.0),
        (shapes::cylinder(1.0, 2.0, 64, &rounding), 2.0 * std::f64::consts::PI),
        (shapes::regular_solid(4, 1.0, &rounding), 1.0 / 72f64.sqrt()),
        (shapes::regular_solid(6, 1.0, &rounding), 1.0),
        (shapes::regular_solid(8, 1.0, &rounding), 2f64.sqrt() / 3.0),
        (shapes::regular_solid(12, 1.0, &rounding), (15.0 + 7.0 * 5f64.sqrt()) / 4.0),
        (shapes::regular_solid(20, 1.0, &rounding), 5.0 * (3.0 + 5f64.sqrt()) / 12.0),
        (shapes::sphere(2.0), 32.0 / 3.0 * std::f64::consts::PI),
    ];
    for (shape, volume) in cases {
        let shape = shape.unwrap();
        assert_volume(&shape, volume);
        assert_framed(&shape);
    }
}

/// Faces are where they were: the foot of the perpendicular from the centre lies on the surface, for any k.
#[test]
fn faces_are_where_the_half_spaces_end() {
    for k in [0.0, 0.02, 0.3] {
        let edges = [2.0, 1.2, 1.0];
        let shape = shapes::cuboid(edges, &Rounding::new(0.05, k)).unwrap();
        for (axis, edge) in edges.into_iter().enumerate() {
            let foot = Vector3::ith(axis, 0.5 * edge);
            assert!(shape.particle.potential(&foot).abs() < 1e-9, "k = {k}, axis {axis}");
        }
    }
}

/// A tetrahedron at any place, turned: its centroid is the mean of its corners, and its frame leads back to them.
#[test]
fn a_hull_stands_where_its_points_are() {
    let points = [[10.0, 20.0, 30.0], [11.0, 20.0, 30.5], [10.2, 22.0, 30.0], [10.0, 20.1, 33.0]];
    let shape = shapes::hull(&points, &sharp()).unwrap();
    let corners = points.map(Vector3::from);
    let mean = corners.iter().sum::<Vector3<f64>>() / 4.0;
    let sides = [1, 2, 3].map(|i| corners[i] - corners[0]);
    assert_volume(&shape, sides[0].dot(&sides[1].cross(&sides[2])).abs() / 6.0);
    assert!((shape.centroid - mean).norm() < 1e-4, "{} {mean}", shape.centroid);
    assert_framed(&shape);
    let pose = shape.pose();
    for corner in corners {
        // From just inside of the corner it is near the surface.
        let inside = mean + 0.99 * (corner - mean);
        assert!(shape.particle.potential(&pose.to_local(&inside)) < 0.0);
        assert!(shape.particle.potential(&pose.to_local(&(mean + 1.01 * (corner - mean)))) > 0.0);
    }
}

/// The mesh of a shape, read as a surface, is that shape again.
#[test]
fn a_mesh_is_a_closed_convex_surface() {
    let ball = shapes::sphere(1.0).unwrap();
    let mesh = SurfaceMesh::of(&ball.particle, 0.02).unwrap();
    let points: Vec<[f64; 3]> = mesh.vertices.iter().map(|&v| v.into()).collect();
    let volume: f64 = mesh
        .triangles
        .iter()
        .map(|t| t.map(|i| mesh.vertices[i as usize]))
        .map(|[a, b, c]| a.dot(&b.cross(&c)) / 6.0)
        .sum();
    let read = shapes::surface(&points, &mesh.triangles, &sharp()).unwrap();
    assert_volume(&read, volume);

    let open = shapes::surface(&points, &mesh.triangles[1..], &sharp());
    assert!(matches!(open, Err(ShapeError::OpenSurface { edges: 3, .. })), "{open:?}");
    let mut dented = points.clone();
    dented[0] = dented[0].map(|c| 0.7 * c);
    let dented = shapes::surface(&dented, &mesh.triangles, &sharp());
    assert!(matches!(dented, Err(ShapeError::Concave { .. })), "{dented:?}");
    let wrong = shapes::surface(&points, &[[0, 1, 1_000_000]], &sharp());
    assert!(matches!(wrong, Err(ShapeError::NoSuchPoint { .. })), "{wrong:?}");
}

#[test]
fn bad_input_is_told() {
    let text = |found: Result<Shape, ShapeError>| found.unwrap_err().to_string();
    let rounding = Rounding::default();
    assert_eq!(text(shapes::cuboid([1.0, -1.0, 1.0], &rounding)), "edge y=-1.0 must be finite and above 0");
    assert_eq!(text(shapes::cuboid([1.0; 3], &Rounding::new(0.05, f64::NAN))), "k=NaN must be between 0 and 1");
    assert!(text(shapes::cuboid([1.0; 3], &Rounding::new(0.5, 0.0))).starts_with("r=0.5 must be a share of the size"));
    assert!(text(shapes::regular_solid(7, 1.0, &rounding)).contains("4, 6, 8, 12 or 20"));
    let three = [[1.0, 0.0, 0.0, 1.0], [-1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0]].map(Plane::from);
    assert!(text(shapes::half_spaces(&three, &rounding)).contains("enclose no volume"));
    let inverted = [[1.0, 0.0, 0.0, -1.0], [-1.0, 0.0, 0.0, -1.0]].map(Plane::from);
    assert!(text(shapes::half_spaces(&inverted, &rounding)).contains("no point lies inside"));
}
