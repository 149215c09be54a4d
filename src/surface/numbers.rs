//! The numbers by which a surface is meshed, all in one place. The error of the mesh is measured whatever they are.

/// Ends of loops and sizes of buffers.
pub(super) struct Limits;

impl Limits {
    /// Flips of diagonals after one change, for each triangle: more are a circle that rounding leads in.
    pub const FLIPS: usize = 4;
}

// surface_mesh.rs
/// Least tolerance: a sphere has about a million triangles then.
pub(super) const FINEST: f64 = 1e-5;
/// The same in the plane: a circle has some 70,000 corners then.
pub(super) const FINEST_IN_PLANE: f64 = 1e-9;
/// Most vertices times the tolerance, and besides: ten times those of a sphere, which needs more than other bodies of
/// its radius. Only rounding needs more, as with normals of very different lengths; the error of the mesh then shows
/// it.
pub(super) const VERTICES_BY_TOLERANCE: f64 = 50.0;
pub(super) const FEW_VERTICES: f64 = 1_000.0;
/// Part of the way from an edge to the opposite corner below which a point is put on the edge: no sliver is needed
/// there.
pub(super) const NEAR_EDGE: f64 = 1e-3;
/// Distance, over the radius, within which two points count as one, and below which a diagonal counts as flat; part by
/// which a basic solution may violate its other constraints: more than the rounding of their products.
pub(super) const ROUNDED: f64 = 1e-12;
