//! Random particles over everything that can be written down.

use crate::pair_line::outline;
use crate::random::Random;
use nalgebra::Vector3;
use potential_particles::{Particle, Plane};

/// What planes a shape has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hull {
    Box,
    /// Few random planes: tetrahedra and the like.
    Few,
    Some,
    /// Up to 1,000.
    Many,
    Needle,
    Plate,
    /// Regular or not, of three to twelve sides.
    Prism,
    /// Doubled, nearly parallel, needless and unnormalised planes, many through one point, faces without area.
    Degenerate,
    Any,
}

/// What is drawn from where.
#[derive(Clone, Copy, Debug)]
pub struct Recipe {
    pub hull: Hull,
    /// r, relative to the nearest plane, from 10^.0 to 10^.1.
    pub rounding: (f64, f64),
    pub sphericity: Sphericity,
    /// Length, from 10^.0 to 10^.1.
    pub size: (f64, f64),
}

/// Which k.
#[derive(Clone, Copy, Debug)]
pub enum Sphericity {
    Flat,
    Round,
    /// 10^.0 to 10^.1.
    Between(f64, f64),
    Any,
}

/// A particle of the recipe; attempts that are no particle (a centre outside, open planes) are drawn anew.
pub fn particle(recipe: &Recipe, random: &mut Random) -> Particle {
    loop {
        if let Some(particle) = attempt(recipe, random) {
            return particle;
        }
    }
}

/// The outline of one: its planes as lines of the plane z = 0, normals as long as they are. Planes that lie there are
/// none.
pub fn in_plane(recipe: &Recipe, random: &mut Random) -> Particle {
    loop {
        if let Some(flat) = flattened(&particle(recipe, random)) {
            return flat;
        }
    }
}

/// The same of a particle, if its lines make one.
pub fn flattened(particle: &Particle) -> Option<Particle> {
    let line = |plane: Plane| {
        let length = plane.normal.norm();
        let across = Vector3::new(plane.normal.x, plane.normal.y, 0.0).try_normalize(1e-3 * length)?;
        Some(Plane { normal: length * across, ..plane })
    };
    let lines: Vec<Plane> = particle.planes().filter_map(line).collect();
    outline(&lines, particle.rounding_radius(), particle.sphericity(), particle.shadow_radius()).ok()
}

fn power(random: &mut Random, (low, high): (f64, f64)) -> f64 {
    10f64.powf(low + (high - low) * random.uniform())
}

fn attempt(recipe: &Recipe, random: &mut Random) -> Option<Particle> {
    let size = power(random, recipe.size);
    let hull = match recipe.hull {
        Hull::Any => [Hull::Box, Hull::Few, Hull::Some, Hull::Many, Hull::Needle, Hull::Plate, Hull::Degenerate]
            [[0, 0, 1, 1, 1, 2, 2, 2, 3, 4, 4, 5, 5, 6, 6, 6][random.whole(0, 16)]],
        hull => hull,
    };
    let k = match recipe.sphericity {
        Sphericity::Flat => 0.0,
        Sphericity::Round => 1.0,
        Sphericity::Between(low, high) => power(random, (low, high)).min(1.0),
        Sphericity::Any => match random.whole(0, 8) {
            0 => 0.0,
            1 => 1.0,
            2 | 3 => power(random, (-10.0, 0.0)),
            4 => 1.0 - power(random, (-16.0, 0.0)),
            _ => power(random, (-4.0, -0.1)),
        },
    };
    let shadow = size * power(random, (-0.3, 0.3));
    if k == 1.0 && random.uniform() < 0.5 {
        return Particle::new(&[], 0.0, 1.0, shadow).ok();
    }
    let mut planes = planes(hull, size, random);
    let nearest = planes.iter().map(|p| p.offset / p.normal.norm()).fold(f64::INFINITY, f64::min);
    let r = nearest * power(random, recipe.rounding);
    let inset = if random.uniform() < 0.2 { random.uniform() } else { 1.0 };
    for plane in &mut planes {
        plane.offset -= inset * r * plane.normal.norm();
    }
    Particle::new(&planes, r, k, shadow).ok()
}

fn planes(hull: Hull, size: f64, random: &mut Random) -> Vec<Plane> {
    let thin = |random: &mut Random| power(random, (-3.0, -1.0));
    let aspect = match hull {
        Hull::Needle => Vector3::new(1.0, thin(random), thin(random)),
        Hull::Plate => Vector3::new(1.0, power(random, (-0.5, 0.0)), thin(random)),
        _ => Vector3::new(1.0, power(random, (-0.7, 0.0)), power(random, (-0.7, 0.0))),
    };
    let half = size * aspect;
    match hull {
        Hull::Box => cuboid(&half),
        Hull::Few => scattered(random.whole(4, 7), &half, random),
        Hull::Some => scattered(random.whole(7, 31), &half, random),
        Hull::Many => {
            let count = power(random, (1.5, 3.0)).round() as usize;
            scattered(count, &half, random)
        }
        Hull::Needle | Hull::Plate if random.uniform() < 0.5 => cuboid(&half),
        Hull::Needle | Hull::Plate => scattered(random.whole(6, 21), &half, random),
        Hull::Prism => prism(random.whole(3, 13), &half, random),
        Hull::Degenerate | Hull::Any => degenerate(&half, random),
    }
}

fn cuboid(half: &Vector3<f64>) -> Vec<Plane> {
    (0..3)
        .flat_map(|axis| [1.0, -1.0].map(|sign| Plane { normal: Vector3::ith(axis, sign), offset: half[axis] }))
        .collect()
}

/// Sides about z, and two caps.
fn prism(sides: usize, half: &Vector3<f64>, random: &mut Random) -> Vec<Plane> {
    let regular = random.uniform() < 0.5;
    let mut planes = cuboid(half).split_off(4);
    for i in 0..sides {
        let aside = if regular { 0.0 } else { 0.6 * (random.uniform() - 0.5) };
        let angle = std::f64::consts::TAU * (i as f64 + aside) / sides as f64;
        planes.push(Plane { normal: Vector3::new(angle.cos(), angle.sin(), 0.0), offset: half.x });
    }
    planes
}

/// Tangents of an ellipsoid, moved in a little.
fn scattered(count: usize, half: &Vector3<f64>, random: &mut Random) -> Vec<Plane> {
    (0..count)
        .map(|_| {
            let normal = random.direction();
            let reach = normal.component_mul(half).norm();
            Plane { normal, offset: reach * (0.7 + 0.3 * random.uniform()) }
        })
        .collect()
}

fn degenerate(half: &Vector3<f64>, random: &mut Random) -> Vec<Plane> {
    let mut planes = if random.uniform() < 0.5 {
        cuboid(half)
    } else {
        let count = random.whole(4, 13);
        scattered(count, half, random)
    };
    for _ in 0..random.whole(1, 4) {
        let chosen = planes[random.whole(0, planes.len())];
        match random.whole(0, 7) {
            0 => planes.push(chosen),
            1 => {
                let tilt = power(random, (-16.0, -3.0));
                let shift = 1.0 + power(random, (-16.0, -3.0));
                let normal = (chosen.normal.normalize() + tilt * random.direction()).normalize();
                planes.push(Plane { normal, offset: chosen.offset / chosen.normal.norm() * shift });
            }
            // Never reached.
            2 => {
                let far = power(random, (0.5, 6.0));
                planes.push(Plane { normal: random.direction(), offset: far * half.amax() });
            }
            // Normals of other lengths mean a sharper or blunter rounding on their side.
            3 => {
                let factor = power(random, (-2.0, 2.0));
                let at = random.whole(0, planes.len());
                planes[at] = Plane { normal: factor * chosen.normal, offset: factor * chosen.offset };
            }
            // A fan of planes through one corner.
            4 => {
                let corner = 0.9 * half.component_mul(&random.direction());
                for _ in 0..random.whole(3, 30) {
                    let normal = (corner.normalize() + 0.7 * random.direction()).normalize();
                    if normal.dot(&corner) > 0.05 * corner.norm() {
                        planes.push(Plane { normal, offset: normal.dot(&corner) });
                    }
                }
            }
            // Touching a box along an edge or in a corner: a face without area.
            5 => {
                let mut sum = half.map(|_| if random.uniform() < 0.7 { 1.0 } else { 0.0 });
                if sum.norm() == 0.0 {
                    sum.x = 1.0;
                }
                let normal = sum.normalize();
                planes.push(Plane { normal, offset: normal.dot(half) });
            }
            // A wedge that ends in a blade.
            _ => {
                let blade = power(random, (-6.0, -1.0));
                let axis = Vector3::ith(random.whole(0, 3), 1.0);
                let normal = (axis + blade * random.direction()).normalize();
                let offset = 0.5 * half.amin();
                planes.extend([normal, -normal].map(|n| {
                    let normal = (n + blade * random.direction()).normalize();
                    Plane { normal, offset }
                }));
            }
        }
    }
    planes
}
