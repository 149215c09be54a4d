//! The third part: smooth motions, along which point, normal and overlap must move smoothly. Jumps are looked for by
//! halving the interval of the largest change until it is a trillionth of the motion.
//!
//! A point may move fast: along a face as fast as the stiffness of the edge over that of the sphere term allows. A
//! normal may turn fast: overlaps deeper than the rounding meet in both cores, where the level surfaces have corners.
//! What is left of a change on the last interval beyond these rates, and beyond the bounds of the points, is a jump.

use crate::pair_line::{Line, Place};
use crate::patch::bodies::cuboid;
use crate::stress::judge::FULL;
use crate::stress::ledger::{Fault, Finding, Ledger};
use crate::stress::reference::Body;
use crate::wide::Wide3;
use nalgebra::{UnitQuaternion, Vector3};
use potential_particles::{Contact, Kind, Particle, detect};
use serde::Serialize;
use std::f64::consts::{FRAC_PI_4, SQRT_2};

/// Intervals of each motion, and halvings of the worst.
const INTERVALS: usize = 2000;
const HALVINGS: usize = 30;
/// Intervals that are looked into, of each quantity.
const WORST: usize = 12;

/// r/size and k.
const SHAPES: [(f64, f64); 7] =
    [(0.1, 0.3), (0.05, 0.01), (1e-2, 0.05), (1e-3, 1e-3), (1e-4, 1e-4), (1e-6, 1e-6), (1e-2, 0.0)];

/// A motion: place and orientation of the upper body (half 0.2) for t in [0, 1]; the lower (half 0.5) rests.
type Motion = fn(f64) -> (Vector3<f64>, UnitQuaternion<f64>);

const MOTIONS: [(&str, Motion); 5] = [
    ("sliding over an edge", |t| (Vector3::new(0.2 + 0.6 * t, 0.05, 0.699), UnitQuaternion::identity())),
    ("sliding askew over an edge", |t| {
        (Vector3::new(0.2 + 0.6 * t, 0.05, 0.69), UnitQuaternion::from_euler_angles(0.02, 0.01, 0.4))
    }),
    ("rolling a corner over a face", |t| {
        let corner = UnitQuaternion::rotation_between(&Vector3::new(1.0, 1.0, 1.0), &-Vector3::z());
        let roll = UnitQuaternion::from_euler_angles(0.4 * (t - 0.5), 0.3 * (t - 0.5), 0.0);
        (Vector3::new(0.1, 0.05, 0.5 + 0.2 * 3f64.sqrt() - 0.02), roll * corner.unwrap_or_default())
    }),
    ("tilting from edge over face to edge", |t| {
        let angle = 0.05 * (t - 0.5_f64);
        let lift = 0.2 * angle.sin().abs();
        (Vector3::new(0.02, 0.01, 0.699 + lift), UnitQuaternion::from_euler_angles(0.0, angle, 0.0))
    }),
    ("edge across edge", |t| {
        let edge = UnitQuaternion::from_euler_angles(0.0, FRAC_PI_4, 0.0);
        let across = UnitQuaternion::from_euler_angles(0.0, 0.0, 0.7) * edge;
        (Vector3::new(0.45 + 0.15 * t, 0.0, 0.5 + 0.2 * SQRT_2 - 0.01), across)
    }),
];

/// Motions times shapes.
pub const COUNT: u64 = (MOTIONS.len() * SHAPES.len()) as u64;

/// What was found along one motion of one shape.
#[derive(Clone, Serialize)]
pub struct Sweep {
    pub motion: &'static str,
    pub r: f64,
    pub k: f64,
    /// Largest rates on the coarse grid: of the point in lengths, of the normal, of the overlap, for t from 0 to 1.
    pub rates: [f64; 3],
    /// Largest changes left on an interval of a trillionth.
    pub left: [f64; 3],
    /// What the curvatures allow the point on it.
    pub allowed: f64,
    pub jumps: u32,
}

struct Stage {
    a: Particle,
    b: Particle,
    motion: Motion,
}

impl Stage {
    fn places(&self, t: f64) -> (Place, Place) {
        let (position, q) = (self.motion)(t);
        (
            Place { position: [0.0; 3], orientation: [1.0, 0.0, 0.0, 0.0], angle: None },
            Place { position: position.into(), orientation: [q.w, q.i, q.j, q.k], angle: None },
        )
    }

    /// How fast the gradients turn at an answer, radians a length.
    fn bend(&self, contact: &Contact, t: f64) -> f64 {
        let (at_a, at_b) = self.places(t);
        let body = |particle, at: &Place| Body::new(particle, at, at_b.position);
        let x = Wide3::from(contact.branch_b);
        body(&self.a, &at_a).at(&x).bend().max(body(&self.b, &at_b).at(&x).bend())
    }

    fn at(&self, t: f64) -> Result<Contact, String> {
        let (at_a, at_b) = self.places(t);
        let settings = FULL.with_solve_separated(true);
        detect(&self.a, &at_a.pose(), &self.b, &at_b.pose(), &settings, None).map_err(|error| error.to_string())
    }
}

/// Changes of point, normal and overlap between two answers.
fn changes(one: &Contact, other: &Contact) -> [f64; 3] {
    let both = one.kind == Kind::Overlapping && other.kind == Kind::Overlapping;
    [
        (one.branch_a - other.branch_a).norm(),
        (one.normal - other.normal).norm(),
        if both { (one.overlap - other.overlap).abs() } else { 0.0 },
    ]
}

pub fn all(ledger: &mut Ledger, progress: impl Fn()) -> Vec<Sweep> {
    let mut sweeps = Vec::new();
    for (index, (name, motion)) in MOTIONS.iter().enumerate() {
        for (share, k) in SHAPES {
            let stage = Stage { a: cuboid([0.5; 3], share, k), b: cuboid([0.2; 3], 0.4 * share, k), motion: *motion };
            match one(&stage, name, share, k, index, ledger) {
                Ok(sweep) => sweeps.push(sweep),
                Err(error) => {
                    let detail = format!("{name}, r={share:e}, k={k:e}: {error}");
                    ledger.find(finding(Fault::NotSolved, index, detail, serde_json::Value::Null));
                }
            }
            progress();
        }
    }
    sweeps
}

fn finding(fault: Fault, index: usize, detail: String, case: serde_json::Value) -> Finding {
    Finding { fault, family: "sweep".into(), seed: 0, index: index as u64, detail, case, planes: 12 }
}

fn one(
    stage: &Stage,
    motion: &'static str,
    r: f64,
    k: f64,
    index: usize,
    ledger: &mut Ledger,
) -> Result<Sweep, String> {
    let grid: Result<Vec<Contact>, String> = (0..=INTERVALS).map(|i| stage.at(i as f64 / INTERVALS as f64)).collect();
    let grid = grid?;
    let steps: Vec<[f64; 3]> = grid.windows(2).map(|pair| changes(&pair[0], &pair[1])).collect();
    let mut sweep = Sweep { motion, r, k, rates: [0.0; 3], left: [0.0; 3], allowed: 0.0, jumps: 0 };
    // Stiffest over softest curvature: how much faster than the body the optimum may run.
    let run = |p: &Particle| {
        let stiff = (1.0 - p.sphericity()) / p.rounding_radius().powi(2);
        3.0 * stiff / (p.sphericity().max(FULL.flat_regularisation) / p.shadow_radius().powi(2))
    };
    let fastest = run(&stage.a).max(run(&stage.b));
    let width = 0.5f64.powi(HALVINGS as i32) / INTERVALS as f64;
    sweep.allowed = fastest * width;
    for quantity in 0..3 {
        let mut order: Vec<usize> = (0..INTERVALS).collect();
        order.sort_by(|&i, &j| steps[j][quantity].total_cmp(&steps[i][quantity]));
        sweep.rates[quantity] = steps[order[0]][quantity] * INTERVALS as f64;
        for &i in &order[..WORST] {
            let (mut from, mut to) = (i as f64 / INTERVALS as f64, (i + 1) as f64 / INTERVALS as f64);
            let (mut first, mut last) = (grid[i], grid[i + 1]);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (from + to);
                let between = stage.at(middle)?;
                if changes(&first, &between)[quantity] >= changes(&between, &last)[quantity] {
                    (to, last) = (middle, between);
                } else {
                    (from, first) = (middle, between);
                }
            }
            let left = changes(&first, &last)[quantity];
            sweep.left[quantity] = sweep.left[quantity].max(left);
            let bounds = first.point_bound + last.point_bound;
            // A normal turns as fast as the level surfaces bend, and the overlap is measured along it.
            let turn = 8.0 * stage.bend(&last, to).max(stage.bend(&first, from)) * ((to - from) + bounds);
            let allowed = match quantity {
                0 => fastest * (to - from) + bounds + 1e-12,
                1 => turn + 1e-12,
                _ => turn + (to - from) + bounds + 1e-12,
            };
            if !(left <= allowed) {
                sweep.jumps += 1;
                let name = ["point", "normal", "overlap"][quantity];
                let detail = format!(
                    "{motion}, r={r:e}, k={k:e}: {name} jumps by {left:e} (allowed {allowed:e}) between t={from} and {to}"
                );
                let (at_a, at_b) = stage.places(from);
                let line = Line::of(&stage.a, &at_a, &stage.b, &at_b, detail.clone());
                let case = serde_json::to_value(line).unwrap_or_default();
                ledger.find(finding(Fault::Jump, index, detail, case));
            }
        }
    }
    Ok(sweep)
}
