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
    /// Volume of the sharp body that it was made of.
    pub sharp_volume: f64,
}

/// Builds a particle whose faces are at given planes, about its centroid and along its principal axes.
///
/// planes: count rows of a, b, c, h; inside is a x + b y + c z <= h. (a, b, c) may have any length. These
/// are the faces themselves; the planes of pp_particle_new lie deeper, by about r. Planes that make no face
/// are left out.
/// rounding: the rounding radius r over the size, in (0, 0.5). The size is the diameter of the largest ball
/// between the planes. k: sphericity, in [0, 1). shadow: R over the size, or 0 for the distance from the
/// centroid to the farthest corner.
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

fn shares(rounding: f64, k: f64, shadow: f64) -> Rounding {
    let rounding = Rounding::new(rounding, k);
    if shadow == 0.0 { rounding } else { rounding.with_shadow_share(shadow) }
}

/// The particle of a shape, and how it stands.
fn built_from(shape: Shape) -> (pp_particle, impl FnOnce() -> pp_built) {
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
