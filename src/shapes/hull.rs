//! The convex hull of points, as half-spaces.
//!
//! About a point inside, the hull is the polar body of {y : p_i·y ≤ 1}: its faces are the corners of that one, which is cut out of a cube by
//! the same cutter as the blocks of a rock mass.

use super::error::ShapeError;
use crate::particle::cutter::Cutter;
use crate::particle::plane::Plane;
use crate::particle::polyhedron::{OF_CUBE, Polyhedron};
use nalgebra::Vector3;

/// Two faces are one if the corners of one lie this close to the plane of the other, as a share of the extent. The numbers of a binary .stl
/// file are good to 6e-8.
pub(super) const COPLANAR: f64 = 1e-6;

/// A body thinner than this share of its extent is flat.
const FLAT: f64 = 1e-9;

/// Least depth of a cut over the size of the polar body: some rounding of corners.
const LEAST_CUT: f64 = 1e-13;

/// The faces of the convex hull of points, unit normals, coplanar triangles as one; no point lies outside of any.
///
/// # Errors
/// Points that are not finite, fewer than four, or all in a plane.
pub(super) fn faces(points: &[Vector3<f64>]) -> Result<Vec<Plane>, ShapeError> {
    if let Some(index) = points.iter().position(|point| !point.iter().all(|c| c.is_finite())) {
        return Err(ShapeError::PointNotFinite(index));
    }
    if points.len() < 4 {
        return Err(ShapeError::TooFewPoints(points.len()));
    }
    let low = points.iter().copied().reduce(|a, b| a.inf(&b)).unwrap_or_default();
    let high = points.iter().copied().reduce(|a, b| a.sup(&b)).unwrap_or_default();
    let (middle, extent) = (0.5 * low + 0.5 * high, (high - low).max());
    if !(extent > 0.0 && extent.is_finite()) {
        return Err(ShapeError::Flat(points.len()));
    }
    // About their middle and with an extent of 1, so that places and units do not matter.
    let unit: Vec<Vector3<f64>> = points.iter().map(|point| (point - middle) / extent).collect();
    let tetrahedron = tetrahedron(&unit).ok_or(ShapeError::Flat(points.len()))?;
    let inside = tetrahedron.iter().map(|&i| unit[i]).sum::<Vector3<f64>>() / 4.0;
    let triangles = triangles(&unit, &tetrahedron, &inside);
    let faces = merged(&unit, triangles);
    Ok(faces
        .into_iter()
        .map(|(normal, height)| Plane { normal, offset: extent * height + normal.dot(&middle) })
        .collect())
}

/// Four of the points that enclose a volume: two far apart, the farthest from their line, the farthest from that plane.
fn tetrahedron(points: &[Vector3<f64>]) -> Option<[usize; 4]> {
    let farthest = |distance: &dyn Fn(&Vector3<f64>) -> f64| {
        (0..points.len()).max_by(|&i, &j| distance(&points[i]).total_cmp(&distance(&points[j]))).unwrap_or(0)
    };
    let a = farthest(&|p| (p - points[0]).norm());
    let b = farthest(&|p| (p - points[a]).norm());
    let along = (points[b] - points[a]).try_normalize(0.0)?;
    let c = farthest(&|p| along.cross(&(p - points[a])).norm());
    let normal = along.cross(&(points[c] - points[a])).try_normalize(FLAT)?;
    let d = farthest(&|p| normal.dot(&(p - points[a])).abs());
    (normal.dot(&(points[d] - points[a])).abs() > FLAT).then_some([a, b, c, d])
}

/// The triangles of the hull: corners of the polar body of the points about `inside`, each where three of them are.
fn triangles(points: &[Vector3<f64>], first: &[usize; 4], inside: &Vector3<f64>) -> Vec<[usize; 3]> {
    // The polar body of the tetrahedron, which holds that of all points.
    let reach = |i: usize| {
        let [a, b, c] = [1, 2, 3].map(|step| points[first[(i + step) % 4]]);
        let normal = (b - a).cross(&(c - a));
        normal.norm() / normal.dot(&(a - inside)).abs()
    };
    let half = 1.01 * (0..4).map(reach).fold(0.0, f64::max);
    let (mut polar, mut cutter) = (Polyhedron::cube(half, LEAST_CUT * half), Cutter::default());
    for i in first.iter().copied().chain(0..points.len()) {
        let from = points[i] - inside;
        let distance = from.norm();
        // One at the place of `inside` is no corner.
        if 1.0 / distance < 2.0 * half {
            polar.cut(&mut cutter, OF_CUBE + i, &(from / distance), 1.0 / distance);
        }
    }
    polar.corners_with_faces().map(|(_, faces)| faces.map(|face| face.saturating_sub(OF_CUBE))).collect()
}

/// Unit normals and heights of the faces of the hull, large triangles first, without those that lie in another's plane.
fn merged(points: &[Vector3<f64>], triangles: Vec<[usize; 3]>) -> Vec<(Vector3<f64>, f64)> {
    let doubled = |t: &[usize; 3]| (points[t[1]] - points[t[0]]).cross(&(points[t[2]] - points[t[0]]));
    let mut left: Vec<_> = triangles.into_iter().map(|triangle| (doubled(&triangle), triangle)).collect();
    left.sort_by(|a, b| b.0.norm().total_cmp(&a.0.norm()));
    let used: Vec<Vector3<f64>> = {
        let mut used: Vec<usize> = left.iter().flat_map(|(_, triangle)| *triangle).collect();
        used.sort_unstable();
        used.dedup();
        used.into_iter().map(|i| points[i]).collect()
    };
    let mut faces = Vec::new();
    while let Some(normal) = left.first().and_then(|(doubled, _)| doubled.try_normalize(0.0)) {
        // No corner is cut off.
        let height = used.iter().map(|at| normal.dot(at)).fold(f64::NEG_INFINITY, f64::max);
        left.remove(0);
        left.retain(|(_, triangle)| triangle.iter().any(|&i| normal.dot(&points[i]) < height - COPLANAR));
        faces.push((normal, height));
    }
    faces
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    fn random_points(count: usize, seed: u64) -> Vec<Vector3<f64>> {
        let mut random = Random::new(seed, 0);
        (0..count).map(|_| random.direction().component_mul(&Vector3::new(1.0, 0.5, 0.2))).collect()
    }

    /// Every point is below every face, every face has three points on it, and Euler's formula holds for points of an ellipsoid, but for slivers
    /// that are coplanar with a neighbour.
    #[test]
    fn faces_hold_all_points() {
        for seed in 0..10 {
            let points = random_points(200, seed);
            let faces = faces(&points).unwrap();
            let expected = 2 * points.len() - 4;
            assert!((expected - 3..=expected).contains(&faces.len()), "seed {seed}: {}", faces.len());
            for face in &faces {
                let excess: Vec<f64> = points.iter().map(|p| face.normal.dot(p) - face.offset).collect();
                assert!(excess.iter().all(|&e| e < 1e-12));
                assert!(excess.iter().filter(|e| e.abs() < 1e-9).count() >= 3);
            }
        }
    }

    #[test]
    fn triangles_of_one_face_are_one() {
        let cube: Vec<_> = (0..8).map(|i| Vector3::from_fn(|axis, _| f64::from(i >> axis & 1) + 1e6)).collect();
        assert_eq!(faces(&cube).unwrap().len(), 6);
        // Points on faces and inside change nothing.
        let mut more = cube.clone();
        more.extend(cube.iter().map(|p| (p + cube[0]) * 0.5));
        assert_eq!(faces(&more).unwrap().len(), 6);
    }

    #[test]
    fn what_has_no_volume_is_told() {
        let flat: Vec<_> = random_points(50, 1).iter().map(|p| Vector3::new(p.x, p.y, p.x + p.y)).collect();
        assert_eq!(faces(&flat), Err(ShapeError::Flat(50)));
        assert_eq!(faces(&flat[..3]), Err(ShapeError::TooFewPoints(3)));
        assert_eq!(faces(&[Vector3::zeros(); 5]), Err(ShapeError::Flat(5)));
        assert_eq!(faces(&[Vector3::repeat(f64::NAN); 5]), Err(ShapeError::PointNotFinite(0)));
    }
}
