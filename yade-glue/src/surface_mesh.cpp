// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface_mesh.hpp"

#include "particle.hpp"

#include <boost/python/handle.hpp>
#include <boost/python/object.hpp>

#include <vector>

namespace py = boost::python;

namespace potential_particles {

namespace {

    // numpy reads it without a copy.
    template <class Value> py::object bytes(const std::vector<Value>& values)
    {
        const auto size = static_cast<Py_ssize_t>(values.size() * sizeof(Value));
        return py::object(py::handle<>(PyBytes_FromStringAndSize(reinterpret_cast<const char*>(values.data()), size)));
    }

} // namespace

py::tuple surfaceMesh(const yade::PotentialParticle& shape, double tolerance)
{
    const std::shared_ptr<const Particle> particle = Particle::make(Definition::of(shape));
    std::vector<double> vertices, normals;
    std::vector<std::uint32_t> triangles;
    // Enough for most meshes: asking the size alone would take as long as making the mesh.
    std::size_t points = 10'000, faces = 20'000;
    double error = 0;
    pp_status status = PP_BUFFER_TOO_SMALL;
    while (status == PP_BUFFER_TOO_SMALL) {
        vertices.resize(3 * points);
        normals.resize(3 * points);
        triangles.resize(3 * faces);
        status = pp_particle_mesh(particle->require(), tolerance, vertices.data(), normals.data(), points, &points,
                                  triangles.data(), faces, &faces, &error);
    }
    requireOk(status);
    vertices.resize(3 * points);
    normals.resize(3 * points);
    triangles.resize(3 * faces);
    return py::make_tuple(bytes(vertices), bytes(normals), bytes(triangles), error);
}

} // namespace potential_particles
