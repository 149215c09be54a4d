//! Polynomials in Bernstein form on 0 ≤ λ ≤ 1: signs and roots.
//!
//! A quadratic is c₀(1−λ)² + 2c₁λ(1−λ) + c₂λ², a quartic c₀(1−λ)⁴ + 4c₁λ(1−λ)³ + … + c₄λ⁴. By Descartes' rule the
//! coefficients change their sign at least as often as the polynomial.

use super::numbers::LAST_STEP;
use crate::linalg::root::{self, Bracket};

/// A parameter as (1−λ, λ): both ends are equally precise.
pub(super) type Parameter = [f64; 2];

/// Where a quadratic with c₀ ≤ 0 ≤ c₂ rises through zero; if it vanishes everywhere, the end.
pub(super) fn rising_root([c0, c1, c2]: [f64; 3]) -> Parameter {
    let root = (c1 * c1 - c0 * c2).sqrt();
    // Of the two forms of the root the one without cancellation.
    let [a, b] = if c1 >= 0.0 { [c1 + root, -c0] } else { [c2, root - c1] };
    let sum = a + b;
    if sum > 0.0 { [a / sum, b / sum] } else { [0.0, 1.0] }
}

/// The interval in which a quadratic is positive, if it is an interval; an end of it at 0 or 1 is `None`.
pub(super) fn positive_interval([c0, c1, c2]: [f64; 3]) -> Option<(Option<Parameter>, Option<Parameter>)> {
    let discriminant = c1 * c1 - c0 * c2;
    if c0 <= 0.0 && c2 <= 0.0 && (c1 <= 0.0 || discriminant <= 0.0) {
        return None;
    }
    let start = (c0 < 0.0).then(|| rising_root([c0, c1, c2]));
    let end = (c2 < 0.0).then(|| {
        let [b, a] = rising_root([c2, c1, c0]);
        [a, b]
    });
    Some((start, end))
}

/// Both halves of a quartic (de Casteljau).
pub(super) fn halves(mut c: [f64; 5]) -> ([f64; 5], [f64; 5]) {
    let (mut left, mut right) = (c, c);
    for round in 1..5 {
        for i in 0..5 - round {
            c[i] = 0.5 * (c[i] + c[i + 1]);
        }
        left[round] = c[0];
        right[4 - round] = c[4 - round];
    }
    (left, right)
}

/// Where a quartic changes its sign, which it does once.
pub(super) fn sign_change(mut c: [f64; 5]) -> Parameter {
    let (middle, _) = value_and_slope(&c, 0.5);
    if (middle > 0.0) == (c[4] > 0.0) {
        let t = root_in_first_half(&c);
        [1.0 - t, t]
    } else {
        c.reverse();
        let t = root_in_first_half(&c);
        [t, 1.0 - t]
    }
}

/// The root in (0, ½] of a quartic that changes its sign there, once.
fn root_in_first_half(c: &[f64; 5]) -> f64 {
    let sign = if c[0] <= 0.0 { 1.0 } else { -1.0 };
    root::newton(Bracket { low: 0.0, high: 0.5 }, 0.0, LAST_STEP, |t| {
        let (value, slope) = value_and_slope(c, t);
        (sign * value, sign * slope)
    })
}

fn value_and_slope(c: &[f64; 5], t: f64) -> (f64, f64) {
    let u = 1.0 - t;
    let cubic = |c: [f64; 4]| u * u * (u * c[0] + 3.0 * t * c[1]) + t * t * (3.0 * u * c[2] + t * c[3]);
    let left = cubic([c[0], c[1], c[2], c[3]]);
    let right = cubic([c[1], c[2], c[3], c[4]]);
    (u * left + t * right, 4.0 * (right - left))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_of_quadratics() {
        // −(λ − ¼)(λ − ¾) in Bernstein form.
        let (start, end) = positive_interval([-0.1875, 0.3125, -0.1875]).unwrap();
        assert_eq!((start, end), (Some([0.75, 0.25]), Some([0.25, 0.75])));
        assert_eq!(positive_interval([1.0, 1.0, 1.0]), Some((None, None)));
        assert_eq!(positive_interval([-1.0, 0.5, -1.0]), None);
        assert_eq!(rising_root([0.0; 3]), [0.0, 1.0]);
    }

    #[test]
    fn the_sign_change_of_a_quartic_near_either_end() {
        for root in [1e-12, 0.2, 0.499, 0.501, 0.8, 1.0 - 1e-12] {
            // (λ − root)·((1−λ)³ + λ³), whose second factor is positive.
            let (low, high) = (-root, 1.0 - root);
            let c = [low, 0.25 * high, 0.0, 0.25 * low, high];
            let [u, t] = sign_change(c);
            assert!((t - root).abs() <= 1e-12 * root && (u + t - 1.0).abs() <= f64::EPSILON, "{t} for {root}");
            let (left, right) = halves(c);
            assert!((left[4] - value_and_slope(&c, 0.5).0).abs() < 1e-15 && left[4] == right[0]);
        }
    }
}
