//! A plane or a triangle as a particle sees it, in 32 digits.

use crate::pair_line::Place;
use crate::wide::{Wide, Wide3};
use nalgebra::Vector3;

/// A plane or a triangle as given, world frame.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Boundary {
    Plane { point: [f64; 3], normal: [f64; 3] },
    Triangle([[f64; 3]; 3]),
}

/// The part of a boundary on which a point lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    Inside,
    Edge(usize),
    Vertex(usize),
}

pub type Wide2 = [Wide; 2];

pub fn dot(a: &Wide2, b: &Wide2) -> Wide {
    a[0] * b[0] + a[1] * b[1]
}

pub fn cross(a: &Wide2, b: &Wide2) -> Wide {
    a[0] * b[1] - a[1] * b[0]
}

pub fn along(from: &Wide2, share: Wide, step: &Wide2) -> Wide2 {
    [from[0] + share * step[0], from[1] + share * step[1]]
}

pub fn length(v: &Wide2) -> f64 {
    v[0].f64().hypot(v[1].f64())
}

fn cross3(a: &Wide3, b: &Wide3) -> Wide3 {
    let ([a, b, c], [d, e, f]) = (a.0, b.0);
    Wide3([b * f - c * e, c * d - a * f, a * e - b * d])
}

fn unit(v: &Wide3) -> Wide3 {
    v.times(Wide::ONE / v.norm())
}

/// The boundary's plane in the frame of a particle.
pub struct Plane {
    /// Rows of the rotation, local to world.
    pub rotation: [Wide3; 3],
    /// Unit vectors of the plane and its normal, local frame.
    pub axes: [Wide3; 2],
    pub normal: Wide3,
    /// Distance of the plane from the centre along the normal.
    pub height: Wide,
    /// Of a triangle.
    pub corners: Option<[Wide2; 3]>,
    /// Distance of the farthest point that gives it, times what its sides make of their rounding.
    pub farthest: f64,
}

impl Plane {
    pub fn new(boundary: &Boundary, at: &Place) -> Self {
        Self::with_axis(boundary, at, None)
    }

    /// With its first axis along edge i of a triangle, and its height that of the edge: however the sides of a narrow
    /// triangle turn the plane, the edge stays where it is.
    pub fn along_edge(boundary: &Boundary, at: &Place, i: usize) -> Self {
        Self::with_axis(boundary, at, Some(i))
    }

    fn with_axis(boundary: &Boundary, at: &Place, edge: Option<usize>) -> Self {
        let rotation = at.rows();
        let columns = [0, 1, 2].map(|j| Wide3([0, 1, 2].map(|i| rotation[i].0[j])));
        let local = |v: &Wide3| Wide3([0, 1, 2].map(|j| columns[j].dot(v)));
        let from_centre = |p: &[f64; 3]| local(&Wide3([0, 1, 2].map(|i| Wide::difference(p[i], at.position[i]))));
        let (normal, point, vertices, condition, along) = match boundary {
            Boundary::Plane { point, normal } => {
                (unit(&local(&Wide3(normal.map(Wide::from)))), from_centre(point), None, 1.0, None)
            }
            Boundary::Triangle(vertices) => {
                let from = vertices.map(|v| from_centre(&v));
                let side = |i: usize| from[(i + 2) % 3].minus(&from[(i + 1) % 3]).norm().f64();
                let base = (0..3).fold(0, |longest, i| if side(i) > side(longest) { i } else { longest });
                let (next, last) = ((base + 1) % 3, (base + 2) % 3);
                // Their differences have no rounding in world axes.
                let between = |from: usize, to: usize| {
                    local(&Wide3([0, 1, 2].map(|c| Wide::difference(vertices[to][c], vertices[from][c]))))
                };
                let across = cross3(&unit(&between(base, next)), &unit(&between(base, last)));
                let condition = 1.0 / across.norm().f64();
                let along = edge.map(|i| unit(&between(i, (i + 1) % 3)));
                let normal = along.as_ref().map_or(unit(&across), |e| {
                    let n = unit(&across);
                    unit(&n.minus(&e.times(n.dot(e))))
                });
                (normal, from[edge.unwrap_or(base)], Some(from), condition, along)
            }
        };
        let plain = normal.f64();
        let first = along.unwrap_or_else(|| unit(&cross3(&normal, &Wide3::from(Vector3::ith(plain.iamin(), 1.0)))));
        let axes = [first, cross3(&normal, &first)];
        let given = vertices.map_or(vec![point], |at| at.to_vec());
        Self {
            rotation,
            axes,
            normal,
            height: normal.dot(&point),
            corners: vertices.map(|at| at.map(|v| [axes[0].dot(&v), axes[1].dot(&v)])),
            farthest: condition * given.iter().map(|v| v.norm().f64()).fold(0.0, f64::max),
        }
    }

    pub fn local(&self, y: &Wide2) -> Wide3 {
        self.normal.times(self.height).plus(&self.axes[0].times(y[0])).plus(&self.axes[1].times(y[1]))
    }

    pub fn world(&self, v: &Wide3) -> Wide3 {
        Wide3([0, 1, 2].map(|i| self.rotation[i].dot(v)))
    }
}

/// Vectors of a triangle in its plane: edge i as unit vector, its length, and the unit vector inwards.
pub struct Edge {
    pub along: Wide2,
    pub length: Wide,
    pub inwards: Wide2,
}

pub fn edges(corners: &[Wide2; 3]) -> [Edge; 3] {
    [0, 1, 2].map(|i| {
        let (from, to, third) = (corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]);
        let whole = [to[0] - from[0], to[1] - from[1]];
        let most = Wide::from(length(&whole));
        let scaled = whole.map(|c| c / most);
        let size = dot(&scaled, &scaled).sqrt();
        let along = scaled.map(|c| c / size);
        let across = [-along[1], along[0]];
        let inside = dot(&across, &[third[0] - from[0], third[1] - from[1]]).f64() > 0.0;
        Edge { along, length: size * most, inwards: if inside { across } else { across.map(|c| -c) } }
    })
}

/// A point beside a boundary, relative to the particle's centre in world axes.
pub struct Beside {
    /// Distance from the nearest point of the boundary, and from that of the part that is named.
    pub boundary: f64,
    pub part: f64,
    /// Unit normal of the plane, world axes.
    pub normal: Vector3<f64>,
    /// Distance of the farthest point that gives the boundary.
    pub farthest: f64,
}

pub fn beside(boundary: &Boundary, at: &Place, x: &Vector3<f64>, part: Part) -> Beside {
    let plane = Plane::new(boundary, at);
    let columns = [0, 1, 2].map(|j| Wide3([0, 1, 2].map(|i| plane.rotation[i].0[j])));
    let x = Wide3::from(*x);
    let local = Wide3([0, 1, 2].map(|j| columns[j].dot(&x)));
    let y = [plane.axes[0].dot(&local), plane.axes[1].dot(&local)];
    let off = (plane.normal.dot(&local) - plane.height).f64().abs();
    let (mut aside, mut of_part) = (0.0_f64, 0.0_f64);
    if let Some(corners) = &plane.corners {
        let edges = edges(corners);
        let from = |i: usize| [y[0] - corners[i][0], y[1] - corners[i][1]];
        let to_edge = |i: usize| {
            let t = dot(&from(i), &edges[i].along);
            let t = Wide::from(t.f64().clamp(0.0, edges[i].length.f64()));
            length(&along(&from(i), -t, &edges[i].along))
        };
        if (0..3).any(|i| dot(&from(i), &edges[i].inwards).f64() < 0.0) {
            aside = (0..3).map(to_edge).fold(f64::INFINITY, f64::min);
        }
        of_part = match part {
            Part::Inside => aside,
            Part::Edge(i) => to_edge(i),
            Part::Vertex(i) => length(&from(i)),
        };
    }
    Beside {
        boundary: off.hypot(aside),
        part: off.hypot(of_part),
        normal: plane.world(&plane.normal).f64(),
        farthest: plane.farthest,
    }
}
