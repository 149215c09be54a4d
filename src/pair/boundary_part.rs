//! A plane, an edge or a corner of a boundary: the set on which the point of a contact lies, with its own frame.
//!
//! In its frame a plane is z = 0, an edge the x axis and a corner the origin, so that a point of it has the first two,
//! the first or none of its coordinates. The origin is the point that is nearest to the centre of the particle:
//! coordinates are no longer than the particle, wherever the scene lies.

use crate::linalg::double_double::DoubleDouble;
use crate::linalg::graded_basis::any_across;
use crate::linalg::number::{Number, gamma, larger};
use crate::linalg::wide::{Wide, difference, rounded, wide};
use crate::pose::Pose;
use nalgebra::{Matrix3, Vector2, Vector3};
use std::cell::OnceCell;

/// A part of a boundary as the caller gave it, world frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum BoundaryPart {
    /// A plane through a point, by its unit normal and by a normal of any length that is exact.
    Plane { point: Vector3<f64>, normal: Vector3<f64>, given: Vector3<f64> },
    /// The plane of three points, which have this unit normal. The sides at the first have a sine of 1/`condition`
    /// between them.
    Inside { vertices: [Vector3<f64>; 3], normal: Vector3<f64>, condition: f64 },
    /// The line through two points of a triangle with this third one. They come in an order of their own, so that all
    /// triangles that share an edge find the same bits.
    Edge { ends: [Vector3<f64>; 2], third: Vector3<f64> },
    /// A vertex of a triangle with these two others.
    Corner { at: Vector3<f64>, others: [Vector3<f64>; 2] },
}

/// The frame of a part beside a particle, in doubles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PartFrame {
    /// Part to world.
    pub rotation: Matrix3<f64>,
    /// Centre of the particle in the frame of the part.
    pub centre: Vector3<f64>,
    /// Length that the rounding of the place of the part is proportional to: that of the farthest point by which it is
    /// given.
    pub lengths: f64,
}

/// The same in numbers of 32 digits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WideFrame {
    /// The axes of the part, world frame.
    pub axes: [Wide; 3],
    pub centre: Wide,
}

/// A part of a boundary beside a particle.
#[derive(Clone, Debug)]
pub(crate) struct PlacedPart<'a> {
    pub part: BoundaryPart,
    /// Of the particle.
    pub pose: &'a Pose,
    pub frame: PartFrame,
    /// Made where it is first asked for.
    wide: OnceCell<WideFrame>,
}

impl BoundaryPart {
    /// The number of coordinates that a point of it has.
    pub fn dimensions(&self) -> usize {
        match self {
            Self::Plane { .. } | Self::Inside { .. } => 2,
            Self::Edge { .. } => 1,
            Self::Corner { .. } => 0,
        }
    }

    /// What its place is rounded by in numbers of 32 digits, relative to the lengths by which it is given: the rounding
    /// of two sides turns their plane.
    pub fn wide_condition(&self) -> f64 {
        if let Self::Inside { condition, .. } = self { 1.0 + 2.0 * condition } else { 1.0 }
    }

    /// Its frame beside a particle, whose pose is subtracted before anything is turned.
    fn frame(&self, pose: &Pose) -> PartFrame {
        let from_centre = |point: &Vector3<f64>| point - pose.position();
        match self {
            Self::Plane { point, normal, .. } => plane_frame(normal, &from_centre(point), from_centre(point).norm()),
            Self::Inside { vertices, normal, .. } => {
                let farthest = vertices.iter().map(|v| from_centre(v).norm()).fold(0.0, f64::max);
                plane_frame(normal, &from_centre(&vertices[0]), farthest)
            }
            Self::Edge { ends: [from, to], .. } => {
                let (start, along) = (from_centre(from), unit(&(to - from)));
                let across = any_across(&along);
                let rotation = Matrix3::from_columns(&[along, across, along.cross(&across)]);
                let lengths = start.norm().max(from_centre(to).norm());
                let centre = -rotation.tr_mul(&start);
                PartFrame { rotation, centre: Vector3::new(0.0, centre.y, centre.z), lengths }
            }
            Self::Corner { at, .. } => {
                let start = from_centre(at);
                PartFrame { rotation: Matrix3::identity(), centre: -start, lengths: start.norm() }
            }
        }
    }

    /// The same in numbers of 32 digits.
    fn wide_frame(&self, pose: &Pose) -> WideFrame {
        let (axes, point) = match self {
            Self::Plane { point, given, normal } => (plane_axes(&wide_unit(&wide(given)), normal), point),
            Self::Inside { vertices: [a, b, c], normal, .. } => {
                (plane_axes(&wide_unit(&difference(b, a).cross(&difference(c, a))), normal), a)
            }
            Self::Edge { ends: [from, to], .. } => {
                let along = wide_unit(&difference(to, from));
                let across = wide_across(&along, &any_across(&unit(&(to - from))));
                ([along, across, along.cross(&across)], from)
            }
            Self::Corner { at, .. } => {
                let axes = [0, 1, 2].map(|i| wide(&Vector3::ith(i, 1.0)));
                return WideFrame { axes, centre: difference(pose.position(), at) };
            }
        };
        let to_centre = difference(pose.position(), point);
        let zero = DoubleDouble::default();
        // The origin is below the centre.
        let centre = [0, 1, 2].map(|i| if i < self.dimensions() { zero } else { axes[i].dot(&to_centre) });
        WideFrame { axes, centre: centre.into() }
    }

    /// Bound on the rounding of [`PlacedPart::descent`] in doubles, for a gradient of this length: the direction from
    /// an edge into a narrow triangle is a small difference of long sides.
    pub fn descent_rounding(&self, gradient: f64) -> f64 {
        let Self::Edge { ends: [from, to], third } = self else { return OF_DIRECTION * gradient };
        let (along, side) = (unit(&(to - from)), third - from);
        OF_DIRECTION * gradient * side.norm() / along.cross(&side).norm()
    }

    /// The steepest fall along the directions that bound the triangle at the part, in either kind of numbers.
    fn steepest<N: Number>(
        &self,
        towards: impl Fn(&Vector3<f64>, &Vector3<f64>) -> Vector3<N>,
        unit: impl Fn(&Vector3<N>) -> Vector3<N>,
        fall: impl Fn(&Vector3<N>) -> f64,
        rounded: impl Fn(&Vector3<N>) -> Vector3<f64>,
    ) -> Option<f64> {
        match self {
            Self::Plane { .. } | Self::Inside { .. } => None,
            Self::Edge { ends, third } => {
                let inwards = towards(third, &ends[0]);
                Some(fall(&unit(&Vector3::new(N::of(0.0), inwards.y, inwards.z))))
            }
            Self::Corner { at, others } => {
                let sides = others.map(|other| unit(&towards(&other, at)));
                Some(into_corner([fall(&sides[0]), fall(&sides[1])], (rounded(&sides[0]) + rounded(&sides[1])).norm()))
            }
        }
    }
}

impl<'a> PlacedPart<'a> {
    pub fn new(part: BoundaryPart, pose: &'a Pose) -> Self {
        Self { frame: part.frame(pose), part, pose, wide: OnceCell::new() }
    }

    pub fn wide_frame(&self) -> &WideFrame {
        self.wide.get_or_init(|| self.part.wide_frame(self.pose))
    }

    /// Its frame in doubles, right to the last digits wherever the points lie by which the part is given.
    pub fn precise_frame(&self) -> PartFrame {
        let WideFrame { axes, centre } = self.wide_frame();
        let rotation = Matrix3::from_columns(&axes.map(|axis| rounded(&axis)));
        PartFrame { rotation, centre: rounded(centre), lengths: self.frame.lengths }
    }

    /// A point of the local frame of the particle in the frame of the part.
    pub fn in_part(&self, x: &Vector3<f64>) -> Vector3<f64> {
        self.frame.rotation.tr_mul(&self.pose.rotate(x)) + self.frame.centre
    }

    /// How steeply a function with this gradient, frame of the part, falls at most from the part into the triangle that
    /// it is part of; negative where it rises by at least so much. `None` for a part that is all of its boundary.
    pub fn descent(&self, gradient: &Vector3<f64>) -> Option<f64> {
        let towards = |v: &Vector3<f64>, from: &Vector3<f64>| self.frame.rotation.tr_mul(&(v - from));
        self.part.steepest(towards, |v| v.normalize(), |side| -gradient.dot(side), |side| *side)
    }

    /// The same in numbers of 32 digits: a slope that is small beside the gradient keeps its digits.
    pub fn wide_descent(&self, gradient: &Wide) -> Option<f64> {
        let WideFrame { axes, .. } = self.wide_frame();
        let towards = |v: &Vector3<f64>, from: &Vector3<f64>| {
            let way = difference(v, from);
            Vector3::from([0, 1, 2].map(|i| axes[i].dot(&way)))
        };
        self.part.steepest(towards, wide_unit, |side| -gradient.dot(side).rounded(), rounded)
    }

    /// The coordinates of the ends of an edge along it, of 32 digits before they are rounded.
    pub fn wide_ends(&self) -> [f64; 2] {
        let BoundaryPart::Edge { ends, .. } = &self.part else { return [f64::NEG_INFINITY, f64::INFINITY] };
        let WideFrame { axes, .. } = self.wide_frame();
        ends.map(|end| axes[0].dot(&difference(&end, self.pose.position())).rounded())
    }

    /// Distances of a point of a plane, in its frame, from the edges of a triangle there; negative beyond. Of 32 digits
    /// before they are rounded.
    pub fn wide_from_edges(&self, vertices: &[Vector3<f64>; 3], x: &Vector2<f64>) -> [f64; 3] {
        let WideFrame { axes, centre } = self.wide_frame();
        let from_centre = wide(&x.push(0.0)) - centre;
        let point = axes[0] * from_centre.x + axes[1] * from_centre.y + axes[2] * from_centre.z;
        [0, 1, 2].map(|i| {
            let (from, to) = (&vertices[i], &vertices[(i + 1) % 3]);
            if from == to {
                return f64::INFINITY;
            }
            let inwards = axes[2].cross(&wide_unit(&difference(to, from)));
            inwards.dot(&(point - difference(from, self.pose.position()))).rounded()
        })
    }
}

/// Bound on the rounding of a side in the frame of a part, relative to its length: that of a difference, and of a
/// product with the rounded axes. Estimated: u for the difference, 5u for the product, as much for the axes.
const OF_DIRECTION: f64 = gamma(16);

/// The steepest fall between two sides with these falls along them, `sum` the length of the sum of their unit vectors:
/// a direction between them is a sum of both with shares that add up to at least 1, and at most 2/`sum`.
fn into_corner(falls: [f64; 2], sum: f64) -> f64 {
    let most = larger(falls[0], falls[1]);
    if most > 0.0 { most * 2.0 / sum } else { most }
}

fn plane_frame(normal: &Vector3<f64>, to_point: &Vector3<f64>, farthest: f64) -> PartFrame {
    let first = any_across(normal);
    let rotation = Matrix3::from_columns(&[first, normal.cross(&first), *normal]);
    PartFrame { rotation, centre: Vector3::new(0.0, 0.0, -normal.dot(to_point)), lengths: farthest }
}

/// The axes of a plane, of which the first is that of [`plane_frame`] to rounding.
fn plane_axes(normal: &Wide, rounded: &Vector3<f64>) -> [Wide; 3] {
    let first = wide_across(normal, &any_across(rounded));
    [first, normal.cross(&first), *normal]
}

/// At unit length; of an edge that is lost beside its distance, any direction is as good.
fn unit(v: &Vector3<f64>) -> Vector3<f64> {
    let scaled = v / v.amax();
    scaled.try_normalize(0.0).filter(|v| v.iter().all(|c| c.is_finite())).unwrap_or_else(Vector3::x)
}

fn wide_unit(v: &Wide) -> Wide {
    // In units of the largest component no square leaves the range of numbers.
    let largest = DoubleDouble::from(v.iter().fold(0.0, |largest: f64, c| largest.max(c.rounded().abs())));
    let scaled = v.map(|c| c / largest);
    let length = scaled.dot(&scaled).sqrt();
    scaled.map(|c| c / length)
}

/// The unit vector nearest to `near` at right angles to `n`.
fn wide_across(n: &Wide, near: &Vector3<f64>) -> Wide {
    let near = wide(near);
    wide_unit(&(near - n * near.dot(n)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_frames_agree_and_hold_the_part() {
        let [a, b, c] = [[0.3, -1.0, 0.2], [2.0, 0.7, -0.4], [-0.6, 0.8, 1.1]].map(Vector3::from);
        let normal = (b - a).cross(&(c - a)).normalize();
        let pose = Pose::new([0.4, 0.1, 0.9], [1.0, 0.2, -0.3, 0.5]).unwrap();
        let parts = [
            BoundaryPart::Plane { point: a, normal, given: normal },
            BoundaryPart::Inside { vertices: [a, b, c], normal, condition: 2.0 },
            BoundaryPart::Edge { ends: [a, b], third: c },
            BoundaryPart::Corner { at: c, others: [a, b] },
        ];
        for part in parts {
            let placed = PlacedPart::new(part, &pose);
            let (frame, WideFrame { axes, centre }) = (placed.frame, placed.wide_frame());
            assert!((frame.centre - rounded(centre)).norm() < 1e-15, "{part:?}");
            for (i, axis) in axes.iter().enumerate() {
                assert!((frame.rotation.column(i) - rounded(axis)).norm() < 1e-15, "{part:?}");
                let square = (axis.dot(axis) - DoubleDouble::from(1.0)).rounded();
                assert!(square.abs() < 16.0 * DoubleDouble::UNIT, "{part:?}");
            }
            // The first coordinates of the points that give the part are all that they have.
            let points: &[Vector3<f64>] = match &part {
                BoundaryPart::Plane { .. } => &[a],
                BoundaryPart::Inside { .. } => &[a, b, c],
                BoundaryPart::Edge { .. } => &[a, b],
                BoundaryPart::Corner { .. } => &[c],
            };
            for point in points {
                let x = frame.rotation.tr_mul(&(point - pose.position())) + frame.centre;
                assert!((part.dimensions()..3).all(|i| x[i].abs() < 4e-16), "{part:?}: {x}");
            }
        }
    }

    /// A function that falls along a vector in the plane falls into the triangle as far as that points into it.
    #[test]
    fn the_descent_is_that_into_the_triangle() {
        let [a, b, c] = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(Vector3::from);
        let pose = Pose::at([0.3, 0.2, 0.9]).unwrap();
        let edge = BoundaryPart::Edge { ends: [a, b], third: c };
        let corner = BoundaryPart::Corner { at: a, others: [b, c] };
        // Edge a-b: inwards is y. Corner a: the quarter between x and y, whose steepest is at most √2 times that of a
        // side.
        for (falls, of_edge, of_corner) in [
            ([0.3, -2.0, 5.0], -2.0, 0.3 * 2f64.sqrt()),
            ([-1.0, -2.0, 5.0], -2.0, -1.0),
            ([0.0, 1.0, -5.0], 1.0, 2f64.sqrt()),
        ] {
            for (part, expected) in [(edge, of_edge), (corner, of_corner)] {
                let placed = PlacedPart::new(part, &pose);
                let gradient = placed.frame.rotation.tr_mul(&-Vector3::from(falls));
                let (quick, precise) = (placed.descent(&gradient), placed.wide_descent(&wide(&gradient)));
                assert!((quick.unwrap() - expected).abs() < 1e-14, "{part:?}, {falls:?}: {quick:?}");
                assert!((precise.unwrap() - expected).abs() < 1e-14, "{part:?}, {falls:?}: {precise:?}");
            }
        }
    }
}
