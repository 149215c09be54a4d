//! Separation tests of a particle and a boundary: each proves that they share no point, or proves nothing (`None`).

use crate::flags::Flags;
use crate::linalg::number::{larger, smaller};
use crate::pair::body::shift_in_a;
use crate::pair::separation::Apart;
use crate::particle::numbers::MARGIN;
use crate::particle::particle::Particle;
use crate::pose::Pose;
use nalgebra::Vector3;

/// By the bounding ball, or by the plane of the boundary and the corners of the particle's bounding polyhedron, with
/// the larger distance of both; else by a face of the particle. A plane has this unit normal and is given by a point of
/// it, a triangle by its vertices. All of it is seen from the centre of the particle in world axes: no frame is needed
/// yet.
pub(super) fn proof_of_separation(
    particle: &Particle,
    pose: &Pose,
    normal: &Vector3<f64>,
    given: &[Vector3<f64>],
) -> Option<Apart> {
    let from_centre = |point: &Vector3<f64>| point - pose.position();
    let lengths = given.iter().map(|point| from_centre(point).norm()).fold(0.0, f64::max);
    // To the plane, and its foot there.
    let height = normal.dot(&from_centre(&given[0]));
    let foot = height * normal;
    let triangle: Option<&[Vector3<f64>; 3]> = given.try_into().ok();
    let nearest = triangle.map_or(foot, |vertices| nearest(vertices, pose.position(), normal, &foot));
    let slack = shift_in_a(nearest.norm(), lengths);
    let by_ball = nearest.norm() * (1.0 - MARGIN) - slack - particle.bounding_radius();
    let towards = height.signum() * pose.rotation().tr_mul(normal);
    let by_plane = height.abs() * (1.0 - MARGIN) - slack - particle.bounds.support(&towards);
    let distance = larger(by_ball, by_plane);
    if distance > 0.0 {
        let by = if by_ball > 0.0 { Flags::BY_SPHERES } else { Flags::BY_FACE };
        return Some(Apart::new(by, distance));
    }
    let in_particle = |way: &Vector3<f64>| pose.rotation().tr_mul(way);
    let vertices = triangle?.map(|vertex| in_particle(&from_centre(&vertex)));
    beyond_a_face(particle, &vertices, &in_particle(&nearest), slack)
        .map(|distance| Apart::new(Flags::BY_FACE, distance))
}

/// The point of a triangle that is nearest to a centre, seen from there, where `foot` is that of its plane. Where the
/// squares of the edges leave the range of doubles, the foot itself, which is no farther off.
fn nearest(
    vertices: &[Vector3<f64>; 3],
    centre: &Vector3<f64>,
    normal: &Vector3<f64>,
    foot: &Vector3<f64>,
) -> Vector3<f64> {
    let (mut nearest, mut least) = (*foot, f64::INFINITY);
    for i in 0..3 {
        let (from, edge) = (vertices[i] - centre, vertices[(i + 1) % 3] - vertices[i]);
        let (square, beyond) = (edge.norm_squared(), normal.dot(&edge.cross(&(foot - from))));
        if !(square > f64::MIN_POSITIVE / f64::EPSILON && square.is_finite() && beyond.is_finite()) {
            return *foot;
        }
        if beyond < 0.0 {
            let on_edge = from + smaller(larger(-from.dot(&edge) / square, 0.0), 1.0) * edge;
            if on_edge.norm_squared() < least {
                (nearest, least) = (on_edge, on_edge.norm_squared());
            }
        }
    }
    nearest
}

/// How far all vertices lie beyond the face of the particle that the nearest point lies farthest beyond.
fn beyond_a_face(particle: &Particle, vertices: &[Vector3<f64>; 3], nearest: &Vector3<f64>, slack: f64) -> Option<f64> {
    if particle.is_sphere() {
        return None;
    }
    let (_, face) = particle.farthest_excess(nearest);
    let n = particle.normal(face);
    let length = n.norm();
    let least = vertices.iter().map(|y| n.dot(y) - MARGIN * length * y.norm()).fold(f64::INFINITY, f64::min);
    let reach = particle.offset(face) + particle.bounds.face_reach;
    let beyond = least - reach - MARGIN * (particle.offset(face).abs() + particle.bounds.face_reach) - slack * length;
    (beyond > 0.0).then(|| beyond / length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::boundary::Triangle;
    use crate::pair::scattered;

    #[test]
    fn no_point_of_the_triangle_is_nearer_than_the_nearest() {
        let mut places = [0; 2];
        for seed in 0..200 {
            let mut chance = scattered(12 * seed);
            let mut vector = || Vector3::<f64>::from_fn(|_, _| 2.0 * chance());
            let (centre, [a, b, c]) = (0.4 * vector(), [vector(), vector(), vector()]);
            let Ok(given) = Triangle::new([a, b, c].map(Into::into)) else { continue };
            let foot = given.normal.dot(&(a - centre)) * given.normal;
            let nearest = nearest(&given.vertices, &centre, &given.normal, &foot);
            places[usize::from(nearest == foot)] += 1;
            for (i, j) in (0..=20).flat_map(|i| (0..=20 - i).map(move |j| (i, j))) {
                let (u, v) = (f64::from(i) / 20.0, f64::from(j) / 20.0);
                let x: Vector3<f64> = u * a + v * b + (1.0 - u - v) * c - centre;
                // It lies on the side of the plane at right angles to the way to the nearest one.
                assert!(x.norm() >= nearest.norm() * (1.0 - 1e-12), "{nearest:?}, {x:?}");
                assert!((x - nearest).dot(&nearest) >= -1e-12 * x.norm(), "{nearest:?}, {x:?}");
            }
        }
        assert!(places.iter().all(|count| *count > 20), "{places:?}");
    }

    /// Edges whose squares leave the range of doubles say nothing, rather than a vertex that is too far.
    #[test]
    fn of_a_triangle_beyond_all_range_the_foot_is_taken() {
        for size in [1e-160, 1e160] {
            let [a, b, c] = [[-1.0, -1.0, 1.0], [3.0, -1.0, 1.0], [-1.0, 2.0, 1.0]].map(|v| size * Vector3::from(v));
            let foot = size * Vector3::z();
            assert_eq!(nearest(&[a, b, c], &Vector3::zeros(), &Vector3::z(), &foot), foot);
        }
    }
}
