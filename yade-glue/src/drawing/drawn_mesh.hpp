// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface of a particle as it is drawn on a screen.
#pragma once

#include "particle/particle.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace potential_particles {

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
