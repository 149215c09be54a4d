//! Contacts with planes and triangles against differences of sixth order, and the derivatives of patches.

use crate::properties::{disagreement, scattered, some_weights, weighted};
use nalgebra::{Rotation3, UnitQuaternion, Vector3};
use potential_particles::*;

/// The derivative of f at 0 by values at ±h, ±2h, ±3h: off by h⁶.
fn derivative<const N: usize>(h: f64, f: impl Fn(f64) -> [f64; N]) -> [f64; N] {
    let mut sum = [0.0; N];
    for (i, weight) in [0.75, -0.15, 1.0 / 60.0].into_iter().enumerate() {
        let step = h * (i + 1) as f64;
        let (up, down) = (f(step), f(-step));
        for (sum, (up, down)) in sum.iter_mut().zip(up.iter().zip(&down)) {
            *sum += weight * (up - down) / h;
        }
    }
    sum
}

fn moved(pose: &Pose, shift: Vector3<f64>, turn: Vector3<f64>) -> Pose {
    let [w, i, j, k] = pose.orientation();
    let q = UnitQuaternion::new_normalize(nalgebra::Quaternion::new(w, i, j, k));
    let turned = UnitQuaternion::from_scaled_axis(turn) * q;
    Pose::new((pose.position() + shift).into(), [turned.w, turned.i, turned.j, turned.k]).unwrap()
}

/// A cube cut at a corner.
fn body(r: f64, k: f64) -> Particle {
    let sides = (0..3).flat_map(|axis| [1.0, -1.0].map(|sign| Vector3::ith(axis, sign)));
    let mut planes: Vec<Plane> = sides.map(|normal| Plane { normal, offset: 0.4 }).collect();
    planes.push(Plane { normal: Vector3::new(0.5, 0.6, 0.7).normalize(), offset: 0.45 });
    Particle::new(&planes, r, k, 0.9).unwrap()
}

/// s, overlap, normal, point, on_particle, on_boundary.
fn numbers(c: &FlatContact) -> [f64; 14] {
    all_of([c.s, c.overlap], [c.normal, c.point, c.on_particle, c.on_boundary])
}

fn all_of(numbers: [f64; 2], vectors: [Vector3<f64>; 4]) -> [f64; 14] {
    let mut all = [numbers[0]; 14];
    all[1] = numbers[1];
    for (i, v) in vectors.iter().enumerate() {
        all[2 + 3 * i..5 + 3 * i].copy_from_slice(v.as_slice());
    }
    all
}

fn columns(d: &ContactDerivatives, column: usize) -> [f64; 14] {
    let mut all = [d.s[column]; 14];
    all[1] = d.overlap[column];
    for (i, rows) in [d.normal, d.point, d.point_on_a, d.point_on_b].iter().enumerate() {
        (0..3).for_each(|j| all[2 + 3 * i + j] = rows[(j, column)]);
    }
    all
}

fn assert_near(found: &[f64; 14], expected: &[f64; 14], what: &str) {
    let most = expected.iter().fold(1.0_f64, |most, v| most.max(v.abs()));
    for (i, (found, expected)) in found.iter().zip(expected).enumerate() {
        assert!((found - expected).abs() <= 1e-8 * most, "{what}, number {i}: {found} for {expected}");
    }
}

#[test]
fn contacts_with_boundaries_move_as_differences_say() {
    let settings = Settings::default().with_gap_tolerance(1e-14);
    let mut met = [0; 3];
    for seed in 0..60 {
        let mut chance = scattered(50 * seed);
        let particle = body(0.1 + 0.05 * chance(), 0.3 + 0.2 * chance());
        let pose = Pose::new([0.1 * chance(), 0.1 * chance(), 0.42], [1.0, chance(), chance(), chance()]).unwrap();
        // Beside the middle of the face, and around it.
        let (far, aside) = [(0.2, 0.1), (0.5, 0.2), (5.0, -0.4)][seed % 3];
        let corner = |x: f64, y: f64| [far * (x + aside), far * (y + aside), 0.02 * far * x];
        let triangle = Triangle::new([corner(0.0, 0.1), corner(2.0, 0.2), corner(0.2, 2.0)]).unwrap();
        let at = |pose: &Pose, triangle: &Triangle, particle: &Particle| {
            contact_with_triangle(particle, pose, triangle, &settings, None).unwrap()
        };
        let contact = at(&pose, &triangle, &particle);
        if contact.kind != Kind::Overlapping {
            continue;
        }
        let d = boundary_derivatives(&particle, &pose, Some(&triangle), &contact, &settings).unwrap();
        if d.flags.contains(DerivativeFlags::SWITCHING) {
            continue;
        }
        met[match contact.feature {
            Feature::Interior => 0,
            Feature::Edge0 | Feature::Edge1 | Feature::Edge2 => 1,
            _ => 2,
        }] += 1;
        for column in 0..6 {
            let axis = Vector3::ith(column % 3, 1.0);
            let motion = |step: f64| if column < 3 { (step * axis, 0.0 * axis) } else { (0.0 * axis, step * axis) };
            let by_a = derivative(1e-4, |step| {
                let (shift, turn) = motion(step);
                numbers(&at(&moved(&pose, shift, turn), &triangle, &particle))
            });
            assert_near(&columns(&d, column), &by_a, &format!("{seed}, {:?}, column {column}", contact.feature));
            let by_boundary = derivative(1e-4, |step| {
                let (shift, turn) = motion(step);
                let turn = Rotation3::from_scaled_axis(turn);
                let [a, b, c] = [corner(0.0, 0.1), corner(2.0, 0.2), corner(0.2, 2.0)]
                    .map(|v| (pose.position() + turn * (Vector3::from(v) - pose.position()) + shift).into());
                numbers(&at(&pose, &Triangle::new([a, b, c]).unwrap(), &particle))
            });
            assert_near(&columns(&d, 6 + column), &by_boundary, &format!("{seed}, boundary, column {column}"));
        }
        let weights = some_weights(true, false, scattered(seed));
        let mut shape = ShapeGradient::zeros(&particle);
        let (poses, _) =
            boundary_gradient(&particle, &pose, Some(&triangle), &contact, &settings, &weights, Some(&mut shape))
                .unwrap();
        assert!(disagreement(&weighted(&d, &weights), &poses, 1.0) < 1e-11);
        // The shape: every number of it.
        let cost = |particle: &Particle| {
            let c = at(&pose, &triangle, particle);
            [weights.s * c.s
                + weights.overlap * c.overlap
                + weights.normal.dot(&c.normal)
                + weights.point.dot(&c.point)
                + weights.point_on_a.dot(&c.on_particle)
                + weights.point_on_b.dot(&c.on_boundary)]
        };
        let planes: Vec<Plane> = particle.planes().collect();
        let (r, k, shadow) = (particle.rounding_radius(), particle.sphericity(), particle.shadow_radius());
        let near = |found: f64, f: &dyn Fn(f64) -> Particle, what: &str| {
            let [expected] = derivative(1e-4, |step| cost(&f(step)));
            assert!(
                (found - expected).abs() <= 1e-8 * (1.0 + expected.abs()),
                "{seed}, {what}: {found} for {expected}"
            );
        };
        for (i, of_plane) in shape.planes.iter().enumerate() {
            for j in 0..4 {
                let with = |step: f64| {
                    let mut planes = planes.clone();
                    if j < 3 {
                        planes[i].normal[j] += step
                    } else {
                        planes[i].offset += step
                    }
                    Particle::new(&planes, r, k, shadow).unwrap()
                };
                let found = if j < 3 { of_plane.normal[j] } else { of_plane.offset };
                near(found, &with, &format!("plane {i}, number {j}"));
            }
        }
        near(shape.r, &|step| Particle::new(&planes, r + step, k, shadow).unwrap(), "r");
        near(shape.k, &|step| Particle::new(&planes, r, k + step, shadow).unwrap(), "k");
        near(shape.shadow_radius, &|step| Particle::new(&planes, r, k, shadow + step).unwrap(), "R");
    }
    println!("{met:?} on planes, edges, vertices");
    assert!(met.iter().all(|count| *count >= 3), "{met:?}");
}

/// Motions of the plane: x, y and about z of A, then of B.
const IN_PLANE: [usize; 6] = [0, 1, 5, 6, 7, 11];

#[test]
fn polygons_move_as_differences_say_and_stay_in_the_plane() {
    let square = |half: f64, r: f64, k: f64| {
        let corners = [[-half, -half], [half, -half], [half, half], [-half, half]];
        Particle::polygon(&corners, r, k).unwrap()
    };
    let place = |[x, y, turn]: [f64; 3]| Pose::in_plane([x, y], turn).unwrap();
    let moved = |at: [f64; 3], by: &[f64]| place([at[0] + by[0], at[1] + by[1], at[2] + by[2]]);
    let beside = |d: &ContactDerivatives, columns: usize| {
        let flat = |row: usize| row < 2 || (row - 2) % 3 != 2;
        (0..columns).all(|column| {
            let leaves = !IN_PLANE.contains(&column);
            self::columns(d, column).iter().enumerate().all(|(row, v)| *v == 0.0 || !leaves && flat(row))
        })
    };
    let near = |found: &[f64; 14], expected: &[f64; 14], what: &str| {
        for (i, (found, expected)) in found.iter().zip(expected).enumerate() {
            let off = (found - expected).abs();
            assert!(off < 1e-5 * (1.0 + expected.abs()), "{what}, number {i}: {found} for {expected}");
        }
    };
    let (mut met, mut on_line) = ([0; 2], 0);
    for (i, k, formulation) in (0..12)
        .flat_map(|i| [(i, 0.1, Formulation::Midway), (i, 0.1, Formulation::Closest), (i, 0.0, Formulation::Midway)])
    {
        let (a, b) = (square(0.5, 0.1, k), square(0.4, 0.08, 2.0 * k));
        let settings = Settings::default().with_formulation(formulation).with_gap_tolerance(1e-15);
        let way = 0.5 * f64::from(i);
        let (at_a, at_b) = ([0.1, 0.2, 0.3], [0.1 + 0.85 * way.cos(), 0.2 + 0.85 * way.sin(), 1.0 + way]);
        let found =
            |by: [f64; 6]| detect(&a, &moved(at_a, &by[..3]), &b, &moved(at_b, &by[3..]), &settings, None).unwrap();
        let contact = found([0.0; 6]);
        let (pose_a, pose_b) = (place(at_a), place(at_b));
        let what = format!("{formulation}, k {k}, {i}");
        // A line, of which the square is at a corner.
        let line =
            Wall::new([0.1 + 0.55 * way.cos(), 0.2 + 0.55 * way.sin(), 0.0], [way.cos(), way.sin(), 0.0]).unwrap();
        let on = |by: &[f64]| contact_with_plane(&a, &moved(at_a, by), &line, &settings, None).unwrap();
        let flat = on(&[0.0; 3]);
        if k > 0.0 && flat.kind == Kind::Overlapping && flat.s > 1e-3 {
            let d = boundary_derivatives(&a, &pose_a, None, &flat, &settings).unwrap();
            for (n, column) in [0, 1, 5].into_iter().enumerate() {
                let expected = derivative(1e-5, |h| {
                    numbers(&on(&std::array::from_fn::<_, 3, _>(|j| if j == n { h } else { 0.0 })))
                });
                near(&columns(&d, column), &expected, &format!("line, {what}, column {column}"));
            }
            assert!(beside(&d, 6), "{what}");
            on_line += 1;
        }
        // In the cores of both there are none.
        if contact.kind == Kind::Separated || contact.formulation != formulation || contact.s < 1e-3 {
            continue;
        }
        let d = contact_derivatives(&a, &pose_a, &b, &pose_b, &contact, &settings).unwrap();
        met[usize::from(k > 0.0)] += 1;
        for (n, column) in IN_PLANE.into_iter().enumerate() {
            let expected = derivative(1e-5, |h| {
                let c = found(std::array::from_fn(|j| if j == n { h } else { 0.0 }));
                all_of([c.s, c.overlap], [c.normal, c.point, c.point_on_a, c.point_on_b])
            });
            near(&columns(&d, column), &expected, &format!("{what}, column {column}"));
        }
        assert!(beside(&d, 12), "{what}");
        // Backwards the same, and into the shape.
        let weights = some_weights(true, formulation == Formulation::Closest, scattered(i as usize));
        let mut shape = ShapeGradient::zeros(&a);
        let given = Some(&mut shape);
        let (poses, _) =
            contact_gradient(&a, &pose_a, &b, &pose_b, &contact, &settings, &weights, given, None).unwrap();
        assert!(disagreement(&weighted(&d, &weights), &poses, 1.0) < 1e-9, "{what}");
        assert!(shape.planes.iter().all(|plane| plane.normal.z == 0.0), "{what}");
    }
    assert!(met[0] > 2 && met[1] > 12 && on_line > 12, "{met:?}, {on_line}");
}

/// Against differences of the wrench, and of its energy: the second derivative in shifts is symmetric, and in turns but
/// for half the commutator of the turns.
#[test]
fn patches_change_as_differences_say_and_as_an_energy() {
    let (a, b) = (body(0.1, 0.05), body(0.15, 0.02));
    let settings = PatchSettings { tolerance: 1e-9, with_stiffness: true, ..PatchSettings::default() };
    let mut scratch = PatchScratch::new();
    for seed in 0..4 {
        let mut chance = scattered(20 * seed + 7);
        let poses = [
            Pose::new([0.3 * chance(), 0.3 * chance(), 0.86], [1.0, 0.2 * chance(), 0.2 * chance(), chance()]).unwrap(),
            Pose::new([0.1, 0.0, 0.0], [1.0, 0.3 * chance(), 0.2, 0.1]).unwrap(),
        ];
        let mut wrench = |poses: &[Pose; 2]| {
            let [pa, pb] = poses;
            let contact = detect(&a, pa, &b, pb, &Settings::default(), None).unwrap();
            let patch = patch_of_contact(&a, pa, &b, pb, &contact, &settings, &mut scratch, |_| ()).unwrap();
            let derivatives = patch_derivatives(&patch, [contact.branch_a, contact.branch_b]).unwrap();
            let on_a = -(patch.torque + contact.branch_a.cross(&patch.force));
            let on_b = patch.torque + contact.branch_b.cross(&patch.force);
            let mut all = [0.0; 9];
            for (i, v) in [patch.force, on_a, on_b].iter().enumerate() {
                all[3 * i..3 * i + 3].copy_from_slice(v.as_slice());
            }
            (all, derivatives)
        };
        let (here, d) = wrench(&poses);
        let rows = [d.force, d.torque_on_a, d.torque_on_b];
        let most = d.force.amax();
        for column in 0..12 {
            let (body, axis) = (column / 6, Vector3::ith(column % 3, 1.0));
            let h = 1e-5;
            let mut ends = [1.0, -1.0].map(|sign| {
                let step = sign * h * axis;
                let mut poses = poses;
                let zero = Vector3::zeros();
                poses[body] =
                    if column % 6 < 3 { moved(&poses[body], step, zero) } else { moved(&poses[body], zero, step) };
                wrench(&poses).0
            });
            let [up, down] = &mut ends;
            for i in 0..9 {
                let expected = (up[i] - down[i]) / (2.0 * h);
                let found = rows[i / 3][(i % 3, column)];
                assert!(
                    (found - expected).abs() < 2e-4 * most,
                    "{seed}: row {i}, column {column}: {found} for {expected}"
                );
            }
        }
        // Generalised forces on A and B in the order of the columns.
        let force = |row: usize, column: usize| match row {
            0..3 => -d.force[(row, column)],
            3..6 => d.torque_on_a[(row - 3, column)],
            6..9 => d.force[(row - 6, column)],
            _ => d.torque_on_b[(row - 9, column)],
        };
        let torque = [Vector3::new(here[3], here[4], here[5]), Vector3::new(here[6], here[7], here[8])];
        for i in 0..12 {
            for j in 0..12 {
                let mut commutator = 0.0;
                if i / 6 == j / 6 && i % 6 >= 3 && j % 6 >= 3 {
                    commutator = torque[i / 6].dot(&Vector3::ith(i % 3, 1.0).cross(&Vector3::ith(j % 3, 1.0)));
                }
                let off = force(i, j) - force(j, i) - commutator;
                assert!(off.abs() < 1e-4 * most, "{seed}: ({i}, {j}): {off:e} of {most:e}");
            }
        }
    }
}
