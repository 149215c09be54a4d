//! Particles shared by threads: each thread gets, bit for bit, the answers that one thread alone gets, from states
//! of its own.

mod support;

use potential_particles::{Contact, Formulation, PairState, Particle, Pose, Settings, detect};
use std::sync::{Arc, Barrier};
use std::thread;

const THREADS: usize = 8;

struct Pair {
    a: Arc<Particle>,
    b: Arc<Particle>,
    pose_a: Pose,
    pose_b: Pose,
}

/// Everything in an answer, as bits: NaN is then like NaN, and 0 not like -0.
fn bits(contact: &Contact) -> Vec<u64> {
    let numbers = [contact.s, contact.s_b, contact.weight, contact.gap, contact.point_bound, contact.overlap];
    let vectors =
        [contact.normal, contact.point, contact.branch_a, contact.branch_b, contact.point_on_a, contact.point_on_b];
    let counts = [contact.kind as u64, contact.flags.bits().into(), contact.iterations.into()];
    let numbers = numbers.into_iter().chain(vectors.iter().flat_map(|v| [v.x, v.y, v.z])).map(f64::to_bits);
    counts.into_iter().chain(numbers).collect()
}

/// Cold, then warm, in both formulations; the pairs in an order that begins at `first`.
fn answers(pairs: &[Pair], first: usize) -> Vec<Vec<u64>> {
    let mut found = vec![Vec::new(); pairs.len()];
    for index in (0..pairs.len()).map(|i| (i + first) % pairs.len()) {
        let Pair { a, b, pose_a, pose_b } = &pairs[index];
        for formulation in [Formulation::Midway, Formulation::Closest] {
            let settings = Settings::default().with_formulation(formulation);
            let mut state = PairState::default();
            for _ in 0..2 {
                let contact = detect(a, pose_a, b, pose_b, &settings, Some(&mut state)).expect("a pair with an answer");
                found[index].extend(bits(&contact));
            }
        }
    }
    found
}

#[test]
fn many_threads_answer_as_one() {
    let pairs: Vec<Pair> = support::pairs()
        .iter()
        .map(|pair| Pair {
            a: Arc::new(pair.shape_a.particle()),
            b: Arc::new(pair.shape_b.particle()),
            pose_a: pair.a.pose(),
            pose_b: pair.b.pose(),
        })
        .collect();
    let alone = answers(&pairs, 0);
    let start = Barrier::new(THREADS);
    thread::scope(|scope| {
        let workers: Vec<_> = (0..THREADS)
            .map(|thread| {
                let (pairs, start) = (&pairs, &start);
                // Each begins elsewhere, so that different threads are in different solvers.
                scope.spawn(move || {
                    start.wait();
                    answers(pairs, thread * pairs.len() / THREADS)
                })
            })
            .collect();
        for (thread, worker) in workers.into_iter().enumerate() {
            let found = worker.join().expect("a thread that ends");
            for (index, (found, alone)) in found.iter().zip(&alone).enumerate() {
                assert_eq!(found, alone, "thread {thread}, pair {index}");
            }
        }
    });
}
