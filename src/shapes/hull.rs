//! The convex hull of points as triangles, exact: which side of a plane a point lies on is decided without rounding (J.
//! R. Shewchuk's predicates, by the crate `robust`).
//!
//! Quickhull (Barber, Dobkin and Huhdanpaa 1996): a tetrahedron grows by the farthest point above one of its triangles.
//! The triangles below that point are connected; those in whose plane it lies do not count. Triangles from the point to
//! the edges around them take their place. Each point is kept with one triangle that it lies above.

use super::error::{ShapeError, refuse_extent};
use super::numbers::ZERO_COORDINATE;
use crate::particle::coplanar;
use nalgebra::Vector3;
use robust::{Coord3D, orient3d};

/// A triangle of the hull, corners counter-clockwise from outside.
struct Triangle {
    corners: [u32; 3],
    /// The triangle beyond the edge from each corner to the next one.
    beyond: [u32; 3],
    /// The points above it that are kept with it.
    above: Vec<u32>,
    is_left: bool,
}

impl Triangle {
    fn new(corners: [u32; 3], beyond: [u32; 3]) -> Self {
        Self { corners, beyond, above: Vec::new(), is_left: true }
    }
}

/// The triangles of the convex hull, corners counter-clockwise from outside; neighbours may lie in one plane.
///
/// # Errors
/// Points that are not finite, fewer than four, all in a plane, or whose extent is out of range.
pub(super) fn triangles(points: &[Vector3<f64>]) -> Result<Vec<[u32; 3]>, ShapeError> {
    if let Some(index) = points.iter().position(|point| !point.iter().all(|c| c.is_finite())) {
        return Err(ShapeError::PointNotFinite(index));
    }
    if points.len() < 4 {
        return Err(ShapeError::TooFewPoints(points.len()));
    }
    let flat = ShapeError::Flat(points.len());
    let extent = coplanar::extent(points);
    if extent == 0.0 {
        return Err(flat);
    }
    refuse_extent(extent)?;
    // By a power of two, which changes no digit.
    let scale = 2f64.powi(-(extent.log2().floor() as i32));
    let share = |c: f64| if c.abs() > ZERO_COORDINATE { c } else { 0.0 };
    let points: Vec<Vector3<f64>> = points.iter().map(|point| (point * scale).map(share)).collect();
    let mut hull = Hull::of_tetrahedron(&points).ok_or(flat)?;
    let mut open: Vec<u32> = (0..4).collect();
    while let Some(triangle) = open.pop() {
        if let Some(point) = hull.farthest(triangle) {
            let first = hull.triangles.len() as u32;
            hull.add(point, triangle);
            open.extend(first..hull.triangles.len() as u32);
        }
    }
    Ok(hull.triangles.iter().filter(|triangle| triangle.is_left).map(|triangle| triangle.corners).collect())
}

struct Hull<'a> {
    points: &'a [Vector3<f64>],
    triangles: Vec<Triangle>,
    /// Of a point that is being added: the triangles that it sees, and for each corner the edge around them that begins
    /// there.
    seen: Vec<u32>,
    leaving: Vec<u32>,
}

impl<'a> Hull<'a> {
    /// Of four points that enclose a volume: two far apart, one far from their line, one far from that plane.
    fn of_tetrahedron(points: &'a [Vector3<f64>]) -> Option<Self> {
        let farthest = |distance: &dyn Fn(&Vector3<f64>) -> f64| {
            (0..points.len()).max_by(|&i, &j| distance(&points[i]).total_cmp(&distance(&points[j]))).unwrap_or(0)
        };
        let a = farthest(&|p| (p - points[0]).norm());
        let b = farthest(&|p| (p - points[a]).norm());
        let along = points[b] - points[a];
        let c = farthest(&|p| along.cross(&(p - points[a])).norm());
        let mut hull = Self { points, triangles: Vec::new(), seen: Vec::new(), leaving: vec![u32::MAX; points.len()] };
        let plane = [a, b, c].map(|i| i as u32);
        let d = farthest(&|p| above(points, plane, p).abs());
        let height = above(points, plane, &points[d]);
        if height == 0.0 {
            return None;
        }
        let [a, b, c] = if height < 0.0 { plane } else { [plane[0], plane[2], plane[1]] };
        let d = d as u32;
        // Beyond the edges of the base are the three sides, in the order of their edges; beyond those of a side the
        // base and the other two.
        let sides = [([a, b, c], [1, 2, 3]), ([b, a, d], [0, 3, 2]), ([c, b, d], [0, 1, 3]), ([a, c, d], [0, 2, 1])];
        for (corners, beyond) in sides {
            hull.triangles.push(Triangle::new(corners, beyond));
        }
        hull.hand_out(0..points.len() as u32, 0);
        Some(hull)
    }

    /// Keeps each point with the first triangle, from a number on, that it lies above; a point above none of them is
    /// within the hull.
    fn hand_out(&mut self, points: impl Iterator<Item = u32>, from: usize) {
        for point in points {
            let at = &self.points[point as usize];
            if let Some(triangle) =
                self.triangles[from..].iter_mut().find(|triangle| above(self.points, triangle.corners, at) > 0.0)
            {
                triangle.above.push(point);
            }
        }
    }

    /// Of the points that are kept with a triangle the one farthest above it.
    fn farthest(&self, triangle: u32) -> Option<u32> {
        let Triangle { corners, above: points, .. } = &self.triangles[triangle as usize];
        let heights = points.iter().map(|&point| (above(self.points, *corners, &self.points[point as usize]), point));
        heights.max_by(|(i, _), (j, _)| i.total_cmp(j)).map(|(_, point)| point)
    }

    /// Adds a point that is kept with a triangle.
    fn add(&mut self, point: u32, triangle: u32) {
        let at = self.points[point as usize];
        self.seen.clear();
        self.seen.push(triangle);
        self.triangles[triangle as usize].is_left = false;
        let first = self.triangles.len();
        // The edges around what the point sees, each with the triangle beyond it.
        let (mut edges, mut i) = (Vec::new(), 0);
        while i < self.seen.len() {
            let Triangle { corners, beyond, .. } = self.triangles[self.seen[i] as usize];
            for side in 0..3 {
                let next = &self.triangles[beyond[side] as usize];
                if next.is_left && above(self.points, next.corners, &at) > 0.0 {
                    self.triangles[beyond[side] as usize].is_left = false;
                    self.seen.push(beyond[side]);
                } else if next.is_left {
                    edges.push((corners[side], corners[(side + 1) % 3], beyond[side]));
                }
            }
            i += 1;
        }
        for (i, &(from, to, beyond)) in edges.iter().enumerate() {
            self.leaving[from as usize] = i as u32;
            let other = &mut self.triangles[beyond as usize];
            let side = (0..3).find(|&side| other.corners[side] == to).unwrap_or(0);
            other.beyond[side] = (first + i) as u32;
        }
        for &(from, to, beyond) in &edges {
            self.triangles.push(Triangle::new([from, to, point], [beyond, 0, 0]));
        }
        for (i, &(_, to, _)) in edges.iter().enumerate() {
            let next = first + self.leaving[to as usize] as usize;
            self.triangles[first + i].beyond[1] = next as u32;
            self.triangles[next].beyond[2] = (first + i) as u32;
        }
        for i in 0..self.seen.len() {
            let above = std::mem::take(&mut self.triangles[self.seen[i] as usize].above);
            self.hand_out(above.into_iter().filter(|&other| other != point), first);
        }
    }
}

/// Above 0 for a point above the plane of three points, which are counter-clockwise as seen from above; its sign is
/// exact.
fn above(points: &[Vector3<f64>], plane: [u32; 3], point: &Vector3<f64>) -> f64 {
    let coordinates = |p: &Vector3<f64>| Coord3D { x: p.x, y: p.y, z: p.z };
    let [a, b, c] = plane.map(|i| coordinates(&points[i as usize]));
    -orient3d(a, b, c, coordinates(point))
}
