//! The whole of contact detection: reject, solve, prove, describe.

use crate::bounds::solution::{Ending, Solution};
use crate::contact::contact::Contact;
use crate::contact::geometry::LocalContact;
use crate::flags::Flags;
use crate::model::local_model::Start;
use crate::model::problem::Problem;
use crate::pair::hull;
use crate::pair::pair::Pair;
use crate::pair::pair_state::{LastContact, PairState, Remembered, from_memory_or_anew};
use crate::pair::separation::{self, Apart};
use crate::particle::particle::Particle;
use crate::pose::Pose;
use crate::settings::{BackEnd, Formulation, Settings, SettingsError};
use crate::solver::call::{Call, SolveError};
use crate::solver::closest;
use std::convert::identity;
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
/// `state` is what this ordered pair keeps from call to call: read, and updated on success.
///
/// ```
/// use potential_particles::{Flags, Kind, PairState, Particle, Pose, Settings, detect};
/// let ball = Particle::sphere(1.0)?;
/// let left = Pose::at([0.0, 0.0, 0.0])?;
/// let settings = Settings::default().with_carry_tolerance(1e-9);
/// let mut state = PairState::default();
/// for step in 0..3 {
///     let right = Pose::at([1.5, 1e-6 * f64::from(step), 0.0])?;
///     let contact = detect(&ball, &left, &ball, &right, &settings, Some(&mut state))?;
///     assert_eq!(contact.kind, Kind::Overlapping);
///     assert!((contact.s - 0.75).abs() < 1e-11 && (contact.overlap - 0.5).abs() < 1e-11);
///     assert!((contact.normal.x - 1.0).abs() < 1e-11);
///     assert_eq!(contact.flags.contains(Flags::CARRIED), step > 0);
/// }
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
    detect_as((a, pose_a), (b, pose_b), settings, state, identity)
}

/// What makes the form T of a contact that the caller asked for. Any closure does; a type of its own may be `inline(always)`, which cannot be
/// put on a closure.
pub(crate) trait Form<T> {
    fn of(&self, contact: Contact) -> T;
}

impl<T, F: Fn(Contact) -> T> Form<T> for F {
    #[inline(always)]
    fn of(&self, contact: Contact) -> T {
        self(contact)
    }
}

/// The whole of [`detect()`], for every entry that gives a contact another form. `answer` makes that form where the contact
/// comes into being: a contact is large, and most pairs of a scene are rejected by a separation test, where copying it would take longer
/// than finding it.
#[inline(always)]
pub(crate) fn detect_as<T>(
    a: (&Particle, &Pose),
    b: (&Particle, &Pose),
    settings: &Settings,
    state: Option<&mut PairState>,
    answer: impl Form<T>,
) -> Result<T, DetectError> {
    settings.validate()?;
    match state {
        Some(state) if settings.carries_on() => carried_on_or_anew(a, b, settings, state, answer),
        state => anew(a, b, settings, state, answer),
    }
}

/// `answer` of the contact that is carried on, if it can be. In a frame of its own, as every part below that not all pairs need.
#[inline(never)]
fn carried_on_or_anew<T>(
    a: (&Particle, &Pose),
    b: (&Particle, &Pose),
    settings: &Settings,
    state: &mut PairState,
    answer: impl Form<T>,
) -> Result<T, DetectError> {
    match state.carry_on(a, b, settings, &answer) {
        Some(answer) => Ok(answer),
        None => not_carried_on(a, b, settings, state, answer),
    }
}

/// `answer` of the contact from the planes, to be carried on from here.
pub(crate) fn not_carried_on<T>(
    a: (&Particle, &Pose),
    b: (&Particle, &Pose),
    settings: &Settings,
    state: &mut PairState,
    answer: impl Form<T>,
) -> Result<T, DetectError> {
    state.last_contact.of = [0; 2];
    anew(a, b, settings, Some(state), answer)
}

/// `answer` of the contact from the planes, with settings that were checked. One function for all who call it: in each of them the compiler
/// would take less of it into one frame.
#[inline(never)]
fn anew<T>(
    a: (&Particle, &Pose),
    b: (&Particle, &Pose),
    settings: &Settings,
    state: Option<&mut PairState>,
    answer: impl Form<T>,
) -> Result<T, DetectError> {
    let last = state.as_deref().and_then(|state| state.remembered(a, b));
    let rejected = |Apart { by, distance }: Apart| {
        let flags = by.with(Flags::REJECTED);
        Ok(answer.of(Contact { flags, distance, ..Contact::separated(settings.formulation, 1.0) }))
    };
    begin(a, b, settings, last, rejected, |pair| {
        let mut state = state;
        from_memory_or_anew(last.is_some(), |remembers| {
            solved(pair, b.1, settings, state.as_deref_mut(), remembers).map(|contact| answer.of(contact))
        })
    })
}

/// The contact of a pair that is not rejected by a separation test. In a frame of its own: it is large, and most pairs of a scene
/// need none.
#[inline(never)]
fn solved(
    pair: &Pair,
    pose_b: &Pose,
    settings: &Settings,
    mut state: Option<&mut PairState>,
    remembers: bool,
) -> Result<Contact, DetectError> {
    let mut call = Call::new(pair, settings);
    // Unpacked once more: handed on through memory it would hold up the proofs of separation.
    let last = state.as_deref().filter(|_| remembers).map(|state| state.unpacked());
    // Where planes in balance kept sharp bodies apart, such planes are looked for again. Where none did, they are closer than planes can tell.
    let last = last.filter(|last| !last.balanced || settings.solve_separated || !call.is_sharp());
    let start = match last {
        Some(last) => {
            if settings.back_end == BackEnd::Fast {
                call.flags.set(Flags::WARM, true);
            }
            Start { x: last.x, lambda: last.lambda }
        }
        None => {
            let (start, apart) = call.cold_or_apart();
            if let Some((Apart { distance, .. }, planes)) =
                apart.filter(|_| !settings.solve_separated && settings.back_end == BackEnd::Fast)
            {
                let Start { x, lambda } = start;
                remember(state, Remembered { x, lambda, overlapping: false, balanced: true, closest: planes });
                let flags = call.flags.with(Flags::REJECTED);
                return Ok(Contact { flags, distance, ..Contact::separated(settings.formulation, 1.0) });
            }
            start
        }
    };
    let mut model = call.model(&start, Problem::Midway);
    let overlapped = last.filter(|last| last.overlapping && settings.formulation == Formulation::Closest);
    if let Some(points) = overlapped.and_then(|last| call.closest_from_memory(&last, &model)) {
        remember(state, closest::midway_between(&points));
        let local = LocalContact::closest(pair, &points, settings.weight_on_a, true);
        return Ok(local.placed(pair, pose_b, summary(&call)));
    }
    let midway = call.solve(Problem::Midway, start.lambda, &mut model)?;
    let scale = call.scale(&midway.solution, Problem::Midway);
    let separated = midway.solution.ending == Ending::Separated;
    if !separated && scale.s >= 1.0 && scale.low < 1.0 && settings.raises_regularisation() {
        // Where the bulge of a raised regularisation may hide an overlap, the particles as they are decide.
        let flat_regularisation = Settings::default().flat_regularisation;
        // Of a contact with other settings than were given nothing is carried on.
        let settings = Settings { flat_regularisation, carry_tolerance: 0.0, ..*settings };
        let contact = solved(pair, pose_b, &settings, state, remembers)?;
        return Ok(Contact { flags: contact.flags.with(Flags::DEFAULT_REGULARISATION), ..contact });
    }
    // What is proved apart may have any upper bound; a raised regularisation was asked for with the gap that it leaves.
    if !separated && scale.is_undecided(settings.raises_regularisation()) {
        return Err(SolveError::Undecided { low: scale.low, high: scale.high }.into());
    }
    let overlapping = !separated && scale.s < 1.0;
    let Solution { x, lambda, values, .. } = midway.solution;
    let mut remembered = Remembered { x, lambda, overlapping, balanced: false, closest: [1.0; 2] };
    let carries_on = settings.carries_on() && !call.flags.contains(Flags::EXTENDED);
    if separated {
        if let Some(state) = state.as_deref_mut().filter(|_| carries_on && scale.s - scale.gap > 1.0) {
            // Nobody asks for its point.
            state.last_contact = LastContact::of(&call, &midway, scale, 0.0);
        }
        remember(state, remembered);
        let s = scale.low.max(1.0);
        let flags = call.flags.with(Flags::REJECTED);
        let distance = separation::distance_of_scale(pair.a, pair.b, scale.low);
        return Ok(Contact { formulation: settings.formulation, flags, s, distance, ..summary(&call) });
    }
    let points = if settings.formulation == Formulation::Closest { call.closest(&midway)? } else { None };
    let local = match &points {
        Some(points) => {
            // By rounding, midway and closest may lie on different sides of 1. Where midway does not tell, the scales that are answered do.
            remembered.overlapping = if scale.tells_the_side() { overlapping } else { closest::is_overlap(points) };
            remembered = closest::seen_from(remembered, values, points);
            LocalContact::closest(pair, points, settings.weight_on_a, remembered.overlapping)
        }
        None => {
            let local = LocalContact::midway(&call, &midway, scale, overlapping).ok_or_else(DetectError::no_surface)?;
            if let Some(state) = state.as_deref_mut().filter(|_| carries_on && overlapping) {
                state.last_contact = LastContact::of(&call, &midway, scale, local.point_bound());
            }
            local
        }
    };
    remember(state, remembered);
    Ok(local.placed(pair, pose_b, summary(&call)))
}

/// What a call has cost, and who answered.
fn summary(call: &Call) -> Contact {
    Contact { flags: call.flags, iterations: call.iterations, back_end: call.back_end, ..Contact::UNKNOWN }
}

fn remember(state: Option<&mut PairState>, remembered: Remembered) {
    if let Some(state) = state {
        state.remember(remembered);
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
    let still_apart = |last: Remembered| match last.balanced {
        true => hull::still_balanced(a, b, &last.x, &last.closest),
        false => separation::still_apart(a, b, &last.x),
    };
    if let Some(proof) = known.and_then(still_apart) {
        return rejected(proof);
    }
    let pair = Pair::new(a.0, a.1, b.0, b.1);
    let proof = match overlapped {
        _ if settings.solve_separated => None,
        // Of a pair that overlapped, only the cheapest test is tried.
        true => separation::balls_apart(&pair),
        false => separation::proof_of_separation(&pair),
    };
    match proof {
        Some(proof) => rejected(proof),
        None => undecided(&pair),
    }
}
