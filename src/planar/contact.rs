//! The contact of two particles of the plane: that of space without z.

use super::particle::Particle;
use super::pose::Pose;
use crate::contact::contact::{self, Kind};
use crate::contact::detect::{self, DetectError};
use crate::flags::Flags;
use crate::linalg::number::equality;
use crate::pair::pair_state::PairState;
use crate::settings::{BackEnd, Formulation, Settings};
use nalgebra::Vector2;

/// The answer for one pair, world axes, lengths in the caller's unit. What does not apply is NaN.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Contact {
    /// Separated or overlapping.
    pub kind: Kind,
    /// The formulation that the geometry answers (midway where closest is slack).
    pub formulation: Formulation,
    /// Who answered.
    pub back_end: BackEnd,
    /// What else is to be known.
    pub flags: Flags,
    /// Pairs of quadratics solved; interior-point iterations of the cone-program back end.
    pub iterations: u32,
    /// Midway: t. Closest: s_A at P2. Rejected: a proved lower bound, ≥ 1.
    pub s: f64,
    /// Closest: s_B at P1; NaN for midway.
    pub s_b: f64,
    /// Weight u of B: (1−u)∇S_A + u∇S_B = 0.
    pub weight: f64,
    /// |s − s*| ≤ gap (and the same for s_b), as in [`crate::Contact`].
    pub gap: f64,
    /// Estimated bound on the distance of the point (of closest: of each of P1 and P2) to the optimum, length.
    pub point_bound: f64,
    /// Overlap, > 0 when overlapping; NaN when separated.
    pub overlap: f64,
    /// Separated: the particles are at least this far from each other, as far as the proof knows; NaN when overlapping.
    pub distance: f64,
    /// Unit normal from A to B.
    pub normal: Vector2<f64>,
    /// Contact point, world frame.
    pub point: Vector2<f64>,
    /// Contact point minus position of A.
    pub branch_a: Vector2<f64>,
    /// Contact point minus position of B.
    pub branch_b: Vector2<f64>,
    /// Point on the boundary of A (P1 of closest), world frame; NaN when separated.
    pub point_on_a: Vector2<f64>,
    /// Point on the boundary of B (P2 of closest), world frame; NaN when separated.
    pub point_on_b: Vector2<f64>,
}

equality!(Contact: kind, formulation, back_end, flags, iterations; s, s_b, weight, gap, point_bound, overlap, distance;
    normal, point, branch_a, branch_b, point_on_a, point_on_b);

impl From<contact::Contact> for Contact {
    /// Of a contact of two particles of the plane.
    fn from(contact: contact::Contact) -> Self {
        Self {
            kind: contact.kind,
            formulation: contact.formulation,
            back_end: contact.back_end,
            flags: contact.flags,
            iterations: contact.iterations,
            s: contact.s,
            s_b: contact.s_b,
            weight: contact.weight,
            gap: contact.gap,
            point_bound: contact.point_bound,
            overlap: contact.overlap,
            distance: contact.distance,
            normal: contact.normal.xy(),
            point: contact.point.xy(),
            branch_a: contact.branch_a.xy(),
            branch_b: contact.branch_b.xy(),
            point_on_a: contact.point_on_a.xy(),
            point_on_b: contact.point_on_b.xy(),
        }
    }
}

/// Contact of A at `pose_a` with B at `pose_b`.
///
/// `state` is what this ordered pair keeps from call to call: read, and updated on success.
///
/// ```
/// use potential_particles::planar::{Particle, Pose, detect};
/// let disc = Particle::circle(1.0)?;
/// let (left, right) = (Pose::new([0.0, 0.0], 0.0)?, Pose::new([1.5, 0.0], 0.0)?);
/// let contact = detect(&disc, &left, &disc, &right, &Default::default(), None)?;
/// assert!((contact.overlap - 0.5).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// A setting out of range, or no answer from any solver.
pub fn detect(
    a: &Particle,
    pose_a: &Pose,
    b: &Particle,
    pose_b: &Pose,
    settings: &Settings,
    state: Option<&mut PairState>,
) -> Result<Contact, DetectError> {
    detect_as((a, pose_a), (b, pose_b), settings, state, |contact| contact)
}

/// [`detect()`] with the contact in another form; see [`crate::contact::detect::detect_as`].
#[inline(always)]
pub(crate) fn detect_as<T>(
    (a, pose_a): (&Particle, &Pose),
    (b, pose_b): (&Particle, &Pose),
    settings: &Settings,
    state: Option<&mut PairState>,
    answer: impl Fn(Contact) -> T,
) -> Result<T, DetectError> {
    let (pose_a, pose_b) = (pose_a.in_space(), pose_b.in_space());
    detect::detect_as((&a.0, &pose_a), (&b.0, &pose_b), settings, state, |contact: contact::Contact| {
        answer(contact.into())
    })
}
