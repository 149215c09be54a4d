//! Time and error of contact patches by kind, in units of one evaluation of both bodies.

use crate::cases::kinds;
use kit::patch::bodies::Pair;
use kit::random;
use kit::scene::evaluation::Plain;
use kit::scene::polyhedra;
use nalgebra::{Matrix3, Vector3};
use potential_particles::{Patch, PatchFlags, PatchScratch, PatchSettings, PatchState, patch_of_contact};
use serde_json::{Value, json};
use std::hint::black_box;
use std::time::Instant;

/// Shortest time that is measured, seconds, and of how many such the least is taken: short ones, so that other programs
/// leave some alone.
const SHORTEST: f64 = 3e-4;
const TIMES: usize = 40;

/// Roundings over the size, sphericities, and overlaps over the rounding.
const ROUNDINGS: [f64; 3] = [1e-3, 1e-2, 5e-2];
const SPHERICITIES: [f64; 2] = [0.0, 0.02];
const DEPTHS: [f64; 2] = [0.02, 0.2];

fn patch(case: &Pair, tolerance: f64, scratch: &mut PatchScratch) -> Patch {
    let settings = PatchSettings { tolerance, with_energy: false, ..PatchSettings::default() };
    patch_of_contact(&case.a, &case.pose_a, &case.b, &case.pose_b, &case.contact, &settings, scratch, |_| ())
        .expect("a patch of an overlapping contact")
}

/// Seconds of one call.
pub fn time(mut call: impl FnMut()) -> f64 {
    let mut count = 1;
    loop {
        let mut best = f64::INFINITY;
        for _ in 0..TIMES {
            let start = Instant::now();
            (0..count).for_each(|_| call());
            best = best.min(start.elapsed().as_secs_f64());
        }
        if best > SHORTEST {
            return best / f64::from(count);
        }
        count *= 2;
    }
}

/// The unit: S, ∇S and ∇²S of both bodies at the contact point.
fn unit(case: &Pair) -> f64 {
    let plain = [Plain::new(&case.a), Plain::new(&case.b)];
    let points = [case.pose_a, case.pose_b].map(|pose| pose.to_local(&case.contact.point));
    time(|| {
        black_box(plain[0].at(black_box(&points[0])));
        black_box(plain[1].at(black_box(&points[1])));
    })
}

fn measured(kind: &str, case: &Pair, unit: f64) -> Value {
    let mut scratch = PatchScratch::new();
    let finest = patch(case, 1e-11, &mut scratch);
    let force = finest.force.norm();
    let reach = finest.area.sqrt();
    let rows: Vec<Value> = [1e-3, 1e-4, 1e-5, 1e-6, 1e-8]
        .iter()
        .map(|tolerance| {
            let found = patch(case, *tolerance, &mut scratch);
            let seconds = time(|| {
                black_box(patch(black_box(case), *tolerance, &mut scratch));
            });
            let error = ((found.force - finest.force).norm() / force)
                .max((found.torque - finest.torque).norm() / (force * reach));
            println!(
                "{kind:24} {tolerance:7.0e}: {:6.0} units, {:4} rays, {:5} points, estimate {:.1e}, error {error:.1e}",
                seconds / unit,
                found.rays,
                found.points,
                found.error
            );
            json!({"tolerance": tolerance, "seconds": seconds, "units": seconds / unit, "rays": found.rays,
                "points": found.points, "estimate": found.error, "error": error})
        })
        .collect();
    json!({"kind": kind, "s": case.contact.s, "rows": rows})
}

/// Units of a patch that is carried on: the most of all kinds.
pub fn carried(unit: f64) -> f64 {
    let (settings, mut scratch) = (PatchSettings::default(), PatchScratch::new());
    let mut of = |case: &Pair| {
        let mut state = PatchState::default();
        let mut look = || {
            let Pair { a, b, pose_a, pose_b, contact } = black_box(case);
            let patch = state.patch_of_contact(a, pose_a, b, pose_b, contact, &settings, &mut scratch);
            patch.expect("a patch of an overlapping contact").flags
        };
        let last = [look(), look(), look()][2];
        assert!(last.contains(PatchFlags::CARRIED), "{last}");
        time(|| _ = black_box(look())) / unit
    };
    kinds(1e-2, 0.0, 2e-4).iter().map(|(_, case)| of(case)).fold(0.0, f64::max)
}

/// The unit in seconds, and a row for each kind.
pub fn measure(quick: bool) -> (f64, Vec<Value>) {
    let unit = unit(&kinds(1e-2, 0.02, 1e-3)[4].1);
    println!("unit: {:.1} ns", 1e9 * unit);
    let mut results = Vec::new();
    let mut add = |kind: &str, case: &Pair, r: f64, k: f64, depth: f64| {
        let mut row = measured(kind, case, unit);
        (row["r"], row["k"], row["depth"]) = (json!(r), json!(k), json!(depth));
        results.push(row);
    };
    for r in ROUNDINGS.into_iter().filter(|r| !quick || *r == 1e-2) {
        for k in SPHERICITIES {
            for depth in DEPTHS {
                println!("r {r}, k {k}, overlap {depth} r");
                kinds(r, k, depth * r).iter().for_each(|(kind, case)| add(kind, case, r, k, depth));
            }
        }
    }
    let mut random = random::Random::seeded(300);
    let [a, b] = [0; 2].map(|_| polyhedra::ball(300, &mut random));
    let (level, way) = (Matrix3::identity(), Vector3::new(0.03, 0.05, 1.0).normalize());
    let case = Pair::at_overlap(a, &level, b, &level, &way, 1e-3);
    add("300 + 300 planes", &case, 0.01, 0.05, 0.1);
    (unit, results)
}
