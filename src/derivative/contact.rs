//! The entries for pairs of particles.

use super::answer::{
    ContactDerivatives, ContactWeights, DerivativeError, DerivativeFlags, PoseGradient, ShapeGradient,
};
use super::closest::ClosestPoints;
use super::field::{Place, Potential};
use super::midway::AlongNormal;
use super::numbers::LOST_ACROSS;
use super::optimum::{FieldWeights, Kind as Problem, Optimum, normal_at};
use super::surface::SurfacePoint;
use crate::contact::closest_point::closest_point;
use crate::contact::contact::{Contact, Kind};
use crate::contact::error::DetectError;
use crate::flags::Flags;
use crate::linalg::double_double::DoubleDouble;
use crate::linalg::number::Single;
use crate::linalg::wide::{difference, wide};
use crate::pair::role::Role;
use crate::particle::particle::Particle;
use crate::pose::Pose;
use crate::settings::{Formulation, Settings};
use nalgebra::Vector3;

/// The derivatives of a contact in the poses of both bodies.
///
/// `contact` is the answer of [`crate::detect()`] for the same bodies, poses and settings. Nothing is solved again, but
/// for the closest points of a separated pair.
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
    let mut derivatives = ContactDerivatives::NONE;
    linearised((a, pose_a), (b, pose_b), contact, settings, |linearised| linearised.in_poses(&mut derivatives))?;
    derivatives.flags.set(DerivativeFlags::SEPARATED, contact.kind == Kind::Separated);
    if a.is_in_plane() {
        derivatives.stay_in_plane();
    }
    Ok(derivatives)
}

/// The derivative of a cost in poses and shapes of both bodies, from its derivatives in the numbers of their contact.
///
/// Adds to the gradients of the shapes that are given, and returns those of the poses of A and B. The work is linear in
/// the number of active planes; `contact` and `settings` as for [`contact_derivatives`].
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
    let weights = if a.is_in_plane() { weights.in_plane() } else { *weights };
    linearised((a, pose_a), (b, pose_b), contact, settings, |linearised| {
        let mut flags = linearised.add_to(&mut sum, &weights);
        flags.set(DerivativeFlags::SEPARATED, contact.kind == Kind::Separated);
        if a.is_in_plane() {
            sum.poses.iter_mut().for_each(PoseGradient::stay_in_plane);
        }
        (sum.poses, flags)
    })
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

    fn add_optimum<N: Single>(&mut self, optimum: &Optimum<N>, fields: &[FieldWeights<N>; 2]) {
        for (i, (place, weights)) in optimum.places.iter().zip(fields).enumerate() {
            if let Some(place) = place {
                self.add_motion(i, place, optimum.on_motion(i, weights));
                self.add_shape(i, place, weights);
            }
        }
    }

    /// Weights on velocity and turn at a point.
    fn add_motion<N: Single>(&mut self, i: usize, place: &Place<N>, [velocity, turn]: [Vector3<N>; 2]) {
        self.poses[i].shift += velocity.map(N::approximate);
        self.poses[i].turn += (turn + place.branch.cross(&velocity)).map(N::approximate);
    }

    fn add_shape<N: Single>(&mut self, i: usize, place: &Place<N>, weights: &FieldWeights<N>) {
        if let Some(shape) = self.shapes[i].as_deref_mut() {
            place.add_to_shape(weights.sigma, &weights.gamma, shape);
        }
    }
}

/// A contact with its linearised optimality conditions, in doubles or in 32 digits.
pub(super) trait Linearised {
    fn in_poses(&self, to: &mut ContactDerivatives);

    fn add_to(&self, sum: &mut Gradient, weights: &ContactWeights) -> DerivativeFlags;
}

impl<N: Single> Linearised for AlongNormal<'_, N> {
    fn in_poses(&self, to: &mut ContactDerivatives) {
        self.in_poses(to);
    }

    fn add_to(&self, sum: &mut Gradient, weights: &ContactWeights) -> DerivativeFlags {
        let (fields, sigmas) = self.pulled_back(weights);
        sum.add_optimum(&self.optimum, &fields);
        if let Some((surface_a, surface_b)) = &self.surfaces {
            for (i, surface) in [Some(surface_a), surface_b.as_ref()].into_iter().enumerate() {
                let Some(surface) = surface else { continue };
                let velocity = self.optimum.axes * surface.gradient() * -sigmas[i];
                sum.add_motion(i, &surface.place, [velocity, Vector3::zeros()]);
                sum.add_shape(i, &surface.place, &FieldWeights { sigma: sigmas[i], gamma: Vector3::zeros() });
            }
        }
        self.optimum.flags
    }
}

impl<N: Single> Linearised for ClosestPoints<'_, N> {
    fn in_poses(&self, to: &mut ContactDerivatives) {
        self.in_poses(to);
    }

    fn add_to(&self, sum: &mut Gradient, weights: &ContactWeights) -> DerivativeFlags {
        let mut flags = DerivativeFlags::default();
        for (optimum, fields) in &self.pulled_back(weights) {
            sum.add_optimum(optimum, fields);
            flags.set(optimum.flags, true);
        }
        flags
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

/// A point seen from both bodies, with the bound on its error and the lengths that were rounded in it.
type Seen = ([Vector3<f64>; 2], [f64; 2]);

/// A contact whose optimality conditions are to be linearised.
struct Task<'a, 'c> {
    bodies: [(&'a Particle, &'a Pose); 2],
    contact: &'c Contact,
    settings: &'c Settings,
    least_sphericity: f64,
}

impl<'a> Task<'a, '_> {
    fn is_overlap(&self) -> bool {
        self.contact.kind == Kind::Overlapping
    }

    /// Guesses of the ways along the normal to both surfaces.
    fn guesses(&self) -> [f64; 2] {
        let Contact { point_on_a, point_on_b, point, normal, .. } = self.contact;
        [point_on_a, point_on_b].map(|on_surface| (on_surface - point).dot(normal))
    }

    /// In doubles.
    #[inline(always)]
    fn midway<'p>(&self, bodies: &'p [Potential<'a>; 2]) -> Result<Optimum<'p>, DerivativeError> {
        let contact = self.contact;
        let branches = [contact.branch_a, contact.branch_b];
        let error = [contact.point_bound, 0.0];
        let place = |i: usize| Some(Place::new(&bodies[i], branches[i], error));
        Optimum::new(Problem::Midway, [place(0), place(1)], &contact.normal, None)
    }

    /// `then` of the contact along the normal from an optimum.
    #[inline(always)]
    fn along_normal<'p, N: Single, T>(
        &self,
        optimum: Optimum<'p, N>,
        then: impl FnOnce(&dyn Linearised) -> T,
    ) -> Result<T, DerivativeError> {
        optimum.check()?;
        let [Some(a), Some(b)] = optimum.places else { return Err(DerivativeError::NoPoint) };
        let guesses = self.guesses();
        let surface = |i: usize, place: Place<'p, N>| SurfacePoint::new(place.by_sign(), &optimum.axes, guesses[i]);
        let surfaces = if self.is_overlap() { Some((surface(0, a)?, Some(surface(1, b)?))) } else { None };
        Ok(then(&AlongNormal { s: self.contact.s, surfaces, optimum }))
    }

    /// Branches of P1 and of P2 from both bodies, with the bound on their error and the lengths that their rounding
    /// comes from.
    fn closest_branches(&self) -> Result<[Seen; 2], DerivativeError> {
        let [a, b] = self.bodies;
        let positions = [*a.1.position(), *b.1.position()];
        if self.is_overlap() {
            let from = positions[0].norm().max(positions[1].norm());
            let error = [self.contact.point_bound + 2.0 * f64::EPSILON * from, from];
            let points = [self.contact.point_on_a, self.contact.point_on_b];
            return Ok(points.map(|point| (positions.map(|position| point - position), error)));
        }
        let found = |on: Role| -> Result<_, DerivativeError> {
            let found = closest_point(a.0, a.1, b.0, b.1, on, self.settings)?.ok_or(DetectError::no_surface())?;
            Ok(([found.branch_a, found.branch_b], [found.point_bound, 0.0]))
        };
        Ok([found(Role::A)?, found(Role::B)?])
    }

    #[inline(always)]
    fn closest<'p>(
        &self,
        bodies: &'p [Potential<'a>; 2],
        branches: &[Seen; 2],
    ) -> Result<Option<ClosestPoints<'p>>, DerivativeError> {
        let optimum = |j: usize| -> Result<_, DerivativeError> {
            let (branches, error) = branches[j];
            let place = |i: usize| Place::new(&bodies[i], branches[i], error);
            let places = [place(0), place(1)];
            let normal = normal_at(ON[j], &places);
            let [a, b] = places;
            Optimum::new(ON[j], [Some(a), Some(b)], &normal, None)
        };
        let optima = [optimum(0)?, optimum(1)?];
        // The direction from one to the other is known to their rounding over their distance.
        let rounding = f64::EPSILON * (branches[0].0[0].norm() + branches[0].0[1].norm() + branches[0].1[1]);
        let lost = self.is_overlap() && rounding > LOST_ACROSS * self.contact.overlap;
        if lost || optima.iter().any(Optimum::wants_more) {
            return Ok(None);
        }
        let [on_a, on_b] = optima;
        on_a.check()?;
        on_b.check()?;
        Ok(Some(self.closest_points([on_a, on_b])))
    }

    fn closest_points<'p, N: Single>(&self, optima: [Optimum<'p, N>; 2]) -> ClosestPoints<'p, N> {
        let scales = [self.contact.s_b, self.contact.s];
        ClosestPoints::new(optima, scales, self.settings.weight_on_a, self.is_overlap())
    }

    #[cold]
    fn precise_bodies(&self) -> [Potential<'a, DoubleDouble>; 2] {
        [0, 1].map(|i| Potential::precise(self.bodies[i], self.least_sphericity))
    }

    /// An optimum in 32 digits, from how far it lies from B.
    #[cold]
    fn precise<'p>(
        &self,
        bodies: &'p [Potential<'a, DoubleDouble>; 2],
        kind: Problem,
        branch_b: &Vector3<f64>,
    ) -> Result<Optimum<'p, DoubleDouble>, DerivativeError> {
        let [pose_a, pose_b] = self.bodies.map(|body| body.1);
        let branch_b = wide(branch_b);
        let branch_a = branch_b + difference(pose_b.position(), pose_a.position());
        Optimum::refined(kind, [Place::precise(&bodies[0], branch_a), Place::precise(&bodies[1], branch_b)])
    }

    /// `then` of the contact: in 32 digits where doubles have lost too many. The contact is not moved, as it is large.
    #[inline(always)]
    fn linearised<T>(&self, then: impl FnOnce(&dyn Linearised) -> T) -> Result<T, DerivativeError> {
        let bodies = [0, 1].map(|i| Potential::new(self.bodies[i], self.least_sphericity));
        if self.contact.formulation == Formulation::Midway {
            let optimum = self.midway(&bodies)?;
            if !optimum.wants_more() {
                return self.along_normal(optimum, then);
            }
            let bodies = self.precise_bodies();
            return self.along_normal(self.precise(&bodies, Problem::Midway, &self.contact.branch_b)?, then);
        }
        let branches = self.closest_branches()?;
        if let Some(contact) = self.closest(&bodies, &branches)? {
            return Ok(then(&contact));
        }
        let bodies = self.precise_bodies();
        let optimum = |j: usize| self.precise(&bodies, ON[j], &branches[j].0[1]);
        Ok(then(&self.closest_points([optimum(0)?, optimum(1)?])))
    }
}

/// What P1 and P2 are.
const ON: [Problem; 2] = [Problem::OnA, Problem::OnB];

/// `then` of the optimality conditions at the optimum or optima of a contact.
fn linearised<T>(
    a: (&Particle, &Pose),
    b: (&Particle, &Pose),
    contact: &Contact,
    settings: &Settings,
    then: impl FnOnce(&dyn Linearised) -> T,
) -> Result<T, DerivativeError> {
    settings.validate()?;
    Particle::refuse_mixed(a, b)?;
    let closest = contact.formulation == Formulation::Closest;
    let scales = contact.s > 0.0 && contact.s.is_finite() && (!closest || contact.s_b > 0.0 && contact.s_b.is_finite());
    let surfaces = contact.kind == Kind::Separated || is_finite(&contact.point_on_a) && is_finite(&contact.point_on_b);
    let centred = is_finite(&contact.branch_a) && is_finite(&contact.branch_b) && is_finite(&contact.point);
    if contact.s == 0.0 || closest && contact.s_b == 0.0 {
        return Err(DerivativeError::NoGradient);
    }
    if !(scales && surfaces && centred && is_finite(&contact.normal)) {
        return Err(DerivativeError::without_point(contact.kind));
    }
    if contact.flags.contains(Flags::NORMAL_BY_CENTRES) {
        return Err(DerivativeError::NoGradient);
    }
    let least_sphericity = least_sphericity(settings, contact.flags);
    Task { bodies: [a, b], contact, settings, least_sphericity }.linearised(then)
}
