//! The contact of two particles of the plane: that of space without z.

use super::particle::Particle;
use super::pose::Pose;
use crate::contact::contact;
use crate::contact::detect::detect_into;
use crate::contact::error::DetectError;
use crate::pair::pair_state::PairState;
use crate::settings::Settings;
use std::mem::MaybeUninit;

/// The answer for one pair: that of space without z.
pub type Contact = contact::Contact<2>;

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
    let (pose_a, pose_b) = (pose_a.in_space(), pose_b.in_space());
    let mut place = MaybeUninit::uninit();
    detect_into((&a.0, &pose_a), (&b.0, &pose_b), settings, state, &mut place).map(|contact| contact.in_plane())
}
