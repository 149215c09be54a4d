//! The scale s of a solution, and the bound on its error.

use crate::bounds::solution::Solution;
use crate::linalg::number::{gamma, larger, smaller};
use crate::model::problem::Problem;
use crate::pair::body::Body;

/// s with its error bound.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scale {
    /// Best estimate of s.
    pub s: f64,
    /// |s − s*| ≤ gap.
    pub gap: f64,
    /// low ≤ s* ≤ high.
    pub low: f64,
    pub high: f64,
}

/// Rounding of the sums and roots below, relative to s: γ₆ for the sums of S and the weights, halved by the root, and
/// that of the root itself (derived).
const OF_SCALE: f64 = gamma(4);

/// What bounds of s are apart by rounding, as a share of s² (chosen).
const OF_DOUBLE: f64 = 1e-14;

/// Root of the least normal number: an s below it has a square that is lost (derived).
const UNDERFLOW: f64 = 1.5e-154;

/// Largest gap of an answer that leaves open whether s is below 1 (chosen).
pub(crate) const INCONCLUSIVE: f64 = 1e-2;

impl Scale {
    /// With the regularisation taken out again.
    #[inline(always)]
    pub fn of(solution: &Solution, [a, b]: [&Body; 2], problem: Problem) -> Self {
        let weighted = |of_a, of_b| problem.weighted(of_a, of_b, solution.lambda);
        // Regularised S exceeds S by at most this where the optimum can be.
        let [level_a, level_b] = problem.levels(solution.upper);
        let most = weighted(a.most_surplus(level_a), b.most_surplus(level_b));
        let surplus = [a.surplus(&solution.x), b.surplus(&solution.x)];
        let square = larger(solution.estimate - weighted(surplus[0], surplus[1]), 0.0);
        // What the regularisation adds to the larger of S_A and S_B at the point is no part of the upper bound.
        let added = if problem == Problem::Midway { smaller(surplus[0], surplus[1]) * (1.0 - OF_SCALE) } else { 0.0 };
        let high = larger(square, larger(solution.lower, solution.upper) - added) + solution.rounding;
        Self::between(square, solution.lower - most - solution.rounding, high)
    }

    /// From an estimate of S that is not negative and bounds of it. The gap is NaN where `high` is: `larger` gives its
    /// second argument where either is NaN.
    #[inline(always)]
    pub fn between(square: f64, low: f64, high: f64) -> Self {
        let low = smaller(larger(low, 0.0), square);
        let s = square.sqrt();
        let (low, high) = (low.sqrt() * (1.0 - OF_SCALE), high.sqrt());
        Self { s, gap: larger(s - low, high - s) + OF_SCALE * s + UNDERFLOW, low, high: high * (1.0 + OF_SCALE) }
    }

    /// Whether it is no answer: 1 lies within the gap of s, which is above [`INCONCLUSIVE`]. With a raised
    /// regularisation the gap may be any number.
    pub fn is_undecided(&self, raised: bool) -> bool {
        let most = if raised { f64::MAX } else { INCONCLUSIVE };
        // What is no number is no answer either.
        !(self.s - self.gap >= 1.0 || self.s + self.gap <= 1.0 || self.gap <= most)
    }

    /// Whether it proves on which side of 1 s lies.
    pub fn tells_the_side(&self) -> bool {
        (self.s - 1.0).abs() > self.gap
    }

    /// Whether s² is known to a relative tolerance, or as well as a double holds it: with cores that meet s² is 0 and
    /// its bounds are all that is known.
    pub fn is_known_to(&self, tolerance: f64) -> bool {
        let [low, high] = [self.low * self.low, self.high * self.high];
        high - low <= larger(tolerance, OF_DOUBLE) * high
    }

    /// Whether s cannot be told from 0, as where a constraint is slack.
    pub fn may_be_zero(&self) -> bool {
        !(self.low > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[test]
    fn bounds_of_s_hold_it_whatever_the_bounds_of_its_square() {
        for (square, low, high) in [(0.49, 0.48, 0.5), (0.49, -1.0, 0.5), (0.49, 0.5, 0.49), (0.0, -1e-30, 1e-20)] {
            let scale = Scale::between(square, low, high);
            assert!(scale.low <= scale.s && scale.s - scale.gap <= scale.low * (1.0 + 1e-15), "{scale:?}");
            assert!(scale.high <= scale.s + scale.gap * (1.0 + 1e-15) || high < square, "{scale:?}");
        }
        assert!((Scale::between(0.25, 0.16, 0.36).gap - 0.1).abs() < 1e-15);
    }

    #[test]
    fn what_leaves_the_side_of_1_open_is_undecided() {
        for (low, high, undecided) in
            [(0.9, 0.99, false), (1.01, 3.0, false), (0.5, 1.5, true), (0.999, 1.001, false), (0.5, f64::NAN, true)]
        {
            let scale = Scale::between(0.5 * (low * low + high * high), low * low, high * high);
            assert_eq!(scale.is_undecided(false), undecided, "{scale:?}");
            assert_eq!(scale.is_undecided(true), high.is_nan(), "{scale:?}");
        }
        assert!(Scale::between(0.1, -1.0, 0.2).may_be_zero() && !Scale::between(0.1, 0.05, 0.2).may_be_zero());
    }
}
