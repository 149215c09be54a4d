//! Contact patches of the cases of patches.py: `patches FILE TOLERANCE SECONDS` prints a line of JSON for each line
//! `LOWER UPPER x y z qw qx qy qz X Y Z` of the file, a body being `ball R`, `box HALF_X HALF_Y HALF_Z r` or, of the
//! lower one, `ground`: force, torque about X Y Z, area and the estimated error for K = 1, and seconds a call from
//! nothing and carried on.

use potential_particles::nalgebra::Vector3;
use potential_particles::{
    Kind, PairState, Particle, Patch, PatchScratch, PatchSettings, PatchState, Plane, Pose, Settings, Wall,
    contact_with_plane, detect, patch_of_contact, patch_on_plane,
};
use std::hint::black_box;
use std::time::Instant;

/// Far from rounding, and so small that a patch is carried on: the shift between the poses that calls take in turn,
/// over the depth.
const SHIFT: f64 = 1e-4;

/// What the last step left.
#[derive(Default)]
struct Memory {
    pair: PairState,
    patch: PatchState,
}

struct Case {
    /// `None` is the ground, z ≤ 0.
    lower: Option<Particle>,
    upper: Particle,
    pose: [f64; 7],
    about: [f64; 3],
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let text = std::fs::read_to_string(&arguments[1]).expect("the file of cases");
    let tolerance = arguments[2].parse().expect("a tolerance");
    let seconds: f64 = arguments[3].parse().expect("seconds");
    let settings = PatchSettings { tolerance, ..PatchSettings::default() };
    for line in text.lines() {
        let case = Case::read(line);
        let (patch, torque) = case.answer(&settings);
        let ([x, y, z], [a, b, c]) = (<[f64; 3]>::from(patch.force), torque);
        let times = [false, true].map(|is_carried| case.time(&settings, patch.largest_depth, is_carried, seconds));
        println!(
            "[[{x:e}, {y:e}, {z:e}], [{a:e}, {b:e}, {c:e}], {:e}, {:e}, {:e}, {:e}]",
            patch.area, patch.error, times[0], times[1]
        );
    }
}

/// The next body of a line; `None` for the ground.
fn body<'a>(words: &mut impl Iterator<Item = &'a str>) -> Option<Particle> {
    let kind = words.next().expect("a body");
    let mut next = || words.next().and_then(|word| word.parse::<f64>().ok()).expect("the sizes of a body");
    match kind {
        "ground" => None,
        "ball" => Some(Particle::sphere(next()).expect("a sphere")),
        "box" => {
            let halves: [f64; 3] = std::array::from_fn(|_| next());
            let r = next();
            let planes = (0..3).flat_map(|axis| {
                let offset = halves[axis] - r;
                [1.0, -1.0].map(|sign| Plane { normal: Vector3::ith(axis, sign), offset })
            });
            let planes: Vec<Plane> = planes.collect();
            Some(Particle::new(&planes, r, 0.0, 2.0 * Vector3::from(halves).norm()).expect("a box"))
        }
        _ => panic!("no body {kind}"),
    }
}

impl Case {
    fn read(line: &str) -> Self {
        let mut words = line.split_whitespace();
        let lower = body(&mut words);
        let upper = body(&mut words).expect("the upper body is no ground");
        let mut numbers = words.map(|word| word.parse::<f64>().expect("a number"));
        let mut next = || numbers.next().expect("ten numbers after the bodies");
        Self { lower, upper, pose: std::array::from_fn(|_| next()), about: std::array::from_fn(|_| next()) }
    }

    /// The pose of the upper body, shifted sideways and up.
    fn pose(&self, shift: f64) -> Pose {
        let [x, y, z, w, i, j, k] = self.pose;
        Pose::new([x + shift, y, z + shift], [w, i, j, k]).expect("a pose")
    }

    /// The patch, and its torque on the upper body about the point of the case. The forces are those on the upper body.
    fn answer(&self, settings: &PatchSettings) -> (Patch, [f64; 3]) {
        let mut scratch = PatchScratch::new();
        let (mut patch, point) = self.patch(&self.pose(0.0), settings, None, &mut scratch);
        // The lower body is A of a pair and the wall of a particle: force and torque on B, and on the wall.
        let sign = if self.lower.is_some() { 1.0 } else { -1.0 };
        patch.force *= sign;
        let arm = point - Vector3::from(self.about);
        let torque = sign * patch.torque + arm.cross(&patch.force);
        (patch, torque.into())
    }

    fn patch(
        &self,
        pose: &Pose,
        settings: &PatchSettings,
        memory: Option<&mut Memory>,
        scratch: &mut PatchScratch,
    ) -> (Patch, Vector3<f64>) {
        let (pair, kept) = memory.map(|memory| (&mut memory.pair, &mut memory.patch)).unzip();
        let upper = &self.upper;
        if let Some(lower) = &self.lower {
            let at_rest = Pose::at([0.0; 3]).expect("a pose");
            let contact = detect(lower, &at_rest, upper, pose, &Settings::default(), pair).expect("a contact");
            assert!(contact.kind == Kind::Overlapping, "the bodies of a case overlap");
            let patch = match kept {
                Some(kept) => kept.patch_of_contact(lower, &at_rest, upper, pose, &contact, settings, scratch),
                None => patch_of_contact(lower, &at_rest, upper, pose, &contact, settings, scratch, |_| ()),
            };
            return (patch.expect("a patch"), contact.point);
        }
        let ground = Wall::new([0.0, 0.0, 0.0], [0.0, 0.0, 1.0]).expect("a plane");
        let contact = contact_with_plane(upper, pose, &ground, &Settings::default(), pair).expect("a contact");
        let patch = match kept {
            Some(kept) => kept.patch_on_plane(upper, pose, &contact, settings, scratch),
            None => patch_on_plane(upper, pose, &contact, settings, scratch, |_| ()),
        };
        (patch.expect("a patch"), contact.on_boundary)
    }

    /// Seconds of contact and patch together, of poses in turn, the fastest of several windows.
    fn time(&self, settings: &PatchSettings, depth: f64, is_carried: bool, seconds: f64) -> f64 {
        let mut scratch = PatchScratch::new();
        let mut memory = Memory::default();
        let poses = [0.0, SHIFT * depth].map(|shift| self.pose(shift));
        let mut fastest = f64::INFINITY;
        for _ in 0..10 {
            let (begin, mut calls) = (Instant::now(), 0);
            while begin.elapsed().as_secs_f64() < 0.1 * seconds || calls < 20 {
                for pose in &poses {
                    black_box(self.patch(pose, settings, is_carried.then_some(&mut memory), &mut scratch));
                    calls += 1;
                }
            }
            fastest = fastest.min(begin.elapsed().as_secs_f64() / f64::from(calls));
        }
        fastest
    }
}
