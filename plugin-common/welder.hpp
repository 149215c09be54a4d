// SPDX-License-Identifier: MIT OR Apache-2.0
//
// Corners of triangles that are one point.
#pragma once

#include "seam.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace potential_particles {

// Gives the same number to points that are closer than their weld.
class Welder {
public:
    // `largest`: no weld is longer.
    explicit Welder(double largest)
        : cell(8 * largest)
    {
    }

    int numberOf(const Eigen::Vector3d& point, double weld)
    {
        // A point within the weld lies in one of the cells that a cube of twice that size touches.
        const Index low = indexOf(point - Eigen::Vector3d::Constant(weld));
        const Index high = indexOf(point + Eigen::Vector3d::Constant(weld));
        Index at = low;
        for (at[0] = low[0]; at[0] <= high[0]; ++at[0])
            for (at[1] = low[1]; at[1] <= high[1]; ++at[1])
                for (at[2] = low[2]; at[2] <= high[2]; ++at[2]) {
                    const auto [begin, end] = known.equal_range(keyOf(at));
                    for (auto one = begin; one != end; ++one)
                        if ((points[static_cast<std::size_t>(one->second)] - point).norm() <= weld)
                            return one->second;
                }
        const int number = static_cast<int>(points.size());
        points.push_back(point);
        known.emplace(keyOf(indexOf(point)), number);
        return number;
    }

    std::size_t size() const { return points.size(); }

private:
    using Index = std::array<std::int64_t, 3>;

    Index indexOf(const Eigen::Vector3d& point) const
    {
        Index index;
        for (int i = 0; i < 3; ++i)
            index[static_cast<std::size_t>(i)] = static_cast<std::int64_t>(std::floor(point[i] / cell));
        return index;
    }

    static std::uint64_t keyOf(const Index& index)
    {
        std::uint64_t key = 0;
        for (const std::int64_t one : index)
            key = (key ^ static_cast<std::uint64_t>(one)) * 0x9e3779b97f4a7c15u + (key >> 29);
        return key;
    }

    const double cell;
    std::vector<Eigen::Vector3d> points;
    std::unordered_multimap<std::uint64_t, int> known;
};

// Beyond, cells have no number; such a mesh has no digits left either.
inline bool isUsable(const Triangle& vertices, double weld)
{
    return weld > 0 && std::all_of(vertices.begin(), vertices.end(), [weld](const Eigen::Vector3d& vertex) {
               return vertex.allFinite() && vertex.cwiseAbs().maxCoeff() < 1e18 * weld;
           });
}

} // namespace potential_particles
