use super::goal::both;
use super::*;
use crate::particle::particle::{Particle, Plane};
use crate::pose::Pose;
use nalgebra::Vector3;

const TURNED: [f64; 4] = [0.8, 0.3, -0.4, 0.33];

fn cube(half: f64, r: f64, k: f64, shadow: f64) -> Particle {
    let mut planes = Vec::new();
    for axis in 0..3 {
        for sign in [1.0, -1.0] {
            let mut normal = Vector3::zeros();
            normal[axis] = sign;
            planes.push(Plane { normal, offset: half });
        }
    }
    Particle::new(&planes, r, k, shadow).expect("a cube is a particle")
}

fn close(a: f64, b: f64, relative: f64) {
    assert!((a - b).abs() <= relative * b.abs().max(1e-300), "{a:e} is not {b:e} to {relative:e}");
}

fn near(a: &Vector3<f64>, b: &Vector3<f64>, distance: f64) {
    assert!((a - b).norm() <= distance, "{a:?} is not {b:?} to {distance:e}");
}

/// A pose that outlives the pair made of it.
fn at(position: [f64; 3]) -> &'static Pose {
    Box::leak(Box::new(Pose::at(position).unwrap()))
}

#[test]
fn spheres_have_the_closed_form() {
    let (small, large) = (Particle::sphere(0.5).unwrap(), Particle::sphere(2.0).unwrap());
    let direction = Vector3::new(1.0, -2.0, 2.0) / 3.0;
    for distance in [1.0, 2.4, 2.5, 2.6, 40.0] {
        let at = Pose::new((direction * distance).into(), TURNED).unwrap();
        let home = Pose::at([0.0; 3]).unwrap();
        let pair = Pair::new(&small, &at, &large, &home);
        let found = midway(&pair).unwrap();
        let t = distance / 2.5;
        close(found.s, t, 1e-9);
        near(&found.x, &(direction * (2.0 * t)), 1e-6);
        // ∇S = 2x/R² and x = tR on either side: (1−u)/R_A = u/R_B.
        close(found.weight, 2.0 / 2.5, 1e-6);
    }
}

#[test]
fn closest_points_of_spheres_lie_on_the_constrained_one() {
    let (small, large) = (Particle::sphere(0.5).unwrap(), Particle::sphere(2.0).unwrap());
    let pair = Pair::new(&small, at([0.0, 2.3, 0.0]), &large, at([0.0; 3]));
    let p2 = closest(&pair, Role::B).unwrap();
    close(p2.s, 0.3 / 0.5, 1e-8);
    near(&p2.x, &Vector3::new(0.0, 2.0, 0.0), 1e-7);
    let p1 = closest(&pair, Role::A).unwrap();
    close(p1.s, 1.8 / 2.0, 1e-8);
    near(&p1.x, &Vector3::new(0.0, 1.8, 0.0), 1e-7);
}

#[test]
fn a_slack_constraint_gives_the_centre() {
    let (small, large) = (Particle::sphere(0.5).unwrap(), cube(1.0, 0.1, 0.2, 1.5));
    let pair = Pair::new(&small, at([0.4, 0.0, 0.2]), &large, at([0.0; 3]));
    let p2 = closest(&pair, Role::B).unwrap();
    assert!(p2.s <= 1e-10, "s = {:e}", p2.s);
    near(&p2.x, &pair.centre, 1e-9);
    assert!(p2.weight <= 1e-6, "u = {:e}", p2.weight);
}

#[test]
fn concise_programs_for_flat_cubes_and_spheres() {
    // k = 0 on both sides: faces at distance d + r, S = ((x−d)/r)² in front of a face.
    let (a, b) = (cube(0.5, 0.02, 0.0, 1.0), cube(0.7, 0.04, 0.0, 1.0));
    let beside = Pose::at([1.25, 0.1, -0.05]).unwrap();
    let home = Pose::at([0.0; 3]).unwrap();
    let pair = Pair::new(&a, &beside, &b, &home);
    close(midway(&pair).unwrap().s, (1.25 - 1.2) / 0.06, 1e-9);
    close(closest(&pair, Role::B).unwrap().s, (1.25 - 0.5 - 0.74) / 0.02, 1e-8);
    close(closest(&pair, Role::A).unwrap().s, (1.25 - 0.7 - 0.52) / 0.04, 1e-8);

    // A flat face and a pure sphere, face on.
    let ball = Particle::sphere(0.3).unwrap();
    let mixed = Pair::new(&ball, at([1.04, 0.0, 0.0]), &b, &home);
    let found = midway(&mixed).unwrap();
    close(found.s, (1.04 - 0.7) / 0.34, 1e-9);
    near(&found.x, &Vector3::new(1.04 - 0.3, 0.0, 0.0), 1e-6);
}

#[test]
fn near_polyhedral_faces_keep_their_digits() {
    // Two equal cubes face to face, S = (1−k)/r²·(x−d)² + k/R²·x² at half the distance. The gap is
    // a few r; its rounding, ε·size/r, is all that may be lost.
    for r in [1e-4, 1e-6, 1e-8] {
        let (d, k, shadow) = (0.5, r, 0.9);
        let particle = cube(d, r, k, shadow);
        let distance = 2.0 * d + 1.5 * r;
        let pair = Pair::new(&particle, at([0.0, 0.0, distance]), &particle, at([0.0; 3]));
        let x = 0.5 * distance;
        let exact = ((1.0 - k) * ((x - d) / r).powi(2) + k * (x / shadow).powi(2)).sqrt();
        let found = midway(&pair).unwrap();
        close(found.s, exact, 1e-9 + 4.0 * f64::EPSILON / r);
        close(found.weight, 0.5, 1e-4);
    }
}

#[test]
fn no_neighbour_is_better_and_swapping_changes_nothing() {
    let (a, b) = (cube(0.5, 0.05, 0.1, 0.8), cube(0.3, 0.002, 0.01, 0.6));
    let at = Pose::new([0.5, 0.45, 0.35], TURNED).unwrap();
    let home = Pose::new([0.0; 3], [0.2, -0.7, 0.1, 0.4]).unwrap();
    let pair = Pair::new(&a, &at, &b, &home);
    let swapped = Pair::new(&b, &home, &a, &at);

    let found = midway(&pair).unwrap();
    for axis in 0..3 {
        for step in [-1e-1, -1e-3, -1e-5, 1e-5, 1e-3, 1e-1] {
            let mut x = found.x;
            x[axis] += step;
            let [s_a, s_b] = both(&pair, &x);
            assert!(s_a.max(s_b) >= found.s * (1.0 - 1e-9), "better by {:e} at {step:e}", found.s - s_a.max(s_b));
        }
    }
    let other = midway(&swapped).unwrap();
    close(other.s, found.s, 1e-9);
    close(other.weight, 1.0 - found.weight, 1e-4);

    for (role, opposite) in [(Role::A, Role::B), (Role::B, Role::A)] {
        let (one, two) = (closest(&pair, role).unwrap(), closest(&swapped, opposite).unwrap());
        close(one.s, two.s, 1e-8);
        let held = Goal::Constrained(role).held(both(&pair, &one.x));
        assert!(held <= 1.0 + 1e-8, "the constraint is exceeded: s = {held}");
    }
}

#[test]
fn units_do_not_matter() {
    let sizes = [1e-9, 1.0, 1e6];
    let s = sizes.map(|unit| {
        let a = cube(0.5 * unit, 0.02 * unit, 0.05, 0.8 * unit);
        let b = cube(0.2 * unit, 1e-3 * unit, 0.3, 0.4 * unit);
        let turned = Pose::new([0.55 * unit, 0.3 * unit, 0.2 * unit], TURNED).unwrap();
        midway(&Pair::new(&a, &turned, &b, at([0.0; 3]))).unwrap().s
    });
    close(s[0], s[1], 1e-9);
    close(s[2], s[1], 1e-9);
}
