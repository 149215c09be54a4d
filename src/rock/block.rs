//! A block of rock.

use crate::particle::particle::{Particle, ParticleError};
use crate::particle::plane::Plane;
use crate::particle::polyhedron::Polyhedron;
use nalgebra::{Matrix3, Vector3};

/// What a face of a block comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FaceOf {
    /// A plane of the domain, by its index.
    Domain(usize),
    /// A joint, by its index.
    Joint(usize),
    /// A plane of a region, by their indices.
    Region {
        /// Index of the region.
        region: usize,
        /// Index of the plane in it.
        plane: usize,
    },
}

/// A face of a block.
#[derive(Clone, Debug)]
pub struct BlockFace {
    /// What it comes from.
    pub of: FaceOf,
    /// Unit outward normal and offset, axes and origin of the domain.
    pub plane: Plane,
    /// Area.
    pub area: f64,
    /// Corners, counter-clockwise from outside, axes and origin of the domain.
    pub corners: Vec<Vector3<f64>>,
}

/// A convex block.
#[derive(Clone, Debug)]
pub struct Block {
    /// Volume.
    pub volume: f64,
    /// Centroid, axes and origin of the domain.
    pub centroid: Vector3<f64>,
    /// Its faces.
    pub faces: Vec<BlockFace>,
    /// Blocks of the same number were one before regions cut it: where none of them lies inside a region they are still one piece of rock.
    pub parent: usize,
    /// The region that it lies in, by its index.
    pub region: Option<usize>,
}

/// Volume and surface of a polyhedron.
pub(super) fn volume_and_area(polyhedron: &Polyhedron) -> (f64, f64) {
    // About a corner, so that no digits are lost far from the origin.
    let pole = polyhedron.corners().next().copied().unwrap_or_else(Vector3::zeros);
    let (mut six_volumes, mut area) = (0.0, 0.0);
    for face in polyhedron.faces() {
        let first = face.corners[0].0 - pole;
        let mut doubled = Vector3::zeros();
        for pair in face.corners[1..].windows(2) {
            let [b, c] = [pair[0].0 - pole, pair[1].0 - pole];
            six_volumes += first.dot(&b.cross(&c));
            doubled += (b - first).cross(&(c - first));
        }
        area += 0.5 * doubled.norm();
    }
    (six_volumes / 6.0, area)
}

impl Block {
    /// From a polyhedron about `origin`; `plane`: what its faces come from and their unit normals and heights, by their numbers.
    pub(super) fn of(
        polyhedron: &Polyhedron,
        origin: &Vector3<f64>,
        plane: impl Fn(usize) -> (FaceOf, Vector3<f64>, f64),
    ) -> Self {
        let faces = polyhedron.faces().into_iter();
        let faces: Vec<(usize, Vec<Vector3<f64>>)> =
            faces.map(|face| (face.number, face.corners.iter().map(|corner| corner.0).collect())).collect();
        // About a corner of the block, so that no digits are lost far from the origin.
        let pole = faces[0].1[0];
        let inside = polyhedron.middle();
        let (mut volume, mut moment) = (0.0, Vector3::zeros());
        let made = faces.iter().map(|(number, corners)| {
            let mut doubled = Vector3::zeros();
            for pair in corners[1..].windows(2) {
                let [a, b, c] = [corners[0] - pole, pair[0] - pole, pair[1] - pole];
                let six = a.dot(&b.cross(&c));
                volume += six / 6.0;
                moment += six / 24.0 * (a + b + c);
                doubled += (b - a).cross(&(c - a));
            }
            let (of, mut normal, mut height) = plane(*number);
            if normal.dot(&inside) > height {
                (normal, height) = (-normal, -height);
            }
            let offset = height + normal.dot(origin);
            let corners = corners.iter().map(|at| at + origin).collect();
            BlockFace { of, plane: Plane { normal, offset }, area: 0.5 * doubled.norm(), corners }
        });
        let made = made.collect();
        Self { volume, centroid: origin + (pole + moment / volume), faces: made, parent: 0, region: None }
    }

    /// Moments and products of inertia about its centroid for density 1, axes of the domain: ∫ (|x|² 1 − x xᵀ) dV.
    pub fn inertia(&self) -> Matrix3<f64> {
        // Over a tetrahedron at the centroid with the corners a, b, c beyond: ∫ x xᵀ = V/20 (a aᵀ + b bᵀ + c cᵀ + s sᵀ), s = a + b + c.
        let mut second = Matrix3::zeros();
        for face in &self.faces {
            for pair in face.corners[1..].windows(2) {
                let [a, b, c] = [face.corners[0] - self.centroid, pair[0] - self.centroid, pair[1] - self.centroid];
                let squares = [a, b, c, a + b + c].iter().map(|x| x * x.transpose()).sum::<Matrix3<f64>>();
                second += a.dot(&b.cross(&c)) / 120.0 * squares;
            }
        }
        Matrix3::from_diagonal_element(second.trace()) - second
    }

    /// The block as a particle about its centroid, its edges and corners rounded by r, length, with faces where they are (k = 0).
    ///
    /// # Errors
    /// As of [`Particle::new`]: r that is not above 0, or not below the distance of the nearest face from the centroid.
    pub fn particle(&self, r: f64) -> Result<Particle, ParticleError> {
        let planes: Vec<Plane> = self.faces.iter().map(|face| self.about_centroid(face, r)).collect();
        Particle::new(&planes, r, 0.0, 1.0)
    }

    fn about_centroid(&self, face: &BlockFace, r: f64) -> Plane {
        let normal = face.plane.normal;
        Plane { normal, offset: face.plane.offset - normal.dot(&self.centroid) - r }
    }
}
