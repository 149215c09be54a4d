//! Particles of the plane, each a particle of space cut at z = 0.

use super::area_properties::{self, AreaProperties};
use super::polygon::{self, Polygon};
use super::pose::Pose;
use super::raised;
use crate::particle::error::ToleranceError;
use crate::particle::particle::{self, ParticleError};
use nalgebra::{Matrix2, Vector2};

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
///
/// ```
/// use potential_particles::planar::{Line, Particle};
/// let square = [[1.0, 0.0, 0.9], [-1.0, 0.0, 0.9], [0.0, 1.0, 0.9], [0.0, -1.0, 0.9]].map(Line::from);
/// let square = Particle::new(&square, 0.1, 0.0, 1.0)?;
/// assert!((square.potential(&[1.0, 0.0].into())).abs() < 1e-12);
/// assert_eq!(square.lines().len(), 4);
/// # Ok::<(), potential_particles::ParticleError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Particle(pub(super) particle::Particle);

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

    /// A convex polygon with rounded corners, about its centroid, by points of which the corners are the convex hull.
    ///
    /// Its sides lie where those of the polygon are (for k = 0; for k > 0 they bulge by about k·r/2 and less than the
    /// corners recede). The shadow circle goes through the outermost corner. r: rounding radius, length, less than the
    /// distance of each side from the centroid. k: sphericity, in [0, 1].
    ///
    /// ```
    /// use potential_particles::planar::Particle;
    /// let triangle = Particle::polygon(&[[0.0, 0.0], [3.0, 0.0], [0.0, 3.0]], 0.1, 0.0)?;
    /// let properties = triangle.area_properties(1e-9)?;
    /// assert!(properties.area < 4.5 && properties.centroid.norm() < 0.01);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Points that are not finite or enclose no area, r that is too large; and those of [`Particle::new`].
    pub fn polygon(points: &[[f64; 2]], r: f64, k: f64) -> Result<Self, ParticleError> {
        let polygon = Polygon::hull(points)?;
        Self::new(&polygon.lines(r)?, r, k, polygon.radius())
    }

    /// A regular polygon, as [`Particle::polygon`] makes it; radius: of the circle through its corners, the first of
    /// which lies on the x axis.
    ///
    /// # Errors
    /// Fewer than three sides, a radius that is not positive and finite, and those of [`Particle::polygon`].
    pub fn regular_polygon(sides: usize, radius: f64, r: f64, k: f64) -> Result<Self, ParticleError> {
        Self::polygon(&polygon::regular(sides, radius.max(0.0)), r, k)
    }

    /// A rectangle with sides along x and y, as [`Particle::polygon`] makes it; width along x, height along y, length.
    ///
    /// # Errors
    /// A width or height that is not positive and finite, and those of [`Particle::polygon`].
    pub fn rectangle(width: f64, height: f64, r: f64, k: f64) -> Result<Self, ParticleError> {
        // What is negative, or not a number, encloses no area.
        let (x, y) = (0.5 * width.max(0.0), 0.5 * height.max(0.0));
        Self::polygon(&[[-x, -y], [x, -y], [x, y], [-x, y]], r, k)
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

    /// Distance τ ≥ 0 along a local direction of any length from a local point inside to the boundary, length; `None`
    /// if the direction is zero or a number is not finite.
    pub fn surface_distance(&self, from: &Vector2<f64>, direction: &Vector2<f64>) -> Option<f64> {
        self.0.surface_distance(&raised(from), &raised(direction))
    }

    /// Area, centroid and second moments: in closed form, arc by arc of the boundary. The relative tolerance counts
    /// where rounding leaves more than that (lines far stiffer than the rest of the boundary): there a polygon of
    /// points on rays answers.
    ///
    /// # Errors
    /// A tolerance outside [1e-12, 1].
    pub fn area_properties(&self, tolerance: f64) -> Result<AreaProperties, ToleranceError> {
        ToleranceError::refuse_relative(tolerance)?;
        Ok(area_properties::of(&self.0, tolerance))
    }

    /// Points of the boundary in order, so dense that a chord between two neighbours is within `tolerance` (length) of
    /// the boundary: the boundary is at most that far outside. At most a million or so, whatever the tolerance.
    ///
    /// # Errors
    /// A tolerance that is not positive and finite.
    pub fn outline(&self, tolerance: f64) -> Result<Vec<Vector2<f64>>, ToleranceError> {
        ToleranceError::refuse_length(tolerance)?;
        Ok(area_properties::outline(&self.0, tolerance).0)
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

    /// ℓ, by which 1 − s is multiplied to give a depth below the boundary: as of [`crate::Particle::depth_length`].
    pub fn depth_length(&self) -> f64 {
        self.0.depth_length()
    }

    /// The particle of space.
    pub(crate) fn in_space(&self) -> &particle::Particle {
        &self.0
    }

    /// Radius about the local origin of a circle that holds the whole particle.
    pub fn bounding_radius(&self) -> f64 {
        self.0.bounding_radius()
    }

    /// Corners of a polygon, local frame, length, in no order. Corners nearer to each other than 1e-6 of the distance
    /// of the farthest one are merged: enlarged by as much, the polygon holds the whole particle.
    pub fn bounding_corners(&self) -> impl ExactSizeIterator<Item = Vector2<f64>> + '_ {
        self.0.bounding_corners().iter().map(|corner| corner.xy())
    }

    /// Axis-aligned box in world axes that holds the particle at a pose: (lower, upper).
    pub fn bounding_box(&self, pose: &Pose) -> (Vector2<f64>, Vector2<f64>) {
        let (lower, upper) = self.0.bounding_box(&pose.in_space());
        (lower.xy(), upper.xy())
    }
}
