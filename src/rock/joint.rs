//! A joint: a plane through the rock, or a disc or polygon of it.

use super::numbers::{FLAT, SHORT};
use crate::rock::error::{RockError, within};
use crate::rock::polygon::{axes_across, clip, within_circle};
use nalgebra::{Vector2, Vector3};
use std::f64::consts::TAU;
use std::sync::Arc;

/// A plane, or a disc or convex polygon of it, along which rock has parted. Axes: x east, y north, z up.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Joint {
    /// A point of it, length; of a disc its centre.
    pub point: Vector3<f64>,
    /// Unit normal.
    pub normal: Vector3<f64>,
    /// Radius of a disc, length; infinite of a joint without end; of a polygon that of a disc about the point that
    /// holds it.
    pub radius: f64,
    /// Corners of a polygon in their order, as [`Joint::polygon`] makes it.
    pub outline: Option<Arc<[Vector3<f64>]>>,
}

impl Joint {
    /// The plane through a point that descends most, by the angle `dip` in degrees, towards the azimuth `dip_direction`
    /// in degrees, clockwise from north: its normal is (sin δ sin α, sin δ cos α, cos δ) and points upwards.
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
        Ok(Self { point, normal, radius: f64::INFINITY, outline: None })
    }

    /// The plane through a point with a normal of any length, without end.
    pub fn through(point: impl Into<Vector3<f64>>, normal: impl Into<Vector3<f64>>) -> Self {
        Self { point: point.into(), normal: normal.into(), radius: f64::INFINITY, outline: None }
    }

    /// A convex polygon, by its corners in their order: trace and dip length of a mapped joint as a rectangle, a face
    /// of a fracture network.
    ///
    /// # Errors
    /// Fewer than three corners, corners that are not finite, on one line, off their plane by more than 10⁻⁶ of the
    /// size, or not those of a convex polygon.
    pub fn polygon<T: Into<Vector3<f64>> + Clone>(corners: &[T]) -> Result<Self, RockError> {
        let corners: Arc<[Vector3<f64>]> = corners.iter().cloned().map(Into::into).collect();
        let count = corners.len();
        let point = corners.iter().sum::<Vector3<f64>>() / count as f64;
        let radius = corners.iter().map(|at| (at - point).norm()).fold(0.0, f64::max);
        // Twice the area, and its direction.
        let edge = |i: usize| corners[(i + 1) % count] - corners[i];
        let doubled = (0..count).map(|i| (corners[i] - point).cross(&edge(i))).sum::<Vector3<f64>>();
        let normal = doubled.normalize();
        let off = |at: &Vector3<f64>| (at - point).dot(&normal).abs();
        let must = |what: &str| RockError::NoPolygon(what.to_string());
        if count < 3 {
            return Err(must("be three or more"));
        }
        if !(doubled.norm() > FLAT * radius * radius) {
            return Err(must("be finite, and not all on one line"));
        }
        if let Some(i) = (0..count).find(|&i| !(off(&corners[i]) <= FLAT * radius)) {
            return Err(must(&format!("lie in one plane: corner {i} is {:.1e} off it", off(&corners[i]))));
        }
        // Turns to the left that sum to one turn: a star has two.
        let turn = |i: usize| {
            let (here, next) = (edge(i), edge((i + 1) % count));
            here.cross(&next).dot(&normal).atan2(here.dot(&next))
        };
        if let Some(i) = (0..count).find(|&i| turn(i) < -FLAT) {
            return Err(must(&format!(
                "be those of a convex polygon, in their order: it turns inwards at corner {}",
                (i + 1) % count
            )));
        }
        let turned = (0..count).map(turn).sum::<f64>();
        if (turned - TAU).abs() > 0.1 {
            return Err(must("be those of a convex polygon, in their order: they go around more than once"));
        }
        Ok(Self { point, normal, radius, outline: Some(corners) })
    }

    /// The same as a disc about its point.
    ///
    /// # Errors
    /// A radius that is not above 0.
    pub fn with_radius(self, radius: f64) -> Result<Self, RockError> {
        within(radius, radius > 0.0, "radius of a joint", "above 0")?;
        Ok(Self { radius, outline: None, ..self })
    }

    /// The same with its place given from another origin, and a unit normal.
    pub(super) fn about(&self, origin: &Vector3<f64>, normal: Vector3<f64>) -> Self {
        let outline = self.outline.as_ref().map(|outline| outline.iter().map(|at| at - origin).collect());
        Self { point: self.point - origin, normal, radius: self.radius, outline }
    }

    /// Unit normals and heights of planes across the joint's own, between which a polygon lies; none of other joints.
    pub(super) fn borders(&self) -> impl Iterator<Item = (Vector3<f64>, f64)> {
        sides(self.outline.as_deref().unwrap_or_default()).map(|(from, side)| {
            let outwards = side.cross(&self.normal).normalize();
            (outwards, outwards.dot(&from))
        })
    }

    /// The area that a convex polygon in its plane, corners in order, shares with the disc or polygon.
    pub(super) fn shared_area(&self, polygon: &[Vector3<f64>]) -> f64 {
        // Corners about the point of the joint, along two axes of its plane.
        let [u, v] = axes_across(&self.normal);
        let flat = |x: &Vector3<f64>| Vector2::new(u.dot(x), v.dot(x));
        let mut corners: Vec<_> = polygon.iter().map(|at| flat(&(at - self.point))).collect();
        for (n, height) in self.borders() {
            let (normal, left) = (flat(&n), height - n.dot(&self.point));
            clip(&mut corners, |at| left - normal.dot(at));
        }
        let radius = if self.outline.is_some() { f64::INFINITY } else { self.radius };
        let pairs = corners.iter().zip(corners.iter().cycle().skip(1));
        pairs.map(|(a, b)| within_circle(radius, a, b)).sum::<f64>().abs()
    }

    /// Whether a point of its plane lies in the disc or polygon.
    pub(super) fn holds(&self, at: &Vector3<f64>) -> bool {
        (at - self.point).norm() <= self.radius && self.borders().all(|(n, height)| n.dot(at) <= height)
    }

    /// Whether the disc or polygon and a convex polygon in its plane, corners in order, have a point in common.
    pub(super) fn meets(&self, polygon: &[Vector3<f64>]) -> bool {
        match &self.outline {
            Some(outline) => !self.is_parted(outline, polygon) && !self.is_parted(polygon, outline),
            None => self.disc_meets(polygon),
        }
    }

    /// Whether a line along a side of `first` has both polygons on its two sides: of two convex polygons that are
    /// apart, some side of one does.
    fn is_parted(&self, first: &[Vector3<f64>], other: &[Vector3<f64>]) -> bool {
        sides(first).any(|(from, side)| {
            let across = side.cross(&self.normal);
            let reach = |polygon: &[Vector3<f64>]| {
                let heights = polygon.iter().map(|at| across.dot(&(at - from)));
                heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| (low.min(h), high.max(h)))
            };
            let (own, its) = (reach(first), reach(other));
            own.1 < its.0 || its.1 < own.0
        })
    }

    fn disc_meets(&self, polygon: &[Vector3<f64>]) -> bool {
        let (mut signs, mut nearest) = ([false; 2], f64::INFINITY);
        for (from, side) in sides(polygon) {
            let away = self.point - from;
            signs[usize::from(side.cross(&away).dot(&self.normal) > 0.0)] = true;
            let share = (away.dot(&side) / side.norm_squared()).clamp(0.0, 1.0);
            nearest = nearest.min((away - share * side).norm());
        }
        nearest <= self.radius || !(signs[0] && signs[1])
    }
}

/// The sides of a polygon with the corners at which they begin, but for those so short that their direction is
/// rounding: where more than three planes meet in a point, faces have such sides.
fn sides(polygon: &[Vector3<f64>]) -> impl Iterator<Item = (Vector3<f64>, Vector3<f64>)> {
    let size = polygon.iter().map(|at| (at - polygon[0]).norm()).fold(0.0, f64::max);
    let all = polygon.iter().zip(polygon.iter().cycle().skip(1)).map(|(from, to)| (*from, to - from));
    all.filter(move |(_, side)| side.norm() > SHORT * size)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

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

    /// Against the same question for many points of both, whose answer is yes where a point of one lies in the other or
    /// sides cross.
    #[test]
    fn polygons_meet_where_they_share_points() {
        let mut random = Random::new(5, 0);
        let (mut apart, mut together) = (0, 0);
        for _ in 0..400 {
            let mut polygon = |sides: usize, away: f64| {
                let (x, y) = (random.between(-away, away), random.between(-away, away));
                let (radius, first) = (random.between(0.3, 1.0), random.between(0.0, TAU));
                let corner = |i: usize| {
                    let (sin, cos) = (first + TAU * i as f64 / sides as f64).sin_cos();
                    Vector3::new(x + radius * cos, y + 0.4 * radius * sin, 0.0)
                };
                (0..sides).map(corner).collect::<Vec<_>>()
            };
            let (first, other) = (polygon(5, 0.0), polygon(4, 1.5));
            let inside = |at: &Vector3<f64>, polygon: &[Vector3<f64>]| {
                (0..polygon.len()).all(|i| {
                    let side = polygon[(i + 1) % polygon.len()] - polygon[i];
                    side.cross(&(at - polygon[i])).z >= 0.0
                })
            };
            // Of the triangles that the corners span with the middle, points on a grid.
            let touch = |a: &[Vector3<f64>], b: &[Vector3<f64>]| {
                let middle = a.iter().sum::<Vector3<f64>>() / a.len() as f64;
                (0..a.len()).any(|i| {
                    (0..=200).any(|t| {
                        let edge = a[i] + f64::from(t) / 200.0 * (a[(i + 1) % a.len()] - a[i]);
                        inside(&edge, b) || inside(&middle, b)
                    })
                })
            };
            let expected = touch(&first, &other) || touch(&other, &first);
            let joint = Joint::polygon(&first).unwrap();
            assert_eq!(joint.meets(&other), expected);
            let turned: Vec<_> = other.iter().rev().copied().collect();
            assert_eq!(joint.meets(&turned), expected);
            if expected { together += 1 } else { apart += 1 }
        }
        assert!(apart > 50 && together > 50, "{apart} {together}");
    }

    /// Against closed forms, and the share of points drawn in the polygon that lie in the joint.
    #[test]
    fn shared_areas_are_those_of_points() {
        let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]].map(|[x, y]| Vector3::new(x, y, 0.0));
        let disc = |x: f64, y: f64, radius| Joint::new([x, y, 0.0], 0.0, 0.0).unwrap().with_radius(radius).unwrap();
        let quarter = TAU / 8.0;
        let cases =
            [(disc(1.0, 1.0, 0.5), quarter), (disc(0.0, 0.0, 1.0), quarter), (disc(1.0, 2.0, 1.0), 2.0 * quarter)];
        for (joint, area) in cases {
            assert!((joint.shared_area(&square) - area).abs() < 1e-14);
        }
        assert_eq!(disc(1.0, 1.0, 9.0).shared_area(&square), 4.0);
        assert!(disc(5.0, 1.0, 1.0).shared_area(&square).abs() < 1e-14);
        assert!((Joint::new([3.0, 1.0, 0.0], 0.0, 0.0).unwrap().shared_area(&square) - 4.0).abs() < 1e-15);
        let mut random = Random::new(7, 0);
        let normal = random.direction();
        let axes = [normal.cross(&Vector3::x()).normalize(), normal.cross(&normal.cross(&Vector3::x())).normalize()];
        let at = |x: f64, y: f64| x * axes[0] + y * axes[1];
        let square = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| at(x, y));
        for case in 0..20 {
            let centre = [random.between(-1.0, 1.0), random.between(-1.0, 1.0)];
            let radius = random.between(0.3, 1.5);
            let turn = random.between(0.0, TAU);
            let corner = |i: usize| (turn + TAU * i as f64 / 5.0).sin_cos();
            let polygon: Vec<_> =
                (0..5).map(|i| at(centre[0] + radius * corner(i).0, centre[1] + radius * corner(i).1)).collect();
            let joint = match case % 2 {
                0 => Joint::through(at(centre[0], centre[1]), normal).with_radius(radius).unwrap(),
                _ => Joint::polygon(&polygon).unwrap(),
            };
            let drawn = 40_000;
            let hits =
                (0..drawn).filter(|_| joint.holds(&at(random.between(-1.0, 1.0), random.between(-1.0, 1.0)))).count();
            let expected = 4.0 * hits as f64 / f64::from(drawn);
            assert!((joint.shared_area(&square) - expected).abs() < 0.05, "{case}: {expected}");
        }
    }

    #[test]
    fn outlines_that_are_none_are_told() {
        let square = [[0.0, 0.0, 1.0], [2.0, 0.0, 1.0], [2.0, 1.0, 1.0], [0.0, 1.0, 1.0]];
        let joint = Joint::polygon(&square).unwrap();
        assert!(
            (joint.normal - Vector3::z()).norm() < 1e-15 && (joint.point - Vector3::new(1.0, 0.5, 1.0)).norm() < 1e-15
        );
        assert!((joint.radius - 1.25f64.sqrt()).abs() < 1e-15);
        let text = |corners: &[[f64; 3]]| Joint::polygon(corners).unwrap_err().to_string();
        assert!(text(&square[..2]).contains("three or more") && text(&[[0.0; 3]; 4]).contains("not all on one line"));
        assert!(text(&[[f64::NAN; 3]; 4]).contains("finite"));
        let [a, b, c, d] = square;
        assert!(text(&[a, b, c, [0.0, 1.0, 1.1]]).contains("in one plane: corner 0 is 2.5e-2 off it"));
        assert!(text(&[a, c, b, [0.0, 2.0, 1.0]]).contains("convex"));
        assert!(text(&[a, b, [1.0, 0.1, 1.0], d]).contains("inwards at corner 2"));
        assert!(Joint::polygon(&[a, b, [1.0, 0.5, 1.0], d]).is_ok());
        let star: Vec<[f64; 3]> =
            (0..5).map(|i| (2.0 * TAU * f64::from(i) / 5.0).sin_cos()).map(|(s, c)| [c, s, 0.0]).collect();
        assert!(text(&star).contains("convex"));
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
