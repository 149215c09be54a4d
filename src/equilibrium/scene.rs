//! What is asked about: bodies, their contacts, their loads.

use super::error::EquilibriumError;
use super::numbers::{A_POINT, MOST_FRICTION, MOST_LEAN, STRAIGHT};
use nalgebra::{Matrix3, Vector3};

/// A force and its torque about the centre of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Load {
    /// Force.
    pub force: Vector3<f64>,
    /// Torque about the centre of the body, force × length.
    pub torque: Vector3<f64>,
}

impl Load {
    /// No load.
    pub const NONE: Self = Self { force: Vector3::new(0.0, 0.0, 0.0), torque: Vector3::new(0.0, 0.0, 0.0) };

    /// A force through the centre.
    pub fn force(force: Vector3<f64>) -> Self {
        Self { force, ..Self::NONE }
    }

    /// A force at a place, on a body with this centre.
    pub fn at(place: Vector3<f64>, force: Vector3<f64>, centre: Vector3<f64>) -> Self {
        Self { force, torque: (place - centre).cross(&force) }
    }

    /// Adds `factor` times another load.
    pub fn add(&mut self, factor: f64, other: &Self) {
        self.force += factor * other.force;
        self.torque += factor * other.torque;
    }
}

/// A rigid body.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Body {
    /// Its centre of mass; torques and velocities are about it.
    pub centre: Vector3<f64>,
    /// Whether it is held: it carries whatever comes, and does not move.
    pub held: bool,
    /// The load that is there: weight, water, surcharge.
    pub dead: Load,
    /// The load that the load factor multiplies.
    pub live: Load,
}

impl Body {
    /// A free body with its weight as a force.
    pub fn free(centre: Vector3<f64>, weight: Vector3<f64>) -> Self {
        Self { centre, held: false, dead: Load::force(weight), live: Load::NONE }
    }

    /// A held body.
    pub fn held(centre: Vector3<f64>) -> Self {
        Self { centre, held: true, dead: Load::NONE, live: Load::NONE }
    }
}

/// A polygon, a line or a point on which two bodies touch, and its strength.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Contact {
    /// The two bodies, by index.
    pub bodies: [usize; 2],
    /// Corners: one or more.
    pub corners: Vec<Vector3<f64>>,
    /// Normal from the first body to the second, of any length.
    pub normal: Vector3<f64>,
    /// Area, which cohesion and tension act on; 0 for a line or a point.
    pub area: f64,
    /// Coefficient of friction μ = tan φ.
    pub friction: f64,
    /// Cohesion c, a stress.
    pub cohesion: f64,
    /// Tensile strength, a stress.
    pub tension: f64,
    /// Stiffness k_n along the normal and k_t across it, force per volume. Displacements are small, so that only
    /// k_t/k_n and the ratios of contacts count.
    pub stiffness: [f64; 2],
    /// Initial stress on the second body, before any load: p times the normal where the contact is pressed by p.
    pub initial: Vector3<f64>,
}

impl Contact {
    /// A contact with friction alone, k_t = k_n and no initial stress. The area is that of the convex polygon of the
    /// corners, in whatever order.
    pub fn new(bodies: [usize; 2], corners: Vec<Vector3<f64>>, normal: Vector3<f64>, friction: f64) -> Self {
        let initial = Vector3::zeros();
        let (area, cohesion, tension, stiffness) = (0.0, 0.0, 0.0, [1.0; 2]);
        let made = Self { bodies, corners, normal, area, friction, cohesion, tension, stiffness, initial };
        let order = made.outline();
        let from = |i: usize| made.corners[order[i]] - made.corners[order[0]];
        let doubled: Vector3<f64> = (1..order.len()).map(|i| from(i - 1).cross(&from(i))).sum();
        Self { area: 0.5 * doubled.norm(), ..made }
    }

    /// The corners of the convex hull in their order about the normal, by index: without those within it or on its
    /// edges. Fewer than three if the corners lie on a line.
    pub(super) fn outline(&self) -> Vec<usize> {
        let (middle, normal) = (middle(&self.corners), self.normal.normalize());
        let arms: Vec<Vector3<f64>> = self.corners.iter().map(|at| at - middle).collect();
        let Some(first) = (0..arms.len()).max_by(|i, j| arms[*i].norm().total_cmp(&arms[*j].norm())) else {
            return Vec::new();
        };
        let turn = |i: usize, j: usize, k: usize| (arms[j] - arms[i]).cross(&(arms[k] - arms[j])).dot(&normal);
        // From the corner farthest from the middle, which is one of the hull.
        let aside = normal.cross(&arms[first]);
        let angle = |i: usize| match aside.dot(&arms[i]).atan2(arms[first].dot(&arms[i])) {
            angle if angle < 0.0 => angle + std::f64::consts::TAU,
            angle => angle,
        };
        let mut order: Vec<usize> = (0..arms.len()).filter(|i| *i != first).collect();
        order.sort_by(|i, j| angle(*i).total_cmp(&angle(*j)));
        order.push(first);
        let straight = STRAIGHT * arms[first].norm_squared();
        let mut outline = vec![first];
        for next in order {
            while let [.., before, last] = outline[..] {
                if turn(before, last, next) > straight {
                    break;
                }
                outline.pop();
            }
            outline.push(next);
        }
        outline.pop();
        outline
    }

    /// The largest distance of a corner from the plane across the normal, over that from the middle of the corners; 0
    /// of what is a point beside its bodies.
    fn lean(&self, bodies: &[Body]) -> f64 {
        let (middle, normal) = (middle(&self.corners), self.normal.normalize());
        let about = || self.corners.iter().map(|at| at - middle);
        let extent = about().map(|at| at.norm()).fold(0.0, f64::max);
        let off = about().map(|at| at.dot(&normal).abs()).fold(0.0, f64::max);
        let reach = self.bodies.iter().map(|&body| (bodies[body].centre - middle).norm()).fold(middle.norm(), f64::max);
        if extent > A_POINT * reach { off / extent } else { 0.0 }
    }
}

/// The mean of corners; 0 of none.
fn middle(corners: &[Vector3<f64>]) -> Vector3<f64> {
    corners.iter().sum::<Vector3<f64>>() / corners.len().max(1) as f64
}

const MOST_FRICTION_SAID: &str = "a coefficient up to 1e6: tan of the angle";

/// Bodies and their contacts.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Scene {
    /// The bodies.
    pub bodies: Vec<Body>,
    /// Where they touch.
    pub contacts: Vec<Contact>,
}

/// Velocity of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Velocity {
    /// Of its centre.
    pub linear: Vector3<f64>,
    /// Angular.
    pub angular: Vector3<f64>,
}

impl Scene {
    /// Number of corners of all contacts: forces come in this order, contact after contact.
    pub fn corner_count(&self) -> usize {
        self.contacts.iter().map(|contact| contact.corners.len()).sum()
    }

    /// The same scene with `factor` times the live loads among its dead ones, and no live loads: for the strength under
    /// a push, water or a surcharge.
    #[must_use]
    pub fn under(mut self, factor: f64) -> Self {
        for body in &mut self.bodies {
            body.dead.add(factor, &body.live);
            body.live = Load::NONE;
        }
        self
    }

    /// Presses every contact by the stress there before any load: a symmetric tensor by place, pressure positive, as it
    /// is in situ.
    pub fn press(&mut self, stress: impl Fn(&Vector3<f64>) -> Matrix3<f64>) {
        for contact in &mut self.contacts {
            contact.initial = stress(&middle(&contact.corners)) * contact.normal.normalize();
        }
    }

    pub(super) fn validate(&self) -> Result<(), EquilibriumError> {
        let mut touched = vec![false; self.bodies.len()];
        for (index, contact) in self.contacts.iter().enumerate() {
            let [first, second] = contact.bodies;
            let count = self.bodies.len();
            if first == second || first.max(second) >= count {
                return Err(EquilibriumError::Bodies { contact: index, first, second, count });
            }
            if contact.corners.is_empty() {
                return Err(EquilibriumError::NoCorner(index));
            }
            contact.bodies.iter().for_each(|&body| touched[body] = true);
            let check = |name, value: f64, fine: bool, range| match fine && value.is_finite() {
                true => Ok(()),
                false => Err(EquilibriumError::OutOfRange { name, of: "contact", index, value, range }),
            };
            let length = contact.normal.norm();
            check("length of the normal", length, length > 0.0, "above 0")?;
            contact.corners.iter().try_for_each(|at| check("a corner", at.sum(), true, "finite"))?;
            let lean = contact.lean(&self.bodies);
            check("lean of the polygon from its normal", lean, lean <= MOST_LEAN, "0.1 or less: turn the normal")?;
            for (name, value) in [
                ("area", contact.area),
                ("friction", contact.friction),
                ("cohesion", contact.cohesion),
                ("tension", contact.tension),
            ] {
                check(name, value, value >= 0.0, "0 or above, and finite")?;
            }
            check("friction", contact.friction, contact.friction <= MOST_FRICTION, MOST_FRICTION_SAID)?;
            for (name, value) in ["normal stiffness", "shear stiffness"].into_iter().zip(contact.stiffness) {
                check(name, value, value > 0.0, "above 0, and finite")?;
            }
            let initial = contact.initial.norm();
            check("initial stress", initial, true, "finite")?;
        }
        for (index, body) in self.bodies.iter().enumerate() {
            for (name, v) in [
                ("centre", body.centre),
                ("dead force", body.dead.force),
                ("dead torque", body.dead.torque),
                ("live force", body.live.force),
                ("live torque", body.live.torque),
            ] {
                let value = v.norm();
                if !value.is_finite() {
                    let range = "finite, and below 1e150";
                    return Err(EquilibriumError::OutOfRange { name, of: "body", index, value, range });
                }
            }
        }
        let free = |(index, body): (usize, &Body)| (!body.held).then_some(index);
        match self.bodies.iter().enumerate().filter_map(free).find(|&body| !touched[body]) {
            _ if self.bodies.iter().all(|body| body.held) => Err(EquilibriumError::NoFreeBody),
            _ if !self.bodies.iter().any(|body| body.held) => Err(EquilibriumError::NoSupport),
            Some(body) => Err(EquilibriumError::NoContact(body)),
            None => Ok(()),
        }
    }
}
