//! Rock masses: how long slicing takes, and whether the volumes of the blocks sum to that of the domain. Writes
//! out/rock/summary.json, and out/rock/slope.json for the picture; `-- quick` takes the small ones only.

use kit::target::{at_most, own_time, write_summary};
use potential_particles::Plane;
use potential_particles::rock::{FaceOf, Joint, JointSet, RockMass, SliceSettings, slice};
use serde_json::{Value, json};
use std::time::Instant;

/// Half of the side of the domains, m.
const HALF: f64 = 50.0;

/// Of each mass and number of threads, in turns, and how long one lasts at least.
const WINDOWS: usize = 7;
const WINDOW: f64 = 0.2;

/// Joints of each of three sets.
const COUNTS: [u32; 4] = [5, 10, 22, 46];

struct Row {
    blocks: usize,
    /// Of the processor, on one thread.
    seconds: f64,
    /// By the clock, on one and two threads.
    one: f64,
    two: f64,
    alike: bool,
    off: f64,
    unclosed: usize,
}

fn main() {
    let counts = if std::env::args().any(|argument| argument == "quick") { &COUNTS[..2] } else { &COUNTS[..] };
    let rows: Vec<Row> = counts.iter().map(|&count| row(count)).collect();
    println!(
        "| blocks | s of the processor | us a block | s by the clock | two threads | volume off by |\n|---|---|---|---|---|---|"
    );
    for row in &rows {
        let each = 1e6 * row.seconds / row.blocks as f64;
        println!(
            "| {} | {:.4} | {each:.2} | {:.4} | {:.4} | {:.0e} |",
            row.blocks, row.seconds, row.one, row.two, row.off
        );
    }
    let largest = &rows[rows.len() - 1];
    let from = rows.iter().find(|row| row.blocks >= 1000).unwrap_or(&rows[0]);
    let each = |row: &Row| row.seconds / row.blocks as f64;
    let worst = rows.iter().map(|row| row.off.abs()).fold(0.0, f64::max);
    let unclosed = rows.iter().map(|row| row.unclosed).sum::<usize>() as f64;
    let targets = [
        at_most("100,000 blocks, s", 30.0, 1e5 * each(largest)),
        at_most("time of a block in the largest mass over that from 1,000 on", 1.3, each(largest) / each(from)),
        at_most("time on two threads over that on one, largest mass", 1.0 / 1.7, largest.two / largest.one),
        at_most("masses that two threads cut otherwise", 0.0, rows.iter().filter(|row| !row.alike).count() as f64),
        at_most("largest error of the sum of volumes, relative", 1e-12, worst),
        at_most("cuts that left no closed surface", 0.0, unclosed),
    ];
    let listed: Vec<Value> = rows
        .iter()
        .map(|row| json!({"blocks": row.blocks, "processor_seconds": row.seconds, "seconds": row.one, "two_threads": row.two, "off": row.off}))
        .collect();
    write_summary("out/rock/summary.json", &json!({"rows": listed, "targets": targets})).expect("out/rock");
    write_summary("out/rock/slope.json", &slope()).expect("out/rock");
}

/// A cube.
fn domain() -> Vec<Plane> {
    let side = |i: usize| {
        let mut plane = [0.0, 0.0, 0.0, HALF];
        plane[i / 2] = [1.0, -1.0][i % 2];
        Plane::from(plane)
    };
    (0..6).map(side).collect()
}

/// Three sets with some scatter: bedding and two steep ones.
fn joints(count: u32) -> Vec<Joint> {
    let set = |(dip, direction): (f64, f64)| {
        let set = JointSet {
            fisher: 200.0,
            seed: count.into(),
            ..JointSet::new(dip, direction, 2.0 * HALF / f64::from(count))
        };
        set.joints([0.0; 3], 1.2 * HALF).expect("a joint set")
    };
    [(5.0, 10.0), (85.0, 100.0), (80.0, 190.0)].into_iter().flat_map(set).collect()
}

fn volume(mass: &RockMass) -> f64 {
    mass.blocks.iter().map(|block| block.volume).sum()
}

fn row(count: u32) -> Row {
    let (domain, joints) = (domain(), joints(count));
    let cut = |threads| {
        let settings = SliceSettings { threads, ..SliceSettings::default() };
        slice(&domain, &joints, &settings).expect("a rock mass")
    };
    // Other work may share the machine: the best of some windows, in turns, and on one thread the processor's time
    // besides.
    let (mut seconds, mut one, mut two) = (f64::INFINITY, f64::INFINITY, f64::INFINITY);
    for _ in 0..WINDOWS {
        let (mut runs, mut own, mut window) = (0.0, 0.0, 0.0);
        while window < WINDOW {
            let (begin, begin_own) = (Instant::now(), own_time());
            let mass = cut(1);
            let took = begin.elapsed().as_secs_f64();
            own += own_time() - begin_own;
            drop(mass);
            one = one.min(took);
            let begin = Instant::now();
            let mass = cut(2);
            two = two.min(begin.elapsed().as_secs_f64());
            drop(mass);
            (runs, window) = (runs + 1.0, window + took);
        }
        seconds = seconds.min(own / runs);
    }
    let (mass, by_two) = (cut(1), cut(2));
    let places = |mass: &RockMass| mass.blocks.iter().map(|block| (block.volume, block.centroid)).collect::<Vec<_>>();
    let alike = places(&mass) == places(&by_two);
    let off = volume(&mass) / (2.0 * HALF).powi(3) - 1.0;
    Row { blocks: mass.blocks.len(), seconds, one, two, alike, off, unclosed: mass.unclosed }
}

/// Faces of a slope of some 800 blocks: corners, and the set that each comes from (−1: the outside).
fn slope() -> Value {
    let mut domain = domain();
    // The face dips 60° to the east, from the edge of the crest.
    let face = Joint::new([10.0, 0.0, HALF], 60.0, 90.0).expect("the face");
    domain.push(Plane { normal: face.normal, offset: face.normal.dot(&face.point) });
    let sets = [
        (JointSet::new(35.0, 90.0, 11.0), 3),
        (JointSet::new(80.0, 265.0, 14.0), 4),
        (JointSet::new(85.0, 355.0, 13.0), 5),
    ];
    let (mut joints, mut of) = (Vec::new(), Vec::new());
    for (i, (set, seed)) in sets.into_iter().enumerate() {
        let made =
            JointSet { fisher: 150.0, exponential: i == 0, seed, ..set }.joints([0.0; 3], 80.0).expect("a joint set");
        of.extend(made.iter().map(|_| i as i64));
        joints.extend(made);
    }
    let mass =
        slice(&domain, &joints, &SliceSettings { least_volume: 1.0, ..SliceSettings::default() }).expect("the slope");
    println!(
        "the slope has {} blocks; {} cuts were left out, as parts would have had less than 1 m3",
        mass.blocks.len(),
        mass.too_small
    );
    let faces = mass.blocks.iter().enumerate().flat_map(|(number, block)| {
        let of = &of;
        block.faces.iter().map(move |face| {
            let set = if let FaceOf::Joint(i) = face.of { of[i] } else { -1 };
            let corners: Vec<[f64; 3]> = block.corners_of(face).iter().map(|at| (*at).into()).collect();
            json!({"block": number, "set": set, "centroid": <[f64; 3]>::from(block.centroid), "corners": corners})
        })
    });
    faces.collect()
}
