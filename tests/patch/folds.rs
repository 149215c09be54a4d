//! Deep overlaps of round bodies, where the patch turns back under itself: closed forms of spheres, the gradient of an
//! energy that is summed over the volume, and walks through the onset.

use crate::patch;
use kit::patch::bodies::{Chance, FAMILIES, Pair, contact, cuboid, difference};
use nalgebra::{Matrix3, Vector3};
use potential_particles::{
    Particle, Patch, PatchFlags, PatchPoint, PatchScratch, PatchSettings, Pose, patch_of_contact,
};
use std::f64::consts::TAU;

fn spheres(radii: [f64; 2], distance: f64) -> Pair {
    let [a, b] = radii.map(|radius| Particle::sphere(radius).unwrap());
    let direction = Vector3::new(0.48, -0.6, 0.64);
    let pose_a = Pose::from_rotation([0.1, 0.2, 0.3], &Matrix3::identity()).unwrap();
    let position = pose_a.position() + distance * direction;
    let pose_b = Pose::from_rotation(position.into(), &Matrix3::identity()).unwrap();
    let contact = contact(&a, &pose_a, &b, &pose_b);
    Pair { a, b, pose_a, pose_b, contact }
}

/// Force and area of two spheres of unlike radii, A the larger one: of the sphere of Apollonius the part with |x| <
/// R_A, x from the centre of A. And the cosine at which it ends, seen from its centre: the patch turns back where that
/// is above 0.
fn apollonius([of_a, of_b]: [f64; 2], distance: f64) -> (f64, f64, f64) {
    let square = (of_a / of_b).powi(2);
    let (centre, radius) = (square * distance / (square - 1.0), square.sqrt() * distance / (square - 1.0));
    let (p, q) = (centre * centre + radius * radius, 2.0 * centre * radius);
    let end = ((of_a * of_a - p) / q).min(1.0);
    // ∫ (1 − √(p + q u)/R_A) (−u) du.
    let of_root = |u: f64| {
        let v = p + q * u;
        (0.4 * v.powf(2.5) - 2.0 / 3.0 * p * v.powf(1.5)) / (q * q)
    };
    let sum = 0.5 * (1.0 - end * end) + (of_root(end) - of_root(-1.0)) / of_a;
    ((of_a + of_b) * TAU * radius * radius * sum, TAU * radius * radius * (end + 1.0), end)
}

#[test]
fn spheres_of_unlike_radii_at_any_overlap() {
    let mut turned = 0;
    for small in [0.2, 0.5, 0.8, 0.95] {
        for distance in [1.7, 1.2, 0.9, 0.6, 0.3, 0.15, 0.05] {
            if distance >= 1.0 + small {
                continue;
            }
            let (force, area, end) = apollonius([1.0, small], distance);
            turned += u32::from(end > 0.0);
            for tolerance in [1e-4, 1e-8] {
                let pair = spheres([1.0, small], distance);
                let found = patch(&pair, tolerance, true);
                let what = format!("radius {small}, distance {distance}, tolerance {tolerance}, end {end}: {found:?}");
                assert!(end.abs() < 0.05 || found.flags.contains(PatchFlags::FOLDED) == (end > 0.0), "{what}");
                assert!((found.force.norm() / force - 1.0).abs() < 2.0 * tolerance, "force {force}, {what}");
                assert!((found.area / area - 1.0).abs() < 3.0 * tolerance.max(1e-6), "area {area}, {what}");
                assert!(
                    found.force.cross(&(pair.pose_b.position() - pair.pose_a.position())).norm()
                        < 2.0 * tolerance * force,
                    "{what}"
                );
                let about_centre = found.torque + pair.contact.branch_a.cross(&found.force);
                assert!(about_centre.norm() < 2.0 * tolerance * force, "{what}");
            }
        }
    }
    assert!(turned > 4, "{turned}");
    // Through both onsets: where the patch turns back, and where it closes around the smaller body.
    for i in 0..=100 {
        let distance = 0.9 - 0.005 * f64::from(i);
        let (force, area, end) = apollonius([1.0, 0.5], distance);
        let found = patch(&spheres([1.0, 0.5], distance), 1e-6, false);
        let off = [found.force.norm() / force - 1.0, found.area / area - 1.0];
        assert!(off[0].abs() < 2e-6 && off[1].abs() < 1e-5, "distance {distance}, end {end}: {off:?}");
        if i % 10 == 5 {
            let slope = difference(|h| apollonius([1.0, 0.5], distance + h).0, 1e-3);
            let Pair { a, pose_a, b, pose_b, contact } = spheres([1.0, 0.5], distance);
            let settings = PatchSettings { tolerance: 1e-6, with_stiffness: true, ..PatchSettings::default() };
            let found =
                patch_of_contact(&a, &pose_a, &b, &pose_b, &contact, &settings, &mut PatchScratch::new(), |_| ());
            let along = (pose_b.position() - pose_a.position()) / distance;
            let stiffness = along.dot(&(found.unwrap().stiffness.fixed_view::<3, 3>(0, 0) * along));
            assert!((stiffness + slope).abs() < 1e-4 * force, "distance {distance}: {stiffness} {slope}");
        }
    }
}

/// The part of the area whose normal is turned away from that of the contact.
fn beyond_the_fold(pair: &Pair) -> f64 {
    let Pair { a, pose_a, b, pose_b, contact } = pair;
    let (mut beyond, mut whole) = (0.0, 0.0);
    let visit = |point: PatchPoint| {
        assert!(point.area > 0.0, "{point:?}");
        whole += point.area;
        beyond += if point.normal.dot(&contact.normal) < 0.0 { point.area } else { 0.0 };
    };
    let settings = PatchSettings { tolerance: 1e-6, ..PatchSettings::default() };
    patch_of_contact(a, pose_a, b, pose_b, contact, &settings, &mut PatchScratch::new(), visit).unwrap();
    beyond / whole
}

/// W/K = ℓ ∫ min(1 − s_A, 1 − s_B) dV by lines along an axis in a square of them about a point: Gauss's rule between
/// the places where either body begins or ends and where the other decides.
fn by_volume(pair: &Pair, centre: &Vector3<f64>, axis: &Vector3<f64>, reach: f64, lines: usize) -> f64 {
    const RULE: [(f64, f64); 3] =
        [(0.112_701_665_379_258_3, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];
    const PARTS: usize = 24;
    let first = axis.cross(&Vector3::ith(axis.iamin(), 1.0)).normalize();
    let (second, step) = (axis.cross(&first), 2.0 * reach / lines as f64);
    let scale = |squared: f64| (1.0 + squared).max(0.0).sqrt();
    let mut sum = 0.0;
    for i in 0..lines * lines {
        let [p, q] = [i / lines, i % lines].map(|n| -reach + (n as f64 + 0.5) * step);
        let foot = centre + p * first + q * second;
        let both = |z: f64| {
            let x = foot + z * axis;
            (scale(pair.a.potential(&pair.pose_a.to_local(&x))), scale(pair.b.potential(&pair.pose_b.to_local(&x))))
        };
        let larger = |z: f64| both(z).0.max(both(z).1);
        // The least of a convex function, and where it is 1 on both sides.
        let (mut low, mut high) = (-reach, reach);
        while high - low > 1e-4 * reach {
            let [one, two] = [low + 0.382 * (high - low), high - 0.382 * (high - low)];
            if larger(one) < larger(two) { high = two } else { low = one }
        }
        let least = 0.5 * (low + high);
        if larger(least) >= 1.0 {
            continue;
        }
        let zero = |of: &dyn Fn(f64) -> f64, mut from: f64, mut to: f64| {
            let sign = of(from).signum();
            for _ in 0..40 {
                let middle = 0.5 * (from + to);
                if of(middle).signum() == sign { from = middle } else { to = middle }
            }
            0.5 * (from + to)
        };
        let ends = [-reach, reach].map(|end| zero(&|z| larger(z) - 1.0, least, end));
        let part = (ends[1] - ends[0]) / PARTS as f64;
        let apart = |z: f64| both(z).0 - both(z).1;
        for n in 0..PARTS {
            let (from, to) = (ends[0] + n as f64 * part, ends[0] + (n + 1) as f64 * part);
            let middle = if apart(from) * apart(to) < 0.0 { zero(&apart, from, to) } else { to };
            for (from, to) in [(from, middle), (middle, to)] {
                sum += RULE.iter().map(|(t, w)| w * (to - from) * (1.0 - larger(from + t * (to - from)))).sum::<f64>();
            }
        }
    }
    (pair.a.depth_length() + pair.b.depth_length()) * step * step * sum
}

#[test]
fn the_force_is_the_gradient_of_an_energy_summed_over_the_volume() {
    let mut chance = Chance::new(33);
    let (mut count, mut missing) = (0, 0);
    while count < 8 {
        let families = [chance.pick(&FAMILIES), chance.pick(&FAMILIES)];
        let k = [0, 1].map(|_| chance.pick(&[0.0, 0.02, 0.3]));
        let (r, depth) = (chance.pick(&[0.3, 0.9]), chance.pick(&[0.3, 0.9]));
        let pair = Pair::random(families, k, r, depth, &mut chance);
        let beyond = beyond_the_fold(&pair);
        if !(beyond >= 0.02) {
            continue;
        }
        let here = patch(&pair, 1e-6, true);
        assert!(here.flags.contains(PatchFlags::FOLDED), "{here:?}");
        let (centre, axis) = (pair.contact.point, pair.contact.normal);
        let reach = 1.2 * (here.area.sqrt() + pair.contact.overlap);
        let energy =
            |shift: Vector3<f64>, turn: Vector3<f64>| by_volume(&pair.moved(&shift, &turn), &centre, &axis, reach, 80);
        let force = here.force.norm();
        let along = (here.force / force + 0.7 * chance.direction()).normalize();
        let (about, arm) = (chance.direction(), pair.contact.branch_b.norm().max(0.1));
        let h = 0.05 * pair.contact.overlap;
        let by_shift = -difference(|h| energy(h * along, Vector3::zeros()), h);
        let by_turn = -difference(|h| energy(Vector3::zeros(), h * about), h / arm);
        let torque = here.torque + pair.contact.branch_b.cross(&here.force);
        let whole = energy(Vector3::zeros(), Vector3::zeros());
        let what = format!("{families:?}, k {k:?}, r {r}, depth {depth}, {beyond} beyond the fold");
        // The volume is summed over 80 lines across: its differences are known to a hundredth.
        if (here.energy / whole - 1.0).abs() > 1e-3 {
            missing += 1;
            continue;
        }
        let off = [by_shift - here.force.dot(&along), (by_turn - torque.dot(&about)) / arm].map(|off| off / force);
        assert!(off.iter().all(|off| off.abs() < 1.5e-2), "{what}: force, torque off by {off:?}");
        count += 1;
    }
    // A part that no ray reaches.
    assert!(missing < 12, "{missing}");
}

/// A small rounded cube that sinks into a ball until the patch has turned back: the energy grows by what the force
/// does, through the onset, too.
#[test]
fn nothing_jumps_where_a_patch_begins_to_turn_back() {
    let small = cuboid([0.2; 3], 0.15, 0.3);
    let (ball, still) = (Particle::sphere(0.5).unwrap(), Matrix3::identity());
    let direction = Vector3::new(0.1, 0.2, 1.0).normalize();
    let start = Pair::at_overlap(ball, &still, small, &still, &direction, 0.02);
    let at = |t: f64| start.moved(&(-0.35 * t * direction), &Vector3::zeros());
    let beyond = [0.0, 1.0].map(|t| beyond_the_fold(&at(t)));
    assert!(beyond[0] == 0.0 && beyond[1] > 0.01, "{beyond:?}");
    let steps = 100;
    let found: Vec<Patch> = (0..=steps).map(|i| patch(&at(f64::from(i) / f64::from(steps)), 1e-6, true)).collect();
    for (i, three) in found.windows(3).step_by(2).enumerate() {
        // Simpson's rule.
        let push = |n: usize| 0.35 / f64::from(steps) * three[n].force.dot(&direction);
        let work = (push(0) + 4.0 * push(1) + push(2)) / 3.0;
        let gain = three[2].energy - three[0].energy;
        assert!((work / gain - 1.0).abs() < 1e-3, "step {i}: {work} {gain}");
    }
}
