//! Planes that let a particle touch each face of its sharp body, where many of them share a rounding.
//!
//! A plane alone reaches its face at the foot of the perpendicular from the centre (`rounding`). Where others are active
//! there as well, S is the sum over all of them, and the surface lies deeper: of a ball of N planes by as much as a
//! quarter of its radius. So the planes are moved outwards by distances that are found from what is missing: the height
//! of the particle along the normal of each face is to be that of the face.
//!
//! At the point of greatest height along u the gradient of S is along u, so that a plane there raises this height by
//! w_j = 2 (1−k)/r² ⟨n_j·x − d_j⟩/|∇S| for each unit that it moves. These weights blur: differences from plane to plane
//! hardly show in the heights. SIRT (Gilbert 1972), each sum over its weights, finds what shows and leaves the rest.
//!
//! No plane moves beyond its face. A face that rounding swallows, as a narrow one at an edge, stays out of reach, and
//! then counts no longer.

use crate::particle::particle::Particle;
use crate::particle::plane::Plane;
use crate::particle::support;
use nalgebra::Vector3;

/// Of the height, relative: at which a face is touched, and least distance that is made up for.
const TOUCHED: f64 = 1e-6;
const UNTOUCHED: f64 = 1e-9;

/// Most rounds, and most planes times rounds.
const MOST_ROUNDS: usize = 60;
const MOST_WORK: usize = 60_000;

/// How far planes were moved, kept from one place of the centre to the next.
#[derive(Default)]
pub(super) struct Touching {
    moved: Vec<f64>,
    points: Vec<Vector3<f64>>,
}

/// Of one face: what is missing to its height, and the weights of the planes there.
struct Reached {
    missing: f64,
    own: f64,
    weights: Vec<(usize, f64)>,
}

impl Touching {
    /// Moves planes that lie below faces, unit normals and heights above the centre, outwards to where the particle
    /// touches the faces. `make`: the particle of planes.
    pub fn moved(
        &mut self,
        faces: &[(Vector3<f64>, f64)],
        planes: Vec<Plane>,
        make: impl Fn(&[Plane]) -> Option<Particle>,
    ) -> Vec<Plane> {
        if self.moved.len() != planes.len() {
            self.moved = vec![0.0; planes.len()];
            self.points = faces.iter().map(|(normal, height)| *height * normal).collect();
        }
        let extent = faces.iter().map(|(_, height)| *height).fold(0.0, f64::max);
        let mut last = None;
        for round in 0..MOST_ROUNDS {
            let now = self.applied(&planes);
            let Some(particle) = make(&now).filter(|made| made.plane_count() == planes.len()) else { return planes };
            if round == 0 && self.moved.iter().all(|moved| *moved == 0.0) && stand_alone(&particle, faces) {
                return planes;
            }
            let Some(reached) = self.reached(&particle, faces) else { return planes };
            let counts = |i: usize| {
                let Reached { missing, own, .. } = reached[i];
                missing < 0.0 || own > 0.0 || self.moved[i] < faces[i].1 - planes[i].offset
            };
            let missing: Vec<f64> =
                (0..faces.len()).map(|i| if counts(i) { reached[i].missing } else { 0.0 }).collect();
            let worst = missing.iter().fold(0.0, |worst: f64, missing| worst.max(missing.abs()));
            if round == 0 && worst <= UNTOUCHED * extent {
                return now;
            }
            let beyond = reached.iter().map(|face| -face.missing).fold(0.0, f64::max);
            last = Some(beyond);
            if worst <= TOUCHED * extent || (round + 1) * planes.len() > MOST_WORK {
                break;
            }
            let (mut sum, mut weight) = (vec![0.0; planes.len()], vec![0.0; planes.len()]);
            for (i, face) in reached.iter().enumerate() {
                let all: f64 = face.weights.iter().map(|(_, weight)| weight).sum();
                for &(j, of_plane) in &face.weights {
                    sum[j] += of_plane * missing[i] / all;
                    weight[j] += of_plane;
                }
            }
            for (j, moved) in self.moved.iter_mut().enumerate() {
                let depth = faces[j].1 - planes[j].offset;
                // A plane that is not active at its own face comes as near as it lacks.
                let change = if weight[j] > 0.0 { sum[j] / weight[j] } else { missing[j] };
                *moved = (*moved + change).clamp(0.0, depth.max(0.0));
            }
        }
        // What still lies beyond a face is taken from all, so that no part of the particle does.
        let beyond = last.unwrap_or(0.0);
        let back = |plane: Plane| Plane { offset: plane.offset - beyond, ..plane };
        self.applied(&planes).into_iter().map(back).collect()
    }

    fn applied(&self, planes: &[Plane]) -> Vec<Plane> {
        let moved = |(plane, moved): (&Plane, &f64)| Plane { offset: plane.offset + moved, ..*plane };
        planes.iter().zip(&self.moved).map(moved).collect()
    }

    fn reached(&mut self, particle: &Particle, faces: &[(Vector3<f64>, f64)]) -> Option<Vec<Reached>> {
        let mut reached = Vec::with_capacity(faces.len());
        for (i, ((normal, height), point)) in faces.iter().zip(&mut self.points).enumerate() {
            *point = support::farthest(particle, normal, point)?;
            let mut weights = Vec::new();
            particle.visit_near(point, 0.0, |place, _, excess| {
                if excess > 0.0 {
                    weights.push((particle.given_index(place), excess));
                }
            });
            let slope = particle.gradient(point).norm();
            weights.iter_mut().for_each(|(_, weight)| *weight *= 2.0 * particle.plane_weight / slope);
            let own = weights.iter().find(|(j, _)| *j == i).map_or(0.0, |(_, weight)| *weight);
            reached.push(Reached { missing: height - normal.dot(point), own, weights });
        }
        Some(reached)
    }
}

/// Whether at the foot of each face no other plane is active.
fn stand_alone(particle: &Particle, faces: &[(Vector3<f64>, f64)]) -> bool {
    faces.iter().all(|(normal, height)| {
        let mut active = 0;
        particle.visit_near(&(*height * normal), 0.0, |_, _, excess| active += usize::from(excess > 0.0));
        active <= 1
    })
}
