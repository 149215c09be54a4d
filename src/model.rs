//! The two quadratics at a point, solved exactly: one step of the fast solver.
//!
//! For weights a, b ≥ 0 let v(λ), λ = b/a, minimise a·q_A + b·q_B. The curve v(λ) runs from the minimum of
//! A (λ → 0) to that of B (λ → ∞); along it q_A grows and q_B falls. Midway is its point with q_A = q_B,
//! the two closest points are those with q_B = 1 and q_A = 1: one search in one variable serves all three.

use crate::potential::Quadratic;
use nalgebra::{Matrix3, Vector3};

/// Which point of the curve is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Target {
    /// S_A = S_B: minimise the larger (paper eq. 44).
    Midway,
    /// S_B = 1: the point P2 on B closest to A, minimising S_A (paper eqs 9, 34).
    OnB,
    /// S_A = 1: the point P1 on A closest to B, minimising S_B.
    OnA,
}

impl Target {
    /// Weights (a, b) at λ.
    pub fn weights(self, lambda: f64) -> (f64, f64) {
        match self {
            Self::Midway => (1.0 / (1.0 + lambda), lambda / (1.0 + lambda)),
            Self::OnB => (1.0, lambda),
            Self::OnA => (1.0 / lambda, 1.0),
        }
    }

    /// The quantity being minimised, given both potentials: S_A, S_B or the larger. Infeasibility of the
    /// constraint counts with a price above its multiplier (exact penalty).
    pub fn merit(self, s_a: f64, s_b: f64, lambda: f64) -> f64 {
        match self {
            Self::Midway => s_a.max(s_b),
            Self::OnB => s_a + PRICE * lambda * (s_b - 1.0).max(0.0),
            Self::OnA => s_b + PRICE / lambda * (s_a - 1.0).max(0.0),
        }
    }

    /// Value of the dual function: a lower bound of the optimum for every λ.
    pub fn dual(self, s_a: f64, s_b: f64, lambda: f64) -> f64 {
        let (a, b) = self.weights(lambda);
        match self {
            Self::Midway => a * s_a + b * s_b,
            Self::OnB => s_a + b * (s_b - 1.0),
            Self::OnA => a * (s_a - 1.0) + s_b,
        }
    }

    /// Bound on the error of the dual value, from bounds on those of S_A and S_B.
    pub fn dual_weighted(self, error_a: f64, error_b: f64, lambda: f64) -> f64 {
        let (a, b) = self.weights(lambda);
        a * error_a + b * error_b
    }

    /// Bound on the error of the merit, from bounds on those of S_A and S_B.
    pub fn merit_rounding(self, error_a: f64, error_b: f64, lambda: f64) -> f64 {
        match self {
            Self::Midway => error_a.max(error_b),
            Self::OnB => error_a + PRICE * lambda * error_b,
            Self::OnA => error_b + PRICE / lambda * error_a,
        }
    }

    /// The two numbers that are equal at the wanted point; the first grows with λ.
    fn sides(self, q_a: f64, q_b: f64) -> (f64, f64) {
        match self {
            Self::Midway => (q_a, q_b),
            Self::OnB => (1.0, q_b),
            Self::OnA => (q_a, 1.0),
        }
    }
}

/// Price of infeasibility in units of the multiplier; anything above 1 makes the penalty exact.
pub(crate) const PRICE: f64 = 2.0;

/// Optimum of the two quadratics.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Optimum {
    /// Step from the point of expansion.
    pub step: Vector3<f64>,
    /// ∇S_A and ∇S_B there: a·g_A + b·g_B = 0. Where a stiff plane is on by less than rounding, only the
    /// model knows them.
    pub gradients: [Vector3<f64>; 2],
    /// Weight ratio λ = b/a.
    pub lambda: f64,
    /// Dual value of the model: a lower bound of the whole problem while no active plane turns negative.
    pub lower: f64,
    /// Merit of the quadratics there.
    pub upper: f64,
    /// Whether λ is as good as rounding allows.
    pub settled: bool,
    /// How far `lower` may lie above the model's minimum, because the step is not solved exactly.
    pub doubt: f64,
    /// Rounding of S_A and S_B over the length of the step.
    pub rounding: (f64, f64),
    /// How fast the sides part with ln λ.
    pub rate: f64,
}

/// Most searches for λ; quadratic convergence needs a handful.
const MOST_SEARCHES: usize = 40;

/// λ stays in this range: beyond it one particle's weight is lost in rounding altogether.
const LAMBDA_RANGE: (f64, f64) = (1e-30, 1e30);

/// One search moves λ by at most this factor: quadratics that miss the planes further on may not
/// reach the target at all.
const FARTHEST: f64 = 1e6;

/// A last change of ln λ, and mismatch of the sides, below this is carried over by derivatives: what is left
/// out is its square.
const EXTRAPOLATED: f64 = 1e-8;

/// Relative mismatch above which logarithms of the sides are taken.
const LOGARITHMIC: f64 = 0.02;

/// Relative mismatch below which a search that no longer gains is at the end of its digits.
const STALLING: f64 = 1e-9;

/// Solves the pair of quadratics from the guess λ. `None` when a factorisation breaks down.
///
/// `soft` are the least curvatures of A and B in any direction (their spheres'), `enough` is a mismatch of the
/// two sides below which the search may stop; 0 for as good as rounding allows.
pub(crate) fn solve(
    q_a: &Quadratic,
    q_b: &Quadratic,
    soft: (f64, f64),
    target: Target,
    guess: f64,
    enough: f64,
) -> Option<Optimum> {
    let (h_a, h_b) = (Symmetric::of(&q_a.hessian), Symmetric::of(&q_b.hessian));
    let mut lambda = guess.clamp(LAMBDA_RANGE.0, LAMBDA_RANGE.1);
    let (mut low, mut high) = (lambda / FARTHEST, lambda * FARTHEST);
    let mut last_mismatch = f64::INFINITY;
    for search in 1..=MOST_SEARCHES {
        let (a, b) = target.weights(lambda);
        let least = a * soft.0 + b * soft.1;
        let factor = Factor::of(&h_a.weighted(a, &h_b, b), least)?;
        let step = -factor.solve(&(a * q_a.gradient + b * q_b.gradient));
        let (bend_a, bend_b) = (h_a.times(&step), h_b.times(&step));
        let s_a = q_a.expansion + step.dot(&(q_a.gradient + 0.5 * bend_a));
        let s_b = q_b.expansion + step.dot(&(q_b.gradient + 0.5 * bend_b));
        let (g_a, g_b) = (q_a.gradient + bend_a, q_b.gradient + bend_b);
        let (growing, falling) = target.sides(s_a, s_b);
        let mismatch = growing - falling;
        if !(s_a.is_finite() && s_b.is_finite()) {
            return None;
        }
        // To rounding; or Newton, which should square the mismatch, does not even halve it any more.
        let larger = growing.max(falling);
        let stalled = mismatch.abs() <= STALLING * larger && mismatch.abs() > 0.5 * last_mismatch;
        let settled = mismatch.abs() <= 4.0 * f64::EPSILON * larger || stalled;
        last_mismatch = mismatch.abs();
        let optimum = |step: Vector3<f64>, lambda, (s_a, s_b): (f64, f64), gradients, settled| {
            let length = step.norm();
            let rounding = |q: &Quadratic, h: &Symmetric| {
                2.0 * f64::EPSILON * (q.expansion + length * (q.gradient.norm() + length * h.size()))
            };
            let rounding = (rounding(q_a, &h_a), rounding(q_b, &h_b));
            // With curvature of at least `least`, a remaining slope can hide this much.
            let doubt = 0.5 * (a * g_a + b * g_b).norm_squared() / least;
            let drift = factor.solve(&(a * b / (a + b) * (g_a - g_b)));
            let (rate_growing, rate_falling) = target.rates(g_a.dot(&drift), g_b.dot(&drift));
            let rate = rate_growing - rate_falling;
            let (lower, upper) = (target.dual(s_a, s_b, lambda), target.merit(s_a, s_b, lambda));
            Some(Optimum { step, gradients, lambda, lower, upper, settled, doubt, rounding, rate })
        };
        if mismatch.abs() <= enough || settled || search == MOST_SEARCHES {
            return optimum(step, lambda, (s_a, s_b), [g_a, g_b], settled);
        }
        if mismatch > 0.0 {
            high = lambda
        } else {
            low = lambda
        }
        // d step / d ln λ, from a g_A + b g_B = 0 along the curve.
        let drift = factor.solve(&(a * b / (a + b) * (g_a - g_b)));
        let (rate_growing, rate_falling) = target.rates(g_a.dot(&drift), g_b.dot(&drift));
        let rate = rate_growing - rate_falling;
        // Far off, the logarithms of both sides are nearly linear in ln λ; near the root, the sides are.
        let smaller = growing.min(falling);
        let change = if mismatch.abs() > LOGARITHMIC * larger && smaller > 0.0 {
            (falling / growing).ln() / (rate_growing / growing - rate_falling / falling)
        } else {
            -mismatch / rate
        };
        if change.abs() <= EXTRAPOLATED && mismatch.abs() <= EXTRAPOLATED * growing.max(falling) {
            let sides = (s_a + change * g_a.dot(&drift), s_b + change * g_b.dot(&drift));
            let gradients = [g_a + change * h_a.times(&drift), g_b + change * h_b.times(&drift)];
            return optimum(step + change * drift, lambda * (1.0 + change), sides, gradients, true);
        }
        let mut next =
            if change.abs() < 0.1 { lambda * (1.0 + change) } else { lambda * change.clamp(-60.0, 60.0).exp() };
        if !(low < next && next < high) {
            next = (low * high).sqrt();
        }
        if next == lambda {
            // No λ does better.
            return optimum(step, lambda, (s_a, s_b), [g_a, g_b], true);
        }
        lambda = next;
    }
    None
}

impl Target {
    /// How far the two numbers are from being equal at the point of expansion.
    pub fn mismatch(self, q_a: &Quadratic, q_b: &Quadratic) -> f64 {
        let (growing, falling) = self.sides(q_a.expansion, q_b.expansion);
        (growing - falling).abs()
    }

    /// What a change of S_A (0) or S_B (1) does to the difference of the two numbers.
    pub fn mismatch_of(self, body: usize, change: f64) -> f64 {
        match (self, body) {
            (Self::OnB, 0) | (Self::OnA, 1) => 0.0,
            _ => change,
        }
    }

    fn rates(self, rate_a: f64, rate_b: f64) -> (f64, f64) {
        match self {
            Self::Midway => (rate_a, rate_b),
            Self::OnB => (0.0, rate_b),
            Self::OnA => (rate_a, 0.0),
        }
    }
}

/// How the optimum answers to small changes of the data: the derivative of the conditions
/// a·g_A + b·g_B = 0 and "both sides are equal".
pub(crate) struct Response {
    factor: Factor,
    /// H⁻¹h, with h the gradient of the difference of the sides.
    along: Vector3<f64>,
    /// hᵀH⁻¹h.
    stiffness: f64,
}

impl Response {
    /// `gradients` are those at the optimum, in the axes of the quadratics.
    pub fn of(
        q_a: &Quadratic,
        q_b: &Quadratic,
        soft: (f64, f64),
        target: Target,
        lambda: f64,
        gradients: &[Vector3<f64>; 2],
    ) -> Option<Self> {
        let (a, b) = target.weights(lambda);
        let (h_a, h_b) = (Symmetric::of(&q_a.hessian), Symmetric::of(&q_b.hessian));
        let factor = Factor::of(&h_a.weighted(a, &h_b, b), a * soft.0 + b * soft.1)?;
        let [g_a, g_b] = gradients;
        let h = match target {
            Target::Midway => g_b - g_a,
            Target::OnB => *g_b,
            Target::OnA => -g_a,
        };
        let along = factor.solve(&h);
        let stiffness = h.dot(&along);
        (stiffness > 0.0).then_some(Self { factor, along, stiffness })
    }

    /// Length of the move of the optimum when the slope a·g_A + b·g_B changes by `slope` and the difference of
    /// the sides by `mismatch`.
    pub fn distance(&self, slope: &Vector3<f64>, mismatch: f64) -> f64 {
        let free = self.factor.solve(slope);
        (free + self.along * ((mismatch - self.along.dot(slope)) / self.stiffness)).norm()
    }

    /// Bound on the move per unit of slope, in whatever direction (in the plane: of its first two axes).
    pub fn per_slope(&self, dimensions: usize) -> f64 {
        (0..dimensions).map(|axis| self.factor.solve(&Vector3::ith(axis, 1.0)).norm()).sum()
    }
}

/// A symmetric 3×3 matrix by its lower half.
#[derive(Clone, Copy)]
struct Symmetric {
    xx: f64,
    yx: f64,
    zx: f64,
    yy: f64,
    zy: f64,
    zz: f64,
}

impl Symmetric {
    fn of(m: &Matrix3<f64>) -> Self {
        Self { xx: m.m11, yx: m.m21, zx: m.m31, yy: m.m22, zy: m.m32, zz: m.m33 }
    }

    fn weighted(&self, a: f64, other: &Self, b: f64) -> Self {
        Self {
            xx: a * self.xx + b * other.xx,
            yx: a * self.yx + b * other.yx,
            zx: a * self.zx + b * other.zx,
            yy: a * self.yy + b * other.yy,
            zy: a * self.zy + b * other.zy,
            zz: a * self.zz + b * other.zz,
        }
    }

    fn times(&self, v: &Vector3<f64>) -> Vector3<f64> {
        Vector3::new(
            self.xx * v.x + self.yx * v.y + self.zx * v.z,
            self.yx * v.x + self.yy * v.y + self.zy * v.z,
            self.zx * v.x + self.zy * v.y + self.zz * v.z,
        )
    }

    /// The trace: for a positive semidefinite matrix a bound of its norm.
    fn size(&self) -> f64 {
        self.xx + self.yy + self.zz
    }
}

/// L D Lᵀ of a symmetric positive definite 3×3 matrix, eliminated in the given order of axes: stiffest
/// first keeps the softest direction to full relative precision.
struct Factor {
    l10: f64,
    l20: f64,
    l21: f64,
    inverse_d: [f64; 3],
}

impl Factor {
    /// `least` bounds the eigenvalues from below, and so every pivot: rounding may not take it further.
    fn of(h: &Symmetric, least: f64) -> Option<Self> {
        let i0 = 1.0 / h.xx.max(least);
        let (l10, l20) = (h.yx * i0, h.zx * i0);
        let i1 = 1.0 / (h.yy - l10 * h.yx).max(least);
        let c21 = h.zy - l20 * h.yx;
        let l21 = c21 * i1;
        let i2 = 1.0 / (h.zz - l20 * h.zx - l21 * c21).max(least);
        (least > 0.0 && i0.is_finite() && i1.is_finite() && i2.is_finite()).then_some(Self {
            l10,
            l20,
            l21,
            inverse_d: [i0, i1, i2],
        })
    }

    fn solve(&self, r: &Vector3<f64>) -> Vector3<f64> {
        let y0 = r.x;
        let y1 = r.y - self.l10 * y0;
        let y2 = r.z - self.l20 * y0 - self.l21 * y1;
        let z = y2 * self.inverse_d[2];
        let y = y1 * self.inverse_d[1] - self.l21 * z;
        let x = y0 * self.inverse_d[0] - self.l10 * y - self.l20 * z;
        Vector3::new(x, y, z)
    }
}
