//! The surface of a particle as a mesh.

use super::fence::call;
use super::output::{Holds, IfWanted, Output, check_room, fill};
use super::particle::pp_particle;
use super::status::*;
use crate::{MeshError, SurfaceMesh};

/// A closed mesh of triangles inside the particle, its corners on the surface, local frame.
///
/// tolerance: the largest distance from the surface to the mesh, over the bounding radius; in [1e-5, 1].
/// vertices: room for vertex_capacity rows of x, y, z. normals: the same for the outward unit normals of
/// the surface at the vertices; NULL when not wanted. triangles: room for triangle_capacity rows of
/// three indices of vertices, from 0, counter-clockwise from outside. Buffers may be NULL when their
/// capacity is 0.
/// vertex_count, triangle_count: receive the numbers, also when a buffer is too small
/// (PP_BUFFER_TOO_SMALL), so that one call asks the size; it takes as long as one that fills the buffers.
/// error: receives the bound on the distance from any point of the surface to the mesh, length. May be
/// NULL.
/// Errors: PP_NULL_POINTER, PP_BAD_TOLERANCE, PP_BUFFER_TOO_SMALL, PP_SOLVER_FAILED (rounding leaves no
/// surface: scale the particle to a size near 1).
/// Pointers: Pointers are NULL or valid for writing what they have room for.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pp_particle_mesh(
    particle: *const pp_particle,
    tolerance: f64,
    vertices: *mut f64,
    normals: *mut f64,
    vertex_capacity: usize,
    vertex_count: *mut usize,
    triangles: *mut u32,
    triangle_capacity: usize,
    triangle_count: *mut usize,
    error: *mut f64,
) -> pp_status {
    call!([particle], {
        check_room(vertex_count, 1)?;
        check_room(triangle_count, 1)?;
        check_room(vertices, vertex_capacity)?;
        check_room(triangles, triangle_capacity)?;
        let mesh = SurfaceMesh::of(particle, tolerance).map_err(|error| match error {
            MeshError::Tolerance(_) => PP_BAD_TOLERANCE,
            MeshError::NoSurface => PP_SOLVER_FAILED,
        })?;
        let (points, faces) = (mesh.vertices.len(), mesh.triangles.len());
        let fits = points <= vertex_capacity && faces <= triangle_capacity;
        // SAFETY: checked, and the caller promised 3*vertex_capacity doubles each and 3*triangle_capacity integers.
        unsafe {
            if fits {
                fill(vertices.place(), points, mesh.vertices)?;
                fill(normals.place(), if normals.is_null() { 0 } else { points }, mesh.normals)?;
                fill(triangles.place(), faces, mesh.triangles)?;
            }
            (vertex_count, triangle_count).put((points, faces))?;
            IfWanted(error).put(|| mesh.error)?;
        }
        if fits { Ok(()) } else { Err(PP_BUFFER_TOO_SMALL) }
    })
}
