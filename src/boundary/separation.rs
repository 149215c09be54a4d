//! Separation tests of a particle and a boundary: each proves that they share no point, or proves nothing (`None`).

use super::triangle::PlacedTriangle;
use crate::flags::Flags;
use crate::linalg::number::larger;
use crate::pair::body::shift_in_a;
use crate::pair::pair::Pair;
use crate::pair::separation::{Apart, MARGIN};
use crate::particle::particle::Particle;
use nalgebra::{Vector2, Vector3};

/// By the bounding ball, or by the plane of the boundary and the corners of the particle's bounding polyhedron, with the larger
/// distance of both; else by a face of the particle. `pair` is that of the particle and the plane.
pub(super) fn proof_of_separation(pair: &Pair, triangle: Option<&PlacedTriangle>) -> Option<Apart> {
    let particle = pair.a;
    let nearest = pair.in_a(&triangle.map_or_else(Vector2::zeros, |triangle| triangle.nearest()).push(0.0));
    let slack = shift_in_a(nearest.norm(), pair.lengths);
    let by_ball = nearest.norm() * (1.0 - MARGIN) - slack - particle.bounding_radius();
    // From the centre to the plane.
    let towards = -pair.centre.z.signum() * pair.rotation.row(2).transpose();
    let by_plane = pair.centre.z.abs() * (1.0 - MARGIN) - slack - particle.support(&towards);
    let distance = larger(by_ball, by_plane);
    if distance > 0.0 {
        let by = if by_ball > 0.0 { Flags::BY_SPHERES } else { Flags::BY_FACE };
        return Some(Apart::new(by, distance));
    }
    let vertices = triangle?.in_particle(pair);
    beyond_a_face(particle, &vertices, &nearest, slack).map(|distance| Apart::new(Flags::BY_FACE, distance))
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
