//! Quadrature over a triangle with curved sides, each a parabola through three points.

use super::form::Form;
use super::ray::Node;

/// Corners, and the middles of the sides 0–1, 1–2, 2–0.
#[derive(Clone, Copy, Debug)]
pub(super) struct CurvedTriangle {
    pub corners: [[f64; 2]; 3],
    pub middles: [[f64; 2]; 3],
}

/// Points of the rule.
pub(super) const POINTS: usize = 16;

/// The rule of degree 8 of Dunavant (1985): barycentric coordinates, weights, and the weights of one of degree 4 on the same points.
const RULE: [([f64; 3], f64, f64); POINTS] = {
    // By orbits of the permutations of the coordinates: of the middle, of (1 − 2 t, t, t), and of all three different.
    const B: f64 = 0.459_292_588_292_747_7;
    const C: f64 = 0.170_569_307_751_812_37;
    const D: f64 = 0.050_547_228_317_048_36;
    const E: [f64; 3] =
        [0.263_112_829_634_565_3, 0.008_394_777_409_977_376, 1.0 - 0.263_112_829_634_565_3 - 0.008_394_777_409_977_376];
    const OF_B: [f64; 2] = [0.095_091_634_267_259_11, 0.175_050_355_106_292_94];
    const OF_C: [f64; 2] = [0.103_217_370_534_725_47, 0.128_728_543_530_628_46];
    const OF_D: [f64; 2] = [0.032_458_497_623_210_916, 0.049_492_071_424_056_87];
    const OF_E: [f64; 2] = [0.027_230_314_174_438_656, -0.009_968_818_363_822_513];
    const fn twice(t: f64, place: usize, [w, low]: [f64; 2]) -> ([f64; 3], f64, f64) {
        let mut l = [t; 3];
        l[place] = 1.0 - 2.0 * t;
        (l, w, low)
    }
    const fn once(i: usize, j: usize, k: usize) -> ([f64; 3], f64, f64) {
        ([E[i], E[j], E[k]], OF_E[0], OF_E[1])
    }
    [
        ([1.0 / 3.0; 3], 0.144_315_607_677_781_2, 0.0),
        twice(B, 0, OF_B),
        twice(B, 1, OF_B),
        twice(B, 2, OF_B),
        twice(C, 0, OF_C),
        twice(C, 1, OF_C),
        twice(C, 2, OF_C),
        twice(D, 0, OF_D),
        twice(D, 1, OF_D),
        twice(D, 2, OF_D),
        once(0, 1, 2),
        once(1, 2, 0),
        once(2, 0, 1),
        once(0, 2, 1),
        once(2, 1, 0),
        once(1, 0, 2),
    ]
};

/// Integrals of p n, of p u and p v, and of |n|.
pub(super) const INTEGRALS: usize = 6;

/// Integrals over a triangle by the rule, and how far those of degree 4 are off.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Integrals {
    pub value: [f64; INTEGRALS],
    pub off: [f64; INTEGRALS],
}

impl CurvedTriangle {
    /// With straight sides but for the given middles.
    pub fn new(corners: [[f64; 2]; 3], middles: [Option<[f64; 2]>; 3]) -> Self {
        let straight = |i: usize| [0, 1].map(|c| 0.5 * (corners[i][c] + corners[(i + 1) % 3][c]));
        Self { corners, middles: std::array::from_fn(|i| middles[i].unwrap_or_else(|| straight(i))) }
    }

    /// The point at barycentric coordinates, and the Jacobian there over twice the area of the coordinates' triangle.
    #[inline(always)]
    fn at(&self, l: &[f64; 3]) -> ([f64; 2], f64) {
        let Self { corners: p, middles: m } = self;
        let (mut x, mut by) = ([0.0; 2], [[0.0; 2]; 2]);
        let at_corner = l.map(|l| l * (2.0 * l - 1.0));
        let at_middle = [4.0 * l[0] * l[1], 4.0 * l[1] * l[2], 4.0 * l[2] * l[0]];
        let slopes = l.map(|l| 4.0 * l - 1.0);
        for c in 0..2 {
            x[c] = (0..3).map(|i| at_corner[i] * p[i][c] + at_middle[i] * m[i][c]).sum();
            // Along the first two coordinates, the third falling.
            let along: [f64; 3] = std::array::from_fn(|i| {
                slopes[i] * p[i][c] + 4.0 * (l[(i + 1) % 3] * m[i][c] + l[(i + 2) % 3] * m[(i + 2) % 3][c])
            });
            by[c] = [along[0] - along[2], along[1] - along[2]];
        }
        (x, by[0][0] * by[1][1] - by[0][1] * by[1][0])
    }

    /// Whether it turns counter-clockwise all over its points.
    pub fn is_regular(&self) -> bool {
        RULE.iter().all(|(l, ..)| self.at(l).1 > 0.0)
    }

    /// Integrates over the part whose corners have these barycentric coordinates; `None` where the patch is no graph.
    #[inline(always)]
    pub fn integrate(&self, part: &[[f64; 3]; 3], form: &Form, nodes: &mut [Node]) -> Option<Integrals> {
        let mut sums = Integrals::default();
        let [a, b, c] = part;
        let share = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0]);
        for ((l, weight, low), node) in RULE.iter().zip(nodes) {
            let at: [f64; 3] = std::array::from_fn(|i| l[0] * a[i] + l[1] * b[i] + l[2] * c[i]);
            let (x, jacobian) = self.at(&at);
            let found = form.node(x)?;
            let area = 0.5 * share.abs() * jacobian;
            *node = Node { weight: weight * area, ..found };
            let Node { x: [u, v, _], pressure, normal: [n_u, n_v], .. } = found;
            let stretch = (1.0 + n_u * n_u + n_v * n_v).sqrt();
            let values = [pressure * n_u, pressure * n_v, pressure, pressure * u, pressure * v, stretch];
            for (i, value) in values.into_iter().enumerate() {
                sums.value[i] += weight * area * value;
                sums.off[i] += (weight - low) * area * value;
            }
        }
        Some(sums)
    }
}

/// The corners of a whole triangle.
pub(super) const WHOLE: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Its four quarters.
pub(super) fn quarters([a, b, c]: &[[f64; 3]; 3]) -> [[[f64; 3]; 3]; 4] {
    let between = |p: &[f64; 3], q: &[f64; 3]| std::array::from_fn(|i| 0.5 * (p[i] + q[i]));
    let (ab, bc, ca) = (between(a, b), between(b, c), between(c, a));
    [[*a, ab, ca], [ab, *b, bc], [ca, bc, *c], [ab, bc, ca]]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ∫ λ₁^i λ₂^j over a triangle is i! j! 2 A / (i + j + 2)!.
    #[test]
    fn the_rules_have_their_degrees() {
        let factorial = |n: i32| (1..=n).map(f64::from).product::<f64>();
        for (i, j) in (0..=8).flat_map(|i| (0..=8 - i).map(move |j| (i, j))) {
            let exact = 2.0 * factorial(i) * factorial(j) / factorial(i + j + 2);
            let [fine, coarse] = [0, 1].map(|which| {
                let weight = |(_, w, low): &([f64; 3], f64, f64)| if which == 0 { *w } else { *low };
                RULE.iter().map(|rule| weight(rule) * rule.0[0].powi(i) * rule.0[1].powi(j)).sum::<f64>()
            });
            assert!((fine - exact).abs() < 1e-15, "{i} {j}");
            assert!(i + j > 4 || (coarse - exact).abs() < 1e-15, "{i} {j}");
        }
    }

    #[test]
    fn a_sector_with_an_arc_has_its_area_to_fourth_order() {
        for turn in [0.5, 1.0] {
            let at = |angle: f64| [f64::cos(angle), f64::sin(angle)];
            let sector =
                CurvedTriangle::new([[0.0, 0.0], at(0.0), at(turn)], [None, Some(at(0.5 * turn)), None]);
            let area: f64 = RULE.iter().map(|(l, w, _)| 0.5 * w * sector.at(l).1).sum();
            assert!((area / (0.5 * turn) - 1.0).abs() < 1e-3 * turn.powi(4), "{area}");
        }
    }
}
