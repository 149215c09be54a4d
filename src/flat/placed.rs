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

/// The vertices of a triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corners {
    pub at: [Vector3<f64>; 3],
    /// Whether edge i runs from vertex i + 1 to vertex i when it is solved: an edge has one direction, whatever triangle it is
    /// seen as part of, so that all find the same numbers on it.
    reversed: [bool; 3],
}

/// An edge in its own direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    /// The vertices at its beginning and end.
    pub ends: [usize; 2],
    /// Where it begins.
    pub from: Vector3<f64>,
    /// Unit vector.
    pub along: Vector3<f64>,
    pub length: f64,
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
        let reversed = [0, 1, 2].map(|i| comes_before(&vertices[(i + 1) % 3], &vertices[i]));
        let plane = Self::plane(&triangle.normal, &from_centre[triangle.base], farthest * triangle.condition, pose);
        Self { corners: Some(Corners { at, reversed }), ..plane }
    }

    fn plane(normal: &Vector3<f64>, to_point: &Vector3<f64>, farthest: f64, pose: &Pose) -> Self {
        let offset = normal.dot(to_point);
        let normal = pose.rotation().tr_mul(normal);
        Self { normal, foot: offset * normal, offset, farthest, corners: None }
    }

    /// The point nearest to the centre.
    pub fn nearest(&self) -> Vector3<f64> {
        let Some(corners) = &self.corners else { return self.foot };
        if corners.outside(&self.foot, &self.normal) == [false; 3] {
            return self.foot;
        }
        let on_edges = [0, 1, 2].map(|i| corners.edge(i).nearest());
        let nearer = |p: Vector3<f64>, q: Vector3<f64>| if q.norm_squared() < p.norm_squared() { q } else { p };
        nearer(nearer(on_edges[0], on_edges[1]), on_edges[2])
    }

    /// Bound on the distance from a point of the boundary to any other.
    pub fn extent(&self, from: &Vector3<f64>) -> f64 {
        match &self.corners {
            Some(corners) => corners.at.iter().map(|corner| (corner - from).norm()).fold(0.0, f64::max),
            None => f64::INFINITY,
        }
    }
}

impl Corners {
    /// Edge i, between the vertices i and i + 1.
    pub fn edge(&self, i: usize) -> Edge {
        let ends = if self.reversed[i] { [(i + 1) % 3, i] } else { [i, (i + 1) % 3] };
        let from = self.at[ends[0]];
        let whole = self.at[ends[1]] - from;
        let length = whole.norm();
        // Of an edge that is lost beside its distance, any direction is as good.
        let along = if length > 0.0 { whole / length } else { Vector3::x() };
        Edge { ends, from, along, length }
    }

    /// Unit vector in the plane from edge i to the inside of the triangle, at right angles to it.
    pub fn inwards(&self, i: usize, normal: &Vector3<f64>) -> Vector3<f64> {
        let edge = self.edge(i);
        let across = normal.cross(&edge.along);
        if self.reversed[i] { -across } else { across }
    }

    /// Whether a point of the plane lies beyond each edge.
    pub fn outside(&self, x: &Vector3<f64>, normal: &Vector3<f64>) -> [bool; 3] {
        [0, 1, 2].map(|i| (x - self.edge(i).from).dot(&self.inwards(i, normal)) < 0.0)
    }
}

impl Edge {
    /// The point nearest to the centre.
    pub fn nearest(&self) -> Vector3<f64> {
        self.from + (-self.from.dot(&self.along)).clamp(0.0, self.length) * self.along
    }

    /// Length that the rounding of its place is proportional to.
    pub fn farthest(&self, corners: &Corners) -> f64 {
        let [begin, end] = self.ends.map(|i| corners.at[i].norm());
        begin.max(end)
    }
}

/// Order of points by their coordinates.
fn comes_before(a: &Vector3<f64>, b: &Vector3<f64>) -> bool {
    a.iter().partial_cmp(b.iter()) == Some(std::cmp::Ordering::Less)
}
