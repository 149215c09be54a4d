//! The whole of contact detection: reject, solve, prove, describe.

use crate::bounds::solution::{Ending, Solution};
use crate::contact::carried::Carried;
use crate::contact::contact::Contact;
use crate::contact::geometry::LocalContact;
use crate::flags::Flags;
use crate::model::local_model::Start;
use crate::model::problem::Problem;
use crate::pair::memory::{Memory, Remembered};
use crate::pair::pair::Pair;
use crate::pair::separation::{self, Apart};
use crate::particle::particle::Particle;
use crate::pose::Pose;
use crate::settings::{BackEnd, Formulation, Settings, SettingsError};
use crate::solver::call::{Call, SolveError};
use crate::solver::closest;
use thiserror::Error;

/// Why there is no answer.
#[derive(Clone, Debug, Error)]
#[non_exhaustive]
pub enum DetectError {
    /// A setting is out of range.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// No solver reached an answer. The contact is unknown; this does not mean separated.
    #[error("no solver reached an answer ({reason}); the contact is unknown")]
    Failed {
        /// What stopped the last solver.
        reason: String,
    },
    /// A pair of a batch names a body that is not there.
    #[error("body {index} does not exist: there are {bodies}, counted from 0")]
    NoSuchBody {
        /// As given.
        index: u32,
        /// How many there are.
        bodies: usize,
    },
    /// The arguments of a batch do not fit together.
    #[error("{given} {what} given where {expected} are needed")]
    Length {
        /// Of what.
        what: &'static str,
        /// How many were given.
        given: usize,
        /// How many are needed.
        expected: usize,
    },
}

impl DetectError {
    pub(crate) fn no_surface() -> Self {
        Self::Failed { reason: "the surface was not found along the normal".into() }
    }
}

impl From<SolveError> for DetectError {
    fn from(error: SolveError) -> Self {
        Self::Failed { reason: error.to_string() }
    }
}

/// Contact of A at `pose_a` with B at `pose_b`.
///
/// `memory` is what this ordered pair remembers between calls: read, and updated on success.
///
/// ```
/// use potential_particles::{Kind, Memory, Particle, Pose, Settings, detect};
/// let ball = Particle::sphere(1.0)?;
/// let (left, right) = (Pose::at([0.0, 0.0, 0.0])?, Pose::at([1.5, 0.0, 0.0])?);
/// let mut memory = Memory::default();
/// let contact = detect(&ball, &left, &ball, &right, &Settings::default(), Some(&mut memory))?;
/// assert_eq!(contact.kind, Kind::Overlapping);
/// assert!((contact.s - 0.75).abs() <= contact.gap && (contact.overlap - 0.5).abs() < 1e-12);
/// assert!((contact.normal.x - 1.0).abs() < 1e-12);
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
    memory: Option<&mut Memory>,
) -> Result<Contact, DetectError> {
    detect_as((a, pose_a), (b, pose_b), settings, (memory, None), |contact| contact)
}

/// The same for a contact that is followed from pose to pose: where the last one can be carried on, with the contact point known to within `tolerance`
/// times the smaller bounding radius, no plane is looked at ([`Flags::CARRIED`]); elsewhere, and always with a tolerance of 0,
/// this is [`detect()`]. Only [`crate::Formulation::Midway`] by [`crate::BackEnd::Fast`] is carried on.
///
/// The gap and `point_bound` of a contact that was carried on hold for it as for any other.
///
/// ```
/// use potential_particles::{Carried, Flags, Memory, Particle, Plane, Pose, Settings, detect_carried};
/// let faces = [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
/// let cube = Particle::new(&faces.map(|[a, b, c]| Plane::from([a, b, c, 0.9])), 0.1, 0.1, 2.0)?;
/// let lower = Pose::at([0.0, 0.0, 0.0])?;
/// let (mut memory, mut carried) = (Memory::default(), Carried::default());
/// for step in 0..5 {
///     let upper = Pose::at([0.3, 1e-6 * f64::from(step), 1.9])?;
///     let (settings, pair) = (Settings::default(), (&cube, &lower, &cube, &upper));
///     let contact = detect_carried(pair.0, pair.1, pair.2, pair.3, &settings, 1e-9, Some(&mut memory), &mut carried)?;
///     assert_eq!(contact.flags.contains(Flags::CARRIED), step > 0);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// As of [`detect()`], or a tolerance that is not within [0, 0.1].
#[allow(clippy::too_many_arguments)]
pub fn detect_carried(
    a: &Particle,
    pose_a: &Pose,
    b: &Particle,
    pose_b: &Pose,
    settings: &Settings,
    tolerance: f64,
    memory: Option<&mut Memory>,
    carried: &mut Carried,
) -> Result<Contact, DetectError> {
    Carrying::new(settings, tolerance)?.detect((a, pose_a), (b, pose_b), memory, carried)
}

/// How contacts are carried on: checked once, for all pairs of a batch.
#[derive(Clone, Copy)]
pub(crate) struct Carrying<'a> {
    settings: &'a Settings,
    /// 0 where these settings always solve.
    tolerance: f64,
}

impl<'a> Carrying<'a> {
    pub fn new(settings: &'a Settings, tolerance: f64) -> Result<Self, SettingsError> {
        settings.validate()?;
        if !(0.0..=0.1).contains(&tolerance) {
            return Err(SettingsError::CarryTolerance(tolerance));
        }
        let carries = settings.formulation == Formulation::Midway && settings.back_end == BackEnd::Fast;
        Ok(Self { settings, tolerance: if carries { tolerance } else { 0.0 } })
    }

    /// The contact of one pair, carried on or from the planes.
    pub fn detect(
        &self,
        a: (&Particle, &Pose),
        b: (&Particle, &Pose),
        memory: Option<&mut Memory>,
        carried: &mut Carried,
    ) -> Result<Contact, DetectError> {
        match self.carry_on(a, b, carried, |contact| contact) {
            Some(contact) => Ok(contact),
            None => self.solve(a, b, (memory, carried), |contact| contact),
        }
    }

    /// `answer` of the contact that is carried on, if it can be.
    #[inline(always)]
    pub fn carry_on<T>(
        &self,
        a: (&Particle, &Pose),
        b: (&Particle, &Pose),
        carried: &mut Carried,
        answer: impl FnOnce(Contact) -> T,
    ) -> Option<T> {
        let carries = self.tolerance > 0.0 && carried.is_for(self.settings);
        if carries { carried.contact(a, b, self.tolerance, answer) } else { None }
    }

    /// `answer` of the contact from the planes, to be carried on from here.
    pub fn solve<T>(
        &self,
        a: (&Particle, &Pose),
        b: (&Particle, &Pose),
        (mut memory, carried): (Option<&mut Memory>, &mut Carried),
        answer: impl Fn(Contact) -> T,
    ) -> Result<T, DetectError> {
        if let (Some(memory), Some((x, lambda))) = (memory.as_deref_mut(), carried.last(a.0, b.0)) {
            memory.follow(x, lambda);
        }
        *carried = Carried::default();
        let carried = (self.tolerance > 0.0).then_some(carried);
        detect_as(a, b, self.settings, (memory, carried), answer)
    }
}

/// The whole of [`detect()`], for every entry that gives a contact another form. `answer` makes that form where the contact
/// comes into being: a contact is large, and most pairs of a scene end with a cheap proof, where copying it would take longer
/// than finding it.
#[inline(always)]
pub(crate) fn detect_as<T>(
    a: (&Particle, &Pose),
    b: (&Particle, &Pose),
    settings: &Settings,
    (memory, carried): (Option<&mut Memory>, Option<&mut Carried>),
    answer: impl Fn(Contact) -> T,
) -> Result<T, DetectError> {
    settings.validate()?;
    let last = memory.as_deref().and_then(|memory| memory.last);
    let rejected = |Apart { by, distance }: Apart| {
        let flags = by.with(Flags::REJECTED);
        Ok(answer(Contact { flags, distance, ..Contact::separated(settings.formulation, 1.0) }))
    };
    begin(a, b, settings, last, rejected, |pair| solved(pair, b.1, settings, memory, carried).map(&answer))
}

/// The contact of a pair that is not rejected by a separation test. In a frame of its own: it is large, and most pairs of a scene
/// need none.
#[inline(never)]
fn solved(
    pair: &Pair,
    pose_b: &Pose,
    settings: &Settings,
    memory: Option<&mut Memory>,
    carried: Option<&mut Carried>,
) -> Result<Contact, DetectError> {
    let mut call = Call::new(pair, settings);
    let last = memory.as_deref().and_then(|memory| memory.last);
    let start = match last {
        Some(last) => {
            if settings.back_end == BackEnd::Fast {
                call.flags.insert(Flags::WARM);
            }
            Start { x: last.x, lambda: last.lambda }
        }
        None => call.cold(),
    };
    let model = call.model(&start, Problem::Midway);
    let overlapped = last.filter(|last| last.overlapping && settings.formulation == Formulation::Closest);
    if let Some(points) = overlapped.and_then(|last| call.closest_from_memory(&last, &model)) {
        remember(memory, closest::midway_between(&points));
        let local = LocalContact::closest(pair, &points, settings.weight_on_a, true);
        return Ok(local.placed(pair, pose_b, summary(&call)));
    }
    let midway = call.solve(Problem::Midway, start.lambda, model)?;
    let scale = call.scale(&midway.solution, Problem::Midway);
    let separated = midway.solution.ending == Ending::Separated;
    if !separated && scale.s >= 1.0 && scale.low < 1.0 && settings.raises_regularisation() {
        // Where the bulge of a raised regularisation may hide an overlap, the particles as they are decide.
        let flat_regularisation = Settings::default().flat_regularisation;
        let settings = Settings { flat_regularisation, ..*settings };
        let contact = solved(pair, pose_b, &settings, memory, None)?;
        return Ok(Contact { flags: contact.flags.with(Flags::DEFAULT_REGULARISATION), ..contact });
    }
    if scale.is_undecided() {
        return Err(SolveError::Undecided { low: scale.low, high: scale.high }.into());
    }
    let overlapping = !separated && scale.s < 1.0;
    let Solution { x, lambda, values, .. } = midway.solution;
    let mut remembered = Remembered { x, lambda, overlapping, closest: [1.0; 2] };
    if separated {
        remember(memory, remembered);
        let s = scale.low.max(1.0);
        let flags = call.flags.with(Flags::REJECTED);
        return Ok(Contact { formulation: settings.formulation, flags, s, ..summary(&call) });
    }
    let points = if settings.formulation == Formulation::Closest { call.closest(&midway)? } else { None };
    let local = match &points {
        Some(points) => {
            remembered = closest::seen_from(remembered, values, points);
            LocalContact::closest(pair, points, settings.weight_on_a, overlapping)
        }
        None => {
            let local = LocalContact::midway(&call, &midway, scale, overlapping).ok_or_else(DetectError::no_surface)?;
            if let Some(carried) = carried.filter(|_| overlapping && !call.flags.contains(Flags::EXTENDED)) {
                *carried = Carried::of(&call, &midway, scale, local.point_bound());
            }
            local
        }
    };
    remember(memory, remembered);
    Ok(local.placed(pair, pose_b, summary(&call)))
}

/// What a call has cost, and who answered.
fn summary(call: &Call) -> Contact {
    Contact { flags: call.flags, iterations: call.iterations, back_end: call.back_end, ..Contact::UNKNOWN }
}

fn remember(memory: Option<&mut Memory>, remembered: Remembered) {
    if let Some(memory) = memory {
        memory.last = Some(remembered);
    }
}

/// Runs the separation tests, then the solver. The pair in one frame is handed on and not given back: copying it takes a twentieth
/// of a call from memory.
#[inline(always)]
fn begin<T>(
    a: (&Particle, &Pose),
    b: (&Particle, &Pose),
    settings: &Settings,
    last: Option<Remembered>,
    rejected: impl Fn(Apart) -> T,
    undecided: impl FnOnce(&Pair) -> T,
) -> T {
    let overlapped = last.is_some_and(|last| last.overlapping);
    let known = last.filter(|_| !overlapped && !settings.solve_separated);
    if let Some(proof) = known.and_then(|last| separation::still_apart(a, b, &last.x)) {
        return rejected(proof);
    }
    let pair = Pair::new(a.0, a.1, b.0, b.1);
    let proof = match overlapped {
        _ if settings.solve_separated => None,
        // Of a pair that overlapped, only the cheapest proof is worth a try.
        true => separation::balls_apart(&pair),
        false => separation::proof_of_separation(&pair),
    };
    match proof {
        Some(proof) => rejected(proof),
        None => undecided(&pair),
    }
}
