//! A plane or a triangle, and particles that rest on it.

use crate::patch::bodies::Chance;
use nalgebra::Matrix3;
use potential_particles::{
    FlatContact, Kind, Particle, Patch, PatchScratch, PatchSettings, PatchState, Pose, Settings, Triangle, Wall,
    contact_with_plane, contact_with_triangle, patch_on_plane, patch_on_triangle,
};
use std::f64::consts::TAU;

#[derive(Clone, Copy, Debug)]
pub enum Boundary {
    Plane(Wall),
    /// Pressed from its front.
    Triangle(Triangle),
}

impl Boundary {
    /// `None` where they are separated.
    pub fn contact(&self, a: &Particle, pose: &Pose) -> Option<FlatContact> {
        let contact = match self {
            Self::Plane(wall) => contact_with_plane(a, pose, wall, &Settings::default(), None),
            Self::Triangle(triangle) => contact_with_triangle(a, pose, triangle, &Settings::default(), None),
        };
        contact.ok().filter(|contact| contact.kind == Kind::Overlapping)
    }

    pub fn patch(&self, a: &Particle, pose: &Pose, settings: &PatchSettings) -> Option<Patch> {
        let (contact, mut scratch) = (self.contact(a, pose)?, PatchScratch::new());
        let patch = match self {
            Self::Plane(_) => patch_on_plane(a, pose, &contact, settings, &mut scratch, |_| ()),
            Self::Triangle(triangle) => {
                patch_on_triangle(a, pose, triangle, true, &contact, settings, &mut scratch, |_| ())
            }
        };
        Some(patch.unwrap())
    }

    pub fn carried(
        &self,
        a: &Particle,
        pose: &Pose,
        settings: &PatchSettings,
        state: &mut PatchState,
    ) -> Option<Patch> {
        let (contact, scratch) = (self.contact(a, pose)?, &mut PatchScratch::new());
        let patch = match self {
            Self::Plane(_) => state.patch_on_plane(a, pose, &contact, settings, scratch),
            Self::Triangle(triangle) => state.patch_on_triangle(a, pose, triangle, true, &contact, settings, scratch),
        };
        Some(patch.unwrap())
    }
}

/// The pose, turned like this, in which a particle is this deep in the plane z = 0.
pub fn resting(a: &Particle, turn: &Matrix3<f64>, overlap: f64) -> Pose {
    let floor = Boundary::Plane(Wall::new([0.0; 3], [0.0, 0.0, 1.0]).unwrap());
    let at = |height: f64| Pose::from_rotation([0.01, 0.02, height], turn).unwrap();
    let (mut deep, mut apart) = (0.0, 1.1 * a.bounding_radius());
    for _ in 0..60 {
        let middle = 0.5 * (deep + apart);
        if floor.contact(a, &at(middle)).is_some() { deep = middle } else { apart = middle }
    }
    at(deep - overlap)
}

/// A triangle of the plane z = 0, of 0.3 to 100 times the patch of a particle there, whose border mostly crosses it.
pub fn triangle_over(a: &Particle, pose: &Pose, chance: &mut Chance) -> Option<[[f64; 3]; 3]> {
    let floor = Boundary::Plane(Wall::new([0.0; 3], [0.0, 0.0, 1.0]).unwrap());
    let whole = floor.patch(a, pose, &PatchSettings::default())?;
    let (at, size) = (whole.pressure_centre, whole.area.sqrt());
    let scale = size * chance.pick(&[0.3, 1.0, 3.0, 100.0]);
    let (angle, shift) = (TAU * chance.uniform(), [0; 2].map(|_| size * (chance.uniform() - 0.5)));
    let corners = [(0.0_f64, 1.0), (2.0, 3.0), (4.3, 3.0)].map(|(turn, way)| {
        let (sin, cos) = (angle + turn).sin_cos();
        [at.x + shift[0] + scale * way * cos, at.y + shift[1] + scale * way * sin, 0.0]
    });
    (size > 0.0).then_some(corners)
}
