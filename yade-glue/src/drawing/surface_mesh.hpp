// SPDX-License-Identifier: GPL-3.0-or-later
//
// The library's mesh of a particle, and that of a shape for Python.
#pragma once

#include "particle/particle.hpp"

#include <boost/python/tuple.hpp>

#include <cstdint>
#include <vector>

namespace potential_particles {

struct SurfaceMesh {
    std::vector<double> vertices, normals; // three a row, local axes
    std::vector<std::uint32_t> triangles; // three vertices a row, counter-clockwise from outside
    double error; // bound on the distance from the surface to the mesh

    // tolerance: the largest error, over the bounding radius. Throws std::invalid_argument for a particle or a
    // tolerance that the library refuses.
    static SurfaceMesh of(const Particle& particle, double tolerance);
};

// The same of a shape: vertices, normals (3 doubles a row), triangles (3 unsigned 32-bit integers a row), each as
// bytes, and the error.
boost::python::tuple surfaceMesh(const yade::PotentialParticle& shape, double tolerance);

} // namespace potential_particles
