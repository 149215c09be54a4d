//! Quadrature over a triangle with curved sides, each a parabola through three points.

use super::form::Form;
use super::ray::Node;

/// Corners, and the middles of the sides 0–1, 1–2, 2–0.
#[derive(Clone, Copy, Debug)]
pub(super) struct CurvedTriangle {
    pub corners: [[f64; 2]; 3],
    pub middles: [[f64; 2]; 3],
}

/// Most points of a rule.
pub(super) const POINTS: usize = 16;

/// A point of a rule: barycentric coordinates, weight, and that in a rule of lower degree on the same points.
type Point = ([f64; 3], f64, f64);

/// A point whose coordinates are t but for one.
const fn twice(t: f64, place: usize, [w, low]: [f64; 2]) -> Point {
    let mut l = [t; 3];
    l[place] = 1.0 - 2.0 * t;
    (l, w, low)
}

/// Radon's rule of degree 5, and one of degree 2.
const COARSE: [Point; 7] = {
    const A: f64 = 0.101_286_507_323_456_34;
    const B: f64 = 0.470_142_064_105_115_1;
    // ∫ λ² = 1/6 each, without the middle.
    const SQUARES_A: f64 = (1.0 - 2.0 * A) * (1.0 - 2.0 * A) + 2.0 * A * A;
    const SQUARES_B: f64 = (1.0 - 2.0 * B) * (1.0 - 2.0 * B) + 2.0 * B * B;
    const LOW: f64 = (0.5 - SQUARES_B) / (3.0 * (SQUARES_A - SQUARES_B));
    const OF_A: [f64; 2] = [0.125_939_180_544_827_15, LOW];
    const OF_B: [f64; 2] = [0.132_394_152_788_506_2, 1.0 / 3.0 - LOW];
    [
        ([1.0 / 3.0; 3], 0.225, 0.0),
        twice(A, 0, OF_A),
        twice(A, 1, OF_A),
        twice(A, 2, OF_A),
        twice(B, 0, OF_B),
        twice(B, 1, OF_B),
        twice(B, 2, OF_B),
    ]
};

/// The rule of degree 8 of Dunavant (1985), and one of degree 4.
const FINE: [Point; POINTS] = {
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
    const fn once(i: usize, j: usize, k: usize) -> Point {
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

/// How many points are asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Rule {
    Coarse,
    Fine,
}

impl Rule {
    fn points(self) -> &'static [Point] {
        match self {
            Self::Coarse => &COARSE,
            Self::Fine => &FINE,
        }
    }

    /// Number of its points.
    pub fn count(self) -> usize {
        self.points().len()
    }
}

/// Integrals of p n, of p u, p v and the torque about z, and of |n|.
pub(super) const INTEGRALS: usize = 7;

/// Integrals over a triangle by a rule, and how far those of the lower degree are off.
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

    #[cfg(test)]
    pub fn area(&self) -> f64 {
        FINE.iter().map(|(l, weight, _)| 0.5 * weight * self.at(l).1).sum()
    }

    /// A point well inside, and twice the area about there.
    pub fn middle(&self) -> ([f64; 2], f64) {
        self.at(&[1.0 / 3.0; 3])
    }

    /// Whether its Jacobian, a quadratic, is positive at the rule's points. Positive Bernstein coefficients prove it
    /// everywhere, and are tried first.
    pub fn is_regular(&self) -> bool {
        let at_corner = WHOLE.map(|l| self.at(&l).1);
        let in_between = |i: usize| {
            let (here, next) = (&WHOLE[i], &WHOLE[(i + 1) % 3]);
            let middle = self.at(&[0, 1, 2].map(|j| 0.5 * (here[j] + next[j]))).1;
            2.0 * middle - 0.5 * (at_corner[i] + at_corner[(i + 1) % 3])
        };
        at_corner.iter().all(|c| *c > 0.0) && (0..3).all(|i| in_between(i) > 0.0)
            || FINE.iter().all(|(l, ..)| self.at(l).1 > 0.0)
    }

    /// Integrates over the part whose corners have these barycentric coordinates; `None` where the patch is no graph.
    #[inline(always)]
    pub fn integrate(&self, part: &[[f64; 3]; 3], form: &Form, rule: Rule, nodes: &mut [Node]) -> Option<Integrals> {
        let mut sums = Integrals::default();
        let [a, b, c] = part;
        let share = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0]);
        for ((l, weight, low), node) in rule.points().iter().zip(nodes) {
            let at: [f64; 3] = std::array::from_fn(|i| l[0] * a[i] + l[1] * b[i] + l[2] * c[i]);
            let (x, jacobian) = self.at(&at);
            let found = form.node(x)?;
            let area = 0.5 * share.abs() * jacobian;
            *node = Node { weight: weight * area, ..found };
            let Node { x: [u, v, _], pressure, normal: [n_u, n_v], .. } = found;
            let stretch = (1.0 + n_u * n_u + n_v * n_v).sqrt();
            let [p_u, p_v, twist] = [u, v, u * n_v - v * n_u].map(|c| pressure * c);
            let values = [pressure * n_u, pressure * n_v, pressure, p_u, p_v, twist, stretch];
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
        for (rule, degrees) in [(Rule::Coarse, [5, 2]), (Rule::Fine, [8, 4])] {
            for (i, j) in (0..=8).flat_map(|i| (0..=8 - i).map(move |j| (i, j))) {
                let exact = 2.0 * factorial(i) * factorial(j) / factorial(i + j + 2);
                let sum = |weight: fn(&Point) -> f64| -> f64 {
                    rule.points().iter().map(|p| weight(p) * p.0[0].powi(i) * p.0[1].powi(j)).sum()
                };
                for (sum, degree) in [sum(|p| p.1), sum(|p| p.2)].iter().zip(degrees) {
                    assert!(i + j > degree || (sum - exact).abs() < 1e-15, "{rule:?} {i} {j}");
                }
            }
        }
    }

    #[test]
    fn a_sector_with_an_arc_has_its_area_to_fourth_order() {
        for turn in [0.5, 1.0] {
            let at = |angle: f64| [f64::cos(angle), f64::sin(angle)];
            let sector = CurvedTriangle::new([[0.0, 0.0], at(0.0), at(turn)], [None, Some(at(0.5 * turn)), None]);
            assert!((sector.area() / (0.5 * turn) - 1.0).abs() < 3e-3 * turn.powi(4), "{}", sector.area());
        }
    }
}
