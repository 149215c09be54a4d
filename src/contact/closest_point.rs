//! One of the two closest points alone, for pairs of which the other has none.

use crate::answer::answer;
use crate::contact::error::DetectError;
use crate::linalg::number::unknown_vector;
use crate::model::problem::Problem;
use crate::pair::pair::Pair;
use crate::pair::role::Role;
use crate::particle::particle::Particle;
use crate::pose::Pose;
use crate::settings::Settings;
use crate::solver::call::Call;
use nalgebra::Vector3;

answer! {
    /// One closest point alone; frames and units as in [`Contact`](crate::Contact).
    pub struct ClosestPoint {
        /// 1 when there is no such point: for [`Role::A`] because the centre of B (for k = 0, its core) lies inside A,
        /// for [`Role::B`] the reverse. The numbers below are NaN then. Else 0.
        pub(crate) slack: u32 = 1,
        /// Always 0.
        pub(crate) reserved: u32 = 0,
        /// Scale of the other particle at the point: s_B at P1, s_A at P2. No unit.
        pub s: f64 = f64::NAN,
        /// Bound on the error of s: |s - s*| <= gap (as in [`Contact`](crate::Contact)).
        pub gap: f64 = f64::NAN,
        /// Estimated bound on the distance of the point to the exact optimum, length.
        pub point_bound: f64 = f64::NAN,
        /// P1 or P2, world frame.
        pub point: Vector3<f64> = unknown_vector(),
        /// The point minus position of A: exact lever arm even far from the world origin.
        pub branch_a: Vector3<f64> = unknown_vector(),
        /// The point minus position of B.
        pub branch_b: Vector3<f64> = unknown_vector(),
    }
}

/// The point on the particle `on` where the other one's scale is least (paper eqs 3, 9): minimise s_A with s_B ≤ 1 for
/// the point P2 on B, and the swap for P1 on A.
///
/// `None` where the constraint is slack: the other particle's centre (for k = 0, its core) lies inside this one.
/// [`crate::detect()`] with [`crate::Formulation::Closest`] needs both points, and answers midway where one is missing.
///
/// ```
/// use potential_particles::{Particle, Pose, Role, Settings, closest_point};
/// let (small, large) = (Particle::sphere(0.1)?, Particle::sphere(1.0)?);
/// let (at_rim, at_origin) = (Pose::at([0.95, 0.0, 0.0])?, Pose::at([0.0, 0.0, 0.0])?);
/// let settings = Settings::default();
/// // The point of the small ball that lies deepest in the large one,
/// let deepest = closest_point(&small, &at_rim, &large, &at_origin, Role::A, &settings)?.expect("a point");
/// assert!((deepest.point.x - 0.85).abs() < 1e-12 && (deepest.s - 0.85).abs() <= deepest.gap);
/// // and no such point of the large one, which holds the centre of the small one.
/// assert!(closest_point(&small, &at_rim, &large, &at_origin, Role::B, &settings)?.is_none());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// As of [`crate::detect()`].
pub fn closest_point(
    a: &Particle,
    pose_a: &Pose,
    b: &Particle,
    pose_b: &Pose,
    on: Role,
    settings: &Settings,
) -> Result<Option<ClosestPoint>, DetectError> {
    settings.validate()?;
    Particle::refuse_mixed((a, pose_a), (b, pose_b))?;
    let pair = Pair::new(a, pose_a, b, pose_b);
    let problem = match on {
        Role::A => Problem::OnA,
        Role::B => Problem::OnB,
    };
    let found = Call::new(&pair, settings).closest_point(problem, None)?;
    Ok(found.map(|found| {
        let branch_b = pose_b.rotate(&found.x);
        let (s, gap, point) = (found.scale.s, found.scale.gap, pose_b.position() + branch_b);
        let branch_a = pair.branch_a(&branch_b);
        ClosestPoint { s, gap, point, branch_a, branch_b, point_bound: found.bound, slack: 0, reserved: 0 }
    }))
}
