//! The patch of two particles of the plane: a curve, walked over to both sides of the contact point.

use super::centre::on_patch;
use super::contact::{NEAR, checked, least_sphericity};
use super::field::{Field, Placed};
use super::patch::PatchFlags;
use super::ray::{Line, Node, Ray, SUMS, Walker};
use super::rules::order_of;
use super::scratch::PatchScratch;
use super::settings::{PatchError, PatchSettings};
use super::stiffness::{stiffness, turned};
use crate::planar::{Contact, Particle, Pose};
use nalgebra::{Matrix3, Vector2, Vector3};

/// Places of shifts along x and y and of the turn about z among shifts and turns of space.
pub(super) const AXES: [usize; 3] = [0, 1, 5];

/// The contact patch of two particles of the plane: as [`crate::Patch`], with lengths in place of areas. All per unit
/// of thickness.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Patch {
    /// ℓ = ℓ_A + ℓ_B, length.
    pub depth_length: f64,
    /// ∫ p n dΣ / K, the force on B over K, length².
    pub force: Vector2<f64>,
    /// Torque on B about the contact point over K, anticlockwise, length³.
    pub torque: f64,
    /// Where the line of action of the force meets the patch: its middle height along the force. World frame.
    pub pressure_centre: Vector2<f64>,
    /// The same minus position of A.
    pub branch_a: Vector2<f64>,
    /// The same minus position of B.
    pub branch_b: Vector2<f64>,
    /// Length of Σ.
    pub length: f64,
    /// Centroid of Σ minus the centre of pressure.
    pub centroid: Vector2<f64>,
    /// ∫ |y|² dΣ, y from the centroid, length³.
    pub second_moment: f64,
    /// ∫ p dΣ / (K·length): the mean overlap.
    pub mean_depth: f64,
    /// Largest ℓ (1 − s), that of the contact point.
    pub largest_depth: f64,
    /// Elastic energy over K, length³; NaN unless it was asked for.
    pub energy: f64,
    /// Change of force and torque about the contact point, over K, with a shift and a turn of A, as
    /// [`crate::Patch::stiffness`]: rows and columns x, y and angle; world frame. NaN unless it was asked for.
    pub stiffness: Matrix3<f64>,
    /// Estimated error of the force over its size.
    pub error: f64,
    /// What else is to be known.
    pub flags: PatchFlags,
    /// Number of points of quadrature.
    pub points: usize,
}

/// A point of quadrature on a patch of the plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
pub struct PatchPoint {
    /// Its place minus the contact point, world axes.
    pub position: Vector2<f64>,
    /// Its share of the length.
    pub length: f64,
    /// p/K = depth_length (1 - s) there, length.
    pub depth: f64,
    /// Unit normal of the patch, from A to B, world axes.
    pub normal: Vector2<f64>,
}

/// The patch of an overlapping contact of two particles of the plane; `visit` is called with each point of quadrature.
///
/// ```
/// use potential_particles::planar::{Particle, Pose, detect, patch_of_contact};
/// use potential_particles::{PatchScratch, PatchSettings};
/// let square = Particle::rectangle(1.0, 1.0, 1e-4, 0.0)?;
/// let (lower, upper) = (Pose::new([0.0, 0.0], 0.0)?, Pose::new([0.2, 1.0 - 1e-6], 0.0)?);
/// let contact = detect(&square, &lower, &square, &upper, &Default::default(), None)?;
/// let (settings, scratch) = (PatchSettings::default(), &mut PatchScratch::new());
/// let patch = patch_of_contact(&square, &lower, &square, &upper, &contact, &settings, scratch, |_| ())?;
/// // Two faces that share 0.8, 1e-6 deep.
/// assert!((patch.force.y / 0.8e-6 - 1.0).abs() < 1e-3);
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
    mut visit: impl FnMut(PatchPoint),
) -> Result<Patch, PatchError> {
    let branches = [raised(&contact.branch_a), raised(&contact.branch_b)];
    let normal = checked(contact.kind, &branches, &raised(&contact.normal), settings)?.column(2).into_owned();
    let frame = Matrix3::from_columns(&[Vector3::z().cross(&normal), Vector3::z(), normal]);
    let (least, mut flags) = least_sphericity(contact.s);
    let PatchScratch { planes, ray_planes, nodes, .. } = scratch;
    let bodies = (
        Placed::new(a.in_space(), &pose_a.in_space(), &branches[0], &frame, least),
        Placed::new(b.in_space(), &pose_b.in_space(), &branches[1], &frame, least),
    );
    let mut field = Field::new(bodies.0, Some(bodies.1), &[], NEAR * contact.overlap, planes);
    field.is_planar = true;
    let start = on_patch(&mut field, 0.0, 0.0, 0.0).unwrap_or_default();
    let deepest = field.values(&start)[0].0;
    let rounding = field.rounding(deepest);
    let tolerance = settings.above(rounding);
    let mut walker = Walker::new(&mut field, ray_planes, nodes, order_of(tolerance));
    walker.with_energy = settings.with_energy;
    let mut rays = both_sides(&mut walker, start);
    // A quarter of the tolerance for each rule, now that the force is known roughly.
    walker.budget = 0.25 * tolerance * rays.iter().map(|ray| ray.sums[2]).sum::<f64>();
    if rays.iter().any(|ray| ray.error > walker.budget) {
        rays = both_sides(&mut walker, start);
    }
    let depth_length = a.depth_length() + b.depth_length();
    let sums: [f64; SUMS] = std::array::from_fn(|i| rays[0].sums[i] + rays[1].sums[i]);
    let (mut force, mut torque, mut length, mut first, mut load, mut loaded) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    let (mut first_up, mut loaded_up, mut force_u) = (0.0, 0.0, 0.0);
    for Node { x: [u, _, z], weight, pressure, normal: [n, _] } in walker.nodes.iter() {
        let share = weight.abs() * n.hypot(1.0);
        (force, force_u) = (force + weight * pressure, force_u + weight * pressure * n);
        torque += weight * pressure * (z * n - u);
        (length, first, first_up) = (length + share, first + share * u, first_up + share * z);
        (load, loaded, loaded_up) =
            (load + share * pressure, loaded + share * pressure * u, loaded_up + share * pressure * z);
    }
    let size = force.hypot(force_u);
    flags.set(PatchFlags::EMPTY, !(size > 0.0));
    flags.set(PatchFlags::FOLDED, rays.iter().any(|ray| ray.is_folded || ray.turns_back));
    let whole = size > 0.0;
    let error = if whole { ((rays[0].error + rays[1].error) / size).max(rounding) } else { 0.0 };
    flags.set(PatchFlags::TOLERANCE_NOT_REACHED, error > settings.tolerance);
    let (mut pole, mut centroid, mut second) = ([0.0; 2], [0.0; 2], 0.0);
    if whole {
        // A point of the line of action, and from there to the height of the middle of the load.
        let axis = [force_u / size, force / size];
        let off = -torque / size;
        let foot = [off * axis[1], -off * axis[0]];
        let along = axis[0] * (loaded / load - foot[0]) + axis[1] * (loaded_up / load - foot[1]);
        pole = [foot[0] + along * axis[0], foot[1] + along * axis[1]];
        centroid = [first / length, first_up / length];
        for Node { x: [u, _, z], weight, normal: [n, _], .. } in walker.nodes.iter() {
            second += weight.abs() * n.hypot(1.0) * ((u - centroid[0]).powi(2) + (z - centroid[1]).powi(2));
        }
    }
    let world = |[u, z]: [f64; 2]| (frame * Vector3::new(u, 0.0, z)).xy();
    for Node { x: [u, _, z], weight, pressure, normal: [n, _] } in walker.nodes.iter() {
        let stretch = n.hypot(1.0).copysign(*weight);
        visit(PatchPoint {
            position: world([*u, *z]),
            length: weight * stretch,
            depth: depth_length * pressure,
            normal: world([n / stretch, 1.0 / stretch]),
        });
    }
    let branch = world(pole);
    Ok(Patch {
        depth_length,
        force: depth_length * world([force_u, force]),
        torque: depth_length * torque,
        pressure_centre: pose_a.position() + (contact.branch_a + branch),
        branch_a: contact.branch_a + branch,
        branch_b: contact.branch_b + branch,
        length,
        centroid: world([centroid[0] - pole[0], centroid[1] - pole[1]]),
        second_moment: second,
        mean_depth: if whole { depth_length * load / length } else { 0.0 },
        largest_depth: (depth_length * (1.0 - deepest.max(0.0).sqrt())).max(0.0),
        energy: if settings.with_energy { depth_length * sums[7] } else { f64::NAN },
        stiffness: if settings.with_stiffness {
            let of_space = turned(&stiffness(walker.field, walker.nodes), &frame);
            Matrix3::from_fn(|i, j| depth_length * of_space[(AXES[i], AXES[j])])
        } else {
            Matrix3::repeat(f64::NAN)
        },
        error,
        flags,
        points: walker.nodes.len(),
    })
}

fn both_sides(walker: &mut Walker, origin: [f64; 3]) -> [Ray; 2] {
    walker.nodes.clear();
    [1.0, -1.0].map(|sign| walker.walk(&Line { origin, direction: [sign, 0.0], is_polar: false }))
}

/// Into the plane z = 0 of space.
pub(super) fn raised(v: &Vector2<f64>) -> Vector3<f64> {
    Vector3::new(v.x, v.y, 0.0)
}
