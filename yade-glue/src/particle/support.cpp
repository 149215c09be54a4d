// SPDX-License-Identifier: GPL-3.0-or-later
#include "support.hpp"

#include "particle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace potential_particles {

using yade::Vector3r;

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
    offsets = d;
    for (std::size_t i = 0; i < d.size(); ++i)
        normals.emplace_back(a[i], b[i], c[i]);
    tried = std::min(mostPlanes, d.size());
    std::vector<std::uint32_t> order(d.size());
    std::iota(order.begin(), order.end(), 0);
    for (const Vector3r& point : points) {
        const auto beyond = [&](std::uint32_t i) { return (normals[i].dot(point) - offsets[i]) / normals[i].norm(); };
        std::partial_sort(order.begin(), order.begin() + tried, order.end(),
                          [&](std::uint32_t i, std::uint32_t j) { return beyond(i) > beyond(j); });
        Corner& corner = corners.emplace_back();
        corner.point = point;
        std::copy_n(order.begin(), tried, corner.planes.begin());
    }
}

double Support::along(const Vector3r& e) const
{
    const auto farthest = std::max_element(corners.begin(), corners.end(), [&](const Corner& one, const Corner& other) {
        return e.dot(one.point) < e.dot(other.point);
    });
    if (farthest != corners.end()) {
        const auto& at = farthest->planes;
        for (std::size_t i = 0; i < tried; ++i)
            for (std::size_t j = i + 1; j < tried; ++j)
                for (std::size_t l = j + 1; l < tried; ++l)
                    if (const double bound = by(e, at[i], at[j], at[l]); std::isfinite(bound))
                        return bound;
    }
    return std::numeric_limits<double>::infinity();
}

// Infinite, or not a number, where the y of these planes are not all >= 0.
double Support::by(const Vector3r& e, std::size_t i, std::size_t j, std::size_t l) const
{
    const Vector3r &m = normals[i], &n = normals[j], &o = normals[l];
    const Vector3r no = n.cross(o), om = o.cross(m), mn = m.cross(n);
    const Vector3r y = Vector3r(e.dot(no), e.dot(om), e.dot(mn)) / m.dot(no);
    if (!(y.minCoeff() >= 0))
        return std::numeric_limits<double>::infinity();
    const Vector3r d(offsets[i], offsets[j], offsets[l]);
    const double rounded = reach * y.norm();
    // What the rounded y misses of e, and the rounding of the sum, over ten times of it.
    const double missing = radius * (y[0] * m + y[1] * n + y[2] * o - e).norm();
    return y.dot(d) + rounded + missing + 1e-14 * (y.dot(d.cwiseAbs()) + rounded + radius * e.norm());
}

} // namespace potential_particles
