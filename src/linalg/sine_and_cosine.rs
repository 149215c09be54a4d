//! Sine and cosine of a double to about 32 digits.

use super::double_double::DoubleDouble;

/// Largest |angle|, 2³⁰ radians: above, the doubles next to each other are more than 10⁻⁷ apart (chosen).
pub(crate) const LARGEST: f64 = 1_073_741_824.0;

/// π/2 as the sum of three doubles, right to 6·10⁻⁵⁰ (derived).
const QUARTER: [f64; 3] = [std::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_169_8e-33];

/// Terms of each series after the first: what follows is below 10⁻³³ for angles up to π/4. Derived: sine and cosine are
/// within 2U.
const TERMS: u32 = 14;

/// Sine and cosine of an angle of at most [`LARGEST`], each right to 2·[`DoubleDouble::UNIT`] (docs/theory.md, 4.9).
pub(crate) fn sine_and_cosine(angle: f64) -> (DoubleDouble, DoubleDouble) {
    let quarters = (angle / QUARTER[0]).round();
    let rest =
        QUARTER.iter().fold(DoubleDouble::from(angle), |rest, part| rest - DoubleDouble::product(quarters, *part));
    let square = rest * rest;
    let (sine, cosine) = (rest * series(square, 2), series(square, 1));
    match quarters.rem_euclid(4.0) as u8 {
        0 => (sine, cosine),
        1 => (cosine, -sine),
        2 => (-sine, -cosine),
        _ => (-cosine, sine),
    }
}

/// 1 − x²/(n(n+1))·(1 − x²/((n+2)(n+3))·(1 − …)): cos x for n = 1, sin x / x for n = 2.
fn series(square: DoubleDouble, n: u32) -> DoubleDouble {
    let one = DoubleDouble::from(1.0);
    (0..TERMS).rev().fold(one, |sum, term| {
        let first = f64::from(n + 2 * term);
        one - square * sum / DoubleDouble::from(first * (first + 1.0))
    })
}

#[cfg(test)]
#[allow(clippy::approx_constant)] // The high parts of known values are what a table of them shows.
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Angle, then sine and cosine as sums of three doubles, from 80 digits.
    #[allow(clippy::approx_constant)] // parts of sums, as they were computed
    const KNOWN: [(f64, [f64; 3], [f64; 3]); 12] = [
        (1e-09, [1e-09, -1.6666666666666669e-28, -9.769467151226575e-45], [1.0, -5e-19, -2.646871276380223e-35]),
        (
            0.5,
            [0.479425538604203, -5.103969860556013e-18, 3.7134329111577535e-34],
            [0.8775825618903728, -4.2623149864279997e-17, -9.919134682117543e-34],
        ),
        (
            0.7853981633974483,
            [0.7071067811865475, 4.1036934489363755e-17, 1.9217598003156353e-33],
            [0.7071067811865476, -2.6687565161377232e-17, -1.527378847930213e-33],
        ),
        (
            1.0,
            [0.8414709848078965, 1.776845092935536e-18, -1.4730549161871722e-34],
            [0.5403023058681398, -4.760954612604417e-17, -2.7465847695890946e-33],
        ),
        (
            1.5707963267948966,
            [1.0, -1.874699728327322e-33, 1.6486434320072074e-50],
            [6.123233995736766e-17, -1.4973849048591698e-33, 1.7358627348860476e-50],
        ),
        (
            2.0,
            [0.9092974268256817, -1.4020906557816256e-17, 9.372291149433695e-34],
            [-0.4161468365471424, 1.990596398957495e-17, 7.298584149358241e-34],
        ),
        (
            2.356194490192345,
            [0.7071067811865476, 1.661023765039743e-17, -1.4647674553145625e-33],
            [-0.7071067811865475, 2.26086832241091e-18, -2.337074524169829e-35],
        ),
        (
            3.141592653589793,
            [1.2246467991473532e-16, -2.99476980971834e-33, 1.4724663542367524e-49],
            [-1.0, 7.498798913309288e-33, -6.59457372802883e-50],
        ),
        (
            45.553093477052,
            [1.0, -1.915685142356643e-37, 1.6224087125354197e-53],
            [-6.189806365883577e-19, 5.558005016244944e-36, 4.515723697329867e-53],
        ),
        (
            1000000.0,
            [-0.34999350217129294, -1.5952848809323968e-17, -8.66705592921456e-34],
            [0.9367521275331447, 4.637088260214747e-17, -2.9230210042389845e-33],
        ),
        (
            123456789.123,
            [0.9998429395520451, -9.985306752627648e-18, 8.047973330519824e-35],
            [0.017722760166677856, -5.252468057090721e-19, -1.9946446007340362e-35],
        ),
        (
            1073741824.0,
            [-0.6173264150460421, -3.8969684709160755e-17, -6.142289820342537e-34],
            [0.7867071229411882, -4.425992365508206e-17, -1.9361363909665842e-33],
        ),
    ];

    fn off(value: DoubleDouble, known: [f64; 3]) -> f64 {
        known.iter().fold(value, |rest, part| rest - DoubleDouble::from(*part)).rounded().abs()
    }

    #[test]
    fn known_values() {
        for (angle, sine, cosine) in KNOWN {
            for sign in [1.0, -1.0] {
                let (s, c) = sine_and_cosine(sign * angle);
                let (of_sine, of_cosine) = (off(s * sign, sine), off(c, cosine));
                assert!(of_sine.max(of_cosine) <= 2.0 * DoubleDouble::UNIT, "{angle:?}: {of_sine:e}, {of_cosine:e}");
            }
        }
    }

    proptest! {
        #[test]
        fn identities(x in -LARGEST / 4.0..LARGEST / 4.0, small in -4.0..4.0_f64) {
            for x in [x, small] {
                let ((s, c), (s2, c2)) = (sine_and_cosine(x), sine_and_cosine(2.0 * x));
                let square = s * s + c * c - DoubleDouble::from(1.0);
                let (of_sine, of_cosine) = (s2 - s * c * 2.0, c2 - (c * c - s * s));
                for off in [square, of_sine, of_cosine] {
                    prop_assert!(off.rounded().abs() <= 8.0 * DoubleDouble::UNIT, "{x:?}: {:e}", off.rounded());
                }
                // The doubles of the platform.
                let (sine, cosine) = x.sin_cos();
                prop_assert!((s.rounded() - sine).abs().max((c.rounded() - cosine).abs()) <= f64::EPSILON);
            }
        }
    }
}
