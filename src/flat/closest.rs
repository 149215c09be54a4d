//! The point of a boundary where S is least, and the bound on the error of s there.

use super::boundary::Feature;
use super::minimum::Minimum;
use super::placed::{Corners, Edge, Placed};
use super::search::{Found, Freedom, minimise};
use crate::bounds::scale::Scale;
use crate::linalg::number::{larger, smaller};
use crate::pair::body::{Body, shift_in_a};
use crate::pair::separation::MARGIN;
use crate::particle::particle::Particle;
use nalgebra::Vector3;

/// What is asked of every search of a call.
#[derive(Clone, Copy, Debug)]
pub(super) struct Goal<'a> {
    pub particle: &'a Particle,
    /// As in `Settings`.
    pub least_sphericity: f64,
    pub tolerance: f64,
}

/// The least S on a boundary.
#[derive(Clone, Copy, Debug)]
pub(super) struct Closest {
    pub minimum: Minimum,
    pub feature: Feature,
    /// How steeply S may descend into the boundary from there, in doubt.
    descent: f64,
    /// Lower bound of S on the whole boundary up to `minimum.rounding`.
    pub lower: f64,
    /// Whether the search settled; if not, the bounds say how much is known.
    pub settled: bool,
    pub models: u32,
}

impl Goal<'_> {
    /// The particle as it is solved for.
    pub fn body(&self) -> Body<'_> {
        Body::alone(self.particle, self.least_sphericity)
    }

    /// The point of the boundary where S is least; `None` if something is not finite.
    pub fn closest(&self, boundary: &Placed) -> Option<Closest> {
        let body = self.body();
        let freedom = Freedom::Plane(boundary.normal);
        let found = minimise(&body, &freedom, &boundary.nearest(), self.tolerance)?.displaced(boundary.farthest);
        let in_plane = Closest::on(&body, boundary, &found, Feature::Interior);
        let Some(corners) = &boundary.corners else { return Some(in_plane) };
        let x = found.minimum.x;
        let (mut least, mut models): (Option<Closest>, _) = (None, found.models);
        // The least S on a triangle is in its plane's, or on an edge beyond which that lies.
        for i in (0..3).filter(|i| corners.edges[*i].is_passed_by(&x)) {
            let (found, feature) = self.on_edge(&body, corners, i)?;
            models += found.models;
            if least.is_none_or(|least| found.minimum.value < least.minimum.value) {
                least = Some(Closest::on(&body, boundary, &found, feature));
            }
        }
        let found = least.unwrap_or(in_plane);
        // No point of the triangle is below the least of its plane.
        let lower = larger(found.lower, in_plane.lower - in_plane.minimum.rounding);
        Some(Closest { lower, models, ..found })
    }

    /// The least S on edge i, from the edge alone: triangles that share it find the same.
    fn on_edge(&self, body: &Body, corners: &Corners, i: usize) -> Option<(Found, Feature)> {
        let edge = &corners.edges[i];
        let found = minimise(body, &Freedom::Line(edge.along), &edge.nearest(), self.tolerance)?;
        Some(match beyond(edge, &found.minimum.x) {
            None => (found.displaced(edge.farthest(corners)), Feature::Edge(i as u8)),
            Some(vertex) => {
                let at = &corners.at[vertex];
                let found = Found { minimum: Minimum::at(body, at), models: found.models + 1, ..found };
                (found.displaced(at.norm()), Feature::Vertex(vertex as u8))
            }
        })
    }
}

impl Found {
    /// With the rounding of a place that is given by points so far from the centre.
    fn displaced(self, farthest: f64) -> Self {
        let by = shift_in_a(self.minimum.x.norm(), farthest);
        Self { minimum: self.minimum.displaced(by), ..self }
    }
}

/// The vertex beyond which a point of the line of an edge lies.
fn beyond(edge: &Edge, x: &Vector3<f64>) -> Option<usize> {
    let way = (x - edge.from).dot(&edge.along);
    if way < 0.0 {
        Some(edge.ends[0])
    } else if way > edge.length {
        Some(edge.ends[1])
    } else {
        None
    }
}

impl Closest {
    /// A minimum on a part of the boundary, seen as that of the whole.
    fn on(body: &Body, boundary: &Placed, found: &Found, feature: Feature) -> Self {
        let Found { minimum, settled, models } = *found;
        let descent = descent(boundary, &minimum.gradient, feature) + minimum.slope;
        let found = Self { minimum, feature, descent, lower: f64::NEG_INFINITY, settled, models };
        Self { lower: minimum.value - minimum.height(body, descent, found.within(body, boundary)), ..found }
    }

    /// s of the regularised particle, with bounds of that of the given one.
    ///
    /// Where a flat face lies on several triangles, or a core of k = 0 reaches through them, the regularisation alone tells which of
    /// them is nearest to the centre: it stays part of s, and of the gap.
    pub fn scale(&self, body: &Body) -> Scale {
        let minimum = &self.minimum;
        let most = body.most_surplus(larger(minimum.value, 1.0));
        Scale::between(minimum.value, self.lower - most - minimum.rounding, minimum.value + minimum.rounding)
    }

    /// Estimated bound on the distance of the point to the minimum: from the answer of that to its data, or since S, regularised,
    /// rises at least as the square of the way times the least curvature, or from where it can be at all.
    pub fn point_bound(&self, body: &Body, boundary: &Placed) -> f64 {
        let minimum = &self.minimum;
        let open = larger(minimum.value - self.lower, 0.0) + 2.0 * minimum.rounding;
        let by_convexity = 2.0 * (2.0 * open / body.sphere_curvature()).sqrt();
        smaller(smaller(minimum.way, by_convexity), self.within(body, boundary))
    }

    /// Lower bound of the distance of particle and boundary, from the tangent of s at the point, which lies below s everywhere.
    ///
    /// In the particle the tangent is at most 1, or what the regularisation makes of that; on the boundary it is at least s but for
    /// what is in doubt; and it rises by no more than its slope. The point of the boundary nearest to the particle is no farther
    /// from the centre than this one and the radius of the particle together.
    pub fn distance(&self, body: &Body, boundary: &Placed) -> f64 {
        let Minimum { x, value, gradient, rounding, .. } = &self.minimum;
        let within = smaller(2.0 * (body.particle.bounding_radius() + x.norm()), boundary.extent(x));
        let most = (*value * (1.0 + body.most_surplus(1.0))).sqrt();
        let above = 2.0 * (value - most) - self.descent * within - rounding;
        larger(above / (gradient.norm() + self.descent) * (1.0 - MARGIN), 0.0)
    }

    /// Bound on the way to any point of the boundary where S is no larger.
    fn within(&self, body: &Body, boundary: &Placed) -> f64 {
        let level = larger(self.minimum.value, 1.0);
        smaller(self.minimum.farthest(body, level), boundary.extent(&self.minimum.x))
    }
}

/// How steeply S descends at most into the boundary, away from a minimum on this part of it: 0 but for rounding if it is that
/// of the whole.
fn descent(boundary: &Placed, gradient: &Vector3<f64>, feature: Feature) -> f64 {
    let across = gradient - gradient.dot(&boundary.normal) * boundary.normal;
    let Some(corners) = &boundary.corners else { return across.norm() };
    match feature {
        Feature::Interior => across.norm(),
        Feature::Edge(i) => {
            let edge = &corners.edges[usize::from(i)];
            gradient.dot(&edge.along).hypot(gradient.dot(&edge.inwards).min(0.0))
        }
        Feature::Vertex(i) => into_corner(corners, usize::from(i), &across),
    }
}

/// The same at a vertex: steepest along the negative gradient if that points into the triangle, else along one of its sides.
fn into_corner(corners: &Corners, i: usize, across: &Vector3<f64>) -> f64 {
    let [left, right] = [(i + 1) % 3, (i + 2) % 3].map(|j| corners.at[j] - corners.at[i]);
    let along = |side: &Vector3<f64>| -across.dot(side) / side.norm();
    let turn = left.cross(&right);
    let inside = left.cross(across).dot(&turn) <= 0.0 && across.cross(&right).dot(&turn) <= 0.0;
    if inside { across.norm() } else { along(&left).max(along(&right)).max(0.0) }
}
