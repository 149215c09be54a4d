//! From a sharp body to a particle: where its faces, its centre and its axes are.
//!
//! Let h_i be the distance of face i from the centre of the particle. The planes of the particle lie at
//!
//! ```text
//! d_i = h_i − r √((1 − k h_i²/R²)/(1 − k))
//! ```
//!
//! so that S = 1 at the foot of the perpendicular from the centre on the face, as long as no other plane counts there: the particle touches the face at
//! this foot, and lies inside the body everywhere. Away from the foot a face is deeper by at most r (1/√(1−k) − 1), about r k/2; for k = 0 it is
//! flat. Edges and corners are rounded. The shadow sphere is about the centre, which is to be the centroid: with k > 0 the shape depends on it a
//! little, and it is found by repetition.

use super::error::{ShapeError, positive, within};
use super::principal_frame;
use crate::particle::largest_ball;
use crate::particle::mass_properties::{self, MASS_TOLERANCE, MassProperties};
use crate::particle::particle::Particle;
use crate::particle::plane::Plane;
use crate::pose::Pose;
use crate::rock::{Block, SliceSettings, slice};
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

/// The repetition ends when the centre is the centroid to this share of the size, found with fewer digits, which takes far less time, or, of bodies so
/// flat or long that these digits do not say as much, when it comes no nearer and is the centroid as far as they tell. A last step with all digits
/// follows; the shape does not change by it, but in the product of this share and k.
const CENTRED: f64 = 1e-5;
const ROUGHLY: f64 = 1e-4;
const MOST_STEPS: usize = 50;

/// How edges and corners are rounded: shares of the size, the diameter of the largest ball that fits into the sharp body.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Rounding {
    /// Rounding radius r over the size, in (0, 0.5).
    pub r: f64,
    /// Sphericity k, in [0, 1]: 0 leaves faces flat, 1 makes a sphere of radius R.
    pub k: f64,
    /// Radius R of the shadow sphere over the size; `None`: the distance from the centre to the farthest corner.
    pub shadow_radius: Option<f64>,
}

impl Default for Rounding {
    /// What docs/shapes.md advises: r = 0.05, k = 0.02.
    fn default() -> Self {
        Self::new(0.05, 0.02)
    }
}

impl Rounding {
    /// By r, a share of the size, and k.
    pub fn new(r: f64, k: f64) -> Self {
        Self { r, k, shadow_radius: None }
    }

    /// The same with R, a share of the size.
    pub fn with_shadow_radius(self, shadow_radius: f64) -> Self {
        Self { shadow_radius: Some(shadow_radius), ..self }
    }

    /// r and k as they are, and R, all lengths.
    fn lengths(&self, size: f64) -> Result<(f64, f64, Option<f64>), ShapeError> {
        let range = "a share of the size between 0 and 0.5 (a sphere has k = 1 and no planes)";
        let r = within(self.r, self.r > 0.0 && self.r < 0.5, "r", range)?;
        let k = within(self.k, (0.0..=1.0).contains(&self.k), "k", "between 0 and 1")?;
        let shadow_radius = self.shadow_radius.map(|share| positive(share, "R")).transpose()?;
        Ok((size * r, k, shadow_radius.map(|share| size * share)))
    }
}

/// A particle about its centroid along its principal axes, with its mass properties.
#[derive(Clone, Debug)]
pub struct Shape {
    /// The particle.
    pub particle: Particle,
    /// Volume, centroid and inertia in the particle's frame, to 1e-6.
    pub mass: MassProperties,
    /// The origin of the particle's frame in that of the builder, length.
    pub centroid: Vector3<f64>,
    /// The quaternion (w, x, y, z), w ≥ 0, from the particle's frame to the builder's: x_builder = centroid + orientation x.
    pub orientation: [f64; 4],
}

impl Shape {
    /// The pose at which the particle stands where its builder's frame is the world's.
    pub fn pose(&self) -> Pose {
        // Both are finite, and the quaternion of unit length.
        Pose::new(self.centroid.into(), self.orientation).expect("a finite centroid and a unit quaternion")
    }

    /// The shape {n·x ≤ h} of half-spaces, rounded.
    pub(super) fn rounded(half_spaces: &[Plane], rounding: &Rounding) -> Result<Self, ShapeError> {
        Self::of_block(&block(half_spaces)?, rounding)
    }

    /// A sharp body, rounded.
    pub(super) fn of_block(block: &Block, rounding: &Rounding) -> Result<Self, ShapeError> {
        let centroid = block.centroid;
        let heights: Vec<_> = block.faces.iter().map(|face| (face.plane.normal, face.plane.offset)).collect();
        let about = |centre: &Vector3<f64>| heights.iter().map(|(n, h)| (*n, h - n.dot(centre))).collect::<Vec<_>>();
        let farthest =
            |centre: &Vector3<f64>| block.corners.iter().map(|corner| (corner - centre).norm()).fold(0.0, f64::max);
        let radius = largest_ball::radius(&about(&centroid), farthest(&centroid)).ok_or(ShapeError::Empty)?;
        let (r, k, shadow_radius) = rounding.lengths(2.0 * radius)?;
        let definition = |centre: &Vector3<f64>| {
            let shadow_radius = shadow_radius.unwrap_or_else(|| farthest(centre));
            Definition { planes: lowered(&about(centre), r, k, shadow_radius), r, k, shadow_radius }
        };
        Self::settled(definition, centroid, 2.0 * radius)
    }

    /// With its centroid as its centre, in principal axes.
    pub(super) fn settled(
        definition: impl Fn(&Vector3<f64>) -> Definition,
        mut centre: Vector3<f64>,
        size: f64,
    ) -> Result<Self, ShapeError> {
        let mut found = None;
        let mut last = f64::INFINITY;
        for _ in 0..MOST_STEPS {
            let Definition { k, shadow_radius, .. } = definition(&centre);
            let particle = definition(&centre).particle()?;
            let mass = mass_properties::of(&particle, ROUGHLY);
            let shift = mass.centroid;
            let is_known_no_better =
                shift.amax() > 0.5 * last && known(&mass).zip_map(&shift, |k, s| s.abs() - k).max() <= 0.0;
            if !(shift.amax() > CENTRED * size) || is_known_no_better {
                found = Some(particle);
                break;
            }
            last = shift.amax();
            centre += shift;
            if !centre.iter().all(|c| c.is_finite()) {
                return Err(ShapeError::NoCentre { k, shadow_radius });
            }
        }
        let Definition { k, shadow_radius, .. } = definition(&centre);
        let particle = found.ok_or(ShapeError::NoCentre { k, shadow_radius })?;
        let mass = mass_properties::of(&particle, MASS_TOLERANCE);
        // The centroid is known no better than this.
        if mass.centroid.amax() > MASS_TOLERANCE * size {
            centre += mass.centroid;
        }
        let axes = principal_frame::axes(&mass.inertia);
        let particle = definition(&centre).turned(&axes).particle()?;
        let quaternion = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
        let sign = if quaternion.w < 0.0 { -1.0 } else { 1.0 };
        let orientation = [quaternion.w, quaternion.i, quaternion.j, quaternion.k].map(|c| sign * c);
        let mass = mass_properties::of(&particle, MASS_TOLERANCE);
        Ok(Self { particle, mass, centroid: centre, orientation })
    }
}

/// How far the centroid may be off along each axis: its error is a share of the radius of gyration √(∫x²dV/V); none where nothing is known.
fn known(mass: &MassProperties) -> Vector3<f64> {
    let error = if mass.error.is_finite() { mass.error } else { 0.0 };
    let all = 0.5 * mass.inertia.trace();
    mass.inertia.diagonal().map(|about| error * ((all - about).max(0.0) / mass.volume).sqrt())
}

/// The sharp body of half-spaces: a domain of rock without joints.
pub(super) fn block(half_spaces: &[Plane]) -> Result<Block, ShapeError> {
    let mass = slice(half_spaces, &[], &SliceSettings::default())?;
    mass.blocks.into_iter().next().ok_or(ShapeError::Empty)
}

/// What a particle is made of.
pub(super) struct Definition {
    pub planes: Vec<Plane>,
    pub r: f64,
    pub k: f64,
    pub shadow_radius: f64,
}

impl Definition {
    fn particle(&self) -> Result<Particle, ShapeError> {
        Ok(Particle::new(&self.planes, self.r, self.k, self.shadow_radius)?)
    }

    /// In axes that are these columns.
    fn turned(mut self, axes: &Matrix3<f64>) -> Self {
        self.planes.iter_mut().for_each(|plane| plane.normal = axes.tr_mul(&plane.normal));
        self
    }
}

/// The planes of faces at these heights above the centre.
fn lowered(faces: &[(Vector3<f64>, f64)], r: f64, k: f64, shadow_radius: f64) -> Vec<Plane> {
    if k == 1.0 {
        return Vec::new();
    }
    let plane = |&(normal, height): &(Vector3<f64>, f64)| {
        // A face beyond the sphere is never reached, and keeps its place.
        let depth = r * ((1.0 - k * (height / shadow_radius).powi(2)).max(0.0) / (1.0 - k)).sqrt();
        Plane { normal, offset: height - depth }
    };
    faces.iter().map(plane).collect()
}
