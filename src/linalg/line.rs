//! The minimum of a convex, piecewise quadratic function of one variable, found from piece to piece.
//!
//! The function is Σ w⟨depth + α·rate⟩² plus a quadratic. Its slope is continuous, piecewise linear and grows with α: from the slope at
//! α = 0 the curvature of each piece leads to its end, where one plane comes on or goes off, until the slope vanishes. No slope is
//! ever summed up from the planes, where large terms would cancel.

/// The function for α ≥ 0.
#[derive(Debug)]
pub(crate) struct Line {
    /// At α = 0.
    slope: f64,
    /// That of the quadratic and of the planes that are on all along.
    curvature: f64,
    switches: Vec<Switch>,
}

/// Where a plane comes on or goes off.
#[derive(Debug)]
struct Switch {
    at: f64,
    curvature: f64,
    comes_on: bool,
}

impl Line {
    /// With this slope at α = 0, and nothing else yet.
    pub fn new(slope: f64) -> Self {
        Self { slope, curvature: 0.0, switches: Vec::new() }
    }

    pub fn add_curvature(&mut self, curvature: f64) {
        self.curvature += curvature;
    }

    /// A plane with weight 2w. Its share of the slope at α = 0 is in that already.
    pub fn add_plane(&mut self, depth: f64, rate: f64, w2: f64) {
        let (curvature, is_on) = (w2 * rate * rate, depth > 0.0);
        if is_on != (rate > 0.0) && rate != 0.0 {
            self.switches.push(Switch { at: -depth / rate, curvature, comes_on: !is_on });
        } else if is_on {
            self.curvature += curvature;
        }
    }

    /// α where the function is least; 0 if it does not fall.
    pub fn least(mut self) -> f64 {
        self.switches.sort_by(|a, b| a.at.total_cmp(&b.at));
        // No curvature is subtracted, since the difference may be the rounding of the stiffest planes alone: before each switch, that of the
        // planes yet to go off is summed up from the last one.
        let mut on = vec![0.0; self.switches.len() + 1];
        for (place, switch) in self.switches.iter().enumerate().rev() {
            on[place] = on[place + 1] + if switch.comes_on { 0.0 } else { switch.curvature };
        }
        let (mut alpha, mut slope, mut curvature) = (0.0, self.slope, self.curvature);
        for (switch, on) in self.switches.iter().zip(on) {
            // After a switch rounding may leave no slope.
            if !(slope < 0.0) {
                return alpha;
            }
            let least = alpha - slope / (curvature + on);
            if least <= switch.at {
                return least;
            }
            slope += (curvature + on) * (switch.at - alpha);
            alpha = switch.at;
            if switch.comes_on {
                curvature += switch.curvature;
            }
        }
        if slope < 0.0 { alpha - slope / curvature } else { alpha }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ½α² − 3α, a plane that comes on at α = 1 and one that goes off at α = 0.5.
    fn line() -> Line {
        let mut line = Line::new(-3.0);
        line.add_curvature(1.0);
        line.add_plane(-2.0, 2.0, 1.0);
        line.add_plane(0.5, -1.0, 2.0);
        line
    }

    #[test]
    fn the_slope_vanishes_at_the_minimum() {
        // Slopes at 0, 0.5 and 1: −3, −1.5 and −1; beyond, the curvature is 5.
        assert!((line().least() - 1.2).abs() < 1e-15);
    }

    #[test]
    fn a_plane_that_comes_on_at_once_shortens_the_step_from_the_start() {
        let mut line = Line::new(-1.0);
        line.add_curvature(1e-30);
        line.add_plane(0.0, 1e10, 1.0);
        assert!((line.least() / 1e-20 - 1.0).abs() < 1e-12);
        assert_eq!(Line::new(1.0).least(), 0.0);
    }

    #[test]
    fn a_stiff_plane_that_goes_off_leaves_the_soft_curvature() {
        let mut line = Line::new(-4.0);
        line.add_curvature(1.0);
        line.add_plane(1e-20, -1.0, 1e20);
        // The slope is −3 once the plane is off.
        assert!((line.least() - 3.0).abs() < 1e-15);
    }
}
