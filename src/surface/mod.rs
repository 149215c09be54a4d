//! A closed mesh of triangles on the surface of a particle, with a proved distance to it. Each file uses only those
//! above it:
//!
//! | file | holds |
//! |---|---|
//! | `numbers` | what the mesh is tuned by |
//! | `triangulation` | which triangle lies beside which; split and flip |
//! | `tangent_bound` | how far a convex surface can rise above a triangle, from the tangent planes at its corners |
//! | `surface_mesh` | points are added where that is most, until it is below a tolerance |

mod numbers;
pub mod surface_mesh;
mod tangent_bound;
mod triangulation;
