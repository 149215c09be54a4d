//! Patches on planes, triangles and closed meshes.

use kit::patch::bodies::{Chance, FAMILIES, body, cuboid, difference, mesh_of_box};
use kit::patch::boundaries::resting;
use nalgebra::{UnitQuaternion, Vector3};
use potential_particles::{
    Kind, Particle, Patch, PatchScratch, PatchSettings, Pose, Settings, Triangle, Wall, contact_with_plane,
    contact_with_triangle, patch_on_plane, patch_on_triangle,
};
use std::f64::consts::PI;

/// Force, torque about the position of the particle, energy and area.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    force: Vector3<f64>,
    torque: Vector3<f64>,
    energy: f64,
    area: f64,
}

impl Sum {
    fn add(&mut self, patch: &Patch, arm: &Vector3<f64>) {
        self.force += patch.force;
        self.torque += patch.torque + arm.cross(&patch.force);
        self.energy += patch.energy;
        self.area += patch.area;
    }
}

fn on_plane(a: &Particle, pose: &Pose, height: f64, tolerance: f64) -> Option<(Patch, Sum)> {
    let wall = Wall::new([0.0, 0.0, height], [0.0, 0.0, 1.0]).unwrap();
    let contact = contact_with_plane(a, pose, &wall, &Settings::default(), None).unwrap();
    if contact.kind == Kind::Separated {
        return None;
    }
    let settings = PatchSettings { tolerance, with_energy: true, ..PatchSettings::default() };
    let patch = patch_on_plane(a, pose, &contact, &settings, &mut PatchScratch::new(), |_| ()).unwrap();
    let mut sum = Sum::default();
    sum.add(&patch, &(contact.on_boundary - pose.position()));
    Some((patch, sum))
}

fn on_mesh(a: &Particle, pose: &Pose, triangles: &[[[f64; 3]; 3]], tolerance: f64) -> (Sum, usize) {
    let (mut sum, mut count) = (Sum::default(), 0);
    for vertices in triangles {
        let triangle = Triangle::new(*vertices).unwrap();
        let contact = contact_with_triangle(a, pose, &triangle, &Settings::default(), None).unwrap();
        if contact.kind == Kind::Separated {
            continue;
        }
        let settings = PatchSettings { tolerance, with_energy: true, ..PatchSettings::default() };
        let scratch = &mut PatchScratch::new();
        let patch = patch_on_triangle(a, pose, &triangle, true, &contact, &settings, scratch, |_| ()).unwrap();
        sum.add(&patch, &(contact.on_boundary - pose.position()));
        count += 1;
    }
    (sum, count)
}

/// A square slab at z = 0, seen from above, cut into triangles.
fn slab(middle: &Vector3<f64>, half: f64, pieces: usize, chance: &mut Chance) -> Vec<[[f64; 3]; 3]> {
    let grid: Vec<Vec<[f64; 3]>> = (0..=pieces)
        .map(|i| {
            (0..=pieces)
                .map(|j| {
                    let inner = |k: usize| k > 0 && k < pieces;
                    let jitter = |on: bool, c: &mut Chance| if on { 0.4 * (c.uniform() - 0.5) } else { 0.0 };
                    let at = |k: usize, off: f64| half * (2.0 * (k as f64 + off) / pieces as f64 - 1.0);
                    [middle.x + at(i, jitter(inner(i), chance)), middle.y + at(j, jitter(inner(j), chance)), 0.0]
                })
                .collect()
        })
        .collect();
    let mut triangles = Vec::new();
    for i in 0..pieces {
        for j in 0..pieces {
            let [a, b, c, d] = [grid[i][j], grid[i + 1][j], grid[i + 1][j + 1], grid[i][j + 1]];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    triangles
}

#[test]
fn a_sphere_on_a_plane_presses_as_a_paraboloid() {
    let radius = 2.0;
    let ball = Particle::sphere(radius).unwrap();
    let overlap = 1e-5 * radius;
    let pose = Pose::at([0.3, 0.2, radius - overlap]).unwrap();
    let (found, _) = on_plane(&ball, &pose, 0.0, 1e-6).unwrap();
    assert!((-found.force.z / (PI * radius * overlap * overlap) - 1.0).abs() < 1e-4, "{found:?}");
}

#[test]
fn coplanar_triangles_add_up_to_the_plane() {
    let mut chance = Chance::new(5);
    for family in FAMILIES {
        for (k, tolerance, allowed) in [(0.0, 1e-10, 5e-8), (0.3, 1e-9, 5e-8)] {
            for r in [1e-3, 0.2] {
                let a = body(family, r, k, &mut chance);
                let turn = chance.rotation();
                // As deep as half of its rounding, or so.
                let overlap = 0.3 * if family == "ball" { 0.1 } else { a.rounding_radius() };
                let pose = resting(&a, &turn, overlap);
                let (patch, whole) = on_plane(&a, &pose, 0.0, tolerance).unwrap();
                let size = patch.area.sqrt();
                for pieces in [1, 3] {
                    let triangles = slab(&patch.pressure_centre, 2.0 * a.bounding_radius(), 2 * pieces, &mut chance);
                    let (sum, count) = on_mesh(&a, &pose, &triangles, tolerance);
                    assert!(count > 0, "no triangle");
                    let f = whole.force.norm();
                    let arm = f * (size + a.bounding_radius());
                    let errors = [
                        (sum.force - whole.force).norm() / f,
                        (sum.torque - whole.torque).norm() / arm,
                        1e-2 * (sum.energy / whole.energy - 1.0).abs(),
                        1e-2 * (sum.area / whole.area - 1.0).abs(),
                    ];
                    assert!(errors.iter().all(|e| *e < allowed), "{family} k {k} r {r}: {errors:?}");
                }
            }
        }
    }
}

#[test]
fn a_closed_mesh_has_an_energy() {
    let mut chance = Chance::new(9);
    let mesh = mesh_of_box([0.4, 0.5, 0.3]);
    for k in [0.0, 0.1] {
        for _ in 0..4 {
            let a = cuboid([0.5, 0.4, 0.3], 0.1, k);
            let turn = chance.rotation();
            let direction = chance.direction();
            let at = |distance: f64| Pose::from_rotation((distance * direction).into(), &turn).unwrap();
            let (mut deep, mut apart) = (0.3, 2.0);
            for _ in 0..50 {
                let middle = 0.5 * (deep + apart);
                if on_mesh(&a, &at(middle), &mesh, 1e-3).1 > 0 { deep = middle } else { apart = middle }
            }
            let distance = deep - 0.04;
            let moved = |shift: Vector3<f64>, rotation: Vector3<f64>| {
                let rotation = UnitQuaternion::from_scaled_axis(rotation).to_rotation_matrix().into_inner() * turn;
                let pose = Pose::from_rotation((distance * direction + shift).into(), &rotation).unwrap();
                on_mesh(&a, &pose, &mesh, 1e-9).0
            };
            let here = moved(Vector3::zeros(), Vector3::zeros());
            let (along, about) = (chance.direction(), chance.direction());
            let f = here.force.norm();
            // The force of a patch is that on the mesh.
            let by_shift = difference(|h| moved(h * along, Vector3::zeros()).energy, 2e-4);
            let by_turn = difference(|h| moved(Vector3::zeros(), h * about).energy, 2e-4);
            let errors = [(by_shift - here.force.dot(&along)).abs() / f, (by_turn - here.torque.dot(&about)).abs() / f];
            assert!(errors.iter().all(|e| *e < 2e-6), "k {k}: {errors:?}");
        }
    }
}
