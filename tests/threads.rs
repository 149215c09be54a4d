//! Particles shared by threads: each thread gets, bit for bit, the answers that one thread alone gets, from states
//! of its own.

use kit::truth;
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

/// Every byte of an answer: NaN is then like NaN, and 0 not like -0.
fn bytes(contact: &Contact) -> Vec<u8> {
    let mut bytes = vec![0; size_of::<Contact>()];
    contact.put(&mut bytes);
    bytes
}

/// Cold, then warm, in both formulations; the pairs in an order that begins at `first`.
fn answers(pairs: &[Pair], first: usize) -> Vec<Vec<u8>> {
    let mut found = vec![Vec::new(); pairs.len()];
    for index in (0..pairs.len()).map(|i| (i + first) % pairs.len()) {
        let Pair { a, b, pose_a, pose_b } = &pairs[index];
        for formulation in [Formulation::Midway, Formulation::Closest] {
            let settings = Settings::default().with_formulation(formulation);
            let mut state = PairState::default();
            for _ in 0..2 {
                let contact = detect(a, pose_a, b, pose_b, &settings, Some(&mut state)).expect("a pair with an answer");
                found[index].extend(bytes(&contact));
            }
        }
    }
    found
}

#[test]
fn many_threads_answer_as_one() {
    let pairs: Vec<Pair> = truth::pairs()
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
