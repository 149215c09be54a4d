//! The mesh of a particle: the convex hull of points on its surface, of which one more is added where the surface may
//! rise most above a triangle, until that is below a tolerance.
//!
//! The points lie on a convex surface, so that the mesh lies inside; how far the surface can rise above a triangle is
//! bounded by the tangent planes at its corners. Where two or three of these planes meet, the next point is taken: on a
//! polyhedron that is an edge or a corner, which a sharp particle so gets after a few points. A point splits one
//! triangle, then flips of diagonals make the mesh convex again; neither can open it.

use super::numbers::{FEW_VERTICES, FINEST, FINEST_IN_PLANE, Limits, NEAR_EDGE, ROUNDED, VERTICES_BY_TOLERANCE};
use super::tangent_bound::{Rise, SurfacePoint, rise};
use super::triangulation::Triangulation;
use crate::linalg::number::direction;
use crate::particle::particle::Particle;
use crate::particle::ray_cast;
use crate::section::outline::outline;
use nalgebra::Vector3;
use std::cmp::Ordering;
use std::collections::BinaryHeap;
use thiserror::Error;

/// A closed mesh of triangles in the local frame of a particle, inside the particle and with its corners on the
/// surface.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SurfaceMesh {
    /// Corners, length.
    pub vertices: Vec<Vector3<f64>>,
    /// Outward unit normals of the surface at the corners.
    pub normals: Vec<Vector3<f64>>,
    /// Indices of three corners each, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
    /// No point of the surface is further from the mesh, length.
    pub error: f64,
}

/// Why there is no mesh.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[allow(missing_docs)]
pub enum MeshError {
    #[error(
        "mesh tolerance {0:?} is outside [1e-5, 1], in the plane [1e-9, 1]: give the distance to the surface over the \
         radius of the particle"
    )]
    Tolerance(f64),
    #[error("a ray from the centre finds no surface: scale the particle to a size near 1")]
    NoSurface,
}

impl SurfaceMesh {
    /// The mesh whose distance to the surface is at most `tolerance` times the bounding radius. In the plane: vertices
    /// are those of a polygon inside the outline, in order, and triangles fill it.
    ///
    /// # Errors
    /// A tolerance outside [1e-5, 1] (in the plane [1e-9, 1]), or a particle on whose surface rounding leaves no point.
    pub fn of(particle: &Particle, tolerance: f64) -> Result<Self, MeshError> {
        let finest = if particle.is_in_plane() { FINEST_IN_PLANE } else { FINEST };
        if !(finest..=1.0).contains(&tolerance) {
            return Err(MeshError::Tolerance(tolerance));
        }
        if particle.is_in_plane() {
            return Self::in_plane(particle, tolerance);
        }
        let mut refinement = Refinement::start(particle, tolerance).ok_or(MeshError::NoSurface)?;
        refinement.run();
        Ok(refinement.finish())
    }

    fn in_plane(particle: &Particle, tolerance: f64) -> Result<Self, MeshError> {
        let (points, error) = outline(particle, tolerance * particle.bounding_radius());
        let vertices: Vec<Vector3<f64>> = points.iter().map(|point| point.push(0.0)).collect();
        let normals: Option<Vec<_>> = vertices.iter().map(|vertex| direction(&particle.gradient(vertex))).collect();
        let triangles = (2..vertices.len() as u32).map(|i| [0, i - 1, i]).collect();
        Ok(Self { vertices, normals: normals.ok_or(MeshError::NoSurface)?, triangles, error })
    }
}

/// A triangle that is to be refined. The greatest bound comes first.
#[derive(Debug)]
struct Candidate {
    triangle: u32,
    corners: [u32; 3],
    rise: Rise,
}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        // The number of the triangle makes the order, and so the mesh, the same on every machine.
        self.rise.bound.total_cmp(&other.rise.bound).then(other.triangle.cmp(&self.triangle))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Candidate {}

/// A mesh in the making; lengths in units of the bounding radius.
struct Refinement<'a> {
    particle: &'a Particle,
    tolerance: f64,
    points: Vec<SurfacePoint>,
    mesh: Triangulation,
    candidates: BinaryHeap<Candidate>,
}

impl<'a> Refinement<'a> {
    fn start(particle: &'a Particle, tolerance: f64) -> Option<Self> {
        let (mesh, candidates) = (Triangulation::octahedron(), BinaryHeap::new());
        let mut start = Self { particle, tolerance, points: Vec::new(), mesh, candidates };
        for axis in 0..3 {
            for sign in [1.0, -1.0] {
                start.points.push(start.surface_point(&Vector3::ith(axis, sign))?);
            }
        }
        let all: Vec<u32> = (0..start.mesh.len()).collect();
        start.make_convex(all.iter().flat_map(|&t| [0, 1, 2].map(|i| (t, i))).collect());
        for t in all {
            start.consider(t);
        }
        Some(start)
    }

    fn run(&mut self) {
        let most = (FEW_VERTICES + VERTICES_BY_TOLERANCE / self.tolerance) as usize;
        while let Some(Candidate { triangle, corners, rise }) = self.candidates.pop() {
            // Triangles change after they were considered; then they have been considered again.
            if self.points.len() >= most {
                break;
            }
            if self.mesh.triangle(triangle).corners == corners {
                self.refine(triangle, rise.place);
            }
        }
    }

    fn finish(self) -> SurfaceMesh {
        let radius = self.particle.bounding_radius();
        let error = (0..self.mesh.len()).map(|t| self.rise(t).bound).fold(0.0, f64::max) * radius;
        SurfaceMesh {
            vertices: self.points.iter().map(|point| point.position * radius).collect(),
            normals: self.points.iter().map(|point| point.normal).collect(),
            triangles: self.mesh.corners().collect(),
            error,
        }
    }

    /// Where the ray from the centre meets the surface; `direction` of any length.
    fn surface_point(&self, direction: &Vector3<f64>) -> Option<SurfacePoint> {
        let direction = direction.try_normalize(0.0)?;
        let distance = ray_cast::distance(self.particle, &Vector3::zeros(), &direction)?;
        let normal = self.particle.gradient(&(distance * direction)).try_normalize(0.0)?;
        let position = distance / self.particle.bounding_radius() * direction;
        (normal.dot(&position) > 0.0).then_some(SurfacePoint { position, normal })
    }

    fn position(&self, corner: u32) -> &Vector3<f64> {
        &self.points[corner as usize].position
    }

    fn rise(&self, t: u32) -> Rise {
        rise(&self.mesh.triangle(t).corners.map(|corner| self.points[corner as usize]))
    }

    /// Remembers a triangle if the surface may rise too far above it.
    fn consider(&mut self, t: u32) {
        let rise = self.rise(t);
        if rise.bound > self.tolerance {
            self.candidates.push(Candidate { triangle: t, corners: self.mesh.triangle(t).corners, rise });
        }
    }

    /// Adds a point above a place of a triangle. If rounding leaves none, the triangle stays as it is and its bound
    /// enters the error of the mesh.
    fn refine(&mut self, t: u32, place: [f64; 3]) {
        let corners = self.mesh.triangle(t).corners;
        let small = place.map(|part| part < NEAR_EDGE);
        let (place, edge) = match small.iter().filter(|&&s| s).count() {
            0 => (place, None),
            1 => (place, small.iter().position(|&s| s)),
            _ => ([1.0; 3], None),
        };
        let below = |j: usize| if edge == Some(j) { Vector3::zeros() } else { place[j] * self.position(corners[j]) };
        let Some(point) = self.surface_point(&(below(0) + below(1) + below(2))) else { return };
        if corners.iter().any(|&corner| (self.position(corner) - point.position).norm() <= ROUNDED) {
            return;
        }
        let new = self.points.len() as u32;
        self.points.push(point);
        let mut changed = self.mesh.split(t, new).to_vec();
        if let Some(j) = edge {
            // The part on the edge opposite corner j has no extent: its other diagonal takes its place.
            let flat = changed.remove((j + 1) % 3);
            changed.extend(self.mesh.flip(flat, 2));
        }
        let edges = changed.iter().map(|&part| (part, self.corner_place(part, new))).collect();
        changed.extend(self.make_convex(edges));
        changed.sort_unstable();
        changed.dedup();
        for part in changed {
            self.consider(part);
        }
    }

    fn corner_place(&self, t: u32, corner: u32) -> usize {
        let corners = &self.mesh.triangle(t).corners;
        (0..3).find(|&i| corners[i] == corner).expect("the new point is a corner of its triangles")
    }

    /// Flips the edges opposite these corners where the surface bends inwards, and those that this puts in doubt;
    /// returns the triangles that were changed.
    fn make_convex(&mut self, mut edges: Vec<(u32, usize)>) -> Vec<u32> {
        let mut changed = Vec::new();
        let most = Limits::FLIPS * self.mesh.len() as usize;
        while let Some((t, i)) = edges.pop() {
            if changed.len() < 2 * most && self.bends_inwards(t, i) {
                for part in self.mesh.flip(t, i) {
                    edges.push((part, 0));
                    changed.push(part);
                }
            }
        }
        changed
    }

    /// Whether the triangle across the edge opposite corner `i` of t rises above the plane of t, and the other diagonal
    /// gives two triangles that both face away from the centre.
    fn bends_inwards(&self, t: u32, i: usize) -> bool {
        let here = self.mesh.triangle(t);
        let there = self.mesh.triangle(here.beside[i]);
        let opposite = there.corners[self.mesh.place(here.beside[i], t)];
        let [a, b, c] = [i, (i + 1) % 3, (i + 2) % 3].map(|j| self.position(here.corners[j]));
        let d = self.position(opposite);
        let (normal, arm) = ((b - a).cross(&(c - a)), d - a);
        let faces_out = |p: &Vector3<f64>, q: &Vector3<f64>, r: &Vector3<f64>| {
            p.dot(&q.cross(r)) > ROUNDED * (q - p).norm() * (r - p).norm() * p.norm()
        };
        normal.dot(&arm) > ROUNDED * normal.norm() && faces_out(a, b, d) && faces_out(a, d, c)
    }
}
