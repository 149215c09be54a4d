//! The contact area by adaptive quadrature over ray hits, as it is commonly computed.

use super::Placed;
use nalgebra::Vector3;
use potential_particles::Section;
use std::f64::consts::TAU;

/// Sectors before refinement.
const SECTORS: usize = 12;

/// Deepest halving of one sector.
const DEEPEST: u32 = 24;

/// ½∮ρ² dφ by Simpson's rule; sectors are halved until both of their estimates agree to their share of the tolerance.
/// `None` when a ray has no hit.
pub fn by_quadrature(pair: &Placed, section: &Section, relative_tolerance: f64) -> Option<f64> {
    let first = section.normal.cross(&Vector3::ith(section.normal.iamin(), 1.0)).normalize();
    let second = section.normal.cross(&first);
    let half_square = |angle: f64| {
        let direction = angle.cos() * first + angle.sin() * second;
        let (turn_a, turn_b) = (&pair.pose_a.rotation(), &pair.pose_b.rotation());
        let to_a = pair.a.surface_distance(&turn_a.tr_mul(&section.branch_a), &turn_a.tr_mul(&direction))?;
        let to_b = pair.b.surface_distance(&turn_b.tr_mul(&section.branch_b), &turn_b.tr_mul(&direction))?;
        Some(0.5 * to_a.min(to_b).max(0.0).powi(2))
    };
    let width = TAU / SECTORS as f64;
    let mut values = [0.0; 2 * SECTORS + 1];
    for (i, value) in values.iter_mut().enumerate() {
        *value = half_square(0.5 * width * i as f64)?;
    }
    let share = relative_tolerance * values[1..].iter().sum::<f64>() * 0.5 * width / SECTORS as f64;
    let mut area = 0.0;
    for i in 0..SECTORS {
        let at = [values[2 * i], values[2 * i + 1], values[2 * i + 2]];
        area += sector(&half_square, width * i as f64, width, at, share, DEEPEST)?;
    }
    Some(area)
}

fn sector(
    f: &impl Fn(f64) -> Option<f64>,
    from: f64,
    width: f64,
    [start, middle, end]: [f64; 3],
    tolerance: f64,
    deeper: u32,
) -> Option<f64> {
    let (left, right) = (f(from + 0.25 * width)?, f(from + 0.75 * width)?);
    let rough = width / 6.0 * (start + 4.0 * middle + end);
    let fine = width / 12.0 * (start + 4.0 * left + 2.0 * middle + 4.0 * right + end);
    if deeper == 0 || (fine - rough).abs() <= tolerance {
        return Some(fine + (fine - rough) / 15.0);
    }
    let half = 0.5 * width;
    let before = sector(f, from, half, [start, left, middle], 0.5 * tolerance, deeper - 1)?;
    Some(before + sector(f, from + half, half, [middle, right, end], 0.5 * tolerance, deeper - 1)?)
}
