//! Many pairs in one call: the contacts of a whole step.

use crate::contact::contact::Contact;
use crate::contact::detect::detect_into;
use crate::contact::error::DetectError;
use crate::pair::pair_state::PairState;
use crate::particle::particle::Particle;
use crate::pose::Pose;
use crate::settings::Settings;
use std::mem::MaybeUninit;
use std::panic::resume_unwind;
use std::sync::{Mutex, PoisonError};
use std::thread;

/// Pairs that a thread takes at a time: enough that taking them costs nothing, few enough that no thread waits long for
/// the last one. Chosen: no result depends on it.
pub(crate) const CHUNK: usize = 64;

/// More threads than this are not started, whatever the caller asks (chosen).
pub(crate) const MOST_THREADS: usize = 256;

/// Contacts of many pairs of bodies: body i is `particles[i]` at `poses[i]`, pair n is that of the bodies `pairs[n]`,
/// first A, then B.
///
/// The answers come in the order of the pairs, and each is, to the last bit, what [`crate::detect()`] gives for that
/// pair alone, whatever the number of threads: 1 is the calling thread alone (as is 0), n starts n − 1 more and ends
/// them again before the call returns. `states` holds one state for each pair, or nothing.
///
/// A pair that names a body that is not there has [`DetectError::NoSuchBody`] for an answer, and the others are
/// answered.
///
/// ```
/// use potential_particles::{Kind, PairState, Particle, Pose, Settings, detect_batch};
/// let ball = Particle::sphere(1.0)?;
/// let particles = [&ball, &ball, &ball];
/// let poses = [Pose::at([0.0, 0.0, 0.0])?, Pose::at([1.5, 0.0, 0.0])?, Pose::at([5.0, 0.0, 0.0])?];
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
    let one = |_, a: Placed, b: Placed, state: Option<&mut PairState>, answer: &mut Answer| {
        let mut place = MaybeUninit::uninit();
        *answer = detect_into(a, b, settings, state, &mut place).map(|contact| *contact);
    };
    let mut answers = unanswered(pairs.len());
    detect_batch_by((one, refuse), (particles, poses), pairs, threads, states, &mut answers)?;
    Ok(answers)
}

/// [`detect_batch`] into answers of the caller's own form, one for each pair: `write` gets the number of a pair, the
/// place of its answer and the answer, which is not copied on the way. It is called once for each pair, by several
/// threads.
///
/// ```
/// use potential_particles::{Particle, Pose, Settings, detect_batch_into};
/// let ball = Particle::sphere(1.0)?;
/// let poses = [Pose::at([0.0, 0.0, 0.0])?, Pose::at([1.5, 0.0, 0.0])?];
/// let mut overlaps = [f64::NAN];
/// let write = |_, place: &mut f64, answer: Result<&potential_particles::Contact, _>| {
///     if let Ok(contact) = answer {
///         *place = contact.overlap;
///     }
/// };
/// detect_batch_into(&[&ball, &ball], &poses, &[[0, 1]], &Settings::default(), 1, &mut [], &mut overlaps, write)?;
/// assert!((overlaps[0] - 0.5).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Those of [`detect_batch`], and a number of answers that is not that of the pairs; then nothing was written.
#[allow(clippy::too_many_arguments)]
pub fn detect_batch_into<T: Send>(
    particles: &[&Particle],
    poses: &[Pose],
    pairs: &[[u32; 2]],
    settings: &Settings,
    threads: usize,
    states: &mut [PairState],
    answers: &mut [T],
    write: impl Fn(usize, &mut T, Result<&Contact, DetectError>) + Sync,
) -> Result<(), DetectError> {
    settings.validate()?;
    let one = |number, a: Placed, b: Placed, state: Option<&mut PairState>, place: &mut T| {
        let mut contact = MaybeUninit::uninit();
        write(number, place, detect_into(a, b, settings, state, &mut contact).map(|contact| &*contact));
    };
    let refuse = |number, place: &mut T, error| write(number, place, Err(error));
    detect_batch_by((one, refuse), (particles, poses), pairs, threads, states, answers)
}

/// A particle at a pose.
type Placed<'a> = (&'a Particle, &'a Pose);
type Answer = Result<Contact, DetectError>;

/// A small placeholder for each answer: a contact is large, and each will be written.
fn unanswered(pairs: usize) -> Vec<Answer> {
    vec![Err(DetectError::NoSuchBody { index: 0, bodies: 0 }); pairs]
}

/// The answer for a pair that names a body that is not there.
fn refuse(_: usize, answer: &mut Answer, error: DetectError) {
    *answer = Err(error);
}

/// [`detect_batch`] with settings that were checked: `detect` finds the answer T of the pair of this number with its
/// state, if that is kept, and `refuse` writes an error in its place.
fn detect_batch_by<T: Send>(
    (detect, refuse): (
        impl Fn(usize, Placed, Placed, Option<&mut PairState>, &mut T) + Sync,
        impl Fn(usize, &mut T, DetectError) + Sync,
    ),
    (particles, poses): (&[&Particle], &[Pose]),
    pairs: &[[u32; 2]],
    threads: usize,
    states: &mut [PairState],
    answers: &mut [T],
) -> Result<(), DetectError> {
    same_length("poses", poses.len(), particles.len())?;
    same_length("answers", answers.len(), pairs.len())?;
    if !states.is_empty() {
        same_length("states", states.len(), pairs.len())?;
    }
    let body = |index: u32| match (particles.get(index as usize), poses.get(index as usize)) {
        (Some(&particle), Some(pose)) => Ok((particle, pose)),
        _ => Err(DetectError::NoSuchBody { index, bodies: particles.len() }),
    };
    let chunks = pairs.chunks(CHUNK).zip(answers.chunks_mut(CHUNK)).zip(optional_chunks(states));
    in_parallel(threads, pairs.len().div_ceil(CHUNK), chunks.enumerate(), |(chunk, ((pairs, answers), states))| {
        let mut states = states.iter_mut();
        for (number, (&[i, j], answer)) in (chunk * CHUNK..).zip(pairs.iter().zip(answers)) {
            let state = states.next();
            match (body(i), body(j)) {
                (Ok(a), Ok(b)) => detect(number, a, b, state, answer),
                (Err(error), _) | (_, Err(error)) => refuse(number, answer, error),
            }
        }
    });
    Ok(())
}

fn same_length(what: &'static str, given: usize, expected: usize) -> Result<(), DetectError> {
    if given == expected { Ok(()) } else { Err(DetectError::Length { what, given, expected }) }
}

/// As [`slice::chunks_mut`], then empty chunks without end: an empty slice means that no pair has one.
pub(crate) fn optional_chunks<T>(all: &mut [T]) -> impl Iterator<Item = &mut [T]> {
    all.chunks_mut(CHUNK).chain(std::iter::repeat_with(|| &mut [][..]))
}

/// Has each of `count` chunks worked on once, by so many threads, of which the calling one is the first.
///
/// Which thread has which chunk is left to time, so that pairs of unlike cost do not hold up the others; as no chunk
/// depends on another, no result depends on it. A thread that the system refuses to start is done without.
pub(crate) fn in_parallel<T: Send>(
    threads: usize,
    count: usize,
    chunks: impl Iterator<Item = T> + Send,
    work: impl Fn(T) + Sync,
) {
    let threads = threads.min(count).min(MOST_THREADS);
    if threads <= 1 {
        return chunks.for_each(work);
    }
    let chunks = Mutex::new(chunks);
    let take_turns = || {
        loop {
            let next = chunks.lock().unwrap_or_else(PoisonError::into_inner).next();
            match next {
                Some(chunk) => work(chunk),
                None => break,
            }
        }
    };
    thread::scope(|scope| {
        let start = |_| thread::Builder::new().spawn_scoped(scope, take_turns).ok();
        let helpers: Vec<_> = (1..threads).filter_map(start).collect();
        take_turns();
        // Joined one by one, which the scope alone would not do: so ThreadSanitizer sees in a caller's program that
        // they ended.
        for helper in helpers {
            helper.join().unwrap_or_else(|panic| resume_unwind(panic));
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    #[test]
    fn every_chunk_is_worked_on_once() {
        for threads in [0, 1, 2, 5, 1_000_000] {
            for count in [0, 1, CHUNK, CHUNK + 1, 10 * CHUNK + 7] {
                let mut visits = vec![0; count];
                let calls = AtomicUsize::new(0);
                in_parallel(threads, count.div_ceil(CHUNK), visits.chunks_mut(CHUNK), |chunk| {
                    calls.fetch_add(1, Ordering::Relaxed);
                    chunk.iter_mut().for_each(|visit| *visit += 1);
                });
                assert!(visits.iter().all(|&visit| visit == 1), "{threads} threads, {count} items");
                assert_eq!(calls.into_inner(), count.div_ceil(CHUNK));
            }
        }
    }

    #[test]
    fn no_states_are_empty_chunks() {
        let mut states = [1, 2, 3];
        assert_eq!(optional_chunks(&mut states).take(2).map(|chunk| chunk.len()).collect::<Vec<_>>(), [3, 0]);
        assert!(optional_chunks::<u8>(&mut []).take(3).all(|chunk| chunk.is_empty()));
    }
}
