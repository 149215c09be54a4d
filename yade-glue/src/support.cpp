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
    std::vector<Vector3r> points(count);
    requireOk(pp_particle_corners(particle, points.front().data(), count, &count));

    const auto& [a, b, c, d, r, k, R] = definition;
    const auto normal = [&](std::size_t i) { return Vector3r(a[i], b[i], c[i]); };
    std::vector<std::size_t> order(d.size());
    for (const Vector3r& corner : points) {
        // The planes nearest to it, those it is beyond of first.
        const auto beyond = [&](std::size_t i) { return (normal(i).dot(corner) - d[i]) / normal(i).norm(); };
        std::iota(order.begin(), order.end(), 0);
        const std::size_t chosen = std::min(mostPlanes, order.size());
        std::partial_sort(order.begin(), order.begin() + chosen, order.end(),
                          [&](std::size_t i, std::size_t j) { return beyond(i) > beyond(j); });
        const std::size_t first = meeting.size();
        for (std::size_t i = 0; i < chosen; ++i)
            for (std::size_t j = i + 1; j < chosen; ++j)
                for (std::size_t l = j + 1; l < chosen; ++l) {
                    Planes planes;
                    planes.normals << normal(order[i]), normal(order[j]), normal(order[l]);
                    planes.inverse = planes.normals.inverse();
                    planes.offsets = Vector3r(d[order[i]], d[order[j]], d[order[l]]);
                    if (planes.inverse.allFinite())
                        meeting.push_back(planes);
                }
        corners.push_back({ corner, first, meeting.size() });
    }
}

double Support::along(const Vector3r& e) const
{
    const auto farthest = std::max_element(corners.begin(), corners.end(), [&](const Corner& one, const Corner& other) {
        return e.dot(one.point) < e.dot(other.point);
    });
    if (farthest == corners.end())
        return std::numeric_limits<double>::infinity();
    for (std::size_t i = farthest->first; i < farthest->last; ++i) {
        const Planes& planes = meeting[i];
        const Vector3r y = planes.inverse * e;
        if (!(y.minCoeff() >= 0))
            continue;
        // What the rounded y misses of e, and the rounding of the sum, over ten times of it.
        const double missing = radius * (planes.normals * y - e).norm();
        const double size = y.dot(planes.offsets.cwiseAbs()) + reach * y.norm() + radius * e.norm();
        return y.dot(planes.offsets) + reach * y.norm() + missing + 1e-14 * size;
    }
    return std::numeric_limits<double>::infinity();
}

} // namespace potential_particles
