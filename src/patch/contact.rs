//! The patch of two particles, of a particle and a plane, and of a particle and a triangle.

use super::field::{FramePlane, Owner, Placed};
use super::integration::{Task, patch};
use super::numbers::{COARSEST, DEEP, DEEP_SPHERICITY, FINEST, NEARBY};
use super::patch::{Patch, PatchFlags, PatchPoint};
use super::scratch::PatchScratch;
use super::settings::{PatchError, PatchSettings};
use crate::boundary::{FlatContact, Triangle};
use crate::contact::contact::{Contact, Kind};
use crate::particle::particle::Particle;
use crate::pose::Pose;
use nalgebra::{Matrix3, Vector3};

/// The patch of an overlapping contact of midway (of closest, its point and normal will do) of A with B.
///
/// `visit` is called with each point of quadrature; their sums over area · depth · normal and so on are those of the
/// answer. Of particles in the plane the patch is a curve, and areas are lengths: all is per unit of depth.
///
/// ```
/// use potential_particles::{Particle, PatchScratch, PatchSettings, Pose, Settings, detect, patch_of_contact};
/// let ball = Particle::sphere(1.0)?;
/// let (left, right) = (Pose::at([0.0, 0.0, 0.0])?, Pose::at([1.99, 0.0, 0.0])?);
/// let contact = detect(&ball, &left, &ball, &right, &Settings::default(), None)?;
/// let mut scratch = PatchScratch::new();
/// let settings = PatchSettings::default();
/// let patch = patch_of_contact(&ball, &left, &ball, &right, &contact, &settings, &mut scratch, |_| ())?;
/// // K times the volume of a paraboloid, for small overlaps: π R' δ² with 1/R' = 1/R_A + 1/R_B.
/// let volume = std::f64::consts::PI * 0.5 * 0.01_f64.powi(2);
/// assert!((patch.force.x / volume - 1.0).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// A tolerance out of range, a separated contact, or one without a finite point and normal.
#[allow(clippy::too_many_arguments)]
pub fn patch_of_contact(
    a: &Particle,
    pose_a: &Pose,
    b: &Particle,
    pose_b: &Pose,
    contact: &Contact,
    settings: &PatchSettings,
    scratch: &mut PatchScratch,
    visit: impl FnMut(PatchPoint),
) -> Result<Patch, PatchError> {
    Particle::refuse_mixed((a, pose_a), (b, pose_b))?;
    let frame = checked(a, contact.kind, &[contact.branch_a, contact.branch_b], &contact.normal, settings)?;
    let (least, flags) = least_sphericity(contact.s);
    let task = Task {
        a: Placed::new(a, pose_a, &contact.branch_a, &frame, least),
        b: Some(Placed::new(b, pose_b, &contact.branch_b, &frame, least)),
        edges: &[],
        inside: None,
        frame,
        length: a.depth_length() + b.depth_length(),
        branches: [contact.branch_a, contact.branch_b],
        position: *pose_a.position(),
        near: NEARBY * contact.overlap,
        settings: *settings,
        flags,
    };
    Ok(patch(&task, scratch, visit))
}

/// The patch of an overlapping contact of A with a plane: the part of the plane inside A.
///
/// The normal is that of the contact, from A to the plane.
///
/// # Errors
/// Those of [`patch_of_contact`].
pub fn patch_on_plane(
    a: &Particle,
    pose: &Pose,
    contact: &FlatContact,
    settings: &PatchSettings,
    scratch: &mut PatchScratch,
    visit: impl FnMut(PatchPoint),
) -> Result<Patch, PatchError> {
    let branch = contact.on_boundary - pose.position();
    on_boundary(a, pose, (&branch, &contact.normal), (&[], None), contact, settings, scratch, visit)
}

/// The patch of an overlapping contact of A with a triangle: the part of the triangle inside A.
///
/// The normal is that of the triangle, pointing away from A. If `from_front`, A is on the front, where the vertices run
/// counter-clockwise: the outside of the mesh of a closed body. Patches of coplanar triangles add up to that of the
/// slab, and those of a closed mesh to force, torque and energy of the mesh.
///
/// # Errors
/// Those of [`patch_of_contact`].
#[allow(clippy::too_many_arguments)]
pub fn patch_on_triangle(
    a: &Particle,
    pose: &Pose,
    triangle: &Triangle,
    from_front: bool,
    contact: &FlatContact,
    settings: &PatchSettings,
    scratch: &mut PatchScratch,
    visit: impl FnMut(PatchPoint),
) -> Result<Patch, PatchError> {
    let normal = if from_front { -triangle.normal() } else { *triangle.normal() };
    a.refuse_triangle()?;
    let branch = contact.on_boundary - pose.position();
    let frame = checked(a, contact.kind, &[branch], &normal, settings)?;
    let corners = triangle.vertices().map(|vertex| frame.tr_mul(&((vertex - pose.position()) - branch)));
    // Counter-clockwise in the frame.
    let turned = if from_front { [0, 2, 1] } else { [0, 1, 2] };
    let edges = [0, 1, 2].map(|i| {
        let (from, to) = (corners[turned[i]], corners[turned[(i + 1) % 3]]);
        let along = (to - from).xy().normalize();
        let outwards = [along.y, -along.x, 0.0];
        FramePlane { normal: outwards, excess: -(outwards[0] * from.x + outwards[1] * from.y), owner: Owner::Edge }
    });
    let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    on_boundary(a, pose, (&branch, &normal), (&edges, Some([middle.x, middle.y])), contact, settings, scratch, visit)
}

#[allow(clippy::too_many_arguments)]
fn on_boundary(
    a: &Particle,
    pose: &Pose,
    (branch, normal): (&Vector3<f64>, &Vector3<f64>),
    (edges, inside): (&[FramePlane], Option<[f64; 2]>),
    contact: &FlatContact,
    settings: &PatchSettings,
    scratch: &mut PatchScratch,
    visit: impl FnMut(PatchPoint),
) -> Result<Patch, PatchError> {
    let frame = checked(a, contact.kind, &[*branch], normal, settings)?;
    a.refuse_slanted(pose, normal)?;
    let (least, flags) = least_sphericity(contact.s);
    let task = Task {
        a: Placed::new(a, pose, branch, &frame, least),
        b: None,
        edges,
        inside,
        frame,
        length: a.depth_length(),
        branches: [*branch; 2],
        position: *pose.position(),
        near: NEARBY * contact.overlap,
        settings: *settings,
        flags,
    };
    Ok(patch(&task, scratch, visit))
}

/// The sphericity to which smaller ones are raised, and the flag if it is above 0.
fn least_sphericity(s: f64) -> (f64, PatchFlags) {
    let mut flags = PatchFlags::default();
    flags.set(PatchFlags::DEEP, s < DEEP);
    (if s < DEEP { DEEP_SPHERICITY } else { 0.0 }, flags)
}

/// The frame of the patch, columns u, v, normal; in the plane v is its axis.
pub(super) fn checked(
    a: &Particle,
    kind: Kind,
    branches: &[Vector3<f64>],
    normal: &Vector3<f64>,
    settings: &PatchSettings,
) -> Result<Matrix3<f64>, PatchError> {
    if !(FINEST..=COARSEST).contains(&settings.tolerance) {
        return Err(PatchError::Tolerance(settings.tolerance));
    }
    if kind == Kind::Separated {
        return Err(PatchError::Separated);
    }
    if !branches.iter().chain([normal]).flat_map(|v| v.iter()).all(|c| c.is_finite()) {
        return Err(PatchError::NotFinite);
    }
    let normal = normal.try_normalize(0.0).ok_or(PatchError::NotFinite)?;
    if a.is_in_plane() {
        let in_plane = branches.iter().chain([&normal]).all(|vector| vector.z == 0.0);
        let frame = Matrix3::from_columns(&[Vector3::z().cross(&normal), Vector3::z(), normal]);
        return if in_plane { Ok(frame) } else { Err(PatchError::NotFinite) };
    }
    let first = normal.cross(&Vector3::ith(normal.iamin(), 1.0)).try_normalize(0.0).ok_or(PatchError::NotFinite)?;
    Ok(Matrix3::from_columns(&[first, normal.cross(&first), normal]))
}
