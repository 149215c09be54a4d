//! A particle and a plane or triangle of any numbers: refused, or an answer that holds together, on the boundary, and
//! of the same kind whether or not it was solved to the end.

use super::bytes::Bytes;
use super::detect::pose;
use super::particle;
use nalgebra::Vector3;
use potential_particles::{
    DetectError, Flags, FlatContact, Kind, Particle, Pose, Settings, Triangle, Wall, contact_with_plane,
    contact_with_triangle,
};

enum Boundary {
    Plane(Wall),
    Triangle(Triangle, [[f64; 3]; 3]),
}

pub fn run(data: &[u8]) {
    let mut bytes = Bytes(data);
    let Ok(particle) = particle::likely(&mut bytes) else { return };
    let Some(at) = pose(&mut bytes) else { return };
    let Some(boundary) = boundary(&mut bytes, &particle, &at) else { return };
    let mut settings = Settings::default();
    if bytes.byte() & 1 != 0 {
        settings.gap_tolerance = bytes.number();
        settings.flat_regularisation = bytes.number();
    }
    let quick = solve(&particle, &at, &boundary, &settings);
    let full = solve(&particle, &at, &boundary, &settings.with_solve_separated(true));
    if settings.validate().is_err() {
        assert!(quick.is_err() && full.is_err());
        return;
    }
    for contact in [&quick, &full].into_iter().flatten() {
        whole(contact);
        if settings.gap_tolerance < 1e-4 && settings.flat_regularisation < 1e-4 {
            says_something(contact);
        }
        if let Boundary::Triangle(_, vertices) = &boundary {
            in_box(contact, vertices, &at);
        }
    }
    if let (Ok(quick), Ok(full)) = (&quick, &full) {
        let near = (full.s - 1.0).abs() <= full.gap;
        assert!(quick.kind == full.kind || near, "{quick:?} {full:?}");
    }
}

/// Anywhere, or in a plane parallel to a face.
fn boundary(bytes: &mut Bytes, particle: &Particle, at: &Pose) -> Option<Boundary> {
    let choice = bytes.byte();
    let face = particle.planes().nth(usize::from(bytes.byte()) % particle.plane_count().max(1));
    if let Some(face) = face.filter(|_| choice & 1 != 0) {
        // As deep as the bytes say, from the centre to beyond the surface.
        let way = face.normal.try_normalize(0.0)?;
        let depth = particle.bounding_radius() * f64::from(bytes.byte()) / 128.0;
        let normal = at.rotate(&way);
        let point = at.position() + depth * normal;
        if choice & 2 != 0 {
            return Wall::new(point.into(), normal.into()).ok().map(Boundary::Plane);
        }
        let first = normal.cross(&Vector3::ith(normal.iamin(), 1.0));
        let second = normal.cross(&first);
        let vertices = [0; 3].map(|_| (point + bytes.ordinary() * first + bytes.ordinary() * second).into());
        return Triangle::new(vertices).ok().map(|triangle| Boundary::Triangle(triangle, vertices));
    }
    if choice & 2 != 0 {
        return Wall::new(bytes.triple(), bytes.triple()).ok().map(Boundary::Plane);
    }
    let vertices = [bytes.triple(), bytes.triple(), bytes.triple()];
    Triangle::new(vertices).ok().map(|triangle| Boundary::Triangle(triangle, vertices))
}

fn solve(a: &Particle, at: &Pose, boundary: &Boundary, settings: &Settings) -> Result<FlatContact, DetectError> {
    match boundary {
        Boundary::Plane(wall) => contact_with_plane(a, at, wall, settings, None),
        Boundary::Triangle(triangle, _) => contact_with_triangle(a, at, triangle, settings, None),
    }
}

fn whole(contact: &FlatContact) {
    let overlapping = contact.kind == Kind::Overlapping;
    if contact.flags.contains(Flags::REJECTED) {
        assert!(!overlapping && contact.s >= 1.0 && contact.distance >= 0.0, "{contact:?}");
        return;
    }
    assert!(contact.s >= 0.0 && contact.gap >= 0.0 && contact.point_bound >= 0.0, "{contact:?}");
    assert!((contact.normal.norm() - 1.0).abs() < 1e-12, "{contact:?}");
    assert!(contact.point.iter().chain(contact.branch.iter()).all(|c| c.is_finite()), "{contact:?}");
    assert_eq!(overlapping, contact.s < 1.0, "{contact:?}");
    assert_eq!(overlapping, contact.overlap >= 0.0, "{contact:?}");
    assert_eq!(overlapping, contact.on_particle.iter().all(|c| c.is_finite()), "{contact:?}");
    assert_eq!(!overlapping, contact.distance >= 0.0, "{contact:?}");
}

fn says_something(contact: &FlatContact) {
    let open = contact.gap > 1e-2 && contact.s - contact.gap < 1.0 && 1.0 < contact.s + contact.gap;
    assert!(!open, "s = {:e} ± {:e} says nothing", contact.s, contact.gap);
}

/// No point of a triangle lies outside the box of its vertices.
fn in_box(contact: &FlatContact, vertices: &[[f64; 3]; 3], at: &Pose) {
    if contact.flags.contains(Flags::REJECTED) {
        return;
    }
    let size = vertices.iter().flatten().map(|c| c.abs()).fold(at.position().amax(), f64::max);
    for i in 0..3 {
        let axis = vertices.map(|v| v[i]);
        let (low, high) = axis.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), c| (l.min(*c), h.max(*c)));
        let on = contact.on_boundary[i];
        let rounding = 256.0 * f64::EPSILON * size;
        assert!(on >= low - rounding && on <= high + rounding, "{contact:?}");
    }
}
