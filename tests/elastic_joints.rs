//! Factors without dilatancy: published walls, closed forms, and what may not change them.

use kit::masonry::{block, ferris_tin_loi, level, pushed, random_slope, v, wall};
use potential_particles::equilibrium::*;
use potential_particles::nalgebra::{Matrix3, Rotation3, Vector3};

fn factor(scene: &Scene) -> f64 {
    load_factor(scene, Flow::NonDilatant).expect("a factor").factor
}

fn close(a: f64, b: f64, relative: f64) {
    assert!((a - b).abs() <= relative * b.abs(), "{a} is not {b} to {relative:e}");
}

/// Factors of Ferris & Tin-Loi (2001) without dilatancy; the associated ones are larger by up to an eighth.
#[test]
fn published_walls() {
    for (number, published) in [(1, 0.640), (2, 0.563), (3, 0.3558)] {
        let scene = ferris_tin_loi(number);
        let found = load_factor(&scene, Flow::NonDilatant).unwrap();
        close(found.factor, published, 3e-3);
        assert!(found.factor <= found.bound && found.bound < 1.15 * published, "{found:?}");
        assert!(found.unbalanced < 1e-5 && found.excess < 1e-12, "{} {}", found.unbalanced, found.excess);
    }
}

/// Five stones in a row between two held walls, above nothing.
fn lintel(friction: f64, thrust: f64) -> Scene {
    let mut bodies = vec![Body::held(v(-1.0, 0.5, 0.5)), Body::held(v(6.0, 0.5, 0.5))];
    bodies.extend((0..5).map(|i| Body::free(v(f64::from(i) + 0.5, 0.5, 0.5), v(0.0, 0.0, -1.0))));
    let joint = |i: usize| {
        let x = i as f64;
        let corners = vec![v(x, 0.0, 0.0), v(x, 1.0, 0.0), v(x, 1.0, 1.0), v(x, 0.0, 1.0)];
        let ends = [if i == 0 { 0 } else { i + 1 }, if i == 5 { 1 } else { i + 2 }];
        Contact { initial: thrust * Vector3::x(), ..Contact::new(ends, corners, Vector3::x(), friction) }
    };
    Scene { bodies, contacts: (0..6).map(joint).collect() }
}

/// Nothing presses it to begin with: it falls. A thrust H holds it by friction at both ends, 2 μ H over its weight,
/// unless it turns.
#[test]
fn a_lintel_stands_by_its_thrust() {
    assert!(!stands(&lintel(0.6, 0.0), Flow::NonDilatant).unwrap().stands);
    for (friction, thrust) in [(0.6, 9.0), (0.3, 20.0)] {
        let found = strength_factor(&lintel(friction, thrust), Flow::NonDilatant).unwrap();
        // As it sags stones turn a little and press more.
        let by_thrust = 2.0 * friction * thrust / 5.0;
        assert!((0.999..1.02).contains(&(found.factor / by_thrust)), "{} {by_thrust}", found.factor);
    }
}

/// Stress in situ presses a joint by its part along the normal.
#[test]
fn stress_in_situ() {
    let mut scene = lintel(0.6, 0.0);
    scene.press(|at| Matrix3::from_diagonal(&v(9.0, at.z, 7.0)));
    assert_eq!(scene, lintel(0.6, 9.0));
}

/// A support that settles by δ: the initial stress −k δ at its contact. Of three points in a row the middle one
/// settles: the outer ones bear (W + k a δ)/3.
#[test]
fn a_support_settles() {
    let point = |i: usize| {
        let corners = vec![v(i as f64, 0.0, 0.0), v(i as f64, 1.0, 0.0)];
        let initial = if i == 1 { v(0.0, 0.0, -0.25) } else { Vector3::zeros() };
        Contact { area: 1.0, initial, ..Contact::new([0, 1], corners, Vector3::z(), 0.5) }
    };
    let bodies = vec![Body::held(v(0.0, 0.0, -1.0)), Body::free(v(1.0, 0.5, 0.5), v(0.0, 0.0, -1.0))];
    let found = stands(&Scene { bodies, contacts: (0..3).map(point).collect() }, Flow::NonDilatant).unwrap();
    for (of, expected) in found.contacts.iter().zip([1.25 / 3.0, 0.5 / 3.0, 1.25 / 3.0]) {
        close(of.normal, expected, 1e-6);
    }
}

/// Live loads that are there once are dead ones.
#[test]
fn strength_under_a_push() {
    let scene = pushed(block(0.5, 0.0, 0.5));
    close(strength_factor(&scene.under(0.2), Flow::NonDilatant).unwrap().factor, 2.5, 1e-6);
}

/// Corners on the edges of a polygon or within it bear nothing, and move nothing.
#[test]
fn corners_that_are_none() {
    let scene = pushed(wall(3, 3, 0.6));
    let mut other = scene.clone();
    for contact in &mut other.contacts {
        let (a, b, c) = (contact.corners[0], contact.corners[1], contact.corners[2]);
        contact.corners.insert(1, 0.7 * a + 0.3 * b);
        contact.corners.insert(3, 0.5 * a + 0.2 * b + 0.3 * c);
    }
    let [found, with] = [scene, other].map(|scene| load_factor(&scene, Flow::NonDilatant).unwrap());
    close(with.factor, found.factor, 1e-9);
    close(with.bound, found.bound, 1e-6);
    assert!(with.forces[1].norm() == 0.0 && with.forces[3].norm() == 0.0);
}

/// Numbers of bodies and contacts, their sides, place, turn and units, and corners that stand twice.
#[test]
fn the_same_scene_said_otherwise() {
    let scenes = [pushed(wall(4, 4, 0.6)), random_slope(22, 60.0), random_slope(30, 60.0), random_slope(107, 60.0)];
    for (i, scene) in scenes.iter().enumerate() {
        let ask = |scene: &Scene| match i {
            0 => factor(scene),
            _ => strength_factor(scene, Flow::NonDilatant).expect("a factor").factor,
        };
        let expected = ask(scene);
        let last = scene.bodies.len() - 1;
        let mut other = scene.clone();
        other.bodies.reverse();
        for contact in &mut other.contacts {
            let [first, second] = contact.bodies;
            (contact.bodies, contact.normal) = ([last - second, last - first], -contact.normal);
            contact.corners.insert(0, contact.corners[0]);
        }
        other.contacts.reverse();
        close(ask(&other), expected, 1e-6);
        let turn = Rotation3::new(v(0.3, 0.7, 0.2));
        for (length, force, shift) in [(1.0, 1.0, 1e4), (1e-6, 1e6, 0.0), (1e6, 1e-6, 0.0)] {
            let mut other = scene.clone();
            let place = |at: Vector3<f64>| turn * at * length + Vector3::repeat(shift);
            for body in &mut other.bodies {
                body.centre = place(body.centre);
                for load in [&mut body.dead, &mut body.live] {
                    *load = Load { force: force * (turn * load.force), torque: force * length * (turn * load.torque) };
                }
            }
            for contact in &mut other.contacts {
                contact.corners.iter_mut().for_each(|at| *at = place(*at));
                (contact.normal, contact.area) = (turn * contact.normal, contact.area * length * length);
            }
            close(ask(&other), expected, 1e-5);
        }
    }
}

/// A face cut in two, and corners on its edges, with cohesion that holds a part of it.
#[test]
fn polygons_may_be_split() {
    let mut scene = pushed(block(0.8, 0.0, 0.5));
    (scene.contacts[0].cohesion, scene.contacts[0].tension) = (0.3, 0.2);
    let expected = factor(&scene);
    let whole = scene.contacts.remove(0);
    let part = |low: f64, high: f64| {
        let corners = level([low, -0.5], [high, 0.5], 0.0);
        Contact { cohesion: 0.3, tension: 0.2, ..Contact::new([0, 1], corners, Vector3::z(), 0.5) }
    };
    scene.contacts = vec![part(-0.5, 0.1), part(0.1, 0.5)];
    close(factor(&scene), expected, 1e-4);
    let corners = whole.corners.iter().zip(whole.corners.iter().cycle().skip(1));
    let corners = corners.flat_map(|(a, b)| [*a, (a + b) / 2.0]).collect();
    scene.contacts = vec![Contact { corners, ..whole }];
    close(factor(&scene), expected, 1e-4);
}

/// Twisted about its normal a square of side a resists by 0.3826 μ N a; the rule of its points is 4 % below.
#[test]
fn torsion_of_a_square() {
    let mut scene = block(0.5, 0.0, 0.4);
    scene.bodies[1].live.torque = Vector3::z();
    let found = factor(&scene) / 0.4;
    assert!((0.96 * 0.3826 - 1e-3..0.3826).contains(&found), "{found}");
}

/// A small stone on a large one, both pushed: each slides at μ, whatever its size and weight. And live loads of any
/// size beside the dead ones.
#[test]
fn ratios_of_size_weight_and_load() {
    for (side, weight) in [(1e-2, 1e-6), (1e-3, 1e-9), (1.0, 1e-8)] {
        let mut scene = block(0.5, 0.0, 0.7);
        let half = 0.5 * side;
        scene.bodies.push(Body::free(v(0.0, 0.0, 0.5 + 0.2 * half), v(0.0, 0.0, -weight)));
        scene.contacts.push(Contact::new([1, 2], level([-half; 2], [half; 2], 0.5), Vector3::z(), 0.5));
        close(factor(&pushed(scene)), 0.5, 1e-5);
    }
    for ratio in [1e-12, 1e9] {
        let mut scene = pushed(block(0.5, 0.0, 0.5));
        scene.bodies[1].live.force *= ratio;
        close(factor(&scene) * ratio, 0.5, 1e-5);
    }
    // A stone that falls beside a block of any weight.
    let mut scene = block(0.5, 0.0, 0.5);
    scene.bodies[1].dead.force *= 1e10;
    let angle = 0.7_f64;
    scene.bodies.push(Body::free(v(5.0, 0.0, 0.25), v(angle.sin(), 0.0, -angle.cos())));
    scene.contacts.push(Contact::new([0, 2], level([4.5, -0.5], [5.5, 0.5], 0.0), Vector3::z(), 0.5));
    assert!(!stands(&scene, Flow::NonDilatant).unwrap().stands);
}

/// A column that hangs by tension, which ends at the apex c/μ of the cone of friction: at 1.05 times that it falls.
#[test]
fn tension_ends_at_the_apex() {
    for (tension, limit) in [(5.0, 2.0), (1.5, 1.5)] {
        for (share, expected) in [(0.95, true), (1.05, false), (15.0, false)] {
            let mut scene = block(1.0, 0.0, 0.5);
            scene.bodies[1].dead.force.z = share * limit;
            (scene.contacts[0].cohesion, scene.contacts[0].tension) = (1.0, tension);
            for flow in [Flow::Associated, Flow::NonDilatant] {
                assert_eq!(stands(&scene, flow).unwrap().stands, expected, "{tension} {share} {flow:?}");
            }
        }
    }
}

/// The ratio of stiffnesses hardly moves a factor, and not that of a block.
#[test]
fn stiffness_moves_little() {
    let with = |mut scene: Scene, ratio: f64| {
        scene.contacts.iter_mut().for_each(|contact| contact.stiffness = [1.0, ratio]);
        factor(&scene)
    };
    for ratio in [0.2, 5.0] {
        close(with(pushed(block(3.0, 0.0, 0.5)), ratio), 1.0 / 3.0, 1e-6);
        close(with(ferris_tin_loi(3), ratio), 0.3558, 2e-3);
    }
}

/// What no number can be made of names it.
#[test]
fn values_that_are_refused() {
    let said = |change: fn(&mut Scene)| {
        let mut scene = pushed(block(0.5, 0.0, 0.5));
        change(&mut scene);
        stands(&scene, Flow::NonDilatant).unwrap_err().to_string()
    };
    assert!(said(|scene| scene.bodies[1].dead.force.z = -1e160).contains("dead force of body 1"));
    assert!(said(|scene| scene.bodies[1].dead.torque.x = 1e200).contains("dead torque of body 1"));
    assert!(said(|scene| scene.contacts[0].friction = 1e9).contains("friction of contact 0 is 1000000000"));
    assert!(said(|scene| scene.contacts[0].stiffness[1] = 0.0).contains("shear stiffness of contact 0 is 0"));
}
