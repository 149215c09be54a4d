// SPDX-License-Identifier: GPL-3.0-or-later
//
// The library's mesh of a particle: that of a shape for Python, and that which is drawn on a screen.
#pragma once

#include "particle/particle.hpp"

#include <boost/python/tuple.hpp>

#include <array>
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

struct DrawnMesh {
    struct Corner {
        std::array<float, 3> normal, point; // local axes; the normal has length 1 and points outwards
    };
    std::vector<Corner> corners;
    std::vector<std::uint32_t> triangles; // three corners each, counter-clockwise from outside

    // Of the library's mesh with an error of at most 1 % of the bounding radius. Where the surface bends, triangles
    // share a corner and its normal; where it has an edge that the mesh does not follow round, each has its own normal
    // there. Throws std::invalid_argument when there is no particle or no mesh of it.
    static DrawnMesh of(const Particle& particle);
};

} // namespace potential_particles
