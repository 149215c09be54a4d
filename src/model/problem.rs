//! The formulations of a contact as one dual problem: weights, merit and dual value of each.
//!
//! Every problem is a dual problem in one weight θ: minimise a(θ)·S_A + b(θ)·S_B, a and b linear in θ. Midway: a = 1 −
//! θ, b = θ; on B: a = 1, b = θ; on A: a = θ, b = 1; on a boundary: a = 1, b = 0. What is passed around is the ratio λ
//! = b/a, which keeps its digits where one weight is all but zero.

use crate::linalg::number::{Number, larger};

/// The formulation: which point of the dual path is sought.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Problem {
    /// S_A = S_B: minimise the larger (paper eq. 44).
    Midway,
    /// S_B = 1: the point P2 on B closest to A, minimising S_A (paper eqs 9, 34).
    OnB,
    /// S_A = 1: the point P1 on A closest to B, minimising S_B.
    OnA,
    /// The point of a boundary where S_A is least. S_B, of the boundary, is 0 on all of it, and no weight is sought.
    OnBoundary,
}

/// Price of infeasibility in units of the multiplier; anything above 1 makes the penalty exact (estimated).
pub(crate) const PRICE: f64 = 2.0;

/// Bound on the error of the slope by the rounding of A's rotation, in units of ε·(a|∇S_A| + b|∇S_B|): 26.4ε of
/// a|∇S_A|, which is half of that sum where forces balance (docs/theory.md, "Rounding"). Derived: 13.2, and 12 for a
/// point that turns to the world.
pub(crate) const TURN: f64 = 14.0;

impl Problem {
    /// [`TURN`]; on a boundary a|∇S_A| is all of the sum, and the frame of the boundary is rounded as a rotation is.
    #[inline(always)]
    pub fn turn(self) -> f64 {
        if self == Self::OnBoundary { 2.0 * TURN } else { TURN }
    }

    /// Weights (a, b) at λ.
    #[inline]
    pub fn weights<N: Number>(self, lambda: N) -> (N, N) {
        let one = N::of(1.0);
        match self {
            Self::Midway => {
                let a = one / (one + lambda);
                (a, lambda * a)
            }
            Self::OnB => (one, lambda),
            Self::OnA => (one / lambda, one),
            Self::OnBoundary => (one, N::of(0.0)),
        }
    }

    /// (da/dθ, db/dθ).
    #[inline]
    pub fn weight_rates<N: Number>(self) -> (N, N) {
        let (alpha, beta) = match self {
            Self::Midway => (-1.0, 1.0),
            Self::OnB => (0.0, 1.0),
            Self::OnA => (1.0, 0.0),
            Self::OnBoundary => (0.0, 0.0),
        };
        (N::of(alpha), N::of(beta))
    }

    /// dθ/d ln λ at the weights (a, b).
    #[inline]
    pub fn per_logarithm(self, (a, b): (f64, f64)) -> f64 {
        match self {
            Self::Midway => a * b,
            Self::OnB => b,
            Self::OnA => -a,
            Self::OnBoundary => 1.0,
        }
    }

    /// The quantity being minimised, given both potentials: S_A, S_B or the larger. Infeasibility of the
    /// constraint counts with a price above its multiplier (exact penalty).
    #[inline]
    pub fn merit(self, s_a: f64, s_b: f64, lambda: f64) -> f64 {
        match self {
            Self::Midway => larger(s_a, s_b),
            Self::OnB => s_a + PRICE * lambda * larger(s_b - 1.0, 0.0),
            Self::OnA => s_b + PRICE / lambda * larger(s_a - 1.0, 0.0),
            Self::OnBoundary => s_a,
        }
    }

    /// Bound on the error of the merit, from bounds on those of S_A and S_B.
    #[inline]
    pub fn merit_rounding(self, error_a: f64, error_b: f64, lambda: f64) -> f64 {
        match self {
            Self::Midway => larger(error_a, error_b),
            Self::OnB => error_a + PRICE * lambda * error_b,
            Self::OnA => error_b + PRICE / lambda * error_a,
            Self::OnBoundary => error_a,
        }
    }

    /// Value of the dual function: a lower bound of the optimum for every λ.
    #[inline]
    pub fn dual<N: Number>(self, s_a: N, s_b: N, lambda: N) -> N {
        let (a, b) = self.weights(lambda);
        match self {
            Self::Midway => a * s_a + b * s_b,
            Self::OnB => s_a + b * (s_b - N::of(1.0)),
            Self::OnA => a * (s_a - N::of(1.0)) + s_b,
            Self::OnBoundary => s_a,
        }
    }

    /// Bound on the error of the dual value, from bounds on those of S_A and S_B.
    #[inline]
    pub fn weighted(self, error_a: f64, error_b: f64, lambda: f64) -> f64 {
        let (a, b) = self.weights(lambda);
        a * error_a + b * error_b
    }

    /// Both sides of the optimality equation: equal at the optimum. Their difference, first less second, grows with λ;
    /// one may be the constant 1.
    #[inline]
    pub fn sides<N: Number>(self, s_a: N, s_b: N) -> (N, N) {
        match self {
            Self::Midway => (s_a, s_b),
            Self::OnB => (N::of(1.0), s_b),
            Self::OnA => (s_a, N::of(1.0)),
            Self::OnBoundary => (s_a, s_a),
        }
    }

    /// The body held at S = 1 and the other one; `None` where neither is held.
    pub fn held(self) -> Option<(usize, usize)> {
        match self {
            Self::Midway | Self::OnBoundary => None,
            Self::OnB => Some((1, 0)),
            Self::OnA => Some((0, 1)),
        }
    }

    /// Bounds of S_A and S_B where the optimum can be, from an upper bound of what is minimised: a body that is held
    /// has S ≤ 1 there.
    #[inline]
    pub fn levels(self, upper: f64) -> [f64; 2] {
        let level = larger(upper, 1.0);
        match self {
            Self::OnB => [level, 1.0],
            Self::OnA => [1.0, level],
            Self::Midway | Self::OnBoundary => [level; 2],
        }
    }

    /// c in the mismatch m = c − (α·S_A + β·S_B).
    #[inline]
    pub fn level<N: Number>(self) -> N {
        N::of(if matches!(self, Self::Midway | Self::OnBoundary) { 0.0 } else { 1.0 })
    }

    /// The first side less the second, from m: λ falls as θ grows for a point on A.
    #[inline]
    pub fn difference(self, mismatch: f64) -> f64 {
        if self == Self::OnA { -mismatch } else { mismatch }
    }

    /// S_A and S_B from a·S_A + b·S_B and α·S_A + β·S_B.
    #[inline]
    pub fn apart<N: Number>(self, fixed: N, rate: N, (a, b): (N, N)) -> (N, N) {
        match self {
            Self::Midway => (fixed - b * rate, fixed + a * rate),
            Self::OnB => (fixed - b * rate, rate),
            Self::OnA => (rate, fixed - a * rate),
            Self::OnBoundary => (fixed, N::of(0.0)),
        }
    }

    /// |first side − second side|.
    #[inline]
    pub fn mismatch<N: Number>(self, s_a: N, s_b: N) -> N {
        let (growing, falling) = self.sides(s_a, s_b);
        (growing - falling).magnitude()
    }

    /// Changes of both sides by changes of S_A and S_B.
    #[inline]
    pub fn changes(self, of_a: f64, of_b: f64) -> (f64, f64) {
        match self {
            Self::Midway => (of_a, of_b),
            Self::OnB => (0.0, of_b),
            Self::OnA => (of_a, 0.0),
            Self::OnBoundary => (0.0, 0.0),
        }
    }

    /// dm/dθ, given that of the quadratics. Infinite where there is no θ: no error is then compensated by a change of
    /// the weights.
    #[inline(always)]
    pub fn rate<N: Number>(self, of_quadratics: N) -> N {
        if self == Self::OnBoundary { N::of(f64::INFINITY) } else { of_quadratics }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    const ALL: [Problem; 4] = [Problem::Midway, Problem::OnB, Problem::OnA, Problem::OnBoundary];

    /// da/d ln λ and db/d ln λ by differences, and both S from the two sums.
    #[test]
    fn weights_rates_and_sums_belong_together() {
        let (s_a, s_b) = (0.7, 1.3);
        for problem in ALL {
            let (alpha, beta): (f64, f64) = problem.weight_rates();
            for lambda in [0.1, 1.0, 6.0] {
                let (a, b): (f64, f64) = problem.weights(lambda);
                let (step, rate) = (1e-6_f64, problem.per_logarithm((a, b)));
                let (more, less): ((f64, f64), (f64, f64)) =
                    (problem.weights(lambda * step.exp()), problem.weights(lambda * (-step).exp()));
                assert!(((more.0 - less.0) / (2.0 * step) - alpha * rate).abs() < 1e-8, "{problem:?}, {lambda}");
                assert!(((more.1 - less.1) / (2.0 * step) - beta * rate).abs() < 1e-8, "{problem:?}, {lambda}");
                if problem != Problem::OnBoundary {
                    let found = problem.apart(a * s_a + b * s_b, alpha * s_a + beta * s_b, (a, b));
                    assert!((found.0 - s_a).abs() < 1e-14 && (found.1 - s_b).abs() < 1e-14, "{problem:?}, {lambda}");
                }
            }
        }
    }

    /// Weak duality at a point: the dual value of any λ is at most the merit of any point, and equal where both sides
    /// are.
    #[test]
    fn the_dual_value_is_no_more_than_the_merit() {
        for problem in ALL {
            for (s_a, s_b) in [(0.3, 2.0), (1.7, 0.2), (0.9, 1.1), (1.0, 1.0)] {
                for lambda in [0.01, 1.0, 50.0] {
                    let (dual, merit) = (problem.dual(s_a, s_b, lambda), problem.merit(s_a, s_b, lambda));
                    assert!(dual <= merit + 1e-15, "{problem:?}, {s_a}, {s_b}, {lambda}");
                    let meets = problem.mismatch(s_a, s_b) == 0.0;
                    assert!(!meets || (dual - merit).abs() < 1e-15, "{problem:?}, {s_a}, {s_b}, {lambda}");
                }
            }
        }
    }
}
