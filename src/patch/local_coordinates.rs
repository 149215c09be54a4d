//! Coordinates in which the patch is explicit: the excesses of active planes.
//!
//! On the patch of bodies without a sphere, the excesses of the active planes of a body are 1/√w times s times the
//! components of a unit vector. With the excesses of three planes as coordinates of space (or of two, and the distance
//! along their edge), that of the last active plane is c + α·coordinates. This relation gives s for any directions of
//! the unit vectors, without a root to be found.

use super::field::{Field, FramePlane, Owner};
use super::numbers::STEEPEST_GRAPH;
use super::ray::Node;
use nalgebra::Vector3;

pub(super) type Vector = Vector3<f64>;

/// A place of the patch, the vector of area for a unit of both parameters, and s.
pub(super) type Place = (Vector, Vector, f64);

/// Planes as coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct LocalCoordinates {
    /// The point at which all three coordinates are 0.
    pub origin: Vector,
    /// How the place changes with each of them.
    pub arms: [Vector; 3],
    /// The excess of the last plane at the origin, and how it changes.
    pub c: f64,
    pub slopes: [f64; 3],
}

/// A flat body: one active plane, or a rigid boundary.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flat {
    pub normal: Vector,
    pub excess: f64,
    /// Its excess over s; 0 for a rigid boundary.
    pub radius: f64,
}

impl Flat {
    /// The plane z = 0, with A below.
    pub const BOUNDARY: Self = Self { normal: Vector::new(0.0, 0.0, -1.0), excess: 0.0, radius: 0.0 };
}

/// 1/√w of a body: the excess of its plane on the surface.
pub(super) fn radius(field: &Field, owner: Owner) -> f64 {
    match owner {
        Owner::A => field.a.plane_weight.sqrt().recip(),
        Owner::B => field.b.map_or(0.0, |b| b.plane_weight.sqrt().recip()),
        Owner::Edge => 0.0,
    }
}

pub(super) fn normal(plane: &FramePlane) -> Vector {
    Vector::from(plane.normal)
}

impl LocalCoordinates {
    /// The excesses of three planes. `None` where they meet in no point.
    pub fn corner(planes: [&FramePlane; 3], last: &Flat) -> Option<Self> {
        let [n, m, o] = planes.map(normal);
        let arms = [m.cross(&o), o.cross(&n), n.cross(&m)];
        let volume = n.dot(&arms[0]);
        let arms = arms.map(|arm| arm / volume);
        let origin = -(planes[0].excess * arms[0] + planes[1].excess * arms[1] + planes[2].excess * arms[2]);
        Self::with(origin, arms, last)
    }

    /// The excesses of two planes, and the distance along the line in which they meet.
    pub fn edge(planes: [&FramePlane; 2], last: &Flat) -> Option<Self> {
        let [n, m] = planes.map(normal);
        let along = n.cross(&m).try_normalize(0.0)?;
        let (of_n, of_m) = (m.cross(&along), along.cross(&n));
        let arms = [of_n / n.dot(&of_n), of_m / m.dot(&of_m), along];
        Self::with(-(planes[0].excess * arms[0] + planes[1].excess * arms[1]), arms, last)
    }

    fn with(origin: Vector, arms: [Vector; 3], last: &Flat) -> Option<Self> {
        let c = last.excess + last.normal.dot(&origin);
        let slopes = arms.map(|arm| last.normal.dot(&arm));
        (c.is_finite() && slopes.iter().all(|slope| slope.is_finite())).then_some(Self { origin, arms, c, slopes })
    }

    #[inline(always)]
    pub fn combine(&self, a: [f64; 3]) -> Vector {
        a[0] * self.arms[0] + a[1] * self.arms[1] + a[2] * self.arms[2]
    }

    /// The change of the last excess with a change of the coordinates.
    #[inline(always)]
    pub fn change(&self, a: [f64; 3]) -> f64 {
        a[0] * self.slopes[0] + a[1] * self.slopes[1] + a[2] * self.slopes[2]
    }

    /// The place with coordinates s·`a` and last excess s·`last`, with derivatives by two parameters.
    #[inline(always)]
    pub fn place(&self, a: [f64; 3], by: [[f64; 3]; 2], last: f64, last_by: [f64; 2]) -> Place {
        let inverse = 1.0 / (last - self.change(a));
        let s = self.c * inverse;
        let away = self.combine(a);
        let along =
            |by: [f64; 3], last_by: f64| (-s * (last_by - self.change(by)) * inverse) * away + s * self.combine(by);
        let area = along(by[0], last_by[0]).cross(&along(by[1], last_by[1]));
        (self.origin + s * away, area, s)
    }
}

/// a cos x + b sin x. Angles are given by the tangent of their half, so that only roots and quotients are needed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wave {
    pub a: f64,
    pub b: f64,
    pub size: f64,
}

impl Wave {
    #[inline(always)]
    pub fn new(a: f64, b: f64) -> Self {
        Self { a, b, size: (a * a + b * b).sqrt() }
    }

    /// The angle at which the wave is largest.
    #[inline(always)]
    pub fn peak(&self) -> f64 {
        self.b / (self.size + self.a)
    }

    /// Where it has fallen to a value on the given side of the peak, or the peak if it never is as high; and the sine
    /// of the angle between.
    #[inline(always)]
    pub fn fallen_to(&self, value: f64, sign: f64) -> (f64, f64) {
        let ratio = (value / self.size).clamp(-1.0, 1.0);
        let (peak, away) = (self.peak(), sign * ((1.0 - ratio) / (1.0 + ratio)).sqrt());
        ((peak + away) / (1.0 - peak * away), sign * (1.0 - ratio * ratio).sqrt())
    }
}

/// Sine and cosine of an angle with this tangent of its half, and how fast the angle changes with that.
#[inline(always)]
pub(super) fn turn(half: f64) -> (f64, f64, f64) {
    let rate = 2.0 / (1.0 + half * half);
    (half * rate, rate - 1.0, rate)
}

/// A node from the place, the vector of area for a unit of both parameters, s, and the weight. `None` where the patch
/// is no graph, and where a parameter has no end: a border that is reached at an angle of 0.
#[inline(always)]
pub(super) fn node(x: Vector, area: Vector, s: f64, weight: f64) -> Option<Node> {
    let inverse = 1.0 / area.z;
    let node = Node {
        x: x.into(),
        weight: weight * area.z.abs(),
        pressure: (1.0 - s).max(0.0),
        normal: [area.x * inverse, area.y * inverse],
    };
    (node.normal[0].abs() + node.normal[1].abs() < STEEPEST_GRAPH && node.weight < f64::INFINITY).then_some(node)
}
