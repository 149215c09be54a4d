//! Roots of functions of one unknown on a bracket.

/// An interval with the root in it: the function is ≤ 0 at `low` and > 0 at `high`. Either end may be infinite.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bracket {
    pub low: f64,
    pub high: f64,
}

impl Bracket {
    /// Whether t lies strictly inside. False for NaN.
    #[inline(always)]
    pub fn contains(&self, t: f64) -> bool {
        self.low < t && t < self.high
    }

    #[inline(always)]
    pub fn middle(&self) -> f64 {
        0.5 * (self.low + self.high)
    }

    /// Moves one end to t, which lies beyond the root (the function is positive there) or not.
    #[inline(always)]
    pub fn narrow(&mut self, t: f64, is_beyond: bool) {
        if is_beyond {
            self.high = t;
        } else {
            self.low = t;
        }
    }
}

/// Most steps of a search with a bracket, here and elsewhere: halving alone leaves 2⁻¹⁰⁰ of it (chosen).
pub(crate) const MOST_STEPS: usize = 100;

/// The lower end of a bracket that was halved until nothing is left of it.
pub(crate) fn halved(mut bracket: Bracket, is_beyond: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..MOST_STEPS {
        let middle = bracket.middle();
        if !bracket.contains(middle) {
            break;
        }
        bracket.narrow(middle, is_beyond(middle));
    }
    bracket.low
}

/// The root of a function that changes its sign once on a finite bracket, from below to above, by Newton's method.
///
/// `at` returns value and slope. Where Newton's step leaves the bracket, or is not a number, the bracket is halved:
/// every step narrows it, and near a simple root the convergence is quadratic. The search ends with a step of at most
/// `last_step`·|t|. If that was one of Newton's, what it leaves is about its square, in units of the curvature over the
/// slope; if it was a bisection, the root is nearer than the step.
pub(crate) fn newton(mut bracket: Bracket, start: f64, last_step: f64, mut at: impl FnMut(f64) -> (f64, f64)) -> f64 {
    let mut t = start;
    for _ in 0..MOST_STEPS {
        let (value, slope) = at(t);
        bracket.narrow(t, value > 0.0);
        let newton = t - value / slope;
        let next = if bracket.contains(newton) { newton } else { bracket.middle() };
        if (next - t).abs() <= last_step * next.abs() {
            return next;
        }
        t = next;
    }
    t
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn simple_multiple_and_extreme_roots() {
        let bracket = Bracket { low: 0.0, high: 2.0 };
        let simple = newton(bracket, 0.0, 1e-7, |t| (t * t - 2.0, 2.0 * t));
        assert!((simple - 2f64.sqrt()).abs() <= 2.0 * f64::EPSILON, "{simple}");
        // Newton's step from 0 leaves the bracket, and at the root its slope vanishes.
        let threefold = newton(bracket, 0.0, 1e-12, |t| ((t - 1.5).powi(3), 3.0 * (t - 1.5).powi(2)));
        assert!((threefold - 1.5).abs() <= 1e-9, "{threefold}");
        let tiny = newton(bracket, 1.0, 1e-12, |t| (t - 1e-15, 1.0));
        assert!((tiny / 1e-15 - 1.0).abs() <= 1e-12, "{tiny:e}");
    }

    #[test]
    fn without_a_slope_it_bisects() {
        for root in [0.1, 0.7, 1.0 / 3.0] {
            let found = newton(Bracket { low: 0.0, high: 1.0 }, 0.0, 1e-14, |t| (t - root, 0.0));
            assert!((found - root).abs() <= 1e-13, "{found}");
        }
    }
}
