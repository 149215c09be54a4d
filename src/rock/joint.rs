//! A joint: a plane through the rock, or a disc of it.

use crate::rock::error::{RockError, within};
use nalgebra::Vector3;

/// A plane or a disc along which rock has parted. Axes: x east, y north, z up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    /// A point of it, length; of a disc its centre.
    pub point: Vector3<f64>,
    /// Unit normal.
    pub normal: Vector3<f64>,
    /// Radius of a disc, length; infinite of a joint without end.
    pub radius: f64,
}

impl Joint {
    /// The plane through a point that descends most, by the angle `dip` in degrees, towards the azimuth `dip_direction` in degrees, clockwise
    /// from north: its normal is (sin δ sin α, sin δ cos α, cos δ) and points upwards.
    ///
    /// # Errors
    /// A point or angle that is not finite, and a dip outside [0, 90].
    pub fn new(point: impl Into<Vector3<f64>>, dip: f64, dip_direction: f64) -> Result<Self, RockError> {
        let point = point.into();
        for (i, name) in
            ["x of a joint's point", "y of a joint's point", "z of a joint's point"].into_iter().enumerate()
        {
            within(point[i], true, name, "finite")?;
        }
        let dip = within(dip, (0.0..=90.0).contains(&dip), "dip", "an angle from 0 to 90 degrees")?.to_radians();
        let direction = within(dip_direction, true, "dip direction", "a finite angle in degrees")?.to_radians();
        let normal = Vector3::new(dip.sin() * direction.sin(), dip.sin() * direction.cos(), dip.cos());
        Ok(Self { point, normal, radius: f64::INFINITY })
    }

    /// The same as a disc about its point.
    ///
    /// # Errors
    /// A radius that is not above 0.
    pub fn with_radius(self, radius: f64) -> Result<Self, RockError> {
        within(radius, radius > 0.0, "radius of a joint", "above 0")?;
        Ok(Self { radius, ..self })
    }

    /// Whether the disc and a polygon in its plane, corners in order, have a point in common.
    pub(super) fn meets(&self, polygon: &[Vector3<f64>]) -> bool {
        let (mut signs, mut nearest) = ([false; 2], f64::INFINITY);
        for (i, from) in polygon.iter().enumerate() {
            let (side, away) = (polygon[(i + 1) % polygon.len()] - from, self.point - from);
            signs[usize::from(side.cross(&away).dot(&self.normal) > 0.0)] = true;
            let share = (away.dot(&side) / side.norm_squared()).clamp(0.0, 1.0);
            // A side of no length is its corner.
            let share = if share.is_finite() { share } else { 0.0 };
            nearest = nearest.min((away - share * side).norm());
        }
        nearest <= self.radius || !(signs[0] && signs[1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Dipping 30° to the east: one metre east is tan 30° lower.
    #[test]
    fn dip_and_direction_are_those_of_a_compass() {
        let joint = Joint::new([0.0; 3], 30.0, 90.0).unwrap();
        let descent = Vector3::new(1.0, 0.0, -30f64.to_radians().tan());
        assert!(
            joint.normal.dot(&descent).abs() < 1e-15
                && joint.normal.z > 0.0
                && (joint.normal.norm() - 1.0).abs() < 1e-15
        );
        assert!(Joint::new([0.0; 3], 91.0, 0.0).is_err() && Joint::new([f64::NAN, 0.0, 0.0], 1.0, 0.0).is_err());
        assert!(joint.with_radius(0.0).is_err());
    }

    #[test]
    fn a_disc_meets_what_it_reaches() {
        let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]].map(|[x, y]| Vector3::new(x, y, 0.0));
        let disc = |x: f64, y: f64, radius| Joint::new([x, y, 0.0], 0.0, 0.0).unwrap().with_radius(radius).unwrap();
        assert!(disc(1.0, 1.0, 0.1).meets(&square));
        assert!(disc(3.0, 1.0, 1.01).meets(&square) && !disc(3.0, 1.0, 0.99).meets(&square));
        assert!(disc(3.0, 3.0, 1.42).meets(&square) && !disc(3.0, 3.0, 1.41).meets(&square));
        let turned: Vec<_> = square.iter().rev().copied().collect();
        assert!(disc(1.0, 1.0, 0.1).meets(&turned) && !disc(3.0, 1.0, 0.99).meets(&turned));
    }
}
