// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far a turn takes a point.
#pragma once

#include "../abi/base.hpp"

#include <cmath>
#include <limits>

namespace potential_particles {

// Quaternions longer or shorter than 1 by more than this are not bounded below. (YADE keeps them at 1.)
constexpr double quaternionLengthError = 1e-6;

inline bool isUnitQuaternion(const yade::Quaternionr& turn)
{
    return std::abs(turn.squaredNorm() - 1) < quaternionLengthError;
}

// A bound on how far the turn from one unit quaternion to another takes a point at distance 1. Those at a distance c = 2 sin(angle/4) take
// it by 2 sin(angle/2) <= 2c. The second may have any length, within c of the first's: divided by it, it is at most
// 2c/(2 - c) <= c(1 + c) away; beyond c = 1 the bound is more than any turn can do.
inline double turnedFromUnit(const yade::Quaternionr& from, const yade::Quaternionr& to)
{
    const double c = (to.coeffs() - from.coeffs()).norm();
    return 2 * c * (1 + c) * (1 + 2 * quaternionLengthError);
}

// The same for any quaternions; infinite where there is no bound.
inline double turned(const yade::Quaternionr& from, const yade::Quaternionr& to)
{
    return isUnitQuaternion(from) ? turnedFromUnit(from, to) : std::numeric_limits<double>::infinity();
}

} // namespace potential_particles
