//! A triangle in the frame of its plane, whose origin is the point nearest to the centre of a particle.

use super::boundary::Triangle;
use crate::linalg::number::direction;
use crate::pair::pair::Pair;
use crate::pose::Pose;
use nalgebra::{Vector2, Vector3};

/// By two coordinates, anticlockwise.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlacedTriangle {
    vertices: [Vector2<f64>; 3],
    /// Unit vector and distance from each vertex to the next, by the vertices as given: far from the particle,
    /// `vertices` are less exact.
    edges: [(Vector2<f64>, f64); 3],
}

impl PlacedTriangle {
    /// `pair` is that of the particle at this pose and the plane of the triangle.
    pub fn of(triangle: &Triangle, pose: &Pose, pair: &Pair) -> Self {
        let rotation = pair.rotation * pose.rotation().transpose();
        let given = triangle.vertices;
        Self {
            vertices: given.map(|vertex| (rotation * (vertex - pose.position()) + pair.centre).xy()),
            edges: [0, 1, 2].map(|i| {
                let edge = rotation * (given[(i + 1) % 3] - given[i]);
                // One that is lost to rounding counts as passed.
                (direction(&edge).unwrap_or_else(Vector3::zeros).xy(), edge.norm())
            }),
        }
    }

    /// Distance of a point from edge i; negative beyond it, outside the triangle.
    fn from_edge(&self, i: usize, x: &Vector2<f64>) -> f64 {
        self.edges[i].0.perp(&(x - self.vertices[i]))
    }

    pub fn from_edges(&self, x: &Vector2<f64>) -> [f64; 3] {
        [0, 1, 2].map(|i| self.from_edge(i, x))
    }

    /// Bound on the distance from a point to any other of the triangle.
    pub fn extent(&self, from: &Vector2<f64>) -> f64 {
        self.vertices.iter().map(|vertex| (vertex - from).norm()).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pair::boundary_part::PlacedPart;
    use crate::pair::scattered;
    use crate::particle::particle::Particle;

    #[test]
    fn no_point_of_the_triangle_is_farther_than_its_extent() {
        for seed in 0..200 {
            let mut chance = scattered(10 * seed);
            let mut point = || [0.4 + 2.0 * chance(), 0.1 + 2.0 * chance(), 0.0];
            let Ok(given) = Triangle::new([point(), point(), point()]) else { continue };
            // The origin is below the centre of the particle.
            let (ball, pose) = (Particle::sphere(1.0).unwrap(), Pose::at([0.0, 0.0, 0.7]).unwrap());
            let plane = PlacedPart::new(given.inside(), &pose);
            let triangle = PlacedTriangle::of(&given, &pose, &Pair::on_boundary(&ball, &plane));
            let [a, b, c] = triangle.vertices;
            assert!((0..3).all(|i| (triangle.vertices[i].norm() - given.vertices[i].norm()).abs() < 1e-14));
            let middle = (a + b + c) / 3.0;
            assert!(triangle.from_edges(&middle).iter().all(|distance| *distance > 0.0), "{middle:?}");
            for (i, j) in (0..=20).flat_map(|i| (0..=20 - i).map(move |j| (i, j))) {
                let (u, v) = (f64::from(i) / 20.0, f64::from(j) / 20.0);
                let x: Vector2<f64> = u * a + v * b + (1.0 - u - v) * c;
                assert!((x - middle).norm() <= triangle.extent(&middle) * (1.0 + 1e-12));
            }
        }
    }
}
