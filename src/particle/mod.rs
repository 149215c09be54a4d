//! The shape of a particle and what follows from it alone. Each file uses only those above it:
//!
//! | file | holds |
//! |---|---|
//! | `numbers` | what bounds, cuts and quadrature are tuned by |
//! | `plane` | one plane as given |
//! | `error` | why planes and parameters do not make a particle |
//! | `plane_clusters` | planes in clusters of similar normals, which are skipped as a whole where none is active |
//! | `linear_program` | whether half-spaces enclose a volume, and how large it is: the dual simplex method |
//! | `largest_ball` | the largest ball within half-spaces, by the simplex method |
//! | `bounding_volumes` | a ball and a polyhedron that hold the particle |
//! | `cutter`, `polyhedron`, `outlines` | a polyhedron that planes cut, what a plane takes away, and the faces |
//! | `coplanar` | which faces of a convex body are one |
//! | `volume` | volume, centroid and inertia of a body from the polygons of its surface |
//! | `neighbours` | which planes are neighbours on the polyhedron that holds a particle |
//! | `solid` | the validated definition with its clusters and bounding volumes |
//! | `potential` | S, its gradient and its Hessian |
//! | `ray_cast` | the distance from a point inside to the surface |
//! | `support` | the point that lies farthest along a direction |
//! | `minkowski_gauge` | where rays through a piece of a plane leave the particle, and which planes are active there |
//! | `direction_mesh` | a partition of all directions along faces and edges |
//! | `quadrature` | a rule on an interval, and what its error is at most |
//! | `mass_properties` | volume, centroid and inertia |
//! | `polygon` | convex polygons in the plane, from points |
//! | `particle` | the public interface |
//! | `in_plane` | particles in the plane, and what their poses must keep |

pub mod bounding_volumes;
pub mod coplanar;
pub mod cutter;
pub mod direction_mesh;
pub mod error;
pub mod in_plane;
pub mod largest_ball;
pub mod linear_program;
pub mod mass_properties;
pub mod minkowski_gauge;
pub mod neighbours;
pub mod numbers;
pub mod outlines;
pub mod particle;
pub mod plane;
pub mod plane_clusters;
pub mod polygon;
pub mod polyhedron;
pub mod potential;
pub mod quadrature;
pub mod ray_cast;
pub mod solid;
pub mod support;
pub mod volume;
