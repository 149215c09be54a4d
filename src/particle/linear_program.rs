//! Linear programs in up to four unknowns: whether half-spaces enclose a volume (half-planes an area), and how large it
//! is.
//!
//! A program max c·x subject to a_i·x ≤ h_i is solved by the dual simplex method: the four planes of a basis meet in a
//! point, the half-space that cuts it off most enters the basis, and one whose multiplier reaches 0 first leaves.
//!
//! A bound is not trusted for that. The active planes give multipliers y ≥ 0 with Σ y_i n_i ≈ e, and by weak duality
//!
//! ```text
//! e·x = Σ y_i n_i·x + ρ·x ≤ Σ y_i h_i + |ρ|₁ |x|_∞,   ρ = e − Σ y_i n_i
//! ```
//!
//! for every x that the half-spaces hold, whatever rounding did on the way. Taken for all axes this bounds |x|_∞.

use super::numbers::{DUAL_ROUNDING, LARGEST_RESIDUAL, Limits, OPTIMA_CUBE, PIVOT, TINY_EXTENT, UNDECIDED};
use nalgebra::{Matrix3, Matrix4, Vector3, Vector4};

/// a and h of a half-space a·x ≤ h.
pub(super) type HalfSpace = (Vector4<f64>, f64);

/// The maximiser of c·x over half-spaces and the four that meet there, from four of which c is a sum with weights ≥ 0.
/// `None` if rounding leaves no answer.
pub(super) fn maximiser(
    all: &[HalfSpace],
    c: &Vector4<f64>,
    mut basis: [usize; 4],
) -> Option<(Vector4<f64>, [usize; 4])> {
    for step in 0..Limits::PIVOTS {
        let columns = Matrix4::from_columns(&basis.map(|i| all[i].0));
        let x = columns.transpose().lu().solve(&Vector4::from(basis.map(|i| all[i].1)))?;
        let mut entering = None;
        for (i, (a, h)) in all.iter().enumerate() {
            let terms = a.component_mul(&x);
            let (cut, size) = (terms.sum() - h, terms.abs().sum() + h.abs());
            if cut > UNDECIDED * size && entering.is_none_or(|(_, most)| step < Limits::STEEPEST_PIVOTS && cut > most) {
                entering = Some((i, cut));
            }
        }
        let Some((entering, _)) = entering else { return Some((x, basis)) };
        let system = columns.lu();
        let (weights, change) = (system.solve(c)?, system.solve(&all[entering].0)?);
        let least = PIVOT * change.amax();
        let falling = || (0..4).filter(|&j| change[j] > least);
        // Weights that reach 0 together, within rounding (Harris): of them the one that falls fastest leaves.
        let first = falling().map(|j| (weights[j].max(0.0) + UNDECIDED) / change[j]).fold(f64::INFINITY, f64::min);
        let together = falling().filter(|&j| weights[j].max(0.0) <= first * change[j]);
        let leaving = if step < Limits::STEEPEST_PIVOTS {
            together.max_by(|&i, &j| change[i].total_cmp(&change[j]))?
        } else {
            together.min_by_key(|&j| basis[j])?
        };
        basis[leaving] = entering;
    }
    None
}

/// Half the edge of a cube about the origin that holds {x : n·x ≤ h for every face}, |n| = 1, h > 0; `None` if
/// unbounded. With two dimensions, of a square in the plane z = 0, to which x is then confined.
pub(crate) fn half_cube(faces: &[(Vector3<f64>, f64)], dimensions: usize) -> Option<f64> {
    let mut faces = faces.to_vec();
    loop {
        let scale = faces.iter().map(|(_, h)| *h).fold(0.0, f64::max);
        if !(scale > 0.0) {
            return None;
        }
        let scaled: Vec<_> = faces.iter().map(|(n, h)| (*n, (h / scale).max(0.0))).collect();
        let half = extent(&scaled, dimensions)? * scale;
        let before = faces.len();
        // A face further off than the cube's corners plays no part: not in the scale either.
        if half < TINY_EXTENT * scale {
            // In those units `half` may underflow; TINY_EXTENT does not.
            faces.retain(|(_, h)| *h < (2.0 * half).max(TINY_EXTENT * scale));
        }
        if faces.len() == before {
            return Some(half);
        }
    }
}

/// The same in units of the farthest face.
fn extent(faces: &[(Vector3<f64>, f64)], dimensions: usize) -> Option<f64> {
    // Of the cube its upper faces, then its lower ones; in place of unknowns that are not there, planes that hold them
    // at 0.
    let axis = |i: usize| (Vector4::ith(i, 1.0), if i < dimensions { OPTIMA_CUBE } else { 0.0 });
    let cube = (0..4).map(axis).chain((0..4).map(axis).map(|(a, h)| (-a, h)));
    let all: Vec<HalfSpace> = cube.chain(faces.iter().map(|(n, h)| (n.push(0.0), *h))).collect();
    let (mut most, mut residual): (f64, f64) = (0.0, 0.0);
    for axis in 0..dimensions {
        for (sign, first) in [(1.0, 0), (-1.0, 4)] {
            let mut basis = [0, 1, 2, 3];
            basis[axis] += first;
            let e = Vector3::ith(axis, sign);
            let (_, active) = maximiser(&all, &e.push(0.0), basis)?;
            let (bound, of_bound) = dual_bound(faces, &e, active, dimensions)?;
            (most, residual) = (most.max(bound), residual.max(of_bound));
        }
    }
    (residual <= LARGEST_RESIDUAL).then(|| most / (1.0 - residual))
}

/// Σ y_i h_i and |ρ|₁, with bounds on rounding, for the multipliers of these planes.
fn dual_bound(
    faces: &[(Vector3<f64>, f64)],
    e: &Vector3<f64>,
    active: [usize; 4],
    dimensions: usize,
) -> Option<(f64, f64)> {
    // In two dimensions the z axis completes the basis, without a weight.
    let (mut normals, mut distances) = (Matrix3::identity(), Vector3::zeros());
    let mut column = 0;
    for place in active {
        if place < 8 && place % 4 >= dimensions {
            continue;
        }
        // A face of the cube: the half-spaces reach it.
        let (n, h) = faces.get(place.wrapping_sub(8))?;
        normals.set_column(column, n);
        distances[column] = *h;
        column += 1;
    }
    let y = normals.lu().solve(e)?.map(|weight| weight.max(0.0));
    let residual = (e - normals * y).abs().sum() + DUAL_ROUNDING * (1.0 + y.sum());
    Some((y.dot(&distances) * (1.0 + DUAL_ROUNDING), residual))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    type Face = (Vector3<f64>, f64);

    fn face(n: [f64; 3], h: f64) -> Face {
        (Vector3::from(n).normalize(), h)
    }

    fn cuboid(x: f64, y: f64, z: f64) -> Vec<Face> {
        let of = |axis, h| [1.0, -1.0].map(|sign| (Vector3::ith(axis, sign), h));
        [of(0, x), of(1, y), of(2, z)].concat()
    }

    /// Holds the true half edge, and exceeds it by little.
    fn assert_half(faces: &[Face], dimensions: usize, expected: f64) {
        let half = half_cube(faces, dimensions).expect("bounded");
        assert!(half >= expected && half <= expected * (1.0 + 3e-6), "{half:e} for {expected:e}");
    }

    #[test]
    fn boxes_of_any_size_and_order() {
        for scale in [1e-150, 1e-12, 1.0, 3e8, 1e150] {
            let mut faces = cuboid(scale, 0.5 * scale, 0.25 * scale);
            assert_half(&faces, 3, scale);
            faces.reverse();
            // Twice, and with a face beyond all others.
            faces.extend(faces.clone());
            faces.push(face([1.0, 2.0, 3.0], 1e155));
            assert_half(&faces, 3, scale);
        }
        assert_half(&cuboid(1e140, 0.4, 0.4), 3, 1e140);
        assert_half(&cuboid(1.0, 1e-9, 1e-150), 3, 1.0);
    }

    #[test]
    fn a_far_face_does_not_cost_the_digits_of_a_small_body() {
        let mut faces = cuboid(3e-5, 2e-5, 1e-5);
        faces.push(face([1.0, 1.0, 1.0], f64::MAX));
        assert_half(&faces, 3, 3e-5);
    }

    #[test]
    fn simplices_in_space_and_in_the_plane() {
        let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
        // The corners of a regular tetrahedron lie opposite to its faces, three times as far off.
        assert_half(&corners.map(|n| face(n, 1.0)), 3, 3.0 / 3f64.sqrt());
        let half = 0.75f64.sqrt();
        let triangle = [face([1.0, 0.0, 0.0], 1.0), face([-0.5, half, 0.0], 1.0), face([-0.5, -half, 0.0], 1.0)];
        assert_half(&triangle, 2, 2.0);
        assert_eq!(half_cube(&triangle, 3), None);
    }

    #[test]
    fn slabs_wedges_and_needles_without_an_end_are_unbounded() {
        let all = cuboid(1.0, 0.5, 0.25);
        assert_eq!(half_cube(&[], 3), None);
        assert_eq!(half_cube(&all[..2], 3), None);
        for left_out in 0..6 {
            let mut faces = all.clone();
            faces.remove(left_out);
            assert_eq!(half_cube(&faces, 3), None, "without {left_out}");
            faces.extend(faces.clone());
            assert_eq!(half_cube(&faces, 3), None, "twice, without {left_out}");
        }
        let square = &all[..4];
        assert_eq!(half_cube(square, 3), None);
        assert_half(square, 2, 1.0);
        assert_eq!(half_cube(&all[..3], 2), None);
        // Open where the ridge of a roof runs.
        let roof = [face([0.0, 1.0, 1.0], 1.0), face([0.0, -1.0, 1.0], 1.0), face([0.0, 0.0, -1.0], 1.0)];
        assert_eq!(half_cube(&roof, 3), None);
    }

    /// A wedge of the half angle a about the x axis, with y and z bounded at its foot x = −1.
    fn wedge(a: f64) -> Vec<Face> {
        let mut faces = cuboid(f64::MAX, 1.0, 1.0);
        faces.remove(0);
        faces[0].1 = 1.0;
        faces.extend([1.0, -1.0].map(|sign| face([a.sin(), sign * a.cos(), 0.0], 0.5 * a.cos())));
        faces
    }

    #[test]
    fn a_wedge_is_bounded_by_its_ridge_until_its_faces_count_as_parallel() {
        for a in [0.1, 1e-3, 1e-6, 1e-8] {
            assert_half(&wedge(a), 3, 0.5 / a.tan());
        }
        for a in [1e-10, 1e-15, 0.0, -1e-10, -0.1] {
            assert_eq!(half_cube(&wedge(a), 3), None, "{a:e}");
        }
    }

    #[test]
    fn a_cone_of_many_planes_ends_at_its_apex() {
        for (count, slope) in [(7, 0.5), (1_000, 1e-4), (65_535, 0.3)] {
            let around = (0..count).map(|i| f64::from(i) * std::f64::consts::TAU / f64::from(count));
            let mut faces: Vec<Face> = around.map(|phi| face([phi.cos(), phi.sin(), slope], 1.0)).collect();
            faces.push(face([0.0, 0.0, -1.0], 1.0));
            let length = slope.hypot(1.0);
            assert_half(&faces, 3, length / slope);
        }
    }

    /// By all corners: `None` if a ray that no face cuts off runs along two faces.
    fn by_enumeration(faces: &[Face]) -> Option<f64> {
        let mut half: f64 = 0.0;
        for i in 0..faces.len() {
            for j in 0..i {
                let along = faces[i].0.cross(&faces[j].0);
                for ray in [along, -along] {
                    if along.norm() > 1e-9 && faces.iter().all(|(n, _)| n.dot(&ray) <= 1e-12) {
                        return None;
                    }
                }
                for k in 0..j {
                    let rows = [i, j, k].map(|place| faces[place].0.transpose());
                    let Some(inverse) = Matrix3::from_rows(&rows).try_inverse() else { continue };
                    let corner = inverse * Vector3::new(faces[i].1, faces[j].1, faces[k].1);
                    if faces.iter().all(|(n, h)| n.dot(&corner) <= h + 1e-9 * (1.0 + corner.norm())) {
                        half = half.max(corner.amax());
                    }
                }
            }
        }
        (half > 0.0).then_some(half)
    }

    proptest! {
        #[test]
        fn random_polyhedra_agree_with_the_enumeration_of_corners(
            given in prop::collection::vec(([-1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64], 0.01..2.0f64), 3..14),
            scale in -100..100i32,
        ) {
            let given = given.into_iter().filter(|(n, _)| Vector3::from(*n).norm() > 0.1);
            let faces: Vec<Face> = given.map(|(n, h)| face(n, h)).collect();
            let unit = 10f64.powi(scale);
            let scaled: Vec<Face> = faces.iter().map(|(n, h)| (*n, h * unit)).collect();
            let found = half_cube(&scaled, 3).map(|half| half / unit);
            match (found, by_enumeration(&faces)) {
                (Some(found), Some(half)) => prop_assert!((found / half - 1.0).abs() < 1e-5, "{} for {}", found, half),
                (found, half) => prop_assert_eq!(found.is_some(), half.is_some(), "{:?} for {:?}", found, half),
            }
        }

        /// On a grid of directions many planes are parallel, and many meet in one corner.
        #[test]
        fn degenerate_polyhedra_agree_with_the_enumeration_of_corners(
            given in prop::collection::vec(([-1..=1i32, -1..=1i32, -1..=1i32], 1..=3i32), 4..20),
        ) {
            let given = given.into_iter().filter(|(n, _)| *n != [0; 3]);
            let faces: Vec<Face> = given.map(|(n, h)| face(n.map(f64::from), f64::from(h))).collect();
            match (half_cube(&faces, 3), by_enumeration(&faces)) {
                (Some(found), Some(half)) => prop_assert!((found / half - 1.0).abs() < 1e-5, "{} for {}", found, half),
                (found, half) => prop_assert!(found.is_none() && half.is_none(), "{:?} for {:?}", found, half),
            }
        }
    }
}
