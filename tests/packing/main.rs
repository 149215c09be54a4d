//! `pack` against closed forms, against the cone programs, and against its own definition.

mod among;
mod rocks;

use nalgebra::Vector3;
use potential_particles::packing::{self, Arrangement, Container, PackError, Packing, Placement, Sizes, Supply};
use potential_particles::{BackEnd, Kind, Particle, Settings, detect};
use rocks::{rock, scattered};

const SETTLED: Packing =
    Packing { arrangement: Arrangement::Settled, number: Some(60), first: 0, trials: 5_000, seed: 1, threads: 2 };
const SCATTERED: Packing = Packing { arrangement: Arrangement::Scattered, ..SETTLED };

/// Among nothing, without a margin.
fn pack(
    container: &Container,
    shapes: &[Particle],
    sizes: &Sizes,
    how: &Packing,
    progress: impl FnMut(&[Placement]) -> bool,
) -> Result<Vec<Placement>, PackError> {
    packing::pack(container, &Supply::new(shapes, sizes, 0.0)?, &[], how, progress)
}

fn box_of(edge: f64, height: f64) -> Container {
    Container::cuboid([0.0; 3], [edge, edge, height]).unwrap()
}

fn rocks() -> Vec<Particle> {
    (1..=6).map(|seed| rock(8 + 2 * seed as usize, seed)).collect()
}

fn scaled(shapes: &[Particle], bodies: &[Placement]) -> Vec<Particle> {
    bodies.iter().map(|body| shapes[body.shape].scaled(body.scale).unwrap()).collect()
}

/// Points of the surface of a body, world frame.
fn surface(particle: &Particle, body: &Placement, seed: u32) -> Vec<Vector3<f64>> {
    let mut chance = scattered(seed);
    let mut direction = || Vector3::from_fn(|_, _| 2.0 * chance() - 1.0).normalize();
    let point = |e: Vector3<f64>| particle.surface_distance(&Vector3::zeros(), &e).unwrap() * e;
    (0..300).map(|_| body.pose.rotate(&point(direction())) + body.pose.position()).collect()
}

/// Every pair whose balls meet, by the paper's cone programs, which share no code with what packed them.
fn assert_no_overlap(shapes: &[Particle], bodies: &[Placement]) {
    let particles = scaled(shapes, bodies);
    let settings = Settings::default().with_back_end(BackEnd::ConeProgram);
    let mut near = 0;
    for (i, a) in bodies.iter().enumerate() {
        for (j, b) in bodies.iter().enumerate().take(i) {
            let reach = particles[i].bounding_radius() + particles[j].bounding_radius();
            if (a.pose.position() - b.pose.position()).norm() < reach {
                near += 1;
                let contact = detect(&particles[i], &a.pose, &particles[j], &b.pose, &settings, None).unwrap();
                assert_eq!(contact.kind, Kind::Separated, "{i} and {j}: {contact:?}");
            }
        }
    }
    assert!(near > bodies.len(), "only {near} pairs are near each other");
}

#[test]
fn rocks_in_a_box_overlap_neither_each_other_nor_the_walls() {
    let (edge, shapes) = (3.0, rocks());
    let sizes = Sizes::by_number(&[[0.5, 0.5], [0.9, 0.5]]).unwrap();
    let bodies = pack(&box_of(edge, 12.0), &shapes, &sizes, &SETTLED, |_| true).unwrap();
    assert_eq!(bodies.len(), 60);
    assert_no_overlap(&shapes, &bodies);
    for (particle, body) in scaled(&shapes, &bodies).iter().zip(&bodies) {
        for point in surface(particle, body, 7) {
            assert!(point.z >= 0.0 && (0..2).all(|axis| (0.0..=edge).contains(&point[axis])), "{point}");
        }
    }
    // The size is the diameter of a ball of the same volume.
    let volumes: Vec<f64> = shapes.iter().map(|shape| shape.mass_properties(1e-6).unwrap().volume).collect();
    for body in &bodies {
        let size = body.scale * (6.0 / std::f64::consts::PI * volumes[body.shape]).cbrt();
        assert!((size - 0.5).abs() < 1e-6 || (size - 0.9).abs() < 1e-6, "{size}");
    }
}

#[test]
fn rocks_in_a_cylinder_stay_within_its_wall() {
    let (radius, height, shapes) = (1.6, 3.0, rocks());
    let container = Container::cylinder([1.0, -2.0, 0.5], radius, height).unwrap();
    for how in [SETTLED, Packing { number: Some(15), ..SCATTERED }] {
        let sizes = Sizes::by_number(&[[0.8, 1.0]]).unwrap();
        let bodies = pack(&container, &shapes, &sizes, &how, |_| true).unwrap();
        assert!(bodies.len() >= 15, "{}", bodies.len());
        for (particle, body) in scaled(&shapes, &bodies).iter().zip(&bodies) {
            for point in surface(particle, body, 3) {
                assert!((point.x - 1.0).hypot(point.y + 2.0) <= radius && (0.5..=0.5 + height).contains(&point.z));
            }
        }
    }
}

#[test]
fn balls_keep_the_margin() {
    let shapes = [Particle::sphere(0.5).unwrap()];
    let sizes = Sizes::by_number(&[[0.6, 0.5], [1.0, 0.5]]).unwrap();
    for (margin, how) in [(0.0, SETTLED), (0.05, SETTLED), (0.1, SCATTERED)] {
        let supply = Supply::new(&shapes, &sizes, margin).unwrap();
        let bodies = packing::pack(&box_of(4.0, 8.0), &supply, &[], &how, |_| true).unwrap();
        assert_eq!(bodies.len(), 60);
        let mut least = f64::INFINITY;
        for (i, a) in bodies.iter().enumerate() {
            assert!(a.pose.position().z - 0.5 * a.scale >= 0.5 * margin * 0.999_999);
            for b in &bodies[..i] {
                let gap = (a.pose.position() - b.pose.position()).norm() - 0.5 * (a.scale + b.scale);
                least = least.min(gap - margin);
            }
        }
        // No closer, and settled bodies come about as close.
        assert!(least > 0.0 && (how.arrangement == Arrangement::Scattered || least < 0.01), "{least}");
    }
}

#[test]
fn the_same_seed_gives_the_same_packing_with_any_number_of_threads() {
    let (container, shapes) = (box_of(9.0, 6.0), rocks());
    let sizes = Sizes::passing(&[[0.5, 0.0], [1.0, 1.0]]).unwrap();
    for how in [SETTLED, Packing { number: Some(200), ..SCATTERED }] {
        let by =
            |threads, seed| pack(&container, &shapes, &sizes, &Packing { threads, seed, ..how }, |_| true).unwrap();
        let one = by(1, 5);
        assert_eq!(Some(one.len()), how.number);
        for threads in [2, 7] {
            assert_eq!(by(threads, 5), one, "{threads} threads");
        }
        assert_ne!(by(2, 6), one);
    }
}

#[test]
fn bodies_follow_the_grading_curve() {
    let shapes = [Particle::sphere(0.5).unwrap()];
    let sizes = Sizes::passing(&[[0.5, 0.0], [1.0, 0.3], [1.5, 1.0]]).unwrap();
    let count = 2000;
    let how = Packing { number: Some(count), ..SCATTERED };
    let bodies = pack(&box_of(30.0, 30.0), &shapes, &sizes, &how, |_| true).unwrap();
    assert_eq!(bodies.len(), count);
    let total: f64 = bodies.iter().map(|body| body.scale.powi(3)).sum();
    for (size, passing) in [(0.75, 0.15), (1.0, 0.3), (1.25, 0.65), (1.5, 1.0)] {
        let below: f64 = bodies.iter().filter(|body| body.scale <= size).map(|body| body.scale.powi(3)).sum();
        // One of the largest bodies more or less is 1.5³ of that total.
        assert!((below / total - passing).abs() < 4.0 * 1.5f64.powi(3) / total, "{size}: {}", below / total);
    }
}

#[test]
fn a_packing_that_is_stopped_keeps_what_it_has() {
    let (container, shapes, sizes) = (box_of(4.0, 8.0), rocks(), Sizes::as_given());
    let all = pack(&container, &shapes, &sizes, &SETTLED, |_| true).unwrap();
    let mut calls = 0;
    let some = pack(&container, &shapes, &sizes, &SETTLED, |placed| {
        calls += 1;
        placed.len() < 20
    });
    let some = some.unwrap();
    assert!(calls > 1 && (20..60).contains(&some.len()), "{}", some.len());
    assert_eq!(some, all[..some.len()]);
    assert!(some.iter().all(|body| body.scale == 1.0));
    assert_eq!(pack(&container, &shapes, &sizes, &SETTLED, |_| false).unwrap().len(), 1);
}

#[test]
fn as_many_balls_as_fit_make_a_loose_packing() {
    let shapes = [Particle::sphere(0.5).unwrap()];
    let (edge, sizes) = (6.0, Sizes::as_given());
    let container = box_of(edge, edge);
    let settled = pack(&container, &shapes, &sizes, &Packing { number: None, ..SETTLED }, |_| true).unwrap();
    let fraction = |bodies: &[Placement]| bodies.len() as f64 * std::f64::consts::PI / 6.0 / container.volume();
    // Walls cost some of the 0.55 to 0.64 of loose and dense random packings.
    assert!((0.45..0.6).contains(&fraction(&settled)), "{}", fraction(&settled));
    // More are asked for than random sequential addition can place (0.38), and fewer come back.
    let scattered = pack(&container, &shapes, &sizes, &Packing { number: Some(300), ..SCATTERED }, |_| true).unwrap();
    assert!((0.25..0.385).contains(&fraction(&scattered)), "{}", fraction(&scattered));
}

#[test]
fn what_cannot_be_packed_is_refused_with_a_sentence() {
    let (shapes, sizes) = (rocks(), Sizes::as_given());
    let fault = |container: &Container, shapes: &[Particle], how: &Packing| {
        pack(container, shapes, &sizes, how, |_| true).unwrap_err().to_string()
    };
    let container = box_of(4.0, 4.0);
    assert!(fault(&container, &[], &SETTLED).contains("no shape"));
    let margin = |margin| Supply::new(&shapes, &sizes, margin).unwrap_err().to_string();
    assert!(margin(-1.0).contains("margin=-1.0") && margin(f64::NAN).contains("margin=NaN"));
    assert!(fault(&container, &shapes, &Packing { trials: 0, ..SCATTERED }).contains("trials=0 must be 1 or more"));
    let prism = |corners: &[[f64; 2]]| Container::prism(corners, 0.0, 1.0).unwrap_err().to_string();
    assert!(prism(&[[0.0, 0.0], [1.0, 0.0]]).contains("a prism of 2 corners has no volume"));
    assert!(prism(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]).contains("no volume"));
    for how in [SETTLED, SCATTERED] {
        assert!(
            fault(&box_of(0.2, 4.0), &shapes, &how).contains("no body fits: the container is [0.2, 0.2, 4.0] wide")
        );
    }
    assert!(Container::cuboid([0.0; 3], [1.0, 0.0, 1.0]).unwrap_err().to_string().contains("no volume"));
    assert!(Container::cuboid([0.0, 0.0, f64::NAN], [1.0; 3]).unwrap_err().to_string().contains("NaN"));
    assert!(Container::cylinder([0.0; 3], -1.0, 2.0).unwrap_err().to_string().contains("radius -1.0"));
    let many = Packing { number: Some(10_000_001), ..SCATTERED };
    assert!(fault(&box_of(400.0, 400.0), &shapes, &many).contains("10000001 bodies are more than the 10000000"));
    let none = Packing { number: Some(0), ..SETTLED };
    assert_eq!(pack(&container, &shapes, &sizes, &none, |_| true).unwrap(), []);
    // Sizes in which the weights of S leave the range of numbers.
    let tiny = Sizes::by_number(&[[1e-180, 1.0]]).unwrap();
    let error = pack(&container, &shapes, &tiny, &SETTLED, |_| true).unwrap_err().to_string();
    assert!(error.contains("shape 0, scaled by"), "{error}");
}
