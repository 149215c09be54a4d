//! Derivatives of contacts in poses and shapes.

use super::argument::Argument;
use super::convert::{detect_status, settings_status};
use super::fence::give;
use super::flat::boundary_from;
use super::particle::pp_particle;
use super::status::*;
use super::types::*;
use crate::particle::particle::{Particle, Plane};
use crate::{
    ContactDerivatives, DerivativeError, DerivativeFlags, PoseGradient, PoseRow, PoseRows, ShapeGradient,
    boundary_derivatives, boundary_gradient, contact_derivatives, contact_gradient,
};

/// Derivatives of a contact in the poses of A and B, as of struct pp_contact. Columns of each row: shift of A
/// along x, y, z; rotation of A about x, y, z through its position (world axes, radians); then the same six
/// of B.
/// What is NaN in the contact is NaN here.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_derivatives {
    /// Sum of PP_DERIVATIVE_... bits.
    pub flags: u32,
    /// Always 0.
    pub reserved: u32,
    /// Of s.
    pub s: [f64; 12],
    /// Of s_b; NaN for midway.
    pub s_b: [f64; 12],
    /// Of overlap; NaN when separated.
    pub overlap: [f64; 12],
    /// Of normal, a row for each of x, y, z.
    pub normal: [[f64; 12]; 3],
    /// Of point.
    pub point: [[f64; 12]; 3],
    /// Of point_on_a (of a boundary: on_particle); NaN when separated.
    pub point_on_a: [[f64; 12]; 3],
    /// Of point_on_b (of a boundary: on_boundary); of a pair NaN when separated.
    pub point_on_b: [[f64; 12]; 3],
}

/// Derivatives of a cost with respect to the shape of a particle. Calls add to it: set all numbers, and the
/// planes, to 0 first.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_shape_gradient {
    /// Four numbers for each plane of the particle, in a, b, c and d; the caller's memory.
    pub planes: *mut f64,
    /// How many planes there is room for: those of the particle.
    pub count: usize,
    /// In the rounding radius r.
    pub r: f64,
    /// In the sphericity k; at k = 0 and 1 towards the inside of its range.
    pub k: f64,
    /// In the radius R of the shadow sphere.
    pub shadow_radius: f64,
}

/// The derivatives of a contact in the poses of both bodies, at the contact, which is not solved again.
///
/// settings: may be NULL (defaults). contact: the answer of pp_contact_detect for the same bodies, poses and
/// settings.
/// Errors: PP_NULL_POINTER, PP_BAD_POSITION, PP_BAD_ORIENTATION, PP_BAD_POINT (the contact was not filled, or
/// was rejected without a point), PP_NO_DERIVATIVE, PP_UNKNOWN_FORMULATION, PP_UNKNOWN_BACK_END,
/// PP_BAD_SETTING, PP_SOLVER_FAILED.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_contact_derivatives(
    a: *const pp_particle,
    pose_a: *const pp_pose,
    b: *const pp_particle,
    pose_b: *const pp_pose,
    settings: *const pp_settings,
    contact: *const pp_contact,
    out: *mut pp_derivatives,
) -> pp_status {
    give!(out, [a, pose_a, b, pose_b, settings, contact], {
        contact_derivatives(a, &pose_a, b, &pose_b, contact, settings).map(derivatives_to).map_err(status_of)
    })
}

/// The derivatives of a cost in poses and shapes of both bodies, from its derivatives in the numbers of their
/// contact (reverse mode). The work is linear in the number of active planes.
///
/// settings, contact: as of pp_contact_derivatives. shape_a, shape_b: may be NULL; else added to. poses:
/// receives those of A and B. flags: receives PP_DERIVATIVE_... bits.
/// Pointers: planes of a gradient holds 4 * count numbers; poses has room for 2. The two gradients are not
/// the same.
/// Errors: those of pp_contact_derivatives, and PP_BAD_INDEX (count).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_contact_gradient(
    a: *const pp_particle,
    pose_a: *const pp_pose,
    b: *const pp_particle,
    pose_b: *const pp_pose,
    settings: *const pp_settings,
    contact: *const pp_contact,
    weights: *const pp_contact_weights,
    shape_a: *mut pp_shape_gradient,
    shape_b: *mut pp_shape_gradient,
    poses: *mut pp_pose_gradient,
    flags: *mut u32,
) -> pp_status {
    give!((poses, flags), [a, pose_a, b, pose_b, settings, contact, weights], {
        // SAFETY: as the caller has promised.
        let mut shapes = [unsafe { ShapeSum::of(shape_a, a) }?, unsafe { ShapeSum::of(shape_b, b) }?];
        let [of_a, of_b] = shapes.each_mut().map(ShapeSum::sum);
        let found = contact_gradient(a, &pose_a, b, &pose_b, contact, settings, weights, of_a, of_b);
        added(found, shapes)
    })
}

/// The derivatives of a contact with a plane or a triangle in the poses of the particle and of the boundary,
/// which stands in place of B and turns about the position of A, too.
///
/// vertices: NULL for a plane; else as for pp_contact_triangle. contact: the answer of pp_contact_plane or
/// pp_contact_triangle for the same body, pose and settings.
/// Pointers: vertices holds 9 numbers.
/// Errors: those of pp_contact_derivatives, and PP_DEGENERATE_TRIANGLE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_flat_contact_derivatives(
    a: *const pp_particle,
    pose_a: *const pp_pose,
    vertices: *const f64,
    settings: *const pp_settings,
    contact: *const pp_flat_contact,
    out: *mut pp_derivatives,
) -> pp_status {
    give!(out, [a, pose_a, settings, contact], {
        // SAFETY: as the caller has promised.
        let triangle = unsafe { boundary_from(vertices) }?;
        boundary_derivatives(a, &pose_a, triangle.as_ref(), contact, settings).map(derivatives_to).map_err(status_of)
    })
}

/// The derivatives of a cost in the pose and the shape of a particle, and in the pose of the plane or
/// triangle that it touches, from its derivatives in the numbers of the contact.
///
/// vertices, contact and the pose of the boundary: as of pp_flat_contact_derivatives; the rest as of
/// pp_contact_gradient.
/// Pointers: vertices holds 9 numbers; planes of the gradient 4 * count; poses has room for 2.
/// Errors: those of pp_contact_gradient, and PP_DEGENERATE_TRIANGLE.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_flat_contact_gradient(
    a: *const pp_particle,
    pose_a: *const pp_pose,
    vertices: *const f64,
    settings: *const pp_settings,
    contact: *const pp_flat_contact,
    weights: *const pp_contact_weights,
    shape: *mut pp_shape_gradient,
    poses: *mut pp_pose_gradient,
    flags: *mut u32,
) -> pp_status {
    give!((poses, flags), [a, pose_a, settings, contact, weights], {
        // SAFETY: as the caller has promised.
        let triangle = unsafe { boundary_from(vertices) }?;
        let mut gradient = unsafe { ShapeSum::of(shape, a) }?;
        let sum = ShapeSum::sum(&mut gradient);
        let found = boundary_gradient(a, &pose_a, triangle.as_ref(), contact, settings, weights, sum);
        added(found, [gradient])
    })
}

/// A gradient of the caller, and what is to be added to it.
struct ShapeSum<'a> {
    given: &'a mut pp_shape_gradient,
    planes: &'a mut [[f64; 4]],
    sum: ShapeGradient,
}

impl<'a> ShapeSum<'a> {
    /// # Safety
    /// `given` is NULL or exclusively ours for the call, as its planes are.
    unsafe fn of(given: *mut pp_shape_gradient, particle: &Particle) -> Result<Option<Self>, pp_status> {
        let Some(given) = (unsafe { given.as_mut() }) else { return Ok(None) };
        if given.count != particle.plane_count() {
            return Err(PP_BAD_INDEX);
        }
        // SAFETY: as promised.
        let planes = unsafe { (given.planes.cast::<[f64; 4]>(), given.count).take() }?;
        Ok(Some(Self { given, planes, sum: ShapeGradient::zeros(particle) }))
    }

    fn sum(shape: &mut Option<Self>) -> Option<&mut ShapeGradient> {
        shape.as_mut().map(|shape| &mut shape.sum)
    }

    fn add(self) {
        for (to, Plane { normal, offset }) in self.planes.iter_mut().zip(&self.sum.planes) {
            for (to, add) in to.iter_mut().zip([normal.x, normal.y, normal.z, *offset]) {
                *to += add;
            }
        }
        self.given.r += self.sum.r;
        self.given.k += self.sum.k;
        self.given.shadow_radius += self.sum.shadow_radius;
    }
}

/// The gradients of both poses, and flags; those of shapes are added.
fn added<const N: usize>(
    found: Result<([PoseGradient; 2], DerivativeFlags), DerivativeError>,
    shapes: [Option<ShapeSum>; N],
) -> Result<([PoseGradient; 2], u32), pp_status> {
    let (gradients, flags) = found.map_err(status_of)?;
    shapes.into_iter().flatten().for_each(ShapeSum::add);
    Ok((gradients, flags.bits()))
}

fn status_of(error: DerivativeError) -> pp_status {
    match error {
        DerivativeError::Settings(error) => settings_status(error),
        DerivativeError::InPlane(_) => PP_NOT_IN_PLANE,
        DerivativeError::NoPoint | DerivativeError::NotFinite | DerivativeError::NoTriangle => PP_BAD_POINT,
        DerivativeError::NoGradient | DerivativeError::NoCurvature => PP_NO_DERIVATIVE,
        DerivativeError::Detect(error) => detect_status(error),
        DerivativeError::Planes { .. } => PP_BAD_INDEX,
    }
}

/// The rows of x, y and z.
pub(super) fn rows(rows: &PoseRows) -> [[f64; 12]; 3] {
    rows.transpose().into()
}

fn derivatives_to(found: ContactDerivatives) -> pp_derivatives {
    let row = |row: &PoseRow| row.transpose().into();
    pp_derivatives {
        flags: found.flags.bits(),
        reserved: 0,
        s: row(&found.s),
        s_b: row(&found.s_b),
        overlap: row(&found.overlap),
        normal: rows(&found.normal),
        point: rows(&found.point),
        point_on_a: rows(&found.point_on_a),
        point_on_b: rows(&found.point_on_b),
    }
}
