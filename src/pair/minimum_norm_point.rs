//! Planes of two particles in balance: the point of least norm in the convex hull of their gradients (Wolfe 1976), and
//! what that proves.
//!
//! Let g_i = ρ n_i be the gradients of planes of both particles, with a factor ρ for each particle, and c_i ≥ 0 shares.
//! In a particle Σ c_i ρ (n_i·x − d_i), over any of its planes, is at most ρ·r/√(1−k) times the root of the sum of
//! c_i², since w Σ⟨n_i·x − d_i⟩² is at most 1. The sum over the planes of both has the slope y = Σ c_i g_i. Where that
//! is 0 or nearly, the sum is the same everywhere, and no point lies in both particles if it is more than what both
//! allow. Of two points at a distance d, one in A and one in B, the sum at either exceeds that by at most d times the
//! slope of the other one's planes.

use crate::flags::Flags;
use crate::linalg::number::{larger, smaller};
use crate::pair::separation::Apart;
use crate::particle::numbers::MARGIN;
use crate::particle::particle::{MAX_PLANES, Particle};
use crate::pose::Pose;
use nalgebra::Vector3;

/// A plane that takes part.
#[derive(Clone, Copy)]
pub(crate) struct Face {
    /// g = ρ·n, with a factor ρ of its particle.
    pub gradient: Vector3<f64>,
    /// Of A (0) or B (1).
    pub of: usize,
    pub place: usize,
}

/// Planes that balance each other as far as they can: y = Σ c_i g_i is the shortest vector of their convex hull.
#[derive(Clone, Copy)]
pub(crate) struct MinimumNorm {
    pub faces: [Face; 4],
    /// c_i > 0, Σ c_i = 1.
    pub shares: [f64; 4],
    pub count: usize,
    /// Square of the longest g that was ever in it.
    pub longest: f64,
    /// Vectors in the span of the differences g_i − g_last, each with product 1 with its own and 0 with the others.
    pub reciprocal: [Vector3<f64>; 3],
}

impl MinimumNorm {
    pub fn of(face: Face) -> Self {
        let longest = face.gradient.norm_squared();
        let reciprocal = [Vector3::zeros(); 3];
        Self { faces: [face; 4], shares: [1.0, 0.0, 0.0, 0.0], count: 1, longest, reciprocal }
    }

    /// y.
    pub fn shortest(&self) -> Vector3<f64> {
        (1..self.count).fold(self.shares[0] * self.g(0), |sum, i| sum + self.shares[i] * self.g(i))
    }

    fn g(&self, i: usize) -> &Vector3<f64> {
        &self.faces[i].gradient
    }

    /// One more plane; those that y needs no longer go (Wolfe's algorithm). `None` where rounding decides.
    pub fn join(&mut self, face: Face) -> Option<()> {
        self.longest = larger(face.gradient.norm_squared(), self.longest);
        self.faces[self.count] = face;
        self.shares[self.count] = 0.0;
        self.count += 1;
        loop {
            let wanted = self.affine();
            // The way to `wanted` on which all shares stay positive, and which vanishes first.
            let (mut way, mut first) = (1.0, None);
            // By index: iterators make these short loops longer.
            #[allow(clippy::needless_range_loop)]
            for i in 0..self.count {
                let (have, want) = (self.shares[i], wanted[i]);
                if !want.is_finite() {
                    return None;
                }
                if want <= 0.0 && have <= way * (have - want) {
                    (way, first) = (have / (have - want), Some(i));
                }
            }
            #[allow(clippy::needless_range_loop)]
            for i in 0..self.count {
                self.shares[i] += way * (wanted[i] - self.shares[i]);
            }
            let Some(i) = first else { return Some(()) };
            self.count -= 1;
            if i == self.count {
                return None;
            }
            // The newest stays last.
            for j in i..self.count {
                (self.faces[j], self.shares[j]) = (self.faces[j + 1], self.shares[j + 1]);
            }
        }
    }

    /// Shares, of any sign, of the shortest vector in the affine hull.
    fn affine(&mut self) -> [f64; 4] {
        let last = self.count - 1;
        self.reciprocal = self.reciprocal_to_last();
        let g = self.g(last);
        let shares = self.reciprocal.map(|r| -g.dot(&r));
        let mut all = [0.0; 4];
        all[..last].copy_from_slice(&shares[..last]);
        all[last] = 1.0 - shares[..last].iter().sum::<f64>();
        all
    }

    fn reciprocal_to_last(&self) -> [Vector3<f64>; 3] {
        let last = self.g(self.count - 1);
        let zero = Vector3::zeros();
        match self.count {
            2 => {
                let u = self.g(0) - last;
                [u * (1.0 / u.norm_squared()), zero, zero]
            }
            3 => {
                let (u, v) = (self.g(0) - last, self.g(1) - last);
                let across = u.cross(&v);
                let per_area = 1.0 / across.norm_squared();
                [v.cross(&across) * per_area, across.cross(&u) * per_area, zero]
            }
            _ => {
                let (u, v, w) = (self.g(0) - last, self.g(1) - last, self.g(2) - last);
                let across = v.cross(&w);
                let per_volume = 1.0 / u.dot(&across);
                [across * per_volume, w.cross(&u) * per_volume, u.cross(&v) * per_volume]
            }
        }
    }

    /// Of planes that were in balance before, with the shares that they have now, of any sign.
    pub fn again(faces: [Face; 4], count: usize) -> Self {
        let mut hull = Self { faces, count, ..Self::of(faces[0]) };
        hull.shares = hull.affine();
        hull
    }

    /// The proof of separation by the planes, if there is one, from n·x − d of each at a point x at distances `far`
    /// from both centres. `rho` are the factors of the gradients.
    #[inline(always)]
    pub fn proof(
        &self,
        particles: [&Particle; 2],
        rho: [f64; 2],
        far: [f64; 2],
        excess: impl Fn(&Face) -> f64,
    ) -> Option<Apart> {
        let (mut sum, mut all, mut squares, mut slopes) = (0.0, [0.0; 2], [0.0; 2], [Vector3::zeros(); 2]);
        for (face, share) in self.faces.iter().zip(self.shares).take(self.count) {
            let share = larger(share, 0.0);
            let weight = share * rho[face.of];
            sum += weight * excess(face);
            all[face.of] += weight;
            squares[face.of] += weight * weight;
            slopes[face.of] += share * face.gradient;
        }
        let [most_a, most_b] = [0, 1].map(|i| particles[i].bounds.face_reach * f64::sqrt(squares[i]));
        let steep = all[0] * particles[0].bounds.longest_normal + all[1] * particles[1].bounds.longest_normal;
        let reach = [0, 1].map(|i| far[i] + particles[i].bounding_radius());
        let lengths = [0, 1].map(|i| far[i] + particles[i].bounds.offset_within(far[i]));
        let reach = smaller(reach[0], reach[1]);
        let doubt = MARGIN * (2.0 * (lengths[0] + lengths[1]) * (all[0] + all[1] + steep) + reach * steep);
        let slope = (slopes[0] + slopes[1]).norm();
        let over = sum - slope * reach - doubt - (most_a + most_b) * (1.0 + MARGIN);
        // What the planes of either particle gain is no more than that.
        (over > 0.0).then(|| Apart::new(Flags::NONE, over / (slopes[0].norm() + slope)))
    }

    /// Which planes they are, as two whole numbers.
    pub fn places(&self) -> [f64; 2] {
        let one = |i: usize| {
            let Face { of, place, .. } = self.faces[i];
            if i < self.count { MAX_PLANES * of + place } else { NO_PLANE }
        };
        [0, 2].map(|i| (one(i) + SECOND * one(i + 1)) as f64)
    }
}

/// A whole number encodes two planes, the second times [`SECOND`]: each by its place, plus [`MAX_PLANES`] if of B, or
/// by this if there is none (derived).
const NO_PLANE: usize = 2 * MAX_PLANES;
const SECOND: usize = 4 * MAX_PLANES;

/// Body (0, 1) and place of the planes of [`MinimumNorm::places`], and how many of them the particles have; any numbers
/// are allowed.
#[inline(always)]
fn planes_at(particles: [&Particle; 2], [first, second]: &[f64; 2]) -> ([(usize, usize); 4], usize) {
    // What is negative or not a number becomes 0.
    let [first, second] = [*first as usize, *second as usize];
    let planes = [first % SECOND, first / SECOND, second % SECOND, second / SECOND]
        .map(|one| (one / MAX_PLANES, one % MAX_PLANES));
    // Each once: the bound is of different planes.
    let is_one = |&i: &usize| {
        let (of, place) = planes[i];
        of < 2 && place < particles[of].len() && !planes[..i].contains(&planes[i])
    };
    let count = (0..4).take_while(is_one).count();
    (planes, count)
}

/// What planes that were in balance ([`MinimumNorm::places`]) prove at these poses, whichever they are; x is any point
/// between the particles, local frame of B.
#[inline(always)]
pub(crate) fn still_balanced(
    (a, pose_a): (&Particle, &Pose),
    (b, pose_b): (&Particle, &Pose),
    x: &Vector3<f64>,
    places: &[f64; 2],
) -> Option<Apart> {
    let (particles, poses) = ([a, b], [pose_a, pose_b]);
    let (planes, count) = planes_at(particles, places);
    if count < 2 {
        return None;
    }
    // In world axes, as `separation::still_apart`.
    let from_b = pose_b.rotation() * x;
    let from = [from_b + (pose_b.position() - pose_a.position()), from_b];
    // Without a branch on the body, which no processor foresees.
    let face = |i: usize| {
        let (of, place) = if i < count { planes[i] } else { planes[0] };
        Face { gradient: poses[of].rotation() * particles[of].normal(place), of, place }
    };
    let excess = |&Face { gradient, of, place }: &Face| gradient.dot(&from[of]) - particles[of].offset(place);
    let hull = MinimumNorm::again([face(0), face(1), face(2), face(3)], count);
    let apart = hull.proof(particles, [1.0; 2], from.map(|from| from.norm()), excess);
    apart.map(|apart| Apart { by: Flags::BY_MEMORY, ..apart })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pair::scattered;
    use crate::{Kind, PairState, Settings, detect};

    /// Each plane that joins shortens y, which has the same product with all that are left: none is nearer to the
    /// origin.
    #[test]
    fn the_hull_gives_the_shortest_vector() {
        let mut joined = 0;
        for seed in 0..300 {
            let mut chance = scattered(40 * seed);
            let mut face = || {
                let gradient = Vector3::new(0.4, 0.0, 0.0) + Vector3::<f64>::from_fn(|_, _| chance());
                Face { gradient, of: 0, place: 0 }
            };
            let mut hull = MinimumNorm::of(face());
            for _ in 0..10 {
                let (next, last) = (face(), hull.shortest());
                // Others do not take over.
                if hull.count == 4 || next.gradient.dot(&last) >= 0.9 * last.norm_squared() {
                    continue;
                }
                if hull.join(next).is_none() {
                    break;
                }
                joined += 1;
                let (y, shares) = (hull.shortest(), &hull.shares[..hull.count]);
                assert!(hull.count == 4 || y.norm() < last.norm(), "{y:?}");
                assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-12 && shares.iter().all(|share| *share > 0.0));
                let scale = 1e-9 * hull.longest;
                assert!((0..hull.count).all(|i| (y.dot(hull.g(i)) - y.norm_squared()).abs() < scale), "{y:?}");
            }
        }
        assert!(joined > 300, "{joined}");
    }

    /// Two edges of cubes that cross at right angles: each reaches √2·d + r from its centre. From nothing and from
    /// memory, at the distance and after a turn.
    #[test]
    fn edges_know_their_distance() {
        let cube = Particle::cube(0.4, 0.1, 0.0, 0.0);
        let (reach, between) = (0.4 * 2f64.sqrt() + 0.1, 0.05);
        let eighth = 0.125 * std::f64::consts::PI;
        let pose_a = Pose::new([0.0; 3], [eighth.cos(), eighth.sin(), 0.0, 0.0]).unwrap();
        let pose_b = |turn: f64| {
            let (c, s) = ((eighth + 0.5 * turn).cos(), (eighth + 0.5 * turn).sin());
            // Turned about y, moved along z.
            Pose::new([0.01, 0.02, 2.0 * reach + between], [c, 0.0, s, 0.0]).unwrap()
        };
        let (settings, mut state) = (Settings::default(), PairState::default());
        let mut look = |turn: f64| detect(&cube, &pose_a, &cube, &pose_b(turn), &settings, Some(&mut state)).unwrap();
        let (first, again, turned) = (look(0.0), look(0.0), look(0.01));
        assert!(first.flags == Flags::REJECTED && [again, turned].iter().all(|c| c.flags.contains(Flags::BY_MEMORY)));
        assert!([first, again].iter().all(|c| (c.distance - between).abs() < 1e-12), "{first:?}, {again:?}");
        // Turned by 0.01 the edge reaches less far along z: √2·d cos 0.01 and r as before.
        let farther = 0.4 * 2f64.sqrt() * (1.0 - 0.01f64.cos());
        assert!((turned.distance - (between + farther)).abs() < 1e-6, "{turned:?}");
        assert_eq!(state.into_raw()[5], 2.0);
    }

    /// Whichever they are, and whatever the numbers.
    #[test]
    fn no_planes_prove_that_overlapping_particles_are_apart() {
        let sharp = |offset: f64, r: f64| Particle::cube(offset, r, 0.0, 0.0);
        let cube = Particle::cube(0.4, 0.1, 0.02, 0.9);
        let particles = [cube, sharp(0.5, 1e-4), sharp(0.5, 1e-9), sharp(0.4, 0.1), Particle::sphere(0.5).unwrap()];
        let (mut overlapping, mut proved) = (0, 0);
        for seed in 0..50_000 {
            let mut chance = scattered(20 * seed);
            let mut vector = || Vector3::from_fn(|_, _| chance());
            let (a, b) = (&particles[seed % 5], &particles[seed / 5 % 5]);
            let (towards, turn, other, x, y) = (vector().normalize(), vector(), vector(), vector(), vector());
            let pose_a = Pose::new([0.0; 3], [0.5, turn.x, turn.y, turn.z]).unwrap();
            let far = [0.9, 1.1, 1.5][seed % 3];
            let pose_b = Pose::new((far * towards).into(), [0.5, other.x, other.y, other.z]).unwrap();
            let contact = detect(a, &pose_a, b, &pose_b, &Settings::default(), None).unwrap();
            let plane = |share: f64| MAX_PLANES * usize::from(share < 0.0) + (7.0 * share.abs()) as usize;
            let places = match seed % 10 {
                0 => [f64::NAN, x.x],
                1 => [f64::INFINITY, -1e300 * x.x],
                _ => [[x.x, x.y], [x.z, y.x]].map(|[p, q]| (plane(p) + SECOND * plane(q)) as f64),
            };
            let proof = still_balanced((a, &pose_a), (b, &pose_b), &(0.5 * y), &places);
            overlapping += u32::from(contact.kind == Kind::Overlapping);
            proved += u32::from(proof.is_some());
            assert!(proof.is_none() || contact.kind == Kind::Separated, "{proof:?} from {places:?}: {contact:?}");
        }
        assert!(overlapping > 10_000 && proved > 10, "{overlapping}, {proved}");
    }
}
