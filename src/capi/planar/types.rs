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
