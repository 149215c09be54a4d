//! Planes that let a particle touch each face of its sharp body, where many of them share a rounding.
//!
//! A plane alone reaches its face at the foot of the perpendicular from the centre (`rounding`). Where others are
//! active there as well, S is the sum over all of them, and the surface lies deeper: of a ball of N planes by as much
//! as a quarter of its radius. So the planes are moved outwards by distances that are found from what is missing: the
//! height of the particle along the normal of each face is to be that of the face.
//!
//! At the point of greatest height along u the gradient of S is along u, so that a plane there raises this height by
//! w_j = 2 (1−k)/r² ⟨n_j·x − d_j⟩/|∇S| for each unit that it moves. These weights blur: differences from plane to plane
//! hardly show in the heights. SIRT (Gilbert 1972), each sum over its weights, finds what shows and leaves the rest.
//!
//! No plane moves beyond its face. A face that rounding swallows, as a narrow one at an edge, stays out of reach, and
//! then counts no longer.

use super::numbers::{Limits, TOUCHED, UNTOUCHED};
use crate::particle::particle::Particle;
use crate::particle::plane::Plane;
use crate::particle::support;
use nalgebra::Vector3;

/// A direction of unit length, and a height along it.
pub(super) type Height = (Vector3<f64>, f64);

/// How far planes were moved, kept from one place of the centre to the next.
#[derive(Default)]
pub(super) struct Touching {
    moved: Vec<f64>,
    points: Vec<Vector3<f64>>,
    work: usize,
}

/// Of one direction: where the particle lies farthest along it, what is missing to a height, and the weights of the
/// planes there.
pub(super) struct Reached {
    pub at: Vector3<f64>,
    pub missing: f64,
    pub weights: Vec<(usize, f64)>,
}

impl Touching {
    /// Moves planes that lie below faces, heights above the centre, outwards to where the particle touches the faces.
    /// `make`: the particle of planes.
    pub fn moved(
        &mut self,
        faces: &[Height],
        planes: Vec<Plane>,
        make: impl Fn(&[Plane]) -> Option<Particle>,
    ) -> Vec<Plane> {
        if self.moved.len() != planes.len() {
            self.moved = vec![0.0; planes.len()];
            self.points = faces.iter().map(|(normal, height)| *height * normal).collect();
        }
        let depth = faces.iter().zip(&planes).map(|(face, plane)| face.1 - plane.offset).fold(0.0, f64::max);
        let mut beyond = 0.0;
        for round in 0..Limits::STEPS {
            let now = self.applied(&planes);
            let Some(particle) = make(&now).filter(|made| made.plane_count() == planes.len()) else { return planes };
            let is_unmoved = round == 0 && self.moved.iter().all(|moved| *moved == 0.0);
            if is_unmoved && stand_alone(&particle, faces) {
                return planes;
            }
            let Some(reached) = reached(&particle, faces, &mut self.points) else { return planes };
            let own = |i: usize| reached[i].weights.iter().any(|(j, _)| *j == i);
            let is_in_reach = |i: usize| own(i) || self.moved[i] < faces[i].1 - planes[i].offset;
            let missing = |i: usize| {
                let missing = reached[i].missing;
                if missing < 0.0 || is_in_reach(i) { missing } else { 0.0 }
            };
            let missing: Vec<f64> = (0..faces.len()).map(missing).collect();
            let worst = missing.iter().fold(0.0, |worst: f64, missing| worst.max(missing.abs()));
            if round == 0 && worst <= UNTOUCHED * depth {
                return now;
            }
            beyond = missing.iter().map(|missing| -missing).fold(0.0, f64::max);
            self.work += faces.len();
            if worst <= TOUCHED * depth || self.work > Limits::TOUCHING_WORK || round + 1 == Limits::STEPS {
                break;
            }
            let changes = changes(&reached, &missing);
            for ((moved, change), (face, plane)) in self.moved.iter_mut().zip(changes).zip(faces.iter().zip(&planes)) {
                *moved = (*moved + change).clamp(0.0, (face.1 - plane.offset).max(0.0));
            }
        }
        // What still lies beyond a face is taken from all, so that no part of the particle does.
        let back = |plane: Plane| Plane { offset: plane.offset - beyond, ..plane };
        self.applied(&planes).into_iter().map(back).collect()
    }

    fn applied(&self, planes: &[Plane]) -> Vec<Plane> {
        let moved = |(plane, moved): (&Plane, &f64)| Plane { offset: plane.offset + moved, ..*plane };
        planes.iter().zip(&self.moved).map(moved).collect()
    }
}

/// Along each direction, from points that are near the farthest and become it.
pub(super) fn reached(particle: &Particle, rows: &[Height], points: &mut [Vector3<f64>]) -> Option<Vec<Reached>> {
    let of_row = |((u, height), point): (&Height, &mut Vector3<f64>)| {
        *point = support::farthest(particle, u, point)?;
        let mut weights = Vec::new();
        particle.visit_near(point, 0.0, |place, _, excess| {
            if excess > 0.0 {
                weights.push((particle.given_index(place), excess));
            }
        });
        let slope = particle.gradient(point).norm();
        weights.iter_mut().for_each(|(_, weight)| *weight *= 2.0 * particle.plane_weight / slope);
        Some(Reached { at: *point, missing: height - u.dot(point), weights })
    };
    rows.iter().zip(points).map(of_row).collect()
}

/// How far planes move towards their faces: SIRT. A plane that is not active at its own face comes as near as it lacks.
fn changes(reached: &[Reached], missing: &[f64]) -> Vec<f64> {
    let (mut sum, mut weight) = (vec![0.0; reached.len()], vec![0.0; reached.len()]);
    for (missing, reached) in missing.iter().zip(reached) {
        let all: f64 = reached.weights.iter().map(|(_, weight)| weight).sum();
        for &(j, of_plane) in &reached.weights {
            sum[j] += of_plane * missing / all;
            weight[j] += of_plane;
        }
    }
    (0..reached.len()).map(|j| if weight[j] > 0.0 { sum[j] / weight[j] } else { missing[j] }).collect()
}

/// Whether at the foot of each face no other plane is active.
fn stand_alone(particle: &Particle, faces: &[Height]) -> bool {
    faces.iter().all(|(normal, height)| {
        let mut active = 0;
        particle.visit_near(&(*height * normal), 0.0, |_, _, excess| active += usize::from(excess > 0.0));
        active <= 1
    })
}
