//! Particles of the plane: the paper's 2-D case (eqs 1 and 5–31), solved by the code for space.
//!
//! A particle of lines a·x + b·y ≤ d is the particle of planes (a, b, 0, d), cut at z = 0. In space
//!
//! ```text
//! S(x, y, z) = S(x, y) + k/R² · z²
//! ```
//!
//! and poses of the plane, a shift and a turn about z, keep that form. Moving a point to z = 0 raises neither
//! S_A nor S_B, so that midway and closest (both are convex problems in S_A and S_B) have an optimum there,
//! and at z = 0 they are the problems of the plane, with the same s, weights and bounds. For k > 0 the
//! optimum is there only. For k = 0 nothing depends on z: in the fast solver the regularisation of flat
//! faces ([`Settings::flat_regularisation`]) holds z at 0, and the cone programs leave z out (eqs 19–31).
//! z begins at 0 and every term that could move it has an exact zero as a factor, so that it stays 0.
//!
//! The one thing not taken over is what bounds a particle: lines that enclose an area are enough, and ball
//! and corners are those of the cut.

use crate::contact::contact;
use crate::contact::contact::{Flags, Kind};
use crate::contact::detect::DetectError;
use crate::pair::pose;
use crate::pair::warm_start::Memory;
use crate::particle::particle::{self, ParticleError};
use crate::particle::ray_cast;
use crate::settings::{BackEnd, Formulation, Settings};
use nalgebra::{Matrix2, Vector2, Vector3};
use thiserror::Error;

/// One line a·x + b·y = d of a particle, local frame, (a, b) pointing outwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Outward normal (a, b); unit length is usual, not required.
    pub normal: Vector2<f64>,
    /// Offset d, length. A side of the finished particle lies near d + r.
    pub offset: f64,
}

impl From<[f64; 3]> for Line {
    /// From (a, b, d).
    fn from([a, b, d]: [f64; 3]) -> Self {
        Self { normal: Vector2::new(a, b), offset: d }
    }
}

/// A validated potential particle of the plane, immutable; share it freely between threads and bodies.
#[derive(Clone, Debug)]
pub struct Particle(particle::Particle);

impl Particle {
    /// Builds a particle from its lines, rounding radius r, sphericity k and radius R of the shadow circle.
    ///
    /// # Errors
    /// Those of [`particle::Particle::new`], of lines: non-finite numbers, k outside [0, 1], r ≤ 0 (unless
    /// k = 1), R ≤ 0 (unless k = 0), a zero normal, an origin that is not inside (f(0) ≥ 0), and for k = 0
    /// lines that enclose no area.
    pub fn new(lines: &[Line], r: f64, k: f64, shadow_radius: f64) -> Result<Self, ParticleError> {
        let planes: Vec<_> =
            lines.iter().map(|line| particle::Plane { normal: raised(&line.normal), offset: line.offset }).collect();
        particle::Particle::in_plane(&planes, r, k, shadow_radius).map(Self)
    }

    /// A circle of the given radius (k = 1, no lines).
    ///
    /// # Errors
    /// A radius that is not positive and finite.
    pub fn circle(radius: f64) -> Result<Self, ParticleError> {
        Self::new(&[], 0.0, 1.0, radius)
    }

    /// f(x) = S(x) − 1 at a local point (paper eq. 1): negative inside, zero on the boundary.
    pub fn potential(&self, x: &Vector2<f64>) -> f64 {
        self.0.potential(&raised(x))
    }

    /// ∇f(x), local frame, 1/length.
    pub fn gradient(&self, x: &Vector2<f64>) -> Vector2<f64> {
        self.0.gradient(&raised(x)).xy()
    }

    /// ∇²f(x), local frame, 1/length². Where a line is just switching on, the side without it.
    pub fn hessian(&self, x: &Vector2<f64>) -> Matrix2<f64> {
        self.0.hessian(&raised(x)).fixed_view::<2, 2>(0, 0).into()
    }

    /// Distance τ ≥ 0 along a local unit direction from a local point inside to the boundary; see
    /// [`ray_cast::distance`].
    pub fn surface_distance(&self, from: &Vector2<f64>, direction: &Vector2<f64>) -> Option<f64> {
        ray_cast::distance(&self.0, &raised(from), &raised(direction))
    }

    /// Lines as given.
    pub fn lines(&self) -> impl ExactSizeIterator<Item = Line> + '_ {
        self.0.planes().map(|plane| Line { normal: plane.normal.xy(), offset: plane.offset })
    }

    /// Rounding radius r, length.
    pub fn rounding_radius(&self) -> f64 {
        self.0.rounding_radius()
    }

    /// Sphericity k (here: how much of a circle it is), no unit.
    pub fn sphericity(&self) -> f64 {
        self.0.sphericity()
    }

    /// Radius R of the shadow circle, length.
    pub fn shadow_radius(&self) -> f64 {
        self.0.shadow_radius()
    }

    /// Radius about the local origin of a circle that holds the whole particle.
    pub fn bounding_radius(&self) -> f64 {
        self.0.bounding_radius()
    }

    /// Corners of a polygon that holds the whole particle, local frame, in no order.
    pub fn bounding_corners(&self) -> impl ExactSizeIterator<Item = Vector2<f64>> + '_ {
        self.0.bounding_corners().iter().map(|corner| corner.xy())
    }

    /// Axis-aligned box in world axes that holds the particle at a pose: (lower, upper).
    pub fn bounding_box(&self, pose: &Pose) -> (Vector2<f64>, Vector2<f64>) {
        let (lower, upper) = self.0.bounding_box(&pose.in_space());
        (lower.xy(), upper.xy())
    }
}

/// Why numbers do not make a pose of the plane.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[allow(missing_docs)]
pub enum PoseError {
    #[error("position ({0:?}, {1:?}) is not finite")]
    Position(f64, f64),
    #[error("angle {0:?} is not finite: give it in radians, anticlockwise")]
    Angle(f64),
}

/// Where a body is: world = rotation · local + position (paper eqs 7, 8).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    position: Vector2<f64>,
    rotation: Matrix2<f64>,
    in_space: pose::Pose,
}

impl Pose {
    /// From a position and the paper's angle θ: radians, anticlockwise, local to world.
    ///
    /// # Errors
    /// A position or angle that is not finite.
    pub fn new(position: [f64; 2], angle: f64) -> Result<Self, PoseError> {
        let [x, y] = position;
        if !(x.is_finite() && y.is_finite()) {
            return Err(PoseError::Position(x, y));
        }
        if !angle.is_finite() {
            return Err(PoseError::Angle(angle));
        }
        let (sin, cos) = angle.sin_cos();
        // tan(θ/2) = sin/(1 + cos) = (1 − cos)/sin, whichever does not cancel.
        let orientation = if cos >= 0.0 { [1.0 + cos, 0.0, 0.0, sin] } else { [sin, 0.0, 0.0, 1.0 - cos] };
        let in_space = pose::Pose::new([x, y, 0.0], orientation).map_err(|_| PoseError::Angle(angle))?;
        let rotation = in_space.rotation().fixed_view::<2, 2>(0, 0).into();
        Ok(Self { position: position.into(), rotation, in_space })
    }

    /// Centre of the particle, world frame.
    pub fn position(&self) -> &Vector2<f64> {
        &self.position
    }

    /// Local to world.
    pub fn rotation(&self) -> &Matrix2<f64> {
        &self.rotation
    }

    /// World point to local point.
    pub fn to_local(&self, world: &Vector2<f64>) -> Vector2<f64> {
        self.rotation.tr_mul(&(world - self.position))
    }

    /// Local direction to world direction.
    pub fn rotate(&self, local: &Vector2<f64>) -> Vector2<f64> {
        self.rotation * local
    }

    fn in_space(&self) -> pose::Pose {
        self.in_space
    }
}

/// The answer for one pair, world axes, lengths in the caller's unit. What does not apply is NaN.
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    /// Separated or overlapping.
    pub kind: Kind,
    /// The formulation that the geometry answers (midway where closest is slack).
    pub formulation: Formulation,
    /// Who answered.
    pub back_end: BackEnd,
    /// What else is to be known.
    pub flags: Flags,
    /// Evaluations (fast) or interior-point iterations (conic).
    pub iterations: u32,
    /// Midway: t. Closest: s_A at P2. Rejected: a proved lower bound, ≥ 1.
    pub s: f64,
    /// Closest: s_B at P1.
    pub s_b: f64,
    /// Weight u of B: (1−u)∇S_A + u∇S_B = 0.
    pub weight: f64,
    /// |s − s*| ≤ gap (and the same for s_b).
    pub gap: f64,
    /// Bound on the distance of the point (of closest: of each of P1 and P2) to the optimum, length.
    pub point_bound: f64,
    /// Overlap, > 0 when overlapping; NaN when separated.
    pub overlap: f64,
    /// Unit normal from A to B.
    pub normal: Vector2<f64>,
    /// Contact point, world frame.
    pub point: Vector2<f64>,
    /// Contact point minus position of A.
    pub branch_a: Vector2<f64>,
    /// Contact point minus position of B.
    pub branch_b: Vector2<f64>,
    /// Point on the boundary of A (P1 of closest), world frame; NaN when separated.
    pub point_on_a: Vector2<f64>,
    /// Point on the boundary of B (P2 of closest), world frame; NaN when separated.
    pub point_on_b: Vector2<f64>,
}

impl From<contact::Contact> for Contact {
    /// Of a contact of two particles of the plane.
    fn from(contact: contact::Contact) -> Self {
        Self {
            kind: contact.kind,
            formulation: contact.formulation,
            back_end: contact.back_end,
            flags: contact.flags,
            iterations: contact.iterations,
            s: contact.s,
            s_b: contact.s_b,
            weight: contact.weight,
            gap: contact.gap,
            point_bound: contact.point_bound,
            overlap: contact.overlap,
            normal: contact.normal.xy(),
            point: contact.point.xy(),
            branch_a: contact.branch_a.xy(),
            branch_b: contact.branch_b.xy(),
            point_on_a: contact.point_on_a.xy(),
            point_on_b: contact.point_on_b.xy(),
        }
    }
}

/// Contact of A at `pose_a` with B at `pose_b`.
///
/// `memory` is what this ordered pair remembers between calls: read, and updated on success.
///
/// # Errors
/// A setting out of range, or no answer from any solver.
pub fn detect(
    a: &Particle,
    pose_a: &Pose,
    b: &Particle,
    pose_b: &Pose,
    settings: &Settings,
    memory: Option<&mut Memory>,
) -> Result<Contact, DetectError> {
    crate::contact::detect::detect(&a.0, &pose_a.in_space(), &b.0, &pose_b.in_space(), settings, memory)
        .map(Contact::from)
}

/// The line through the contact point at right angles to the contact normal, world axes.
#[derive(Clone, Copy, Debug)]
pub struct Section {
    /// Contact point minus position of A.
    pub branch_a: Vector2<f64>,
    /// Contact point minus position of B.
    pub branch_b: Vector2<f64>,
    /// Unit normal of the line.
    pub normal: Vector2<f64>,
}

impl Section {
    /// Contact length (YADE: jointLength): how much of this line lies in both particles. The counterpart of
    /// the area in space.
    ///
    /// Exact: both cuts are intervals, and two rays find the ends of each. `None` when the section holds no
    /// finite point or normal.
    pub fn length(&self, a: &Particle, pose_a: &Pose, b: &Particle, pose_b: &Pose) -> Option<f64> {
        let normal = self.normal.try_normalize(0.0)?;
        let along = Vector2::new(-normal.y, normal.x);
        let to_boundary = |particle: &Particle, pose: &Pose, branch: &Vector2<f64>, direction: &Vector2<f64>| {
            particle.surface_distance(&pose.rotation().tr_mul(branch), &pose.rotation().tr_mul(direction))
        };
        let mut length = 0.0;
        for direction in [along, -along] {
            let to_a = to_boundary(a, pose_a, &self.branch_a, &direction)?;
            let to_b = to_boundary(b, pose_b, &self.branch_b, &direction)?;
            length += to_a.min(to_b);
        }
        // A point that rounding left outside gives intervals that may miss each other by as much.
        Some(length.max(0.0))
    }
}

/// A vector of the plane z = 0 in space.
fn raised(v: &Vector2<f64>) -> Vector3<f64> {
    Vector3::new(v.x, v.y, 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Memory;

    /// The doc of this module says that z stays 0: seen here in the contact of space.
    #[test]
    fn nothing_leaves_the_plane() {
        let square = |k: f64| {
            let lines = [[1.0, 0.0, 0.5], [0.0, 1.0, 0.5], [-1.0, 0.0, 0.5], [0.0, -1.0, 0.5]].map(Line::from);
            Particle::new(&lines, 0.05, k, 0.8).unwrap()
        };
        let triangle =
            Particle::new(&[[0.8, 0.6, 0.3], [-0.8, 0.6, 0.3], [0.0, -1.0, 0.3]].map(Line::from), 1e-6, 0.0, 0.0);
        let particles = [square(0.0), square(0.3), square(1.0), triangle.unwrap()];
        let mut overlapping = 0;
        for (a, b) in particles.iter().flat_map(|a| particles.iter().map(move |b| (a, b))) {
            for i in 0..40 {
                let angle = f64::from(i);
                let distance = 1.2 - f64::from(i % 8) / 8.0;
                let pose_a = Pose::new([1.0, -2.0], 0.7 * angle).unwrap().in_space();
                let pose_b =
                    Pose::new([1.0 + distance * angle.cos(), -2.0 + distance * angle.sin()], angle).unwrap().in_space();
                for (formulation, back_end) in [
                    (Formulation::Midway, BackEnd::Fast),
                    (Formulation::Closest, BackEnd::Fast),
                    (Formulation::Midway, BackEnd::Conic),
                    (Formulation::Closest, BackEnd::Conic),
                ] {
                    let settings = Settings { formulation, back_end, solve_separated: true, ..Settings::default() };
                    let mut memory = Memory::default();
                    let contact =
                        crate::contact::detect::detect(&a.0, &pose_a, &b.0, &pose_b, &settings, Some(&mut memory))
                            .unwrap();
                    let mut vectors = vec![contact.normal, contact.point, contact.branch_a, contact.branch_b];
                    if contact.kind == Kind::Overlapping {
                        overlapping += 1;
                        vectors.extend([contact.point_on_a, contact.point_on_b]);
                    }
                    assert!(vectors.iter().all(|v| v.z == 0.0), "{contact:?}");
                    // Number 3 of a filled memory is z.
                    assert_eq!(memory.into_raw()[3], 0.0);
                }
            }
        }
        assert!(overlapping > 500, "{overlapping}");
    }

    /// The line enters the bulge of a face where it touches it, and comes out as far on the other side of the middle.
    #[test]
    fn a_line_through_a_point_that_rounding_left_outside_has_its_length() {
        let lines = [[1.0, 0.0, 0.5], [0.0, 1.0, 0.5], [-1.0, 0.0, 0.5], [0.0, -1.0, 0.5]].map(Line::from);
        let square = Particle::new(&lines, 0.05, 0.3, 0.8).unwrap();
        let pose = Pose::new([3.0, -1.0], 0.4).unwrap();
        let (middle, up) = (Vector2::new(0.3, 0.0), Vector2::y());
        let height = square.surface_distance(&middle, &up).unwrap();
        for off in -20..=20 {
            let branch = pose.rotation() * (middle + height * (1.0 + f64::from(off) * f64::EPSILON) * up);
            let section = Section { branch_a: branch, branch_b: branch, normal: pose.rotation() * up };
            let length = section.length(&square, &pose, &square, &pose).unwrap();
            assert!((length - 0.6).abs() < 1e-12, "{off}: {length}");
        }
    }
}
