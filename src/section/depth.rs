//! 1 − S at the contact point, in double-double.
//!
//! It sets the size of a cross-section. In doubles S is known to ε·(1 + 2·size/r), while 1 − S is about 2·overlap/r:
//! where the particles hardly overlap, no digit of it would be left.

use super::plane_section::PlaneSection;
use crate::linalg::double_double::DoubleDouble;
use crate::particle::potential::{Sums, Weights};
use nalgebra::Vector3;

/// 1 − S at the contact point.
pub(super) fn of(section: &PlaneSection) -> f64 {
    let PlaneSection { shape, branch, rotation, point, .. } = section;
    let x =
        Vector3::from([0, 1, 2].map(|axis| dot(rotation.column(axis).iter().zip(branch.iter().map(|&b| b.into())))));
    let mut square = DoubleDouble::default();
    if !shape.is_sphere() {
        shape.visit_near(point, 0.0, |i, normal, excess| {
            if excess > 0.0 {
                let excess = dot(normal.iter().zip(x.iter().copied())) + DoubleDouble::from(-shape.offset(i));
                square += excess * excess;
            }
        });
    }
    let s = Weights::precise(shape).value(&Sums { square, ..Sums::default() }, &x);
    (DoubleDouble::from(1.0) - s).rounded()
}

fn dot<'a>(terms: impl Iterator<Item = (&'a f64, DoubleDouble)>) -> DoubleDouble {
    terms.fold(DoubleDouble::default(), |sum, (&factor, term)| sum + term * factor)
}
