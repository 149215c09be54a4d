//! The whole of contact detection: reject, solve, prove, describe.

use crate::certificate::Certified;
use crate::contact::{Contact, Flags, Kind, LocalContact};
use crate::expansion::Start;
use crate::memory::{Memory, Remembered};
use crate::outcome::Ending;
use crate::pair::Pair;
use crate::particle::Particle;
use crate::pose::Pose;
use crate::reject::{self, Apart};
use crate::search::{Answer, Search};
use crate::settings::{BackEnd, Formulation, Settings, SettingsError};
use crate::target::Target;
use thiserror::Error;

/// Why there is no answer.
#[derive(Clone, Debug, Error)]
pub enum DetectError {
    /// A setting is out of range.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// No solver reached an answer. The contact is unknown; this does not mean separated.
    #[error("no solver reached an answer (the conic one: {conic}); the contact is unknown")]
    Failed {
        /// What stopped the last solver.
        conic: String,
    },
}

impl From<crate::conic::ConicError> for DetectError {
    fn from(error: crate::conic::ConicError) -> Self {
        Self::Failed { conic: error.to_string() }
    }
}

/// Contact of A at `pose_a` with B at `pose_b`.
///
/// `memory` is what this ordered pair remembers between calls: read, and updated on success.
///
/// # Errors
/// A setting out of range, or no answer from any solver.
pub fn detect(
    a: &Particle,
    pose_a: &Pose,
    b: &Particle,
    pose_b: &Pose,
    settings: &Settings,
    memory: Option<&mut Memory>,
) -> Result<Contact, DetectError> {
    settings.validate()?;
    let pair = Pair::new(a, pose_a, b, pose_b);
    if let Some(proof) = rejected(&pair, settings, memory.as_deref()) {
        let flags = proof.by.with(Flags::REJECTED);
        return Ok(Contact { flags, distance: proof.distance, ..Contact::separated(settings.formulation, 1.0) });
    }
    solved(&pair, [pose_a, pose_b], settings, memory)
}

/// The contact of a pair that no cheap proof holds apart. In a frame of its own: it is large, and most pairs of a scene
/// need none.
#[inline(never)]
pub(crate) fn solved(
    pair: &Pair,
    [pose_a, pose_b]: [&Pose; 2],
    settings: &Settings,
    memory: Option<&mut Memory>,
) -> Result<Contact, DetectError> {
    let last = memory.as_deref().and_then(|memory| memory.last);
    let mut search = Search::new(pair, settings);
    let start = last.map(|last| Start { x: last.x, lambda: last.lambda, near: true });
    if start.is_some() && settings.back_end == BackEnd::Fast {
        search.flags.insert(Flags::WARM);
    }
    let midway = search.midway(start)?;
    let scale = search.certify(&midway, Target::Midway);
    let separated = midway.outcome.ending == Ending::Separated;
    let least = Settings::default().flat_regularisation;
    if !separated && scale.s >= 1.0 && scale.low < 1.0 && settings.flat_regularisation > least {
        // Where the bulge of a raised regularisation may hide an overlap, the particles as they are decide.
        let settings = Settings { flat_regularisation: least, ..*settings };
        return solved(pair, [pose_a, pose_b], &settings, memory);
    }
    if let Some(memory) = memory {
        let overlapping = !separated && scale.s < 1.0;
        memory.last = Some(Remembered { x: midway.outcome.x, lambda: midway.outcome.lambda, overlapping });
    }
    if separated {
        let mut contact = Contact::separated(settings.formulation, scale.low.max(1.0));
        contact.flags.insert(search.flags);
        (contact.iterations, contact.back_end) = (search.iterations, search.answered);
        return Ok(contact);
    }
    let mut contact = Contact::separated(settings.formulation, scale.s);
    if scale.s < 1.0 {
        (contact.kind, contact.distance) = (Kind::Overlapping, f64::NAN);
    }
    let local = describe(&mut search, settings, pair, &midway, scale, &mut contact)?;
    contact.flags = search.flags;
    (contact.iterations, contact.back_end) = (search.iterations, search.answered);
    contact.place(&local, pair, pose_a, pose_b);
    Ok(contact)
}

/// A cheap proof of separation, if one succeeds and will do.
#[inline]
pub(crate) fn rejected(pair: &Pair, settings: &Settings, memory: Option<&Memory>) -> Option<Apart> {
    if settings.solve_separated {
        return None;
    }
    match memory.and_then(|memory| memory.last) {
        // Of a pair that overlapped, only the cheapest proof is worth a try.
        Some(Remembered { overlapping: true, .. }) => reject::balls_apart(pair),
        Some(last) => reject::still_apart(pair, &last.x).or_else(|| reject::proof_of_separation(pair)),
        None => reject::proof_of_separation(pair),
    }
}

/// The geometry that the settings ask for, from the solution of midway; what else is known goes into `contact`.
fn describe(
    search: &mut Search,
    settings: &Settings,
    pair: &Pair,
    midway: &Answer,
    scale: Certified,
    contact: &mut Contact,
) -> Result<LocalContact, DetectError> {
    let overlapping = contact.kind == Kind::Overlapping;
    if settings.formulation == Formulation::Closest {
        let of_a = search.constrained(Target::OnB, Some(midway))?;
        let of_b = if of_a.is_some() { search.constrained(Target::OnA, Some(midway))? } else { None };
        if let (Some((p2, of_a)), Some((p1, of_b))) = (of_a, of_b) {
            (contact.s, contact.s_b) = (of_a.s, of_b.s);
            contact.gap = of_a.gap.max(of_b.gap);
            contact.point_bound = search.bound(&p2, Target::OnB).max(search.bound(&p1, Target::OnA));
            contact.weight = share(p2.outcome.lambda);
            let gradients = [p1.outcome.gradients[0], p2.outcome.gradients[1]];
            let points = [&p1.outcome.x, &p2.outcome.x];
            return Ok(LocalContact::closest(pair, points, &gradients, settings.weight_on_a, overlapping));
        }
        search.flags.insert(Flags::SLACK);
        contact.formulation = Formulation::Midway;
    }
    contact.gap = scale.gap;
    contact.weight = share(midway.outcome.lambda);
    contact.point_bound = search.bound(midway, Target::Midway);
    LocalContact::midway(pair, &midway.outcome, |n| search.pieces(midway, n), overlapping)
        .ok_or_else(|| DetectError::Failed { conic: "the surface was not found along the normal".into() })
}

/// The weight u of B from the ratio λ = u/(1−u).
fn share(lambda: f64) -> f64 {
    lambda / (1.0 + lambda)
}
