//! One of the two closest points alone, for pairs of which the other has none.

use crate::contact::detect::DetectError;
use crate::model::problem::Problem;
use crate::pair::pose::Pose;
use crate::pair::relative_pose::Pair;
use crate::particle::particle::Particle;
use crate::reference::Role;
use crate::settings::Settings;
use crate::solver::call::Call;
use nalgebra::Vector3;

/// The closest point on one particle.
#[derive(Clone, Copy, Debug)]
pub struct Half {
    /// Scale of the other particle at the point: s_A at P2, s_B at P1.
    pub s: f64,
    /// |s − s*| ≤ gap.
    pub gap: f64,
    /// P1 on A or P2 on B, world frame.
    pub point: Vector3<f64>,
    /// The same minus the position of B: free of the rounding of positions far from the origin.
    pub branch_b: Vector3<f64>,
    /// Bound on the distance of the point to the optimum, length.
    pub point_bound: f64,
}

/// The point on the particle `on` where the other one's scale is least (paper eqs 3, 9): minimise s_A with s_B ≤ 1 for
/// the point P2 on B, and the swap for P1 on A.
///
/// `None` where the constraint is slack: the other particle's centre (for k = 0, its core) lies inside this one.
/// [`crate::contact::detect()`] with [`crate::Formulation::Closest`] needs both points, and answers midway where one is missing.
///
/// # Errors
/// As of [`crate::contact::detect()`].
pub fn closest_point(
    a: &Particle,
    pose_a: &Pose,
    b: &Particle,
    pose_b: &Pose,
    on: Role,
    settings: &Settings,
) -> Result<Option<Half>, DetectError> {
    settings.validate()?;
    let pair = Pair::new(a, pose_a, b, pose_b);
    let problem = match on {
        Role::A => Problem::OnA,
        Role::B => Problem::OnB,
    };
    let found = Call::new(&pair, settings).closest_point(problem, None)?;
    Ok(found.map(|found| {
        let branch_b = pose_b.rotate(&found.x);
        let (s, gap, point) = (found.scale.s, found.scale.gap, pose_b.position() + branch_b);
        Half { s, gap, point, branch_b, point_bound: found.bound }
    }))
}
