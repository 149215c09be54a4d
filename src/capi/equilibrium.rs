//! Limit analysis over the C boundary: one call for a scene of rigid bodies.

#[cfg(feature = "equilibrium")]
use super::message::Refusal;
use super::message::{Refused, explain};
use super::output::{Holds, check_room, fill};
use super::status::*;
#[cfg(feature = "equilibrium")]
use crate::equilibrium::{
    Body, Contact, Equilibrium, EquilibriumError, Flow, Load, Scene, Velocity, load_factor, stands, strength_factor,
};
use std::ffi::c_char;

/// Question of pp_equilibrium: do forces exist that hold all bodies?
pub const PP_STANDS: u32 = 0;
/// Question of pp_equilibrium: the largest multiple of the live loads that can be borne.
pub const PP_LOAD_FACTOR: u32 = 1;
/// Question of pp_equilibrium: the factor of safety on friction and cohesion.
pub const PP_STRENGTH_FACTOR: u32 = 2;

/// A rigid body; torques are about its centre.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_rigid_body {
    /// Centre of mass.
    pub centre: [f64; 3],
    /// Force that is there.
    pub dead_force: [f64; 3],
    /// Torque that is there.
    pub dead_torque: [f64; 3],
    /// Force that the load factor multiplies.
    pub live_force: [f64; 3],
    /// Torque that it multiplies.
    pub live_torque: [f64; 3],
    /// 1: it carries whatever comes, and does not move.
    pub held: u64,
}

/// A polygon, a line or a point on which two bodies touch.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pp_rigid_contact {
    /// Indices of the bodies.
    pub bodies: [u64; 2],
    /// How many of the corners are its own: 1 or more, in their order about it.
    pub corner_count: u64,
    /// From the first body to the second, of any length.
    pub normal: [f64; 3],
    /// On which cohesion and tension act.
    pub area: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// Shear strength without pressure, a stress.
    pub cohesion: f64,
    /// Tensile strength, a stress.
    pub tension: f64,
    /// Along the normal and across it, force per volume: ratios count alone. 0 and 0: 1 and 1.
    pub stiffness: [f64; 2],
    /// Initial stress on the second body: p times the normal where the contact is pressed by p.
    pub initial: [f64; 3],
}

/// What pp_equilibrium finds.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct pp_equilibrium_result {
    /// 1: the bodies come to rest (for a factor: with any factor). 0: velocities are those of the motion.
    pub stands: u32,
    /// 1: forces within the strength that hold the bodies exist, where joints open by the tangent of the
    /// friction angle as they slip.
    pub may_stand: u32,
    /// The load factor or the factor of safety; 0 for PP_STANDS and where nothing stands.
    pub factor: f64,
    /// Its bound from above, of joints that open as they slip: infinite without a limit, NaN if it was not
    /// found.
    pub bound: f64,
    /// The largest force, or torque over the size of the body, that is left on a body, over the mean load.
    pub unbalanced: f64,
    /// The largest friction beyond its strength at a point, over the mean load.
    pub excess: f64,
    /// The largest force of a contact over the mean load: far above 1 where blocks clamp each other.
    pub largest: f64,
    /// Number of matrices that were factorised, or of cone programs.
    pub solves: u64,
}

/// Limit analysis of rigid bodies on elastic joints: forces at the corners of their contacts that keep each
/// free body in equilibrium, |t| <= friction n + cohesion a and n >= -tension a, a a share of the area; and how
/// the bodies move at the limit.
///
/// question: PP_STANDS, PP_LOAD_FACTOR or PP_STRENGTH_FACTOR. dilatant: 0: joints slip along themselves, in
/// the state that loads lead to from nothing; 1: they open by the tangent of the friction angle as they slip,
/// which bounds the factor from above.
/// corners: rows of x, y, z, those of the first contact first; corner_count: of all contacts.
/// result: receives the answer. forces: receives rows of x, y, z: the force on the second body of its
/// contact at each corner, 0 where nothing stands (may be NULL). velocities: receives six numbers for each
/// body, linear and angular, the fastest corner at 1; 0 for PP_STANDS of what stands (may be NULL).
/// message: receives, on failure, a sentence that names the body, contact or value (may be NULL).
/// Errors: PP_NULL_POINTER, PP_BAD_EQUILIBRIUM, PP_BAD_SETTING (an unknown question, held or dilatant other
/// than 0 and 1), PP_BAD_INDEX (corners that are not as many as the contacts have), PP_SOLVER_FAILED (it may
/// stand or fall), PP_NO_CONE_PROGRAM.
/// Pointers: bodies points to body_count, contacts to contact_count structs, corners to 3*corner_count
/// doubles, forces is NULL or valid for as many, velocities for 6*body_count, message for message_size bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_equilibrium(
    question: u32,
    dilatant: u32,
    bodies: *const pp_rigid_body,
    body_count: usize,
    contacts: *const pp_rigid_contact,
    contact_count: usize,
    corners: *const f64,
    corner_count: usize,
    result: *mut pp_equilibrium_result,
    forces: *mut f64,
    velocities: *mut f64,
    message: *mut c_char,
    message_size: usize,
) -> pp_status {
    explain!(
        message[message_size],
        "result",
        (),
        [bodies[body_count], contacts[contact_count], corners[corner_count]],
        {
            check_room(result, 1).map_err(|status| Refused::argument(status, "result"))?;
            let (head, forces_found, velocities_found) = answer(question, dilatant, bodies, contacts, corners)?;
            // SAFETY: checked, and as the caller has promised.
            unsafe {
                fill_if_wanted(forces.place(), corner_count, forces_found)?;
                fill_if_wanted(velocities.place(), body_count, velocities_found)?;
                result.write(head);
            }
            Ok(())
        }
    )
}

/// Writes as many rows, zeros where none was found; nothing where it may.
///
/// # Safety
/// `to` is NULL or valid for writing them.
unsafe fn fill_if_wanted<V: Default>(to: *mut V, count: usize, rows: Vec<V>) -> Result<(), pp_status> {
    let rows = rows.into_iter().chain(std::iter::repeat_with(V::default));
    // SAFETY: as promised.
    if to.is_null() { Ok(()) } else { unsafe { fill(to, count, rows) } }
}

/// The result, rows of forces and of velocities.
type Found = (pp_equilibrium_result, Vec<[f64; 3]>, Vec<[f64; 6]>);

#[cfg(feature = "equilibrium")]
fn answer(
    question: u32,
    dilatant: u32,
    bodies: &[pp_rigid_body],
    contacts: &[pp_rigid_contact],
    corners: &[[f64; 3]],
) -> Result<Found, Refused> {
    let flow = match dilatant {
        0 => Flow::NonDilatant,
        1 => Flow::Associated,
        _ => return Err(PP_BAD_SETTING.into()),
    };
    let load = |force: [f64; 3], torque: [f64; 3]| Load { force: force.into(), torque: torque.into() };
    let body = |body: &pp_rigid_body| {
        let held = match body.held {
            0 => false,
            1 => true,
            _ => return Err(PP_BAD_SETTING),
        };
        let (dead, live) = (load(body.dead_force, body.dead_torque), load(body.live_force, body.live_torque));
        Ok(Body { centre: body.centre.into(), held, dead, live })
    };
    let mut left = corners;
    let contact = |contact: &pp_rigid_contact| {
        let count = usize::try_from(contact.corner_count).unwrap_or(usize::MAX);
        let (own, others) = left.split_at_checked(count).ok_or(PP_BAD_INDEX)?;
        left = others;
        Ok(Contact {
            stiffness: if contact.stiffness == [0.0; 2] { [1.0; 2] } else { contact.stiffness },
            initial: contact.initial.into(),
            bodies: contact.bodies.map(|index| usize::try_from(index).unwrap_or(usize::MAX)),
            corners: own.iter().map(|&at| at.into()).collect(),
            normal: contact.normal.into(),
            area: contact.area,
            friction: contact.friction,
            cohesion: contact.cohesion,
            tension: contact.tension,
        })
    };
    let bodies = bodies.iter().map(body).collect::<Result<_, pp_status>>()?;
    let contacts = contacts.iter().map(contact).collect::<Result<_, pp_status>>()?;
    if !left.is_empty() {
        return Err(PP_BAD_INDEX.into());
    }
    let scene = Scene { bodies, contacts };
    let found = match question {
        PP_STANDS => stands(&scene, flow),
        PP_LOAD_FACTOR => load_factor(&scene, flow),
        PP_STRENGTH_FACTOR => strength_factor(&scene, flow),
        _ => return Err(PP_BAD_SETTING.into()),
    }?;
    let six = |Velocity { linear: v, angular: w }: Velocity| [v.x, v.y, v.z, w.x, w.y, w.z];
    let Equilibrium { factor, bound, forces, mechanism, unbalanced, excess, largest, .. } = found;
    let (stands, may_stand) = (found.stands.into(), found.may_stand.into());
    let solves = found.solves.into();
    let head = pp_equilibrium_result { stands, may_stand, factor, bound, unbalanced, excess, largest, solves };
    Ok((head, forces.into_iter().map(<[f64; 3]>::from).collect(), mechanism.into_iter().map(six).collect()))
}

#[cfg(feature = "equilibrium")]
impl Refusal for EquilibriumError {
    fn status(&self) -> pp_status {
        match self {
            Self::NotConverged { .. } | Self::Undecided { .. } | Self::NotFound { .. } => PP_SOLVER_FAILED,
            _ => PP_BAD_EQUILIBRIUM,
        }
    }
}

#[cfg(not(feature = "equilibrium"))]
fn answer(_: u32, _: u32, _: &[pp_rigid_body], _: &[pp_rigid_contact], _: &[[f64; 3]]) -> Result<Found, Refused> {
    Err(PP_NO_CONE_PROGRAM.into())
}
