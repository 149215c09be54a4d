//! Planes and triangles as given, checked.

use crate::answer::words;
use crate::linalg::number::{direction, gamma};
use crate::linalg::wide::{difference, rounded};
use crate::pair::boundary_part::BoundaryPart;
use nalgebra::Vector3;
use thiserror::Error;

/// Why numbers do not make a flat boundary.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum BoundaryError {
    /// A point of the boundary is not finite.
    #[error("point ({0:?}, {1:?}, {2:?}) of a boundary is not finite: leave out boundaries without a place")]
    Point(f64, f64, f64),
    /// The normal of a plane has no direction.
    #[error("normal ({0:?}, {1:?}, {2:?}) of a plane has no direction: give a finite vector that is not zero")]
    Normal(f64, f64, f64),
    /// The corners of a triangle lie on a line, as far as doubles tell.
    #[error("a triangle has the area {0:e}, which is zero to rounding: remove it from the mesh")]
    Area(f64),
}

/// The part of a boundary on which a point lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(u32)]
pub enum Feature {
    /// The plane, or the inside of the triangle.
    Interior = 0,
    /// The edge between the vertices 0 and 1.
    Edge0 = 1,
    /// Between 1 and 2.
    Edge1 = 2,
    /// Between 2 and 0.
    Edge2 = 3,
    /// Vertex 0.
    Vertex0 = 4,
    /// Vertex 1.
    Vertex1 = 5,
    /// Vertex 2.
    Vertex2 = 6,
}

words!(Feature, "u4", |feature| (feature as u32));

impl Feature {
    const ALL: [Self; 7] =
        [Self::Interior, Self::Edge0, Self::Edge1, Self::Edge2, Self::Vertex0, Self::Vertex1, Self::Vertex2];

    /// From its number, 0 to 6.
    #[cfg(feature = "capi")]
    pub(crate) fn from_number(number: u32) -> Option<Self> {
        Self::ALL.get(number as usize).copied()
    }

    pub(super) fn of_edge(i: usize) -> Self {
        Self::ALL[1 + i]
    }

    pub(super) fn of_vertex(i: usize) -> Self {
        Self::ALL[4 + i]
    }

    /// i of an edge, which joins the vertices i and i + 1 (of edge 2: 2 and 0).
    pub fn edge(self) -> Option<usize> {
        (self as usize).checked_sub(1).filter(|i| *i < 3)
    }

    /// i of a vertex.
    pub fn vertex(self) -> Option<usize> {
        (self as usize).checked_sub(4)
    }
}

/// A plane, which a particle touches from either side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall {
    /// Any point of it, world frame.
    pub(super) point: Vector3<f64>,
    /// Unit normal, world frame, and as it was given.
    pub(super) normal: Vector3<f64>,
    given: Vector3<f64>,
}

impl Wall {
    /// Through a point, with a normal of any length.
    ///
    /// # Errors
    /// A point or normal that is not finite, or a normal of length zero.
    pub fn new(point: [f64; 3], normal: [f64; 3]) -> Result<Self, BoundaryError> {
        let [x, y, z] = normal;
        let given = normal.into();
        let normal = direction(&given).ok_or(BoundaryError::Normal(x, y, z))?;
        Ok(Self { point: finite(point)?, normal, given })
    }

    /// How far a point lies before it, along the normal.
    pub(crate) fn height(&self, point: &Vector3<f64>) -> f64 {
        self.normal.dot(&(point - self.point))
    }

    pub(crate) fn is_horizontal(&self) -> bool {
        self.normal.x == 0.0 && self.normal.y == 0.0
    }

    pub(super) fn part(&self) -> BoundaryPart {
        BoundaryPart::Plane { point: self.point, normal: self.normal, given: self.given }
    }
}

/// A closed triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// World frame.
    pub(super) vertices: [Vector3<f64>; 3],
    /// Unit normal, world frame: from its front the vertices run counter-clockwise.
    pub(super) normal: Vector3<f64>,
    /// The vertex between the two shorter sides, from which the normal is known best, and 1/sin of their angle.
    base: usize,
    condition: f64,
}

/// Sine of the angle between the two shorter sides, below which it is rounding: each side is off by a unit of rounding,
/// and so is each product of their components. Derived: 7u.
const FLAT: f64 = gamma(32);

/// The same sine below which the normal is taken from numbers of 32 digits: the rounding of the sides, over the sine,
/// turns it. Derived: some 7u over the sine, which [`crate::model::problem::TURN`] covers.
const NARROW: f64 = 0.5;

impl Triangle {
    /// With these vertices.
    ///
    /// # Errors
    /// A vertex that is not finite, or vertices on one line (to rounding).
    pub fn new(vertices: [[f64; 3]; 3]) -> Result<Self, BoundaryError> {
        let [a, b, c] = vertices;
        let vertices = [finite(a)?, finite(b)?, finite(c)?];
        let opposite = |i: usize| vertices[(i + 2) % 3] - vertices[(i + 1) % 3];
        let length = |i: usize| opposite(i).amax();
        let base = (0..3).fold(0, |longest, i| if length(i) > length(longest) { i } else { longest });
        // In units of the longest side no product leaves the range of doubles.
        let unit = length(base);
        let (next, last) = ((base + 1) % 3, (base + 2) % 3);
        let sides = [next, last].map(|i| (vertices[i] - vertices[base]) / unit);
        let cross = sides[0].cross(&sides[1]);
        let (area, product) = (cross.norm(), sides[0].norm() * sides[1].norm());
        if !(area > FLAT * product && product.is_finite()) {
            return Err(BoundaryError::Area(0.5 * area * unit * unit));
        }
        let normal = if area > NARROW * product { cross / area } else { precise_normal(&vertices, base, unit) };
        Ok(Self { vertices, normal, base, condition: product / area })
    }

    /// The vertices, world frame.
    pub(crate) fn vertices(&self) -> &[Vector3<f64>; 3] {
        &self.vertices
    }

    /// Unit normal, world frame: from its front the vertices run counter-clockwise.
    pub(crate) fn normal(&self) -> &Vector3<f64> {
        &self.normal
    }

    /// Its plane.
    pub(super) fn inside(&self) -> BoundaryPart {
        let vertices = [0, 1, 2].map(|i| self.vertices[(self.base + i) % 3]);
        BoundaryPart::Inside { vertices, normal: self.normal, condition: self.condition }
    }

    /// Edge i, between the vertices i and i + 1, in the order of their coordinates; and whether that is the other way
    /// round.
    pub(super) fn edge(&self, i: usize) -> ([Vector3<f64>; 2], bool) {
        let (from, to) = (self.vertices[i], self.vertices[(i + 1) % 3]);
        let reversed = to.iter().partial_cmp(from.iter()) == Some(std::cmp::Ordering::Less);
        (if reversed { [to, from] } else { [from, to] }, reversed)
    }
}

/// The unit normal of a narrow triangle, from its sides at `base` in units of its longest one.
fn precise_normal(vertices: &[Vector3<f64>; 3], base: usize, unit: f64) -> Vector3<f64> {
    let side = |i: usize| difference(&vertices[(base + i) % 3], &vertices[base]).map(|c| c * (1.0 / unit));
    let normal = rounded(&side(1).cross(&side(2)));
    normal / normal.norm()
}

fn finite(point: [f64; 3]) -> Result<Vector3<f64>, BoundaryError> {
    let [x, y, z] = point;
    if point.iter().all(|c| c.is_finite()) { Ok(point.into()) } else { Err(BoundaryError::Point(x, y, z)) }
}
