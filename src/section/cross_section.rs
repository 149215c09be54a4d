//! S of one particle in the section plane.
//!
//! Coordinates y have their origin at the contact point. A plane becomes the line at_origin + rate·y = 0, and
//!
//! ```text
//! S(y) − 1 = w·Σ ⟨at_origin_i + rate_i·y⟩² + s·|y − y₀|² + constant
//! ```
//!
//! It is summed as the change since the origin, whose value and slope are rounded only once: S then has the same
//! relative precision in a tiny cross-section as in a large one.

use super::depth;
use super::edge_curve::{EdgeCurve, quarter_turn};
use super::lines::{Line, Lines};
use super::numbers::{ON_BOUNDARY, ON_SURFACE, ROUNDING, SHALLOW};
use super::plane_section::{Failure, PlaneSection};
use crate::linalg::root::{Bracket, MOST_STEPS};
use nalgebra::Vector2;

/// The cross-section {S ≤ 1} of one particle.
#[derive(Debug)]
pub(super) struct CrossSection<'s> {
    /// The planes that may be active as far as they are loaded.
    pub lines: Lines<'s>,
    plane_weight: f64,
    sphere_weight: f64,
    /// 1 − S at the origin.
    depth: f64,
    /// Half the gradient of S at the origin, and its length.
    slope: Vector2<f64>,
    steepness: f64,
}

/// S at a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Evaluation {
    /// S − 1.
    pub value: f64,
    pub half_gradient: Vector2<f64>,
    /// Estimated rounding of S, in units of ε.
    pub rounding: f64,
    /// Distance from the contact point.
    pub distance: f64,
}

impl Evaluation {
    /// Whether S = 1 up to rounding.
    pub fn on_boundary(&self) -> bool {
        self.value.abs() <= ON_BOUNDARY * self.rounding
    }
}

impl<'s> CrossSection<'s> {
    /// Fails when the origin is outside.
    pub fn new(section: &'s PlaneSection, buffer: &'s mut [Line]) -> Result<Self, Failure> {
        let PlaneSection { shape, point, axes, .. } = section;
        let (plane_weight, sphere_weight) = (shape.plane_weight, shape.sphere_weight);
        let lines = Lines::new(section, buffer)?;
        let (mut sum, mut pull, mut along) = (0.0, 0.0, Vector2::zeros());
        for line in lines.as_slice() {
            let reached = line.at_origin.max(0.0);
            sum += reached * reached;
            pull += reached;
            along += reached * line.rate;
        }
        let size = point.norm() + shape.bounds.offset_within(point.norm());
        let mut depth = 1.0 - plane_weight * sum - sphere_weight * point.norm_squared();
        let rounding = ROUNDING * (1.0 + 2.0 * plane_weight * pull * size);
        if depth < SHALLOW * rounding {
            depth = depth::of(section);
        }
        if !(depth >= -ON_SURFACE - rounding) {
            return Err(Failure::Outside);
        }
        // A contact point on the surface counts as inside.
        let depth = depth.max(f64::EPSILON * rounding);
        let centre = Vector2::new(point.dot(&axes[0]), point.dot(&axes[1]));
        let slope = plane_weight * along + sphere_weight * centre;
        Ok(Self { lines, plane_weight, sphere_weight, depth, slope, steepness: slope.norm() })
    }

    /// S at a point.
    pub fn at(&mut self, y: &Vector2<f64>) -> Evaluation {
        let distance = y.norm();
        self.sum(y, distance, |line| line.move_to(y, distance))
    }

    /// S at a point that is reached by a step from the current one.
    pub fn after_step(&mut self, y: &Vector2<f64>, step: &Vector2<f64>) -> Evaluation {
        let (distance, length) = (y.norm(), step.norm());
        self.sum(y, distance, |line| line.move_by(y, distance, step, length))
    }

    /// S − 1, half its gradient and its rounding, while `to_point` moves the lines.
    #[inline(always)]
    fn sum(&mut self, y: &Vector2<f64>, distance: f64, to_point: impl Fn(&mut Line)) -> Evaluation {
        let (mut sum, mut rounding, mut pull) = (0.0, 0.0, Vector2::zeros());
        self.lines.move_all(to_point, |line| {
            if line.at_origin <= 0.0 {
                if line.excess > 0.0 {
                    sum += line.excess * line.excess;
                    pull += line.excess * line.rate;
                    rounding += line.excess * line.rounding();
                }
            } else if line.excess >= 0.0 {
                // (at_origin + change)² − at_origin² without its linear part, which is in the slope.
                sum += line.change * line.change;
                pull += line.change * line.rate;
                rounding += line.change.abs() * line.rounding();
            } else {
                sum -= line.at_origin * (line.change + line.excess);
                pull -= line.at_origin * line.rate;
                rounding += line.at_origin * line.rounding();
            }
        });
        let (w, s) = (self.plane_weight, self.sphere_weight);
        let square = s * y.norm_squared();
        Evaluation {
            value: w * sum + square + 2.0 * self.slope.dot(y) - self.depth,
            half_gradient: w * pull + s * y + self.slope,
            rounding: 2.0 * (w * rounding + square + self.steepness * distance),
            distance,
        }
    }

    /// The conic that the boundary follows counter-clockwise from the current point y.
    ///
    /// A line through y, up to rounding or because it is the one `switching` there, is active when its excess grows in
    /// that direction. Its excess is set to 0: for a stiff plane its rounding would turn the tangent.
    pub fn edge_curve(&mut self, y: &Vector2<f64>, here: &Evaluation, switching: Option<u32>) -> EdgeCurve {
        let half_gradient = self.without_rounding(here.half_gradient, switching);
        let onwards = quarter_turn(&half_gradient);
        let stiff = self.activate(&onwards);
        let soft = quarter_turn(&stiff);
        let (mut uu, mut uv, mut vv, mut tilt) = (0.0, 0.0, 0.0, 0.0);
        let mut each = self.lines.first_near();
        while let Some(i) = each {
            let line = self.lines.at(i);
            if line.active {
                let (u, v) = (line.rate.dot(&stiff), line.rate.dot(&soft));
                uu += u * u;
                uv += u * v;
                vv += v * v;
                tilt += line.rounding() * line.rate.dot(&onwards).abs();
            }
            each = line.next;
        }
        let (w, s) = (self.plane_weight, self.sphere_weight);
        let tilt = w * tilt / onwards.norm() + s * here.distance;
        EdgeCurve { base: *y, half_gradient, stiff, uu: w * uu + s, uv: w * uv, vv: w * vv + s, tilt }
    }

    /// Sets the excess of lines through the current point to 0, and takes it out of the gradient.
    fn without_rounding(&mut self, mut half_gradient: Vector2<f64>, switching: Option<u32>) -> Vector2<f64> {
        let lines = &mut self.lines;
        if let Some(i) = switching.filter(|i| !lines.at(*i).may_be_active()) {
            lines.add_near(i);
        }
        let mut each = lines.first_near();
        while let Some(i) = each {
            let line = lines.at(i);
            if switching == each || line.significant_excess() == 0.0 {
                if line.excess > 0.0 {
                    let beyond = if line.at_origin > 0.0 { line.change + line.at_origin } else { line.excess };
                    half_gradient -= self.plane_weight * beyond * line.rate;
                }
                (line.excess, line.change, line.length) = (0.0, -line.at_origin, 0.0);
            }
            each = line.next;
        }
        half_gradient
    }

    /// Finds the lines that are active from the current point on. Returns the direction of the stiffest one.
    fn activate(&mut self, onwards: &Vector2<f64>) -> Vector2<f64> {
        let (mut stiffest, mut square) = (Vector2::x(), 0.0);
        let mut each = self.lines.first_near();
        while let Some(i) = each {
            let line = self.lines.at(i);
            line.active = line.excess > 0.0 || line.rate.dot(onwards) > 0.0;
            if line.active && line.rate.norm_squared() > square {
                (stiffest, square) = (line.rate, line.rate.norm_squared());
            }
            each = line.next;
        }
        if square > 0.0 { stiffest / square.sqrt() } else { stiffest }
    }

    /// Distance to the boundary along the ray of a unit direction.
    ///
    /// The root of the quadratic at the current point is exact once the active lines are those of the root. Before
    /// that, a root outside the bracket is replaced by a Newton step from beyond the boundary, which does not overshoot
    /// since S is convex.
    pub fn ray(&mut self, direction: &Vector2<f64>) -> Result<f64, Failure> {
        let mut bracket = Bracket { low: 0.0, high: f64::INFINITY };
        let (mut newton, mut distance) = (f64::NAN, 0.0);
        for _ in 0..MOST_STEPS {
            let here = self.at(&(distance * direction));
            if here.on_boundary() {
                return Ok(distance);
            }
            let (value, slope) = (here.value, here.half_gradient.dot(direction));
            // NaN counts as outside, where the search ends.
            let is_outside = !(value < 0.0);
            bracket.narrow(distance, is_outside);
            if is_outside {
                newton = distance - 0.5 * value / slope;
            }
            let curvature = self.curvature(direction);
            let root = (slope * slope - curvature * value).sqrt();
            let mut next = distance + if slope >= 0.0 { -value / (slope + root) } else { (root - slope) / curvature };
            if bracket.high == f64::INFINITY {
                next = if next > bracket.low { next.min(self.lines.radius()) } else { self.lines.radius() };
            } else if !bracket.contains(next) {
                next = newton;
            }
            if !bracket.contains(next) {
                return Ok(distance);
            }
            if next > self.lines.loaded() {
                self.lines.load_towards(next, &(distance * direction))?;
                next = next.min(self.lines.loaded());
            }
            distance = next;
        }
        Err(Failure::Inaccurate)
    }

    /// Half the second derivative of S along a direction at the current point.
    fn curvature(&self, direction: &Vector2<f64>) -> f64 {
        let active = self.lines.as_slice().iter().filter(|line| line.excess > 0.0);
        self.plane_weight * active.map(|line| line.rate.dot(direction).powi(2)).sum::<f64>() + self.sphere_weight
    }
}
