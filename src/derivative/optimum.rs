//! How an optimum moves with the potentials, forward and reverse.
//!
//! All vectors are in the axes of the optimum: two directions across the normal and the normal. Motions of a body are those at the optimum:
//! three columns of the velocity of its point there and three of its turn.

use super::answer::{DerivativeError, DerivativeFlags};
use super::field::{Field, Place};
use crate::linalg::graded_basis::any_across;
use crate::linalg::symmetric::Symmetric;
use nalgebra::{Matrix2, Matrix2x3, Matrix2x6, Matrix3, Matrix3x6, Vector2, Vector3};

/// What an optimum is one of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// S_A = S_B.
    Midway,
    /// S_A = 1, least S_B: P1.
    OnA,
    /// S_B = 1, least S_A: P2.
    OnB,
    /// Least S_A on a part of a boundary on which a point has so many coordinates, along the first axes.
    OnBoundary(usize),
}

/// Where the least curvature across the normal is below this share of the sum, the axes are aligned with the curvatures, so that it keeps its digits.
const GRADED: f64 = 1e-4;

/// An optimum with its linearised optimality conditions.
pub(super) struct Optimum<'a> {
    /// The bodies at this point; none in place of a boundary.
    pub places: [Option<Place<'a>>; 2],
    /// Columns, world axes: across the normal, and the normal from A to B.
    pub axes: Matrix3<f64>,
    fields: [Field; 2],
    kind: Kind,
    /// Weights a and b, whose sum is 1.
    pub weights: [f64; 2],
    /// Slopes g·n along the normal; of a boundary −1.
    slopes: [f64; 2],
    /// c: shares of the bodies in how far the point moves along the normal.
    shares: [f64; 2],
    /// (TᵀHT)⁻¹, zero along directions in which the point is held.
    inverse: Matrix2<f64>,
    /// TᵀHn.
    bend: Vector2<f64>,
    /// The body from whose gradient the derivative of the normal is taken: the one with the flatter level surface.
    flatter: usize,
    pub flags: DerivativeFlags,
}

/// Weights σ on δS and Γ on δg of each body, Γ in world axes.
#[derive(Clone, Copy, Default)]
pub(super) struct FieldWeights {
    pub sigma: f64,
    pub gamma: Vector3<f64>,
}

const FLAT: Field = Field {
    gradient: Vector3::new(0.0, 0.0, -1.0),
    hessian: Symmetric { xx: 0.0, yx: 0.0, yy: 0.0, zx: 0.0, zy: 0.0, zz: 0.0 },
    clear: true,
    imprecise: false,
    sloped: true,
};

impl<'a> Optimum<'a> {
    /// With the normal there, world axes, and on an edge its direction.
    pub fn new(
        kind: Kind,
        places: [Option<Place<'a>>; 2],
        normal: &Vector3<f64>,
        along: Option<Vector3<f64>>,
    ) -> Result<Self, DerivativeError> {
        let first = along.unwrap_or_else(|| any_across(normal));
        let axes = |first: Vector3<f64>| Matrix3::from_columns(&[first, normal.cross(&first), *normal]);
        let mut optimum = Self::in_axes(kind, places, axes(first))?;
        if along.is_none() {
            if let Some(stiffest) = optimum.graded() {
                let first = optimum.axes.column(0) * stiffest.x + optimum.axes.column(1) * stiffest.y;
                optimum = Self::in_axes(kind, places, axes(first))?;
            }
        }
        optimum.invert()?;
        Ok(optimum)
    }

    fn in_axes(kind: Kind, places: [Option<Place<'a>>; 2], axes: Matrix3<f64>) -> Result<Self, DerivativeError> {
        let fields = places.map(|place| place.map_or(FLAT, |place| place.field(&axes)));
        let slopes = fields.map(|field| field.gradient.z);
        let opposed = slopes[0] > 0.0 && slopes[1] < 0.0 && fields.iter().all(|field| field.sloped);
        if !(opposed && slopes[0].is_finite() && slopes[1].is_finite()) {
            return Err(DerivativeError::NoGradient);
        }
        // Of both sides of a quotient the smaller share is exact, and so their sum is 1.
        let part = |of: f64, beside: f64| of / (of + beside);
        let share = match kind {
            Kind::Midway => part(slopes[0], -slopes[1]),
            Kind::OnA => 1.0,
            Kind::OnB | Kind::OnBoundary(_) => 0.0,
        };
        let weights = match kind {
            Kind::OnBoundary(_) => [1.0, 0.0],
            _ => [part(-slopes[1], slopes[0]), part(slopes[0], -slopes[1])],
        };
        let hessian = fields[0].hessian.weighted(weights[0], &fields[1].hessian, weights[1]);
        let curved = |i: usize| (fields[i].hessian.xx + fields[i].hessian.yy) / slopes[i].abs();
        let mut flags = DerivativeFlags::default();
        flags.set(DerivativeFlags::SWITCHING, !fields.iter().all(|field| field.clear));
        flags.set(DerivativeFlags::IMPRECISE, fields.iter().any(|field| field.imprecise));
        Ok(Self {
            places,
            axes,
            fields,
            kind,
            weights,
            slopes,
            shares: [share, 1.0 - share],
            inverse: Matrix2::new(hessian.xx, hessian.yx, hessian.yx, hessian.yy),
            bend: Vector2::new(hessian.zx, hessian.zy),
            flatter: usize::from(places[1].is_some() && curved(1) < curved(0)),
            flags,
        })
    }

    /// The direction of the largest curvature across the normal, where the other one is so small beside it that it has lost digits.
    fn graded(&self) -> Option<Vector2<f64>> {
        let h = &self.inverse;
        let (sum, half, mixed) = (h.m11 + h.m22, 0.5 * (h.m11 - h.m22), h.m12);
        if !(h.m11 * h.m22 - mixed * mixed < GRADED * sum * sum) || mixed == 0.0 {
            return None;
        }
        // An eigenvector of the larger eigenvalue, without cancellation.
        let root = half.hypot(mixed);
        let stiffest = if half > 0.0 { Vector2::new(half + root, mixed) } else { Vector2::new(mixed, root - half) };
        stiffest.try_normalize(0.0)
    }

    /// Turns TᵀHT into its inverse on the directions that are free.
    fn invert(&mut self) -> Result<(), DerivativeError> {
        let h = self.inverse;
        let dimensions = if let Kind::OnBoundary(dimensions) = self.kind { dimensions } else { 2 };
        let least = match dimensions {
            0 => f64::INFINITY,
            1 => h.m11,
            // The stiffer axis is eliminated first.
            _ if h.m11 >= h.m22 => h.m22 - h.m12 * h.m12 / h.m11,
            _ => h.m11 - h.m12 * h.m12 / h.m22,
        };
        // Of the two spheres, by regularisation and in all.
        let weighted = |of: fn(&Place) -> f64| -> f64 {
            let weight = |i: usize| self.places[i].as_ref().map_or(0.0, |place| 2.0 * self.weights[i] * of(place));
            weight(0) + weight(1)
        };
        let added = weighted(|place| place.sphere_weight - place.particle.sphere_weight);
        let least = least.max(weighted(|place| place.sphere_weight));
        if dimensions > 0 && !(least > 0.0 && least.is_finite()) {
            return Err(DerivativeError::NoCurvature);
        }
        self.flags.set(DerivativeFlags::FREE, least < 2.0 * added);
        self.inverse = match dimensions {
            0 => Matrix2::zeros(),
            1 => Matrix2::new(1.0 / least, 0.0, 0.0, 0.0),
            _ if h.m11 >= h.m22 => {
                let ratio = h.m12 / h.m11;
                Matrix2::new(1.0 / h.m11 + ratio * ratio / least, -ratio / least, -ratio / least, 1.0 / least)
            }
            _ => {
                let ratio = h.m12 / h.m22;
                Matrix2::new(1.0 / least, -ratio / least, -ratio / least, 1.0 / h.m22 + ratio * ratio / least)
            }
        };
        Ok(())
    }

    /// The factor of a·δS_A + b·δS_B in the derivative of the least S, and hence of its root s: that of the body whose S is sought.
    pub fn of_value(&self) -> f64 {
        match self.kind {
            Kind::Midway => 1.0,
            Kind::OnA => 1.0 / self.weights[1],
            Kind::OnB | Kind::OnBoundary(_) => 1.0 / self.weights[0],
        }
    }

    /// Number of directions across the normal in which the normal is that of a boundary.
    fn held(&self) -> usize {
        if let Kind::OnBoundary(dimensions) = self.kind { dimensions } else { 0 }
    }

    /// Rows T of the Hessian of a body.
    fn across(&self, i: usize) -> Matrix2x3<f64> {
        let h = &self.fields[i].hessian;
        Matrix2x3::new(h.xx, h.yx, h.zx, h.yx, h.yy, h.zy)
    }

    /// How the point moves with a body, of which the other one is held.
    pub fn moved_by(&self, i: usize) -> Matrix3x6<f64> {
        let along = self.shares[i];
        // a(ω × g − H v) + ζ H n for the six columns.
        let weight = self.weights[i];
        let mut slope = Matrix2x6::zeros();
        slope.fixed_view_mut::<2, 3>(0, 0).copy_from(&(self.across(i) * -weight));
        slope[(0, 2)] += along * self.bend.x;
        slope[(1, 2)] += along * self.bend.y;
        let turned = weight * self.slopes[i];
        (slope[(0, 4)], slope[(1, 3)]) = (turned, -turned);
        let across = -self.inverse * slope;
        let mut moved = Matrix3x6::zeros();
        moved.fixed_view_mut::<2, 6>(0, 0).copy_from(&across);
        moved[(2, 2)] = along;
        moved
    }

    /// How the normal turns with A, along the axes across it, where its point moves so.
    pub fn normal_by_a(&self, moved: &Matrix3x6<f64>) -> Matrix2x6<f64> {
        let flatter = self.flatter;
        let slope = self.slopes[flatter];
        let mut turned = self.across(flatter) / slope * moved;
        if flatter == 0 {
            let hessian = self.across(0) / slope;
            for (column, h) in hessian.column_iter().enumerate() {
                turned[(0, column)] -= h.x;
                turned[(1, column)] -= h.y;
            }
            turned[(0, 4)] += 1.0;
            turned[(1, 3)] -= 1.0;
        }
        // On a boundary it stays at right angles to that.
        (0..self.held()).for_each(|i| turned.row_mut(i).fill(0.0));
        turned
    }

    /// The weights on the potentials that weights on the point and on the normal (own axes) come to.
    pub fn pulled_back(&self, point: &Vector3<f64>, normal: &Vector3<f64>) -> [FieldWeights; 2] {
        let mut normal = normal.xy();
        (0..self.held()).for_each(|i| normal[i] = 0.0);
        let carrier = self.flatter;
        let of_normal = normal / self.slopes[carrier];
        let point = point + self.across(carrier).tr_mul(&of_normal);
        let across = self.inverse * point.xy();
        let along = point.z - across.dot(&self.bend);
        [0, 1].map(|i| {
            let mut gamma = across * -self.weights[i];
            if i == carrier {
                gamma += of_normal;
            }
            FieldWeights {
                sigma: -self.shares[i] * along / self.slopes[i],
                gamma: self.axes * Vector3::new(gamma.x, gamma.y, 0.0),
            }
        })
    }

    /// The weights on velocity and turn of a body, world axes, at this point, that weights on its potential come to.
    pub fn on_motion(&self, i: usize, weights: &FieldWeights) -> [Vector3<f64>; 2] {
        let field = &self.fields[i];
        let gamma = self.axes.tr_mul(&weights.gamma);
        let velocity = -(weights.sigma * field.gradient + field.hessian.times(&gamma));
        // Gradients beside the normal are rounding.
        let turn = Vector3::new(0.0, 0.0, self.slopes[i]).cross(&gamma);
        [self.axes * velocity, self.axes * turn]
    }

    /// The slope of the potential of a body along the normal.
    pub fn slope(&self, i: usize) -> f64 {
        self.slopes[i]
    }
}
