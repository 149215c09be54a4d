//! Boxes and prisms whose sides lie in line, against brute force: a running bond, stacks, edges along edges.

use kit::patch::bodies::{Chance, contact, cuboid};
use kit::patch::brute::{brute, frame_of};
use nalgebra::{Rotation3, Vector3};
use potential_particles::{
    Particle, PatchFlags, PatchPoint, PatchScratch, PatchSettings, Plane, Pose, patch_of_contact,
};
use std::f64::consts::TAU;

/// Checks the patch of a pair; whether it was compared.
fn compare(what: &str, a: (&Particle, &Pose), b: (&Particle, &Pose), tolerance: f64) -> bool {
    let contact = contact(a.0, a.1, b.0, b.1);
    if contact.s >= 1.0 || contact.s < 1e-3 {
        return false;
    }
    let settings = PatchSettings { tolerance, ..PatchSettings::default() };
    let mut farthest = 0.0_f64;
    let visit = |point: PatchPoint| farthest = farthest.max(point.position.norm());
    let found = patch_of_contact(a.0, a.1, b.0, b.1, &contact, &settings, &mut PatchScratch::new(), visit).unwrap();
    if [PatchFlags::FOLDED, PatchFlags::EMPTY, PatchFlags::TOLERANCE_NOT_REACHED]
        .iter()
        .any(|f| found.flags.contains(*f))
    {
        return false;
    }
    let right = brute(a, Some(b), &contact.point, &frame_of(&contact.normal), &[], 2.0 * farthest).unwrap();
    let size = right.force.norm();
    let off = (found.force - right.force).norm() / size;
    let of_torque = (found.torque - right.torque).norm() / (size * right.reach);
    let allowed = 3.0 * tolerance.max(found.error) + 1e-7 + right.doubt;
    assert!(
        off <= allowed && of_torque <= allowed,
        "{what} at {tolerance:e}: force off by {off:e}, torque by {of_torque:e}, {found:?}, {right:?}"
    );
    let of_area = (found.area / right.area - 1.0).abs();
    assert!(
        of_area <= 3.0 * found.area_error.max(10.0 * tolerance) + 1e-6 + 10.0 * right.doubt,
        "{what} at {tolerance:e}: area off by {of_area:e}, {found:?}, {right:?}"
    );
    true
}

/// Two cubes of edge 1, one on the other and half an edge aside: 9.6208e-4 by brute force in issue 50.
#[test]
fn a_running_bond_is_what_brute_force_says() {
    let cube = cuboid([0.5; 3], 0.01, 0.0);
    let (here, above) = (Pose::at([0.0; 3]).unwrap(), Pose::at([0.5, 0.0, 1.0 - 0.002]).unwrap());
    for tolerance in [1e-3, 1e-4, 1e-6] {
        assert!(compare("bond", (&cube, &here), (&cube, &above), tolerance));
    }
    let contact = contact(&cube, &here, &cube, &above);
    let right =
        brute((&cube, &here), Some((&cube, &above)), &contact.point, &frame_of(&contact.normal), &[], 2.0).unwrap();
    assert!((right.force.z / 9.6208e-4 - 1.0).abs() < 1e-5, "{right:?}");
}

/// Boxes of random sides shifted along one or two edges, flush or equal, with edges of A along edges of B but for a
/// small step.
#[test]
fn aligned_boxes_are_what_brute_force_says() {
    let mut chance = Chance::new(50);
    let mut compared = 0;
    for round in 0..rounds() {
        let r = 10f64.powf(-3.0 + 2.5 * chance.uniform());
        let sides = |chance: &mut Chance| [0.5, 0.3 + 0.4 * chance.uniform(), 0.5].map(|h| h.max(1.1 * r));
        let (half_a, mut half_b) = (sides(&mut chance), sides(&mut chance));
        if round % 3 == 0 {
            half_b = half_a;
        }
        let step = chance.pick(&[0.0, 1e-16, 1e-13, 1e-10, 1e-7, 1e-5, 1e-3]);
        let mut shift = [0, 1].map(|i| match chance.pick(&[0, 1, 2, 3]) {
            0 => step,
            1 => half_a[i] - half_b[i] + step,
            2 => half_a[i] + step,
            _ => (half_a[i] + half_b[i]) * (0.9 * chance.uniform()),
        });
        shift[0] *= chance.pick(&[1.0, -1.0]);
        let overlap = r * chance.pick(&[1e-3, 0.02, 0.2, 0.6]);
        let (a, b) = (cuboid(half_a, r, 0.0), cuboid(half_b, r, 0.0));
        let here = Pose::at([0.0; 3]).unwrap();
        let above = Pose::at([shift[0], shift[1], half_a[2] + half_b[2] - overlap]).unwrap();
        for tolerance in [1e-4, 1e-6] {
            compared += usize::from(compare(
                &format!("{round}: {half_a:?} {half_b:?} {r} {shift:?} {overlap}"),
                (&a, &here),
                (&b, &above),
                tolerance,
            ));
        }
    }
    assert!(compared > 10, "{compared}");
}

/// Two stones of `sides` sides whose joint is z = 0: their sides meet on its edges, at an angle.
fn stones(r: f64, sides: usize, taper: f64, spin: f64) -> [Particle; 2] {
    [1.0, -1.0].map(|sign| {
        let side = |i: usize| {
            let (sin, cos) = (spin + TAU * i as f64 / sides as f64).sin_cos();
            let normal = Vector3::new(cos, sin, sign * taper).normalize();
            Plane { normal, offset: 0.4 * normal.xy().norm() + 0.3 * normal.z * sign - r }
        };
        let ends = [1.0, -1.0].map(|way| Plane { normal: way * Vector3::z(), offset: 0.3 - r });
        Particle::new(&(0..sides).map(side).chain(ends).collect::<Vec<_>>(), r, 0.0, 1.2).unwrap()
    })
}

/// Moved and turned against each other by parts of r down to 1e-12; of the first pair three vertices of the network lie
/// within the distance at which two count as one.
#[test]
fn stones_of_an_arch_are_what_brute_force_says() {
    let mut chance = Chance::new(51);
    let mut compared = 0;
    for round in 0..=rounds() / 4 {
        let (shape, at, turn) = if round == 0 {
            (
                (0.00315187356156772, 6, 0.12446843452575171, 5.802831224267658),
                [2.7288489169095042e-9, 1.4724767155880222e-9, 0.2999369625287686],
                Vector3::new(2.3348253931380725e-6, 2.0691435559796427e-6, -4.4889971336556726e-7),
            )
        } else {
            let r = 10f64.powf(-3.0 + 1.5 * chance.uniform());
            let (taper, spin) = (0.3 * chance.uniform() * chance.pick(&[1.0, -1.0]), TAU * chance.uniform());
            let off = r * chance.pick(&[0.0, 1e-9, 1e-6, 1e-3]);
            let at = [off * chance.uniform(), off * chance.uniform(), 0.3 - r * chance.pick(&[1e-3, 0.02, 0.2])];
            let turn = chance.pick(&[0.0, 1e-12, 1e-6, 1e-3]) * r * chance.direction();
            ((r, 4 + (5.0 * chance.uniform()) as usize, taper, spin), at, turn)
        };
        let [a, b] = stones(shape.0, shape.1, shape.2, shape.3);
        let below = Pose::at([0.0, 0.0, -0.3]).unwrap();
        let above = Pose::from_rotation(at, Rotation3::new(turn).matrix()).unwrap();
        for tolerance in [1e-4, 1e-6] {
            let what = format!("{round}: {shape:?} {at:?} {turn:?}");
            compared += u64::from(compare(&what, (&a, &below), (&b, &above), tolerance));
        }
    }
    assert!(compared > rounds() / 4, "{compared}");
}

/// PATCH_ROUNDS in the environment chooses another number.
fn rounds() -> u64 {
    std::env::var("PATCH_ROUNDS").map_or(24, |value| value.parse().expect("a number"))
}
