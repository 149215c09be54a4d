//! The largest ball within half-spaces: max ρ subject to n_i·x + ρ ≤ h_i, |n_i| = 1.

use super::linear_program::{HalfSpace, maximiser};
use nalgebra::{Vector3, Vector4};

/// The radius of the largest ball in {n·x ≤ h}, for unit normals n of a bounded body that holds the origin; its size is
/// at most `extent`, length. `None` if rounding leaves no answer.
pub(crate) fn radius(faces: &[(Vector3<f64>, f64)], extent: f64) -> Option<f64> {
    // A tetrahedron far outside begins.
    let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    let outside = corners.map(|corner| (Vector3::from(corner) / 3f64.sqrt(), 1e3 * extent));
    let all: Vec<HalfSpace> = outside.iter().chain(faces).map(|(n, h)| (n.push(1.0), *h)).collect();
    maximiser(&all, &Vector4::w(), [0, 1, 2, 3]).map(|(ball, _)| ball.w)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn a_cuboid_has_half_its_least_edge() {
        let faces: Vec<_> = (0..3)
            .flat_map(|axis| [1.0, -1.0].map(|sign| (Vector3::ith(axis, sign), [0.5, 0.2, 3.0][axis] + sign * 0.1)))
            .collect();
        assert!((radius(&faces, 3.1).unwrap() - 0.2).abs() < 1e-14);
    }

    /// Of tetrahedra on a grid many planes are parallel to others of the basis or meet with them: the radius is three
    /// times the volume over the area.
    #[test]
    fn tetrahedra_of_a_grid_have_their_inscribed_ball() {
        let grid: Vec<Vector3<f64>> =
            (0..27).map(|i| Vector3::new(f64::from(i / 9), f64::from(i / 3 % 3), f64::from(i % 3))).collect();
        let mut count = 0;
        for numbers in (0..27usize.pow(4)).map(|n| [n / 19_683, n / 729 % 27, n / 27 % 27, n % 27]) {
            let [a, b, c, d] = numbers.map(|i| grid[i]);
            let six = (b - a).cross(&(c - a)).dot(&(d - a));
            if !numbers.is_sorted() || six == 0.0 {
                continue;
            }
            let (middle, sides) = ((a + b + c + d) / 4.0, [[a, b, c], [b, c, d], [c, d, a], [d, a, b]]);
            let doubled = sides.map(|[a, b, c]| (b - a).cross(&(c - a)));
            let area: f64 = doubled.iter().map(|n| 0.5 * n.norm()).sum();
            let faces: Vec<_> = doubled
                .iter()
                .zip(sides)
                .map(|(n, [a, ..])| n.normalize() * n.dot(&(a - middle)).signum())
                .zip(sides)
                .map(|(n, [a, ..])| (n, n.dot(&(a - middle))))
                .collect();
            let radius = radius(&faces, 3.0).unwrap_or(f64::NAN);
            assert!((radius / (0.5 * six.abs() / area) - 1.0).abs() < 1e-11, "{numbers:?}: {radius}");
            count += 1;
        }
        assert_eq!(count, 14_632);
    }

    /// Tangent planes of a sphere, all about it, leave no larger ball.
    #[test]
    fn planes_about_a_sphere_have_that_sphere() {
        for seed in 0..20 {
            let mut random = Random::new(seed, 0);
            let centre = 0.3 * random.direction();
            let faces: Vec<_> = (0..300).map(|_| random.direction()).map(|n| (n, 0.7 + n.dot(&centre))).collect();
            assert!((radius(&faces, 1.0).unwrap() - 0.7).abs() < 1e-12);
        }
    }
}
