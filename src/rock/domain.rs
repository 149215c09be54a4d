//! The polyhedron of a domain, and the planes that bound and cut it.

use super::numbers::{EXTENTS, FAR, LEAST_CUT};
use crate::linalg::number::direction;
use crate::particle::cutter::Cutter;
use crate::particle::plane::Plane;
use crate::particle::polyhedron::{OF_CUBE, Polyhedron};
use crate::rock::block::FaceOf;
use crate::rock::error::RockError;
use crate::rock::joint::Joint;
use nalgebra::Vector3;

/// A unit normal, and the height of its plane above some origin.
pub(crate) type Oriented = (Vector3<f64>, f64);

/// What each face comes from, with unit normal and height above the origin of the polyhedra, in the order of their
/// numbers.
pub(super) fn faces(
    outer: &[Oriented],
    joints: &[Joint],
    regions: &[Vec<Plane>],
    origin: &Vector3<f64>,
) -> Result<Vec<(FaceOf, Vector3<f64>, f64)>, RockError> {
    let about = |of: FaceOf, (n, d): Oriented| (of, n, d - n.dot(origin));
    let mut planes: Vec<_> = outer.iter().enumerate().map(|(i, plane)| about(FaceOf::Domain(i), *plane)).collect();
    for (i, joint) in joints.iter().enumerate() {
        let n = direction(&joint.normal).ok_or(RockError::NoJoint(i))?;
        let height = n.dot(&(joint.point - origin));
        if !(height.is_finite() && joint.radius > 0.0) {
            return Err(RockError::NoJoint(i));
        }
        planes.push((FaceOf::Joint(i), n, height));
    }
    for (region, given) in regions.iter().enumerate() {
        let given = unit_planes(given).map_err(|plane| RockError::NoRegion { region, plane })?;
        planes.extend(given.into_iter().enumerate().map(|(plane, of)| about(FaceOf::Region { region, plane }, of)));
    }
    Ok(planes)
}

/// Unit normals and distances from the origin; the index of an invalid plane.
pub(crate) fn unit_planes(planes: &[Plane]) -> Result<Vec<Oriented>, usize> {
    let unit = |(i, plane): (usize, &Plane)| {
        let normal = direction(&plane.normal).ok_or(i)?;
        // By the largest component, whose square may leave the range of doubles.
        let scale = plane.normal.amax();
        let offset = plane.offset / scale / (plane.normal / scale).norm();
        offset.is_finite().then_some((normal, offset)).ok_or(i)
    };
    planes.iter().enumerate().map(unit).collect()
}

/// What planes enclose, about an origin in its middle.
pub(crate) fn enclosed(planes: &[Oriented]) -> Result<(Vector3<f64>, Polyhedron), RockError> {
    let farthest = planes.iter().map(|(_, d)| d.abs()).fold(0.0, f64::max);
    let [near, far] = FAR.map(|times| times * farthest);
    match enclosed_within(planes, near) {
        Err(RockError::Open) => enclosed_within(planes, far),
        found => found,
    }
}

/// Cut from a cube, and from smaller ones about its middle, as corners that are cut from a cube far away are known less
/// well.
fn enclosed_within(planes: &[Oriented], mut half: f64) -> Result<(Vector3<f64>, Polyhedron), RockError> {
    let (mut origin, mut cutter) = (Vector3::zeros(), Cutter::default());
    for _ in 0..4 {
        let mut polyhedron = Polyhedron::cube(half, LEAST_CUT * half);
        // A point that mostly shows that a cut leaves something, without a walk to the lowest corner.
        let mut inside = Vector3::zeros();
        for (i, (n, d)) in planes.iter().enumerate() {
            let height = d - n.dot(&origin);
            let is_left = |lowest: f64| lowest < height - LEAST_CUT * half;
            let is_shown = is_left(n.dot(&inside));
            if !(is_shown || is_left(polyhedron.lowest(&mut cutter, n))) {
                return Err(RockError::Empty);
            }
            polyhedron.cut(&mut cutter, OF_CUBE + i, n, height);
            if !is_shown {
                inside = polyhedron.middle();
            }
        }
        let is_open = polyhedron.outlines().iter().any(|face| face.number < OF_CUBE);
        if is_open {
            return Err(RockError::Open);
        }
        let [low, high] = polyhedron.extremes();
        let extent = 0.5 * (high - low).max();
        if half <= 4.0 * extent {
            return if EXTENTS.contains(&extent) { Ok((origin, polyhedron)) } else { Err(RockError::Extent(extent)) };
        }
        origin += 0.5 * (low + high);
        half = 2.0 * extent;
    }
    Err(RockError::Empty)
}
