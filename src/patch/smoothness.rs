//! How far off a rule over a sector is, from the loads of its rays and of those at its ends.

use super::numbers::Fitted;
use super::rules::GAUSS_KRONROD;
use std::sync::LazyLock;

/// Error of a rule from how far the polynomial through its loads misses those at the ends, and from how smooth they
/// are.
pub(super) fn error_of_rule(loads: &[[f64; 3]], ends: &[[f64; 3]; 2]) -> f64 {
    if let [load] = loads {
        let off = [0, 1, 2].map(|j| load[j] - 0.5 * (ends[0][j] + ends[1][j]));
        return 0.5 * norm(&off);
    }
    let few = loads.len() == 3;
    let weights = if few { &at_ends().0[..] } else { &at_ends().1[..] };
    let missed = ends.iter().enumerate().map(|(side, end)| {
        let mut off = *end;
        for (weight, load) in weights.iter().zip(loads) {
            (0..3).for_each(|j| off[j] -= weight[side] * load[j]);
        }
        norm(&off)
    });
    let missed = missed.fold(0.0, f64::max);
    if few {
        (Fitted::ENDS[0] * missed).max(error_of_three(loads))
    } else {
        (Fitted::ENDS[1] * missed).max(error_of_seven(loads))
    }
}

/// Weights of the polynomials through 3 and 7 points at both ends.
type AtEnds = ([[f64; 2]; 3], [[f64; 2]; 7]);

fn at_ends() -> &'static AtEnds {
    static WEIGHTS: LazyLock<AtEnds> = LazyLock::new(|| {
        let weight = |count: usize, i: usize| {
            [0.0, 1.0].map(|end| {
                let factor = |j: usize| (end - GAUSS_KRONROD[j].0) / (GAUSS_KRONROD[i].0 - GAUSS_KRONROD[j].0);
                (0..count).filter(|j| *j != i).map(factor).product::<f64>()
            })
        };
        (std::array::from_fn(|i| weight(3, i)), std::array::from_fn(|i| weight(7, i)))
    });
    &WEIGHTS
}

/// Error of the rule of 3 rays from how their loads vary.
fn error_of_three(loads: &[[f64; 3]]) -> f64 {
    let mean = [0, 1, 2].map(|j| GAUSS_KRONROD.iter().zip(loads).map(|((_, w, _), load)| w * load[j]).sum::<f64>());
    let off = |load: &[f64; 3]| norm(&[load[0] - mean[0], load[1] - mean[1], load[2] - mean[2]]);
    let most = loads.iter().map(off).fold(0.0, f64::max);
    if most > 0.0 { Fitted::VARIATION * most * (most / norm(&mean)).powi(2).min(1.0) } else { 0.0 }
}

/// Error of the rule of 7 rays from how fast the coefficients of Legendre's series of the loads fall.
fn error_of_seven(loads: &[[f64; 3]]) -> f64 {
    let mut coefficients = [[0.0; 3]; 6];
    for ((t, _, weight), load) in GAUSS_KRONROD.iter().zip(loads) {
        let x = 2.0 * t - 1.0;
        let (mut before, mut value) = (0.0, 1.0);
        for (n, coefficient) in coefficients.iter_mut().enumerate() {
            let n = n as f64;
            for j in 0..3 {
                coefficient[j] += (2.0 * n + 1.0) * weight * value * load[j];
            }
            (before, value) = (value, ((2.0 * n + 1.0) * x * value - n * before) / (n + 1.0));
        }
    }
    let size = coefficients.map(|c| norm(&c));
    let (high, low) = (size[4].max(size[5]), size[1].max(size[2]).max(size[3]));
    // The fall over six degrees is the square of that over three.
    if high > 0.0 { high * (high / low).powi(2).min(1.0) } else { 0.0 }
}

pub(super) fn norm(v: &[f64]) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}
