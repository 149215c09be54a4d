//! Joints of about one orientation at about one spacing.

use crate::random::Random;
use crate::rock::error::{RockError, within};
use crate::rock::joint::Joint;
use nalgebra::Vector3;
use std::f64::consts::TAU;

/// A joint set: dip and dip direction as of [`Joint::new`], in degrees, and the mean spacing of its joints across it, length.
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
    /// κ of Fisher's distribution of normals, infinite for none: half of them lie within arccos(1 + ln(½)/κ), about, of the mean.
    pub fisher: f64,
    /// The numbers drawn depend on this and on the order of the joints only.
    pub seed: u64,
}

impl JointSet {
    /// A set of parallel joints at equal spacings.
    pub fn new(dip: f64, dip_direction: f64, spacing: f64) -> Self {
        Self { dip, dip_direction, spacing, exponential: false, fisher: f64::INFINITY, seed: 0 }
    }

    /// Its joints, without end, that cross the line through `centre` along the mean normal within `reach` of it, both lengths; one of equal
    /// spacings crosses it at `centre`.
    ///
    /// # Errors
    /// Numbers that are not finite, a dip outside [0, 90], a spacing, reach or κ that is not above 0.
    pub fn joints(&self, centre: impl Into<Vector3<f64>>, reach: f64) -> Result<Vec<Joint>, RockError> {
        within(self.spacing, self.spacing > 0.0, "spacing", "above 0")?;
        within(reach, reach > 0.0, "reach", "above 0")?;
        if !(self.fisher > 0.0) {
            return Err(RockError::OutOfRange { name: "fisher", value: self.fisher, range: "above 0" });
        }
        let mean = Joint::new(centre, self.dip, self.dip_direction)?;
        let mut random = Random::new(self.seed, 0);
        let (mut joints, first) = (Vec::new(), -(reach / self.spacing).floor() * self.spacing);
        let mut at = if self.exponential { -reach + self.gap(&mut random) } else { first };
        while at <= reach {
            let normal = self.scattered(&mean.normal, &mut random);
            joints.push(Joint { point: mean.point + at * mean.normal, normal, ..mean });
            at = if self.exponential { at + self.gap(&mut random) } else { first + joints.len() as f64 * self.spacing };
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
        let u = mean.cross(&Vector3::ith(mean.iamin(), 1.0)).normalize();
        (cos * mean + sin * (along * u + across * mean.cross(&u))).normalize()
    }
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

    #[test]
    fn bad_numbers_are_told() {
        let set = JointSet::new(40.0, 210.0, 0.5);
        assert!(JointSet { spacing: 0.0, ..set }.joints([0.0; 3], 1.0).is_err());
        assert!(JointSet { fisher: f64::NAN, ..set }.joints([0.0; 3], 1.0).is_err());
        let text = JointSet { dip: 95.0, ..set }.joints([0.0; 3], 1.0).unwrap_err().to_string();
        assert_eq!(text, "dip = 95 must be an angle from 0 to 90 degrees");
    }
}
