//! Many pairs of the plane in one call.

use super::contact::{Contact, detect};
use super::particle::Particle;
use super::pose::Pose;
use crate::contact::batch::{self, Placed};
use crate::contact::error::DetectError;
use crate::pair::pair_state::PairState;
use crate::settings::Settings;

/// Contacts of many pairs of bodies of the plane: [`crate::detect_batch`] with two coordinates.
///
/// Body i is `particles[i]` at `poses[i]`, pair n is that of the bodies `pairs[n]`, first A, then B. The answers come
/// in the order of the pairs, and each is, to the last bit, what [`detect()`] gives for that pair alone, whatever the
/// number of threads. `states` holds one state for each pair, or nothing.
///
/// ```
/// use potential_particles::planar::{Particle, Pose, detect_batch};
/// use potential_particles::{Kind, PairState, Settings};
/// let disc = Particle::circle(1.0)?;
/// let particles = [&disc, &disc, &disc];
/// let poses = [Pose::new([0.0, 0.0], 0.0)?, Pose::new([1.5, 0.0], 0.0)?, Pose::new([5.0, 0.0], 0.0)?];
/// let mut states = [PairState::default(); 2];
/// let answers = detect_batch(&particles, &poses, &[[0, 1], [1, 2]], &Settings::default(), 2, &mut states)?;
/// assert_eq!(answers[0].as_ref().unwrap().kind, Kind::Overlapping);
/// assert_eq!(answers[1].as_ref().unwrap().kind, Kind::Separated);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// A setting out of range, or slices whose lengths do not fit together; then no pair was looked at.
pub fn detect_batch(
    particles: &[&Particle],
    poses: &[Pose],
    pairs: &[[u32; 2]],
    settings: &Settings,
    threads: usize,
    states: &mut [PairState],
) -> Result<Vec<Result<Contact, DetectError>>, DetectError> {
    settings.validate()?;
    let one =
        |_, a: Placed<Particle, Pose>, b: Placed<Particle, Pose>, state: Option<&mut PairState>, answer: &mut _| {
            *answer = detect(a.0, a.1, b.0, b.1, settings, state);
        };
    let mut answers = batch::unanswered(pairs.len());
    batch::detect_batch_by((one, batch::refuse), (particles, poses), pairs, threads, states, &mut answers)?;
    Ok(answers)
}
