// SPDX-License-Identifier: MIT OR Apache-2.0
//
// Bounds on how far the surface of a body has come.
#pragma once

#include <potential_particles.h>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

namespace potential_particles {

constexpr double quaternionLengthError = 1e-6;

// Of the four numbers of a quaternion, in any order.
inline bool isUnit(const Eigen::Vector4d& turn) { return std::abs(turn.squaredNorm() - 1) < quaternionLengthError; }
inline bool isUnit(const Eigen::Quaterniond& turn) { return isUnit(turn.coeffs()); }

// A bound on how far a turn takes a point at distance 1; isUnit(from). Unit quaternions at a distance c = 2
// sin(angle/4) take it by 2 sin(angle/2) <= 2c. Lengths l0 and l1 near 1 change c by the factor 1/sqrt(l0 l1), since
// |x - y|^2 is (|x| - |y|)^2 + |x||y| times that of the unit vectors. A new one of any other length, within c of the
// old one's: divided by it, it is at most 2c/(2 - c) <= c(1 + c) away; beyond c = 1 the bound is more than any turn
// can do.
//
// For unit quaternions the sum of the bounds of successive turns is at least the bound of the whole turn: a pair
// skipped by the sum of steps is also separated by the whole turn.
inline double wayOfTurn(const Eigen::Vector4d& from, const Eigen::Vector4d& to)
{
    const double c = (to - from).norm();
    return 2 * c * (isUnit(to) ? 1 : 1 + c) * (1 + 2 * quaternionLengthError);
}
inline double wayOfTurn(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to)
{
    return wayOfTurn(from.coeffs(), to.coeffs());
}

// Of any point of a body within `radius` of its centre.
inline double wayBetween(const pp_pose& from, const pp_pose& to, double radius)
{
    using Eigen::Map;
    return (Map<const Eigen::Vector3d>(to.position) - Map<const Eigen::Vector3d>(from.position)).norm()
        + radius * wayOfTurn(Map<const Eigen::Vector4d>(from.orientation), Map<const Eigen::Vector4d>(to.orientation));
}

// An upper bound, despite rounding, of the sum of all ways so far and one more. Not a number if one is not.
inline double travelled(double before, double way)
{
    return way > 0 ? (before + way * (1 + 1e-12)) * (1 + std::numeric_limits<double>::epsilon()) : before + way;
}

// Until bodies that have travelled so far, taken together, have come by `room` more; 0 where there is none.
inline double wakesAt(double travelled, double room)
{
    // Three roundings of sums, and that of the room.
    return room > 0 ? (travelled + room) - 1e-15 * (travelled + room) : 0;
}

} // namespace potential_particles
