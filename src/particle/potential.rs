//! S, its gradient and its Hessian, in the local frame of the particle.
//!
//! S is piecewise quadratic: value, gradient and Hessian at a point describe it exactly as long as the active set, the
//! planes with n·y > d, does not change. (The solver counts those above −blur, `pair::local_point`.)

use crate::linalg::double_double::DoubleDouble;
use crate::linalg::number::{Number, larger, smaller};
use crate::linalg::symmetric::Symmetric;
use crate::particle::solid::Solid;
use nalgebra::Vector3;

/// The weights of S = plane·Σ⟨depth⟩² + sphere·|y|², 1/length², in doubles or in numbers of 32 digits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Weights<N = f64> {
    /// (1−k)/r².
    pub plane: N,
    /// k/R², or more where flat faces are regularised.
    pub sphere: N,
}

/// What the planes that are counted at a point add up to.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sums<N: Number = f64> {
    /// Σ depth², depth = n·y − d.
    pub square: N,
    /// Σ depth.
    pub depth: N,
    /// Σ depth·n.
    pub linear: Vector3<N>,
    /// Number of planes.
    pub count: u32,
}

impl<N: Number> Sums<N> {
    /// Counts a plane.
    #[inline(always)]
    pub fn add(&mut self, n: &Vector3<N>, depth: N) {
        self.square += depth * depth;
        self.depth += depth;
        self.linear += n * depth;
        self.count += 1;
    }
}

impl Weights {
    /// Of a shape, with its sphericity at least this (about a sphere of the bounding radius).
    #[inline]
    pub fn of(shape: &Solid, least_sphericity: f64) -> Self {
        let radius = shape.bounds.radius;
        Self { plane: shape.plane_weight, sphere: larger(shape.sphere_weight, least_sphericity / (radius * radius)) }
    }
}

impl Weights<DoubleDouble> {
    /// Of a shape, from r, k and R as they were given; 0 where the shape has 0.
    pub fn precise(shape: &Solid) -> Self {
        let quotient = |of: DoubleDouble, by: f64| of / DoubleDouble::product(by, by);
        let (plane, sphere) = (DoubleDouble::sum(1.0, -shape.sphericity), DoubleDouble::from(shape.sphericity));
        let or_none = |weight: f64, precise: DoubleDouble| if weight > 0.0 { precise } else { DoubleDouble::from(0.0) };
        Self {
            plane: or_none(shape.plane_weight, quotient(plane, shape.rounding_radius)),
            sphere: or_none(shape.sphere_weight, quotient(sphere, shape.shadow_radius)),
        }
    }
}

impl<N: Number> Weights<N> {
    /// S at y.
    #[inline(always)]
    pub fn value(&self, sums: &Sums<N>, y: &Vector3<N>) -> N {
        self.plane * sums.square + self.sphere * (y.x * y.x + y.y * y.y + y.z * y.z)
    }

    /// ∇S at y, in the axes of both.
    #[inline(always)]
    pub fn gradient(&self, linear: &Vector3<N>, y: &Vector3<N>) -> Vector3<N> {
        let twice = self.twice();
        linear * twice.plane + y * twice.sphere
    }

    /// ∇²S, from Σ n nᵀ in orthonormal axes.
    #[inline(always)]
    pub fn hessian(&self, squares: &Symmetric<N>) -> Symmetric<N> {
        let twice = self.twice();
        squares.scaled(twice.plane, twice.sphere)
    }

    /// The weights of curvatures.
    #[inline(always)]
    pub fn twice(&self) -> Self {
        let two = N::of(2.0);
        Self { plane: two * self.plane, sphere: two * self.sphere }
    }
}

/// S near a point: S(x + h) = expansion + gradient·h + ½ hᵀ·hessian·h as long as the active set at x + h is the set of
/// planes that were counted.
#[derive(Clone, Copy, Debug)]
pub struct Quadratic {
    /// S(x), no unit.
    pub value: f64,
    /// The quadratic at x; more than `value` only by planes that were counted and are not active at x.
    pub expansion: f64,
    /// Gradient of the quadratic at x, 1/length: ∇S(x) if the planes that were counted are the active ones.
    pub gradient: Vector3<f64>,
    /// Its Hessian, 1/length²; for ∇²S(x) a plane with n·x = d is not counted.
    pub hessian: Symmetric,
    /// 2(1-k)/r² · Σ ⟨n_i·x − d_i⟩, the derivative of S for a change of all offsets: times the rounding of an excess it
    /// bounds, to first order, what that does to S.
    pub pull: f64,
    /// Number of planes that were counted.
    pub count: u32,
    /// Least |n·x − d|: the change of an excess that changes the active set. Negative if the planes that were counted
    /// are not the active set.
    pub clear: f64,
}

impl Quadratic {
    /// S of a boundary, on all of it.
    pub(crate) const ZERO: Self = Self {
        value: 0.0,
        expansion: 0.0,
        gradient: Vector3::new(0.0, 0.0, 0.0),
        hessian: Symmetric { xx: 0.0, yx: 0.0, yy: 0.0, zx: 0.0, zy: 0.0, zz: 0.0 },
        pull: 0.0,
        count: 0,
        clear: f64::INFINITY,
    };

    /// Half of a bound on the terms of S after a step v, in the axes of the quadratic. With b = Σ|v_i|·√(h_ii/2) they
    /// are at most (√S + b)² ≤ 2(S + b²), and b² ≤ 3/2·Σ v_i²·h_ii by Cauchy's inequality.
    #[inline]
    pub(crate) fn terms(&self, v: &Vector3<f64>) -> f64 {
        self.expansion + 1.5 * v.component_mul(v).dot(&self.hessian.diagonal())
    }

    /// Bound on the rounding of S along a step with these terms: γ with n = count + 15 for each term of value, gradient
    /// and Hessian, which together are at most 2·terms (docs/theory.md, "Rounding"). It is taken axis by axis, since a
    /// long step along a face meets only the curvature along it.
    #[inline]
    pub(crate) fn rounding_after(&self, terms: f64) -> f64 {
        (15.0 + f64::from(self.count)) * f64::EPSILON * terms
    }
}

/// S and ∇S at a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tangent {
    /// S.
    pub value: f64,
    /// ∇S, 1/length.
    pub gradient: Vector3<f64>,
    /// As in [`Quadratic`].
    pub pull: f64,
    /// 2(1-k)/r² · max |n_i| · number of active planes: a bound on the derivative of ∇S for a change of all
    /// offsets.
    pub stiffness: f64,
}

/// S on a line: value, slope and curvature at one point of it.
#[derive(Clone, Copy, Debug)]
pub struct OnLine {
    /// S.
    pub value: f64,
    /// dS/dα.
    pub slope: f64,
    /// d²S/dα².
    pub curvature: f64,
}

/// S(y).
pub fn value(shape: &Solid, y: &Vector3<f64>) -> f64 {
    let mut sums = Sums::default();
    shape.visit_near(y, 0.0, |_, n, excess| sums.add(&n, excess.max(0.0)));
    shape.weights().value(&sums, y)
}

/// S, ∇S, ∇²S at y, local frame.
pub fn local(shape: &Solid, y: &Vector3<f64>) -> Quadratic {
    turned(shape, &shape.weights(), |n| n, y, 0.0, |_, excess| excess > 0.0)
}

/// S, ∇S, ∇²S at the local point y. Derivatives are in the frame to which `turn` takes local directions; the weights
/// may differ from the shape's own. `counts` says for a plane and its n·y − d whether it is counted;
/// none below −`early` is.
///
/// Each normal is turned before it is squared, and not the finished Hessian: in a frame aligned with a face the small
/// curvature along it then keeps its relative precision beside the large one across it.
#[inline(always)]
pub(crate) fn turned(
    shape: &Solid,
    weights: &Weights,
    turn: impl Fn(Vector3<f64>) -> Vector3<f64>,
    y: &Vector3<f64>,
    early: f64,
    counts: impl Fn(usize, f64) -> bool,
) -> Quadratic {
    // All that are counted, and the depths of those that are active.
    let (mut sums, mut square, mut depth) = (Sums::default(), 0.0, 0.0);
    let mut squares = Symmetric::default();
    let mut clear = f64::INFINITY;
    let most_left_out = shape.visit_near(y, early, |i, n, excess| {
        if !counts(i, excess) {
            clear = smaller(-excess, clear);
        } else {
            clear = smaller(excess, clear);
            let n = turn(n);
            let reached = larger(excess, 0.0);
            square += reached * reached;
            depth += reached;
            sums.add(&n, excess);
            squares.add_square(&n);
        }
    });
    Quadratic {
        value: weights.value(&Sums { square, ..sums }, y),
        expansion: weights.value(&sums, y),
        gradient: weights.gradient(&sums.linear, &turn(*y)),
        hessian: weights.hessian(&squares),
        pull: weights.twice().plane * depth,
        count: sums.count,
        clear: smaller(clear, -most_left_out),
    }
}

/// S, ∇S at y, local frame.
#[inline(always)]
pub(crate) fn tangent(shape: &Solid, y: &Vector3<f64>) -> Tangent {
    let mut sums = Sums::default();
    shape.visit_near(y, 0.0, |_, n, excess| {
        if excess > 0.0 {
            sums.add(&n, excess);
        }
    });
    let (weights, curvature) = (shape.weights(), shape.weights().twice().plane);
    Tangent {
        value: weights.value(&sums, y),
        gradient: weights.gradient(&sums.linear, y),
        pull: curvature * sums.depth,
        stiffness: curvature * f64::from(sums.count) * shape.bounds.longest_normal,
    }
}

/// S, slope and curvature at y along the local direction `e` (any length; it sets the unit of α).
pub(crate) fn on_line(shape: &Solid, weights: &Weights, y: &Vector3<f64>, e: &Vector3<f64>) -> OnLine {
    let (mut square, mut mixed, mut steep) = (0.0, 0.0, 0.0);
    shape.visit_near(y, 0.0, |_, n, excess| {
        if excess > 0.0 {
            let rate = n.dot(e);
            square += excess * excess;
            mixed += excess * rate;
            steep += rate * rate;
        }
    });
    let (w, m) = (weights.plane, weights.sphere);
    OnLine {
        value: w * square + m * y.norm_squared(),
        slope: 2.0 * (w * mixed + m * y.dot(e)),
        curvature: 2.0 * (w * steep + m * e.norm_squared()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particle::particle::Particle;
    use crate::particle::plane::Plane;

    const R: f64 = 0.3;
    const K: f64 = 0.2;
    const SHADOW: f64 = 1.4;

    /// So many planes that they are kept in several clusters.
    fn planes() -> Vec<Plane> {
        let plane = |i: i32| {
            let (z, phi) = (1.0 - (2.0 * f64::from(i) + 1.0) / 60.0, f64::from(i) * 2.399963);
            let s = (1.0 - z * z).sqrt();
            let length = 1.0 + 0.5 * f64::from(i % 3);
            Plane { normal: length * Vector3::new(s * phi.cos(), s * phi.sin(), z), offset: length * 0.7 }
        };
        (0..60).map(plane).collect()
    }

    fn points() -> [Vector3<f64>; 4] {
        [[0.1, 0.2, -0.1], [0.8, 0.3, 0.2], [-0.5, 0.6, 0.9], [2.0, -3.0, 1.0]].map(Vector3::from)
    }

    /// (1-k)/r² Σ⟨n·x − d⟩² + k/R² |x|².
    fn by_definition(x: &Vector3<f64>) -> f64 {
        let excess = |plane: &Plane| (plane.normal.dot(x) - plane.offset).max(0.0);
        let squares: f64 = planes().iter().map(|plane| excess(plane).powi(2)).sum();
        (1.0 - K) / (R * R) * squares + K / (SHADOW * SHADOW) * x.norm_squared()
    }

    #[test]
    fn every_way_to_ask_gives_the_value_of_the_definition() {
        let particle = Particle::new(&planes(), R, K, SHADOW).unwrap();
        for x in points() {
            let expected = by_definition(&x);
            let line = on_line(&particle, &particle.weights(), &x, &Vector3::x());
            for found in [value(&particle, &x), local(&particle, &x).value, tangent(&particle, &x).value, line.value] {
                assert!((found - expected).abs() <= 1e-13 * expected, "{found} for {expected}");
            }
        }
    }

    /// S is quadratic between its kinks, where central differences are exact but for rounding; a kink within a step h
    /// costs h.
    #[test]
    fn derivatives_are_those_of_the_value() {
        let particle = Particle::new(&planes(), R, K, SHADOW).unwrap();
        let h = 1e-6;
        for x in points() {
            let (here, tangent) = (local(&particle, &x), tangent(&particle, &x));
            let scale = here.gradient.norm() + 1.0;
            assert!((tangent.gradient - here.gradient).norm() <= 1e-13 * scale);
            for axis in 0..3 {
                let step = h * Vector3::ith(axis, 1.0);
                let slope = (by_definition(&(x + step)) - by_definition(&(x - step))) / (2.0 * h);
                assert!((here.gradient[axis] - slope).abs() <= 1e-7 * scale, "{} for {slope}", here.gradient[axis]);
                let bend = (particle.gradient(&(x + step)) - particle.gradient(&(x - step))) / (2.0 * h);
                assert!((here.hessian.matrix().column(axis) - bend).norm() <= 1e-6 * scale);
                let line = on_line(&particle, &particle.weights(), &x, &Vector3::ith(axis, 1.0));
                assert!((line.slope - here.gradient[axis]).abs() <= 1e-13 * scale);
                assert!((line.curvature - here.hessian.matrix()[(axis, axis)]).abs() <= 1e-12 * scale);
            }
        }
    }
}
