//! A boundary in the frame of a particle.

use super::boundary::{Triangle, Wall};
use crate::pose::Pose;
use nalgebra::Vector3;

/// A plane or a triangle in the local frame of a particle.
///
/// Differences to the particle's centre are taken before anything is turned, so that a boundary far from the world origin
/// loses no more than the rounding of its own coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed {
    /// Unit normal.
    pub normal: Vector3<f64>,
    /// Where the plane is nearest to the centre: `offset` times the normal.
    pub foot: Vector3<f64>,
    /// Distance of the plane from the centre along the normal; negative where the centre is in front of it.
    pub offset: f64,
    /// Length that the rounding of the plane's place is proportional to: that of the farthest point by which it is given, times
    /// the condition of its normal.
    pub farthest: f64,
    /// Of a triangle.
    pub corners: Option<Corners>,
}

/// The vertices and edges of a triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corners {
    pub at: [Vector3<f64>; 3],
    /// Edge i lies between the vertices i and i + 1.
    pub edges: [Edge; 3],
}

/// An edge. It is solved in one direction, whatever triangle it is seen as part of, so that all find the same numbers on it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    /// The vertices at its beginning and end.
    pub ends: [usize; 2],
    /// Where it begins.
    pub from: Vector3<f64>,
    /// Unit vector.
    pub along: Vector3<f64>,
    pub length: f64,
    /// Unit vector in the plane to the inside of the triangle, at right angles to the edge.
    pub inwards: Vector3<f64>,
}

impl Placed {
    pub fn wall(wall: &Wall, pose: &Pose) -> Self {
        let to_point = wall.point - pose.position();
        Self::plane(&wall.normal, &to_point, to_point.norm(), pose)
    }

    pub fn triangle(triangle: &Triangle, pose: &Pose) -> Self {
        let vertices = &triangle.vertices;
        let from_centre = vertices.map(|vertex| vertex - pose.position());
        let at = from_centre.map(|vertex| pose.rotation().tr_mul(&vertex));
        let farthest = at.iter().map(|y| y.norm()).fold(0.0, f64::max);
        let plane = Self::plane(&triangle.normal, &from_centre[triangle.base], farthest * triangle.condition, pose);
        let edges = [0, 1, 2].map(|i| {
            let j = (i + 1) % 3;
            Edge::new(&at, [i, j], comes_before(&vertices[j], &vertices[i]), &plane.normal)
        });
        Self { corners: Some(Corners { at, edges }), ..plane }
    }

    fn plane(normal: &Vector3<f64>, to_point: &Vector3<f64>, farthest: f64, pose: &Pose) -> Self {
        let offset = normal.dot(to_point);
        let normal = pose.rotation().tr_mul(normal);
        Self { normal, foot: offset * normal, offset, farthest, corners: None }
    }

    /// The point nearest to the centre.
    pub fn nearest(&self) -> Vector3<f64> {
        let Some(corners) = &self.corners else { return self.foot };
        let (mut nearest, mut least) = (self.foot, f64::INFINITY);
        for edge in corners.edges.iter().filter(|edge| edge.is_passed_by(&self.foot)) {
            let on_edge = edge.nearest();
            let square = on_edge.norm_squared();
            if square < least {
                (nearest, least) = (on_edge, square);
            }
        }
        nearest
    }

    /// Bound on the distance from a point of the boundary to any other.
    pub fn extent(&self, from: &Vector3<f64>) -> f64 {
        match &self.corners {
            Some(corners) => corners.at.iter().map(|corner| (corner - from).norm()).fold(0.0, f64::max),
            None => f64::INFINITY,
        }
    }
}

impl Edge {
    fn new(at: &[Vector3<f64>; 3], [i, j]: [usize; 2], reversed: bool, normal: &Vector3<f64>) -> Self {
        let ends = if reversed { [j, i] } else { [i, j] };
        let from = at[ends[0]];
        let whole = at[ends[1]] - from;
        let length = whole.norm();
        // Of an edge that is lost beside its distance, any direction is as good.
        let along = if length > 0.0 { whole / length } else { Vector3::x() };
        let across = normal.cross(&along);
        Self { ends, from, along, length, inwards: if reversed { -across } else { across } }
    }

    /// Whether a point of the plane lies beyond it, outside the triangle.
    pub fn is_passed_by(&self, x: &Vector3<f64>) -> bool {
        (x - self.from).dot(&self.inwards) < 0.0
    }

    /// The point nearest to the centre.
    pub fn nearest(&self) -> Vector3<f64> {
        self.from + (-self.from.dot(&self.along)).clamp(0.0, self.length) * self.along
    }

    /// Length that the rounding of its place is proportional to.
    pub fn farthest(&self, corners: &Corners) -> f64 {
        self.ends.iter().map(|i| corners.at[*i].norm()).fold(0.0, f64::max)
    }
}

/// Order of points by their coordinates.
fn comes_before(a: &Vector3<f64>, b: &Vector3<f64>) -> bool {
    a.iter().partial_cmp(b.iter()) == Some(std::cmp::Ordering::Less)
}
