//! A partition of all directions from the origin into quadrilaterals that follow the faces and edges of a particle.
//!
//! They lie on the polyhedron {n_i·x ≤ d_i + r/√(1−k)} that holds the particle, cut off by a cube about its bounding
//! ball. On a face i, a neighbour j is active beyond the line n_j·x = d_j. The lines of all neighbours bound the inner
//! part of the face, where the surface is that of plane i and the shadow sphere alone; between them and the edges there
//! are strips, as wide as the rounding, which are cut at their ends where a third plane becomes active. For k = 0 these
//! are exactly the places where the second derivatives of the surface jump, but for those in the corners; for k > 0
//! they are near them.
//!
//! The quadrilaterals share corners and edges, so that each direction is covered once whatever rounding does to the
//! corners, if one that is folded over counts as negative.

use super::numbers::{FACES_APART, Limits};
use crate::particle::neighbours;
use crate::particle::outlines::Outline;
use crate::particle::polyhedron::{OF_CUBE, Polyhedron};
use crate::particle::solid::Solid;
use nalgebra::{Matrix3, Vector3};

/// A quadrilateral: p(u, v) is bilinear in 0 ≤ u, v ≤ 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patch {
    /// p(0, 0), p(0, 1), p(1, 0), p(1, 1).
    corners: [Vector3<f64>; 4],
    /// No point of it is nearer to the origin; above 0.
    pub height: f64,
    /// Where v is divided to begin with: 0 < `cuts[0]` < `cuts[1]` < 1, or both 0.
    cuts: [f64; 2],
}

impl Patch {
    fn of(corners: [Vector3<f64>; 4], normal: &Vector3<f64>, cuts: [f64; 2]) -> Self {
        let height = corners.iter().map(|corner| normal.dot(corner)).fold(f64::INFINITY, f64::min);
        Self { corners, height, cuts }
    }

    /// The least area of the image of du dv.
    fn least_area(&self) -> f64 {
        let at_corners = [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0)].map(|(u, v)| self.at(u, v).1);
        at_corners.into_iter().fold(f64::INFINITY, f64::min) / self.height
    }

    /// p(u, v), and p·(∂p/∂u × ∂p/∂v): three times the volume between the origin and the image of du dv, negative where
    /// it is folded over.
    pub fn at(&self, u: f64, v: f64) -> (Vector3<f64>, f64) {
        let [a, b, c, d] = &self.corners;
        let (inner, outer) = (a + v * (b - a), c + v * (d - c));
        let p = inner + u * (outer - inner);
        (p, p.dot(&(outer - inner).cross(&((1.0 - u) * (b - a) + u * (d - c)))))
    }

    /// ∂p/∂u and ∂p/∂v at (u, v).
    pub fn along(&self, u: f64, v: f64) -> [Vector3<f64>; 2] {
        let [a, b, c, d] = &self.corners;
        [(1.0 - v) * (c - a) + v * (d - b), (1.0 - u) * (b - a) + u * (d - c)]
    }

    /// The intervals of v into which the patch is divided to begin with.
    pub fn intervals(&self) -> impl Iterator<Item = (f64, f64)> + use<> {
        let [low, high] = self.cuts;
        // Without cuts the last is the whole.
        [(0.0, low), (low, high), (high, 1.0)].into_iter().filter(|(from, to)| from < to)
    }
}

/// Patches along the faces of a particle, or along those of a cube where there are many and most are all rounding.
pub(crate) fn of(shape: &Solid) -> Vec<Patch> {
    let rows = if shape.is_sphere() { &[] } else { &shape.rows[..] };
    let mut faces = neighbours::polyhedron(rows, &shape.bounds).outlines();
    let mut divided: Vec<Option<Vec<Patch>>> = faces.iter().map(|face| with_strips(&face, shape)).collect();
    if faces.len() > Limits::FOLLOWED_FACES && 2 * divided.iter().flatten().count() < faces.len() {
        faces = Polyhedron::cube(shape.bounds.radius, 0.0).outlines();
        divided = vec![None; faces.len()];
    }
    let patches = divided
        .into_iter()
        .zip(faces.iter())
        .map(|(divided, face)| divided.unwrap_or_else(|| triangles(face.corners, &plane(shape, face.number).0)));
    patches.flatten().collect()
}

/// Unit normal and height of a face.
fn plane(shape: &Solid, number: usize) -> (Vector3<f64>, f64) {
    let radius = shape.bounds.radius;
    if number < OF_CUBE {
        return (Vector3::ith(number / 2, [1.0, -1.0][number % 2]), radius);
    }
    neighbours::face(&shape.normal(number - OF_CUBE), shape.offset(number - OF_CUBE), &shape.bounds)
}

/// A polygon as triangles about its middle.
fn triangles(rim: &[Vector3<f64>], normal: &Vector3<f64>) -> Vec<Patch> {
    let middle = rim.iter().sum::<Vector3<f64>>() / rim.len() as f64;
    let next = |i: usize| (i + 1) % rim.len();
    (0..rim.len()).map(|i| Patch::of([middle, middle, rim[i], rim[next(i)]], normal, [0.0; 2])).collect()
}

/// The inner part of a face as triangles, and a strip along each edge, if there are such.
fn with_strips(face: &Outline<'_>, shape: &Solid) -> Option<Vec<Patch>> {
    let normal = plane(shape, face.number).0;
    let inner = inner(face, &normal, shape)?;
    let mut patches = triangles(&inner, &normal);
    for i in 0..inner.len() {
        let next = (i + 1) % inner.len();
        let corners = [inner[i], inner[next], face.corners[i], face.corners[next]];
        patches.push(Patch::of(corners, &normal, cuts(face, i, shape)));
    }
    let least = -FACES_APART * shape.bounds.radius.powi(2);
    patches.iter().all(|patch| patch.least_area() >= least).then_some(patches)
}

/// Normal and offset of the plane beyond the edge from corner i of a face; `None` for the cube.
fn beyond(face: &Outline<'_>, i: usize, shape: &Solid) -> Option<(Vector3<f64>, f64)> {
    let plane = face.beyond[i].checked_sub(OF_CUBE)?;
    Some((shape.normal(plane), shape.offset(plane)))
}

/// For each corner of a face the point where the planes beyond both of its edges begin to be active.
fn inner(face: &Outline<'_>, normal: &Vector3<f64>, shape: &Solid) -> Option<Vec<Vector3<f64>>> {
    let count = face.corners.len();
    let of_corner = |i: usize| {
        let at = face.corners[i];
        let (before, after) = (beyond(face, (i + count - 1) % count, shape)?, beyond(face, i, shape)?);
        let rows = Matrix3::from_rows(&[normal.transpose(), before.0.transpose(), after.0.transpose()]);
        let excess = Vector3::new(0.0, before.0.dot(&at) - before.1, after.0.dot(&at) - after.1);
        let way = rows.try_inverse()? * excess;
        Some(at - (way - way.dot(normal) * normal))
    };
    face.number.checked_sub(OF_CUBE)?;
    (0..count).map(of_corner).collect()
}

/// Where on the edge from corner i the planes beyond the edges before and after it cease to be active.
fn cuts(face: &Outline<'_>, i: usize, shape: &Solid) -> [f64; 2] {
    let count = face.corners.len();
    let (from, to) = (&face.corners[i], &face.corners[(i + 1) % count]);
    let share = |edge: usize, here: &Vector3<f64>, there: &Vector3<f64>| {
        let excess = |x: &Vector3<f64>| beyond(face, edge, shape).map_or(0.0, |(n, d)| n.dot(x) - d);
        excess(here) / (excess(here) - excess(there))
    };
    let low = share((i + count - 1) % count, from, to);
    let high = 1.0 - share((i + 1) % count, to, from);
    if 0.0 < low && low < high && high < 1.0 { [low, high] } else { [0.0; 2] }
}
