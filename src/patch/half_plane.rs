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

/// How far the axes of a walk are turned from upright: it follows the patch around where that turns back under itself.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tilt {
    pub cos: f64,
    pub sin: f64,
}

impl Tilt {
    pub const UPRIGHT: Self = Self { cos: 1.0, sin: 0.0 };

    /// Turned on to a direction with this incline; and the cosine and sine of that turn.
    pub fn onwards(&self, incline: f64) -> (Self, [f64; 2]) {
        let length = incline.hypot(1.0);
        let [c, s] = [1.0 / length, incline / length];
        (Self { cos: c * self.cos - s * self.sin, sin: s * self.cos + c * self.sin }, [c, s])
    }

    pub fn is_upright(&self) -> bool {
        self.sin == 0.0 && self.cos > 0.0
    }

    /// Distance of a place of the turned half-plane from the upright axis through its origin, and height above that.
    #[inline(always)]
    pub fn upright(&self, rho: f64, zeta: f64) -> [f64; 2] {
        [self.cos * rho - self.sin * zeta, self.sin * rho + self.cos * zeta]
    }
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

    /// This half plane with both axes reversed.
    pub fn backwards(&self) -> Self {
        Self { along: self.along.map(|x| -x), across: self.across.map(|x| -x), ..*self }
    }

    /// This half plane with its axes turned in it.
    pub fn turned(&self, [c, s]: [f64; 2]) -> Self {
        let mix = |a: f64, x: &[f64; 3], b: f64, y: &[f64; 3]| std::array::from_fn(|i| a * x[i] + b * y[i]);
        Self { along: mix(c, &self.along, s, &self.up), up: mix(c, &self.up, -s, &self.along), ..*self }
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
