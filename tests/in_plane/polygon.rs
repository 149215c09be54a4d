//! Polygons from points: closed forms of rounded polygons, any order of the points, and what is refused.

use crate::body::rectangle;
use nalgebra::Vector2;
use potential_particles::{Particle, ParticleError};
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
            let found = particle.mass_properties(1e-10).unwrap().volume;
            // Points are rounded to an ulp of where they lie.
            let rounding = 1e-9 + 1e-15 * far.abs() / scale;
            assert!((found / expected - 1.0).abs() < rounding, "{found} for {expected} at {far}");
        }
    }
}

#[test]
fn sides_lie_where_those_of_the_polygon_are() {
    let (x, y, r) = (1.5, 0.25, 0.02);
    for point in [[x, 0.1, 0.0], [-x, -0.1, 0.0], [0.7, y, 0.0], [-0.7, -y, 0.0]] {
        assert!(rectangle(x, y, r, 0.0).potential(&point.into()).abs() < 1e-12, "{point:?}");
    }
    let pentagon: Vec<[f64; 2]> = (0..5).map(|i| (PI * f64::from(i) / 2.5).sin_cos()).map(Into::into).collect();
    let disc = Particle::polygon(&pentagon, 1e-3, 1.0).unwrap();
    let area = disc.mass_properties(1e-9).unwrap().volume;
    assert!((area / PI - 1.0).abs() < 1e-8, "k = 1: the circle through the corners");
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
}
