//! The entries for pairs of particles.

use super::answer::{
    ContactDerivatives, ContactWeights, DerivativeError, DerivativeFlags, PoseGradient, ShapeGradient,
};
use super::closest::ClosestPoints;
use super::field::Place;
use super::midway::AlongNormal;
use super::optimum::{FieldWeights, Kind as Problem, Optimum};
use super::surface::SurfacePoint;
use crate::contact::closest_point::closest_point;
use crate::contact::contact::{Contact, Kind};
use crate::contact::detect::DetectError;
use crate::flags::Flags;
use crate::pair::role::Role;
use crate::particle::particle::Particle;
use crate::pose::Pose;
use crate::settings::{Formulation, Settings};
use nalgebra::Vector3;

/// A contact with its linearised optimality conditions.
enum Linearised<'a> {
    AlongNormal(Box<AlongNormal<'a>>),
    Closest(Box<ClosestPoints<'a>>),
}

/// The derivatives of a contact in the poses of both bodies.
///
/// `contact` is the answer of [`crate::detect()`] for the same bodies, poses and settings. Nothing is solved again, but for the closest points
/// of a separated pair.
///
/// ```
/// use potential_particles::{Particle, Pose, Settings, contact_derivatives, detect};
/// let ball = Particle::sphere(1.0)?;
/// let (left, right) = (Pose::at([0.0, 0.0, 0.0])?, Pose::at([1.5, 0.0, 0.0])?);
/// let settings = Settings::default();
/// let contact = detect(&ball, &left, &ball, &right, &settings, None)?;
/// let derivatives = contact_derivatives(&ball, &left, &ball, &right, &contact, &settings)?;
/// // Overlap 2 − |c|: moving B away along x opens it, and across it turns the normal by 1/|c|.
/// assert!((derivatives.overlap[6] + 1.0).abs() < 1e-12);
/// assert!((derivatives.normal[(1, 7)] - 1.0 / 1.5).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// No contact point, no gradient there, or no curvature across the normal.
pub fn contact_derivatives(
    a: &Particle,
    pose_a: &Pose,
    b: &Particle,
    pose_b: &Pose,
    contact: &Contact,
    settings: &Settings,
) -> Result<ContactDerivatives, DerivativeError> {
    let mut derivatives = match linearised((a, pose_a), (b, pose_b), contact, settings)? {
        Linearised::AlongNormal(contact) => contact.derivatives(),
        Linearised::Closest(contact) => contact.derivatives(),
    };
    derivatives.flags.set(DerivativeFlags::SEPARATED, contact.kind == Kind::Separated);
    Ok(derivatives)
}

/// The derivative of a cost in poses and shapes of both bodies, from its derivatives in the numbers of their contact.
///
/// Adds to the gradients of the shapes that are given, and returns those of the poses of A and B. The work is linear in the number of active
/// planes; `contact` and `settings` as for [`contact_derivatives`].
///
/// ```
/// use potential_particles::{
///     ContactWeights, Particle, Pose, Settings, ShapeGradient, contact_gradient, detect,
/// };
/// let (small, large) = (Particle::sphere(0.5)?, Particle::sphere(1.0)?);
/// let (left, right) = (Pose::at([0.0, 0.0, 0.0])?, Pose::at([1.4, 0.0, 0.0])?);
/// let settings = Settings::default();
/// let contact = detect(&small, &left, &large, &right, &settings, None)?;
/// let mut shape = ShapeGradient::zeros(&small);
/// let weights = ContactWeights { overlap: 1.0, ..ContactWeights::default() };
/// let (poses, _) =
///     contact_gradient(&small, &left, &large, &right, &contact, &settings, &weights, Some(&mut shape), None)?;
/// // The overlap R_A + R_B − |c|.
/// assert!((shape.shadow_radius - 1.0).abs() < 1e-12 && (poses[0].shift.x - 1.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Those of [`contact_derivatives`], and gradients of other numbers of planes.
#[allow(clippy::too_many_arguments)]
pub fn contact_gradient(
    a: &Particle,
    pose_a: &Pose,
    b: &Particle,
    pose_b: &Pose,
    contact: &Contact,
    settings: &Settings,
    weights: &ContactWeights,
    shape_a: Option<&mut ShapeGradient>,
    shape_b: Option<&mut ShapeGradient>,
) -> Result<([PoseGradient; 2], DerivativeFlags), DerivativeError> {
    let mut sum = Gradient { poses: Default::default(), shapes: [shape_a, shape_b] };
    sum.check([a, b])?;
    let mut flags = match linearised((a, pose_a), (b, pose_b), contact, settings)? {
        Linearised::AlongNormal(contact) => sum.add_along_normal(&contact, weights),
        Linearised::Closest(contact) => {
            let mut flags = DerivativeFlags::default();
            for (optimum, fields) in &contact.pulled_back(weights) {
                sum.add_optimum(optimum, fields);
                flags.set(optimum.flags, true);
            }
            flags
        }
    };
    flags.set(DerivativeFlags::SEPARATED, contact.kind == Kind::Separated);
    Ok((sum.poses, flags))
}

/// What a pull-back adds to.
pub(super) struct Gradient<'s> {
    pub poses: [PoseGradient; 2],
    pub shapes: [Option<&'s mut ShapeGradient>; 2],
}

impl Gradient<'_> {
    pub fn check(&self, particles: [&Particle; 2]) -> Result<(), DerivativeError> {
        for (shape, particle) in self.shapes.iter().zip(particles) {
            let expected = particle.plane_count();
            if let Some(given) = shape.as_ref().map(|shape| shape.planes.len()).filter(|given| *given != expected) {
                return Err(DerivativeError::Planes { given, expected });
            }
        }
        Ok(())
    }

    pub fn add_along_normal(&mut self, contact: &AlongNormal, weights: &ContactWeights) -> DerivativeFlags {
        let (fields, sigmas) = contact.pulled_back(weights);
        self.add_optimum(&contact.optimum, &fields);
        if let Some((surface_a, surface_b)) = &contact.surfaces {
            for (i, surface) in [Some(surface_a), surface_b.as_ref()].into_iter().enumerate() {
                let Some(surface) = surface else { continue };
                let velocity = -sigmas[i] * (contact.optimum.axes * surface.gradient());
                self.add_motion(i, &surface.place, [velocity, Vector3::zeros()]);
                self.add_shape(i, &surface.place, &FieldWeights { sigma: sigmas[i], gamma: Vector3::zeros() });
            }
        }
        contact.optimum.flags
    }

    fn add_optimum(&mut self, optimum: &Optimum, fields: &[FieldWeights; 2]) {
        for (i, (place, weights)) in optimum.places.iter().zip(fields).enumerate() {
            if let Some(place) = place {
                self.add_motion(i, place, optimum.on_motion(i, weights));
                self.add_shape(i, place, weights);
            }
        }
    }

    /// Weights on velocity and turn at a point.
    fn add_motion(&mut self, i: usize, place: &Place, [velocity, turn]: [Vector3<f64>; 2]) {
        self.poses[i].shift += velocity;
        self.poses[i].turn += turn + place.branch.cross(&velocity);
    }

    fn add_shape(&mut self, i: usize, place: &Place, weights: &FieldWeights) {
        if let Some(shape) = self.shapes[i].as_deref_mut() {
            place.add_to_shape(weights.sigma, &weights.gamma, shape);
        }
    }
}

/// Sphericity that the solver used in place of smaller ones.
pub(super) fn least_sphericity(settings: &Settings, flags: Flags) -> f64 {
    let default = Settings { flat_regularisation: Settings::DEFAULT.flat_regularisation, ..*settings };
    if flags.contains(Flags::DEFAULT_REGULARISATION) { default.least_sphericity() } else { settings.least_sphericity() }
}

pub(super) fn is_finite(v: &Vector3<f64>) -> bool {
    v.iter().all(|c| c.is_finite())
}

/// The optimality conditions at the optimum or optima of a contact.
fn linearised<'a>(
    a: (&'a Particle, &'a Pose),
    b: (&'a Particle, &'a Pose),
    contact: &Contact,
    settings: &Settings,
) -> Result<Linearised<'a>, DerivativeError> {
    settings.validate()?;
    if !(is_finite(&contact.branch_a) && is_finite(&contact.branch_b) && is_finite(&contact.normal)) {
        return Err(DerivativeError::NoPoint);
    }
    if contact.flags.contains(Flags::NORMAL_BY_CENTRES) {
        return Err(DerivativeError::NoGradient);
    }
    let least = least_sphericity(settings, contact.flags);
    let place = |body: (&'a Particle, &'a Pose), branch: Vector3<f64>, error: f64| {
        Place::new(body.0, body.1, branch, error, least)
    };
    let is_overlap = contact.kind == Kind::Overlapping;
    let on_surface = [contact.point_on_a, contact.point_on_b];
    if contact.formulation == Formulation::Midway {
        let places = [place(a, contact.branch_a, contact.point_bound), place(b, contact.branch_b, contact.point_bound)];
        let optimum = Optimum::new(Problem::Midway, places.map(Some), &contact.normal, None)?;
        let surface = |i: usize| {
            let guess = (on_surface[i] - contact.point).dot(&contact.normal);
            SurfacePoint::new(&places[i], &optimum.axes, guess)
        };
        let surfaces = if is_overlap { Some((surface(0)?, Some(surface(1)?))) } else { None };
        let branches = [contact.branch_a, contact.branch_b];
        return Ok(Linearised::AlongNormal(Box::new(AlongNormal { optimum, s: contact.s, branches, surfaces })));
    }
    let places = if is_overlap {
        on_surface.map(|point| {
            [a, b].map(|body| {
                let error = contact.point_bound + 2.0 * f64::EPSILON * body.1.position().norm();
                place(body, point - body.1.position(), error)
            })
        })
    } else {
        let mut places = [[place(a, contact.branch_a, 0.0), place(b, contact.branch_b, 0.0)]; 2];
        for (places, on) in places.iter_mut().zip([Role::A, Role::B]) {
            let found = closest_point(a.0, a.1, b.0, b.1, on, settings)?.ok_or(DetectError::no_surface())?;
            *places = [place(a, found.branch_a, found.point_bound), place(b, found.branch_b, found.point_bound)];
        }
        places
    };
    let scales = [contact.s_b, contact.s];
    let points = ClosestPoints::new(places, scales, settings.weight_on_a, is_overlap)?;
    Ok(Linearised::Closest(Box::new(points)))
}
