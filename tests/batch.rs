//! `detect_batch` against `detect`, `detect_batch_carried` against `detect_carried`: the same bits for any number of threads, and
//! what they refuse.

use potential_particles::{
    Carried, DetectError, Flags, Memory, Particle, Plane, Pose, Settings, detect, detect_batch, detect_batch_carried,
    detect_carried,
};

fn cube() -> Particle {
    let mut planes = Vec::new();
    for axis in 0..3 {
        for sign in [1.0, -1.0] {
            let mut row = [0.0, 0.0, 0.0, 0.4];
            row[axis] = sign;
            planes.push(Plane::from(row));
        }
    }
    Particle::new(&planes, 0.1, 0.05, 0.9).expect("a cube")
}

/// A block of bodies on a grid, each turned its own way, and every pair of neighbours.
fn block(particles: &[Particle; 2]) -> (Vec<&Particle>, Vec<Pose>, Vec<[u32; 2]>) {
    let (mut all, mut poses, mut pairs) = (Vec::new(), Vec::new(), Vec::new());
    let edge = 8;
    for i in 0..edge {
        for j in 0..edge {
            let turn = f64::from(i * edge + j);
            all.push(&particles[(i + j) as usize % 2]);
            let position = [0.9 * f64::from(i), 0.9 * f64::from(j), 0.05 * turn.sin()];
            poses.push(Pose::new(position, [1.0, 0.1 * turn.cos(), 0.05, 0.1 * turn.sin()]).unwrap());
            for [k, l] in [[i + 1, j], [i, j + 1], [i + 1, j + 1]] {
                if k < edge && l < edge {
                    pairs.push([i * edge + j, k * edge + l].map(|body| body as u32));
                }
            }
        }
    }
    (all, poses, pairs)
}

#[test]
fn answers_are_those_of_single_calls_for_any_number_of_threads() {
    let particles = [cube(), Particle::sphere(0.5).unwrap()];
    let (all, poses, pairs) = block(&particles);
    let settings = Settings::default();
    for threads in [0, 1, 2, 7] {
        let mut memories = vec![Memory::default(); pairs.len()];
        let mut own = memories.clone();
        for step in 0..2 {
            let answers = detect_batch(&all, &poses, &pairs, &settings, threads, &mut memories).unwrap();
            assert_eq!(answers.len(), pairs.len());
            let mut overlapping = 0;
            for (n, answer) in answers.iter().enumerate() {
                let [i, j] = pairs[n].map(|body| body as usize);
                let alone = detect(all[i], &poses[i], all[j], &poses[j], &settings, Some(&mut own[n])).unwrap();
                let answer = answer.as_ref().unwrap();
                // NaN in the same places, too.
                assert_eq!(format!("{answer:?}"), format!("{alone:?}"), "{threads} threads, step {step}, pair {n}");
                overlapping += usize::from(answer.overlap > 0.0);
            }
            assert!(overlapping > pairs.len() / 4, "{overlapping} of {}", pairs.len());
            assert_eq!(memories, own);
        }
    }
}

/// All bodies moved a little, each its own way.
fn moved(poses: &[Pose]) -> Vec<Pose> {
    let moved = poses.iter().enumerate().map(|(i, pose)| {
        let [w, x, y, z] = pose.orientation();
        let (sin, cos) = (i as f64).sin_cos();
        let position = pose.position() + 1e-6 * nalgebra::Vector3::new(sin, cos, -sin);
        Pose::new(position.into(), [w, x + 1e-6 * cos, y, z - 1e-6 * sin]).unwrap()
    });
    moved.collect()
}

#[test]
fn contacts_that_are_followed_are_those_of_single_calls() {
    let particles = [cube(), Particle::sphere(0.5).unwrap()];
    let (all, first, pairs) = block(&particles);
    let (settings, tolerance) = (Settings::default(), 1e-9);
    for threads in [1, 2, 7] {
        let mut poses = first.clone();
        let (mut memories, mut carried) = (vec![Memory::default(); pairs.len()], vec![Carried::default(); pairs.len()]);
        let (mut own, mut own_carried) = (memories.clone(), carried.clone());
        for step in 0..3 {
            let (kept, carry) = (&mut memories, &mut carried);
            let answers =
                detect_batch_carried(&all, &poses, &pairs, &settings, tolerance, threads, kept, carry).unwrap();
            let mut count = 0;
            for (n, answer) in answers.iter().enumerate() {
                let [i, j] = pairs[n].map(|body| body as usize);
                let (memory, carry) = (Some(&mut own[n]), &mut own_carried[n]);
                let (a, b) = ((all[i], &poses[i]), (all[j], &poses[j]));
                let alone = detect_carried(a.0, a.1, b.0, b.1, &settings, tolerance, memory, carry).unwrap();
                let answer = answer.as_ref().unwrap();
                assert_eq!(format!("{answer:?}"), format!("{alone:?}"), "{threads} threads, step {step}, pair {n}");
                count += usize::from(answer.flags.contains(Flags::CARRIED));
            }
            assert!(if step == 0 { count == 0 } else { count > pairs.len() / 4 }, "{count} carried on in step {step}");
            assert_eq!(memories, own);
            poses = moved(&poses);
        }
    }
    // With nothing to carry on all are solved.
    let solved = detect_batch(&all, &first, &pairs, &settings, 1, &mut []).unwrap();
    let nothing = detect_batch_carried(&all, &first, &pairs, &settings, tolerance, 1, &mut [], &mut []).unwrap();
    assert_eq!(format!("{solved:?}"), format!("{nothing:?}"));
    for bad in [-1e-9, 0.2, f64::NAN] {
        let refused = detect_batch_carried(&all, &first, &pairs, &settings, bad, 1, &mut [], &mut []);
        assert!(matches!(refused, Err(DetectError::Settings(_))), "{bad}: {refused:?}");
    }
    let mut few = [Carried::default(); 3];
    let short = detect_batch_carried(&all, &first, &pairs, &settings, tolerance, 1, &mut [], &mut few);
    assert!(matches!(short, Err(DetectError::Length { what: "carried", given: 3, .. })), "{short:?}");
}

#[test]
fn what_does_not_fit_is_refused_and_a_missing_body_is_told_by_its_pair() {
    let particles = [cube(), Particle::sphere(0.5).unwrap()];
    let (all, poses, mut pairs) = block(&particles);
    let settings = Settings::default();
    let short = detect_batch(&all, &poses[1..], &pairs, &settings, 1, &mut []);
    assert!(matches!(short, Err(DetectError::Length { what: "poses", given: 63, expected: 64, .. })), "{short:?}");
    let short = detect_batch(&all, &poses, &pairs, &settings, 1, &mut [Memory::default(); 3]);
    assert!(matches!(short, Err(DetectError::Length { what: "memories", given: 3, .. })), "{short:?}");
    let bad = detect_batch(&all, &poses, &pairs, &Settings { weight_on_a: 2.0, ..settings }, 1, &mut []);
    assert!(matches!(bad, Err(DetectError::Settings(_))), "{bad:?}");
    pairs[5] = [3, 64];
    let answers = detect_batch(&all, &poses, &pairs, &settings, 2, &mut []).unwrap();
    for (n, answer) in answers.iter().enumerate() {
        let missing = matches!(answer, Err(DetectError::NoSuchBody { index: 64, bodies: 64, .. }));
        assert_eq!((missing, answer.is_ok()), (n == 5, n != 5), "pair {n}: {answer:?}");
    }
}
