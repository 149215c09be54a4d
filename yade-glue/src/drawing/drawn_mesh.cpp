// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawn_mesh.hpp"

#include "surface_mesh.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace potential_particles {

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
