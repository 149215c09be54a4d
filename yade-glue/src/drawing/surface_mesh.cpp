// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface_mesh.hpp"

#include "registration/python_bytes.hpp"

namespace py = boost::python;

namespace potential_particles {

SurfaceMesh SurfaceMesh::of(const Particle& particle, double tolerance)
{
    SurfaceMesh mesh;
    // Enough for most meshes: asking the size alone would take as long as making the mesh.
    std::size_t points = 10'000, faces = 20'000;
    pp_status status = PP_BUFFER_TOO_SMALL;
    while (status == PP_BUFFER_TOO_SMALL) {
        mesh.vertices.resize(3 * points);
        mesh.normals.resize(3 * points);
        mesh.triangles.resize(3 * faces);
        status = pp_particle_mesh(particle.require(), tolerance, mesh.vertices.data(), mesh.normals.data(), points,
                                  &points, mesh.triangles.data(), faces, &faces, &mesh.error);
    }
    requireOk(status);
    mesh.vertices.resize(3 * points);
    mesh.normals.resize(3 * points);
    mesh.triangles.resize(3 * faces);
    return mesh;
}

py::tuple surfaceMesh(const yade::PotentialParticle& shape, double tolerance)
{
    const SurfaceMesh mesh = SurfaceMesh::of(*Particle::make(Definition::of(shape)), tolerance);
    return py::make_tuple(bytes(mesh.vertices), bytes(mesh.normals), bytes(mesh.triangles), mesh.error);
}

} // namespace potential_particles
