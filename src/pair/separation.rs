//! Separation tests: each proves that two particles share no point, with a lower bound on their distance, or proves
//! nothing.

use crate::flags::Flags;
use crate::linalg::number::{larger, smaller};
use crate::pair::pair::Pair;
use crate::particle::numbers::MARGIN;
use crate::particle::particle::Particle;
use crate::particle::potential;
use crate::pose::Pose;
use nalgebra::{Matrix3, Vector3};

/// A proof that two particles share no point.
#[derive(Clone, Copy, Debug)]
pub struct Apart {
    /// Which proof.
    pub by: Flags,
    /// The particles are at least this far from each other, length.
    pub distance: f64,
}

impl Apart {
    /// From a distance that is known but for the rounding of a few operations on it.
    pub(crate) fn new(by: Flags, distance: f64) -> Self {
        Self { by, distance: distance * (1.0 - MARGIN) }
    }
}

/// Lower bound on the distance of two particles for which midway has s ≥ `low`. s is 1 on the surface and has the
/// Lipschitz constant 1/ℓ, so that at the point that divides a gap d as ℓ_A : ℓ_B both s are at most 1 + d/(ℓ_A + ℓ_B).
pub(crate) fn distance_of_scale(a: &Particle, b: &Particle, low: f64) -> f64 {
    larger(low - 1.0, 0.0) * (a.slope_length + b.slope_length) * (1.0 - MARGIN)
}

/// Two balls that hold the particles and do not meet.
pub fn balls_apart(pair: &Pair) -> Option<Apart> {
    let distance = pair.centre.norm() * (1.0 - MARGIN) - (pair.a.bounding_radius() + pair.b.bounding_radius());
    (distance > 0.0).then(|| Apart::new(Flags::BY_SPHERES, distance))
}

/// The separation tests by balls and by faces.
pub fn proof_of_separation(pair: &Pair) -> Option<Apart> {
    let (a, b) = (pair.a, pair.b);
    balls_apart(pair).or_else(|| {
        let distance = pair.centre.norm();
        let b_in_a = pair.in_a(&Vector3::zeros());
        beyond_a_face(a, &b_in_a, b, &pair.rotation, distance)
            .or_else(|| beyond_a_face(b, &pair.centre, a, &pair.rotation.transpose(), distance))
            .map(|distance| Apart::new(Flags::BY_FACE, distance))
    })
}

/// A proof of separation by the tangents of both potentials at x (local frame of B), if they give one.
///
/// S is convex, so that for any λ > 0 and any y that both hold
///
/// ```text
/// 1 + λ ≥ S_A(y) + λ S_B(y) ≥ S_A(x) + λ S_B(x) − |∇S_A(x) + λ ∇S_B(x)|·|y − x|
/// ```
///
/// and |y − x| is at most the way to the far side of either ball. At the optimum of midway the gradients
/// are opposite, and the point of the last call is near it.
///
/// For two points at a distance d, one in A and one in B, the left side grows by |∇S_A(x)|·d or λ|∇S_B(x)|·d, depending
/// on which of them y is: its excess over 1 + λ, divided by the larger slope, is a lower bound on d.
#[inline(always)]
pub(crate) fn still_apart(
    (particle_a, pose_a): (&Particle, &Pose),
    (particle_b, pose_b): (&Particle, &Pose),
    x: &Vector3<f64>,
) -> Option<Apart> {
    // In world axes: the pair itself, with its product of rotations, is not needed.
    let from_a = pose_b.rotation() * x + (pose_b.position() - pose_a.position());
    let a = potential::tangent(particle_a, &pose_a.rotation().tr_mul(&from_a));
    let b = potential::tangent(particle_b, x);
    let (to_a, to_b) = (from_a.norm(), x.norm());
    let reach = smaller(to_a + particle_a.bounding_radius(), to_b + particle_b.bounding_radius());
    let (gradient_a, gradient_b) = (pose_a.rotation() * a.gradient, pose_b.rotation() * b.gradient);
    // The λ for which the sum of the gradients is shortest.
    let lambda = -gradient_a.dot(&gradient_b) / gradient_b.norm_squared();
    let slope = (gradient_a + lambda * gradient_b).norm();
    // What rounding can do: to the distances of the planes, and with them to the values and the slope.
    let lengths = 2.0 * (to_a + to_b + particle_a.bounds.offset_within(to_a) + particle_b.bounds.offset_within(to_b));
    let blur = MARGIN * lengths;
    // A plane whose normal is longer than 1 blurs by so much more.
    let [blur_a, blur_b] = [particle_a, particle_b].map(|particle| blur * larger(particle.bounds.longest_normal, 1.0));
    let doubt = |t: &potential::Tangent, blur: f64| blur * (t.pull + t.stiffness * (blur + reach)) + MARGIN * t.value;
    let least = a.value + lambda * b.value - slope * reach - doubt(&a, blur_a) - lambda * doubt(&b, blur_b);
    if !(lambda > 0.0 && least > 1.0 + lambda) {
        return None;
    }
    // λ|∇S_B| is the projection of ∇S_A, so that it is not longer than ∇S_A.
    let steepest = gradient_a.norm() + larger(blur_a * a.stiffness, lambda * (blur_b * b.stiffness));
    Some(Apart::new(Flags::BY_MEMORY, (least - (1.0 + lambda)) / steepest))
}

/// How far `other`, centred at `centre` in the frame of `host`, lies beyond a face of `host`, if it does.
///
/// f ≤ 0 implies n·x ≤ d + r/√(1−k). The ball of `other`, then its tighter corners, are tried against a face that its
/// centre lies far beyond: any face is valid for a proof. `to_other` takes directions from the frame of `host` to that
/// of `other`.
fn beyond_a_face(
    host: &Particle,
    centre: &Vector3<f64>,
    other: &Particle,
    to_other: &Matrix3<f64>,
    distance: f64,
) -> Option<f64> {
    // No face lies nearer to the centre of `host` than the first of these, and `other` reaches as far as the second all
    // around.
    if host.is_sphere() || distance <= host.bounds.nearest + other.bounds.inner {
        return None;
    }
    let ball = other.bounding_radius();
    let (most, face) = host.likely_excess(centre);
    let n = host.normal(face);
    let length = n.norm();
    let reach = host.bounds.face_reach;
    let slack = MARGIN * (distance * length + host.offset(face).abs() + reach + ball * length);
    let gap = most - reach - slack;
    if gap > ball * length {
        return Some(gap / length - ball);
    }
    if gap <= other.bounds.inner * length {
        return None;
    }
    let extent = other.bounds.support(&(to_other * (-n / length)));
    (gap > length * extent).then(|| gap / length - extent)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pair::scattered;
    use crate::particle::plane::Plane;
    use crate::{Kind, PairState, Settings, detect};

    fn cube() -> Particle {
        Particle::cube(0.4, 0.1, 0.02, 0.9)
    }

    #[test]
    fn whoever_moves_by_less_than_the_distance_meets_nobody() {
        let (a, pose_a, settings) = (cube(), Pose::at([0.0; 3]).unwrap(), Settings::default());
        let mut seen = [0; 3];
        for seed in 0..200 {
            let mut chance = scattered(1000 * seed);
            let mut vector = || Vector3::from_fn(|_, _| chance());
            let (turn, direction) = (vector(), vector().normalize());
            let at = |position: Vector3<f64>| Pose::new(position.into(), [0.5, turn.x, turn.y, turn.z]).unwrap();
            let mut state = PairState::default();
            // Closer from call to call, so that the proof changes.
            for far in (0..40).map(|i| 2.2 - 0.03 * f64::from(i)) {
                let pose_b = at(far * direction);
                let contact = detect(&a, &pose_a, &a, &pose_b, &settings, Some(&mut state)).unwrap();
                if contact.kind == Kind::Overlapping {
                    assert!(contact.distance.is_nan());
                    break;
                }
                let proofs = [Flags::BY_SPHERES, Flags::BY_FACE, Flags::BY_MEMORY];
                // Else planes in balance have proved it, or a solver has.
                if let Some(proof) = proofs.iter().position(|&proof| contact.flags.contains(proof)) {
                    seen[proof] += 1;
                }
                assert!(contact.distance > 0.0);
                for towards in [-direction, vector().normalize(), vector().normalize()] {
                    let moved = at(far * direction + 0.999_999 * contact.distance * towards);
                    let then = detect(&a, &pose_a, &a, &moved, &settings, None).unwrap();
                    assert_eq!(then.kind, Kind::Separated, "{contact:?} moved along {towards:?}");
                }
            }
        }
        assert!(seen.iter().all(|&count| count > 100), "{seen:?}");
    }

    /// A ball cut by one plane, with a normal of that length.
    fn cap(length: f64) -> Particle {
        let plane = Plane { normal: length * Vector3::z(), offset: 0.1 * length };
        Particle::new(&[plane], 0.05 * length, 0.01, 0.5).unwrap()
    }

    /// A little further apart than where they touch, where no other proof than the solution is found.
    #[test]
    fn particles_that_are_solved_apart_do_not_meet_within_their_distance() {
        let shapes = [
            cube(),
            Particle::cube(0.5, 1e-3, 0.0, 0.0),
            Particle::cube(0.45, 0.05, 0.3, 0.8),
            cube().scaled(1e-3).unwrap(),
            // Of a single plane nothing is lost where it faces the other.
            cap(1.0),
            cap(1e3),
        ];
        let mut solved = 0;
        for seed in 0..600 {
            let mut chance = scattered(500 * seed);
            let mut vector = || Vector3::from_fn(|_, _| chance());
            let (a, b) = (&shapes[seed % 6], &shapes[seed / 6 % 6]);
            let (direction, turn, other) = (vector().normalize(), vector(), vector());
            let pose_a = Pose::new([0.0; 3], [0.5, turn.x, turn.y, turn.z]).unwrap();
            let at = |position: Vector3<f64>| Pose::new(position.into(), [0.5, other.x, other.y, other.z]).unwrap();
            let look = |position| detect(a, &pose_a, b, &at(position), &Settings::default(), None).unwrap();
            let to_the_end = Settings::default().with_solve_separated(true);
            let (mut deep, mut apart) = (0.0, a.bounding_radius() + b.bounding_radius());
            for _ in 0..30 {
                let middle = 0.5 * (deep + apart);
                let touching = look(middle * direction).kind == Kind::Overlapping;
                if touching { deep = middle } else { apart = middle }
            }
            for share in [1e-6, 1e-4, 1e-3] {
                let position = (1.0 + share) * apart * direction;
                let contact = look(position);
                assert!(contact.kind == Kind::Separated && contact.distance > 0.0, "{contact:?}");
                // No more than the way back to where they touch.
                assert!(contact.distance <= 1.001 * ((1.0 + share) * apart - deep), "{contact:?}");
                solved += usize::from(contact.flags == Flags::REJECTED && contact.iterations > 0);
                // A pair that is solved to the end knows a distance, too.
                let ended = detect(a, &pose_a, b, &at(position), &to_the_end, None).unwrap();
                assert!(ended.distance > 0.0 && ended.distance <= 1.001 * ((1.0 + share) * apart - deep), "{ended:?}");
                for towards in [-ended.normal, -direction, vector().normalize()] {
                    let way = 0.999_999 * contact.distance.max(ended.distance);
                    let then = look(position + way * towards);
                    assert_eq!(then.kind, Kind::Separated, "{contact:?} moved along {towards:?}");
                }
            }
        }
        assert!(solved > 300, "{solved}");
    }

    /// However far from both: the tangents there prove nothing that is not so.
    #[test]
    fn no_point_proves_that_overlapping_particles_are_apart() {
        let sharp = |offset: f64, r: f64| Particle::cube(offset, r, 0.0, 0.0);
        let particles = [cube(), sharp(0.5, 1e-4), sharp(0.5, 1e-9), sharp(0.4, 0.1), Particle::sphere(0.5).unwrap()];
        let mut overlapping = 0;
        for seed in 0..50_000 {
            let mut chance = scattered(20 * seed);
            let mut vector = || Vector3::from_fn(|_, _| chance());
            let (a, b) = (&particles[seed % 5], &particles[seed / 5 % 5]);
            let (towards, turn, other, x, powers) = (vector().normalize(), vector(), vector(), vector(), vector());
            let pose_a = Pose::new([0.0; 3], [0.5, turn.x, turn.y, turn.z]).unwrap();
            let pose_b = Pose::new((0.9 * towards).into(), [0.5, other.x, other.y, other.z]).unwrap();
            let contact = detect(a, &pose_a, b, &pose_b, &Settings::default(), None).unwrap();
            // Of one size, or each coordinate of its own.
            let largest = (seed / 25 % 309) as f64;
            let x = x.zip_map(&powers, |x, p| x * 10_f64.powf(if seed % 2 == 0 { largest } else { largest * p.abs() }));
            if contact.kind == Kind::Overlapping {
                overlapping += 1;
                let proof = still_apart((a, &pose_a), (b, &pose_b), &x);
                assert!(proof.is_none(), "{proof:?} from {x:?}: {contact:?}");
            }
        }
        assert!(overlapping > 25_000, "{overlapping}");
    }

    #[test]
    fn faces_and_balls_know_their_distance() {
        let (cube, ball) = (cube(), Particle::sphere(0.5).unwrap());
        let distance = |a: &Particle, b: &Particle, at: [f64; 3]| {
            let (pose_a, pose_b) = (Pose::at([0.0; 3]).unwrap(), Pose::at(at).unwrap());
            proof_of_separation(&Pair::new(a, &pose_a, b, &pose_b)).unwrap().distance
        };
        let between = 5.0 - 2.0 * ball.bounding_radius();
        assert!((distance(&ball, &ball, [0.0, 3.0, 4.0]) - between).abs() < 1e-12 && between > 3.99);
        // A face bulges by what the shadow sphere takes away and (1−k) gives: the bounds know it to a few percent of r.
        let faces = distance(&cube, &cube, [0.0, 1.2, 0.0]);
        assert!(0.19 < faces && faces <= 0.2 + 0.01, "{faces}");
    }
}
