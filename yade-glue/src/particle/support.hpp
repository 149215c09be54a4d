// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far a particle reaches along a direction, its rounding included.
//
// The library's box is that of the sharp polyhedron around a particle, whose corners lie up to several rounding radii
// outside. For y >= 0 with sum y_i n_i = e, and any x of the particle,
//     e.x = sum y_i n_i.x <= sum y_i (d_i + <n_i.x - d_i>) <= y.d + |y| r/sqrt(1-k)
// by Cauchy's inequality, since sum <n_i.x - d_i>^2 <= r^2/(1-k) there. The sharp polyhedron has the sum of the y_i in
// the place of |y|. Any y gives a bound; here it is one of three planes that meet at the farthest corner, the corner's
// most active first.
#pragma once

#include "abi/base.hpp"

#include <potential_particles.h>

#include <array>
#include <cstdint>

namespace potential_particles {

struct Definition;

class Support {
public:
    // None: every bound is infinite.
    Support() = default;
    Support(const Definition& definition, const pp_particle* particle, double radius);

    // An upper bound of e.x over the particle, local axes; infinite where no corner gives one.
    double along(const yade::Vector3r& e) const;

private:
    double by(const yade::Vector3r& e, std::size_t i, std::size_t j, std::size_t l) const;

    // At most so many planes of a corner are tried, three at a time: a pyramid's apex has four.
    static constexpr std::size_t mostPlanes = 4;

    struct Corner {
        yade::Vector3r point;
        std::array<std::uint32_t, mostPlanes> planes; // the most active first
    };

    // As few bytes as can be: boxes of many bodies are made in a row, and memory takes longer than arithmetic.
    std::vector<Corner> corners;
    std::vector<yade::Vector3r> normals;
    std::vector<double> offsets;
    std::size_t tried = 0; // planes at each corner
    double reach = 0; // r/sqrt(1-k)
    double radius = 0;
};

} // namespace potential_particles
