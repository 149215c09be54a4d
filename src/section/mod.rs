//! The contact area: the area in which both particles meet the plane through the contact point, in closed form.
//!
//! In that plane S is piecewise quadratic, so that the boundary S = 1 of each cross-section is a closed convex curve of
//! conic arcs. Both boundaries are traced arc by arc, and over every angle at which neither changes its arc the inner
//! of the two contributes its sector. Each file uses only those above it:
//!
//! | file | holds |
//! |---|---|
//! | `numbers` | what the area is tuned by |
//! | `bernstein` | quadratics and quartics in Bernstein form: signs and roots |
//! | `arc` | one arc as a rational quadratic curve: its sector, its parts |
//! | `edge_curve` | the conic that the boundary follows from a point on |
//! | `plane_section` | the plane of the section in the frame of one particle; why an area fails |
//! | `lines` | the planes of a particle as lines of the section |
//! | `depth` | 1 − S at the contact point, in double-double |
//! | `cross_section` | S of one particle in the section |
//! | `boundary` | the boundary of a cross-section, arc by arc, counter-clockwise |
//! | `intersection` | the area of the intersection of two boundaries |
//! | `moments` | area and moments of one particle's cut |
//! | `outline` | the same of a particle in the plane: its mass properties, and points of its outline |
//! | `quadrature` | the same by adaptive quadrature over rays: the fallback |

mod arc;
mod bernstein;
mod boundary;
mod cross_section;
mod depth;
mod edge_curve;
mod intersection;
mod lines;
mod moments;
mod numbers;
pub(crate) mod outline;
mod plane_section;
mod quadrature;

use crate::particle::particle::Particle;
use crate::pose::Pose;
use nalgebra::Vector3;
use plane_section::{Failure, PlaneSection};

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

impl From<&crate::Contact> for Section {
    /// Of an overlapping contact.
    fn from(contact: &crate::Contact) -> Self {
        Self { branch_a: contact.branch_a, branch_b: contact.branch_b, normal: contact.normal }
    }
}

impl Section {
    /// The relative tolerances of an area that the C interface and Python take.
    pub const TOLERANCES: std::ops::RangeInclusive<f64> = 1e-12..=0.1;

    /// Area of the intersection of both particles with this plane, length².
    ///
    /// In closed form: measured against 40-digit areas it is right to 1e-12 of the area, or to ε·size/r where that is
    /// more, so that it changes as continuously as the section does. The error of the section itself is not included: a
    /// contact point that is off by δ along the normal changes the area by a relative δ/overlap or so.
    ///
    /// The end of every arc is checked against S = 1. Where rounding makes that check fail (in less than 1 section of
    /// 1,000 at r = 1e-8 of the size, hardly ever above 1e-6), adaptive quadrature over rays answers to
    /// `relative_tolerance`, or to 1e-9 if that is more; the tolerance matters for nothing else. The run time is
    /// proportional to the number of arcs times that of the planes close to them. Nothing is allocated unless more than
    /// 256 planes come close.
    ///
    /// This was measured down to r = 1e-6 of a particle's least width. At 1e-9 a cross-section may be thinner than the
    /// rounding of its boundary, and about 1 area in 1,000 is wrong.
    ///
    /// `None` when the section has no finite point or normal, and when the contact point lies outside a particle, that
    /// is S > 1 + 1e-6 by more than rounding: what a solver leaves counts as on the surface; and where the tolerance is
    /// not a number.
    ///
    /// In the plane: the contact length (YADE: jointLength), which is the area per unit of depth, exact to rounding;
    /// `None` for one particle in the plane with one in space, too.
    pub fn area(
        &self,
        a: &Particle,
        pose_a: &Pose,
        b: &Particle,
        pose_b: &Pose,
        relative_tolerance: f64,
    ) -> Option<f64> {
        if relative_tolerance.is_nan() {
            return None;
        }
        if a.is_in_plane() | b.is_in_plane() {
            return self.length((a, pose_a), (b, pose_b));
        }
        let sections = self.in_local_frames([(a, pose_a), (b, pose_b)])?;
        match intersection::area(&sections) {
            Ok(area) => Some(area),
            Err(Failure::Outside) => None,
            Err(_) => quadrature::area(&sections, relative_tolerance),
        }
    }

    /// How much of the line of this plane in z = 0 lies in both particles: both cuts are intervals, and two rays find
    /// the ends of each.
    fn length(&self, a: (&Particle, &Pose), b: (&Particle, &Pose)) -> Option<f64> {
        Particle::refuse_mixed(a, b).ok()?;
        let normal = self.normal.try_normalize(0.0)?;
        let along = Vector3::new(-normal.y, normal.x, 0.0);
        let to_boundary = |(particle, pose): (&Particle, &Pose), branch: &Vector3<f64>, direction: &Vector3<f64>| {
            particle.surface_distance(&pose.rotation().tr_mul(branch), &pose.rotation().tr_mul(direction))
        };
        let mut length = 0.0;
        for direction in [along, -along] {
            let to_a = to_boundary(a, &self.branch_a, &direction)?;
            let to_b = to_boundary(b, &self.branch_b, &direction)?;
            length += to_a.min(to_b);
        }
        // A point that rounding left outside gives intervals that may miss each other by as much.
        Some(length.max(0.0))
    }

    fn in_local_frames<'a>(&self, bodies: [(&'a Particle, &Pose); 2]) -> Option<[PlaneSection<'a>; 2]> {
        if ![self.branch_a, self.branch_b, self.normal].iter().flatten().all(|c| c.is_finite()) {
            return None;
        }
        let unit = self.normal.try_normalize(0.0)?;
        let first = unit.cross(&Vector3::ith(unit.iamin(), 1.0)).try_normalize(0.0)?;
        let axes = [first, unit.cross(&first)];
        let [(a, pose_a), (b, pose_b)] = bodies;
        let of = |particle: &'a Particle, pose: &Pose, branch: &Vector3<f64>| PlaneSection {
            shape: particle,
            branch: *branch,
            rotation: *pose.rotation(),
            point: pose.rotation().tr_mul(branch),
            axes: axes.map(|axis| pose.rotation().tr_mul(&axis)),
        };
        Some([of(a, pose_a, &self.branch_a), of(b, pose_b, &self.branch_b)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particle::plane::Plane;

    /// Hardly any section needs the quadrature, so that it is compared with the closed form here.
    #[test]
    fn quadrature_agrees_with_the_closed_form() {
        for (r, k) in [(0.2, 0.3), (0.02, 0.05), (1e-4, 0.0), (0.1, 1.0)] {
            let planes: Vec<Plane> = (0..3)
                .flat_map(|axis| [1.0, -1.0].map(|sign| Plane { normal: Vector3::ith(axis, sign), offset: 0.4 - r }))
                .collect();
            let particle = Particle::new(&planes, r, k, 0.6).unwrap();
            let pose_a = Pose::new([0.0; 3], [1.0, 0.2, 0.3, -0.1]).unwrap();
            let pose_b = Pose::new([0.0; 3], [0.3, -0.8, 0.1, 0.5]).unwrap();
            for (i, tolerance) in [1e-3, 1e-6, 1e-9].into_iter().enumerate() {
                let i = i as f64;
                let section = Section {
                    branch_a: Vector3::new(0.1 * i, 0.2, 0.05),
                    branch_b: Vector3::new(-0.1, 0.15 * i, 0.1),
                    normal: Vector3::new(0.3, 0.5 - i, 0.8),
                };
                let sections = section.in_local_frames([(&particle, &pose_a), (&particle, &pose_b)]).unwrap();
                let exact = intersection::area(&sections).unwrap();
                let area = quadrature::area(&sections, tolerance).unwrap();
                assert!((area / exact - 1.0).abs() < tolerance, "r {r}, k {k}: {area} for {exact} to {tolerance}");
            }
            let outside = Section { branch_a: Vector3::z(), branch_b: Vector3::zeros(), normal: Vector3::z() };
            let sections = outside.in_local_frames([(&particle, &pose_a), (&particle, &pose_b)]).unwrap();
            assert_eq!(intersection::area(&sections), Err(Failure::Outside));
        }
    }

    /// The line enters the bulge of a face where it touches it, and comes out as far on the other side of the middle.
    #[test]
    fn a_line_through_a_point_that_rounding_left_outside_has_its_length() {
        let lines = [[1.0, 0.0, 0.5], [0.0, 1.0, 0.5], [-1.0, 0.0, 0.5], [0.0, -1.0, 0.5]];
        let square = Particle::in_plane(&lines, 0.05, 0.3, 0.8).unwrap();
        let pose = Pose::in_plane([3.0, -1.0], 0.4).unwrap();
        let (middle, up) = (Vector3::new(0.3, 0.0, 0.0), Vector3::y());
        let height = square.surface_distance(&middle, &up).unwrap();
        for off in -20..=20 {
            let branch = pose.rotation() * (middle + height * (1.0 + f64::from(off) * f64::EPSILON) * up);
            let section = Section { branch_a: branch, branch_b: branch, normal: pose.rotation() * up };
            let length = section.area(&square, &pose, &square, &pose, 1e-6).unwrap();
            assert!((length - 0.6).abs() < 1e-12, "{off}: {length}");
        }
    }
}
