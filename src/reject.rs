//! Cheap proofs that a pair is separated. Each is one-sided: "no" means nothing.

use crate::pair::Pair;
use crate::particle::Particle;
use nalgebra::{Matrix3, Vector3};

/// Rounding of the sums below, relative to the lengths in them; thirty times what they can lose.
const MARGIN: f64 = 1e-14;

/// Whether two balls that hold the particles prove that they share no point.
pub fn balls_apart(pair: &Pair) -> bool {
    pair.centre.norm() * (1.0 - MARGIN) > pair.a.bounding_radius() + pair.b.bounding_radius()
}

/// Whether a cheap test, by balls or by faces, proves that the particles share no point.
pub fn proves_separation(pair: &Pair) -> bool {
    let (a, b) = (pair.a, pair.b);
    if balls_apart(pair) {
        return true;
    }
    let distance = pair.centre.norm();
    let b_in_a = pair.in_a(&Vector3::zeros());
    beyond_a_face(a, &b_in_a, b, &pair.rotation, distance)
        || beyond_a_face(b, &pair.centre, a, &pair.rotation.transpose(), distance)
}

/// Whether `other`, centred at `centre` in the frame of `host`, lies beyond a face of `host`.
///
/// f ≤ 0 implies n·x ≤ d + r/√(1−k). The ball of `other` is tried against every face; its corners, which
/// are tighter, against the face that its centre lies furthest beyond. `to_other` takes
/// directions from the frame of `host` to that of `other`.
fn beyond_a_face(
    host: &Particle,
    centre: &Vector3<f64>,
    other: &Particle,
    to_other: &Matrix3<f64>,
    distance: f64,
) -> bool {
    if host.is_sphere() {
        return false;
    }
    let ball = other.bounding_radius();
    let (most, face) = host.leaves.largest(centre, |run| {
        let (mut most, mut face) = (f64::NEG_INFINITY, 0);
        for (i, [a, b, c], d) in host.run(run) {
            let beyond = a * centre.x + b * centre.y + c * centre.z - d;
            if beyond > most {
                (most, face) = (beyond, i);
            }
        }
        (most, face)
    });
    let n = host.normal(face);
    let length = n.norm();
    let reach = host.bounds.face_reach;
    let slack = MARGIN * (distance * length + host.bounds.longest_offset + reach + ball * length);
    let gap = most - reach - slack;
    gap > ball * length || gap > length * other.support(&(to_other * (-n / length)))
}
