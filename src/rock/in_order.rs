//! Many pieces of work on several threads, whose results come in the order of the pieces.

use crate::contact::batch::{CHUNK, in_parallel};

/// What `work` makes of each item.
pub(super) fn mapped<T: Send, U: Send>(threads: usize, items: &mut [T], work: impl Fn(&mut T) -> U + Sync) -> Vec<U> {
    let mut results: Vec<Option<U>> = items.iter().map(|_| None).collect();
    let count = items.len();
    let chunks = items.chunks_mut(CHUNK).zip(results.chunks_mut(CHUNK));
    in_parallel(threads, count, chunks, |(items, results)| {
        items.iter_mut().zip(results).for_each(|(item, result)| *result = Some(work(item)));
    });
    results.into_iter().flatten().collect()
}
