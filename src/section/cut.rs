//! S of one particle in the section plane.
//!
//! Coordinates y have their origin at the contact point. A plane becomes the line excess + rate·y = 0, and
//!
//! ```text
//! S(y) − 1 = w·Σ ⟨excess_i + rate_i·y⟩² + s·|y − y₀|² + constant
//! ```
//!
//! It is summed as the change since the origin, whose value and slope are rounded once and for all: inside a tiny cut
//! the function is then as smooth and precise as inside a large one.

use super::conic::{Conic, quarter_turn};
use super::line::{Line, Lines, ROUNDING};
use super::{Side, Trouble, margin};
use nalgebra::Vector2;

/// The cut {S ≤ 1} of one particle.
#[derive(Debug)]
pub(super) struct Cut<'s> {
    /// The planes that may reach what was looked at.
    pub lines: Lines<'s>,
    plane_weight: f64,
    sphere_weight: f64,
    /// 1 − S at the origin.
    margin: f64,
    /// Half the gradient of S at the origin, and its length.
    slope: Vector2<f64>,
    steepness: f64,
}

/// S at a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Look {
    /// S − 1.
    pub value: f64,
    pub half_gradient: Vector2<f64>,
    /// Rounding of S, in units of ε.
    pub rounding: f64,
    /// Distance from the contact point.
    pub far: f64,
}

impl Look {
    /// Whether S = 1 up to rounding.
    pub fn on_edge(&self) -> bool {
        self.value.abs() <= ON_EDGE * self.rounding
    }
}

/// Multiple of the rounding of S up to which a point counts as on the edge.
const ON_EDGE: f64 = 4.0 * f64::EPSILON;

/// 1 − S at the contact point, as a multiple of its rounding, below which it is worth twice the usual precision.
const SMALL: f64 = 1e11;

/// S − 1 up to which a contact point counts as on the surface: what a solver may leave.
const ON_SURFACE: f64 = 1e-6;

/// Most steps of a search along a ray; four are usual.
const MOST_STEPS: usize = 60;

impl<'s> Cut<'s> {
    /// Fails when the origin is outside.
    pub fn new(side: &'s Side, room: &'s mut [Line]) -> Result<Self, Trouble> {
        let Side { particle, point, axes, .. } = side;
        let (plane_weight, sphere_weight) = (particle.plane_weight, particle.sphere_weight);
        let lines = Lines::new(side, room)?;
        let (mut sum, mut pull, mut along) = (0.0, 0.0, Vector2::zeros());
        for line in lines.as_slice() {
            let reached = line.excess.max(0.0);
            sum += reached * reached;
            pull += reached;
            along += reached * line.rate;
        }
        let size = point.norm() + particle.bounds.offset_within(point.norm());
        let mut margin = 1.0 - plane_weight * sum - sphere_weight * point.norm_squared();
        let rounding = ROUNDING * (1.0 + 2.0 * plane_weight * pull * size);
        if margin < SMALL * rounding {
            margin = margin::precise(side);
        }
        if !(margin >= -ON_SURFACE - rounding) {
            return Err(Trouble::Outside);
        }
        // A contact point on the surface is inside.
        let margin = margin.max(f64::EPSILON * rounding);
        let centre = Vector2::new(point.dot(&axes[0]), point.dot(&axes[1]));
        let slope = plane_weight * along + sphere_weight * centre;
        Ok(Self { lines, plane_weight, sphere_weight, margin, slope, steepness: slope.norm() })
    }

    /// A look at a point.
    pub fn look(&mut self, y: &Vector2<f64>) -> Look {
        let far = y.norm();
        self.sum(y, far, |line| line.look(y, far))
    }

    /// A look at a point that lies a step behind the one before it.
    pub fn follow(&mut self, y: &Vector2<f64>, step: &Vector2<f64>) -> Look {
        let (far, near) = (y.norm(), step.norm());
        self.sum(y, far, |line| line.follow(y, far, step, near))
    }

    /// S − 1, half its gradient and the rounding of S, from lines that are looked at on the way.
    #[inline(always)]
    fn sum(&mut self, y: &Vector2<f64>, far: f64, look: impl Fn(&mut Line)) -> Look {
        let (mut sum, mut rounding, mut pull) = (0.0, 0.0, Vector2::zeros());
        self.lines.look(look, |line| {
            if line.excess <= 0.0 {
                if line.here > 0.0 {
                    sum += line.here * line.here;
                    pull += line.here * line.rate;
                    rounding += line.here * line.noise();
                }
            } else if line.here >= 0.0 {
                // ⟨excess + change⟩² − excess² less its linear part, which is in the slope.
                sum += line.change * line.change;
                pull += line.change * line.rate;
                rounding += line.change.abs() * line.noise();
            } else {
                sum -= line.excess * (line.change + line.here);
                pull -= line.excess * line.rate;
                rounding += line.excess * line.noise();
            }
        });
        let (w, s) = (self.plane_weight, self.sphere_weight);
        let square = s * y.norm_squared();
        Look {
            value: w * sum + square + 2.0 * self.slope.dot(y) - self.margin,
            half_gradient: w * pull + s * y + self.slope,
            rounding: 2.0 * (w * rounding + square + self.steepness * far),
            far,
        }
    }

    /// The conic that the edge follows counter-clockwise from a point y that was looked at last.
    ///
    /// A line that passes through y, up to rounding or because it is the one `switching` there, counts when its
    /// excess grows that way. The excess is taken as 0: stiff as it may be, its rounding would turn the conic.
    pub fn conic(&mut self, y: &Vector2<f64>, look: &Look, switching: Option<u32>) -> Conic {
        let (w, s) = (self.plane_weight, self.sphere_weight);
        let lines = &mut self.lines;
        if let Some(i) = switching
            && !lines.at(i).reaches()
        {
            lines.reach_by(i);
        }
        let mut half_gradient = look.half_gradient;
        let mut each = lines.reaching();
        while let Some(i) = each {
            let line = lines.at(i);
            if switching == each || line.offset() == 0.0 {
                if line.here > 0.0 {
                    let beyond = if line.excess > 0.0 { line.change + line.excess } else { line.here };
                    half_gradient -= w * beyond * line.rate;
                }
                (line.here, line.change, line.doubt) = (0.0, -line.excess, 0.0);
            }
            each = line.next;
        }
        let onwards = quarter_turn(&half_gradient);
        let (mut stiffest, mut square) = (Vector2::x(), 0.0);
        each = lines.reaching();
        while let Some(i) = each {
            let line = lines.at(i);
            line.on = line.here > 0.0 || line.rate.dot(&onwards) > 0.0;
            if line.on && line.rate.norm_squared() > square {
                (stiffest, square) = (line.rate, line.rate.norm_squared());
            }
            each = line.next;
        }
        let stiff = if square > 0.0 { stiffest / square.sqrt() } else { stiffest };
        let soft = quarter_turn(&stiff);
        let (mut uu, mut uv, mut vv, mut tilt) = (0.0, 0.0, 0.0, 0.0);
        each = lines.reaching();
        while let Some(i) = each {
            let line = lines.at(i);
            if line.on {
                let (u, v) = (line.rate.dot(&stiff), line.rate.dot(&soft));
                uu += u * u;
                uv += u * v;
                vv += v * v;
                tilt += line.noise() * line.rate.dot(&onwards).abs();
            }
            each = line.next;
        }
        let tilt = w * tilt / onwards.norm() + s * look.far;
        Conic { base: *y, half_gradient, stiff, uu: w * uu + s, uv: w * uv, vv: w * vv + s, tilt }
    }

    /// Distance to the edge along the ray of a unit direction.
    ///
    /// The root of the quadratic at hand is exact once the right planes are on; before that a jump out of the
    /// bracket becomes a Newton step from outside, which, S being convex, never passes the edge.
    pub fn ray(&mut self, direction: &Vector2<f64>) -> Result<f64, Trouble> {
        let (mut inside, mut outside, mut newton) = (0.0, f64::INFINITY, f64::NAN);
        let mut distance = 0.0;
        for _ in 0..MOST_STEPS {
            let look = self.look(&(distance * direction));
            if look.on_edge() {
                return Ok(distance);
            }
            let (value, slope) = (look.value, look.half_gradient.dot(direction));
            if value < 0.0 {
                inside = distance;
            } else {
                (outside, newton) = (distance, distance - 0.5 * value / slope);
            }
            let curvature = self.curvature(direction);
            let root = (slope * slope - curvature * value).sqrt();
            let mut next = distance + if slope >= 0.0 { -value / (slope + root) } else { (root - slope) / curvature };
            if outside == f64::INFINITY {
                next = if next > inside { next.min(self.lines.reach()) } else { self.lines.reach() };
            } else if !(inside < next && next < outside) {
                next = newton;
            }
            if !(inside < next && next < outside) {
                return Ok(distance);
            }
            if next > self.lines.horizon() {
                self.lines.widen_towards(next, &(distance * direction))?;
                next = next.min(self.lines.horizon());
            }
            distance = next;
        }
        Err(Trouble::Spoilt)
    }

    /// Half the second derivative of S along a direction at the point looked at last.
    fn curvature(&self, direction: &Vector2<f64>) -> f64 {
        let active = self.lines.as_slice().iter().filter(|line| line.here > 0.0);
        self.plane_weight * active.map(|line| line.rate.dot(direction).powi(2)).sum::<f64>() + self.sphere_weight
    }
}
