//! What is answered: forces, checked again from the scene, and the motion at the limit.

use super::assembly::{Assembly, Joint, Point, largest};
use super::scene::Velocity;
use nalgebra::Vector3;

/// Forces in equilibrium, and the motion at the limit.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Equilibrium {
    /// Whether the scene comes to rest under its dead loads; of a factor: whether there is one, however small.
    pub stands: bool,
    /// Whether any forces within the strength hold it, where joints open by tan φ times their slip: the associated
    /// answer. Where it is false, nothing can hold the scene.
    pub may_stand: bool,
    /// The load factor or the factor of safety; 0 where nothing stands, and in [`stands()`](super::stands).
    pub factor: f64,
    /// The associated factor, which no state of equilibrium exceeds; infinite where it has no limit, NaN where its
    /// program has no answer, and 0 in [`stands()`](super::stands).
    pub bound: f64,
    /// Force on the second body at each corner, contact after contact, in the axes of the scene; empty where nothing
    /// stands.
    pub forces: Vec<Vector3<f64>>,
    /// Force of each contact; empty where nothing stands.
    pub contacts: Vec<ContactForce>,
    /// Velocity of each body in the mechanism, the fastest at 1; empty in [`stands()`](super::stands) of a scene that
    /// does.
    pub mechanism: Vec<Velocity>,
    /// The largest force, or torque over the size of the body, that is left on a body, over the mean load of one.
    pub unbalanced: f64,
    /// The largest friction beyond its strength at a point, over the mean load of a body.
    pub excess: f64,
    /// The largest force of a contact over the mean load of a body: far above the number of bodies that load it, blocks
    /// clamp each other.
    pub largest: f64,
    /// Number of matrices that were factorised, or of cone programs for the associated answer.
    pub solves: u32,
}

/// What multiplies the live loads and the strength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Demand {
    pub live: f64,
    pub strength: f64,
}

impl Demand {
    /// The loads that are there, with the strength that is given.
    pub const GIVEN: Self = Self { live: 0.0, strength: 1.0 };
}

impl Equilibrium {
    /// Forces at the points of an assembly, judged anew.
    pub(super) fn standing(assembly: &Assembly, forces: &[Vector3<f64>], at: Demand, solves: u32) -> Self {
        let left = assembly.left(forces.iter().copied(), at.live).0;
        let beyond =
            |((_, point), f): ((_, &Point), &Vector3<f64>)| f.y.hypot(f.z) - point.strength.most(f.x, at.strength);
        let mut contacts = vec![ContactForce::default(); assembly.contact_count];
        for joint in &assembly.joints {
            contacts[joint.contact] = ContactForce::of(assembly, joint, forces);
        }
        Self {
            stands: true,
            may_stand: true,
            forces: assembly.forces(forces),
            unbalanced: left.chunks(6).map(largest).fold(0.0, f64::max),
            excess: assembly.each_point().zip(forces).map(beyond).fold(0.0, f64::max),
            largest: contacts.iter().map(|of| of.normal.hypot(of.shear)).fold(0.0, f64::max) / assembly.unit,
            contacts,
            solves,
            ..Self::default()
        }
    }

    /// The motion of a scene that nothing was found to hold.
    pub(super) fn falling(assembly: &Assembly, velocities: &[f64], solves: u32) -> Self {
        Self { mechanism: assembly.velocities(velocities), solves, ..Self::default() }
    }
}

/// The force of a contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ContactForce {
    /// Along the normal; pressing is positive.
    pub normal: f64,
    /// Size across it.
    pub shear: f64,
    /// `shear` over μ n + c A with the strength of the scene: at a factor of safety F it reaches 1/F. 0 where nothing
    /// slides.
    pub used: f64,
}

impl ContactForce {
    fn of(assembly: &Assembly, joint: &Joint, forces: &[Vector3<f64>]) -> Self {
        let total: Vector3<f64> = forces[joint.points.clone()].iter().sum();
        let shear = total.y.hypot(total.z);
        let points = &assembly.points[joint.points.clone()];
        let friction = points.first().map_or(0.0, |point| point.strength.friction);
        let cohesion: f64 = points.iter().map(|point| point.strength.cohesion).sum();
        let most = (friction * total.x + cohesion).max(0.0);
        let used = if shear > 0.0 { shear / most } else { 0.0 };
        Self { normal: assembly.unit * total.x, shear: assembly.unit * shear, used }
    }
}
