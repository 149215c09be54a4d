//! The whole of contact detection: reject, solve, prove, describe.

use crate::bounds::solution::{Ending, Solution};
use crate::contact::contact::Contact;
use crate::contact::error::DetectError;
use crate::contact::geometry::LocalContact;
use crate::flags::Flags;
use crate::linalg::number::larger;
use crate::model::local_model::Start;
use crate::model::problem::Problem;
use crate::pair::minimum_norm_point;
use crate::pair::pair::Pair;
use crate::pair::pair_state::{How, LastContact, PairState, Remembered, from_memory_or_anew};
use crate::pair::separation::{self, Apart};
use crate::particle::particle::Particle;
use crate::pose::Pose;
use crate::settings::{BackEnd, Formulation, Settings};
use crate::solver::call::{Call, SolveError};
use crate::solver::closest;
use std::mem::MaybeUninit;

/// Contact of A at `pose_a` with B at `pose_b`.
///
/// `state` is what this ordered pair keeps from call to call: read, and updated on success. Both particles may lie in
/// the plane ([`Particle::in_plane`]); the contact lies there, too.
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
/// A setting out of range, no answer from any solver, one particle in the plane with one in space, or a pose that
/// leaves the plane.
pub fn detect(
    a: &Particle,
    pose_a: &Pose,
    b: &Particle,
    pose_b: &Pose,
    settings: &Settings,
    state: Option<&mut PairState>,
) -> Result<Contact, DetectError> {
    let mut place = MaybeUninit::uninit();
    detect_into((a, pose_a), (b, pose_b), settings, state, &mut place).map(|contact| *contact)
}

/// [`detect()`] into a place of the caller's, which is written where there is an answer: reuse, reject, solve,
/// describe.
///
/// A contact is large, and most pairs of a scene are rejected, where copying it would take longer than finding it.
#[inline(always)]
pub(crate) fn detect_into<'o>(
    a: (&Particle, &Pose),
    b: (&Particle, &Pose),
    settings: &Settings,
    mut state: Option<&mut PairState>,
    out: &'o mut MaybeUninit<Contact>,
) -> Result<&'o mut Contact, DetectError> {
    settings.validate()?;
    Particle::refuse_mixed(a, b)?;
    let mut out = out;
    if let Some(state) = state.as_deref_mut().filter(|_| settings.carries_on()) {
        match reused(a, b, settings, state, out) {
            Ok(contact) => return Ok(contact),
            Err(place) => out = place,
        }
    }
    anew(a, b, settings, state, out)
}

/// The last contact at these poses, if it is accurate enough; else `out` is returned, and the last contact is dropped.
/// Not inlined, as every function below that few pairs need: each has a stack frame of its own.
#[inline(never)]
fn reused<'o>(
    a: (&Particle, &Pose),
    b: (&Particle, &Pose),
    settings: &Settings,
    state: &mut PairState,
    out: &'o mut MaybeUninit<Contact>,
) -> Result<&'o mut Contact, &'o mut MaybeUninit<Contact>> {
    match state.carry_on(a, b, settings) {
        Some(contact) => Ok(out.write(contact)),
        None => {
            state.last_contact.of = [0; 2];
            Err(out)
        }
    }
}

/// The contact from the planes, with settings that were validated. Not inlined: compiled once, more of what it calls
/// is inlined into it.
#[inline(never)]
fn anew<'o>(
    a: (&Particle, &Pose),
    b: (&Particle, &Pose),
    settings: &Settings,
    mut state: Option<&mut PairState>,
    out: &'o mut MaybeUninit<Contact>,
) -> Result<&'o mut Contact, DetectError> {
    let last = state.as_deref().and_then(|state| state.remembered(a, b));
    let known = last.filter(|last| last.how != How::Overlapping && !settings.solve_separated());
    if let Some(proof) = known.and_then(|last| still_apart(a, b, &last)) {
        return Ok(out.write(rejected(settings, proof)));
    }
    let pair = Pair::new(a.0, a.1, b.0, b.1);
    if let Some(proof) = separated(&pair, settings, last.is_some_and(|last| last.how == How::Overlapping)) {
        return Ok(out.write(rejected(settings, proof)));
    }
    let solve = |remembers| solved(&pair, b.1, settings, state.as_deref_mut(), remembers);
    from_memory_or_anew(last.is_some(), solve).map(|contact| out.write(contact))
}

/// The proof that kept the pair apart, if it does so still.
#[inline(always)]
fn still_apart(a: (&Particle, &Pose), b: (&Particle, &Pose), last: &Remembered) -> Option<Apart> {
    match last.how {
        How::Balanced => minimum_norm_point::still_balanced(a, b, &last.x, &last.closest),
        _ => separation::still_apart(a, b, &last.x),
    }
}

/// A proof of separation, if one is wanted; of a pair that overlapped, only the cheapest test is tried.
#[inline(always)]
fn separated(pair: &Pair, settings: &Settings, overlapped: bool) -> Option<Apart> {
    match overlapped {
        _ if settings.solve_separated() => None,
        true => separation::balls_apart(pair),
        false => separation::proof_of_separation(pair),
    }
}

#[inline(always)]
fn rejected(settings: &Settings, Apart { by, distance }: Apart) -> Contact {
    Contact { flags: by.with(Flags::REJECTED), distance, ..Contact::separated(settings.formulation, 1.0) }
}

/// The contact of a pair that no separation test rejects. Not inlined: its stack frame is large, and most pairs of a
/// scene are rejected.
#[inline(never)]
fn solved(
    pair: &Pair,
    pose_b: &Pose,
    settings: &Settings,
    mut state: Option<&mut PairState>,
    remembers: bool,
) -> Result<Contact, DetectError> {
    let mut call = Call::new(pair, settings);
    // Unpacked again: a copy through memory would stall the proofs of separation.
    let mut last = state.as_deref().filter(|_| remembers).map(|state| state.unpacked());
    if let Some(last) = last.as_mut().filter(|_| pair.b.is_in_plane()) {
        // A point remembered of another pair may lie elsewhere, and z stays 0 only from 0 on.
        last.x.z = 0.0;
    }
    // If planes in balance kept sharp bodies apart, such planes are looked for again. If none did, the bodies are too
    // close for a proof by planes.
    let last = last.filter(|last| last.how != How::Balanced || settings.solve_separated() || !call.is_sharp());
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
                apart.filter(|_| !settings.solve_separated() && settings.back_end == BackEnd::Fast)
            {
                let Start { x, lambda } = start;
                remember(state, Remembered { x, lambda, how: How::Balanced, closest: planes });
                let flags = call.flags.with(Flags::REJECTED);
                return Ok(Contact { flags, distance, ..Contact::separated(settings.formulation, 1.0) });
            }
            start
        }
    };
    let mut model = call.model(&start, Problem::Midway);
    let overlapped = last.filter(|last| last.how == How::Overlapping && settings.formulation == Formulation::Closest);
    if let Some(points) = overlapped.and_then(|last| call.closest_from_memory(&last, &model)) {
        remember(state, closest::midway_between(&points));
        call.flag_free(&points);
        let local = LocalContact::closest(pair, &points, settings.weight_on_a, true);
        return Ok(local.placed(pair, pose_b, summary(&call)));
    }
    let midway = call.solve(Problem::Midway, start.lambda, &mut model)?;
    let scale = call.scale(&midway.solution, Problem::Midway);
    let separated = midway.solution.ending == Ending::Separated;
    if !separated && scale.s >= 1.0 && scale.low < 1.0 && settings.raises_regularisation() {
        // If the bulge of a raised regularisation may hide an overlap, the particles without it decide.
        let flat_regularisation = Settings::default().flat_regularisation;
        // Nothing is carried on: the settings were changed.
        let settings = Settings { flat_regularisation, carry_tolerance: 0.0, ..*settings };
        let contact = solved(pair, pose_b, &settings, state, remembers)?;
        return Ok(Contact { flags: contact.flags.with(Flags::DEFAULT_REGULARISATION), ..contact });
    }
    // A pair that is proved apart may have any upper bound; a raised regularisation was asked for with the gap that it
    // leaves.
    if !separated && scale.is_undecided(settings.raises_regularisation()) {
        return Err(SolveError::Undecided { low: scale.low, high: scale.high }.into());
    }
    if settings.is_precise() && !separated && !scale.is_known_to(settings.gap_tolerance) {
        call.flags.set(Flags::ROUNDING_LIMITED, true);
    }
    let overlapping = !separated && scale.s < 1.0;
    let Solution { x, lambda, values, .. } = midway.solution;
    let mut remembered = Remembered { x, lambda, how: How::solved(overlapping), closest: [1.0; 2] };
    let carries_on = settings.carries_on() && !call.flags.contains(Flags::EXTENDED);
    if separated {
        if let Some(state) = state.as_deref_mut().filter(|_| carries_on && scale.s - scale.gap > 1.0) {
            // The point is not needed.
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
            // By rounding, midway and closest may lie on different sides of 1. If midway is undecided, the scales of
            // the answer decide.
            let overlapping = if scale.tells_the_side() { overlapping } else { closest::is_overlap(points) };
            remembered.how = How::solved(overlapping);
            remembered = closest::seen_from(remembered, values, points);
            call.flag_free(points);
            LocalContact::closest(pair, points, settings.weight_on_a, overlapping)
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
    let answer = summary(&call);
    let distance = if remembered.how == How::Overlapping { answer.distance } else { known_distance(pair, scale.low) };
    Ok(local.placed(pair, pose_b, Contact { distance, ..answer }))
}

/// Lower bound on the distance of a pair that was solved to the end: by its s, by balls or by faces.
#[cold]
fn known_distance(pair: &Pair, low: f64) -> f64 {
    let by_scale = separation::distance_of_scale(pair.a, pair.b, low);
    separation::proof_of_separation(pair).map_or(by_scale, |proof| larger(proof.distance, by_scale))
}

/// The cost of a call, and who answered.
fn summary(call: &Call) -> Contact {
    Contact { flags: call.flags, iterations: call.iterations, back_end: call.back_end, ..Contact::UNKNOWN }
}

fn remember(state: Option<&mut PairState>, remembered: Remembered) {
    if let Some(state) = state {
        state.remember(remembered);
    }
}
