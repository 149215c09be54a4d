//! The scene of a rock mass: blocks by their volumes, contacts by the faces that lie on each other.

use super::scene::{Body, Contact, Scene};
use crate::rock::{Interface, RockMass};
use nalgebra::Vector3;

/// Strength of a joint.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointStrength {
    /// Coefficient of friction tan φ.
    pub friction: f64,
    /// Cohesion, a stress.
    pub cohesion: f64,
    /// Tensile strength, a stress.
    pub tension: f64,
}

impl Scene {
    /// The blocks of a rock mass under their weight. `held`: whether the block of this index is held; `strength`: of
    /// the joint at an interface; `unit_weight`: weight of a unit of volume, with the direction of gravity.
    ///
    /// Each block is a body of its own, also where a region divides a block.
    pub fn of_rock(
        mass: &RockMass,
        unit_weight: Vector3<f64>,
        held: impl Fn(usize) -> bool,
        strength: impl Fn(&Interface) -> JointStrength,
    ) -> Self {
        let body = |(index, block): (usize, &crate::rock::Block)| Body {
            held: held(index),
            ..Body::free(block.centroid, block.volume * unit_weight)
        };
        let contact = |interface: Interface| {
            let JointStrength { friction, cohesion, tension } = strength(&interface);
            let bodies = interface.faces.map(|[block, _]| block);
            let [block, face] = interface.faces[0];
            let normal = mass.blocks[block].faces[face].plane.normal;
            let (area, corners) = (interface.area, interface.corners);
            Contact { area, cohesion, tension, ..Contact::new(bodies, corners, normal, friction) }
        };
        let bodies = mass.blocks.iter().enumerate().map(body).collect();
        Self { bodies, contacts: mass.interfaces().into_iter().map(contact).collect() }
    }
}
