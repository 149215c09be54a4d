// SPDX-License-Identifier: GPL-3.0-or-later
#include "support.hpp"

#include "particle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace potential_particles {

using yade::Vector3r;

namespace {

    // At most so many planes of a corner are tried, three at a time: a pyramid's apex has four.
    constexpr std::size_t mostPlanes = 4;

} // namespace

Support::Support(const Definition& definition, const pp_particle* particle, double boundingRadius)
    : reach(definition.r / std::sqrt(1 - definition.k))
    , radius(boundingRadius)
{
    std::size_t count = 0;
    if (!std::isfinite(reach) || pp_particle_corners(particle, nullptr, 0, &count) != PP_BUFFER_TOO_SMALL)
        return;
    corners.resize(count);
    requireOk(pp_particle_corners(particle, corners.front().data(), count, &count));

    const auto& [a, b, c, d, r, k, R] = definition;
    const auto normal = [&](std::size_t i) { return Vector3r(a[i], b[i], c[i]); };
    std::vector<std::size_t> order(d.size());
    for (const Vector3r& corner : corners) {
        // The planes nearest to it, those it is beyond of first.
        const auto beyond = [&](std::size_t i) { return (normal(i).dot(corner) - d[i]) / normal(i).norm(); };
        std::iota(order.begin(), order.end(), 0);
        const std::size_t chosen = std::min(mostPlanes, order.size());
        std::partial_sort(order.begin(), order.begin() + chosen, order.end(),
                          [&](std::size_t i, std::size_t j) { return beyond(i) > beyond(j); });
        auto& here = meeting.emplace_back();
        for (std::size_t i = 0; i < chosen; ++i)
            for (std::size_t j = i + 1; j < chosen; ++j)
                for (std::size_t l = j + 1; l < chosen; ++l) {
                    Planes planes;
                    planes.normals << normal(order[i]), normal(order[j]), normal(order[l]);
                    planes.inverse = planes.normals.inverse();
                    planes.offsets = Vector3r(d[order[i]], d[order[j]], d[order[l]]);
                    if (planes.inverse.allFinite())
                        here.push_back(planes);
                }
    }
}

double Support::along(const Vector3r& e) const
{
    double least = std::numeric_limits<double>::infinity();
    const auto farthest = std::max_element(corners.begin(), corners.end(),
                                           [&](const Vector3r& one, const Vector3r& other) { return e.dot(one) < e.dot(other); });
    if (farthest == corners.end())
        return least;
    for (const Planes& planes : meeting[farthest - corners.begin()]) {
        const Vector3r y = planes.inverse * e;
        if (!(y.minCoeff() >= 0))
            continue;
        // What the rounded y misses of e, and the rounding of the sum, over ten times of it.
        const double missing = radius * (planes.normals * y - e).norm();
        const double size = y.dot(planes.offsets.cwiseAbs()) + reach * y.norm() + radius * e.norm();
        least = std::min(least, y.dot(planes.offsets) + reach * y.norm() + missing + 1e-14 * size);
    }
    return least;
}

} // namespace potential_particles
