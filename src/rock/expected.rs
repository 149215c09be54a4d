//! How many blocks joints will make, before any of them cuts.

use crate::particle::polyhedron::Polyhedron;
use crate::random::Random;
use crate::rock::domain::Oriented;
use crate::rock::joint::Joint;
use nalgebra::{Matrix3, Vector3};

/// Up to so many pairs or triples are all looked at; of more, so many drawn by chance.
const MOST_DRAWN: usize = 20_000;

/// Standard deviations by which a number found by chance is taken lower.
const DEVIATIONS: f64 = 4.0;

/// The joints that cut a domain, about the origin of its polyhedron, with the planes of the domain.
struct Crossing<'a> {
    outer: &'a [Oriented],
    joints: Vec<&'a Joint>,
}

/// 1 + n + L + P: with n joints that meet the domain, the L lines inside in which two of them cross and the P points in which three do, as planes
/// in general position make. Of many joints L and P are estimated from pairs and triples drawn by chance, and taken as low as chance allows.
/// Joints that end inside are counted in their own extent, so that they make more.
pub(super) fn expected_blocks(domain: &Polyhedron, outer: &[Oriented], joints: &[Joint]) -> f64 {
    let meets = |joint: &&Joint| {
        let heights = domain.corners().map(|at| joint.normal.dot(&(at - joint.point)));
        let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| (low.min(h), high.max(h)));
        low < 0.0 && high > 0.0
    };
    let crossing = Crossing { outer, joints: joints.iter().filter(meets).collect() };
    let count = crossing.joints.len();
    1.0 + count as f64 + of_all::<2>(count, |i| crossing.has_line(i)) + of_all::<3>(count, |i| crossing.has_point(i))
}

/// How many of all choices of N out of `count` are so.
fn of_all<const N: usize>(count: usize, is_so: impl Fn([usize; N]) -> bool) -> f64 {
    let choices = (0..N).map(|i| (count as f64 - i as f64) / (i as f64 + 1.0)).product::<f64>().max(0.0);
    if choices <= MOST_DRAWN as f64 {
        let mut chosen = [0; N];
        return every(&mut chosen, 0, count, &is_so) as f64;
    }
    let mut random = Random::new(0, N as u64);
    let mut hits = 0;
    for _ in 0..MOST_DRAWN {
        let mut chosen = [0; N];
        for i in 0..N {
            chosen[i] = random.below(count);
            while chosen[..i].contains(&chosen[i]) {
                chosen[i] = random.below(count);
            }
        }
        hits += usize::from(is_so(chosen));
    }
    let (drawn, hits) = (MOST_DRAWN as f64, hits as f64);
    choices * (hits - DEVIATIONS * (hits * (1.0 - hits / drawn)).sqrt()).max(0.0) / drawn
}

/// Counts those choices, whose first `done` members are chosen, in which the members rise.
fn every<const N: usize>(
    chosen: &mut [usize; N],
    done: usize,
    count: usize,
    is_so: &impl Fn([usize; N]) -> bool,
) -> usize {
    if done == N {
        return usize::from(is_so(*chosen));
    }
    let first = if done == 0 { 0 } else { chosen[done - 1] + 1 };
    let mut hits = 0;
    for next in first..count {
        chosen[done] = next;
        hits += every(chosen, done + 1, count, is_so);
    }
    hits
}

impl Crossing<'_> {
    /// Whether two joints cross in the domain: on what is left of their common line when domain and extents have cut it.
    fn has_line(&self, [i, j]: [usize; 2]) -> bool {
        let [a, b] = [self.joints[i], self.joints[j]];
        let along = a.normal.cross(&b.normal);
        let square = along.norm_squared();
        if !(square > 0.0) {
            return false;
        }
        let of = |joint: &Joint| joint.normal.dot(&joint.point);
        let from = (of(a) * b.normal - of(b) * a.normal).cross(&along) / square;
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        let mut keep = |n: &Vector3<f64>, height: f64| {
            let (rate, left) = (n.dot(&along), height - n.dot(&from));
            if rate > 0.0 {
                high = high.min(left / rate);
            } else if rate < 0.0 {
                low = low.max(left / rate);
            } else if left < 0.0 {
                high = f64::NEG_INFINITY;
            }
        };
        self.outer.iter().for_each(|(n, height)| keep(n, *height));
        for joint in [a, b] {
            joint.borders().for_each(|(n, height)| keep(&n, height));
        }
        for joint in [a, b].into_iter().filter(|joint| joint.outline.is_none() && joint.radius.is_finite()) {
            let nearest = along.dot(&(joint.point - from)) / square;
            let rest = joint.radius.powi(2) - (joint.point - from - nearest * along).norm_squared();
            let half = (rest.max(0.0) / square).sqrt();
            (low, high) = (low.max(nearest - half), high.min(nearest + half));
        }
        low < high
    }

    /// Whether three joints meet in a point of the domain and of each.
    fn has_point(&self, chosen: [usize; 3]) -> bool {
        let of = chosen.map(|i| self.joints[i]);
        let rows = Matrix3::from_rows(&of.map(|joint| joint.normal.transpose()));
        let heights = Vector3::from(of.map(|joint| joint.normal.dot(&joint.point)));
        let Some(at) = rows.try_inverse().map(|inverse| inverse * heights) else { return false };
        self.outer.iter().all(|(n, height)| n.dot(&at) < *height)
            && of.iter().all(|joint| {
                (at - joint.point).norm() <= joint.radius && joint.borders().all(|(n, height)| n.dot(&at) <= height)
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particle::plane::Plane;
    use crate::rock::domain::{enclosed, unit_planes};
    use crate::rock::settings::SliceSettings;
    use crate::rock::slicing::slice;

    fn cube() -> Vec<Plane> {
        (0..6).map(|i| Plane { normal: Vector3::ith(i / 2, 1.0 - 2.0 * (i % 2) as f64), offset: 1.0 }).collect()
    }

    fn expected(joints: &[Joint]) -> f64 {
        let outer = unit_planes(&cube()).unwrap();
        let (origin, polyhedron) = enclosed(&outer).unwrap();
        assert!(origin.norm() < 1e-12);
        expected_blocks(&polyhedron, &outer, joints)
    }

    fn joints(seed: u64, count: usize, mut make: impl FnMut(Joint, &mut Random) -> Joint) -> Vec<Joint> {
        let mut random = Random::new(seed, 0);
        let one = |_| {
            let point = Vector3::from([0; 3].map(|_| random.between(-0.9, 0.9)));
            let joint = Joint::through(point, random.direction());
            make(joint, &mut random)
        };
        (0..count).map(one).collect()
    }

    #[test]
    fn few_planes_are_counted_and_many_estimated() {
        let made = |joints: &[Joint]| slice(&cube(), joints, &SliceSettings::default()).unwrap().blocks.len() as f64;
        for seed in 0..5 {
            let few = joints(seed, 30, |joint, _| joint);
            assert_eq!(expected(&few), made(&few));
            let many = joints(seed, 100, |joint, _| joint);
            let part = expected(&many) / made(&many);
            assert!((0.85..1.0).contains(&part), "{part}");
        }
    }

    /// They cut all of a block that they reach.
    #[test]
    fn joints_that_end_make_no_fewer() {
        for seed in 0..10 {
            let discs = joints(seed, 40, |joint, random| joint.with_radius(random.between(0.2, 0.9)).unwrap());
            let squares = joints(seed, 40, |joint, random| {
                let across = joint.normal.cross(&random.direction()).normalize();
                let sides = [across, joint.normal.cross(&across)].map(|side| random.between(0.2, 0.7) * side);
                Joint::polygon(
                    &[[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
                        .map(|[s, t]| joint.point + s * sides[0] + t * sides[1]),
                )
                .unwrap()
            });
            for joints in [discs, squares] {
                let made = slice(&cube(), &joints, &SliceSettings::default()).unwrap().blocks.len() as f64;
                let count = expected(&joints);
                assert!(count <= made && count > 0.2 * made, "{count} of {made}");
            }
        }
    }
}
