//! Axes aligned with the stiffest planes at a point, in which a Hessian is graded.
//!
//! Plane curvature (1−k)/r² and sphere curvature k/R² can differ by 1e18. Summed in arbitrary axes, the
//! sphere's share is lost in the rounding of the planes'. In axes q₁ = stiffest normal, q₂ = stiffest
//! remainder, q₃ = q₁ × q₂ the Hessian is graded, and elimination in this order keeps each
//! direction's own relative precision.

use nalgebra::{Matrix3, Vector3};

/// Square of the sine below which what is left of a normal is rounding. Estimated: two projections leave about (4u)² =
/// 2e-31.
pub(crate) const PARALLEL: f64 = 1e-30;

/// Most normals kept from the first pass for the second: few points have more active planes (chosen; further ones are
/// looked up again).
const MOST_KEPT: usize = 16;

/// The normals of the active planes, each with the weighted 2w of its plane; times |n|² this is its curvature in the
/// sum.
pub(crate) trait StiffNormals {
    /// Calls `visit` with each normal and weight, in the same order each time.
    fn visit(&self, visit: impl FnMut(Vector3<f64>, f64));
}

/// Orthonormal axes (columns) of points with `dimensions` coordinates, stiffest first. The other columns are zeros, so
/// that a quadratic in these axes has neither slope nor planes across the boundary on which the points lie.
pub(crate) fn aligned(normals: &impl StiffNormals, dimensions: usize) -> Matrix3<f64> {
    if dimensions == 3 {
        return aligned_in_space(normals);
    }
    let mut axes = first(dimensions);
    if dimensions == 2 {
        let aligned = aligned_in_space(&Projected(normals, dimensions));
        (0..dimensions).for_each(|i| axes.set_column(i, &aligned.column(i)));
    }
    axes
}

/// The first axes, and zeros in place of the others.
pub(crate) fn first(dimensions: usize) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| if i == j && j < dimensions { 1.0 } else { 0.0 })
}

/// Normals of which the first coordinates count; the others are taken as 0.
struct Projected<'a, T>(&'a T, usize);

impl<T: StiffNormals> StiffNormals for Projected<'_, T> {
    fn visit(&self, mut visit: impl FnMut(Vector3<f64>, f64)) {
        self.0.visit(|mut n, weight| {
            (self.1..3).for_each(|axis| n[axis] = 0.0);
            visit(n, weight);
        });
    }
}

fn aligned_in_space(normals: &impl StiffNormals) -> Matrix3<f64> {
    let (mut stiffest, mut kept, mut count) = (Stiffest::default(), [(Vector3::zeros(), 0.0); MOST_KEPT], 0);
    normals.visit(|n, weight| {
        stiffest.meet(&n, n, weight);
        if let Some(place) = kept.get_mut(count) {
            *place = (n, weight);
        }
        count += 1;
    });
    let Some(first) = stiffest.normal.try_normalize(0.0) else {
        return Matrix3::identity();
    };
    // Twice is enough (Kahan): the second pass removes what rounding left of the first axis.
    let across = |n: Vector3<f64>| n - n.dot(&first) * first;
    let mut stiffest = Stiffest::default();
    let mut meet = |n: Vector3<f64>, weight| stiffest.meet(&n, across(across(n)), weight);
    match kept.get(..count) {
        Some(kept) => kept.iter().for_each(|(n, weight)| meet(*n, *weight)),
        None => normals.visit(meet),
    }
    let second = stiffest
        .normal
        .try_normalize(0.0)
        .and_then(|v| across(v).try_normalize(0.5))
        .unwrap_or_else(|| any_across(&first));
    Matrix3::from_columns(&[first, second, first.cross(&second)])
}

/// The remainder of an active normal that carries the largest curvature.
#[derive(Default)]
struct Stiffest {
    normal: Vector3<f64>,
    most: f64,
}

impl Stiffest {
    #[inline(always)]
    fn meet(&mut self, n: &Vector3<f64>, rest: Vector3<f64>, weight: f64) {
        let stiffness = weight * rest.norm_squared();
        if stiffness > self.most && rest.norm_squared() > PARALLEL * n.norm_squared() {
            (self.normal, self.most) = (rest, stiffness);
        }
    }
}

/// A unit vector at right angles to a unit vector.
pub(crate) fn any_across(n: &Vector3<f64>) -> Vector3<f64> {
    n.cross(&least_axis(n)).normalize()
}

/// The axis most nearly at right angles to a vector; of equally good ones the last: across a normal in the plane z = 0
/// that gives another one in it.
pub(crate) fn least_axis(n: &Vector3<f64>) -> Vector3<f64> {
    let [x, y, z] = [n.x.abs(), n.y.abs(), n.z.abs()];
    if z <= x && z <= y {
        Vector3::z()
    } else if y <= x {
        Vector3::y()
    } else {
        Vector3::x()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    struct Normals(Vec<(Vector3<f64>, f64)>);

    impl StiffNormals for Normals {
        fn visit(&self, mut visit: impl FnMut(Vector3<f64>, f64)) {
            self.0.iter().for_each(|(n, weight)| visit(*n, *weight));
        }
    }

    /// The softest of three directions keeps its curvature, 1e-18 of the stiffest one: the third axis is at right
    /// angles to both normals.
    #[test]
    fn axes_are_orthonormal_and_follow_the_stiffest_normals() {
        let (stiff, soft) = (Vector3::new(0.6, 0.8, 0.1), Vector3::new(0.5, 0.9, 0.3));
        // More than are kept from the first look, all but two of them along the first.
        for repeated in [1, 2 * MOST_KEPT] {
            let mut normals = vec![(soft, 1.0)];
            normals.extend((0..repeated).map(|i| (stiff, 1e18 - i as f64)));
            let axes = aligned(&Normals(normals), 3);
            assert!((axes.transpose() * axes - Matrix3::identity()).norm() < 1e-15);
            assert!((axes.column(0) - stiff.normalize()).norm() < 1e-15);
            assert!(axes.column(2).dot(&stiff).abs() < 1e-16 && axes.column(2).dot(&soft).abs() < 1e-16);
        }
    }

    #[test]
    fn axes_of_a_boundary_stay_on_it() {
        let normals = Normals(vec![(Vector3::new(0.6, 0.8, 5.0), 1e9), (Vector3::new(-0.8, 0.6, 2.0), 1.0)]);
        let plane = aligned(&normals, 2);
        assert!((plane.column(0) - Vector3::new(0.6, 0.8, 0.0)).norm() < 1e-15 && plane.column(2).norm() == 0.0);
        assert!(plane.row(2).norm() == 0.0 && plane.column(0).dot(&plane.column(1)).abs() < 1e-16);
        assert_eq!(aligned(&normals, 1), Matrix3::from_diagonal(&Vector3::x()));
        assert_eq!(aligned(&normals, 0), Matrix3::zeros());
    }
}
