//! The conic that a boundary follows from a point on, until a plane becomes active or inactive.

use super::arc::Arc;
use nalgebra::Vector2;

/// A conic through `base`: S − 1 = 2·q·h + hᵀMh at base + h, with q half the gradient at the base.
///
/// M is held in the frame of the stiffest direction: along a stiff edge and across it its entries are 16 and more
/// decades apart where r = 1e-8 of the size, and in another frame the small one would be lost to rounding.
#[derive(Clone, Copy, Debug)]
pub(super) struct EdgeCurve {
    pub base: Vector2<f64>,
    pub half_gradient: Vector2<f64>,
    /// Unit vector u of the frame; v is u turned counter-clockwise.
    pub stiff: Vector2<f64>,
    pub uu: f64,
    pub uv: f64,
    pub vv: f64,
    /// Rounding of the half gradient at right angles to it, in units of ε.
    pub tilt: f64,
}

impl EdgeCurve {
    /// det M, 1/length⁴; 0 for a straight edge.
    pub fn determinant(&self) -> f64 {
        (self.uu * self.vv - self.uv * self.uv).max(0.0)
    }

    /// From the base towards the centre of the conic, times det M: −adj(M)·q.
    pub fn inwards(&self) -> Vector2<f64> {
        let v = quarter_turn(&self.stiff);
        let (qu, qv) = (self.half_gradient.dot(&self.stiff), self.half_gradient.dot(&v));
        (self.uv * qv - self.vv * qu) * self.stiff + (self.uv * qu - self.uu * qv) * v
    }

    /// The counter-clockwise arc from the base to the parameter τ > 0: its end is
    /// base + 2(τ·Jq − τ²·adj(M)·q)/(1 + τ²·det M), J a quarter turn, and τ√det M the tangent of half its angle on the
    /// circle that the conic is an affine image of. A straight edge needs no case of its own.
    ///
    /// Also returns the step from its beginning to its end, which may be smaller than the rounding of both.
    pub fn arc(&self, tau: f64) -> (Arc, Vector2<f64>) {
        let tangent = tau * quarter_turn(&self.half_gradient);
        let secant = 1.0 + tau * tau * self.determinant();
        let step = 2.0 / secant * (tangent + tau * tau * self.inwards());
        let arc = Arc { from: self.base, pole: self.base + tangent, to: self.base + step, weight: 1.0 / secant.sqrt() };
        (arc, step)
    }

    /// Estimated rounding of S at the end of such an arc, in units of ε, to first order: of both ends, of the direction
    /// of the tangent at the base, and of the end along the soft direction.
    ///
    /// `length`: distances of both ends from the origin, added up.
    pub fn rounding(&self, tau: f64, arc: &Arc, end_gradient: &Vector2<f64>, length: f64) -> f64 {
        let half_gradient = self.half_gradient.norm() + self.tilt;
        let soft = end_gradient.dot(&quarter_turn(&self.stiff)).abs();
        let slide = tau * tau * self.uu * arc.weight * arc.weight;
        2.0 * (half_gradient + end_gradient.norm()) * length + 4.0 * half_gradient * slide * soft
    }

    /// The polar form of (S − 1)/2 for two points; for twice the same point (S − 1)/2 itself.
    pub fn polar(&self, p: &Vector2<f64>, p2: &Vector2<f64>) -> f64 {
        let (h, h2) = (p - self.base, p2 - self.base);
        let v = quarter_turn(&self.stiff);
        let (hu, hv) = (h.dot(&self.stiff), h.dot(&v));
        let (hu2, hv2) = (h2.dot(&self.stiff), h2.dot(&v));
        let form = self.uu * hu * hu2 + self.uv * (hu * hv2 + hv * hu2) + self.vv * hv * hv2;
        0.5 * (self.half_gradient.dot(&(h + h2)) + form)
    }
}

/// Counter-clockwise.
pub(super) fn quarter_turn(vector: &Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-vector.y, vector.x)
}
