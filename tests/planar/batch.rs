//! `planar::detect_batch` against `planar::detect`: the same bits for any number of threads, and what it refuses.

use crate::body::Body;
use potential_particles::planar::{Particle, Pose, detect, detect_batch};
use potential_particles::{DetectError, Flags, Kind, PairState, Settings};

/// Squares and circles on a grid, each turned its own way, and every pair of neighbours.
struct Grid {
    particles: [Particle; 2],
    poses: Vec<Pose>,
    pairs: Vec<[u32; 2]>,
}

const EDGE: u32 = 12;

impl Grid {
    fn new() -> Self {
        let particles = [Body::square(0.5, 0.1, 0.05).particle(), Particle::circle(0.55).unwrap()];
        let (mut poses, mut pairs) = (Vec::new(), Vec::new());
        for (i, j) in (0..EDGE * EDGE).map(|body| (body / EDGE, body % EDGE)) {
            poses.push(Pose::new([f64::from(i), f64::from(j)], f64::from(i * i + 3 * j)).unwrap());
            for (k, l) in [(i + 1, j), (i, j + 1), (i + 1, j + 1)] {
                if k < EDGE && l < EDGE {
                    pairs.push([i * EDGE + j, k * EDGE + l]);
                }
            }
        }
        Self { particles, poses, pairs }
    }

    fn bodies(&self) -> Vec<&Particle> {
        (0..self.poses.len()).map(|body| &self.particles[body % 3 % 2]).collect()
    }
}

#[test]
fn answers_are_those_of_single_calls_for_any_number_of_threads() {
    let grid = Grid::new();
    let (bodies, poses) = (grid.bodies(), &grid.poses);
    for (threads, carry_tolerance) in [(0, 0.0), (1, 1e-9), (2, 0.0), (7, 1e-9)] {
        let settings = Settings::default().with_carry_tolerance(carry_tolerance);
        let mut states = vec![PairState::default(); grid.pairs.len()];
        let mut own = states.clone();
        for step in 0..2 {
            let answers = detect_batch(&bodies, poses, &grid.pairs, &settings, threads, &mut states).unwrap();
            let (mut overlapping, mut carried) = (0, 0);
            for ((&[i, j], state), answer) in grid.pairs.iter().zip(&mut own).zip(&answers) {
                let ((a, at_a), (b, at_b)) =
                    ((bodies[i as usize], &poses[i as usize]), (bodies[j as usize], &poses[j as usize]));
                let alone = detect(a, at_a, b, at_b, &settings, Some(state)).unwrap();
                let answer = answer.as_ref().unwrap();
                // NaN in the same places, too.
                assert_eq!(format!("{answer:?}"), format!("{alone:?}"), "{threads} threads, step {step}, {i} and {j}");
                overlapping += usize::from(answer.kind == Kind::Overlapping);
                carried += usize::from(answer.flags.contains(Flags::CARRIED));
                assert!(answer.kind == Kind::Separated || answer.flags.contains(Flags::WARM) == (step == 1));
            }
            assert_eq!(answers.len(), grid.pairs.len());
            assert_eq!(format!("{states:?}"), format!("{own:?}"));
            assert_eq!(carried > answers.len() / 8, step == 1 && carry_tolerance > 0.0, "{carried}");
            assert!(overlapping > answers.len() / 4 && overlapping < answers.len(), "{overlapping}");
        }
    }
}

#[test]
fn what_does_not_fit_is_refused_and_a_missing_body_is_told_by_its_pair() {
    let mut grid = Grid::new();
    let (count, missing) = (grid.poses.len(), EDGE * EDGE);
    grid.pairs[5] = [3, missing];
    let (bodies, poses, pairs, settings) = (grid.bodies(), &grid.poses, &grid.pairs, Settings::default());
    let short = detect_batch(&bodies, &poses[1..], pairs, &settings, 1, &mut []);
    assert!(matches!(short, Err(DetectError::Length { what: "poses", .. })), "{short:?}");
    let short = detect_batch(&bodies, poses, pairs, &settings, 1, &mut [PairState::default(); 3]);
    assert!(matches!(short, Err(DetectError::Length { what: "states", given: 3, .. })), "{short:?}");
    let bad = detect_batch(&bodies, poses, pairs, &settings.with_gap_tolerance(0.0), 1, &mut []);
    assert!(matches!(bad, Err(DetectError::Settings(_))), "{bad:?}");
    let answers = detect_batch(&bodies, poses, pairs, &settings, 2, &mut []).unwrap();
    for (n, answer) in answers.iter().enumerate() {
        let told = matches!(answer, Err(DetectError::NoSuchBody { index, bodies, .. }) if (*index, *bodies) == (missing, count));
        assert_eq!((told, answer.is_ok()), (n == 5, n != 5), "pair {n}: {answer:?}");
    }
}
