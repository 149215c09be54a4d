//! Volume, centroid and inertia of a particle, by quadrature over rays.

use crate::particle::ray_cast;
use crate::particle::shape::Shape;
use nalgebra::{Matrix3, Vector3};

/// Volume and moments of a particle of unit density, local frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassProperties {
    /// Volume, length³.
    pub volume: f64,
    /// Centroid, length.
    pub centroid: Vector3<f64>,
    /// ∫ (|x|² I − x xᵀ) dV about the local origin, length⁵.
    pub inertia: Matrix3<f64>,
}

/// Subdivisions of each edge of an octahedron's faces: 8·n² rays.
const SUBDIVISIONS: usize = 96;

/// Volume, centroid and inertia by summing thin pyramids from the origin to the surface.
///
/// Rays go through the centres of 8·96² small triangles of the unit sphere; with ρ the distance to the surface and ω the
/// solid angle of a triangle, V = Σ ωρ³/3, ∫x = Σ ωρ⁴/4 e, ∫x xᵀ = Σ ωρ⁵/5 e eᵀ.
pub(crate) fn of(shape: &Shape) -> MassProperties {
    let (mut volume, mut first, mut second) = (0.0, Vector3::zeros(), Matrix3::zeros());
    for (direction, solid_angle) in sphere_directions(SUBDIVISIONS) {
        // The origin is inside, so that every ray leaves the particle.
        let rho = ray_cast::distance(shape, &Vector3::zeros(), &direction).unwrap_or(0.0);
        let cube = solid_angle * rho.powi(3);
        volume += cube / 3.0;
        first += cube * rho / 4.0 * direction;
        second += cube * rho * rho / 5.0 * direction * direction.transpose();
    }
    MassProperties {
        volume,
        centroid: first / volume,
        inertia: Matrix3::from_diagonal_element(second.trace()) - second,
    }
}

/// Centres and solid angles of the triangles of an octahedron, subdivided and pushed to the sphere.
fn sphere_directions(n: usize) -> impl Iterator<Item = (Vector3<f64>, f64)> {
    let corner = move |i: usize, j: usize| {
        let (x, y) = (i as f64 / n as f64, j as f64 / n as f64);
        Vector3::new(x, y, 1.0 - x - y).normalize()
    };
    let triangles = (0..n).flat_map(move |i| {
        (0..n - i).flat_map(move |j| {
            let upright = Some([(i, j), (i + 1, j), (i, j + 1)]);
            let inverted = (i + j + 2 <= n).then_some([(i + 1, j + 1), (i, j + 1), (i + 1, j)]);
            [upright, inverted].into_iter().flatten()
        })
    });
    triangles.flat_map(move |triangle| {
        let [p, q, r] = triangle.map(|(i, j)| corner(i, j));
        let centre = (p + q + r).normalize();
        let solid_angle = solid_angle(&p, &q, &r);
        (0..8).map(move |octant| {
            let sign = |bit: usize| if octant >> bit & 1 == 0 { 1.0 } else { -1.0 };
            (Vector3::new(sign(0) * centre.x, sign(1) * centre.y, sign(2) * centre.z), solid_angle)
        })
    })
}

/// Solid angle of a spherical triangle (Van Oosterom & Strackee 1983), unit corners.
fn solid_angle(p: &Vector3<f64>, q: &Vector3<f64>, r: &Vector3<f64>) -> f64 {
    2.0 * p.dot(&q.cross(r)).abs().atan2(1.0 + p.dot(q) + q.dot(r) + r.dot(p))
}

#[cfg(test)]
mod tests {
    use crate::particle::particle::Particle;
    use crate::particle::plane::Plane;

    #[test]
    fn sphere_and_cube_match_their_closed_forms() {
        let sphere = Particle::sphere(2.0).unwrap().mass_properties();
        let volume = 4.0 / 3.0 * std::f64::consts::PI * 8.0;
        assert!((sphere.volume / volume - 1.0).abs() < 1e-12, "{}", sphere.volume);
        assert!((sphere.inertia.m11 / (0.4 * 4.0 * volume) - 1.0).abs() < 1e-3);

        let r = 1e-6;
        let faces = [1.0, -1.0].into_iter().flat_map(|s| [[s, 0.0, 0.0], [0.0, s, 0.0], [0.0, 0.0, s]]);
        let planes: Vec<Plane> = faces.map(|[a, b, c]| [a, b, c, 0.5 - r].into()).collect();
        let cube = Particle::new(&planes, r, 0.0, 0.0).unwrap().mass_properties();
        assert!((cube.volume - 1.0).abs() < 3e-4, "{}", cube.volume);
        assert!((cube.inertia.m22 * 6.0 - 1.0).abs() < 1e-3);
        assert!(cube.centroid.norm() < 1e-12);
    }
}
