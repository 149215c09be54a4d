//! From a sharp body to a particle: where its faces, its centre and its axes are.
//!
//! Let h_i be the distance of face i from the centre of the particle. The planes of the particle lie at
//!
//! ```text
//! d_i = h_i − r √((1 − k h_i²/R²)/(1 − k))
//! ```
//!
//! so that S = 1 at the foot of the perpendicular from the centre on the face, as long as no other plane counts there:
//! the particle touches the face at this foot, and lies inside the body everywhere. Away from the foot a face is deeper
//! by at most r (1/√(1−k) − 1), about r k/2; for k = 0 it is flat. Edges and corners are rounded. The shadow sphere is
//! about the centre, which is to be the centroid: with k > 0 the shape depends on it a little, and it is found by
//! repetition.

use super::error::{ShapeError, positive, within};
use super::numbers::{CENTRED, FEW_PLANES, FEWER_DIGITS, Limits};
use super::principal_frame::principal_orientation;
use super::sharp_body::SharpBody;
use super::touching::Touching;
use crate::linalg::root::MOST_STEPS;
use crate::particle::mass_properties::{self, MASS_TOLERANCE, MassProperties};
use crate::particle::particle::Particle;
use crate::particle::plane::Plane;
use crate::pose::Pose;
use nalgebra::{Matrix3, Vector3};

/// The tolerance to which the mass properties of a shape are found, relative.
pub(super) fn usual_tolerance(planes: usize) -> f64 {
    if planes > FEW_PLANES { FEWER_DIGITS } else { MASS_TOLERANCE }
}

/// How edges and corners are rounded. The size of a body is the diameter of the largest ball that fits into it while it
/// is sharp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rounding {
    r: Extent,
    k: f64,
    shadow_radius: Option<Extent>,
}

/// A length, a share of the size, or what the builder takes.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Extent {
    Length(f64),
    OfSize(f64),
    Chosen,
}

impl Extent {
    fn length(self, size: f64) -> f64 {
        match self {
            Self::Length(length) => length,
            Self::OfSize(share) => share * size,
            Self::Chosen => Rounding::SHARE * size,
        }
    }
}

impl Default for Rounding {
    /// What docs/shapes.md advises: a twentieth of the size, k = 0.02.
    fn default() -> Self {
        Self::new(Self::SHARE, 0.02)
    }
}

impl Rounding {
    /// The rounding radius of the default, as a share of the size.
    pub const SHARE: f64 = 0.05;

    /// By the rounding radius r as a share of the size, in (0, 0.5), and the sphericity k, in [0, 1): 0 leaves faces
    /// flat, towards 1 the shape becomes a sphere of radius R. R, the radius of the shadow sphere, is the distance from
    /// the centre to the farthest corner.
    pub fn new(share: f64, k: f64) -> Self {
        Self { r: Extent::OfSize(share), k, shadow_radius: None }
    }

    /// By k alone: r is what the builder takes, a twentieth of the size, or what keeps the size of its shape ([`cone`],
    /// [`fitted`]).
    ///
    /// [`cone`]: super::cone
    /// [`fitted`]: super::fitted
    pub fn chosen(k: f64) -> Self {
        Self { r: Extent::Chosen, ..Self::new(0.0, k) }
    }

    /// Whether the builder takes r.
    pub(super) fn is_chosen(&self) -> bool {
        self.r == Extent::Chosen
    }

    /// The same with r, length.
    pub(super) fn with_radius(self, r: f64) -> Self {
        Self { r: Extent::Length(r), ..self }
    }

    /// The same by r, length, in (0, half the size).
    pub fn of_radius(r: f64, k: f64) -> Self {
        Self { r: Extent::Length(r), ..Self::new(0.0, k) }
    }

    /// The same with R, length.
    pub fn with_shadow_radius(self, shadow_radius: f64) -> Self {
        Self { shadow_radius: Some(Extent::Length(shadow_radius)), ..self }
    }

    /// The same with R as a share of the size.
    pub fn with_shadow_share(self, share: f64) -> Self {
        Self { shadow_radius: Some(Extent::OfSize(share)), ..self }
    }

    /// r, k and R, lengths.
    pub(super) fn lengths(&self, size: f64) -> Result<(f64, f64, Option<f64>), ShapeError> {
        match self.r {
            Extent::OfSize(share) => {
                let range = "a share of the size between 0 and 0.5 (a sphere has k = 1 and no planes)";
                within(share, share > 0.0 && share < 0.5, "rounding", range)?;
            }
            Extent::Length(r) if positive(r, "r")? >= 0.5 * size => {
                return Err(ShapeError::RadiusTooLarge { r, limit: 0.5 * size });
            }
            Extent::Length(_) | Extent::Chosen => {}
        }
        let range = if self.k == 1.0 {
            "below 1: there no face is left, and sphere(R) has that shape"
        } else {
            "from 0 to below 1"
        };
        let k = within(self.k, (0.0..1.0).contains(&self.k), "k", range)?;
        if let Some(Extent::Length(given) | Extent::OfSize(given)) = self.shadow_radius {
            positive(given, "R")?;
        }
        Ok((self.r.length(size), k, self.shadow_radius.map(|shadow_radius| shadow_radius.length(size))))
    }
}

/// A particle about its centroid along its principal axes, with its mass properties.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Shape {
    /// The particle.
    pub particle: Particle,
    /// Volume, centroid and inertia in the particle's frame, to 1e-6; with more than 30 planes to 1e-4, and in fact to
    /// some thousandths of that.
    pub mass: MassProperties,
    /// The volume of what it was made of: the sharp body, or the round one that was asked for. Rounding takes away the
    /// rest.
    pub sharp_volume: f64,
    /// The origin of the particle's frame in that of the builder, length.
    pub centroid: Vector3<f64>,
    /// The quaternion (w, x, y, z), w ≥ 0, from the particle's frame to the builder's: x_builder = centroid +
    /// orientation x.
    pub orientation: [f64; 4],
}

impl Shape {
    /// The pose at which the particle stands where its builder's frame is the world's.
    pub fn pose(&self) -> Pose {
        // Both are finite, and the quaternion of unit length.
        Pose::new(self.centroid.into(), self.orientation).expect("a finite centroid and a unit quaternion")
    }

    /// A sharp body, rounded. `tolerance`: of volume, centroid and inertia, relative; by default [`usual_tolerance`].
    #[doc(hidden)]
    pub fn of_body(body: &SharpBody, rounding: &Rounding, tolerance: Option<f64>) -> Result<Self, ShapeError> {
        let size = body.size()?;
        let (r, k, shadow_radius) = rounding.lengths(size)?;
        if body.planes.len() > Limits::ROUNDED_PLANES {
            return Err(ShapeError::TooManyFaces(body.planes.len()));
        }
        let tolerance = tolerance.unwrap_or_else(|| usual_tolerance(body.planes.len()));
        let mut touching = Touching::default();
        let definition = |centre: &Vector3<f64>| {
            let shadow_radius = shadow_radius.unwrap_or_else(|| body.farthest(centre));
            let faces = body.heights(centre);
            let planes = lowered(&faces, r, k, shadow_radius);
            let make = |planes: &[Plane]| Particle::new(planes, r, k, shadow_radius).ok();
            Definition { planes: touching.moved(&faces, planes, make), r, k, shadow_radius }
        };
        let shape = Self::settled(definition, body.centroid, size, tolerance)?;
        Ok(Self { centroid: shape.centroid + body.origin, sharp_volume: body.volume, ..shape })
    }

    /// The same shape `factor` times as large, its centroid where it is.
    pub(super) fn resized(self, factor: f64) -> Result<Self, ShapeError> {
        let MassProperties { volume, centroid, inertia, error } = self.mass;
        let mass = MassProperties {
            volume: factor.powi(3) * volume,
            centroid: factor * centroid,
            inertia: factor.powi(5) * inertia,
            error,
        };
        Ok(Self { particle: self.particle.scaled(factor)?, mass, ..self })
    }

    /// With its centroid as its centre, in principal axes.
    pub(super) fn settled(
        mut definition: impl FnMut(&Vector3<f64>) -> Definition,
        mut centre: Vector3<f64>,
        size: f64,
        tolerance: f64,
    ) -> Result<Self, ShapeError> {
        let (roughly, near) = (FEWER_DIGITS.max(10.0 * tolerance), CENTRED.max(0.1 * tolerance) * size);
        let mut found = None;
        let mut last = f64::INFINITY;
        for _ in 0..MOST_STEPS {
            let made = definition(&centre);
            let particle = made.particle()?;
            let mass = mass_properties::of(&particle, roughly);
            let shift = mass.centroid;
            let is_known_no_better =
                shift.amax() > 0.5 * last && known(&mass).zip_map(&shift, |k, s| s.abs() - k).max() <= 0.0;
            if !(shift.amax() > near) || is_known_no_better {
                found = Some(particle);
                break;
            }
            last = shift.amax();
            centre += shift;
            if !centre.iter().all(|c| c.is_finite()) {
                return Err(made.no_centre());
            }
        }
        let particle = found.ok_or_else(|| definition(&centre).no_centre())?;
        let mut mass = mass_properties::of(&particle, tolerance);
        // The centroid is known no better than this.
        let is_centred = !(mass.centroid.amax() > MASS_TOLERANCE.max(0.1 * tolerance) * size);
        if !is_centred {
            centre += mass.centroid;
        }
        let (axes, orientation) = principal_orientation(&mass.inertia);
        let particle = definition(&centre).turned(&axes).particle()?;
        if is_centred {
            (mass.centroid, mass.inertia) = (axes.tr_mul(&mass.centroid), axes.transpose() * mass.inertia * axes);
        } else {
            mass = mass_properties::of(&particle, tolerance);
        }
        Ok(Self { particle, mass, sharp_volume: mass.volume, centroid: centre, orientation })
    }
}

/// How far the centroid may be off along each axis: its error is a share of the radius of gyration √(∫x²dV/V); 0 where
/// nothing is known.
fn known(mass: &MassProperties) -> Vector3<f64> {
    let error = if mass.error.is_finite() { mass.error } else { 0.0 };
    let all = 0.5 * mass.inertia.trace();
    mass.inertia.diagonal().map(|about| error * ((all - about).max(0.0) / mass.volume).sqrt())
}

/// What a particle is made of.
pub(super) struct Definition {
    pub planes: Vec<Plane>,
    pub r: f64,
    pub k: f64,
    pub shadow_radius: f64,
}

impl Definition {
    pub fn particle(&self) -> Result<Particle, ShapeError> {
        Ok(Particle::new(&self.planes, self.r, self.k, self.shadow_radius)?)
    }

    fn no_centre(&self) -> ShapeError {
        ShapeError::NoCentre { k: self.k, shadow_radius: self.shadow_radius }
    }

    /// In axes that are these columns.
    fn turned(mut self, axes: &Matrix3<f64>) -> Self {
        self.planes.iter_mut().for_each(|plane| plane.normal = axes.tr_mul(&plane.normal));
        self
    }
}

/// The planes of faces at these heights above the centre.
pub(super) fn lowered(faces: &[(Vector3<f64>, f64)], r: f64, k: f64, shadow_radius: f64) -> Vec<Plane> {
    let plane = |&(normal, height): &(Vector3<f64>, f64)| {
        // A face beyond the sphere is never reached, and keeps its place.
        let depth = r * ((1.0 - k * (height / shadow_radius).powi(2)).max(0.0) / (1.0 - k)).sqrt();
        Plane { normal, offset: height - depth }
    };
    faces.iter().map(plane).collect()
}
