//! Cheap proofs that a particle does not reach a flat boundary. Each is one-sided: `None` means nothing.

use super::placed::Placed;
use crate::flags::Flags;
use crate::linalg::number::larger;
use crate::pair::body::shift_in_a;
use crate::pair::separation::{Apart, MARGIN};
use crate::particle::particle::Particle;
use nalgebra::Vector3;

/// By the bounding ball, or by the plane of the boundary and the corners of the particle's bounding polyhedron, with the larger
/// distance of both; else by a face of the particle.
pub(super) fn proof_of_separation(particle: &Particle, boundary: &Placed) -> Option<Apart> {
    let nearest = boundary.nearest();
    let slack = shift_in_a(nearest.norm(), boundary.farthest);
    let by_ball = nearest.norm() * (1.0 - MARGIN) - slack - particle.bounding_radius();
    let towards = boundary.normal * boundary.offset.signum();
    let by_plane = boundary.offset.abs() * (1.0 - MARGIN) - slack - particle.support(&towards);
    let distance = larger(by_ball, by_plane);
    if distance > 0.0 {
        let by = if by_ball > 0.0 { Flags::BY_SPHERES } else { Flags::BY_FACE };
        return Some(Apart::new(by, distance));
    }
    let corners = boundary.corners.as_ref()?;
    beyond_a_face(particle, &corners.at, &nearest, slack).map(|distance| Apart::new(Flags::BY_FACE, distance))
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
