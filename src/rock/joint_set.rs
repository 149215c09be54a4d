//! Joints of about one orientation at about one spacing.

use super::numbers::Limits;
use crate::random::Random;
use crate::rock::error::{RockError, within};
use crate::rock::joint::Joint;
use crate::rock::polygon::axes_across;
use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};

/// A joint set: dip and dip direction as of [`Joint::new`], in degrees, and the mean spacing of its joints across it,
/// length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointSet {
    /// Mean dip, degrees.
    pub dip: f64,
    /// Mean dip direction, degrees.
    pub dip_direction: f64,
    /// Mean spacing, length.
    pub spacing: f64,
    /// Whether spacings are drawn from an exponential distribution, instead of all the same.
    pub exponential: bool,
    /// κ of Fisher's distribution of normals, infinite for none: half of them lie within arccos(1 + ln(½)/κ), about, of
    /// the mean.
    pub fisher: f64,
    /// Radius of its joints as discs, length, infinite for joints without end. Discs lie anywhere in the ball of that
    /// radius beyond the reach, as many as make the mean distance of crossings on a line along the mean normal the
    /// spacing; `exponential` has no meaning then.
    pub radius: f64,
    /// The numbers drawn depend on this and on the order of the joints only.
    pub seed: u64,
}

impl JointSet {
    /// A set of parallel joints at equal spacings.
    pub fn new(dip: f64, dip_direction: f64, spacing: f64) -> Self {
        Self { dip, dip_direction, spacing, exponential: false, fisher: f64::INFINITY, radius: f64::INFINITY, seed: 0 }
    }

    /// Its joints within `reach` of `centre`, both lengths: those that cross the line through it along the mean normal,
    /// of equal spacings one at `centre`; discs that reach into the ball.
    ///
    /// # Errors
    /// Numbers that are not finite, a dip outside [0, 90], a spacing, reach, radius or κ that is not above 0, more than
    /// 10⁷ joints.
    pub fn joints(&self, centre: impl Into<Vector3<f64>>, reach: f64) -> Result<Vec<Joint>, RockError> {
        within(self.spacing, self.spacing > 0.0, "spacing", "above 0")?;
        within(reach, reach > 0.0, "reach", "above 0")?;
        if !(self.fisher > 0.0) {
            return Err(RockError::OutOfRange { name: "fisher", value: self.fisher, range: "above 0" });
        }
        if !(self.radius > 0.0) {
            return Err(RockError::OutOfRange { name: "radius", value: self.radius, range: "above 0" });
        }
        let mean = Joint::new(centre, self.dip, self.dip_direction)?;
        let mut random = Random::new(self.seed, 0);
        if self.radius < f64::INFINITY {
            return self.discs(&mean, reach + self.radius, &mut random);
        }
        within(
            self.spacing,
            2.0 * reach / self.spacing <= Limits::JOINTS,
            "spacing",
            "wide enough for at most 10 million joints",
        )?;
        let (mut joints, first) = (Vec::new(), -(reach / self.spacing).floor() * self.spacing);
        let mut at = if self.exponential { -reach + self.gap(&mut random) } else { first };
        while at <= reach {
            let normal = self.scattered(&mean.normal, &mut random);
            joints.push(Joint::through(mean.point + at * mean.normal, normal));
            at = if self.exponential { at + self.gap(&mut random) } else { first + joints.len() as f64 * self.spacing };
        }
        Ok(joints)
    }

    /// A line across discs of one orientation, ν in a unit of volume, meets ν π R² of them in a unit of length; where
    /// they scatter, that times the mean of |cos θ|, (κ − 1 + 2 q − (κ + 1) q²) / (κ (1 − q²)) with q = e^(−κ).
    fn discs(&self, mean: &Joint, radius: f64, random: &mut Random) -> Result<Vec<Joint>, RockError> {
        let ball = 4.0 / 3.0 * PI * radius.powi(3);
        let met = ball / (self.spacing * PI * self.radius.powi(2) * mean_cosine(self.fisher));
        within(self.spacing, met <= Limits::JOINTS, "spacing", "wide enough for at most 10 million joints")?;
        let (mut joints, mut crossed) = (Vec::new(), 0.0);
        // A Poisson process: the gaps between the numbers of discs are exponential.
        while {
            crossed -= (1.0 - random.uniform()).ln();
            crossed <= met
        } {
            let normal = self.scattered(&mean.normal, random);
            let away = radius * random.uniform().cbrt() * random.direction();
            joints.push(Joint { radius: self.radius, ..Joint::through(mean.point + away, normal) });
        }
        Ok(joints)
    }

    fn gap(&self, random: &mut Random) -> f64 {
        -self.spacing * (1.0 - random.uniform()).ln()
    }

    /// By the inverse of Fisher's distribution: cos θ = 1 + ln(u + (1 − u) e^(−2κ))/κ.
    fn scattered(&self, mean: &Vector3<f64>, random: &mut Random) -> Vector3<f64> {
        if self.fisher == f64::INFINITY {
            return *mean;
        }
        let u = 1.0 - random.uniform();
        let cos = 1.0 + (u + (1.0 - u) * (-2.0 * self.fisher).exp()).ln() / self.fisher;
        let sin = ((1.0 - cos) * (1.0 + cos)).max(0.0).sqrt();
        let (across, along) = (TAU * random.uniform()).sin_cos();
        let [u, v] = axes_across(mean);
        (cos * mean + sin * (along * u + across * v)).normalize()
    }
}

/// Mean of |cos θ| of Fisher's distribution.
fn mean_cosine(fisher: f64) -> f64 {
    // Below, the terms cancel, and 1/2 is right to the square of it; without scatter there is nothing to average.
    if fisher < 1e-3 {
        return 0.5;
    }
    if fisher == f64::INFINITY {
        return 1.0;
    }
    let q = (-fisher).exp();
    (fisher - 1.0 + 2.0 * q - (fisher + 1.0) * q * q) / (fisher * (1.0 - q * q))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spacings_and_scatter_are_those_asked_for() {
        let set = JointSet::new(40.0, 210.0, 0.5);
        let joints = set.joints([1.0, 2.0, 3.0], 10.2).unwrap();
        assert_eq!(joints.len(), 41);
        let step = (joints[1].point - joints[0].point).dot(&joints[0].normal);
        assert!((step - 0.5).abs() < 1e-14 && (joints[20].point - Vector3::new(1.0, 2.0, 3.0)).norm() < 1e-13);

        // Mean and standard error of a Poisson process, and of cos θ: coth κ − 1/κ.
        let set = JointSet { exponential: true, fisher: 20.0, seed: 7, ..set };
        let joints = set.joints([0.0; 3], 5000.0).unwrap();
        let mean = JointSet { fisher: f64::INFINITY, ..set }.joints([0.0; 3], 1.0).unwrap()[0].normal;
        assert!((joints.len() as f64 - 20_000.0).abs() < 4.0 * 20_000f64.sqrt(), "{}", joints.len());
        let cos = joints.iter().map(|joint| joint.normal.dot(&mean)).sum::<f64>() / joints.len() as f64;
        assert!((cos - 0.95).abs() < 4.0 * 0.05 / (joints.len() as f64).sqrt(), "{cos}");
    }

    /// Of a line through the middle: crossings at the mean distance that was asked for, and as many in the ball as
    /// there are discs in it.
    #[test]
    fn discs_cross_a_line_at_the_spacing() {
        for fisher in [f64::INFINITY, 30.0] {
            let set = JointSet { radius: 0.6, fisher, ..JointSet::new(30.0, 60.0, 0.5) };
            let (mut crossings, runs) = (0, 40);
            for seed in 0..runs {
                let joints = JointSet { seed, ..set }.joints([5.0, 1.0, -2.0], 6.0).unwrap();
                let mean = Joint::new([5.0, 1.0, -2.0], 30.0, 60.0).unwrap();
                crossings += joints
                    .iter()
                    .filter(|joint| {
                        let along = joint.normal.dot(&(joint.point - mean.point)) / joint.normal.dot(&mean.normal);
                        along.abs() < 6.0 && (mean.point + along * mean.normal - joint.point).norm() < 0.6
                    })
                    .count();
            }
            let expected = 24.0 * runs as f64;
            assert!((crossings as f64 - expected).abs() < 4.0 * expected.sqrt(), "{crossings}, not {expected}");
        }
    }

    #[test]
    fn bad_numbers_are_told() {
        let set = JointSet::new(40.0, 210.0, 0.5);
        assert!(JointSet { spacing: 0.0, ..set }.joints([0.0; 3], 1.0).is_err());
        assert!(JointSet { fisher: f64::NAN, ..set }.joints([0.0; 3], 1.0).is_err());
        assert!(JointSet { radius: 0.0, ..set }.joints([0.0; 3], 1.0).is_err());
        assert!(JointSet { radius: 1e-3, ..set }.joints([0.0; 3], 10.0).is_err());
        assert!(JointSet { spacing: 1e-9, ..set }.joints([0.0; 3], 10.0).is_err());
        let text = JointSet { dip: 95.0, ..set }.joints([0.0; 3], 1.0).unwrap_err().to_string();
        assert_eq!(text, "dip = 95 must be an angle from 0 to 90 degrees");
        let text = JointSet::new(30.0, 60.0, 1e-300).joints([0.0; 3], 1.0).unwrap_err().to_string();
        assert_eq!(text, "spacing = 1e-300 must be wide enough for at most 10 million joints");
    }

    /// By the mean over the distribution, whose density of cos θ goes with e^(κ cos θ).
    #[test]
    fn mean_cosines_are_those_of_the_density() {
        for fisher in [1e-4, 1e-3, 0.5, 2.0, 20.0, 200.0] {
            let (mut sum, mut all) = (0.0, 0.0);
            for i in 0..200_000 {
                let cosine = (f64::from(i) + 0.5) / 1e5 - 1.0;
                let density = (fisher * (cosine - 1.0)).exp();
                (sum, all) = (sum + density * cosine.abs(), all + density);
            }
            assert!((mean_cosine(fisher) / (sum / all) - 1.0).abs() < 1e-6, "{fisher}");
        }
    }
}
