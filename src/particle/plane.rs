//! One plane of a particle.

use nalgebra::Vector3;

/// One plane a·x + b·y + c·z = d of a particle, local frame, (a, b, c) pointing outwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Outward normal (a, b, c); unit length is usual, not required.
    pub normal: Vector3<f64>,
    /// Offset d, length·|n|: the plane lies at d/|n| from the origin; for k = 0 the flat part of the face at (d +
    /// r)/|n|.
    pub offset: f64,
}

/// Most planes that a particle may have: their places are stored in 16 bits.
pub const MAX_PLANES: usize = 65_536;

impl From<[f64; 4]> for Plane {
    /// From (a, b, c, d).
    fn from([a, b, c, d]: [f64; 4]) -> Self {
        Self { normal: Vector3::new(a, b, c), offset: d }
    }
}
