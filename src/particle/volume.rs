//! Volume, centroid and inertia of a body from the polygons of its surface.

use nalgebra::{Matrix3, Vector3};

/// Volume and first moment, face by face, about a corner of the body, so that no digits are lost far from the origin.
pub(crate) struct Enclosed {
    pole: Vector3<f64>,
    pub volume: f64,
    moment: Vector3<f64>,
}

impl Enclosed {
    pub fn about(pole: Vector3<f64>) -> Self {
        Self { pole, volume: 0.0, moment: Vector3::zeros() }
    }

    /// Adds a flat face, corners counter-clockwise from outside; its area.
    pub fn add(&mut self, corners: impl Iterator<Item = Vector3<f64>>) -> f64 {
        let mut doubled = Vector3::zeros();
        for [a, b, c] in fan(corners.map(|corner| corner - self.pole)) {
            let six = a.dot(&b.cross(&c));
            self.volume += six / 6.0;
            self.moment += six / 24.0 * (a + b + c);
            doubled += (b - a).cross(&(c - a));
        }
        0.5 * doubled.norm()
    }

    pub fn centroid(&self) -> Vector3<f64> {
        self.pole + self.moment / self.volume
    }
}

/// Moments and products of inertia about a point for density 1, ∫ (|x|² 1 − x xᵀ) dV, from faces whose corners are
/// counter-clockwise from outside.
///
/// Over a tetrahedron at the point with the corners a, b, c beyond: ∫ x xᵀ = V/20 (a aᵀ + b bᵀ + c cᵀ + s sᵀ), s = a +
/// b + c.
pub(crate) fn inertia<F: Iterator<Item = Vector3<f64>>>(
    about: &Vector3<f64>,
    faces: impl Iterator<Item = F>,
) -> Matrix3<f64> {
    let mut second = Matrix3::zeros();
    for [a, b, c] in faces.flat_map(|face| fan(face.map(|corner| corner - about))) {
        let squares = [a, b, c, a + b + c].iter().map(|x| x * x.transpose()).sum::<Matrix3<f64>>();
        second += a.dot(&b.cross(&c)) / 120.0 * squares;
    }
    Matrix3::from_diagonal_element(second.trace()) - second
}

/// A convex polygon as triangles at its first corner.
fn fan(mut corners: impl Iterator<Item = Vector3<f64>>) -> impl Iterator<Item = [Vector3<f64>; 3]> {
    let first = corners.next().unwrap_or_default();
    let mut last = corners.next().unwrap_or_default();
    corners.map(move |next| [first, std::mem::replace(&mut last, next), next])
}
