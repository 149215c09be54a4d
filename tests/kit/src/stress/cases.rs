//! Random pairs by seed and index: shapes by family, places from far apart to one inside the other.
//!
//! No solver is asked where to put them: pairs that touch are built by laying one surface point on the other, with
//! opposite normals where that is wanted. The same seed and index give the same pair, whatever the library does. One
//! pair of shapes in twenty, of every family, are those that planes cut out of the plane z = 0.

use crate::pair_line::{Line, Place};
use crate::random::Random;
use crate::stress::shapes::{Hull, Recipe, Sphericity, in_plane, particle};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use potential_particles::Particle;

/// Poses of the same two shapes.
pub const POSES_A_PAIR: u64 = 8;

/// From this index on shapes last longer: to make two of them costs as much as to judge some thirty poses.
pub const BULK: u64 = 10_000_000_000_000;
const POSES_A_PAIR_IN_BULK: u64 = 512;

/// The two shapes of pair `index`, by number.
pub fn group_of(index: u64) -> u64 {
    if index < BULK { index / POSES_A_PAIR } else { BULK / POSES_A_PAIR + (index - BULK) / POSES_A_PAIR_IN_BULK }
}

/// Index into [`FAMILIES`].
pub fn family_of(index: u64) -> usize {
    (group_of(index) % FAMILIES.len() as u64) as usize
}

/// The first pair after `index` of two other shapes.
pub fn next_group(index: u64) -> u64 {
    let (from, poses) = if index < BULK { (0, POSES_A_PAIR) } else { (BULK, POSES_A_PAIR_IN_BULK) };
    index + poses - (index - from) % poses
}

/// How a family places its bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Contact {
    /// Anywhere with balls that meet.
    Anywhere,
    /// Surface point on surface point, normals opposite, then this far into each other: ±10^.0 to ±10^.1, relative.
    Touching(f64, f64),
    /// The same, and the points are those next to corners and edges.
    Edges,
    /// Both centres in one point, or nearly.
    Coincident,
    /// One inside the other.
    Contained,
    Any,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Turned {
    Anyhow,
    /// Multiples of 90°, or next to them.
    Aligned,
}

/// One family of pairs.
pub struct Family {
    pub name: &'static str,
    recipes: [Recipe; 2],
    contact: Contact,
    turned: Turned,
    /// Largest distance of the origin, powers of ten of the size.
    far: f64,
}

const USUAL: Recipe =
    Recipe { hull: Hull::Some, rounding: (-3.0, -0.3), sphericity: Sphericity::Between(-3.0, -0.05), size: (0.0, 0.3) };
const SHARP: Recipe = Recipe { rounding: (-8.0, -3.0), sphericity: Sphericity::Between(-10.0, -2.0), ..USUAL };
const ANY: Recipe = Recipe { hull: Hull::Any, rounding: (-8.0, -0.3), sphericity: Sphericity::Any, size: (-2.0, 3.0) };
const BASE: Family =
    Family { name: "", recipes: [USUAL, USUAL], contact: Contact::Any, turned: Turned::Anyhow, far: 0.0 };

const fn both(recipe: Recipe) -> [Recipe; 2] {
    [recipe, recipe]
}

/// In this order: the shapes of group g are of family g modulo their number.
pub static FAMILIES: [Family; 20] = [
    Family { name: "generic", ..BASE },
    Family { name: "few planes", recipes: both(Recipe { hull: Hull::Few, ..USUAL }), ..BASE },
    Family { name: "near-polyhedral", recipes: both(SHARP), ..BASE },
    Family {
        name: "flat faces, k = 0",
        recipes: both(Recipe { hull: Hull::Any, sphericity: Sphericity::Flat, ..USUAL }),
        ..BASE
    },
    Family {
        name: "sharp and flat, k = 0",
        recipes: both(Recipe { hull: Hull::Any, sphericity: Sphericity::Flat, ..SHARP }),
        ..BASE
    },
    Family {
        name: "spheres and others",
        recipes: [Recipe { sphericity: Sphericity::Round, ..ANY }, Recipe { size: (-1.0, 1.0), ..ANY }],
        ..BASE
    },
    Family {
        name: "nearly spheres",
        recipes: both(Recipe { sphericity: Sphericity::Between(-1e-8, 0.0), ..ANY }),
        ..BASE
    },
    Family { name: "needles", recipes: both(Recipe { hull: Hull::Needle, ..USUAL }), ..BASE },
    Family { name: "plates", recipes: both(Recipe { hull: Hull::Plate, rounding: (-6.0, -0.3), ..USUAL }), ..BASE },
    Family { name: "many planes", recipes: both(Recipe { hull: Hull::Many, ..USUAL }), ..BASE },
    Family { name: "size ratio", recipes: [USUAL, Recipe { size: (-5.0, 0.0), ..ANY }], ..BASE },
    Family { name: "far from the origin", recipes: both(Recipe { hull: Hull::Any, ..USUAL }), far: 8.0, ..BASE },
    Family { name: "units", recipes: both(Recipe { size: (-9.0, -8.5), ..ANY }), ..BASE },
    Family {
        name: "aligned boxes",
        recipes: both(Recipe { hull: Hull::Box, rounding: (-6.0, -0.3), sphericity: Sphericity::Any, ..USUAL }),
        turned: Turned::Aligned,
        ..BASE
    },
    Family { name: "aligned", recipes: both(Recipe { hull: Hull::Any, ..SHARP }), turned: Turned::Aligned, ..BASE },
    Family { name: "kissing", recipes: both(ANY), contact: Contact::Touching(-15.0, -6.0), ..BASE },
    Family { name: "edges and corners", recipes: both(ANY), contact: Contact::Edges, ..BASE },
    Family { name: "coincident or contained", recipes: both(ANY), contact: Contact::Coincident, ..BASE },
    Family {
        name: "degenerate hulls",
        recipes: both(Recipe { hull: Hull::Degenerate, size: (0.0, 0.5), ..ANY }),
        ..BASE
    },
    Family { name: "anything", recipes: both(ANY), far: 6.0, ..BASE },
];

/// Two shapes, from which several poses are drawn.
pub struct Shapes {
    pub a: Particle,
    pub b: Particle,
    pub group: u64,
    pub family: usize,
}

/// One pair at its poses.
pub struct Case<'a> {
    pub shapes: &'a Shapes,
    pub at_a: Place,
    pub at_b: Place,
}

/// A generator of its own for each number drawn from a seed (splitmix, Steele et al. 2014).
pub fn stream(seed: u64, kind: u64, index: u64) -> Random {
    let mut state = seed ^ kind.wrapping_mul(0xD1B5_4A32_D192_ED03) ^ index.wrapping_mul(0x9E37_79B9_7F4A_7C15);
    for _ in 0..2 {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        state = (state ^ (state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        state = (state ^ (state >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        state ^= state >> 31;
    }
    Random::seeded(state | 1)
}

impl Shapes {
    /// The shapes of pair `index`.
    pub fn of(seed: u64, index: u64) -> Self {
        let (group, family) = (group_of(index), family_of(index));
        let mut random = stream(seed, 1, group);
        let draw = if is_flat(seed, 18, group) { in_plane } else { particle };
        let [mut a, mut b] = FAMILIES[family].recipes.each_ref().map(|recipe| draw(recipe, &mut random));
        // "Units": micrometres in kilometres to the other way round, the same for both.
        if FAMILIES[family].name == "units" {
            let unit = 10f64.powf(18.0 * random.uniform());
            [a, b] = [a, b].map(|particle| particle.scaled(unit).expect("a particle is one in any unit"));
        }
        if random.uniform() < 0.5 {
            std::mem::swap(&mut a, &mut b);
        }
        Self { a, b, group, family }
    }

    /// Those of a line, of no family.
    pub fn of_line(line: &Line) -> Self {
        Self { a: line.shape_a.particle(), b: line.shape_b.particle(), group: 0, family: 0 }
    }

    pub fn is_flat(&self) -> bool {
        self.a.is_in_plane()
    }
}

/// Whether the shapes of a group lie in the plane.
pub fn is_flat(seed: u64, kind: u64, group: u64) -> bool {
    stream(seed, kind, group).uniform() < 0.05
}

impl<'a> Case<'a> {
    /// Pair `index`; `shapes` must be its own.
    pub fn of(shapes: &'a Shapes, seed: u64, index: u64) -> Self {
        assert_eq!(shapes.group, group_of(index));
        let family = &FAMILIES[shapes.family];
        let mut random = stream(seed, 2, index);
        let flat = shapes.is_flat();
        let orientation_a = orientation(family.turned, flat, &mut random);
        let (relative, orientation_b) = place(shapes, family, &orientation_a, &mut random);
        let length = shapes.a.bounding_radius().max(shapes.b.bounding_radius());
        let origin = if family.far > 0.0 {
            length * 10f64.powf(family.far * random.uniform()) * random.direction_in(flat)
        } else if random.uniform() < 0.5 {
            length * random.direction_in(flat)
        } else {
            Vector3::zeros()
        };
        let mut at = |position: Vector3<f64>, orientation: [f64; 4]| {
            // Of every other turn in the plane the angle is given, now and then with many whole turns.
            let angle = (flat && random.uniform() < 0.5).then(|| {
                let turns = if random.uniform() < 0.2 { random.whole(0, 1_000_000) as f64 } else { 0.0 };
                2.0 * orientation[3].atan2(orientation[0]) + std::f64::consts::TAU * turns
            });
            Place { position: position.into(), orientation, angle }
        };
        Self { shapes, at_a: at(origin, orientation_a), at_b: at(origin + relative, orientation_b) }
    }

    /// The pair, for whoever solves it again.
    pub fn line(&self, what: String) -> Line {
        Line::of(&self.shapes.a, &self.at_a, &self.shapes.b, &self.at_b, what)
    }

    pub fn family(&self) -> &'static str {
        FAMILIES[self.shapes.family].name
    }
}

fn orientation(turned: Turned, flat: bool, random: &mut Random) -> [f64; 4] {
    if turned == Turned::Anyhow && random.uniform() > 0.1 {
        return random.turn_in(flat);
    }
    let exact = [
        [1.0, 0.0, 0.0, 0.0],
        [1.0, 1.0, 0.0, 0.0],
        [1.0, 0.0, 1.0, 0.0],
        [1.0, 0.0, 0.0, 1.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.5, 0.5, 0.5, 0.5],
        [1.0, 0.0, 0.0, 0.414_213_562_373_095_05],
    ][random.whole(0, 7)];
    let tilt = if random.uniform() < 0.5 { 0.0 } else { 10f64.powf(-17.0 + 16.0 * random.uniform()) };
    let [w, x, y, z] = exact.map(|c| c + tilt * random.normal());
    match flat {
        true if (w, z) == (0.0, 0.0) => [1.0, 0.0, 0.0, 0.0],
        true => [w, 0.0, 0.0, z],
        false => [w, x, y, z],
    }
}

fn turn([w, x, y, z]: [f64; 4]) -> UnitQuaternion<f64> {
    UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z))
}

/// Position of B relative to A, world axes, and orientation of B.
fn place(shapes: &Shapes, family: &Family, of_a: &[f64; 4], random: &mut Random) -> (Vector3<f64>, [f64; 4]) {
    let (a, b) = (&shapes.a, &shapes.b);
    let flat = shapes.is_flat();
    let small = a.bounding_radius().min(b.bounding_radius());
    let contact = match family.contact {
        Contact::Any => match random.whole(0, 10) {
            0 | 1 => Contact::Anywhere,
            2..=4 => Contact::Touching(-15.0, -6.0),
            5..=7 => Contact::Touching(-6.0, 0.0),
            8 => Contact::Edges,
            _ => [Contact::Coincident, Contact::Contained][random.whole(0, 2)],
        },
        Contact::Coincident => [Contact::Coincident, Contact::Contained][random.whole(0, 2)],
        contact => contact,
    };
    let free = orientation(family.turned, flat, random);
    let sign = |random: &mut Random| if random.uniform() < 0.7 { -1.0 } else { 1.0 };
    match contact {
        Contact::Coincident => {
            let off = if random.uniform() < 0.4 { 0.0 } else { small * 10f64.powf(-16.0 + 15.0 * random.uniform()) };
            (off * random.direction_in(flat), free)
        }
        Contact::Contained => {
            let way = random.direction_in(flat);
            let to = a.surface_distance(&Vector3::zeros(), &way).unwrap_or(0.0);
            (turn(*of_a) * (random.uniform() * to * way), free)
        }
        Contact::Touching(..) | Contact::Edges if family.turned == Turned::Anyhow || contact == Contact::Edges => {
            let edges = contact == Contact::Edges;
            let (low, high) = if let Contact::Touching(low, high) = contact { (low, high) } else { (-9.0, -0.5) };
            let ((on_a, out_a), (on_b, out_b)) = (touched(a, edges, random), touched(b, edges, random));
            let normal = turn(*of_a) * out_a;
            let about = |axis: Vector3<f64>, angle: f64| {
                UnitQuaternion::from_axis_angle(&nalgebra::Unit::new_normalize(axis), angle)
            };
            let spin = about(normal, if flat { 0.0 } else { std::f64::consts::TAU * random.uniform() });
            let first = UnitQuaternion::rotation_between(&out_b, &-normal).unwrap_or_else(|| {
                // Exactly opposite: half a turn about any axis at right angles.
                let across = if flat { Vector3::z() } else { normal.cross(&Vector3::ith(normal.iamin(), 1.0)) };
                about(across, std::f64::consts::PI)
            });
            let turned = spin * first;
            let apart = sign(random) * small * 10f64.powf(low + (high - low) * random.uniform());
            let relative = turn(*of_a) * on_a - turned * on_b + apart * normal;
            (relative, [turned.w, turned.i, turned.j, turned.k])
        }
        Contact::Touching(low, high) => {
            // Orientations are given: surface point on surface point, faces flush for boxes.
            let (on_a, out_a) = touched(a, false, random);
            let normal = turn(*of_a) * out_a;
            let back = turn(free).inverse() * -normal;
            let to = b.surface_distance(&Vector3::zeros(), &back).unwrap_or(0.0);
            let apart = sign(random) * small * 10f64.powf(low + (high - low) * random.uniform());
            let aside = small * random.uniform() * random.direction_in(flat);
            let relative = turn(*of_a) * on_a + (to + apart) * normal + (aside - aside.dot(&normal) * normal);
            (relative, free)
        }
        _ => ((a.bounding_radius() + b.bounding_radius()) * random.uniform() * random.direction_in(flat), free),
    }
}

/// A surface point and the outward normal there, local frame; next to corners and edges if wanted.
fn touched(particle: &Particle, edges: bool, random: &mut Random) -> (Vector3<f64>, Vector3<f64>) {
    let flat = particle.is_in_plane();
    let corners = particle.bounding_corners();
    let way = if edges && corners.len() > 1 {
        let corner = corners[random.whole(0, corners.len())];
        let other = corners[random.whole(0, corners.len())];
        let share = if random.uniform() < 0.5 { 0.0 } else { random.uniform() };
        corner + share * (other - corner)
    } else {
        match random.whole(0, 3) {
            // The normal of a face: exactly on the flat part of it.
            0 if particle.plane_count() > 0 => {
                particle.planes().nth(random.whole(0, particle.plane_count())).map_or(Vector3::x(), |p| p.normal)
            }
            _ => random.direction_in(flat),
        }
    };
    let way = way.try_normalize(0.0).unwrap_or_else(Vector3::x);
    let to = particle.surface_distance(&Vector3::zeros(), &way).unwrap_or(particle.bounding_radius());
    let point = to * way;
    let normal = particle.gradient(&point).try_normalize(0.0).unwrap_or(way);
    (point, normal)
}
