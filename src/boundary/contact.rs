//! Point, normal and overlap of a particle and a flat boundary.

use super::boundary::{Feature, Triangle, Wall};
use super::closest::{Closest, Search};
use super::separation;
use super::triangle::PlacedTriangle;
use crate::answer::answer;
use crate::bounds::scale::Scale;
use crate::contact::contact::Kind;
use crate::contact::error::DetectError;
use crate::flags::Flags;
use crate::linalg::number::direction;
use crate::linalg::number::{larger, unknown_vector};
use crate::pair::body::{Body, shift_in_a};
use crate::pair::boundary_part::PlacedPart;
use crate::pair::pair::Pair;
use crate::pair::pair_state::{How, PairState, Remembered, from_memory_or_anew};
use crate::pair::separation::Apart;
use crate::particle::particle::Particle;
use crate::particle::{potential, ray_cast};
use crate::pose::Pose;
use crate::section::Section;
use crate::settings::Settings;
use crate::solver::call::SolveError;
use nalgebra::Vector3;

answer! {
    /// The contact of a particle A with a flat boundary T, a plane or a closed triangle of no thickness. World
    /// axes; lengths in the caller's unit; s and gap have no unit. Fields that do not apply are NaN.
    ///
    /// x* is the point of T where the scale s of A is least. A overlaps T if that scale is below 1.
    pub struct FlatContact {
        /// [`Kind::Separated`] or [`Kind::Overlapping`]. A failed solve has no kind: it returns a status.
        pub kind: Kind = Kind::Separated,
        /// Where on T the point x* lies: PP_ON_INTERIOR, PP_ON_EDGE + i or PP_ON_VERTEX + i.
        pub feature: Feature = Feature::Interior,
        /// Sum of [`Flags`]: REJECTED with BY_SPHERES, or with BY_FACE (of A, or T itself);
        /// ROUNDING_LIMITED, EXTENDED, DEFAULT_REGULARISATION, NORMAL_BY_BOUNDARY.
        pub flags: Flags = Flags::NONE,
        /// Quadratics solved.
        pub iterations: u32 = 0,
        /// Scale of A at x*, the least on T, of A as regularised (flat_regularisation). Rejected: a lower bound,
        /// no less than 1. Triangles that share the edge or vertex on which x* lies get the same s to the last
        /// bit: a caller can give the contact at a seam to the triangle with the least s, and break ties by its
        /// own numbering. If a flat face (k = 0) lies on several triangles, their s differ by flat_regularisation
        /// only; the place of the contact is then known to some percent of the size with the default, to 1e-6 of
        /// the size with 1e-4.
        pub s: f64 = f64::NAN,
        /// Bound on the error of s, with rounding to first order in doubles (as in [`Contact`](crate::Contact)).
        pub gap: f64 = f64::NAN,
        /// Estimated bound on the distance of on_boundary to the exact x*, length.
        pub point_bound: f64 = f64::NAN,
        /// Distance from x* along the normal to the surface of A (YADE: penetrationDepth), length, >= 0 when
        /// overlapping; NaN when separated.
        pub overlap: f64 = f64::NAN,
        /// Separated: lower bound on the distance between A and T, length; 0 when none is known. NaN when
        /// overlapping.
        pub distance: f64 = 0.0,
        /// Unit normal from A to T: the gradient of S_A at x*; inside T exactly the normal of T or its opposite.
        pub normal: Vector3<f64> = unknown_vector(),
        /// Contact point, halfway between on_boundary and on_particle, world frame; x* when separated.
        pub point: Vector3<f64> = unknown_vector(),
        /// Contact point minus position of A: exact lever arm even far from the world origin.
        pub branch: Vector3<f64> = unknown_vector(),
        /// x*, world frame.
        pub on_boundary: Vector3<f64> = unknown_vector(),
        /// The point of the surface of A beyond x* along the normal, world frame; NaN when separated.
        pub on_particle: Vector3<f64> = unknown_vector(),
    }
}

/// Contact of A at a pose with a plane, which it may touch from either side.
///
/// Of the settings, `gap_tolerance`, `flat_regularisation` (values below the default count as the default) and
/// `solve_separated` count. As for a pair, a `gap_tolerance` below 1e-13, or a gap in doubles that is too wide, is
/// answered in extended precision ([`Flags::EXTENDED`]). Where the slope of S does not tell the normal, it is the
/// plane's, away from the centre of A; where that lies on the plane to rounding, A counts as in front of it
/// ([`Flags::NORMAL_BY_BOUNDARY`]).
///
/// `state` is what A and this boundary keep from call to call, as for a pair of particles: read, and updated on
/// success. For a particle in the plane the normal is (x, y, 0), and the boundary a line.
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
/// A setting out of range; no answer: the solver failed, or its bounds of s enclose 1 with a gap above 1e-2; a pose or
/// a normal that leaves the plane of a particle in it.
pub fn contact_with_plane(
    a: &Particle,
    pose: &Pose,
    wall: &Wall,
    settings: &Settings,
    state: Option<&mut PairState>,
) -> Result<FlatContact, DetectError> {
    settings.validate()?;
    a.refuse_slanted(pose, &wall.normal)?;
    let call = Call { particle: a, pose, normal: wall.normal, settings };
    if let Some(apart) = call.apart(&[wall.point]) {
        return Ok(apart);
    }
    let plane = PlacedPart::new(wall.part(), pose);
    let contact = call.contact(state, |search| search.on_plane(&plane))?;
    Ok(if a.is_in_plane() { contact.in_plane() } else { contact })
}

/// Contact of A at a pose with a closed triangle, which it may touch from either side; otherwise as
/// [`contact_with_plane`].
///
/// # Errors
/// A setting out of range, no answer from the solver, or a particle in the plane.
pub fn contact_with_triangle(
    a: &Particle,
    pose: &Pose,
    triangle: &Triangle,
    settings: &Settings,
    state: Option<&mut PairState>,
) -> Result<FlatContact, DetectError> {
    settings.validate()?;
    a.refuse_triangle()?;
    let call = Call { particle: a, pose, normal: triangle.normal, settings };
    if let Some(apart) = call.apart(&triangle.vertices) {
        return Ok(apart);
    }
    let plane = PlacedPart::new(triangle.inside(), pose);
    let placed = PlacedTriangle::of(triangle, pose, &Pair::on_boundary(a, &plane));
    call.contact(state, |search| search.on_triangle(triangle, &plane, &placed))
}

/// What a call is about.
#[derive(Clone, Copy)]
struct Call<'a> {
    particle: &'a Particle,
    pose: &'a Pose,
    /// Of the boundary, world frame.
    normal: Vector3<f64>,
    settings: &'a Settings,
}

impl Call<'_> {
    /// The answer if a test proves that the particle and a boundary given by these points are apart, and that will do.
    fn apart(&self, given: &[Vector3<f64>]) -> Option<FlatContact> {
        let wanted = !self.settings.solve_separated();
        let proof = wanted.then(|| separation::proof_of_separation(self.particle, self.pose, &self.normal, given));
        proof.flatten().map(|proof| FlatContact::apart(&proof))
    }

    /// Searches and describes.
    fn contact(
        &self,
        state: Option<&mut PairState>,
        closest: impl Fn(&mut Search) -> Result<Closest, DetectError>,
    ) -> Result<FlatContact, DetectError> {
        let (particle, pose, settings) = (self.particle, self.pose, self.settings);
        let remembered = state.as_ref().and_then(|state| state.remembered_on_boundary(particle));
        let flags = if remembered.is_some() { Flags::WARM } else { Flags::NONE };
        let mut search = Search { particle, pose, settings, precise: false, remembered, flags, iterations: 0 };
        let mut found = from_memory_or_anew(remembered.is_some(), |remembers| {
            search.remembered = remembered.filter(|_| remembers);
            closest(&mut search)
        })?;
        if found.is_inconclusive() {
            search.precise = true;
            found = closest(&mut search)?;
        }
        let body = search.body();
        let scale = found.scale(&body);
        if found.may_hide_an_overlap(&body) && settings.raises_regularisation() {
            // Where the bulge of a raised regularisation may hide an overlap, the particle as it is decides.
            let flat_regularisation = Settings::default().flat_regularisation;
            let settings = Settings { flat_regularisation, ..*settings };
            let contact = Call { settings: &settings, ..*self }.contact(state, closest)?;
            return Ok(FlatContact { flags: contact.flags.with(Flags::DEFAULT_REGULARISATION), ..contact });
        }
        if scale.is_undecided(settings.raises_regularisation()) {
            return Err(SolveError::Undecided { low: scale.low, high: scale.high }.into());
        }
        let contact = self.described(&body, &found, scale)?;
        let flags = contact.flags.with(search.flags);
        if let (Some(state), Some(x)) = (state, search.remembered) {
            let how = How::solved(contact.kind == Kind::Overlapping);
            state.remember(Remembered { x, lambda: 1.0, how, closest: [1.0; 2] });
        }
        Ok(FlatContact { flags, iterations: search.iterations, ..contact })
    }

    /// Point, normal and overlap; what the search has cost is not known here.
    fn described(&self, body: &Body, found: &Closest, scale: Scale) -> Result<FlatContact, DetectError> {
        let (least, position) = (&found.least, self.pose.position());
        let (normal, by_boundary) = self.normal(body, found);
        let to_boundary = least.rotation * least.from_centre();
        let contact = FlatContact {
            kind: Kind::Separated,
            feature: found.feature,
            flags: if by_boundary { Flags::NORMAL_BY_BOUNDARY } else { Flags::NONE },
            s: scale.s,
            gap: scale.gap,
            point_bound: found.point_bound(body),
            normal,
            point: position + to_boundary,
            branch: to_boundary,
            on_boundary: position + to_boundary,
            ..FlatContact::UNKNOWN
        };
        if scale.s >= 1.0 {
            return Ok(FlatContact { distance: found.distance(body), ..contact });
        }
        let overlap = self.overlap(found, &normal)?;
        let branch = to_boundary + 0.5 * overlap * normal;
        Ok(FlatContact {
            kind: Kind::Overlapping,
            overlap,
            distance: f64::NAN,
            point: position + branch,
            branch,
            on_particle: position + (to_boundary + overlap * normal),
            ..contact
        })
    }

    /// Along the gradient; inside the boundary along its normal, at an edge at right angles to that. And whether the
    /// gradient is 0 within rounding, so that the normal is ± that of the boundary.
    fn normal(&self, body: &Body, found: &Closest) -> (Vector3<f64>, bool) {
        let (least, solution) = (&found.least, &found.least.solution);
        let shift = shift_in_a(least.from_centre().norm(), least.lengths);
        let doubt = solution.slope + body.sphere_curvature() * shift;
        let mut across = solution.gradients[0];
        // What it has along the part is rounding.
        (0..least.dimensions).for_each(|i| across[i] = 0.0);
        let steep = across.norm() > doubt;
        // Without a slope that tells, from the centre to the boundary; A is in front of one through its centre.
        let side = self.normal.dot(&(least.rotation * least.from_centre()));
        let normal = match found.feature {
            _ if !steep && side > shift => self.normal,
            _ if !steep => -self.normal,
            Feature::Interior => across.z.signum() * self.normal,
            _ => direction(&(least.rotation * across)).unwrap_or(-self.normal),
        };
        (normal, !steep)
    }

    /// The way along the normal from the boundary to the surface of A.
    fn overlap(&self, found: &Closest, normal: &Vector3<f64>) -> Result<f64, DetectError> {
        let (particle, rotation) = (self.particle, self.pose.rotation());
        let from = rotation.tr_mul(&(found.least.rotation * found.least.from_centre()));
        let outwards = rotation.tr_mul(normal);
        let line = potential::on_line(particle, &particle.weights(), &from, &outwards);
        let guess = ray_cast::root_of_piece(line.value - 1.0, line.slope, line.curvature);
        let shift = shift_in_a(from.norm(), found.least.lengths);
        let near = ray_cast::distance_near(particle, &from, &outwards, guess);
        // The point is inside but for its rounding, which puts it beyond a flank of a sharp particle.
        let ahead = near.filter(|way| *way > 0.0);
        let way = ahead.or_else(|| ray_cast::distance_beside(particle, &from, &outwards, shift)).or(near);
        // Where s < 1 by rounding alone, it may be behind.
        Ok(larger(way.ok_or_else(DetectError::no_surface)?, 0.0))
    }
}

impl From<&FlatContact> for Section {
    /// Of an overlapping contact: with A in place of both particles its area is that of the cut of A alone.
    fn from(contact: &FlatContact) -> Self {
        Self { branch_a: contact.branch, branch_b: contact.branch, normal: contact.normal }
    }
}

impl FlatContact {
    /// Of a particle in the plane, whose least S on the boundary is at z = 0: what is beside it is rounding.
    fn in_plane(mut self) -> Self {
        let vectors =
            [&mut self.normal, &mut self.point, &mut self.branch, &mut self.on_boundary, &mut self.on_particle];
        vectors.into_iter().for_each(|vector| vector.z = 0.0);
        self
    }

    fn apart(proof: &Apart) -> Self {
        let flags = proof.by.with(Flags::REJECTED);
        Self { flags, s: 1.0, distance: proof.distance, ..Self::UNKNOWN }
    }
}
