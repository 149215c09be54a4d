//! The half-plane of a walk over the patch: upright over a ray, or a plane of a body along the border where it goes on.

use super::cell::Quadratic;
use super::field::{Placed, dot};

/// An origin and orthonormal axes: along the walk, across the half-plane, and upwards in it.
#[derive(Clone, Copy, Debug)]
pub(super) struct HalfPlane {
    pub origin: [f64; 3],
    pub along: [f64; 3],
    pub across: [f64; 3],
    pub up: [f64; 3],
}

impl HalfPlane {
    /// Over a ray of the frame's plane; `direction`: a unit vector.
    pub fn upright(origin: [f64; 3], [e, f]: [f64; 2]) -> Self {
        Self { origin, along: [e, f, 0.0], across: [-f, e, 0.0], up: [0.0, 0.0, 1.0] }
    }

    /// In a plane with this normal; `None` where it lies across z.
    pub fn within(origin: [f64; 3], normal: &[f64; 3]) -> Option<Self> {
        let length = dot(normal, normal).sqrt();
        let [a, b, c] = normal.map(|x| x / length);
        let run = (a * a + b * b).sqrt();
        let along = [b / run, -a / run, 0.0];
        let up = [-a * c / run, -b * c / run, run];
        along.iter().chain(&up).all(|x| x.is_finite()).then_some(Self { origin, along, across: [a, b, c], up })
    }

    /// The same the other way.
    pub fn backwards(&self) -> Self {
        Self { along: self.along.map(|x| -x), across: self.across.map(|x| -x), ..*self }
    }

    /// A point of it in the frame.
    pub fn at(&self, rho: f64, zeta: f64) -> [f64; 3] {
        std::array::from_fn(|i| self.origin[i] + rho * self.along[i] + zeta * self.up[i])
    }

    /// From the centre of a body to a point of the half-plane, along its axes.
    #[inline(always)]
    pub fn from_centre(&self, body: &Placed, rho: f64, zeta: f64) -> [f64; 3] {
        let from: [f64; 3] = std::array::from_fn(|i| body.from_centre[i] + self.origin[i]);
        [dot(&from, &self.along) + rho, dot(&from, &self.across), dot(&from, &self.up) + zeta]
    }

    /// The height above the plane of the frame, on which the walk started: D of a rigid boundary.
    pub fn height(&self, rho: f64, zeta: f64) -> Quadratic {
        let v = rho * self.along[2] + zeta * self.up[2];
        Quadratic { v, h: self.along[2], k: self.up[2], p: self.across[2], ..Quadratic::default() }
    }
}
