//! Contact patches against closed forms, and tiles against a slab.

use kit::patch::bodies::{Pair, contact, cuboid};
use nalgebra::{Matrix3, Rotation3, Vector3};
use potential_particles::{
    Kind, Particle, Patch, PatchScratch, PatchSettings, Plane, Pose, Settings, Triangle, Wall, contact_with_plane,
    contact_with_triangle, patch_of_contact, patch_on_plane, patch_on_triangle,
};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

fn patch(pair: &Pair, tolerance: f64, with_energy: bool) -> Patch {
    let Pair { a, pose_a, b, pose_b, contact, .. } = pair;
    let settings = PatchSettings { tolerance, with_energy, ..PatchSettings::default() };
    patch_of_contact(a, pose_a, b, pose_b, contact, &settings, &mut PatchScratch::new(), |_| ())
        .expect("a patch of an overlapping contact")
}

fn placed(a: Particle, turn_a: Matrix3<f64>, b: Particle, position: [f64; 3], turn_b: Matrix3<f64>) -> Pair {
    let pose_a = Pose::from_rotation([0.0; 3], &turn_a).expect("a rotation");
    let pose_b = Pose::from_rotation(position, &turn_b).expect("a rotation");
    let contact = contact(&a, &pose_a, &b, &pose_b);
    Pair { a, b, pose_a, pose_b, contact }
}

fn turn(axis: [f64; 3], angle: f64) -> Matrix3<f64> {
    Rotation3::new(angle * Vector3::from(axis)).into_inner()
}

fn off(found: f64, exact: f64) -> f64 {
    (found / exact - 1.0).abs()
}

/// N, M and the contact length of a tilted block of sides 0.6 and 0.4: largest relative errors within the base and
/// beyond its middle third.
pub fn faces() -> [f64; 2] {
    let r: f64 = 1e-6;
    let (length, width, overlap) = (0.6 - 2.0 * r, 0.4 - 2.0 * r, 1e-3 * r);
    let mut errors = [0.0_f64; 2];
    for times in [0.1, 0.5, 0.9, 1.5, 2.0, 4.0] {
        let angle = times * overlap / (0.5 * length);
        let rotation = turn([0.0, 1.0, 0.0], angle);
        let position = Vector3::new(0.0, 0.0, 0.5 - overlap) + rotation * Vector3::new(0.0, 0.0, 0.3);
        let (a, b) = (cuboid([1.0, 1.0, 0.5], r, 0.0), cuboid([0.3, 0.2, 0.3], r, 0.0));
        let found = patch(&placed(a, Matrix3::identity(), b, position.into(), rotation), 1e-4, false);
        let arm = found.pressure_centre.x.abs();
        if times < 1.0 {
            let (area, second) = (length * width, width * length.powi(3) / 12.0);
            errors[0] = errors[0].max(off(found.force.z, area * overlap)).max(off(arm * found.force.z, second * angle));
        } else {
            let pressed = 0.5 * length + overlap / angle;
            errors[1] = errors[1].max(off(found.force.z, 0.5 * angle * pressed * pressed * width));
            errors[1] = errors[1].max(off(3.0 * (0.5 * length - arm), pressed));
        }
    }
    errors
}

/// Sphere on plane and on sphere, and crossed cylinders: N.
pub fn round() -> f64 {
    let overlap = 1e-5;
    let ball = Particle::sphere(1.0).expect("a ball");
    let (found, _) = on_plane(&ball, &Pose::at([0.1, 0.2, 1.0 - overlap]).expect("finite"), 1e-4).expect("a contact");
    let on_plane = off(found.force.norm(), PI * overlap * overlap);
    let other = Particle::sphere(0.5).expect("a ball");
    let pair = placed(ball, Matrix3::identity(), other, [1.5 - overlap, 0.0, 0.0], Matrix3::identity());
    let on_sphere = off(patch(&pair, 1e-4, false).force.x, PI / 3.0 * overlap * overlap);
    on_plane.max(on_sphere).max(crossed()[0])
}

/// N and C of crossed edges.
pub fn crossed() -> [f64; 2] {
    let r = 0.05;
    let overlap = 1e-4 * r;
    let mut errors = [0.0_f64; 2];
    for crossing in [0.5, 1.0] {
        let up = turn([1.0, 0.0, 0.0], FRAC_PI_4);
        let down = turn([0.0, 0.0, 1.0], crossing) * up;
        let height = 2.0 * ((0.5 - r) * 2.0_f64.sqrt() + r) - overlap;
        let (a, b) = (cuboid([0.5; 3], r, 0.0), cuboid([0.5; 3], r, 0.0));
        let found = patch(&placed(a, up, b, [0.0, 0.0, height], down), 1e-4, false);
        errors[0] = errors[0].max(off(found.force.z, PI * r / f64::sin(crossing) * overlap * overlap));
        errors[1] = errors[1].max(off(found.couple.abs(), found.force.z * overlap / 3.0 / f64::tan(crossing)));
    }
    errors
}

/// Levers of a square and a disc (a prism of 256 sides) against twist, even pressure.
pub fn levers() -> [f64; 2] {
    let r = 1e-6;
    let on_plate = |body: Particle| {
        let plate = cuboid([1.0, 1.0, 0.5], r, 0.0);
        let position = [0.1, -0.1, 0.8 - 1e-3 * r];
        patch(&placed(plate, Matrix3::identity(), body, position, turn([0.0, 0.0, 1.0], 0.4)), 1e-4, false).twist_lever
    };
    let square = on_plate(cuboid([0.3; 3], r, 0.0));
    let mut planes: Vec<Plane> = (0..256)
        .map(|i| {
            let (sine, cosine) = (TAU * f64::from(i) / 256.0).sin_cos();
            Plane { normal: Vector3::new(cosine, sine, 0.0), offset: 0.3 - r }
        })
        .collect();
    planes.extend([1.0, -1.0].map(|sign| Plane { normal: Vector3::new(0.0, 0.0, sign), offset: 0.3 - r }));
    let disc = on_plate(Particle::new(&planes, r, 0.0, 1.0).expect("a prism"));
    let of_square = (2.0_f64.sqrt() + (1.0 + 2.0_f64.sqrt()).ln()) / 6.0 * 0.6;
    [off(square, of_square), off(disc, 2.0 / 3.0 * 0.3)]
}

fn on_plane(a: &Particle, pose: &Pose, tolerance: f64) -> Option<(Patch, Vector3<f64>)> {
    let wall = Wall::new([0.0; 3], [0.0, 0.0, 1.0]).expect("a plane");
    let contact = contact_with_plane(a, pose, &wall, &Settings::default(), None).expect("a contact");
    let settings = PatchSettings { tolerance, with_energy: false, ..PatchSettings::default() };
    (contact.kind == Kind::Overlapping).then(|| {
        let found = patch_on_plane(a, pose, &contact, &settings, &mut PatchScratch::new(), |_| ());
        (found.expect("a patch"), contact.on_boundary - pose.position())
    })
}

/// A cube slid over square tiles of two triangles each: largest relative difference of the force to that on one slab,
/// of so many places.
pub fn tiles(places: usize, tolerance: f64) -> f64 {
    let cube = cuboid([0.5; 3], 0.01, 0.0);
    let settings = PatchSettings { tolerance, with_energy: false, ..PatchSettings::default() };
    let mut most = 0.0_f64;
    for i in 0..places {
        let along = i as f64 / places as f64;
        let pose =
            Pose::from_rotation([along, 0.1 + 0.3 * along, 0.499], &turn([0.0, 0.0, 1.0], 0.3 + FRAC_PI_2 * along));
        let pose = pose.expect("a rotation");
        let (whole, _) = on_plane(&cube, &pose, tolerance).expect("a contact");
        let mut sum = Vector3::zeros();
        for x in -2..3 {
            for y in -2..3 {
                let corner = |i: i32, j: i32| [0.8 * f64::from(x + i), 0.8 * f64::from(y + j), 0.0];
                let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                for vertices in [[a, b, c], [a, c, d]] {
                    let triangle = Triangle::new(vertices).expect("a triangle");
                    let contact = contact_with_triangle(&cube, &pose, &triangle, &Settings::default(), None);
                    let contact = contact.expect("a contact");
                    if contact.kind == Kind::Overlapping {
                        let scratch = &mut PatchScratch::new();
                        let part =
                            patch_on_triangle(&cube, &pose, &triangle, true, &contact, &settings, scratch, |_| ());
                        sum += part.expect("a patch").force;
                    }
                }
            }
        }
        most = most.max((sum - whole.force).norm() / whole.force.norm());
    }
    most
}
