//! Status codes of the C interface and the sentence that goes with each.
//!
//! Codes travel as plain integers, because an enum value unknown to Rust would be undefined
//! behaviour. A code is never reused for another meaning.

use std::ffi::{CStr, c_char};

/// What every function of the C interface returns: PP_OK or a positive code.
pub type pp_status = i32;

/// The call did what it says; its outputs are written.
pub const PP_OK: pp_status = 0;
/// A pointer that must not be NULL was NULL.
pub const PP_NULL_POINTER: pp_status = 1;
/// A pose holds a position that is not finite.
pub const PP_BAD_POSITION: pp_status = 2;
/// A pose holds a quaternion that is not finite, or of a length outside [1e-150, 1e150].
pub const PP_BAD_ORIENTATION: pp_status = 3;
/// A point or direction is not finite, a direction has no length, or a contact was not filled or is not
/// of the kind that is needed.
pub const PP_BAD_POINT: pp_status = 4;
/// The settings name a formulation that does not exist.
pub const PP_UNKNOWN_FORMULATION: pp_status = 5;
/// The settings name a back end that does not exist.
pub const PP_UNKNOWN_BACK_END: pp_status = 6;
/// A setting or a tolerance argument is outside its documented range, or a reserved field is not 0.
pub const PP_BAD_SETTING: pp_status = 7;
/// No solver reached an answer: the contact is unknown, which is not "no contact".
pub const PP_SOLVER_FAILED: pp_status = 8;
/// An internal error was caught at the boundary: please report it.
pub const PP_INTERNAL_ERROR: pp_status = 9;
/// The output buffer is too small; the needed size was written.
pub const PP_BUFFER_TOO_SMALL: pp_status = 10;
/// The settings ask for the cone-program back end, and the library was built without it.
pub const PP_NO_CONE_PROGRAM: pp_status = 11;
/// An index or a count names something that is not there; of any function, an array of more elements than any
/// memory holds.
pub const PP_BAD_INDEX: pp_status = 12;
/// The vertices of a triangle lie on one line, so that it has no normal.
pub const PP_DEGENERATE_TRIANGLE: pp_status = 13;
/// The tolerance of a mesh is outside its documented range.
pub const PP_BAD_TOLERANCE: pp_status = 14;
/// The contact has no derivative: gradients or curvatures vanish there, as in the core of both bodies.
pub const PP_NO_DERIVATIVE: pp_status = 15;
/// One particle lies in the plane z = 0 and the other does not; or, of one that does, a pose, the normal of a
/// plane or a triangle leaves that plane.
pub const PP_NOT_IN_PLANE: pp_status = 16;

/// A plane holds a coefficient that is not finite.
pub const PP_PLANE_NOT_FINITE: pp_status = 20;
/// A plane has a normal (a, b, c) of length zero, or so short or long that its square, or the square over
/// r^2, leaves the range of doubles.
pub const PP_PLANE_ZERO_NORMAL: pp_status = 21;
/// k is not a number in [0, 1].
pub const PP_BAD_SPHERICITY: pp_status = 22;
/// r is not a positive finite number, or so small that squares of depths leave the range of doubles, and
/// k < 1 needs it.
pub const PP_BAD_ROUNDING_RADIUS: pp_status = 23;
/// R is not a positive finite number, or k/R^2 leaves the range of doubles, and k > 0 needs it.
pub const PP_BAD_SHADOW_RADIUS: pp_status = 24;
/// f(0) >= 0: the origin of the local frame is not inside the particle.
pub const PP_CENTRE_OUTSIDE: pp_status = 25;
/// k = 0 and the planes do not enclose a bounded volume.
pub const PP_UNBOUNDED: pp_status = 26;
/// More planes than PP_MAX_PLANES.
pub const PP_TOO_MANY_PLANES: pp_status = 27;
/// The particle reaches less than 1e-30 or more than 1e30 from its centre.
pub const PP_BAD_SIZE: pp_status = 28;

/// Every code with its sentence; pp_status_message and the tests read this one table.
const MESSAGES: &[(pp_status, &CStr)] = &[
    (PP_OK, c"success"),
    (PP_NULL_POINTER, c"a pointer that must not be NULL was NULL"),
    (PP_BAD_POSITION, c"a position is not finite"),
    (
        PP_BAD_ORIENTATION,
        c"an orientation quaternion (w, x, y, z) is not finite, or of a length outside [1e-150, 1e150]",
    ),
    (PP_BAD_POINT, c"a point or direction is not finite, a direction has no length, or a contact was not filled or is not of the kind that is needed"),
    (PP_UNKNOWN_FORMULATION, c"unknown formulation: use PP_MIDWAY or PP_CLOSEST"),
    (PP_UNKNOWN_BACK_END, c"unknown back end: use PP_FAST or PP_CONE_PROGRAM"),
    (PP_BAD_SETTING, c"a setting or tolerance is outside its documented range, or a reserved field is not 0"),
    (PP_SOLVER_FAILED, c"no solver reached an answer; the contact is unknown (this does not mean separated)"),
    (PP_INTERNAL_ERROR, c"internal error caught at the library boundary: please report it"),
    (PP_BUFFER_TOO_SMALL, c"the output buffer is too small; the needed size was written"),
    (
        PP_NO_CONE_PROGRAM,
        c"the library was built without the cone-program back end (Cargo feature cone-program): use PP_FAST",
    ),
    (PP_BAD_INDEX, c"an index or a count names something that is not there"),
    (PP_DEGENERATE_TRIANGLE, c"a triangle has no area to rounding: remove it from the mesh"),
    (
        PP_BAD_TOLERANCE,
        c"the tolerance of a mesh must lie in [1e-5, 1]: the distance to the surface over the bounding radius",
    ),
    (PP_NO_DERIVATIVE, c"the contact has no derivative: the gradients, or the curvature across the normal, vanish at its point"),
    (PP_NOT_IN_PLANE, c"one particle lies in the plane z = 0 and the other does not, or a boundary or pose leaves it: z, and x and y of the quaternion, must be 0"),
    (PP_PLANE_NOT_FINITE, c"a plane coefficient is not finite"),
    (
        PP_PLANE_ZERO_NORMAL,
        c"a plane normal (a, b, c) has no length, or its square (over r^2, too) leaves the range of doubles",
    ),
    (PP_BAD_SPHERICITY, c"sphericity k must lie in [0, 1]"),
    (PP_BAD_ROUNDING_RADIUS, c"rounding radius r must be positive and finite when k < 1"),
    (PP_BAD_SHADOW_RADIUS, c"shadow radius R must be positive and finite when k > 0"),
    (PP_CENTRE_OUTSIDE, c"the local origin lies outside the particle: f(0) must be negative"),
    (PP_UNBOUNDED, c"with k = 0 the planes must enclose a bounded volume"),
    (PP_TOO_MANY_PLANES, c"more planes than PP_MAX_PLANES"),
    (PP_BAD_SIZE, c"the particle reaches less than 1e-30 or more than 1e30 from its centre: take another unit of length"),
];

/// The sentence of a status code, if it is one.
fn text_of(status: pp_status) -> Option<&'static CStr> {
    MESSAGES.iter().find(|(code, _)| *code == status).map(|(_, text)| *text)
}

/// The same for messages.
pub(super) fn sentence(status: pp_status) -> &'static str {
    text_of(status).and_then(|text| text.to_str().ok()).unwrap_or_default()
}

/// The sentence for a status code, in English, without a full stop.
///
/// Never NULL; an unknown code gives "unknown status code". The text is static: do not free it.
#[unsafe(no_mangle)]
pub extern "C" fn pp_status_message(status: pp_status) -> *const c_char {
    text_of(status).unwrap_or(c"unknown status code").as_ptr()
}
