//! `detect_batch` against `detect`: the same bits for any number of threads, and what it refuses.

use potential_particles::{
    Contact, DetectError, Flags, PairState, Particle, Plane, Pose, Settings, detect, detect_batch, detect_batch_into,
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

/// For any number of threads, solved anew and followed.
#[test]
fn answers_are_those_of_single_calls() {
    let particles = [cube(), Particle::sphere(0.5).unwrap()];
    let (all, first, pairs) = block(&particles);
    let settings = Settings::default().with_carry_tolerance(1e-9);
    let both = [Settings::default(), settings];
    for (threads, settings) in [0, 1, 2, 7].into_iter().flat_map(|threads| both.map(|settings| (threads, settings))) {
        let mut poses = first.clone();
        let mut states = vec![PairState::default(); pairs.len()];
        let mut own = states.clone();
        for step in 0..3 {
            let answers = detect_batch(&all, &poses, &pairs, &settings, threads, &mut states).unwrap();
            assert_eq!(answers.len(), pairs.len());
            let (mut count, mut overlapping) = (0, 0);
            for (n, answer) in answers.iter().enumerate() {
                let [i, j] = pairs[n].map(|body| body as usize);
                let alone = detect(all[i], &poses[i], all[j], &poses[j], &settings, Some(&mut own[n])).unwrap();
                let answer = answer.as_ref().unwrap();
                // NaN in the same places, too.
                assert_eq!(format!("{answer:?}"), format!("{alone:?}"), "{threads} threads, step {step}, pair {n}");
                overlapping += usize::from(answer.overlap > 0.0);
                count += usize::from(answer.flags.contains(Flags::CARRIED));
            }
            let is_followed = step > 0 && settings.carry_tolerance > 0.0;
            assert!(overlapping > pairs.len() / 4, "{overlapping} of {}", pairs.len());
            assert!(
                if is_followed { count > pairs.len() / 4 } else { count == 0 },
                "{count} carried on in step {step}"
            );
            assert_eq!(format!("{states:?}"), format!("{own:?}"));
            poses = moved(&poses);
        }
    }
    // Without states all are solved.
    let solved = detect_batch(&all, &first, &pairs, &Settings::default(), 1, &mut []).unwrap();
    let nothing = detect_batch(&all, &first, &pairs, &settings, 1, &mut []).unwrap();
    assert_eq!(format!("{solved:?}"), format!("{nothing:?}"));
    for carry_tolerance in [-1e-9, 0.2, f64::NAN] {
        let refused = detect_batch(&all, &first, &pairs, &settings.with_carry_tolerance(carry_tolerance), 1, &mut []);
        assert!(matches!(refused, Err(DetectError::Settings(_))), "{carry_tolerance}: {refused:?}");
    }
}

/// Into answers of the caller's own form: the same contacts at the places of their pairs, also of those that have none.
#[test]
fn contacts_are_written_where_they_are_wanted() {
    let particles = [cube(), Particle::sphere(0.5).unwrap()];
    let (all, poses, mut pairs) = block(&particles);
    pairs[70] = [0, 64];
    for settings in [Settings::default(), Settings::default().with_carry_tolerance(1e-9)] {
        let (mut states, mut own) = (vec![PairState::default(); pairs.len()], vec![PairState::default(); pairs.len()]);
        for threads in [1, 3, 1] {
            let expected = detect_batch(&all, &poses, &pairs, &settings, threads, &mut states).unwrap();
            let mut answers = vec![(usize::MAX, None); pairs.len()];
            let write = |number, place: &mut (usize, Option<Contact>), answer: Result<&Contact, DetectError>| {
                *place = (number, answer.ok().copied());
            };
            detect_batch_into(&all, &poses, &pairs, &settings, threads, &mut own, &mut answers, write).unwrap();
            for (n, (expected, (number, answer))) in expected.into_iter().zip(answers).enumerate() {
                assert_eq!((number, answer.is_some()), (n, n != 70));
                assert_eq!(answer, expected.ok(), "pair {n}");
            }
        }
    }
    let mut short = [(); 3];
    let refused = detect_batch_into(&all, &poses, &pairs, &Settings::default(), 1, &mut [], &mut short, |_, _, _| ());
    assert!(matches!(refused, Err(DetectError::Length { what: "answers", given: 3, .. })), "{refused:?}");
}

#[test]
fn what_does_not_fit_is_refused_and_a_missing_body_is_told_by_its_pair() {
    let particles = [cube(), Particle::sphere(0.5).unwrap()];
    let (all, poses, mut pairs) = block(&particles);
    let settings = Settings::default();
    let short = detect_batch(&all, &poses[1..], &pairs, &settings, 1, &mut []);
    assert!(matches!(short, Err(DetectError::Length { what: "poses", given: 63, expected: 64, .. })), "{short:?}");
    let short = detect_batch(&all, &poses, &pairs, &settings, 1, &mut [PairState::default(); 3]);
    assert!(matches!(short, Err(DetectError::Length { what: "states", given: 3, .. })), "{short:?}");
    let bad = detect_batch(&all, &poses, &pairs, &settings.with_weight_on_a(2.0), 1, &mut []);
    assert!(matches!(bad, Err(DetectError::Settings(_))), "{bad:?}");
    pairs[5] = [3, 64];
    let answers = detect_batch(&all, &poses, &pairs, &settings, 2, &mut []).unwrap();
    for (n, answer) in answers.iter().enumerate() {
        let missing = matches!(answer, Err(DetectError::NoSuchBody { index: 64, bodies: 64, .. }));
        assert_eq!((missing, answer.is_ok()), (n == 5, n != 5), "pair {n}: {answer:?}");
    }
}
