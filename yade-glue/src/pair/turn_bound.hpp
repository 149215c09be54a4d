// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far a turn takes a point, from the quaternions before and after it.
#pragma once

#include "abi/state.hpp"

#include <cmath>

namespace potential_particles {

constexpr double quaternionLengthError = 1e-6;

inline bool isUnit(const yade::Quaternionr& turn) { return std::abs(turn.squaredNorm() - 1) < quaternionLengthError; }

// A bound on how far a turn takes a point at distance 1; isUnit(from). Unit quaternions at a distance c = 2 sin(angle/4)
// take it by 2 sin(angle/2) <= 2c. Lengths l0 and l1 near 1 change c by the factor 1/sqrt(l0 l1), since |x - y|^2 is
// (|x| - |y|)^2 + |x||y| times that of the unit vectors. A new one of any other length, within c of the old one's: divided
// by it, it is at most 2c/(2 - c) <= c(1 + c) away; beyond c = 1 the bound is more than any turn can do.
//
// Of unit quaternions, turns one after the other have no smaller bounds, in sum, than the turn from the first to the last: what
// ConicInteractionLoop lets sleep by the sum of steps, KeptApart holds apart by the turn as a whole.
inline double wayOfTurn(const yade::Quaternionr& from, const yade::Quaternionr& to)
{
    const double c = (to.coeffs() - from.coeffs()).norm();
    return 2 * c * (isUnit(to) ? 1 : 1 + c) * (1 + 2 * quaternionLengthError);
}

} // namespace potential_particles
