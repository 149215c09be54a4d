//! The largest ball within half-spaces: max ρ subject to n_i·x + ρ ≤ h_i, |n_i| = 1.
//!
//! Its dual, min Σ y_i h_i subject to Σ y_i n_i = 0, Σ y_i = 1, y ≥ 0, has four equations, so that the simplex method
//! works with bases of four half-spaces: their ball touches all four, and the half-space that cuts it most enters.

use nalgebra::{Matrix4, Vector3, Vector4};

/// Half-spaces that a ball may cut by this share of the largest height, by rounding.
const CUT: f64 = 1e-13;

/// Steps with the half-space that is cut most; from then on the first one enters, and the first leaves, which never
/// leads in circles (Bland).
const STEEPEST: usize = 200;

/// Changes of a weight below this share of the largest are rounding: with such a half-space leaving, the others would
/// be dependent.
const PIVOT: f64 = 1e-9;

/// Rounding of the weights, whose sum is 1.
const SLACK: f64 = 1e-12;

/// Most steps: far more than any body has taken.
const MOST_STEPS: usize = 100_000;

/// The radius of the largest ball in {n·x ≤ h}, for unit normals n of a bounded body that holds the origin; its size is
/// at most `extent`, length. `None` if rounding leaves no answer.
pub(crate) fn radius(faces: &[(Vector3<f64>, f64)], extent: f64) -> Option<f64> {
    // A tetrahedron far outside begins.
    let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    let outside = corners.map(|corner| (Vector3::from(corner) / 3f64.sqrt(), 1e3 * extent));
    let all: Vec<_> = outside.iter().chain(faces).copied().collect();
    let column = |i: usize| Vector4::new(all[i].0.x, all[i].0.y, all[i].0.z, 1.0);
    let mut basis = [0, 1, 2, 3];
    for step in 0..MOST_STEPS {
        let system = Matrix4::from_columns(&basis.map(column)).lu();
        // Of the ball that touches all four: (x, ρ)ᵀ B = h.
        let heights = Vector4::from(basis.map(|i| all[i].1));
        let ball = Matrix4::from_columns(&basis.map(column)).transpose().lu().solve(&heights)?;
        let cut = |i: usize| column(i).dot(&ball) - all[i].1;
        let most = |best: Option<usize>, i: usize| {
            let is_better = cut(i) > CUT * extent && best.is_none_or(|best| step < STEEPEST && cut(i) > cut(best));
            if is_better { Some(i) } else { best }
        };
        let Some(entering) = (0..all.len()).fold(None, most) else { return Some(ball.w) };
        let weights = system.solve(&Vector4::new(0.0, 0.0, 0.0, 1.0))?;
        let change = system.solve(&column(entering))?;
        let least = PIVOT * change.amax();
        let falling = || (0..4).filter(|&j| change[j] > least);
        // Weights that reach 0 together, within rounding (Harris): of them the one that falls fastest leaves.
        let first = falling().map(|j| (weights[j].max(0.0) + SLACK) / change[j]).fold(f64::INFINITY, f64::min);
        let together = falling().filter(|&j| weights[j].max(0.0) <= first * change[j]);
        let leaving = if step < STEEPEST {
            together.max_by(|&i, &j| change[i].total_cmp(&change[j]))?
        } else {
            together.min_by_key(|&j| basis[j])?
        };
        basis[leaving] = entering;
    }
    None
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
