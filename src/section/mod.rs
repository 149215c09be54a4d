//! Contact area: the cut of both particles with the plane through the contact point, exact.
//!
//! Restricted to that plane S stays piecewise quadratic, so that the edge S = 1 of each cut is a closed convex
//! curve of conic arcs, and the area a sum of closed forms. Data flow:
//!
//! | module | holds |
//! |---|---|
//! | `line` | the planes of a particle as lines of the section |
//! | `margin` | 1 − S at the contact point, in twice the usual precision |
//! | `cut` | S of one particle in the section |
//! | `conic` | the quadratic that the edge follows from a point on |
//! | `walk` | the edge, arc by arc, counter-clockwise |
//! | `arc` | one arc: its sector, its parts |
//! | `inner` | which of two arcs over one angle bounds the intersection |
//! | `rays` | adaptive quadrature over rays: the fallback |

mod arc;
mod conic;
mod cut;
mod inner;
mod line;
mod margin;
mod rays;
mod walk;

use crate::pair::pose::Pose;
use crate::particle::particle::Particle;
use cut::Cut;
use line::Line;
use nalgebra::{Matrix3, Vector3};
use walk::Walk;

/// A plane through the contact point, at right angles to the contact normal, world axes.
///
/// ```
/// use potential_particles::{Particle, Pose, Section, Settings, detect};
/// let ball = Particle::sphere(1.0)?;
/// let (left, right) = (Pose::at([0.0, 0.0, 0.0])?, Pose::at([1.2, 0.0, 0.0])?);
/// let contact = detect(&ball, &left, &ball, &right, &Settings::default(), None)?;
/// let area = Section::from(&contact).area(&ball, &left, &ball, &right, 1e-6).expect("an overlapping contact");
/// assert!((area - std::f64::consts::PI * 0.64).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Section {
    /// Contact point minus position of A.
    pub branch_a: Vector3<f64>,
    /// Contact point minus position of B.
    pub branch_b: Vector3<f64>,
    /// Unit normal of the plane.
    pub normal: Vector3<f64>,
}

/// A particle, the contact point and the axes of the section plane, all in the particle's local frame.
#[derive(Clone, Copy, Debug)]
struct Side<'a> {
    particle: &'a Particle,
    /// As given: contact point minus centre, world axes, and the turn from local to world axes.
    branch: Vector3<f64>,
    rotation: Matrix3<f64>,
    point: Vector3<f64>,
    axes: [Vector3<f64>; 2],
}

/// Room for lines on the stack, cleared at each call: usually the smaller one is enough.
const ROOMS: [usize; 2] = [32, 256];

impl From<&crate::Contact> for Section {
    /// Of an overlapping contact.
    fn from(contact: &crate::Contact) -> Self {
        Self { branch_a: contact.branch_a, branch_b: contact.branch_b, normal: contact.normal }
    }
}

impl Section {
    /// Area of the intersection of both particles with this plane, length².
    ///
    /// Exact but for rounding: to 1e-12 of the area, or to ε·size/r where that is more; so it is as continuous as the
    /// motion that moves the section. What the rounding of the section itself leaves is not in this: a point that is off by δ along the
    /// normal changes the area by about δ/overlap of it.
    ///
    /// An arc counts only when its end is found on the surface again. Where rounding prevents that (below 1 in 1,000
    /// at r = 1e-8 of the size, hardly ever above 1e-6), quadrature over rays answers to `relative_tolerance`,
    /// or to 1e-9 if that is more: the only thing for which the tolerance matters. Time is proportional to the arcs
    /// times the planes close to them. Nothing is allocated unless more than 256 planes come close.
    ///
    /// This was seen to hold down to r = 1e-6 of a particle's least width. Far below, at 1e-9 of the size, a cut may be
    /// thinner than the rounding of its edges, and about 1 section in 1,000 comes out wrong.
    ///
    /// `None` when the section holds no finite point or normal, and when the contact point lies outside a particle, by
    /// S > 1 + 1e-6 and more than rounding: what a solver leaves counts as on the surface.
    pub fn area(
        &self,
        a: &Particle,
        pose_a: &Pose,
        b: &Particle,
        pose_b: &Pose,
        relative_tolerance: f64,
    ) -> Option<f64> {
        let sides = self.sides([(a, pose_a), (b, pose_b)])?;
        match exact(&sides) {
            Ok(area) => Some(area),
            Err(Trouble::Outside) => None,
            Err(_) => rays::area(&sides, relative_tolerance),
        }
    }

    fn sides<'a>(&self, bodies: [(&'a Particle, &Pose); 2]) -> Option<[Side<'a>; 2]> {
        if ![self.branch_a, self.branch_b, self.normal].iter().flatten().all(|c| c.is_finite()) {
            return None;
        }
        let unit = self.normal.try_normalize(0.0)?;
        let first = unit.cross(&Vector3::ith(unit.iamin(), 1.0)).try_normalize(0.0)?;
        let axes = [first, unit.cross(&first)];
        let [(a, pose_a), (b, pose_b)] = bodies;
        let side = |particle, pose: &Pose, branch: &Vector3<f64>| Side {
            particle,
            branch: *branch,
            rotation: *pose.rotation(),
            point: pose.rotation().tr_mul(branch),
            axes: axes.map(|axis| pose.rotation().tr_mul(&axis)),
        };
        Some([side(a, pose_a, &self.branch_a), side(b, pose_b, &self.branch_b)])
    }
}

/// Why walks found no area.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Trouble {
    /// The contact point is outside a particle.
    Outside,
    /// More planes than there is room for.
    Crowded,
    /// Rounding has spoilt a walk.
    Spoilt,
}

impl From<line::Crowded> for Trouble {
    fn from(_: line::Crowded) -> Self {
        Self::Crowded
    }
}

/// The area from walks around both edges.
fn exact(sides: &[Side; 2]) -> Result<f64, Trouble> {
    let crowded = |found: &Result<f64, Trouble>| *found == Err(Trouble::Crowded);
    let mut found = in_room::<{ ROOMS[0] }>(sides);
    if crowded(&found) {
        found = in_room::<{ ROOMS[1] }>(sides);
    }
    if crowded(&found) {
        let most = sides[0].particle.plane_count().max(sides[1].particle.plane_count());
        let (mut room_a, mut room_b) = (vec![Line::default(); most], vec![Line::default(); most]);
        found = common(sides, &mut room_a, &mut room_b);
    }
    found
}

/// Apart from its callers, so that only the room in use is on the stack.
#[inline(never)]
fn in_room<const LINES: usize>(sides: &[Side; 2]) -> Result<f64, Trouble> {
    let (mut room_a, mut room_b) = ([Line::default(); LINES], [Line::default(); LINES]);
    common(sides, &mut room_a, &mut room_b)
}

/// Both edges side by side: over every angle at which neither changes its arc, the inner of the two arcs counts.
fn common(sides: &[Side; 2], room_a: &mut [Line], room_b: &mut [Line]) -> Result<f64, Trouble> {
    let mut walk_a = Walk::new(Cut::new(&sides[0], room_a)?)?;
    let mut walk_b = Walk::new(Cut::new(&sides[1], room_b)?)?;
    let (mut arc_a, mut arc_b) = (walk_a.step()?, walk_b.step()?);
    let mut area = 0.0;
    loop {
        // Which arc ends at the smaller angle; the other one goes on behind it.
        let turn = arc_a.to.perp(&arc_b.to);
        let (mut rest_a, mut rest_b) = (None, None);
        if turn > 0.0 {
            let (now, rest) = arc_b.split(&arc_a.to);
            (arc_b, rest_b) = (now, Some(rest));
        } else if turn < 0.0 {
            let (now, rest) = arc_a.split(&arc_b.to);
            (arc_a, rest_a) = (now, Some(rest));
        }
        area += inner::sector(&arc_a, &arc_b, &walk_b.conic);
        // When one has come around, only rounding is left of the other.
        if rest_a.is_none() && walk_a.is_round() || rest_b.is_none() && walk_b.is_round() {
            break;
        }
        arc_a = rest_a.map_or_else(|| walk_a.step(), Ok)?;
        arc_b = rest_b.map_or_else(|| walk_b.step(), Ok)?;
    }
    if walk_a.is_closed() && walk_b.is_closed() && area.is_finite() { Ok(area) } else { Err(Trouble::Spoilt) }
}
