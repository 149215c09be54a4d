//! Particles in the plane (the paper's eqs 1 and 5 to 31): closed forms by both back ends, polygons from points, and
//! what every call answers or refuses of them. Random ones are among the pairs, walls, patches and mass properties of
//! `stress`.

use nalgebra::{Vector2, Vector3};
use potential_particles::packing::{PackError, Sizes, Supply};
use potential_particles::*;
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_4, PI, SQRT_2, TAU};

const BACK_ENDS: [BackEnd; 2] = [BackEnd::Fast, BackEnd::ConeProgram];

fn square(half: f64, r: f64, k: f64) -> Particle {
    let d = half - r;
    let lines = [[1.0, 0.0, d], [0.0, 1.0, d], [-1.0, 0.0, d], [0.0, -1.0, d]];
    Particle::in_plane(&lines, r, k, 1.6 * half).unwrap()
}

fn circle(radius: f64) -> Particle {
    Particle::in_plane(&[], 0.0, 1.0, radius).unwrap()
}

/// A rectangle about the origin, of these half edges.
fn rectangle(x: f64, y: f64, r: f64, k: f64) -> Particle {
    Particle::polygon(&[[-x, -y], [x, -y], [x, y], [-x, y]], r, k).unwrap()
}

fn at(x: f64, y: f64, angle: f64) -> Pose {
    Pose::in_plane([x, y], angle).unwrap()
}

fn solve(a: &Particle, at_a: &Pose, b: &Particle, at_b: &Pose, back_end: BackEnd) -> Contact {
    let settings = Settings::default().with_back_end(back_end).with_solve_separated(true);
    detect(a, at_a, b, at_b, &settings, None).unwrap()
}

/// A half turn about the centre of the patch swaps the two squares.
#[test]
fn stacked_squares_touch_at_the_centre_of_the_patch() {
    for (half, r, k) in [(0.5, 0.1, 0.0), (0.5, 1e-6, 0.0), (0.5, 1e-3, 0.2), (2.0, 1e-6, 1e-6)] {
        for (angle, shift) in [(0.0, 0.0), (0.0, 0.3 * half), (0.4, 0.0), (0.4, -0.7 * half)] {
            let (body, low) = (square(half, r, k), at(0.3, -0.2, angle));
            let across = Vector3::new(f64::cos(angle), f64::sin(angle), 0.0);
            let up = Vector3::z().cross(&across);
            let way: Vector3<f64> = shift * across + (2.0 * half - 0.5 * r) * up;
            let (high, centre) = (at(0.3 + way.x, -0.2 + way.y, angle), low.position() + 0.5 * way);
            let y = low.to_local(&centre);
            let s = (body.potential(&y) + 1.0).sqrt();
            let normal = if k == 0.0 { up } else { low.rotate(&body.gradient(&y)).normalize() };
            for back_end in BACK_ENDS {
                let contact = solve(&body, &low, &body, &high, back_end);
                let accuracy = if back_end == BackEnd::Fast { 32.0 * f64::EPSILON * half / r } else { 1e-7 };
                assert!((contact.s - s).abs() <= accuracy + contact.gap, "{back_end:?} {} for {s}", contact.s);
                assert!((contact.normal - normal).norm() < 1e-6 && contact.normal.z == 0.0, "{contact:?}");
                // The boundary is flat there for k = 0 only.
                assert!(k > 0.0 || (contact.overlap - 0.5 * r).abs() < 1e-9, "{}", contact.overlap);
                let off = contact.point - centre;
                if back_end == BackEnd::Fast {
                    assert!(off.norm() < 1e-9 && off.norm() <= contact.point_bound, "{off}, {contact:?}");
                } else {
                    // Any point of the patch solves the cone program.
                    assert!(off.dot(&up).abs() < 1e-6 && off.dot(&across).abs() < half && off.z == 0.0, "{off}");
                }
            }
        }
    }
}

#[test]
fn a_corner_on_a_side_keeps_its_digits() {
    for r in [1e-2, 1e-4, 1e-6] {
        let (half, k, shadow) = (0.5, 1e-6, 0.8);
        let d = half - r;
        // √2·p + v = 1 with line depths p·r of the corner's two lines and v·r of the side's.
        let s = |lines: f64, depth: f64, distance: f64| {
            (lines * (1.0 - k) * depth * depth + k * (distance / shadow).powi(2)).sqrt()
        };
        let both = |p: f64| {
            let v = 1.0 - SQRT_2 * p;
            (s(2.0, p, SQRT_2 * (d + r * p)), s(1.0, v, d + r * v))
        };
        let (mut low, mut high) = (0.0, FRAC_1_SQRT_2);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            let (of_a, of_b) = both(middle);
            if of_a < of_b { low = middle } else { high = middle }
        }
        for back_end in BACK_ENDS {
            let body = square(half, r, k);
            let above = at(0.0, d + SQRT_2 * d + r, FRAC_PI_4);
            let contact = solve(&body, &above, &body, &at(0.0, 0.0, 0.0), back_end);
            let accuracy = if back_end == BackEnd::Fast { 32.0 * f64::EPSILON / r } else { 1e-8 };
            assert!((contact.s - both(low).0).abs() <= accuracy, "{back_end:?}, r = {r}: {contact:?}");
            assert!(contact.gap <= 10.0 * accuracy, "{back_end:?}, r = {r}: gap {}", contact.gap);
            assert!(contact.point.x.abs() < 1e-4 && (contact.normal + Vector3::y()).norm() < 1e-4, "{contact:?}");
        }
    }
}

#[test]
fn contact_length_matches_closed_forms() {
    let length = |body: &Particle, here: &Pose, there: &Pose| {
        let section = Section::from(&solve(body, here, body, there, BackEnd::Fast));
        section.area(body, here, body, there, 1e-6).unwrap()
    };
    // Two unit circles at distance 1.
    assert!((length(&circle(1.0), &at(0.0, 0.0, 0.0), &at(0.6, 0.8, 2.0)) - 3f64.sqrt()).abs() < 1e-14);
    // Squares side on side, one shifted by `shift`: the core, and on each end what the cut leaves of r.
    let (half, r, s) = (0.5, 0.1, 0.5f64);
    for (shift, angle) in [(0.0, 0.0), (0.25, 0.0), (-0.6, 1.0)] {
        let (sin, cos) = f64::sin_cos(angle);
        let height = 2.0 * (half - r + s * r);
        let there = at(3.0 + shift * cos - height * sin, 4.0 + shift * sin + height * cos, angle);
        let expected = 2.0 * (half - r + r * (1.0 - s * s).sqrt()) - f64::abs(shift);
        let found = length(&square(half, r, 0.0), &at(3.0, 4.0, angle), &there);
        assert!((found - expected).abs() < 1e-12, "{found} for {expected}");
    }
}

#[test]
fn each_violation_is_its_own_error_and_names_the_value() {
    let lines = [[1.0, 0.0, 0.45], [0.0, 1.0, 0.45], [-1.0, 0.0, 0.45], [0.0, -1.0, 0.45]];
    let with = |line: usize, number: usize, value: f64| {
        let mut lines = lines;
        lines[line][number] = value;
        Particle::in_plane(&lines, 0.05, 0.1, 0.9)
    };
    let open = "the lines do not enclose an area";
    for (made, text) in [
        (with(3, 2, f64::NAN), "line 3 is not finite: a=0.0, b=-1.0, d=NaN"),
        (with(1, 1, 0.0), "line 1 has a normal of length zero"),
        (with(1, 2, -0.06), "line 1 (d=-0.06)"),
        (Particle::in_plane(&lines, 0.05, -0.1, 0.9), "k=-0.1"),
        (Particle::in_plane(&lines, 0.0, 0.1, 0.9), "r=0"),
        (Particle::in_plane(&lines, 0.05, 0.1, -2.0), "R=-2"),
        (Particle::in_plane(&lines[..3], 0.05, 0.0, 0.9), open),
        // A strip, bounded one way only.
        (Particle::in_plane(&[lines[0], lines[2]], 0.05, 0.0, 0.9), open),
        (Particle::in_plane(&vec![lines[0]; 65_537], 0.05, 0.1, 0.9), "65537 lines"),
    ] {
        let message = made.unwrap_err().to_string();
        assert!(message.contains(text) && !message.contains("plane") && !message.contains("c="), "{message}: {text}");
    }
    // Three lines are enough, and the circle closes what lines leave open.
    assert!(Particle::in_plane(&[[0.8, 0.6, 0.3], [-0.8, 0.6, 0.3], [0.0, -1.0, 0.3]], 0.1, 0.0, 0.0).is_ok());
    assert!(Particle::in_plane(&lines[..1], 0.05, 0.1, 0.9).is_ok());
    let pose = |y: f64, angle: f64| Pose::in_plane([0.0, y], angle).unwrap_err().to_string();
    assert!(pose(f64::NAN, 0.0).contains("(0.0, NaN, 0.0)") && pose(0.0, f64::INFINITY).contains("angle inf"));
    assert!(pose(0.0, -1.1e9).contains("-1100000000.0") && pose(0.0, -1.1e9).contains("whole turns"));
    assert!(Pose::in_plane([0.0; 2], -1.07e9).is_ok());
}

/// Area of a convex polygon with rounded corners, k = 0: by u and v, the distances beyond the two lines of a corner,
/// the boundary there is u² + v² = r², and an area is du dv over the sine of the turn between the sides.
#[test]
fn polygons_have_the_area_of_their_corners_wherever_they_lie() {
    let hexagon: Vec<[f64; 2]> = (0..6).map(|i| (PI * f64::from(i) / 3.0).sin_cos()).map(|(s, c)| [c, s]).collect();
    for corners in
        [vec![[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]], vec![[0.0, 0.0], [5.0, -1.0], [6.0, 2.0], [1.0, 3.0]], hexagon]
    {
        let place = |i: usize| Vector2::from(corners[i % corners.len()]);
        let part = |i: usize| {
            let turn = (place(i + 1) - place(i)).angle(&(place(i + 2) - place(i + 1)));
            0.5 * place(i).perp(&place(i + 1)) - 0.05 * 0.05 * (1.0 - 0.25 * PI) / turn.sin()
        };
        let expected = (0..corners.len()).map(part).sum::<f64>();
        for (scale, far) in [(1.0, 0.0), (1e-6, 1.0), (1e6, -1e8), (1.0, 1e6)] {
            // Reversed, with a point inside and one on a side: the hull is the same.
            let mut points: Vec<[f64; 2]> =
                corners.iter().rev().map(|c| [scale * c[0] + far, scale * c[1] - far]).collect();
            let mean = |p: [f64; 2], q: [f64; 2]| [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])];
            let on_side = mean(points[0], points[1]);
            points.extend([on_side, mean(on_side, points[2])]);
            let particle = Particle::polygon(&points, 0.05 * scale, 0.0).unwrap();
            let found = particle.mass_properties(1e-10).unwrap().volume / (scale * scale);
            // Points are rounded to an ulp of where they lie.
            let rounding = 1e-9 + 1e-15 * far.abs() / scale;
            assert!((found / expected - 1.0).abs() < rounding, "{found} for {expected} at {far}");
        }
    }
    let (x, y) = (1.5, 0.25);
    for point in [[x, 0.1, 0.0], [-x, -0.1, 0.0], [0.7, y, 0.0], [-0.7, -y, 0.0]] {
        assert!(rectangle(x, y, 0.02, 0.0).potential(&point.into()).abs() < 1e-12, "{point:?}");
    }
    let pentagon: Vec<[f64; 2]> = (0..5).map(|i| (PI * f64::from(i) / 2.5).sin_cos()).map(Into::into).collect();
    let disc = Particle::polygon(&pentagon, 1e-3, 1.0).unwrap().mass_properties(1e-9).unwrap();
    assert!((disc.volume / PI - 1.0).abs() < 1e-8, "k = 1: the circle through the corners");
}

#[test]
fn what_is_no_polygon_is_refused() {
    type E = ParticleError;
    let said = |points: &[[f64; 2]], r: f64, k: f64| Particle::polygon(points, r, k).unwrap_err();
    let triangle = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    for points in [&[][..], &triangle[..2], &[[1.0, 1.0]; 9]] {
        assert_eq!(said(points, 0.1, 0.0), E::FlatVertices(points.len()));
    }
    let line: Vec<[f64; 2]> = (0..20).map(|i| [1e3 + 0.1 * f64::from(i), 1e3 + 0.3 * f64::from(i)]).collect();
    assert!(matches!(said(&line, 1e-3, 0.0), E::FlatVertices(20) | E::RoundingTooLarge { .. }));
    let spoilt = [[0.0, 0.0], [1.0, f64::NAN], [0.0, 1.0]];
    assert!(matches!(said(&spoilt, 0.1, 0.0), E::VertexNotFinite { index: 1, .. }));
    assert!(matches!(said(&triangle, 0.5, 0.0), E::RoundingTooLarge { .. }));
    assert!(matches!(said(&triangle, 0.0, 0.0), E::RoundingRadius(_)));
    assert!(matches!(said(&triangle, f64::NAN, 0.0), E::RoundingRadius(_)));
    assert!(matches!(said(&triangle, 0.1, 1.5), E::Sphericity(_)));
}

/// The same polygon with normals of any length, and d and r with them, or d alone and so with sharp corners, or neither
/// and so as many times smaller: its area is told, and the call ends.
#[test]
fn areas_are_right_for_normals_of_any_length() {
    let area = |sides: usize, length: f64, of_d: f64, of_r: f64| {
        let lines = (0..sides).map(|i| {
            let (sin, cos) = (0.3 + TAU * i as f64 / sides as f64).sin_cos();
            [length * cos, length * sin, 0.4 * of_d]
        });
        let made = Particle::in_plane(&lines.collect::<Vec<_>>(), 0.1 * of_r, 0.0, 1.0);
        made.map(|particle| particle.mass_properties(1e-6).unwrap())
    };
    for sides in [3, 4, 7] {
        let known = area(sides, 1.0, 1.0, 1.0).unwrap();
        let sharp = sides as f64 * 0.16 * (PI / sides as f64).tan();
        for length in [1e-8, 1e3, 1e8, 1e16, 1e29] {
            let (alike, small) = (area(sides, length, length, length).unwrap(), area(sides, length, 1.0, 1.0).unwrap());
            let off = [alike.volume / known.volume - 1.0, small.volume * length * length / known.volume - 1.0];
            assert!(off[0].abs() <= alike.error + known.error, "{sides}, {length:e}: {alike:?}");
            assert!(off[1].abs() <= small.error + known.error, "{sides}, {length:e}: {small:?}");
            let found = area(sides, length, length, 1.0).unwrap();
            let near = (found.volume / sharp - 1.0).abs() <= found.error + 10.0 / length;
            assert!(near || length <= 1e8, "{sides}, {length:e}: {found:?}");
        }
        // Beyond the range of sizes the length is named.
        let error = area(sides, 1e40, 1.0, 1.0).unwrap_err();
        assert!(matches!(error, ParticleError::Size { radius } if radius < 1e-30), "{error}");
    }
}

fn refused<T: std::fmt::Debug>(answer: Result<T, DetectError>) -> InPlaneError {
    match answer {
        Err(DetectError::InPlane(error)) => error,
        other => panic!("{other:?}"),
    }
}

#[test]
fn other_kinds_and_poses_that_leave_the_plane_are_refused() {
    let (disc, ball, settings) = (circle(1.0), Particle::sphere(1.0).unwrap(), Settings::default());
    let (home, near) = (at(0.0, 0.0, 0.0), at(1.5, 0.0, 1.0));
    let mixed = refused(detect(&disc, &home, &ball, &near, &settings, None));
    assert!(mixed == InPlaneError::Mixed && mixed.to_string().contains("make both by in_plane"));
    let raised = Pose::new([1.5, 0.0, 0.25], [1.0, 0.0, 0.0, 0.0]).unwrap();
    for (at_a, at_b) in [(&home, &raised), (&raised, &home)] {
        assert_eq!(refused(detect(&disc, at_a, &disc, at_b, &settings, None)), InPlaneError::Height(0.25));
    }
    for leaning in [[1.0, 0.5, 0.0, 0.0], [1.0, 0.0, 1e-300, 0.2], [0.0, 1.0, 0.0, 0.0]] {
        let [w, x, y, z] = leaning;
        let pose = Pose::new([1.5, 0.0, 0.0], leaning).unwrap();
        let error = refused(closest_point(&disc, &home, &disc, &pose, Role::A, &settings));
        assert_eq!(error, InPlaneError::Turn(w, x, y, z));
        let batch = detect_batch(&[&disc, &disc], &[home, pose], &[[0, 1]], &settings, 1, &mut []).unwrap();
        assert!(matches!(batch[0], Err(DetectError::InPlane(_))));
    }
    let floor = Wall::new([0.0, -0.5, 0.0], [0.0, 1.0, 0.1]).unwrap();
    let error = refused(contact_with_plane(&disc, &home, &floor, &settings, None));
    assert!(matches!(error, InPlaneError::Normal(z) if z > 0.0));
    let triangle = Triangle::new([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]).unwrap();
    let error = refused(contact_with_triangle(&disc, &home, &triangle, &settings, None));
    assert!(error == InPlaneError::Triangle && error.to_string().contains("(x, y, 0)"));
    let contact = detect(&disc, &home, &disc, &near, &settings, None).unwrap();
    let section = Section::from(&contact);
    assert_eq!(section.area(&disc, &home, &ball, &near, 1e-6), None);
    assert_eq!(Section { normal: Vector3::zeros(), ..section }.area(&disc, &home, &disc, &near, 1e-6), None);
    let nowhere = Section { branch_a: Vector3::repeat(f64::NAN), ..section };
    assert_eq!(nowhere.area(&disc, &home, &disc, &near, 1e-6), None);
    let scratch = &mut PatchScratch::new();
    let patch = patch_of_contact(&disc, &home, &ball, &near, &contact, &PatchSettings::default(), scratch, |_| ());
    assert!(patch.unwrap_err().to_string().contains("make both by in_plane"));
    let packed = Supply::new(&[ball, disc], &Sizes::as_given(), 0.0);
    assert!(matches!(packed, Err(PackError::InPlane(1))), "{packed:?}");
}

/// A scaled particle and one that was written down and read back lie in the plane, too.
#[test]
fn copies_stay_in_the_plane() {
    let square = rectangle(0.5, 0.7, 0.1, 0.2);
    let twice = square.scaled(2.0).unwrap();
    assert!(twice.is_in_plane() && (twice.bounding_radius() / square.bounding_radius() - 2.0).abs() < 1e-12);
    for particle in [square, Particle::sphere(1.0).unwrap()] {
        let back: Particle = serde_json::from_str(&serde_json::to_string(&particle).unwrap()).unwrap();
        assert!(back.is_in_plane() == particle.is_in_plane() && back.planes().eq(particle.planes()));
    }
    let pose = at(1.0, 2.0, 0.3);
    assert_eq!(serde_json::from_str::<Pose>(&serde_json::to_string(&pose).unwrap()).unwrap(), pose);
}

/// Every point of the boundary is in the box, the ball and the corners, which are not much larger.
#[test]
fn bounds_hold_every_point_of_the_boundary() {
    for (particle, far) in [(rectangle(0.5, 0.7, 0.1, 0.02), 1.1), (square(0.4, 1e-3, 0.0), 1.1), (circle(0.3), 1.01)] {
        let pose = at(3.0, -2.0, 0.8);
        let (lower, upper) = particle.bounding_box(&pose);
        let mut fullest: f64 = 0.0;
        for i in 0..500 {
            let (sin, cos) = (f64::from(i) * TAU / 500.0).sin_cos();
            let e = Vector3::new(cos, sin, 0.0);
            let x = particle.surface_distance(&Vector3::zeros(), &e).unwrap() * e;
            assert!(particle.potential(&x).abs() < 1e-10 && x.norm() <= particle.bounding_radius());
            assert!(x.dot(&e) <= particle.bounding_corners().iter().map(|c| c.dot(&e)).fold(0.0, f64::max));
            let world = pose.position() + pose.rotate(&x);
            assert!((0..2).all(|axis| lower[axis] <= world[axis] && world[axis] <= upper[axis]));
            fullest = fullest.max(x.norm());
        }
        assert!(particle.bounding_radius() < far * fullest, "{} for {fullest}", particle.bounding_radius());
    }
}

/// The mesh is a polygon within the tolerance of the outline, its corners in order, its triangles the area.
#[test]
fn meshes_are_polygons() {
    let particle = rectangle(0.5, 0.7, 0.1, 0.02);
    let area = particle.mass_properties(1e-9).unwrap().volume;
    for tolerance in [1e-2, 1e-4, 1e-6] {
        let mesh = SurfaceMesh::of(&particle, tolerance).unwrap();
        let length = tolerance * particle.bounding_radius();
        assert!(mesh.error <= length);
        let (mut enclosed, mut perimeter) = (0.0, 0.0);
        for ((here, next), normal) in mesh.vertices.iter().zip(mesh.vertices.iter().cycle().skip(1)).zip(&mesh.normals)
        {
            assert!(particle.potential(here).abs() < 1e-9 && here.z == 0.0 && here.cross(next).z > 0.0);
            assert!((normal - particle.gradient(here).normalize()).norm() < 1e-12);
            perimeter += (next - here).norm();
            let across = (next - here).cross(&Vector3::z()).normalize();
            for t in 1..20 {
                let on = here + f64::from(t) / 20.0 * (next - here);
                let beyond = particle.surface_distance(&on, &across).unwrap();
                assert!(beyond <= length, "{beyond:e} beyond {length:e}");
            }
        }
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.map(|i| mesh.vertices[i as usize]);
            enclosed += 0.5 * (b - a).cross(&(c - a)).z;
        }
        assert!(enclosed < area && area - enclosed < length * perimeter, "{enclosed} of {area}");
    }
}

/// A square on a line presses by its depth, its rounded ends by what √(1 − v²) leaves, v = 1 − depth/r.
#[test]
fn patches_on_lines_match_closed_forms() {
    let (half, r, depth) = (0.5, 0.1, 1e-3);
    let square = rectangle(half, half, r, 0.0);
    for turn in [0.0, 0.3, 2.0] {
        let (sin, cos) = f64::sin_cos(turn);
        let up = Vector3::new(-sin, cos, 0.0);
        let line = Wall::new([3.0, 4.0, 0.0], up.into()).unwrap();
        let place = Vector3::new(3.0, 4.0, 0.0) + (half - depth) * up + 7.0 * Vector3::new(cos, sin, 0.0);
        let pose = at(place.x, place.y, turn);
        let contact = contact_with_plane(&square, &pose, &line, &Settings::default(), None).unwrap();
        assert!((contact.overlap - depth).abs() < 1e-9 && (contact.normal + up).norm() < 1e-9, "{contact:?}");
        let settings = PatchSettings { tolerance: 1e-8, ..PatchSettings::default() };
        let patch = patch_on_plane(&square, &pose, &contact, &settings, &mut PatchScratch::new(), |_| ()).unwrap();
        let v = 1.0 - depth / r;
        let u = (1.0 - v * v).sqrt();
        let beyond = r * (u - 0.5 * (u * (v * v + u * u).sqrt() + v * v * (u / v).asinh()));
        let force = r * (2.0 * (half - r) * (1.0 - v) + 2.0 * beyond);
        assert!((patch.area / (2.0 * (half - r + r * u)) - 1.0).abs() < 1e-7, "{patch:?}");
        assert!((patch.force.norm() / force - 1.0).abs() < 1e-6 && patch.force.z == 0.0, "{patch:?} for {force:e}");
    }
}
