//! The part of a patch along an edge: two planes of one body are active, and one of the other.
//!
//! Angles are given by the tangents of their halves.

use super::local_coordinates::{LocalCoordinates, Vector, Wave, node, turn};
use super::numbers::{Limits, SETTLED, UNSETTLED};
use super::ray::Node;
use super::rules::{MOST_POINTS, gauss, tapering};

/// The end of a strip.
#[derive(Clone, Copy, Debug)]
pub(super) enum End {
    /// At a distance along the edge.
    At(f64),
    /// At a plane that comes on, or at the edge of a triangle: its value at the origin of the coordinates, and how that
    /// changes with the coordinates.
    Line { value: f64, slopes: [f64; 3] },
}

/// Two planes of a body are active, and one of the other: the angle θ between both, from `start` on, and the distance
/// along the edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strip {
    pub coordinates: LocalCoordinates,
    /// Excess over s: of the two planes, and of the third.
    pub radii: [f64; 2],
    pub start: f64,
    /// Towards larger or smaller angles.
    pub sign: f64,
    pub ends: [End; 2],
    wave: Wave,
    /// The products of the arms across the edge with that along it, and of the second with the first.
    crosses: [Vector; 3],
    /// The angle over which a strip extends at its ends, and the distance along the edge at its ends, there and at the
    /// start.
    corners: [(f64, f64); 2],
    starts: [f64; 2],
}

impl Strip {
    /// From `start`, or from the ridge, to the rim.
    pub fn new(
        coordinates: LocalCoordinates,
        radii: [f64; 2],
        start: Option<f64>,
        sign: f64,
        ends: [End; 2],
    ) -> Option<Self> {
        let wave = Wave::new(-coordinates.slopes[0] * radii[0], -coordinates.slopes[1] * radii[0]);
        let start = start.unwrap_or_else(|| wave.peak());
        let [d, e, t] = coordinates.arms;
        let mut strip = Self {
            coordinates,
            crosses: [d.cross(&t), e.cross(&t), e.cross(&d)],
            radii: [radii[0], radii[1]],
            start,
            sign,
            ends,
            wave,
            corners: [(0.0, 0.0); 2],
            starts: [0.0; 2],
        };
        for side in 0..2 {
            let first = strip.end(side, start).0;
            let (mut width, mut along, mut step) = (strip.width(first).0, first, f64::INFINITY);
            for _ in 0..Limits::ITERATIONS {
                along = strip.end(side, start + width).0;
                let next = strip.width(along).0;
                step = (next - width).abs();
                width = next;
                if step <= SETTLED * width.abs() {
                    break;
                }
            }
            // The steps diverge where the end does not meet the rim within the zone.
            if step > UNSETTLED * width.abs() {
                return None;
            }
            strip.corners[side] = (width, along);
            strip.starts[side] = first;
        }
        let numbers = strip.corners.iter().flat_map(|(a, b)| [*a, *b]).chain(strip.starts);
        numbers.into_iter().all(f64::is_finite).then_some(strip)
    }

    /// Its length, at the start and at the rim: below 0 where its ends cross.
    pub fn lengths(&self) -> [f64; 2] {
        [self.starts[1] - self.starts[0], self.corners[1].1 - self.corners[0].1]
    }

    /// Angle and place of its four corners and of the middle of its rim.
    pub fn outline(&self) -> [[f64; 2]; 5] {
        let [(a, t), (b, u)] = self.corners;
        let middle = 0.5 * (t + u);
        [
            [self.start, self.starts[0]],
            [self.start, self.starts[1]],
            [self.start + a, t],
            [self.start + b, u],
            [self.start + self.width(middle).0, middle],
        ]
    }

    /// How far it extends in angle at a distance along the edge, and how fast that changes.
    #[inline(always)]
    fn width(&self, along: f64) -> (f64, f64) {
        let g = self.coordinates.slopes[2];
        let (rim, sine) = self.wave.fallen_to(self.coordinates.c + g * along - self.radii[1], self.sign);
        (rim - self.start, -0.5 * (1.0 + rim * rim) * g / (self.wave.size * sine))
    }

    /// F with s = (c + g t)/F, and its derivative in the angle.
    #[inline(always)]
    fn denominator(&self, sin: f64, cos: f64) -> (f64, f64) {
        let Wave { a, b, .. } = self.wave;
        (self.radii[1] + a * cos + b * sin, b * cos - a * sin)
    }

    /// Place of an end at an angle, and its derivative by the angle.
    #[inline(always)]
    fn end(&self, side: usize, theta: f64) -> (f64, f64) {
        match self.ends[side] {
            End::At(along) => (along, 0.0),
            End::Line { value, slopes } => {
                let [h1, h2, h3] = slopes;
                let (sin, cos, rate) = turn(theta);
                let (f, f1) = self.denominator(sin, cos);
                let k = (cos * h1 + sin * h2) * self.radii[0] / f;
                let k1 = (cos * h2 - sin * h1) * self.radii[0] / f - k * f1 / f;
                let (c, g) = (self.coordinates.c, self.coordinates.slopes[2]);
                let (up, down) = (value + c * k, h3 + g * k);
                (-up / down, -rate * (c * k1 * down - up * g * k1) / (down * down))
            }
        }
    }

    /// Estimate of ∫ p beyond an end where s = 1 at the start, over the width there: with the angle s first falls
    /// below 1.
    pub fn overhang(&self) -> f64 {
        let Wave { a, b, size } = self.wave;
        let rise = size - a;
        let ends_at_rim = self.start == 0.0 && self.ends.iter().any(|end| matches!(end, End::At(_)));
        let (g, c) = (self.coordinates.slopes[2].abs(), self.coordinates.c.abs());
        if ends_at_rim && b > 0.0 { rise * rise / (g * c) } else { 0.0 }
    }

    /// 1 − s in the middle of its start.
    pub fn depth(&self) -> f64 {
        let along = 0.5 * (self.starts[0] + self.starts[1]);
        let (sin, cos, _) = turn(self.start);
        1.0 - (self.coordinates.c + self.coordinates.slopes[2] * along) / self.denominator(sin, cos).0
    }

    pub fn place(&self, [theta, along]: [f64; 2]) -> Vector {
        let (sin, cos, _) = turn(theta);
        let s = (self.coordinates.c + self.coordinates.slopes[2] * along) / self.denominator(sin, cos).0;
        let scale = s * self.radii[0];
        self.coordinates.origin + self.coordinates.combine([scale * cos, scale * sin, along])
    }

    /// The parts of a node that depend on the angle alone: the vector of area over s, the direction outwards, and 1/F.
    #[inline(always)]
    fn across(&self, theta: f64) -> (Vector, Vector, f64) {
        let (sin, cos, rate) = turn(theta);
        let (f, f1) = self.denominator(sin, cos);
        let inverse = 1.0 / f;
        let [d, e, _] = self.coordinates.arms;
        let [by_d, by_e, along] = self.crosses;
        let r = self.radii[0];
        // Derivatives of s·outwards + along·t by the angle and along the edge.
        let fall = r * f1 * inverse;
        let area = (-fall * cos - r * sin) * by_d
            + (r * cos - fall * sin) * by_e
            + (r * r * self.coordinates.slopes[2] * inverse) * along;
        (rate * area, r * (cos * d + sin * e), inverse)
    }

    /// Gauss' rule of points across and along.
    pub fn integrate(&self, across: usize, along: usize, mut visit: impl FnMut(Node)) -> Option<()> {
        let [(first, t0), (last, t1)] = self.corners;
        let mut stations = [(0.0, 0.0, 0.0, 0.0); MOST_POINTS];
        let tapers = self.tapers();
        let rule = if tapers.is_some() { tapering(along) } else { &gauss(along).nodes[..along] };
        for (station, (sigma, weight)) in stations.iter_mut().zip(rule) {
            // Towards such an end it narrows as a root does, or as a line, which the square of the distance makes
            // smooth.
            let (tau, weight) = match tapers {
                None => (*sigma, *weight),
                Some(0) => (sigma * sigma, 2.0 * sigma * weight),
                Some(_) => (1.0 - sigma * sigma, 2.0 * sigma * weight),
            };
            let (wide, by_along) = self.width(t0 + tau * (t1 - t0));
            *station = (tau, weight, wide, if first == last { 0.0 } else { by_along * (t1 - t0) });
        }
        for (lambda, weight) in &gauss(across).nodes[..across] {
            let [(from, from1), (to, to1)] =
                [self.end(0, self.start + lambda * first), self.end(1, self.start + lambda * last)];
            for (tau, weight_along, width, width_by_tau) in &stations[..along] {
                let theta = self.start + lambda * width;
                let jacobian =
                    width * (to - from) - lambda * width_by_tau * (from1 * first * (1.0 - tau) + to1 * last * tau);
                let along = from + tau * (to - from);
                let (area, outwards, inverse) = self.across(theta);
                let s = (self.coordinates.c + self.coordinates.slopes[2] * along) * inverse;
                let x = self.coordinates.origin + s * outwards + along * self.coordinates.arms[2];
                visit(node(x, s * area, s, weight * weight_along * (self.sign * jacobian).max(0.0))?);
            }
        }
        Some(())
    }

    /// The end that it tapers to, as s = 1 there; `None` if both or neither.
    pub fn tapers(&self) -> Option<usize> {
        match self.ends {
            [End::At(_), End::Line { .. }] => Some(0),
            [End::Line { .. }, End::At(_)] => Some(1),
            _ => None,
        }
    }
}
