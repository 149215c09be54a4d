// SPDX-License-Identifier: MIT OR Apache-2.0
//
// A triangle of a wall, and what two of them share.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>

namespace potential_particles {

using Triangle = std::array<Eigen::Vector3d, 3>;

// Nine numbers, as the library takes them.
inline const double* numbersOf(const Triangle& triangle)
{
    static_assert(sizeof(Triangle) == 9 * sizeof(double));
    return triangle[0].data();
}

// Corners within this share of a triangle's longest side of each other are one. STL files round to 1e-7 of a
// coordinate, but alike for all triangles that share the corner.
constexpr double weldShare = 1e-9;

inline double weldOf(const Triangle& triangle)
{
    const auto side = [&](std::size_t i, std::size_t j) { return (triangle[i] - triangle[j]).norm(); };
    return weldShare * std::max({ side(0, 1), side(1, 2), side(2, 0) });
}

// Corners that two triangles have in common, a bit each, in the numbering of either. Two corners share the edge
// between them.
struct SharedCorners {
    unsigned mine = 0, its = 0;

    static SharedCorners of(const Triangle& mine, const Triangle& its)
    {
        const double weld = std::max(weldOf(mine), weldOf(its));
        SharedCorners shared;
        for (unsigned i = 0; i < 3; ++i)
            for (unsigned j = 0; j < 3; ++j)
                if ((mine[i] - its[j]).squaredNorm() <= weld * weld) {
                    shared.mine |= 1u << i;
                    shared.its |= 1u << j;
                }
        return shared;
    }

    explicit operator bool() const { return mine != 0; }
};

// Edge i goes from corner i to the next one.
inline unsigned cornersOfEdge(unsigned i) { return 1u << i | 1u << (i + 1) % 3; }

inline double distanceToSegment(const Eigen::Vector3d& x, const Eigen::Vector3d& from, const Eigen::Vector3d& to)
{
    const Eigen::Vector3d along = to - from;
    return (x - from - std::clamp((x - from).dot(along) / along.squaredNorm(), 0.0, 1.0) * along).norm();
}

} // namespace potential_particles
