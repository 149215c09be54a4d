//! Random particles beside random planes and triangles, by seed and index: parallel to faces, at edges and corners,
//! from just touching to through the centre. No solver is asked where to put them.

use crate::pair_line::Place;
use crate::random::Random;
use crate::stress::cases::{is_flat, stream};
use crate::stress::placed_boundary::Boundary;
use crate::stress::shapes::{Hull, Recipe, Sphericity, flattened, particle};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use potential_particles::{Particle, Plane, Settings};

/// Boundaries of the same particle.
const CASES_A_PARTICLE: u64 = 8;

/// Seed and index of a case.
pub struct Drawn {
    pub seed: u64,
    pub index: u64,
}

/// A particle, where it is, and what it may touch.
pub struct Case {
    pub particle: Particle,
    pub at: Place,
    pub boundary: Boundary,
    pub settings: Settings,
    /// What the state of the pair is drawn from.
    pub memory: Drawn,
    /// Of the particle, and how the boundary lies.
    pub family: String,
}

const ANY_ROUNDING: (f64, f64) = (-9.0, -0.3);
const BASE: Recipe =
    Recipe { hull: Hull::Some, rounding: ANY_ROUNDING, sphericity: Sphericity::Between(-4.0, -0.1), size: (-1.0, 1.0) };
const FLAT: Recipe = Recipe { sphericity: Sphericity::Flat, ..BASE };
const ALMOST_FLAT: Recipe = Recipe { sphericity: Sphericity::Between(-14.0, -4.0), ..BASE };

static PARTICLES: [(&str, Recipe); 20] = [
    ("rocks", BASE),
    ("rocks, k = 0", FLAT),
    ("rocks, k almost 0", ALMOST_FLAT),
    ("boxes", Recipe { hull: Hull::Box, ..BASE }),
    ("boxes, k = 0", Recipe { hull: Hull::Box, ..FLAT }),
    ("boxes, k almost 0", Recipe { hull: Hull::Box, ..ALMOST_FLAT }),
    ("prisms", Recipe { hull: Hull::Prism, ..BASE }),
    ("prisms, k = 0", Recipe { hull: Hull::Prism, ..FLAT }),
    ("few planes", Recipe { hull: Hull::Few, sphericity: Sphericity::Any, ..BASE }),
    ("few planes, k = 0", Recipe { hull: Hull::Few, ..FLAT }),
    ("needles", Recipe { hull: Hull::Needle, sphericity: Sphericity::Any, ..BASE }),
    ("needles, k = 0", Recipe { hull: Hull::Needle, ..FLAT }),
    ("plates", Recipe { hull: Hull::Plate, sphericity: Sphericity::Any, ..BASE }),
    ("plates, k = 0", Recipe { hull: Hull::Plate, ..FLAT }),
    ("many planes", Recipe { hull: Hull::Many, sphericity: Sphericity::Any, ..BASE }),
    ("many planes, k = 0", Recipe { hull: Hull::Many, ..FLAT }),
    ("degenerate hulls", Recipe { hull: Hull::Degenerate, sphericity: Sphericity::Any, ..BASE }),
    ("degenerate hulls, k = 0", Recipe { hull: Hull::Degenerate, ..FLAT }),
    ("nearly spheres", Recipe { hull: Hull::Any, sphericity: Sphericity::Between(-1e-8, 0.0), ..BASE }),
    ("units", Recipe { hull: Hull::Any, sphericity: Sphericity::Any, size: (-9.0, 9.0), ..BASE }),
];

/// The particle of a group of cases, and the name of its kind.
pub fn particle_of(random: &mut Random, group: u64) -> (Particle, &'static str) {
    let (name, recipe) = &PARTICLES[(group % PARTICLES.len() as u64) as usize];
    loop {
        let particle = particle(recipe, random);
        if random.uniform() > 0.15 {
            return (particle, name);
        }
        // Each normal of another length.
        let planes: Vec<Plane> = particle
            .planes()
            .map(|p| {
                let factor = random.power(-2.0, 2.0);
                Plane { normal: factor * p.normal, offset: factor * p.offset }
            })
            .collect();
        let (r, k, shadow) = (particle.rounding_radius(), particle.sphericity(), particle.shadow_radius());
        if let Ok(particle) = Particle::new(&planes, r, k, shadow) {
            return (particle, name);
        }
    }
}

/// Any, exact multiples of 90°, or next to those; and at, near or far from the origin.
pub fn place_of(particle: &Particle, random: &mut Random) -> Place {
    let orientation = match random.whole(0, 4) {
        0 => [1.0, 0.0, 0.0, 0.0],
        1 => {
            let exact = [[1.0, 1.0, 0.0, 0.0], [0.5, 0.5, 0.5, 0.5], [1.0, 0.0, 0.0, 0.4]][random.whole(0, 3)];
            let tilt = if random.uniform() < 0.5 { 0.0 } else { random.power(-17.0, -1.0) };
            exact.map(|c: f64| c + tilt * random.normal())
        }
        _ => [0; 4].map(|_| random.normal()),
    };
    let (length, flat) = (particle.bounding_radius(), particle.is_in_plane());
    let position = match random.whole(0, 5) {
        0 | 1 => Vector3::zeros(),
        2 | 3 => length * random.power(-1.0, 1.0) * random.direction_in(flat),
        _ => length * random.power(3.0, 6.5) * random.direction_in(flat),
    };
    // That of a tilt alone would be none.
    let orientation = if flat { [1.0 + orientation[0], 0.0, 0.0, orientation[3]] } else { orientation };
    Place { position: position.into(), orientation, angle: None }
}

/// A point of the surface and the outward normal there, local frame, and how it was chosen.
fn touched(particle: &Particle, random: &mut Random) -> (Vector3<f64>, Vector3<f64>, &'static str) {
    let corners = particle.bounding_corners();
    let count = particle.plane_count();
    let (way, face, name) = match random.whole(0, 8) {
        0..=3 if count > 0 && particle.sphericity() < 1.0 => {
            let face = particle.planes().nth(random.whole(0, count)).expect("a plane of those counted").normal;
            (face, Some(face), "parallel to a face")
        }
        4 if corners.len() > 1 => (corners[random.whole(0, corners.len())], None, "at a corner"),
        5 if corners.len() > 1 => {
            let (one, other) = (corners[random.whole(0, corners.len())], corners[random.whole(0, corners.len())]);
            (one + random.uniform() * (other - one), None, "at an edge")
        }
        _ => (random.direction_in(particle.is_in_plane()), None, "anywhere"),
    };
    let way = way.try_normalize(0.0).unwrap_or_else(Vector3::x);
    let to = particle.surface_distance(&Vector3::zeros(), &way).unwrap_or(particle.bounding_radius());
    let point = to * way;
    let normal = face.unwrap_or_else(|| particle.gradient(&point));
    (point, normal.try_normalize(0.0).unwrap_or(way), name)
}

/// From just touching to through the centre, as a share of the way from the centre.
fn depth(random: &mut Random) -> f64 {
    let sign = if random.uniform() < 0.75 { -1.0 } else { 1.0 };
    match random.whole(0, 8) {
        0 => 1.0,
        1..=3 => 1.0 + sign * random.power(-16.0, -9.0),
        4 | 5 => 1.0 + sign * random.power(-9.0, -2.0),
        6 => random.uniform(),
        _ if random.uniform() < 0.3 => 0.0,
        _ => random.power(-16.0, 0.0),
    }
}

/// The given direction but for a tilt: none, of rounding, or up to 1e-6.
fn tilted(normal: &Vector3<f64>, flat: bool, random: &mut Random) -> Vector3<f64> {
    let tilt = [0.0, 0.0, 1e-16, 1e-15, 1e-12, 1e-9, 1e-6][random.whole(0, 7)];
    if tilt == 0.0 {
        return *normal;
    }
    let about = if flat { Vector3::z() } else { random.direction() };
    let across = normal.cross(&about).try_normalize(0.0).unwrap_or_else(Vector3::zeros);
    normal + tilt * random.uniform() * across
}

/// Corners in the plane, about a point that lies in it, on an edge, at a corner or just outside; of unit size.
fn outline(random: &mut Random) -> [[f64; 2]; 3] {
    let mut corners = [0; 3].map(|_| {
        let (radius, angle) = (random.uniform().sqrt(), std::f64::consts::TAU * random.uniform());
        [radius * angle.cos(), radius * angle.sin()]
    });
    if random.uniform() < 0.2 {
        // A sliver: the third corner next to the line of the others.
        let (share, thin) = (random.uniform(), random.power(-9.0, -1.0));
        let aside = [0, 1].map(|c| corners[1][c] - corners[0][c]);
        corners[2] =
            [corners[0][0] + share * aside[0] - thin * aside[1], corners[0][1] + share * aside[1] + thin * aside[0]];
        let first = random.whole(0, 3);
        corners.rotate_left(first);
    }
    let mut weights = [random.uniform(), random.uniform(), random.uniform()];
    match random.whole(0, 6) {
        0 => weights[random.whole(0, 3)] = 0.0,
        1 => {
            let kept = random.whole(0, 3);
            weights = [0, 1, 2].map(|i| if i == kept { 1.0 } else { 0.0 });
        }
        2 => {
            let (at, by) = (random.whole(0, 3), random.power(-16.0, 0.0));
            weights[at] = if random.uniform() < 0.5 { by } else { -by };
        }
        3 => weights[random.whole(0, 3)] -= 1.0,
        _ => {}
    }
    let sum: f64 = weights.iter().sum();
    let sum = if sum.abs() > 0.1 { sum } else { 1.0 };
    let centre = [0, 1].map(|c| (0..3).map(|i| weights[i] * corners[i][c]).sum::<f64>() / sum);
    corners.map(|corner| [corner[0] - centre[0], corner[1] - centre[1]])
}

pub fn settings(random: &mut Random) -> Settings {
    let default = Settings::default();
    match random.whole(0, 6) {
        0 => default.with_gap_tolerance(1e-14).with_solve_separated(true),
        1 => default.with_flat_regularisation(random.power(-12.0, -2.0)).with_solve_separated(true),
        2 => default,
        _ => default.with_solve_separated(true),
    }
}

impl Case {
    pub fn of(seed: u64, index: u64) -> Self {
        let group = index / CASES_A_PARTICLE;
        let (mut particle, name) = particle_of(&mut stream(seed, 11, group), group);
        if is_flat(seed, 19, group) {
            particle = flattened(&particle).unwrap_or(particle);
        }
        let mut random = stream(seed, 12, index);
        let at = place_of(&particle, &mut random);
        let settings = settings(&mut random);
        let (boundary, how) = beside(&particle, &at, &mut random);
        let memory = Drawn { seed, index };
        Self { particle, at, boundary, settings, memory, family: format!("{name} | {how}") }
    }
}

/// A boundary beside a placed particle, and how it lies.
pub fn beside(particle: &Particle, at: &Place, random: &mut Random) -> (Boundary, String) {
    let [w, x, y, z] = at.orientation;
    let turn = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
    let (centre, flat) = (Vector3::from(at.position), particle.is_in_plane());
    let (surface, outward, how) = touched(particle, random);
    // A face that is met at any place of it.
    let aside = if how == "parallel to a face" && random.uniform() < 0.5 {
        let across = random.direction_in(flat);
        particle.bounding_radius() * random.uniform() * (across - across.dot(&outward) * outward)
    } else {
        Vector3::zeros()
    };
    let point = centre + turn * (depth(random) * surface + aside);
    let normal = turn * tilted(&outward, flat, random);
    // In the plane there are lines alone.
    if random.uniform() < 0.4 || flat {
        let length = if random.uniform() < 0.5 { 1.0 } else { random.power(-3.0, 3.0) };
        let sign = if random.uniform() < 0.5 { 1.0 } else { -1.0 };
        let normal: Vector3<f64> = sign * length * normal;
        return (Boundary::Plane { point: point.into(), normal: normal.into() }, format!("plane {how}"));
    }
    loop {
        // Most lie in the tangent plane; the others meet it with an edge or a corner, or cut through.
        let normal = if random.uniform() < 0.7 { normal } else { random.direction() };
        let first = normal.cross(&Vector3::ith(normal.iamin(), 1.0)).normalize();
        let second = normal.cross(&first).normalize();
        let size = particle.bounding_radius()
            * match random.whole(0, 3) {
                0 => random.power(-3.0, 0.0),
                1 => random.power(-0.5, 1.0),
                _ => random.power(0.0, 6.0),
            };
        let corner = |[u, v]: [f64; 2]| (point + size * (u * first + v * second)).into();
        let vertices: [[f64; 3]; 3] = outline(random).map(corner);
        if potential_particles::Triangle::new(vertices).is_ok() {
            return (Boundary::Triangle(vertices), format!("triangle {how}"));
        }
    }
}
