//! Patches in pieces against the fan of rays, which computes them when the energy is asked for.

use crate::patch;
use kit::patch::bodies::{Chance, FAMILIES, Pair, body, cuboid};
use kit::patch::boundaries::{Boundary, resting, triangle_over};
use nalgebra::{Matrix3, Rotation3, Vector3};
use potential_particles::{
    Particle, Patch, PatchFlags, PatchScratch, PatchSettings, Pose, Settings, Triangle, Wall, contact_with_plane,
    contact_with_triangle, patch_on_plane, patch_on_triangle,
};

/// Errors of force, torque, area and second moments, relative to the patch.
fn errors(found: &Patch, exact: &Patch) -> [f64; 4] {
    let force = exact.force.norm();
    let reach = exact.area.sqrt();
    [
        (found.force - exact.force).norm() / force,
        (found.torque - exact.torque).norm() / (force * reach),
        (found.area / exact.area - 1.0).abs(),
        (found.second_moment - exact.second_moment).norm() / exact.second_moment.norm(),
    ]
}

/// Pairs with faces nearly against each other, or anyhow.
fn pairs(seed: u64) -> Vec<(String, Pair)> {
    let mut chance = Chance::new(seed);
    let mut pairs = Vec::new();
    for r in [1e-6, 1e-3, 0.05, 0.3] {
        for depth in [0.001, 0.02, 0.2] {
            for tilt in [0.0, 0.3, 1.0, 3.0] {
                let overlap = depth * r;
                let spin = Rotation3::new(chance.uniform() * Vector3::z()).into_inner();
                let turn = Rotation3::new(tilt * overlap * Vector3::new(1.0, 0.3, 0.0)).into_inner() * spin;
                let (a, b) = (cuboid([0.7, 0.6, 0.5], r, 0.0), cuboid([0.5, 0.4, 0.3], 0.5 * r, 0.0));
                let aside = Vector3::new(0.6 * chance.uniform(), 0.5 * chance.uniform(), 1.0).normalize();
                let pair = Pair::at_overlap(a, &Matrix3::identity(), b, &turn, &aside, overlap);
                pairs.push((format!("face, r {r}, depth {depth}, tilt {tilt}"), pair));
            }
            for shift in [0.0, 0.1, 1.0] {
                let overlap = depth * r;
                let (a, b) = (cuboid([0.5, 0.4, 0.3], r, 0.0), cuboid([0.5, 0.4, 0.3], r, 0.0));
                let aside = Vector3::new(0.6 * shift * overlap, -0.3 * shift * overlap, 0.6).normalize();
                let turn = Rotation3::new(shift * overlap * Vector3::new(0.5, 0.3, 0.4)).into_inner();
                let pair = Pair::at_overlap(a, &Matrix3::identity(), b, &turn, &aside, overlap);
                pairs.push((format!("aligned, r {r}, depth {depth}, shift {shift}"), pair));
            }
            for family in &FAMILIES[..5] {
                let other = chance.pick(&FAMILIES[..5]);
                let pair = Pair::random([family, other], [0.0; 2], r, depth, &mut chance);
                pairs.push((format!("{family} on {other}, r {r}, depth {depth}"), pair));
            }
        }
    }
    pairs
}

#[test]
fn pieces_are_as_the_fan() {
    for tolerance in [1e-4, 1e-6] {
        let (mut count, mut over) = (0, 0);
        for (name, pair) in pairs(5) {
            let (found, exact) = (patch(&pair, tolerance, false), patch(&pair, 0.01 * tolerance, true));
            if exact.flags.contains(PatchFlags::FOLDED) {
                continue;
            }
            let off = errors(&found, &exact);
            count += 1;
            over += usize::from(off[0] > found.error.max(0.1 * tolerance) + exact.error);
            assert!(
                off[0] < 1.5 * tolerance && off[1] < 1.5 * tolerance,
                "{tolerance} {name}: {off:?}, {}",
                found.error
            );
            // Where a side of the patch narrows to a point, area and moments have no smooth end.
            assert!(off[2] < 20.0 * tolerance && off[3] < 100.0 * tolerance, "{tolerance} {name}: {off:?}");
        }
        assert!(count > 130 && 50 * over <= count, "{tolerance}: {over} of {count}");
    }
}

/// The patch of a block on a floor: a plane, or a slab of two triangles.
fn on_floor(tilt: f64, with_energy: bool, in_triangles: bool) -> (Vector3<f64>, Vector3<f64>, f64) {
    let block = cuboid([0.5, 0.4, 0.3], 0.02, 0.0);
    let turn = Rotation3::new(tilt * Vector3::new(1.0, 0.4, 0.0)) * Rotation3::new(0.3 * Vector3::z());
    let pose = Pose::from_rotation([0.1, 0.05, 0.299], &turn.into_inner()).unwrap();
    let (settings, scratch) =
        (PatchSettings { tolerance: 1e-5, with_energy, ..PatchSettings::default() }, &mut PatchScratch::new());
    let (mut force, mut torque, mut area) = (Vector3::zeros(), Vector3::zeros(), 0.0);
    let mut add = |found: Patch, at: Vector3<f64>| {
        force += found.force;
        torque += found.torque + (at - pose.position()).cross(&found.force);
        area += found.area;
    };
    if in_triangles {
        let [a, b, c, d] = [[-2.0, -1.0, 0.0], [1.5, -1.3, 0.0], [1.6, 1.1, 0.0], [-1.2, 1.0, 0.0]];
        for corners in [[a, b, c], [a, c, d]] {
            let triangle = Triangle::new(corners).unwrap();
            let contact = contact_with_triangle(&block, &pose, &triangle, &Settings::default(), None).unwrap();
            let found = patch_on_triangle(&block, &pose, &triangle, true, &contact, &settings, scratch, |_| ());
            add(found.unwrap(), contact.on_boundary);
        }
    } else {
        let wall = Wall::new([0.0; 3], [0.0, 0.0, 1.0]).unwrap();
        let contact = contact_with_plane(&block, &pose, &wall, &Settings::default(), None).unwrap();
        add(patch_on_plane(&block, &pose, &contact, &settings, scratch, |_| ()).unwrap(), contact.on_boundary);
    }
    (force, torque, area)
}

#[test]
fn floors_are_as_the_fan() {
    for tilt in [0.0, 1e-3, 5e-3] {
        let (force, torque, area) = on_floor(tilt, true, false);
        let size = force.norm();
        for in_triangles in [false, true] {
            let found = on_floor(tilt, false, in_triangles);
            let off = [(found.0 - force).norm() / size, (found.1 - torque).norm() / size, (found.2 / area - 1.0).abs()];
            assert!(off[0] < 2e-5 && off[1] < 2e-5 && off[2] < 2e-4, "tilt {tilt}, triangles {in_triangles}: {off:?}");
        }
    }
}

/// A random body on a floor at z = 0, and a triangle of the floor, of 0.3 to 100 times the patch, whose border mostly
/// crosses it.
fn over_a_triangle(chance: &mut Chance) -> Option<(Particle, Pose, [[f64; 3]; 3])> {
    let (family, k) = (chance.pick(&FAMILIES), chance.pick(&[0.0, 0.0, 0.0, 0.02]));
    let (r, depth) = (chance.pick(&[1e-6, 1e-4, 1e-3, 0.05, 0.3, 1.0]), chance.pick(&[0.01, 0.1, 0.3, 0.9]));
    let a = body(family, r, k, chance);
    let overlap = depth * if family == "ball" { 0.1 } else { a.rounding_radius() };
    let pose = resting(&a, &chance.rotation(), overlap);
    let corners = triangle_over(&a, &pose, chance)?;
    Some((a, pose, corners))
}

/// ∫ (1 − s) over a triangle at z = 0, times ℓ, by the midpoints of a grid over a square about a point.
fn by_midpoints(a: &Particle, pose: &Pose, corners: &[[f64; 3]; 3], middle: &Vector3<f64>, half: f64) -> f64 {
    const CELLS: usize = 1200;
    let corners = corners.map(Vector3::from);
    let at = |i: usize| half * (2.0 * (i as f64 + 0.5) / CELLS as f64 - 1.0);
    let mut sum = 0.0;
    for (i, j) in (0..CELLS).flat_map(|i| (0..CELLS).map(move |j| (i, j))) {
        let x = Vector3::new(middle.x + at(i), middle.y + at(j), 0.0);
        let is_inside = (0..3).all(|e| (corners[(e + 1) % 3] - corners[e]).xy().perp(&(x - corners[e]).xy()) > 0.0);
        let s = if is_inside { (a.potential(&pose.to_local(&x)) + 1.0).max(0.0).sqrt() } else { 1.0 };
        sum += (1.0 - s).max(0.0);
    }
    a.depth_length() * sum * (2.0 * half / CELLS as f64).powi(2)
}

/// The border of a triangle may cut off any part of what would be a zone.
#[test]
fn patches_over_the_border_of_a_triangle_are_as_the_fan_and_as_the_definition() {
    let (mut chance, mut count, mut over) = (Chance::new(17), 0, 0);
    for round in 0..1500 {
        let Some((a, pose, corners)) = over_a_triangle(&mut chance) else { continue };
        let triangle = Boundary::Triangle(Triangle::new(corners).unwrap());
        let with = |tolerance: f64, with_energy: bool| {
            triangle.patch(&a, &pose, &PatchSettings { tolerance, with_energy, ..PatchSettings::default() })
        };
        let (Some(found), Some(exact)) = (with(1e-4, false), with(1e-7, true)) else { continue };
        let force = exact.force.norm();
        let off = (found.force - exact.force).norm() / force;
        count += 1;
        over += usize::from(off > 1e-4);
        assert!(off < 1e-3, "{round}: {off:e}, estimated {:e}", found.error);
        if round % 100 == 0 {
            let half = 5.0 * (exact.second_moment.trace() / exact.area).sqrt();
            let plain = by_midpoints(&a, &pose, &corners, &exact.pressure_centre, half);
            assert!((found.force.norm() - plain).abs() < 3e-2 * plain, "{round}: {} for {plain}", found.force.norm());
        }
    }
    assert!(count > 700 && 200 * over <= count, "{over} of {count}");
}
