//! What one pair keeps of its patch, from which the next ones follow as long as it hardly moves.
//!
//! With B held, force and torque are those of the last integration plus the stiffness times the motion of A since, up
//! to the square of that motion over the depth of the patch. The axes and the point of reference are held with B, so
//! that nothing else enters.

use super::contact::{checked, patch_of_contact, patch_on_plane, patch_on_triangle};
use super::numbers::{ErrorBudget, FARTHEST_CARRIED, Fitted};
use super::patch::{Patch, PatchFlags};
use super::scratch::PatchScratch;
use super::settings::{PatchError, PatchSettings};
use super::stiffness::turned;
use crate::boundary::{FlatContact, Triangle};
use crate::contact::contact::Contact;
use crate::particle::particle::Particle;
use crate::pose::Pose;
use crate::settings::Formulation;
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

/// The last patch of one ordered pair (A, B), or of a particle and a boundary, with its stiffness.
///
/// A patch follows from it without an integral while no point of the patch has moved by more than 0.3 √tolerance of its
/// largest depth since. The state is for the two particles for which it was written; of any others, patches are
/// integrated. Empty by default.
///
/// ```
/// use potential_particles::{Particle, PatchFlags, PatchScratch, PatchSettings, PatchState, Pose, Settings, detect};
/// let ball = Particle::sphere(1.0)?;
/// let left = Pose::at([0.0, 0.0, 0.0])?;
/// let (mut state, mut scratch) = (PatchState::default(), PatchScratch::new());
/// let mut carried = Vec::new();
/// for step in 0..4 {
///     let right = Pose::at([1.99 + 1e-6 * f64::from(step), 0.0, 0.0])?;
///     let contact = detect(&ball, &left, &ball, &right, &Settings::default(), None)?;
///     let settings = PatchSettings::default();
///     let patch = state.patch_of_contact(&ball, &left, &ball, &right, &contact, &settings, &mut scratch)?;
///     carried.push(patch.flags.contains(PatchFlags::CARRIED));
/// }
/// // The stiffness is computed once the pair was seen to move little.
/// assert_eq!(carried, [false, false, true, true]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
pub struct PatchState {
    /// Serial numbers of A and B, of a plane 0 and of a triangle the largest; all 0 where nothing is known.
    of: [u64; 2],
    place: Place,
    /// The tolerance that was asked for, and whether the energy was: 0 or 1.
    tolerance: f64,
    with_energy: u64,
    /// The patch in the frame of B, and the contact point there.
    patch: Patch,
    point: Vector3<f64>,
    /// Number of patches that were carried on from it.
    uses: u64,
}

/// The place of A, seen from B.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C)]
struct Place {
    /// Local frame of A to that of B, and the centre of A there.
    rotation: Matrix3<f64>,
    centre: Vector3<f64>,
    /// World axes, which serve as those of a boundary: the normal of a plane, or two edges of a triangle in an order
    /// that shows its front.
    shape: [Vector3<f64>; 2],
}

/// A pair as it is now.
struct Now<'a> {
    of: [u64; 2],
    place: Place,
    /// Local frame of B to world axes.
    axes: Matrix3<f64>,
    /// The contact point in the frame of B.
    point: Vector3<f64>,
    /// From the centres to it, world axes, and the centre of A.
    branches: [&'a Vector3<f64>; 2],
    position: &'a Vector3<f64>,
    /// s there, where it is that of midway or of a boundary.
    s: Option<f64>,
}

/// The motion of A since the patch was integrated, in the frame of B.
struct Motion {
    /// Shift and turn about the contact point of that time.
    screw: Vector6<f64>,
    /// The largest shift of a point of the patch, and what the boundary has changed its shape by, over the largest
    /// depth.
    size: f64,
    change: f64,
}

impl PatchState {
    /// As [`patch_of_contact`], carried on where that is possible ([`PatchFlags::CARRIED`]).
    ///
    /// # Errors
    /// Those of [`patch_of_contact`].
    #[allow(clippy::too_many_arguments)]
    pub fn patch_of_contact(
        &mut self,
        a: &Particle,
        pose_a: &Pose,
        b: &Particle,
        pose_b: &Pose,
        contact: &Contact,
        settings: &PatchSettings,
        scratch: &mut PatchScratch,
    ) -> Result<Patch, PatchError> {
        Particle::refuse_mixed((a, pose_a), (b, pose_b))?;
        checked(a, contact.kind, &[contact.branch_a, contact.branch_b], &contact.normal, settings)?;
        let now = Now::of_pair(
            [a, b],
            [pose_a, pose_b],
            [&contact.branch_a, &contact.branch_b],
            (contact.formulation, contact.s),
        );
        self.carried_or(&now, settings, |settings| {
            patch_of_contact(a, pose_a, b, pose_b, contact, settings, scratch, |_| ())
        })
    }

    /// As [`patch_on_plane`], carried on where that is possible.
    ///
    /// # Errors
    /// Those of [`patch_on_plane`].
    pub fn patch_on_plane(
        &mut self,
        a: &Particle,
        pose: &Pose,
        contact: &FlatContact,
        settings: &PatchSettings,
        scratch: &mut PatchScratch,
    ) -> Result<Patch, PatchError> {
        // A plane is the same wherever A slides to: its origin is the foot of A's centre.
        let branch = contact.on_boundary - pose.position();
        let centre = -branch.dot(&contact.normal) * contact.normal;
        let shape = [contact.normal, Vector3::zeros()];
        let now = Now::on_boundary(a, pose, centre, shape, &branch, contact, settings)?;
        self.carried_or(&now, settings, |settings| patch_on_plane(a, pose, contact, settings, scratch, |_| ()))
    }

    /// As [`patch_on_triangle`], carried on where that is possible.
    ///
    /// # Errors
    /// Those of [`patch_on_triangle`].
    #[allow(clippy::too_many_arguments)]
    pub fn patch_on_triangle(
        &mut self,
        a: &Particle,
        pose: &Pose,
        triangle: &Triangle,
        from_front: bool,
        contact: &FlatContact,
        settings: &PatchSettings,
        scratch: &mut PatchScratch,
    ) -> Result<Patch, PatchError> {
        let [first, second, third] = triangle.vertices();
        let edges = [second - first, third - first];
        let shape = if from_front { edges } else { [edges[1], edges[0]] };
        let branch = contact.on_boundary - pose.position();
        let now = Now::on_boundary(a, pose, pose.position() - first, shape, &branch, contact, settings)?;
        self.carried_or(&now, settings, |settings| {
            patch_on_triangle(a, pose, triangle, from_front, contact, settings, scratch, |_| ())
        })
    }

    /// The patch by its stiffness, or by the integral, which is kept.
    fn carried_or(
        &mut self,
        now: &Now,
        settings: &PatchSettings,
        integrate: impl FnOnce(&PatchSettings) -> Result<Patch, PatchError>,
    ) -> Result<Patch, PatchError> {
        let with_energy = u64::from(settings.with_energy);
        let known = self.of == now.of && self.tolerance == settings.tolerance && self.with_energy == with_energy;
        let motion = if known { Some(self.motion(&now.place)) } else { None };
        let near = motion.filter(|motion| motion.is_small(settings.tolerance));
        if let Some(motion) = near.as_ref().filter(|_| self.patch.stiffness[(0, 0)].is_finite()) {
            self.uses += 1;
            return Ok(self.carried(now, motion));
        }
        // The stiffness takes time: it is computed for pairs whose steps are small.
        let with_stiffness = settings.with_stiffness || near.is_some() || known && self.uses > 0;
        let mut patch = integrate(&PatchSettings { with_stiffness, ..*settings })?;
        *self = Self {
            of: now.of,
            place: now.place,
            tolerance: settings.tolerance,
            with_energy,
            patch: now.seen_from_b(&patch),
            point: now.point,
            uses: 0,
        };
        let uncertain = [PatchFlags::EMPTY, PatchFlags::FOLDED, PatchFlags::DEEP];
        if uncertain.iter().any(|flag| patch.flags.contains(*flag)) {
            self.patch.stiffness.fill(f64::NAN);
        }
        if !settings.with_stiffness {
            patch.stiffness.fill(f64::NAN);
        }
        Ok(patch)
    }

    fn motion(&self, now: &Place) -> Motion {
        let turn = now.rotation * self.place.rotation.transpose();
        let away = self.point - self.place.centre;
        let shift = (now.centre - self.place.centre) + (turn * away - away);
        let about = 0.5 * Vector3::new(turn.m32 - turn.m23, turn.m13 - turn.m31, turn.m21 - turn.m12);
        // 2 sin(θ/2) of the turn by θ: the sine above is 0 of half a turn, too.
        let turned = (turn - Matrix3::identity()).norm() * std::f64::consts::FRAC_1_SQRT_2;
        let change = [0, 1].map(|i| (now.shape[i] - self.place.shape[i]).norm());
        let depth = self.patch.largest_depth;
        // A plane has a normal, whose change turns the whole patch.
        let arm = if self.place.shape[1] == Vector3::zeros() { self.patch.reach } else { 1.0 };
        Motion {
            screw: Vector6::new(shift.x, shift.y, shift.z, about.x, about.y, about.z),
            size: (shift.norm() + turned * self.patch.reach) / depth,
            change: arm * change[0].max(change[1]) / depth,
        }
    }

    /// The patch after a small motion of A. Area and moments go along with B as they are, within the error of the area.
    fn carried(&self, now: &Now, motion: &Motion) -> Patch {
        let Self { patch, point, .. } = self;
        let change = patch.stiffness * motion.screw;
        let force = patch.force + change.fixed_rows::<3>(0);
        let about_point = patch.torque + change.fixed_rows::<3>(3);
        // The point of the axis of the wrench that is nearest to the contact point, moved to the height of the patch.
        let (square, size) = (force.norm_squared(), force.norm());
        let foot = point + force.cross(&about_point) / square;
        let centre = foot + force * (force.dot(&(patch.pressure_centre - foot)) / square);
        let work = Vector6::from_iterator(patch.force.iter().chain(patch.torque.iter()).copied()) + 0.5 * change;
        let world = |v: &Vector3<f64>| now.axes * v;
        let branch = world(&(centre - now.point));
        let mut flags = patch.flags;
        flags.set(PatchFlags::CARRIED, true);
        Patch {
            force: world(&force),
            torque: world(&(about_point + (point - now.point).cross(&force))),
            pressure_centre: now.position + (now.branches[0] + branch),
            branch_a: now.branches[0] + branch,
            branch_b: now.branches[1] + branch,
            couple: about_point.dot(&force) / size,
            centroid: world(&(patch.pressure_centre + patch.centroid - centre)),
            second_moment: now.axes * patch.second_moment * now.axes.transpose(),
            mean_depth: patch.mean_depth * (size / patch.force.norm()),
            // With the formulation closest, s is not that of the point.
            largest_depth: now.s.map_or(patch.largest_depth, |s| (patch.length * (1.0 - s)).max(0.0)),
            energy: patch.energy + work.dot(&motion.screw),
            stiffness: Matrix6::repeat(f64::NAN),
            // The stiffness is summed at points that are meant for the force: it is known to about the root of the
            // tolerance.
            error: patch.error
                + (Fitted::CARRIED_FORCE * motion.size + self.tolerance.sqrt()) * motion.size
                + motion.change,
            area_error: patch.area_error + Fitted::CARRIED_AREA * motion.size,
            flags,
            points: 0,
            rays: 0,
            ..*patch
        }
    }
}

impl Motion {
    /// At a depth of 0 no motion is small: the quotient is infinite or NaN.
    fn is_small(&self, tolerance: f64) -> bool {
        self.size <= FARTHEST_CARRIED * tolerance.sqrt() && self.change <= ErrorBudget::MINOR * tolerance
    }
}

impl<'a> Now<'a> {
    /// Two particles, and the branches from their centres to the contact point.
    fn of_pair(
        [a, b]: [&Particle; 2],
        [pose_a, pose_b]: [&'a Pose; 2],
        branches: [&'a Vector3<f64>; 2],
        (formulation, s): (Formulation, f64),
    ) -> Self {
        let s = (formulation == Formulation::Midway).then_some(s);
        let axes = *pose_b.rotation();
        let place = Place {
            rotation: axes.tr_mul(pose_a.rotation()),
            centre: axes.tr_mul(&(pose_a.position() - pose_b.position())),
            shape: Default::default(),
        };
        let point = axes.tr_mul(branches[1]);
        Self { of: [a.serial(), b.serial()], place, axes, point, branches, position: pose_a.position(), s }
    }

    /// A particle and a boundary: with world axes, A's centre in its frame and what tells its shape.
    fn on_boundary(
        a: &Particle,
        pose: &'a Pose,
        centre: Vector3<f64>,
        shape: [Vector3<f64>; 2],
        branch: &'a Vector3<f64>,
        contact: &FlatContact,
        settings: &PatchSettings,
    ) -> Result<Self, PatchError> {
        checked(a, contact.kind, &[*branch], &contact.normal, settings)?;
        // Serial numbers of no particle: one of planes, one of triangles.
        let boundary = if shape[1] == Vector3::zeros() { 0 } else { u64::MAX };
        Ok(Self {
            of: [a.serial(), boundary],
            place: Place { rotation: *pose.rotation(), centre, shape },
            axes: Matrix3::identity(),
            point: centre + branch,
            branches: [branch; 2],
            position: pose.position(),
            s: Some(contact.s),
        })
    }

    /// A patch in the axes of B, with the centre of pressure in its frame.
    fn seen_from_b(&self, patch: &Patch) -> Patch {
        let local = |v: &Vector3<f64>| self.axes.tr_mul(v);
        Patch {
            force: local(&patch.force),
            torque: local(&patch.torque),
            pressure_centre: self.point + local(&(patch.branch_b - self.branches[1])),
            centroid: local(&patch.centroid),
            second_moment: self.axes.tr_mul(&patch.second_moment) * self.axes,
            stiffness: turned(&patch.stiffness, &self.axes.transpose()),
            ..*patch
        }
    }
}
