//! Which faces lie on each other.

use super::numbers::{ONE_PLANE, SHORT};
use crate::rock::block::FaceOf;
use crate::rock::polygon::{axes_across, clip};
use crate::rock::slicing::RockMass;
use nalgebra::{Vector2, Vector3};
use std::collections::BTreeMap;

/// Two faces that lie on each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Partners {
    /// Each by the index of its block, and its own among the faces of that block.
    pub faces: [[usize; 2]; 2],
    /// Area that they share.
    pub area: f64,
}

/// The polygon that two faces share.
#[derive(Clone, Debug, PartialEq)]
pub struct Interface {
    /// Each by the index of its block, and its own among the faces of that block.
    pub faces: [[usize; 2]; 2],
    /// Its area.
    pub area: f64,
    /// Its corners, counter-clockwise about the normal of the first face, axes and origin of the domain.
    pub corners: Vec<Vector3<f64>>,
}

/// A face in its plane, from the left to the right, without sides too short to have a direction.
struct Outline {
    at: [usize; 2],
    area: f64,
    low: Vector2<f64>,
    high: Vector2<f64>,
    corners: Vec<Vector2<f64>>,
}

impl RockMass {
    /// All pairs of faces that lie on each other, in the order of joints and regions. Where one side of a joint was
    /// cut further than the other, a face
    /// has several partners; the areas that it shares sum to its own.
    pub fn partners(&self) -> Vec<Partners> {
        let pair = |Interface { faces, area, .. }| Partners { faces, area };
        self.interfaces().into_iter().map(pair).collect()
    }

    /// The same with the polygons that they share.
    pub fn interfaces(&self) -> Vec<Interface> {
        let mut planes: BTreeMap<[usize; 3], Vec<[usize; 2]>> = BTreeMap::new();
        for (i, block) in self.blocks.iter().enumerate() {
            for (j, face) in block.faces.iter().enumerate() {
                let key = match face.of {
                    FaceOf::Domain(_) => continue,
                    FaceOf::Joint(joint) => [0, joint, 0],
                    FaceOf::Region { region, plane } => [1, region, plane],
                };
                planes.entry(key).or_default().push([i, j]);
            }
        }
        planes.values().flat_map(|faces| self.in_plane(faces)).collect()
    }

    fn corners(&self, [i, j]: [usize; 2]) -> &[Vector3<f64>] {
        let block = &self.blocks[i];
        block.corners_of(&block.faces[j])
    }

    /// Those among the faces of one plane.
    fn in_plane(&self, faces: &[[usize; 2]]) -> Vec<Interface> {
        let face = |[i, j]: [usize; 2]| &self.blocks[i].faces[j];
        let (normal, origin) = (face(faces[0]).plane.normal, self.corners(faces[0])[0]);
        let [u, v] = axes_across(&normal);
        let outline = |&at: &[usize; 2]| {
            let place = |x: &Vector3<f64>| Vector2::new(u.dot(&(x - origin)), v.dot(&(x - origin)));
            let mut corners: Vec<_> = self.corners(at).iter().map(place).collect();
            let [low, high] = [f64::min, f64::max].map(|of| corners.iter().fold(corners[0], |a, b| a.zip_map(b, of)));
            let (size, area) = ((high - low).norm(), face(at).area);
            corners.dedup_by(|next, last| (*next - *last).norm() <= SHORT * size);
            if corners.len() > 1 && (corners[0] - corners[corners.len() - 1]).norm() <= SHORT * size {
                corners.pop();
            }
            // A face without width lies on nothing.
            (corners.len() > 2 && area > SHORT * size * size).then_some(Outline { at, area, low, high, corners })
        };
        let is_below = |at: &&[usize; 2]| face(**at).plane.normal.dot(&normal) > 0.0;
        let below: Vec<Outline> = faces.iter().filter(is_below).filter_map(outline).collect();
        let mut beyond: Vec<Outline> = faces.iter().filter(|at| !is_below(at)).filter_map(outline).collect();
        beyond.sort_by(|a, b| a.low.x.total_cmp(&b.low.x));
        let widest = beyond.iter().map(|one| one.high.x - one.low.x).fold(0.0, f64::max);
        let mut found = Vec::new();
        for one in &below {
            let begin = beyond.partition_point(|other| other.low.x < one.low.x - widest);
            for other in beyond[begin..].iter().take_while(|other| other.low.x < one.high.x) {
                if other.high.x <= one.low.x || other.high.y <= one.low.y || other.low.y >= one.high.y {
                    continue;
                }
                let polygon = shared(&one.corners, &other.corners);
                let area = area_of(&polygon);
                if area > ONE_PLANE * one.area.min(other.area) {
                    let corners = polygon.iter().map(|at| origin + u * at.x + v * at.y).collect();
                    found.push(Interface { faces: [one.at, other.at], area, corners });
                }
            }
        }
        found
    }
}

/// What two convex polygons share: the first counter-clockwise, the second clockwise, as they are seen from its other
/// side.
fn shared(first: &[Vector2<f64>], second: &[Vector2<f64>]) -> Vec<Vector2<f64>> {
    let mut left: Vec<Vector2<f64>> = first.to_vec();
    for (i, from) in second.iter().enumerate() {
        let along = second[(i + 1) % second.len()] - from;
        clip(&mut left, |x| (x - from).perp(&along));
        if left.len() < 3 {
            return Vec::new();
        }
    }
    left
}

fn area_of(polygon: &[Vector2<f64>]) -> f64 {
    let Some(first) = polygon.first() else { return 0.0 };
    0.5 * polygon[1..].windows(2).map(|pair| (pair[0] - first).perp(&(pair[1] - first))).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particle::plane::Plane;
    use crate::random::Random;
    use crate::rock::joint::Joint;
    use crate::rock::settings::SliceSettings;
    use crate::rock::slicing::{slice, slice_with_regions};

    fn cube(half: f64, at: f64) -> Vec<Plane> {
        let side =
            |i: usize| Plane { normal: Vector3::ith(i / 2, [1.0, -1.0][i % 2]), offset: half + [at, -at][i % 2] };
        (0..6).map(side).collect()
    }

    /// Joints without end, discs that leave steps, and a region: the areas that a face shares with others sum to its
    /// own.
    #[test]
    fn areas_shared_are_those_of_the_faces() {
        for seed in 0..6 {
            let mut random = Random::new(seed, 0);
            let at = [0.0, 1e4][seed as usize % 2];
            let mut joint = |radius| {
                let point = Vector3::from_fn(|_, _| at + random.between(-0.7, 0.7));
                Joint { point, normal: random.direction(), radius, outline: None }
            };
            let joints: Vec<Joint> = (0..30).map(|i| joint(if i % 3 == 0 { 0.4 } else { f64::INFINITY })).collect();
            let settings = SliceSettings { least_volume: 1e-5, ..SliceSettings::default() };
            let mass = slice_with_regions(&cube(1.0, at), &joints, &[cube(0.3, at)], &settings, |_, _| true).unwrap();
            areas_sum(&mass, 500);
        }
    }

    /// Sets of joints as they come, with one of each through the middle of the domain: faces have sides of no length
    /// there, and some no width.
    #[test]
    fn areas_shared_are_those_of_the_faces_where_many_planes_meet() {
        for seed in 0..40 {
            let mut random = Random::new(seed, 1);
            let normals: Vec<Vector3<f64>> = (0..4).map(|_| random.direction()).collect();
            let joints: Vec<Joint> = (-1..2)
                .flat_map(|step| normals.iter().map(move |n| (0.4 * f64::from(step) * n, *n)))
                .map(|(point, normal)| Joint { point, normal, radius: f64::INFINITY, outline: None })
                .collect();
            let mass = slice(&cube(1.0, 0.0), &joints, &SliceSettings::default()).unwrap();
            areas_sum(&mass, 100);
        }
    }

    /// The areas that each face shares sum to its own.
    fn areas_sum(mass: &RockMass, least: usize) {
        let partners = mass.partners();
        for (pair, interface) in partners.iter().zip(mass.interfaces()) {
            let [i, j] = pair.faces[0];
            let plane = mass.blocks[i].faces[j].plane;
            let corners = &interface.corners;
            let beyond = |at: &Vector3<f64>| (plane.normal.dot(at) - plane.offset).abs();
            assert!(corners.iter().all(|at| beyond(at) < 1e-11 * at.norm().max(1.0)), "a corner lies off its plane");
            let doubled: Vector3<f64> =
                corners.windows(2).map(|two| (two[0] - corners[0]).cross(&(two[1] - corners[0]))).sum();
            let area = 0.5 * doubled.dot(&plane.normal);
            assert!((area - pair.area).abs() <= 1e-9 * pair.area + 1e-11, "{area} {}", pair.area);
        }
        let mut left: BTreeMap<[usize; 2], f64> = BTreeMap::new();
        for pair in &partners {
            let [below, beyond] = pair.faces.map(|[i, j]| &mass.blocks[i].faces[j]);
            assert!(below.of == beyond.of && below.plane.normal.dot(&beyond.plane.normal) < -0.999);
            pair.faces.iter().for_each(|face| *left.entry(*face).or_default() += pair.area);
        }
        let mut faces = 0;
        for (i, block) in mass.blocks.iter().enumerate() {
            for (j, face) in block.faces.iter().enumerate() {
                if matches!(face.of, FaceOf::Domain(_)) {
                    continue;
                }
                let sum = left.get(&[i, j]).copied().unwrap_or(0.0);
                faces += 1;
                assert!((sum - face.area).abs() < 1e-9 * face.area + 1e-11, "{sum} of {} of {:?}", face.area, face.of);
            }
        }
        assert!(faces > least && 3 * partners.len() > faces, "{faces} faces, {} partners", partners.len());
    }

    /// A disc parts the left half only, so that the face of the right one lies on two.
    #[test]
    fn a_face_may_have_several_partners() {
        let joint = |normal, radius| Joint { point: Vector3::new(-0.5, 0.0, 0.0), normal, radius, outline: None };
        let across = Joint { point: Vector3::zeros(), ..joint(Vector3::x(), f64::INFINITY) };
        let mass = slice(&cube(1.0, 0.0), &[across, joint(Vector3::z(), 0.1)], &SliceSettings::default()).unwrap();
        let partners = mass.partners();
        assert_eq!((mass.blocks.len(), partners.len()), (3, 3));
        let mut areas: Vec<f64> = partners.iter().map(|pair| pair.area).collect();
        areas.sort_by(f64::total_cmp);
        assert!(areas.iter().zip([2.0, 2.0, 2.0]).all(|(a, b)| (a - b).abs() < 1e-12), "{areas:?}");
    }
}
