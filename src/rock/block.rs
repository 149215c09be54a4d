//! A block of rock.

use crate::particle::outlines::{Outline, Outlines};
use crate::particle::particle::{Particle, ParticleError};
use crate::particle::plane::Plane;
use crate::particle::volume::{self, Enclosed};
use nalgebra::{Matrix3, Vector3};

/// What a face of a block comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BlockFace {
    /// What it comes from.
    pub of: FaceOf,
    /// Unit outward normal and offset, axes and origin of the domain.
    pub plane: Plane,
    /// Area.
    pub area: f64,
    /// The part of it within the true extent of its joint, a disc or polygon; the rest was rock. All of it where the
    /// joint has no end, 0 on other planes.
    pub jointed_area: f64,
    /// Its corners among those of the block.
    first: u32,
    count: u32,
}

/// A convex block.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Block {
    /// Volume.
    pub volume: f64,
    /// Centroid, axes and origin of the domain.
    pub centroid: Vector3<f64>,
    /// Its faces.
    pub faces: Vec<BlockFace>,
    /// Corners of all faces, one face after the other ([`Block::corners_of`]), axes and origin of the domain.
    pub corners: Vec<Vector3<f64>>,
    /// Blocks of the same number were one before regions cut it: where none of them lies inside a region they are still
    /// one piece of rock.
    pub parent: usize,
    /// The region that it lies in, by its index.
    pub region: Option<usize>,
}

impl Block {
    /// From the faces of a polyhedron about `origin`, and a point inside; `plane`: what they come from and their unit
    /// normals and heights, by their numbers; `shared`: what a joint's extent shares with corners in its plane, `None`
    /// of one without end.
    pub(super) fn of(
        outlines: &Outlines,
        inside: &Vector3<f64>,
        origin: &Vector3<f64>,
        plane: impl Fn(usize) -> (FaceOf, Vector3<f64>, f64),
        shared: impl Fn(usize, &[Vector3<f64>]) -> Option<f64>,
    ) -> Self {
        let mut faces = Vec::with_capacity(outlines.len());
        let mut all = Vec::with_capacity(outlines.corner_count());
        let mut enclosed = Enclosed::about(outlines.iter().next().map_or_else(Vector3::zeros, |face| face.corners[0]));
        for Outline { number, corners, .. } in outlines.iter() {
            let area = enclosed.add(corners.iter().copied());
            let (of, mut normal, mut height) = plane(number);
            if normal.dot(inside) > height {
                (normal, height) = (-normal, -height);
            }
            let plane = Plane { normal, offset: height + normal.dot(origin) };
            let (first, count) = (all.len() as u32, corners.len() as u32);
            all.extend(corners.iter().map(|at| at + origin));
            let jointed_area = match of {
                FaceOf::Joint(joint) => shared(joint, corners).map_or(area, |shared| shared.min(area)),
                _ => 0.0,
            };
            faces.push(BlockFace { of, plane, area, jointed_area, first, count });
        }
        let centroid = origin + enclosed.centroid();
        Self { volume: enclosed.volume, centroid, faces, corners: all, parent: 0, region: None }
    }

    /// Corners of one of its faces, counter-clockwise from outside, axes and origin of the domain.
    pub fn corners_of(&self, face: &BlockFace) -> &[Vector3<f64>] {
        &self.corners[face.first as usize..][..face.count as usize]
    }

    /// Moments and products of inertia about its centroid for density 1, axes of the domain: ∫ (|x|² 1 − x xᵀ) dV.
    pub fn inertia(&self) -> Matrix3<f64> {
        volume::inertia(&self.centroid, self.faces.iter().map(|face| self.corners_of(face).iter().copied()))
    }

    /// The block as a particle about its centroid, its edges and corners rounded by r, length, with faces where they
    /// are (k = 0).
    ///
    /// # Errors
    /// As of [`Particle::new`]: r that is not above 0, or not below the distance of the nearest face from the centroid.
    pub fn particle(&self, r: f64) -> Result<Particle, ParticleError> {
        let planes: Vec<Plane> = self.faces.iter().map(|face| self.about_centroid(face, r)).collect();
        let limit = planes.iter().map(|plane| plane.offset + r).fold(f64::INFINITY, f64::min);
        if r >= limit {
            return Err(ParticleError::RoundingTooLarge { r, limit });
        }
        Particle::new(&planes, r, 0.0, 1.0)
    }

    fn about_centroid(&self, face: &BlockFace, r: f64) -> Plane {
        let normal = face.plane.normal;
        Plane { normal, offset: face.plane.offset - normal.dot(&self.centroid) - r }
    }
}
