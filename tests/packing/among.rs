//! Packings among what is there, in regions of any outline, in parts, and until they are full.

use crate::{SCATTERED, SETTLED, assert_no_overlap, box_of, rocks, surface};
use nalgebra::Vector3;
use potential_particles::packing::{
    Arrangement, Container, Obstacle, Packing, Placement, Sizes, Supply, are_free, pack,
};
use potential_particles::{Particle, Pose, Triangle, Wall};

const IN_SEQUENCE: Packing = Packing { arrangement: Arrangement::InSequence, ..SETTLED };

fn at(position: [f64; 3]) -> Pose {
    Pose::new(position, [1.0, 0.0, 0.0, 0.0]).unwrap()
}

/// Distance of a point from a triangle, by its closest point (Ericson 2004).
fn distance(p: &Vector3<f64>, [a, b, c]: [Vector3<f64>; 3]) -> f64 {
    let on_edge = |u: Vector3<f64>, v: Vector3<f64>| {
        let along = ((p - u).dot(&(v - u)) / (v - u).norm_squared()).clamp(0.0, 1.0);
        (p - u - along * (v - u)).norm()
    };
    let normal = (b - a).cross(&(c - a)).normalize();
    let foot = p - normal.dot(&(p - a)) * normal;
    let inside = [(a, b), (b, c), (c, a)].iter().all(|(u, v)| (v - u).cross(&(foot - u)).dot(&normal) >= 0.0);
    if inside { (p - foot).norm() } else { on_edge(a, b).min(on_edge(b, c)).min(on_edge(c, a)) }
}

#[test]
fn balls_keep_off_balls_triangles_and_planes() {
    let edge = 5.0;
    let corners = [Vector3::new(0.5, 0.5, 1.0), Vector3::new(4.5, 1.0, 2.5), Vector3::new(2.0, 4.5, 3.5)];
    let obstacles = [
        Obstacle::Body(Particle::sphere(1.2).unwrap(), at([2.5, 2.5, 4.2])),
        Obstacle::Triangle(Triangle::new(corners.map(Into::into)).unwrap()),
        Obstacle::Plane(Wall::new([2.4, 0.0, 0.0], [1.0, 0.0, 0.0]).unwrap()),
        Obstacle::HalfSpace(Wall::new([0.0, 4.0, 0.0], [0.0, -2.0, 0.0]).unwrap()),
    ];
    let supply = Supply::new(&[Particle::sphere(0.3).unwrap()], &Sizes::as_given(), 0.0).unwrap();
    for how in [Packing { number: None, ..SCATTERED }, SETTLED, Packing { number: None, trials: 500, ..IN_SEQUENCE }] {
        let bodies = pack(&box_of(edge, edge), &supply, &obstacles, &how, |_| true).unwrap();
        assert!(bodies.len() > 30, "{} by {how:?}", bodies.len());
        let mut sides = [0; 2];
        for (i, body) in bodies.iter().enumerate() {
            let centre = body.pose.position();
            assert!((centre - Vector3::new(2.5, 2.5, 4.2)).norm() >= 1.5);
            assert!(distance(centre, corners) >= 0.3, "{centre}");
            assert!((centre.x - 2.4).abs() >= 0.3 && centre.y <= 3.7, "{centre}");
            assert!(bodies[..i].iter().all(|other| (centre - other.pose.position()).norm() >= 0.6));
            sides[usize::from(centre.x > 2.4)] += 1;
        }
        assert!(sides.iter().all(|&count| count > 5), "both sides of a plane are free: {sides:?}");
    }
}

/// A square funnel of triangles, its outlet closed: what is laid into it stays within.
#[test]
fn settled_bodies_do_not_leave_a_hopper_through_its_triangles() {
    let (mouth, outlet, height) = (2.0, 0.3, 2.0);
    let ring = |half: f64, z: f64| [[-half, -half, z], [half, -half, z], [half, half, z], [-half, half, z]];
    let (low, high) = (ring(outlet, 0.0), ring(mouth, height));
    let mut triangles = vec![[low[0], low[1], low[2]], [low[0], low[2], low[3]]];
    for i in 0..4 {
        let j = (i + 1) % 4;
        triangles.extend([[low[i], low[j], high[j]], [low[i], high[j], high[i]]]);
    }
    let obstacles: Vec<_> = triangles.iter().map(|one| Obstacle::Triangle(Triangle::new(*one).unwrap())).collect();
    let container = Container::cuboid([-mouth, -mouth, -1.0], [mouth, mouth, 4.0]).unwrap();
    let shapes = rocks();
    let supply = Supply::new(&shapes, &Sizes::by_number(&[[0.4, 1.0]]).unwrap(), 0.0).unwrap();
    let bodies = pack(&container, &supply, &obstacles, &Packing { number: Some(80), ..SETTLED }, |_| true).unwrap();
    assert_eq!(bodies.len(), 80);
    assert_no_overlap(&shapes, &bodies);
    let mut lowest = f64::INFINITY;
    for body in &bodies {
        for point in surface(&shapes[body.shape].scaled(body.scale).unwrap(), body, 5) {
            lowest = lowest.min(point.z);
            let half = outlet + (mouth - outlet) * (point.z / height).min(1.0);
            assert!(point.z > 0.0 && point.x.abs() < half && point.y.abs() < half, "{point}");
        }
    }
    assert!(lowest < 0.3, "they reach the outlet: {lowest}");
}

#[test]
fn bodies_stay_within_prisms_and_regions_of_points() {
    let shapes = rocks();
    let supply = Supply::new(&shapes, &Sizes::by_number(&[[0.5, 1.0]]).unwrap(), 0.0).unwrap();
    // An L, whose inner corner (1.2, 1.2) no box of a body shows.
    let corners = [[0.0, 0.0], [4.0, 0.0], [4.0, 1.2], [1.2, 1.2], [1.2, 4.0], [0.0, 4.0]];
    let prism = Container::prism(&corners, 1.0, 3.0).unwrap();
    assert!((prism.volume() - 2.0 * (4.0 * 1.2 + 1.2 * 2.8)).abs() < 1e-12);
    let ball = Container::of_points([-2.0; 3], [2.0; 3], |p| p.iter().map(|x| x * x).sum::<f64>() <= 4.0).unwrap();
    let in_prism = |p: &Vector3<f64>| {
        (1.0..=3.0).contains(&p.z) && p.x >= 0.0 && p.y >= 0.0 && p.x.max(p.y) <= 4.0 && p.x.min(p.y) <= 1.2
    };
    let in_ball = |p: &Vector3<f64>| p.norm() <= 2.0;
    type Holds<'a> = &'a dyn Fn(&Vector3<f64>) -> bool;
    let regions: [(&Container, Holds<'_>); 2] = [(&prism, &in_prism), (&ball, &in_ball)];
    for (region, holds) in regions {
        for how in [Packing { number: None, trials: 2_000, ..SCATTERED }, Packing { number: Some(25), ..SETTLED }] {
            let bodies = pack(region, &supply, &[], &how, |_| true).unwrap();
            assert!(bodies.len() >= 25, "{}", bodies.len());
            for body in &bodies {
                let points = surface(&shapes[body.shape].scaled(body.scale).unwrap(), body, 9);
                assert!(points.iter().all(holds), "{body:?}");
            }
        }
    }
}

/// In parts, each among what the former parts have placed, the sequence of bodies goes on.
#[test]
fn a_sequence_goes_on_where_it_ended() {
    let (container, shapes) = (box_of(4.0, 4.0), rocks());
    let supply = Supply::new(&shapes, &Sizes::passing(&[[0.4, 0.0], [0.9, 1.0]]).unwrap(), 0.0).unwrap();
    let (mut bodies, mut obstacles) = (Vec::<Placement>::new(), Vec::new());
    for number in [Some(7), Some(0), Some(20), None, None] {
        let how = Packing { number, first: bodies.len() as u64, trials: 300, ..IN_SEQUENCE };
        let new = pack(&container, &supply, &obstacles, &how, |_| true).unwrap();
        assert!(number.is_none_or(|number| new.len() == number), "{}", new.len());
        let particle = |body: &Placement| shapes[body.shape].scaled(body.scale).unwrap();
        obstacles.extend(new.iter().map(|body| Obstacle::Body(particle(body), body.pose)));
        bodies.extend(new);
        // The body that has found no place is the next one, and finds none again.
        assert!(bodies.len() > 40 || number.is_some());
    }
    assert_no_overlap(&shapes, &bodies);
    let expected: Vec<_> = supply.sequence(SETTLED.seed, 0).take(bodies.len()).collect();
    assert_eq!(bodies.iter().map(|body| (body.shape, body.scale)).collect::<Vec<_>>(), expected);
    assert!(supply.sequence(SETTLED.seed, 5).take(9).eq(expected[5..14].iter().copied()));
}

#[test]
fn overlaps_with_obstacles_are_found() {
    let ball = Particle::sphere(0.5).unwrap();
    let obstacles = [
        Obstacle::Body(ball.clone(), at([0.0; 3])),
        Obstacle::HalfSpace(Wall::new([0.0; 3], [0.0, 0.0, 1.0]).unwrap()),
    ];
    let bodies =
        [[1.001, 0.0, 0.0], [0.999, 0.0, 0.6], [1.2, 0.0, 0.6], [3.0, 0.0, -2.0]].map(|p| (ball.clone(), at(p)));
    assert_eq!(are_free(&bodies, &obstacles), [false, true, true, false]);
    assert_eq!(are_free(&[], &obstacles), [false; 0]);
}

/// Saturated random sequential addition of regular tetrahedra fills 0.356 (Kubala 2019). With few trials it is less,
/// and the more the more trials there are.
#[test]
fn tetrahedra_near_saturation_from_below() {
    let third = 1.0 / 3.0_f64.sqrt();
    let planes = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    let (r, inner) = (1e-4, third);
    let faces = planes.map(|n| potential_particles::Plane { normal: third * Vector3::from(n), offset: inner - r });
    let tetrahedron = Particle::new(&faces, r, 0.0, 3.0).unwrap();
    let volume = tetrahedron.mass_properties(1e-6).unwrap().volume;
    // Of the cube with edge 2 it takes a third.
    assert!((volume / (8.0 / 3.0) - 1.0).abs() < 1e-3, "{volume}");
    let supply = Supply::new(&[tetrahedron], &Sizes::as_given(), 0.0).unwrap();
    let (edge, skin) = (16.0, 3.0);
    let filled = |trials| {
        let how = Packing { number: None, trials, seed: 11, ..SCATTERED };
        let bodies = pack(&box_of(edge, edge), &supply, &[], &how, |_| true).unwrap();
        let inside = |body: &&Placement| body.pose.position().iter().all(|x| (skin..edge - skin).contains(x));
        bodies.iter().filter(inside).count() as f64 * volume / (edge - 2.0 * skin).powi(3)
    };
    let (few, many) = (filled(30), filled(1_000));
    assert!((0.15..0.22).contains(&few) && (few + 0.03..0.29).contains(&many), "{few}, {many}");
}
