//! How an optimum moves with the potentials, forward and reverse.
//!
//! All vectors are in the axes of the optimum: two directions across the normal and the normal. Motions of a body are
//! those at the optimum: three columns of the velocity of its point there and two of its turn.

use super::answer::{DerivativeError, DerivativeFlags};
use super::field::{Field, Place, Potential, dot3};
use super::numbers::{CONVERGED, GRADED, IMPRECISE, LOST, Limits, RUN};
use crate::linalg::double_double::DoubleDouble;
use crate::linalg::graded_basis::least_axis;
use crate::linalg::number::Single;
use crate::linalg::symmetric::Symmetric;
use nalgebra::{Matrix2, Matrix2x3, Matrix3, Vector2, Vector3};

/// What an optimum is one of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// S_A = S_B.
    Midway,
    /// S_A = 1, least S_B: P1.
    OnA,
    /// S_B = 1, least S_A: P2.
    OnB,
    /// Least S_A on a part of a boundary with this number of coordinates, along the first axes.
    OnBoundary(usize),
}

/// An optimum with its linearised optimality conditions.
pub(super) struct Optimum<'a, N: Single = f64> {
    /// The bodies at this point; none in place of a boundary.
    pub places: [Option<Place<'a, N>>; 2],
    /// Columns, world axes: across the normal, and the normal from A to B.
    pub axes: Matrix3<N>,
    fields: [Field<N>; 2],
    kind: Kind,
    /// Weights a and b, whose sum is 1.
    pub weights: [N; 2],
    /// Slopes g·n along the normal; of a boundary −1.
    slopes: [N; 2],
    /// c: shares of the bodies in how far the point moves along the normal.
    shares: [N; 2],
    /// (TᵀHT)⁻¹, zero along directions in which the point is held.
    inverse: Matrix2<N>,
    /// TᵀHn.
    bend: Vector2<N>,
    /// The body from whose gradient the derivative of the normal is taken: the one with the flatter level surface.
    flatter: usize,
    /// How far the point runs with a turn by the rounding of a double, relative to its distance from the centre of A.
    run: f64,
    pub flags: DerivativeFlags,
}

/// The derivative of a number in the motion of A: three components of the velocity of its point at the optimum, and two
/// of its turn; one about the normal, along which the gradient is, changes nothing there.
pub(super) type ByMotion<N> = [N; 5];

/// Weights σ on δS and Γ on δg of a body, Γ in world axes.
#[derive(Clone, Copy)]
pub(super) struct FieldWeights<N> {
    pub sigma: N,
    pub gamma: Vector3<N>,
}

/// At unit length.
#[inline(always)]
pub(super) fn unit<N: Single>(v: &Vector3<N>) -> Vector3<N> {
    // In units of the largest component no square leaves the range of numbers.
    let largest = v.x.approximate().abs().max(v.y.approximate().abs()).max(v.z.approximate().abs());
    let scaled = v * N::of(1.0 / largest);
    scaled * (N::of(1.0) / dot3(&scaled, &scaled).root())
}

/// The normal at an optimum, along which gradients are opposed: of closest that of the body on which it lies, since the
/// other one may be all but level there; of midway mostly that of the larger, which is known to more digits.
#[inline(always)]
pub(super) fn normal_at<N: Single>(kind: Kind, places: &[Place<N>; 2]) -> Vector3<N> {
    let gradient = |i: usize| places[i].tangent().1;
    unit(&match kind {
        Kind::OnA | Kind::OnBoundary(_) => gradient(0),
        Kind::OnB => -gradient(1),
        Kind::Midway => gradient(0) - gradient(1),
    })
}

#[inline(always)]
fn is_in_plane<N: Single>(places: &[Option<Place<N>>; 2]) -> bool {
    places[0].as_ref().is_some_and(|place| place.body.particle.is_in_plane())
}

fn flat<N: Single>() -> Field<N> {
    let zero = N::of(0.0);
    Field {
        value: zero,
        gradient: Vector3::new(zero, zero, N::of(-1.0)),
        hessian: Symmetric::default(),
        clear: true,
        lost: 0.0,
        sloped: true,
    }
}

/// Both potentials in the axes of an optimum, and what follows from them.
struct Local<N> {
    fields: [Field<N>; 2],
    weights: [N; 2],
    slopes: [N; 2],
    shares: [N; 2],
    /// TᵀHT and TᵀHn.
    across: Matrix2<N>,
    bend: Vector2<N>,
}

impl<N: Single> Local<N> {
    #[inline(always)]
    fn of(kind: Kind, [a, b]: &[Option<Place<N>>; 2], axes: &Matrix3<N>) -> Self {
        let field = |place: &Option<Place<N>>| match place {
            Some(place) => place.field(axes),
            None => flat(),
        };
        let fields = [field(a), field(b)];
        // On the way to an optimum they may not be opposed: with the signs that they have there it is found.
        let slopes = [fields[0].gradient.z.magnitude(), -fields[1].gradient.z.magnitude()];
        // The smaller part keeps its digits, and both add up to 1.
        let part = |of: N, beside: N| of / (of + beside);
        let (of_a, of_b) = (part(slopes[0], -slopes[1]), part(-slopes[1], slopes[0]));
        let (zero, one) = (N::of(0.0), N::of(1.0));
        let (weights, shares) = match kind {
            Kind::Midway => ([of_b, of_a], [of_a, of_b]),
            Kind::OnA => ([of_b, of_a], [one, zero]),
            Kind::OnB => ([of_b, of_a], [zero, one]),
            Kind::OnBoundary(_) => ([one, zero], [zero, one]),
        };
        let h = fields[0].hessian.weighted(weights[0], &fields[1].hessian, weights[1]);
        let (across, bend) = (Matrix2::new(h.xx, h.yx, h.yx, h.yy), Vector2::new(h.zx, h.zy));
        Self { fields, weights, slopes, shares, across, bend }
    }

    /// The direction of the largest curvature across the normal, where the other one is so small beside it that it has
    /// lost digits.
    fn graded(&self) -> Option<Vector2<f64>> {
        let h = self.across.map(N::approximate);
        let (sum, half, mixed) = (h.m11 + h.m22, 0.5 * (h.m11 - h.m22), h.m12);
        if !(h.m11 * h.m22 - mixed * mixed < GRADED * sum * sum) || mixed == 0.0 {
            return None;
        }
        // An eigenvector of the larger eigenvalue, without cancellation.
        let root = half.hypot(mixed);
        let stiffest = if half > 0.0 { Vector2::new(half + root, mixed) } else { Vector2::new(mixed, root - half) };
        stiffest.try_normalize(0.0)
    }

    /// (TᵀHT)⁻¹ on the directions that are free to move in, the least curvature, and whether the regularisation alone
    /// resists in one.
    #[inline(always)]
    fn inverse(&self, kind: Kind, places: &[Option<Place<N>>; 2]) -> Result<(Matrix2<N>, f64, bool), DerivativeError> {
        let h = self.across;
        let across = if let Kind::OnBoundary(dimensions) = kind { dimensions } else { 2 };
        // In the plane along the first axis alone.
        let dimensions = if is_in_plane(places) { across.min(1) } else { across };
        if dimensions == 0 {
            return Ok((Matrix2::zeros(), f64::INFINITY, false));
        }
        // The stiffer axis is eliminated first.
        let swapped = h.m11.approximate() < h.m22.approximate();
        let (stiff, soft) = if swapped { (h.m22, h.m11) } else { (h.m11, h.m22) };
        let ratio = h.m12 / stiff;
        let least = if dimensions == 2 { soft - ratio * h.m12 } else { h.m11 };
        // Of the two spheres, in all and by regularisation.
        let weighted = |of: fn(&Potential<N>) -> N| -> N {
            let weight = |i: usize| places[i].as_ref().map_or(N::of(0.0), |place| self.weights[i] * of(place.body));
            N::of(2.0) * (weight(0) + weight(1))
        };
        let least = least.larger(weighted(|body| body.weights.sphere));
        let added = weighted(|body| body.weights.sphere - N::of(body.particle.sphere_weight)).approximate();
        if !(least.is_positive() && least.is_finite()) {
            return Err(DerivativeError::NoCurvature);
        }
        let (zero, one) = (N::of(0.0), N::of(1.0));
        let (of_soft, mixed) = (one / least, -ratio / least);
        let of_stiff = one / stiff - ratio * mixed;
        let inverse = match dimensions {
            1 => Matrix2::new(of_soft, zero, zero, zero),
            _ if swapped => Matrix2::new(of_soft, mixed, mixed, of_stiff),
            _ => Matrix2::new(of_stiff, mixed, mixed, of_soft),
        };
        Ok((inverse, least.approximate(), least.approximate() < 2.0 * added))
    }
}

impl<'a, N: Single> Optimum<'a, N> {
    /// With the normal there, world axes, and on an edge its direction.
    #[inline(always)]
    pub fn new(
        kind: Kind,
        places: [Option<Place<'a, N>>; 2],
        normal: &Vector3<N>,
        along: Option<Vector3<N>>,
    ) -> Result<Self, DerivativeError> {
        let axes_along = |across: Vector3<N>| {
            let first = across * (N::of(1.0) / dot3(&across, &across).root());
            Matrix3::from_columns(&[first, normal.cross(&first), *normal])
        };
        let is_in_plane = is_in_plane(&places);
        let mut axes = axes_along(match along {
            Some(along) => along - normal * dot3(normal, &along),
            None if is_in_plane => Vector3::new(-normal.y, normal.x, N::of(0.0)),
            None => normal.cross(&least_axis(&normal.map(N::approximate)).map(N::of)),
        });
        let mut local = Local::of(kind, &places, &axes);
        if let Some(stiffest) = local.graded().filter(|_| along.is_none() && !is_in_plane) {
            let [x, y] = [N::of(stiffest.x), N::of(stiffest.y)];
            axes = axes_along(axes.column(0) * x + axes.column(1) * y);
            local = Local::of(kind, &places, &axes);
        }
        let (inverse, least, is_free) = local.inverse(kind, &places)?;
        let Local { fields: [a, b], weights, slopes, shares, bend, .. } = local;
        let curved =
            |field: &Field<N>, slope: N| ((field.hessian.xx + field.hessian.yy) / slope).magnitude().approximate();
        let mut flags = DerivativeFlags::default();
        flags.set(DerivativeFlags::SWITCHING, !(a.clear && b.clear));
        let imprecise = |field: &Field<N>| field.lost > IMPRECISE && field.lost < f64::INFINITY;
        flags.set(DerivativeFlags::IMPRECISE, imprecise(&a) || imprecise(&b));
        flags.set(DerivativeFlags::FREE, is_free);
        let flatter = usize::from(places[1].is_some() && curved(&b, slopes[1]) < curved(&a, slopes[0]));
        let length = places[0].as_ref().map_or(0.0, Place::length);
        let run = f64::EPSILON * (weights[0] * slopes[0]).approximate() / (least * length);
        Ok(Self { places, axes, run, fields: [a, b], kind, weights, slopes, shares, inverse, bend, flatter, flags })
    }

    /// Refuses an optimum at which the gradients are not opposed, or are those of the regularisation.
    #[inline]
    pub fn check(&self) -> Result<(), DerivativeError> {
        let [a, b] = &self.fields;
        let opposed = a.gradient.z.is_positive() && (-b.gradient.z).is_positive() && a.sloped && b.sloped;
        if opposed && self.slopes.iter().all(|slope| slope.is_finite()) {
            Ok(())
        } else {
            Err(DerivativeError::NoGradient)
        }
    }

    /// Whether doubles have lost too many digits.
    pub fn wants_more(&self) -> bool {
        self.run > RUN || self.fields.iter().any(|field| field.lost > LOST)
    }

    /// The factor of a·δS_A + b·δS_B in the derivative of the least S, and hence of its root s: that of the body whose
    /// S is sought.
    #[inline]
    pub fn of_value(&self) -> N {
        match self.kind {
            Kind::Midway => N::of(1.0),
            Kind::OnA => N::of(1.0) / self.weights[1],
            Kind::OnB | Kind::OnBoundary(_) => N::of(1.0) / self.weights[0],
        }
    }

    /// Number of directions across the normal in which the normal is that of a boundary.
    #[inline]
    fn held(&self) -> usize {
        if let Kind::OnBoundary(dimensions) = self.kind { dimensions } else { 0 }
    }

    /// Rows T of the Hessian of a body.
    #[inline]
    fn across(&self, i: usize) -> Matrix2x3<N> {
        let h = &self.fields[i].hessian;
        Matrix2x3::new(h.xx, h.yx, h.zx, h.yx, h.yy, h.zy)
    }

    /// How the point moves with A, while B is held: across the normal, and along it.
    #[inline(always)]
    pub fn moved_by_a(&self) -> [ByMotion<N>; 3] {
        let (weight, along, zero) = (self.weights[0], self.shares[0], N::of(0.0));
        let (h, k) = (&self.fields[0].hessian, &self.inverse);
        // a(ω × g − H v) + ζ H n for the five columns.
        let turned = weight * self.slopes[0];
        let bent = [along * self.bend.x - weight * h.zx, along * self.bend.y - weight * h.zy];
        let first = [-weight * h.xx, -weight * h.yx, bent[0], zero, turned];
        let second = [-weight * h.yx, -weight * h.yy, bent[1], -turned, zero];
        let row = |x: N, y: N| std::array::from_fn(|column| -(x * first[column] + y * second[column]));
        [row(k.m11, k.m12), row(k.m21, k.m22), [zero, zero, along, zero, zero]]
    }

    /// How the normal turns with A, along the axes across it, where its point moves so.
    #[inline(always)]
    pub fn normal_by_a(&self, moved: &[ByMotion<N>; 3]) -> [ByMotion<N>; 2] {
        let (h, scale) = (&self.fields[self.flatter].hessian, N::of(1.0) / self.slopes[self.flatter]);
        let rows = [[h.xx * scale, h.yx * scale, h.zx * scale], [h.yx * scale, h.yy * scale, h.zy * scale]];
        let mut turned = rows.map(|[x, y, z]| -> ByMotion<N> {
            std::array::from_fn(|column| x * moved[0][column] + y * moved[1][column] + z * moved[2][column])
        });
        if self.flatter == 0 {
            for (turned, row) in turned.iter_mut().zip(&rows) {
                (0..3).for_each(|column| turned[column] -= row[column]);
            }
            turned[0][4] += N::of(1.0);
            turned[1][3] -= N::of(1.0);
        }
        // On a boundary it stays at right angles to that.
        (0..self.held()).for_each(|i| turned[i] = [N::of(0.0); 5]);
        turned
    }

    /// The weights on the potentials that weights on the point and on the normal (own axes) come to.
    #[inline]
    pub fn pulled_back(&self, point: &Vector3<N>, normal: &Vector3<N>) -> [FieldWeights<N>; 2] {
        let mut normal = normal.xy();
        (0..self.held()).for_each(|i| normal[i] = N::of(0.0));
        let carrier = self.flatter;
        let of_normal = normal * (N::of(1.0) / self.slopes[carrier]);
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
                gamma: self.axes.fixed_columns::<2>(0) * gamma,
            }
        })
    }

    /// The weights on velocity and turn of a body at this point, world axes, from weights on its potential.
    pub fn on_motion(&self, i: usize, weights: &FieldWeights<N>) -> [Vector3<N>; 2] {
        let field = &self.fields[i];
        let gamma = self.axes.tr_mul(&weights.gamma);
        let velocity = -(field.gradient * weights.sigma + field.hessian.times(&gamma));
        // What the gradient has beside the normal is rounding.
        let turn = Vector3::new(N::of(0.0), N::of(0.0), self.slopes[i]).cross(&gamma);
        [self.axes * velocity, self.axes * turn]
    }

    /// The slope of the potential of a body along the normal.
    #[inline]
    pub fn slope(&self, i: usize) -> N {
        self.slopes[i]
    }

    /// From here to the optimum, world axes: a step of Newton's method.
    fn step(&self) -> Vector3<N> {
        let [a, b] = &self.fields;
        let one = N::of(1.0);
        let along = match self.kind {
            Kind::Midway => (b.value - a.value) / (self.slopes[0] - self.slopes[1]),
            Kind::OnA => (one - a.value) / self.slopes[0],
            Kind::OnB => (one - b.value) / self.slopes[1],
            Kind::OnBoundary(_) => N::of(0.0),
        };
        let slope = a.gradient.xy() * self.weights[0] + b.gradient.xy() * self.weights[1];
        let across = -self.inverse * (slope + self.bend * along);
        self.axes * Vector3::new(across.x, across.y, along)
    }
}

impl<'a> Optimum<'a, DoubleDouble> {
    /// The optimum near the places, to the digits that its bodies have.
    pub fn refined(kind: Kind, mut places: [Place<'a, DoubleDouble>; 2]) -> Result<Self, DerivativeError> {
        let (mut steps, mut last) = (0, f64::INFINITY);
        loop {
            let mut optimum = Self::new(kind, places.map(Some), &normal_at(kind, &places), None)?;
            let step = optimum.step();
            steps += 1;
            // Relative to the lengths in which the gradients turn and change.
            let change = |i: usize| {
                let of = optimum.fields[i].hessian.times(&optimum.axes.tr_mul(&step));
                of.map(Single::approximate).norm() / optimum.slopes[i].approximate().abs()
            };
            let change = change(0) + change(1);
            let converged = change <= CONVERGED[0] || (change <= CONVERGED[1] && change >= 0.5 * last);
            last = change;
            let pulling = |places: &mut [Place<'a, DoubleDouble>; 2]| {
                let [a, b] = places;
                // One of each body.
                a.drop_a_pulling_plane() | b.drop_a_pulling_plane()
            };
            let dropped = converged && pulling(&mut places);
            if (converged && !dropped) || steps >= Limits::NEWTON_STEPS {
                optimum.flags.set(DerivativeFlags::IMPRECISE, !converged);
                optimum.check()?;
                return Ok(optimum);
            }
            if dropped {
                last = f64::INFINITY;
            }
            if !converged {
                places = places.each_ref().map(|place| place.moved(&step));
            }
        }
    }
}
