//! A polyhedron, a ball and a box that hold a particle: what the cheap tests rely on.
//!
//! They are estimated, not proved: corners are exact to the relative error [`CORNER_SLACK`] if the three normals that
//! meet there have a condition number κ ≤ 1e8 (the error of a 3×3 solve by cofactors is some 10·κ·ε), and
//! [`BOUND_MARGIN`] is ten times as much, for that and for merged corners. Three planes closer to a common direction
//! than this may give a corner that is lost.

use super::numbers::{BOUND_MARGIN, CORNER_SLACK, FIRST_CUBE, Limits, NEARBY, SQUARABLE};
use crate::linalg::number::{larger, smaller};
use crate::particle::linear_program;
use nalgebra::{Matrix3, Vector3};

/// What holds a particle, local frame; for a two-dimensional particle, its cut at z = 0.
#[derive(Clone, Debug)]
pub(crate) struct Bounds {
    /// Radius of a ball about the origin that holds the particle.
    pub radius: f64,
    /// Corners of a polyhedron that holds the particle, up to `merged`.
    pub corners: Box<[Vector3<f64>]>,
    /// Distance within which corners were merged into one: of a body far longer than wide, all those around an end.
    merged: f64,
    /// max |d_i|.
    longest_offset: f64,
    /// min d_i; negative where a plane passes behind the origin.
    least_offset: f64,
    /// max |n_i|.
    pub longest_normal: f64,
    /// min |n_i| of all planes, and of those that are active anywhere within [`NEARBY`] times the radius.
    pub shortest_normal: f64,
    shortest_nearby: f64,
    /// Radius of a ball about the origin within all planes, and of one within all n_i·x ≤ d_i + r/√(1−k); 0 where there
    /// is none that is known.
    pub inner: f64,
    pub nearest: f64,
    /// How far beyond d_i the particle can reach along n_i: r/√(1−k); infinite for k = 1.
    pub face_reach: f64,
    /// {S ≤ s²} lies in a ball of radius·(1 + growth·(s − 1)), s ≥ 1.
    growth: f64,
}

/// What f ≤ 0 says without regard to the planes: n_i·x ≤ d_i + face_reach and |x| ≤ sphere_reach.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    /// r/√(1−k); infinite for k = 1.
    face_reach: f64,
    /// R/√k; infinite for k = 0.
    sphere_reach: f64,
    /// √S(0).
    s_origin: f64,
    dimensions: usize,
}

impl Extent {
    /// From the weights of S and S(0).
    pub fn new(plane_weight: f64, sphere_weight: f64, at_origin: f64, dimensions: usize) -> Self {
        Self {
            face_reach: (1.0 / plane_weight).sqrt(),
            sphere_reach: (1.0 / sphere_weight).sqrt(),
            s_origin: at_origin.sqrt(),
            dimensions,
        }
    }
}

impl Bounds {
    /// From the planes (a, b, c, d). `None` when nothing bounds the particle.
    pub fn of(rows: &[[f64; 4]], extent: &Extent) -> Option<Self> {
        let Extent { sphere_reach, s_origin, dimensions, .. } = *extent;
        let face_reach = if rows.is_empty() { f64::INFINITY } else { extent.face_reach };
        let planes: Vec<_> = rows.iter().map(|[a, b, c, d]| (Vector3::new(*a, *b, *c), *d)).collect();
        let face = |i: usize| face(&planes[i].0, planes[i].1 + face_reach);
        let chosen = if face_reach.is_finite() { spread(&planes) } else { Vec::new() };
        let faces: Vec<_> = chosen.into_iter().filter_map(face).collect();
        let (half, corners) = if sphere_reach.is_finite() {
            (sphere_reach, corners(&faces, sphere_reach, dimensions))
        } else {
            let all: Vec<_> = (0..planes.len()).filter_map(face).collect();
            let few = if all.len() == faces.len() { enclosed(&faces, dimensions) } else { None };
            few.or_else(|| {
                let half = linear_program::half_cube(&all, dimensions).filter(|half| *half <= SQUARABLE)?;
                Some((half, corners(&faces, half, dimensions)))
            })?
        };
        let farthest = corners.iter().map(|c| c.norm()).fold(0.0, f64::max);
        let radius = farthest.min(sphere_reach) * BOUND_MARGIN;
        let offsets = || planes.iter().map(|(_, d)| *d);
        let lengths = || planes.iter().map(|(n, _)| n.norm());
        let (least_offset, longest_normal) = (offsets().fold(f64::INFINITY, f64::min), lengths().fold(0.0, f64::max));
        let within = |offset: f64| if planes.is_empty() { 0.0 } else { offset.max(0.0) / longest_normal };
        // Where the faces alone enclose the particle, {S ≤ s²} lies between those at d_i + s·r/√(1−k): for small r that
        // grows far less than convexity of s allows. With a shadow sphere they do if no corner lies on the cube.
        let enclosed = !sphere_reach.is_finite() || farthest < 0.99 * half;
        let by_faces = if enclosed { face_reach / (least_offset + face_reach) } else { f64::INFINITY };
        // Its square is a weight of the solvers.
        (radius * radius).is_normal().then(|| Self {
            radius,
            corners: corners.into_iter().map(|c| c * BOUND_MARGIN).collect(),
            merged: CORNER_SLACK * farthest * BOUND_MARGIN,
            longest_offset: offsets().map(f64::abs).fold(0.0, f64::max),
            least_offset,
            longest_normal,
            inner: within(least_offset),
            nearest: within(least_offset + face_reach),
            shortest_normal: lengths().fold(f64::INFINITY, f64::min),
            shortest_nearby: lengths()
                .zip(offsets())
                .filter(|(length, offset)| *offset <= length * NEARBY * radius * BOUND_MARGIN)
                .fold(f64::INFINITY, |least, (length, _)| least.min(length)),
            face_reach,
            growth: by_faces.min(1.0 / (1.0 - s_origin)),
        })
    }

    /// Of a set without planes and without an end.
    pub fn unbounded() -> Self {
        Self {
            radius: f64::INFINITY,
            corners: Box::default(),
            merged: 0.0,
            longest_offset: 0.0,
            least_offset: f64::INFINITY,
            longest_normal: 0.0,
            inner: 0.0,
            nearest: 0.0,
            shortest_normal: f64::INFINITY,
            shortest_nearby: f64::INFINITY,
            face_reach: f64::INFINITY,
            growth: 0.0,
        }
    }

    /// Radius of a ball about the origin that holds {S ≤ level}, level ≥ 1.
    ///
    /// s = √S is convex with s(0) < 1, so that along a ray it needs at most (s − s(0))/(1 − s(0)) times the distance to
    /// the surface to reach s.
    pub fn reach(&self, level: f64) -> f64 {
        self.radius * (1.0 + self.growth * (level.sqrt().max(1.0) - 1.0))
    }

    /// Upper bound of max e·x over the particle, e of unit length: the lesser of those of the polyhedron and of the
    /// ball.
    pub fn support(&self, e: &Vector3<f64>) -> f64 {
        let farthest = self.corners.iter().map(|c| c.dot(e)).fold(f64::NEG_INFINITY, f64::max);
        (farthest + self.merged).min(self.radius)
    }

    /// Mean of the corners c with e·c ≥ h, or the one that is farthest along e where there is none; `None` of a ball.
    pub fn beyond(&self, e: &Vector3<f64>, h: f64) -> Option<Vector3<f64>> {
        let (mut sum, mut count, mut farthest, mut most) = (Vector3::zeros(), 0.0, None, f64::NEG_INFINITY);
        for corner in &self.corners {
            let along = corner.dot(e);
            if along >= h {
                sum += corner;
                count += 1.0;
            } else if along > most {
                (farthest, most) = (Some(*corner), along);
            }
        }
        if count > 0.0 { Some(sum / count) } else { farthest }
    }

    /// Axis-aligned box that holds the particle turned and moved: (lower, upper).
    pub fn aligned_box(&self, rotation: &Matrix3<f64>, position: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
        let (mut lower, mut upper) = (*position, *position);
        for axis in 0..3 {
            let e = rotation.row(axis).transpose();
            // One unit in the last place of the position covers the final addition.
            let slack = f64::EPSILON * position[axis].abs();
            upper[axis] += self.support(&e) + slack;
            lower[axis] -= self.support(&-e) + slack;
        }
        (lower, upper)
    }

    /// Least |n| of a plane that may be active at a point. A short normal of a plane that is never reached does not
    /// count.
    pub fn shortest_normal_at(&self, y: &Vector3<f64>) -> f64 {
        let far = NEARBY * self.radius;
        if y.norm_squared() <= far * far { self.shortest_nearby } else { self.shortest_normal }
    }

    /// Largest |d| of a plane that can be active within this distance of the origin: the rounding of others enters no
    /// sum.
    #[inline]
    pub fn offset_within(&self, distance: f64) -> f64 {
        smaller(self.longest_offset, self.longest_normal * distance + larger(-self.least_offset, 0.0))
    }
}

/// Up to [`Limits::FACES`] planes whose normals lie far from each other (farthest-point sampling).
fn spread(planes: &[(Vector3<f64>, f64)]) -> Vec<usize> {
    let count = planes.len();
    if count <= Limits::FACES {
        return (0..count).collect();
    }
    let unit = |i: usize| planes[i].0.normalize();
    let mut chosen = vec![0];
    let mut nearest: Vec<f64> = (0..count).map(|i| unit(i).dot(&unit(0))).collect();
    while chosen.len() < Limits::FACES {
        let next = (0..count).min_by(|&i, &j| nearest[i].total_cmp(&nearest[j])).unwrap_or(0);
        chosen.push(next);
        for (i, cosine) in nearest.iter_mut().enumerate() {
            *cosine = cosine.max(unit(i).dot(&unit(next)));
        }
    }
    chosen
}

/// The face {n·x = h} with a normal of unit length; `None` where h/|n| overflows: such a face bounds nothing.
fn face(n: &Vector3<f64>, h: f64) -> Option<(Vector3<f64>, f64)> {
    let (n, h) = (n / n.norm(), h / n.norm());
    h.is_finite().then_some((n, h))
}

/// Whether the planes (a, b, c, d) alone enclose a volume, without the shadow sphere.
pub(super) fn planes_enclose(rows: &[[f64; 4]], dimensions: usize) -> bool {
    // That depends on the normals alone, as long as a point is inside; so each plane is moved outwards until the origin
    // is.
    let outside = rows.iter().map(|row| -row[3]).fold(0.0, f64::max);
    let farthest = rows.iter().map(|row| row[3].abs()).fold(f64::MIN_POSITIVE, f64::max);
    let faces: Vec<_> =
        rows.iter().filter_map(|[a, b, c, d]| face(&Vector3::new(*a, *b, *c), d + outside + farthest)).collect();
    linear_program::half_cube(&faces, dimensions).is_some()
}

/// A cube that holds {n·x ≤ h} in its interior, as half its edge, with the corners; `None` if the cube tried is none.
fn enclosed(faces: &[(Vector3<f64>, f64)], dimensions: usize) -> Option<(f64, Vec<Vector3<f64>>)> {
    let farthest = faces.iter().map(|(_, h)| *h).fold(0.0, f64::max);
    let half = (FIRST_CUBE * farthest).min(SQUARABLE);
    let corners = corners(faces, half, dimensions);
    // A convex set that does not touch the surface of the cube has no part beyond it.
    (!corners.is_empty() && corners.iter().all(|c| c.amax() < 0.99 * half)).then_some((half, corners))
}

/// Corners of the polyhedron {n·x ≤ h} ∩ cube, |n| = 1: every point where three faces meet and that none cuts off.
/// In two dimensions the cube has no height, so that every corner has z = 0.
fn corners(faces: &[(Vector3<f64>, f64)], half: f64, dimensions: usize) -> Vec<Vector3<f64>> {
    // In units of the nearest face, rounded to a power of two, no square underflows or overflows.
    let nearest = faces.iter().map(|(_, h)| *h).fold(half, f64::min).max(half / SQUARABLE);
    let unit = nearest.log2().floor().exp2();
    let mut all: Vec<_> = faces.iter().map(|(n, h)| (*n, (h / unit).min(SQUARABLE))).collect();
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
                // Also false for NaN.
                if !(corner.norm() <= 2.0 * half / unit) {
                    continue;
                }
                let slack = CORNER_SLACK * corner.norm();
                // Planes through one line may have an inverse by rounding; its point lies on none of them.
                let met = [i, j, k].iter().all(|&face| (all[face].0.dot(&corner) - all[face].1).abs() <= slack);
                let kept = met && all.iter().all(|(n, h)| n.dot(&corner) <= h + slack);
                if kept && !corners.iter().any(|c| (c - corner).norm() <= slack) {
                    corners.push(corner);
                }
            }
        }
    }
    corners.into_iter().map(|c| c * unit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particle::particle::Particle;
    use crate::particle::plane::Plane;

    fn of_cuboid(half: [f64; 3], r: f64) -> Vec<Plane> {
        let sides = (0..3).flat_map(|axis| [1.0, -1.0].map(|sign| (axis, sign)));
        sides.map(|(axis, sign)| Plane { normal: Vector3::ith(axis, sign), offset: half[axis] - r }).collect()
    }

    /// A tilted frame, in which nothing cancels by chance.
    fn tilted(planes: &[Plane]) -> Vec<Plane> {
        let turn = nalgebra::Rotation3::from_euler_angles(0.3, -0.7, 1.1);
        planes.iter().map(|plane| Plane { normal: turn * plane.normal, ..*plane }).collect()
    }

    #[test]
    fn a_cuboid_has_its_eight_corners_also_where_each_plane_is_given_twice_or_nearly() {
        let (half, r) = ([3.0, 2.0, 1.0], 1e-3);
        let reach = Vector3::from(half).norm();
        for nudge in [0.0, 1e-17, 1e-16, 1e-15, 1e-13] {
            let mut planes = tilted(&of_cuboid(half, r));
            let again = planes.iter().map(|plane| Plane { offset: plane.offset * (1.0 + nudge), ..*plane });
            planes.extend(again.collect::<Vec<_>>());
            let particle = Particle::new(&planes, r, 0.0, 0.0).unwrap();
            assert_eq!(particle.bounding_corners().len(), 8, "{nudge:e}");
            for corner in particle.bounding_corners() {
                assert!((corner.norm() / reach - 1.0).abs() < 2e-5, "{nudge:e}: {corner}");
            }
        }
    }

    #[test]
    fn ball_polyhedron_and_box_hold_every_point_of_the_surface() {
        for (k, shadow) in [(0.0, 0.0), (0.3, 2.5)] {
            let particle = Particle::new(&tilted(&of_cuboid([3.0, 2.0, 1.0], 0.2)), 0.2, k, shadow).unwrap();
            let (lower, upper) = particle.bounds.aligned_box(&Matrix3::identity(), &Vector3::zeros());
            for i in 0..500 {
                let (z, phi) = (1.0 - (2.0 * f64::from(i) + 1.0) / 500.0, f64::from(i) * 2.399963);
                let e = Vector3::new((1.0 - z * z).sqrt() * phi.cos(), (1.0 - z * z).sqrt() * phi.sin(), z);
                let x = particle.surface_distance(&Vector3::zeros(), &e).unwrap() * e;
                assert!(x.norm() <= particle.bounding_radius());
                assert!((0..3).all(|axis| lower[axis] <= x[axis] && x[axis] <= upper[axis]));
                for f in [e, Vector3::x(), -Vector3::z()] {
                    assert!(f.dot(&x) <= particle.support(&f).unwrap());
                }
            }
        }
    }

    #[test]
    fn reach_holds_the_level_sets() {
        let particle = Particle::cube(0.9, 0.1, 0.2, 1.5);
        for e in [Vector3::x(), Vector3::new(1.0, 1.0, 1.0).normalize(), Vector3::new(0.3, -0.9, 0.1).normalize()] {
            for distance in [0.5, 1.0, 1.3, 2.0, 5.0] {
                let level = 1.0 + particle.potential(&(distance * e));
                assert!(distance <= particle.bounds.reach(level.max(1.0)), "{distance} at {level}");
            }
        }
    }
}
