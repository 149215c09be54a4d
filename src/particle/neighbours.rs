//! Which planes are neighbours on the polyhedron that holds a particle. From neighbour to neighbour a farthest plane is
//! found without visiting most of the others.

use super::numbers::FACES_APART;
use crate::particle::bounding_volumes::Bounds;
use crate::particle::cutter::Cutter;
use crate::particle::polyhedron::{OF_CUBE, Polyhedron};
use nalgebra::Vector3;

/// For each plane those whose faces share an edge with its own; none of a plane without a face.
#[derive(Clone, Debug, Default)]
pub(crate) struct Neighbours {
    /// Where those of each plane begin in `places`, and where the last ones end.
    starts: Box<[u32]>,
    /// There are at most 65,536 planes.
    places: Box<[u16]>,
}

impl Neighbours {
    /// Of the planes (a, b, c, d) of a particle.
    pub fn of(rows: &[[f64; 4]], bounds: &Bounds) -> Self {
        let faces = polyhedron(rows, bounds).outlines();
        let mut beyond = vec![&[][..]; rows.len()];
        faces.iter().filter(|face| face.number >= OF_CUBE).for_each(|face| beyond[face.number - OF_CUBE] = face.beyond);
        let (mut starts, mut places) = (vec![0], Vec::new());
        for beyond in beyond {
            places.extend(beyond.iter().filter_map(|number| number.checked_sub(OF_CUBE)).map(|place| place as u16));
            starts.push(places.len() as u32);
        }
        Self { starts: starts.into(), places: places.into() }
    }

    /// The neighbours of a plane; none where none were sought.
    #[inline]
    pub fn around(&self, place: usize) -> &[u16] {
        match self.starts.get(place..place.saturating_add(2)) {
            Some(&[from, to]) => &self.places[from as usize..to as usize],
            _ => &[],
        }
    }
}

/// The polyhedron {n_i·x ≤ d_i + r/√(1−k)}, cut off by a cube about the bounding ball. The face of plane i has the
/// number [`OF_CUBE`] + i.
pub(super) fn polyhedron(rows: &[[f64; 4]], bounds: &Bounds) -> Polyhedron {
    let radius = bounds.radius;
    let (mut polyhedron, mut cutter) = (Polyhedron::cube(radius, FACES_APART * radius), Cutter::default());
    for (place, [a, b, c, d]) in rows.iter().enumerate() {
        let (normal, height) = face(&Vector3::new(*a, *b, *c), *d, bounds);
        polyhedron.cut(&mut cutter, OF_CUBE + place, &normal, height);
    }
    polyhedron
}

/// Unit normal and height of the face of a plane.
pub(super) fn face(n: &Vector3<f64>, d: f64, bounds: &Bounds) -> (Vector3<f64>, f64) {
    (n.normalize(), ((d + bounds.face_reach) / n.norm()).max(FACES_APART * bounds.radius))
}

#[cfg(test)]
mod tests {
    use crate::particle::particle::Particle;
    use crate::particle::plane::Plane;
    use nalgebra::Vector3;

    fn around_a_ball(count: i32, stretch: f64) -> Particle {
        let plane = |i: i32| {
            let (z, phi) = (1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(count), f64::from(i) * 2.399963);
            let s = (1.0 - z * z).sqrt();
            let normal = Vector3::new(s * phi.cos(), s * phi.sin(), z);
            // Tangent planes of an ellipsoid.
            let offset = Vector3::new(normal.x, normal.y, stretch * normal.z).norm();
            Plane { normal, offset }
        };
        Particle::new(&(0..count).map(plane).collect::<Vec<_>>(), 1e-3, 0.0, 0.0).unwrap()
    }

    /// Each edge has two sides, and a polyhedron of F faces whose corners are three faces each has 3F − 6 edges.
    #[test]
    fn neighbours_are_those_of_a_closed_polyhedron() {
        for (count, stretch) in [(13, 1.0), (100, 1.0), (500, 3.0)] {
            let particle = around_a_ball(count, stretch);
            let around = |place: usize| particle.neighbours.around(place);
            let sides: usize = (0..particle.len()).map(|place| around(place).len()).sum();
            assert_eq!(sides, 2 * (3 * particle.len() - 6));
            for place in 0..particle.len() {
                assert!(around(place).iter().all(|&other| around(usize::from(other)).contains(&(place as u16))));
            }
            assert!(around(particle.len()).is_empty() && around(usize::MAX).is_empty());
        }
    }

    /// On the surface of that polyhedron a plane that no neighbour exceeds is exceeded by none.
    #[test]
    fn a_walk_on_the_surface_ends_at_the_farthest_plane() {
        let particle = around_a_ball(500, 3.0);
        for corner in super::polyhedron(&particle.rows, &particle.bounds).corners() {
            let most = particle.farthest_excess(corner);
            for from in (0..particle.len()).step_by(50) {
                let found = particle.climbed(corner, from);
                assert!((found.0 - most.0).abs() < 1e-12, "{found:?}, {most:?}");
            }
            assert!((particle.likely_excess(corner).0 - most.0).abs() < 1e-12);
        }
    }
}
