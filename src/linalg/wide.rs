//! Vectors of numbers of about 32 digits.

use super::double_double::DoubleDouble;
use nalgebra::Vector3;

/// A vector of 32 digits.
pub(crate) type Wide = Vector3<DoubleDouble>;

/// A vector of doubles.
pub(crate) fn wide(v: &Vector3<f64>) -> Wide {
    v.map(DoubleDouble::from)
}

/// The nearest vector of doubles.
pub(crate) fn rounded(v: &Wide) -> Vector3<f64> {
    v.map(DoubleDouble::rounded)
}

/// a − b without rounding.
pub(crate) fn difference(a: &Vector3<f64>, b: &Vector3<f64>) -> Wide {
    a.zip_map(b, |a, b| DoubleDouble::sum(a, -b))
}
