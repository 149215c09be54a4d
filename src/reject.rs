//! Cheap proofs that a pair is separated. Each is one-sided: "no" means nothing.

use crate::contact::Flags;
use crate::pair::Pair;
use crate::particle::Particle;
use crate::potential;
use nalgebra::{Matrix3, Vector3};

/// Rounding of the sums below, relative to the lengths in them; thirty times what they can lose.
const MARGIN: f64 = 1e-14;

/// Whether two balls that hold the particles prove that they share no point.
pub fn balls_apart(pair: &Pair) -> bool {
    pair.centre.norm() * (1.0 - MARGIN) > pair.a.bounding_radius() + pair.b.bounding_radius()
}

/// A cheap proof, by balls or by faces, that the particles share no point.
pub fn proof_of_separation(pair: &Pair) -> Option<Flags> {
    let (a, b) = (pair.a, pair.b);
    if balls_apart(pair) {
        return Some(Flags::BY_SPHERES);
    }
    let distance = pair.centre.norm();
    let b_in_a = pair.in_a(&Vector3::zeros());
    let apart = beyond_a_face(a, &b_in_a, b, &pair.rotation, distance)
        || beyond_a_face(b, &pair.centre, a, &pair.rotation.transpose(), distance);
    apart.then_some(Flags::BY_FACE)
}

/// Whether the tangents of both potentials at x (frame of B) prove that the particles share no point.
///
/// S is convex, so that for any λ > 0 and any y that both hold
///
/// ```text
/// 1 + λ ≥ S_A(y) + λ S_B(y) ≥ S_A(x) + λ S_B(x) − |∇S_A(x) + λ ∇S_B(x)|·|y − x|
/// ```
///
/// and |y − x| is at most the way to the far side of either ball. At the optimum of midway the gradients
/// are opposite, and the point of the last call is near it.
pub(crate) fn still_apart(pair: &Pair, x: &Vector3<f64>) -> bool {
    let (from_a, from_b) = (x - pair.centre, *x);
    let a = potential::tangent(pair.a, &pair.rotation.tr_mul(&from_a));
    let b = potential::tangent(pair.b, &from_b);
    let (to_a, to_b) = (from_a.norm(), from_b.norm());
    let reach = (to_a + pair.a.bounding_radius()).min(to_b + pair.b.bounding_radius());
    let gradient_a = pair.rotation * a.gradient;
    // The λ for which the sum of the gradients is shortest.
    let lambda = -gradient_a.dot(&b.gradient) / b.gradient.norm_squared();
    let slope = (gradient_a + lambda * b.gradient).norm();
    // What rounding can do: to the distances of the planes, and with them to the values and the slope.
    let lengths = 2.0 * (to_a + to_b + pair.a.bounds.offset_within(to_a) + pair.b.bounds.offset_within(to_b));
    let blur = MARGIN * lengths;
    let doubt = |t: &potential::Tangent| blur * (t.pull + t.stiffness * (blur + reach)) + MARGIN * t.value;
    let least = a.value + lambda * b.value - slope * reach - doubt(&a) - lambda * doubt(&b);
    lambda > 0.0 && least > 1.0 + lambda
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
    let (most, face) = host.farthest_excess(centre);
    let n = host.normal(face);
    let length = n.norm();
    let reach = host.bounds.face_reach;
    let slack = MARGIN * (distance * length + host.offset(face).abs() + reach + ball * length);
    let gap = most - reach - slack;
    gap > ball * length || gap > length * other.support(&(to_other * (-n / length)))
}
