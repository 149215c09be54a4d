//! A sharp convex body, of points or of half-spaces: its faces, corners, volume and centroid.

use super::error::{ShapeError, within};
use super::hull;
use super::numbers::OF_SUMS;
use crate::particle::coplanar::{self, Distinct, Face};
use crate::particle::error::ParticleError;
use crate::particle::largest_ball;
use crate::particle::plane::{MAX_PLANES, Plane};
use crate::particle::polyhedron::OF_CUBE;
use crate::particle::volume::{self, Enclosed};
use crate::rock::{EXTENTS, enclosed, unit_planes};
use nalgebra::{Matrix3, Vector3};

/// Planes, corners and centroid are about `origin`, so that their digits do not depend on how far away the body is.
pub struct SharpBody {
    /// Of the numbers below, in the given frame.
    pub origin: Vector3<f64>,
    /// Of its faces, unit normals: half-spaces in their order, those of points by falling area.
    pub planes: Vec<Plane>,
    /// Its corners.
    pub corners: Vec<Vector3<f64>>,
    /// Its surface, three numbers of corners each, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Its volume.
    pub volume: f64,
    /// The centroid of its volume.
    pub centroid: Vector3<f64>,
}

/// The convex hull of points.
pub(super) struct HullOfPoints {
    pub body: SharpBody,
    pub area: f64,
    /// For each point the planes of the triangles around it: none of a point within the hull.
    pub planes_around: Vec<Vec<u32>>,
}

impl SharpBody {
    /// {n·x ≤ d} of half-spaces, with normals of any length. Those that make no face of their own are left out, the
    /// others keep their order.
    ///
    /// # Errors
    /// Too many half-spaces; those that are none, that hold no point, that leave a side open or whose body is flat.
    pub fn of_planes(half_spaces: &[Plane]) -> Result<Self, ShapeError> {
        refuse_many(half_spaces.len())?;
        let units = unit_planes(half_spaces).map_err(ShapeError::NoPlane)?;
        let (middle, polyhedron) = enclosed(&units).map_err(|error| {
            // Beyond the range of sizes rounding makes them seem empty or open.
            let farthest = units.iter().map(|(_, offset)| offset.abs()).fold(0.0, f64::max);
            if EXTENTS.contains(&farthest) || farthest == 0.0 { error.into() } else { ShapeError::Extent(farthest) }
        })?;
        let (corners, outlines) = polyhedron.numbered();
        let fan = |(_, outline): &(usize, Vec<u32>)| -> Vec<[u32; 3]> {
            outline[1..].windows(2).map(|pair| [outline[0], pair[0], pair[1]]).collect()
        };
        let triangles: Vec<[u32; 3]> = outlines.iter().flat_map(fan).collect();
        let (solid, _) = measured(&corners, outlines.iter().map(|(_, outline)| &outline[..]));
        // No face of the cube that it was cut from is left.
        let numbers: Vec<usize> = outlines.iter().map(|(of, _)| of - OF_CUBE).collect();
        let face =
            |(of, outline): (usize, Vec<u32>)| Face { normal: units[of - OF_CUBE].0, ..Face::new(&corners, outline) };
        let faces: Vec<Face<Vec<u32>>> = outlines.into_iter().map(face).collect();
        let Distinct { planes, .. } = coplanar::distinct(&corners, &faces, 0.0).ok_or(ShapeError::Thin)?;
        let mut kept: Vec<usize> = planes.iter().map(|(face, _)| numbers[*face]).collect();
        kept.sort_unstable();
        let given = |number: usize| {
            let (normal, offset) = units[number];
            Plane { normal, offset }
        };
        let planes = kept.into_iter().map(given).collect();
        let corners: Vec<_> = corners.into_iter().map(|corner| corner + middle).collect();
        let centroid = at_the_origin(middle + solid.centroid(), &corners);
        Ok(Self { origin: Vector3::zeros(), planes, corners, triangles, volume: solid.volume, centroid })
    }

    /// The convex hull of points. Triangles that lie within 1e-6 of its extent of a plane are one face, or within
    /// `known`, the length to which the points are known.
    ///
    /// # Errors
    /// Points that are not finite, fewer than four, or all in a plane; too many faces.
    pub fn of_points(points: &[[f64; 3]], known: f64) -> Result<Self, ShapeError> {
        let (middle, points) = about_middle(points);
        Ok(HullOfPoints::new(&points, known)?.body.at(middle))
    }

    /// A body that was made about its middle.
    pub(super) fn at(self, origin: Vector3<f64>) -> Self {
        Self { origin, ..self }
    }

    /// Heights of the faces above a point, with their normals.
    pub fn heights(&self, centre: &Vector3<f64>) -> Vec<(Vector3<f64>, f64)> {
        self.planes.iter().map(|plane| (plane.normal, plane.offset - plane.normal.dot(centre))).collect()
    }

    /// The distance of the farthest corner from a point.
    pub fn farthest(&self, centre: &Vector3<f64>) -> f64 {
        self.corners.iter().map(|corner| (corner - centre).norm()).fold(0.0, f64::max)
    }

    /// The diameter of the largest ball within.
    ///
    /// # Errors
    /// Rounding leaves none.
    pub fn size(&self) -> Result<f64, ShapeError> {
        let radius = largest_ball::radius(&self.heights(&self.centroid), self.farthest(&self.centroid));
        Ok(2.0 * radius.ok_or(ShapeError::Empty)?)
    }

    /// Moments and products of inertia about the centroid for density 1.
    pub fn inertia(&self) -> Matrix3<f64> {
        let at = |i: u32| self.corners[i as usize];
        volume::inertia(&self.centroid, self.triangles.iter().map(|triangle| triangle.map(at).into_iter()))
    }
}

impl HullOfPoints {
    /// # Errors
    /// Points that are not finite, fewer than four, or all in a plane; too many faces.
    pub fn new(points: &[Vector3<f64>], known: f64) -> Result<Self, ShapeError> {
        within(known, known >= 0.0, "known", "finite and at least 0")?;
        let triangles = hull::triangles(points)?;
        let flat = ShapeError::Flat(points.len());
        let (solid, area) = measured(points, triangles.iter().map(|corners| &corners[..]));
        let faces: Vec<Face<[u32; 3]>> = triangles.iter().map(|&corners| Face::new(points, corners)).collect();
        let Distinct { planes, plane_of } = coplanar::distinct(points, &faces, known).ok_or(flat)?;
        refuse_many(planes.len())?;
        let mut planes_around = vec![Vec::new(); points.len()];
        for (corners, &plane) in triangles.iter().zip(&plane_of) {
            for &corner in corners {
                let around: &mut Vec<u32> = &mut planes_around[corner as usize];
                if plane != u32::MAX && !around.contains(&plane) {
                    around.push(plane);
                }
            }
        }
        // Points within the hull are no corners.
        let (mut place, mut corners) = (vec![u32::MAX; points.len()], Vec::new());
        triangles.iter().flatten().for_each(|&corner| place[corner as usize] = 0);
        for (place, at) in place.iter_mut().zip(points).filter(|(place, _)| **place == 0) {
            *place = corners.len() as u32;
            corners.push(*at);
        }
        let triangles = triangles.into_iter().map(|triangle| triangle.map(|corner| place[corner as usize])).collect();
        let planes = planes.into_iter().map(|(_, plane)| plane).collect();
        let centroid = at_the_origin(solid.centroid(), &corners);
        let body = SharpBody { origin: Vector3::zeros(), planes, corners, triangles, volume: solid.volume, centroid };
        Ok(Self { body, area, planes_around })
    }
}

/// A body that is symmetric about the origin stays so: where faces lie on faces, the contact point follows the last
/// digit of their places.
fn at_the_origin(centroid: Vector3<f64>, corners: &[Vector3<f64>]) -> Vector3<f64> {
    let least = OF_SUMS * corners.iter().map(|corner| corner.amax()).fold(0.0, f64::max);
    centroid.map(|c| if c.abs() > least { c } else { 0.0 })
}

/// Volume and centroid of polygons that enclose a body, and their area.
fn measured<'a>(corners: &[Vector3<f64>], outlines: impl Iterator<Item = &'a [u32]>) -> (Enclosed, f64) {
    let mut outlines = outlines.peekable();
    let pole = outlines.peek().map(|outline| corners[outline[0] as usize]);
    let mut solid = Enclosed::about(pole.unwrap_or_default());
    let area = outlines.map(|outline| solid.add(outline.iter().map(|&corner| corners[corner as usize]))).sum();
    (solid, area)
}

/// The middle of points, and the points about it: their distances from it have all digits, however far away they are.
pub(super) fn about_middle(points: &[[f64; 3]]) -> (Vector3<f64>, Vec<Vector3<f64>>) {
    let points: Vec<Vector3<f64>> = points.iter().map(|&point| point.into()).collect();
    let [low, high] = coplanar::extremes(&points);
    let middle = 0.5 * low + 0.5 * high;
    let origin = if middle.iter().all(|c| c.is_finite()) { middle } else { Vector3::zeros() };
    (origin, points.iter().map(|point| point - origin).collect())
}

fn refuse_many(planes: usize) -> Result<(), ShapeError> {
    if planes > MAX_PLANES { Err(ParticleError::TooManyPlanes(planes).into()) } else { Ok(()) }
}
