//! S of a placed body in doubles, with a bound on what rounding does to it: what is clear needs no 32 digits.

use nalgebra::{Matrix3, Vector3};
use potential_particles::{Particle, Plane, Pose};

/// What all poses of a body share.
pub struct Shape {
    planes: Vec<Plane>,
    plane_weight: f64,
    sphere_weight: f64,
    /// Longest normal.
    longest: f64,
    bounding_radius: f64,
    /// s at the centre.
    least: f64,
}

/// A body in world axes about the centre of B.
pub struct Placed<'a> {
    shape: &'a Shape,
    rotation: Matrix3<f64>,
    centre: Vector3<f64>,
}

/// S at a point; the truth lies within `error`.
#[derive(Clone, Copy, Debug)]
pub struct Value {
    pub value: f64,
    pub error: f64,
    pub gradient: Vector3<f64>,
    /// Bound on the error of the gradient.
    pub gradient_error: f64,
    /// 2(1−k)/r² Σ⟨n·x − d⟩: what one unit of length, by which all planes are wrong, does to S.
    pub pull: f64,
}

/// S at x + v, and a linear function below + slope·(z − x) that is nowhere above S, in world axes; the truth lies
/// within the errors.
#[derive(Clone, Copy, Debug)]
pub struct Near {
    pub value: f64,
    pub error: f64,
    pub below: f64,
    pub below_error: f64,
    /// That of S at x + v.
    pub slope: Vector3<f64>,
    pub slope_error: f64,
}

/// Roundings of a distance to a plane, in units of the lengths it is made from: nine products and sums of the turn,
/// whose entries are themselves off by a few, and four of the plane.
const ROUNDINGS: f64 = 16.0;
const EPS: f64 = f64::EPSILON;

impl Shape {
    pub fn of(particle: &Particle) -> Self {
        let (r, k, shadow) = (particle.rounding_radius(), particle.sphericity(), particle.shadow_radius());
        let planes: Vec<Plane> = particle.planes().filter(|_| k < 1.0).collect();
        Self {
            longest: planes.iter().map(|plane| plane.normal.norm()).fold(0.0, f64::max),
            planes,
            plane_weight: if k == 1.0 { 0.0 } else { (1.0 - k) / (r * r) },
            sphere_weight: if k == 0.0 { 0.0 } else { k / (shadow * shadow) },
            bounding_radius: particle.bounding_radius(),
            least: (particle.potential(&Vector3::zeros()) + 1.0).max(0.0).sqrt(),
        }
    }
}

impl<'a> Placed<'a> {
    pub fn new(shape: &'a Shape, pose: &Pose, origin: &Vector3<f64>) -> Self {
        Self { shape, rotation: *pose.rotation(), centre: pose.position() - origin }
    }

    pub fn centre(&self) -> Vector3<f64> {
        self.centre
    }

    pub fn bounding_radius(&self) -> f64 {
        self.shape.bounding_radius
    }

    pub fn at(&self, x: &Vector3<f64>) -> Value {
        let y = self.rotation.tr_mul(&(x - self.centre));
        let length = y.norm();
        // Of the place in the body's own axes.
        let arm = EPS * (ROUNDINGS * length + self.centre.norm());
        let Shape { longest, plane_weight: w, sphere_weight: m, .. } = *self.shape;
        let (mut square, mut excesses, mut error, mut swing) = (0.0, 0.0, 0.0, 0.0);
        let mut pull = Vector3::zeros();
        let mut count = 0.0;
        for plane in &self.shape.planes {
            let excess = plane.normal.dot(&y) - plane.offset;
            let off = longest * arm + EPS * plane.offset.abs();
            if excess <= -off {
                continue;
            }
            let on = excess.max(0.0);
            square += on * on;
            excesses += on;
            error += (on + on + off) * off;
            swing += off;
            pull += on * plane.normal;
            count += 1.0;
        }
        let value = w * square + m * length * length;
        Value {
            value,
            error: w * error + m * (length + length + arm) * arm + EPS * (count + 8.0) * value,
            gradient: self.rotation * (2.0 * (w * pull + m * y)),
            gradient_error: 2.0 * (w * swing * longest + m * arm)
                + EPS * (count + ROUNDINGS) * 2.0 * (w * excesses * longest + m * length),
            pull: 2.0 * w * excesses,
        }
    }

    /// ∇²S in world axes, planes that are on.
    pub fn hessian(&self, x: &Vector3<f64>) -> Matrix3<f64> {
        let y = self.rotation.tr_mul(&(x - self.centre));
        let on = self.shape.planes.iter().filter(|plane| plane.normal.dot(&y) > plane.offset);
        let planes = on.fold(Matrix3::zeros(), |sum, plane| sum + plane.normal * plane.normal.transpose());
        let local = 2.0 * (self.shape.plane_weight * planes + Matrix3::from_diagonal_element(self.shape.sphere_weight));
        self.rotation * local * self.rotation.transpose()
    }

    /// Around x + v, which need not be a point in doubles. Each square e² is at least 2êe − ê² for any ê, and those of
    /// x + v are taken: the slope is as exact as the ê are, however much a rounding of x would do to that of S.
    pub fn near(&self, x: &Vector3<f64>, v: &Vector3<f64>) -> Near {
        let y = self.rotation.tr_mul(&(x - self.centre));
        let (step, length) = (self.rotation.tr_mul(v), y.norm());
        let arm = EPS * (ROUNDINGS * (length + step.norm()) + self.centre.norm());
        let Shape { longest, plane_weight: w, sphere_weight: m, .. } = *self.shape;
        let (mut sum, mut below_error, mut sizes, mut pushes, mut count) = (0.0, 0.0, 0.0, 0.0, 0.0);
        let (mut square, mut error) = (0.0, 0.0);
        let mut slope = Vector3::zeros();
        for plane in &self.shape.planes {
            let excess = plane.normal.dot(&y) - plane.offset;
            let taken = excess + plane.normal.dot(&step);
            let off = longest * arm + EPS * (plane.offset.abs() + taken.abs());
            if taken <= -off {
                continue;
            }
            error += (2.0 * taken.max(0.0) + off) * off;
            if taken <= 0.0 {
                continue;
            }
            square += taken * taken;
            sum += taken * (excess + excess - taken);
            sizes += taken * (2.0 * excess.abs() + taken);
            below_error += taken * off;
            slope += taken * plane.normal;
            pushes += taken;
            count += 1.0;
        }
        let there = y + step;
        let far = there.norm();
        Near {
            value: w * square + m * far * far,
            error: w * error + m * (far + far + arm) * arm + EPS * (count + 8.0) * (w * square + m * far * far),
            below: w * sum + m * there.dot(&(y + y - there)),
            below_error: 2.0 * (w * below_error + m * far * arm)
                + EPS * (count + 8.0) * (w * sizes + m * far * (length + length + far)),
            slope: self.rotation * (2.0 * (w * slope + m * there)),
            slope_error: EPS * (count + ROUNDINGS) * 2.0 * (w * pushes * longest + m * far),
        }
    }

    /// How much S grows when every plane moves in by `depth`.
    pub fn risen(&self, x: &Vector3<f64>, depth: f64) -> f64 {
        let y = self.rotation.tr_mul(&(x - self.centre));
        let grown = |excess: f64| {
            let reached = excess.max(0.0);
            if excess + depth > 0.0 { (excess + depth - reached) * (excess + depth + reached) } else { 0.0 }
        };
        self.shape.plane_weight * self.shape.planes.iter().map(|p| grown(p.normal.dot(&y) - p.offset)).sum::<f64>()
    }

    /// How far S ≤ level reaches from x, at most: s is convex along each ray from the centre, and the ball ends no
    /// sooner than the surface.
    pub fn farthest(&self, x: &Vector3<f64>, level: f64) -> f64 {
        let s0 = self.shape.least;
        (x - self.centre).norm() + self.bounding_radius() * (level.max(1.0).sqrt() - s0) / (1.0 - s0)
    }
}

impl Value {
    /// Distance from the surface {S = 1} to first order, and how far rounding can put that off; infinite where it says
    /// nothing.
    pub fn off_surface(&self) -> (f64, f64) {
        let (s, slope) = (self.value.sqrt(), self.gradient.norm());
        let steep = slope / (s + s);
        let off = ((s - 1.0) / steep).abs();
        let lost = self.gradient_error / slope;
        let doubt = (self.error / (s + 1.0) + EPS * (s + 1.0)) / steep + 2.0 * off * lost;
        // Half of the slope lost to rounding, or nearly: then the first order says nothing either.
        if lost < 0.25 && self.error < 0.1 * self.value { (off, 2.0 * doubt) } else { (off, f64::INFINITY) }
    }
}
