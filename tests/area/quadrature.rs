//! The area by its definition, with nothing but ray hits: slow, and independent of the walk along the edges.

use crate::sections::Cut;
use nalgebra::Vector3;
use std::f64::consts::TAU;

/// Sectors before refinement.
const SECTORS: usize = 24;

/// Deepest halving of a sector: a kink is then met to 1e-9 of its sector.
const DEEPEST: u32 = 30;

/// ½∮ρ² dφ with ρ the distance to the nearer edge; sectors are halved until both of their estimates agree to a part of
/// the tolerance so small that the sum keeps to it.
pub fn area(cut: &Cut, relative_tolerance: f64) -> f64 {
    let normal = cut.section.normal.normalize();
    let first = normal.cross(&Vector3::ith(normal.iamin(), 1.0)).normalize();
    let second = normal.cross(&first);
    let [from_a, from_b] = cut.points();
    let half_square = |angle: f64| {
        let direction = angle.cos() * first + angle.sin() * second;
        let to_a = cut.a.surface_distance(&from_a, &cut.pose_a.rotation().tr_mul(&direction)).expect("a hit");
        let to_b = cut.b.surface_distance(&from_b, &cut.pose_b.rotation().tr_mul(&direction)).expect("a hit");
        0.5 * to_a.min(to_b).max(0.0).powi(2)
    };
    let width = TAU / SECTORS as f64;
    let values: Vec<f64> = (0..=2 * SECTORS).map(|i| half_square(0.5 * width * i as f64)).collect();
    let rough: f64 = values.iter().sum::<f64>() * 0.5 * width;
    let share = 0.1 * relative_tolerance * rough / SECTORS as f64;
    (0..SECTORS)
        .map(|i| {
            let at = [values[2 * i], values[2 * i + 1], values[2 * i + 2]];
            sector(&half_square, width * i as f64, width, at, share, DEEPEST)
        })
        .sum()
}

fn sector(
    f: &impl Fn(f64) -> f64,
    from: f64,
    width: f64,
    [start, middle, end]: [f64; 3],
    tolerance: f64,
    deeper: u32,
) -> f64 {
    let (left, right) = (f(from + 0.25 * width), f(from + 0.75 * width));
    let rough = width / 6.0 * (start + 4.0 * middle + end);
    let fine = width / 12.0 * (start + 4.0 * left + 2.0 * middle + 4.0 * right + end);
    if deeper == 0 || (fine - rough).abs() <= tolerance {
        return fine + (fine - rough) / 15.0;
    }
    let half = 0.5 * width;
    sector(f, from, half, [start, left, middle], tolerance, deeper - 1)
        + sector(f, from + half, half, [middle, right, end], tolerance, deeper - 1)
}
