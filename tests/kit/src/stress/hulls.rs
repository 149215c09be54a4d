//! Convex hulls of points and bodies of half-spaces, against hulls in exact arithmetic.

use crate::random::Random;
use crate::stress::cases::stream;
use crate::stress::exact::ExactHull;
use crate::stress::ledger::{Fault, Finding, Ledger};
use nalgebra::{Rotation3, Vector3};
use potential_particles::Plane;
use potential_particles::internals::{sharp_hull, sharp_planes};
use potential_particles::rock::{SliceSettings, slice};
use potential_particles::shapes::ShapeError;

/// At which faces are one, as a share of the extent.
const COPLANAR: f64 = 1e-6;

/// Of the heights of points over planes, as a share of the extent.
const ROUNDING: f64 = 1e-12;

const FAMILIES: [&str; 6] = ["grid", "whole numbers", "prism", "shaken", "ellipsoid", "taper"];

/// Nothing, or a power of ten between the last digit and the tolerance.
fn little(random: &mut Random, most: f64) -> f64 {
    if random.uniform() < 0.3 { 0.0 } else { random.power(-16.5, most) }
}

fn combined(points: &[Vector3<f64>], random: &mut Random) -> Vector3<f64> {
    let weights: Vec<f64> = points.iter().map(|_| random.uniform().powi(3)).collect();
    points.iter().zip(&weights).map(|(at, weight)| at * *weight).sum::<Vector3<f64>>() / weights.iter().sum::<f64>()
}

/// Corners of a solid of extent 1 or so.
fn solid(random: &mut Random) -> Vec<Vector3<f64>> {
    match random.whole(0, 3) {
        0 => (0..8).map(|i| Vector3::from_fn(|axis, _| f64::from(i >> axis & 1))).collect(),
        1 => (0..4).map(|_| random.direction()).collect(),
        _ => (0..random.whole(5, 15)).map(|_| random.direction()).collect(),
    }
}

fn points(family: usize, random: &mut Random) -> Vec<[f64; 3]> {
    let mut points: Vec<Vector3<f64>> = match family {
        0 => {
            let counts = [(); 3].map(|()| random.whole(2, 5));
            let step = random.pick(&[1.0, 1.0 / 3.0, 0.1, 0.7]);
            let cells =
                (0..counts[0]).flat_map(|i| (0..counts[1]).flat_map(move |j| (0..counts[2]).map(move |k| [i, j, k])));
            cells.map(|cell| step * Vector3::from(cell.map(|i| i as f64))).collect()
        }
        1 => {
            let step = random.pick(&[1.0, 1.0 / 3.0, 0.1]);
            let most = random.whole(2, 8);
            (0..random.whole(4, 25)).map(|_| step * Vector3::from_fn(|_, _| random.whole(0, most) as f64)).collect()
        }
        2 => {
            let sides = random.whole(3, 20);
            let rows = random.whole(2, 4);
            let turn = Rotation3::new(random.direction() * 3.0 * random.uniform());
            let at = |row: usize, side: usize| {
                let (sin, cos) = (std::f64::consts::TAU * side as f64 / sides as f64).sin_cos();
                turn * Vector3::new(cos, sin, row as f64)
            };
            (0..rows).flat_map(|row| (0..sides).map(move |side| at(row, side))).collect()
        }
        3 => {
            let corners = solid(random);
            let mut all = corners.clone();
            for _ in 0..random.whole(0, 30) {
                let few: Vec<_> = (0..random.whole(1, 4)).map(|_| corners[random.whole(0, corners.len())]).collect();
                all.push(combined(&few, random));
            }
            let shake = little(random, -6.0);
            all.iter().map(|at| at + shake * random.uniform() * random.direction()).collect()
        }
        4 => {
            let axes = Vector3::new(1.0, random.power(-5.0, 0.0), random.power(-5.0, 0.0));
            (0..random.whole(4, 40)).map(|_| random.direction().component_mul(&axes)).collect()
        }
        _ => {
            let (base, tip) = (random.power(-4.0, 0.0), random.power(-9.0, -2.0));
            let ends = [(0.0, base), (1.0, base * tip)];
            let slant = random.uniform() * tip;
            ends.iter()
                .flat_map(|&(x, half)| {
                    [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)]
                        .map(|(y, z)| Vector3::new(x + slant * y * x, half * y, half * z))
                })
                .collect()
        }
    };
    if random.uniform() < 0.3 {
        let again: Vec<_> = points.iter().filter(|at| at.x > at.y).copied().collect();
        points.extend(again);
    }
    for i in (1..points.len()).rev() {
        points.swap(i, random.whole(0, i + 1));
    }
    let scale = if random.uniform() < 0.3 { 1.0 } else { random.power(-9.0, 9.0) };
    let place = if random.uniform() < 0.5 { Vector3::zeros() } else { random.power(-2.0, 5.0) * random.direction() };
    points.iter().map(|at| (scale * (at + place)).into()).collect()
}

/// The volume that planes enclose.
fn volume(planes: &[Plane]) -> Option<f64> {
    slice(planes, &[], &SliceSettings::default()).ok().map(|mass| mass.blocks.iter().map(|block| block.volume).sum())
}

pub fn one(seed: u64, index: u64, ledger: &mut Ledger) {
    let mut random = stream(seed, index, 23);
    let family = random.whole(0, FAMILIES.len());
    *ledger.families.entry(FAMILIES[family].into()).or_default() += 1;
    let points = points(family, &mut random);
    let exact = ExactHull::of(&points);
    let mut fault = |fault: Fault, detail: String| {
        ledger.find(Finding {
            fault,
            family: FAMILIES[family].into(),
            seed,
            index,
            detail,
            case: serde_json::json!(points),
            planes: points.len(),
        });
    };
    let found = sharp_hull(&points);
    let ExactHull { volume: right, area, extent, ref faces, .. } = exact;
    let (middle, planes) = match found {
        Ok(found) => found,
        Err(ShapeError::Flat(_) | ShapeError::TooFewPoints(_)) => {
            // Flat: all lies within the tolerance of one of its faces.
            if right > COPLANAR * extent * area {
                fault(
                    Fault::NotSolved,
                    format!("refused as flat with a volume of {right:e}, area {area:e}, extent {extent:e}"),
                );
            }
            ledger.judged += 1;
            return;
        }
        Err(error) => return fault(Fault::NotSolved, error.to_string()),
    };
    let above = |plane: &Plane| {
        let height = |at: &[f64; 3]| plane.normal.dot(&(Vector3::from(*at) - middle)) - plane.offset;
        points.iter().map(height).fold(f64::NEG_INFINITY, f64::max)
    };
    let outside = planes.iter().map(above).fold(f64::NEG_INFINITY, f64::max);
    if !(outside <= ROUNDING * extent) {
        fault(Fault::OffSurface, format!("a point lies {:e} of the extent outside", outside / extent));
    }
    if planes.len() > faces.len() {
        fault(Fault::Malformed, format!("{} planes of {} faces", planes.len(), faces.len()));
    }
    match volume(&planes) {
        None => fault(Fault::Malformed, format!("the {} planes do not close", planes.len())),
        Some(found) if !(found - right).is_finite() || (found - right).abs() > COPLANAR * extent * area => {
            fault(
                Fault::Overlap,
                format!(
                    "volume {found:e} for {right:e}, off by {:e} of extent and area",
                    (found - right) / (extent * area)
                ),
            );
        }
        Some(_) => (),
    }
    // The same body of half-spaces, some of them given twice or more, and some that cut next to nothing.
    let (tilt, shift) = (little(&mut random, -7.0), little(&mut random, -7.0));
    let mut more = planes.clone();
    for _ in 0..random.whole(1, 8) {
        let Plane { normal, offset } = planes[random.whole(0, planes.len())];
        more.push(Plane {
            normal: normal + tilt * random.direction(),
            offset: offset + shift * extent * random.uniform(),
        });
    }
    for plane in &mut more {
        let length = random.power(-3.0, 3.0);
        *plane = Plane { normal: length * plane.normal, offset: length * plane.offset };
    }
    for i in (1..more.len()).rev() {
        more.swap(i, random.whole(0, i + 1));
    }
    match sharp_planes(&more) {
        Err(ShapeError::Thin) if right <= 2.0 * COPLANAR * extent * area => (),
        Err(error) => fault(Fault::NotSolved, format!("half-spaces: {error}")),
        Ok(kept) => {
            if kept.len() > planes.len() {
                fault(
                    Fault::Malformed,
                    format!("half-spaces: {} planes for {}, tilt {tilt:e}, shift {shift:e}", kept.len(), planes.len()),
                );
            }
            let found = volume(&kept).unwrap_or(f64::NAN);
            if !((found - right).abs() <= 2.0 * COPLANAR * extent * area) {
                fault(
                    Fault::Overlap,
                    format!("half-spaces: volume {found:e} for {right:e}, tilt {tilt:e}, shift {shift:e}"),
                );
            }
        }
    }
    ledger.judged += 2;
}
