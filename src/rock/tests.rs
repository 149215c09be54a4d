//! Slicing against closed forms and counts.

use super::*;
use crate::particle::plane::Plane;
use crate::random::Random;
use nalgebra::Vector3;
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

/// Both sides of each joint have the same area, every block lies within its own planes, and its particle is as large
/// but for its edges.
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
            for corner in &block.corners {
                assert!(face.plane.normal.dot(corner) <= face.plane.offset + 1e-12);
            }
        }
    }
    assert!(areas.len() == 12 && areas.values().all(|sum: &f64| sum.abs() < 1e-12), "{areas:?}");
    let largest = mass.blocks.iter().max_by(|a, b| a.volume.total_cmp(&b.volume)).unwrap();
    let r = 1e-4 * largest.volume.cbrt();
    let limit = largest.faces.iter().map(|face| face.plane.offset - face.plane.normal.dot(&largest.centroid));
    let limit = limit.fold(f64::INFINITY, f64::min);
    let refusal = largest.particle(limit).unwrap_err();
    assert!(matches!(refusal, crate::ParticleError::RoundingTooLarge { limit: of, .. } if of == limit), "{refusal}");
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

/// Planes through one point, and copies of them that are off by less and less: every block has a volume, and together
/// they are the domain.
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
        assert_eq!([blocks(0.0999, 20.0), blocks(0.1001, 20.0), blocks(0.0, 10.01), blocks(0.0, 9.99)], [2, 1, 2, 1]);
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
        let mass = slice_with_regions(&domain, joints, std::slice::from_ref(&region), &settings, |_, _| true).unwrap();
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

/// A tunnel through a grid, and a second region across it: volumes by their closed forms, parents whole again, nothing
/// counted twice.
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
    // What is too small stays on the other side: the region takes the centimetre that it leaves, and no 2 cm beside a
    // joint are cut off.
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

/// A disc cuts the whole block, and its faces tell how much of them it is.
#[test]
fn faces_know_the_extent_of_their_joint() {
    let domain = cuboid([2.0, 2.0, 2.0], [5.0, 0.0, -3.0]);
    let centre = domain.iter().map(|plane| 0.5 * plane.offset * plane.normal).sum::<Vector3<f64>>();
    let disc = Joint::new(centre, 20.0, 70.0).unwrap().with_radius(0.5).unwrap();
    let mass = slice(&domain, &[disc], &SliceSettings::default()).unwrap();
    assert_eq!(mass.blocks.len(), 2);
    for block in &mass.blocks {
        for face in &block.faces {
            let expected = if face.of == FaceOf::Joint(0) { std::f64::consts::PI / 4.0 } else { 0.0 };
            assert!((face.jointed_area - expected).abs() < 1e-12 && face.area > 1.0);
        }
    }
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
    let joints = random_joints(4, 40, [0.0; 3], 0.2);
    let few = SliceSettings { most_blocks: 2000, ..none };
    let RockError::TooManyExpected { expected, most: 2000 } = error(&domain, &joints, &few) else { panic!("many") };
    assert!((expected / slice(&domain, &joints, &none).unwrap().blocks.len() as f64 - 1.0).abs() < 1e-12);
    // With a limit on size, the joint that makes one block too many is found by the counts, however many joints a round
    // has.
    let none = SliceSettings { least_volume: f64::MIN_POSITIVE, ..none };
    let count = |joints: &[Joint]| slice(&domain, joints, &none).unwrap().blocks.len();
    for most_blocks in [5, 100, 2000] {
        let joint = (0..40).find(|&joint| count(&joints[..=joint]) > most_blocks).unwrap();
        for threads in [1, 3] {
            let most = SliceSettings { most_blocks, threads, ..none };
            assert_eq!(error(&domain, &joints, &most), RockError::TooManyBlocks { joint, most: most_blocks });
        }
    }
}

#[test]
fn normals_have_any_length_and_domains_a_size_that_numbers_can_bear() {
    let joint = Joint::through([0.1, 0.0, 0.0], Vector3::new(1.0, 2.0, 0.5));
    let expected = slice(&cuboid([2.0; 3], [0.0; 3]), std::slice::from_ref(&joint), &SliceSettings::default()).unwrap();
    for length in [1e200, 1e-200, 3.0] {
        let longer = |plane: Plane| Plane { normal: length * plane.normal, offset: length * plane.offset };
        let domain: Vec<Plane> = cuboid([2.0; 3], [0.0; 3]).into_iter().map(longer).collect();
        let joint = Joint::through(joint.point, length * joint.normal);
        let found = slice(&domain, &[joint], &SliceSettings::default()).unwrap();
        assert_eq!(found.blocks.len(), 2);
        for (one, other) in found.blocks.iter().zip(&expected.blocks) {
            assert!((one.volume - other.volume).abs() < 1e-14);
        }
    }
    for size in [1e150, 1e51, 1e-51] {
        let error = slice(&cuboid([2.0 * size; 3], [0.0; 3]), &[], &SliceSettings::default()).unwrap_err().to_string();
        assert!(error.contains("half extent of the domain = 1") && error.len() < 100, "{error}");
    }
    let mass = slice(&cuboid([2e50; 3], [0.0; 3]), &[], &SliceSettings::default());
    assert!((mass.unwrap().blocks[0].inertia()[(0, 0)] / (16.0 / 3.0 * 1e250) - 1.0).abs() < 1e-9);
}
