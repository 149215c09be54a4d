//! Patches of the plane carried on: as those of space that lie in the plane z = 0, in which nothing changes with z.

use super::contact::checked;
use super::patch::Patch as InSpace;
use super::patch_state::{Now, PatchState};
use super::planar::{AXES, Patch, PatchPoint, patch_of_contact, raised};
use super::scratch::PatchScratch;
use super::settings::{PatchError, PatchSettings};
use crate::planar::{Contact, Particle, Pose};
use nalgebra::{Matrix3, Matrix6, Vector3};

impl PatchState {
    /// As [`crate::planar::patch_of_contact`], carried on where that is possible ([`crate::PatchFlags::CARRIED`]): a
    /// state of its own for each pair.
    ///
    /// # Errors
    /// Those of [`crate::planar::patch_of_contact`].
    #[allow(clippy::too_many_arguments)]
    pub fn patch_in_plane(
        &mut self,
        a: &Particle,
        pose_a: &Pose,
        b: &Particle,
        pose_b: &Pose,
        contact: &Contact,
        settings: &PatchSettings,
        scratch: &mut PatchScratch,
    ) -> Result<Patch, PatchError> {
        let branches = [raised(&contact.branch_a), raised(&contact.branch_b)];
        checked(contact.kind, &branches, &raised(&contact.normal), settings)?;
        let (place_a, place_b) = (pose_a.in_space(), pose_b.in_space());
        let now = Now::of_pair(
            [a.in_space(), b.in_space()],
            [&place_a, &place_b],
            [&branches[0], &branches[1]],
            (contact.formulation, contact.s),
        );
        let found = self.carried_or(&now, settings, |settings| {
            let mut reach = 0.0_f64;
            let visit = |point: PatchPoint| reach = reach.max(point.position.norm());
            let found = patch_of_contact(a, pose_a, b, pose_b, contact, settings, scratch, visit)?;
            Ok(in_space(&found, reach))
        })?;
        Ok(in_plane(&found))
    }
}

fn in_space(patch: &Patch, reach: f64) -> InSpace {
    let mut stiffness = Matrix6::zeros();
    for (i, row) in AXES.into_iter().enumerate() {
        AXES.into_iter().enumerate().for_each(|(j, column)| stiffness[(row, column)] = patch.stiffness[(i, j)]);
    }
    let mut second_moment = Matrix3::zeros();
    // A turn about z leaves it as it is.
    second_moment[(2, 2)] = patch.second_moment;
    InSpace {
        length: patch.depth_length,
        force: raised(&patch.force),
        torque: Vector3::new(0.0, 0.0, patch.torque),
        pressure_centre: raised(&patch.pressure_centre),
        branch_a: raised(&patch.branch_a),
        branch_b: raised(&patch.branch_b),
        area: patch.length,
        centroid: raised(&patch.centroid),
        second_moment,
        mean_depth: patch.mean_depth,
        largest_depth: patch.largest_depth,
        energy: patch.energy,
        stiffness,
        reach,
        error: patch.error,
        flags: patch.flags,
        points: patch.points,
        ..InSpace::default()
    }
}

fn in_plane(patch: &InSpace) -> Patch {
    Patch {
        depth_length: patch.length,
        force: patch.force.xy(),
        torque: patch.torque.z,
        pressure_centre: patch.pressure_centre.xy(),
        branch_a: patch.branch_a.xy(),
        branch_b: patch.branch_b.xy(),
        length: patch.area,
        centroid: patch.centroid.xy(),
        second_moment: patch.second_moment[(2, 2)],
        mean_depth: patch.mean_depth,
        largest_depth: patch.largest_depth,
        energy: patch.energy,
        stiffness: Matrix3::from_fn(|i, j| patch.stiffness[(AXES[i], AXES[j])]),
        error: patch.error,
        flags: patch.flags,
        points: patch.points,
    }
}
