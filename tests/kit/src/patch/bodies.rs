//! Random bodies of every kind, pairs of them at a stated overlap, and what else tests and benchmark of patches share.

use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};
use potential_particles::{Contact, Kind, Particle, Plane, Pose, Settings, detect};
use std::f64::consts::TAU;

/// Numbers that look like chance: the same in every run.
pub struct Chance(u64);

impl Chance {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(0x1234_5678_9abc_def1))
    }

    /// In [0, 1).
    pub fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let mixed = (self.0 ^ (self.0 >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
        ((mixed ^ (mixed >> 29)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[(self.uniform() * of.len() as f64) as usize]
    }

    pub fn direction(&mut self) -> Vector3<f64> {
        loop {
            let v = Vector3::from([0; 3].map(|_| 2.0 * self.uniform() - 1.0));
            if v.norm() < 1.0 && v.norm() > 0.1 {
                return v.normalize();
            }
        }
    }

    pub fn rotation(&mut self) -> Matrix3<f64> {
        let q = Quaternion::from(nalgebra::Vector4::from([0; 4].map(|_| self.uniform() - 0.5)));
        UnitQuaternion::from_quaternion(q).to_rotation_matrix().into_inner()
    }
}

pub fn cuboid(half: [f64; 3], r: f64, k: f64) -> Particle {
    let sides = (0..3).flat_map(|axis| [1.0, -1.0].map(|sign| (axis, sign)));
    let planes: Vec<Plane> =
        sides.map(|(axis, sign)| Plane { normal: Vector3::ith(axis, sign), offset: half[axis] - r }).collect();
    Particle::new(&planes, r, k, 1.2 * Vector3::from(half).norm()).expect("a cuboid")
}

pub const FAMILIES: [&str; 6] = ["rock", "cube", "pyramid", "needle", "plate", "ball"];

/// A body of about size 1; r as a part of its least half width.
pub fn body(family: &str, r: f64, k: f64, chance: &mut Chance) -> Particle {
    match family {
        "cube" => cuboid([0.5; 3], 0.5 * r, k),
        "needle" => cuboid([1.0, 0.1, 0.1], 0.1 * r, k),
        "plate" => cuboid([0.8, 0.8, 0.1], 0.1 * r, k),
        "pyramid" => {
            let r = 0.25 * r;
            let side =
                |x: f64, y: f64| Plane { normal: Vector3::new(2.0 * x, 2.0 * y, 1.0).normalize(), offset: 0.3 - r };
            let base = Plane { normal: -Vector3::z(), offset: 0.25 - r };
            let planes = [side(1.0, 0.0), side(-1.0, 0.0), side(0.0, 1.0), side(0.0, -1.0), base];
            Particle::new(&planes, r, k, 0.9).expect("a pyramid")
        }
        "rock" => loop {
            let r = 0.3 * r;
            let planes: Vec<Plane> = (0..14)
                .map(|_| Plane { normal: chance.direction(), offset: 0.3 + 0.3 * chance.uniform() - r })
                .collect();
            if let Ok(rock) = Particle::new(&planes, r, k, 0.8) {
                if rock.bounding_radius() < 1.5 {
                    return rock;
                }
            }
        },
        _ => Particle::sphere(0.5).expect("a ball"),
    }
}

/// A rock of many faces, as in a pile: planes about a ball; and their normals.
pub fn grain(planes: usize, r: f64, k: f64, chance: &mut Chance) -> (Particle, Vec<Vector3<f64>>) {
    loop {
        let normals: Vec<_> = (0..planes).map(|_| chance.direction()).collect();
        let planes: Vec<_> =
            normals.iter().map(|n| Plane { normal: *n, offset: 0.4 + 0.1 * chance.uniform() - r }).collect();
        if let Ok(grain) = Particle::new(&planes, r, k, 0.8) {
            if grain.bounding_radius() < 1.2 {
                return (grain, normals);
            }
        }
    }
}

/// A turn that brings a direction close to another one.
pub fn facing(from: &Vector3<f64>, to: &Vector3<f64>, chance: &mut Chance) -> Matrix3<f64> {
    let tilt = 10f64.powf(-4.0 * chance.uniform()) * 0.3 * chance.direction();
    let turn =
        Rotation3::rotation_between(from, to).unwrap_or_else(|| Rotation3::new(std::f64::consts::PI * Vector3::x()));
    (Rotation3::new(tilt) * Rotation3::new(6.0 * chance.uniform() * to) * turn).into_inner()
}

/// Two bodies in contact.
pub struct Pair {
    pub a: Particle,
    pub b: Particle,
    pub pose_a: Pose,
    pub pose_b: Pose,
    pub contact: Contact,
}

pub fn contact(a: &Particle, pose_a: &Pose, b: &Particle, pose_b: &Pose) -> Contact {
    detect(a, pose_a, b, pose_b, &Settings::default(), None).expect("a contact of ordinary bodies")
}

impl Pair {
    /// A at the origin, B in a direction at the distance of this overlap.
    pub fn at_overlap(
        a: Particle,
        turn_a: &Matrix3<f64>,
        b: Particle,
        turn_b: &Matrix3<f64>,
        direction: &Vector3<f64>,
        overlap: f64,
    ) -> Self {
        let pose_a = Pose::from_rotation([0.0; 3], turn_a).unwrap();
        let at = |distance: f64| Pose::from_rotation((distance * direction).into(), turn_b).unwrap();
        let (mut deep, mut apart) = (0.0, a.bounding_radius() + b.bounding_radius());
        for _ in 0..60 {
            let middle = 0.5 * (deep + apart);
            let found = contact(&a, &pose_a, &b, &at(middle));
            if found.kind == Kind::Overlapping && found.overlap > overlap { deep = middle } else { apart = middle }
        }
        let pose_b = at(deep);
        let contact = contact(&a, &pose_a, &b, &pose_b);
        Self { a, b, pose_a, pose_b, contact }
    }

    pub fn random(families: [&str; 2], k: [f64; 2], r: f64, depth: f64, chance: &mut Chance) -> Self {
        let a = body(families[0], r, k[0], chance);
        let b = body(families[1], r, k[1], chance);
        let (turn_a, turn_b) = (chance.rotation(), chance.rotation());
        let least = |p: &Particle| if p.sphericity() == 1.0 { p.shadow_radius() } else { p.rounding_radius() };
        let overlap = depth * (least(&a) + least(&b));
        Self::at_overlap(a, &turn_a, b, &turn_b, &chance.direction(), overlap)
    }

    /// Two polygons of the plane: a rounded square, and a pentagon whose corners lie a half away.
    pub fn flat(r: f64, k: f64, depth: f64, chance: &mut Chance) -> Self {
        let corners = |count: u32, reach: f64| {
            let corner = |i: u32| (TAU * f64::from(i) / f64::from(count)).sin_cos();
            (0..count).map(corner).map(|(sin, cos)| [reach * cos, reach * sin]).collect::<Vec<_>>()
        };
        let a = Particle::polygon(&corners(4, 0.5f64.sqrt()), 0.3 * r, k).expect("a square");
        let b = Particle::polygon(&corners(5, 0.5), 0.3 * r, k).expect("a pentagon");
        let [turn_a, turn_b, way] = [0; 3].map(|_| TAU * chance.uniform());
        let [turn_a, turn_b] = [turn_a, turn_b].map(|angle| Rotation3::new(angle * Vector3::z()).into_inner());
        Self::at_overlap(a, &turn_a, b, &turn_b, &Vector3::new(way.cos(), way.sin(), 0.0), depth * 0.6 * r)
    }

    pub fn is_flat(&self) -> bool {
        self.a.is_in_plane()
    }

    /// Any direction in which a body may move, and one about which it may turn.
    pub fn directions(&self, chance: &mut Chance) -> [Vector3<f64>; 2] {
        let [shift, turn] = [chance.direction(), chance.direction()];
        if !self.is_flat() {
            return [shift, turn];
        }
        [Vector3::new(shift.x, shift.y, 0.0).normalize(), turn.z.signum() * Vector3::z()]
    }

    /// With B moved by a shift and turned by a rotation vector about its position.
    pub fn moved(&self, shift: &Vector3<f64>, turn: &Vector3<f64>) -> Self {
        let pose_b = moved(&self.pose_b, self.pose_b.position(), shift, turn);
        let contact = contact(&self.a, &self.pose_a, &self.b, &pose_b);
        Self { a: self.a.clone(), b: self.b.clone(), pose_a: self.pose_a, pose_b, contact }
    }
}

/// A pose after a shift and a turn about a point.
pub fn moved(pose: &Pose, about: &Vector3<f64>, shift: &Vector3<f64>, turn: &Vector3<f64>) -> Pose {
    let turn = UnitQuaternion::from_scaled_axis(*turn).to_rotation_matrix().into_inner();
    let position = about + shift + turn * (pose.position() - about);
    Pose::from_rotation(position.into(), &(turn * pose.rotation())).unwrap()
}

/// The triangles of a box, seen from outside.
pub fn mesh_of_box(half: [f64; 3]) -> Vec<[[f64; 3]; 3]> {
    let mut triangles = Vec::new();
    for (axis, sign) in [0, 1, 2].into_iter().flat_map(|axis| [(axis, 1.0), (axis, -1.0)]) {
        let corner = |i: f64, j: f64| {
            let mut at = [0.0; 3];
            at[axis] = sign * half[axis];
            at[(axis + 1) % 3] = i * sign * half[(axis + 1) % 3];
            at[(axis + 2) % 3] = j * half[(axis + 2) % 3];
            at
        };
        let [a, b, c, d] = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        triangles.extend([[a, b, c], [a, c, d]]);
    }
    triangles
}

/// Central differences with Richardson's extrapolation.
pub fn difference(of: impl Fn(f64) -> f64, h: f64) -> f64 {
    let central = |h: f64| (of(h) - of(-h)) / (2.0 * h);
    (4.0 * central(0.5 * h) - central(h)) / 3.0
}
