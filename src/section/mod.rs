//! The contact area: the area in which both particles meet the plane through the contact point, in closed form.
//!
//! In that plane S is piecewise quadratic, so that the boundary S = 1 of each cross-section is a closed convex curve of
//! conic arcs. Both boundaries are traced arc by arc, and over every angle at which neither changes its arc the inner
//! of the two contributes its sector. Each file uses only those above it:
//!
//! | file | holds |
//! |---|---|
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
//! | `quadrature` | the same by adaptive quadrature over rays: the fallback |

mod arc;
mod bernstein;
mod boundary;
mod cross_section;
mod depth;
mod edge_curve;
mod intersection;
mod lines;
pub(crate) mod moments;
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
        let sections = self.in_local_frames([(a, pose_a), (b, pose_b)])?;
        match intersection::area(&sections) {
            Ok(area) => Some(area),
            Err(Failure::Outside) => None,
            Err(_) => quadrature::area(&sections, relative_tolerance),
        }
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
}
