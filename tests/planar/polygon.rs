//! Polygons from points: closed forms of rounded polygons, any order of the points, and what is refused.

use nalgebra::{Rotation2, Vector2};
use potential_particles::ParticleError;
use potential_particles::planar::Particle;
use std::f64::consts::PI;

/// Area of a convex polygon with rounded corners, k = 0: by u and v, the distances beyond the two lines of a corner,
/// the boundary there is u² + v² = r², and an area is du dv over the sine of the turn between the sides.
fn rounded_area(corners: &[[f64; 2]], r: f64) -> f64 {
    let points: Vec<Vector2<f64>> = corners.iter().map(|&corner| corner.into()).collect();
    let at = |i: usize| points[i % points.len()];
    let sharp: f64 = (0..points.len()).map(|i| 0.5 * at(i).perp(&at(i + 1))).sum();
    let lost: f64 = (0..points.len())
        .map(|i| {
            let turn = (at(i + 1) - at(i)).angle(&(at(i + 2) - at(i + 1)));
            r * r * (1.0 - 0.25 * PI) / turn.sin()
        })
        .sum();
    sharp - lost
}

#[test]
fn polygons_have_the_area_of_their_corners_wherever_they_lie() {
    let hexagon: Vec<[f64; 2]> =
        (0..6).map(|i| (PI * f64::from(i) / 3.0).sin_cos()).map(|(sine, cosine)| [cosine, sine]).collect();
    for corners in
        [vec![[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]], vec![[0.0, 0.0], [5.0, -1.0], [6.0, 2.0], [1.0, 3.0]], hexagon]
    {
        for (scale, far) in [(1.0, 0.0), (1e-6, 1.0), (1e6, -1e8), (1.0, 1e6)] {
            // Reversed, with a point inside and one on a side: the hull is the same.
            let mut points: Vec<[f64; 2]> =
                corners.iter().rev().map(|c| [scale * c[0] + far, scale * c[1] - far]).collect();
            let mean = |i: usize, j: usize| [0.5 * (points[i][0] + points[j][0]), 0.5 * (points[i][1] + points[j][1])];
            let others = [mean(0, 1), [0.5 * (mean(0, 1)[0] + points[2][0]), 0.5 * (mean(0, 1)[1] + points[2][1])]];
            points.extend(others);
            let r = 0.05 * scale;
            let particle = Particle::polygon(&points, r, 0.0).unwrap();
            let expected = rounded_area(&corners, 0.05) * scale * scale;
            let found = particle.area_properties(1e-10).unwrap().area;
            // Points are rounded to an ulp of where they lie.
            let rounding = 1e-9 + 1e-15 * far.abs() / scale;
            assert!((found / expected - 1.0).abs() < rounding, "{found} for {expected} at {far}");
        }
    }
}

#[test]
fn sides_lie_where_those_of_the_polygon_are() {
    let (width, height, r) = (3.0, 0.5, 0.02);
    let rectangle = Particle::rectangle(width, height, r, 0.0).unwrap();
    for point in [[0.5 * width, 0.1], [-0.5 * width, -0.1], [0.7, 0.5 * height], [-0.7, -0.5 * height]] {
        assert!(rectangle.potential(&point.into()).abs() < 1e-12, "{point:?}");
    }
    for sides in [3, 4, 7, 100] {
        let polygon = Particle::regular_polygon(sides, 2.0, 1e-3, 0.0).unwrap();
        let apothem = 2.0 * (PI / sides as f64).cos();
        for i in 0..sides {
            let normal = Rotation2::new(PI * (2 * i + 1) as f64 / sides as f64) * Vector2::x();
            assert!((polygon.potential(&(normal * apothem))).abs() < 1e-9, "side {i} of {sides}");
        }
    }
    let disc = Particle::regular_polygon(5, 2.0, 1e-3, 1.0).unwrap();
    assert!(
        (disc.area_properties(1e-9).unwrap().area / (4.0 * PI) - 1.0).abs() < 1e-8,
        "k = 1: the circle through the corners"
    );
}

#[test]
fn what_is_no_polygon_is_refused() {
    let said = |points: &[[f64; 2]], r: f64, k: f64| Particle::polygon(points, r, k).unwrap_err();
    let triangle = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    assert_eq!(said(&[], 0.1, 0.0), ParticleError::FlatVertices(0));
    assert_eq!(said(&triangle[..2], 0.1, 0.0), ParticleError::FlatVertices(2));
    assert_eq!(said(&[[1.0, 1.0]; 9], 0.1, 0.0), ParticleError::FlatVertices(9));
    let line: Vec<[f64; 2]> = (0..20).map(|i| [1e3 + 0.1 * f64::from(i), 1e3 + 0.3 * f64::from(i)]).collect();
    assert!(matches!(said(&line, 1e-3, 0.0), ParticleError::FlatVertices(20) | ParticleError::RoundingTooLarge { .. }));
    assert!(matches!(
        said(&[[0.0, 0.0], [1.0, f64::NAN], [0.0, 1.0]], 0.1, 0.0),
        ParticleError::VertexNotFinite { index: 1, .. }
    ));
    assert!(matches!(said(&triangle, 0.5, 0.0), ParticleError::RoundingTooLarge { .. }));
    assert!(matches!(said(&triangle, 0.0, 0.0), ParticleError::RoundingRadius(_)));
    assert!(matches!(said(&triangle, f64::NAN, 0.0), ParticleError::RoundingRadius(_)));
    assert!(matches!(said(&triangle, 0.1, 1.5), ParticleError::Sphericity(_)));
    for size in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(
            Particle::rectangle(size, 1.0, 0.1, 0.0).is_err() && Particle::regular_polygon(5, size, 0.1, 0.0).is_err()
        );
    }
    assert!(Particle::regular_polygon(2, 1.0, 0.1, 0.0).is_err());
}
