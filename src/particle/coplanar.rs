//! Which faces of a convex body are one: the rule for half-spaces, hulls, surfaces, polygons and the planes of a
//! particle.
//!
//! A face is part of a larger one if its corners lie within [`COPLANAR`] times the extent of the body below the plane
//! of that one, and its normal is within 60° of that one's. The plane that remains supports the body: no corner lies
//! above it, and each face is judged by its own corners, so that nothing accumulates over chains of faces. A body that
//! lies within this distance of one of its faces is flat.

use super::numbers::{COPLANAR, LEAST_COSINE, NO_AREA};
use crate::particle::plane::Plane;
use nalgebra::Vector3;
use std::ops::Range;

/// A face of a convex body.
pub(crate) struct Face<F> {
    /// Of unit length, outwards; zero where it has no area.
    pub normal: Vector3<f64>,
    pub area: f64,
    /// The numbers of its corners.
    pub corners: F,
}

impl<F: AsRef<[u32]>> Face<F> {
    /// Of corners counter-clockwise from outside.
    pub fn new(points: &[Vector3<f64>], corners: F) -> Self {
        let outline = corners.as_ref();
        let at = |i: usize| points[outline[i] as usize] - points[outline[0] as usize];
        let doubled: Vector3<f64> = (1..outline.len() - 1).map(|i| at(i).cross(&at(i + 1))).sum();
        let normal = doubled.try_normalize(0.0).unwrap_or_default();
        Self { normal, area: 0.5 * doubled.norm(), corners }
    }
}

/// What remains of the faces of a convex body.
pub(crate) struct Distinct {
    /// The planes, with unit normals, and the face of each, largest first.
    pub planes: Vec<(usize, Plane)>,
    /// For each face the index of its plane; `u32::MAX` of a face without an area.
    pub plane_of: Vec<u32>,
}

/// The faces of a convex body with these corners that are distinct; `None` if the body is flat, or thin as a line.
/// `known`: the length to which the corners are known; faces that lie within it are one, too.
pub(crate) fn distinct<F: AsRef<[u32]>>(corners: &[Vector3<f64>], faces: &[Face<F>], known: f64) -> Option<Distinct> {
    let around = Around::new(corners.len(), faces);
    let extent = extent(corners);
    let (within, least) = ((COPLANAR * extent).max(known), NO_AREA * extent * extent);
    let mut order: Vec<usize> = (0..faces.len()).filter(|&face| faces[face].area > least).collect();
    order.sort_by(|&i, &j| faces[j].area.total_cmp(&faces[i].area));
    let mut found = Distinct { planes: Vec::new(), plane_of: vec![u32::MAX; faces.len()] };
    let (mut seen, mut open, mut bottom) = (vec![u32::MAX; corners.len()], Vec::new(), 0);
    for face in order {
        let Face { normal, corners: outline, .. } = &faces[face];
        if found.plane_of[face] != u32::MAX {
            continue;
        }
        let start = outline.as_ref()[0];
        let top = around.climbed(corners, normal, start);
        let offset = normal.dot(&corners[top as usize]);
        let is_near = |corner: u32| normal.dot(&corners[corner as usize]) >= offset - within;
        if is_near(bottom) {
            bottom = (0..corners.len() as u32).find(|&corner| !is_near(corner))?;
        }
        let plane = found.planes.len() as u32;
        found.planes.push((face, Plane { normal: *normal, offset }));
        found.plane_of[face] = plane;
        // The corners near the plane are connected by edges, since the body is convex.
        open.push(top);
        seen[top as usize] = plane;
        while let Some(corner) = open.pop() {
            for &next in around.corners(corner) {
                if seen[next as usize] != plane && is_near(next) {
                    seen[next as usize] = plane;
                    open.push(next);
                }
            }
            for &other in around.faces(corner) {
                let Face { normal: beside, corners: outline, .. } = &faces[other as usize];
                let is_part =
                    || normal.dot(beside) > LEAST_COSINE && outline.as_ref().iter().all(|&corner| is_near(corner));
                if found.plane_of[other as usize] == u32::MAX && is_part() {
                    found.plane_of[other as usize] = plane;
                }
            }
        }
    }
    // Points near a line have faces of rounding only.
    (found.planes.len() > 3).then_some(found)
}

/// The planes that are distinct within a ball about the origin, in their order; normals of any length. Two planes are
/// one if nowhere in the ball they are farther apart than [`COPLANAR`] times its radius; the first of them is kept.
/// `None` if all are distinct.
pub(crate) fn distinct_planes(planes: &[Plane], radius: f64) -> Option<Vec<Plane>> {
    let within = COPLANAR * radius;
    let unit = |plane: &Plane| {
        let length = plane.normal.norm();
        (plane.normal / length, plane.offset / length)
    };
    let units: Vec<_> = planes.iter().map(unit).collect();
    // Planes of nearly the same normal are neighbours in this order; the direction is no axis of usual solids, so that
    // few others are.
    let along = |i: usize| units[i].0.dot(&Vector3::new(0.48, 0.6, 0.64));
    let mut order: Vec<usize> = (0..planes.len()).collect();
    order.sort_by(|&i, &j| along(i).total_cmp(&along(j)));
    let mut place = vec![0; planes.len()];
    order.iter().enumerate().for_each(|(at, &i)| place[i] = at);
    let mut is_left = vec![true; planes.len()];
    for i in 0..planes.len() {
        if !is_left[i] {
            continue;
        }
        let is_near = |j: &&usize| (along(**j) - along(i)).abs() <= COPLANAR;
        let beside =
            order[..place[i]].iter().rev().take_while(is_near).chain(order[place[i] + 1..].iter().take_while(is_near));
        for &j in beside {
            let apart = (units[i].0 - units[j].0).norm() * radius + (units[i].1 - units[j].1).abs();
            if j > i && apart <= within {
                is_left[j] = false;
            }
        }
    }
    let left = || planes.iter().zip(&is_left).filter(|(_, is_left)| **is_left).map(|(plane, _)| *plane);
    (left().count() < planes.len()).then(|| left().collect())
}

/// The least and the largest coordinates of points.
pub(crate) fn extremes(points: &[Vector3<f64>]) -> [Vector3<f64>; 2] {
    let first = points.first().copied().unwrap_or_default();
    points.iter().fold([first; 2], |[low, high], point| [low.inf(point), high.sup(point)])
}

/// The largest edge of the box about points.
pub(crate) fn extent(points: &[Vector3<f64>]) -> f64 {
    let [low, high] = extremes(points);
    (high - low).max()
}

/// For each corner the faces around it, and the corners at the other ends of its edges: each twice, as of both faces.
/// A face of many corners is not walked around for each of them.
struct Around {
    ends: Vec<u32>,
    faces: Vec<u32>,
    corners: Vec<u32>,
}

impl Around {
    fn new<F: AsRef<[u32]>>(corners: usize, faces: &[Face<F>]) -> Self {
        let mut ends = vec![0; corners + 1];
        faces.iter().flat_map(|face| face.corners.as_ref()).for_each(|&corner| ends[corner as usize + 1] += 1);
        (1..=corners).for_each(|i| ends[i] += ends[i - 1]);
        let all = ends[corners] as usize;
        let (mut next, mut around, mut beside) = (ends.clone(), vec![0; all], vec![0; 2 * all]);
        for (number, face) in faces.iter().enumerate() {
            let outline = face.corners.as_ref();
            for (i, &corner) in outline.iter().enumerate() {
                let place = &mut next[corner as usize];
                around[*place as usize] = number as u32;
                let at = |i: usize| outline[i % outline.len()];
                beside[2 * *place as usize..][..2].copy_from_slice(&[at(i + 1), at(i + outline.len() - 1)]);
                *place += 1;
            }
        }
        Self { ends, faces: around, corners: beside }
    }

    fn range(&self, corner: u32) -> Range<usize> {
        self.ends[corner as usize] as usize..self.ends[corner as usize + 1] as usize
    }

    fn faces(&self, corner: u32) -> &[u32] {
        &self.faces[self.range(corner)]
    }

    fn corners(&self, corner: u32) -> &[u32] {
        let Range { start, end } = self.range(corner);
        &self.corners[2 * start..2 * end]
    }

    /// The corner that lies farthest along a direction, uphill from corner to corner.
    fn climbed(&self, corners: &[Vector3<f64>], along: &Vector3<f64>, start: u32) -> u32 {
        let mut best = (along.dot(&corners[start as usize]), start);
        loop {
            let here = best.1;
            for &next in self.corners(here) {
                let height = along.dot(&corners[next as usize]);
                if height > best.0 {
                    best = (height, next);
                }
            }
            if best.1 == here {
                return here;
            }
        }
    }
}
