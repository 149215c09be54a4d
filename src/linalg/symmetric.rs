//! Symmetric 3×3 matrices by their lower half, and their factorisation.

use crate::linalg::number::{Number, Twin};
use nalgebra::{Matrix3, Vector3};

/// Share of the trace from which an eigenvalue can be told from the rounding of the determinant (chosen).
const LEAST_DETERMINED: f64 = 1e-7;

/// Bound on that rounding where it can: the products of the determinant are at most tr³, and γ₈ of their sum is
/// 1e-14·tr³ at most, where the determinant is 2.5e-8·tr³ (estimated).
const DETERMINANT_ROUNDING: f64 = 1e-6;

/// A symmetric 3×3 matrix, of numbers or of lanes of them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
#[allow(missing_docs)]
pub struct Symmetric<N = f64> {
    pub xx: N,
    pub yx: N,
    pub yy: N,
    pub zx: N,
    pub zy: N,
    pub zz: N,
}

impl<N: Number> Symmetric<N> {
    /// a·self + b·other.
    #[inline]
    pub(crate) fn weighted(&self, a: N, other: &Self, b: N) -> Self {
        Self {
            xx: a * self.xx + b * other.xx,
            yx: a * self.yx + b * other.yx,
            yy: a * self.yy + b * other.yy,
            zx: a * self.zx + b * other.zx,
            zy: a * self.zy + b * other.zy,
            zz: a * self.zz + b * other.zz,
        }
    }

    /// factor·self + diagonal·1.
    #[inline]
    pub(crate) fn scaled(&self, factor: N, diagonal: N) -> Self {
        Self {
            xx: factor * self.xx + diagonal,
            yx: factor * self.yx,
            yy: factor * self.yy + diagonal,
            zx: factor * self.zx,
            zy: factor * self.zy,
            zz: factor * self.zz + diagonal,
        }
    }

    /// self += n nᵀ.
    #[inline]
    pub(crate) fn add_square(&mut self, n: &Vector3<N>) {
        self.xx += n.x * n.x;
        self.yx += n.y * n.x;
        self.yy += n.y * n.y;
        self.zx += n.z * n.x;
        self.zy += n.z * n.y;
        self.zz += n.z * n.z;
    }

    #[inline]
    pub(crate) fn times(&self, v: &Vector3<N>) -> Vector3<N> {
        Vector3::new(
            self.xx * v.x + self.yx * v.y + self.zx * v.z,
            self.yx * v.x + self.yy * v.y + self.zy * v.z,
            self.zx * v.x + self.zy * v.y + self.zz * v.z,
        )
    }
}

impl Symmetric<Twin> {
    /// Two matrices in lanes.
    #[inline]
    pub(crate) fn twin(x: &Symmetric, y: &Symmetric) -> Self {
        let of = Twin::new;
        Self {
            xx: of(x.xx, y.xx),
            yx: of(x.yx, y.yx),
            yy: of(x.yy, y.yy),
            zx: of(x.zx, y.zx),
            zy: of(x.zy, y.zy),
            zz: of(x.zz, y.zz),
        }
    }
}

impl Symmetric {
    /// All nine entries.
    pub fn matrix(&self) -> Matrix3<f64> {
        Matrix3::new(self.xx, self.yx, self.zx, self.yx, self.yy, self.zy, self.zx, self.zy, self.zz)
    }

    /// R·self·Rᵀ.
    #[inline]
    pub(crate) fn turned(&self, r: &Matrix3<f64>) -> Self {
        // Rows of R·self; each entry of the product once.
        let [x, y, z] = [0, 1, 2].map(|i| self.times(&r.row(i).transpose()));
        let entry = |v: &Vector3<f64>, i: usize| v.x * r[(i, 0)] + v.y * r[(i, 1)] + v.z * r[(i, 2)];
        Self {
            xx: entry(&x, 0),
            yx: entry(&y, 0),
            yy: entry(&y, 1),
            zx: entry(&z, 0),
            zy: entry(&z, 1),
            zz: entry(&z, 2),
        }
    }

    /// Lower bound of the least eigenvalue of a matrix that has none below 0, given its determinant: the other two
    /// multiply to (½·tr)² at most, so that it is at least 4·det/tr². 0 where that is less than [`LEAST_DETERMINED`] of
    /// the trace.
    #[inline]
    pub(crate) fn least_eigenvalue(&self, determinant: f64) -> f64 {
        let trace = self.trace();
        let least = 4.0 * determinant / (trace * trace) * (1.0 - DETERMINANT_ROUNDING);
        // More than the trace is the infinity of a determinant beyond the range of numbers.
        if least > LEAST_DETERMINED * trace && least <= trace { least } else { 0.0 }
    }

    /// The matrix of minors with their signs: the inverse times the determinant.
    #[inline]
    pub(crate) fn adjugate(&self) -> Self {
        Self {
            xx: self.yy * self.zz - self.zy * self.zy,
            yx: self.zy * self.zx - self.yx * self.zz,
            yy: self.xx * self.zz - self.zx * self.zx,
            zx: self.yx * self.zy - self.yy * self.zx,
            zy: self.yx * self.zx - self.xx * self.zy,
            zz: self.xx * self.yy - self.yx * self.yx,
        }
    }

    /// The determinant, given the adjugate.
    #[inline]
    pub(crate) fn determinant(&self, adjugate: &Self) -> f64 {
        self.xx * adjugate.xx + self.yx * adjugate.yx + self.zx * adjugate.zx
    }

    /// With zeros but for the first `dimensions` rows and columns.
    #[inline]
    pub(crate) fn within(self, dimensions: usize) -> Self {
        let (x, y, z) = match dimensions {
            3 => return self,
            2 => (self.xx, self.yy, 0.0),
            1 => (self.xx, 0.0, 0.0),
            _ => (0.0, 0.0, 0.0),
        };
        Self { xx: x, yx: if dimensions == 2 { self.yx } else { 0.0 }, yy: y, zx: 0.0, zy: 0.0, zz: z }
    }

    /// Sum of the squares of all nine entries.
    #[inline]
    pub(crate) fn square(&self) -> f64 {
        let (diagonal, below) = ([self.xx, self.yy, self.zz], [self.yx, self.zx, self.zy]);
        diagonal.map(|v| v * v).iter().sum::<f64>() + 2.0 * below.map(|v| v * v).iter().sum::<f64>()
    }

    #[inline]
    pub(crate) fn diagonal(&self) -> Vector3<f64> {
        Vector3::new(self.xx, self.yy, self.zz)
    }

    /// The trace.
    #[inline]
    pub(crate) fn trace(&self) -> f64 {
        self.xx + self.yy + self.zz
    }
}

/// L D Lᵀ of a symmetric positive definite 3×3 matrix, eliminated in the given order of axes: stiffest
/// first keeps the softest direction to full relative precision.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Factor<N = f64> {
    l10: N,
    l20: N,
    l21: N,
    inverse_d: [N; 3],
}

impl<N: Number> Factor<N> {
    /// `least` bounds the eigenvalues from below, and so every pivot: rounding may not take it further.
    /// `None` where a number is not finite, or `least` not positive.
    #[inline]
    pub fn of(h: &Symmetric<N>, least: N) -> Option<Self> {
        let one = N::of(1.0);
        let i0 = one / h.xx.larger(least);
        let (l10, l20) = (h.yx * i0, h.zx * i0);
        let d1 = h.yy - l10 * h.yx;
        let i1 = one / d1.larger(least);
        let c21 = h.zy - l20 * h.yx;
        let l21 = c21 * i1;
        let d2 = h.zz - l20 * h.zx - l21 * c21;
        let i2 = one / d2.larger(least);
        // A sum is finite only if all its terms are; the larger of NaN and `least` is `least`, so that pivots are
        // summed as well.
        let finite = (h.xx + d1 + d2 + (i0 + i1 + i2)).is_finite();
        (least.is_positive() && finite).then_some(Self { l10, l20, l21, inverse_d: [i0, i1, i2] })
    }

    #[inline]
    pub fn solve(&self, r: &Vector3<N>) -> Vector3<N> {
        let y0 = r.x;
        let y1 = r.y - self.l10 * y0;
        let y2 = r.z - self.l20 * y0 - self.l21 * y1;
        let z = y2 * self.inverse_d[2];
        let y = y1 * self.inverse_d[1] - self.l21 * z;
        let x = y0 * self.inverse_d[0] - self.l10 * y - self.l20 * z;
        Vector3::new(x, y, z)
    }
}

impl<N: Number> Factor<N> {
    /// The same in other numbers.
    pub fn map<M: Number>(&self, to: impl Fn(N) -> M) -> Factor<M> {
        Factor { l10: to(self.l10), l20: to(self.l20), l21: to(self.l21), inverse_d: self.inverse_d.map(to) }
    }
}

impl Factor<Twin> {
    /// That of one lane.
    #[inline]
    pub fn lane(&self, i: usize) -> Factor {
        self.map(|lanes| lanes.0[i])
    }
}

impl Factor {
    /// The inverse matrix, for what needs no more digits than a bound does.
    #[inline(always)]
    pub fn inverse(&self) -> Symmetric {
        let [i0, i1, i2] = self.inverse_d;
        // L⁻¹ has −l10, m = l10 l21 − l20 and −l21 below its diagonal.
        let m = self.l10 * self.l21 - self.l20;
        Symmetric {
            xx: i0 + self.l10 * self.l10 * i1 + m * m * i2,
            yx: -self.l10 * i1 - self.l21 * m * i2,
            yy: i1 + self.l21 * self.l21 * i2,
            zx: m * i2,
            zy: -self.l21 * i2,
            zz: i2,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inverse_and_the_solution_are_those_of_the_matrix() {
        let h = Symmetric { xx: 4.0, yx: -1.0, yy: 3.0, zx: 0.5, zy: 0.25, zz: 2.0 };
        let factor = Factor::of(&h, 1e-3).unwrap();
        assert!((h.matrix() * factor.inverse().matrix() - Matrix3::identity()).norm() < 1e-15);
        let r = Vector3::new(1.0, -2.0, 3.0);
        assert!((h.times(&factor.solve(&r)) - r).norm() < 1e-15);
        assert!((factor.inverse().times(&r) - factor.solve(&r)).norm() < 1e-15);
    }

    #[test]
    fn the_adjugate_is_the_inverse_times_the_determinant() {
        let h = Symmetric { xx: 4.0, yx: -1.0, yy: 3.0, zx: 0.5, zy: 0.25, zz: 2.0 };
        let adjugate = h.adjugate();
        let determinant = h.determinant(&adjugate);
        assert!((determinant - h.matrix().determinant()).abs() < 1e-14 * determinant);
        assert!((h.matrix() * adjugate.matrix() - determinant * Matrix3::identity()).norm() < 1e-14 * determinant);
    }

    #[test]
    fn no_pivot_falls_below_the_least_curvature() {
        let flat = Symmetric { xx: 1.0, yx: 1.0, yy: 1.0, zx: 0.0, zy: 0.0, zz: 0.0 };
        let step = Factor::of(&flat, 0.5).unwrap().solve(&Vector3::new(0.0, 0.0, 1.0));
        assert_eq!(step, Vector3::new(0.0, 0.0, 2.0));
        assert!(Factor::of(&flat, f64::NAN).is_none() && Factor::of(&flat, 0.0).is_none());
    }

    #[test]
    fn a_matrix_with_an_entry_that_is_no_number_has_no_factor() {
        let h = Symmetric { xx: 4.0, yx: -1.0, yy: 3.0, zx: 0.5, zy: 0.25, zz: 2.0 };
        let nan = f64::NAN;
        let infinite = f64::INFINITY;
        let broken = [
            Symmetric { xx: nan, ..h },
            Symmetric { yx: nan, ..h },
            Symmetric { yy: nan, ..h },
            Symmetric { zx: nan, ..h },
            Symmetric { zy: nan, ..h },
            Symmetric { zz: nan, ..h },
            Symmetric { xx: infinite, yx: infinite, ..h },
        ];
        for h in broken {
            assert!(Factor::of(&h, 1e-3).is_none(), "{h:?}");
        }
    }

    #[test]
    fn the_least_eigenvalue_is_told_in_any_unit_or_not_at_all() {
        let regular = Symmetric { xx: 4.0, yx: -1.0, yy: 3.0, zx: 0.5, zy: 0.25, zz: 2.0 };
        let soft = Symmetric { xx: 1.0, yx: 1.0, yy: 1.0, zx: 0.0, zy: 0.0, zz: 1e-8 };
        let least = |h: Symmetric| h.least_eigenvalue(h.determinant(&h.adjugate()));
        for exponent in [-1000, -400, -90, 0, 90, 340, 500, 1000] {
            let unit = 2f64.powi(exponent);
            let (of_regular, of_soft) = (least(regular.scaled(unit, 0.0)), least(soft.scaled(unit, 0.0)));
            assert!(of_regular == 0.0 || of_regular == unit * least(regular), "2^{exponent}: {of_regular:e}");
            assert_eq!(of_soft, 0.0, "2^{exponent}");
        }
    }
}
