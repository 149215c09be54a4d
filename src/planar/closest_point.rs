//! One of the two closest points of the plane alone: that of space without z.

use super::particle::Particle;
use super::pose::Pose;
use crate::contact::closest_point;
use crate::contact::detect::DetectError;
use crate::pair::role::Role;
use crate::settings::Settings;
use nalgebra::Vector2;

/// The closest point on one particle, world axes, lengths in the caller's unit.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ClosestPoint {
    /// Scale of the other particle at the point: s_A at P2, s_B at P1.
    pub s: f64,
    /// |s − s*| ≤ gap, as in [`crate::Contact`].
    pub gap: f64,
    /// P1 on A or P2 on B, world frame.
    pub point: Vector2<f64>,
    /// The point minus the position of A: free of the rounding of positions far from the origin.
    pub branch_a: Vector2<f64>,
    /// The point minus the position of B.
    pub branch_b: Vector2<f64>,
    /// Estimated bound on the distance of the point to the optimum, length.
    pub point_bound: f64,
}

impl From<closest_point::ClosestPoint> for ClosestPoint {
    /// Of two particles of the plane.
    fn from(found: closest_point::ClosestPoint) -> Self {
        Self {
            s: found.s,
            gap: found.gap,
            point: found.point.xy(),
            branch_a: found.branch_a.xy(),
            branch_b: found.branch_b.xy(),
            point_bound: found.point_bound,
        }
    }
}

/// The point on the particle `on` where the other one's scale is least: [`crate::closest_point`] with two coordinates.
///
/// `None` where the constraint is slack: the other particle's centre (for k = 0, its core) lies inside this one.
///
/// ```
/// use potential_particles::planar::{Particle, Pose, closest_point};
/// use potential_particles::{Role, Settings};
/// let (small, large) = (Particle::circle(0.1)?, Particle::circle(1.0)?);
/// let (at_rim, at_origin) = (Pose::new([0.95, 0.0], 0.0)?, Pose::new([0.0, 0.0], 0.0)?);
/// let settings = Settings::default();
/// // The point of the small disc that lies deepest in the large one,
/// let deepest = closest_point(&small, &at_rim, &large, &at_origin, Role::A, &settings)?.expect("a point");
/// assert!((deepest.point.x - 0.85).abs() < 1e-12 && (deepest.s - 0.85).abs() <= deepest.gap);
/// // and no such point of the large one, which holds the centre of the small one.
/// assert!(closest_point(&small, &at_rim, &large, &at_origin, Role::B, &settings)?.is_none());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// As of [`super::detect()`].
pub fn closest_point(
    a: &Particle,
    pose_a: &Pose,
    b: &Particle,
    pose_b: &Pose,
    on: Role,
    settings: &Settings,
) -> Result<Option<ClosestPoint>, DetectError> {
    let found = closest_point::closest_point(&a.0, &pose_a.in_space(), &b.0, &pose_b.in_space(), on, settings)?;
    Ok(found.map(ClosestPoint::from))
}
