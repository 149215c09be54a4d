//! Plain structs of the plane.

/// Where a body of the plane is: world = rotation(angle) * local + position.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_pose_2d {
    /// Centre of the particle (origin of its local frame), world frame, length units of the caller.
    pub position: [f64; 2],
    /// Angle of the local axes in the world, radians, anticlockwise, from -2^30 to 2^30; beyond, take
    /// whole turns off. It counts as exact.
    pub angle: f64,
}

/// The answer for one pair of the plane: the fields of struct pp_contact, with vectors of two. Frames:
/// world axes unless said otherwise; lengths in the caller's unit; s, weight and gap have no unit. Fields
/// that do not apply are NaN.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_contact_2d {
    /// PP_SEPARATED or PP_OVERLAPPING. A failed solve has no kind: it returns a status.
    pub kind: i32,
    /// The formulation that the geometry below answers (PP_MIDWAY if PP_FLAG_SLACK is set).
    pub formulation: u32,
    /// The back end that answered: PP_FAST or PP_CONE_PROGRAM.
    pub back_end: u32,
    /// Sum of PP_FLAG_... bits.
    pub flags: u32,
    /// Pairs of quadratics solved; interior-point iterations of the cone-program back end.
    pub iterations: u32,
    /// Always 0.
    pub reserved: u32,
    /// Midway: t, the common scale at which the two particles touch at one point; t < 1 overlap.
    /// Closest: s_A at P2. Rejected pairs: a lower bound, >= 1. No unit.
    pub s: f64,
    /// Closest: s_B at P1; NaN for midway.
    pub s_b: f64,
    /// Weight u of B, in [0, 1]: (1-u) grad S_A + u grad S_B = 0 at the solution (closest: at P2).
    pub weight: f64,
    /// Bound on the error of s, and of s_b: |s - s*| <= gap. Every constant in it is
    /// derived (docs/theory.md). In extended precision it is proved; in doubles it counts rounding to first
    /// order: estimated.
    pub gap: f64,
    /// Estimated bound on the distance of the point (closest: of each of P1 and P2) to the exact optimum,
    /// length: of first order in the rounding of the data.
    pub point_bound: f64,
    /// Overlap (YADE: penetrationDepth), length, >= 0 when overlapping (0 where s < 1 by rounding alone); NaN
    /// when separated.
    pub overlap: f64,
    /// Unit contact normal, from A to B (positive force on B pushes it along +normal).
    pub normal: [f64; 2],
    /// Contact point, world frame: P3 of midway, or the weighted mean of P1 and P2 of closest.
    pub point: [f64; 2],
    /// Contact point minus position of A: exact lever arm even far from the world origin.
    pub branch_a: [f64; 2],
    /// Contact point minus position of B.
    pub branch_b: [f64; 2],
    /// Point on the boundary of A inside B, world frame; P1 of closest. NaN when separated.
    pub point_on_a: [f64; 2],
    /// Point on the boundary of B inside A, world frame; P2 of closest. NaN when separated.
    pub point_on_b: [f64; 2],
    /// Separated: lower bound on the distance between the two particles, length, with the rounding of s and
    /// of their bounding volumes estimated; 0 when none is known, as for pairs that were solved to the end.
    /// NaN when overlapping.
    pub distance: f64,
}

/// One closest point of the plane alone: the fields of struct pp_closest, with vectors of two.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_closest_2d {
    /// 1 when there is no such point: for PP_ON_A because the centre of B (for k = 0, its core) lies inside A,
    /// for PP_ON_B the reverse. The numbers below are NaN then. Else 0.
    pub slack: u32,
    /// Always 0.
    pub reserved: u32,
    /// Scale of the other particle at the point: s_B at P1, s_A at P2. No unit.
    pub s: f64,
    /// Bound on the error of s: |s - s*| <= gap (as in struct pp_contact).
    pub gap: f64,
    /// Estimated bound on the distance of the point to the exact optimum, length.
    pub point_bound: f64,
    /// P1 or P2, world frame.
    pub point: [f64; 2],
    /// The point minus position of A: exact lever arm even far from the world origin.
    pub branch_a: [f64; 2],
    /// The point minus position of B.
    pub branch_b: [f64; 2],
}

/// Area and second moments of a particle of the plane of unit density, in its local frame.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_area_properties {
    /// Area, length^2.
    pub area: f64,
    /// Centroid, local frame.
    pub centroid: [f64; 2],
    /// xx, yy, xy of the integral of x x^T dA about the local origin, length^4. xx + yy is the moment of inertia
    /// of a body that turns in the plane.
    pub second_moment: [f64; 3],
    /// Estimated bound on the relative error, as in struct pp_mass_properties.
    pub error: f64,
}
