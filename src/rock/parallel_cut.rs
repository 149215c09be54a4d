//! A round: what a run of joints makes of many parts, on several threads.
//!
//! What is cut off one part never depends on the others. So a thread takes a part and cuts it by all joints of the
//! round: first what lies below the first joint that meets it, piece by piece, then what lies beyond. What it works on
//! stays in its cache and is not kept. The pieces come in the same order whichever rounds there are: those of a part in
//! its place, what lies below a joint before what lies beyond.

use super::numbers::{CHUNKS, Limits};
use crate::contact::batch::in_parallel;
use crate::rock::cutting::{Cuts, LeftOut, Part, Workbench};
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

/// What was made of some parts that follow each other.
pub(super) struct Chunk<T> {
    /// In their order.
    pub results: Vec<T>,
    /// How many pieces they come from.
    pub pieces: usize,
    /// Of each joint of the round whether it has cut.
    has_cut: Vec<bool>,
    left_out: LeftOut,
}

/// What a round has made.
pub(super) struct Round<T> {
    /// In their order.
    pub chunks: Vec<Chunk<T>>,
    /// Joints that cut nothing.
    pub missing: Vec<usize>,
    pub left_out: LeftOut,
}

/// There were more pieces than allowed.
#[derive(Debug)]
pub(super) struct TooMany;

/// A piece that joints from `joint` on have still to cut.
#[derive(Default)]
struct Pending {
    part: Part,
    joint: usize,
}

/// What the joints of a range make of the parts. `finish` appends to the results what it makes of a piece, given its
/// number in the chunk. An error if there are more pieces than `most`.
pub(super) fn cut<T: Send>(
    threads: usize,
    parts: &[Part],
    cuts: &Cuts<'_>,
    joints: Range<usize>,
    most: usize,
    finish: impl Fn(usize, &Part, &mut Workbench, &mut Vec<T>) + Sync,
) -> Result<Round<T>, TooMany> {
    let length = parts.len().div_ceil(CHUNKS * threads.max(1)).clamp(1, Limits::CHUNK);
    let mut chunks: Vec<Option<Chunk<T>>> = parts.chunks(length).map(|_| None).collect();
    let count = AtomicUsize::new(parts.len());
    let work = parts.chunks(length).zip(&mut chunks);
    in_parallel(threads, parts.len().div_ceil(length), work, |(parts, made)| {
        *made = Some(chunk(parts, cuts, joints.clone(), (&count, most), &finish));
    });
    if count.into_inner() > most {
        return Err(TooMany);
    }
    let chunks: Vec<Chunk<T>> = chunks.into_iter().flatten().collect();
    let mut left_out = LeftOut::default();
    chunks.iter().for_each(|chunk| left_out.add(&chunk.left_out));
    let begin = joints.start;
    let missing = joints.filter(|joint| !chunks.iter().any(|chunk| chunk.has_cut[joint - begin])).collect();
    Ok(Round { chunks, missing, left_out })
}

/// What the joints make of some parts; `count` has the pieces that all threads have reported. It ends early if these
/// exceed the limit.
fn chunk<T>(
    parts: &[Part],
    cuts: &Cuts<'_>,
    joints: Range<usize>,
    (count, most): (&AtomicUsize, usize),
    finish: impl Fn(usize, &Part, &mut Workbench, &mut Vec<T>),
) -> Chunk<T> {
    let has_cut = vec![false; joints.len()];
    let mut made = Chunk { results: Vec::new(), pieces: 0, has_cut, left_out: LeftOut::default() };
    let (mut bench, mut piece, mut untold) = (Workbench::default(), Pending::default(), 0);
    // Waiting pieces, followed by buffers of former ones.
    let (mut stack, mut waiting): (Vec<Pending>, usize) = (Vec::new(), 0);
    for part in parts {
        piece.part.copy_from(part);
        piece.joint = joints.start;
        loop {
            while let Some(joint) = cuts.next(piece.joint..joints.end, &piece.part) {
                piece.joint = joint + 1;
                if waiting == stack.len() {
                    stack.push(Pending::default());
                }
                if cuts.cut(joint, &mut piece.part, &mut stack[waiting].part, &mut bench) {
                    stack[waiting].joint = joint + 1;
                    waiting += 1;
                    untold += 1;
                    made.has_cut[joint - joints.start] = true;
                }
            }
            finish(made.pieces, &piece.part, &mut bench, &mut made.results);
            made.pieces += 1;
            if untold >= Limits::CHUNK
                && count.fetch_add(untold, Ordering::Relaxed) + std::mem::take(&mut untold) > most
            {
                return made;
            }
            if waiting == 0 {
                break;
            }
            waiting -= 1;
            std::mem::swap(&mut piece, &mut stack[waiting]);
        }
    }
    count.fetch_add(untold, Ordering::Relaxed);
    made.left_out = bench.left_out;
    made
}
