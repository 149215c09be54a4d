//! The entries for planes and triangles.

use super::answer::{
    ContactDerivatives, ContactWeights, DerivativeError, DerivativeFlags, PoseGradient, ShapeGradient,
};
use super::contact::{Gradient, Linearised, is_finite, least_sphericity};
use super::field::{Place, Potential};
use super::midway::AlongNormal;
use super::optimum::{Kind as Problem, Optimum};
use super::surface::SurfacePoint;
use crate::boundary::{Feature, FlatContact, Triangle};
use crate::contact::contact::Kind;
use crate::flags::Flags;
use crate::particle::particle::Particle;
use crate::pose::Pose;
use crate::settings::Settings;

/// The derivatives of a contact with a plane (no triangle) or a triangle, in the poses of the particle A and of the
/// boundary.
///
/// `contact` is the answer of [`crate::contact_with_plane`] or [`crate::contact_with_triangle`]. As in a contact of two
/// particles, with the boundary in place of B: `point_on_a` is `on_particle`, `point_on_b` is `on_boundary`. The
/// boundary turns about the position of A, too, as it has none of its own: about another place o, add the derivatives
/// in its shift times (position of A − o) × of the turn.
///
/// ```
/// use potential_particles::{Particle, Pose, Settings, Wall, boundary_derivatives, contact_with_plane};
/// let (ball, pose) = (Particle::sphere(1.0)?, Pose::at([3.0, 4.0, 0.75])?);
/// let floor = Wall::new([0.0, 0.0, 0.0], [0.0, 0.0, 1.0])?;
/// let contact = contact_with_plane(&ball, &pose, &floor, &Settings::default(), None)?;
/// let derivatives = boundary_derivatives(&ball, &pose, None, &contact, &Settings::default())?;
/// // Raising the ball opens the contact, and raising the floor closes it.
/// assert!((derivatives.overlap[2] + 1.0).abs() < 1e-14 && (derivatives.overlap[8] - 1.0).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Those of [`crate::contact_derivatives`].
pub fn boundary_derivatives(
    a: &Particle,
    pose: &Pose,
    triangle: Option<&Triangle>,
    contact: &FlatContact,
    settings: &Settings,
) -> Result<ContactDerivatives, DerivativeError> {
    let mut derivatives = ContactDerivatives::NONE;
    linearised(a, pose, triangle, contact, settings, |linearised| linearised.in_poses(&mut derivatives))?;
    derivatives.flags.set(DerivativeFlags::SEPARATED, contact.kind == Kind::Separated);
    if a.is_in_plane() {
        derivatives.stay_in_plane();
    }
    Ok(derivatives)
}

/// The derivative of a cost in the pose and shape of A, and in the pose of the boundary, from its derivatives in the
/// numbers of a contact.
///
/// With the boundary in place of B, otherwise as [`crate::contact_gradient`]; poses as of [`boundary_derivatives`].
///
/// # Errors
/// Those of [`crate::contact_gradient`].
pub fn boundary_gradient(
    a: &Particle,
    pose: &Pose,
    triangle: Option<&Triangle>,
    contact: &FlatContact,
    settings: &Settings,
    weights: &ContactWeights,
    shape: Option<&mut ShapeGradient>,
) -> Result<([PoseGradient; 2], DerivativeFlags), DerivativeError> {
    let mut sum = Gradient { poses: Default::default(), shapes: [shape, None] };
    sum.check([a, a])?;
    let weights = if a.is_in_plane() { weights.in_plane() } else { *weights };
    let mut flags =
        linearised(a, pose, triangle, contact, settings, |linearised| linearised.add_to(&mut sum, &weights))?;
    flags.set(DerivativeFlags::SEPARATED, contact.kind == Kind::Separated);
    // Where both move alike, points and normal go with them.
    let mut both =
        PoseGradient { shift: weights.point + weights.point_on_b, turn: contact.normal.cross(&weights.normal) };
    both.turn +=
        contact.branch.cross(&weights.point) + (contact.on_boundary - pose.position()).cross(&weights.point_on_b);
    if contact.kind == Kind::Overlapping {
        both.shift += weights.point_on_a;
        both.turn += (contact.on_particle - pose.position()).cross(&weights.point_on_a);
    }
    let [of_a, _] = sum.poses;
    let mut poses = [of_a, PoseGradient { shift: both.shift - of_a.shift, turn: both.turn - of_a.turn }];
    if a.is_in_plane() {
        poses.iter_mut().for_each(PoseGradient::stay_in_plane);
    }
    Ok((poses, flags))
}

/// `then` of the optimality conditions.
fn linearised<T>(
    a: &Particle,
    pose: &Pose,
    triangle: Option<&Triangle>,
    contact: &FlatContact,
    settings: &Settings,
    then: impl FnOnce(&AlongNormal) -> T,
) -> Result<T, DerivativeError> {
    settings.validate()?;
    let is_overlap = contact.kind == Kind::Overlapping;
    let surface = !is_overlap || contact.overlap.is_finite() && is_finite(&contact.on_particle);
    let on_boundary = is_finite(&contact.branch) && is_finite(&contact.on_boundary) && is_finite(&contact.normal);
    if !(contact.s >= 0.0 && contact.s.is_finite() && surface && on_boundary) {
        return Err(DerivativeError::without_point(contact.kind));
    }
    a.refuse_slanted(pose, &contact.normal)?;
    if contact.s == 0.0 || contact.flags.contains(Flags::NORMAL_BY_BOUNDARY) {
        return Err(DerivativeError::NoGradient);
    }
    let to_optimum = if is_overlap { contact.branch - 0.5 * contact.overlap * contact.normal } else { contact.branch };
    let body = Potential::new((a, pose), least_sphericity(settings, contact.flags));
    let place = Place::new(&body, to_optimum, [contact.point_bound, 0.0]);
    let (dimensions, along) = match (contact.feature.edge(), triangle) {
        (None, _) => (if contact.feature == Feature::Interior { 2 } else { 0 }, None),
        (Some(i), Some(triangle)) => {
            let [from, to] = [0, 1].map(|j| triangle.vertices()[(i + j) % 3]);
            (1, Some((to - from).normalize()))
        }
        (Some(_), None) => return Err(DerivativeError::NoTriangle),
    };
    let optimum = Optimum::new(Problem::OnBoundary(dimensions), [Some(place), None], &contact.normal, along)?;
    optimum.check()?;
    let surfaces =
        if is_overlap { Some((SurfacePoint::new(place, &optimum.axes, contact.overlap)?, None)) } else { None };
    Ok(then(&AlongNormal { optimum, s: contact.s, surfaces }))
}
