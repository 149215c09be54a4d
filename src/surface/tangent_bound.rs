//! How far a convex surface can rise above a triangle whose corners lie on it.

use super::numbers::ROUNDED;
use nalgebra::{Matrix3, Vector3};

/// A point of the surface with its outward unit normal.
#[derive(Clone, Copy, Debug)]
pub(super) struct SurfacePoint {
    pub position: Vector3<f64>,
    pub normal: Vector3<f64>,
}

/// Bound on the distance of the surface from a triangle, and where that bound is reached.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rise {
    /// Length; infinite where the tangent planes bound nothing above the triangle.
    pub bound: f64,
    /// Weights of the corners, ≥ 0, of sum 1: the point of the triangle below the highest point that the tangent planes
    /// allow.
    pub place: [f64; 3],
}

/// Bound on the distance from any point of the surface to a triangle, within the cone of the triangle from the origin.
///
/// A point of the cone is Σ w_j x_j with w ≥ 0, and the body lies below its tangent plane at each corner: Σ_j a_ij w_j
/// ≤ 1 with a_ij = n_i·x_j / n_i·x_i. The distance from a convex set, the triangle, is a convex function, so that it is
/// largest at a vertex of this polytope. The polytope is bounded if some y ≥ 0 has Σ_i y_i a_ij ≥ 1 for all j: then Σ
/// w_j ≤ Σ y_i.
pub(super) fn rise(corners: &[SurfacePoint; 3]) -> Rise {
    let a = Matrix3::from_fn(|i, j| {
        let SurfacePoint { position, normal } = &corners[i];
        normal.dot(&corners[j].position) / normal.dot(position)
    });
    let triangle = corners.map(|corner| corner.position);
    let mut highest = Rise { bound: 0.0, place: [1.0 / 3.0; 3] };
    let mut bounded = false;
    for Basic { rows, columns, y, w } in basic_solutions(&a) {
        let dual = |j: usize| columns[j] || a.column(j).dot(&y) >= 1.0 - ROUNDED;
        bounded |= y.min() >= 0.0 && (0..3).all(dual);
        let primal = |i: usize| rows[i] || (a.row(i) * w).x <= 1.0 + ROUNDED;
        // Every vertex but the origin lies above the triangle; others come from rounding. Also false for NaN.
        if w.min() >= 0.0 && w.sum() > 1.0 && (0..3).all(primal) {
            let bound = distance(&(w.x * triangle[0] + w.y * triangle[1] + w.z * triangle[2]), &triangle);
            if bound > highest.bound {
                highest = Rise { bound, place: (w / w.sum()).into() };
            }
        }
    }
    if bounded { highest } else { Rise { bound: f64::INFINITY, place: [1.0 / 3.0; 3] } }
}

/// Distance of a point from a triangle.
fn distance(point: &Vector3<f64>, [p, q, r]: &[Vector3<f64>; 3]) -> f64 {
    let normal = (q - p).cross(&(r - p));
    let (mut above, mut nearest) = (true, f64::INFINITY);
    for (from, to) in [(p, q), (q, r), (r, p)] {
        let (edge, arm) = (to - from, point - from);
        above &= normal.dot(&edge.cross(&arm)) >= 0.0;
        let along = (arm.dot(&edge) / edge.norm_squared()).clamp(0.0, 1.0);
        nearest = nearest.min((arm - along * edge).norm());
    }
    // Corners on a line have no inside.
    let height = ((point - p).dot(&normal) / normal.norm()).abs();
    if above { nearest.min(height) } else { nearest }
}

/// Where as many constraints hold with equality as there are weights that are not zero.
struct Basic {
    /// The constraints: (A w)_i = 1 in these rows.
    rows: [bool; 3],
    /// The weights w, which make (Aᵀ y)_j = 1 in these columns.
    columns: [bool; 3],
    y: Vector3<f64>,
    w: Vector3<f64>,
}

/// All of them; where a matrix is singular, with numbers that are none.
fn basic_solutions(a: &Matrix3<f64>) -> impl Iterator<Item = Basic> {
    let single = (0..9).map(|place| {
        let (i, j) = (place / 3, place % 3);
        let value = 1.0 / a[(i, j)];
        let (y, w) = (Vector3::ith(i, value), Vector3::ith(j, value));
        Basic { rows: [0, 1, 2].map(|row| row == i), columns: [0, 1, 2].map(|column| column == j), y, w }
    });
    let double = (0..9).map(|place| {
        let (left_out, zero) = (place / 3, place % 3);
        let ([i, k], [j, l]) = (others(left_out), others(zero));
        let (p, q, r, s) = (a[(i, j)], a[(i, l)], a[(k, j)], a[(k, l)]);
        let determinant = p * s - q * r;
        let (mut y, mut w) = (Vector3::zeros(), Vector3::zeros());
        (y[i], y[k]) = ((s - r) / determinant, (p - q) / determinant);
        (w[j], w[l]) = ((s - q) / determinant, (p - r) / determinant);
        Basic { rows: [0, 1, 2].map(|row| row != left_out), columns: [0, 1, 2].map(|column| column != zero), y, w }
    });
    let ones = Vector3::repeat(1.0);
    let triple = a.try_inverse().map(|inverse| {
        let (y, w) = (inverse.transpose() * ones, inverse * ones);
        Basic { rows: [true; 3], columns: [true; 3], y, w }
    });
    single.chain(double).chain(triple)
}

/// The two axes beside one.
fn others(axis: usize) -> [usize; 2] {
    [(axis + 1) % 3, (axis + 2) % 3]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn on(position: [f64; 3], normal: [f64; 3]) -> SurfacePoint {
        SurfacePoint { position: position.into(), normal: Vector3::from(normal).normalize() }
    }

    #[test]
    fn the_octant_of_a_cube_rises_to_its_corner() {
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let found = rise(&axes.map(|axis| on(axis, axis)));
        // From the plane x + y + z = 1 to (1, 1, 1).
        assert!((found.bound - 2.0 / f64::sqrt(3.0)).abs() < 1e-14, "{found:?}");
        assert!(found.place.iter().all(|part| (part - 1.0 / 3.0).abs() < 1e-14));
    }

    #[test]
    fn two_corners_on_one_face_put_the_place_above_an_edge_of_the_triangle() {
        let (x, y) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
        let found = rise(&[on([1.0, 0.0, 0.0], x), on([1.0, 0.0, 1.0], x), on([0.0, 1.0, 0.0], y)]);
        // (1, 1, 1) lies above the edge from (1, 0, 1) to (0, 1, 0), (1, 1, 0) nearer to that from (1, 0, 0).
        assert!((found.bound - f64::sqrt(2.0 / 3.0)).abs() < 1e-14, "{found:?}");
        assert!(found.place.contains(&0.0), "{found:?}");
    }

    #[test]
    fn a_face_has_no_rise_and_parallel_planes_bound_nothing() {
        let z = [0.0, 0.0, 1.0];
        let flat = rise(&[on([1.0, 0.0, 1.0], z), on([0.0, 1.0, 1.0], z), on([-1.0, -1.0, 1.0], z)]);
        assert!(flat.bound < 1e-13, "{flat:?}");
        let side = |x: f64, y: f64| on([x, y, 0.1], [x, y, 0.0]);
        let open = rise(&[side(1.0, 0.0), side(-0.5, 0.8), side(-0.5, -0.8)]);
        assert_eq!(open.bound, f64::INFINITY);
    }
}
