//! A potential particle: its definition, validated once.
//!
//! Local frame, planes i = 1..N with outward normals n_i = (a_i, b_i, c_i) and offsets d_i:
//!
//! ```text
//! S(x) = (1-k)/r² · Σ ⟨n_i·x − d_i⟩²  +  k/R² · |x|²        ⟨t⟩ = max(t, 0)
//! f(x) = S(x) − 1                                            paper eqs (2), (32)
//! ```
//!
//! f = 0 is the surface, f < 0 the inside. Normals are used as given, never renormalised, so that
//! the particle is exactly the one that the caller wrote down.

use crate::particle::bounding_volumes::Bounds;
use crate::particle::plane_clusters::Leaves;
use crate::particle::potential;
use nalgebra::Vector3;
use thiserror::Error;

/// One plane a·x + b·y + c·z = d of a particle, local frame, (a, b, c) pointing outwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Outward normal (a, b, c); unit length is usual, not required.
    pub normal: Vector3<f64>,
    /// Offset d, length. A face of the finished particle lies near d + r.
    pub offset: f64,
}

impl From<[f64; 4]> for Plane {
    /// From (a, b, c, d).
    fn from([a, b, c, d]: [f64; 4]) -> Self {
        Self { normal: Vector3::new(a, b, c), offset: d }
    }
}

/// Most planes that a particle may have.
pub const MAX_PLANES: usize = 65_536;

/// Why planes, r, k, R do not make a particle. Each names the value and the remedy.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[allow(missing_docs)]
pub enum ParticleError {
    #[error("plane {index} is not finite: a={a:?}, b={b:?}, c={c:?}, d={d:?}")]
    PlaneNotFinite { index: usize, a: f64, b: f64, c: f64, d: f64 },
    #[error("plane {index} has a normal of length zero (d={d:?}): give it a direction or remove it")]
    ZeroNormal { index: usize, d: f64 },
    #[error(
        "plane {index} has a normal of length {length:?}, too short or too long for its square, by r² or not, to be a \
         number: scale it to about unit length, and d with it"
    )]
    NormalLength { index: usize, length: f64 },
    #[error("sphericity k={0:?} is outside [0, 1]")]
    Sphericity(f64),
    #[error("rounding radius r={0:?} must be positive and finite (it may be anything only when k=1)")]
    RoundingRadius(f64),
    #[error("shadow radius R={0:?} must be positive and finite (it may be anything only when k=0)")]
    ShadowRadius(f64),
    #[error(
        "the centre is not inside: f(0)={f:?} must be negative; plane {worst} (d={d:?}) lies furthest behind \
         the origin: shift the planes so that the origin is inside"
    )]
    CentreOutside { f: f64, worst: usize, d: f64 },
    #[error(
        "the planes do not enclose a volume (of a size between 1e-150 and 1e150), and with k=0 nothing else does: \
         add planes or take k>0"
    )]
    Unbounded,
    #[error("{0} planes are more than the {MAX_PLANES} that a particle may have")]
    TooManyPlanes(usize),
    #[error("line {index} is not finite: a={a:?}, b={b:?}, d={d:?}")]
    LineNotFinite { index: usize, a: f64, b: f64, d: f64 },
    #[error("line {index} has a normal of length zero (d={d:?}): give it a direction or remove it")]
    ZeroLineNormal { index: usize, d: f64 },
    #[error(
        "line {index} has a normal of length {length:?}, too short or too long for its square, by r² or not, to be a \
         number: scale it to about unit length, and d with it"
    )]
    LineNormalLength { index: usize, length: f64 },
    #[error(
        "the centre is not inside: f(0)={f:?} must be negative; line {worst} (d={d:?}) lies furthest behind \
         the origin: shift the lines so that the origin is inside"
    )]
    CentreOutsideLines { f: f64, worst: usize, d: f64 },
    #[error(
        "the lines do not enclose an area (of a size between 1e-150 and 1e150), and with k=0 nothing else does: \
         add lines or take k>0"
    )]
    OpenLines,
    #[error("{0} lines are more than the {MAX_PLANES} that a particle may have")]
    TooManyLines(usize),
}

impl ParticleError {
    /// The same of a particle of the plane, whose planes (a, b, 0, d) the caller knows as lines.
    pub(crate) fn of_lines(self) -> Self {
        match self {
            Self::PlaneNotFinite { index, a, b, d, .. } => Self::LineNotFinite { index, a, b, d },
            Self::ZeroNormal { index, d } => Self::ZeroLineNormal { index, d },
            Self::NormalLength { index, length } => Self::LineNormalLength { index, length },
            Self::CentreOutside { f, worst, d } => Self::CentreOutsideLines { f, worst, d },
            Self::Unbounded => Self::OpenLines,
            Self::TooManyPlanes(count) => Self::TooManyLines(count),
            other => other,
        }
    }
}

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
/// let mass = tetrahedron.mass_properties();
/// assert!(mass.volume > sharp(0.9) && mass.volume < sharp(1.0) && mass.centroid.norm() < 1e-3);
/// // Planes are refused with the reason.
/// let error = Particle::new(&planes[..3], 0.1, 0.0, 1.0).unwrap_err();
/// assert!(error.to_string().contains("do not enclose a volume"), "{error}");
///
/// let ball = Particle::sphere(2.0)?;
/// assert!(ball.potential(&[0.0, 2.0, 0.0].into()).abs() < 1e-12 && ball.bounding_radius() >= 2.0);
/// # Ok::<(), potential_particles::ParticleError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Particle {
    /// (a, b, c, d) of each plane, in the order of `leaves`: the evaluation streams through them.
    rows: Box<[[f64; 4]]>,
    /// Coordinates that count: 3, or 2 where only the cut at z = 0 is meant ([`crate::planar`]).
    pub(crate) dimensions: usize,
    rounding_radius: f64,
    sphericity: f64,
    shadow_radius: f64,
    /// (1-k)/r², the weight of the planes in S; 0 for k = 1.
    pub(crate) plane_weight: f64,
    /// k/R², the weight of the shadow sphere in S; 0 for k = 0.
    pub(crate) sphere_weight: f64,
    pub(crate) bounds: Bounds,
    pub(crate) leaves: Leaves,
    /// For each plane as kept, its place among those given.
    order: Box<[usize]>,
}

impl Particle {
    /// Builds a particle from its planes, rounding radius r, sphericity k and shadow radius R.
    ///
    /// # Errors
    /// Non-finite numbers, k outside [0, 1], r ≤ 0 (unless k = 1), R ≤ 0 (unless k = 0), a zero
    /// normal or one whose square is no number, an origin that is not inside (f(0) ≥ 0), and for k = 0 an unbounded shape.
    pub fn new(planes: &[Plane], r: f64, k: f64, shadow_radius: f64) -> Result<Self, ParticleError> {
        Self::build(planes, r, k, shadow_radius, 3)
    }

    /// The same for planes (a, b, 0, d) of which only the cut at z = 0 has to be bounded.
    ///
    /// # Errors
    /// Those of [`Particle::new`], speaking of lines.
    pub(crate) fn in_plane(planes: &[Plane], r: f64, k: f64, shadow_radius: f64) -> Result<Self, ParticleError> {
        Self::build(planes, r, k, shadow_radius, 2).map_err(ParticleError::of_lines)
    }

    fn build(planes: &[Plane], r: f64, k: f64, shadow_radius: f64, dimensions: usize) -> Result<Self, ParticleError> {
        if planes.len() > MAX_PLANES {
            return Err(ParticleError::TooManyPlanes(planes.len()));
        }
        if !(0.0..=1.0).contains(&k) {
            return Err(ParticleError::Sphericity(k));
        }
        let plane_weight = if k == 1.0 { 0.0 } else { (1.0 - k) / (r * r) };
        // The weight itself must be a normal number: r = 1e-200 would make it infinite.
        if k < 1.0 && !(r > 0.0 && r.is_finite() && plane_weight.is_normal()) {
            return Err(ParticleError::RoundingRadius(r));
        }
        let sphere_weight = if k == 0.0 { 0.0 } else { k / (shadow_radius * shadow_radius) };
        if k > 0.0 && !(shadow_radius > 0.0 && shadow_radius.is_finite() && sphere_weight.is_normal()) {
            return Err(ParticleError::ShadowRadius(shadow_radius));
        }
        for (index, Plane { normal, offset: d }) in planes.iter().enumerate() {
            let (a, b, c, d) = (normal.x, normal.y, normal.z, *d);
            if ![a, b, c, d].iter().all(|v| v.is_finite()) {
                return Err(ParticleError::PlaneNotFinite { index, a, b, c, d });
            }
            if a == 0.0 && b == 0.0 && c == 0.0 {
                return Err(ParticleError::ZeroNormal { index, d });
            }
            // A normal n and r are as good as n/|n| and r/|n|, whose square has to be a number like that of r.
            let square = normal.norm_squared();
            if !(square.is_normal() && (plane_weight == 0.0 || (plane_weight * square).is_normal())) {
                return Err(ParticleError::NormalLength { index, length: normal.amax() });
            }
        }
        let (leaves, order) = if plane_weight > 0.0 { Leaves::of(planes) } else { Leaves::none(planes.len()) };
        let mut particle = Self {
            rows: order.iter().map(|&i| row(&planes[i])).collect(),
            dimensions,
            rounding_radius: r,
            sphericity: k,
            shadow_radius,
            plane_weight,
            sphere_weight,
            bounds: Bounds::default(),
            leaves,
            order,
        };
        let f = particle.potential(&Vector3::zeros());
        if !(f < 0.0) {
            let behind = |&i: &usize, &j: &usize| planes[i].offset.total_cmp(&planes[j].offset);
            let worst = (0..planes.len()).min_by(behind).unwrap_or(0);
            return Err(ParticleError::CentreOutside { f, worst, d: planes.get(worst).map_or(f64::NAN, |p| p.offset) });
        }
        particle.bounds = Bounds::of(&particle).ok_or(ParticleError::Unbounded)?;
        Ok(particle)
    }

    /// A sphere of the given radius (k = 1, no planes).
    ///
    /// # Errors
    /// A radius that is not positive and finite.
    pub fn sphere(radius: f64) -> Result<Self, ParticleError> {
        Self::new(&[], 0.0, 1.0, radius)
    }

    /// f(x) = S(x) − 1 at a local point (paper eq. 2): negative inside, zero on the surface.
    pub fn potential(&self, x: &Vector3<f64>) -> f64 {
        potential::value(self, x) - 1.0
    }

    /// ∇f(x), local frame, 1/length.
    pub fn gradient(&self, x: &Vector3<f64>) -> Vector3<f64> {
        potential::local(self, x).gradient
    }

    /// ∇²f(x), local frame, 1/length². Where a plane is just switching on, the side without it.
    pub fn hessian(&self, x: &Vector3<f64>) -> nalgebra::Matrix3<f64> {
        potential::local(self, x).hessian.matrix()
    }

    /// Planes as given.
    pub fn planes(&self) -> impl ExactSizeIterator<Item = Plane> {
        let mut planes = vec![Plane { normal: Vector3::zeros(), offset: 0.0 }; self.rows.len()];
        for (place, &given) in self.order.iter().enumerate() {
            planes[given] = Plane { normal: self.normal(place), offset: self.offset(place) };
        }
        planes.into_iter()
    }

    /// Number of planes.
    pub fn plane_count(&self) -> usize {
        self.rows.len()
    }

    /// Rounding radius r, length.
    pub fn rounding_radius(&self) -> f64 {
        self.rounding_radius
    }

    /// Sphericity k, no unit.
    pub fn sphericity(&self) -> f64 {
        self.sphericity
    }

    /// Radius R of the shadow sphere, length.
    pub fn shadow_radius(&self) -> f64 {
        self.shadow_radius
    }

    /// Radius about the local origin of a ball that holds the whole particle.
    pub fn bounding_radius(&self) -> f64 {
        self.bounds.radius
    }

    /// Corners of a polyhedron that holds the whole particle, local frame.
    pub fn bounding_corners(&self) -> &[Vector3<f64>] {
        &self.bounds.corners
    }

    /// Calls `visit` with place, normal n and excess n·y − d of each plane that may have an excess above −`early`. Gives a
    /// number that no excess of the others exceeds.
    #[inline(always)]
    pub(crate) fn visit_near(
        &self,
        y: &Vector3<f64>,
        early: f64,
        mut visit: impl FnMut(usize, Vector3<f64>, f64),
    ) -> f64 {
        self.leaves.visit_near(y, early, |run| {
            let first = run.start;
            // A single group holds them all.
            let rows = if self.leaves.single() { &self.rows[..] } else { &self.rows[run] };
            for (j, [a, b, c, d]) in rows.iter().enumerate() {
                visit(first + j, Vector3::new(*a, *b, *c), a * y.x + b * y.y + c * y.z - d);
            }
        })
    }

    /// A cube for tests.
    #[cfg(test)]
    pub(crate) fn cube(offset: f64, r: f64, k: f64, shadow_radius: f64) -> Self {
        let sides = (0..3).flat_map(|axis| [1.0, -1.0].map(|sign| Vector3::ith(axis, sign)));
        let planes: Vec<Plane> = sides.map(|normal| Plane { normal, offset }).collect();
        Self::new(&planes, r, k, shadow_radius).unwrap()
    }

    /// The normals of all planes, by place.
    pub(crate) fn normals(&self) -> impl Iterator<Item = Vector3<f64>> {
        self.rows.iter().map(|[a, b, c, _]| Vector3::new(*a, *b, *c))
    }

    /// The largest n·y − d, and the place of its plane; −∞ when there are no planes.
    #[inline]
    pub(crate) fn farthest_excess(&self, y: &Vector3<f64>) -> (f64, usize) {
        let largest_of = |run: std::ops::Range<usize>| {
            let mut largest = (f64::NEG_INFINITY, 0);
            for (i, [a, b, c, d]) in run.clone().zip(&self.rows[run]) {
                let excess = a * y.x + b * y.y + c * y.z - d;
                if excess > largest.0 {
                    largest = (excess, i);
                }
            }
            largest
        };
        self.leaves.largest(y, largest_of)
    }

    pub(crate) fn normal(&self, i: usize) -> Vector3<f64> {
        let [a, b, c, _] = self.rows[i];
        Vector3::new(a, b, c)
    }

    pub(crate) fn offset(&self, i: usize) -> f64 {
        self.rows[i][3]
    }

    /// S counts the planes only for k < 1, the sphere only for k > 0: one place says so.
    pub(crate) fn is_sphere(&self) -> bool {
        self.plane_weight == 0.0 || self.rows.is_empty()
    }
}

fn row(plane: &Plane) -> [f64; 4] {
    [plane.normal.x, plane.normal.y, plane.normal.z, plane.offset]
}
