//! Scenes whose limits are known, for the tests and the benchmark of `equilibrium`.

use potential_particles::Plane;
use potential_particles::equilibrium::{Body, Contact, JointStrength, Load, Scene};
use potential_particles::nalgebra::{Matrix3, Vector3};
use potential_particles::rock::{JointSet, RockMass, SliceSettings, slice};
use rand_pcg::Pcg64;
use rand_pcg::rand_core::{RngCore, SeedableRng};

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
    let shifted = |i: usize| if i == 0 || i == width { 0.5 } else { 1.0 };
    let course = |row: usize| match row % 2 {
        0 => vec![1.0; width],
        _ => (0..=width).map(shifted).collect(),
    };
    masonry(&(0..rows).map(course).collect(), [2.0, 1.0], friction)
}

/// Widths of the bricks of each course, negative where there is an opening.
type Courses = Vec<Vec<f64>>;

/// The walls 1 to 3 of Ferris and Tin-Loi (2001), Int. J. Solids Struct. 38, bricks of 0.4 by 0.175 m, friction 0.65;
/// the third has a window.
pub fn ferris_tin_loi(wall: usize) -> Scene {
    let [even, odd] = [vec![0.5, 1.0, 1.0, 1.0, 1.0, 0.5], vec![1.0; 5]];
    let plain = |rows: usize| -> Courses { (0..rows).map(|row| [&even, &odd][row % 2].clone()).collect() };
    let [full, offset] = [vec![1.0; 4], vec![0.5, 1.0, 1.0, 1.0, 0.5]];
    let [jamb, reveal] = [vec![0.5, 1.0, -1.0, 1.0, 0.5], vec![1.0, 0.5, -1.0, 0.5, 1.0]];
    let window = [&full, &offset, &full, &jamb, &reveal, &jamb, &reveal, &jamb, &full, &offset, &full];
    let courses = match wall {
        1 => plain(6),
        2 => plain(10),
        _ => window.into_iter().cloned().collect(),
    };
    masonry(&courses, [0.4, 0.175], 0.65)
}

/// A wall of courses on a held floor, of bricks of this length and height and the weight 1, pushed along x by a share
/// of its weight.
fn masonry(courses: &Courses, [length, height]: [f64; 2], friction: f64) -> Scene {
    let mut bricks = Vec::new();
    for (row, widths) in courses.iter().enumerate() {
        let mut x = 0.0;
        for width in widths {
            if *width > 0.0 {
                bricks.push((row, x, x + width));
            }
            x += width.abs();
        }
    }
    let mut bodies = vec![Body::held(v(0.0, 0.0, -1.0))];
    let mut contacts = Vec::new();
    for (i, &(row, a, b)) in bricks.iter().enumerate() {
        let centre = v(0.5 * (a + b) * length, 0.5, (row as f64 + 0.5) * height);
        bodies.push(Body { live: Load::force(v(b - a, 0.0, 0.0)), ..Body::free(centre, v(0.0, 0.0, a - b)) });
        let bed = |c: f64, d: f64| level([c * length, 0.0], [d * length, 1.0], row as f64 * height);
        if row == 0 {
            contacts.push(Contact::new([0, i + 1], bed(a, b), Vector3::z(), friction));
        }
        for (j, &(other, c, d)) in bricks.iter().enumerate() {
            let (low, high) = (a.max(c), b.min(d));
            if other + 1 == row && high - low > 1e-9 {
                contacts.push(Contact::new([j + 1, i + 1], bed(low, high), Vector3::z(), friction));
            }
            if other == row && (d - a).abs() < 1e-9 {
                let head = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
                let corner = |(y, z): (f64, f64)| v(a * length, y, (row as f64 + z) * height);
                contacts.push(Contact::new([j + 1, i + 1], head.map(corner).to_vec(), Vector3::x(), friction));
            }
        }
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

/// A slope, 8 high, whose face dips at an angle, cut by joint sets; blocks on its other sides but the top are held.
/// Friction of 35 degrees.
pub fn slope(face: f64, sets: &[JointSet]) -> Scene {
    slope_of_rock(face, sets).1
}

fn slope_of_rock(face: f64, sets: &[JointSet]) -> (RockMass, Scene) {
    let outwards = v(face.to_radians().sin(), 0.0, face.to_radians().cos());
    let side = |i: usize, offset: f64| Plane { normal: Vector3::ith(i / 2, [-1.0, 1.0][i % 2]), offset };
    let mut domain: Vec<Plane> = (0..6).zip([0.0, 10.0, 0.0, 10.0, 0.0, 8.0]).map(|(i, at)| side(i, at)).collect();
    domain.push(Plane { normal: outwards, offset: 9.0 * outwards.x });
    let joints: Vec<_> = sets.iter().flat_map(|set| set.joints([5.0, 5.0, 4.0], 9.0).expect("a set")).collect();
    let settings = SliceSettings { least_volume: 1e-3, least_thickness: 0.02, ..SliceSettings::default() };
    let mass = slice(&domain, &joints, &settings).expect("a rock mass");
    let is_held = |block: usize| {
        let is_inside = |at: &Vector3<f64>| at.x.min(at.y).min(at.z) > 1e-6 && at.x.max(at.y) < 10.0 - 1e-6;
        !mass.blocks[block].corners.iter().all(is_inside)
    };
    let strength = JointStrength { friction: 35.0_f64.to_radians().tan(), ..JointStrength::default() };
    let scene = Scene::of_rock(&mass, v(0.0, 0.0, -26e3), is_held, |_| strength);
    (mass, scene)
}

/// A slope cut by three random sets into about that many blocks.
pub fn random_slope(seed: u64, blocks: f64) -> Scene {
    random_rock(seed, blocks).1
}

/// The same with its rock mass.
pub fn random_rock(seed: u64, blocks: f64) -> (RockMass, Scene) {
    let mut random = Pcg64::seed_from_u64(seed);
    let mut uniform = |low: f64, high: f64| low + (high - low) * (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
    let (face, spacing) = (uniform(50.0, 75.0), (800.0 / blocks).cbrt() * uniform(0.8, 1.2));
    let sets = [(); 3].map(|()| {
        let fisher = if uniform(0.0, 1.0) < 0.5 { f64::INFINITY } else { 300.0 };
        let set = JointSet::new(uniform(0.0, 1.0).acos().to_degrees(), uniform(0.0, 360.0), spacing);
        JointSet { fisher, seed: uniform(0.0, 1e6) as u64, ..set }
    });
    slope_of_rock(face, &sets)
}

/// A scene whose live loads are the dead ones turned along x.
pub fn pushed(mut scene: Scene) -> Scene {
    scene.bodies.iter_mut().for_each(|body| body.live = Load::force(Vector3::x() * body.dead.force.norm()));
    scene
}
