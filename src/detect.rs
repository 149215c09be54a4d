//! The whole of contact detection: reject, solve, prove, describe.

use crate::body::Body;
use crate::certificate::{self, Certified};
use crate::conic::{self, ConicError, Role};
use crate::contact::{Contact, Flags, Kind, LocalContact};
use crate::memory::{Memory, Remembered};
use crate::model::Target;
use crate::pair::Pair;
use crate::particle::Particle;
use crate::pose::Pose;
use crate::reject;
use crate::settings::{BackEnd, Formulation, Settings, SettingsError};
use crate::spine::{self, Ending, Expansion, Factorisation, Goal, Outcome, Start};
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
    let last = memory.as_deref().and_then(|m| m.last);
    if !settings.solve_separated {
        let overlapped = last.is_some_and(|last| last.overlapping);
        if if overlapped { reject::balls_apart(&pair) } else { reject::proves_separation(&pair) } {
            return Ok(Contact::separated(settings.formulation, 1.0));
        }
    }
    let mut search = Search::new(&pair, settings, last);
    let midway = search.solve(Target::Midway, search.start, None)?;
    let scale = search.certify(&midway, Target::Midway);
    if let Some(memory) = memory {
        let overlapping = midway.ending != Ending::Separated && scale.s < 1.0;
        memory.last = Some(Remembered { x: midway.x, lambda: midway.lambda, overlapping });
    }
    if midway.ending == Ending::Separated {
        let mut contact = Contact::separated(settings.formulation, scale.s.max(1.0));
        (contact.iterations, contact.back_end) = (search.iterations, search.answered);
        return Ok(contact);
    }
    let kind = if scale.s < 1.0 { Kind::Overlapping } else { Kind::Separated };
    search.describe(kind, &midway, scale, pose_a, pose_b)
}

/// One call: the pair, what is asked, and what it has cost so far.
struct Search<'a> {
    pair: &'a Pair<'a>,
    body_a: Body<'a>,
    body_b: Body<'a>,
    settings: &'a Settings,
    start: Option<Start>,
    iterations: u32,
    flags: Flags,
    answered: BackEnd,
}

impl<'a> Search<'a> {
    fn new(pair: &'a Pair<'a>, settings: &'a Settings, last: Option<Remembered>) -> Self {
        let (body_a, body_b) = Body::both(pair, settings.flat_regularisation);
        let start = last.map(|last| Start { x: last.x, lambda: last.lambda, near: true });
        let mut flags = Flags::default();
        if start.is_some() && settings.back_end == BackEnd::Fast {
            flags.insert(Flags::WARM);
        }
        Self { pair, body_a, body_b, settings, start, iterations: 0, flags, answered: settings.back_end }
    }

    /// The ladder: from the start at hand, cold, with the safer factorisation, and by the cone program.
    fn solve(
        &mut self,
        target: Target,
        start: Option<Start>,
        mut left: Option<Expansion>,
    ) -> Result<Outcome, DetectError> {
        if self.settings.back_end == BackEnd::Fast {
            let usual = spine::factorisation(&self.body_a, &self.body_b);
            let mut rungs = [start.map(|s| (Some(s), usual)), Some((None, usual)), None];
            if usual == Factorisation::Plain {
                rungs[2] = Some((None, Factorisation::Aligned));
            }
            for (start, factorisation) in rungs.into_iter().flatten() {
                let start = start.unwrap_or_else(|| spine::cold_start(self.pair, &self.body_a, &self.body_b));
                let outcome =
                    spine::solve(&self.body_a, &self.body_b, &self.goal(target), start, left.take(), factorisation);
                self.iterations += outcome.iterations;
                if outcome.ending != Ending::Stuck {
                    if factorisation != usual {
                        self.flags.insert(Flags::SAFER);
                    }
                    if outcome.ending == Ending::RoundingLimited {
                        self.flags.insert(Flags::ROUNDING_LIMITED);
                    }
                    return Ok(outcome);
                }
            }
            self.flags.insert(Flags::FELL_BACK);
        }
        self.answered = BackEnd::Conic;
        self.conic(target).map_err(|error| DetectError::Failed { conic: error.to_string() })
    }

    fn conic(&mut self, target: Target) -> Result<Outcome, ConicError> {
        let solution = match target {
            Target::Midway => conic::midway(self.pair)?,
            Target::OnB => conic::closest(self.pair, Role::B)?,
            Target::OnA => conic::closest(self.pair, Role::A)?,
        };
        self.iterations += solution.iterations;
        let u = solution.weight;
        let outcome = certificate::judge(&solution.x, u / (1.0 - u), solution.s, &self.body_a, &self.body_b, target);
        Ok(Outcome { iterations: solution.iterations, ..outcome })
    }

    fn goal(&self, target: Target) -> Goal {
        Goal {
            target,
            tolerance: self.settings.gap_tolerance,
            stop_when_separated: target == Target::Midway && !self.settings.solve_separated,
        }
    }

    fn bound(&self, outcome: &Outcome, target: Target) -> f64 {
        certificate::distance(outcome, &self.body_a, &self.body_b, target)
    }

    fn certify(&self, outcome: &Outcome, target: Target) -> Certified {
        certificate::scale(outcome, &self.body_a, &self.body_b, target)
    }

    /// One of the two problems of closest, or `None` where its constraint is slack: the optimum is then the
    /// minimum of the other particle, for k > 0 its centre, for k = 0 anywhere in its core, and no contact
    /// point. Midway has no such case.
    fn constrained(&mut self, target: Target, midway: &Outcome) -> Result<Option<(Outcome, Certified)>, DetectError> {
        let centre_inside = match target {
            Target::OnB => self.pair.b.potential(&self.pair.centre) < 0.0,
            _ => self.pair.a.potential(&self.body_a.local(&self.body_b.centre())) < 0.0,
        };
        if centre_inside {
            return Ok(None);
        }
        // It lies near midway on the same curve, mostly on the same planes.
        let start = Start { x: midway.x, lambda: midway.lambda, near: true };
        let outcome = self.solve(target, Some(start), midway.expansion)?;
        let scale = self.certify(&outcome, target);
        // A scale that cannot be told from 0 belongs to a core.
        Ok((scale.s > scale.gap).then_some((outcome, scale)))
    }

    /// The geometry that the settings ask for, from the solution of midway.
    fn describe(
        mut self,
        kind: Kind,
        midway: &Outcome,
        scale: Certified,
        pose_a: &Pose,
        pose_b: &Pose,
    ) -> Result<Contact, DetectError> {
        let overlapping = kind == Kind::Overlapping;
        let mut contact = Contact { kind, ..Contact::separated(self.settings.formulation, scale.s) };
        contact.gap = scale.gap;
        contact.weight = midway.lambda / (1.0 + midway.lambda);
        let mut local = None;
        if self.settings.formulation == Formulation::Closest {
            let on_b = self.constrained(Target::OnB, midway)?;
            let on_a = if on_b.is_some() { self.constrained(Target::OnA, midway)? } else { None };
            if let (Some((on_b, of_a)), Some((on_a, of_b))) = (on_b, on_a) {
                (contact.s, contact.s_b) = (of_a.s, of_b.s);
                contact.gap = of_a.gap.max(of_b.gap);
                contact.point_bound = self.bound(&on_b, Target::OnB).max(self.bound(&on_a, Target::OnA));
                contact.weight = on_b.lambda / (1.0 + on_b.lambda);
                let gradients = [on_a.gradients[0], on_b.gradients[1]];
                let weight = self.settings.weight_on_a;
                local = Some(LocalContact::closest(self.pair, [&on_a.x, &on_b.x], &gradients, weight, overlapping));
            } else {
                self.flags.insert(Flags::SLACK);
                contact.formulation = Formulation::Midway;
            }
        }
        if local.is_none() {
            contact.point_bound = self.bound(midway, Target::Midway);
        }
        let local = match local {
            Some(local) => local,
            None => LocalContact::midway(self.pair, &midway.x, &midway.gradients, overlapping)
                .ok_or_else(|| DetectError::Failed { conic: "the surface was not found along the normal".into() })?,
        };
        contact.flags = self.flags;
        (contact.iterations, contact.back_end) = (self.iterations, self.answered);
        contact.place(&local, self.pair, pose_a, pose_b);
        Ok(contact)
    }
}
