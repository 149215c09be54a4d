//! One of the two closest points of the plane alone: that of space without z.

use super::particle::Particle;
use super::pose::Pose;
use crate::contact::closest_point;
use crate::contact::error::DetectError;
use crate::pair::role::Role;
use crate::settings::Settings;

/// The closest point on one particle: that of space without z.
pub type ClosestPoint = closest_point::ClosestPoint<2>;

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
    Ok(found.map(|found| found.in_plane()))
}
