//! Builders of particles over the C boundary: from half-spaces or points to a particle about its centroid.

use super::convert::planes_of;
use super::message::{Refusal, explain};
use super::output::{IfWanted, New};
use super::particle::pp_particle;
use super::status::*;
use super::types::pp_mass_properties;
use crate::shapes::{self, Rounding, Shape, ShapeError};
use std::ffi::c_char;

/// How a particle that was built stands in the frame of its planes or points: x_given = centroid +
/// orientation x.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_built {
    /// Origin of the particle's frame, which is its centroid; in the given frame, length.
    pub centroid: [f64; 3],
    /// Quaternion (w, x, y, z) of unit length, w >= 0, that turns from the particle's frame, whose axes are
    /// principal axes of inertia, to the given one.
    pub orientation: [f64; 4],
    /// Of the particle in its own frame, to 1e-6; with more than 30 planes to 1e-4.
    pub mass: pp_mass_properties,
    /// Volume of what it was made of: of the sharp body, or of the round one that was asked for.
    pub sharp_volume: f64,
}

/// Forms of pp_particle_round: a cylinder along z, {radius, height}.
pub const PP_ROUND_CYLINDER: u32 = 0;
/// A cone along z, its tip above: {radius, height}.
pub const PP_ROUND_CONE: u32 = 1;
/// An ellipsoid of semi-axes along x, y, z, {a, b, c}: exact, of 6 planes.
pub const PP_ROUND_ELLIPSOID: u32 = 2;
/// All points within a distance of a segment along z, {radius, length}: exact, of 6 planes.
pub const PP_ROUND_CAPSULE: u32 = 3;
/// (|x/a|^(2/e) + |y/b|^(2/e))^(e/n) + |z/c|^(2/n) <= 1, {a, b, c, n, e}: n and e from 0.1 to 2.
pub const PP_ROUND_SUPERQUADRIC: u32 = 4;

/// Builds a particle whose faces are at given planes, about its centroid and along its principal axes.
///
/// planes: count rows of a, b, c, h; inside is a x + b y + c z <= h. (a, b, c) may have any length. These
/// are the faces themselves; the planes of pp_particle_new lie deeper, by about r. Planes that make no face
/// are left out.
/// rounding: the rounding radius r over the size, in (0, 0.5). The size is the diameter of the largest ball
/// between the planes. k: sphericity, in [0, 1). shadow: R over the size, or 0 for the distance from the
/// centroid to the farthest corner. pp_particle_from_polyhedron takes lengths.
/// out: receives the particle; release it with pp_particle_free.
/// built: receives how it stands in the given frame, and its mass properties (may be NULL).
/// message: receives, on failure, a sentence that names the plane or value (may be NULL).
/// Errors: PP_NULL_POINTER, PP_PLANE_ZERO_NORMAL (also of a plane whose numbers are not finite),
/// PP_UNBOUNDED (the planes enclose no volume), and those of pp_particle_new.
/// Pointers: planes points to 4*count doubles, out to one pointer, built to one struct, message to
/// message_size bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_from_faces(
    planes: *const f64,
    count: usize,
    rounding: f64,
    k: f64,
    shadow: f64,
    out: *mut *mut pp_particle,
    built: *mut pp_built,
    message: *mut c_char,
    message_size: usize,
) -> pp_status {
    explain!(message[message_size], "out", (New(out), IfWanted(built)), [planes[count]], {
        Ok(built_from(shapes::half_spaces(&planes_of(planes), &shares(rounding, k, shadow))?))
    })
}

/// Builds a particle from the convex hull of points, about its centroid and along its principal axes.
///
/// points: count rows of x, y, z, in any order; those inside the hull do not matter. No part of the particle
/// lies outside the hull. Triangles of the hull that are coplanar to 1e-6 of its extent are one face.
/// All else as pp_particle_from_faces.
/// Errors: PP_NULL_POINTER, PP_BAD_POINT, PP_UNBOUNDED (fewer than four points, or all in one plane), and
/// those of pp_particle_new.
/// Pointers: points points to 3*count doubles, out to one pointer, built to one struct, message to
/// message_size bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_from_points(
    points: *const f64,
    count: usize,
    rounding: f64,
    k: f64,
    shadow: f64,
    out: *mut *mut pp_particle,
    built: *mut pp_built,
    message: *mut c_char,
    message_size: usize,
) -> pp_status {
    explain!(message[message_size], "out", (New(out), IfWanted(built)), [points[count]], {
        Ok(built_from(shapes::hull(points, &shares(rounding, k, shadow))?))
    })
}

/// Builds a particle of the size of a round form, about its centroid, which is near the origin.
///
/// form: PP_ROUND_CYLINDER or another of these constants. sizes: as they say, lengths; five are read.
/// planes: sides of a cylinder or cone, at most so many planes of a superquadric; 0 for 48. r: rounding radius,
/// length, or 0 for what keeps the size. k and shadow_radius: as of pp_particle_from_polyhedron. Ellipsoids and
/// capsules take none of these four.
/// All else as pp_particle_from_faces.
/// Errors: PP_NULL_POINTER, PP_BAD_INDEX (form), PP_UNBOUNDED (a size or number out of range: the message
/// says which), and those of pp_particle_new.
/// Pointers: sizes points to 5 doubles, out to one pointer, built to one struct, message to message_size bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_round(
    form: u32,
    sizes: *const f64,
    planes: usize,
    r: f64,
    k: f64,
    shadow_radius: f64,
    out: *mut *mut pp_particle,
    built: *mut pp_built,
    message: *mut c_char,
    message_size: usize,
) -> pp_status {
    explain!(message[message_size], "out", (New(out), IfWanted(built)), [sizes], {
        let sizes: &[f64; 5] = sizes;
        let [a, b, c, n, e] = *sizes;
        let planes = if planes == 0 { shapes::SIDES } else { planes };
        let rounding = lengths(r, k, shadow_radius);
        Ok(built_from(match form {
            PP_ROUND_CYLINDER => shapes::cylinder(a, b, planes, &rounding)?,
            PP_ROUND_CONE => shapes::cone(a, b, planes, &rounding)?,
            PP_ROUND_ELLIPSOID => shapes::ellipsoid([a, b, c])?,
            PP_ROUND_CAPSULE => shapes::capsule(a, b)?,
            PP_ROUND_SUPERQUADRIC => shapes::superquadric([a, b, c], [n, e], planes, &rounding)?,
            _ => return Err(PP_BAD_INDEX.into()),
        }))
    })
}

/// r, where it is not 0, and R likewise, lengths.
pub(super) fn lengths(r: f64, k: f64, shadow_radius: f64) -> Rounding {
    let rounding = if r == 0.0 { Rounding::chosen(k) } else { Rounding::of_radius(r, k) };
    if shadow_radius == 0.0 { rounding } else { rounding.with_shadow_radius(shadow_radius) }
}

fn shares(rounding: f64, k: f64, shadow: f64) -> Rounding {
    let rounding = Rounding::new(rounding, k);
    if shadow == 0.0 { rounding } else { rounding.with_shadow_share(shadow) }
}

/// The particle of a shape, and how it stands.
pub(super) fn built_from(shape: Shape) -> (pp_particle, impl FnOnce() -> pp_built) {
    let Shape { particle, mass, sharp_volume, centroid, orientation } = shape;
    let built = move || pp_built { centroid: centroid.into(), orientation, mass: (&mass).into(), sharp_volume };
    (pp_particle(particle), built)
}

impl Refusal for ShapeError {
    fn status(&self) -> pp_status {
        match self {
            Self::OutOfRange { name: "r" | "rounding", .. } | Self::RadiusTooLarge { .. } => PP_BAD_ROUNDING_RADIUS,
            Self::OutOfRange { name: "k", .. } => PP_BAD_SPHERICITY,
            Self::OutOfRange { name: "known", .. } => PP_BAD_SETTING,
            Self::OutOfRange { name: "R", .. } | Self::NoCentre { .. } => PP_BAD_SHADOW_RADIUS,
            Self::PointNotFinite(_) | Self::NoSuchPoint { .. } => PP_BAD_POINT,
            Self::NoPlane(_) => PP_PLANE_ZERO_NORMAL,
            Self::Particle(error) => error.status(),
            _ => PP_UNBOUNDED,
        }
    }
}
