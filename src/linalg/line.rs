//! The minimum of a convex, piecewise quadratic function of one variable, found from piece to piece.
//!
//! The function is Σ w⟨depth + α·rate⟩² plus a quadratic. Its slope is continuous, piecewise linear and grows with α:
//! from the slope at α = 0 the curvature of each piece leads to its end, where one plane switches, until the slope
//! vanishes. No slope is summed from the planes, where large terms would cancel. All numbers have 32 digits: after
//! stiff planes have become inactive, the slope is small beside its former value.

use super::double_double::DoubleDouble;
use super::number::Number;

/// The function for α ≥ 0.
#[derive(Debug)]
pub(crate) struct Line {
    /// At α = 0.
    slope: DoubleDouble,
    /// Of all that is on for every α.
    curvature: DoubleDouble,
    switches: Vec<Switch>,
}

/// Where a plane switches.
#[derive(Debug)]
struct Switch {
    alpha: DoubleDouble,
    /// What the plane adds to the curvature while it is on.
    curvature: DoubleDouble,
    comes_on: bool,
}

impl Line {
    /// With this slope at α = 0, and nothing else yet.
    pub fn new(slope: DoubleDouble) -> Self {
        Self { slope, curvature: DoubleDouble::default(), switches: Vec::new() }
    }

    pub fn add_curvature(&mut self, curvature: DoubleDouble) {
        self.curvature += curvature;
    }

    /// A plane with weight 2w. Its share of the slope at α = 0 is in that already.
    pub fn add_plane(&mut self, depth: DoubleDouble, rate: DoubleDouble, w2: DoubleDouble) {
        let (is_on, comes_on) = (depth.is_positive(), rate.is_positive());
        if rate.rounded() == 0.0 || (!is_on && !comes_on) {
            return;
        }
        let curvature = w2 * rate * rate;
        if is_on && comes_on {
            self.curvature += curvature;
        } else {
            self.switches.push(Switch { alpha: -depth / rate, curvature, comes_on });
        }
    }

    /// α where the function is least; 0 if it does not fall.
    pub fn least(mut self) -> DoubleDouble {
        let zero = DoubleDouble::default();
        if !(self.slope.rounded() < 0.0) {
            return zero;
        }
        self.switches.sort_by(|a, b| a.alpha.rounded().total_cmp(&b.alpha.rounded()));
        // Curvatures of planes active until later, and of planes that have become active, are sums without differences:
        // a plane may be stiffer by many digits than what remains when it is inactive.
        let mut until_later = vec![zero; self.switches.len() + 1];
        for (i, switch) in self.switches.iter().enumerate().rev() {
            until_later[i] = until_later[i + 1] + if switch.comes_on { zero } else { switch.curvature };
        }
        let (mut alpha, mut slope, mut on) = (zero, self.slope, self.curvature);
        for (switch, later) in self.switches.iter().zip(&until_later) {
            let least = alpha - slope / (on + *later);
            if least.is_at_most(switch.alpha) {
                return least;
            }
            slope += (on + *later) * (switch.alpha - alpha);
            alpha = switch.alpha;
            if switch.comes_on {
                on += switch.curvature;
            }
        }
        alpha - slope / on
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(value: f64) -> DoubleDouble {
        DoubleDouble::from(value)
    }

    /// With planes (depth, rate, 2w).
    fn least(slope: f64, curvature: f64, planes: &[[f64; 3]]) -> f64 {
        let mut line = Line::new(of(slope));
        line.add_curvature(of(curvature));
        planes.iter().for_each(|&[depth, rate, w2]| line.add_plane(of(depth), of(rate), of(w2)));
        line.least().rounded()
    }

    /// ½α² − 3α, with one plane active from α = 1 on and one until α = 0.5: slopes at 0, 0.5 and 1 are −3, −1.5 and −1;
    /// beyond, the curvature is 5.
    #[test]
    fn the_slope_vanishes_at_the_minimum() {
        assert!((least(-3.0, 1.0, &[[-2.0, 2.0, 1.0], [0.5, -1.0, 2.0]]) - 1.2).abs() < 1e-15);
    }

    #[test]
    fn a_plane_that_comes_on_at_once_shortens_the_step_from_the_start() {
        assert!((least(-1.0, 1e-30, &[[0.0, 1e10, 1.0]]) / 1e-20 - 1.0).abs() < 1e-12);
        assert_eq!(least(1.0, 0.0, &[]), 0.0);
    }

    /// Without the plane, which takes 1e-10 of the slope away, the minimum is at 1e6.
    #[test]
    fn a_stiff_plane_that_goes_off_leaves_no_rounding() {
        assert!((least(-1.0, 1e-6, &[[1e-30, -1e-10, 1e30]]) / 1e6 - 1.0).abs() < 1e-9);
    }

    /// A plane active until α = 1 leaves 1e-24 of the slope: with a curvature of 1e-24 the minimum is at 2.
    #[test]
    fn what_a_stiff_plane_leaves_of_the_slope_keeps_its_digits() {
        let mut line = Line::new(-(of(1.0) + of(2e-24)));
        line.add_curvature(of(1e-24));
        line.add_plane(of(1.0), of(-1.0), of(1.0));
        assert!((line.least().rounded() - 2.0).abs() < 1e-6);
    }
}
