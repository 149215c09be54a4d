//! The flat part of a patch: where one plane of each body is active, a polygon with a linear pressure.

use super::field::{Field, Owner};
use super::local_coordinates::{Flat, Vector, normal, radius};
use super::numbers::{ROUNDED, WIDE_SIDE_POINTS};
use super::ray::{Node, RIM};
use super::rules::gauss;
use crate::linalg::polygon::clip;

/// A corner, and the number of the plane that ends the polygon from there on ([`RIM`] where s = 1).
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub at: [f64; 2],
    pub side: u32,
}

/// The plane of the flat part: its height and the pressure over the plane of the frame, value and slopes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Level {
    pub height: [f64; 3],
    pub pressure: [f64; 3],
}

/// A linear function of the plane of the frame.
fn linear([c, u, v]: &[f64; 3], at: &[f64; 2]) -> f64 {
    c + u * at[0] + v * at[1]
}

impl Level {
    /// The line on which plane `i` of A and the flat body have the same excess.
    pub fn new(field: &Field, i: usize, other: &Flat) -> Option<Self> {
        let plane = &field.planes[i];
        let of_a = 1.0 / radius(field, Owner::A);
        let n = normal(plane);
        // e_i/r_A − e_j/r_B = 0; with a boundary e_j = 0.
        let (difference, excess) = if other.radius > 0.0 {
            (n * of_a - other.normal / other.radius, plane.excess * of_a - other.excess / other.radius)
        } else {
            (-other.normal, -other.excess)
        };
        if !(difference.z > 0.0) {
            return None;
        }
        let height = [-excess / difference.z, -difference.x / difference.z, -difference.y / difference.z];
        let level = Self { height, pressure: [0.0; 3] };
        let pressure = level.on(&(-of_a * n), 1.0 - of_a * plane.excess);
        Some(Self { pressure, ..level })
    }

    /// A linear function of space on the plane.
    pub fn on(&self, slope: &Vector, value: f64) -> [f64; 3] {
        let [c, u, v] = self.height;
        [value + slope.z * c, slope.x + slope.z * u, slope.y + slope.z * v]
    }

    pub fn point(&self, at: &[f64; 2]) -> Vector {
        Vector::new(at[0], at[1], linear(&self.height, at))
    }

    pub fn pressure_at(&self, at: &[f64; 2]) -> f64 {
        linear(&self.pressure, at)
    }
}

/// Cuts a square about the origin by all planes of the field but two; whether anything is left.
pub(super) fn cut(field: &Field, level: &Level, active: [usize; 2], half: f64, corners: &mut [Vec<Corner>; 2]) -> bool {
    let [polygon, next] = corners;
    polygon.clear();
    let square = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    polygon.extend(square.map(|[u, v]| Corner { at: [half * u, half * v], side: OPEN }));
    let below = level.pressure.map(|c| -c);
    let planes = field.planes.iter().enumerate().filter(|(k, _)| !active.contains(k));
    let lines = planes.map(|(k, plane)| (k as u32, level.on(&normal(plane), plane.excess)));
    for (side, line) in lines.chain([(RIM, below)]) {
        if polygon.is_empty() {
            return false;
        }
        if !polygon.iter().any(|corner| linear(&line, &corner.at) > 0.0) {
            continue;
        }
        let crossing = |from: &Corner, to: &Corner, part: f64, leads_out: bool| Corner {
            at: std::array::from_fn(|c| from.at[c] + part * (to.at[c] - from.at[c])),
            side: if leads_out { side } else { from.side },
        };
        clip(polygon, next, |corner| linear(&line, &corner.at), crossing);
        std::mem::swap(polygon, next);
    }
    // Sides without length.
    let size = polygon.iter().flat_map(|corner| corner.at).fold(0.0, |most: f64, c| most.max(c.abs()));
    let count = polygon.len();
    next.clear();
    next.extend((0..count).filter_map(|k| {
        let (a, b) = (polygon[k].at, polygon[(k + 1) % count].at);
        ((b[0] - a[0]).abs().max((b[1] - a[1]).abs()) > ROUNDED * size).then_some(polygon[k])
    }));
    std::mem::swap(polygon, next);
    polygon.len() >= 3
}

/// The side of the square that a polygon starts from.
pub(super) const OPEN: u32 = u32::MAX - 1;

/// The middle of the load.
fn middle(level: &Level, polygon: &[Corner]) -> Option<[f64; 2]> {
    let start = polygon[0].at;
    let (mut load, mut moment) = (0.0, [0.0; 2]);
    for pair in polygon[1..].windows(2) {
        let [a, b] = [pair[0].at, pair[1].at];
        let area = (a[0] - start[0]) * (b[1] - start[1]) - (a[1] - start[1]) * (b[0] - start[0]);
        let [p, q, r] = [start, a, b].map(|at| level.pressure_at(&at));
        load += area * (p + q + r) / 6.0;
        for c in 0..2 {
            let sum = (start[c] + a[c] + b[c]) * (p + q + r) + start[c] * p + a[c] * q + b[c] * r;
            moment[c] += area * sum / 24.0;
        }
    }
    (load > 0.0).then(|| moment.map(|m| m / load))
}

/// Points that are exact for pressures times linear functions, and nearly so for distances from the middle of the load.
///
/// In each triangle between that point and a side: two Gauss points for the weight ρ towards the side, two to six along
/// it.
pub(super) fn integrate(level: &Level, polygon: &[Corner], nodes: &mut Vec<Node>) -> Option<()> {
    let centre = middle(level, polygon)?;
    let root = 6.0_f64.sqrt();
    let towards = [((6.0 - root) / 10.0, 0.25 - root / 36.0), ((6.0 + root) / 10.0, 0.25 + root / 36.0)];
    let normal = [-level.height[1], -level.height[2]];
    for (k, corner) in polygon.iter().enumerate() {
        let (a, b) = (corner.at, polygon[(k + 1) % polygon.len()].at);
        let cross = (a[0] - centre[0]) * (b[1] - centre[1]) - (a[1] - centre[1]) * (b[0] - centre[0]);
        let dot = (a[0] - centre[0]) * (b[0] - centre[0]) + (a[1] - centre[1]) * (b[1] - centre[1]);
        // The distance from the middle varies along a side by the angle under which that is seen. Where it is wide,
        // both sides of the foot are integrated apart, with t the square of the rule's variable: at the foot there is
        // nearly a kink.
        let points = match () {
            () if dot > cross => 2,
            () if dot > 0.5 * cross => 3,
            () if dot > -0.3 * cross => 4,
            () => 0,
        };
        let mut add = |t: f64, weight: f64| {
            for (rho, share) in &towards {
                let at = std::array::from_fn(|c| centre[c] + rho * (a[c] + t * (b[c] - a[c]) - centre[c]));
                nodes.push(Node {
                    x: level.point(&at).into(),
                    weight: weight * share * cross,
                    pressure: level.pressure_at(&at),
                    normal,
                });
            }
        };
        gauss(points.max(1)).nodes[..points].iter().for_each(|(t, weight)| add(*t, *weight));
        if points == 0 {
            let side = [b[0] - a[0], b[1] - a[1]];
            let along = (centre[0] - a[0]) * side[0] + (centre[1] - a[1]) * side[1];
            let foot = along / (side[0] * side[0] + side[1] * side[1]);
            for (sigma, weight) in &gauss(WIDE_SIDE_POINTS).nodes[..WIDE_SIDE_POINTS] {
                let (square, weight) = (sigma * sigma, 2.0 * sigma * weight);
                add(foot * (1.0 - square), foot * weight);
                add(foot + (1.0 - foot) * square, (1.0 - foot) * weight);
            }
        }
    }
    Some(())
}
