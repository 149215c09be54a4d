//! Plain structs that cross the C boundary, and their one conversion to the Rust types.

/// Formulation "midway" (paper eqs 4 and 44): minimise t with s_A <= t and s_B <= t.
pub const PP_MIDWAY: u32 = 0;
/// Formulation "closest" (paper eqs 3, 9, 34-43): minimise s_A with s_B <= 1, and the swap.
pub const PP_CLOSEST: u32 = 1;

/// The library's own solver, in doubles and, where those do not settle a pair, in extended precision.
pub const PP_FAST: u32 = 0;
/// The paper's second-order cone programs, solved by clarabel: slow; independent of PP_FAST, to check it.
/// Refused with PP_NO_CONE_PROGRAM by a library built without it (Cargo feature cone-program).
pub const PP_CONE_PROGRAM: u32 = 1;

/// The two particles share no interior point: s >= 1.
pub const PP_SEPARATED: i32 = 1;
/// The two particles overlap: s < 1.
pub const PP_OVERLAPPING: i32 = 2;

/// pp_closest_point: the point P1 on A, where s_B is least.
pub const PP_ON_A: u32 = 0;
/// pp_closest_point: the point P2 on B, where s_A is least.
pub const PP_ON_B: u32 = 1;

/// Where a body is: world = rotation(orientation) * local + position.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_pose {
    /// Centre of the particle (origin of its local frame), world frame, length units of the caller.
    pub position: [f64; 3],
    /// Quaternion w, x, y, z, local to world. Normalised by the library; any length in
    /// [1e-150, 1e150] will do.
    pub orientation: [f64; 4],
}

/// What one ordered pair (A, B), or a particle A and a flat boundary, keeps from call to call.
///
/// Owned by the caller: set all bytes to 0 to begin with or to forget; copy it freely within a process. One
/// caller at a time.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_pair_state {
    /// The last solution, from which the next call starts. Private to the library. It may be saved and loaded
    /// again, with all other bytes 0: whatever it holds, an answer changes by no more than its gap.
    pub solution: [f64; 8],
    /// What carry_tolerance needs of the last contact. Private to the library. Not to be saved, as answers
    /// depend on it. It is used only for the two particles for which it was written, while they exist.
    pub last_contact: [f64; 40],
}

/// The structs of the library itself, of which tests/header.rs writes those of the header.
/// cbindgen:ignore
pub type pp_settings = crate::Settings;
/// cbindgen:ignore
pub type pp_contact = crate::Contact;
/// cbindgen:ignore
pub type pp_closest = crate::ClosestPoint;
/// cbindgen:ignore
pub type pp_flat_contact = crate::FlatContact;
/// cbindgen:ignore
pub type pp_patch_point = crate::PatchPoint;
/// cbindgen:ignore
pub type pp_contact_weights = crate::ContactWeights;
/// cbindgen:ignore
pub type pp_pose_gradient = crate::PoseGradient;

/// Volume and inertia of a particle of unit density, in its local frame.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_mass_properties {
    /// Volume, length^3.
    pub volume: f64,
    /// Centroid, local frame. YADE wants it at the local origin.
    pub centroid: [f64; 3],
    /// Inertia about the local origin for density 1: xx, yy, zz, xy, yz, zx of the integral of
    /// (|x|^2 I - x x^T) dV, length^5.
    pub inertia: [f64; 6],
    /// Estimated bound on the relative error of the volume and of every moment of inertia about an axis through
    /// the origin, and of the centroid as a share of the radii of gyration. No unit.
    pub error: f64,
}
