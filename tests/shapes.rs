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

/// A script that names faces by their numbers finds them: the planes of a wedge stay in the order given, whatever their
/// areas, and one that makes no face is left out.
#[test]
fn half_spaces_keep_their_order() {
    let (steep, flat) = (70f64.to_radians(), 25f64.to_radians());
    let given = [
        Vector3::new(steep.sin(), 0.0, steep.cos()),
        Vector3::new(-1.0, 0.0, 0.0),
        Vector3::new(0.0, 1.0, 0.0),
        Vector3::new(0.0, -flat.sin(), flat.cos()),
        Vector3::new(0.0, 0.0, -1.0),
        Vector3::new(0.0, -1.0, 0.0),
    ];
    for turn in 0..given.len() {
        let mut planes: Vec<Plane> = given.iter().map(|&normal| Plane { normal, offset: 1.0 }).collect();
        planes.rotate_left(turn);
        let beyond = Plane { normal: given[0], offset: 1.5 };
        let all: Vec<Plane> = planes[..2].iter().chain([&beyond]).chain(&planes[2..]).copied().collect();
        let shape = shapes::half_spaces(&all, &sharp()).unwrap();
        let found: Vec<_> = shape.particle.planes().map(|plane| shape.pose().rotation() * plane.normal).collect();
        assert_eq!(found.len(), planes.len());
        for (found, plane) in found.iter().zip(&planes) {
            assert!((found - plane.normal).norm() < 1e-14, "turned by {turn}: {found} is not {}", plane.normal);
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

/// However flat they are, as far as faces are not coplanar: pyramids and tetrahedra have their volumes h/3 and h/6, and
/// their centroids where a quarter of their height is.
#[test]
fn flat_hulls_have_their_volumes() {
    for height in [0.1, 0.02, 1e-2, 1e-3, 1e-4, 1e-5] {
        let pyramid = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.5, 0.5, height]];
        let tetrahedron = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, height]];
        let pyramid = shapes::hull(&pyramid, &sharp()).unwrap();
        let tetrahedron = shapes::hull(&tetrahedron, &sharp()).unwrap();
        for (shape, volume, middle) in [(pyramid, height / 3.0, 0.5), (tetrahedron, height / 6.0, 0.25)] {
            assert!((shape.mass.volume / volume - 1.0).abs() < 1e-5 + shape.mass.error, "{height}: {:?}", shape.mass);
            let off = shape.centroid - Vector3::new(middle, middle, 0.25 * height);
            assert!(off.amax() < 1e-4 && off.z.abs() < 1e-4 * height, "{height}: {off}");
        }
        for k in [0.02, 0.5] {
            let rounded = shapes::hull(
                &[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, height]],
                &Rounding::new(0.05, k),
            );
            assert_framed(&rounded.unwrap());
        }
    }
}

/// Of points far away their differences count.
#[test]
fn hulls_and_surfaces_may_be_far_from_the_origin() {
    let near = shapes::surface(&cube(0.0), &CUBE, &sharp()).unwrap();
    for far in [1e6, 1e10, 1e15] {
        for shape in [shapes::hull(&cube(far), &sharp()), shapes::surface(&cube(far), &CUBE, &sharp())] {
            let shape = shape.unwrap();
            assert_eq!(shape.particle.plane_count(), 6);
            assert_volume(&shape, near.mass.volume);
            assert!((shape.centroid - Vector3::repeat(far + 0.5)).amax() <= 1e-6 + f64::EPSILON * far);
        }
    }
    let lost = shapes::hull(&cube(1e17), &sharp()).unwrap_err().to_string();
    assert!(lost.contains("8 points are flat") && lost.contains("nearer to the origin"), "{lost}");
    let planes = |far: f64| {
        let plane = |(axis, sign): (usize, f64)| Plane { normal: Vector3::ith(axis, sign), offset: 0.5 + sign * far };
        [0, 1, 2].map(|axis| [1.0, -1.0].map(|sign| plane((axis, sign)))).concat()
    };
    assert_volume(&shapes::half_spaces(&planes(1e6), &sharp()).unwrap(), 1.0);
    let lost = shapes::half_spaces(&planes(1e10), &sharp()).unwrap_err().to_string();
    assert!(lost.contains("about an origin near it"), "{lost}");
}

fn cube(corner: f64) -> Vec<[f64; 3]> {
    (0..8).map(|i| [0, 1, 2].map(|axis| f64::from(i >> axis & 1) + corner)).collect()
}

/// Its triangles, two a side.
const CUBE: [[u32; 3]; 12] = [
    [0, 2, 1],
    [1, 2, 3],
    [4, 5, 6],
    [5, 7, 6],
    [0, 1, 4],
    [1, 5, 4],
    [2, 6, 3],
    [3, 6, 7],
    [0, 4, 2],
    [2, 4, 6],
    [1, 3, 5],
    [3, 7, 5],
];

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
    assert_eq!(text(shapes::cuboid([1.0; 3], &Rounding::new(0.05, f64::NAN))), "k=NaN must be from 0 to below 1");
    assert!(
        text(shapes::cuboid([1.0; 3], &Rounding::new(0.5, 0.0)))
            .starts_with("rounding=0.5 must be a share of the size")
    );
    for sides in [2, 65_535, 1_000_000_000_000] {
        let told = format!("sides={sides} must lie between 3 and 65534");
        assert_eq!(text(shapes::prism(sides, 1.0, 1.0, &rounding)), told);
        assert_eq!(text(shapes::cylinder(1.0, 1.0, sides, &rounding)), told);
    }
    assert!(text(shapes::regular_solid(7, 1.0, &rounding)).contains("4, 6, 8, 12 or 20"));
    let three = [[1.0, 0.0, 0.0, 1.0], [-1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0]].map(Plane::from);
    assert!(text(shapes::half_spaces(&three, &rounding)).contains("enclose no volume"));
    let inverted = [[1.0, 0.0, 0.0, -1.0], [-1.0, 0.0, 0.0, -1.0]].map(Plane::from);
    assert!(text(shapes::half_spaces(&inverted, &rounding)).contains("no point lies inside"));
}

/// Corners were lost where the hull was cut in floating point.
#[test]
fn hulls_keep_every_corner() {
    let grid = (0..343).map(|i| [i / 49, i / 7 % 7, i % 7].map(|c| f64::from(c) / 3.0 + 16.4)).collect::<Vec<_>>();
    let shape = shapes::hull(&grid, &sharp()).unwrap();
    assert_eq!(shape.particle.plane_count(), 6);
    assert_volume(&shape, 8.0);
    let cloud = [[0, 0, 0], [0, 0, 1], [0, 0, 3], [0, 0, 4], [0, 0, 5], [3, 6, 1], [6, 0, 6], [6, 6, 0], [6, 6, 6]];
    let cloud = cloud.map(|point| point.map(|c| f64::from(c) / 3.0 + 133.0 * (1.0 / 3.0) * 0.37));
    assert_volume(&shapes::hull(&cloud, &sharp()).unwrap(), 11.0 / 3.0);
    for scale in [1.0, 1e-3, 7e5] {
        let points = [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 2.0], [2.0, 1.0, 2.0]].map(|p| p.map(|c| scale * c));
        assert_volume(&shapes::hull(&points, &sharp()).unwrap(), f64::powi(scale, 3) / 3.0);
        let triangles = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]];
        assert_volume(&shapes::surface(&points, &triangles, &sharp()).unwrap(), f64::powi(scale, 3) / 3.0);
    }
}

/// A hull of more faces than a particle may have is told before any work on them.
#[test]
fn a_hull_of_too_many_faces_is_told() {
    let golden = 2.399963229728653;
    let at = |i: u32| {
        let z = 1.0 - (2.0 * f64::from(i) + 1.0) / 40_000.0;
        let (sin, cos) = (golden * f64::from(i)).sin_cos();
        [(1.0 - z * z).sqrt() * cos, (1.0 - z * z).sqrt() * sin, z]
    };
    let error = shapes::hull(&(0..40_000).map(at).collect::<Vec<_>>(), &sharp()).unwrap_err().to_string();
    assert!(error.contains("planes are more than the 65536"), "{error}");
}

/// Of whole numbers that are moved and rounded, one that lies on an edge makes a face whose area, and so the direction
/// of its normal, is rounding.
#[test]
fn a_face_of_rounding_makes_no_plane() {
    let at = |corner: [f64; 3]| {
        [
            corner[0] - 0.055_334_462_280_617_62,
            corner[1] - 0.094_659_609_200_441_43,
            corner[2] + 0.019_603_768_503_472_73,
        ]
    };
    let corners = [[2, 2, 0], [2, 0, 0], [0, 2, 0], [2, 2, 2], [0, 1, 2], [0, 0, 0], [1, 2, 1], [0, 0, 1], [1, 0, 2]];
    let points: Vec<_> = corners.map(|corner| at(corner.map(f64::from))).into();
    assert_eq!(shapes::sharp_hull(&points).unwrap().1.len(), 9);
}

/// Points near a line enclose nothing, whatever rounding makes of them; nor do points that are one.
#[test]
fn points_on_a_line_are_flat() {
    for count in [4, 10, 33] {
        for end in [[1.0, 0.3, 0.7], [1e-3, 7.0, 1.0 / 3.0], [1e7, 1.0, 0.1]] {
            let at = |i: i32| end.map(|c: f64| c * f64::from(i) / f64::from(count - 1));
            let points: Vec<[f64; 3]> = (0..count).map(at).collect();
            let told = shapes::hull(&points, &sharp()).unwrap_err();
            assert!(matches!(told, ShapeError::Flat(_)), "{count} points to {end:?}: {told}");
        }
    }
    assert!(matches!(shapes::hull(&[[0.3; 3]; 5], &sharp()), Err(ShapeError::Flat(5))));
}

/// Beyond the range of sizes one sentence says so, whatever is built.
#[test]
fn sizes_out_of_range_are_told() {
    for scale in [1e-310, 1e-90, 1e-60, 1e-52, 1e52, 1e60, 1e78, 1e300] {
        let points: Vec<[f64; 3]> = cube(0.0).iter().map(|point| point.map(|c| scale * c)).collect();
        let planes =
            [0, 1, 2].map(|axis| [1.0, -1.0].map(|sign| Plane { normal: Vector3::ith(axis, sign), offset: scale }));
        let found = [
            shapes::hull(&points, &sharp()),
            shapes::surface(&points, &CUBE, &sharp()),
            shapes::half_spaces(&planes.concat(), &sharp()),
        ];
        for error in found.map(|found| found.map(|_| ()).unwrap_err().to_string()) {
            assert!(error.contains("must lie between 1e-50 and 1e50: take another unit"), "{scale:e}: {error}");
        }
        let error = shapes::prism(6, scale, scale, &sharp()).map(|_| ()).unwrap_err().to_string();
        assert!(error.contains("from 1e-50 to 1e50"), "{scale:e}: {error}");
    }
}

/// All 14,632 tetrahedra of a grid, from points and from their planes: inscribed balls of singular bases were not
/// found.
#[test]
fn every_tetrahedron_of_a_grid_is_built() {
    let mut count = 0;
    for numbers in (0..27usize.pow(4)).map(|n| [n / 19_683, n / 729 % 27, n / 27 % 27, n % 27]) {
        let points = numbers.map(|i| [i / 9, i / 3 % 3, i % 3].map(|c| c as f64));
        let [a, b, c, d] = points.map(Vector3::from);
        let six = (b - a).cross(&(c - a)).dot(&(d - a));
        if numbers.is_sorted() && six != 0.0 {
            count += 1;
            // Mass properties take longer than the rest.
            if count % 40 == 0 {
                assert_volume(&shapes::hull(&points, &sharp()).unwrap(), six.abs() / 6.0);
            }
        }
    }
    assert_eq!(count, 14_632);
    let once = [[0.0, 0.0, 2.0], [1.0, 0.0, 0.0], [1.0, 1.0, 2.0], [2.0, 0.0, 0.0]];
    assert_volume(&shapes::hull(&once, &sharp()).unwrap(), 1.0 / 3.0);
}
