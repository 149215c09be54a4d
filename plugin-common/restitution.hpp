// SPDX-License-Identifier: MIT OR Apache-2.0
//
// From a coefficient of restitution to the damping ratio of a dashpot beside a linear spring.
#pragma once

#include <cmath>

namespace potential_particles {

constexpr double leastRestitution = 0.01;

// Of a mass that meets a spring with a dashpot of the ratio z to the critical one, and leaves when the force has fallen
// to 0 (no force pulls): ln e = -z/w (pi - atan2(2 z w, 2 z^2 - 1) ...), written with atan2 for either side of z =
// 1/sqrt(2).
inline double restitutionOf(double ratio)
{
    const double z = ratio, w2 = 1 - z * z;
    if (w2 > 0) {
        const double w = std::sqrt(w2);
        return std::exp(-z / w * std::atan2(2 * z * w, 2 * z * z - 1));
    }
    if (w2 == 0)
        return std::exp(-2.0);
    const double w = std::sqrt(-w2);
    return std::exp(-z / w * std::log((z + w) / (z - w)));
}

inline double dampingRatioOf(double restitution)
{
    if (restitution >= 1)
        return 0;
    double low = 0, high = 16; // e(16) < leastRestitution
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (restitutionOf(middle) > restitution ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

} // namespace potential_particles
