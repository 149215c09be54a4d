//! A cell on a ray: the stretch on which the active planes do not change.
//!
//! In the half-plane of the ray, with h along it and k upwards, both from the start of the cell, S_A and D = S_A − S_B
//! are quadratics. The patch is the curve D = 0 on the branch where D rises with k.

use super::field::Owner;
use super::numbers::{BEYOND_RIM, FARTHEST_RIM, SPREAD, TINY_STEP};
use crate::linalg::root::MOST_STEPS;

/// v + h·H + k·K + hh·H² + hk·H·K + kk·K², and its derivative p + ph·H + pk·K across the half-plane.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Quadratic {
    pub v: f64,
    pub h: f64,
    pub k: f64,
    pub hh: f64,
    pub hk: f64,
    pub kk: f64,
    pub p: f64,
    pub ph: f64,
    pub pk: f64,
}

impl Quadratic {
    /// Adds w·⟨plane⟩² of an active plane.
    #[inline(always)]
    pub fn add(&mut self, w: f64, plane: &RayPlane) {
        let RayPlane { excess, along, up, across, .. } = *plane;
        let w2 = 2.0 * w;
        self.v += w * excess * excess;
        self.h += w2 * excess * along;
        self.k += w2 * excess * up;
        self.hh += w * along * along;
        self.hk += w2 * along * up;
        self.kk += w * up * up;
        self.p += w2 * excess * across;
        self.ph += w2 * along * across;
        self.pk += w2 * up * across;
    }

    /// Adds m·|y|², y in the axes of the ray.
    #[inline(always)]
    pub fn add_sphere(&mut self, m: f64, y: &[f64; 3]) {
        self.v += m * (y[0] * y[0] + y[1] * y[1] + y[2] * y[2]);
        self.h += 2.0 * m * y[0];
        self.p += 2.0 * m * y[1];
        self.k += 2.0 * m * y[2];
        self.hh += m;
        self.kk += m;
    }

    pub fn minus(&self, other: &Self) -> Self {
        Self {
            v: self.v - other.v,
            h: self.h - other.h,
            k: self.k - other.k,
            hh: self.hh - other.hh,
            hk: self.hk - other.hk,
            kk: self.kk - other.kk,
            p: self.p - other.p,
            ph: self.ph - other.ph,
            pk: self.pk - other.pk,
        }
    }

    #[inline(always)]
    pub fn value(&self, h: f64, k: f64) -> f64 {
        self.v + h * (self.h + self.hh * h + self.hk * k) + k * (self.k + self.kk * k)
    }

    #[inline(always)]
    pub fn by_h(&self, h: f64, k: f64) -> f64 {
        self.h + 2.0 * self.hh * h + self.hk * k
    }

    #[inline(always)]
    pub fn by_k(&self, h: f64, k: f64) -> f64 {
        self.k + self.hk * h + 2.0 * self.kk * k
    }

    #[inline(always)]
    pub fn across(&self, h: f64, k: f64) -> f64 {
        self.p + self.ph * h + self.pk * k
    }
}

/// A plane on a ray: its excess at the start of the cell, and how it changes along the ray, along z and across both.
#[derive(Clone, Copy, Debug)]
pub(super) struct RayPlane {
    pub at_origin: f64,
    pub excess: f64,
    pub along: f64,
    pub up: f64,
    pub across: f64,
    pub active: bool,
    pub owner: Owner,
}

/// Both quadratics of a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    pub s: Quadratic,
    pub d: Quadratic,
    /// Whether the pressure is linear and the patch flat: one plane of each body and no sphere.
    pub is_flat: bool,
    /// The incline of a flat patch along the ray.
    pub flat_incline: f64,
}

/// A triangle around the conic arc of the patch in a cell. Up to where it turns back the arc is convex or concave, and
/// lies between its tangent at the start and its chord: the corners are the start (0, 0), the point of the tangent at h
/// and the point of the arc at h.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoundingTriangle {
    h: f64,
    on_tangent: f64,
    on_patch: f64,
}

impl BoundingTriangle {
    /// Whether a plane may go on or off: not where its excess, which is linear, has one sign at all corners.
    #[inline(always)]
    pub fn may_cross(&self, plane: &RayPlane) -> bool {
        let ahead = plane.excess + plane.along * self.h;
        let corners = [plane.excess, ahead + plane.up * self.on_tangent, ahead + plane.up * self.on_patch];
        !corners.iter().all(|excess| if plane.active { *excess > 0.0 } else { *excess < 0.0 })
    }

    /// The triangle that ends at a nearer point of the arc.
    #[inline(always)]
    pub fn cut_at(&self, h: f64, k: f64) -> Self {
        if h > 0.0 && h < self.h { Self { h, on_tangent: self.on_tangent / self.h * h, on_patch: k } } else { *self }
    }
}

impl Cell {
    /// The height of the patch at h, and the slope of D along z there. `None` where the curve has turned back.
    #[inline(always)]
    pub fn height(&self, h: f64) -> Option<(f64, f64)> {
        let d = &self.d;
        if self.is_flat {
            let k = self.flat_incline * h;
            return Some((k, d.by_k(h, k)));
        }
        let slope = d.k + d.hk * h;
        let value = d.v + h * (d.h + d.hh * h);
        let discriminant = slope * slope - 4.0 * d.kk * value;
        if !(discriminant > 0.0) {
            return None;
        }
        let root = discriminant.sqrt();
        let k = if slope > 0.0 { -2.0 * value / (slope + root) } else { (root - slope) / (2.0 * d.kk) };
        k.is_finite().then_some((k, root))
    }

    /// The first h > 0 where the curve turns back: the discriminant of its height is 0 there. Infinite where it goes
    /// on.
    pub fn turn(&self) -> f64 {
        let d = &self.d;
        let a = d.hk * d.hk - 4.0 * d.kk * d.hh;
        let b = 2.0 * d.k * d.hk - 4.0 * d.kk * d.h;
        let c = d.k * d.k - 4.0 * d.kk * d.v;
        if self.is_flat || (a >= 0.0 && b >= 0.0) {
            return f64::INFINITY;
        }
        let inner = b * b - 4.0 * a * c;
        if !(inner >= 0.0) {
            return f64::INFINITY;
        }
        let q = -0.5 * (b + inner.sqrt().copysign(b));
        [c / q, q / a].into_iter().filter(|h| *h > 0.0).fold(f64::INFINITY, f64::min)
    }

    /// How fast the height changes along the ray.
    #[inline(always)]
    pub fn incline(&self, h: f64, k: f64) -> f64 {
        -self.d.by_h(h, k) / self.d.by_k(h, k)
    }

    /// The last place before h where the curve, which turns back there or nearly, is inclined by less than 45°.
    pub fn half_turned(&self, h: f64) -> (f64, f64) {
        let (mut gentle, mut steep) = ((0.0, 0.0), h);
        for _ in 0..30 {
            let middle = 0.5 * (gentle.0 + steep);
            match self.height(middle) {
                Some((k, _)) if self.incline(middle, k).abs() < 1.0 => gentle = (middle, k),
                _ => steep = middle,
            }
        }
        gentle
    }

    /// The first place on the way to h where a function of the place is no longer positive.
    pub fn zero_of(&self, h: f64, value: impl Fn(f64, f64) -> f64) -> (f64, f64) {
        let (mut before, mut behind) = ((0.0, 0.0), h);
        for _ in 0..60 {
            let middle = 0.5 * (before.0 + behind);
            match self.height(middle) {
                Some((k, _)) if value(middle, k) > 0.0 => before = (middle, k),
                _ => behind = middle,
            }
        }
        before
    }

    /// The first h > 0, but for rounding, where a plane goes on or off, and the height there; no point of the patch is
    /// farther than `radius` from the start of the walk.
    #[inline(always)]
    pub fn crossing(&self, plane: &RayPlane, radius: f64) -> Option<(f64, f64)> {
        let RayPlane { excess: e, along, up, active, .. } = *plane;
        let tiny = TINY_STEP * radius;
        if self.is_flat {
            let rate = along + up * self.flat_incline;
            let h = -e / rate;
            let turns = if active { rate < 0.0 } else { rate > 0.0 };
            return (turns && h > -tiny && h.is_finite()).then_some((h, self.flat_incline * h));
        }
        let d = &self.d;
        let square = along * along + up * up;
        // Nothing is met farther off than the bodies' size. For a plane parallel to the half-plane to rounding, what
        // follows gives any number.
        if !(e * e <= SPREAD * SPREAD * radius * radius * square) {
            return None;
        }
        // The line of the plane: its point nearest to the start, and t along (up, −along).
        let foot = -e / square;
        let (h0, k0) = (foot * along, foot * up);
        let c = d.value(h0, k0);
        let b = up * d.by_h(h0, k0) - along * d.by_k(h0, k0);
        let a = d.hh * up * up - d.hk * along * up + d.kk * along * along;
        let discriminant = b * b - 4.0 * a * c;
        if !(discriminant >= 0.0) {
            return None;
        }
        let q = -0.5 * (b + discriminant.sqrt().copysign(b));
        let mut first: Option<(f64, f64)> = None;
        for t in [c / q, q / a] {
            let (h, k) = (h0 + t * up, k0 - t * along);
            if !(h > -tiny && h.is_finite() && first.is_none_or(|(other, _)| h < other)) {
                continue;
            }
            let slope = d.by_k(h, k);
            // On the branch, and in the direction in which the plane goes on or off.
            let rate = along * slope - up * d.by_h(h, k);
            if slope > 0.0 && if active { rate < 0.0 } else { rate > 0.0 } {
                first = Some((h, k));
            }
        }
        first
    }

    /// Inverse distance to a plane, extrapolated from its excess and rate at the start of the cell.
    pub fn linear_inverse(&self, plane: &RayPlane) -> f64 {
        -(plane.along + plane.up * self.incline(0.0, 0.0)) / plane.excess
    }

    /// Around the arc from the start to beyond the rim. `None` where the patch is flat, for which it saves nothing, or
    /// where the estimated rim is too near or beyond the turn.
    pub fn bounding_triangle(&self, turn: f64) -> Option<BoundingTriangle> {
        if self.is_flat {
            return None;
        }
        let h = BEYOND_RIM * self.estimated_rim();
        if !(h > 0.0 && h <= turn) {
            return None;
        }
        let (k, _) = self.height(h)?;
        let on_tangent = self.incline(0.0, 0.0) * h;
        (self.s.value(h, k) >= 1.0).then_some(BoundingTriangle { h, on_tangent, on_patch: k })
    }

    /// The h at which the Taylor series of S along the patch, to second order in h, is 1.
    fn estimated_rim(&self) -> f64 {
        let (s, d) = (&self.s, &self.d);
        let incline = self.incline(0.0, 0.0);
        let slope = s.h + s.k * incline;
        let bend = -2.0 * (d.hh + incline * (d.hk + d.kk * incline)) / d.by_k(0.0, 0.0);
        let half_curvature = s.hh + incline * (s.hk + s.kk * incline) + 0.5 * s.k * bend;
        let value = s.v - 1.0;
        -2.0 * value / (slope + (slope * slope - 4.0 * half_curvature * value).sqrt())
    }

    /// The h up to `limit` where s = 1 on the patch; or, as an error, where the curve turns back before.
    pub fn rim(&self, limit: f64, farthest: f64) -> Result<f64, f64> {
        let (s, d) = (&self.s, &self.d);
        if self.is_flat {
            // s is linear.
            let scale = s.v.sqrt();
            let h = 2.0 * scale * (1.0 - scale) / (s.h + s.k * self.flat_incline);
            return Ok(
                if h > 0.0 { h.min(2.0 * FARTHEST_RIM * farthest) } else { 2.0 * FARTHEST_RIM * farthest }.min(limit)
            );
        }
        let (mut inside, mut outside) = (0.0, limit);
        let mut h = self.estimated_rim();
        if !(h > 0.0 && h <= limit && h.is_finite()) {
            h = if limit.is_finite() { limit } else { farthest };
        }
        let mut turned = None;
        for _ in 0..MOST_STEPS {
            let Some((k, rise)) = self.height(h) else {
                // Beyond the turn of the curve.
                turned = Some(h);
                outside = h;
                h = 0.5 * (inside + outside);
                if outside - inside <= 1e-9 * outside {
                    break;
                }
                continue;
            };
            let scale = s.value(h, k).max(0.0).sqrt();
            let off = scale - 1.0;
            if off < 0.0 {
                inside = h
            } else {
                (outside, turned) = (h, None)
            }
            let rate = (s.by_h(h, k) - s.by_k(h, k) * d.by_h(h, k) / rise) / (2.0 * scale);
            let mut next = h - off / rate;
            if !(next >= inside && next <= outside && next.is_finite()) {
                next = if outside.is_finite() { 0.5 * (inside + outside) } else { 2.0 * h.max(farthest) };
            }
            if inside > FARTHEST_RIM * farthest {
                // Not among the planes that are loaded.
                return Ok(inside);
            }
            if (next - h).abs() <= 1e-13 * h || off.abs() <= 2.0 * f64::EPSILON {
                return Ok(next);
            }
            h = next;
        }
        if turned.is_some() { Err(inside) } else { Ok(h) }
    }
}
