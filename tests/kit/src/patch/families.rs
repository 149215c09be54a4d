//! Random contacts of many kinds, whose patches are measured and judged.

use crate::patch::bodies::{Chance, FAMILIES, Pair, body, contact, cuboid, facing, grain};
use crate::patch::boundaries::{Boundary, resting, triangle_over};
use crate::patch::brute::{Brute, brute, frame_of};
use nalgebra::{Matrix3, Rotation3, Vector3};
use potential_particles::{
    Kind, Particle, Patch, PatchScratch, PatchSettings, Plane, Pose, Triangle, Wall, patch_of_contact,
};
use std::f64::consts::{FRAC_PI_4, TAU};

pub const KINDS: [&str; 12] = [
    "grains, face to face",
    "grains, any way up",
    "random bodies",
    "on a plane",
    "on a triangle",
    "cubes, face on face",
    "cubes, edge on face",
    "cubes, crossed edges",
    "masonry",
    "stones of an arch",
    "masonry, turned by a little",
    "polygons",
];

#[allow(clippy::large_enum_variant)] // One at a time.
pub enum Case {
    Pair(Pair),
    Boundary {
        boundary: Boundary,
        /// Of a triangle: a, b, c of a x + b y ≤ c.
        sides: Vec<[f64; 3]>,
        a: Particle,
        pose: Pose,
    },
}

impl Case {
    pub fn patch(&self, settings: &PatchSettings, scratch: &mut PatchScratch) -> Option<Patch> {
        match self {
            Self::Pair(Pair { a, pose_a, b, pose_b, contact }) => {
                patch_of_contact(a, pose_a, b, pose_b, contact, settings, scratch, |_| ()).ok()
            }
            Self::Boundary { boundary, a, pose, .. } => boundary.patch(a, pose, settings),
        }
    }

    /// By brute force, about the centre of pressure of a patch that was found: with its torque about there.
    pub fn brute(&self, found: &Patch) -> Option<Brute> {
        // Of a triangle 2.8 times that reaches to its tip; much farther out another branch may begin.
        let half = 4.0 * (found.second_moment.trace() / found.area).sqrt();
        let origin = found.pressure_centre;
        match self {
            Self::Pair(Pair { a, pose_a, b, pose_b, contact }) => {
                brute((a, pose_a), Some((b, pose_b)), &origin, &frame_of(&contact.normal), &[], half)
            }
            Self::Boundary { sides, a, pose, .. } => {
                let about = |[u, v, c]: &[f64; 3]| [*u, *v, c - u * origin.x - v * origin.y];
                let sides: Vec<_> = sides.iter().map(about).collect();
                let found = brute((a, pose), None, &origin, &Matrix3::identity(), &sides, half)?;
                // Up is the force on A.
                Some(Brute { force: -found.force, torque: -found.torque, ..found })
            }
        }
    }

    /// Where the torque of a patch is about.
    pub fn point(&self) -> Option<Vector3<f64>> {
        match self {
            Self::Pair(pair) => Some(pair.contact.point),
            Self::Boundary { boundary, a, pose, .. } => Some(boundary.contact(a, pose)?.on_boundary),
        }
    }

    /// Of one of [`KINDS`]; `roundings`: r of random bodies, as parts of their least half widths. `None` where nothing
    /// touches.
    pub fn of(kind: usize, k: f64, roundings: &[f64], chance: &mut Chance) -> Option<Self> {
        let depth = 0.8 * 10f64.powf(-3.0 * chance.uniform());
        match kind {
            0 | 1 => {
                let (r, planes) = (chance.pick(&[1e-3, 0.05]), 20 + (20.0 * chance.uniform()) as usize);
                let ((a, of_a), (b, of_b)) = (grain(planes, r, k, chance), grain(planes, r, k, chance));
                let way = chance.pick(&of_a);
                let (turn, aside) = if kind == 0 {
                    let turn = facing(&chance.pick(&of_b), &-way, chance);
                    (turn, (way + 0.2 * chance.direction()).normalize())
                } else {
                    (chance.rotation(), chance.direction())
                };
                Some(Case::Pair(Pair::at_overlap(a, &Matrix3::identity(), b, &turn, &aside, depth * r)))
            }
            2 => {
                let families = [0; 2].map(|_| chance.pick(&FAMILIES));
                let r = chance.pick(roundings);
                Some(Case::Pair(Pair::random(families, [k; 2], r, depth, chance)))
            }
            3 | 4 => {
                let (a, turn) = if chance.uniform() < 0.5 {
                    let r = chance.pick(roundings);
                    (body(chance.pick(&FAMILIES[..5]), r, k, chance), chance.rotation())
                } else {
                    let (a, normals) = grain(24, chance.pick(&[1e-3, 0.05]), k, chance);
                    (a, facing(&chance.pick(&normals), &-Vector3::z(), chance))
                };
                let pose = resting(&a, &turn, depth * a.rounding_radius());
                let (mut boundary, mut sides) =
                    (Boundary::Plane(Wall::new([0.0; 3], [0.0, 0.0, 1.0]).ok()?), Vec::new());
                if kind == 4 {
                    let corners = triangle_over(&a, &pose, chance)?;
                    boundary = Boundary::Triangle(Triangle::new(corners).ok()?);
                    let side = |i: usize| {
                        let (from, to) = (corners[i], corners[(i + 1) % 3]);
                        let [u, v] = [to[1] - from[1], from[0] - to[0]];
                        [u, v, u * from[0] + v * from[1]]
                    };
                    sides = (0..3).map(side).collect();
                }
                boundary.contact(&a, &pose)?;
                Some(Case::Boundary { boundary, sides, a, pose })
            }
            5..=7 => {
                let r = chance.pick(&[1e-3, 1e-2, 0.05]);
                let about_x = |angle: f64| Rotation3::from_axis_angle(&Vector3::x_axis(), angle);
                let tilt = chance.uniform() - 0.5;
                let (below, above) = match kind {
                    5 => (Rotation3::identity(), Rotation3::new(0.02 * r * chance.direction())),
                    6 => (Rotation3::identity(), about_x(FRAC_PI_4 + 0.3 * tilt)),
                    _ => (about_x(FRAC_PI_4), about_x(FRAC_PI_4 + 0.2 * tilt)),
                };
                let above = Rotation3::from_axis_angle(&Vector3::z_axis(), TAU * chance.uniform()) * above;
                let aside =
                    Vector3::new(0.1 * (chance.uniform() - 0.5), 0.1 * (chance.uniform() - 0.5), 1.0).normalize();
                let overlap = r * chance.pick(&[0.02, 0.2]);
                let cube = || cuboid([0.5; 3], r, k);
                Some(Case::Pair(Pair::at_overlap(cube(), below.matrix(), cube(), above.matrix(), &aside, overlap)))
            }
            8 | 10 => {
                let r = 10f64.powf(-3.0 + 2.0 * chance.uniform());
                let half_a = [0.5, 0.3 + 0.4 * chance.uniform(), 0.5];
                let half_b = if chance.uniform() < 0.3 { half_a } else { [0.5, 0.3 + 0.4 * chance.uniform(), 0.5] };
                let step = chance.pick(&[0.0, 1e-16, 1e-10, 1e-5, 1e-3]);
                let shift = [0, 1].map(|i| match chance.pick(&[0, 1, 2, 3]) {
                    0 => step,
                    1 => half_a[i] - half_b[i] + step,
                    2 => half_a[i] + step,
                    _ => (half_a[i] + half_b[i]) * 0.9 * chance.uniform(),
                });
                let height = half_a[2] + half_b[2] - r * chance.pick(&[1e-3, 0.02, 0.2, 0.6]);
                let most = if kind == 10 { chance.pick(&[1e-15, 1e-10, 1e-6, 1e-3, 0.3]) } else { 0.0 };
                let tilt = (kind == 10).then(|| Rotation3::new(most * chance.direction()));
                overlapping(
                    (cuboid(half_a, r, k), [0.0; 3]),
                    (cuboid(half_b, r, k), [shift[0], shift[1], height]),
                    tilt,
                )
            }
            11 => Some(Case::Pair(Pair::flat(chance.pick(roundings), k, depth, chance))),
            _ => {
                let (r, sides) = (10f64.powf(-3.0 + 1.5 * chance.uniform()), 4 + (5.0 * chance.uniform()) as usize);
                let (taper, spin) = (0.3 * chance.uniform() * chance.pick(&[1.0, -1.0]), TAU * chance.uniform());
                // The joint is the plane z = 0; the sides of both meet on its edges, at an angle.
                let stone = |sign: f64| {
                    let side = |i: usize| {
                        let (sin, cos) = (spin + TAU * i as f64 / sides as f64).sin_cos();
                        let normal = Vector3::new(cos, sin, sign * taper).normalize();
                        Plane { normal, offset: 0.4 * normal.xy().norm() + 0.3 * normal.z * sign - r }
                    };
                    let ends = [1.0, -1.0].map(|way| Plane { normal: way * Vector3::z(), offset: 0.3 - r });
                    Particle::new(&(0..sides).map(side).chain(ends).collect::<Vec<_>>(), r, k, 1.2)
                };
                let off = r * chance.pick(&[0.0, 0.0, 1e-6, 1e-3, 1e-1]);
                let at = [off * chance.uniform(), off * chance.uniform(), 0.3 - r * chance.pick(&[1e-3, 0.02, 0.2])];
                let tilt = Rotation3::new(chance.pick(&[0.0, 1e-12, 1e-6, 1e-3]) * r * chance.direction());
                overlapping((stone(1.0).ok()?, [0.0, 0.0, -0.3]), (stone(-1.0).ok()?, at), Some(tilt))
            }
        }
    }
}

fn overlapping(
    (a, at_a): (Particle, [f64; 3]),
    (b, at_b): (Particle, [f64; 3]),
    tilt: Option<Rotation3<f64>>,
) -> Option<Case> {
    let pose_a = Pose::at(at_a).ok()?;
    let pose_b = Pose::from_rotation(at_b, tilt.unwrap_or(Rotation3::identity()).matrix()).ok()?;
    let contact = contact(&a, &pose_a, &b, &pose_b);
    let pair = Pair { a, b, pose_a, pose_b, contact };
    (contact.kind == Kind::Overlapping && contact.s > 1e-3).then_some(Case::Pair(pair))
}
