//! A partition of all directions from the origin into quadrilaterals that follow the faces and edges of a particle.
//!
//! They lie on the polyhedron {n_i·x ≤ d_i + r/√(1−k)} that holds the particle, cut off by a cube about its bounding ball. On a
//! face i, a neighbour j is active beyond the line n_j·x = d_j. The lines of all neighbours bound the inner part of the face,
//! where the surface is that of plane i and the shadow sphere alone; between them and the edges there are strips, as
//! wide as the rounding, which are cut at their ends where a third plane becomes active. For k = 0 these are exactly the places
//! where the second derivatives of the surface jump, but for those in the corners; for k > 0 they are near them.

use crate::linalg::graded_basis;
use crate::particle::shape::Shape;
use nalgebra::{Matrix3, Vector3};

/// A quadrilateral in a plane at a distance `height` from the origin: p(u, v) is bilinear in 0 ≤ u, v ≤ 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patch {
    /// p(0, 0), p(0, 1), p(1, 0), p(1, 1).
    corners: [Vector3<f64>; 4],
    pub height: f64,
    /// Where v is divided to begin with: 0 < `cuts[0]` < `cuts[1]` < 1, or both 0.
    cuts: [f64; 2],
}

/// One face of the polyhedron.
struct Face {
    /// Outward, of unit length.
    normal: Vector3<f64>,
    height: f64,
    /// In order around the face.
    corners: Vec<Vector3<f64>>,
    /// The plane beyond the edge from each corner to the next; `None` for the cube.
    beyond: Vec<Option<usize>>,
}

/// Two planes whose unit normals and heights (in bounding radii) differ by less than this are one.
const SAME: f64 = 1e-9;

/// Rounding of an excess, in units of |n| times the bounding radius.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

impl Patch {
    /// p(u, v), and the area of the image of du dv.
    pub fn at(&self, u: f64, v: f64) -> (Vector3<f64>, f64) {
        let [a, b, c, d] = &self.corners;
        let (inner, outer) = (a + v * (b - a), c + v * (d - c));
        let along = (1.0 - u) * (b - a) + u * (d - c);
        (inner + u * (outer - inner), (outer - inner).cross(&along).norm())
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

/// Patches along the faces of a particle.
pub(crate) fn along_faces(shape: &Shape) -> Vec<Patch> {
    patches(shape, shape.len())
}

/// Patches of a cube alone, which rounding leaves whole: for planes so close to each other that it spoils their edges.
pub(crate) fn plain(shape: &Shape) -> Vec<Patch> {
    patches(shape, 0)
}

/// Effect of overlaps and gaps between patches on the moments, in the measure of the relative error (`mass_properties`) times
/// the volume. The solid angles of all directions add up to 4π, and their ∫e dω to 0: what is missing, and whether it is missing in one
/// place and doubled in another. It counts at the farthest corner. All after the linear map `map`, of whose volume it is.
pub(crate) fn missing_volume(patches: &[Patch], map: &Matrix3<f64>) -> f64 {
    let (mut covered, mut mean, mut farthest) = (0.0, Vector3::zeros(), 0.0_f64);
    for patch in patches {
        let corners = patch.corners.map(|corner| map * corner);
        farthest = corners.iter().map(|corner| corner.norm()).fold(farthest, f64::max);
        let [a, b, c, d] = corners.map(|corner| corner / corner.norm());
        for triangle in [[a, b, d], [a, d, c]] {
            covered += triangle_angle(&triangle[0], &triangle[1], &triangle[2]);
            mean += triangle_mean(&triangle);
        }
    }
    let missing = (covered - 4.0 * std::f64::consts::PI).abs() + mean.norm();
    missing * farthest.powi(3) / 3.0 * (1.0 + farthest).max(farthest * farthest)
}

/// Patches on the first `count` planes, which is all of them or none, and on the cube.
fn patches(shape: &Shape, count: usize) -> Vec<Patch> {
    let half = shape.bounds.radius;
    let count = if shape.is_sphere() { 0 } else { count };
    let cube = (0..3).flat_map(|axis| [1.0, -1.0].map(|sign| (Vector3::ith(axis, sign), half, None)));
    let planes = (0..count).map(|i| {
        let (n, length) = (shape.normal(i), shape.normal(i).norm());
        (n / length, (shape.offset(i) + shape.bounds.face_reach) / length, Some(i))
    });
    let mut patches = Vec::new();
    for (normal, height, plane) in cube.chain(planes) {
        let mut face = Face::square(normal, height, half);
        face.clip_by_cube(half, plane.is_none());
        if count > 0 {
            face.clip_by_planes(shape);
        }
        if face.corners.len() >= 3 && !face.is_known(shape, plane) {
            face.divide(shape, plane, &mut patches);
        }
    }
    patches
}

impl Face {
    /// A square that holds the cut of the cube with the plane n·x = height.
    fn square(normal: Vector3<f64>, height: f64, half: f64) -> Self {
        let side = 4.0 * half;
        let first = graded_basis::any_across(&normal);
        let second = normal.cross(&first);
        let corners = if height <= 2.0 * half {
            [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)]
                .map(|(u, v)| height * normal + side * (u * first + v * second))
                .into()
        } else {
            Vec::new()
        };
        Self { normal, height, beyond: vec![None; corners.len()], corners }
    }

    /// Clips by the faces of the cube, but not one of them by itself.
    fn clip_by_cube(&mut self, half: f64, is_of_cube: bool) {
        for axis in 0..3 {
            for sign in [1.0, -1.0] {
                if !(is_of_cube && sign * self.normal[axis] == 1.0) {
                    self.clip(|x| sign * x[axis] - half, None);
                }
            }
        }
    }

    /// Clips by the plane that cuts off most, again and again.
    fn clip_by_planes(&mut self, shape: &Shape) {
        let bounds = &shape.bounds;
        let limit = bounds.face_reach + ROUNDING * bounds.longest_normal * bounds.radius;
        let mut used = Vec::new();
        loop {
            let worst =
                self.corners.iter().map(|corner| shape.farthest_excess(corner)).max_by(|a, b| a.0.total_cmp(&b.0));
            let Some((excess, plane)) = worst else { return };
            if excess <= limit || used.contains(&plane) {
                return;
            }
            used.push(plane);
            let (n, h) = (shape.normal(plane), shape.offset(plane) + bounds.face_reach);
            self.clip(|x| n.dot(x) - h, Some(plane));
        }
    }

    /// Keeps the part where `excess` is not positive.
    fn clip(&mut self, excess: impl Fn(&Vector3<f64>) -> f64, plane: Option<usize>) {
        let values: Vec<f64> = self.corners.iter().map(&excess).collect();
        let (mut corners, mut beyond) = (Vec::new(), Vec::new());
        for i in 0..values.len() {
            let j = (i + 1) % values.len();
            let crossing =
                || self.corners[i] + values[i] / (values[i] - values[j]) * (self.corners[j] - self.corners[i]);
            if values[i] <= 0.0 {
                corners.push(self.corners[i]);
                beyond.push(self.beyond[i]);
            }
            if values[i] <= 0.0 && values[j] > 0.0 {
                corners.push(crossing());
                beyond.push(plane);
            } else if values[i] > 0.0 && values[j] <= 0.0 {
                corners.push(crossing());
                beyond.push(self.beyond[i]);
            }
        }
        (self.corners, self.beyond) = (corners, beyond);
    }

    fn middle(&self) -> Vector3<f64> {
        self.corners.iter().sum::<Vector3<f64>>() / self.corners.len() as f64
    }

    /// Whether an earlier plane, or for the cube any plane, is the same one.
    fn is_known(&self, shape: &Shape, plane: Option<usize>) -> bool {
        let mut known = false;
        let middle = self.middle();
        shape.visit_near(&middle, 0.0, |j, n, excess| {
            let length = n.norm();
            let apart = (shape.bounds.face_reach - excess).abs() / (length * shape.bounds.radius);
            known |= plane.is_none_or(|i| j < i) && apart <= SAME && (n / length - self.normal).norm() <= SAME;
        });
        known
    }

    /// Its inner part as triangles about their middle, and a strip along each edge; triangles alone where there are no strips.
    fn divide(&self, shape: &Shape, plane: Option<usize>, patches: &mut Vec<Patch>) {
        let inner = plane.and_then(|plane| self.inner(shape, plane));
        let count = self.corners.len();
        let rim = inner.as_ref().unwrap_or(&self.corners);
        let middle = rim.iter().sum::<Vector3<f64>>() / count as f64;
        for i in 0..count {
            let j = (i + 1) % count;
            patches.push(Patch { corners: [middle, middle, rim[i], rim[j]], height: self.height, cuts: [0.0; 2] });
            if let Some(inner) = &inner {
                let corners = [inner[i], inner[j], self.corners[i], self.corners[j]];
                patches.push(Patch { corners, height: self.height, cuts: self.cuts(shape, i) });
            }
        }
    }

    /// Corners of the part of the face where no neighbour is active, if it has as many as the face.
    fn inner(&self, shape: &Shape, plane: usize) -> Option<Vec<Vector3<f64>>> {
        let count = self.corners.len();
        let own = (shape.normal(plane), shape.offset(plane) + shape.bounds.face_reach);
        let edge = |i: usize| self.beyond[i].map(|j| (shape.normal(j), shape.offset(j)));
        let mut inner = Vec::with_capacity(count);
        for i in 0..count {
            let (before, after) = (edge((i + count - 1) % count)?, edge(i)?);
            let rows = Matrix3::from_rows(&[own.0.transpose(), before.0.transpose(), after.0.transpose()]);
            inner.push(rows.try_inverse()? * Vector3::new(own.1, before.1, after.1));
        }
        let forward = |i: usize| {
            let j = (i + 1) % count;
            (inner[j] - inner[i]).dot(&(self.corners[j] - self.corners[i])) > 0.0
        };
        (0..count).all(forward).then_some(inner)
    }

    /// Where on the edge from corner i the planes beyond the edges before and after it cease to be active.
    fn cuts(&self, shape: &Shape, i: usize) -> [f64; 2] {
        let count = self.corners.len();
        let (from, to) = (&self.corners[i], &self.corners[(i + 1) % count]);
        let share = |plane: Option<usize>, here: &Vector3<f64>, there: &Vector3<f64>| {
            let excess = |x: &Vector3<f64>| plane.map_or(0.0, |j| shape.normal(j).dot(x) - shape.offset(j));
            excess(here) / (excess(here) - excess(there))
        };
        let low = share(self.beyond[(i + count - 1) % count], from, to);
        let high = 1.0 - share(self.beyond[(i + 1) % count], to, from);
        if 0.0 < low && low < high && high < 1.0 { [low, high] } else { [0.0; 2] }
    }
}

/// Solid angle of a spherical triangle (Van Oosterom & Strackee 1983), unit corners.
fn triangle_angle(p: &Vector3<f64>, q: &Vector3<f64>, r: &Vector3<f64>) -> f64 {
    // By differences, since the corners may lie close together.
    2.0 * p.dot(&(q - p).cross(&(r - p))).abs().atan2(1.0 + p.dot(q) + q.dot(r) + r.dot(p))
}

/// ∫e dω over a spherical triangle, unit corners: half of the sum over its edges of their angle times the direction across them, pointing inwards.
fn triangle_mean(corners: &[Vector3<f64>; 3]) -> Vector3<f64> {
    let [p, q, r] = corners;
    let sum: Vector3<f64> = [(p, q), (q, r), (r, p)]
        .into_iter()
        .filter_map(|(from, to)| {
            let across = from.cross(&(to - from));
            let sine = across.norm();
            (sine > 0.0).then(|| 0.5 * sine.atan2(from.dot(to)) / sine * across)
        })
        .sum();
    // Of either order of the corners.
    if sum.dot(&(p + q + r)) < 0.0 { -sum } else { sum }
}
