//! What is there before a body is placed, and whether the body overlaps it.

use crate::boundary::{Triangle, Wall, contact_with_plane, contact_with_triangle};
use crate::contact::contact::Kind;
use crate::contact::detect::detect;
use crate::packing::supply::inner_radius;
use crate::pair::pair_state::PairState;
use crate::particle::particle::Particle;
use crate::pose::Pose;
use crate::settings::Settings;
use nalgebra::Vector3;

/// What no body of a packing may overlap.
#[allow(clippy::large_enum_variant)] // most are bodies, which are the largest
#[derive(Clone, Debug)]
pub enum Obstacle {
    /// A body that has its place.
    Body(Particle, Pose),
    /// A triangle of a mesh, which has no inside: either side of it is free.
    Triangle(Triangle),
    /// A plane, either side of which is free.
    Plane(Wall),
    /// A plane to which only the side of its normal is free.
    HalfSpace(Wall),
}

impl Obstacle {
    /// The box about it, for those that have one.
    pub(crate) fn bounding_box(&self) -> Option<(Vector3<f64>, Vector3<f64>)> {
        match self {
            Self::Body(particle, pose) => Some(particle.bounding_box(pose)),
            Self::Triangle(triangle) => {
                let [a, b, c] = triangle.vertices();
                Some((a.inf(b).inf(c), a.sup(b).sup(c)))
            }
            Self::Plane(_) | Self::HalfSpace(_) => None,
        }
    }

    /// Radius of the ball about its centre within it.
    pub(crate) fn inner_radius(&self) -> f64 {
        if let Self::Body(particle, _) = self { inner_radius(particle) } else { 0.0 }
    }

    /// A number that is below `reach` where a point is nearer to it than that, and which is the smaller the nearer it
    /// is.
    pub(crate) fn distance_at_most(&self, point: &Vector3<f64>) -> f64 {
        match self {
            Self::Body(particle, pose) => (pose.position() - point).norm() - particle.bounding_radius(),
            Self::Triangle(triangle) => triangle.normal().dot(&(point - triangle.vertices()[0])).abs(),
            Self::Plane(wall) => wall.height(point).abs(),
            Self::HalfSpace(wall) => wall.height(point),
        }
    }

    /// Whether the particle may overlap it: a pair that cannot be solved may.
    pub(crate) fn overlaps(
        &self,
        particle: &Particle,
        pose: &Pose,
        settings: &Settings,
        state: &mut PairState,
    ) -> bool {
        let state = Some(state);
        let kind = match self {
            Self::Body(other, at) => detect(particle, pose, other, at, settings, state).map(|contact| contact.kind),
            Self::Triangle(triangle) => {
                contact_with_triangle(particle, pose, triangle, settings, state).map(|contact| contact.kind)
            }
            Self::HalfSpace(wall) if !(wall.height(pose.position()) > 0.0) => return true,
            Self::Plane(wall) | Self::HalfSpace(wall) => {
                contact_with_plane(particle, pose, wall, settings, state).map(|contact| contact.kind)
            }
        };
        !matches!(kind, Ok(Kind::Separated))
    }
}
