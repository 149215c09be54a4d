//! Scenes whose limits are known, for the tests and the benchmark of `equilibrium`.

use potential_particles::equilibrium::{Body, Contact, Load, Scene};
use potential_particles::nalgebra::{Matrix3, Vector3};

pub fn v(x: f64, y: f64, z: f64) -> Vector3<f64> {
    Vector3::new(x, y, z)
}

/// A rectangle across z.
pub fn level(low: [f64; 2], high: [f64; 2], z: f64) -> Vec<Vector3<f64>> {
    vec![v(low[0], low[1], z), v(high[0], low[1], z), v(high[0], high[1], z), v(low[0], high[1], z)]
}

/// A block of width 1, depth 1 and a height on a floor; gravity turned by an angle about y.
pub fn block(height: f64, angle: f64, friction: f64) -> Scene {
    let weight = v(angle.sin(), 0.0, -angle.cos());
    let bodies = vec![Body::held(v(0.0, 0.0, -1.0)), Body::free(v(0.0, 0.0, 0.5 * height), weight)];
    let contacts = vec![Contact::new([0, 1], level([-0.5, -0.5], [0.5, 0.5], 0.0), Vector3::z(), friction)];
    Scene { bodies, contacts }
}

/// A running-bond wall of `rows` courses of `width` bricks (2 × 1 × 1) pushed sideways by a share of its weight.
pub fn wall(width: usize, rows: usize, friction: f64) -> Scene {
    let mut bodies = vec![Body::held(v(0.0, 0.0, -1.0))];
    let mut spans: Vec<Vec<(f64, f64, usize)>> = vec![vec![(-1e3, 1e3, 0)]];
    let mut contacts = Vec::new();
    for row in 0..rows {
        let mut edges: Vec<f64> = (0..=width).map(|i| 2.0 * i as f64).collect();
        if row % 2 == 1 {
            edges =
                [0.0].into_iter().chain((0..width).map(|i| 2.0 * i as f64 + 1.0)).chain([2.0 * width as f64]).collect();
        }
        let mut course = Vec::new();
        for pair in edges.windows(2) {
            let (a, b) = (pair[0], pair[1]);
            let index = bodies.len();
            let mut body = Body::free(v(0.5 * (a + b), 0.5, row as f64 + 0.5), v(0.0, 0.0, -(b - a)));
            body.live = Load::force(v(b - a, 0.0, 0.0));
            bodies.push(body);
            for &(c, d, other) in spans.last().unwrap() {
                let (low, high) = (a.max(c), b.min(d));
                if high > low + 1e-9 {
                    contacts.push(Contact::new(
                        [other, index],
                        level([low, 0.0], [high, 1.0], row as f64),
                        Vector3::z(),
                        friction,
                    ));
                }
            }
            if let Some(&(_, _, before)) = course.last() {
                let z = row as f64;
                let corners = vec![v(a, 0.0, z), v(a, 1.0, z), v(a, 1.0, z + 1.0), v(a, 0.0, z + 1.0)];
                contacts.push(Contact::new([before, index], corners, Vector3::x(), friction));
            }
            course.push((a, b, index));
        }
        spans.push(course);
    }
    Scene { bodies, contacts }
}

/// A semicircular arch of n voussoirs, radii 1 ± t/2, on two held springers; depth 1, no sliding.
pub fn arch(thickness: f64, count: usize) -> Scene {
    let pi = std::f64::consts::PI;
    let [inner, outer] = [-0.5, 0.5].map(|side| 1.0 + side * thickness);
    let at = |radius: f64, angle: f64, y: f64| v(radius * angle.cos(), y, radius * angle.sin());
    let step = pi / count as f64;
    // Centroid of a sector of a ring.
    let centre = |angle: f64| {
        let radius = 2.0 / 3.0 * (outer.powi(3) - inner.powi(3)) / (outer.powi(2) - inner.powi(2));
        at(radius * (0.5 * step).sin() / (0.5 * step), angle, 0.5)
    };
    let mut bodies = vec![Body::held(v(1.0, 0.5, -1.0))];
    bodies.extend((0..count).map(|i| Body::free(centre((i as f64 + 0.5) * step), v(0.0, 0.0, -1.0))));
    bodies.push(Body::held(v(-1.0, 0.5, -1.0)));
    let joint = |i: usize| {
        let angle = i as f64 * step;
        let corners = [(inner, 0.0), (outer, 0.0), (outer, 1.0), (inner, 1.0)].map(|(radius, y)| at(radius, angle, y));
        Contact::new([i, i + 1], corners.to_vec(), v(-angle.sin(), 0.0, angle.cos()), 2.0)
    };
    Scene { bodies, contacts: (0..=count).map(joint).collect() }
}

/// A wedge on two planes (dip, dip direction) below a level top and behind a face, and its factor of safety by Hoek &
/// Bray: both normal forces from the
/// components of the weight across the line of intersection.
pub fn wedge(planes: [[f64; 2]; 2], face: [f64; 2], friction: f64) -> (Scene, f64) {
    let normal = |[dip, direction]: [f64; 2]| {
        let (d, a) = (dip.to_radians(), direction.to_radians());
        v(d.sin() * a.sin(), d.sin() * a.cos(), d.cos())
    };
    let ([a, b], f, weight) = (planes.map(normal), normal(face), v(0.0, 0.0, -1.0));
    let meet = |p: Vector3<f64>, q: Vector3<f64>| p.cross(&q) * (10.0 / p.cross(&q).z);
    let (foot, on_a, on_b, back) = (Vector3::zeros(), meet(a, f), meet(b, f), meet(a, b));
    let bodies = vec![Body::held(v(0.0, 0.0, -1.0)), Body::free((foot + on_a + on_b + back) / 4.0, weight)];
    let joint = |corner, normal| Contact::new([0, 1], vec![foot, corner, back], normal, friction);
    let scene = Scene { bodies, contacts: vec![joint(on_a, a), joint(on_b, b)] };
    let line = back.normalize();
    let forces = Matrix3::from_columns(&[a, b, line]).lu().solve(&-weight).unwrap();
    assert!(forces.x > 0.0 && forces.y > 0.0, "it slides on both planes");
    (scene, friction * (forces.x + forces.y) / line.z)
}

/// A scene whose live loads are the dead ones turned along x.
pub fn pushed(mut scene: Scene) -> Scene {
    scene.bodies.iter_mut().for_each(|body| body.live = Load::force(Vector3::x() * body.dead.force.norm()));
    scene
}
