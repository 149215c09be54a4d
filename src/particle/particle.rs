//! A potential particle: the public interface to a [`Solid`].

use crate::linalg::number;
pub use crate::particle::error::ParticleError;
pub use crate::particle::plane::{MAX_PLANES, Plane};
use crate::particle::polygon::Polygon;
use crate::particle::solid::Solid;
use crate::particle::{potential, ray_cast};
use crate::pose::Pose;
use nalgebra::{Matrix3, Vector3};
use std::collections::hash_map::RandomState;
use std::hash::{BuildHasher, Hasher};
use std::ops::Deref;
use std::sync::LazyLock;
use std::sync::atomic::{AtomicU64, Ordering};

/// A validated potential particle, immutable; share it freely between threads and bodies.
///
/// ```
/// use potential_particles::{Particle, Plane};
/// // A tetrahedron of four planes at a distance of 0.9, its edges and corners rounded by r = 0.1.
/// let normals = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
/// let length = f64::sqrt(3.0);
/// let planes = normals.map(|[a, b, c]| Plane::from([a / length, b / length, c / length, 0.9]));
/// let tetrahedron = Particle::new(&planes, 0.1, 0.0, 1.0)?;
/// assert!(tetrahedron.potential(&[0.0, 0.0, 0.0].into()) < 0.0);
/// // Volume and inertia of unit density: between those of the tetrahedra of planes at 0.9 and at 1.
/// let sharp = |height: f64| 8.0 * f64::sqrt(3.0) * height.powi(3);
/// let mass = tetrahedron.mass_properties(1e-6)?;
/// assert!(mass.volume > sharp(0.9) && mass.volume < sharp(1.0) && mass.centroid.norm() < 1e-6);
/// // Planes are refused with the reason.
/// let error = Particle::new(&planes[..3], 0.1, 0.0, 1.0).unwrap_err();
/// assert!(error.to_string().contains("do not enclose a volume"), "{error}");
///
/// let ball = Particle::sphere(2.0)?;
/// assert!(ball.potential(&[0.0, 2.0, 0.0].into()).abs() < 1e-12 && ball.bounding_radius() >= 2.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Particle {
    shape: Solid,
    serial: u64,
}

impl Particle {
    /// Builds a particle from its planes, rounding radius r, sphericity k and shadow radius R. Planes that are one
    /// within its bounding ball, to 1e-6 of the ball's radius, count once: as the first of them.
    ///
    /// # Errors
    /// Non-finite numbers, k outside [0, 1], r ≤ 0 (unless k = 1), R ≤ 0 (unless k = 0), a normal that is zero or whose
    /// square leaves the range of f64, an origin that is not inside (f(0) ≥ 0), for k = 0 an unbounded shape, one that
    /// reaches more than 1e150·r/√(1−k) from its centre, and one that reaches less than 1e-30 or more than 1e30.
    pub fn new(planes: &[Plane], r: f64, k: f64, shadow_radius: f64) -> Result<Self, ParticleError> {
        Ok(Self::of(Solid::new(planes, r, k, shadow_radius, 3)?))
    }

    /// A particle in the plane z = 0, from its lines a·x + b·y = d (rows a, b, d, with outward normals), rounding
    /// radius r, sphericity k and radius R of the shadow circle (paper eq. 1).
    ///
    /// It is the particle of planes (a, b, 0, d), of which only the cut at z = 0 counts. Contacts of two such particles
    /// lie in the plane, too; areas, masses and forces of patches are per unit of depth.
    ///
    /// ```
    /// use potential_particles::{Particle, Pose, Section, Settings, detect};
    /// let square = [[1.0, 0.0, 0.9], [-1.0, 0.0, 0.9], [0.0, 1.0, 0.9], [0.0, -1.0, 0.9]];
    /// let square = Particle::in_plane(&square, 0.1, 0.0, 1.0)?;
    /// let (lower, upper) = (Pose::in_plane([0.0, 0.0], 0.0)?, Pose::in_plane([0.5, 1.95], 0.0)?);
    /// let contact = detect(&square, &lower, &square, &upper, &Settings::default(), None)?;
    /// assert!((contact.overlap - 0.05).abs() < 1e-9 && contact.point.z == 0.0);
    /// let length = Section::from(&contact).area(&square, &lower, &square, &upper, 1e-6);
    /// assert!(length.is_some_and(|length| length > 1.3 && length < 1.5));
    /// // Turned about x it leaves the plane.
    /// let leaning = Pose::new([0.5, 1.95, 0.0], [1.0, 0.1, 0.0, 0.0])?;
    /// let error = detect(&square, &lower, &square, &leaning, &Settings::default(), None).unwrap_err();
    /// assert!(error.to_string().contains("it turns about z alone"), "{error}");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`Particle::new`], in terms of lines; for k = 0 they must enclose an area.
    pub fn in_plane(lines: &[[f64; 3]], r: f64, k: f64, shadow_radius: f64) -> Result<Self, ParticleError> {
        let planes: Vec<Plane> = lines.iter().map(|&[a, b, d]| Plane::from([a, b, 0.0, d])).collect();
        Self::cut(&planes, r, k, shadow_radius)
    }

    /// A convex polygon with rounded corners in the plane z = 0, about its centroid, by points of which the corners are
    /// the convex hull; otherwise as [`Particle::in_plane`].
    ///
    /// Its sides lie where those of the polygon are (for k = 0; for k > 0 they bulge by about k·r/2 and less than the
    /// corners recede). The shadow circle goes through the outermost corner. r: rounding radius, length, less than the
    /// distance of each side from the centroid. k: sphericity, in [0, 1].
    ///
    /// ```
    /// use potential_particles::Particle;
    /// let triangle = Particle::polygon(&[[0.0, 0.0], [3.0, 0.0], [0.0, 3.0]], 0.1, 0.0)?;
    /// let mass = triangle.mass_properties(1e-9)?;
    /// assert!(mass.volume < 4.5 && mass.centroid.norm() < 0.01);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Points that are not finite or enclose no area, r that is too large; and those of [`Particle::in_plane`].
    pub fn polygon(points: &[[f64; 2]], r: f64, k: f64) -> Result<Self, ParticleError> {
        let polygon = Polygon::hull(points)?;
        Self::cut(&polygon.lines(r)?, r, k, polygon.radius())
    }

    /// Of planes (a, b, 0, d) the cut at z = 0.
    fn cut(planes: &[Plane], r: f64, k: f64, shadow_radius: f64) -> Result<Self, ParticleError> {
        Ok(Self::of(Solid::new(planes, r, k, shadow_radius, 2).map_err(ParticleError::of_lines)?))
    }

    /// Whether it lies in the plane z = 0 ([`Particle::in_plane`]).
    #[inline(always)]
    pub fn is_in_plane(&self) -> bool {
        self.shape.dimensions == 2
    }

    /// The second particle where the first one touches a plane, a line or a point of a boundary, of 2, 1 or 0
    /// dimensions: S = 0 on all of it.
    pub(crate) fn boundary(dimensions: usize) -> &'static Self {
        static BOUNDARIES: LazyLock<[Particle; 3]> =
            LazyLock::new(|| [0, 1, 2].map(|d| Particle::of(Solid::boundary(d))));
        &BOUNDARIES[dimensions]
    }

    /// Whether it is one of those.
    #[inline]
    pub(crate) fn is_boundary(&self) -> bool {
        self.shape.len() == 0 && self.shape.sphere_weight == 0.0
    }

    fn of(shape: Solid) -> Self {
        // From a random number on: a pair state saved against its documentation then matches no particle of another
        // process.
        static LAST: LazyLock<AtomicU64> =
            LazyLock::new(|| AtomicU64::new(RandomState::new().build_hasher().finish() >> 13));
        Self { shape, serial: 1 + LAST.fetch_add(1, Ordering::Relaxed) }
    }

    /// A number above 0 that no other particle of this process has, but those that were cloned from this one.
    #[inline(always)]
    pub(crate) fn serial(&self) -> u64 {
        self.serial
    }

    /// A sphere of the given radius (k = 1, no planes).
    ///
    /// # Errors
    /// A radius that is not positive and finite.
    pub fn sphere(radius: f64) -> Result<Self, ParticleError> {
        Self::new(&[], 0.0, 1.0, radius)
    }

    /// The same shape `factor` times as large: d, r and R multiplied by it.
    ///
    /// # Errors
    /// Those of [`Particle::new`], for a factor that is not positive and finite, or out of range with these planes.
    pub fn scaled(&self, factor: f64) -> Result<Self, ParticleError> {
        let scaled = |plane: Plane| Plane { offset: factor * plane.offset, ..plane };
        let planes: Vec<Plane> = self.planes().map(scaled).collect();
        let (r, k, shadow_radius) = (factor * self.rounding_radius(), self.sphericity(), factor * self.shadow_radius());
        if self.is_in_plane() {
            Self::cut(&planes, r, k, shadow_radius)
        } else {
            Self::new(&planes, r, k, shadow_radius)
        }
    }

    /// f(x) = S(x) − 1 at a local point (paper eq. 2): negative inside, zero on the surface.
    pub fn potential(&self, x: &Vector3<f64>) -> f64 {
        potential::value(self, x) - 1.0
    }

    /// ∇f(x), local frame, 1/length.
    pub fn gradient(&self, x: &Vector3<f64>) -> Vector3<f64> {
        potential::local(self, x).gradient
    }

    /// ∇²f(x), local frame, 1/length². On a plane, where it jumps, the limit from the inner side.
    pub fn hessian(&self, x: &Vector3<f64>) -> Matrix3<f64> {
        potential::local(self, x).hessian.matrix()
    }

    /// Planes as given, without those that are one with an earlier one.
    pub fn planes(&self) -> impl ExactSizeIterator<Item = Plane> {
        self.shape.given_planes().into_iter()
    }

    /// Number of planes.
    pub fn plane_count(&self) -> usize {
        self.shape.len()
    }

    /// Rounding radius r, length.
    pub fn rounding_radius(&self) -> f64 {
        self.shape.rounding_radius
    }

    /// Sphericity k, no unit.
    pub fn sphericity(&self) -> f64 {
        self.shape.sphericity
    }

    /// Radius R of the shadow sphere, length.
    pub fn shadow_radius(&self) -> f64 {
        self.shape.shadow_radius
    }

    /// ℓ, by which 1 − s is multiplied to give a depth below the surface: exact, to first order, at the middle of the
    /// face that is nearest to the centre, and a constant of the particle elsewhere. Length.
    ///
    /// 1/ℓ is the slope of s at that face, at the distance h from the centre where S = 1 with this plane alone:
    /// √((1−k)(1 − k h²/R²))·|n|/r + k h/R². That is r/|n| for k = 0 and R for k = 1.
    pub fn depth_length(&self) -> f64 {
        self.shape.depth_length
    }

    /// Whether the planes alone enclose a volume, in the plane the lines an area. Where they do not (no planes, or one
    /// left out), only the shadow sphere bounds the particle, at R/√k: for k > 0 that is valid, and seldom meant.
    pub fn planes_enclose(&self) -> bool {
        self.shape.planes_enclose()
    }

    /// Radius about the local origin of a ball that holds the whole particle.
    pub fn bounding_radius(&self) -> f64 {
        self.shape.bounds.radius
    }

    /// Corners of a polyhedron, local frame, length. Corners nearer to each other than 1e-6 of the distance of the
    /// farthest one are merged: enlarged by as much, the polyhedron holds the whole particle. [`Self::support`] counts
    /// that.
    pub fn bounding_corners(&self) -> &[Vector3<f64>] {
        &self.shape.bounds.corners
    }

    /// Axis-aligned box in world axes that holds the particle at a pose, from its corners: (lower, upper).
    pub fn bounding_box(&self, pose: &Pose) -> (Vector3<f64>, Vector3<f64>) {
        self.shape.bounds.aligned_box(pose.rotation(), pose.position())
    }

    /// Upper bound of max e·x over the particle, length, e the unit vector of a local direction of any length. `None`
    /// for one that is zero or not finite.
    pub fn support(&self, direction: &Vector3<f64>) -> Option<f64> {
        Some(self.shape.bounds.support(&number::direction(direction)?))
    }

    /// Distance τ ≥ 0 along a local direction of any length from a local point inside to the surface, length: the τ
    /// with S(from + τ·e) = 1, e the unit vector of the direction.
    ///
    /// From a point that rounding has put outside, the answer is a small negative number if the ray points away from
    /// the particle, and the distance to where it leaves it again if the ray enters. `None` when the ray misses the
    /// particle, the direction is zero or something is not finite.
    pub fn surface_distance(&self, from: &Vector3<f64>, direction: &Vector3<f64>) -> Option<f64> {
        ray_cast::distance(self, from, &number::direction(direction)?)
    }

    /// A cube for tests.
    #[cfg(test)]
    pub(crate) fn cube(offset: f64, r: f64, k: f64, shadow_radius: f64) -> Self {
        let sides = (0..3).flat_map(|axis| [1.0, -1.0].map(|sign| Vector3::ith(axis, sign)));
        let planes: Vec<Plane> = sides.map(|normal| Plane { normal, offset }).collect();
        Self::new(&planes, r, k, shadow_radius).unwrap()
    }
}

/// For the stages of the solver, which evaluate the shape. Nothing of [`Solid`] is public.
#[doc(hidden)]
impl Deref for Particle {
    type Target = Solid;

    #[inline(always)]
    fn deref(&self) -> &Solid {
        &self.shape
    }
}
