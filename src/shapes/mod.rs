//! Builders of particles: from half-spaces, points, closed surfaces and names of solids, with rounded edges and faces
//! where they are.
//!
//! A particle stands about its centroid along its principal axes of inertia, as codes want the frame of a body;
//! [`Shape::centroid`] and [`Shape::orientation`] say where that frame lies in that of the builder. [`Rounding`] says
//! how far edges and corners are rounded, by a length or a share of the *size*: the diameter of the largest ball that
//! fits into the sharp body. Each file uses only those above it:
//!
//! | file | holds |
//! |---|---|
//! | `numbers` | what shapes are tuned by |
//! | `error` | why input makes no shape |
//! | `hull` | the convex hull of points as triangles, exact |
//! | `sharp_body` | a convex body of points or half-spaces: faces, corners, volume, centroid |
//! | `surface` | whether triangles are the whole surface of their convex hull |
//! | `principal_frame` | principal axes as near to the given ones as they can be |
//! | `touching` | planes that let a particle touch its faces where many share a rounding |
//! | `rounding` | from a sharp body to a particle about its own centroid |
//! | `solids` | the builders of bodies with flat faces |
//! | `curved_solids` | cylinders, cones, ellipsoids and capsules |
//! | `fitting` | few planes for points or surfaces of many |
//!
//! ```
//! use potential_particles::shapes::{self, Rounding};
//! let rounding = Rounding::new(0.05, 0.0); // r is a twentieth of the size, faces are flat
//! let brick = shapes::cuboid([2.0, 1.0, 0.5], &rounding)?;
//! assert!(brick.mass.volume < 1.0 && brick.mass.volume > 0.97);
//! // Of points in any order; those inside do not matter.
//! let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.2, 0.2, 0.2]];
//! let corner = shapes::hull(&points, &rounding)?;
//! assert_eq!(corner.particle.plane_count(), 4);
//! assert!((corner.centroid - nalgebra::Vector3::repeat(0.25)).norm() < 0.02);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod curved_solids;
mod error;
mod fitting;
mod hull;
mod numbers;
mod principal_frame;
mod rounding;
mod sharp_body;
mod solids;
mod surface;
mod touching;

pub use curved_solids::{SIDES, capsule, cone, cylinder, ellipsoid};
pub use error::ShapeError;
pub use fitting::{fitted, superquadric};
pub use rounding::{Rounding, Shape};
pub use solids::{cuboid, frustum, half_spaces, hull, known_hull, prism, regular_solid, sphere, surface};
#[doc(hidden)]
pub use solids::{sharp_hull, sharp_planes};
// The sharp bodies of the C interface.
#[doc(hidden)]
pub use {
    fitting::of_hull,
    principal_frame::principal_orientation,
    sharp_body::SharpBody,
    solids::{sharp_frustum, sharp_regular_solid},
    surface::refuse_open,
};
