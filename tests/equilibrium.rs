//! Equilibrium of scenes against closed forms.

use kit::masonry::{arch, block, level, pushed, random_slope, slope, v, wall, wedge};
use potential_particles::Plane;
use potential_particles::equilibrium::*;
use potential_particles::nalgebra::Vector3;
use potential_particles::rock::{Joint, JointSet, SliceSettings, slice};

const BOTH: [Flow; 2] = [Flow::Associated, Flow::NonDilatant];

fn close(a: f64, b: f64, relative: f64) {
    assert!((a - b).abs() <= relative * b.abs(), "{a} is not {b} to {relative:e}");
}

/// Slides at tan φ = tan θ if it is not tall.
#[test]
fn block_on_a_slope() {
    let angle = 20.0_f64.to_radians();
    for (friction, expected) in [(angle.tan() * (1.0 + 1e-4), true), (angle.tan() * (1.0 - 1e-4), false)] {
        let found = stands(&block(0.5, angle, friction), Flow::NonDilatant).unwrap();
        assert_eq!(found.stands, expected);
        assert!(found.forces.len() == if expected { 4 } else { 0 } && found.mechanism.is_empty() == expected);
    }
    for flow in BOTH {
        let found = strength_factor(&block(0.5, angle, 0.5), flow).unwrap();
        close(found.factor, 0.5 / angle.tan(), 1e-6);
        // Without dilatancy it moves along the slope.
        let motion = found.mechanism[1];
        let rise = if flow == Flow::Associated { angle.tan() } else { 0.0 };
        assert!((motion.linear.z / motion.linear.x - rise).abs() < 1e-4 && motion.angular.norm() < 1e-4, "{motion:?}");
    }
}

/// A block of width 1 slides under a share μ of its weight, or turns over under 1 / height.
#[test]
fn block_under_a_side_load() {
    for flow in BOTH {
        for (height, friction) in [(0.5, 0.5), (1.9, 0.5), (2.1, 0.5), (3.0, 0.7), (8.0, 0.3)] {
            let found = load_factor(&pushed(block(height, 0.0, friction)), flow).unwrap();
            close(found.factor, f64::min(friction, 1.0 / height), 1e-6);
        }
    }
}

/// c a + μ W, and a tall one that tension holds at its edge.
#[test]
fn cohesion_and_tension() {
    let mut flat = pushed(block(0.2, 0.0, 0.5));
    (flat.contacts[0].cohesion, flat.contacts[0].tension) = (0.7, 10.0);
    BOTH.into_iter().for_each(|flow| close(load_factor(&flat, flow).unwrap().factor, 1.2, 1e-6));
    // In whatever order its corners come.
    let joint = &flat.contacts[0];
    let crossed = [0, 2, 1, 3].map(|i| joint.corners[i]).to_vec();
    assert!((Contact::new([0, 1], crossed, joint.normal, 0.5).area / joint.area - 1.0).abs() < 1e-14);
    // |t| ≤ (c a + μ W)/F.
    flat.bodies[1].dead.force.x = 0.3;
    BOTH.into_iter().for_each(|flow| close(strength_factor(&flat, flow).unwrap().factor, 1.2 / 0.3, 1e-6));
    // Moments about the far edge: λ h/2 = 1/2 + T, T at the two corners of the near edge.
    let mut tall = pushed(block(4.0, 0.0, 5.0));
    (tall.contacts[0].cohesion, tall.contacts[0].tension) = (10.0, 0.6);
    BOTH.into_iter().for_each(|flow| close(load_factor(&tall, flow).unwrap().factor, (0.5 + 0.3) / 2.0, 1e-6));
}

/// Of all forces those of the least norm: a ceiling that may pull takes half of the weight, whatever its strength.
#[test]
fn least_norm_with_tension() {
    for (friction, cohesion) in [(0.5, 10.0), (0.5, 40.0), (0.0, 0.0)] {
        let mut scene = block(1.0, 0.0, friction);
        let ceiling = level([-0.5, -0.5], [0.5, 0.5], 1.0);
        scene.contacts.push(Contact::new([0, 1], ceiling, -Vector3::z(), friction));
        for contact in &mut scene.contacts {
            (contact.tension, contact.cohesion) = (50.0, cohesion);
        }
        let found = stands(&scene, Flow::Associated).unwrap();
        let of_floor: Vector3<f64> = found.forces[..4].iter().sum();
        assert!((of_floor - v(0.0, 0.0, 0.5)).norm() < 1e-6, "{friction} {cohesion}: {of_floor}");
        assert!(found.forces.iter().all(|force| (force - v(0.0, 0.0, 0.125)).norm() < 1e-6));
    }
}

/// The upper one on another joint: the weaker joint decides, with what lies above it.
#[test]
fn two_blocks_stacked() {
    let angle = 10.0_f64.to_radians();
    for (lower, upper) in [(0.3, 0.5), (0.5, 0.3)] {
        let mut scene = block(0.3, angle, lower);
        let weight = scene.bodies[1].dead.force;
        scene.bodies.push(Body::free(v(0.0, 0.0, 0.45), 0.4 * weight));
        scene.contacts.push(Contact::new([1, 2], level([-0.5, -0.5], [0.5, 0.5], 0.3), Vector3::z(), upper));
        BOTH.into_iter().for_each(|flow| close(strength_factor(&scene, flow).unwrap().factor, 0.3 / angle.tan(), 1e-6));
    }
}

/// n blocks of length 1 reach beyond the edge by half the sum of 1/i.
#[test]
fn overhang() {
    for count in [1, 4, 12] {
        for (share, expected) in [(1.0 - 1e-5, true), (1.0 + 1e-5, false)] {
            // The table ends at x = 0; from the top the centre of the i uppermost lies on the edge of what carries
            // them.
            let mut bodies = vec![Body::held(v(-1.0, 0.0, -1.0))];
            let mut contacts = Vec::new();
            let (mut left, mut edge) = (f64::NAN, 0.0);
            for i in 0..count {
                let right: f64 = edge + share * 0.5 / f64::from(count - i);
                let from = if i == 0 { right - 1.0 } else { f64::max(left, right - 1.0) };
                bodies.push(Body::free(v(right - 0.5, 0.5, f64::from(i) + 0.5), v(0.0, 0.0, -1.0)));
                let polygon = level([from, 0.0], [edge, 1.0], f64::from(i));
                contacts.push(Contact::new([i as usize, i as usize + 1], polygon, Vector3::z(), 0.5));
                (left, edge) = (right - 1.0, right);
            }
            let scene = Scene { bodies, contacts };
            for flow in BOTH {
                assert_eq!(stands(&scene, flow).unwrap().stands, expected, "{count} blocks at {share}, {flow:?}");
            }
        }
    }
}

/// Milankovitch's least thickness of a semicircular arch, whose weight acts where it is: t/R = 0.10748. Hinges of
/// voussoirs lie at their joints only, so that of few
/// a little less would do; of 200 it is the same to 1e-4.
#[test]
fn least_thickness_of_an_arch() {
    let (mut falls, mut stands_at) = (0.09, 0.12);
    while stands_at - falls > 1e-6 {
        let middle = 0.5 * (falls + stands_at);
        if stands(&arch(middle, 200), Flow::Associated).unwrap().stands { stands_at = middle } else { falls = middle }
    }
    assert!((stands_at - 0.107478).abs() < 1e-4, "{stands_at}");
}

/// Without dilatancy it is Hoek & Bray's factor; with it, the planes clamp what slides between them.
#[test]
fn wedges_without_dilatancy() {
    for (planes, face) in [
        ([[45.0, 105.0], [70.0, 235.0]], [65.0, 185.0]),
        ([[50.0, 130.0], [50.0, 230.0]], [70.0, 180.0]),
        ([[65.0, 120.0], [40.0, 200.0]], [75.0, 170.0]),
        ([[60.0, 110.0], [60.0, 250.0]], [80.0, 180.0]),
        ([[55.0, 150.0], [55.0, 260.0]], [75.0, 200.0]),
    ] {
        let (scene, expected) = wedge(planes, face, 0.6);
        let [associated, without] = BOTH.map(|flow| strength_factor(&scene, flow).unwrap());
        let angle = |factor: f64| (0.6 / factor).atan().to_degrees();
        let difference = angle(without.factor) - angle(expected);
        assert!(difference.abs() < 1e-4, "{difference} degrees at {planes:?}");
        assert!(associated.factor > without.factor * 1.01, "{} {}", associated.factor, without.factor);
    }
}

/// All forces balance all loads and respect their strength; the mechanism does the work of the limit.
#[test]
fn wall_pushed_sideways() {
    let scene = pushed(wall(6, 6, 0.6));
    let [associated, without] = BOTH.map(|flow| load_factor(&scene, flow).unwrap());
    assert!(without.factor <= associated.factor * (1.0 + 1e-6) && without.factor > 0.8 * associated.factor);
    for found in [&associated, &without] {
        let loads = |b: &Body| (b.dead.force + found.factor * b.live.force, Vector3::zeros());
        let mut left: Vec<_> = scene.bodies.iter().map(loads).collect();
        let mut forces = found.forces.iter();
        for contact in &scene.contacts {
            let normal = contact.normal.normalize();
            for at in &contact.corners {
                let force = forces.next().unwrap();
                let n = force.dot(&normal);
                assert!(n > -1e-6 && (force - n * normal).norm() < contact.friction * n + 1e-4, "{force:?}");
                for (body, sign) in contact.bodies.iter().zip([-1.0, 1.0]) {
                    left[*body].0 += sign * force;
                    left[*body].1 += sign * (at - scene.bodies[*body].centre).cross(force);
                }
            }
        }
        let free = left.iter().zip(&scene.bodies).filter(|(_, body)| !body.held);
        free.for_each(|((force, torque), _)| assert!(force.norm() < 1e-6 && torque.norm() < 1e-6, "{force} {torque}"));
        let power = |load: fn(&Body) -> Load| -> f64 {
            scene.bodies.iter().zip(&found.mechanism).map(|(body, v)| load(body).force.dot(&v.linear)).sum()
        };
        assert!(power(|body| body.live) > 0.0);
    }
}

/// Another unit of length and of force, far from the origin: the same factor.
#[test]
fn units_do_not_matter() {
    let scene = pushed(wall(4, 4, 0.5));
    let expected = load_factor(&scene, Flow::Associated).unwrap().factor;
    for (length, force, shift) in [(1e-6, 1e9, 0.0), (1e4, 1e-5, 0.0), (1.0, 1.0, 1e4)] {
        let mut other = scene.clone();
        for body in &mut other.bodies {
            body.centre = body.centre * length + Vector3::repeat(shift);
            body.dead.force *= force;
            body.live.force *= force;
        }
        other
            .contacts
            .iter_mut()
            .flat_map(|c| &mut c.corners)
            .for_each(|at| *at = *at * length + Vector3::repeat(shift));
        close(load_factor(&other, Flow::Associated).unwrap().factor, expected, 1e-7);
    }
}

#[test]
fn what_is_no_scene_is_refused_by_name() {
    let good = block(0.5, 0.1, 0.5);
    let refused = |change: fn(&mut Scene)| {
        let mut scene = good.clone();
        change(&mut scene);
        stands(&scene, Flow::NonDilatant).unwrap_err().to_string()
    };
    for (said, change) in [
        ("no body is held", (|s| s.bodies[0].held = false) as fn(&mut Scene)),
        ("no body is free", |s| s.bodies[1].held = true),
        ("body 2 is free and has no contact", |s| s.bodies.push(s.bodies[1])),
        ("no free body is loaded", |s| s.bodies[1].dead = Load::NONE),
        ("friction of contact 0 is -1", |s| s.contacts[0].friction = -1.0),
        ("length of the normal of contact 0 is 0", |s| s.contacts[0].normal = Vector3::zeros()),
        ("centre of body 1 is NaN", |s| s.bodies[1].centre.x = f64::NAN),
        ("contact 0 joins bodies 0 and 7", |s| s.contacts[0].bodies[1] = 7),
        ("lean of the polygon from its normal of contact 0 is 0.7", |s| s.contacts[0].normal = v(1.0, 0.0, 0.0)),
        ("contact 0 has no corner", |s| s.contacts[0].corners.clear()),
    ] {
        let error = refused(change);
        assert!(error.contains(said), "{error}");
    }
    assert_eq!(load_factor(&good, Flow::Associated), Err(EquilibriumError::NoLiveLoad));
    let mut pressed = good.clone();
    pressed.bodies[1].live = Load::force(v(0.0, 0.0, -1.0));
    BOTH.into_iter().for_each(|flow| assert_eq!(load_factor(&pressed, flow), Err(EquilibriumError::Unlimited)));
    let level = block(0.5, 0.0, 0.5);
    BOTH.into_iter()
        .for_each(|flow| assert_eq!(strength_factor(&level, flow), Err(EquilibriumError::StandsWithoutStrength)));
    // A tall one falls whatever its friction.
    let tall = block(9.0, 0.3, 0.5);
    BOTH.into_iter().for_each(|flow| assert!(!strength_factor(&tall, flow).unwrap().stands));
}

/// A column cut from a slope by a plane that dips out of it: its sliding on that plane, from `slice` to the factor.
#[test]
fn rock_mass_on_one_joint() {
    let side = |i: usize| Plane { normal: Vector3::ith(i / 2, [1.0, -1.0][i % 2]), offset: 1.0 };
    let domain: Vec<_> = (0..6).map(side).collect();
    let bedding = Joint::new([0.0; 3], 25.0, 90.0).unwrap();
    let upright = Joint::new([0.0; 3], 90.0, 0.0).unwrap();
    let mass = slice(&domain, &[bedding, upright], &SliceSettings::default()).unwrap();
    let below = |block: usize| mass.blocks[block].centroid.z < 0.0;
    let strength = JointStrength { friction: 0.8, ..JointStrength::default() };
    let scene = Scene::of_rock(&mass, v(0.0, 0.0, -26e3), below, |_| strength);
    assert!(scene.bodies.len() == 4 && scene.contacts.len() == 4);
    for flow in BOTH {
        close(strength_factor(&scene, flow).unwrap().factor, 0.8 / 25.0_f64.to_radians().tan(), 1e-6);
    }
}

/// A slope of three sets: where the associated mechanism slides on bedding alone, dilatancy changes nothing, and no
/// normal force is lost on the way.
#[test]
fn slope_of_three_sets() {
    let side = |i: usize| Plane { normal: Vector3::ith(i / 2, [1.0, -1.0][i % 2]), offset: 6.0 };
    let face = 65.0_f64.to_radians();
    let normal = v(face.sin(), 0.0, face.cos());
    let mut domain: Vec<Plane> = (0..6).map(side).collect();
    domain.push(Plane { normal, offset: normal.dot(&v(2.0, 0.0, 6.0)) });
    let sets = [(28.0, 90.0, 3.0), (85.0, 265.0, 4.0), (88.0, 355.0, 4.5)];
    let joints = sets.map(|(dip, to, spacing)| JointSet::new(dip, to, spacing).joints([0.0; 3], 9.0).unwrap()).concat();
    let mass = slice(&domain, &joints, &SliceSettings { least_volume: 0.5, ..SliceSettings::default() }).unwrap();
    let held = |i: usize| mass.blocks[i].corners.iter().any(|at| at.z < -5.99 || at.x < -5.99);
    for degrees in [35.0_f64, 34.9920201985587, 31.0, 41.0] {
        let friction = degrees.to_radians().tan();
        let strength = JointStrength { friction, ..JointStrength::default() };
        let scene = Scene::of_rock(&mass, v(0.0, 0.0, -26e3), held, |_| strength);
        for flow in BOTH {
            close(strength_factor(&scene, flow).unwrap().factor, friction / 28.0_f64.to_radians().tan(), 1e-6);
        }
        assert_eq!(stands(&scene, Flow::NonDilatant).unwrap().stands, degrees > 28.0);
    }
}

/// Clamped blocks, steps that go round in circles, programs that clarabel does not solve: forces at the factor are in
/// equilibrium and within the strength, and those without dilatancy are no stronger than the bound.
#[test]
fn slopes_of_random_sets() {
    let set = |dip, to, spacing, fisher, seed| JointSet { fisher, seed, ..JointSet::new(dip, to, spacing) };
    let without = f64::INFINITY;
    let mut scenes: Vec<Scene> = [2.588168416085326, 1.9069787937289078]
        .map(|spacing| {
            let first = set(30.68570700381114, 357.3725093684094, spacing, 300.0, 957320);
            let second = set(35.58012238211697, 84.96986296517329, spacing, without, 326426);
            slope(
                72.45111640073449,
                &[first, second, set(36.01982276012768, 99.40599649616884, spacing, 300.0, 890180)],
            )
        })
        .into();
    scenes.push(slope(
        68.58013812082496,
        &[
            set(61.10425149867071, 323.4461434434458, 2.2321884630668727, without, 790573),
            set(28.38949824727841, 133.95174756442597, 2.2321884630668727, 300.0, 907153),
            set(41.341682100194774, 145.71800157474905, 2.2321884630668727, 300.0, 899105),
        ],
    ));
    scenes.extend((1..=12).map(|seed| random_slope(seed, 60.0)));
    let mut answered = 0;
    for scene in scenes {
        let factors = BOTH.map(|flow| match strength_factor(&scene, flow) {
            Err(EquilibriumError::NoFreeBody | EquilibriumError::StandsWithoutStrength) => f64::INFINITY,
            found => {
                let found = found.expect("a factor");
                let free = scene.bodies.iter().filter(|body| !body.held);
                let mean = free.clone().map(|body| body.dead.force.norm()).sum::<f64>() / free.count() as f64;
                let mut forces = found.forces.iter();
                for contact in &scene.contacts {
                    let normal = contact.normal.normalize();
                    for force in forces.by_ref().take(contact.corners.len()) {
                        let n = force.dot(&normal);
                        let beyond = (force - n * normal).norm() - contact.friction / found.factor * n;
                        // A factor at which forces clamp is known to a part of it, and with it their strength.
                        let rounding = 1e-4 * mean + 1e-6 * n;
                        assert!(n >= -1e-6 * mean && beyond <= rounding, "{n} {beyond} {mean}");
                    }
                }
                answered += 1;
                found.factor
            }
        });
        assert!(factors[1] <= factors[0] * (1.0 + 1e-3), "{factors:?}");
    }
    assert!(answered > 12, "{answered}");
}
