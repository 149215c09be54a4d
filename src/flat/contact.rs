//! Point, normal and overlap of a particle and a flat boundary.

use super::boundary::{Feature, Triangle, Wall};
use super::closest::{Closest, Goal};
use super::placed::Placed;
use super::separation;
use crate::bounds::scale::Scale;
use crate::contact::contact::Kind;
use crate::contact::detect::DetectError;
use crate::flags::Flags;
use crate::linalg::number::larger;
use crate::pair::body::{Body, shift_in_a};
use crate::pair::pair_state::PairState;
use crate::pair::separation::Apart;
use crate::particle::particle::Particle;
use crate::particle::ray_cast;
use crate::pose::Pose;
use crate::section::Section;
use crate::settings::Settings;
use nalgebra::Vector3;

/// The answer for a particle A and a boundary T, world axes, lengths in the caller's unit. What does not apply is NaN.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct FlatContact {
    /// Separated or overlapping.
    pub kind: Kind,
    /// Where on the boundary its point lies.
    pub feature: Feature,
    /// What else is to be known; [`Flags::BY_FACE`] where A lies beyond the plane of T, or T beyond a face of A.
    pub flags: Flags,
    /// Quadratics solved.
    pub iterations: u32,
    /// √S_A at x*, the least on T, with S_A as regularised ([`Settings::flat_regularisation`]). Rejected: a proved lower bound, ≥ 1.
    ///
    /// It depends on the particle, its pose and this boundary alone, and on an edge or a vertex on nothing else of the triangle:
    /// of the triangles of a mesh, the one with the least s (of equal ones, the first) owns the contact at a seam. With k = 0 and a
    /// flat face on several triangles the regularisation alone tells them apart: at its default to some percent of the size, at 1e-4
    /// to 1e-6 of it.
    pub s: f64,
    /// |s − s*| ≤ gap: rounding to first order, as of [`crate::Contact::gap`] in doubles.
    pub gap: f64,
    /// Estimated bound on the distance of `on_boundary` to x*, length.
    pub point_bound: f64,
    /// Distance from x* along the normal to the surface of A, > 0 when overlapping; NaN when separated.
    pub overlap: f64,
    /// Separated: A and T are at least this far from each other, as far as the proof knows; NaN when overlapping.
    pub distance: f64,
    /// Unit normal from A to T, ∇S_A/|∇S_A| at x*; on the inside of T exactly ± its own normal.
    pub normal: Vector3<f64>,
    /// Contact point, halfway between `on_boundary` and `on_particle`, world frame; x* when separated.
    pub point: Vector3<f64>,
    /// Contact point minus position of A.
    pub branch: Vector3<f64>,
    /// x*, world frame.
    pub on_boundary: Vector3<f64>,
    /// The point of the surface of A beyond x* along the normal, world frame; NaN when separated.
    pub on_particle: Vector3<f64>,
}

/// Contact of A at a pose with a plane, which it may touch from either side.
///
/// Of the settings, `gap_tolerance`, `flat_regularisation` (values below the default count as the default) and `solve_separated`
/// count; the answer is always in doubles. Where the centre of A lies on the plane
/// to rounding, A counts as in front of it: the normal is minus the plane's ([`Flags::NORMAL_BY_BOUNDARY`]).
///
/// A state of A and this boundary may be given, as for a pair of particles; nothing is kept in it so far.
///
/// ```
/// use potential_particles::{Kind, Particle, Pose, Settings, Wall, contact_with_plane};
/// let (ball, pose) = (Particle::sphere(1.0)?, Pose::at([3.0, 4.0, 0.75])?);
/// let floor = Wall::new([0.0, 0.0, 0.0], [0.0, 0.0, 1.0])?;
/// let contact = contact_with_plane(&ball, &pose, &floor, &Settings::default(), None)?;
/// assert_eq!(contact.kind, Kind::Overlapping);
/// assert!((contact.overlap - 0.25).abs() < 1e-15 && contact.normal.z == -1.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// A setting out of range, or no answer from the solver.
pub fn contact_with_plane(
    a: &Particle,
    pose: &Pose,
    wall: &Wall,
    settings: &Settings,
    _state: Option<&mut PairState>,
) -> Result<FlatContact, DetectError> {
    settings.validate()?;
    Call { particle: a, pose, normal: wall.normal, settings }.contact(&Placed::wall(wall, pose))
}

/// Contact of A at a pose with a closed triangle, which it may touch from either side; otherwise as [`contact_with_plane`].
///
/// # Errors
/// A setting out of range, or no answer from the solver.
pub fn contact_with_triangle(
    a: &Particle,
    pose: &Pose,
    triangle: &Triangle,
    settings: &Settings,
    _state: Option<&mut PairState>,
) -> Result<FlatContact, DetectError> {
    settings.validate()?;
    Call { particle: a, pose, normal: triangle.normal, settings }.contact(&Placed::triangle(triangle, pose))
}

/// What a call is about, beside the boundary in the particle's frame.
#[derive(Clone, Copy)]
struct Call<'a> {
    particle: &'a Particle,
    pose: &'a Pose,
    /// Of the boundary, world frame.
    normal: Vector3<f64>,
    settings: &'a Settings,
}

/// A unit normal, world and local, and whether the gradient tells none.
struct Normal {
    world: Vector3<f64>,
    local: Vector3<f64>,
    by_boundary: bool,
}

impl Call<'_> {
    fn contact(&self, boundary: &Placed) -> Result<FlatContact, DetectError> {
        if !self.settings.solve_separated {
            if let Some(apart) = separation::proof_of_separation(self.particle, boundary) {
                return Ok(FlatContact::apart(&apart));
            }
        }
        let goal = Goal {
            particle: self.particle,
            least_sphericity: self.settings.regularisation(),
            tolerance: self.settings.gap_tolerance,
        };
        let body = goal.body();
        let Some(closest) = goal.closest(boundary) else {
            return Err(DetectError::Failed { reason: "the scale on the boundary is not finite".into() });
        };
        let scale = closest.scale(&body);
        if !(closest.settled || scale.low >= 1.0 || scale.s + scale.gap < 1.0) {
            return Err(DetectError::Failed { reason: "the search on the boundary did not settle".into() });
        }
        if scale.s >= 1.0 && scale.low < 1.0 && self.settings.raises_regularisation() {
            // Where the bulge of a raised regularisation may hide an overlap, the particle as it is decides.
            let flat_regularisation = Settings::default().flat_regularisation;
            let settings = Settings { flat_regularisation, ..*self.settings };
            let contact = Call { settings: &settings, ..*self }.contact(boundary)?;
            return Ok(FlatContact { flags: contact.flags.with(Flags::DEFAULT_REGULARISATION), ..contact });
        }
        self.described(boundary, &body, &closest, scale)
    }

    fn described(
        &self,
        boundary: &Placed,
        body: &Body,
        closest: &Closest,
        scale: Scale,
    ) -> Result<FlatContact, DetectError> {
        let minimum = &closest.minimum;
        let normal = self.normal(boundary, body, closest);
        let mut flags = if normal.by_boundary { Flags::NORMAL_BY_BOUNDARY } else { Flags::NONE };
        let open = minimum.value - closest.lower + 2.0 * minimum.rounding;
        if open > self.settings.gap_tolerance * minimum.value {
            flags.insert(Flags::ROUNDING_LIMITED);
        }
        let to_boundary = self.pose.rotate(&minimum.x);
        let position = self.pose.position();
        let contact = FlatContact {
            kind: Kind::Separated,
            feature: closest.feature,
            flags,
            iterations: closest.models,
            s: scale.s,
            gap: scale.gap,
            point_bound: closest.point_bound(body, boundary),
            normal: normal.world,
            point: position + to_boundary,
            branch: to_boundary,
            on_boundary: position + to_boundary,
            ..FlatContact::UNKNOWN
        };
        if scale.s >= 1.0 {
            return Ok(FlatContact { distance: closest.distance(body, boundary), ..contact });
        }
        let overlap = self
            .overlap(closest, &normal.local, shift_in_a(minimum.x.norm(), boundary.farthest))
            .ok_or_else(|| DetectError::Failed { reason: "the surface was not found along the normal".into() })?;
        let branch = to_boundary + 0.5 * overlap * normal.world;
        Ok(FlatContact {
            kind: Kind::Overlapping,
            overlap,
            distance: f64::NAN,
            point: position + branch,
            branch,
            on_particle: position + (to_boundary + overlap * normal.world),
            ..contact
        })
    }

    /// Along the gradient; inside the boundary along its normal, at an edge at right angles to that.
    fn normal(&self, boundary: &Placed, body: &Body, closest: &Closest) -> Normal {
        let Closest { minimum, feature, .. } = closest;
        let shift = shift_in_a(minimum.x.norm(), boundary.farthest);
        let doubt = minimum.slope + body.sphere_curvature() * shift;
        let by_boundary = Normal { world: -self.normal, local: -boundary.normal, by_boundary: true };
        let gradient = match (feature, &boundary.corners) {
            (Feature::Interior, _) | (_, None) => {
                let slope = minimum.gradient.dot(&boundary.normal);
                let (world, local) = (self.normal, boundary.normal);
                return match () {
                    _ if slope > doubt => Normal { world, local, by_boundary: false },
                    _ if slope < -doubt => Normal { by_boundary: false, ..by_boundary },
                    _ => by_boundary,
                };
            }
            (Feature::Edge(i), Some(corners)) => {
                let along = corners.edges[usize::from(*i)].along;
                minimum.gradient - minimum.gradient.dot(&along) * along
            }
            (Feature::Vertex(_), Some(_)) => minimum.gradient,
        };
        match gradient.try_normalize(doubt) {
            Some(local) => Normal { world: self.pose.rotate(&local).normalize(), local, by_boundary: false },
            None => by_boundary,
        }
    }

    /// The way along the normal from the boundary to the surface of A.
    fn overlap(&self, closest: &Closest, normal: &Vector3<f64>, shift: f64) -> Option<f64> {
        let minimum = &closest.minimum;
        let guess =
            ray_cast::root_of_piece(minimum.value - 1.0, minimum.gradient.dot(normal), minimum.curvature(normal));
        let way = ray_cast::distance_near(self.particle, &minimum.x, normal, guess)
            .or_else(|| ray_cast::distance_beside(self.particle, &minimum.x, normal, shift))?;
        // Where s < 1 by rounding alone, it may be behind.
        Some(larger(way, 0.0))
    }
}

impl From<&FlatContact> for Section {
    /// Of an overlapping contact: with A in place of both particles its area is that of the cut of A alone.
    fn from(contact: &FlatContact) -> Self {
        Self { branch_a: contact.branch, branch_b: contact.branch, normal: contact.normal }
    }
}

impl FlatContact {
    /// Of which nothing is known yet.
    const UNKNOWN: Self = {
        let nan = Vector3::new(f64::NAN, f64::NAN, f64::NAN);
        Self {
            kind: Kind::Separated,
            feature: Feature::Interior,
            flags: Flags::NONE,
            iterations: 0,
            s: f64::NAN,
            gap: f64::NAN,
            point_bound: f64::NAN,
            overlap: f64::NAN,
            distance: 0.0,
            normal: nan,
            point: nan,
            branch: nan,
            on_boundary: nan,
            on_particle: nan,
        }
    };

    fn apart(proof: &Apart) -> Self {
        let flags = proof.by.with(Flags::REJECTED);
        Self { flags, s: 1.0, distance: proof.distance, ..Self::UNKNOWN }
    }
}
