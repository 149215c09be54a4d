//! Timing: contestants take turns on each item, so that the noise of the machine hits all alike.

use std::time::Instant;

/// Length of one timed batch; some hundred times what reading the clock costs.
const BATCH_SECONDS: f64 = 10e-6;
/// Most calls of one batch.
const MOST_CALLS: usize = 1000;

/// A call on the item of the given index.
pub type Contestant<'a> = &'a dyn Fn(usize);

/// Seconds per call, `[contestant][item]`: the median over `rounds` of batches of repeated calls.
pub fn race(items: usize, contestants: &[Contestant], rounds: usize) -> Vec<Vec<f64>> {
    let mut samples = vec![vec![Vec::with_capacity(rounds); items]; contestants.len()];
    let mut calls = vec![vec![0; items]; contestants.len()];
    for _ in 0..rounds {
        for item in 0..items {
            for (index, contestant) in contestants.iter().enumerate() {
                let calls = &mut calls[index][item];
                if *calls == 0 {
                    *calls = batch(|| contestant(item));
                }
                // Untimed, where it counts: brings code and data back into the caches.
                if *calls > 1 {
                    contestant(item);
                }
                samples[index][item].push(seconds(*calls, || contestant(item)));
            }
        }
    }
    samples.into_iter().map(|items| items.into_iter().map(median).collect()).collect()
}

/// The middle value; NaN of nothing. Of an even number the upper one of the two in the middle.
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Seconds per call.
fn seconds(calls: usize, call: impl Fn()) -> f64 {
    let begin = Instant::now();
    for _ in 0..calls {
        call();
    }
    begin.elapsed().as_secs_f64() / calls as f64
}

/// Calls that make a batch long enough.
fn batch(call: impl Fn()) -> usize {
    // The first call also brings code and data into the caches, which takes longer than many a batch.
    let once = seconds(1, &call).min(seconds(1, &call));
    if once > BATCH_SECONDS {
        return 1;
    }
    let again = seconds(10, &call).max(1e-9);
    ((BATCH_SECONDS / again).ceil() as usize).clamp(1, MOST_CALLS)
}
