//! The whole of contact detection: reject, solve, prove, describe.

use crate::contact::{Contact, Flags, LocalContact};
use crate::expansion::{Expansion, Start};
use crate::memory::{Memory, Remembered};
use crate::outcome::{Ending, Outcome};
use crate::pair::Pair;
use crate::particle::Particle;
use crate::pose::Pose;
use crate::reject::{self, Apart};
use crate::search::Search;
use crate::settings::{BackEnd, Formulation, Settings, SettingsError};
use crate::target::Target;
use nalgebra::Vector3;
use std::ops::ControlFlow;
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
    match begin((a, pose_a), (b, pose_b), settings, memory.as_deref()) {
        ControlFlow::Break(Apart { by, distance }) => {
            let flags = by.with(Flags::REJECTED);
            Ok(Contact { flags, distance, ..Contact::separated(settings.formulation, 1.0) })
        }
        ControlFlow::Continue(pair) => solved(&pair, pose_b, settings, memory),
    }
}

/// The contact of a pair that no cheap proof holds apart. In a frame of its own: it is large, and most pairs of a scene
/// need none.
#[inline(never)]
pub(crate) fn solved(
    pair: &Pair,
    pose_b: &Pose,
    settings: &Settings,
    memory: Option<&mut Memory>,
) -> Result<Contact, DetectError> {
    let mut search = Search::new(pair, settings);
    let start = match memory.as_deref().and_then(|memory| memory.last) {
        Some(last) => {
            if settings.back_end == BackEnd::Fast {
                search.flags.insert(Flags::WARM);
            }
            Start { x: last.x, lambda: last.lambda, near: true }
        }
        None => search.cold(),
    };
    let mut here = search.expansion(&start, Target::Midway);
    let midway = search.midway(&start, &mut here)?;
    let scale = search.certify(&midway, Target::Midway);
    let separated = midway.ending == Ending::Separated;
    let least = Settings::default().flat_regularisation;
    if !separated && scale.s >= 1.0 && scale.low < 1.0 && settings.flat_regularisation > least {
        // Where the bulge of a raised regularisation may hide an overlap, the particles as they are decide.
        let settings = Settings { flat_regularisation: least, ..*settings };
        return solved(pair, pose_b, &settings, memory);
    }
    let overlapping = !separated && scale.s < 1.0;
    if let Some(memory) = memory {
        memory.last = Some(Remembered { x: midway.x, lambda: midway.lambda, overlapping });
    }
    if separated {
        let Search { flags, iterations, answered, .. } = search;
        let contact = Contact::separated(settings.formulation, scale.low.max(1.0));
        return Ok(Contact { flags: contact.flags.with(flags), iterations, back_end: answered, ..contact });
    }
    let found = match settings.formulation {
        Formulation::Closest => closest(&mut search, settings, (&midway, &here), overlapping)?,
        Formulation::Midway => None,
    };
    let local = match found {
        Some(local) => local,
        None => {
            let bound = || search.bound(&midway, &here, Target::Midway);
            let pieces = |n: &Vector3<f64>| search.pieces(&midway, &here, n);
            LocalContact::midway(pair, &midway, scale, bound, pieces, overlapping)
                .ok_or_else(|| DetectError::Failed { conic: "the surface was not found along the normal".into() })?
        }
    };
    let Search { flags, iterations, answered, .. } = search;
    Ok(local.placed(pair, pose_b, Contact { flags, iterations, back_end: answered, ..Contact::UNKNOWN }))
}

/// A cheap proof of separation, if one succeeds and will do; else the pair in one frame.
#[inline(always)]
pub(crate) fn begin<'a>(
    a: (&'a Particle, &Pose),
    b: (&'a Particle, &Pose),
    settings: &Settings,
    memory: Option<&Memory>,
) -> ControlFlow<Apart, Pair<'a>> {
    let last = memory.and_then(|memory| memory.last);
    let overlapped = last.is_some_and(|last| last.overlapping);
    let known = last.filter(|_| !overlapped && !settings.solve_separated);
    if let Some(proof) = known.and_then(|last| reject::still_apart(a, b, &last.x)) {
        return ControlFlow::Break(proof);
    }
    let pair = Pair::new(a.0, a.1, b.0, b.1);
    let proof = match overlapped {
        _ if settings.solve_separated => None,
        // Of a pair that overlapped, only the cheapest proof is worth a try.
        true => reject::balls_apart(&pair),
        false => reject::proof_of_separation(&pair),
    };
    match proof {
        Some(proof) => ControlFlow::Break(proof),
        None => ControlFlow::Continue(pair),
    }
}

/// The contact by both closest points; midway lies between them. `None` where a constraint is slack, which is flagged.
fn closest(
    search: &mut Search,
    settings: &Settings,
    midway: (&Outcome, &Expansion),
    overlapping: bool,
) -> Result<Option<LocalContact>, DetectError> {
    if let Some(p2) = search.constrained(Target::OnB, Some(midway))?
        && let Some(p1) = search.constrained(Target::OnA, Some(midway))?
    {
        return Ok(Some(LocalContact::closest(search.pair, [&p1, &p2], settings.weight_on_a, overlapping)));
    }
    search.flags.insert(Flags::SLACK);
    Ok(None)
}
