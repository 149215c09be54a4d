//! Walks over all that can be written down: every contact that is carried on against 30 digits.

use kit::random::Random;
use kit::stress::shapes::{self, Hull, Recipe, Sphericity};
use nalgebra::Vector3;
use potential_particles::{Contact, Flags, Kind, PairState, Particle, Pose, Settings, detect};

/// Answers of the extended tier.
fn exactly() -> Settings {
    Settings::default().with_gap_tolerance(1e-14).with_solve_separated(true)
}

#[derive(Default, Debug)]
pub struct Tally {
    pub contacts: u64,
    pub carried: u64,
    /// Pairs that do not touch and were carried on.
    pub apart: u64,
    /// Contacts that ended while they were followed.
    pub ended: u64,
    /// And those that began.
    pub begun: u64,
    pub faults: Vec<String>,
    /// Largest errors of s and of the point, over their bounds.
    pub most: [f64; 2],
}

fn particle(random: &mut Random) -> Particle {
    let hull = [Hull::Any, Hull::Few, Hull::Some, Hull::Many][random.whole(0, 4)];
    // Most as blunt as in use: others are seldom carried on.
    let blunt = random.uniform() < 0.8;
    let (rounding, sphericity) = if blunt {
        ((-3.0, 0.0), Sphericity::Between(-2.5, 0.0))
    } else {
        ((-9.0, 0.0), Sphericity::Between(-9.0, 0.0))
    };
    // Many with flat faces, where the regularisation is left off.
    let sphericity = if random.uniform() < 0.3 { Sphericity::Flat } else { sphericity };
    let size = if random.uniform() < 0.5 { (0.0, 0.0) } else { (-2.0, 2.0) };
    shapes::particle(&Recipe { hull, rounding, sphericity, size }, random)
}

/// B touching A, at an overlap that is drawn.
fn touching(a: &Particle, pose_a: &Pose, b: &Particle, random: &mut Random) -> Pose {
    let towards = random.direction();
    let turned = random.pose(Vector3::zeros()).orientation();
    let at = |distance: f64| Pose::new((pose_a.position() + distance * towards).into(), turned).unwrap();
    let settings = Settings::default().with_solve_separated(true);
    let deep = random.uniform() < 0.1;
    let s_wanted = if deep { random.uniform() } else { 1.0 - random.log_uniform(1e-7, 0.1) };
    let (mut near, mut far) = (0.0, a.bounding_radius() + b.bounding_radius());
    for _ in 0..50 {
        let middle = 0.5 * (near + far);
        let s = detect(a, pose_a, b, &at(middle), &settings, None).unwrap().s;
        if s < s_wanted { near = middle } else { far = middle }
    }
    at(near)
}

pub fn walk(random: &mut Random, tally: &mut Tally) {
    let (a, b) = (particle(random), particle(random));
    let small = a.bounding_radius().min(b.bounding_radius());
    let far = [0.0, 1.0, 1e3, 1e6][random.whole(0, 4)];
    let at = far * random.direction();
    let pose_a = random.pose(at);
    let mut poses = [pose_a, touching(&a, &pose_a, &b, random)];
    let steps = if random.uniform() < 0.2 { (1e-12, 0.3) } else { (1e-9, 1e-3) };
    let step = small * random.log_uniform(steps.0, steps.1);
    let turn = random.log_uniform(steps.0, steps.1);
    // Some drift, so that their contact ends, or deepens.
    let away = (poses[1].position() - poses[0].position()).try_normalize(0.0).unwrap_or_else(Vector3::x);
    let drift = if random.uniform() < 0.5 { step * (2.0 * random.uniform() - 1.0) * away } else { Vector3::zeros() };
    let tolerance = if random.uniform() < 0.5 { 1e-9 } else { random.log_uniform(1e-14, 1e-1) };
    let settings = Settings::default().with_carry_tolerance(tolerance);
    let (mut state, mut touched) = (PairState::default(), false);
    for i in 0..60 {
        let [at_a, at_b] = &poses;
        let contact = detect(&a, at_a, &b, at_b, &settings, Some(&mut state)).unwrap();
        if contact.kind == Kind::Overlapping {
            tally.contacts += 1;
        }
        tally.ended += u64::from(touched && contact.kind == Kind::Separated);
        // A contact begins by a solve.
        let begins = contact.kind == Kind::Overlapping && !touched && i > 0;
        tally.begun += u64::from(begins);
        if begins && contact.flags.contains(Flags::CARRIED) {
            tally.faults.push(format!("carried into a contact: {contact:?}"));
        }
        touched = contact.kind == Kind::Overlapping;
        if contact.flags.contains(Flags::CARRIED) {
            *if touched { &mut tally.carried } else { &mut tally.apart } += 1;
            let exact = detect(&a, at_a, &b, at_b, &exactly(), None).unwrap();
            let centres = (at_a.position() - at_b.position()).norm();
            let length = centres + a.bounding_radius() + b.bounding_radius();
            let known = contact.point_bound <= tolerance * small || !touched;
            let fault = match touched {
                true => fault(&contact, &exact, length, &mut tally.most),
                false => apart(&contact, &exact, |moved| detect(&a, at_a, &b, &moved(at_b), &exactly(), None).unwrap()),
            };
            if let Some(fault) = fault.or((!known).then(|| format!("point_bound {:e}", contact.point_bound))) {
                let shapes =
                    [&a, &b].map(|p| (p.rounding_radius(), p.sphericity(), p.bounding_radius(), p.planes().len()));
                tally.faults.push(format!(
                    "{fault}; step {i} of {step:e}, tolerance {tolerance:e}, s {}, gap {:e}, {shapes:?}",
                    contact.s, contact.gap
                ));
            }
        }
        // Large steps now and then.
        let size = if random.uniform() < 0.05 { 100.0 } else { 1.0 };
        poses = poses.map(|pose| random.moved(&pose, size * step, size * turn));
        poses[1] = Pose::new((poses[1].position() + drift).into(), poses[1].orientation()).unwrap();
    }
}

/// Of a pair that is carried on apart: its s is a lower bound, and as near as they are said to be at least, they do not
/// meet.
fn apart(carried: &Contact, exact: &Contact, look: impl Fn(&dyn Fn(&Pose) -> Pose) -> Contact) -> Option<String> {
    let nearer = look(&|at_b| {
        let position = at_b.position() - carried.distance * (1.0 - 1e-9) * exact.normal;
        Pose::new(position.into(), at_b.orientation()).unwrap()
    });
    let told = carried.flags.contains(Flags::REJECTED) && carried.s >= 1.0 && carried.distance >= 0.0;
    let right = told && carried.s <= exact.s + exact.gap && nearer.s + nearer.gap >= 1.0;
    (!right).then(|| format!("apart, but exact {}, nearer {}: {carried:?}", exact.s, nearer.s))
}

fn fault(carried: &Contact, exact: &Contact, length: f64, most: &mut [f64; 2]) -> Option<String> {
    let (off, bound) = ((carried.s - exact.s).abs(), carried.gap + exact.gap);
    most[0] = most[0].max(off / bound);
    if !(off <= bound) {
        return Some(format!("s is off by {off:e}, bound {bound:e}"));
    }
    if exact.kind != Kind::Overlapping && exact.s - exact.gap > 1.0 {
        return Some("no contact".into());
    }
    let rounding = 8.0 * f64::EPSILON * length;
    let (off, bound) = ((carried.branch_b - exact.branch_b).norm(), carried.point_bound + exact.point_bound + rounding);
    most[1] = most[1].max(off / bound);
    if !(off <= bound) {
        return Some(format!(
            "the point is off by {off:e}, bound {bound:e}, that of the exact one {:e}",
            exact.point_bound
        ));
    }
    if !(carried.overlap >= 0.0) {
        return Some(format!("overlap {:e}", carried.overlap));
    }
    None
}
