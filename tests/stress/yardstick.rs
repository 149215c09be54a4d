//! What judges must itself be right: numbers of 32 digits, and the second solver against the 40-digit solutions.

use kit::stress::reference::{Body, Wanted, optimum};
use kit::truth;
use kit::wide::Wide;
use nalgebra::Vector3;

#[test]
fn thirty_two_digits_are_kept() {
    let third = Wide::ONE / Wide::from(3.0);
    let rest = Wide::ONE - third - third - third;
    assert!(rest.f64().abs() < 1e-31);
    let root = Wide::from(2.0).sqrt();
    assert!((root * root - Wide::from(2.0)).f64().abs() < 1e-31);
    let tiny = Wide::difference(1.0, 1e-25);
    assert_eq!((Wide::ONE - tiny).f64(), 1e-25);
}

/// From a start that knows nothing; the truth is given to 40 digits, of which a double keeps 16.
#[test]
fn the_second_solver_agrees_with_the_known_solutions() {
    let (mut settled, mut pairs) = (0, 0);
    for pair in truth::pairs() {
        let (a, b) = (pair.shape_a.particle(), pair.shape_b.particle());
        let body_a = Body::new(&a, &pair.a, pair.b.position);
        let body_b = Body::new(&b, &pair.b, pair.b.position);
        let start = 0.5 * (Vector3::from(pair.a.position) - Vector3::from(pair.b.position));
        pairs += 1;
        let Some(found) = optimum(&body_a, &body_b, Wanted::Midway, &start, 1.0) else { continue };
        let truth = truth::number(&pair.truth.s4);
        let rounding = 4.0 * f64::EPSILON * truth;
        assert!(found.least <= truth + rounding && found.most >= truth - rounding, "{}: {found:?}", pair.family);
        if found.most - found.least <= 1e-14 * truth.max(1.0) {
            settled += 1;
            let off = (found.x.f64() - truth::vector(&pair.truth.x4)).norm();
            let flat = a.sphericity().min(b.sphericity()) < 1e-12;
            assert!(flat || off <= found.doubt + 1e-14 * a.bounding_radius().max(b.bounding_radius()), "{off}");
        }
    }
    assert!(settled * 10 > pairs * 8, "{settled} of {pairs} settled");
}
