//! Gauss rules: their points and weights, and how well a polynomial through the points meets the ends.

use super::numbers::FINE;
use std::sync::LazyLock;

/// Most points of a rule.
pub(super) const MOST_POINTS: usize = 16;

/// Gauss' rule of n points on [0, 1], of degree 2n − 1.
#[derive(Clone, Copy)]
pub(super) struct Gauss {
    /// Point and weight.
    pub nodes: [(f64, f64); MOST_POINTS],
    /// Weights with which the values at the points give that of their polynomial at 0; at 1 the same in reverse order.
    pub at_end: [f64; MOST_POINTS],
}

/// The rule of `points` points.
pub(super) fn gauss(points: usize) -> &'static Gauss {
    static RULES: LazyLock<[Gauss; MOST_POINTS]> = LazyLock::new(|| std::array::from_fn(|i| computed(i + 1)));
    &RULES[points.min(MOST_POINTS) - 1]
}

/// The rule of `points` points for functions that start with x² or x³, as do area and load of a zone that tapers to its
/// end at x = 0, where its border leaves the rim like a root or like a line: exact for x² to x^(2n + 1).
pub(super) fn tapering(points: usize) -> &'static [(f64, f64)] {
    static RULES: LazyLock<[[(f64, f64); MOST_POINTS]; MOST_POINTS]> =
        LazyLock::new(|| std::array::from_fn(|i| tapered(i + 1)));
    let points = points.min(MOST_POINTS);
    &RULES[points - 1][..points]
}

/// Gauss' rule for the weight x², by Newton's method for the roots of Jacobi's polynomial of the orders 0 and 2; its
/// weights over x².
fn tapered(points: usize) -> [(f64, f64); MOST_POINTS] {
    let n = points as f64;
    let mut nodes = [(0.0, 0.0); MOST_POINTS];
    for (i, node) in nodes[..points].iter_mut().enumerate() {
        let mut x = (std::f64::consts::PI * (2.0 * i as f64 + 1.5) / (2.0 * n + 3.0)).cos();
        let mut slope = 1.0;
        for _ in 0..12 {
            let (mut before, mut value) = (1.0, 2.0 * x - 1.0);
            for j in 2..=points {
                let j = j as f64;
                let [a, b, c] =
                    [2.0 * j * (j + 2.0) * (2.0 * j), 2.0 * j + 1.0, 2.0 * (j - 1.0) * (j + 1.0) * (2.0 * j + 2.0)];
                (before, value) = (value, (b * ((2.0 * j + 2.0) * 2.0 * j * x - 4.0) * value - c * before) / a);
            }
            let m = 2.0 * n + 2.0;
            slope = (n * (-2.0 - m * x) * value + 2.0 * n * (n + 2.0) * before) / (m * (1.0 - x * x));
            x -= value / slope;
        }
        let place = 0.5 * (1.0 + x);
        *node = (place, 1.0 / ((1.0 - x * x) * slope * slope * place * place));
    }
    nodes
}

/// The roots of Legendre's polynomial by Newton's method, from Tricomi's approximation.
fn computed(points: usize) -> Gauss {
    let n = points as f64;
    let mut nodes = [(0.0, 0.0); MOST_POINTS];
    for (i, node) in nodes[..points].iter_mut().enumerate() {
        let mut x = -(std::f64::consts::PI * (i as f64 + 0.75) / (n + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..8 {
            let (mut before, mut value) = (0.0, 1.0);
            for j in 1..=points {
                let j = j as f64;
                (before, value) = (value, ((2.0 * j - 1.0) * x * value - (j - 1.0) * before) / j);
            }
            slope = n * (x * value - before) / (x * x - 1.0);
            x -= value / slope;
        }
        *node = (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope));
    }
    let mut at_end = [0.0; MOST_POINTS];
    for i in 0..points {
        let others = (0..points).filter(|j| *j != i);
        at_end[i] = others.map(|j| nodes[j].0 / (nodes[j].0 - nodes[i].0)).product();
    }
    Gauss { nodes, at_end }
}

/// Points in a cell of a ray that starts on the rim of a flat part, or of one of the plane.
pub(super) fn order_of(tolerance: f64) -> usize {
    if tolerance >= FINE { 3 } else { 5 }
}

/// Gauss' rule of 3 points and its extension by Kronrod to 7, on [0, 1]: point, weight among 3, weight among 7. The
/// first is the middle, the first three are Gauss' own.
pub(super) const GAUSS_KRONROD: [(f64, f64, f64); 7] = [
    (0.5, 4.0 / 9.0, 0.225_458_269_329_237_07),
    (0.112_701_665_379_258_31, 5.0 / 18.0, 0.134_244_044_934_166_72),
    (0.887_298_334_620_741_7, 5.0 / 18.0, 0.134_244_044_934_166_72),
    (0.019_754_365_645_988_79, 0.0, 0.052_328_113_013_233_63),
    (0.980_245_634_354_011_2, 0.0, 0.052_328_113_013_233_63),
    (0.282_878_125_326_598_8, 0.0, 0.200_698_707_387_981_11),
    (0.717_121_874_673_401_2, 0.0, 0.200_698_707_387_981_11),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_up_to_the_degree_are_exact() {
        for points in 1..=MOST_POINTS {
            for power in 0..2 * points as i32 {
                let sum: f64 = gauss(points).nodes[..points].iter().map(|(x, w)| w * x.powi(power)).sum();
                assert!((sum - 1.0 / f64::from(power + 1)).abs() < 1e-14, "{points} points, x^{power}: {sum}");
            }
            for power in 0..points as i32 {
                let rule = gauss(points);
                let sum: f64 = (0..points).map(|i| rule.at_end[i] * (1.0 - rule.nodes[i].0).powi(power)).sum();
                assert!((sum - 1.0).abs() < 1e-9, "{points} points, (1-x)^{power} at 0: {sum}");
            }
        }
    }

    #[test]
    fn powers_from_the_second_on_are_exact_where_a_zone_tapers() {
        for points in 1..=MOST_POINTS {
            for power in 2..2 * points as i32 + 2 {
                let sum: f64 = tapering(points).iter().map(|(x, w)| w * x.powi(power)).sum();
                assert!((sum * f64::from(power + 1) - 1.0).abs() < 1e-12, "{points} points, x^{power}: {sum}");
            }
        }
    }

    #[test]
    fn the_extension_has_degree_11() {
        for power in 0..=11 {
            let exact = 1.0 / f64::from(power + 1);
            let [three, seven] =
                GAUSS_KRONROD.iter().fold([0.0; 2], |[g, k], (x, a, b)| [g + a * x.powi(power), k + b * x.powi(power)]);
            assert!((seven - exact).abs() < 1e-14, "x^{power}: {seven}");
            assert_eq!((three - exact).abs() < 1e-14, power <= 5, "x^{power}: {three}");
        }
    }
}
