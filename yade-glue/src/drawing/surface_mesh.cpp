// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/python_bytes.hpp"
#include "surface_mesh.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>

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

namespace {

    using Eigen::Vector3d;

    constexpr double tolerance = 1e-2;
    // A normal of the surface that differs from its triangle's by more, 25 degrees, belongs to an edge, not to a bend.
    constexpr double cosineOfEdge = 0.906;
    constexpr std::uint32_t none = ~std::uint32_t(0);

    Vector3d row(const std::vector<double>& rows, std::size_t i) { return Eigen::Map<const Vector3d>(&rows[3 * i]); }

    DrawnMesh::Corner corner(const Vector3d& normal, const Vector3d& point)
    {
        DrawnMesh::Corner made;
        Eigen::Map<Eigen::Vector3f>(made.normal.data()) = normal.cast<float>();
        Eigen::Map<Eigen::Vector3f>(made.point.data()) = point.cast<float>();
        return made;
    }

} // namespace

DrawnMesh DrawnMesh::of(const Particle& particle)
{
    const SurfaceMesh mesh = SurfaceMesh::of(particle, tolerance);
    DrawnMesh drawn;
    drawn.corners.reserve(mesh.vertices.size() / 3);
    drawn.triangles.reserve(mesh.triangles.size());
    std::vector<std::uint32_t> shared(mesh.vertices.size() / 3, none); // the corner with the normal of the surface
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
        const std::uint32_t* const of = &mesh.triangles[i];
        const Vector3d first = row(mesh.vertices, of[0]);
        const Vector3d own = (row(mesh.vertices, of[1]) - first).cross(row(mesh.vertices, of[2]) - first).normalized();
        for (int k = 0; k < 3; ++k) {
            const Vector3d normal = row(mesh.normals, of[k]);
            const bool bend = normal.dot(own) >= cosineOfEdge;
            if (bend && shared[of[k]] != none) {
                drawn.triangles.push_back(shared[of[k]]);
                continue;
            }
            const auto next = static_cast<std::uint32_t>(drawn.corners.size());
            if (bend)
                shared[of[k]] = next;
            drawn.corners.push_back(corner(bend ? normal : own, row(mesh.vertices, of[k])));
            drawn.triangles.push_back(next);
        }
    }
    return drawn;
}

} // namespace potential_particles
