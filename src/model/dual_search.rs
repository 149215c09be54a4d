//! The two quadratics at a point, solved exactly: one step of the fast solver.
//!
//! The optimum lies on their [`crate::model::dual_path`], where the mismatch of the problem is zero: λ is searched
//! along its series, or in logarithms where that is of no use.

use crate::linalg::number::{Number, Single, Twin, larger};
use crate::linalg::symmetric::Symmetric;
use crate::model::dual_path::{DualPath, Optimum, Probe, Side};
use crate::model::problem::Problem;
use crate::pair::pair_state::LAMBDA_RANGE;
use crate::particle::potential::Quadratic;
use nalgebra::{SimdValue, Vector3};

/// The curve, and what the search along it has to know besides.
#[derive(Clone, Copy)]
pub(crate) struct DualSearch<'a, N = f64> {
    curve: DualPath<'a, N>,
    problem: Problem,
    /// Sum of those values at the point of expansion that enter the mismatch.
    expanded: f64,
}

/// Mismatch at which λ counts as settled (chosen), in numbers of this unit: 4 units of the values at the point of
/// expansion and 8 of the larger side.
#[inline(always)]
fn noise<N: Number>(unit: f64, expanded: N, larger: N) -> N {
    N::of(4.0 * unit) * expanded + N::of(8.0 * unit) * larger
}

/// Most values of λ tried in one solve; a handful is enough where rounding does not interfere (chosen).
const MOST_TRIALS: usize = 40;

/// One solve moves λ by at most this factor: quadratics that miss the planes further on may not reach the problem at
/// all (chosen).
const FARTHEST: f64 = 1e6;

/// Largest share of the higher terms of the series in the first one at which the series is used at all: what is left
/// out then is some 1e-3 of the mismatch (chosen).
const NEAR: f64 = 0.1;

/// The same share at which a point is taken to the third order: some share⁴ = 8e-15 of it is left out, and
/// `is_balanced` decides (derived).
const VERY_NEAR: f64 = 3e-4;

/// Points of both curves from which P1 and P2 are looked for before each is searched alone: where λ was guessed, and
/// where the series leads from there. Measured: with one, closest calls take up to twice as long (docs/theory.md, 9).
const MOST_PROBES: usize = 2;

/// Where a search goes from a point of the curve.
enum Advance<N> {
    Optimum(Optimum<N>),
    Lambda(N),
}

/// The values of λ between which that of the optimum lies, limited to those that one search may go to.
struct LimitedBracket<N> {
    low: N,
    high: N,
    nearest: N,
    farthest: N,
}

impl<N: Single> LimitedBracket<N> {
    #[inline(always)]
    fn about(lambda: N) -> Self {
        let (nearest, farthest) = (lambda / N::of(FARTHEST), lambda * N::of(FARTHEST));
        Self { low: nearest, high: farthest, nearest, farthest }
    }

    /// Leaves out what is beyond a λ that was too large or too small.
    #[inline(always)]
    fn narrow(&mut self, lambda: N, too_large: bool) {
        if too_large {
            self.high = lambda;
        } else {
            self.low = lambda;
        }
    }

    /// λ, or where it is beyond what is known of the curve: to its end, and no further.
    #[inline(always)]
    fn kept(&self, lambda: N) -> N {
        let (beyond_high, beyond_low) = (self.high.is_at_most(lambda), lambda.is_at_most(self.low));
        if beyond_high && self.high == self.farthest {
            self.farthest
        } else if beyond_low && self.low == self.nearest {
            self.nearest
        } else if !beyond_high && !beyond_low {
            lambda
        } else {
            N::of((self.low * self.high).approximate().sqrt())
        }
    }

    #[inline(always)]
    fn is_end(&self, lambda: N) -> bool {
        lambda == self.nearest || lambda == self.farthest
    }
}

impl<'a, N: Single> DualSearch<'a, N> {
    #[inline(always)]
    pub fn new(a: Side<'a, N>, b: Side<'a, N>, problem: Problem) -> Self {
        let (of_a, of_b) = problem.changes(a.value.approximate(), b.value.approximate());
        Self { curve: DualPath::new(a, b, problem), problem, expanded: of_a + of_b }
    }

    /// Searches λ from a guess until the two sides meet as well as rounding allows. `None` when a factorisation breaks
    /// down.
    #[inline(always)]
    pub fn solve(&self, guess: N) -> Option<Optimum<N>> {
        let approximate = guess.approximate();
        let kept = approximate.clamp(LAMBDA_RANGE.0, LAMBDA_RANGE.1);
        let mut found = self.curve.probe(if kept == approximate { guess } else { N::of(kept) })?;
        let mut bracket = LimitedBracket::about(found.lambda);
        for _ in 0..MOST_TRIALS {
            let (growing, falling) = self.sides(&found.values);
            let (difference, larger) =
                (self.problem.difference(found.mismatch.approximate()), larger(growing, falling));
            if !difference.is_finite() {
                return None;
            }
            let noise = noise(N::UNIT, self.expanded, larger);
            if difference.abs() <= noise {
                return Some(Optimum { settled: true, ..self.curve.optimum(&found) });
            }
            bracket.narrow(found.lambda, difference > 0.0);
            let next = match self.advance(&found, (growing, falling), noise) {
                Advance::Optimum(optimum) => return Some(optimum),
                Advance::Lambda(next) => bracket.kept(next),
            };
            if next == found.lambda {
                // No λ does better. At an end of the range there may be a better one, for other quadratics.
                return Some(Optimum { settled: !bracket.is_end(next), ..self.curve.optimum(&found) });
            }
            found = self.curve.probe(next)?;
        }
        Some(self.curve.optimum(&found))
    }

    /// Along the series to the optimum, where that is all that is left; else to another λ.
    #[inline(always)]
    fn advance(&self, found: &Probe<N>, (growing, falling): (f64, f64), noise: f64) -> Advance<N> {
        // In numbers of 32 digits the series gains as many digits a search, but has more to gain.
        let last_at_once = VERY_NEAR * (2.0 * N::UNIT / f64::EPSILON).sqrt().sqrt();
        let series = self.curve.series(found).filter(|series| series.share.approximate() <= NEAR);
        let Some(series) = series else { return Advance::Lambda(N::of(self.far(*found, growing, falling))) };
        if series.share.approximate() <= last_at_once {
            let further = self.curve.along(found, &series);
            if self.mismatch(&further) <= noise && self.curve.is_balanced(&further) {
                return Advance::Optimum(Optimum { settled: true, ..further });
            }
        }
        Advance::Lambda(series.lambda)
    }

    #[inline(always)]
    fn sides(&self, values: &(N, N)) -> (f64, f64) {
        self.problem.sides(values.0.approximate(), values.1.approximate())
    }

    /// How far the two sides are from being equal.
    #[inline(always)]
    fn mismatch(&self, optimum: &Optimum<N>) -> f64 {
        self.problem.mismatch(optimum.values.0, optimum.values.1).approximate()
    }

    /// The next λ where the series is of no use: far off, the logarithms of both sides are nearly linear in ln λ.
    #[cold]
    fn far(self, found: Probe<N>, growing: f64, falling: f64) -> f64 {
        let weights = (found.weights.0.approximate(), found.weights.1.approximate());
        // The weighted sum stays what it is on the curve, to first order.
        let rate = -self.problem.per_logarithm(weights) * found.rate.approximate();
        let (rate_a, rate_b) = self.problem.apart(0.0, rate, weights);
        let (rate_growing, rate_falling) = self.problem.changes(rate_a, rate_b);
        let change = if growing.min(falling) > 0.0 {
            (falling / growing).ln() / (rate_growing / growing - rate_falling / falling)
        } else {
            (falling - growing) / (rate_growing - rate_falling)
        };
        // Only so that exp stays a number: the bracket allows ln FARTHEST, 14.
        found.lambda.approximate() * change.clamp(-60.0, 60.0).exp()
    }
}

/// A quadratic and its least curvature.
#[inline(always)]
pub(crate) fn side(q: &Quadratic, soft: f64) -> Side<'_, f64> {
    Side { value: q.expansion, gradient: &q.gradient, hessian: &q.hessian, soft }
}

/// P1 and P2 along the series of their curves, from guesses of their λ; `None` where that does not do.
///
/// Each holds one body at S = 1 and minimises the other's S: the same in two lanes, in one of them with the bodies
/// swapped.
#[inline(always)]
pub(crate) fn both_closest([q_a, q_b]: [&Quadratic; 2], soft: (f64, f64), lambdas: [f64; 2]) -> Option<[Optimum; 2]> {
    let is_weight = |lambda: f64| lambda > LAMBDA_RANGE.0 && lambda < LAMBDA_RANGE.1;
    if !lambdas.into_iter().all(is_weight) {
        return None;
    }
    let (of, twin) = (Twin::splat, |x: &Vector3<f64>, y: &Vector3<f64>| x.zip_map(y, Twin::new));
    let (g_free, g_held) = (twin(&q_a.gradient, &q_b.gradient), twin(&q_b.gradient, &q_a.gradient));
    let h_free = Symmetric::twin(&q_a.hessian, &q_b.hessian);
    let h_held = Symmetric::twin(&q_b.hessian, &q_a.hessian);
    let value = Twin::new(q_a.expansion, q_b.expansion);
    let free = Side { value, gradient: &g_free, hessian: &h_free, soft: Twin::new(soft.0, soft.1) };
    let value = Twin::new(q_b.expansion, q_a.expansion);
    let held = Side { value, gradient: &g_held, hessian: &h_held, soft: Twin::new(soft.1, soft.0) };
    let curve = DualPath::new(free, held, Problem::OnB);
    let mut lambda = Twin::new(lambdas[1], 1.0 / lambdas[0]);
    for _ in 0..MOST_PROBES {
        let probe = curve.probe(lambda)?;
        let series = curve.series(&probe)?;
        if series.share.is_at_most(of(VERY_NEAR)) {
            let found = curve.along(&probe, &series);
            let noise = noise(Twin::UNIT, held.value, probe.values.1.larger(of(1.0)));
            let settled = (found.values.1 - of(1.0)).magnitude().is_at_most(noise) && curve.is_balanced(&found);
            return settled.then(|| [found.lane(1).swapped(), found.lane(0)]);
        }
        if !series.share.is_at_most(of(NEAR)) {
            return None;
        }
        lambda = series.lambda;
    }
    None
}

impl Optimum {
    /// With A and B the other way round.
    #[inline(always)]
    fn swapped(self) -> Self {
        let (gradients, values) = ([self.gradients[1], self.gradients[0]], (self.values.1, self.values.0));
        Self { gradients, values, lambda: 1.0 / self.lambda, factored: 1.0 / self.factored, ..self }
    }
}

impl Optimum<Twin> {
    /// That of one lane, of which λ is as good as rounding allows.
    #[inline(always)]
    fn lane(&self, i: usize) -> Optimum {
        let vector = |v: &Vector3<Twin>| v.map(|x| x.0[i]);
        Optimum {
            step: vector(&self.step),
            gradients: [vector(&self.gradients[0]), vector(&self.gradients[1])],
            values: (self.values.0.0[i], self.values.1.0[i]),
            lambda: self.lambda.0[i],
            settled: true,
            factor: self.factor.lane(i),
            factored: self.factored.0[i],
            along: vector(&self.along),
            mismatch_rate: self.mismatch_rate.0[i],
        }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// S of two bodies whose surfaces are ellipsoids, seen from a point between them.
    pub(crate) fn two_ellipsoids() -> [Quadratic; 2] {
        let about = |centre: [f64; 3], hessian: Symmetric| {
            let to_centre = Vector3::from(centre);
            let gradient = -hessian.times(&to_centre);
            let value = -0.5 * gradient.dot(&to_centre);
            Quadratic { value, expansion: value, gradient, hessian, pull: 0.0, count: 0, clear: f64::INFINITY }
        };
        let of_a = Symmetric { xx: 2.5, yx: 0.3, yy: 4.0, zx: -0.2, zy: 0.1, zz: 1.5 };
        let of_b = Symmetric { xx: 1.8, yx: -0.1, yy: 2.0, zx: 0.4, zy: 0.5, zz: 5.0 };
        [about([-0.9, 0.1, 0.2], of_a), about([0.95, -0.2, 0.1], of_b)]
    }

    #[test]
    fn both_closest_points_in_lanes_are_those_of_the_search() {
        let [q_a, q_b] = two_ellipsoids();
        let soft = (1.0, 1.0);
        let alone = [Problem::OnA, Problem::OnB]
            .map(|problem| DualSearch::new(side(&q_a, soft.0), side(&q_b, soft.1), problem).solve(1.0).unwrap());
        let guesses = |off: f64| [alone[0].lambda * (1.0 + off), alone[1].lambda * (1.0 - off)];
        // By one probe, and by two.
        for off in [1e-4, 1e-2] {
            let both = both_closest([&q_a, &q_b], soft, guesses(off)).expect("guesses from nearby");
            for ((problem, alone), both) in [Problem::OnA, Problem::OnB].into_iter().zip(&alone).zip(&both) {
                assert!((both.step - alone.step).norm() < 1e-14, "{problem:?}");
                assert!((both.lambda / alone.lambda - 1.0).abs() < 1e-13, "{problem:?}");
                assert!(problem.mismatch(both.values.0, both.values.1) < 1e-14, "{problem:?}");
                assert!(both.slope(problem).norm() < 1e-14, "{problem:?}");
            }
        }
        // From too far, and of no weights, it is left to the search.
        assert!(both_closest([&q_a, &q_b], soft, guesses(0.0).map(|guess| 1.5 * guess)).is_none());
        assert!(both_closest([&q_a, &q_b], soft, [-1.0, 1.0]).is_none());
    }
}
