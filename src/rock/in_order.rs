//! Many pieces of work on several threads, whose results come in the order of the pieces.

use crate::contact::batch::{CHUNK, in_parallel};

/// What `work` makes of each item, where it makes something, with the place of the item.
pub(super) fn found<T: Send, U: Send>(
    threads: usize,
    items: &mut [T],
    work: impl Fn(&mut T) -> Option<U> + Sync,
) -> Vec<(usize, U)> {
    let count = items.len();
    let mut results: Vec<Vec<(usize, U)>> = (0..count.div_ceil(CHUNK)).map(|_| Vec::new()).collect();
    let chunks = items.chunks_mut(CHUNK).zip(&mut results).enumerate();
    in_parallel(threads, count, chunks, |(chunk, (items, results))| {
        let places = (chunk * CHUNK..).zip(items);
        results.extend(places.filter_map(|(place, item)| work(item).map(|result| (place, result))));
    });
    results.into_iter().flatten().collect()
}

/// What `work` makes of each item.
pub(super) fn mapped<T: Send, U: Send>(threads: usize, items: &mut [T], work: impl Fn(&mut T) -> U + Sync) -> Vec<U> {
    found(threads, items, |item| Some(work(item))).into_iter().map(|(_, result)| result).collect()
}
