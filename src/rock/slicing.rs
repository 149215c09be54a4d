//! A domain, cut by one joint after the other.

use crate::particle::plane::Plane;
use crate::particle::polyhedron::{OF_CUBE, Polyhedron};
use crate::rock::block::{Block, FaceOf};
use crate::rock::cutting::{CutOff, Cuts, Part, cut_in_order};
use crate::rock::error::{RockError, within};
use crate::rock::in_order::{found, mapped};
use crate::rock::joint::Joint;
use nalgebra::Vector3;

/// Least depth of a cut over the size of the domain: some rounding of corners.
const LEAST_CUT: f64 = 1e-13;

/// Half of the cube in which a domain is looked for, over the largest distance of its planes from the origin.
const FAR: f64 = 1e4;

/// Rounds of joints after which progress is told, and most joints of a round.
const ROUNDS: usize = 100;
const LONGEST_ROUND: usize = 32;

/// Limits of a rock mass, and on how many threads it is cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SliceSettings {
    /// A joint leaves a block whole if one of its parts would have less than this volume.
    pub least_volume: f64,
    /// Or be thinner than this in the mean, 2V/A of volume and surface: of a wide slab its thickness, of a cube a third of its edge.
    pub least_thickness: f64,
    /// Or if the largest ball in a part would have a smaller diameter than this, the paper's limit on size.
    pub least_width: f64,
    /// Or if its extent along x, y or z would be more than so many times that diameter.
    pub largest_aspect: f64,
    /// More blocks than this are an error.
    pub most_blocks: usize,
    /// How many threads cut, the calling one among them; 0 is 1. The blocks and their order are, to the last bit, the same for any number.
    pub threads: usize,
}

impl Default for SliceSettings {
    fn default() -> Self {
        Self {
            least_volume: 0.0,
            least_thickness: 0.0,
            least_width: 0.0,
            largest_aspect: f64::INFINITY,
            most_blocks: 1_000_000,
            threads: 1,
        }
    }
}

/// What a domain was cut into.
#[derive(Clone, Debug)]
pub struct RockMass {
    /// The blocks, whose volumes sum to that of the domain.
    pub blocks: Vec<Block>,
    /// Joints that cut no block.
    pub missing: Vec<usize>,
    /// How many cuts were left out because of the limits, or as a part would have been no thicker than the rounding of its corners.
    pub too_small: usize,
    /// How many blocks were left whole where the parts of a cut would not have closed, by rounding.
    pub unclosed: usize,
    /// How many of the joints have cut: all, unless it was ended before.
    pub joints: usize,
}

/// Cuts a convex domain {x : n_i·x ≤ d_i for all planes} by joints, in their order. A joint cuts each block that it meets in two; a disc or polygon
/// cuts all of a block that it reaches, as in the paper.
///
/// # Errors
/// A domain that is empty or open, a plane or joint without a normal or whose numbers are not finite, a limit that is none, more blocks
/// than allowed.
pub fn slice(domain: &[Plane], joints: &[Joint], settings: &SliceSettings) -> Result<RockMass, RockError> {
    slice_with_regions(domain, joints, &[], settings, |_, _| true)
}

/// The same with convex regions, which cut the blocks that they meet after all joints: a tunnel, a bench, or what a domain that is not
/// convex leaves out. A block is then cut plane by plane into what lies in the region, in the first one of several, and the parts beside
/// it, which keep its [`Block::parent`]. Parts smaller than the settings allow are not made: one in the region stays with what is beside it, one
/// beside it with what is in the region.
///
/// `progress` is called before each joint, or before every few of many, with the number of joints that have cut and of blocks that there are; where it
/// returns false, the joints that are left do not cut ([`RockMass::joints`]), and the regions still do.
///
/// # Errors
/// As of [`slice()`], and a plane of a region that is none.
pub fn slice_with_regions(
    domain: &[Plane],
    joints: &[Joint],
    regions: &[Vec<Plane>],
    settings: &SliceSettings,
    mut progress: impl FnMut(usize, usize) -> bool,
) -> Result<RockMass, RockError> {
    checked(settings)?;
    let outer = unit_planes(domain).map_err(RockError::NoPlane)?;
    let (origin, polyhedron) = enclosed(&outer)?;
    let planes = planes(&outer, joints, regions, &origin)?;
    let local = joints.iter().zip(&planes[domain.len()..]).map(|(joint, (_, n, _))| joint.about(&origin, *n)).collect();
    let cuts = Cuts::new(&polyhedron, &planes, local, domain.len(), settings);
    let mut parts = vec![Part::of(polyhedron)];
    let mut mass = RockMass { blocks: Vec::new(), missing: Vec::new(), too_small: 0, unclosed: 0, joints: 0 };
    while mass.joints < joints.len() && progress(mass.joints, parts.len()) {
        let round = mass.joints..(mass.joints + round(joints.len(), parts.len(), settings)).min(joints.len());
        let cut = found(settings.threads, &mut parts, |part| cut_in_order(part, &cuts, round.clone()));
        // By joints, what they cut off: the number of the part that was cut, that of the cut, the piece.
        let mut cut_off: Vec<Vec<(usize, usize, CutOff)>> = round.clone().map(|_| Vec::new()).collect();
        // Of each part that was cut, the places of its pieces among all parts: that of the first is known.
        let mut places: Vec<Vec<usize>> = Vec::new();
        for (place, pieces) in cut {
            mass.too_small += pieces.too_small;
            mass.unclosed += pieces.unclosed;
            if !pieces.cut_off.is_empty() {
                for (number, piece) in pieces.cut_off.into_iter().enumerate() {
                    cut_off[piece.joint - round.start].push((places.len(), number, piece));
                }
                places.push(vec![place]);
            }
        }
        // A joint goes through the blocks in their order and puts what it cuts off behind the last one.
        for (joint, mut of_joint) in round.clone().zip(cut_off) {
            of_joint.sort_by_key(|(whole, _, piece)| places[*whole][piece.from]);
            if of_joint.is_empty() {
                mass.missing.push(joint);
            }
            for (whole, number, piece) in of_joint {
                if parts.len() == settings.most_blocks {
                    return Err(RockError::TooManyBlocks { joint, most: settings.most_blocks });
                }
                let places = &mut places[whole];
                places.resize(places.len().max(number + 2), usize::MAX);
                places[number + 1] = parts.len();
                parts.push(piece.part);
            }
        }
        mass.joints = round.end;
    }
    parts.iter_mut().enumerate().for_each(|(i, part)| part.parent = i);
    let mut first = OF_CUBE + domain.len() + joints.len();
    for (i, region) in regions.iter().enumerate() {
        let range = first..first + region.len();
        parts = parts
            .into_iter()
            .flat_map(|part| match part.region {
                Some(_) => vec![part],
                None => parted(part, i, range.clone(), &cuts, &mut mass),
            })
            .collect();
        first += region.len();
    }
    mass.blocks = mapped(settings.threads, &mut parts, |part| Block {
        parent: part.parent,
        region: part.region,
        ..Block::of(&part.polyhedron, &origin, |number| planes[number - OF_CUBE])
    });
    Ok(mass)
}

fn checked(settings: &SliceSettings) -> Result<(), RockError> {
    within(settings.least_volume, settings.least_volume >= 0.0, "least_volume", "a volume of 0 or above")?;
    within(settings.least_thickness, settings.least_thickness >= 0.0, "least_thickness", "a length of 0 or above")?;
    within(settings.least_width, settings.least_width >= 0.0, "least_width", "a length of 0 or above")?;
    if !(settings.largest_aspect >= 1.0) {
        let value = settings.largest_aspect;
        return Err(RockError::OutOfRange { name: "largest_aspect", value, range: "1 or above" });
    }
    Ok(())
}

/// Joints of the next round: so few that, if each halved every block, not many more than the largest number of blocks would be made before that is seen.
fn round(joints: usize, parts: usize, settings: &SliceSettings) -> usize {
    let room = (4 * settings.most_blocks / parts).max(2).ilog2() as usize;
    (joints / ROUNDS).clamp(1, LONGEST_ROUND.min(room))
}

/// A part as what lies in a region, whose planes have the numbers `range`, and what lies beside it.
fn parted(part: Part, region: usize, range: std::ops::Range<usize>, cuts: &Cuts<'_>, mass: &mut RockMass) -> Vec<Part> {
    let Part { middle, radius, parent, .. } = part;
    if range.clone().any(|number| cuts.height(number, &middle) >= radius) {
        return vec![part];
    }
    let (mut inside, mut beside) = (part.polyhedron.clone(), Vec::new());
    for number in range {
        let (n, height) = cuts.plane(number);
        if inside.is_crossed(&n, height) {
            let Some([below, beyond]) = inside.split(number, &n, height) else {
                mass.unclosed += 1;
                return vec![part];
            };
            if cuts.is_too_small(&below) {
                mass.too_small += 1;
                return vec![part];
            }
            if cuts.is_too_small(&beyond) {
                mass.too_small += 1;
                continue;
            }
            beside.push(Part { parent, ..Part::of(beyond) });
            inside = below;
        } else if n.dot(&inside.middle()) > height {
            return vec![part];
        }
    }
    beside.push(Part { parent, region: Some(region), ..Part::of(inside) });
    beside
}

/// What each face comes from, with unit normal and height above the origin of the polyhedra, in the order of their numbers.
fn planes(
    outer: &[(Vector3<f64>, f64)],
    joints: &[Joint],
    regions: &[Vec<Plane>],
    origin: &Vector3<f64>,
) -> Result<Vec<(FaceOf, Vector3<f64>, f64)>, RockError> {
    let about = |of: FaceOf, (n, d): (Vector3<f64>, f64)| (of, n, d - n.dot(origin));
    let mut planes: Vec<_> = outer.iter().enumerate().map(|(i, plane)| about(FaceOf::Domain(i), *plane)).collect();
    for (i, joint) in joints.iter().enumerate() {
        let n = joint.normal.normalize();
        let height = n.dot(&(joint.point - origin));
        if !(height.is_finite() && joint.radius > 0.0) {
            return Err(RockError::NoJoint(i));
        }
        planes.push((FaceOf::Joint(i), n, height));
    }
    for (region, given) in regions.iter().enumerate() {
        let given = unit_planes(given).map_err(|plane| RockError::NoRegion { region, plane })?;
        planes.extend(given.into_iter().enumerate().map(|(plane, of)| about(FaceOf::Region { region, plane }, of)));
    }
    Ok(planes)
}

/// Unit normals and distances from the origin; the index of a plane that is none.
fn unit_planes(planes: &[Plane]) -> Result<Vec<(Vector3<f64>, f64)>, usize> {
    let unit = |(i, plane): (usize, &Plane)| {
        let length = plane.normal.norm();
        let is_plane = length > 0.0 && length.is_finite() && plane.offset.is_finite();
        is_plane.then(|| (plane.normal / length, plane.offset / length)).ok_or(i)
    };
    planes.iter().enumerate().map(unit).collect()
}

/// What planes enclose, about an origin in its middle: twice, as corners that are cut from a cube far away are known less well.
fn enclosed(planes: &[(Vector3<f64>, f64)]) -> Result<(Vector3<f64>, Polyhedron), RockError> {
    let farthest = planes.iter().map(|(_, d)| d.abs()).fold(0.0, f64::max);
    let (mut origin, mut half) = (Vector3::zeros(), FAR * farthest);
    for _ in 0..3 {
        let mut polyhedron = Polyhedron::cube(half, LEAST_CUT * half);
        for (i, (n, d)) in planes.iter().enumerate() {
            let height = d - n.dot(&origin);
            let lowest = polyhedron.corners().map(|at| n.dot(at)).fold(f64::INFINITY, f64::min);
            if !(lowest < height - LEAST_CUT * half) {
                return Err(RockError::Empty);
            }
            polyhedron.cut(OF_CUBE + i, n, height);
        }
        let is_open = polyhedron.faces().iter().any(|face| face.number < OF_CUBE);
        if is_open {
            return Err(RockError::Open);
        }
        let [low, high] = polyhedron.extremes();
        let extent = 0.5 * (high - low).max();
        if half <= 4.0 * extent {
            return Ok((origin, polyhedron));
        }
        origin += 0.5 * (low + high);
        half = 2.0 * extent;
    }
    Err(RockError::Empty)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;
    use std::collections::HashMap;

    fn cuboid(sides: [f64; 3], at: [f64; 3]) -> Vec<Plane> {
        let face = |axis: usize, sign: f64| {
            let normal = Vector3::ith(axis, sign);
            Plane { normal, offset: 0.5 * sides[axis] + sign * at[axis] }
        };
        (0..3).flat_map(|axis| [face(axis, 1.0), face(axis, -1.0)]).collect()
    }

    fn random_joints(seed: u64, count: usize, at: [f64; 3], reach: f64) -> Vec<Joint> {
        let mut random = Random::new(seed, 0);
        let joint = |_| {
            let point = Vector3::from(at) + Vector3::from_fn(|_, _| random.between(-reach, reach));
            Joint::through(point, random.direction())
        };
        (0..count).map(joint).collect()
    }

    fn volume(mass: &RockMass) -> f64 {
        mass.blocks.iter().map(|block| block.volume).sum()
    }

    /// Planes, lines of two of them and points of three inside of a convex domain, by the corners of these alone.
    fn regions(domain: &[Plane], joints: &[Joint]) -> usize {
        let inside = |x: &Vector3<f64>| domain.iter().all(|plane| plane.normal.dot(x) < plane.offset);
        let height = |i: usize| joints[i].normal.dot(&joints[i].point);
        let count = joints.len();
        let crosses = |line: (Vector3<f64>, Vector3<f64>)| {
            let (mut from, mut to) = (f64::NEG_INFINITY, f64::INFINITY);
            for plane in domain {
                let (slope, left) = (plane.normal.dot(&line.1), plane.offset - plane.normal.dot(&line.0));
                if slope > 0.0 { to = to.min(left / slope) } else { from = from.max(left / slope) }
            }
            from < to
        };
        let mut regions = 1;
        for i in 0..count {
            // A plane crosses a convex body if it does so on an edge of the box.
            let sides = (0..8).map(|k| {
                Vector3::from_fn(|axis, _| {
                    let [high, low] = [domain[2 * axis].offset, -domain[2 * axis + 1].offset];
                    if k >> axis & 1 == 0 { high } else { low }
                })
            });
            let above = sides.filter(|x| joints[i].normal.dot(x) > height(i)).count();
            regions += usize::from(above > 0 && above < 8);
            for j in 0..i {
                let along = joints[i].normal.cross(&joints[j].normal);
                let solve = |n: Vector3<f64>, d: f64| {
                    let [a, b] = [joints[i].normal, joints[j].normal];
                    (height(i) * b.cross(&n) + height(j) * n.cross(&a) + d * a.cross(&b)) / a.dot(&b.cross(&n))
                };
                regions += usize::from(crosses((solve(along, 0.0), along)));
                regions += (0..j).filter(|&k| inside(&solve(joints[k].normal, height(k)))).count();
            }
        }
        regions
    }

    #[test]
    fn planes_in_general_position_make_as_many_blocks_as_they_must() {
        for (seed, at) in [(1, [0.0; 3]), (2, [1e3, -2e3, 5e2]), (3, [0.3, 0.1, -7.0])] {
            let (sides, count) = ([2.0, 1.5, 1.0], 25);
            let (domain, joints) = (cuboid(sides, at), random_joints(seed, count, at, 0.6));
            let mass = slice(&domain, &joints, &SliceSettings::default()).unwrap();
            assert_eq!((mass.blocks.len(), mass.unclosed), (regions(&domain, &joints), 0), "seed {seed}");
            assert!((volume(&mass) / 3.0 - 1.0).abs() < 1e-12, "{:e}", volume(&mass) / 3.0 - 1.0);
            let first: Vector3<f64> = mass.blocks.iter().map(|b| b.volume * (b.centroid - Vector3::from(at))).sum();
            assert!(first.norm() < 1e-11, "{first}");
        }
    }

    /// Both sides of each joint have the same area, every block lies within its own planes, and its particle is as large but for its edges.
    #[test]
    fn faces_agree_with_their_partners_and_blocks_with_their_planes() {
        let domain = cuboid([3.0, 3.0, 3.0], [0.0; 3]);
        let mass = slice(&domain, &random_joints(9, 12, [0.0; 3], 1.0), &SliceSettings::default()).unwrap();
        let mut areas = HashMap::new();
        for block in &mass.blocks {
            for face in &block.faces {
                if let FaceOf::Joint(i) = face.of {
                    let x = face.plane.normal;
                    *areas.entry(i).or_insert(0.0) += face.area * if x.z > 0.0 { 1.0 } else { -1.0 };
                }
                for corner in block.faces.iter().flat_map(|other| &other.corners) {
                    assert!(face.plane.normal.dot(corner) <= face.plane.offset + 1e-12);
                }
            }
        }
        assert!(areas.len() == 12 && areas.values().all(|sum: &f64| sum.abs() < 1e-12), "{areas:?}");
        let largest = mass.blocks.iter().max_by(|a, b| a.volume.total_cmp(&b.volume)).unwrap();
        let r = 1e-4 * largest.volume.cbrt();
        let of_particle = largest.particle(r).unwrap().mass_properties(1e-6).unwrap().volume;
        assert!(of_particle <= largest.volume * (1.0 + 1e-6) && of_particle > (1.0 - 1e-3) * largest.volume);
    }

    /// Three sets of equal spacings: as many blocks as there are cells, whatever planes coincide with sides of the domain.
    #[test]
    fn sets_through_lines_and_corners_make_a_grid() {
        let domain = cuboid([2.0, 2.0, 2.0], [0.0; 3]);
        let joint = |axis: usize, place: f64| Joint::through(Vector3::ith(axis, place), Vector3::ith(axis, 1.0));
        let joints: Vec<_> = (0..3).flat_map(|axis| (-4..=4).map(move |i| joint(axis, 0.25 * f64::from(i)))).collect();
        let mass = slice(&domain, &joints, &SliceSettings::default()).unwrap();
        assert_eq!((mass.blocks.len(), mass.missing.len()), (512, 6));
        assert!(mass.blocks.iter().all(|block| (block.volume - 0.015625).abs() < 1e-15 && block.faces.len() == 6));
        // All planes through the long diagonal: wedges.
        let diagonal = Vector3::new(1.0, 1.0, 1.0).normalize();
        let u = diagonal.cross(&Vector3::x()).normalize();
        let fan = (0..10).map(|i| {
            let (sin, cos) = (0.3 * f64::from(i) + 0.1).sin_cos();
            Joint::through([0.0; 3], cos * u + sin * diagonal.cross(&u))
        });
        let mass = slice(&domain, &fan.collect::<Vec<_>>(), &SliceSettings::default()).unwrap();
        assert!(mass.blocks.len() == 20 && (volume(&mass) - 8.0).abs() < 1e-12, "{}", mass.blocks.len());
    }

    /// Planes through one point, and copies of them that are off by less and less: no block is of no volume, and together they are the domain.
    #[test]
    fn planes_that_all_but_coincide_lose_no_volume() {
        for seed in 0..30 {
            let at = [[0.0; 3], [4e5, -3e5, 1e3]][seed as usize % 2];
            let mut random = Random::new(seed, 1);
            let mut joints = random_joints(seed, 8, at, 0.0);
            for off in [1e-3, 1e-6, 1e-9, 1e-12, 1e-15] {
                let Joint { point, normal, .. } = joints[random.below(8)].clone();
                let normal = (normal + off * random.direction()).normalize();
                joints.push(Joint::through(point + off * random.direction(), normal));
            }
            let mass = slice(&cuboid([1.0, 2.0, 3.0], at), &joints, &SliceSettings::default()).unwrap();
            assert!((volume(&mass) / 6.0 - 1.0).abs() < 1e-12, "seed {seed}: {:e}", volume(&mass) / 6.0 - 1.0);
            assert!(mass.blocks.iter().all(|block| block.volume > 0.0), "seed {seed}");
            assert!(mass.unclosed <= 2, "seed {seed}: {}", mass.unclosed);
        }
    }

    #[test]
    fn discs_cut_what_they_reach_and_small_parts_are_left_out() {
        let domain = cuboid([4.0, 1.0, 1.0], [0.0; 3]);
        let across = Joint::through([0.0; 3], Vector3::x());
        // In the left half only.
        let disc = Joint::through([-1.0, 0.0, 0.1], Vector3::z()).with_radius(0.9).unwrap();
        let joints = [across, disc];
        let mass = slice(&domain, &joints, &SliceSettings::default()).unwrap();
        assert_eq!(mass.blocks.len(), 3);
        let least = SliceSettings { least_volume: 0.9, ..SliceSettings::default() };
        let mass = slice(&domain, &joints, &least).unwrap();
        assert_eq!((mass.blocks.len(), mass.too_small, mass.missing), (2, 1, vec![1]));
    }

    /// The rectangle cuts the left half, a triangle beside the domain cuts nothing although a disc about it would.
    #[test]
    fn polygons_cut_what_they_reach() {
        let domain = cuboid([4.0, 1.0, 1.0], [0.0; 3]);
        let rectangle = [[-1.9, -0.4, 0.1], [-0.1, -0.4, 0.1], [-0.1, 0.4, 0.1], [-1.9, 0.4, 0.1]];
        let triangle = [[0.1, 0.6, 0.2], [3.0, 0.6, 0.2], [1.5, 5.0, 0.2]];
        let joints = [
            Joint::through([0.0; 3], Vector3::x()),
            Joint::polygon(&rectangle).unwrap(),
            Joint::polygon(&triangle).unwrap(),
        ];
        let mass = slice(&domain, &joints, &SliceSettings::default()).unwrap();
        assert_eq!((mass.blocks.len(), mass.missing.clone()), (3, vec![2]));
        let far: Vec<_> = joints.iter().map(|joint| joint.about(&Vector3::new(-3e3, 5e3, 1e3), joint.normal)).collect();
        let moved = slice(&cuboid([4.0, 1.0, 1.0], [3e3, -5e3, -1e3]), &far, &SliceSettings::default()).unwrap();
        assert_eq!((moved.blocks.len(), moved.missing), (3, vec![2]));
    }

    /// The largest ball in a slab c of a unit cube has the diameter c; its extent is 1.
    #[test]
    fn narrow_and_long_parts_are_left_out() {
        for at in [0.0, 1e4] {
            let domain = cuboid([1.0, 1.0, 1.0], [at; 3]);
            let joint = Joint::through([at, at, at + 0.4], Vector3::z());
            let blocks = |least_width, largest_aspect| {
                let settings = SliceSettings { least_width, largest_aspect, ..SliceSettings::default() };
                slice(&domain, std::slice::from_ref(&joint), &settings).unwrap().blocks.len()
            };
            assert_eq!(
                [blocks(0.0999, 20.0), blocks(0.1001, 20.0), blocks(0.0, 10.01), blocks(0.0, 9.99)],
                [2, 1, 2, 1]
            );
        }
    }

    /// Blocks, their order and what is counted do not depend on the number of threads or on the rounds of joints.
    #[test]
    fn threads_change_nothing() {
        let domain = cuboid([3.0, 2.0, 2.0], [0.0; 3]);
        let mut joints = random_joints(12, 60, [0.0; 3], 1.0);
        joints.iter_mut().step_by(4).for_each(|joint| joint.radius = 0.5);
        joints.push(Joint::through([9.0; 3], Vector3::x()));
        let region = cuboid([0.7, 5.0, 0.7], [0.1; 3]);
        let cut = |threads, joints: &[Joint]| {
            let settings = SliceSettings { threads, least_volume: 1e-5, ..SliceSettings::default() };
            let mass =
                slice_with_regions(&domain, joints, std::slice::from_ref(&region), &settings, |_, _| true).unwrap();
            assert!(mass.blocks.len() > 1000 && mass.too_small > 0 && mass.missing.contains(&60));
            format!("{mass:?}")
        };
        assert!(cut(1, &joints) == cut(2, &joints) && cut(1, &joints) == cut(7, &joints));
        // Joints that come after and miss make rounds of many joints of what was rounds of one.
        let longer: Vec<Joint> = joints.iter().cloned().chain(vec![joints[60].clone(); 2000]).collect();
        let of = |text: &str| text[..text.find("missing").unwrap()].to_owned();
        assert!(of(&cut(1, &joints)) == of(&cut(3, &longer)));
    }

    /// Of a cuboid a × b × c: 2V/A = abc/(ab + bc + ca).
    #[test]
    fn flat_parts_are_left_out() {
        let domain = cuboid([1.0, 1.0, 1.0], [0.0; 3]);
        let at = |z: f64| Joint::through([0.0, 0.0, z], Vector3::z());
        let thickness = |c: f64| c / (1.0 + 2.0 * c);
        for (least, blocks) in [(thickness(0.1) * 0.999, 2), (thickness(0.1) * 1.001, 1)] {
            let settings = SliceSettings { least_thickness: least, ..SliceSettings::default() };
            let mass = slice(&domain, &[at(0.4)], &settings).unwrap();
            assert_eq!((mass.blocks.len(), mass.too_small), (blocks, 2 - blocks));
        }
    }

    /// A tunnel through a grid, and a second region across it: volumes by their closed forms, parents whole again, nothing counted twice.
    #[test]
    fn regions_part_the_blocks_that_they_meet() {
        let domain = cuboid([4.0, 4.0, 4.0], [0.0; 3]);
        let joint = |axis: usize| Joint::through([0.0; 3], Vector3::ith(axis, 1.0));
        let tunnel = cuboid([1.0, 9.0, 1.0], [0.3, 0.0, 0.2]);
        let shaft = cuboid([0.5, 0.5, 9.0], [0.3, 0.0, 0.0]);
        let joints = [joint(0), joint(1), joint(2)];
        let settings = SliceSettings::default();
        let mass = slice_with_regions(&domain, &joints, &[tunnel, shaft], &settings, |_, _| true).unwrap();
        let of = |region: Option<usize>| mass.blocks.iter().filter(move |block| block.region == region);
        let sum = |region| of(region).map(|block| block.volume).sum::<f64>();
        assert!((sum(Some(0)) - 4.0).abs() < 1e-13 && (sum(Some(1)) - 0.25 * 3.0).abs() < 1e-13);
        assert!((volume(&mass) - 64.0).abs() < 1e-12 && of(None).all(|block| block.volume > 0.0));
        for parent in 0..8 {
            let pieces = mass.blocks.iter().filter(|block| block.parent == parent);
            assert!((pieces.map(|block| block.volume).sum::<f64>() - 8.0).abs() < 1e-13);
        }
        // What is too small stays on the other side: the region takes the centimetre that it leaves, and no 2 cm beside a joint are cut off.
        let (narrow, least) =
            (cuboid([1.99, 9.0, 9.0], [1.005, 0.0, 0.0]), SliceSettings { least_thickness: 0.03, ..settings });
        let wide = slice_with_regions(&domain, &joints[..1], &[narrow], &least, |_, _| true).unwrap();
        assert_eq!((wide.blocks.len(), wide.too_small), (2, 1));
        assert!((wide.blocks.iter().find(|block| block.region == Some(0)).unwrap().volume - 32.0).abs() < 1e-13);
        let left = cuboid([0.02, 9.0, 9.0], [-0.01, 0.0, 0.0]);
        let whole = slice_with_regions(&domain, &joints[..1], &[left], &least, |_, _| true).unwrap();
        assert!(whole.blocks.len() == 2 && whole.blocks.iter().all(|block| block.region.is_none()));
        // A region that holds everything, and one that misses it.
        let (all, none) = (cuboid([9.0; 3], [0.0; 3]), cuboid([1.0; 3], [7.0, 0.0, 0.0]));
        let mass = slice_with_regions(&domain, &joints, &[none, all], &settings, |_, _| true).unwrap();
        assert!(mass.blocks.len() == 8 && mass.blocks.iter().all(|block| block.region == Some(1)));
        let bad = vec![Plane { normal: Vector3::zeros(), offset: 1.0 }];
        let error = slice_with_regions(&domain, &joints, &[bad], &settings, |_, _| true).unwrap_err();
        assert_eq!(error, RockError::NoRegion { region: 0, plane: 0 });
    }

    #[test]
    fn what_is_ended_keeps_what_was_cut() {
        let domain = cuboid([1.0, 1.0, 1.0], [0.0; 3]);
        let joints = random_joints(3, 10, [0.0; 3], 0.1);
        let mass = slice_with_regions(&domain, &joints, &[], &SliceSettings::default(), |done, _| done < 4).unwrap();
        let four = slice(&domain, &joints[..4], &SliceSettings::default()).unwrap();
        assert_eq!((mass.joints, mass.blocks.len()), (4, four.blocks.len()));
        assert!((volume(&mass) - 1.0).abs() < 1e-13);
    }

    /// Against the closed form of a cuboid, far from the origin, and that of a tetrahedron with three edges along the axes.
    #[test]
    fn inertia_is_that_of_closed_forms() {
        let mass = slice(&cuboid([1.0, 2.0, 3.0], [1e3, 0.0, -5.0]), &[], &SliceSettings::default()).unwrap();
        let inertia = mass.blocks[0].inertia();
        let expected = Vector3::new(4.0 + 9.0, 1.0 + 9.0, 1.0 + 4.0) * 0.5;
        assert!((inertia.diagonal() - expected).norm() < 1e-9 && (inertia.trace() - inertia.sum()).abs() < 1e-9);
        let planes = [[-1.0, 0.0, 0.0, 0.0], [0.0, -1.0, 0.0, 0.0], [0.0, 0.0, -1.0, 0.0], [1.0, 1.0, 1.0, 1.0]];
        let mass = slice(&planes.map(Plane::from), &[], &SliceSettings::default()).unwrap();
        let inertia = mass.blocks[0].inertia();
        // ∫ x² = 1/60 and ∫ xy = 1/120 about the right angle; less 1/6 · (1/4)² by Steiner.
        let (square, product) = (1.0 / 60.0 - 1.0 / 96.0, 1.0 / 120.0 - 1.0 / 96.0);
        assert!((inertia[(0, 0)] - 2.0 * square).abs() < 1e-15 && (inertia[(0, 1)] + product).abs() < 1e-15);
    }

    #[test]
    fn bad_domains_are_told() {
        let (domain, none) = (cuboid([1.0, 1.0, 1.0], [0.0; 3]), SliceSettings::default());
        let error =
            |planes: &[Plane], joints: &[Joint], settings: &SliceSettings| slice(planes, joints, settings).unwrap_err();
        assert_eq!(error(&domain[..5], &[], &none), RockError::Open);
        assert_eq!(error(&[], &[], &none), RockError::Open);
        let mut turned = domain.clone();
        turned[0].offset = -3.0;
        assert_eq!(error(&turned, &[], &none), RockError::Empty);
        turned[0].normal = Vector3::zeros();
        assert_eq!(error(&turned, &[], &none), RockError::NoPlane(0));
        let least = SliceSettings { least_volume: f64::NAN, ..none };
        assert!(error(&domain, &[], &least).to_string().contains("least_volume = NaN must be"));
        let most = SliceSettings { most_blocks: 5, ..none };
        let joints = random_joints(4, 9, [0.0; 3], 0.2);
        assert!(matches!(error(&domain, &joints, &most), RockError::TooManyBlocks { most: 5, .. }));
    }
}
