//! Many pairs in one call: the contacts of a whole step.

use crate::contact::contact::Contact;
use crate::contact::detect::{DetectError, detect};
use crate::pair::warm_start::Memory;
use crate::particle::particle::Particle;
use crate::pose::Pose;
use crate::settings::Settings;
use std::panic::resume_unwind;
use std::sync::{Mutex, PoisonError};
use std::thread;

/// Pairs that a thread takes at a time: enough that taking them costs nothing, few enough that no thread waits long
/// for the last one.
pub(crate) const CHUNK: usize = 64;

/// More threads than this are not started, whatever the caller asks.
pub(crate) const MOST_THREADS: usize = 256;

/// Contacts of many pairs of bodies: body i is `particles[i]` at `poses[i]`, pair n is that of the bodies `pairs[n]`, first A,
/// then B.
///
/// The answers come in the order of the pairs, and each is, to the last bit, what [`detect()`] gives for that pair alone,
/// whatever the number of threads: 1 is the calling thread alone (as is 0), n starts n − 1 more and ends them again before
/// the call returns. `memories` holds one memory for each pair, or nothing.
///
/// A pair that names a body that is not there has [`DetectError::NoSuchBody`] for an answer, and the others are answered.
///
/// ```
/// use potential_particles::{Kind, Memory, Particle, Pose, Settings, detect_batch};
/// let ball = Particle::sphere(1.0)?;
/// let particles = [&ball, &ball, &ball];
/// let poses = [Pose::at([0.0, 0.0, 0.0])?, Pose::at([1.5, 0.0, 0.0])?, Pose::at([5.0, 0.0, 0.0])?];
/// let mut memories = [Memory::default(); 2];
/// let answers = detect_batch(&particles, &poses, &[[0, 1], [1, 2]], &Settings::default(), 2, &mut memories)?;
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
    memories: &mut [Memory],
) -> Result<Vec<Result<Contact, DetectError>>, DetectError> {
    detect_batch_by(detect, particles, poses, pairs, settings, threads, memories)
}

/// The contact of one pair, in space or in the plane.
pub(crate) trait Detect<P, Q, C>:
    Fn(&P, &Q, &P, &Q, &Settings, Option<&mut Memory>) -> Result<C, DetectError> + Sync
{
}

impl<P, Q, C, F> Detect<P, Q, C> for F where
    F: Fn(&P, &Q, &P, &Q, &Settings, Option<&mut Memory>) -> Result<C, DetectError> + Sync
{
}

/// [`detect_batch`] of particles P at poses Q with contacts C.
pub(crate) fn detect_batch_by<P: Sync, Q: Sync, C: From<Contact> + Clone + Send>(
    detect: impl Detect<P, Q, C>,
    particles: &[&P],
    poses: &[Q],
    pairs: &[[u32; 2]],
    settings: &Settings,
    threads: usize,
    memories: &mut [Memory],
) -> Result<Vec<Result<C, DetectError>>, DetectError> {
    settings.validate()?;
    same_length("poses", poses.len(), particles.len())?;
    if !memories.is_empty() {
        same_length("memories", memories.len(), pairs.len())?;
    }
    let body = |index: u32| match (particles.get(index as usize), poses.get(index as usize)) {
        (Some(&particle), Some(pose)) => Ok((particle, pose)),
        _ => Err(DetectError::NoSuchBody { index, bodies: particles.len() }),
    };
    let one = |[i, j]: [u32; 2], memory: Option<&mut Memory>| {
        let ((a, pose_a), (b, pose_b)) = (body(i)?, body(j)?);
        detect(a, pose_a, b, pose_b, settings, memory)
    };
    let mut answers = vec![Ok(C::from(Contact::UNKNOWN)); pairs.len()];
    let chunks = pairs.chunks(CHUNK).zip(answers.chunks_mut(CHUNK)).zip(optional_chunks(memories));
    in_parallel(threads, pairs.len(), chunks, |((pairs, answers), memories)| {
        let mut memories = memories.iter_mut();
        for (&pair, answer) in pairs.iter().zip(answers) {
            *answer = one(pair, memories.next());
        }
    });
    Ok(answers)
}

fn same_length(what: &'static str, given: usize, expected: usize) -> Result<(), DetectError> {
    if given == expected { Ok(()) } else { Err(DetectError::Length { what, given, expected }) }
}

/// As [`slice::chunks_mut`], and empty chunks without end behind the last one: nothing is as good as one for each pair.
pub(crate) fn optional_chunks<T>(all: &mut [T]) -> impl Iterator<Item = &mut [T]> {
    all.chunks_mut(CHUNK).chain(std::iter::repeat_with(|| &mut [][..]))
}

/// Has every chunk of `count` items worked on once, by so many threads, of which the calling one is the first.
///
/// Which thread has which chunk is left to time, so that pairs of unlike cost do not hold up the others; as no chunk depends
/// on another, no result depends on it. A thread that the system refuses to start is done without.
pub(crate) fn in_parallel<T: Send>(
    threads: usize,
    count: usize,
    chunks: impl Iterator<Item = T> + Send,
    work: impl Fn(T) + Sync,
) {
    let threads = threads.min(count.div_ceil(CHUNK)).min(MOST_THREADS);
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
        // Joined one by one, which the scope alone would not do: so ThreadSanitizer sees in a caller's program that they ended.
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
                in_parallel(threads, count, visits.chunks_mut(CHUNK), |chunk| {
                    calls.fetch_add(1, Ordering::Relaxed);
                    chunk.iter_mut().for_each(|visit| *visit += 1);
                });
                assert!(visits.iter().all(|&visit| visit == 1), "{threads} threads, {count} items");
                assert_eq!(calls.into_inner(), count.div_ceil(CHUNK));
            }
        }
    }

    #[test]
    fn no_memories_are_empty_chunks() {
        let mut memories = [1, 2, 3];
        assert_eq!(optional_chunks(&mut memories).take(2).map(|chunk| chunk.len()).collect::<Vec<_>>(), [3, 0]);
        assert!(optional_chunks::<u8>(&mut []).take(3).all(|chunk| chunk.is_empty()));
    }
}
