//! A region that is filled, and whether it holds a particle.

use super::numbers::Limits;
use crate::boundary::Triangle;
use crate::packing::error::PackError;
use crate::particle::particle::Particle;
use crate::pose::Pose;
use crate::random::Random;
use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};
use std::fmt;
use std::sync::Arc;

/// What is filled, world frame, z upwards.
#[derive(Clone, Debug)]
pub struct Container {
    lower: Vector3<f64>,
    upper: Vector3<f64>,
    outline: Outline,
}

/// What of the box about it belongs to a container.
#[derive(Clone)]
enum Outline {
    Box,
    /// The upright cylinder of this radius that stands in the box.
    Cylinder(f64),
    /// The prism over these corners, in order around it.
    Polygon(Arc<[[f64; 2]]>),
    /// The points of which it says so.
    Points(Arc<dyn Fn([f64; 3]) -> bool + Send + Sync>),
}

impl Container {
    /// The box between two corners, sides along the axes.
    ///
    /// # Errors
    /// Corners that are not finite or enclose no volume.
    pub fn cuboid(lower: [f64; 3], upper: [f64; 3]) -> Result<Self, PackError> {
        // Written so that what is not a number fails.
        if !(0..3).all(|axis| lower[axis] < upper[axis] && (upper[axis] - lower[axis]).is_finite()) {
            return Err(PackError::EmptyContainer { lower, upper });
        }
        Ok(Self { lower: lower.into(), upper: upper.into(), outline: Outline::Box })
    }

    /// The cylinder with a vertical axis that stands on a disc about `base`.
    ///
    /// # Errors
    /// A radius or height that is not positive and finite, or a base that is not finite.
    pub fn cylinder(base: [f64; 3], radius: f64, height: f64) -> Result<Self, PackError> {
        if !(radius > 0.0 && radius.is_finite() && height > 0.0 && height.is_finite()) {
            return Err(PackError::EmptyCylinder { radius, height });
        }
        let [x, y, z] = base;
        let around = Self::cuboid([x - radius, y - radius, z], [x + radius, y + radius, z + height])?;
        Ok(Self { outline: Outline::Cylinder(radius), ..around })
    }

    /// The upright prism between two heights over a polygon (x, y), convex or not, given in order around it.
    ///
    /// # Errors
    /// Fewer than three corners, no area, edges without length, or heights that enclose nothing.
    pub fn prism(corners: &[[f64; 2]], low: f64, high: f64) -> Result<Self, PackError> {
        let has_length = |(i, corner): (usize, &[f64; 2])| *corner != corners[(i + 1) % corners.len()];
        if corners.len() < 3 || !(area(corners) > 0.0) || !corners.iter().enumerate().all(has_length) {
            return Err(PackError::Polygon(corners.len()));
        }
        let extreme = |extreme: fn(f64, f64) -> f64, axis: usize| {
            corners.iter().map(|corner| corner[axis]).fold(f64::NAN, extreme)
        };
        let lower = [extreme(f64::min, 0), extreme(f64::min, 1), low];
        let around = Self::cuboid(lower, [extreme(f64::max, 0), extreme(f64::max, 1), high])?;
        Ok(Self { outline: Outline::Polygon(corners.into()), ..around })
    }

    /// The points of a box of which `inside` says that they belong to it. A body is held if its centre and the corners
    /// of the polyhedron about it are: that is all of it, where the region is convex.
    ///
    /// # Errors
    /// Corners that are not finite or enclose no volume.
    pub fn of_points(
        lower: [f64; 3],
        upper: [f64; 3],
        inside: impl Fn([f64; 3]) -> bool + Send + Sync + 'static,
    ) -> Result<Self, PackError> {
        Ok(Self { outline: Outline::Points(Arc::new(inside)), ..Self::cuboid(lower, upper)? })
    }

    /// Area of the cross-section times height, length³; of points that of the box about them.
    pub fn volume(&self) -> f64 {
        self.area() * (self.upper.z - self.lower.z)
    }

    /// Area of the horizontal cross-section.
    pub(crate) fn area(&self) -> f64 {
        match &self.outline {
            Outline::Cylinder(radius) => PI * radius * radius,
            Outline::Polygon(corners) => area(corners),
            Outline::Box | Outline::Points(_) => self.widths().x * self.widths().y,
        }
    }

    /// The lowest corner of the box about it.
    pub(crate) fn lower(&self) -> Vector3<f64> {
        self.lower
    }

    /// The highest corner of the box about it.
    pub(crate) fn upper(&self) -> Vector3<f64> {
        self.upper
    }

    /// Edges of the box about it.
    pub(crate) fn widths(&self) -> Vector3<f64> {
        self.upper - self.lower
    }

    /// A random point, uniform in it; `None` if it is so small a part of the box about it that none was found.
    pub(crate) fn point(&self, random: &mut Random) -> Option<Vector3<f64>> {
        if let Outline::Cylinder(radius) = self.outline {
            let (z, centre) = (random.between(self.lower.z, self.upper.z), self.axis());
            let away = radius * random.uniform().sqrt();
            let (sin, cos) = (TAU * random.uniform()).sin_cos();
            return Some(Vector3::new(centre.x + away * cos, centre.y + away * sin, z));
        }
        (0..Limits::POINTS).find_map(|_| {
            // Heights first, as in cylinders: the packing of a seed stays the same.
            let [z, x, y] = [2, 0, 1].map(|axis| random.between(self.lower[axis], self.upper[axis]));
            let point = Vector3::new(x, y, z);
            self.has(&point).then_some(point)
        })
    }

    /// Whether the outline has a point of the box.
    fn has(&self, point: &Vector3<f64>) -> bool {
        match &self.outline {
            Outline::Box => true,
            Outline::Cylinder(radius) => self.off_axis(point) <= *radius,
            Outline::Polygon(corners) => surrounds(corners, point.x, point.y),
            Outline::Points(inside) => inside((*point).into()),
        }
    }

    /// Whether the particle surely lies within: by its box, and within the outline by its ball or by the corners of the
    /// polyhedron that holds it; within a polygon by its centre, where it touches none of [`Self::sides`].
    pub(crate) fn holds(&self, particle: &Particle, pose: &Pose) -> bool {
        let (lower, upper) = particle.bounding_box(pose);
        let within = |axis: usize| lower[axis] >= self.lower[axis] && upper[axis] <= self.upper[axis];
        let corners = |inside: &dyn Fn(&Vector3<f64>) -> bool| {
            particle.bounding_corners().iter().all(|corner| inside(&(pose.position() + pose.rotate(corner))))
        };
        match &self.outline {
            Outline::Box => (0..3).all(within),
            Outline::Cylinder(radius) => {
                within(2)
                    && (self.off_axis(pose.position()) + particle.bounding_radius() <= *radius
                        || corners(&|corner| self.has(corner)))
            }
            Outline::Polygon(_) => (0..3).all(within) && self.has(pose.position()),
            Outline::Points(_) => {
                (0..3).all(within) && self.has(pose.position()) && corners(&|corner| self.has(corner))
            }
        }
    }

    /// The sides of a prism: what lies within touches none of them.
    pub(crate) fn sides(&self) -> Vec<Triangle> {
        let Outline::Polygon(corners) = &self.outline else { return Vec::new() };
        let (low, high) = (self.lower.z, self.upper.z);
        let quads = corners.iter().enumerate().map(|(i, &[x, y])| ([x, y], corners[(i + 1) % corners.len()]));
        let triangles = quads.flat_map(|([x, y], [u, v])| {
            [[[x, y, low], [u, v, low], [u, v, high]], [[x, y, low], [u, v, high], [x, y, high]]]
        });
        triangles.filter_map(|triangle| Triangle::new(triangle).ok()).collect()
    }

    fn off_axis(&self, point: &Vector3<f64>) -> f64 {
        let from_axis = point - self.axis();
        from_axis.x.hypot(from_axis.y)
    }

    /// The middle of the base.
    fn axis(&self) -> Vector3<f64> {
        let middle = 0.5 * (self.lower + self.upper);
        Vector3::new(middle.x, middle.y, self.lower.z)
    }
}

/// Of a polygon, by the trapezia under its edges from the first corner.
fn area(corners: &[[f64; 2]]) -> f64 {
    let [x, y] = corners[0];
    let cross = |pair: &[[f64; 2]]| (pair[0][0] - x) * (pair[1][1] - y) - (pair[1][0] - x) * (pair[0][1] - y);
    0.5 * corners.windows(2).map(cross).sum::<f64>().abs()
}

/// Whether a ray along x from the point leaves the polygon through an odd number of edges.
fn surrounds(corners: &[[f64; 2]], x: f64, y: f64) -> bool {
    let crossed = (0..corners.len()).filter(|&i| {
        let ([a, b], [c, d]) = (corners[i], corners[(i + 1) % corners.len()]);
        (b > y) != (d > y) && x < a + (c - a) * ((y - b) / (d - b))
    });
    crossed.count() % 2 == 1
}

impl fmt::Debug for Outline {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Box => out.write_str("Box"),
            Self::Cylinder(radius) => write!(out, "Cylinder({radius})"),
            Self::Polygon(corners) => write!(out, "Polygon({corners:?})"),
            Self::Points(_) => out.write_str("Points"),
        }
    }
}
