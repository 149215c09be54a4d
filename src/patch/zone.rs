//! Parts of a patch on which the same planes are active: strips along an edge, caps at a corner, and discs.
//!
//! Angles are given by the tangents of their halves.

use super::chart::{Chart, Vector, Wave, node, turn};
use super::ray::Node;
use super::rules::{MOST_POINTS, gauss};
use std::f64::consts::TAU;
use std::sync::LazyLock;

/// Most fixed-point steps towards the corner of a strip.
const MOST_STEPS: usize = 12;

/// Relative size of the last step above which the search for a corner has not converged.
const UNSETTLED: f64 = 1e-5;

/// Where a strip ends.
#[derive(Clone, Copy, Debug)]
pub(super) enum End {
    /// At a distance along the edge.
    At(f64),
    /// Where a plane comes on or the edge of a triangle is met: its value at the origin of the chart, and how that changes with the coordinates.
    Line { value: f64, slopes: [f64; 3] },
}

/// Two planes of a body are active, and one of the other: the angle θ between both, from `start` on, and the distance along the edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strip {
    pub chart: Chart,
    /// Excess over s: of the two planes, and of the third.
    pub radii: [f64; 2],
    pub start: f64,
    /// Towards larger or smaller angles.
    pub sign: f64,
    pub ends: [End; 2],
    wave: Wave,
    /// The angle over which a strip extends at its ends, and the distance along the edge at its ends, there and at the start.
    corners: [(f64, f64); 2],
    starts: [f64; 2],
}

/// A place of a zone, its change with both parameters, and s.
type Place = (Vector, Vector, f64);

impl Strip {
    /// From `start`, or from the ridge, to the rim.
    pub fn new(chart: Chart, radii: [f64; 2], start: Option<f64>, sign: f64, ends: [End; 2]) -> Option<Self> {
        let wave = Wave::new(-chart.slopes[0] * radii[0], -chart.slopes[1] * radii[0]);
        let start = start.unwrap_or_else(|| wave.peak());
        let mut strip = Self {
            chart,
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
            for _ in 0..MOST_STEPS {
                along = strip.end(side, start + width).0;
                let next = strip.width(along).0;
                step = (next - width).abs();
                width = next;
                if step <= 1e-9 * width.abs() {
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
        let g = self.chart.slopes[2];
        let (rim, sine) = self.wave.fallen_to(self.chart.c + g * along - self.radii[1], self.sign);
        (rim - self.start, -0.5 * (1.0 + rim * rim) * g / (self.wave.size * sine))
    }

    /// F with s = (c + g t)/F, and its derivative in the angle.
    #[inline(always)]
    fn denominator(&self, sin: f64, cos: f64) -> (f64, f64) {
        let Wave { a, b, .. } = self.wave;
        (self.radii[1] + a * cos + b * sin, b * cos - a * sin)
    }

    /// Where an end lies at an angle, and its change with it.
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
                let (c, g) = (self.chart.c, self.chart.slopes[2]);
                let (up, down) = (value + c * k, h3 + g * k);
                (-up / down, -rate * (c * k1 * down - up * g * k1) / (down * down))
            }
        }
    }

    /// ∫ p over what lies beyond an end where s = 1 at the start, since s falls at first with the angle, about, over the width there.
    pub fn overhang(&self) -> f64 {
        let Wave { a, b, size } = self.wave;
        let rise = size - a;
        let ends_at_rim = self.start == 0.0 && self.ends.iter().any(|end| matches!(end, End::At(_)));
        let (g, c) = (self.chart.slopes[2].abs(), self.chart.c.abs());
        if ends_at_rim && b > 0.0 { rise * rise / (g * c) } else { 0.0 }
    }

    /// 1 − s in the middle of its start.
    pub fn depth(&self) -> f64 {
        1.0 - self.at(self.start, 0.5 * (self.starts[0] + self.starts[1])).2
    }

    pub fn place(&self, [theta, along]: [f64; 2]) -> Vector {
        let (sin, cos, _) = turn(theta);
        let s = (self.chart.c + self.chart.slopes[2] * along) / self.denominator(sin, cos).0;
        let scale = s * self.radii[0];
        self.chart.origin + self.chart.combine([scale * cos, scale * sin, along])
    }

    #[inline(always)]
    fn at(&self, theta: f64, along: f64) -> Place {
        let (sin, cos, rate) = turn(theta);
        let (f, f1) = self.denominator(sin, cos);
        let s = (self.chart.c + self.chart.slopes[2] * along) / f;
        let (by_theta, by_along) = (-s * f1 / f, self.chart.slopes[2] / f);
        let [d, e, t] = self.chart.arms;
        let r = self.radii[0];
        let outwards = r * (cos * d + sin * e);
        let x = self.chart.origin + s * outwards + along * t;
        let area = (by_theta * outwards + (r * s) * (cos * e - sin * d)).cross(&(t + by_along * outwards));
        (x, rate * area, s)
    }

    /// Gauss' rule of points across and along.
    pub fn integrate(&self, across: usize, along: usize, mut visit: impl FnMut(Node)) -> Option<()> {
        let [(first, t0), (last, t1)] = self.corners;
        let mut widths = [(0.0, 0.0); MOST_POINTS];
        for (width, (tau, _)) in widths.iter_mut().zip(&gauss(along).nodes[..along]) {
            let (wide, by_along) = self.width(t0 + tau * (t1 - t0));
            *width = (wide, if first == last { 0.0 } else { by_along * (t1 - t0) });
        }
        for (lambda, weight) in &gauss(across).nodes[..across] {
            let [(from, from1), (to, to1)] =
                [self.end(0, self.start + lambda * first), self.end(1, self.start + lambda * last)];
            for ((tau, weight_along), (width, width_by_tau)) in gauss(along).nodes[..along].iter().zip(&widths) {
                let theta = self.start + lambda * width;
                let jacobian =
                    width * (to - from) - lambda * width_by_tau * (from1 * first * (1.0 - tau) + to1 * last * tau);
                let (x, area, s) = self.at(theta, from + tau * (to - from));
                visit(node(x, area, s, weight * weight_along * (self.sign * jacobian).max(0.0))?);
            }
        }
        Some(())
    }
}

/// Which body the third plane of a cap belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Third {
    /// That of the first two: three planes against one.
    Same,
    /// The other: two against two.
    Other,
}

/// The excesses of a corner's planes over s as functions of two angles, and the relation that gives s.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cap {
    pub chart: Chart,
    /// Excess over s: of the first two planes, and of the last.
    pub radii: [f64; 2],
    pub third: Third,
    pub start: f64,
    width: f64,
}

impl Cap {
    /// Beyond the end of a strip.
    pub fn new(chart: Chart, strip: &Strip, third: Third) -> Option<Self> {
        let mut cap = Self { chart, radii: strip.radii, third, start: strip.start, width: 0.0 };
        let wave = Wave::new(-chart.slopes[0] * cap.radii[0], -chart.slopes[1] * cap.radii[0]);
        cap.width = wave.fallen_to(chart.c - cap.radii[1], strip.sign).0 - cap.start;
        cap.width.is_finite().then_some(cap)
    }

    /// F as a constant and a wave in the second angle.
    #[inline(always)]
    fn across(&self, theta: f64) -> (f64, Wave) {
        let [r, other] = self.radii;
        let (sin, cos, _) = turn(theta);
        let first = -(self.chart.slopes[0] * cos + self.chart.slopes[1] * sin) * r;
        match self.third {
            Third::Same => (other, Wave::new(first, -self.chart.slopes[2] * r)),
            Third::Other => (first, Wave::new(other, -self.chart.slopes[2] * other)),
        }
    }

    /// By how much F rises beyond the border with the strip, over its value there: a part of the patch is then missing.
    pub fn rise(&self) -> f64 {
        let Wave { a, b, size } = self.across(self.start).1;
        if b > 0.0 { (size - a) / self.chart.c.abs() } else { 0.0 }
    }

    fn height(&self, theta: f64) -> f64 {
        let (constant, wave) = self.across(theta);
        wave.fallen_to(self.chart.c - constant, 1.0).0.max(0.0)
    }

    /// Where it begins.
    pub fn corner(&self) -> Vector {
        self.at(self.start, 0.0).0
    }

    /// Places on its rim, from that at the start on.
    pub fn outline(&self) -> [Vector; 3] {
        [0.0, 0.5, 0.8].map(|part| {
            let theta = self.start + part * self.width;
            self.at(theta, self.height(theta)).0
        })
    }

    #[inline(always)]
    fn at(&self, theta: f64, psi: f64) -> Place {
        let ((sin, cos, rate), (sin2, cos2, rate2)) = (turn(theta), turn(psi));
        let [r, other] = self.radii;
        // The coordinates over s and their changes, and the same of the last plane.
        let (a, by_theta, by_psi, last, last_by_psi) = match self.third {
            Third::Same => (
                [r * cos2 * cos, r * cos2 * sin, r * sin2],
                [-r * cos2 * sin, r * cos2 * cos, 0.0],
                [-r * sin2 * cos, -r * sin2 * sin, r * cos2],
                other,
                0.0,
            ),
            Third::Other => (
                [r * cos, r * sin, other * sin2],
                [-r * sin, r * cos, 0.0],
                [0.0, 0.0, other * cos2],
                other * cos2,
                -other * sin2,
            ),
        };
        let (x, area, s) = place(&self.chart, a, [by_theta, by_psi], last, [0.0, last_by_psi]);
        (x, rate * rate2 * area, s)
    }

    /// Gauss' rule of so many points in both angles.
    pub fn integrate(&self, points: usize, mut visit: impl FnMut(Node)) -> Option<()> {
        let rule = &gauss(points).nodes[..points];
        for (xi, weight) in rule {
            // The height ends as a root does: the square of the rest makes it smooth.
            let rest = 1.0 - if points == 1 { SINGLE } else { *xi };
            let theta = self.start + self.width * (1.0 - rest * rest);
            let height = self.height(theta);
            let share = weight * (2.0 * rest * self.width).abs() * height;
            for (nu, weight) in rule {
                let (x, area, s) = self.at(theta, nu * height);
                visit(node(x, area, s, share * weight)?);
            }
        }
        Some(())
    }
}

/// Where a single point gives the load of a quarter of a paraboloid.
const SINGLE: f64 = 0.407;

/// The place for coordinates over s and an excess of the last plane over s, with their changes by two parameters; the vector of area; s.
#[inline(always)]
fn place(chart: &Chart, a: [f64; 3], by: [[f64; 3]; 2], last: f64, last_by: [f64; 2]) -> Place {
    let f = last - chart.change(a);
    let s = chart.c / f;
    let away = chart.combine(a);
    let [first, second] = [0, 1].map(|i| {
        let f1 = last_by[i] - chart.change(by[i]);
        (-s * f1 / f) * away + s * chart.combine(by[i])
    });
    (chart.origin + s * away, first.cross(&second), s)
}

/// The whole patch is one zone: three planes of a body against one, or two against two.
#[derive(Clone, Copy, Debug)]
pub(super) struct Disc {
    pub chart: Chart,
    pub radii: [f64; 2],
    pub third: Third,
}

impl Disc {
    /// Gauss' rule in the distance from the middle, equal steps around it.
    pub fn integrate(&self, outwards: usize, around: usize, mut visit: impl FnMut(Node)) -> Option<()> {
        for (rho, weight) in &gauss(outwards).nodes[..outwards] {
            for direction in &circle(around)[..around] {
                let (x, area, s) = self.at(rho * rho, direction)?;
                visit(node(x, area, s, 2.0 * rho * weight * TAU / around as f64)?);
            }
        }
        Some(())
    }

    /// Places on its rim, which must not leave the zone.
    pub fn outline(&self) -> Option<[Vector; 12]> {
        let mut places = [Vector::zeros(); 12];
        for (i, place) in places.iter_mut().enumerate() {
            *place = self.at(1.0, &circle(12)[i])?.0;
        }
        Some(places)
    }

    /// At the square of the distance, 1 on the rim, in a direction.
    fn at(&self, u: f64, &(sin_chi, cos_chi): &(f64, f64)) -> Option<Place> {
        match self.third {
            Third::Same => self.on_sphere(u, sin_chi, cos_chi),
            Third::Other => self.on_torus(u, sin_chi, cos_chi),
        }
    }

    fn on_sphere(&self, u: f64, sin_chi: f64, cos_chi: f64) -> Option<Place> {
        let [r, other] = self.radii;
        let towards = Vector::from(self.chart.slopes) * -r;
        let size = towards.norm();
        let axis = towards / size;
        let p = axis.cross(&Vector::ith(axis.iamin(), 1.0)).normalize();
        let q = axis.cross(&p);
        // 1 − cos ω, which is even over the sphere.
        let whole = (size + other - self.chart.c) / size;
        if !(whole > 0.0 && whole < 1.0) {
            return None;
        }
        let versed = whole * u;
        let (cos, sin) = (1.0 - versed, (versed * (2.0 - versed)).sqrt());
        let around = cos_chi * p + sin_chi * q;
        let m = cos * axis + sin * around;
        let by_omega = cos * around - sin * axis;
        let by_chi = cos_chi * q - sin_chi * p;
        let scaled = |v: Vector| [v.x * r, v.y * r, v.z * r];
        let (x, area, s) = place(&self.chart, scaled(m), [scaled(by_omega), scaled(by_chi)], other, [0.0; 2]);
        Some((x, whole * area, s))
    }

    fn on_torus(&self, u: f64, sin_chi: f64, cos_chi: f64) -> Option<Place> {
        let [r, other] = self.radii;
        let [alpha, beta, gamma] = self.chart.slopes;
        let first = Wave::new(-alpha * r, -beta * r);
        let second = Wave::new(other, -gamma * other);
        let depth = first.size + second.size - self.chart.c;
        // Half angles, whose sines are those of an ellipse.
        let axes = [first, second].map(|wave| (0.5 * depth / wave.size).sqrt());
        if !(depth > 0.0 && axes.iter().all(|axis| *axis < 0.7)) {
            return None;
        }
        let half = [axes[0] * u.sqrt() * cos_chi, axes[1] * u.sqrt() * sin_chi];
        let root = half.map(|h| (1.0 - h * h).sqrt());
        let from_peak = |wave: &Wave, i: usize| {
            let (sin, cos) = (2.0 * half[i] * root[i], 1.0 - 2.0 * half[i] * half[i]);
            ((wave.b * cos + wave.a * sin) / wave.size, (wave.a * cos - wave.b * sin) / wave.size)
        };
        let ((sin, cos), (sin2, cos2)) = (from_peak(&first, 0), from_peak(&second, 1));
        let (x, area, s) = place(
            &self.chart,
            [r * cos, r * sin, other * sin2],
            [[-r * sin, r * cos, 0.0], [0.0, 0.0, other * cos2]],
            other * cos2,
            [0.0, -other * sin2],
        );
        let scale = 2.0 * axes[0] * axes[1] / (root[0] * root[1]);
        Some((x, scale * area, s))
    }
}

/// Most points around a disc.
const MOST_AROUND: usize = 24;

/// Sine and cosine of so many equal steps around.
fn circle(count: usize) -> &'static [(f64, f64); MOST_AROUND] {
    type Table = [[(f64, f64); MOST_AROUND]; MOST_AROUND];
    static TABLE: LazyLock<Table> = LazyLock::new(|| {
        std::array::from_fn(|n| std::array::from_fn(|i| (TAU * (i as f64 + 0.5) / (n + 1) as f64).sin_cos()))
    });
    &TABLE[count - 1]
}
