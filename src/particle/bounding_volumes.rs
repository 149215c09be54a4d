//! A polyhedron, a ball and a box that hold a particle: everything cheap tests rely on.

use crate::linalg::number::{larger, smaller};
use crate::pair::pose::Pose;
use crate::particle::linear_program;
use crate::particle::particle::Particle;
use nalgebra::{Matrix3, Vector3};

/// What surely holds a particle, local frame; for a particle of the plane, its cut at z = 0.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bounds {
    /// Radius of a ball about the origin that holds the particle.
    pub radius: f64,
    /// Corners of a polyhedron that holds the particle, but for `merged`.
    pub corners: Box<[Vector3<f64>]>,
    /// Corners that lie no further apart than this are one: of a body far longer than wide, those all around an end.
    merged: f64,
    /// max |d_i|, for bounds on rounding.
    longest_offset: f64,
    /// min d_i; negative where a plane passes behind the origin.
    pub least_offset: f64,
    /// max |n_i|, likewise.
    pub longest_normal: f64,
    /// min |n_i|, of all planes and of those that are on anywhere within [`NEARBY`] times the radius.
    pub shortest_normal: f64,
    shortest_nearby: f64,
    /// How far beyond d_i the particle can reach along n_i: r/√(1−k); infinite for k = 1.
    pub face_reach: f64,
    /// {S ≤ s²} lies in a ball of radius·(1 + growth·(s − 1)), s ≥ 1.
    growth: f64,
}

/// Most planes whose corners are enumerated; further ones only make the polyhedron smaller.
const MOST_FACES: usize = 24;

/// Corners are found to this relative accuracy even where planes are nearly parallel, and kept when
/// they are cut off by less: doubtful ones only make the polyhedron larger.
const SLACK: f64 = 1e-6;

/// Half the edge of the largest cube that is looked at, length: the square of its diagonal is still a number.
const LARGEST: f64 = 1e150;

/// Half the edge of a first guess, in distances of the farthest face: the corners of few particles lie beyond it.
const WIDE: f64 = 8.0;

/// Distance in radii within which planes count as nearby.
const NEARBY: f64 = 4.0;

/// Bounds are enlarged by this factor, which covers [`SLACK`] and the linear programs' tolerance.
const MARGIN: f64 = 1.0 + 1e-5;

impl Bounds {
    /// `None` when nothing bounds the particle.
    pub fn of(particle: &Particle) -> Option<Self> {
        let face_reach = if particle.is_sphere() { f64::INFINITY } else { (1.0 / particle.plane_weight).sqrt() };
        let sphere_reach = (1.0 / particle.sphere_weight).sqrt();
        // f ≤ 0 implies n_i·x ≤ d_i + r/√(1−k) and |x| ≤ R/√k.
        let face = |i: usize| face(&particle.normal(i), particle.offset(i) + face_reach);
        let chosen = if particle.is_sphere() { Vec::new() } else { spread(particle) };
        let faces: Vec<_> = chosen.into_iter().filter_map(face).collect();
        let (half, corners) = if sphere_reach.is_finite() {
            (sphere_reach, corners(&faces, sphere_reach, particle.dimensions))
        } else {
            let all: Vec<_> = (0..particle.plane_count()).filter_map(face).collect();
            let few = if all.len() == faces.len() { enclosed(&faces, particle.dimensions) } else { None };
            few.or_else(|| {
                let half = linear_program::half_cube(&all, particle.dimensions).filter(|half| *half <= LARGEST)?;
                Some((half, corners(&faces, half, particle.dimensions)))
            })?
        };
        let farthest = corners.iter().map(|c| c.norm()).fold(0.0, f64::max);
        let radius = farthest.min(sphere_reach) * MARGIN;
        let offsets = || (0..particle.plane_count()).map(|i| particle.offset(i));
        let lengths = || (0..particle.plane_count()).map(|i| particle.normal(i).norm());
        let s_origin = crate::particle::potential::value(particle, &Vector3::zeros()).sqrt();
        // Where the faces alone enclose the particle, {S ≤ s²} lies between those at d_i + s·r/√(1−k): for small r that grows
        // far less than convexity of s allows. With a sphere they do if no corner lies on the cube.
        let enclosed = !sphere_reach.is_finite() || farthest < 0.99 * half;
        let nearest = offsets().fold(f64::INFINITY, f64::min) + face_reach;
        let by_faces = if enclosed { face_reach / nearest } else { f64::INFINITY };
        // Its square is a weight of the solvers.
        (radius * radius).is_normal().then(|| Self {
            radius,
            corners: corners.into_iter().map(|c| c * MARGIN).collect(),
            merged: SLACK * farthest * MARGIN,
            longest_offset: offsets().map(f64::abs).fold(0.0, f64::max),
            least_offset: offsets().fold(f64::INFINITY, f64::min),
            longest_normal: lengths().fold(0.0, f64::max),
            shortest_normal: lengths().fold(f64::INFINITY, f64::min),
            shortest_nearby: lengths()
                .zip(offsets())
                .filter(|(length, offset)| *offset <= length * NEARBY * radius * MARGIN)
                .fold(f64::INFINITY, |least, (length, _)| least.min(length)),
            face_reach,
            growth: by_faces.min(1.0 / (1.0 - s_origin)),
        })
    }

    /// Least |n| of a plane that is on at a point: what is written short, and never reached, is left out.
    pub fn shortest_normal_at(&self, y: &Vector3<f64>) -> f64 {
        let far = NEARBY * self.radius;
        if y.norm_squared() <= far * far { self.shortest_nearby } else { self.shortest_normal }
    }

    /// Longest |d| of a plane that can be reached within this distance of the origin: others are never summed, so that
    /// their rounding is nobody's.
    #[inline]
    pub fn offset_within(&self, distance: f64) -> f64 {
        smaller(self.longest_offset, self.longest_normal * distance + larger(-self.least_offset, 0.0))
    }
}

impl Particle {
    /// Radius of a ball about the origin that holds {S ≤ level}, level ≥ 1.
    ///
    /// s = √S is convex with s(0) < 1, so that along a ray it needs at most (s − s(0))/(1 − s(0)) times
    /// the way to the surface to reach s.
    pub(crate) fn reach(&self, level: f64) -> f64 {
        self.bounds.radius * (1.0 + self.bounds.growth * (level.sqrt().max(1.0) - 1.0))
    }

    /// Axis-aligned box in world axes that holds the particle at a pose, from its corners: (lower, upper).
    pub fn bounding_box(&self, pose: &Pose) -> (Vector3<f64>, Vector3<f64>) {
        let (mut lower, mut upper) = (*pose.position(), *pose.position());
        for axis in 0..3 {
            let e = pose.rotation().row(axis).transpose();
            // One unit in the last place of the position covers the final addition.
            let slack = f64::EPSILON * pose.position()[axis].abs();
            upper[axis] += self.support(&e) + slack;
            lower[axis] -= self.support(&-e) + slack;
        }
        (lower, upper)
    }

    /// Upper bound of max e·x over the particle, local frame, e of unit length.
    ///
    /// The least over the corners' polyhedron and the ball of the shadow sphere.
    pub fn support(&self, e: &Vector3<f64>) -> f64 {
        let farthest = self.bounds.corners.iter().map(|c| c.dot(e)).fold(f64::NEG_INFINITY, f64::max);
        (farthest + self.bounds.merged).min(self.bounds.radius)
    }
}

/// Up to [`MOST_FACES`] planes whose normals lie far from each other (farthest-point sampling).
fn spread(particle: &Particle) -> Vec<usize> {
    let count = particle.plane_count();
    if count <= MOST_FACES {
        return (0..count).collect();
    }
    let unit = |i: usize| particle.normal(i).normalize();
    let mut chosen = vec![0];
    let mut nearest: Vec<f64> = (0..count).map(|i| unit(i).dot(&unit(0))).collect();
    while chosen.len() < MOST_FACES {
        let next = (0..count).min_by(|&i, &j| nearest[i].total_cmp(&nearest[j])).unwrap_or(0);
        chosen.push(next);
        for (i, cosine) in nearest.iter_mut().enumerate() {
            *cosine = cosine.max(unit(i).dot(&unit(next)));
        }
    }
    chosen
}

/// The face {n·x = h} with a normal of unit length; `None` where it is further off than any number.
fn face(n: &Vector3<f64>, h: f64) -> Option<(Vector3<f64>, f64)> {
    let (n, h) = (n / n.norm(), h / n.norm());
    h.is_finite().then_some((n, h))
}

/// A cube that holds {n·x ≤ h} well inside, as half its edge, with the corners; `None` where no first guess is such a cube.
fn enclosed(faces: &[(Vector3<f64>, f64)], dimensions: usize) -> Option<(f64, Vec<Vector3<f64>>)> {
    let farthest = faces.iter().map(|(_, h)| *h).fold(0.0, f64::max);
    let half = (WIDE * farthest).min(LARGEST);
    let corners = corners(faces, half, dimensions);
    // No part of a convex set is beyond a surface that it does not touch.
    (!corners.is_empty() && corners.iter().all(|c| c.amax() < 0.99 * half)).then_some((half, corners))
}

/// Corners of the polyhedron {n·x ≤ h} ∩ cube, |n| = 1: every point where three faces meet and that none cuts off.
/// In the plane the cube has no height, so that every corner has z = 0.
fn corners(faces: &[(Vector3<f64>, f64)], half: f64, dimensions: usize) -> Vec<Vector3<f64>> {
    // In units, powers of two, of the nearest face no square is lost or infinite.
    let nearest = faces.iter().map(|(_, h)| *h).fold(half, f64::min).max(half / LARGEST);
    let unit = nearest.log2().floor().exp2();
    let mut all: Vec<_> = faces.iter().map(|(n, h)| (*n, (h / unit).min(LARGEST))).collect();
    for axis in 0..3 {
        let half = if axis < dimensions { half / unit } else { 0.0 };
        for sign in [1.0, -1.0] {
            let mut n = Vector3::zeros();
            n[axis] = sign;
            all.push((n, half));
        }
    }
    let mut corners: Vec<Vector3<f64>> = Vec::new();
    for i in 0..all.len() {
        for j in i + 1..all.len() {
            for k in j + 1..all.len() {
                let rows = Matrix3::from_rows(&[all[i].0.transpose(), all[j].0.transpose(), all[k].0.transpose()]);
                let Some(inverse) = rows.try_inverse() else { continue };
                let corner = inverse * Vector3::new(all[i].1, all[j].1, all[k].1);
                // Not a number, or beyond the cube.
                if !(corner.norm() <= 2.0 * half / unit) {
                    continue;
                }
                let slack = SLACK * corner.norm();
                let kept = all.iter().all(|(n, h)| n.dot(&corner) <= h + slack);
                if kept && !corners.iter().any(|c| (c - corner).norm() <= slack) {
                    corners.push(corner);
                }
            }
        }
    }
    corners.into_iter().map(|c| c * unit).collect()
}
