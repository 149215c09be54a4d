//! How many blocks joints will make, before any of them cuts.

use super::numbers::{DEVIATIONS, LEAST_DRAWN, Limits, ONE_PLANE};
use crate::particle::polyhedron::Polyhedron;
use crate::random::Random;
use crate::rock::domain::Oriented;
use crate::rock::joint::Joint;
use nalgebra::{Matrix3, Vector3};
use std::collections::HashSet;

/// The joints that cut a domain, about the origin of its polyhedron, with the planes of the domain.
struct Crossing<'a> {
    outer: &'a [Oriented],
    /// Of the domain.
    size: f64,
    joints: Vec<&'a Joint>,
}

/// 1 + n + L + P: with n joints that meet the domain, the L lines inside in which two of them cross and the P points in
/// which three do, as planes in general position make. A line in which m planes meet counts as m − 1, and a point as
/// ½(m − 1)(m − 2), as Zaslavsky's count of the regions of an arrangement has it.
///
/// Of many joints L and P are estimated from pairs and triples drawn by chance, and taken as low as chance allows. What
/// may be less than it seems is left out: joints in the plane of another one, and those that end and have their middle
/// outside. Joints that end are counted in their own extent, and cut more. So the number is rather too low.
pub(super) fn expected_blocks(domain: &Polyhedron, outer: &[Oriented], joints: &[Joint]) -> f64 {
    let [low, high] = domain.extremes();
    let size = (high - low).norm();
    let meets = |joint: &&Joint| {
        let heights = domain.corners().map(|at| joint.normal.dot(&(at - joint.point)));
        let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| (low.min(h), high.max(h)));
        let is_inside = || outer.iter().all(|(n, height)| n.dot(&joint.point) < *height);
        low < 0.0 && high > 0.0 && (joint.radius == f64::INFINITY || is_inside())
    };
    let mut planes = HashSet::new();
    let mut is_new = |joint: &&Joint| {
        let n = joint.normal * joint.normal[joint.normal.iamax()].signum();
        let numbers = [n.x, n.y, n.z, n.dot(&joint.point) / size];
        planes.insert(numbers.map(|number| (number / ONE_PLANE).round() as i64))
    };
    let crossing =
        Crossing { outer, size, joints: joints.iter().filter(meets).filter(|joint| is_new(joint)).collect() };
    let count = crossing.joints.len();
    1.0 + count as f64 + of_all::<2>(count, |i| crossing.line(i)) + of_all::<3>(count, |i| crossing.point(i))
}

/// The sum of a number over all choices of N out of `count`; the numbers are 0 to 1.
fn of_all<const N: usize>(count: usize, number: impl Fn([usize; N]) -> f64) -> f64 {
    let choices = (0..N).map(|i| (count as f64 - i as f64) / (i as f64 + 1.0)).product::<f64>().max(0.0);
    if choices <= Limits::DRAWN as f64 {
        let mut chosen = [0; N];
        return every(&mut chosen, 0, count, &number);
    }
    let mut random = Random::new(0, N as u64);
    let drawn = (Limits::LOOKS / count).clamp(LEAST_DRAWN, Limits::DRAWN);
    let (mut sum, mut squares) = (0.0, 0.0);
    for _ in 0..drawn {
        let mut chosen = [0; N];
        for i in 0..N {
            chosen[i] = random.below(count);
            while chosen[..i].contains(&chosen[i]) {
                chosen[i] = random.below(count);
            }
        }
        let found = number(chosen);
        (sum, squares) = (sum + found, squares + found * found);
    }
    let deviation = (squares - sum * sum / drawn as f64).max(0.0).sqrt();
    choices * (sum - DEVIATIONS * deviation).max(0.0) / drawn as f64
}

/// The sum over those choices, whose first `done` members are chosen, in which the members rise.
fn every<const N: usize>(
    chosen: &mut [usize; N],
    done: usize,
    count: usize,
    number: &impl Fn([usize; N]) -> f64,
) -> f64 {
    if done == N {
        return number(*chosen);
    }
    let first = if done == 0 { 0 } else { chosen[done - 1] + 1 };
    let mut sum = 0.0;
    for next in first..count {
        chosen[done] = next;
        sum += every(chosen, done + 1, count, number);
    }
    sum
}

impl Crossing<'_> {
    /// Number of planes through all of some points.
    fn through(&self, points: &[Vector3<f64>]) -> f64 {
        let is_on = |joint: &&&Joint| {
            points.iter().all(|at| joint.normal.dot(&(at - joint.point)).abs() <= ONE_PLANE * self.size)
        };
        self.joints.iter().filter(is_on).count() as f64
    }

    /// The share of two joints in the line in which they cross: 2/m of m planes, so that its pairs add up to m − 1; 0
    /// where nothing is left of it when domain and extents have cut it.
    fn line(&self, [i, j]: [usize; 2]) -> f64 {
        let [a, b] = [self.joints[i], self.joints[j]];
        let along = a.normal.cross(&b.normal);
        let square = along.norm_squared();
        if !(square > ONE_PLANE * ONE_PLANE) {
            return 0.0;
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
        if low < high { 2.0 / self.through(&[from + low * along, from + high * along]).max(2.0) } else { 0.0 }
    }

    /// The share of three joints in the point in which they meet: 3/m of m planes; 0 where it is not in the domain and
    /// in each.
    fn point(&self, chosen: [usize; 3]) -> f64 {
        let of = chosen.map(|i| self.joints[i]);
        let rows = Matrix3::from_rows(&of.map(|joint| joint.normal.transpose()));
        let heights = Vector3::from(of.map(|joint| joint.normal.dot(&joint.point)));
        // Planes through one line have a determinant of rounding.
        let inverse = rows.try_inverse().filter(|_| rows.determinant().abs() > ONE_PLANE);
        let Some(at) = inverse.map(|inverse| inverse * heights) else { return 0.0 };
        if self.outer.iter().all(|(n, height)| n.dot(&at) < *height) && of.iter().all(|joint| joint.holds(&at)) {
            3.0 / self.through(&[at]).max(3.0)
        } else {
            0.0
        }
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
            assert!((expected(&few) / made(&few) - 1.0).abs() < 1e-12);
            let many = joints(seed, 100, |joint, _| joint);
            let part = expected(&many) / made(&many);
            assert!((0.85..1.0).contains(&part), "{part}");
        }
    }

    /// Planes through an axis, through a point, a grid with its diagonals, one plane many times, discs beside the
    /// domain.
    #[test]
    fn planes_that_meet_are_not_counted_too_often() {
        let mut random = Random::new(9, 0);
        let axis = random.direction();
        let through_axis: Vec<_> =
            (0..12).map(|_| Joint::through([0.1, 0.0, 0.2], axis.cross(&random.direction()))).collect();
        let through_point: Vec<_> = (0..12).map(|_| Joint::through([0.1, 0.0, 0.2], random.direction())).collect();
        let heights = [-0.75, -0.25, 0.25, 0.75];
        let grid = (0..3)
            .flat_map(|axis| heights.map(|h| Joint::through(h * Vector3::ith(axis, 1.0), Vector3::ith(axis, 1.0))));
        let diagonal = Vector3::new(1.0, 1.0, 1.0);
        let grid: Vec<_> = grid.chain(heights.map(|h| Joint::through([h, 0.0, 0.0], diagonal))).collect();
        let same: Vec<_> =
            (0..12).map(|i| Joint::through([0.0, 0.1, 0.0], Vector3::y() * f64::from(1 - 2 * (i % 2)))).collect();
        let disc = |at: [f64; 3]| Joint::through(at, Vector3::z()).with_radius(0.1).unwrap();
        let bedding: Vec<_> =
            (0..9).map(|i| disc([f64::from(i % 3) - 1.0, f64::from(i / 3) - 1.0, 0.1]).clone()).collect();
        let beside: Vec<_> = (0..9).map(|i| disc([f64::from(i), 2.0, 0.1 * f64::from(i)])).collect();
        for joints in [through_axis, through_point, grid, same, bedding, beside] {
            let joints: Vec<Joint> = joints.into_iter().map(|j| Joint { normal: j.normal.normalize(), ..j }).collect();
            let made = slice(&cube(), &joints, &SliceSettings::default()).unwrap().blocks.len() as f64;
            let count = expected(&joints);
            // Where many planes meet in a point, rounding leaves some blocks whole.
            assert!(count <= 1.1 * made && count >= 0.3 * made, "{count} of {made}");
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
