//! The rule of mass properties on [0, 1], and what its error is at most.

use super::numbers::{LEAST_SHARE, MOST_SHARE, OF_FOURTH_POWER};

/// Number of points.
pub(crate) const POINTS: usize = 7;

/// Kronrod's extension of Lobatto's rule of 4 points (Gander & Gautschi 2000), both with the ends: point, weight in the
/// rule of 7 points, of degree 9, and in that of 4 points, of degree 5.
pub(crate) const RULE: [(f64, f64, f64); POINTS] = [
    (0.0, 11.0 / 420.0, 1.0 / 12.0),
    (0.091_751_709_536_136_98, 36.0 / 245.0, 0.0),
    (0.276_393_202_250_021, 125.0 / 588.0, 5.0 / 12.0),
    (0.5, 8.0 / 35.0, 0.0),
    (0.723_606_797_749_979, 125.0 / 588.0, 5.0 / 12.0),
    (0.908_248_290_463_863, 36.0 / 245.0, 0.0),
    (1.0, 11.0 / 420.0, 1.0 / 12.0),
];

/// Error of the rule of 7 points for a function whose second derivative lies between 0 and 1, wherever it jumps: half
/// of ∫|K|, with K the second Peano kernel, whose integral is 0.
pub(crate) const OF_JUMP: f64 = 6.198e-4;

/// Bound on the difference of the rules for the same functions, over that: half of ∫|K| of the difference.
pub(crate) const DIFFERENCE_OF_JUMP: f64 = 2.556e-3 / OF_JUMP;

/// Error of the rule of 7 points over its difference from that of 4, for a function that is analytic where D is not 0.
/// D is quadratic; here it has these values at 0, ½ and 1.
///
/// With α + β T₁ + γ T₂ its Chebyshev series, |D| ≥ α − |β| (ρ + 1/ρ)/2 − |γ| (ρ² + 1/ρ²)/2 in the ellipse around the
/// interval of which ρ is the sum of the half axes. The function is analytic in the largest one where that is positive.
pub(crate) fn share(first: f64, middle: f64, last: f64) -> f64 {
    let (alpha, beta) = (0.25 * (first + last + 2.0 * middle), 0.5 * (last - first).abs());
    let gamma = 0.25 * (first + last - 2.0 * middle).abs();
    // The root of γ ρ² + β ρ = 2 α − β/ρ − γ/ρ², with a lower bound of ρ on the right: first 1, then what that gives.
    let root = |least: f64| {
        let right = 2.0 * alpha - beta / least - gamma / (least * least);
        2.0 * right / (beta + (beta * beta + 4.0 * gamma * right.max(0.0)).sqrt())
    };
    let first = root(1.0);
    let rho = if first > 1.0 { root(first) } else { first };
    // Also where D is constant, and where it is not a number.
    if rho > 1.0 { (OF_FOURTH_POWER / rho.powi(4)).clamp(LEAST_SHARE, MOST_SHARE) } else { MOST_SHARE }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn integrals(f: impl Fn(f64) -> f64) -> [f64; 2] {
        RULE.iter().fold([0.0; 2], |[k, l], (t, kronrod, lobatto)| [k + kronrod * f(*t), l + lobatto * f(*t)])
    }

    #[test]
    fn powers_up_to_the_degree_are_exact() {
        for power in 0..=9 {
            let [seven, four] = integrals(|t| t.powi(power));
            let exact = 1.0 / f64::from(power + 1);
            assert!((seven - exact).abs() < 1e-15, "t^{power}: {seven}");
            assert_eq!((four - exact).abs() < 1e-15, power <= 5, "t^{power}: {four}");
        }
    }

    /// ⟨t − a⟩²/2, whose second derivative is 0 or 1, with the jump anywhere, and sums of two that jump up and down
    /// again.
    #[test]
    fn jumps_cost_no_more_than_is_said() {
        let cut = |t: f64, a: f64| 0.5 * (t - a).max(0.0).powi(2);
        let exact = |a: f64| (1.0 - a).powi(3) / 6.0;
        let mut most = [0.0_f64; 2];
        for i in 0..200 {
            for j in i..=200 {
                let (a, b) = (f64::from(i) / 200.0, f64::from(j) / 200.0);
                let [seven, four] = integrals(|t| cut(t, a) - cut(t, b));
                most[0] = most[0].max((seven - exact(a) + exact(b)).abs());
                most[1] = most[1].max((seven - four).abs());
            }
        }
        assert!(most[0] <= OF_JUMP && most[0] > 0.1 * OF_JUMP, "{:e}", most[0]);
        assert!(most[1] <= OF_JUMP * DIFFERENCE_OF_JUMP, "{:e}", most[1]);
    }

    /// 1, t and t² over D = (t − x)² + y², whose integrals are known: as for moments, their difference together is not
    /// small by chance.
    #[test]
    fn a_share_of_the_difference_holds_the_error_of_analytic_functions() {
        for i in 0..60 {
            for y in [0.3, 0.6, 1.0, 2.0] {
                let x = -2.0 + f64::from(i) / 12.0;
                let d = |t: f64| (t - x).powi(2) + y * y;
                let i0 = (((1.0 - x) / y).atan() + (x / y).atan()) / y;
                let i1 = 0.5 * (d(1.0) / d(0.0)).ln() + x * i0;
                let exact = [i0, i1, 1.0 + 2.0 * x * i1 - (x * x + y * y) * i0];
                let (mut error, mut difference) = (0.0_f64, 0.0_f64);
                for (power, exact) in exact.into_iter().enumerate() {
                    let [seven, four] = integrals(|t| t.powi(power as i32) / d(t));
                    (error, difference) = (error.hypot(seven - exact), difference.hypot(seven - four));
                }
                let bound = share(d(0.0), d(0.5), d(1.0)) * difference;
                assert!(error <= bound + 1e-14, "{x} {y}: {error:e}, {bound:e}");
            }
        }
    }
}
